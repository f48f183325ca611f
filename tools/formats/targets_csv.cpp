// SPDX-License-Identifier: MIT
#include "tools/formats/targets_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>

#include "tools/formats/csv_rows.h"
#include "tools/formats/error.h"
#include "tools/formats/limits.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace fs = std::filesystem;
namespace {

constexpr unsigned kColumnCount = 14;
constexpr unsigned kLimb = 2, kSide = 13;  // side: what tables of arms had instead of limb
constexpr std::array<std::string_view, kColumnCount> kColumns = {
    "frame", "character", "limb", "x", "y", "z", "pole_x", "pole_y", "pole_z", "qx", "qy", "qz", "qw", "side"};
// Columns that belong together. A table has all or none of an optional group, and so has a row.
struct Part {
    unsigned first, count;
    bool is_optional;
};
constexpr Part kPlace = {0, 6, false}, kPole = {6, 3, true}, kOrientation = {9, 4, true};
constexpr std::string_view kColumnList =
    "frame,character,limb,x,y,z, all or none of pole_x,pole_y,pole_z, and all or none of qx,qy,qz,qw";
constexpr double kMinNorm = 1 / kMaxNorm;

// The values of one line; empty for columns the file does not have.
struct Row {
    const fs::path& path;
    std::size_t line = 0;
    bool has_side = false;  // the column side in place of limb
    std::array<std::string_view, kColumnCount> cell;
};

[[noreturn]] void fail(const Row& row, unsigned column, std::string_view problem)
{
    const std::string_view cell = row.cell[column];
    throw InputError(row.path, row.line,
                     cell.empty() ? fmt::format("column {} is empty", kColumns[column])
                                  : fmt::format("column {}: '{}' {}", kColumns[column], printable(cell), problem));
}

std::uint32_t index_at(const Row& row, unsigned column)
{
    const std::optional<std::int64_t> index = parse_integer(row.cell[column]);
    if (!index || *index < 0 || *index > std::numeric_limits<std::uint32_t>::max()) {
        fail(row, column, "is not a whole number from 0 to 4294967295");
    }
    return static_cast<std::uint32_t>(*index);
}

double number_at(const Row& row, unsigned column)
{
    const std::optional<double> number = parse_number(row.cell[column]);
    if (!number) fail(row, column, "is not a finite decimal number");
    return *number;
}

LimbName limb_at(const Row& row)
{
    if (row.has_side) {
        const std::string_view side = row.cell[kSide];
        if (side == side_name(Side::left)) return {LimbKind::arm, Side::left};
        if (side == side_name(Side::right)) return {LimbKind::arm, Side::right};
        fail(row, kSide, "is neither left nor right");
    }
    const std::optional<LimbName> name = limb_of_word(row.cell[kLimb]);
    if (!name) fail(row, kLimb, "is none of left_arm, right_arm, left_leg and right_leg");
    return *name;
}

Eigen::Vector3d point_at(const Row& row, unsigned column)
{
    return {number_at(row, column), number_at(row, column + 1), number_at(row, column + 2)};
}

bool has_part(const Row& row, Part part)
{
    const auto first = row.cell.begin() + part.first;
    return std::any_of(first, first + part.count, [](std::string_view cell) { return !cell.empty(); });
}

Eigen::Quaterniond orientation_of(const Row& row)
{
    const Eigen::Vector3d xyz = point_at(row, kOrientation.first);
    const Eigen::Quaterniond quaternion(number_at(row, kOrientation.first + 3), xyz.x(), xyz.y(), xyz.z());
    const double norm = quaternion.norm();
    if (!(norm >= kMinNorm && norm <= kMaxNorm)) {
        throw InputError(row.path, row.line, "columns qx to qw: the quaternion's length is zero or absurd");
    }
    return quaternion.normalized();
}

Target parse_target(const Row& row)
{
    Target target;
    target.frame = index_at(row, 0);
    target.character = index_at(row, 1);
    target.limb = limb_at(row);
    target.position = point_at(row, 3);
    target.has_pole = has_part(row, kPole);
    if (target.has_pole) target.pole = point_at(row, kPole.first);
    target.has_orientation = has_part(row, kOrientation);
    if (target.has_orientation) target.orientation = orientation_of(row);
    target.line = static_cast<std::uint32_t>(row.line);
    return target;
}

// Which of kColumns the cells of the first line name.
std::vector<unsigned> columns_of(const fs::path& path, std::size_t line, const std::vector<std::string_view>& cells)
{
    const auto refuse = [&](const std::string& cause) { throw InputError(path, line, cause); };
    std::vector<unsigned> columns;
    const auto is_there = [&](std::string_view name) {
        return std::any_of(columns.begin(), columns.end(), [&](unsigned column) { return kColumns[column] == name; });
    };
    for (const std::string_view cell : cells) {
        if (cells.size() == 1 && cell.find_first_of(";\t") != cell.npos)
            refuse("its columns are separated by semicolons or tabs; write commas, and points in numbers");
        const auto known = std::ranges::find(kColumns, cell);
        if (known == kColumns.end())
            refuse(fmt::format("unknown column '{}'; known are {}", printable(cell), kColumnList));
        if (is_there(cell)) refuse(fmt::format("column {} is there twice", cell));
        columns.push_back(static_cast<unsigned>(known - kColumns.begin()));
    }
    if (is_there(kColumns[kSide]) && is_there(kColumns[kLimb]))
        refuse("columns limb and side are both there; leave side out");
    std::vector<std::string_view> missing;
    for (const Part part : {kPlace, kPole, kOrientation}) {
        const auto first = kColumns.begin() + part.first, last = first + part.count;
        if (part.is_optional && std::none_of(first, last, is_there)) continue;
        std::copy_if(first, last, std::back_inserter(missing), [&](std::string_view name) {
            return !is_there(name) && !(name == kColumns[kLimb] && is_there(kColumns[kSide]));
        });
    }
    if (!missing.empty())
        refuse(fmt::format("column{} {} {} missing; the first line must name {}", missing.size() == 1 ? "" : "s",
                           joined(missing, ","), missing.size() == 1 ? "is" : "are", kColumnList));
    return columns;
}

auto place_of(const Target& target) { return std::tuple(target.frame, target.character, target.limb); }

void sort_targets(const fs::path& path, std::vector<Target>& targets)
{
    if (!std::ranges::is_sorted(targets, {}, place_of)) std::ranges::stable_sort(targets, {}, place_of);
    const auto twin = std::ranges::adjacent_find(targets, {}, place_of);
    if (twin == targets.end()) return;
    const Target& again = *(twin + 1);
    throw InputError(path, again.line,
                     fmt::format("columns frame,character,limb: {},{},{} is already in line {}; remove one",
                                 again.frame, again.character, limb_word(again.limb), twin->line));
}

}  // namespace

