// `harrier objects build` and `inspect`: hierarchical dynamic levels of detail of a timed scene, as a file.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "lod/base/result.h"
#include "objects/clustering/build_options.h"

namespace sim {

struct ClustersBuildArguments {
    std::string source;    ///< what objects::read_timed_scene reads; empty: the paper's scene
    std::string schedule;  ///< empty: beside the source, if there is one
    bool is_paper_scene = false;
    std::vector<std::string> terrain;  ///< rasters that buildings stand on; empty: the ground is at height 0
    std::string out;
    objects::BuildOptions options;
    unsigned threads = 2;
};

void add_clusters_build(CLI::App& app, ClustersBuildArguments& arguments);

/// Writes the file and prints what `inspect` prints; progress on stderr.
lod::Result<lod::Ok> run_clusters_build(const ClustersBuildArguments& arguments);

struct ClustersInspectArguments {
    std::string file;
};

void add_clusters_inspect(CLI::App& app, ClustersInspectArguments& arguments);

/// Prints one line of JSON: leaves and triangles by class (an object that rests between moves is several leaves), clusters and errors by level, sizes.
lod::Result<lod::Ok> run_clusters_inspect(const ClustersInspectArguments& arguments);

}  // namespace sim
