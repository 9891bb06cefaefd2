// Cluster files on disk: read whole and checked, written whole or not at all.
#pragma once

#include <string>

#include "lod/base/result.h"
#include "objects/cluster_tree.h"

namespace sim {

/// Fails with one line that begins with the path.
lod::Result<objects::ClusterTree> read_cluster_file(const std::string& path);

/// @returns the file's size, bytes
lod::Result<uint64_t> write_cluster_file(const std::string& path, const objects::ClusterTree& tree);

}  // namespace sim
