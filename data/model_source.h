// A model file as Assimp understands it: unpacked, refused where it is cut short, faces as the file has them.
#pragma once

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "lod/base/result.h"

namespace data {

/// An open model. The scene belongs to the importer.
struct ModelSource {
    std::unique_ptr<Assimp::Importer> importer;
    const aiScene* scene = nullptr;  ///< no post-processing yet; indices in range, coordinates finite
    std::string extension;           ///< lower case, without dot and without .gz
    /// What was added to the vertices of the nodes' meshes and belongs to the nodes' transforms (data/ac3d_places.h),
    /// by node, depth first; empty where nothing was.
    std::vector<glm::dvec3> node_shifts;
    std::vector<std::string> missing_libraries;  ///< of an OBJ: material files that are named and not there
};

/// Opens `path`; `.gz` is unpacked in memory (4 GiB at the most), then neighbouring files are not found.
/// Fails on unreadable, truncated or inconsistent files and on coordinates that are not finite.
lod::Result<ModelSource> open_model(const std::string& path);

}  // namespace data
