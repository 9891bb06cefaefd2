// A folder of a test's own that goes away, and scenes compared object by object.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "data/scene_time.h"

namespace data {

class TimedFolder : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("harrier_timed_" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, std::string_view bytes) {
        const std::string path = (folder_ / name).string();
        std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return path;
    }

    std::filesystem::path folder_;
};

inline std::string shared_data(const std::string& name) {
    return HARRIER_SOURCE_DIR "/../shared/data/" + name;
}

}  // namespace data
