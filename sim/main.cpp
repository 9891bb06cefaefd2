// The `harrier` program: hands the command line to the commands.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

#include "sim/command_build.h"
#include "sim/command_clusters.h"
#include "sim/command_compare.h"
#include "sim/command_demo.h"
#include "sim/command_fly.h"
#include "sim/command_generate.h"
#include "sim/command_mesh.h"
#include "sim/command_objects_compare.h"
#include "sim/command_query.h"
#include "sim/command_still.h"
#include "sim/command_terrain.h"

namespace {

constexpr int kBadInput = 1, kBadUsage = 2;

/// What any command may be told.
struct Arguments {
    sim::DemoArguments demo;
    sim::FlyArguments fly;
    sim::StillArguments still;
    sim::ExtractArguments terrain_extract;
    sim::BuildArguments terrain_build;
    sim::QueryArguments terrain_query;
    sim::CompareArguments terrain_compare;
    sim::GenerateArguments objects_generate;
    sim::ConvertArguments objects_convert;
    sim::ClustersBuildArguments objects_build;
    sim::ClustersInspectArguments objects_inspect;
    sim::ObjectsCompareArguments objects_compare;
    sim::MeshBuildArguments mesh_build;
    sim::MeshExtractArguments mesh_extract;
    sim::MeshInspectArguments mesh_inspect;
    sim::MeshGenerateArguments mesh_generate;
};

/// A command and what runs it.
struct Command {
    CLI::App* app;
    lod::Result<lod::Ok> (*run)(const Arguments&);
};

/// The commands of the program, as they are declared.
struct Commands {
    Arguments arguments;
    std::vector<Command> all;

    /// Member: of Arguments. Declare: adds its options. Run: does it.
    template <auto Member, auto Declare, auto Run>
    void add(CLI::App& group, const char* name, const char* what) {
        CLI::App* app = group.add_subcommand(name, what);
        Declare(*app, arguments.*Member);
        all.push_back({app, [](const Arguments& told) { return Run(told.*Member); }});
    }
};

CLI::App& add_group(CLI::App& app, const char* name, const char* what) {
    return *app.add_subcommand(name, what)->require_subcommand(1);
}

void declare(CLI::App& app, Commands& commands) {
    using A = Arguments;
    commands.add<&A::demo, sim::add_demo, sim::run_demo>(app, "demo",
                                                         "fly the bundled scene, measure, and take pictures");
    commands.add<&A::fly, sim::add_fly, sim::run_fly>(app, "fly", "run the loop along a path or a recording");
    commands.add<&A::still, sim::add_still, sim::run_still>(
        app, "still", "one picture, converged unless a budget is given");

    CLI::App& terrain = add_group(app, "terrain", "work on rasters of heights");
    commands.add<&A::terrain_extract, sim::add_extract, sim::run_extract>(
        terrain, "extract", "a static mesh with a guaranteed error");
    commands.add<&A::terrain_build, sim::add_build, sim::run_build>(
        terrain, "build", "a store that is drawn without being read whole");
    commands.add<&A::terrain_query, sim::add_query, sim::run_query>(
        terrain, "query", "heights of the ground and lines of sight");
    commands.add<&A::terrain_compare, sim::add_compare, sim::run_compare>(
        terrain, "compare", "ROAM and other methods at equal measured errors");

    CLI::App& objects = add_group(app, "objects", "work on scenes whose objects come, go and move");
    commands.add<&A::objects_generate, sim::add_generate, sim::run_generate>(
        objects, "generate", "a scene by seed, as GLB with a schedule, or FBX");
    commands.add<&A::objects_convert, sim::add_convert, sim::run_convert>(
        objects, "convert", "a model or city with its schedule, as GLB with a schedule, or FBX");
    commands.add<&A::objects_build, sim::add_clusters_build, sim::run_clusters_build>(
        objects, "build", "hierarchical levels of detail of a timed scene");
    commands.add<&A::objects_inspect, sim::add_clusters_inspect, sim::run_clusters_inspect>(
        objects, "inspect", "what a cluster file holds");
    commands.add<&A::objects_compare, sim::add_objects_compare, sim::run_objects_compare>(
        objects, "compare", "frame times with and without levels of detail");

    CLI::App& mesh = add_group(app, "mesh", "progressive meshes of instruments");
    commands.add<&A::mesh_build, sim::add_mesh_build, sim::run_mesh_build>(
        mesh, "build", "a progressive mesh with proved errors");
    commands.add<&A::mesh_extract, sim::add_mesh_extract, sim::run_mesh_extract>(
        mesh, "extract", "a static mesh of a size or error");
    commands.add<&A::mesh_inspect, sim::add_mesh_inspect, sim::run_mesh_inspect>(
        mesh, "inspect", "what a progressive mesh holds");
    commands.add<&A::mesh_generate, sim::add_mesh_generate, sim::run_mesh_generate>(
        mesh, "generate", "a meter of a stated size, to try");
}

/// Runs the one command that was parsed.
lod::Result<lod::Ok> run_parsed(const Commands& commands) {
    for (const Command& command : commands.all) {
        if (command.app->parsed()) return command.run(commands.arguments);
    }
    return lod::Ok{};  // not reached: a command is required
}

}  // namespace

int main(int count, char** words) {
    CLI::App app{"Harrier: real terrain, buildings and instruments at a fixed frame rate", "harrier"};
    app.require_subcommand(1);
    Commands commands;
    declare(app, commands);
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kBadUsage;  // --help is no mistake
    }
    const lod::Result<lod::Ok> outcome = run_parsed(commands);
    if (outcome) return 0;
    std::fprintf(stderr, "harrier: %s\n", outcome.message().c_str());
    return kBadInput;
}
