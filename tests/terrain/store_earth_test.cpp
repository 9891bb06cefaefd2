// Stores of rasters far too large to be held: what is level takes no room, facts are bounds as on a dense store, and the
// whole Earth at an arc second is drawn in its farthest corner as anywhere.
#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>

#include "lod/scheduler.h"
#include "terrain/roam_front.h"
#include "terrain/store/coarse_ground.h"
#include "terrain/store/sparse_builder.h"
#include "tests/terrain/conformity.h"
#include "tests/terrain/store_kit.h"

namespace {

using terrain::GridPoint;
using terrain::SparseRelief;
using terrain_test::DrawnTriangle;
using test::CutFolder;

terrain::ReliefPatch patch_of(GridPoint first, int width, int height, double relief_m, uint64_t seed) {
    return {first, width, height, terrain_test::fractal_grid(width, height, 30.0, relief_m, seed).height_m};
}

/// The same heights, held.
data::HeightGrid dense_twin(const SparseRelief& relief) {
    data::HeightGrid grid =
        terrain_test::fractal_grid(relief.domain.width, relief.domain.height, 30.0, 0.0, 1);
    grid.frame = relief.frame;
    for (int y = 0; y < grid.height; ++y) {
        for (int x = 0; x < grid.width; ++x)
            grid.height_m[grid.index(x, y)] = relief.height_at({x, y});
    }
    const auto [least, most] = std::minmax_element(grid.height_m.begin(), grid.height_m.end());
    grid.min_m = *least;
    grid.max_m = *most;
    return grid;
}

data::GroundFrame geographic_frame(double west, double north, int width, int height) {
    const double cell = 1.0 / 3600.0;
    const std::array<double, 6> place = {west - 0.5 * cell, cell, 0.0, north + 0.5 * cell, 0.0, -cell};
    return *data::GroundFrame::make(place, "EPSG:4326", width, height);
}

/// Two hills on a plain, one of them in the last corner.
SparseRelief two_hills() {
    SparseRelief relief{terrain::make_domain(1300, 900), geographic_frame(8.0, 46.0, 1300, 900), 12.0f, {}};
    relief.patches.push_back(patch_of({120, 40}, 90, 70, 800.0, 3));
    relief.patches.push_back(patch_of({1300 - 65, 900 - 80}, 65, 80, 500.0, 4));
    return relief;
}

TEST(SparseStore, LacksWhatIsLevelAndBoundsTheRest) {
    const CutFolder folder;
    const SparseRelief relief = two_hills();
    const auto built = terrain::build_sparse_store(relief, folder.file("a.hts"), 2, nullptr);
    ASSERT_TRUE(built) << built.message();
    const auto store = terrain::StoreFile::open(folder.file("a.hts"));
    ASSERT_TRUE(store) << store.message();
    EXPECT_LT(store->directory().count(), store->layout().page_count() / 2);
    const auto sparse = store->map_table();
    ASSERT_TRUE(sparse) << sparse.message();

    const terrain::DiamondTable dense = terrain::make_diamond_table(dense_twin(relief), 2);
    EXPECT_EQ(store->header().min_m, dense.min_m);
    EXPECT_EQ(store->header().max_m, dense.max_m);
    size_t looser = 0, count = 0;
    for (size_t page = 0; page < dense.layout.page_count(); ++page) {
        const terrain::PageId id = dense.layout.id(page);
        terrain::for_each_diamond(dense.domain, id, [&](GridPoint centre, int level) {
            const terrain::DiamondSource &s = sparse->at(centre, level), &d = dense.at(centre, level);
            ASSERT_EQ(s.height_m, d.height_m) << centre.x << ", " << centre.y << " level " << level;
            ASSERT_GE(s.rise_m(), d.rise_m());
            // The table in memory adds a margin for single precision.
            ASSERT_GE(s.error_m() * 1.001f + 2e-3f, d.error_m())
                << centre.x << ", " << centre.y << " level " << level;
            ++count;
            looser += s.error_m() > d.error_m() * 1.01f + 2e-3f ? 1u : 0u;
        });
    }
    EXPECT_LT(looser, count / 200) << "only where level ground meets relief";
}

TEST(SparseStore, ItsCoarseGroundIsTheRelief) {
    const CutFolder folder;
    const SparseRelief relief = two_hills();
    ASSERT_TRUE(terrain::build_sparse_store(relief, folder.file("a.hts"), 2, nullptr));
    const auto store = terrain::StoreFile::open(folder.file("a.hts"));
    ASSERT_TRUE(store) << store.message();
    for (const int side : {2000, 300}) {
        const auto coarse = terrain::read_coarse_ground(*store, side);
        ASSERT_TRUE(coarse) << coarse.message();
        for (int row = 0; row < coarse->grid.height; ++row) {
            for (int col = 0; col < coarse->grid.width; ++col)
                ASSERT_EQ(coarse->grid.at(col, row),
                          relief.height_at({col * coarse->stride, row * coarse->stride}));
        }
    }
}

/// 1,296,000 x 648,000 samples, an arc second apart; sample (c, r) at 180 W + c", 90 N - r".
constexpr int kEarthWidth = 1'296'000, kEarthHeight = 648'000;
constexpr double kCell_deg = 1.0 / 3600.0;

glm::dvec3 place_on_earth(GridPoint sample, double height_m) {
    glm::dvec3 world(0.0);
    GeographicLib::Geocentric::WGS84().Forward(90.0 - sample.y * kCell_deg, -180.0 + sample.x * kCell_deg,
                                               height_m, world.x, world.y, world.z);
    return world;
}

struct EarthRig {
    explicit EarthRig(const terrain::ReliefPatch& hill)
        : relief{terrain::make_domain(kEarthWidth, kEarthHeight),
                 geographic_frame(-180.0, 90.0, kEarthWidth, kEarthHeight),
                 0.0f,
                 {hill}} {}

