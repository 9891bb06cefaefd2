#include "objects/clustering/draft.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include "lod/base/check.h"
#include "lod/base/hash.h"
#include "lod/base/parallel.h"
#include "objects/clustering/stays.h"
#include "objects/for_each_item.h"
#include "objects/reduction/fat_faces.h"
#include "objects/reduction/finish.h"
#include "objects/reduction/reduce.h"

namespace objects {

namespace {

constexpr size_t kFewestFaces = 4;  ///< meshes with fewer are not reduced by themselves
constexpr double kWorthwhileShare =
    0.49;  ///< a rung has at most so many of the faces of one with half the error

FaceSoup soup_of(const data::TimedMesh& mesh) {
    FaceSoup soup;
    soup.points.assign(mesh.positions.begin(), mesh.positions.end());
    soup.faces = mesh.triangles;
    soup.colours.reserve(mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        glm::uvec4 sum(0u);
        for (uint32_t corner : triangle)
            sum += glm::uvec4(mesh.colours[corner]);
        glm::u8vec4 colour((sum + 1u) / 3u);
        colour.w = colour.w < 255 ? kGlass : kByNormal;
        soup.colours.push_back(colour);
    }
    return with_fat_faces(soup);
}

/// Finds equal things by hash: `same(number)` decides.
class Distinct {
  public:
    template <typename Same>
    uint32_t find_or(uint64_t hash, uint32_t next, const Same& same) {
        const auto [begin, end] = known_.equal_range(hash);
        for (auto it = begin; it != end; ++it) {
            if (same(it->second)) return it->second;
        }
        known_.emplace(hash, next);
        return next;
    }

  private:
    std::unordered_multimap<uint64_t, uint32_t> known_;
};

uint64_t hash_of(const StepFunction& f) {
    uint64_t hash = f.time_s.size();
    for (size_t i = 0; i < f.time_s.size(); ++i)
        hash = lod::hash_combine(hash, std::bit_cast<uint64_t>(f.time_s[i]));
    return hash;
}

std::array<double, 8> numbers_of(const data::KeyFrame& key) {
    return {key.time_s,     key.position.x, key.position.y, key.position.z,
            key.rotation.w, key.rotation.x, key.rotation.y, key.rotation.z};
}

/// A motion with one key is the same at any time.
bool is_same_motion(const data::TimedScene& scene, data::IndexRange a, data::IndexRange b) {
    if (a.size() != b.size()) return false;
    for (uint32_t i = 0; i < a.size(); ++i) {
        std::array<double, 8> p = numbers_of(scene.keys[a.begin + i]),
                              q = numbers_of(scene.keys[b.begin + i]);
        if (a.size() == 1) p[0] = q[0] = 0.0;
        if (p != q) return false;
    }
    return true;
}

uint64_t hash_of(const data::TimedScene& scene, data::IndexRange motion) {
    uint64_t hash = motion.size();
    for (uint32_t i = motion.begin; i < motion.end; ++i) {
        const std::array<double, 8> numbers = numbers_of(scene.keys[i]);
        for (size_t k = motion.size() == 1 ? 1 : 0; k < numbers.size(); ++k)
            hash = lod::hash_combine(hash, std::bit_cast<uint64_t>(numbers[k] + 0.0));
    }
    return hash;
}

void make_meshes(Draft& draft) {
    draft.meshes.resize(draft.scene.meshes.size());
    for (size_t i = 0; i < draft.meshes.size(); ++i) {
        DraftMesh& mesh = draft.meshes[i];
        mesh.soup = soup_of(draft.scene.meshes[i]);
        mesh.geometry = draft.pool.add(draw_mesh(draft.scene.meshes[i]));
        // Of what is drawn: points that no triangle uses do not count.
        FaceSoup used = mesh.soup;
        drop_unused_points(used);
        for (size_t k = 0; k < used.points.size(); ++k) {
            mesh.box_min = k == 0 ? used.points[0] : glm::min(mesh.box_min, used.points[k]);
            mesh.box_max = k == 0 ? used.points[0] : glm::max(mesh.box_max, used.points[k]);
        }
    }
}

/// Box of the mesh, turned and moved; of its points, not of its box.
void place_leaf(const Draft& draft, DraftCluster& leaf) {
    const DraftMesh& mesh = draft.meshes[leaf.mesh];
    if (leaf.motion_class == data::MotionClass::kDynamic) {
        leaf.box_min = mesh.box_min;
        leaf.box_max = mesh.box_max;
        return;
    }
    const data::KeyFrame& key = draft.scene.keys[draft.motions[leaf.motion].begin];
    const glm::dmat3 rotation = glm::mat3_cast(key.rotation);
    bool is_first = true;
    for (const auto& face : mesh.soup.faces) {
        for (uint32_t corner : face) {
            const glm::dvec3 at = rotation * mesh.soup.points[corner] + key.position;
            leaf.box_min = is_first ? at : glm::min(leaf.box_min, at);
            leaf.box_max = is_first ? at : glm::max(leaf.box_max, at);
            is_first = false;
        }
    }
    if (is_first) leaf.box_min = leaf.box_max = key.position;
}

/// Numbers of visibilities and motions, equal ones once.
class DistinctParts {
  public:
    explicit DistinctParts(Draft& draft) : draft_(draft) {}

    uint32_t visibility(const StepFunction& f) {
        const uint32_t next = static_cast<uint32_t>(draft_.functions.size());
        const uint32_t id = functions_.find_or(hash_of(f), next,
                                               [&](uint32_t known) { return draft_.functions[known] == f; });
        if (id == next) draft_.functions.push_back(f);
        return id;
    }
    uint32_t motion(data::IndexRange keys) {
        const uint32_t next = static_cast<uint32_t>(draft_.motions.size());
        const uint32_t id = motions_.find_or(hash_of(draft_.scene, keys), next, [&](uint32_t known) {
            return is_same_motion(draft_.scene, draft_.motions[known], keys);
        });
        if (id == next) draft_.motions.push_back(keys);
        return id;
    }

