#include "data/scenes/scene_builder.h"

#include <cmath>
#include <utility>

#include "data/object_plan.h"

namespace data {

Placement operator*(const Placement& outer, const Placement& inner) {
    const double c = std::cos(outer.turn_rad), s = std::sin(outer.turn_rad);
    const glm::dvec3& p = inner.position;
    return {outer.position + glm::dvec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z),
            outer.turn_rad + inner.turn_rad};
}

uint32_t add_mesh(TimedMesh mesh, SceneBuilder& builder) {
    builder.scene.meshes.push_back(std::move(mesh));
    return static_cast<uint32_t>(builder.scene.meshes.size() - 1);
}

KeyFrame key_at(double time_s, const Placement& placement) {
    const double half_rad = placement.turn_rad / 2.0;
    return {time_s, placement.position, glm::dquat(std::cos(half_rad), 0.0, 0.0, std::sin(half_rad))};
}

void add_mover(const std::string& kind, uint32_t mesh, const std::vector<KeyFrame>& keys,
               const Presence& presence, SceneBuilder& builder) {
    ObjectPlan plan{mesh, kind + "-" + std::to_string(builder.scene.objects.size() + 1), {}, keys};
    if (presence.appears_s != Presence::kNever) plan.events.push_back({presence.appears_s, true});
    if (presence.disappears_s != Presence::kNever) plan.events.push_back({presence.disappears_s, false});
    const auto appended = append_object(plan, builder.scene);
    CHECK(appended);
}

void add_object(const std::string& kind, uint32_t mesh, const Placement& placement, const Presence& presence,
                SceneBuilder& builder) {
    add_mover(kind, mesh, {key_at(0.0, placement)}, presence, builder);
}

}  // namespace data
