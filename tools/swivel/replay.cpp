// SPDX-License-Identifier: MIT
//
// `swivel replay`: computes a part of a cached crowd again from its goals, proves it by the digests, and writes it.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/cache/column.h"
#include "tools/cli/command_error.h"
#include "tools/cli/option_checks.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/crowd/parallel.h"
#include "tools/formats/error.h"
#include "tools/formats/poses_csv.h"
#include "tools/formats/printable.h"
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

// The characters of one column, chunk after chunk, solved and proved.
class ColumnReplay {
public:
    ColumnReplay(const Cache& cache, std::uint32_t index)
        : cache_(cache),
          characters_(cache.characters(index)),
          column_(cache.crowd(), index, characters_, cache.folder()),
          results_(empty_results(cache.crowd()))
    {
    }

    std::uint32_t index() const { return column_.index(); }
    // Chunks of the column in order, from any on. Throws InputError if the chunk is not done, or has another digest.
    const Results& solve(std::uint32_t time)
    {
        const ChunkAt at{time, column_.index()};
        const std::uint64_t stored = cache_.digest(at);
        if (stored == 0) throw not_done(at);
        if (cache_.crowd().carries_state() && time > 0 && !has_begun_)
            column_.restore(cache_.require_state({time - 1, at.column}));
        has_begun_ = true;
        const std::uint64_t digest = column_.solve(time, cache_.goals(at), results_);
        if (digest != stored)
            throw InputError(cache_.folder(),
                             fmt::format("chunk {}.{} has digest {:016x}, and its goals give {:016x}; run swivel check",
                                         time, at.column, stored, digest));
        return results_;
    }
    std::span<const goal_character> characters() const { return characters_; }

private:
    InputError not_done(ChunkAt chunk) const
    {
        return InputError(cache_.folder(), fmt::format("chunk {}.{} is not done, so nothing proves it; run swivel fill "
                                                       "--resume",
                                                       chunk.time, chunk.column));
    }

    const Cache& cache_;
    std::vector<goal_character> characters_;
    Column column_;
    Results results_;
    bool has_begun_ = false;
};

// The columns of the table, from the fields that there are. Clavicles have none: a table has the local rotation of
// their joint, and a cache has only the turn that the solver adds to it.
formats::PoseColumns columns_of(const CachedCrowd& crowd)
{
    formats::PoseColumns columns;
    for (const ResultField& field : result_fields(crowd)) {
        columns.stretch |= field.field == SWIVEL_STRETCH;
        if (field.field == SWIVEL_TWIST_BONES) columns.twist_count = static_cast<unsigned>(field.parts[0]);
    }
    return columns;
}

// Writes the table: the solver's own rotations. It has frames in order, so it holds the chunks of one time together.
class TableWriter {
public:
    // For these characters of the cache, and for so many frames at once. Its memory is taken here and kept.
    TableWriter(const std::string& path, const CachedCrowd& crowd, std::uint32_t frame_count, Range characters)
        : crowd_(crowd),
          fields_(result_fields(crowd)),
          columns_(columns_of(crowd)),
          has_extras_(columns_.stretch || columns_.twist_count > 0),
          first_(characters.begin),
          characters_(characters.end - characters.begin),
          csv_(path, columns_)
    {
        for (const ResultField& field : fields_)
            results_.emplace_back(frame_count * crowd.limbs.size() * characters_.size() * field.count());
    }

    // Keeps these frames and characters of a chunk, counted within it.
    void add(const ColumnReplay& column, const Results& results, Range frames, Range characters)
    {
        const std::size_t width = characters_.size(), count = characters.end - characters.begin;
        const std::size_t to = column.index() * crowd_.chunk.characters + characters.begin - first_;
        std::ranges::copy(column.characters().subspan(characters.begin, count), &characters_[to]);
        const std::size_t limbs = crowd_.limbs.size(), first_row = frames.begin * limbs, end_row = frames.end * limbs;
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            const std::size_t parts = fields_[f].count();
            for (std::size_t row = first_row; row < end_row; ++row) {
                const std::size_t from = row * crowd_.chunk.characters + characters.begin;
                std::ranges::copy(std::span(results[f]).subspan(from * parts, count * parts),
                                  &results_[f][((row - first_row) * width + to) * parts]);
            }
        }
    }

    // Writes these frames, once all their chunks were added.
    void write(Range frames)
    {
        for (std::uint32_t frame = frames.begin; frame < frames.end; ++frame)
            for (std::uint32_t n = 0; n < characters_.size(); ++n)
                for (std::size_t limb = 0; limb < crowd_.limbs.size(); ++limb)
                    write_row(frame, frame - frames.begin, limb, n);
    }
    void commit() { csv_.commit(); }

