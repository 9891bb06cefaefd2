#include "data/scenes/construction_site.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "data/scene_time.h"
#include "data/scenes/site_cranes.h"
#include "data/scenes/site_crew.h"
#include "data/scenes/site_fleet.h"
#include "data/scenes/site_groundworks.h"
#include "data/scenes/site_meshes.h"
#include "data/scenes/site_old_quarter.h"
#include "data/scenes/site_plan.h"
#include "data/scenes/site_surroundings.h"
#include "data/scenes/site_tower.h"
#include "lod/base/check.h"

namespace data {

namespace site {
namespace {

struct ClassTarget {
    uint64_t objects, triangles;
};
constexpr ClassTarget kStatic{498, 66784}, kPseudoDynamic{40010, 2879506}, kDynamic{15649, 1313767};

/// How many heaps make a class whole, and how many triangles each has: `larger` of them one more than `triangles`.
struct Remainder {
    uint64_t heaps, triangles, larger;
};

Remainder remainder_of(const ClassTarget& target, MotionClass motion, const SceneBuilder& builder) {
    const ClassCounts counts = count_classes(builder.scene);
    const auto index = static_cast<size_t>(motion);
    CHECK(counts.objects[index] < target.objects && counts.triangles[index] < target.triangles);
    const uint64_t heaps = target.objects - counts.objects[index];
    const uint64_t triangles = target.triangles - counts.triangles[index];
    return {heaps, triangles / heaps, triangles % heaps};
}

/// Calls add(number, mesh) for every heap.
template <typename Add>
void add_heaps(const Remainder& remainder, Heap heap, const Colour& colour, SceneBuilder& builder,
               const Add& add) {
    uint32_t meshes[2];
    for (uint64_t i = 0; i < 2; ++i) {
        TimedMesh mesh;
        heap.triangles = remainder.triangles + i;
        append_heap(heap, colour, mesh);
        meshes[i] = add_mesh(std::move(mesh), builder);
    }
    for (uint64_t i = 0; i < remainder.heaps; ++i)
        add(i, meshes[i < remainder.larger ? 1 : 0]);
}

/// Fills the classes up: mounds of earth beyond the fleet, heaps of gravel that come and go at the yards, people, and
/// what the dumpers carry.
void add_crew_and_heaps(const std::vector<Bed>& beds, SceneBuilder& builder) {
    const auto around = [&](double low_m, double high_m) {
        const double radius_m = builder.rng.between(low_m, high_m),
                     angle_rad = builder.rng.between(0.0, 2.0 * std::numbers::pi);
        return Placement{{radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), 0.0}, angle_rad};
    };
    const Remainder mounds = remainder_of(kStatic, MotionClass::kStatic, builder);
    add_heaps(mounds, {7.0, 3.2}, kEarth, builder,
              [&](uint64_t, uint32_t mesh) { add_object("mound", mesh, around(210.0, 222.0), {}, builder); });
    const Remainder heaps = remainder_of(kPseudoDynamic, MotionClass::kPseudoDynamic, builder);
    add_heaps(heaps, {2.6, 1.7}, kSand, builder, [&](uint64_t number, uint32_t mesh) {
        const double appears_s =
            20.0 + 3100.0 * static_cast<double>(number) / static_cast<double>(heaps.heaps);
        add_object("heap", mesh, around(80.0, 85.0),
                   {appears_s, appears_s + builder.rng.between(60.0, 400.0)}, builder);
    });
    const uint64_t movers = count_classes(builder.scene).objects[static_cast<size_t>(MotionClass::kDynamic)];
    add_crew(static_cast<int>(kDynamic.objects - movers - beds.size()), builder);
    const Remainder loads = remainder_of(kDynamic, MotionClass::kDynamic, builder);
    add_heaps(loads, {1.15, 1.0}, kSand, builder, [&](uint64_t number, uint32_t mesh) {
        add_mover("load", mesh, beds[number].keys, beds[number].presence, builder);
    });
}

}  // namespace
}  // namespace site

TimedScene generate_construction_site(uint64_t seed) {
    using namespace site;
    SceneBuilder builder(seed);
    builder.scene.end_s = kEndS;
    add_surroundings(builder);
    add_old_quarter(builder);
    add_groundworks(builder);
    add_masts(builder);
    add_tower(builder);
    add_podium(builder);
    add_trees(builder);
    add_cranes(builder);
    const auto beds = add_fleet(builder);
    add_crew_and_heaps(beds, builder);
    return std::move(builder.scene);
}

}  // namespace data
