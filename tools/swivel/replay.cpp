// SPDX-License-Identifier: MIT
//
// `swivel replay`: computes a part of a cached crowd again from its goals, proves it by the digests, and writes it.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/cache/column.h"
#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/signals.h"
#include "tools/cli/streams.h"
#include "tools/crowd/parallel.h"
#include "tools/formats/error.h"
#include "tools/formats/poses_csv.h"
#include "tools/formats/text.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

using formats::InputError;

struct Range {
    std::uint32_t begin, end;
};

// "A:B" is A and on, up to B without it; either may be left out. "A" is that one.
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

// One column of one time chunk, solved and proved.
struct Slice {
    std::vector<goal_character> characters;
    Results results;
};

Slice solve_slice(const Cache& cache, ChunkAt at)
{
    const CachedCrowd& crowd = cache.crowd();
    const auto not_done = [&](ChunkAt chunk) {
        return InputError(cache.folder(), fmt::format("chunk {}.{} is not done, so nothing proves it; run swivel fill "
                                                      "--resume",
                                                      chunk.time, chunk.column));
    };
    const std::uint64_t stored = cache.digest(at);
    if (stored == 0) throw not_done(at);
    Slice slice{cache.characters(at.column), empty_results(crowd)};
    Column column(crowd, at.column, slice.characters, cache.folder());
    if (crowd.carries_state() && at.time > 0) column.restore(cache.require_state({at.time - 1, at.column}));
    const std::uint64_t digest = column.solve(at.time, cache.goals(at), slice.results);
    if (digest != stored)
        throw InputError(cache.folder(), fmt::format("chunk {}.{} has digest {:016x}, and its goals give {:016x}; run "
                                                     "swivel check",
                                                     at.time, at.column, stored, digest));
    return slice;
}

// The columns of the table, from the fields that there are.
formats::PoseColumns columns_of(const CachedCrowd& crowd)
{
    formats::PoseColumns columns;
    for (const ResultField& field : result_fields(crowd)) {
        columns.stretch |= field.field == SWIVEL_STRETCH;
        if (field.field == SWIVEL_TWIST_BONES) columns.twist_count = static_cast<unsigned>(field.parts[0]);
    }
    return columns;
}

// A row of the table: the solver's own rotations.
class RowMaker {
public:
    explicit RowMaker(const CachedCrowd& crowd) : crowd_(crowd), fields_(result_fields(crowd)) {}

    void add(const Slice& slice, ChunkAt at, std::uint32_t frame_in_chunk, std::uint32_t n,
             std::vector<formats::PoseRow>& rows, std::vector<formats::PoseExtra>& extras) const
    {
        const goal_character& who = slice.characters[n];
        for (std::size_t limb = 0; limb < crowd_.limbs.size(); ++limb) {
            formats::PoseRow row;
            formats::PoseExtra extra;
            row.character = at.column * crowd_.chunk.characters + n;
            row.limb = crowd_.limbs[limb].name;
            row.place = std::to_array(who.place);
            row.size = who.size;
            row.start = who.start;
            const std::uint32_t frame = at.time * crowd_.chunk.frames + frame_in_chunk;
            const auto clip_frame = (std::size_t{frame} + who.start) % crowd_.clip_frame_count();
            row.wrist = std::to_array(crowd_.limbs[limb].sources[clip_frame].wrist_local);
            extra.twist_count = crowd_.limbs[limb].setup.twist_bone_count();
            for (std::size_t f = 0; f < fields_.size(); ++f) {
                const std::size_t count = fields_[f].count();
                const std::size_t place =
                    ((frame_in_chunk * crowd_.limbs.size() + limb) * crowd_.chunk.characters + n) * count;
                put(fields_[f].field, std::span(slice.results[f]).subspan(place, count), row, extra);
            }
            rows.push_back(row);
            extras.push_back(extra);
        }
    }

private:
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
            if (field == SWIVEL_TWIST_BONES) extra.twist[n / 4][n % 4] = number(n);
        }
    }

    const CachedCrowd& crowd_;
    std::vector<ResultField> fields_;
};

}  // namespace

void run_replay(const ReplayOptions& options)
{
    const Cache cache(options.folder);
    cache.require_goals();
    const CachedCrowd& crowd = cache.crowd();
    const Range frames = range_of("--frames", options.frames, crowd.frame_count);
    const Range characters = range_of("--characters", options.characters, crowd.character_count);
    const ThreadLimit limit(options.threads);
    const RowMaker make(crowd);
    const formats::PoseColumns columns = columns_of(crowd);
    const bool has_extras = columns.stretch || columns.twist_count > 0;
    const StopSignals signals;
    std::optional<formats::PosesCsv> csv;
    if (!options.out.empty()) csv.emplace(options.out, columns);
    const auto first_column = characters.begin / crowd.chunk.characters;
    const auto last_column = (characters.end - 1) / crowd.chunk.characters;
    const auto first_time = frames.begin / crowd.chunk.frames, last_time = (frames.end - 1) / crowd.chunk.frames;
    std::uint64_t proved = 0;
    {
        Progress progress("chunks", std::uint64_t{last_time - first_time + 1} * (last_column - first_column + 1),
                          options.quiet);
        for (std::uint32_t time = first_time; time <= last_time; ++time) {
            std::vector<Slice> slices;
            for (std::uint32_t column = first_column; column <= last_column; ++column) {
                signals.check();
                progress.show(proved++);
                slices.push_back(solve_slice(cache, {time, column}));
            }
            for (std::uint32_t n = 0; csv && n < crowd.frames_in(time); ++n) {
                const std::uint32_t frame = time * crowd.chunk.frames + n;
                if (frame < frames.begin || frame >= frames.end) continue;
                std::vector<formats::PoseRow> rows;
                std::vector<formats::PoseExtra> extras;
                for (std::uint32_t who = characters.begin; who < characters.end; ++who) {
                    const std::uint32_t column = who / crowd.chunk.characters;
                    make.add(slices[column - first_column], {time, column}, n, who % crowd.chunk.characters, rows,
                             extras);
                }
                csv->append(frame, rows, has_extras ? extras : std::vector<formats::PoseExtra>());
            }
        }
    }
    signals.check();
    if (csv) csv->commit();
    std::FILE* const to = formats::is_standard_stream(options.out) ? stderr : stdout;
    if (options.json) print_json({{"cache", options.folder}, {"chunks_proved", proved}, {"out", options.out}}, to);
    if (options.json || options.quiet) return;
    say(to, "proved   {} chunks: their digests are those of the cache\n", proved);
    if (csv && to == stdout) say(to, "written  {}\n", options.out);
}

}  // namespace swivel::tools
