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
#include "tools/cli/signals.h"
#include "tools/cli/streams.h"
#include "tools/crowd/clip_crowd.h"
#include "tools/crowd/crowd_plan.h"
#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/swivel/cached_clip.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/report.h"
#include "tools/swivel/solve_files.h"
#include "tools/swivel/solve_report.h"

namespace swivel::tools {

namespace {

// The blocks that a budget chooses, frame by frame. The choice needs the whole crowd, and of it the priorities alone.
class BlockChoice {
public:
    explicit BlockChoice(const CachedCrowd& crowd)
        : crowd_(crowd),
          chooser_(groups_of(crowd)),
          urgency_(swivel_block_count(chooser_.get())),
          mask_((urgency_.size() + 1) / 2)
    {
    }

    // Of the next frame: whether it solves a block of a limb. The first frame solves all.
    void next()
    {
        std::vector<swivel_in> priorities;
        for (const CachedLimb& limb : crowd_.limbs) priorities.push_back({&limb.setup.priority, 0});
        if (frame_++ == 0)
            std::ranges::fill(mask_, ~0u);
        else
            chooser_.choose(priorities, urgency_, crowd_.budget_blocks, mask_);
    }
    bool has(std::size_t limb, std::uint32_t block) const
    {
        const std::uint32_t first = swivel_group_first_limb(chooser_.get(), static_cast<std::uint32_t>(limb));
        const std::uint32_t n = first + block * SWIVEL_LANES;
        return (mask_[n / 32] >> n % 32 & 1u) != 0;
    }

private:
    static std::vector<swivel_group_def> groups_of(const CachedCrowd& crowd)
    {
        return std::vector<swivel_group_def>(crowd.limbs.size(), group(crowd.character_count));
    }

    const CachedCrowd& crowd_;
    Crowd chooser_;
    std::vector<float> urgency_;
    std::vector<std::uint32_t> mask_;
    std::uint64_t frame_ = 0;
};

// The goals of one time chunk, by column, as far as there are any.
class GoalChunks {
public:
    GoalChunks(const CachedCrowd& crowd, std::uint32_t time) : crowd_(crowd), time_(time) {}

    void add_given(std::uint32_t frame, const ClipCrowd& solved)
    {
        const std::size_t limbs = crowd_.limbs.size(), wide = crowd_.chunk.characters;
        for (const GivenPlace& place : solved.given_places()) {
            ChunkGoals& goals = columns_[place.character / crowd_.chunk.characters];
            if (goals.target.empty()) {
                const std::size_t count = crowd_.chunk.frames * limbs * wide;
                const float none = std::numeric_limits<float>::quiet_NaN();
                goals.target.assign(3 * count, none);
                goals.pole.assign(3 * count, none);
                goals.hand.assign(4 * count, none);
            }
            const std::size_t at = (frame * limbs + place.limb) * wide + place.character % wide;
            const goal_input& input = solved.goal_crowd().input(place.limb, place.character);
            std::copy_n(input.target, 3, &goals.target[3 * at]);
            std::copy_n(input.pole, 3, &goals.pole[3 * at]);
            std::copy_n(input.hand, 4, &goals.hand[4 * at]);
        }
    }

    void add_choice(std::uint32_t frame, const BlockChoice& choice)
    {
        const std::uint32_t wide = crowd_.chunk.characters / SWIVEL_LANES;
        for (std::uint32_t column = 0; column < crowd_.column_count(); ++column) {
            ChunkGoals& goals = columns_[column];
            goals.chosen.resize(crowd_.chunk.frames * crowd_.limbs.size() * wide);
            const std::uint32_t here = (crowd_.characters_in(column) + SWIVEL_LANES - 1) / SWIVEL_LANES;
            for (std::size_t limb = 0; limb < crowd_.limbs.size(); ++limb)
                for (std::uint32_t block = 0; block < here; ++block)
                    goals.chosen[(frame * crowd_.limbs.size() + limb) * wide + block] =
                        choice.has(limb, column * wide + block);
        }
    }

