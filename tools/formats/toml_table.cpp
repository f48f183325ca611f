// SPDX-License-Identifier: MIT
#include "tools/formats/toml_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/formats/bvh.h"
#include "tools/formats/error.h"
#include "tools/formats/limits.h"
#include "tools/formats/printable.h"
#include "tools/formats/suggestion.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

constexpr std::size_t kMaxBytes = 1'000'000, kMaxDots = 64;  // in a file, in a line

// By toml::node_type.
constexpr std::array kTypeNames = {"nothing",  "a table",       "a list",         "text",           "a whole number",
                                   "a number", "true or false", "a date or time", "a date or time", "a date or time"};

// The parser recurses for each part of a dotted key. Dots in texts and comments count, too, because only the parser can
// tell them apart. Adjacent dots, which no key has, count once, so that dotted rules may be drawn.
void require_flat(const std::filesystem::path& path, std::string_view text)
{
    std::size_t line = 1, dots = 0;
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (text[n] == '\n') ++line, dots = 0;
        if (text[n] == '.' && (n == 0 || text[n - 1] != '.')) ++dots;
        if (dots > kMaxDots)
            throw InputError(path, line,
                             fmt::format("the line has more than {} dots; no key has so many parts", kMaxDots));
    }
}

}  // namespace

toml::table read_toml(const std::filesystem::path& path)
{
    const std::string text = read_text(path);
    if (is_bvh_text(text))
        throw InputError(path, "is a BVH file, and a TOML file is needed here; give the clip as FILE");
    if (text.size() > kMaxBytes)
        throw InputError(path, fmt::format("has {} bytes; a file of settings has at most {}", text.size(), kMaxBytes));
    require_flat(path, text);
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        throw InputError(path, error.source().begin.line,
                         fmt::format("column {}: is no TOML: {}", error.source().begin.column,
                                     printable(error.description(), kMaxQuoted)));
    }
}

TomlTable::TomlTable(const std::filesystem::path& path, const toml::table& root) : path_(&path), table_(&root), line_(1)
{
}

std::string TomlTable::whole_key(std::string_view key) const
{
    if (key.empty() || key_.empty()) return key_ + std::string(key);
    return fmt::format("{}.{}", key_, key);
}

std::size_t TomlTable::line_of(std::string_view key) const
{
    const toml::node* const node = table_ && !key.empty() ? table_->get(key) : nullptr;
    return node ? node->source().begin.line : line_;
}

void TomlTable::fail(std::string_view key, std::string_view cause) const
{
    throw InputError(*path_, line_of(key), fmt::format("{}: {}", printable(whole_key(key), 120), cause));
}

void TomlTable::fail_type(std::string_view key, const toml::node& node, std::string_view wanted) const
{
    fail(key, fmt::format("is {}; write {}", kTypeNames[static_cast<std::size_t>(node.type())], wanted));
}

const toml::node* TomlTable::find(std::string_view key)
{
    known_.emplace_back(key);
    return table_ ? table_->get(key) : nullptr;
}

Maybe<bool> TomlTable::flag(std::string_view key)
{
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    if (!node->is_boolean()) fail_type(key, *node, "true or false");
    return given(key, node->as_boolean()->get());
}

template <class Number>
void TomlTable::require_within(std::string_view key, Number value, Number min, Number max,
                               std::string_view wanted) const
{
    if (value < min) fail(key, fmt::format("{} is less than {}; write {}", value, min, wanted));
    if (value > max) fail(key, fmt::format("{} is more than {}; write {}", value, max, wanted));
}

Maybe<std::int64_t> TomlTable::whole(std::string_view key, std::int64_t min, std::int64_t max)
{
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    const std::string wanted = fmt::format("a whole number from {} to {}", min, max);
    if (!node->is_integer()) fail_type(key, *node, wanted);
    require_within(key, node->as_integer()->get(), min, max, wanted);
    return given(key, node->as_integer()->get());
}

double TomlTable::number_of(std::string_view key, const toml::node& node, std::string_view wanted) const
{
    if (!node.is_number()) fail_type(key, node, wanted);
    const double value = *node.value<double>();
    if (!std::isfinite(value)) fail(key, fmt::format("{} is not finite; write {}", value, wanted));
    return value;
}

const toml::array& TomlTable::array_of(std::string_view key, const toml::node& node, std::size_t count,
                                       std::string_view wanted) const
{
    const toml::array* const array = node.as_array();
    if (!array) fail_type(key, node, wanted);
    if (array->size() != count) fail(key, fmt::format("has {} values; write {}", array->size(), wanted));
    return *array;
}

std::vector<double> TomlTable::numbers_of(std::string_view key, const toml::node& node, std::size_t count,
                                          std::string_view wanted) const
{
    std::vector<double> values;
    for (const toml::node& each : array_of(key, node, count, wanted)) values.push_back(number_of(key, each, wanted));
    return values;
}

Maybe<double> TomlTable::number(std::string_view key, double min, double max)
{
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    const std::string wanted = fmt::format("a number from {} to {}", min, max);
    const double value = number_of(key, *node, wanted);
    require_within(key, value, min, max, wanted);
    return given(key, value);
}

