// SPDX-License-Identifier: MIT
//
// `swivel solve`: binds a clip's skeleton, makes a crowd of it, solves every frame, reports, and writes the poses.
// `swivel view` does the same for the page alone.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cache/cache.h"
#include "tools/cache/column.h"
#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/streams.h"
#include "tools/crowd/crowd_checks.h"
#include "tools/crowd/heading.h"
#include "tools/crowd/parallel.h"
#include "tools/formats/output_file.h"
#include "tools/formats/poses_csv.h"
#include "tools/formats/text.h"
#include "tools/swivel/cached_clip.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/motion_keys.h"
#include "tools/swivel/report.h"
#include "tools/swivel/run_files.h"
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

// The page of a cache's crowd: of its first characters, or of all of them.
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
    const std::uint32_t wide = crowd.chunk.characters, columns = crowd.has_given ? (count + wide - 1) / wide : 0;
    std::vector<ChunkGoals> goals(columns);  // given ones of each column, in the time chunk at hand
    const std::uint32_t frames = std::min(crowd.clip_frames, crowd.frame_count);  // as a page of the clip has them
    Progress progress("frames", frames, options.quiet);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        progress.show(frame);
        solved.set_frame(frame);
        const std::uint32_t time = frame / crowd.chunk.frames, in_chunk = frame % crowd.chunk.frames;
        std::vector<GivenPlace> given;
        for (std::uint32_t column = 0; column < columns; ++column) {
            if (in_chunk == 0) goals[column] = cache.goals({time, column});
            put_given(crowd, goals[column], in_chunk, column * wide, solved, &given);
        }
        solved.solve();
        page.add_frame(solved, given);
    }
    page.commit(crowd, solved);
    if (!options.quiet && !formats::is_standard_stream(options.view)) say(stdout, "written  {}\n", options.view);
}

Statistics solve_clip(const SolveOptions& options, const MotionFile& file, CrowdJob& job)
{
    const OutKind kind = out_kind(options.out, job.plan.characters);
    if (kind == OutKind::motion && job.crowd) require_fits_motion(*job.crowd, job.limbs);
    std::optional<ViewPage> page;
    if (!options.view.empty()) page.emplace(options.view);
    ClipCrowd crowd(file.clip(), job.limbs, job.plan);
    std::optional<formats::PosesCsv> csv;
    if (kind == OutKind::csv) csv.emplace(options.out, crowd.columns());
    std::optional<formats::TargetsCsv> exported;
    if (!options.export_targets.empty()) exported.emplace(options.export_targets);
    // New frames where the clip's own do not fit, else the file's own keys of the limbs.
    const bool has_new_frames = !job.plan.clips.empty() || job.plan.characters > 1 || !job.plan.agents.empty() ||
                                job.frame_count < job.clip_frames || job.plan.ground;
    std::optional<MotionKeys> keys;
    if (kind == OutKind::motion) {  // says so before the work, not after
        keys.emplace(file.clip(), job.limbs, job.plan, has_new_frames);
        keys->require_can_write(options.out, file, job.frame_count);
        const formats::OutputFile can_be_written(options.out);
    }
    Statistics statistics;
    {
        Progress progress("frames", job.frame_count, options.quiet);
        for (std::size_t frame = 0; frame < job.frame_count; ++frame) {
            progress.show(frame);
            crowd.set_frame(frame, job.given->of_frame(frame));
            if (exported) exported->append(crowd.targets());
            crowd.solve(statistics);
            crowd.measure(statistics);
            if (csv) csv->append(static_cast<std::uint32_t>(frame), crowd.poses(), crowd.extras());
            if (keys) keys->add(crowd);
            if (page) page->add_frame(crowd.goal_crowd(), crowd.given_places());
        }
    }
    if (csv) csv->commit();
    if (exported) exported->commit();
    if (keys) keys->write(options.out, file, crowd.goal_crowd().characters());
    if (page)
        page->commit(cached_clip({title_of(options.file), motion_of(file, job)}, file.clip(), job.limbs, job.plan,
                                 crowd.motion()),
                     crowd.goal_crowd(), page_skin(file, job));
    return statistics;
}

