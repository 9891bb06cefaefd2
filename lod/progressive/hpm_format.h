// The .hpm file: a ProgressiveModel as bytes.
//
//     preamble    sealed_bytes.h: name HarrierM, version 1
//     model       file_from_model, nodes, parts; a part: node, glass, report, the hierarchy's arrays
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lod/base/result.h"
#include "lod/progressive/progressive_model.h"

namespace lod {

std::vector<unsigned char> encode_hpm(const ProgressiveModel& model);

/// Fails with "what; expected what", without the file's name, on anything but a whole file of this version with valid
/// hierarchies (hierarchy_check.h). Never allocates more than the bytes it was given can fill.
Result<ProgressiveModel> decode_hpm(std::span<const unsigned char> bytes);

}  // namespace lod
