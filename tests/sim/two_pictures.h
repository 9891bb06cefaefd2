// Two pictures of one timed scene from one eye: every object that is there, whole, and what a front draws within a bound;
// and where they contradict the bound. Judged by the depth buffer alone, nothing of the tree is read.
//
// A bound of e px says: what a pixel of one picture shows, at depth z, the other shows no more than e px away and no
// more than e z / lambda metres farther, unless it hides it behind something nearer. A pixel of which that is not true is
// lost. Something may be wrongly there or missing where it is smaller than e px; then pixels where both pictures agree
// lie no farther than that. A lost pixel far from any such pixel contradicts the bound.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "lod/scheduler.h"
#include "objects/cluster_front.h"
#include "objects/every_object.h"
#include "render/renderer.h"

namespace sim_test {

/// Pixels of one or many pairs of pictures.
struct PictureTally {
    uint64_t covered = 0;    ///< in one picture or the other; what both cover counts twice
    uint64_t differing = 0;  ///< coverage, or depth by more than the bound
    uint64_t lost = 0;
    uint64_t contradicting = 0;
    double largest_bound_px = 0.0;

    void add(const PictureTally& other) {
        covered += other.covered;
        differing += other.differing;
        lost += other.lost;
        contradicting += other.contradicting;
        largest_bound_px = std::max(largest_bound_px, other.largest_bound_px);
    }
};

/// What may pass between two depth pictures of one view under a bound.
class PictureJudge {
  public:
    static constexpr double kRaster_px = 1.0;  ///< a pixel is the surface at its middle

    PictureJudge(const lod::View& view, double bound_px)
        : lambda_px_(lod::metric_of(view).lambda_px), bound_px_(bound_px) {
        const double reach = bound_px + kRaster_px;
        const int steps = static_cast<int>(reach);
        for (int y = -steps; y <= steps; ++y) {
            for (int x = -steps; x <= steps; ++x) {
                if (x * x + y * y <= reach * reach) disc_.push_back({x, y});
            }
        }
    }

    PictureTally judge(const render::DepthImage& a, const render::DepthImage& b) const {
        PictureTally tally;
        tally.largest_bound_px = bound_px_;
        one_way(a, b, tally);
        one_way(b, a, tally);
        return tally;
    }

  private:
    static bool is_covered(float depth_m) { return std::isfinite(depth_m); }
    /// Both are +infinity, or as far as the bound allows.
    bool agree(float a_m, float b_m) const {
        if (!is_covered(a_m) || !is_covered(b_m)) return is_covered(a_m) == is_covered(b_m);
        return std::abs(double(a_m) - double(b_m)) <= slack_m(std::max(a_m, b_m));
    }
    double slack_m(double depth_m) const { return depth_m * (bound_px_ / lambda_px_ + 1e-4); }

    /// Whether anything within reach of a pixel, picture's edges included, satisfies `test`(index).
    template <typename Test>
    bool any_near(const render::DepthImage& image, int x, int y, const Test& test) const {
        for (const auto& [dx, dy] : disc_) {
            const int nx = x + dx, ny = y + dy;
            if (nx < 0 || ny < 0 || nx >= image.width || ny >= image.height) return true;  // may be out there
            if (test(static_cast<size_t>(ny * image.width + nx))) return true;
        }
        return false;
    }

    void one_way(const render::DepthImage& from, const render::DepthImage& to, PictureTally& tally) const {
        for (int y = 0; y < from.height; ++y) {
            for (int x = 0; x < from.width; ++x) {
                const size_t here = static_cast<size_t>(y * from.width + x);
                const float depth_m = from.depth_m[here];
                if (!is_covered(depth_m)) continue;
                ++tally.covered;
                if (agree(depth_m, to.depth_m[here])) continue;
                ++tally.differing;
                const double farthest_m = double(depth_m) + slack_m(depth_m);
                if (any_near(to, x, y, [&](size_t i) { return double(to.depth_m[i]) <= farthest_m; }))
                    continue;
                ++tally.lost;
                if (!any_near(to, x, y, [&](size_t i) { return agree(from.depth_m[i], to.depth_m[i]); }))
                    ++tally.contradicting;
            }
        }
    }

