#include "objects/reduction/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <utility>

#include "lod/surface/surface_distance.h"
#include "objects/alive_tree.h"
#include "objects/for_each_item.h"
#include "objects/reduction/extremes.h"
#include "objects/reduction/fit.h"
#include "objects/reduction/joint_face.h"
#include "objects/reduction/seen_part.h"
#include "objects/reduction/spread.h"
#include "objects/reduction/width.h"

namespace objects {

namespace {

using lod::Triangle;

constexpr size_t kNeighbours = 8;                         ///< of a face at first
constexpr size_t kMostNeighbours = 16;                    ///< of what is gathered
constexpr size_t kMostDissolved = 4;                      ///< loads of a face that is given up
constexpr uint64_t kFirstTries = 256, kTriesForOne = 24;  ///< fewer finds than one in so many, and it stops
constexpr double kMostWidth =
    2.1;  ///< limits, of what a plane may be near to; as it is measured a little too broad
constexpr uint32_t kNone = 0xffffffffu;
constexpr lod::PieceSearch kSearch{.most_pieces = 1024, .smallest_share = 1.0 / 32};

struct Group {
    Triangle face;
    Extremes extremes;
    std::vector<uint32_t> loads, neighbours;
    uint32_t version = 0;      ///< rises with every change
    uint32_t went_to = kNone;  ///< the group that took it in
};

double gap2(const Group& a, const Group& b) {
    const glm::dvec3 apart =
        glm::max(glm::max(a.extremes.low() - b.extremes.high(), b.extremes.low() - a.extremes.high()),
                 glm::dvec3(0.0));
    return glm::dot(apart, apart);
}

double joint_extent2(const Group& a, const Group& b) {
    const glm::dvec3 extent =
        glm::max(a.extremes.high(), b.extremes.high()) - glm::min(a.extremes.low(), b.extremes.low());
    return glm::dot(extent, extent);
}

/// Two that may become one, as they were when it was thought of.
struct Pair {
    double rank = 0.0;
    uint32_t a = 0, b = 0, version_a = 0, version_b = 0;

    bool operator>(const Pair& other) const {
        return rank != other.rank ? rank > other.rank : a != other.a ? a > other.a : b > other.b;
    }
};

class Gathering {
  public:
    Gathering(const FaceSoup& source, const lod::TriangleTree& tree, double limit_m,
              std::span<const FaceLoad> loads)
        : source_(source), tree_(tree), limit_m_(limit_m), loads_(loads) {
        for (uint32_t load = 0; load < loads.size(); ++load)
            groups_.push_back(group_of(load));
        find_neighbours();
    }

    void join_pairs() {
        while (!queue_.empty() && !is_hopeless()) {
            const Pair pair = queue_.top();
            queue_.pop();
            const Group &a = groups_[pair.a], &b = groups_[pair.b];
            if (a.version != pair.version_a || b.version != pair.version_b) continue;
            if (const std::optional<Triangle> face = face_for(a, b)) join(pair.a, pair.b, *face);
        }
    }

    void dissolve_small() {
        std::vector<uint32_t> small;
        for (uint32_t i = 0; i < groups_.size(); ++i) {
            if (groups_[i].went_to == kNone && groups_[i].loads.size() <= kMostDissolved) small.push_back(i);
        }
        std::stable_sort(small.begin(), small.end(), [&](uint32_t a, uint32_t b) {
            return groups_[a].loads.size() < groups_[b].loads.size();
        });
        for (const uint32_t group : small) {
            if (is_hopeless()) return;
            dissolve(group);
        }
    }

    std::vector<Gathered> result(unsigned threads) {
        const std::vector<uint32_t> parts = shared_parts();
        std::vector<uint32_t> left;
        for (uint32_t i = 0; i < groups_.size(); ++i) {
            if (groups_[i].went_to == kNone) left.push_back(i);
        }
        std::vector<Gathered> all(left.size());
        for_each_item(left.size(), threads, [&](size_t i) {
            Group& group = groups_[left[i]];
            if (std::ranges::binary_search(parts, loads_[group.loads[0]].part)) spread_out(group);
            all[i] = finished(group);
        });
        return all;
    }

  private:
    Group group_of(uint32_t load) const {
        Group group;
        group.face = loads_[load].face;
        group.loads = {load};
        group.extremes = Extremes(loads_[load].corners[0]);
        for (const glm::dvec3& corner : loads_[load].corners)
            group.extremes.add(corner);
        return group;
    }

