// `terrain query` and `terrain extract` of a store: word for word what the raster says that it was made of.
#include <gtest/gtest.h>

#include "lod/base/rng.h"
#include "tests/sim/program.h"

namespace {

using sim_test::run_program;

const std::string kJacksboro = std::string(HARRIER_SOURCE_DIR) + "/data/samples/jacksboro.tif";

class StoreSource : public testing::Test {
  protected:
    void SetUp() override {
        if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
        store_ = folder_.file("relief.hts");
        const auto built = run_program(folder_, "terrain build " + kJacksboro + " --out " + store_);
        ASSERT_EQ(built.status, 0) << built.err;
    }

    sim_test::TempFolder folder_;
    std::string store_;
};

TEST_F(StoreSource, AnswersAsItsRasterDoes) {
    lod::Rng rng(3);
    std::string questions;
    const auto place = [&](double beyond_deg) {
        return std::to_string(rng.between(-84.412 - beyond_deg, -84.08 + beyond_deg)) + " " +
               std::to_string(rng.between(36.448 - beyond_deg, 36.731 + beyond_deg));
    };
    for (int i = 0; i < 400; ++i)
        questions += place(0.02) + "\n";
    for (int i = 0; i < 100; ++i)
        questions += place(0.0) + " 30 " + place(0.0) + " 30\n";
    const std::string file = folder_.write("questions.txt", questions);
    const auto ask = [&](const std::string& source) {
        const auto outcome =
            run_program(folder_, "terrain query " + source + " --points " + file + " --above-ground");
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.out;
    };
    const std::string of_raster = ask(kJacksboro), of_store = ask(store_);
    EXPECT_EQ(of_store, of_raster);
    EXPECT_NE(of_raster.find("\"valid\":true"), std::string::npos);
    EXPECT_NE(of_raster.find("\"blocked\":true"), std::string::npos);
}

TEST_F(StoreSource, GivesTheMeshOfItsRaster) {
    const auto extract = [&](const std::string& source, const std::string& ply) {
        const auto outcome =
            run_program(folder_, "terrain extract " + source + " --max-error 5 --out " + folder_.file(ply));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return sim_test::read_all(folder_.file(ply));
    };
    EXPECT_EQ(extract(store_, "store.ply"), extract(kJacksboro, "raster.ply"));
}

TEST_F(StoreSource, StandsAlone) {
    const auto outcome =
        run_program(folder_, "terrain query " + kJacksboro + " " + store_ + " --points /dev/null");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("expected it alone"), std::string::npos) << outcome.err;
}

}  // namespace
