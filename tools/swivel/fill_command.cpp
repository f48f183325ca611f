// SPDX-License-Identifier: MIT
//
// `swivel fill`: solves the chunks of a cache. `swivel check`: proves that all of them are right, and ends the filling.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/cache/column.h"
#include "tools/cache/fill.h"
#include "tools/cli/command_error.h"
#include "tools/cli/option_checks.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/crowd/parallel.h"
#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

using Json = nlohmann::ordered_json;

std::string chunk_name(ChunkAt at) { return fmt::format("{}.{}", at.time, at.column); }

Shard shard_of_option(const std::string& text)
{
    if (text.empty()) return {};
    try {
        return shard_of(text);
    } catch (const std::invalid_argument& error) {
        throw CommandError(2, fmt::format("--shard {}: {}", formats::printable(text), error.what()));
    }
}

// In the order of chunks_of().
std::pair<std::uint32_t, std::uint32_t> in_order(ChunkAt at) { return {at.column, at.time}; }

void require_empty(const Cache& cache, std::span<const ChunkAt> chunks)
{
    const auto is_among = [&](ChunkAt at) { return std::ranges::binary_search(chunks, in_order(at), {}, in_order); };
    const auto done = std::ranges::count_if(cache.done(), is_among);
    if (done > 0)
        throw formats::InputError(
            cache.folder(),
            fmt::format("{} of {} chunks are done already; add --resume to go on, or --verify", done, chunks.size()));
}

void require_done(const Cache& cache, std::span<const ChunkAt> chunks)
{
    const std::vector<ChunkAt> done = cache.done();
    const auto first_missing = std::ranges::mismatch(chunks, done).in1;
    if (first_missing != chunks.end())
        throw formats::InputError(cache.folder(),
                                  fmt::format("{} of {} chunks are not done, the first is {}; {}",
                                              chunks.size() - done.size(), chunks.size(), chunk_name(*first_missing),
                                              cache.crowd().has_goals() ? "run swivel fill --resume"
                                                                        : "take the files in digest/ from a copy"));
}

// Fills, compares or mends with progress on stderr.
template <class Work>
FillReport run_visibly(FillOptions options, std::size_t chunk_count, bool quiet, Work work)
{
    Progress progress("chunks", std::max<std::size_t>(chunk_count, 1), quiet);
    options.progress = [&](std::uint64_t done) { progress.show(done); };
    return work(options);
}

double rate(double amount, double seconds) { return seconds > 0 ? amount / seconds : 0; }

Json json_of_differences(std::span<const Difference> differences)
{
    Json list = Json::array();
    for (const Difference& each : differences) list.push_back({{"chunk", chunk_name(each.at)}, {"what", each.what}});
    return list;
}

void print_differences(std::span<const Difference> differences, bool are_written)
{
    for (const Difference& each : differences)
        say(stdout, "{} chunk {} {} not what its goals give: {}{}\n", are_written ? "again   " : "differs ",
            chunk_name(each.at), are_written ? "was" : "is", each.what, are_written ? "; it is written again" : "");
}

Json json_of_fill(const FillReport& report)
{
    return {{"chunks_written", report.written},
            {"chunks_compared", report.compared},
            {"chunks_skipped", report.skipped},
            {"limbs", report.limbs},
            {"bytes_written", report.bytes},
            {"seconds", report.seconds},
            {"solver_seconds", report.solve_seconds},
            {"disk_seconds", report.disk_seconds},
            {"limit", report.solve_seconds < report.disk_seconds ? "disk" : "solver"},
            {"written_again", json_of_differences(report.differences)}};
}

void print_fill(const FillReport& report)
{
    const std::string again =
        report.differences.empty() ? "" : fmt::format(" and {} of them written again", report.differences.size());
    say(stdout, "chunks   {} written, {} compared{}, {} were done\n", report.written, report.compared, again,
        report.skipped);
    print_differences(report.differences, true);
    if (report.limbs == 0) return;
    const bool is_disk = report.solve_seconds < report.disk_seconds;
    say(stdout, "speed    {:.2f} s: the solver took {:.2f} s, {:.1f} million limbs/s; the disk {:.2f} s{}\n",
        report.seconds, report.solve_seconds, rate(static_cast<double>(report.limbs), report.solve_seconds) / 1e6,
        report.disk_seconds,
        report.bytes == 0
            ? ""
            : fmt::format(", {:.0f} MB/s", rate(static_cast<double>(report.bytes), report.disk_seconds) / 1e6));
    say(stdout, "limit    {}\n", is_disk ? "the disk" : "the solver");
}

// Poses without goals are held against their digests alone.
std::vector<ChunkAt> damaged_poses(const Cache& cache, std::span<const ChunkAt> chunks, bool quiet)
{
    const CachedCrowd& crowd = cache.crowd();
    Progress progress("chunks", chunks.size(), quiet);
    std::vector<ChunkAt> damaged;
    std::unique_ptr<Column> column;
    for (std::size_t n = 0; n < chunks.size(); ++n) {
        progress.show(n);
        const ChunkAt at = chunks[n];
        if (!column || column->index() != at.column) {
            column = std::make_unique<Column>(crowd, at.column, cache.characters(at.column), cache.folder());
        }
        const std::optional<Results> results = cache.results(at);
        if (!results || column->digest(at.time, *results) != cache.digest(at)) damaged.push_back(at);
    }
    return damaged;
}

