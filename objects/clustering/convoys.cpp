#include "objects/clustering/convoys.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace objects {

namespace {

constexpr double kDriftShare = 0.4;  ///< of a level's error: as much is left for geometry

using Times = std::pair<std::vector<double>, std::vector<double>>;

/// Bodies that are there at the same times, in order.
std::map<Times, std::vector<uint32_t>> by_presence(const Draft& draft, std::span<const uint32_t> bodies) {
    std::map<Times, std::vector<uint32_t>> classes;
    for (uint32_t body : bodies) {
        const StepFunction& f = draft.functions[draft.clusters[body].visibility];
        classes[{f.time_s, f.value}].push_back(body);
    }
    return classes;
}

std::vector<PlaceAndTime> places_of(const Draft& draft, std::span<const uint32_t> bodies, double size_m) {
    std::vector<PlaceAndTime> places;
    for (uint32_t body : bodies) {
        const Box box = swept_box(draft, draft.clusters[body]);
        const glm::dvec3 middle = (box.low + box.high) / (2.0 * size_m);
        places.push_back({middle.x, middle.y, middle.z, 0.0, 0.0});
    }
    return places;
}

std::span<const data::KeyFrame> keys_of(const Draft& draft, const DraftCluster& body) {
    const data::IndexRange motion = draft.motions[body.motion];
    return std::span(draft.scene.keys).subspan(motion.begin, motion.size());
}

/// The convoy that grows around a carrier.
struct GrowingConvoy {
    Draft& draft;
    LevelThresholds at;
    uint32_t carrier = kNone;
    GrowingBox box;

    void begin(uint32_t body) {
        carrier = body;
        box.box = {draft.clusters[body].box_min, draft.clusters[body].box_max};
    }

    bool takes(uint32_t body) {
        DraftCluster& member = draft.clusters[body];
        const MovingPair pair{.carrier = keys_of(draft, draft.clusters[carrier]),
                              .member = keys_of(draft, member),
                              .presence = &draft.functions[member.visibility],
                              .box_min = member.box_min,
                              .box_max = member.box_max,
                              .end_s = draft.scene.end_s};
        const double most_m = kDriftShare * at.error_m;
        if (surely_strays(pair, most_m)) return false;
        Carriage carriage{middle_place(pair), 0.0};
        carriage.drift_m = drift_m(pair, carriage.place, most_m);
        if (!(carriage.drift_m <= most_m) || !box.take(carried_box(member, carriage), at.size_m))
            return false;
        member.carriage = static_cast<uint32_t>(draft.carriages.size());
        draft.carriages.push_back(carriage);
        return true;
    }
};

}  // namespace

Box swept_box(const Draft& draft, const DraftCluster& body) {
    const double reach_m = glm::length(glm::max(glm::abs(body.box_min), glm::abs(body.box_max)));
    const std::span<const data::KeyFrame> keys = keys_of(draft, body);
    Box box{keys[0].position, keys[0].position};
    for (const data::KeyFrame& key : keys) {
        box.low = glm::min(box.low, key.position);
        box.high = glm::max(box.high, key.position);
    }
    return {box.low - reach_m, box.high + reach_m};
}

Grouping group_convoys(Draft& draft, std::span<const uint32_t> bodies, uint32_t level) {
    Grouping out;
    GrowingConvoy convoy{draft, draft.at(level), kNone, {}};
    if (!(convoy.at.error_m > 0.0))
        return {.groups = {}, .waiting = {bodies.begin(), bodies.end()}, .counts = {}};
    for (const auto& [times, members] : by_presence(draft, bodies)) {
        if (members.size() == 1) {
            out.waiting.push_back(members[0]);
            continue;
        }
        AliveTree tree(places_of(draft, members, convoy.at.size_m));
        Grouping some = gather_groups(
            members, tree, draft.options.most_children, [&](uint32_t body) { convoy.begin(body); },
            [&](uint32_t body) { return convoy.takes(body); });
        out.counts.add(some.counts);
        out.waiting.insert(out.waiting.end(), some.waiting.begin(), some.waiting.end());
        // Equal vehicles in one order, so that their geometry is equal.
        for (std::vector<uint32_t>& group : some.groups) {
            std::sort(group.begin() + 1, group.end());
            out.groups.push_back(std::move(group));
        }
    }
    return out;
}

}  // namespace objects
