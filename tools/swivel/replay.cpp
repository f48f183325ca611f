// SPDX-License-Identifier: MIT
//
// `swivel replay`: solves a part of a cached crowd again from its goals, checks it by the digests, and writes it.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/cache/column.h"
#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/crowd/heading.h"
#include "tools/crowd/parallel.h"
#include "tools/formats/error.h"
#include "tools/formats/poses_csv.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/motion_file.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

using formats::InputError;

struct Range {
    std::uint32_t begin, end;
};

// "A:B" is A up to B, B excluded; either may be left out. "A" is A alone.
Range range_of(const char* option, const std::string& text, std::uint32_t count)
{
    const std::size_t colon = text.find(':');
    const std::string first = text.substr(0, colon), second = colon == std::string::npos ? "" : text.substr(colon + 1);
    const auto begin = first.empty() ? 0 : formats::parse_integer(first);
    const auto end = colon == std::string::npos && begin ? std::optional(*begin + 1)
                     : second.empty()                    ? std::optional<std::int64_t>(count)
                                                         : formats::parse_integer(second);
    if (!begin || !end || *begin < 0 || *begin >= *end || *end > count)
        throw CommandError(2, fmt::format("{} {}: write A:B with 0 <= A < B <= {}; B itself is left out", option,
                                          formats::printable(text), count));
    return {static_cast<std::uint32_t>(*begin), static_cast<std::uint32_t>(*end)};
}

// Solves a chunk of a column and proves it by the cache's digest. Throws InputError if the chunk is not done, or has
// another digest. is_first: the column has solved no chunk before, so it needs the state of the one before.
void solve_proved(const Cache& cache, Column& column, std::uint32_t time, bool is_first, Results& results)
{
    const ChunkAt at{time, column.index()};
    const std::uint64_t stored = cache.digest(at);
    if (stored == 0)
        throw InputError(cache.folder(), fmt::format("chunk {}.{} is not done, so nothing proves it; run swivel fill",
                                                     time, at.column));
    if (cache.crowd().carries_state() && time > 0 && is_first)
        column.restore(cache.require_state({time - 1, at.column}));
    const std::uint64_t digest = column.solve(time, cache.goals(at), results);
    if (digest != stored)
        throw InputError(cache.folder(),
                         fmt::format("chunk {}.{} has digest {:016x}, and its goals give {:016x}; run swivel check",
                                     time, at.column, stored, digest));
}

// The columns of the table, from the fields that there are. Clavicles have none: a table has the local rotation of
// their joint, and a cache has only the turn that the solver adds to it.
formats::PoseColumns columns_of(const CachedCrowd& crowd)
{
    formats::PoseColumns columns;
    for (const ResultField& field : result_fields(crowd)) {
        columns.stretch |= field.field == SWIVEL_STRETCH;
        if (field.field == SWIVEL_TWIST_BONES) columns.twist_count = static_cast<unsigned>(field.parts[0]);
    }
    columns.heading = crowd.has_headings;
    columns.name = !crowd.names.empty();
    return columns;
}

// Writes the table: the solver's own rotations, chunk after chunk.
class TableWriter {
public:
    TableWriter(const std::string& path, const CachedCrowd& crowd)
        : crowd_(crowd), fields_(result_fields(crowd)), columns_(columns_of(crowd)), csv_(path, columns_)
    {
    }