// Of a cache that keeps no goals.
void check_poses(Cache& cache, std::span<const ChunkAt> chunks, const CheckOptions& options)
{
    require_memory(cache.folder(), bytes_to_replay(cache.crowd(), cache.arrays()), bytes_of(options.memory), "a chunk",
                   "give more by --memory");
    const ThreadLimit limit(options.threads);
    const std::vector<ChunkAt> damaged = damaged_poses(cache, chunks, options.quiet);
    if (damaged.empty()) cache.close();  // what an interrupted check left
    if (options.json) {
        Json list = Json::array();
        for (const ChunkAt at : damaged) list.push_back({{"chunk", chunk_name(at)}, {"files", cache.pose_files(at)}});
        print_json({{"cache", options.folder},
                    {"chunks", chunks.size()},
                    {"proved_by", "digests"},
                    {"damaged", std::move(list)}});
    } else if (!options.quiet) {
        for (const ChunkAt at : damaged)
            say(stdout, "damaged  chunk {}: {}\n", chunk_name(at), fmt::join(cache.pose_files(at), " "));
        if (damaged.empty()) say(stdout, "right    {} chunks: their poses have their digests\n", chunks.size());
    }
    if (!damaged.empty())
        throw formats::InputError(cache.folder(),
                                  fmt::format("{} of {} chunks are damaged, the first is {}; the cache keeps no goals, "
                                              "so take their files from a copy",
                                              damaged.size(), chunks.size(), chunk_name(damaged[0])));
}

// More than one chunk differs, and more than half of all. Files of poses are damaged one by one, so then all of them
// are asked for something else than when they were filled.
bool suspects_goals(const FillReport& report)
{
    return report.differences.size() > 1 && 2 * report.differences.size() > report.compared;
}

void print_check(const FillReport& report, std::size_t chunk_count, const CheckOptions& options)
{
    const bool is_right = report.differences.empty(), is_suspicious = suspects_goals(report);
    const Json differences = json_of_differences(report.differences), none = Json::array();
    if (options.json)
        print_json({{"cache", options.folder},
                    {"chunks", chunk_count},
                    {"proved_by", "solving"},
                    {"limbs", report.limbs},
                    {"seconds", report.seconds},
                    {"suspects_goals", is_suspicious},
                    {"left_different", is_suspicious ? differences : none},
                    {"written_again", is_suspicious ? none : differences}});
    if (options.json || options.quiet) return;
    print_differences(report.differences, !is_suspicious);
    if (!is_right) return;
    say(stdout, "right    {} chunks: solved again, and all bits are equal\n", chunk_count);
    say(stdout, "speed    {:.2f} s, {:.1f} million limbs/s\n", report.seconds,
        rate(static_cast<double>(report.limbs), report.seconds) / 1e6);
    say(stdout, "closed   {}\n", options.folder);
}

void check_by_solving(Cache& cache, std::span<const ChunkAt> chunks, const CheckOptions& options)
{
    FillOptions how;
    how.memory = bytes_of(options.memory);
    how.threads = options.threads;
    const FillReport report =
        run_visibly(how, chunks.size(), options.quiet, [&](const FillOptions& each) { return compare(cache, each); });
    const auto& differences = report.differences;
    const bool is_suspicious = suspects_goals(report);
    if (differences.empty())
        cache.close();
    else if (!is_suspicious)
        run_visibly(how, differences.size(), options.quiet,
                    [&](const FillOptions& each) { return mend(cache, each, differences); });
    print_check(report, chunks.size(), options);
    if (differences.empty()) return;
    const std::string first = fmt::format("the first is {}: {}", chunk_name(differences[0].at), differences[0].what);
    throw formats::InputError(
        cache.folder(),
        is_suspicious
            ? fmt::format("{} of {} chunks differ from what the goals give, {}; the goals are suspected, or another "
                          "swivel filled the cache, so nothing was written: take a copy, or run swivel fill --verify "
                          "if the goals are right",
                          differences.size(), chunks.size(), first)
            : fmt::format("{} of {} chunks were damaged and are written again, {}; run swivel check once more",
                          differences.size(), chunks.size(), first));
}

}  // namespace

void run_fill(const FillCommand& options)
{
    FillOptions how;
    how.shard = shard_of_option(options.shard);
    how.verifies = options.verifies;
    how.memory = bytes_of(options.memory);
    how.threads = options.threads;
    const Cache cache(options.folder, how.memory);
    const std::vector<ChunkAt> chunks = chunks_of(cache.crowd(), how.shard);
    if (!options.resumes && !options.verifies) require_empty(cache, chunks);
    if (!options.json && !options.quiet && !options.shard.empty())
        say(stdout, "shard    {} of the cache, by {}: {} chunks{}\n", how.shard.words(), how.shard.source,
            chunks.size(), chunks.empty() ? "; there are fewer pieces of work than shards" : "");
    const FillReport report =
        run_visibly(how, chunks.size(), options.quiet, [&](const FillOptions& each) { return fill(cache, each); });
    if (options.json) {
        Json out{{"cache", options.folder}, {"shard", how.shard.words()}};
        out.update(json_of_fill(report));
        print_json(out);
    } else if (!options.quiet) {
        print_fill(report);
    }
}

void run_check(const CheckOptions& options)
{
    Cache cache(options.folder, bytes_of(options.memory));
    const std::vector<ChunkAt> chunks = chunks_of(cache.crowd(), {});
    require_done(cache, chunks);
    if (!cache.crowd().has_goals())
        check_poses(cache, chunks, options);
    else
        check_by_solving(cache, chunks, options);
}

}  // namespace swivel::tools
