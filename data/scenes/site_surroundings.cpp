#include "data/scenes/site_surroundings.h"

#include <cmath>

#include "data/scenes/site_meshes.h"
#include "data/scenes/site_plan.h"

namespace data::site {

namespace {

constexpr double kQuarterRad = std::numbers::pi / 2.0;
constexpr int kTiles = 5;  // of 84 m, the pit in the middle
constexpr double kTileM = 2.0 * kHalfPitM;

/// A plate of ground in 8 by 8 pieces, 128 triangles; its colour varies a little from piece to piece.
TimedMesh make_ground(double size_m, const Colour& colour, uint64_t seed) {
    TimedMesh mesh;
    lod::Rng rng(seed);
    constexpr uint32_t kPieces = 8;
    for (uint32_t row = 0; row <= kPieces; ++row) {
        for (uint32_t col = 0; col <= kPieces; ++col) {
            const auto at = [&](uint32_t i) {
                return static_cast<float>(size_m * (double(i) / kPieces - 0.5));
            };
            mesh.positions.emplace_back(at(col), at(row), 0.0f);
            mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
            const double shade = rng.between(0.94, 1.06);
            mesh.colours.emplace_back(glm::u8vec3(glm::dvec3(colour) * shade), uint8_t{255});
        }
    }
    for (uint32_t row = 0; row < kPieces; ++row) {
        for (uint32_t col = 0; col < kPieces; ++col) {
            const uint32_t first = row * (kPieces + 1) + col, above = first + kPieces + 1;
            mesh.triangles.push_back({first, first + 1, above + 1});
            mesh.triangles.push_back({first, above + 1, above});
        }
    }
    return mesh;
}

void add_ground(SceneBuilder& builder) {
    const uint32_t site = add_mesh(make_ground(kTileM, kSand, 1), builder);
    const uint32_t meadow = add_mesh(make_ground(kTileM, {128, 140, 96}, 2), builder);
    for (int row = 0; row < kTiles; ++row) {
        for (int col = 0; col < kTiles; ++col) {
            const int ring = std::max(std::abs(col - kTiles / 2), std::abs(row - kTiles / 2));
            const glm::dvec3 at(kTileM * (col - kTiles / 2), kTileM * (row - kTiles / 2),
                                ring == 0 ? kPitFloorM : 0.0);
            add_object("ground", ring < 2 ? site : meadow, {at}, {}, builder);
        }
    }
    const uint32_t outer = add_mesh(make_ground(420.0, {122, 136, 92}, 3), builder);
    for (int place = 0; place < 9; ++place) {
        if (place == 4) continue;
        add_object("ground", outer, {{420.0 * (place % 3 - 1), 420.0 * (place / 3 - 1), 0.0}}, {}, builder);
    }
    TimedMesh road;
    append_box({-97.0, -4.5, 0.0}, {97.0, 4.5, 0.12}, {84, 84, 88}, road);
    for (int i = 0; i < 14; ++i)
        append_box({-90.0 + 13.0 * i, -0.12, 0.12}, {-84.0 + 13.0 * i, 0.12, 0.14}, kWhite, road);
    const uint32_t road_mesh = add_mesh(std::move(road), builder);
    for (int side = 0; side < 4; ++side)
        add_object("road", road_mesh, Placement{{}, side * kQuarterRad} * Placement{{0.0, -kRoadM, 0.0}}, {},
                   builder);
}

/// A block of flats or offices with a band of windows in every storey: 12 + 12 * storeys + 24.
TimedMesh make_house(double width_m, double depth_m, int storeys, const Colour& colour) {
    TimedMesh mesh;
    const double x = width_m / 2.0, y = depth_m / 2.0, top = 3.4 * storeys + 1.0;
    append_box({-x, -y, 0.0}, {x, y, top}, colour, mesh);
    for (int i = 0; i < storeys; ++i)
        append_box({-x - 0.05, -y - 0.05, 3.4 * i + 1.6}, {x + 0.05, y + 0.05, 3.4 * i + 3.4}, {78, 94, 108},
                   mesh);
    append_box({-x, -y, top}, {x, y, top + 0.3}, kSteel, mesh);
    append_box({-x / 3.0, -y / 3.0, top + 0.3}, {x / 3.0, y / 3.0, top + 2.8}, kConcrete, mesh);
    return mesh;
}

/// The neighbourhood: blocks on a grid beyond the fleet's grounds, lower towards the edge.
void add_neighbourhood(SceneBuilder& builder) {
    const Colour walls[] = {
        {206, 190, 166}, {190, 172, 150}, {214, 208, 198}, {178, 118, 96}, {168, 172, 176}};
    std::vector<uint32_t> meshes;
    for (int kind = 0; kind < 10; ++kind)
        meshes.push_back(add_mesh(
            make_house(22.0 + 2.0 * (kind % 3), 16.0 + 2.0 * (kind % 4), 4 + 2 * kind, walls[kind % 5]),
            builder));
    for (int row = -7; row <= 7; ++row) {
        for (int col = -7; col <= 7; ++col) {
            const int ring = std::max(std::abs(col), std::abs(row));
            if (ring < 6 || (col + row) % 2 == 0) continue;
            const uint64_t kind = builder.rng.below(ring == 6 ? 10 : 5);
            const double turn_rad = static_cast<double>(builder.rng.below(2)) * kQuarterRad;
            add_object("house", meshes[kind], {{38.0 * col, 38.0 * row, 0.0}, turn_rad}, {}, builder);
        }
    }
}

/// Huts of the four camps, lamps along the ring road, trees of the neighbourhood.
void add_furniture(SceneBuilder& builder) {
    TimedMesh hut, lamp;
    append_box({-3.0, -1.2, 0.2}, {3.0, 1.2, 2.7}, kWhite, hut);
    append_box({-3.05, -1.25, 2.7}, {3.05, 1.25, 2.85}, {58, 112, 158}, hut);
    for (const double at : {-2.2, 0.8})
        append_box({at, -1.23, 1.1}, {at + 1.2, -1.2, 2.1}, {60, 84, 104}, hut);
    append_box({-0.6, -1.23, 0.2}, {0.3, -1.2, 2.2}, kSteel, hut);
    append_tube({{0, 0, 0}, {0, 0, 9.0}, 0.12, 6}, kSteel, lamp);
    append_bar({{0, 0, 8.9}, {0, 2.0, 9.1}, 0.12, 0.12}, kSteel, lamp);
    append_box({-0.2, 1.4, 8.95}, {0.2, 2.4, 9.1}, kWhite, lamp);
    const uint32_t hut_mesh = add_mesh(std::move(hut), builder),
                   lamp_mesh = add_mesh(std::move(lamp), builder);
    for (int i = 0; i < 64; ++i) {
        const Placement in_camp{{106.0 + 7.0 * (i / 4 % 6), 155.0 + 4.0 * (i / 24), 0.0}};
        add_object("hut", hut_mesh, Placement{{}, i % 4 * kQuarterRad} * in_camp, {}, builder);
    }
    for (int i = 0; i < 48; ++i) {
        const Placement on_side{{16.0 * (i / 4) - 88.0, -kRoadM - 7.0, 0.0}};
        add_object("lamp", lamp_mesh, Placement{{}, i % 4 * kQuarterRad} * on_side, {}, builder);
    }
}

}  // namespace

void add_surroundings(SceneBuilder& builder) {
    add_ground(builder);
    add_neighbourhood(builder);
    add_furniture(builder);
}

}  // namespace data::site
