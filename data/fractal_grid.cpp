#include "data/fractal_grid.h"

#include <algorithm>
#include <vector>

#include "lod/base/hash.h"
#include "lod/base/rng.h"

namespace data {

HeightGrid fractal_grid(int width, int height, double spacing_m, double relief_m, uint64_t seed) {
    int side = 2;
    while (side + 1 < std::max(width, height))
        side *= 2;
    const int n = side + 1;
    std::vector<float> h(static_cast<size_t>(n) * static_cast<size_t>(n), 0.0f);
    const auto at = [&](int x, int y) -> float& {
        return h[static_cast<size_t>(y) * static_cast<size_t>(n) + static_cast<size_t>(x)];
    };
    const auto noise = [&](int x, int y, double amplitude) {
        return static_cast<float>(
            amplitude *
            lod::Rng((static_cast<uint64_t>(y) << 32 | static_cast<uint64_t>(x)) ^ lod::mix64(seed))
                .between(-1.0, 1.0));
    };
    double amplitude = relief_m / 2.0;
    for (int step = side; step > 1; step /= 2, amplitude /= 2.0) {
        const int half = step / 2;
        for (int y = half; y < n; y += step) {
            for (int x = half; x < n; x += step) {
                at(x, y) = 0.25f * (at(x - half, y - half) + at(x + half, y - half) + at(x - half, y + half) +
                                    at(x + half, y + half)) +
                           noise(x, y, amplitude);
            }
        }
        for (int y = 0; y < n; y += half) {
            for (int x = (y / half) % 2 == 0 ? half : 0; x < n; x += step) {
                float sum = 0.0f;
                int count = 0;
                const int dx[4] = {-half, half, 0, 0}, dy[4] = {0, 0, -half, half};
                for (int k = 0; k < 4; ++k) {
                    if (x + dx[k] < 0 || x + dx[k] >= n || y + dy[k] < 0 || y + dy[k] >= n) continue;
                    sum += at(x + dx[k], y + dy[k]);
                    ++count;
                }
                at(x, y) = sum / static_cast<float>(count) + noise(x, y, amplitude);
            }
        }
    }
    std::vector<float> cut;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x)
            cut.push_back(at(x, y));
    }
    return make_planar_grid(width, height, spacing_m, std::move(cut));
}

}  // namespace data