    // These frames and characters of a chunk, counted within it.
    void write(ChunkAt at, std::span<const goal_character> who, const Results& results, Range frames, Range characters)
    {
        for (std::uint32_t frame = frames.begin; frame < frames.end; ++frame)
            for (std::uint32_t n = characters.begin; n < characters.end; ++n)
                for (std::size_t limb = 0; limb < crowd_.limbs.size(); ++limb)
                    write_row(at, who[n], results, frame, limb, n);
    }
    void commit() { csv_.commit(); }

private:
    void write_row(ChunkAt at, const goal_character& who, const Results& results, std::uint32_t frame_in_chunk,
                   std::size_t limb, std::uint32_t n)
    {
        const std::uint32_t frame = at.time * crowd_.chunk.frames + frame_in_chunk;
        formats::PoseRow row;
        formats::PoseExtra extra;
        row.character = at.column * crowd_.chunk.characters + n;
        row.limb = crowd_.limbs[limb].name;
        row.place = std::to_array(who.place);
        row.size = who.size;
        row.start = who.first + who.start;
        row.heading_deg = degrees_of(who);
        if (columns_.name) row.name = crowd_.names[row.character];
        row.wrist = std::to_array(crowd_.limbs[limb].sources[swivel_goal_frame(&who, frame)].wrist_local);
        extra.twist_count = crowd_.limbs[limb].setup.twist_bone_count;
        const std::size_t place = crowd_.place(frame_in_chunk, limb, n);
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            const std::size_t parts = fields_[f].count();
            put(fields_[f].field, std::span(results[f]).subspan(place * parts, parts), row, extra);
        }
        csv_.append(frame, {&row, 1}, {&extra, columns_.has_extras() ? 1u : 0u});
    }

    static void put(swivel_field field, std::span<const std::uint32_t> from, formats::PoseRow& row,
                    formats::PoseExtra& extra)
    {
        const auto number = [&](std::size_t n) { return std::bit_cast<float>(from[n]); };
        if (field == SWIVEL_FLAGS) row.flags = from[0];
        if (field != SWIVEL_FLAGS && std::isnan(number(0))) return;  // the limb does not have this field
        for (std::size_t n = 0; n < from.size(); ++n) {
            if (field == SWIVEL_SHOULDER) row.shoulder[n] = number(n);
            if (field == SWIVEL_ELBOW) row.elbow[n] = number(n);
            if (field == SWIVEL_WRIST) row.wrist[n] = number(n);
            if (field == SWIVEL_STRETCH) extra.stretch = number(n);
            if (field == SWIVEL_SHIFT && n == 3) row.place[1] += double{number(n)};
            if (field == SWIVEL_TWIST_BONES) extra.twist[n / 4][n % 4] = number(n);
        }
    }

    const CachedCrowd& crowd_;
    std::vector<ResultField> fields_;
    formats::PoseColumns columns_;
    formats::PosesCsv csv_;
};

// The part of [whole.begin, whole.end) in the piece [first, first + count), relative to first.
Range within(Range whole, std::uint32_t first, std::uint32_t count)
{
    return {std::max(whole.begin, first) - first, std::min(whole.end, first + count) - first};
}

}  // namespace

void run_replay(const ReplayOptions& options)
{
    if (const std::string suffix = formats::lower_suffix(options.out); is_bvh(suffix) || is_gltf(suffix))
        throw CommandError(2,
                           fmt::format("--out {}: poses of a cache are written as a table; name a .csv", options.out));
    const Cache cache(options.folder);
    const CachedCrowd& crowd = cache.crowd();
    const ChunkShape chunk = crowd.chunk;
    const Range frames = range_of("--frames", options.frames, crowd.frame_count);
    const Range characters = range_of("--characters", options.characters, crowd.character_count);
    const Range times{frames.begin / chunk.frames, (frames.end - 1) / chunk.frames + 1};
    const Range columns{characters.begin / chunk.characters, (characters.end - 1) / chunk.characters + 1};
    const std::uint64_t count = std::uint64_t{times.end - times.begin} * (columns.end - columns.begin);
    const ThreadLimit limit(options.threads);
    std::optional<TableWriter> table;
    if (!options.out.empty()) table.emplace(options.out, crowd);
    {
        Progress progress("chunks", count, options.quiet);
        std::uint64_t done = 0;
        for (std::uint32_t index = columns.begin; index < columns.end; ++index) {
            const std::vector<goal_character> in_column = cache.characters(index);
            Column column(crowd, index, in_column);
            Results results = empty_results(crowd);
            const Range who = within(characters, index * chunk.characters, crowd.characters_in(index));
            for (std::uint32_t time = times.begin; time < times.end; ++time) {
                progress.show(done++);
                solve_proved(cache, column, time, time == times.begin, results);
                const Range when = within(frames, time * chunk.frames, crowd.frames_in(time));
                if (table) table->write({time, index}, in_column, results, when, who);
            }
        }
    }
    if (table) table->commit();
    std::FILE* const to = formats::is_standard_stream(options.out) ? stderr : stdout;
    if (options.json) {
        Json out = {{"cache", options.folder},
                    {"chunks", count},
                    {"first_frame", frames.begin},
                    {"last_frame", frames.end - 1},
                    {"first_character", characters.begin},
                    {"last_character", characters.end - 1}};
        if (table) out["out"] = options.out;
        return print_json(out, to);
    }
    if (options.quiet) return;
    say(to, "chunks   {} proved: their digests are those of the cache\n", count);
    if (table && to == stdout) say(to, "written  {}\n", options.out);
}

}  // namespace swivel::tools