  private:
    Draft& draft_;
    Distinct functions_, motions_;
};

void make_leaves(Draft& draft) {
    const data::TimedScene& scene = draft.scene;
    DistinctParts distinct(draft);
    draft.clusters.reserve(scene.objects.size() + scene.objects.size() / 8);
    const Companions companions(scene);
    std::vector<Stay> stays;
    for (uint32_t i = 0; i < scene.objects.size(); ++i) {
        const data::TimedObject& object = scene.objects[i];
        stays_of(scene, object, companions.turns(scene, object), draft.options.least_rest_share * scene.end_s,
                 stays);
        for (const Stay& stay : stays) {
            DraftCluster leaf;
            leaf.object = i;
            leaf.mesh = object.mesh;
            leaf.geometry = draft.meshes[leaf.mesh].geometry;
            leaf.motion_class = stay.motion_class;
            leaf.is_turning = stay.is_turning;
            leaf.visibility = distinct.visibility(stay.visibility);
            leaf.motion = distinct.motion(stay.keys);
            draft.clusters.push_back(std::move(leaf));
        }
    }
    lod::parallel_for(draft.clusters.size(), draft.options.threads, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            place_leaf(draft, draft.clusters[i]);
            draft.clusters[i].weight_m = draft.clusters[i].size_m();
        }
    });
}

}  // namespace

Draft make_draft(const data::TimedScene& scene, const BuildOptions& options) {
    CHECK(scene.end_s > 0.0);
    Draft draft{scene, options, 0.0, {}, {}, {}, {}, {}, {}, {}, {}};
    make_meshes(draft);
    make_leaves(draft);
    return draft;
}

const MeshRung* rung_at(const DraftMesh& mesh, uint32_t level) {
    const MeshRung* best = nullptr;
    for (const MeshRung& rung : mesh.rungs) {
        if (rung.level <= level && rung.geometry != kNoGeometry) best = &rung;
    }
    return best;
}

void make_rungs(Draft& draft, std::span<const uint32_t> meshes, uint32_t level) {
    std::vector<uint32_t> missing;
    for (uint32_t mesh : meshes) {
        const std::vector<MeshRung>& rungs = draft.meshes[mesh].rungs;
        if (rungs.empty() || rungs.back().level < level) missing.push_back(mesh);
    }
    const double limit_m = draft.at(level).error_m;
    const double most_share = std::pow(kWorthwhileShare, 1.0 / draft.options.levels_per_doubling);
    std::vector<MeshRung> made(missing.size());
    const unsigned threads = threads_within(missing.size(), draft.options.threads);
    for_each_item(missing.size(), draft.options.threads, [&](size_t i) {
        const DraftMesh& mesh = draft.meshes[missing[i]];
        made[i].level = level;
        made[i].error_m = limit_m;
        if (mesh.soup.faces.size() >= kFewestFaces && limit_m > 0.0)
            made[i].soup = reduce_within(mesh.soup, limit_m, threads);
    });
    for (size_t i = 0; i < missing.size(); ++i) {
        DraftMesh& mesh = draft.meshes[missing[i]];
        const MeshRung* finer = rung_at(mesh, level);
        const size_t before = finer != nullptr ? finer->soup.faces.size() : mesh.soup.faces.size();
        const size_t after = made[i].soup.faces.size();
        const bool is_worth_it =
            after > 0 && static_cast<double>(after) <= most_share * static_cast<double>(before);
        if (is_worth_it)
            made[i].geometry = draft.pool.add(draw_soup(made[i].soup));
        else
            made[i].soup = {};
        mesh.rungs.push_back(std::move(made[i]));
    }
}

Box carried_box(const DraftCluster& cluster, const Carriage& carriage) {
    const glm::dvec3 middle = 0.5 * (cluster.box_min + cluster.box_max),
                     half = 0.5 * (cluster.box_max - cluster.box_min);
    const glm::dmat3& turn = carriage.place.rotation;
    const glm::dvec3 reach = glm::abs(turn[0]) * half.x + glm::abs(turn[1]) * half.y +
                             glm::abs(turn[2]) * half.z + carriage.drift_m;
    const glm::dvec3 at = turn * middle + carriage.place.offset;
    return {at - reach, at + reach};
}

double append_cluster_soup(const Draft& draft, const DraftCluster& cluster, double most_m,
                           const FramePlace& place, FaceSoup& out) {
    if (cluster.mesh == kNone) {
        append_soup(draft.soups[cluster.soup], place.rotation, place.offset, out);
        return 0.0;
    }
    const DraftMesh& mesh = draft.meshes[cluster.mesh];
    const MeshRung* rung = nullptr;
    for (const MeshRung& coarser : mesh.rungs) {
        if (coarser.error_m <= most_m && coarser.geometry != kNoGeometry) rung = &coarser;
    }
    const FaceSoup& soup = rung != nullptr ? rung->soup : mesh.soup;
    if (cluster.motion_class == data::MotionClass::kDynamic) {
        append_soup(soup, place.rotation, place.offset, out);
    } else {
        const data::KeyFrame& key = draft.scene.keys[draft.motions[cluster.motion].begin];
        append_soup(soup, place.rotation * glm::mat3_cast(key.rotation),
                    place.rotation * key.position + place.offset, out);
    }
    return (rung != nullptr ? rung->error_m : 0.0) - cluster.error_m;
}

}  // namespace objects
