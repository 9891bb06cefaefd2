// make_relief OUT.tif SIDE SPACING_M RELIEF_M SEED: a large fractal raster, written row by row: smooth noise on
// lattices of 2, 4, … cells, each 0.62 times as high as the next wider one.
// RELIEF_M is the widest one's; 16-bit decimetres hold 1200.
#include <cpl_string.h>
#include <gdal.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "lod/base/parallel.h"
#include "lod/base/rng.h"

namespace {

constexpr double kUnit_m = 0.1;  // of the 16-bit heights
constexpr int kRows = 256;       // computed at once

struct Relief {
    int side = 0;
    double relief_m = 0.0;
    uint64_t seed = 0;
};

float lattice(const Relief& relief, int log2_step, int x, int y) {
    const uint64_t key = uint64_t(uint32_t(log2_step)) << 56 | uint64_t(uint32_t(y)) << 28 | uint32_t(x);
    return static_cast<float>(lod::Rng(key ^ lod::mix64(relief.seed)).between(-1.0, 1.0));
}

float eased(float share) {
    return share * share * (3.0f - 2.0f * share);
}

/// Adds one octave to a row.
void add_octave(const Relief& relief, int log2_step, int y, std::vector<float>& row) {
    const int step = 1 << log2_step, at = y >> log2_step;
    const auto height_m = static_cast<float>(relief.relief_m * std::pow(double(step) / relief.side, 0.7));
    const float down = eased(static_cast<float>(y & (step - 1)) / static_cast<float>(step));
    const auto value = [&](int x) {
        const float above = lattice(relief, log2_step, x, at), below = lattice(relief, log2_step, x, at + 1);
        return height_m * (above + (below - above) * down);
    };
    float left = value(0);
    for (int x = 0; x < relief.side; x += step) {
        const float right = value((x >> log2_step) + 1);
        for (int i = 0; i < step && x + i < relief.side; ++i) {
            const float across = eased(static_cast<float>(i) / static_cast<float>(step));
            row[static_cast<size_t>(x + i)] += left + (right - left) * across;
        }
        left = right;
    }
}

GDALDatasetH create(const char* path, int side, double spacing_m) {
    GDALAllRegister();
    char** options = nullptr;
    for (const char* option : {"COMPRESS=ZSTD", "ZSTD_LEVEL=1", "PREDICTOR=2", "BIGTIFF=IF_SAFER"})
        options = CSLAddString(options, option);
    GDALDatasetH dataset = GDALCreate(GDALGetDriverByName("GTiff"), path, side, side, 1, GDT_Int16, options);
    CSLDestroy(options);
    if (dataset == nullptr) return nullptr;
    double place[6] = {0.0, spacing_m, 0.0, side * spacing_m, 0.0, -spacing_m};
    GDALSetGeoTransform(dataset, place);
    GDALSetRasterScale(GDALGetRasterBand(dataset, 1), kUnit_m);
    return dataset;
}

}  // namespace

int main(int count, char** words) {
    if (count != 6) {
        std::fprintf(stderr, "make_relief OUT.tif SIDE SPACING_M RELIEF_M SEED\n");
        return 2;
    }
    const Relief relief{std::atoi(words[2]), std::atof(words[4]), std::strtoull(words[5], nullptr, 10)};
    GDALDatasetH dataset = create(words[1], relief.side, std::atof(words[3]));
    if (dataset == nullptr) return 1;
    const auto side = static_cast<size_t>(relief.side);
    std::vector<int16_t> block(side * kRows);
    for (int first = 0; first < relief.side; first += kRows) {
        const int rows = std::min(kRows, relief.side - first);
        lod::parallel_for(static_cast<size_t>(rows), 2, [&](size_t begin, size_t end) {
            std::vector<float> row(side);
            for (size_t y = begin; y < end; ++y) {
                std::fill(row.begin(), row.end(), 0.0f);
                for (int log2_step = 1; 1 << log2_step <= relief.side; ++log2_step)
                    add_octave(relief, log2_step, first + static_cast<int>(y), row);
                for (size_t x = 0; x < side; ++x)
                    block[y * side + x] = static_cast<int16_t>(std::lrint(double(row[x]) / kUnit_m));
            }
        });
        if (GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Write, 0, first, relief.side, rows, block.data(),
                         relief.side, rows, GDT_Int16, 0, 0) != CE_None) {
            return 1;
        }
    }
    GDALClose(dataset);
    return 0;
}
