// SPDX-License-Identifier: MIT
//
// `swivel store`: makes a cache of a clip's crowd, with all goals and no poses yet.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "tools/cache/cache_maker.h"
#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/crowd/clip_crowd.h"
#include "tools/crowd/crowd_plan.h"
#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/swivel/cached_clip.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/report.h"
#include "tools/swivel/run_files.h"

namespace swivel::tools {

namespace {

// Adds the given goals of one frame to those of its time chunk, by column. frame: in the chunk.
void add_given(std::uint32_t frame, const ClipCrowd& solved, const CachedCrowd& crowd,
               std::map<std::uint32_t, ChunkGoals>& columns)
{
    const std::size_t limbs = crowd.limb_count(), wide = crowd.chunk.characters;
    for (const GivenPlace& place : solved.given_places()) {
        ChunkGoals& goals = columns[place.character / crowd.chunk.characters];
        if (goals.target.empty()) {
            const std::size_t count = crowd.chunk.frames * limbs * wide;
            goals.target.assign(3 * count, std::numeric_limits<double>::quiet_NaN());
            goals.pole = goals.target;
            goals.hand.assign(4 * count, std::numeric_limits<float>::quiet_NaN());
        }
        const std::size_t at = (frame * limbs + place.limb) * wide + place.character % wide;
        const goal_input& input = solved.goal_crowd().input(place.limb, place.character);
        std::copy_n(input.target, 3, &goals.target[3 * at]);
        if (input.weights[2] > 0) std::copy_n(input.pole, 3, &goals.pole[3 * at]);
        std::copy_n(input.hand, 4, &goals.hand[4 * at]);
    }
}

void write_characters(CacheMaker& maker, const CrowdJob& job, bool quiet)
{
    const CachedCrowd& crowd = maker.crowd();
    CharacterStream stream(job.plan, job.limbs, crowd.clip_frames);
    Progress progress("characters", crowd.character_count, quiet);
    for (std::uint32_t column = 0; column < crowd.column_count(); ++column) {
        progress.show(std::uint64_t{column} * crowd.chunk.characters);
        std::vector<goal_character> characters(crowd.characters_in(column));
        for (goal_character& character : characters) character = stream.next();
        maker.write_characters(column, characters);
    }
}

// Writes the goals that the formula does not make.
void write_goals(CacheMaker& maker, const StoreOptions& options, const MotionFile& file, CrowdJob& job)
{
    const CachedCrowd& crowd = maker.crowd();
    if (!crowd.has_given) return;
    ClipCrowd given(file.clip(), job.limbs, job.plan);
    Progress progress("frames", crowd.frame_count, options.crowd.quiet);
    for (std::uint32_t time = 0; time < crowd.time_count(); ++time) {
        std::map<std::uint32_t, ChunkGoals> columns;
        for (std::uint32_t n = 0; n < crowd.frames_in(time); ++n) {
            const std::uint32_t frame = time * crowd.chunk.frames + n;
            progress.show(frame);
            given.set_frame(frame, job.given->of_frame(frame));
            add_given(n, given, crowd, columns);
        }
        for (const auto& [column, goals] : columns) maker.write_goals({time, column}, goals);
    }
}

// "8,4096": frames and characters. Throws CommandError.
ChunkShape chunk_of(const std::string& text)
{
    const std::size_t comma = text.find(',');
    const auto frames = formats::parse_integer(text.substr(0, comma));
    const auto characters = formats::parse_integer(comma == std::string::npos ? "" : text.substr(comma + 1));
    if (!frames || !characters || *frames < 1 || *frames > 65'536 || *characters < 1 || *characters > 1'048'576 ||
        *characters % SWIVEL_LANES != 0)
        throw CommandError(
            2, fmt::format("--chunk {}: write FRAMES,CHARACTERS, such as 8,4096: at most 65536 and 1048576, "
                           "and the characters a multiple of {}",
                           formats::printable(text), int{SWIVEL_LANES}));
    return {static_cast<std::uint32_t>(*frames), static_cast<std::uint32_t>(*characters)};
}

// The size of all chunks of an array.
std::uint64_t bytes_of(const ZarrArray& array) { return std::uint64_t{array.chunk_bytes()} * array.chunk_count(); }

CachedCrowd crowd_to_store(const StoreOptions& options, const MotionFile& file, const CrowdJob& job)
{
    const formats::Clip& clip = file.clip();
    if (job.plan.budget_blocks > 0)
        throw formats::InputError(
            options.crowd.crowd,
            "has a budget, which is for live crowds: a cache solves all limbs; leave [budget] out");
    CachedCrowd crowd = cached_clip({title_of(options.crowd.file), motion_of(file, job)}, clip, job.limbs, job.plan,
                                    ClipMotion(clip, job.limbs, job.plan));
    crowd.frame_count = options.crowd.frames > 0 ? options.crowd.frames : static_cast<std::uint32_t>(job.frame_count);
    crowd.has_given = job.given->count(job.frame_count) > 0;
    crowd.has_poses = !options.no_poses;
    crowd.chunk = options.chunk.empty()
                      ? chunk_shape(crowd.frame_count, crowd.character_count, crowd.limb_count(), crowd.carries_state())
                      : chunk_of(options.chunk);
    return crowd;
}

}  // namespace

void run_store(const StoreOptions& options)
{
    require_one_reader(options.crowd, options.crowd.targets.value_or("clip"));
    if (!options.chunk.empty()) chunk_of(options.chunk);  // usage errors first
    if (formats::is_standard_stream(options.folder)) throw CommandError(2, "CACHE: a cache is a folder; name one");
    require_new(options.folder);  // before long files are read
    const LimbChoice choice = choice_of(options.crowd);
    MotionFile file(options.crowd.file, options.crowd.motion);
    CrowdJob job = make_job(options.crowd, choice, file);
    if (!options.crowd.quiet && !options.crowd.json) print_clip(stdout, options.crowd, file, job);
    CachedCrowd to_store = crowd_to_store(options, file, job);
    CacheMaker maker(options.folder, std::move(to_store));
    const CachedCrowd& crowd = maker.crowd();
    write_characters(maker, job, options.crowd.quiet);
    write_goals(maker, options, file, job);
    const std::uint64_t goals = maker.commit();
    const CacheArrays arrays(crowd);
    std::uint64_t poses = 0, state = 0;
    for (std::size_t n = 0; n < arrays.fields.size(); ++n)
        if (!arrays.fields[n].is_state_alone) poses += bytes_of(arrays.results[n]);
    for (const ZarrArray& array : arrays.state) state += bytes_of(array);
    const std::uint64_t chunks = std::uint64_t{crowd.time_count()} * crowd.column_count();
    if (options.crowd.json) {
        Json out = json_of_clip(options.crowd, file, job);
        out["cache"] = {{"folder", options.folder},
                        {"frames", crowd.frame_count},
                        {"chunks", chunks},
                        {"columns", crowd.column_count()},
                        {"chunk_frames", crowd.chunk.frames},
                        {"chunk_characters", crowd.chunk.characters},
                        {"goal_bytes", goals},
                        {"state_bytes", state},
                        {"pose_bytes", crowd.has_poses ? poses : 0}};
        return print_json(out);
    }
    if (options.crowd.quiet) return;
    const auto megabytes = [](std::uint64_t bytes) { return static_cast<double>(bytes) / 1e6; };
    say(stdout, "cache    {}: {} frames in {} chunks, each of {} frames and {} characters\n", options.folder,
        crowd.frame_count, chunks, crowd.chunk.frames, crowd.chunk.characters);
    say(stdout, "bytes    goals {:.1f} MB, state {:.1f} MB, poses {:.1f} MB{}\n", megabytes(goals), megabytes(state),
        megabytes(poses), crowd.has_poses ? "" : ", which the cache does not keep");
    say(stdout, "next     swivel fill {0}, then swivel check {0}\n", options.folder);
}

}  // namespace swivel::tools
