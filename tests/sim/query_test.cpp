// `terrain query` from outside: heights against the text of the raster, lines of sight against a wall in it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/sim/program.h"

namespace {

using nlohmann::json;
using sim_test::Outcome;
using sim_test::run_program;

double relief_m(int col, int row) {
    return 100 + (row * row + 3 * col) % 41;
}

class Query : public testing::Test {
  protected:
    void SetUp() override {
        if (!sim_test::has_program()) GTEST_SKIP() << "harrier is not built in " HARRIER_BINARY_DIR;
        dem_ = folder_.write("relief.asc", sim_test::small_relief());
    }

    std::vector<json> answers(const Outcome& outcome) const {
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        std::vector<json> out;
        std::istringstream lines(outcome.out);
        for (std::string line; std::getline(lines, line);)
            out.push_back(json::parse(line));
        return out;
    }

    std::vector<json> ask(const std::string& questions, const std::string& options = "") const {
        const std::string file = folder_.write("questions.txt", questions);
        return answers(run_program(folder_, "terrain query " + dem_ + " --points " + file + options));
    }

    void expect_refused(const std::string& words, const std::string& must_say, int status = 1) const {
        const Outcome outcome = run_program(folder_, "terrain query " + words);
        EXPECT_EQ(outcome.status, status) << outcome.err;
        EXPECT_NE(outcome.err.find(must_say), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        if (status != 1) return;
        EXPECT_EQ(outcome.error_lines(), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("expected"), std::string::npos) << outcome.err;
    }

    sim_test::TempFolder folder_;
    std::string dem_;
};

TEST_F(Query, SamplesAreWhatTheFileSays) {
    std::string questions = "# all samples\n\n";
    for (int row = 0; row < 33; ++row) {
        for (int col = 0; col < 33; ++col)
            questions += std::to_string(15 + 30 * col) + ", " + std::to_string(15 + 30 * (32 - row)) + "\n";
    }
    const std::vector<json> out = ask(questions);
    ASSERT_EQ(out.size(), 33u * 33u);
    for (int row = 0; row < 33; ++row) {
        for (int col = 0; col < 33; ++col) {
            const json& one = out[static_cast<size_t>(row * 33 + col)];
            ASSERT_EQ(one["height_m"].get<double>(), relief_m(col, row)) << col << ' ' << row;
            EXPECT_EQ(one["valid"], true);
            EXPECT_EQ(one["ground"], "measured");
            EXPECT_EQ(one["spacing_m"].get<double>(), 30.0);
        }
    }
}

TEST_F(Query, BetweenAndBeyondSamples) {
    // The north-west cell is cut from its north-west to its south-east corner: both places are in the eastern half.
    const std::vector<json> out = ask("25 970\n35 960\n-100 500\n");
    ASSERT_EQ(out.size(), 3u);
    const double nw = relief_m(0, 0), ne = relief_m(1, 0), se = relief_m(1, 1);
    EXPECT_NEAR(out[0]["height_m"].get<double>(), nw + (ne - nw) / 3.0 + (se - ne) / 6.0, 1e-9);
    EXPECT_NEAR(out[1]["height_m"].get<double>(), nw + (ne - nw) / 1.5 + (se - ne) / 2.0, 1e-9);
    const std::vector<double> normal = out[0]["normal_enu"];
    EXPECT_NEAR(normal[0] / normal[2], -(ne - nw) / 30.0, 1e-9);
    EXPECT_NEAR(normal[1] / normal[2], (se - ne) / 30.0, 1e-9);
    EXPECT_EQ(out[2]["valid"], false);
    EXPECT_EQ(out[2]["ground"], "outside");
    EXPECT_FALSE(out[2].contains("height_m"));
}

TEST_F(Query, LinesOfSight) {
    // 250 m at x = 495 on a plain of 50 m, with a void next to the southern border.
    std::string text = "ncols 33\nnrows 33\nxllcorner 0\nyllcorner 0\ncellsize 30\nNODATA_value -9999\n";
    for (int row = 0; row < 33; ++row) {
        for (int col = 0; col < 33; ++col)
            text += row > 28 ? "-9999 " : col == 16 ? "250 " : "50 ";
        text += "\n";
    }
    const std::string wall = folder_.write("wall.asc", text);
    const auto sight = [&](const std::string& options) {
        const std::vector<json> out = answers(run_program(folder_, "terrain query " + wall + options));
        EXPECT_EQ(out.size(), 1u);
        return out.empty() ? json() : out[0];
    };
    const json blocked = sight(" --from 105,500,150 --to 885,500,150");
    EXPECT_EQ(blocked["blocked"], true);
    EXPECT_EQ(blocked["through_void"], false);
    EXPECT_NEAR(blocked["hit"][0].get<double>(), 480.0, 1e-4);
    EXPECT_NEAR(blocked["hit"][2].get<double>(), 150.0, 1e-9);
    EXPECT_NEAR(blocked["distance_m"].get<double>(), 375.0, 1e-4);
    const json clear = sight(" --from 105,500,251 --to 885,500,251");
    EXPECT_EQ(clear["blocked"], false);
    EXPECT_FALSE(clear.contains("hit"));
    EXPECT_EQ(sight(" --from 105,500,199 --to 885,500,199 --above-ground")["blocked"], true);
    EXPECT_EQ(sight(" --from 105,500,201 --to 885,500,201 --above-ground")["blocked"], false);
    const json gap = sight(" --from 105,50,55 --to 885,50,55");
    EXPECT_EQ(gap["blocked"], false);
    EXPECT_EQ(gap["through_void"], true);
    EXPECT_EQ(sight(" --from 105,50,55 --to 885,50,55 --voids fill")["blocked"], true);
    const std::string lines =
        folder_.write("lines.txt", "105 500 150 885 500 150\n105 500\n105 500 251 885 500 251\n");
    const std::vector<json> mixed = answers(run_program(folder_, "terrain query " + wall + " < " + lines));
    ASSERT_EQ(mixed.size(), 3u);
    EXPECT_EQ(mixed[0], blocked);
    EXPECT_EQ(mixed[1]["height_m"], 50.0);
    EXPECT_EQ(mixed[2], clear);
}

TEST_F(Query, ThreadsDoNotMatter) {
    std::string questions;
    for (int i = 0; i < 1000; ++i)
        questions += std::to_string(i * 0.97) + " " + std::to_string(i * 37 % 990) + "\n";
    EXPECT_EQ(ask(questions, " --threads 1"), ask(questions, " --threads 3"));
}

TEST_F(Query, BadInputIsOneLine) {
    expect_refused(folder_.file("none.tif"), "none.tif");
    expect_refused(dem_ + " --points " + folder_.file("none.txt"), "none.txt");
    for (const char* bad :
         {"1 2\n3\n", "1 2\n1 x\n", "1 2\n1 2 3\n", "1 2\nnan 2\n", "1 2\n1 2 3 4 5 6 7\n"}) {
        expect_refused(dem_ + " --points " + folder_.write("bad.txt", bad), "bad.txt:2: ");
    }
    const std::string jacksboro = HARRIER_SOURCE_DIR "/data/samples/jacksboro.tif";
    expect_refused(jacksboro + " --points " + folder_.write("far.txt", "-84 36\n-84 136\n"), "far.txt:2: ");
    expect_refused(jacksboro + " --from -84,36,9 --to -84,99,9", "99");
    expect_refused(dem_ + " --from -84,36,9 --to 50,50,9 --above-ground", "no ground at -84, 36");
    expect_refused(dem_ + " --from 1,2,3", "--to", 2);
    expect_refused(dem_ + " --from 1,2 --to 1,2,3", "3 numbers", 2);
}

}  // namespace
