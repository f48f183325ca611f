// SPDX-License-Identifier: MIT
//
// `swivel view` of a cache: the page of its crowd.
#include <fmt/format.h>

#include <algorithm>

#include "tools/cache/column.h"
#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/crowd/parallel.h"
#include "tools/formats/text.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/view_page.h"

namespace swivel::tools {

namespace {

std::vector<goal_character> first_characters(const Cache& cache, std::uint32_t count)
{
    std::vector<goal_character> characters;
    for (std::uint32_t column = 0; characters.size() < count; ++column) {
        const std::vector<goal_character> more = cache.characters(column);
        characters.insert(characters.end(), more.begin(), more.end());
    }
    characters.resize(count);
    return characters;
}

// Goals of one's own of a cache's first characters, frame by frame, in order.
class GivenGoals {
public:
    explicit GivenGoals(const Cache& cache) : cache_(cache) {}

    // Puts those of a frame in the formula's place. Returns the limbs that had some.
    std::vector<GivenPlace> put(std::uint32_t frame, GoalCrowd& solved)
    {
        const CachedCrowd& crowd = cache_.crowd();
        std::vector<GivenPlace> places;
        if (!crowd.has_given) return places;
        const auto columns = (solved.character_count() + crowd.chunk.characters - 1) / crowd.chunk.characters;
        goals_.resize(columns);
        const std::uint32_t time = frame / crowd.chunk.frames, in_chunk = frame % crowd.chunk.frames;
        for (std::uint32_t column = 0; column < columns; ++column) {
            if (in_chunk == 0) goals_[column] = cache_.goals({time, column});
            put_given(crowd, goals_[column], in_chunk, column * crowd.chunk.characters, solved, &places);
        }
        return places;
    }

private:
    const Cache& cache_;
    std::vector<ChunkGoals> goals_;  // of each column, in the time chunk at hand
};

}  // namespace

void view_cache(const SolveOptions& options, const std::string& about_clip)
{
    if (!about_clip.empty())
        throw CommandError(2, fmt::format("{}: the cache has its crowd already; leave the option out", about_clip));
    const Cache cache(options.file);
    const CachedCrowd& crowd = cache.crowd();
    const std::uint32_t count = options.characters.value_or(crowd.character_count);
    if (count > crowd.character_count)
        throw CommandError(2, fmt::format("--characters {}: the cache has {}", count, crowd.character_count));
    require_memory(cache.folder(), crowd, cache.arrays(), count, "ask for fewer by --characters");
    ViewPage page(options.view);
    const std::vector<LimbSetup> setups = setups_of(crowd);
    const ThreadLimit limit(options.threads);
    GoalCrowd solved(setups, sources_of(crowd), first_characters(cache, count), 0, ground_of(crowd),
                     crowd.frame_seconds);
    GivenGoals goals(cache);
    const std::uint32_t frames = std::min(crowd.clip_frames, crowd.frame_count);  // as a page of the clip has them
    Progress progress("frames", frames, options.quiet);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        progress.show(frame);
        solved.set_frame(frame);
        const std::vector<GivenPlace> given = goals.put(frame, solved);
        solved.solve();
        page.add_frame(solved, given);
    }
    page.commit(crowd, solved);
    if (!options.quiet && !formats::is_standard_stream(options.view)) say(stdout, "written  {}\n", options.view);
}

}  // namespace swivel::tools
