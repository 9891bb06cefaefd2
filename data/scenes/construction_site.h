// A skyscraper under construction: the scene of the paper by its counts, two years of building in an hour.
//
//   static          498 objects,   66,784 triangles   ground, roads, neighbourhood
//   pseudo-dynamic  40,010        2,879,506           57 storeys with formwork, frame, facade, fit-out; an
//                                                     old quarter that is pulled down; pit, podium, masts, trees
//   dynamic         15,649        1,313,767           four cranes and what they lift, 480 vehicles, people; each
//                                                     is there while it has something to do
//
// Counts: Semenov, Shutkin, Zolotov et al., Visualization of large scenes with deterministic dynamics (2020), table 1.
#pragma once

#include <cstdint>

#include "data/timed_scene.h"

namespace data {

/// The counts above, exactly, for every seed; equal parts share a mesh. Ground at z = 0, the tower at the origin,
/// 228 m high and its spire 48 more at the end; T = 3,600 s. Erection follows a Hilbert curve through each storey, trade after trade.
/// The same for equal seeds on every machine but for the last bits of sine and cosine.
TimedScene generate_construction_site(uint64_t seed);

}  // namespace data