std::vector<Target> read_targets_csv(const fs::path& path)
{
    std::vector<Target> targets;
    std::vector<unsigned> columns;
    Row row{path, 0, false, {}};
    for_each_row(path, [&](std::size_t line, const std::vector<std::string_view>& cells) {
        row.line = line;
        if (columns.empty()) {
            columns = columns_of(path, line, cells);
            row.has_side = std::find(columns.begin(), columns.end(), kSide) != columns.end();
            return;
        }
        if (cells.size() < columns.size())
            throw InputError(path, line, "fewer values than the first line names columns; leave none out");
        if (cells.size() > columns.size())
            throw InputError(path, line, "more values than the first line names columns; remove the surplus");
        for (std::size_t n = 0; n < cells.size(); ++n) row.cell[columns[n]] = cells[n];
        targets.push_back(parse_target(row));
    });
    if (columns.empty()) throw InputError(path, "is empty; its first line must name the columns");
    if (targets.empty()) throw InputError(path, "has no targets below its first line");
    sort_targets(path, targets);
    return targets;
}

TargetsCsv::TargetsCsv(const std::filesystem::path& path) : out_(path)
{
    out_.write(joined(std::span(kColumns).first(kSide), ",") + "\n");
}

void TargetsCsv::append(std::span<const Target> targets)
{
    std::string line;
    const auto put = [&](bool is_there, const auto& numbers) {
        for (const double number : numbers) {
            line.push_back(',');
            if (is_there) line += fmt::format("{}", number);
        }
    };
    for (const Target& target : targets) {
        line = fmt::format("{},{},{}", target.frame, target.character, limb_word(target.limb));
        put(true, target.position);
        put(target.has_pole, target.pole);
        put(target.has_orientation, target.orientation.coeffs());
        line.push_back('\n');
        out_.write(line);
    }
}

}  // namespace swivel::formats
