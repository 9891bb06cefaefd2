// Cutting files down and reading what is left.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace test {

/// What came of it: cut at which lengths the file was read nevertheless, longest first.
struct CutOutcome {
    std::vector<size_t> read_at;
    size_t refused = 0;
};

/// Cuts a file down, longest first, at every multiple of `step_bytes` that is shorter than the file. After each cut
/// calls `read`, which returns the message of a refusal: one line that says what was expected and names `name`.
inline CutOutcome cut_down(const std::string& path, const std::string& name,
                           const std::function<std::optional<std::string>()>& read,
                           size_t step_bytes = 1024) {
    CutOutcome outcome;
    const size_t whole = std::filesystem::file_size(path);
    for (size_t steps = (whole + step_bytes - 1) / step_bytes; steps-- > 0;) {
        const size_t length = steps * step_bytes;
        std::filesystem::resize_file(path, length);
        const std::optional<std::string> message = read();
        if (!message) {
            outcome.read_at.push_back(length);
            continue;
        }
        ++outcome.refused;
        EXPECT_NE(message->find(name), std::string::npos) << length << ": " << *message;
        EXPECT_NE(message->find("expected"), std::string::npos) << length << ": " << *message;
        EXPECT_EQ(message->find('\n'), std::string::npos) << length << ": " << *message;
        if (message->find(name) == std::string::npos) break;  // so would all the others
    }
    EXPECT_EQ(outcome.refused + outcome.read_at.size(), (whole + step_bytes - 1) / step_bytes);
    return outcome;
}

/// An empty folder of its own for a test; gone with the scope.
class CutFolder {
  public:
    CutFolder() {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::path(testing::TempDir()) /
                ("harrier_cut_" + std::string(info->test_suite_name()) + "_" + info->name());
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~CutFolder() { std::filesystem::remove_all(path_); }
    CutFolder(const CutFolder&) = delete;
    CutFolder& operator=(const CutFolder&) = delete;

    std::string file(const std::string& name) const { return (path_ / name).string(); }
    /// Copies a file here, writable. @returns its path
    std::string copy(const std::filesystem::path& from) const {
        const std::string to = file(from.filename().string());
        std::filesystem::copy_file(from, to, std::filesystem::copy_options::overwrite_existing);
        std::filesystem::permissions(to, std::filesystem::perms::owner_write,
                                     std::filesystem::perm_options::add);
        return to;
    }

  private:
    std::filesystem::path path_;
};

}  // namespace test
