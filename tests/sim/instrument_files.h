// The real instruments beside the project: n-gons, open borders, duplicate faces, unwelded and non-manifold parts.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace sim_test {

inline const std::string kInstrumentFolder = HARRIER_SOURCE_DIR "/../shared/data/instruments";

/// Paths in order; of one aircraft's many only two. Empty: the folder is not there.
inline std::vector<std::string> instrument_files() {
    std::vector<std::string> files;
    if (!std::filesystem::exists(kInstrumentFolder)) return files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kInstrumentFolder)) {
        const std::string path = entry.path().string();
        const bool is_model = path.ends_with(".ac") || path.ends_with(".STL") || path.ends_with(".stl.gz");
        const bool is_one_of_many = path.find("Panel_Instruments") != std::string::npos &&
                                    !path.ends_with("oat.ac") && !path.ends_with("hobbs.ac");
        if (is_model && !is_one_of_many) files.push_back(path);
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace sim_test
