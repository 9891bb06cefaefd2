// The .hdlod file: a ClusterTree as sealed bytes (lod/base/sealed_bytes.h), its arrays one after the other.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "objects/cluster_tree.h"

namespace objects {

std::vector<unsigned char> encode_tree(const ClusterTree& tree);

/// Fails with "what; expected what", without the file's name, on anything but a whole file of this version that holds a
/// tree without fault.
lod::Result<ClusterTree> decode_tree(std::span<const unsigned char> bytes);

/// The first thing wrong with a tree: an index that leads outside, a child before its parent, a number that is not
/// finite, a visibility outside 0 … 1. Empty: whoever reads the tree meets nothing undefined.
std::string fault_of(const ClusterTree& tree);

}  // namespace objects
