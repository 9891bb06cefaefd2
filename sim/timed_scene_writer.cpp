#include "sim/timed_scene_writer.h"

#include <filesystem>
#include <string_view>

#include "data/schedule_csv.h"
#include "data/timed_fbx.h"
#include "data/timed_glb.h"
#include "sim/whole_file.h"

namespace sim {

lod::Result<std::vector<std::string>> timed_scene_files(const std::string& out) {
    const std::filesystem::path path(out);
    const std::string extension = path.extension().string();
    if (extension.empty()) return std::vector{(path / "scene.glb").string(), (path / "scene.csv").string()};
    if (extension == ".fbx") return std::vector{out};
    if (extension == ".glb")
        return std::vector{out, std::filesystem::path(out).replace_extension(".csv").string()};
    return lod::Error{out + ": cannot be written as '" + extension +
                      "', expected a folder or a name that ends in .glb or .fbx"};
}

lod::Result<lod::Ok> write_timed_scene(const data::TimedScene& scene, const std::string& out) {
    const auto files = timed_scene_files(out);
    if (!files) return files.error();
    if (std::filesystem::path(out).extension().empty()) {
        if (auto made = make_folder(out); !made) return made.error();
    }
    if (files->size() == 1) {
        const auto fbx = data::timed_fbx_bytes(scene);
        if (!fbx) return lod::Error{out + ": " + fbx.message()};
        return write_whole(out, *fbx);
    }
    const std::vector<char> glb = data::timed_glb_bytes(scene);
    if (auto written = write_whole((*files)[0], std::string_view(glb.data(), glb.size())); !written)
        return written.error();
    return write_whole((*files)[1], data::schedule_csv(scene));
}

}  // namespace sim