Maybe<std::string> TomlTable::text(std::string_view key)
{
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    if (!node->is_string()) fail_type(key, *node, "text in quotes");
    if (node->as_string()->get().empty()) fail(key, "is empty; write text in quotes, or leave the key out");
    return given(key, node->as_string()->get());
}

Maybe<std::vector<std::string>> TomlTable::texts(std::string_view key, std::size_t count)
{
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    const std::string wanted = fmt::format("a list of {} texts in quotes", count);
    std::vector<std::string> values;
    for (const toml::node& each : array_of(key, *node, count, wanted)) {
        if (!each.is_string()) fail_type(key, each, wanted);
        values.push_back(each.as_string()->get());
    }
    return given(key, std::move(values));
}

Maybe<std::size_t> TomlTable::word(std::string_view key, std::span<const std::string_view> words)
{
    const Maybe<std::string> value = text(key);
    if (!value) return std::nullopt;
    const auto found = std::find(words.begin(), words.end(), value->value);
    if (found != words.end()) return given(key, static_cast<std::size_t>(found - words.begin()));
    const std::vector<std::string> known(words.begin(), words.end());
    fail(key, fmt::format("there is no '{}'; {}", printable(value->value), suggestion(value->value, known)));
}

Maybe<NumberRange> TomlTable::range(std::string_view key, double min, double max, double widest)
{
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    const std::string wanted = fmt::format("[least, most], two numbers from {} to {}", min, max);
    const std::vector<double> ends = numbers_of(key, *node, 2, wanted);
    for (const double end : ends) require_within(key, end, min, max, wanted);
    if (ends[0] > ends[1])
        fail(key, fmt::format("the least, {}, is more than the most, {}; write {}", ends[0], ends[1], wanted));
    if (ends[1] - ends[0] > widest)
        fail(key, fmt::format("{} to {} is wider than {}; leave the key out for no limit", ends[0], ends[1], widest));
    return given(key, NumberRange{ends[0], ends[1]});
}

Eigen::Vector3d TomlTable::vector_of(std::string_view key, const toml::node& node, std::string_view wanted) const
{
    const std::vector<double> xyz = numbers_of(key, node, 3, wanted);
    const double length = std::hypot(xyz[0], xyz[1], xyz[2]);
    if (!(length <= kMaxNorm)) fail(key, fmt::format("is {:g} long; at most {:g} can be solved", length, kMaxNorm));
    return {xyz[0], xyz[1], xyz[2]};
}

Maybe<Eigen::Vector3d> TomlTable::vector(std::string_view key)
{
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    return given(key, vector_of(key, *node, "[x, y, z], three numbers"));
}

Maybe<std::vector<Eigen::Vector3d>> TomlTable::vectors(std::string_view key)
{
    const toml::node* const node = find(key);
    if (!node) return std::nullopt;
    constexpr std::string_view kWanted = "a list of [x, y, z], three numbers each";
    if (!node->is_array()) fail_type(key, *node, kWanted);
    std::vector<Eigen::Vector3d> values;
    for (const toml::node& each : *node->as_array()) values.push_back(vector_of(key, each, kWanted));
    return given(key, std::move(values));
}

Maybe<Eigen::Vector3d> TomlTable::axis(std::string_view key)
{
    Maybe<Eigen::Vector3d> value = vector(key);
    if (!value) return std::nullopt;
    const double length = value->value.stableNorm();
    if (!(length > 1e-15)) fail(key, "has no length, so no direction; write [x, y, z], not all of them 0");
    value->value /= length;
    return value;
}

TomlTable TomlTable::table(std::string_view key)
{
    const toml::node* const node = find(key);
    if (node && !node->is_table()) fail_type(key, *node, fmt::format("a table, [{}]", whole_key(key)));
    return inner(whole_key(key), node);
}

std::vector<TomlTable> TomlTable::tables(std::string_view key)
{
    const toml::node* const node = find(key);
    std::vector<TomlTable> all;
    if (!node) return all;
    constexpr std::string_view kWanted = "a list of tables, [{...}, {...}]";
    if (!node->is_array()) fail_type(key, *node, kWanted);
    for (const toml::node& each : *node->as_array()) {
        if (!each.is_table()) fail_type(key, each, kWanted);
        all.push_back(inner(fmt::format("{}[{}]", whole_key(key), all.size()), &each));
    }
    return all;
}

// node: null where it is not there.
TomlTable TomlTable::inner(std::string key, const toml::node* node) const
{
    TomlTable inner;
    inner.path_ = path_;
    inner.key_ = std::move(key);
    if (node) {
        inner.table_ = node->as_table();
        inner.line_ = std::max<std::size_t>(node->source().begin.line, 1);
    }
    return inner;
}

void TomlTable::finish() const
{
    if (!table_) return;
    const toml::key* first = nullptr;
    for (const auto& [key, node] : *table_)
        if (std::find(known_.begin(), known_.end(), key.str()) == known_.end() &&
            (!first || key.source().begin.line < first->source().begin.line))
            first = &key;
    if (!first) return;
    throw InputError(
        *path_, first->source().begin.line,
        fmt::format("{}: unknown key; {}", printable(whole_key(first->str()), 120), suggestion(first->str(), known_)));
}

}  // namespace swivel::formats