    uint32_t now(uint32_t group) const {
        while (groups_[group].went_to != kNone)
            group = groups_[group].went_to;
        return group;
    }

    void find_neighbours() {
        if (groups_.empty()) return;
        std::vector<PlaceAndTime> places;
        for (const Group& group : groups_) {
            const glm::dvec3 middle = 0.5 * (group.extremes.low() + group.extremes.high());
            places.push_back({middle.x, middle.y, middle.z, 0.0, 0.0});
        }
        const AliveTree tree(places);
        std::vector<uint32_t> nearest;
        for (uint32_t i = 0; i < groups_.size(); ++i) {
            (void)tree.nearest(i, std::numeric_limits<double>::infinity(), kNeighbours, nearest);
            for (const uint32_t other : nearest) {
                groups_[i].neighbours.push_back(other);
                groups_[other].neighbours.push_back(i);
            }
        }
        for (uint32_t i = 0; i < groups_.size(); ++i) {
            tidy_neighbours(i);
            for (const uint32_t other : groups_[i].neighbours) {
                if (i < other) offer(i, other);
            }
        }
    }

    /// Each neighbour once, by what it is now.
    void tidy_neighbours(uint32_t group) {
        std::vector<uint32_t>& neighbours = groups_[group].neighbours;
        for (uint32_t& neighbour : neighbours)
            neighbour = now(neighbour);
        std::sort(neighbours.begin(), neighbours.end());
        neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
        std::erase(neighbours, group);
    }

    bool may_join(const Group& a, const Group& b) const {
        return is_glass(loads_[a.loads[0]].colour) == is_glass(loads_[b.loads[0]].colour) &&
               gap2(a, b) <= 4.0 * limit_m_ * limit_m_;
    }

    void offer(uint32_t a, uint32_t b) {
        if (a > b) std::swap(a, b);
        const Group &one = groups_[a], &other = groups_[b];
        if (may_join(one, other)) queue_.push({joint_extent2(one, other), a, b, one.version, other.version});
    }

    /// Whether so few of what has been tried came to anything that the rest is not worth it.
    bool is_hopeless() const { return tried_ >= kFirstTries && found_ * kTriesForOne < tried_; }

    /// A face that is proved to be near enough to all that two stand for, and to the source.
    std::optional<Triangle> face_for(const Group& one, const Group& other) {
        std::array<glm::dvec3, 2 * Extremes::kCount> points;
        std::ranges::copy(one.extremes.points(), points.begin());
        std::ranges::copy(other.extremes.points(), points.begin() + Extremes::kCount);
        if (is_rod(points) || least_width_m(points) > kMostWidth * limit_m_) return std::nullopt;
        ++tried_;
        const FitTarget target{points, source_.view(), &tree_};
        const std::array<glm::dvec3, 6> corners = {one.face.a,   one.face.b,   one.face.c,
                                                   other.face.a, other.face.b, other.face.c};
        for (Triangle face : {largest_face(corners), narrow_face(corners)}) {
            if (!fit(target, limit_m_, {&face, 1})) continue;
            lod::PieceSearch search = kSearch;
            if (holds_all(one, face) && holds_all(other, face) &&
                lod::is_within(face, tree_, limit_m_, search)) {
                ++found_;
                return face;
            }
        }
        return std::nullopt;
    }

    /// Of which a face stands for something else, too; ascending.
    std::vector<uint32_t> shared_parts() const {
        std::vector<uint32_t> parts;
        for (const Group& group : groups_) {
            if (group.loads.size() < 2) continue;
            for (const uint32_t load : group.loads)
                parts.push_back(loads_[load].part);
        }
        std::ranges::sort(parts);
        return parts;
    }

    void spread_out(Group& group) const {
        Outlook outlook;
        std::vector<glm::dvec3> corners;
        for (const uint32_t load : group.loads) {
            outlook.add(loads_[load].outlook);
            corners.insert(corners.end(), loads_[load].corners.begin(), loads_[load].corners.end());
        }
        const FitTarget target{group.extremes.points(), source_.view(), &tree_};
        spread(target, corners, limit_m_, outlook.covering_m2(), group.face);
    }

