#include "lod/progressive/glide_error.h"

#include <algorithm>

namespace lod {
namespace {

constexpr size_t kMostLooks = 128;
constexpr double kUnseen_px = 0.1;  ///< what is farther away is looked at
constexpr int kWithAllOthers = -1;

/// Where a displaced vertex may be, and what its triangles may cover; errors are both the same.
struct FourReaches {
    FourBounds vertex, star;

    void set(int lane, const ProgressiveMesh& mesh, const NodeGlide& glide, float error_m) {
        const NodeBound& around = mesh.bounds[mesh.collapse_of(mesh.hierarchy.parent[glide.node])];
        // Twice its way: a border made straight moves it aside, too.
        vertex.set(lane, {mesh.hierarchy.position[glide.node], 2.0f * glm::length(glide.shown_m), error_m});
        star.set(lane, {around.centre, around.radius_m, error_m});
    }

    /// Displacements fall to 0 towards the edges of the star, so they are seen largest at the vertex, if it is in view.
    Float4 worst_px(std::span<const AnchoredEye> eyes) const {
        Float4 worst{};
        for (const AnchoredEye& eye : eyes) {
            FourSights near, around;
            near.look(eye.lanes, vertex);
            around.look(eye.lanes, star);
            worst = max(worst, near.shown_px > 0.0f ? near.shown_px : around.shown_px);
        }
        return worst;
    }
};

}  // namespace

/// All ways, the farthest sorted to the front.
void GlideError::sort_ways(const MeshCut& cut, std::span<const NodeGlide> glides,
                           std::span<const AnchoredEye> eyes) {
    ways_.clear();
    for (size_t begin = 0; begin < glides.size(); begin += 4) {
        const size_t end = std::min(begin + 4, glides.size());
        FourReaches reaches;
        for (size_t i = begin; i < end; ++i)
            reaches.set(static_cast<int>(i - begin), cut.mesh(), glides[i], glm::length(glides[i].shown_m));
        const Float4 px = reaches.worst_px(eyes);
        for (size_t i = begin; i < end; ++i)
            ways_.push_back({double(px[i - begin]), static_cast<uint32_t>(i)});
    }
    const auto looked_at = static_cast<std::ptrdiff_t>(std::min(ways_.size(), kMostLooks + 1));
    std::partial_sort(ways_.begin(), ways_.begin() + looked_at, ways_.end(), [](const Way& a, const Way& b) {
        return a.px != b.px ? a.px > b.px : a.glide < b.glide;
    });
}

/// Gathers the star of a vertex. Returns the step it may be in: behind its neighbours.
int GlideError::look_around(const MeshCut& cut, const NodeGlides& glides, NodeId node) {
    int step = 0;
    const auto place_m = [&](NodeId corner) {
        glm::dvec3 place(cut.mesh().hierarchy.position[corner]);
        const NodeGlide* glide = glides.find(corner);
        if (glide == nullptr) return place;
        const int step_there = steps_[static_cast<size_t>(glide - glides.all().data())];
        if (step_there == kWithAllOthers) return place;
        step = std::max(step, step_there + 1);
        return place + glm::dvec3(glide->shown_m);
    };
    star_.clear();
    const ProgressiveMesh& mesh = cut.mesh();
    for (CornerId corner : mesh.is_leaf(node) ? mesh.full_star(node) : mesh.star(node)) {
        if (!cut.is_drawn(corner / 3)) continue;
        const auto corners = cut.corners(corner / 3);
        const NodeId from = corners[next_corner(corner) % 3], to = corners[prev_corner(corner) % 3];
        star_.push_back({from, to, place_m(from), place_m(to)});
    }
    return step;
}

/// The vertex joins its step. Returns what that adds to the error; negative when the vertex stays with all others.
double GlideError::step_out_px(const MeshCut& cut, const NodeGlides& glides,
                               std::span<const AnchoredEye> eyes, const Way& way) {
    const NodeGlide& glide = glides.all()[way.glide];
    const glm::dvec3 place_m(cut.mesh().hierarchy.position[glide.node]);
    const auto step = static_cast<size_t>(look_around(cut, glides, glide.node));
    const std::optional<double> slide_m = slide_bound_m(place_m, place_m + glm::dvec3(glide.shown_m), star_);
    if (!slide_m || *slide_m >= double(glm::length(glide.shown_m))) return -1.0;
    FourReaches reach;
    reach.set(0, cut.mesh(), glide, static_cast<float>(*slide_m) * (1.0f + 0x1p-20f));
    const double px = double(reach.worst_px(eyes)[0]);
    if (step_px_.size() <= step) step_px_.resize(step + 1, 0.0);
    const double more_px = std::max(px - step_px_[step], 0.0);
    step_px_[step] += more_px;
    steps_[way.glide] = static_cast<int>(step);
    return more_px;
}

double GlideError::measure_px(const MeshCut& cut, const NodeGlides& glides,
                              std::span<const AnchoredEye> eyes) {
    if (glides.all().empty()) return 0.0;
    sort_ways(cut, glides.all(), eyes);
    steps_.assign(ways_.size(), kWithAllOthers);
    step_px_.clear();
    double least_px = ways_.front().px, steps_px = 0.0;
    for (size_t i = 0; i < std::min(ways_.size(), kMostLooks); ++i) {
        if (ways_[i].px <= kUnseen_px || steps_px >= least_px) break;
        const double more_px = step_out_px(cut, glides, eyes, ways_[i]);
        if (more_px < 0.0) break;
        steps_px += more_px;
        least_px = std::min(least_px, steps_px + (i + 1 < ways_.size() ? ways_[i + 1].px : 0.0));
    }
    return least_px;
}

}  // namespace lod
