// SPDX-License-Identifier: MIT
//
// `swivel fill`: solves the chunks of a cache. `swivel check`: verifies all chunks, and solves wrong ones again.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/cache/fill.h"
#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

std::string chunk_name(ChunkAt at) { return fmt::format("{}.{}", at.time, at.column); }

// "2/8", counted from 1. Empty: all.
Shard shard_of(const std::string& text)
{
    if (text.empty()) return {};
    const std::size_t slash = text.find('/');
    const auto index = formats::parse_integer(text.substr(0, slash));
    const auto count = formats::parse_integer(slash == std::string::npos ? "" : text.substr(slash + 1));
    if (!index || !count || *index < 1 || *index > *count || *count > UINT32_MAX)
        throw CommandError(
            2, fmt::format("--shard {}: write i/n with i from 1 to n, such as 1/4", formats::printable(text)));
    return {static_cast<std::uint32_t>(*index - 1), static_cast<std::uint32_t>(*count)};
}

// With progress on stderr.
FillReport fill_visibly(const Cache& cache, FillOptions options, bool quiet)
{
    Progress progress("chunks", std::max<std::size_t>(chunks_of(cache.crowd(), options.shard).size(), 1), quiet);
    options.progress = [&](std::uint64_t done) { progress.show(done); };
    return fill(cache, options);
}

// Why a shard has nothing to do; empty: it has something.
std::string note_on(const Cache& cache, const Shard& shard)
{
    const CachedCrowd& crowd = cache.crowd();
    if (!chunks_of(crowd, shard).empty()) return {};
    return crowd.carries_state()
               ? fmt::format(
                     "the shard is empty: each frame depends on those before it, so a shard has whole columns "
                     "of characters, and of these there are {}; swivel store --chunk makes more",
                     crowd.column_count())
               : fmt::format("the shard is empty: there are only {} chunks; swivel store --chunk makes more",
                             std::uint64_t{crowd.time_count()} * crowd.column_count());
}

void print_fill(const FillReport& report, const std::string& note)
{
    for (const Difference& each : report.differences)
        say(stdout, "{}  chunk {}: {}\n", each.is_mended ? "mended " : "differs", chunk_name(each.at), each.what);
    if (!note.empty()) say(stdout, "note     {}\n", note);
    say(stdout, "chunks   {} written, {} left as they were\n", report.written, report.left);
    if (report.limbs > 0)
        say(stdout, "speed    {:.2f} s, {:.1f} million limbs/s\n", report.seconds,
            static_cast<double>(report.limbs) / report.seconds / 1e6);
}

Json json_of(const std::string& folder, const FillReport& report, const std::string& note)
{
    Json out = {{"cache", folder},       {"written", report.written}, {"left", report.left},
                {"limbs", report.limbs}, {"seconds", report.seconds}, {"differences", Json::array()}};
    for (const Difference& each : report.differences)
        out["differences"].push_back({{"chunk", chunk_name(each.at)}, {"what", each.what}, {"mended", each.is_mended}});
    if (!note.empty()) out["notes"] = {note};
    return out;
}

// Throws InputError unless all chunks were right.
void require_right(const Cache& cache, const FillReport& report)
{
    const std::vector<Difference>& found = report.differences;
    if (found.empty()) return;
    const std::uint64_t count = report.written + report.left, mended = report.written;
    const auto is_lost = [](const Difference& each) { return !each.is_mended; };
    const auto lost = std::ranges::find_if(found, is_lost);
    const auto& first = lost == found.end() ? found[0] : *lost;
    const std::string which = fmt::format("the first is {}: {}", chunk_name(first.at), first.what);
    throw formats::InputError(
        cache.folder(),
        lost == found.end()
            ? fmt::format("{} of {} chunks were not right and are written again, {}; run swivel check once more",
                          mended, count, which)
            : fmt::format(
                  "{} of {} chunks are not what the goals give, {}; the goals may be another crowd's, or another "
                  "swivel filled the cache, so they stay: take a copy, or remove their digests and run swivel fill",
                  found.size() - mended, count, which));
}

}  // namespace

void run_fill(const FillCommand& options)
{
    FillOptions how;
    how.shard = shard_of(options.shard);
    how.proves = options.proves;
    how.threads = options.threads;
    const Cache cache(options.folder);
    const FillReport report = fill_visibly(cache, how, options.quiet);
    const std::string note = note_on(cache, how.shard);
    if (options.json)
        print_json(json_of(options.folder, report, note));
    else if (!options.quiet)
        print_fill(report, note);
    require_right(cache, report);
    if (!options.proves) return;
    if (how.shard.count == 1) cache.remove_unfinished();
    if (!options.quiet && !options.json)
        say(stdout, "right    {} chunks: solved again, and all bits are equal\n", report.left);
}

}  // namespace swivel::tools