    double lambda_px_, bound_px_;
    std::vector<std::pair<int, int>> disc_;
};

/// Draws a scene both ways.
class TwoPictures {
  public:
    static lod::Result<render::Renderer> make_renderer(const objects::ClusterTree& tree, int width_px,
                                                       int height_px) {
        render::RendererOptions options;
        options.width_px = width_px;
        options.height_px = height_px;
        options.pool = {static_cast<uint32_t>(tree.vertices.size()),
                        static_cast<uint32_t>(tree.indices.size()), 2 * tree.object_count + 64};
        return render::Renderer::create(options);
    }

    TwoPictures(objects::ClusterTree tree, render::Renderer renderer)
        : front_(std::move(tree), {}), every_(front_.tree(), {}), renderer_(std::move(renderer)) {
        front_.place(front_.pool_need());
        every_.place(front_.pool_need());
        air_.draw_sky = false;
        air_.clear_colour = {0.45f, 0.55f, 0.7f};
        air_.sun_world = glm::normalize(glm::dvec3(-0.5, -0.6, 0.6));
    }

    const objects::ClusterTree& tree() const { return front_.tree(); }

    /// Compared `factor` times as large as the view that the bound is of: the finer, the less falls between the middles of
    /// pixels. @param factor  the renderer's size in sizes of the view
    PictureTally compare(const lod::View& view, double time_s, double tolerance_px, int factor) {
        const render::DepthImage drawn = picture(front_, view, time_s, tolerance_px, factor);
        const render::DepthImage full = picture(every_, view, time_s, 0.0, factor);
        lod::View judged = view;
        judged.width_px *= factor;
        judged.height_px *= factor;
        PictureTally tally = PictureJudge(judged, factor * front_.error_px()).judge(full, drawn);
        tally.largest_bound_px /= factor;
        return tally;
    }

    /// Both pictures, `factor` times as large as the view that the bound is of.
    struct Colours {
        render::ColourImage full, drawn;
        std::vector<bool> is_covered;  ///< [pixels of the view] by anything in either picture
        uint64_t full_triangles = 0, drawn_triangles = 0;
    };
    /// @param factor  the renderer's size in sizes of the view
    Colours colours(const lod::View& view, double time_s, double tolerance_px, int factor) {
        Colours out;
        out.is_covered.resize(static_cast<size_t>(view.width_px) * static_cast<size_t>(view.height_px));
        const auto take = [&](lod::Front& front, double within_px) {
            const render::DepthImage depth = picture(front, view, time_s, within_px, factor);
            for (int y = 0; y < depth.height; ++y) {
                for (int x = 0; x < depth.width; ++x) {
                    if (std::isfinite(depth.depth_m[static_cast<size_t>(y * depth.width + x)]))
                        out.is_covered[static_cast<size_t>(y / factor * view.width_px + x / factor)] = true;
                }
            }
            return renderer_.read_colour();
        };
        out.drawn = take(front_, tolerance_px);  // writes what both draw
        out.full = take(every_, 0.0);
        out.full_triangles = every_.emitted_triangles();
        out.drawn_triangles = front_.emitted_triangles();
        return out;
    }

  private:
    render::DepthImage picture(lod::Front& front, const lod::View& view, double time_s, double tolerance_px,
                               int factor) {
        lod::Front* const fronts[] = {&front};
        lod::Budget budget;
        budget.tolerance_px = tolerance_px;
        front.begin_frame({&view, 1}, time_s);
        lod::schedule(fronts, budget, lod::operation_limit(UINT64_MAX));
        lod::View drawn = view;
        drawn.width_px *= factor;
        drawn.height_px *= factor;
        list_.clear();
        front.emit(drawn, list_);
        renderer_.draw(drawn, list_, air_);
        renderer_.finish();
        return renderer_.read_depth();
    }

    objects::ClusterFront front_;
    objects::EveryObject every_;
    render::Renderer renderer_;
    render::Atmosphere air_;
    lod::DrawList list_;
};

}  // namespace sim_test