    void write(CacheMaker& maker) const
    {
        for (const auto& [column, goals] : columns_) maker.write_goals({time_, column}, goals);
    }

private:
    const CachedCrowd& crowd_;
    std::uint32_t time_;
    std::map<std::uint32_t, ChunkGoals> columns_;
};

void write_characters(CacheMaker& maker, const CrowdJob& job, const StopSignals& signals, bool quiet)
{
    const CachedCrowd& crowd = maker.crowd();
    CharacterStream stream(job.plan, job.limbs, crowd.clip_frames);
    Progress progress("characters", crowd.character_count, quiet);
    for (std::uint32_t column = 0; column < crowd.column_count(); ++column) {
        signals.check();
        progress.show(std::uint64_t{column} * crowd.chunk.characters);
        std::vector<goal_character> characters(crowd.characters_in(column));
        for (goal_character& character : characters) character = stream.next();
        maker.write_characters(column, characters);
    }
}

// What the formula of goals does not give.
void write_goals(CacheMaker& maker, const StoreOptions& options, const MotionFile& file, CrowdJob& job,
                 const StopSignals& signals)
{
    const CachedCrowd& crowd = maker.crowd();
    if (!crowd.has_given && crowd.budget_blocks == 0) return;
    std::optional<ClipCrowd> given;
    if (crowd.has_given) given.emplace(file.clip(), job.limbs, job.plan, options.crowd.crowd);
    std::optional<BlockChoice> choice;
    if (crowd.budget_blocks > 0) choice.emplace(crowd);
    Progress progress("frames", crowd.frame_count, options.crowd.quiet);
    for (std::uint32_t time = 0; time < crowd.time_count(); ++time) {
        GoalChunks chunks(crowd, time);
        for (std::uint32_t n = 0; n < crowd.frames_in(time); ++n) {
            signals.check();
            const std::uint32_t frame = time * crowd.chunk.frames + n;
            progress.show(frame);
            if (given) {
                given->set_frame(frame, job.given->of_frame(frame));
                chunks.add_given(n, *given);
            }
            if (choice) {
                choice->next();
                chunks.add_choice(n, *choice);
            }
        }
        chunks.write(maker);
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

// What all chunks of some arrays take, before they are packed, in MB.
double megabytes_of(const std::vector<ZarrArray>& arrays)
{
    double bytes = 0;
    for (const ZarrArray& array : arrays)
        bytes += static_cast<double>(array.chunk_bytes()) * static_cast<double>(array.chunk_count());
    return bytes / 1e6;
}

CachedCrowd crowd_to_store(const StoreOptions& options, const MotionFile& file, const CrowdJob& job)
{
    const formats::Clip& clip = file.clip();
    const LimbCrowds one(limb_setups(job.limbs, job.plan), 1, job.plan.budget_blocks, options.crowd.crowd);
    CachedCrowd crowd = cached_clip({title_of(options.crowd.file), file.describe()}, clip, job.limbs, job.plan,
                                    ClipMotion(clip, job.limbs));
    if (options.crowd.frames > 0) crowd.frame_count = options.crowd.frames;
    crowd.has_given = job.given->count(clip.frame_count) > 0;
    crowd.keep = options.keep == "goals" ? Keep::goals : options.keep == "poses" ? Keep::poses : Keep::both;
    crowd.is_compressed = options.compressed;
    crowd.chunk = options.chunk.empty() ? chunk_shape(crowd.frame_count, crowd.character_count, crowd.limbs.size())
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
    const SolveFacts facts{options.crowd.file,  options.crowd.crowd, file.describe(), job.targets,
                           job.plan.characters, job.plan.seed,       job.missing,     file.notes()};
    if (!options.crowd.json && !options.crowd.quiet) print_clip(stdout, facts, file.clip(), job.limbs);
    CachedCrowd to_store = crowd_to_store(options, file, job);
    const StopSignals signals;
    CacheMaker maker(options.folder, std::move(to_store));
    const CachedCrowd& crowd = maker.crowd();
    write_characters(maker, job, signals, options.crowd.quiet);
    write_goals(maker, options, file, job, signals);
    signals.check();
    const double goals = static_cast<double>(maker.commit()) / 1e6;
    const CacheArrays arrays(crowd);
    const double poses = megabytes_of(arrays.results), state = megabytes_of(arrays.state);
    const std::uint64_t chunks = std::uint64_t{crowd.time_count()} * crowd.column_count();
    if (options.crowd.json) {
        print_json({{"cache", options.folder},
                    {"frames", crowd.frame_count},
                    {"characters", crowd.character_count},
                    {"limbs", crowd.limbs.size()},
                    {"chunk", {crowd.chunk.frames, crowd.chunk.characters}},
                    {"chunks", chunks},
                    {"keep", options.keep},
                    {"carries_state", crowd.carries_state()},
                    {"goals_bytes", goals * 1e6},
                    {"poses_bytes", poses * 1e6},
                    {"state_bytes", state * 1e6}});
    } else if (!options.crowd.quiet) {
        say(stdout, "cache    {}: {} frames in {} chunks, each of {} frames and {} characters\n", options.folder,
            crowd.frame_count, chunks, crowd.chunk.frames, crowd.chunk.characters);
        say(stdout, "bytes    goals {:.1f} MB, state {:.1f} MB, poses {:.1f} MB{}; --store {} keeps {:.1f} MB\n", goals,
            state, poses, crowd.is_compressed ? " before they are packed" : "", options.keep,
            (crowd.keep == Keep::poses ? 0 : goals + state) + (crowd.keep == Keep::goals ? 0 : poses));
        say(stdout, "next     swivel fill {0}, then swivel check {0}\n", options.folder);
    }
}

}  // namespace swivel::tools
