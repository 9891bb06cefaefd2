// TomlTable: takes the keys of one TOML table one by one; what nobody took is an error.
//
// The first problem found is kept, with file and line, and everything after it is ignored: a reader states
// what it wants in a row of calls and looks once at the end.
#pragma once

#include <glm/glm.hpp>
#include <set>
#include <string>
#include <toml.hpp>
#include <vector>

namespace sim {

/// Where a file is read and what was wrong with it first.
struct TomlProblem {
    std::string file;
    std::string message;  ///< one line, "file:line: what, expected"; empty while all is well

    /// Notes a problem unless there is one already.
    void note(const toml::value& at, const std::string& what);
};

/// Inclusive bounds of a number.
struct NumberRange {
    double min = -1e300;
    double max = 1e300;
};

/// One table while it is being read. The value and the problem must outlive it.
class TomlTable {
  public:
    /// @param name  as the user wrote it, e.g. "[terrain]"; in messages
    TomlTable(const toml::value& table, std::string name, TomlProblem& problem);

    bool has(const std::string& key) const { return find(key) != nullptr; }

    /// Each of these takes `key` and sets `out` when the key is there and of the right kind.
    void take(const std::string& key, std::string& out);
    void take(const std::string& key, std::vector<std::string>& out);  ///< not empty
    void take(const std::string& key, double& out, NumberRange range = {});
    /// An array of `least` to `most` numbers.
    void take(const std::string& key, std::vector<double>& out, size_t least, size_t most);
    /// An array of such arrays.
    void take(const std::string& key, std::vector<std::vector<double>>& out, size_t least, size_t most);
    /// One of a few words; sets the word's index.
    void take_word(const std::string& key, const std::vector<std::string>& words, size_t& index);

    /// Takes a sub-table or an array of tables; null or empty when it is absent.
    const toml::value* take_table(const std::string& key);
    std::vector<const toml::value*> take_tables(const std::string& key);

    /// Notes an error when the key is absent.
    void require(const std::string& key);
    /// Notes an error about the value of `key`, or about the table when it is absent.
    void reject(const std::string& key, const std::string& what);
    /// Notes an error when some key was not taken: the one on the earliest line.
    void finish();

    /// All keys with string values, for tables that name things; everything is taken.
    std::vector<std::pair<std::string, std::string>> take_all_strings();

    int line() const { return static_cast<int>(table_.location().line()); }

  private:
    const toml::value* find(const std::string& key) const;
    const toml::value* take_value(const std::string& key);
    bool read_number(const toml::value& value, const std::string& what, double& out);
    bool read_numbers(const toml::value& value, const std::string& what, std::vector<double>& out);

    const toml::value& table_;
    std::string name_;
    TomlProblem& problem_;
    std::set<std::string> taken_;
};

}  // namespace sim
