// Paths for files of a single test: tests run side by side, in processes of their own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace test {

/// A path in the folder for temporary files that no other test uses.
inline std::string own_path(const std::string& name) {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    std::string test = std::string(info->test_suite_name()) + "_" + info->name();
    std::replace(test.begin(), test.end(), '/', '_');
    return testing::TempDir() + test + "_" + name;
}

}  // namespace test