    bool holds_all(const Group& group, const Triangle& face) const {
        for (const uint32_t load : group.loads) {
            for (const glm::dvec3& corner : loads_[load].corners) {
                if (lod::squared_distance(corner, face) > limit_m_ * limit_m_) return false;
            }
        }
        return true;
    }

    static void take_in(const Group& other, const Triangle& face, Group& group) {
        group.face = face;
        for (const glm::dvec3& point : other.extremes.points())
            group.extremes.add(point);
        group.loads.insert(group.loads.end(), other.loads.begin(), other.loads.end());
        ++group.version;
    }

    void give_up(uint32_t group, uint32_t went_to) {
        groups_[group].went_to = went_to;
        ++groups_[group].version;
        groups_[group].loads.clear();
        groups_[group].neighbours.clear();
    }

    void join(uint32_t a, uint32_t b, const Triangle& face) {
        Group& kept = groups_[a];
        take_in(groups_[b], face, kept);
        kept.neighbours.insert(kept.neighbours.end(), groups_[b].neighbours.begin(),
                               groups_[b].neighbours.end());
        give_up(b, a);
        tidy_neighbours(a);
        if (kept.neighbours.size() > kMostNeighbours) {
            sort_by_extent_with(kept, kept.neighbours);
            kept.neighbours.resize(kMostNeighbours);
        }
        for (const uint32_t neighbour : kept.neighbours)
            offer(a, neighbour);
    }

    void sort_by_extent_with(const Group& group, std::vector<uint32_t>& others) const {
        std::stable_sort(others.begin(), others.end(), [&](uint32_t a, uint32_t b) {
            return joint_extent2(group, groups_[a]) < joint_extent2(group, groups_[b]);
        });
    }

    /// Gives each of a group's loads to a neighbour, if all find one.
    void dissolve(uint32_t group) {
        tidy_neighbours(group);
        std::vector<uint32_t> near = groups_[group].neighbours;
        std::map<uint32_t, Group> grown;
        for (const uint32_t load : groups_[group].loads) {
            const Group one = group_of(load);
            sort_by_extent_with(one, near);
            const bool is_taken = std::any_of(near.begin(), near.end(), [&](uint32_t id) {
                const auto known = grown.find(id);
                const Group& other = known == grown.end() ? groups_[id] : known->second;
                if (!may_join(one, other)) return false;
                const std::optional<Triangle> face = face_for(one, other);
                if (face) take_in(one, *face, grown.try_emplace(id, other).first->second);
                return face.has_value();
            });
            if (!is_taken) return;
        }
        for (auto& [id, taker] : grown) {
            taker.neighbours.insert(taker.neighbours.end(), near.begin(), near.end());
            groups_[id] = std::move(taker);
        }
        give_up(group, grown.begin()->first);
    }

    Gathered finished(const Group& group) const {
        Gathered out{group.face, loads_[group.loads[0]].colour, group.loads};
        glm::dvec3 light(0.0);
        Outlook outlook;
        for (const uint32_t load : group.loads) {
            const glm::dvec3 colour(loads_[load].colour);
            light += loads_[load].outlook.area_m2 * colour * colour;
            outlook.add(loads_[load].outlook);
        }
        if (outlook.area_m2 > 0.0)
            out.colour = {glm::u8vec3(glm::round(glm::sqrt(light / outlook.area_m2))), out.colour.w};
        const glm::dvec3 normal = lod::area_vector_m2(out.face);
        if (!is_glass(out.colour)) out.colour.w = outlook.finish(normal);
        if (glm::dot(normal, outlook.sum_m2) < 0.0) std::swap(out.face.b, out.face.c);
        return out;
    }

    const FaceSoup& source_;
    const lod::TriangleTree& tree_;
    double limit_m_;
    std::span<const FaceLoad> loads_;
    std::vector<Group> groups_;
    std::priority_queue<Pair, std::vector<Pair>, std::greater<>> queue_;
    uint64_t tried_ = 0, found_ = 0;
};

}  // namespace

std::vector<Gathered> gather(const FaceSoup& source, const lod::TriangleTree& source_tree, double limit_m,
                             std::span<const FaceLoad> loads, unsigned threads) {
    Gathering gathering(source, source_tree, limit_m, loads);
    gathering.join_pairs();
    gathering.dissolve_small();
    return gathering.result(threads);
}

}  // namespace objects