private:
    void write_row(std::uint32_t frame, std::size_t held_frame, std::size_t limb, std::uint32_t n)
    {
        const goal_character& who = characters_[n];
        formats::PoseRow row;
        formats::PoseExtra extra;
        row.character = first_ + n;
        row.limb = crowd_.limbs[limb].name;
        row.place = std::to_array(who.place);
        row.size = who.size;
        row.start = who.start;
        const auto clip_frame = (std::size_t{frame} + who.start) % crowd_.clip_frames;
        row.wrist = std::to_array(crowd_.limbs[limb].sources[clip_frame].wrist_local);
        extra.twist_count = crowd_.limbs[limb].setup.twist_bone_count();
        const std::size_t at = (held_frame * crowd_.limbs.size() + limb) * characters_.size() + n;
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            const std::size_t parts = fields_[f].count();
            put(fields_[f].field, std::span(results_[f]).subspan(at * parts, parts), row, extra);
        }
        csv_.append(frame, {&row, 1}, {&extra, has_extras_ ? 1u : 0u});
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
            if (field == SWIVEL_TWIST_BONES) extra.twist[n / 4][n % 4] = number(n);
        }
    }

    const CachedCrowd& crowd_;
    std::vector<ResultField> fields_;
    formats::PoseColumns columns_;
    bool has_extras_;
    std::uint32_t first_;
    std::vector<goal_character> characters_;
    Results results_;  // frame by frame, limb by limb; each row as wide as characters_
    formats::PosesCsv csv_;
};

// What a table holds at once: the results of these frames, and who is in them.
double bytes_of_rows(const CachedCrowd& crowd, std::uint32_t frame_count, Range characters)
{
    double bytes_of_limb = 0;
    for (const ResultField& field : result_fields(crowd)) bytes_of_limb += 4.0 * static_cast<double>(field.count());
    const double bytes_of_character = frame_count * bytes_of_limb * static_cast<double>(crowd.limbs.size());
    return (characters.end - characters.begin) * (bytes_of_character + sizeof(goal_character));
}

// What of [whole.begin, whole.end) is in the piece of that many from first on, counted from first.
Range within(Range whole, std::uint32_t first, std::uint32_t count)
{
    return {std::max(whole.begin, first) - first, std::min(whole.end, first + count) - first};
}

// A table needs the columns of one time together. Without one, each column is gone through at once.
std::vector<ChunkAt> order_of(Range times, Range columns, bool is_by_time)
{
    std::vector<ChunkAt> order;
    for (std::uint32_t time = times.begin; time < times.end; ++time)
        for (std::uint32_t column = columns.begin; column < columns.end; ++column) order.push_back({time, column});
    if (!is_by_time) std::ranges::stable_sort(order, {}, &ChunkAt::column);
    return order;
}

}  // namespace

void run_replay(const ReplayOptions& options)
{
    const std::uint64_t memory = bytes_of(options.memory);
    const Cache cache(options.folder, memory);
    cache.require_goals();
    const CachedCrowd& crowd = cache.crowd();
    const Range frames = range_of("--frames", options.frames, crowd.frame_count);
    const Range characters = range_of("--characters", options.characters, crowd.character_count);
    const ChunkShape chunk = crowd.chunk;
    const std::uint32_t held_frames = std::min(chunk.frames, frames.end - frames.begin);
    double bytes = bytes_to_replay(crowd, cache.arrays());
    if (!options.out.empty()) bytes += bytes_of_rows(crowd, held_frames, characters);
    require_memory(cache.folder(), bytes, memory, options.out.empty() ? "a chunk" : "a chunk with the table's rows",
                   "give more by --memory, or ask for fewer characters");
    const ThreadLimit limit(options.threads);
    std::optional<TableWriter> table;
    if (!options.out.empty()) table.emplace(options.out, crowd, held_frames, characters);
    const Range times{frames.begin / chunk.frames, (frames.end - 1) / chunk.frames + 1};
    const Range columns{characters.begin / chunk.characters, (characters.end - 1) / chunk.characters + 1};
    const std::vector<ChunkAt> order = order_of(times, columns, table.has_value());
    {
        Progress progress("chunks", order.size(), options.quiet);
        std::optional<ColumnReplay> column;
        for (std::size_t n = 0; n < order.size(); ++n) {
            progress.show(n);
            const ChunkAt at = order[n];
            if (!column || column->index() != at.column) column.emplace(cache, at.column);
            const Results& results = column->solve(at.time);
            if (!table) continue;
            const Range when = within(frames, at.time * chunk.frames, crowd.frames_in(at.time));
            table->add(*column, results, when,
                       within(characters, at.column * chunk.characters, crowd.characters_in(at.column)));
            const std::uint32_t first = at.time * chunk.frames;
            if (at.column + 1 == columns.end) table->write({first + when.begin, first + when.end});
        }
    }
    if (table) table->commit();
    std::FILE* const to = formats::is_standard_stream(options.out) ? stderr : stdout;
    if (options.json)
        print_json({{"cache", options.folder}, {"chunks_proved", order.size()}, {"out", options.out}}, to);
    if (options.json || options.quiet) return;
    say(to, "chunks   {} proved: their digests are those of the cache\n", order.size());
    if (table && to == stdout) say(to, "written  {}\n", options.out);
}

}  // namespace swivel::tools
