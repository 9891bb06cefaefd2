#include "objects/clustering/merge.h"

#include <algorithm>
#include <cmath>

#include "lod/base/check.h"
#include "objects/for_each_item.h"
#include "objects/reduction/reduce.h"

namespace objects {

namespace {

constexpr double kLeastShare = 0.05;  ///< of a level's error: with less left, geometry is joined as it is
constexpr double kWorthwhileShare =
    0.64;  ///< of its faces that a cluster alone may keep for each doubling of the error a parent has
constexpr size_t kFewestFacesAlone = 12;  ///< what stands alone with fewer is not reduced
constexpr size_t kGroupsAtOnce = 256;     ///< so many finished clusters wait at most to be put into the draft
constexpr double kMostSizes = 2.0;        ///< of w(l), beyond which nothing alone is reduced

/// A cluster on its way: made by any thread, put into the draft in order.
struct Merged {
    DraftCluster cluster;
    StepFunction visibility;
    FaceSoup soup;
    DrawnGeometry drawn;
    BuildCounts counts;
};

StepFunction mean_of(const Draft& draft, std::span<const uint32_t> children) {
    std::vector<WeightedFunction> parts;
    for (uint32_t child : children)
        parts.push_back({&draft.functions[draft.clusters[child].visibility], draft.clusters[child].weight_m});
    return weighted_mean(parts);
}

/// gamma that a child asks of a cluster with this visibility.
double gamma_with(const Draft& draft, uint32_t child, const StepFunction& visibility) {
    const DraftCluster& cluster = draft.clusters[child];
    return cluster.gamma + distance(visibility, draft.functions[cluster.visibility], draft.scene.end_s);
}

/// Visibility and gamma of a group; children that are too far in time leave it, the farthest first.
void settle_time(const Draft& draft, double most_gamma, std::vector<uint32_t>& children, Merged& out,
                 std::vector<uint32_t>& released) {
    for (;;) {
        out.visibility = mean_of(draft, children);
        for (uint32_t child : children)
            out.counts.steps += draft.functions[draft.clusters[child].visibility].time_s.size();
        out.counts.steps += children.size() * out.visibility.time_s.size();
        size_t worst = 0;
        double gamma = 0.0;
        for (size_t i = 0; i < children.size(); ++i) {
            const double one = gamma_with(draft, children[i], out.visibility);
            if (one > gamma) {
                gamma = one;
                worst = i;
            }
        }
        out.cluster.gamma = gamma;
        if (gamma <= most_gamma || children.size() == 1) return;
        released.push_back(children[worst]);
        children.erase(children.begin() + static_cast<std::ptrdiff_t>(worst));
    }
}

void settle_box(const Draft& draft, std::span<const uint32_t> children, DraftCluster& out) {
    out.weight_m = 0.0;
    for (uint32_t child : children) {
        const DraftCluster& cluster = draft.clusters[child];
        const Box box = cluster.carriage == kNone ? Box{cluster.box_min, cluster.box_max}
                                                  : carried_box(cluster, draft.carriages[cluster.carriage]);
        out.box_min = child == children[0] ? box.low : glm::min(out.box_min, box.low);
        out.box_max = child == children[0] ? box.high : glm::max(out.box_max, box.high);
        out.weight_m += cluster.weight_m;
    }
}

/// A cluster whose geometry a parent is made of.
struct Source {
    uint32_t cluster = kNone;
    FramePlace place;      ///< of its frame in the parent's …
    double drift_m = 0.0;  ///< … and how far off that it gets
};

/// Children, or what is below them where they have spent so much of the level's error that little could be gained with the
/// rest.
/// @param below  the frame that the children's parent has in the one that is asked for
void gather_sources(const Draft& draft, std::span<const uint32_t> children, uint32_t level,
                    const Source& below, std::vector<Source>& out) {
    for (uint32_t child : children) {
        const DraftCluster& cluster = draft.clusters[child];
        Source source{child, below.place, below.drift_m};
        if (cluster.carriage != kNone) {
            const Carriage& carriage = draft.carriages[cluster.carriage];
            source.place.rotation = below.place.rotation * carriage.place.rotation;
            source.place.offset = below.place.rotation * carriage.place.offset + below.place.offset;
            source.drift_m += carriage.drift_m;
        }
        if (cluster.error_m > draft.options.spent_share * draft.at(level).error_m && cluster.soup != kNone)
            gather_sources(draft, cluster.children, level, source, out);
        else
            out.push_back(source);
    }
}

void drop_soups(Draft& draft, std::span<const uint32_t> clusters) {
    for (uint32_t id : clusters) {
        const DraftCluster& cluster = draft.clusters[id];
        if (cluster.soup == kNone || draft.soups[cluster.soup].faces.empty()) continue;
        draft.soups[cluster.soup] = {};
        drop_soups(draft, cluster.children);
    }
}

/// What lies below a source of the next level is no source of any level any more.
void drop_spent_soups(Draft& draft, const DraftCluster& cluster) {
    for (uint32_t id : cluster.children) {
        const DraftCluster& child = draft.clusters[id];
        if (child.error_m <= draft.options.spent_share * draft.at(cluster.level + 1).error_m)
            drop_soups(draft, child.children);
        else
            drop_spent_soups(draft, child);
    }
}

/// Geometry: what stands for the children at this level, joined and reduced around the box's middle.
void settle_geometry(const Draft& draft, std::span<const uint32_t> children, uint32_t level, unsigned threads,
                     Merged& out) {
    const glm::dvec3 middle = 0.5 * (out.cluster.box_min + out.cluster.box_max);
    std::vector<Source> sources;
    gather_sources(draft, children, level, {.cluster = kNone, .place = {.offset = -middle}}, sources);
    FaceSoup joined;
    double error_m = 0.0, child_error_m = 0.0;
    for (const Source& source : sources) {
        const DraftCluster& cluster = draft.clusters[source.cluster];
        const double most_m = draft.options.spent_share * draft.at(level).error_m;
        const double more_m = append_cluster_soup(draft, cluster, most_m, source.place, joined);
        error_m = std::max(error_m, cluster.error_m + more_m + source.drift_m);
    }
    out.counts.faces += joined.faces.size();
    for (uint32_t child : children)
        child_error_m = std::max(child_error_m, draft.clusters[child].error_m);
    const double limit_m = draft.at(level).error_m - error_m;
    FaceSoup reduced;
    if (limit_m > kLeastShare * draft.at(level).error_m) reduced = reduce_within(joined, limit_m, threads);
    const bool is_reduced = !reduced.faces.empty() && reduced.faces.size() < joined.faces.size();
    const FaceSoup& kept = is_reduced ? reduced : joined;
    out.soup.points.reserve(kept.points.size());
    out.soup.faces.reserve(kept.faces.size());
    append_soup(kept, glm::dmat3(1.0), middle, out.soup);
    out.cluster.error_m = std::max(child_error_m, error_m + (is_reduced ? limit_m : 0.0));
    for (const auto& face : out.soup.faces) {
        for (uint32_t corner : face) {
            out.cluster.box_min = glm::min(out.cluster.box_min, out.soup.points[corner]);
            out.cluster.box_max = glm::max(out.cluster.box_max, out.soup.points[corner]);
        }
    }
    out.drawn = draw_soup(out.soup);
}

/// Puts a finished cluster into the draft.
uint32_t add_cluster(Draft& draft, Merged& merged) {
    DraftCluster& cluster = merged.cluster;
    cluster.visibility = static_cast<uint32_t>(draft.functions.size());
    draft.functions.push_back(std::move(merged.visibility));
    cluster.geometry = draft.pool.add(merged.drawn);
    cluster.soup = static_cast<uint32_t>(draft.soups.size());
    draft.soups.push_back(std::move(merged.soup));
    drop_spent_soups(draft, cluster);
    draft.clusters.push_back(std::move(cluster));
    return static_cast<uint32_t>(draft.clusters.size()) - 1;
}

/// What is that much larger than a level's clusters is coarse enough for it, and costly to reduce to its error.
bool is_too_large(const Draft& draft, const DraftCluster& cluster, uint32_t level) {
    return cluster.size_m() > kMostSizes * draft.at(level).size_m;
}

}  // namespace

std::vector<uint32_t> merge_groups(Draft& draft, const std::vector<std::vector<uint32_t>>& groups,
                                   uint32_t level, data::MotionClass motion_class,
                                   std::vector<uint32_t>& released) {
    std::vector<uint32_t> made;
    for (size_t begin = 0; begin < groups.size(); begin += kGroupsAtOnce) {
        const auto some = std::span(groups).subspan(begin, std::min(kGroupsAtOnce, groups.size() - begin));
        std::vector<Merged> merged(some.size());
        std::vector<std::vector<uint32_t>> let_go(some.size());
        const unsigned threads = threads_within(some.size(), draft.options.threads);
        for_each_item(some.size(), draft.options.threads, [&](size_t i) {
            std::vector<uint32_t> children = some[i];
            settle_time(draft, draft.at(level).gamma, children, merged[i], let_go[i]);
            DraftCluster& cluster = merged[i].cluster;
            cluster.level = level;
            cluster.motion = motion_class == data::MotionClass::kDynamic ? draft.clusters[children[0]].motion
                                                                         : kSceneFrame;
            cluster.motion_class = motion_class;
            cluster.children = children;
            if (children.size() < 2) return;
            settle_box(draft, children, cluster);
            settle_geometry(draft, children, level, threads, merged[i]);
        });
        for (size_t i = 0; i < some.size(); ++i) {
            draft.counts.add(merged[i].counts);
            released.insert(released.end(), let_go[i].begin(), let_go[i].end());
            if (merged[i].cluster.children.size() < 2)
                released.push_back(merged[i].cluster.children[0]);
            else
                made.push_back(add_cluster(draft, merged[i]));
        }
    }
    return made;
}

std::vector<uint32_t> reduce_alone(Draft& draft, std::span<const uint32_t> alone, uint32_t level) {
    std::vector<uint32_t> tops(alone.begin(), alone.end());
    std::vector<uint32_t> meshes;
    for (uint32_t id : alone) {
        const DraftCluster& cluster = draft.clusters[id];
        if (cluster.mesh != kNone && draft.meshes[cluster.mesh].soup.faces.size() >= kFewestFacesAlone &&
            !is_too_large(draft, cluster, level))
            meshes.push_back(cluster.mesh);
    }
    std::sort(meshes.begin(), meshes.end());
    meshes.erase(std::unique(meshes.begin(), meshes.end()), meshes.end());
    make_rungs(draft, meshes, level);
    const double most_share = std::pow(kWorthwhileShare, 1.0 / draft.options.levels_per_doubling);
    std::vector<Merged> merged(alone.size());
    std::vector<size_t> to_reduce;
    for (size_t i = 0; i < alone.size(); ++i) {
        const DraftCluster& child = draft.clusters[alone[i]];
        if (child.mesh == kNone && draft.soups[child.soup].faces.size() >= kFewestFacesAlone &&
            !is_too_large(draft, child, level))
            to_reduce.push_back(i);
    }
    const unsigned threads = threads_within(to_reduce.size(), draft.options.threads);
    for_each_item(to_reduce.size(), draft.options.threads, [&](size_t k) {
        const size_t i = to_reduce[k];
        merged[i].cluster = draft.clusters[alone[i]];
        settle_geometry(draft, {&alone[i], 1}, level, threads, merged[i]);
    });
    for (size_t i = 0; i < alone.size(); ++i) {
        draft.counts.add(merged[i].counts);
        const DraftCluster child = draft.clusters[alone[i]];
        DraftCluster parent = child;
        if (child.mesh != kNone) {
            const MeshRung* rung = rung_at(draft.meshes[child.mesh], level);
            if (rung == nullptr || rung->level != level) continue;
            parent.rung = level;
            parent.geometry = rung->geometry;
            parent.error_m = rung->error_m;
            const glm::dvec3 margin(rung->error_m);
            parent.box_min -= margin;
            parent.box_max += margin;
        } else {
            const size_t before = draft.soups[child.soup].faces.size();
            const double after = static_cast<double>(merged[i].soup.faces.size());
            if (after == 0.0 || after > most_share * static_cast<double>(before)) continue;
            parent = merged[i].cluster;
            parent.geometry = draft.pool.add(merged[i].drawn);
            parent.soup = static_cast<uint32_t>(draft.soups.size());
            draft.soups.push_back(std::move(merged[i].soup));
        }
        parent.children = {alone[i]};
        parent.object = kNoObject;
        parent.level = level;
        drop_spent_soups(draft, parent);
        tops[i] = static_cast<uint32_t>(draft.clusters.size());
        draft.clusters.push_back(std::move(parent));
    }
    return tops;
}

uint32_t hold(Draft& draft, const std::vector<uint32_t>& children, uint32_t level,
              data::MotionClass motion_class) {
    CHECK(!children.empty());
    DraftCluster cluster;
    settle_box(draft, children, cluster);
    StepFunction visibility = mean_of(draft, children);
    for (uint32_t child : children)
        cluster.gamma = std::max(cluster.gamma, gamma_with(draft, child, visibility));
    cluster.visibility = static_cast<uint32_t>(draft.functions.size());
    draft.functions.push_back(std::move(visibility));
    cluster.error_m = double(kNeverEnough_m);
    cluster.level = level;
    cluster.motion_class = motion_class;
    cluster.children = children;
    draft.clusters.push_back(std::move(cluster));
    return static_cast<uint32_t>(draft.clusters.size()) - 1;
}

}  // namespace objects
