// The `harrier` program: hands the command line to the commands.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>

#include "sim/command_build.h"
#include "sim/command_compare.h"
#include "sim/command_demo.h"
#include "sim/command_fly.h"
#include "sim/command_mesh.h"
#include "sim/command_query.h"
#include "sim/command_still.h"
#include "sim/command_terrain.h"

namespace {

constexpr int kBadInput = 1, kBadUsage = 2;

/// Parses, runs the one command that was named, and turns its outcome into an exit status.
int run(CLI::App& app, const std::function<lod::Result<lod::Ok>()>& command, int count, char** words) {
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kBadUsage;  // --help is no mistake
    }
    const lod::Result<lod::Ok> outcome = command();
    if (outcome) return 0;
    std::fprintf(stderr, "harrier: %s\n", outcome.message().c_str());
    return kBadInput;
}

}  // namespace

int main(int count, char** words) {
    CLI::App app{"Harrier: real terrain, buildings and instruments at a fixed frame rate", "harrier"};
    app.require_subcommand(1);

    sim::DemoArguments demo;
    sim::FlyArguments fly;
    sim::StillArguments still;
    sim::ExtractArguments extract;
    sim::BuildArguments build;
    sim::QueryArguments query;
    sim::CompareArguments compare;
    sim::MeshBuildArguments mesh_build;
    sim::MeshExtractArguments mesh_extract;
    sim::MeshInspectArguments mesh_inspect;
    sim::MeshGenerateArguments mesh_generate;
    CLI::App& demo_app = *app.add_subcommand("demo", "fly the bundled scene, measure, and take pictures");
    CLI::App& fly_app = *app.add_subcommand("fly", "run the loop along a path or a recording");
    CLI::App& still_app = *app.add_subcommand("still", "one picture, converged unless a budget is given");
    CLI::App& terrain_app =
        *app.add_subcommand("terrain", "work on rasters of heights")->require_subcommand(1);
    CLI::App& extract_app = *terrain_app.add_subcommand("extract", "a static mesh with a guaranteed error");
    CLI::App& build_app =
        *terrain_app.add_subcommand("build", "a store that is drawn without being read whole");
    CLI::App& query_app = *terrain_app.add_subcommand("query", "heights of the ground and lines of sight");
    CLI::App& compare_app =
        *terrain_app.add_subcommand("compare", "ROAM and other methods at equal measured errors");
    CLI::App& mesh_app =
        *app.add_subcommand("mesh", "progressive meshes of instruments")->require_subcommand(1);
    CLI::App& mesh_build_app = *mesh_app.add_subcommand("build", "a progressive mesh with proved errors");
    CLI::App& mesh_extract_app = *mesh_app.add_subcommand("extract", "a static mesh of a size or error");
    CLI::App& mesh_generate_app = *mesh_app.add_subcommand("generate", "a meter of a stated size, to try");
    CLI::App& mesh_inspect_app = *mesh_app.add_subcommand("inspect", "what a progressive mesh holds");
    sim::add_demo(demo_app, demo);
    sim::add_fly(fly_app, fly);
    sim::add_still(still_app, still);
    sim::add_extract(extract_app, extract);
    sim::add_build(build_app, build);
    sim::add_query(query_app, query);
    sim::add_compare(compare_app, compare);
    sim::add_mesh_build(mesh_build_app, mesh_build);
    sim::add_mesh_extract(mesh_extract_app, mesh_extract);
    sim::add_mesh_inspect(mesh_inspect_app, mesh_inspect);
    sim::add_mesh_generate(mesh_generate_app, mesh_generate);

    const auto command = [&]() -> lod::Result<lod::Ok> {
        if (demo_app.parsed()) return sim::run_demo(demo);
        if (fly_app.parsed()) return sim::run_fly(fly);
        if (still_app.parsed()) return sim::run_still(still);
        if (build_app.parsed()) return sim::run_build(build);
        if (query_app.parsed()) return sim::run_query(query);
        if (compare_app.parsed()) return sim::run_compare(compare);
        if (mesh_build_app.parsed()) return sim::run_mesh_build(mesh_build);
        if (mesh_extract_app.parsed()) return sim::run_mesh_extract(mesh_extract);
        if (mesh_inspect_app.parsed()) return sim::run_mesh_inspect(mesh_inspect);
        if (mesh_generate_app.parsed()) return sim::run_mesh_generate(mesh_generate);
        return sim::run_extract(extract);
    };
    return run(app, command, count, words);
}
