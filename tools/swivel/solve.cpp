// SPDX-License-Identifier: MIT
//
// `swivel solve`: binds a clip's skeleton, makes a crowd of it, solves every frame, reports, and writes the poses.
// `swivel view` does the same for the page alone.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/cache/cache.h"
#include "tools/cli/command_error.h"
#include "tools/cli/progress.h"
#include "tools/cli/signals.h"
#include "tools/cli/streams.h"
#include "tools/crowd/crowd_checks.h"
#include "tools/crowd/given_targets.h"
#include "tools/crowd/parallel.h"
#include "tools/formats/error.h"
#include "tools/formats/output_file.h"
#include "tools/formats/poses_csv.h"
#include "tools/formats/text.h"
#include "tools/swivel/cached_clip.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/motion_keys.h"
#include "tools/swivel/report.h"
#include "tools/swivel/report_file.h"
#include "tools/swivel/solve_files.h"
#include "tools/swivel/solve_html.h"
#include "tools/swivel/solve_report.h"
#include "tools/swivel/view_page.h"

namespace swivel::tools {

namespace {

// A page holds goals of one's own, and they may be many.
void print_page_size(const SolveOptions& options, std::uint64_t goal_count)
{
    if (options.view.empty() || options.quiet || options.json || goal_count == 0) return;
    const double kilobytes = static_cast<double>(goal_count) * kPageBytesPerGoal / 1e3;
    const std::string size =
        kilobytes < 1000 ? fmt::format("{:.0f} kB", std::ceil(kilobytes)) : fmt::format("{:.1f} MB", kilobytes / 1e3);
    say(report_stream(options), "page     your {} target{} of it{}\n", goal_count,
        goal_count == 1 ? " takes " + size : "s take " + size,
        goal_count > 100'000 ? "; swivel view --frames takes fewer" : "");
}

Statistics solve_clip(const SolveOptions& options, const MotionFile& file, CrowdJob& job, const StopSignals& signals,
                      SolveHtml* report)
{
    const OutKind kind = out_kind(options, job.plan.characters);
    if (kind == OutKind::motion && job.crowd) require_fits_motion(*job.crowd, job.limbs);
    std::optional<ViewPage> page;
    if (!options.view.empty()) page.emplace(options.view);
    print_page_size(options, job.given->count(file.clip().frame_count));
    ClipCrowd crowd(file.clip(), job.limbs, job.plan, options.crowd);
    std::optional<formats::PosesCsv> csv;
    if (kind == OutKind::csv) csv.emplace(options.out, crowd.columns());
    std::optional<formats::TargetsCsv> exported;
    if (!options.export_targets.empty()) exported.emplace(options.export_targets);
    MotionKeys keys(job.limbs, job.plan);
    if (kind == OutKind::motion) {  // says so before the work, not after
        keys.require_can_write(file);
        const formats::OutputFile can_be_written(options.out);
    }
    Statistics statistics;
    {
        Progress progress("frames", file.clip().frame_count, options.quiet);
        for (std::size_t frame = 0; frame < file.clip().frame_count; ++frame) {
            signals.check();
            progress.show(frame);
            crowd.set_frame(frame, job.given->of_frame(frame));
            if (exported) exported->append(crowd.targets());
            Statistics of_frame;
            crowd.solve(of_frame);
            crowd.measure(of_frame);
            statistics.add(of_frame);
            if (report) report->add_frame(of_frame, crowd);
            if (csv) csv->append(static_cast<std::uint32_t>(frame), crowd.poses(), crowd.extras());
            if (kind == OutKind::motion) keys.add(crowd);
            if (page) page->add_frame(crowd.goal_crowd(), crowd.given_places());
        }
    }
    signals.check();
    if (csv) csv->commit();
    signals.check();
    if (exported) exported->commit();
    signals.check();
    if (kind == OutKind::motion) keys.write(out_place(options), file);
    if (!page) return statistics;
    signals.check();
    page->commit(
        cached_clip({title_of(options.file), file.describe()}, file.clip(), job.limbs, job.plan, crowd.motion()),
        crowd.goal_crowd());
    return statistics;
}

// Where links lead; empty where the page has no name.
std::string page_of(const SolveOptions& options)
{
    return formats::is_standard_stream(options.view) ? "" : options.view;
}

void print_report(std::FILE* to, const SolveOptions& options, const Statistics& statistics, double seconds)
{
    print_statistics(to, statistics);
    say(to, "time     {:.2f} s in all, {:.3f} s of it solving\n", seconds, statistics.solve_seconds);
    for (const std::string& name : {options.out, options.export_targets, options.view, options.report})
        if (!name.empty())
            say(to, "written  {}\n", formats::is_standard_stream(name) ? "to standard output" : shown_file(name));
}

nlohmann::ordered_json json_of_run(const SolveOptions& options, const SolveFacts& facts, const MotionFile& file,
                                   const CrowdJob& job, const Statistics& statistics, double seconds)
{
    nlohmann::ordered_json out = json_of(facts, file.clip(), job.limbs);
    out["each_character"] = json_of(characters_of(job.plan, job.limbs, file.clip().frame_count));
    out.update(json_of(statistics));
    out["seconds"] = seconds;
    if (!options.out.empty()) out["out"] = options.out;
    if (!options.export_targets.empty()) out["export_targets"] = options.export_targets;
    if (!options.view.empty()) out["view"] = options.view;
    if (!options.report.empty()) out["report"] = options.report;
    return out;
}

}  // namespace

void run_solve(const SolveOptions& options)
{
    const auto before = std::chrono::steady_clock::now();
    out_kind(options, options.characters.value_or(1));  // usage errors first
    require_one_reader(options, options.targets.value_or("clip"));
    const LimbChoice choice = choice_of(options);
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    std::FILE* const reports = report_stream(options);
    MotionFile file(options.file, options.motion);
    if (out_kind(options, 1) == OutKind::motion) file.require_can_write(out_place(options));
    CrowdJob job = make_job(options, choice, file);
    require_own_files(options, file, job.targets);
    require_html_name(options.view_option, options.view);
    require_html_name("--report", options.report);
    const SolveFacts facts{options.file,        options.crowd, file.describe(), job.targets,
                           job.plan.characters, job.plan.seed, job.missing,     file.notes()};
    if (!options.json && !options.quiet) print_clip(reports, facts, file.clip(), job.limbs);

    const ThreadLimit limit(options.threads);
    const StopSignals signals;  // from here on there may be files to remove
    std::optional<SolveHtml> report;
    if (!options.report.empty())
        report.emplace(options.report, page_of(options), "swivel solve " + title_of(options.file));
    const Statistics statistics = solve_clip(options, file, job, signals, report ? &*report : nullptr);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    if (report) {
        signals.check();
        report->commit(json_of_run(options, facts, file, job, statistics, seconds));
    }
    if (options.json)
        print_json(json_of_run(options, facts, file, job, statistics, seconds), reports);
    else if (!options.quiet)
        print_report(reports, options, statistics, seconds);
    if (options.strict && went_wrong(statistics)) throw CommandError(1, "--strict: " + what_went_wrong(statistics));
}

void run_view(SolveOptions options, const std::string& about_clip)
{
    std::error_code ignored;
    const bool is_cache = std::filesystem::is_directory(options.file, ignored);
    const std::filesystem::path named = is_cache ? folder_name(options.file) : std::filesystem::path(options.file);
    if (options.view.empty()) options.view = title_of(named.string()) + ".html";
    if (is_cache) require_html_name(options.view_option, options.view);
    is_cache ? view_cache(options, about_clip) : run_solve(options);
}

}  // namespace swivel::tools
