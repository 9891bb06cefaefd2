#include "terrain/store/page_judge.h"

#include <algorithm>

#include "lod/screen_error.h"

namespace terrain {
namespace {

struct Foresight {
    double ahead_s, weight;
};
/// What is needed later yields to what is needed now.
constexpr Foresight kForesights[] = {{0.0, 1.0}, {0.5, 0.9}, {1.0, 0.8}, {2.0, 0.7}};
constexpr double kOutOfView = 0.5;

/// World positions of nine places of a page, at its lowest and its highest height.
struct Outline {
    glm::dvec3 points[18];
    glm::dvec3 middle;
};

Outline outline_of(const data::GroundFrame& frame, const Domain& domain, const PageId& id,
                   const PageSummary& summary) {
    // Diamonds one level up that need the page reach over its rim by two of its own reaches.
    const int reach = domain.reach(2 * id.group), width = 2 * reach * kPageSide;
    const GridPoint first{id.block_x * width - 2 * reach, id.block_y * width - 2 * reach};
    const int step = (width + 4 * reach) / 2;
    Outline outline;
    for (int i = 0; i < 9; ++i) {
        const GridPoint p =
            domain.clamped({std::max(0, first.x + i % 3 * step), std::max(0, first.y + i / 3 * step)});
        outline.points[2 * i] = frame.world_from_sample(p.x, p.y, double(summary.min_m));
        outline.points[2 * i + 1] = frame.world_from_sample(p.x, p.y, double(summary.max_m));
    }
    outline.middle = 0.5 * (outline.points[8] + outline.points[9]);
    return outline;
}

}  // namespace

PageJudge::PageJudge(const StoreFile& store) {
    const Domain domain = store.domain();
    const DiamondTable table = store.make_table();
    anchor_world_ = table.frame.world_from_sample(domain.width / 2, domain.height / 2,
                                                  0.5 * (double(table.min_m) + double(table.max_m)));
    finest_reach_m_ = kPageSide * std::min(table.frame.cell_m().x, table.frame.cell_m().y);
    balls_.resize(store.directory().count());
    for (size_t page = store.directory().level_count(); page < balls_.size(); ++page) {
        const PageSummary& summary = store.header().entries[page];
        const Outline outline = outline_of(table.frame, domain, store.directory().id(page), summary);
        double radius_m = 0.0;
        for (const glm::dvec3& point : outline.points)
            radius_m = std::max(radius_m, glm::distance(point, outline.middle));
        balls_[page] = {glm::vec3(outline.middle - anchor_world_), static_cast<float>(radius_m),
                        decode_length(summary.error_code)};
    }
}

void PageJudge::look(const std::vector<MovingEye>& eyes) {
    gazes_.clear();
    for (const MovingEye& eye : eyes) {
        for (const Foresight& foresight : kForesights) {
            gazes_.push_back({lod::metric_of(eye.view),
                              eye.view.eye_world + eye.velocity_mps * foresight.ahead_s - anchor_world_,
                              foresight.weight});
            if (eye.velocity_mps == glm::dvec3(0.0)) break;
        }
    }
}

float PageJudge::worth_px(size_t page) const {
    const Ball& ball = balls_[page];
    double worst_px = 0.0;
    for (const Gaze& gaze : gazes_) {
        const glm::dvec3 centre = gaze.metric.eye_from_world * (glm::dvec3(ball.centre_m) - gaze.eye);
        const double radius = double(ball.radius_m);
        const double px =
            gaze.weight * lod::screen_error_px(gaze.metric, centre, radius, double(ball.error_m));
        const bool is_seen = lod::distance_outside_m(gaze.metric, centre, radius) <= 0.0;
        worst_px = std::max(worst_px, is_seen ? px : kOutOfView * px);
    }
    return static_cast<float>(worst_px);
}

}  // namespace terrain
