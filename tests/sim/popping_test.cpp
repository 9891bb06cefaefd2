// Popping along the demo's path: no vertex in view moves by more than half a pixel between two frames at 60 Hz.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/sim/program.h"

namespace {

/// Frames until the first picture, a cut, has been refined to the tolerance and what that moved has arrived.
constexpr size_t kFirstSettled = 60;

TEST(Popping, StaysBelowHalfAPixelAlongTheDemoPath) {
    if (!sim_test::has_program()) GTEST_SKIP() << "the program is not built";
    const sim_test::TempFolder folder;
    const std::string report = folder.file("report.json");
    const sim_test::Outcome outcome =
        sim_test::run_program(folder, "fly " HARRIER_SOURCE_DIR
                                      "/data/samples/jacksboro.toml --ops 1500 --triangles 60000 --rate 60 "
                                      "--frames 300 --report " +
                                          report);
    if (outcome.status != 0 && outcome.err.find("EGL") != std::string::npos) GTEST_SKIP() << outcome.err;
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto json = nlohmann::json::parse(std::ifstream(report));
    const auto& frames = json.at("frames");
    ASSERT_EQ(frames.size(), 300u);
    double largest_px = 0.0, largest_error_px = 0.0;
    uint64_t changes = 0;
    for (size_t i = kFirstSettled; i < frames.size(); ++i) {
        largest_error_px = std::max(largest_error_px, frames[i].at("error_px").at("terrain").get<double>());
        largest_px = std::max(largest_px, frames[i].at("jump_px").get<double>());
        changes += frames[i].at("operations").at("split").get<uint64_t>() +
                   frames[i].at("operations").at("merge").get<uint64_t>();
    }
    RecordProperty("largest_jump_px", std::to_string(largest_px));
    RecordProperty("largest_error_px", std::to_string(largest_error_px));
    EXPECT_LE(largest_px, 0.5);
    // What comes into view must not wait for glides: the mesh's 1 px, and what is on its way.
    EXPECT_LE(largest_error_px, 1.5);
    EXPECT_GT(largest_px, 0.01) << "nothing moved";
    EXPECT_GT(changes, 300u) << "the mesh should change along the path";
}

}  // namespace
