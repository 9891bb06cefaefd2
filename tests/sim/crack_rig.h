// Cracks in pictures: background pixels where the eye must meet ground, over random views of a front that was
// interrupted anywhere.
//
// The drawn surface is continuous over the whole raster and lies between its lowest and highest sample. So a ray
// that starts above the drawn surface and sinks below the lowest sample while still over the raster has crossed it,
// whatever the level of detail: its pixel must be covered.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "data/ground_height.h"
#include "lod/base/rng.h"
#include "lod/scheduler.h"
#include "render/renderer.h"
#include "tests/terrain/vertical_probe.h"

namespace sim_test {

struct CrackTrial {
    int views = 0;
    uint64_t seed = 0;
};

/// Pixels of all pictures.
struct CrackTally {
    uint64_t covered = 0, background = 0, cracks = 0;
    double largest_jump_px = 0.0;  ///< that the front tells of
};

/// Draws one front over one raster.
class CrackRig {
  public:
    static constexpr uint64_t kMostTriangles = 20000;

    /// @param grid, front  must outlive the rig
    CrackRig(const data::HeightGrid& grid, lod::Front& front, render::Renderer renderer)
        : grid_(grid), front_(front), renderer_(std::move(renderer)) {}

    static lod::Result<render::Renderer> make_renderer() {
        render::RendererOptions options;
        options.width_px = kWidth_px;
        options.height_px = kHeight_px;
        options.pool = {1, 3, kCommands};  // until the front is placed
        return render::Renderer::create(options);
    }

    /// One picture of a random view.
    void add_view(lod::Rng& rng, CrackTally& tally) {
        lod::View view = random_view(rng);
        adapt(view, rng);
        lod::DrawList list;
        lift_eye(view, list);
        if (testing::Test::HasFatalFailure()) return;
        emit(view, list);  // after the look straight down, whose writes are news for both
        air_.up_world = up_at(view.eye_world);
        renderer_.draw(view, list, air_);
        tally.largest_jump_px = std::max(tally.largest_jump_px, front_.jump_px());
        count(view, renderer_.read_colour(), tally);
    }

  private:
    static constexpr int kWidth_px = 160, kHeight_px = 90;
    static constexpr uint32_t kCommands = 8192;
    // Triangles of 50 km sink by L^2 / (8 R) = 49 m below the curved ground.
    static constexpr double kChordSag_m = 100.0;
    static constexpr double kMargin_cells = 3.0;

    glm::dvec3 up_at(const glm::dvec3& world) const { return grid_.frame.world().world_from_enu(world)[2]; }

    /// Anywhere over the raster, near the ground or far above, looking anywhere.
    lod::View random_view(lod::Rng& rng) const {
        const double col = rng.between(0.05, 0.95) * (grid_.width - 1);
        const double row = rng.between(0.05, 0.95) * (grid_.height - 1);
        const double above_m = std::exp(rng.between(std::log(2.0), std::log(9000.0)));
        lod::View view;
        view.eye_world =
            grid_.frame.world_from_grid(col, row, data::ground_height(grid_, col, row).height_m + above_m);
        view.eye_from_world = lod::eye_from_attitude(grid_.frame.world().world_from_enu(view.eye_world),
                                                     rng.between(0.0, 6.2832), rng.between(-1.5708, 0.2),
                                                     rng.between(-3.1416, 3.1416));
        view.fov_y_rad = rng.between(0.2, 1.8);
        view.width_px = kWidth_px;
        view.height_px = kHeight_px;
        return view;
    }

    /// A narrow look at what is straight below an eye.
    lod::View down_from(const lod::View& view) const {
        const glm::dvec3 up = up_at(view.eye_world);
        lod::View down = lod::look_at(view.eye_world + up * 20000.0, view.eye_world, {0.0, 0.0, 1.0}, view);
        down.fov_y_rad = 0.001;
        return down;
    }

    /// Stops refinement anywhere: often early, sometimes at a triangle limit, now and then never. Comes to the view in
    /// a few short steps, so that vertices glide when it is drawn.
    void adapt(const lod::View& view, lod::Rng& rng) {
        lod::Front* fronts[] = {&front_};
        lod::Budget budget;
        budget.tolerance_px = std::exp2(rng.between(-3.0, 3.0));
        budget.max_triangles = rng.unit() < 0.5 ? kMostTriangles : 2 + rng.below(kMostTriangles);
        const glm::dvec3 step = glm::dvec3(rng.between(-1, 1), rng.between(-1, 1), rng.between(-1, 1)) *
                                std::exp(rng.between(0.0, 5.0));
        for (int before = 3; before >= 0; --before) {
            lod::View there = view;
            there.eye_world += step * double(before);
            time_s_ += rng.between(0.01, 0.2);
            const auto operations = static_cast<uint64_t>(std::exp2(rng.between(0.0, 14.5))) - 1;
            const lod::View views[] = {there, down_from(there)};
            front_.begin_frame(views, time_s_);
            lod::schedule(fronts, budget, lod::operation_limit(operations));
        }
    }

    /// Triangles and writes of a view; `list` keeps what a renderer needs.
    std::vector<terrain_test::DrawnTriangle> emit(const lod::View& view, lod::DrawList& list) {
        list.items.clear();
        list.instances.clear();
        make_room();
        front_.emit(view, list);
        pool_.apply(list);
        return terrain_test::drawn_triangles(pool_, list, lod::Module::kTerrain);
    }

