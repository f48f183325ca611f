// SPDX-License-Identifier: MIT
#include "tools/formats/targets_csv.h"

#include <fmt/format.h>

#define CSV_IO_NO_THREAD
#include <libfccp/csv.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <tuple>

#include "tools/formats/error.h"
#include "tools/formats/limits.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace fs = std::filesystem;
namespace {

constexpr unsigned kColumnCount = 14;
constexpr unsigned kLimb = 2, kSide = 13;  // side: what tables of arms had instead of limb
constexpr std::array<const char*, kColumnCount> kColumns = {"frame",  "character", "limb", "x",  "y",  "z",  "pole_x",
                                                            "pole_y", "pole_z",    "qx",   "qy", "qz", "qw", "side"};
// Columns that belong together. Of those that are optional a table has all or none, and so has a row.
struct Part {
    unsigned first, count;
    bool is_optional;
};
constexpr Part kPlace = {0, 6, false}, kPole = {6, 3, true}, kOrientation = {9, 4, true};
constexpr std::string_view kColumnList =
    "frame,character,limb,x,y,z, all or none of pole_x,pole_y,pole_z, and all or none of qx,qy,qz,qw";
constexpr double kMinNorm = 1 / kMaxNorm;

using Csv = io::CSVReader<kColumnCount, io::trim_chars<' ', '\t'>, io::double_quote_escape<',', '"'>,
                          io::throw_on_overflow, io::single_and_empty_line_comment<'#'>>;

// Feeds the parser, which takes a read error for the end and a zero byte for the end of a line, and which needs a line
// end after the last line to be sure of it. Derived from the parser's base because that is its only door.
class TextSource : public io::ByteSourceBase {
public:
    explicit TextSource(const fs::path& path) : path_(path), file_(open_text(path)) {}

    int read(char* buffer, int size) override
    {
        const auto wanted = static_cast<std::size_t>(size);
        std::size_t count = read_chunk(path_, file_.get(), buffer, wanted);
        if (count > 0) ends_line_ = buffer[count - 1] == '\n';
        if (count < wanted && !ends_line_) {
            buffer[count++] = '\n';
            ends_line_ = true;
        }
        return static_cast<int>(count);
    }

private:
    fs::path path_;
    TextFile file_;
    bool ends_line_ = true;
};

// The values of one line, as the parser cut them out; empty for columns the file does not have.
struct Row {
    const fs::path& path;
    std::size_t line = 0;
    bool has_side = false;  // the column side in place of limb
    std::array<const char*, kColumnCount> cell;
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
    return std::any_of(first, first + part.count, [](const char* cell) { return *cell != 0; });
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

// Calls a function of the parser, and says its complaints in our words.
template <class Call>
auto translated(const fs::path& path, const Csv& csv, Call call)
{
    const auto error = [&](std::string_view cause) { return InputError(path, csv.get_file_line(), cause); };
    try {
        return call();
    } catch (const io::error::header_missing&) {
        throw InputError(path, "is empty; its first line must name the columns");
    } catch (const io::error::escaped_string_not_closed&) {
        throw error("a quote is opened and not closed; close it or remove it");
    } catch (const io::error::extra_column_in_header& e) {
        if (std::string_view(e.column_name).find_first_of(";\t") != std::string_view::npos)
            throw error("its columns are separated by semicolons or tabs; write commas, and points in numbers");
        throw error(fmt::format("unknown column '{}'; known are {}", printable(e.column_name), kColumnList));
    } catch (const io::error::duplicated_column_in_header& e) {
        throw error(fmt::format("column {} is there twice", e.column_name));
    } catch (const io::error::too_few_columns&) {
        throw error("fewer values than the first line names columns; leave none out");
    } catch (const io::error::too_many_columns&) {
        throw error("more values than the first line names columns; remove the surplus");
    } catch (const io::error::line_length_limit_exceeded&) {
        throw error("a line longer than 16 MiB; is this a table?");
    }
}

void read_column_names(const fs::path& path, Csv& csv)
{
    translated(path, csv, [&] {
        std::apply([&](auto... names) { csv.read_header(io::ignore_missing_column, names...); }, kColumns);
    });
    const auto is_there = [&](const char* name) { return csv.has_column(name); };
    if (is_there(kColumns[kSide]) && is_there(kColumns[kLimb]))
        throw InputError(path, csv.get_file_line(), "columns limb and side are both there; leave side out");
    std::vector<std::string_view> missing;
    for (const Part part : {kPlace, kPole, kOrientation}) {
        const auto first = kColumns.begin() + part.first, last = first + part.count;
        if (part.is_optional && std::none_of(first, last, is_there)) continue;
        std::copy_if(first, last, std::back_inserter(missing), [&](const char* name) {
            return !is_there(name) && !(name == kColumns[kLimb] && is_there(kColumns[kSide]));
        });
    }
    if (missing.empty()) return;
    throw InputError(path, csv.get_file_line(),
                     fmt::format("column{} {} {} missing; the first line must name {}", missing.size() == 1 ? "" : "s",
                                 fmt::join(missing, ","), missing.size() == 1 ? "is" : "are", kColumnList));
}

auto place_of(const Target& target) { return std::tuple(target.frame, target.character, target.limb); }

void sort_targets(const fs::path& path, std::vector<Target>& targets)
{
    const auto before = [](const Target& a, const Target& b) { return place_of(a) < place_of(b); };
    const auto same = [](const Target& a, const Target& b) { return place_of(a) == place_of(b); };
    if (!std::is_sorted(targets.begin(), targets.end(), before)) {
        std::stable_sort(targets.begin(), targets.end(), before);
    }
    const auto twin = std::adjacent_find(targets.begin(), targets.end(), same);
    if (twin == targets.end()) return;
    const Target& again = *(twin + 1);
    throw InputError(path, again.line,
                     fmt::format("columns frame,character,limb: {},{},{} is already in line {}; remove one",
                                 again.frame, again.character, limb_word(again.limb), twin->line));
}

}  // namespace

std::vector<Target> read_targets_csv(const fs::path& path)
{
    Csv csv("", std::make_unique<TextSource>(path));
    read_column_names(path, csv);
    std::vector<Target> targets;
    Row row{path, 0, csv.has_column(kColumns[kSide]), {}};
    row.cell.fill("");
    const auto read_row = [&] { return std::apply([&](auto&... cells) { return csv.read_row(cells...); }, row.cell); };
    while (translated(path, csv, read_row)) {
        row.line = csv.get_file_line();
        targets.push_back(parse_target(row));
    }
    if (targets.empty()) throw InputError(path, "has no targets below its first line");
    sort_targets(path, targets);
    return targets;
}

}  // namespace swivel::formats
