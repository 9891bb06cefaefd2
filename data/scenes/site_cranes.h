// The four tower cranes: they grow with the tower and lift every rack of its yards up to it.
#pragma once

#include "data/scenes/scene_builder.h"

namespace data::site {

constexpr int kCranes = 4;
constexpr int kMastSections = 46;
constexpr double kSectionM = 6.0;

/// Where a crane's mast begins, on the pit's floor.
glm::dvec3 mast_foot(int crane);

/// A mast grows from above; its last sections leave first.
double mast_section_appears_s(int crane, int section);
double mast_section_disappears_s(int section);

/// Jibs, trolleys, hooks and ropes, and the racks of parts they lift.
void add_cranes(SceneBuilder& builder);

}  // namespace data::site
