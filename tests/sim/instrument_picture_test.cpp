// The meter of 86,802 triangles at 5,381 and back: at the distance where that is one pixel of error, both look the same.
#include <gtest/gtest.h>

#include <cmath>

#include "data/generated_meter.h"
#include "lod/scheduler.h"
#include "sim/adaptive_models.h"
#include "sim/mesh_model.h"
#include "tests/sim/seen_difference.h"

namespace {

constexpr uint64_t kFull = 86'802, kFew = 5'381;
constexpr int kSide_px = 160, kFactor = 4;

/// A square out of the middle of a picture of 1280 x 720 over 60 degrees, straight before the dial.
/// @param factor  times as many pixels over the same angle
lod::View view_from(double away_m, int factor) {
    const double lambda_px = 360.0 / std::tan(0.5 * 60.0 * 3.14159265358979323846 / 180.0);
    lod::View optics;
    optics.width_px = optics.height_px = kSide_px * factor;
    optics.fov_y_rad = 2.0 * std::atan(0.5 * kSide_px / lambda_px);
    optics.near_m = 0.01;
    return lod::look_at({0.0, -away_m, 0.0}, {0.0, 0.0, -0.007}, {0.0, 0.0, 1.0}, optics);
}

/// The meter, standing in the world's origin, and a way to draw it.
class Meter {
  public:
    static lod::ProgressiveModel model() {
        auto built = sim::build_model(data::generate_meter(kFull), {}, 2);
        EXPECT_TRUE(built) << built.message();
        return std::move(*built);
    }
    explicit Meter(const lod::ProgressiveModel& model) {
        sim::AdaptiveModels models;
        models.learn("meter", model);
        lod::BodyPose pose;
        pose.frame = lod::BodyPose::Frame::kPlaced;
        EXPECT_TRUE(models.add("meter", pose, {}));
        sim::AdaptiveRig rig;
        front_ = models.make_front(lod::Module::kInstruments, {}, rig);
        front_->place(front_->pool_need());
    }
    lod::MeshFront& front() { return *front_; }

    void adapt(double away_m, double tolerance_px, uint64_t most_triangles) {
        lod::Front* fronts[] = {front_.get()};
        lod::Budget budget;
        budget.tolerance_px = tolerance_px;
        budget.max_triangles = most_triangles;
        const lod::View view = view_from(away_m, 1);
        front_->begin_frame({&view, 1}, 0.0);
        lod::schedule(fronts, budget, lod::operation_limit(200'000));
    }
    render::ColourImage draw(double away_m, render::Renderer& renderer) {
        const lod::View view = view_from(away_m, kFactor);
        list_.clear();
        front_->emit(view, list_);
        render::Atmosphere air;
        air.sun_world = glm::normalize(glm::dvec3(-0.5, -0.6, 0.6));
        renderer.draw(view, list_, air);
        renderer.finish();
        return renderer.read_colour();
    }

  private:
    std::unique_ptr<lod::MeshFront> front_;
    lod::DrawList list_;
};

/// Where the most triangles that may be drawn come to one pixel of error.
double distance_of_a_pixel(const lod::ProgressiveModel& model, uint64_t triangles) {
    Meter meter(model);
    double near_m = 0.5, far_m = 8.0;  // from where all of it is in the picture
    while (far_m - near_m > 0.005) {
        const double middle_m = 0.5 * (near_m + far_m);
        meter.adapt(middle_m, 1.0, UINT64_MAX);
        meter.adapt(middle_m, 1e-3, triangles);
        (meter.front().error_px() > 1.0 ? near_m : far_m) = middle_m;
    }
    return far_m;
}

std::vector<bool> pixels_drawn(const render::DepthImage& depth) {
    std::vector<bool> is_drawn;
    for (int y = 0; y < depth.height; y += kFactor) {
        for (int x = 0; x < depth.width; x += kFactor)
            is_drawn.push_back(std::isfinite(depth.depth_m[static_cast<size_t>(y * depth.width + x)]));
    }
    return is_drawn;
}

TEST(InstrumentPicture, WhereFewTrianglesAreAPixelOffNobodySeesIt) {
    const lod::ProgressiveModel model = Meter::model();
    Meter meter(model);
    const lod::PoolRegion need = meter.front().pool_need();
    render::RendererOptions options;
    options.width_px = options.height_px = kSide_px * kFactor;
    options.pool = {need.vertex_capacity, need.index_capacity, 64};
    auto renderer = render::Renderer::create(options);
    if (!renderer) GTEST_SKIP() << renderer.message();

    const double away_m = distance_of_a_pixel(model, kFew);
    meter.adapt(away_m, 0.0, UINT64_MAX);
    EXPECT_EQ(meter.front().triangles(), kFull);
    const render::ColourImage full = meter.draw(away_m, *renderer);
    const std::vector<bool> is_drawn = pixels_drawn(renderer->read_depth());

    meter.adapt(away_m, 1e-3, kFew);
    EXPECT_LE(meter.front().triangles(), kFew);
    EXPECT_GE(meter.front().triangles(), kFew - 1) << "operations come in twos but at borders";
    EXPECT_LE(meter.front().error_px(), 1.0);
    const render::ColourImage few = meter.draw(away_m, *renderer);
    const sim_test::SeenDifference seen = sim_test::seen_difference(full, few, kFactor, is_drawn);
    RecordProperty("away_m", std::to_string(away_m));
    RecordProperty("mean", std::to_string(seen.mean));
    RecordProperty("largest", std::to_string(seen.largest));
    RecordProperty("noticeable_share", std::to_string(seen.noticeable_share));
    EXPECT_GT(seen.pixels, 500u);
    EXPECT_LT(seen.mean, 0.5 * sim_test::kJustNoticeable);
    EXPECT_LT(seen.noticeable_share, 0.05);

    meter.adapt(away_m, 0.0, UINT64_MAX);
    EXPECT_EQ(meter.front().triangles(), kFull);
    EXPECT_EQ(meter.draw(away_m, *renderer).rgba, full.rgba) << "and back";
}

}  // namespace
