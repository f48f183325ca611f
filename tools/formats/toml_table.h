#pragma once
// SPDX-License-Identifier: MIT
// A table of a TOML file, read key by key. Each getter checks its value's type and range. A key that no getter asked
// for is unknown. Errors are InputErrors "FILE:LINE: the.whole.key: cause; what to do".
// Knows no keys of its own.

#include <toml++/toml.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace swivel::formats {

// A value, and its line and key in the file.
template <class T>
struct Given {
    T value{};
    std::size_t line = 0;
    std::string key{};      // the whole key, such as limb.arms.reach.soft_far
    bool mirrored = false;  // written for the body's other side
};
template <class T>
using Maybe = std::optional<Given<T>>;

struct NumberRange {
    double min = 0, max = 0;
};

// Parses a file. Throws InputError for a file that is no TOML, too large, nested too deep, or not readable.
toml::table read_toml(const std::filesystem::path& path);

class TomlTable {
public:
    // Both must outlive this.
    TomlTable(const std::filesystem::path& path, const toml::table& root);

    // Each returns the value of a key, or nothing if it is missing. They throw InputError for another type, and for
    // values outside of the given range, whose ends are allowed.
    Maybe<bool> flag(std::string_view key);
    Maybe<std::int64_t> whole(std::string_view key, std::int64_t min, std::int64_t max);
    Maybe<double> number(std::string_view key, double min, double max);  // whole numbers will do, too
    Maybe<std::string> text(std::string_view key);
    Maybe<std::vector<std::string>> texts(std::string_view key, std::size_t count);
    Maybe<std::size_t> word(std::string_view key, std::span<const std::string_view> words);  // which of them
    // [min, max], min <= max and no wider than widest.
    Maybe<NumberRange> range(std::string_view key, double min, double max, double widest);
    Maybe<Eigen::Vector3d> vector(std::string_view key);  // of a length up to 1e15
    Maybe<Eigen::Vector3d> axis(std::string_view key);    // the same, made unit; zero is refused

    Maybe<std::vector<Eigen::Vector3d>> vectors(std::string_view key);  // a list of them, of any number

    // Whether the key is there, has true or false, or a list.
    bool has(std::string_view key) const { return table_ && table_->contains(key); }
    bool is_flag(std::string_view key) const { return table_ && table_->get(key) && table_->get(key)->is_boolean(); }
    bool is_list(std::string_view key) const { return table_ && table_->get(key) && table_->get(key)->is_array(); }

    // An inner table; empty if it is missing, so that its keys can be asked for all the same.
    TomlTable table(std::string_view key);
    // The tables of a list, such as [{...}, {...}]; none if it is missing.
    std::vector<TomlTable> tables(std::string_view key);
    bool is_there() const { return line_ > 0; }
    std::size_t line() const { return line_; }
    const std::string& key() const { return key_; }

    // Throws InputError for the first key in the file that was not asked for, and names a known one that looks like it.
    void finish() const;

    // Throws InputError about a key of this table, or about the table itself where the key is empty.
    [[noreturn]] void fail(std::string_view key, std::string_view cause) const;

private:
    TomlTable() = default;
    const toml::node* find(std::string_view key);
    std::string whole_key(std::string_view key) const;
    std::size_t line_of(std::string_view key) const;
    [[noreturn]] void fail_type(std::string_view key, const toml::node& node, std::string_view wanted) const;
    double number_of(std::string_view key, const toml::node& node, std::string_view wanted) const;
    template <class Number>
    void require_within(std::string_view key, Number value, Number min, Number max, std::string_view wanted) const;
    const toml::array& array_of(std::string_view key, const toml::node& node, std::size_t count,
                                std::string_view wanted) const;
    Eigen::Vector3d vector_of(std::string_view key, const toml::node& node, std::string_view wanted) const;
    TomlTable inner(std::string key, const toml::node* node) const;
    std::vector<double> numbers_of(std::string_view key, const toml::node& node, std::size_t count,
                                   std::string_view wanted) const;
    template <class T>
    Given<T> given(std::string_view key, T value) const
    {
        return {std::move(value), line_of(key), whole_key(key)};
    }

    const std::filesystem::path* path_ = nullptr;
    const toml::table* table_ = nullptr;  // null: not there
    std::vector<std::string> known_;
    std::string key_;
    std::size_t line_ = 0;
};

}  // namespace swivel::formats