    /// Lifts the eye above the drawn surface, which may be far above the true one when few operations were granted.
    void lift_eye(lod::View& view, lod::DrawList& list) {
        const glm::dvec3 up = up_at(view.eye_world);
        const auto below = emit(down_from(view), list);
        const glm::dvec2 at = grid_.frame.grid_from_site(grid_.frame.world().site_from_world(view.eye_world));
        const terrain_test::VerticalProbe probe(grid_.width, grid_.height, grid_.frame.cell_m().x, below);
        const auto hit = probe.probe(static_cast<int>(at.x), static_cast<int>(at.y), view.eye_world, up);
        ASSERT_TRUE(hit.found) << "no surface below the eye";
        if (hit.above_m > -2.0) view.eye_world += up * (hit.above_m + 2.0);
    }

    /// Whether the pixel's ray sinks below the lowest ground while it is over the raster.
    bool must_meet_ground(const lod::View& view, const glm::dvec3& up, int x, int y) const {
        const double tan_y = std::tan(view.fov_y_rad / 2.0);
        const glm::dvec3 ray_eye((x + 0.5 - kWidth_px / 2.0) * 2.0 * tan_y / kHeight_px,
                                 (kHeight_px / 2.0 - y - 0.5) * 2.0 * tan_y / kHeight_px, -1.0);
        const glm::dvec3 ray = glm::normalize(glm::transpose(view.eye_from_world) * ray_eye);
        if (glm::dot(ray, up) >= 0.0) return false;
        // The ellipsoid that lies at the lowest height.
        const double low_m = static_cast<double>(grid_.min_m) - kChordSag_m;
        const glm::dvec3 axes(6378137.0 + low_m, 6378137.0 + low_m, 6356752.314245 + low_m);
        const glm::dvec3 o = view.eye_world / axes, d = ray / axes;
        const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1.0;
        const double root = b * b - a * c;
        if (root < 0.0) return false;  // passes above the horizon
        const glm::dvec3 bottom = view.eye_world + ray * ((-b - std::sqrt(root)) / a);
        const data::GroundFrame& frame = grid_.frame;
        const glm::dvec2 at = frame.grid_from_site(frame.world().site_from_world(bottom));
        return at.x > kMargin_cells && at.y > kMargin_cells && at.x < grid_.width - 1 - kMargin_cells &&
               at.y < grid_.height - 1 - kMargin_cells;
    }

    void count(const lod::View& view, const render::ColourImage& image, CrackTally& tally) const {
        const glm::dvec3 up = up_at(view.eye_world);
        for (int y = 0; y < kHeight_px; ++y) {
            for (int x = 0; x < kWidth_px; ++x) {
                const uint8_t* rgba = &image.rgba[4 * static_cast<size_t>(y * kWidth_px + x)];
                if (rgba[0] != 255 || rgba[1] != 0 || rgba[2] != 255) {
                    ++tally.covered;
                    continue;
                }
                ++tally.background;
                if (must_meet_ground(view, up, x, y)) ++tally.cracks;
            }
        }
    }

    /// For the view and what lies below its eye. What is placed anew is written anew.
    void make_room() {
        lod::PoolRegion need = front_.pool_need();
        need.index_capacity *= 2;
        if (need.vertex_capacity <= region_.vertex_capacity && need.index_capacity <= region_.index_capacity)
            return;
        region_ = {0, need.vertex_capacity + need.vertex_capacity / 4, 0,
                   need.index_capacity + need.index_capacity / 4};
        front_.place(region_);
        const auto resized =
            renderer_.resize_pool({region_.vertex_capacity, region_.index_capacity, kCommands});
        ASSERT_TRUE(resized) << resized.message();
    }

    const data::HeightGrid& grid_;
    lod::Front& front_;
    render::Renderer renderer_;
    render::Atmosphere air_ = render::vacuum();
    lod::PoolRegion region_;
    terrain_test::PoolTwin pool_;
    double time_s_ = 0.0;
};

/// Expects that no picture has a crack, and that the pictures could have shown one. Skips where there is no OpenGL.
inline void expect_no_cracks(const data::HeightGrid& grid, lod::Front& front, const CrackTrial& trial,
                             CrackTally& sum) {
    auto renderer = CrackRig::make_renderer();
    if (!renderer) GTEST_SKIP() << renderer.message();
    CrackRig rig(grid, front, std::move(*renderer));
    lod::Rng rng(trial.seed);
    for (int i = 0; i < trial.views; ++i) {
        SCOPED_TRACE("view " + std::to_string(i));
        const uint64_t before = sum.cracks;
        rig.add_view(rng, sum);
        if (testing::Test::HasFatalFailure()) return;
        EXPECT_EQ(sum.cracks, before) << "with " << front.triangles() << " triangles";
    }
    std::printf("%d views: %llu pixels of ground, %llu of background, %llu cracks\n", trial.views,
                static_cast<unsigned long long>(sum.covered), static_cast<unsigned long long>(sum.background),
                static_cast<unsigned long long>(sum.cracks));
    EXPECT_GT(sum.covered, sum.background / 2) << "the views should see ground";
    EXPECT_GT(sum.background, sum.covered / 100) << "the background should show where there is no ground";
}

}  // namespace sim_test
