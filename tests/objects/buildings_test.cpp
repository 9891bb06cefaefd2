#include "objects/buildings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "lod/base/rng.h"
#include "objects/hilbert.h"

namespace objects {
namespace {

constexpr double kSpacing = 10.0;
constexpr int kSamples = 65;

data::HeightGrid rough_grid() {
    std::vector<float> heights(kSamples * kSamples);
    lod::Rng rng(42);
    for (float& height : heights)
        height = static_cast<float>(rng.between(100.0, 108.0));
    return data::make_planar_grid(kSamples, kSamples, kSpacing, heights);
}

/// Height at a site of a planar grid, from the two triangles' barycentric coordinates.
double brute_force_height(const data::HeightGrid& grid, double x, double y) {
    const double col = x / kSpacing, row = kSamples - 1 - y / kSpacing;
    const int c = std::clamp(static_cast<int>(col), 0, kSamples - 2);
    const int r = std::clamp(static_cast<int>(row), 0, kSamples - 2);
    const std::array<std::array<int, 2>, 4> corner{{{c, r}, {c + 1, r}, {c + 1, r + 1}, {c, r + 1}}};
    const int even = (c + r) % 2 == 0 ? 0 : 1;  // where the diagonal starts
    for (int half = 0; half < 2; ++half) {
        const auto a = corner[static_cast<size_t>(even)], b = corner[static_cast<size_t>(even + 2) % 4];
        const auto apex = corner[static_cast<size_t>(even + 1 + 2 * half) % 4];
        const glm::dmat3 points(glm::dvec3(a[0], a[1], 1), glm::dvec3(b[0], b[1], 1),
                                glm::dvec3(apex[0], apex[1], 1));
        const glm::dvec3 weight = glm::inverse(points) * glm::dvec3(col, row, 1.0);
        if (std::min({weight.x, weight.y, weight.z}) < -1e-9) continue;
        return weight.x * double(grid.at(a[0], a[1])) + weight.y * double(grid.at(b[0], b[1])) +
               weight.z * double(grid.at(apex[0], apex[1]));
    }
    ADD_FAILURE() << "no triangle holds " << x << ", " << y;
    return 0.0;
}

/// A turned rectangle, with or without a courtyard half its size.
data::Footprint block(const glm::dvec2& middle, const glm::dvec2& half, double turn, bool has_courtyard) {
    data::Footprint footprint;
    const auto ring = [&](double scale, bool clockwise) {
        std::vector<glm::dvec2> points;
        for (const glm::dvec2& sign :
             {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
            const glm::dvec2 p = sign * half * scale;
            points.push_back(middle + glm::dvec2(p.x * std::cos(turn) - p.y * std::sin(turn),
                                                 p.x * std::sin(turn) + p.y * std::cos(turn)));
        }
        if (clockwise) std::reverse(points.begin() + 1, points.end());
        return points;
    };
    footprint.rings.push_back(ring(1.0, false));
    footprint.triangles = {{0, 1, 2}, {0, 2, 3}};
    footprint.height_m = 12.0;
    if (!has_courtyard) return footprint;
    footprint.rings.push_back(
        ring(0.5, true));  // corner k of the courtyard faces corner (4 - k) % 4 of the block
    footprint.triangles.clear();
    for (uint32_t k = 0; k < 4; ++k) {
        const uint32_t next = (k + 1) % 4, in = 4 + (4 - k) % 4, in_next = 4 + (4 - next) % 4;
        footprint.triangles.push_back({k, next, in_next});
        footprint.triangles.push_back({k, in_next, in});
    }
    return footprint;
}

data::Footprints random_blocks(size_t count, uint64_t seed) {
    lod::Rng rng(seed);
    data::Footprints footprints;
    for (size_t i = 0; i < count; ++i) {
        const double x = rng.between(60.0, 580.0), y = rng.between(60.0, 580.0);
        const double width = rng.between(3.0, 35.0), depth = rng.between(3.0, 35.0);
        data::Footprint footprint = block({x, y}, {width, depth}, rng.between(0.0, 6.3), i % 3 == 0);
        footprint.id = static_cast<int64_t>(i);
        footprints.buildings.push_back(footprint);
    }
    return footprints;
}

Buildings build(const data::Footprints& footprints, const data::HeightGrid* grid, uint32_t per_cell = 2000) {
    return build_buildings(footprints, grid, data::WorldFrame{.has_datum = false},
                           {.triangles_per_cell = per_cell});
}

lod::Material material_of(const lod::Vertex& vertex) {
    return static_cast<lod::Material>(vertex.colour[3]);
}

glm::dvec3 corner(const lod::RigidPart& part, size_t triangle, size_t k) {
    return position_of(part.vertices[part.indices[3 * triangle + k % 3]]);
}

using Key = std::tuple<double, double, double>;
Key key_of(const glm::dvec3& p) {
    return {p.x, p.y, p.z};
}

TEST(Buildings, FeetLieOnTheGroundEverywhereAlongEveryWall) {
    const data::HeightGrid grid = rough_grid();
    const Buildings buildings = build(random_blocks(60, 1), &grid);
    size_t checked = 0;
    for (const lod::RigidPart& part : buildings.parts) {
        for (size_t triangle = 0; triangle < part.indices.size() / 3; ++triangle) {
            for (size_t k = 0; k < 3; ++k) {
                const lod::Vertex& from = part.vertices[part.indices[3 * triangle + k]];
                const lod::Vertex& to = part.vertices[part.indices[3 * triangle + (k + 1) % 3]];
                if (material_of(from) != lod::Material::kWallFoot) continue;
                if (material_of(to) != lod::Material::kWallFoot) continue;
                for (double t = 0.0; t <= 1.0; t += 0.125) {
                    const glm::dvec3 at = glm::mix(position_of(from), position_of(to), t);
                    ASSERT_NEAR(at.z, brute_force_height(grid, at.x, at.y), 1e-6);
                    ++checked;
                }
            }
        }
    }
    EXPECT_GT(checked, 10000u);
    EXPECT_EQ(buildings.off_terrain, 0u);
}

TEST(Buildings, WallsAndRoofCloseButForTheFoot) {
    const data::HeightGrid grid = rough_grid();
    data::Footprints footprints = random_blocks(40, 2);
    for (size_t i = 0; i < footprints.buildings.size(); i += 4)
        footprints.buildings[i].min_height_m = 3.0;
    const Buildings buildings = build(footprints, &grid);
    std::map<std::pair<Key, Key>, int> edges;  // directed, minus one for each opposite
    std::set<Key> feet;
    for (const lod::RigidPart& part : buildings.parts) {
        for (const lod::Vertex& vertex : part.vertices) {
            if (material_of(vertex) == lod::Material::kWallFoot) feet.insert(key_of(position_of(vertex)));
        }
        for (size_t triangle = 0; triangle < part.indices.size() / 3; ++triangle) {
            for (size_t k = 0; k < 3; ++k) {
                const Key a = key_of(corner(part, triangle, k)), b = key_of(corner(part, triangle, k + 1));
                if (a < b) {
                    ++edges[{a, b}];
                } else {
                    --edges[{b, a}];
                }
            }
        }
    }
    size_t open = 0;
    for (const auto& [edge, balance] : edges) {
        if (balance == 0) continue;
        ++open;
        ASSERT_TRUE(feet.contains(edge.first) && feet.contains(edge.second)) << "open away from the foot";
    }
    EXPECT_EQ(open, feet.size()) << "the open edges are the rings of feet";
}

TEST(Buildings, EnclosesTheFootprintsVolumeWithNormalsOutside) {
    const data::HeightGrid grid =
        data::make_planar_grid(kSamples, kSamples, kSpacing, std::vector<float>(kSamples * kSamples, 100.0f));
    for (const bool has_courtyard : {false, true}) {
        for (const double min_height : {0.0, 4.0}) {
            data::Footprints footprints;
            footprints.buildings.push_back(block({320, 320}, {20, 10}, 0.3, has_courtyard));
            footprints.buildings[0].min_height_m = min_height;
            const Buildings buildings = build(footprints, &grid);
            ASSERT_EQ(buildings.parts.size(), 1u);
            const lod::RigidPart& part = buildings.parts[0];
            double volume = 0.0, wall = 0.0, roof = 0.0;
            for (size_t triangle = 0; triangle < part.indices.size() / 3; ++triangle) {
                const glm::dvec3 low(0.0, 0.0, 100.0);  // in the plane of an open foot
                const glm::dvec3 a = corner(part, triangle, 0) - low, b = corner(part, triangle, 1) - low,
                                 c = corner(part, triangle, 2) - low;
                const glm::dvec3 area = glm::cross(b - a, c - a) / 2.0;
                volume += glm::dot(a, area) / 3.0;
                const lod::Vertex& vertex = part.vertices[part.indices[3 * triangle]];
                EXPECT_GT(glm::dot(glm::normalize(area), glm::dvec3(lod::decode_normal(vertex.surface))),
                          0.999);
                if (material_of(vertex) == lod::Material::kRoof) roof += glm::length(area);
                if (std::abs(area.z) < 1e-6) wall += glm::length(area);
            }
            const double plan = has_courtyard ? 800.0 - 200.0 : 800.0;
            const double girth = has_courtyard ? 120.0 + 60.0 : 120.0;
            EXPECT_NEAR(roof, plan, 1e-6);
            EXPECT_NEAR(wall, girth * (12.0 - min_height), 1e-6);
            EXPECT_NEAR(volume, plan * (12.0 - min_height), 1e-3);
        }
    }
}

TEST(Buildings, RoofStandsOnTheMeanGroundAndClearsTheHighest) {
    std::vector<float> slope;
    for (int row = 0; row < kSamples; ++row) {
        for (int col = 0; col < kSamples; ++col)
            slope.push_back(static_cast<float>(col) * 8.0f);
    }
    const data::HeightGrid grid = data::make_planar_grid(kSamples, kSamples, kSpacing, slope);
    for (const double half : {5.0, 30.0}) {
        data::Footprints footprints;
        footprints.buildings.push_back(block({320, 320}, {half, half}, 0.0, false));
        const Buildings buildings = build(footprints, &grid);
        double top = 0.0;
        for (const lod::Vertex& vertex : buildings.parts[0].vertices)
            top = std::max(top, position_of(vertex).z);
        const double mean = 32.0 * 8.0, highest = mean + half * 0.8;
        EXPECT_NEAR(top, std::max(mean + 12.0, highest + 2.0), 1e-6);
        EXPECT_NEAR(buildings.sites[0].highest_ground_m, highest, 1e-6);
        EXPECT_NEAR(buildings.sites[0].lowest_ground_m, mean - half * 0.8, 1e-6);
    }
}

TEST(Buildings, CountsWhatStandsOffTheTerrainOrOnAVoid) {
    data::HeightGrid grid = rough_grid();
    grid.is_void.assign(grid.height_m.size(), 0);
    grid.is_void[grid.index(32, 32)] = 1;
    data::Footprints footprints;
    footprints.buildings.push_back(block({100, 100}, {5, 5}, 0.0, false));
    footprints.buildings.push_back(block({640, 100}, {5, 5}, 0.0, false));   // over the edge
    footprints.buildings.push_back(block({-4e5, 1e7}, {5, 5}, 0.0, false));  // far away
    footprints.buildings.push_back(block({318, 318}, {5, 5}, 0.0, false));   // on the void
    const Buildings buildings = build(footprints, &grid);
    EXPECT_EQ(buildings.off_terrain, 3u);
    ASSERT_EQ(buildings.sites.size(), 1u);
    EXPECT_EQ(buildings.sites[0].footprint, 0u);
}

TEST(Buildings, StandAtHeightZeroWithoutTerrain) {
    const Buildings planar = build(random_blocks(5, 3), nullptr);
    ASSERT_EQ(planar.sites.size(), 5u);
    for (const BuildingSite& site : planar.sites)
        EXPECT_EQ(site.base_world.z, 0.0);
    data::Footprints one;
    one.buildings.push_back(block({7.42, 43.73}, {1e-4, 1e-4}, 0.0, false));
    const data::WorldFrame earth{.has_datum = true};
    const Buildings round = build_buildings(one, nullptr, earth, {});
    double highest = 0.0;
    for (const lod::Vertex& vertex : round.parts[0].vertices) {
        highest = std::max(highest, earth.site_from_world(position_of(vertex)).height_m);
    }
    EXPECT_NEAR(earth.site_from_world(round.sites[0].base_world).height_m, 0.0, 1e-6);
    EXPECT_NEAR(highest, 12.0, 1e-6);
}

TEST(Buildings, CellsAreSmallAndKeepEveryTriangle) {
    const data::HeightGrid grid = rough_grid();
    data::Footprints footprints = random_blocks(2000, 4);
    for (data::Footprint& building : footprints.buildings)
        building = block(building.rings[0][0], {2, 2}, 0, false);
    const Buildings whole = build(footprints, &grid, 1u << 30), cells = build(footprints, &grid, 500);
    ASSERT_EQ(whole.parts.size(), 1u);
    size_t indices = 0;
    double area = 0.0;
    for (const lod::RigidPart& part : cells.parts) {
        EXPECT_LE(part.indices.size(), 3 * 500u);
        indices += part.indices.size();
        glm::dvec3 low = position_of(part.vertices[0]), high = low;
        for (const lod::Vertex& vertex : part.vertices) {
            low = glm::min(low, position_of(vertex));
            high = glm::max(high, position_of(vertex));
        }
        area += (high.x - low.x) * (high.y - low.y);
    }
    EXPECT_EQ(indices, whole.parts[0].indices.size());
    EXPECT_LT(area, 4.0 * 600.0 * 600.0) << "boxes of cells cover the site a few times over";
}

TEST(Buildings, ColoursVaryButNotFromRunToRun) {
    const data::HeightGrid grid = rough_grid();
    const data::Footprints footprints = random_blocks(100, 5);
    const Buildings a = build(footprints, &grid), b = build(footprints, &grid);
    std::set<std::tuple<int, int, int>> roofs;
    ASSERT_EQ(a.parts.size(), b.parts.size());
    for (size_t part = 0; part < a.parts.size(); ++part) {
        for (size_t i = 0; i < a.parts[part].vertices.size(); ++i) {
            const lod::Vertex &left = a.parts[part].vertices[i], &right = b.parts[part].vertices[i];
            ASSERT_TRUE(std::equal(left.colour, left.colour + 4, right.colour));
            if (material_of(left) != lod::Material::kRoof) continue;
            roofs.insert({left.colour[0], left.colour[1], left.colour[2]});
        }
    }
    EXPECT_GT(roofs.size(), 30u);
}

TEST(Hilbert, ConsecutiveCellsShareAnEdge) {
    constexpr uint16_t kSide = 64;  // the first quarters of the quarters … fill this corner first
    std::map<uint32_t, std::pair<int, int>> cells;
    for (uint16_t y = 0; y < kSide; ++y) {
        for (uint16_t x = 0; x < kSide; ++x)
            cells[hilbert_index(x, y)] = {x, y};
    }
    ASSERT_EQ(cells.size(), size_t{kSide} * kSide);
    EXPECT_EQ(cells.rbegin()->first, uint32_t{kSide} * kSide - 1);
    std::pair<int, int> last = cells.begin()->second;
    EXPECT_EQ(last, std::make_pair(0, 0));
    for (auto cell = std::next(cells.begin()); cell != cells.end(); ++cell) {
        EXPECT_EQ(std::abs(cell->second.first - last.first) + std::abs(cell->second.second - last.second), 1);
        last = cell->second;
    }
}

}  // namespace
}  // namespace objects