    void build() {
        const auto built = terrain::build_sparse_store(relief, folder.file("earth.hts"), 2, nullptr);
        ASSERT_TRUE(built) << built.message();
        file_bytes = built->file_bytes;
        auto store = terrain::StoreFile::open(folder.file("earth.hts"));
        ASSERT_TRUE(store) << store.message();
        auto paged =
            open_paged_table(std::move(*store), {.memory_bytes = 48u << 20, .want_px = 0.5, .waits = true});
        ASSERT_TRUE(paged) << paged.message();
        front = std::make_unique<terrain::RoamFront>(
            std::move(paged->table), terrain::RoamOptions{.tolerance_px = 1.0}, std::move(paged->loader));
    }

    /// Above a sample, looking along `heading_rad` and a little down.
    lod::View view_over(GridPoint sample, double height_m, double heading_rad) const {
        lod::View view;
        view.eye_world = place_on_earth(sample, height_m);
        view.eye_from_world = lod::eye_from_attitude(relief.frame.world().world_from_enu(view.eye_world),
                                                     heading_rad, -0.4, 0.0);
        view.fov_y_rad = 1.0;
        view.width_px = 640;
        view.height_px = 360;
        return view;
    }

    CutFolder folder;
    SparseRelief relief;
    uint64_t file_bytes = 0;
    std::unique_ptr<terrain::RoamFront> front;
};

/// Largest distance, in pixels and beyond what the drawn chords may sink, between a hill's samples in view and the surface drawn over
/// them: heights by barycentric weights on the grid.
double worst_error_px(const SparseRelief& relief, const lod::View& view,
                      const std::vector<DrawnTriangle>& triangles) {
    const terrain::ReliefPatch& hill = relief.patches.front();
    const lod::ViewMetric metric = lod::metric_of(view);
    const auto height_of = [&](const DrawnTriangle& t, size_t i) {
        double lat = 0.0, lon = 0.0, height = 0.0;
        GeographicLib::Geocentric::WGS84().Reverse(t.world[i].x, t.world[i].y, t.world[i].z, lat, lon,
                                                   height);
        return height;
    };
    double worst_px = 0.0;
    for (const DrawnTriangle& t : triangles) {
        const auto& s = t.samples;
        const double area = double(terrain::drawn::area_of(t));
        if (area <= 0.0) continue;
        const double h[3] = {height_of(t, 0), height_of(t, 1), height_of(t, 2)};
        const int left = std::max(std::min({s[0].x, s[1].x, s[2].x}), hill.first.x);
        const int right = std::min(std::max({s[0].x, s[1].x, s[2].x}), hill.first.x + hill.width - 1);
        const int top = std::max(std::min({s[0].y, s[1].y, s[2].y}), hill.first.y);
        const int bottom = std::min(std::max({s[0].y, s[1].y, s[2].y}), hill.first.y + hill.height - 1);
        for (int y = top; y <= bottom; ++y) {
            for (int x = left; x <= right; ++x) {
                const GridPoint p{x, y};
                const double u = double(terrain::drawn::area_of(DrawnTriangle{{}, {p, s[1], s[2]}})) / area;
                const double v = double(terrain::drawn::area_of(DrawnTriangle{{}, {s[0], p, s[2]}})) / area;
                if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
                const glm::dvec3 at = place_on_earth(p, double(hill.at(p)));
                const glm::dvec3 eye = metric.eye_from_world * (at - view.eye_world);
                if (-eye.z < 1.0 || std::abs(eye.x) > -eye.z * metric.tan_x ||
                    std::abs(eye.y) > -eye.z * metric.tan_y)
                    continue;
                const double off_m =
                    std::abs(u * h[0] + v * h[1] + (1.0 - u - v) * h[2] - double(hill.at(p)));
                worst_px = std::max(worst_px, off_m * metric.lambda_px / glm::length(eye));
            }
        }
    }
    return worst_px;
}

/// What a flight is judged by.
struct Flight {
    int frames = 0;
    uint64_t operations = UINT64_MAX;  ///< a frame; without a limit the tolerance of a pixel is reached
    size_t least_on_hill = 1000;       ///< vertices, in all frames
};

/// Flies over a hill at 300 m/s and looks at every frame.
void fly_over(EarthRig& rig, const Flight& flight) {
    const terrain::ReliefPatch& hill = rig.relief.patches.front();
    const GridPoint middle{hill.first.x + hill.width / 2, hill.first.y + hill.height / 2};
    lod::Front* fronts[] = {rig.front.get()};
    double worst_px = 0.0;
    size_t on_hill = 0;
    for (int frame = 0; frame < flight.frames; ++frame) {
        SCOPED_TRACE("frame " + std::to_string(frame));
        lod::View view = rig.view_over(middle, 2500.0, 0.1 * frame);
        view.eye_world +=
            glm::transpose(view.eye_from_world)[2] * (300.0 * (frame - flight.frames / 2) / 15.0);
        rig.front->begin_frame({&view, 1}, frame / 15.0);
        lod::schedule(fronts, {.tolerance_px = 1.0}, lod::operation_limit(flight.operations));
        ASSERT_EQ(rig.front->validate(), "");
        if (flight.operations == UINT64_MAX) {
            EXPECT_LE(rig.front->error_px(), 1.0 + 1e-6);
        }
        terrain_test::PoolTwin pool;
        const auto triangles = terrain_test::emit_triangles(*rig.front, view, pool);
        for (const DrawnTriangle& t : triangles) {
            for (size_t i = 0; i < 3; ++i) {
                const double height_m = double(rig.relief.height_at(t.samples[i]));
                ASSERT_LT(glm::distance(t.world[i], place_on_earth(t.samples[i], height_m)), 1e-6);
                on_hill += hill.contains(t.samples[i]) ? 1u : 0u;
            }
        }
        ASSERT_EQ(terrain_test::conformity_fault(triangles), "");
        worst_px = std::max(worst_px, worst_error_px(rig.relief, view, triangles));
    }
    EXPECT_GT(on_hill, flight.least_on_hill) << "the hill should be seen";
    EXPECT_GT(worst_px, 0.1);
    if (flight.operations == UINT64_MAX) {
        EXPECT_LE(worst_px, 1.0);
    }
}

/// Every triangle of the Earth: the mesh has no hole anywhere.
void expect_whole(EarthRig& rig) {
    lod::View all = rig.view_over({kEarthWidth / 2, kEarthHeight / 2}, 4e7, 0.0);
    all.eye_from_world = lod::look_at(all.eye_world, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, all).eye_from_world;
    terrain_test::PoolTwin pool;
    rig.front->begin_frame({&all, 1}, 1000.0);
    const auto triangles = terrain_test::emit_triangles(*rig.front, all, pool);
    EXPECT_EQ(terrain_test::conformity_fault(triangles), "");
    EXPECT_EQ(terrain_test::area_of(triangles), 2 * int64_t{kEarthWidth - 1} * (kEarthHeight - 1));
}

/// Columns far to the east, rows far to the south: near 180 E, 60 S.
TEST(SparseStore, TheWholeEarthIsAsGoodFarFromItsFirstSample) {
    EarthRig rig(patch_of({kEarthWidth - 300, 540'000}, 300, 260, 900.0, 7));
    rig.build();
    if (HasFatalFailure()) return;
    EXPECT_LT(rig.file_bytes, 60u << 20);
    fly_over(rig, {12});
    if (!HasFatalFailure()) expect_whole(rig);
}

/// 89.9 S, where columns are 5 cm apart. Bounds take cells to be as wide as the widest, so mesh and tolerance never meet there.
TEST(SparseStore, TheWholeEarthHasALastSample) {
    EarthRig rig(patch_of({kEarthWidth - 300, kEarthHeight - 260}, 300, 260, 900.0, 9));
    rig.build();
    if (HasFatalFailure()) return;
    fly_over(rig, {8, 5'000, 0});
    if (!HasFatalFailure()) expect_whole(rig);
}

TEST(PageLayout, IdsOfTheWholeEarthAreUnique) {
    const terrain::Domain domain = terrain::make_domain(kEarthWidth, kEarthHeight);
    const terrain::PageLayout layout(domain);
    EXPECT_GT(layout.page_count(), uint64_t{1} << 28);
    lod::Rng rng(11);
    for (int i = 0; i < 100'000; ++i) {
        const size_t page = rng.below(layout.page_count());
        const terrain::PageId id = layout.id(page);
        ASSERT_EQ(layout.number(id), page);
        ASSERT_EQ(id.key() >> 56, uint64_t(id.group));
        ASSERT_EQ(int(id.key() & 0xfffffff), id.block_x);
        ASSERT_EQ(int(id.key() >> 28 & 0xfffffff), id.block_y);
    }
    const int last = layout.blocks(layout.group_count() - 1) - 1;
    EXPECT_EQ(layout.number({layout.group_count() - 1, last, last}), layout.page_count() - 1);
}

}  // namespace
