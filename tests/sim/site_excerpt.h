// The lower storeys of the construction site, an eighth of its movers and all that stands around: few enough to be built in
// a test.
#pragma once

#include "data/scene_time.h"
#include "data/scenes/construction_site.h"

namespace sim_test {

inline data::TimedScene site_excerpt() {
    constexpr double kTower_m = 45.0, kUpTo_m = 12.0;  // around the tower's axis, above the ground
    constexpr size_t kRun = 256, kEvery = 8;           // vehicles stay whole: parts lie side by side
    data::TimedScene scene = data::generate_construction_site(1);
    std::vector<data::TimedObject> kept;
    for (size_t i = 0; i < scene.objects.size(); ++i) {
        const data::TimedObject& object = scene.objects[i];
        const glm::dvec3 at = scene.keys[object.keys.begin].position;
        const data::MotionClass motion_class = data::motion_class(scene, object);
        const bool is_of_tower = std::abs(at.x) < kTower_m && std::abs(at.y) < kTower_m;
        const bool is_kept = motion_class == data::MotionClass::kDynamic ? i / kRun % kEvery == 0
                                                                         : !is_of_tower || at.z < kUpTo_m;
        if (is_kept) kept.push_back(object);
    }
    scene.objects = std::move(kept);
    return scene;
}

}  // namespace sim_test
