// No crack: before a magenta background, no background pixel where the eye must meet ground, over a thousand random
// views of fronts interrupted anywhere.
//
// The drawn surface is continuous over the whole raster and lies between its lowest and highest sample. So a ray
// that starts above the drawn surface and sinks below the lowest sample while still over the raster has crossed it,
// whatever the level of detail: its pixel must be covered.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "data/ground_height.h"
#include "lod/base/rng.h"
#include "lod/scheduler.h"
#include "render/renderer.h"
#include "terrain/roam_front.h"
#include "tests/terrain/vertical_probe.h"

namespace {

constexpr int kWidth_px = 160, kHeight_px = 90;
constexpr uint64_t kMostTriangles = 20000;
constexpr double kChordSag_m =
    100.0;  // triangles of 50 km sink by L^2 / (8 R) = 49 m below the curved ground
constexpr double kMargin_cells = 3.0;

struct Terrain {
    Terrain(data::HeightGrid heights, double glide_s)
        : grid(std::move(heights)),
          front(terrain::make_diamond_table(grid, 2),
                {.tolerance_px = 1.0, .reserve_triangles = 3 * kMostTriangles, .glide_s = glide_s}) {}
    data::HeightGrid grid;
    terrain::RoamFront front;
    terrain_test::PoolTwin pool;
    double time_s = 0.0;
};

glm::dvec3 up_at(const Terrain& terrain, const glm::dvec3& world) {
    return terrain.grid.frame.world().world_from_enu(world)[2];
}

/// Anywhere over the raster, near the ground or far above, looking anywhere.
lod::View random_view(const Terrain& terrain, lod::Rng& rng) {
    const data::HeightGrid& grid = terrain.grid;
    const double col = rng.between(0.05, 0.95) * (grid.width - 1);
    const double row = rng.between(0.05, 0.95) * (grid.height - 1);
    const double above_m = std::exp(rng.between(std::log(2.0), std::log(9000.0)));
    lod::View view;
    view.eye_world =
        grid.frame.world_from_grid(col, row, data::ground_height(grid, col, row).height_m + above_m);
    view.eye_from_world =
        lod::eye_from_attitude(grid.frame.world().world_from_enu(view.eye_world), rng.between(0.0, 6.2832),
                               rng.between(-1.5708, 0.2), rng.between(-3.1416, 3.1416));
    view.fov_y_rad = rng.between(0.2, 1.8);
    view.width_px = kWidth_px;
    view.height_px = kHeight_px;
    return view;
}

/// Stops refinement anywhere: often early, sometimes at a triangle limit, now and then never. Comes to the view in
/// a few short steps, so that vertices glide when it is drawn.
void adapt(Terrain& terrain, const lod::View& view, lod::Rng& rng) {
    lod::Front* fronts[] = {&terrain.front};
    lod::Budget budget;
    budget.tolerance_px = std::exp2(rng.between(-3.0, 3.0));
    budget.max_triangles = rng.unit() < 0.5 ? kMostTriangles : 2 + rng.below(kMostTriangles);
    const glm::dvec3 step = glm::dvec3(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1)) *
                            std::exp(rng.between(0.0, 5.0));
    for (int before = 3; before >= 0; --before) {
        lod::View there = view;
        there.eye_world += step * double(before);
        terrain.time_s += rng.between(0.01, 0.2);
        const auto operations = static_cast<uint64_t>(std::exp2(rng.between(0.0, 14.5))) - 1;
        terrain.front.begin_frame({&there, 1}, terrain.time_s);
        lod::schedule(fronts, budget, lod::operation_limit(operations));
    }
}

/// Triangles and writes of a view; `list` keeps what a renderer needs.
std::vector<terrain_test::DrawnTriangle> emit(Terrain& terrain, const lod::View& view, lod::DrawList& list) {
    list.items.clear();
    list.instances.clear();
    terrain.front.emit(view, list);
    terrain.pool.apply(list);
    return terrain_test::drawn_triangles(terrain.pool, list, lod::Module::kTerrain);
}

/// Lifts the eye above the drawn surface, which may be far above the true one when few operations were granted.
void lift_eye(Terrain& terrain, lod::View& view, lod::DrawList& list) {
    const glm::dvec3 up = up_at(terrain, view.eye_world);
    lod::View down = lod::look_at(view.eye_world + up * 20000.0, view.eye_world, {0.0, 0.0, 1.0}, view);
    down.fov_y_rad = 0.001;
    const auto below = emit(terrain, down, list);
    const glm::dvec2 at =
        terrain.grid.frame.grid_from_site(terrain.grid.frame.world().site_from_world(view.eye_world));
    const terrain_test::VerticalProbe probe(terrain.grid.width, terrain.grid.height,
                                            terrain.grid.frame.cell_m().x, below);
    const auto hit = probe.probe(static_cast<int>(at.x), static_cast<int>(at.y), view.eye_world, up);
    ASSERT_TRUE(hit.found) << "no surface below the eye";
    if (hit.above_m > -2.0) view.eye_world += up * (hit.above_m + 2.0);
}

