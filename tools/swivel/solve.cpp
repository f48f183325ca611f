// SPDX-License-Identifier: MIT
//
// `swivel solve`: binds a clip's skeleton, makes a crowd of it, solves every frame, reports, and writes the poses.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/formats/error.h"
#include "tools/formats/output_file.h"
#include "tools/formats/poses_csv.h"
#include "tools/formats/scene_import.h"
#include "tools/formats/text.h"
#include "tools/swivel/command_error.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_checks.h"
#include "tools/swivel/given_targets.h"
#include "tools/swivel/interrupt.h"
#include "tools/swivel/motion_keys.h"
#include "tools/swivel/parallel.h"
#include "tools/swivel/progress.h"
#include "tools/swivel/report.h"
#include "tools/swivel/solve_report.h"

namespace swivel::tools {

namespace {

// What the options and the crowd file come to.
struct Job {
    std::optional<formats::CrowdFile> crowd;
    std::vector<Limb> limbs;
    std::vector<LimbFinding> missing;
    std::string doubt;  // of the front
    CrowdPlan plan;
    std::string targets;  // "clip" or a file
};

enum class OutKind { none, motion, csv };

OutPlace out_place(const SolveOptions& options)
{
    if (!options.format.empty()) return {options.out, "." + options.format};
    return {options.out, formats::is_standard_stream(options.out) ? ".csv" : formats::lower_suffix(options.out)};
}

OutKind out_kind(const SolveOptions& options, std::uint32_t characters)
{
    if (options.out.empty()) return OutKind::none;
    const std::string suffix = out_place(options).suffix;
    if (suffix == ".csv") return OutKind::csv;
    if (formats::is_scene(options.out))
        throw CommandError(
            2, fmt::format("--out {}: FBX and DAE are read, not written; use .glb, .gltf or .csv", options.out));
    if (!is_bvh(suffix) && !is_gltf(suffix))
        throw CommandError(2, fmt::format("--out {}: no writer for this suffix; use .bvh, .glb, .gltf or .csv, or "
                                          "--format",
                                          options.out));
    if (characters > 1)
        throw CommandError(2, fmt::format("--out {}: a {} file holds one character, not {}; write a .csv", options.out,
                                          is_bvh(suffix) ? "BVH" : "glTF", characters));
    return OutKind::motion;
}

// Standard input can be read once.
void require_one_reader(const std::string& file, const std::string& crowd, const std::string& targets)
{
    const auto count = std::ranges::count_if(std::array{&file, &crowd, &targets},
                                             [](const auto* name) { return formats::is_standard_stream(*name); });
    if (count > 1)
        throw CommandError(2, "more than one of FILE, --crowd and --targets is -, standard input; name the others");
}

// While it lives, reports go to stderr, as stdout is for data. The GNU C Library lets its streams be set like other
// variables.
class ReportsToStderr {
public:
    ReportsToStderr() { stdout = stderr; }
    ReportsToStderr(const ReportsToStderr&) = delete;
    ReportsToStderr& operator=(const ReportsToStderr&) = delete;
    ~ReportsToStderr() { stdout = before_; }

private:
    std::FILE* before_ = stdout;
};

// What is read would be lost.
void require_other_file(const SolveOptions& options, const Job& job)
{
    const auto check = [&](const std::string& input, const char* what) {
        std::error_code ignored;
        if (!formats::is_standard_stream(options.out) && std::filesystem::is_regular_file(options.out, ignored) &&
            std::filesystem::equivalent(options.out, input, ignored))
            throw CommandError(2, fmt::format("--out {}: is {} itself; name another file", options.out, what));
    };
    check(options.file, "the clip");
    if (job.targets != "clip") check(job.targets, "the table of targets");
    if (job.crowd) check(options.crowd, "the crowd file");
}

Statistics solve_clip(const SolveOptions& options, const MotionFile& file, const Job& job)
{
    const OutKind kind = out_kind(options, job.plan.characters);
    if (kind == OutKind::motion && job.crowd) require_fits_motion(*job.crowd, job.limbs);
    GivenTargets given(job.targets, file.clip(), job.limbs, job.plan.characters);
    ClipCrowd crowd(file.clip(), job.limbs, job.plan, options.crowd);
    std::optional<formats::PosesCsv> csv;
    if (kind == OutKind::csv) csv.emplace(options.out, crowd.columns());
    MotionKeys keys(job.limbs, job.plan);
    if (kind == OutKind::motion) {  // says so before the work, not after
        keys.require_can_write(file);
        const formats::OutputFile can_be_written(options.out);
    }
    Statistics statistics;
    {
        Progress progress("frames", file.clip().frame_count, options.quiet);
        for (std::size_t frame = 0; frame < file.clip().frame_count; ++frame) {
            check_interrupt();
            progress.show(frame);
            crowd.set_frame(frame, given.of_frame(frame));
            crowd.solve(statistics);
            crowd.measure(statistics);
            if (csv) csv->append(static_cast<std::uint32_t>(frame), crowd.poses(), crowd.extras());
            if (kind == OutKind::motion) keys.add(crowd);
        }
    }
    if (csv) csv->commit();
    if (kind == OutKind::motion) keys.write(out_place(options), file);
    return statistics;
}

void require_named_limbs_solved(const LimbChoice& choice)
{
    if (choice.kinds == "legs" && !choice.arms.empty())
        throw CommandError(2,
                           fmt::format("--arm names an arm, but {} solves none; use --limbs all", kinds_words(choice)));
    if (choice.kinds == "arms" && !choice.legs.empty())
        throw CommandError(2,
                           fmt::format("--leg names a leg, but {} solves none; use --limbs all", kinds_words(choice)));
}

LimbChoice choice_of(const SolveOptions& options)
{
    LimbChoice choice;
    choice.kinds = options.kinds;
    if (!options.kinds.empty()) choice.kinds_source = {"--limbs"};
    for (const std::string& arm : options.arms) choice.arms.push_back(limb_of_option(arm, "--arm"));
    for (const std::string& leg : options.legs) choice.legs.push_back(limb_of_option(leg, "--leg"));
    require_named_limbs_solved(choice);
    return choice;
}

// The command line before the crowd file before what is so without both.
Job make_job(const SolveOptions& options, LimbChoice choice, const formats::Clip& clip)
{
    Job job;
    if (!options.crowd.empty()) {
        job.crowd = formats::read_crowd_file(options.crowd);
        add_choice(*job.crowd, choice);
        require_named_limbs_solved(choice);
    }
    FoundLimbs found = find_limbs(clip, options.file, choice);
    job.limbs = std::move(found.limbs);
    job.missing = std::move(found.missing);
    job.doubt = std::move(found.doubt);
    job.plan = plan_crowd(job.crowd ? &*job.crowd : nullptr, clip, job.limbs);
    if (options.characters) job.plan.characters = *options.characters;
    if (options.seed) job.plan.seed = *options.seed;
    job.targets = options.targets ? *options.targets : job.crowd ? checked_targets(*job.crowd) : "clip";
    require_one_reader(options.file, options.crowd, job.targets);
    return job;
}

void print_report(const SolveOptions& options, const Statistics& statistics, double seconds, std::size_t mended)
{
    print_statistics(statistics);
    if (const std::string wrong = what_went_wrong(statistics); !wrong.empty()) fmt::print("note     {}\n", wrong);
    fmt::print("time     {:.2f} s in all, {:.3f} s of it solving\n", seconds, statistics.solve_seconds);
    if (mended > 0)
        fmt::print(
            "weights  the skin weights of {} {} did not add up to 1, as glTF asks; in the written file they do\n",
            mended, mended == 1 ? "vertex" : "vertices");
    if (!options.out.empty())
        fmt::print("written  {}\n", formats::is_standard_stream(options.out) ? "to standard output" : options.out);
}

}  // namespace

void run_solve(const SolveOptions& options)
{
    note_interrupts();
    const auto before = std::chrono::steady_clock::now();
    out_kind(options, options.characters.value_or(1));  // usage errors first
    require_one_reader(options.file, options.crowd, options.targets.value_or("clip"));
    const LimbChoice choice = choice_of(options);
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    std::optional<ReportsToStderr> data_goes_out;
    if (formats::is_standard_stream(options.out)) data_goes_out.emplace();
    const MotionFile file(options.file, options.motion);
    if (out_kind(options, 1) == OutKind::motion) file.require_can_write(out_place(options));
    const Job job = make_job(options, choice, file.clip());
    require_other_file(options, job);
    const SolveFacts facts{options.file,        options.crowd, file.describe(), job.targets,
                           job.plan.characters, job.plan.seed, job.missing,     job.doubt};
    if (!options.json && !options.quiet) print_clip(facts, file.clip(), job.limbs);

    const ThreadLimit limit(options.threads);
    const Statistics statistics = solve_clip(options, file, job);
    const bool has_motion = out_kind(options, job.plan.characters) == OutKind::motion;
    const std::size_t mended = has_motion ? file.mended_vertex_count() : 0;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
    const std::string wrong = what_went_wrong(statistics);
    if (options.json) {
        nlohmann::ordered_json out = json_of(facts, file.clip(), job.limbs);
        out.update(json_of(statistics));
        out["seconds"] = seconds;
        if (!wrong.empty()) out["went_wrong"] = wrong;
        if (mended > 0) out["mended_vertices"] = mended;
        if (!options.out.empty()) out["out"] = options.out;
        print_json(out);
    } else if (!options.quiet) {
        print_report(options, statistics, seconds, mended);
    }
    if (options.strict && !wrong.empty()) throw CommandError(1, wrong + " (--strict)");
}

}  // namespace swivel::tools