// The unit of a clip's lengths, by the limbs that are solved.
LengthUnit unit_of(const MotionFile& file, const CrowdJob& job)
{
    double length[2] = {};
    for (const Limb& limb : job.limbs)
        length[limb.name.kind == formats::LimbKind::leg] = limb.bound.lengths[0] + limb.bound.lengths[1];
    return length_unit(file.is_in_metres(), length[1], length[0]);
}

void print_report(std::FILE* to, const SolveOptions& options, const Statistics& statistics, const LengthUnit& unit,
                  double seconds)
{
    print_statistics(to, statistics, unit);
    say(to, "time     {:.2f} s in all, {:.3f} s of it solving\n", seconds, statistics.solve_seconds);
    print_written(to, {options.out, options.export_targets, options.view});
}

Json json_of_run(const SolveOptions& options, const MotionFile& file, const CrowdJob& job, const Statistics& statistics,
                 double seconds)
{
    Json out = json_of_clip(options, file, job);
    for (const goal_character& each : characters_of(job.plan, job.limbs, file.clip().frame_count)) {
        out["each_character"].push_back(
            {{"place", each.place}, {"size", each.size}, {"start", each.first + each.start}});
        Json& character = out["each_character"].back();
        if (!job.plan.agents.empty()) character["name"] = job.plan.agents[out["each_character"].size() - 1].name;
        if (job.plan.has_headings()) character["heading_deg"] = degrees_of(each);
        if (job.plan.carry) character["carries"] = each.carries == 1;
        if (!job.plan.clips.empty())
            character["performs"] =
                std::ranges::find(job.plan.clips, each.first, &ClipPart::first) - job.plan.clips.begin();
    }
    out.update(json_of(statistics));
    out["seconds"] = seconds;
    if (!options.out.empty()) out["out"] = options.out;
    if (!options.export_targets.empty()) out["export_targets"] = options.export_targets;
    if (!options.view.empty()) out["view"] = options.view;
    return out;
}

}  // namespace

void run_solve(const SolveOptions& options)
{
    const auto before = std::chrono::steady_clock::now();
    const bool is_motion =
        out_kind(options.out, options.characters.value_or(1)) == OutKind::motion;  // usage errors first
    require_one_reader(options, options.targets.value_or("clip"));
    const LimbChoice choice = choice_of(options);
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const std::array outputs{options.out, options.export_targets, options.view};
    std::FILE* const reports = report_stream(outputs);
    MotionFile file(options.file, options.motion);
    if (is_motion) file.require_can_write(options.out, false, " or .csv");
    CrowdJob job = make_job(options, choice, file);
    require_own_files(outputs, options, file, job);
    if (!options.json && !options.quiet) print_clip(reports, options, file, job);

    const ThreadLimit limit(options.threads);
    const Statistics statistics = solve_clip(options, file, job);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    if (options.json)
        print_json(json_of_run(options, file, job, statistics, seconds), reports);
    else if (!options.quiet)
        print_report(reports, options, statistics, unit_of(file, job), seconds);
    require_went_well(statistics, options.file);
}

void run_view(SolveOptions options, const std::string& about_clip)
{
    if (options.file.empty()) {
        options.file = shared_file("figure.glb").string();
        if (options.crowd.empty()) options.crowd = shared_file("figure.toml").string();
        if (options.frames == 0) options.frames = 300;  // of 30 a second
    }
    std::error_code ignored;
    const bool is_cache = std::filesystem::is_directory(options.file, ignored);
    const std::filesystem::path named = is_cache ? folder_name(options.file) : std::filesystem::path(options.file);
    if (options.view.empty()) options.view = title_of(named.string()) + ".html";
    is_cache ? view_cache(options, about_clip) : run_solve(options);
}

}  // namespace swivel::tools