/// Whether the pixel's ray sinks below the lowest ground while it is over the raster.
bool must_meet_ground(const Terrain& terrain, const lod::View& view, const glm::dvec3& up, int x, int y) {
    const double tan_y = std::tan(view.fov_y_rad / 2.0);
    const glm::dvec3 ray_eye((x + 0.5 - kWidth_px / 2.0) * 2.0 * tan_y / kHeight_px,
                             (kHeight_px / 2.0 - y - 0.5) * 2.0 * tan_y / kHeight_px, -1.0);
    const glm::dvec3 ray = glm::normalize(glm::transpose(view.eye_from_world) * ray_eye);
    if (glm::dot(ray, up) >= 0.0) return false;
    // The ellipsoid that lies at the lowest height.
    const double low_m = static_cast<double>(terrain.grid.min_m) - kChordSag_m;
    const glm::dvec3 axes(6378137.0 + low_m, 6378137.0 + low_m, 6356752.314245 + low_m);
    const glm::dvec3 o = view.eye_world / axes, d = ray / axes;
    const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1.0;
    const double root = b * b - a * c;
    if (root < 0.0) return false;  // passes above the horizon
    const glm::dvec3 bottom = view.eye_world + ray * ((-b - std::sqrt(root)) / a);
    const data::GroundFrame& frame = terrain.grid.frame;
    const glm::dvec2 at = frame.grid_from_site(frame.world().site_from_world(bottom));
    return at.x > kMargin_cells && at.y > kMargin_cells && at.x < terrain.grid.width - 1 - kMargin_cells &&
           at.y < terrain.grid.height - 1 - kMargin_cells;
}

struct Tally {
    uint64_t covered = 0, background = 0, cracks = 0;
};

/// @returns pixels of one picture
Tally count_cracks(const Terrain& terrain, const lod::View& view, const render::ColourImage& image) {
    const glm::dvec3 up = up_at(terrain, view.eye_world);
    Tally tally;
    for (int y = 0; y < kHeight_px; ++y) {
        for (int x = 0; x < kWidth_px; ++x) {
            const uint8_t* rgba = &image.rgba[4 * static_cast<size_t>(y * kWidth_px + x)];
            if (rgba[0] != 255 || rgba[1] != 0 || rgba[2] != 255) {
                ++tally.covered;
                continue;
            }
            ++tally.background;
            if (must_meet_ground(terrain, view, up, x, y)) ++tally.cracks;
        }
    }
    return tally;
}

struct Trial {
    int views = 0;
    uint64_t seed = 0;
    double glide_s = 0.0;
};

void expect_no_cracks(const std::string& path, const Trial& trial) {
    auto grid = data::read_height_grid({path}, {});
    ASSERT_TRUE(grid) << grid.message();
    Terrain terrain(std::move(*grid), trial.glide_s);
    lod::PoolRegion region = terrain.front.pool_need();
    region.index_capacity *= 2;  // the view and what lies below its eye
    terrain.front.place(region);

    render::RendererOptions options;
    options.width_px = kWidth_px;
    options.height_px = kHeight_px;
    options.pool = {region.vertex_capacity, region.index_capacity, 16};
    auto renderer = render::Renderer::create(options);
    if (!renderer) GTEST_SKIP() << renderer.message();
    render::Atmosphere vacuum;
    vacuum.visibility_m = 1e15;
    vacuum.draw_sky = false;

    lod::Rng rng(trial.seed);
    double largest_glide_px = 0.0;
    Tally sum;
    for (int i = 0; i < trial.views; ++i) {
        SCOPED_TRACE("view " + std::to_string(i));
        lod::View view = random_view(terrain, rng);
        adapt(terrain, view, rng);
        lod::DrawList list;
        lift_eye(terrain, view, list);
        if (testing::Test::HasFatalFailure()) return;
        list.index_writes.clear();  // of the look straight down; its vertices are news for both
        emit(terrain, view, list);
        vacuum.up_world = up_at(terrain, view.eye_world);
        renderer->draw(view, list, vacuum);
        largest_glide_px = std::max(largest_glide_px, terrain.front.jump_px());
        const Tally tally = count_cracks(terrain, view, renderer->read_colour());
        EXPECT_EQ(tally.cracks, 0u) << "with " << terrain.front.triangles() << " triangles";
        sum.covered += tally.covered;
        sum.background += tally.background;
        sum.cracks += tally.cracks;
    }
    std::printf("%d views: %llu pixels of ground, %llu of background, %llu cracks\n", trial.views,
                static_cast<unsigned long long>(sum.covered), static_cast<unsigned long long>(sum.background),
                static_cast<unsigned long long>(sum.cracks));
    EXPECT_GT(largest_glide_px, 0.0) << "something should move";
    EXPECT_GT(sum.covered, sum.background / 2) << "the views should see ground";
    EXPECT_GT(sum.background, sum.covered / 100) << "the background should show where there is no ground";
}

const std::string kJacksboro = std::string(HARRIER_SOURCE_DIR) + "/data/samples/jacksboro.tif";
const std::string kBigTujunga =
    std::string(HARRIER_SOURCE_DIR) + "/../shared/data/terrain/srtm_bigtujunga30m_utm11.tif";

TEST(Cracks, NoneOverJacksboro) {
    expect_no_cracks(kJacksboro, {900, 21, 0.0});
}
TEST(Cracks, NoneWhileVerticesGlide) {
    expect_no_cracks(kJacksboro, {900, 23, 0.4});
}

TEST(Cracks, NoneOverBigTujunga) {
    if (!std::ifstream(kBigTujunga)) GTEST_SKIP() << kBigTujunga << " is not on this machine";
    expect_no_cracks(kBigTujunga, {900, 22, 0.0});
}
TEST(Cracks, NoneOverBigTujungaWhileVerticesGlide) {
    if (!std::ifstream(kBigTujunga)) GTEST_SKIP() << kBigTujunga << " is not on this machine";
    expect_no_cracks(kBigTujunga, {900, 24, 0.4});
}

}  // namespace
