// SPDX-License-Identifier: MIT
#include "tools/swivel/crowd_job.h"

#include <fmt/format.h>

#include "tools/cli/command_error.h"
#include "tools/crowd/crowd_checks.h"
#include "tools/formats/error.h"
#include "tools/formats/text.h"
#include "tools/swivel/solve_files.h"

namespace swivel::tools {

namespace {

void require_named_limbs_solved(const LimbChoice& choice)
{
    if (choice.kinds == "legs" && !choice.arms.empty())
        throw CommandError(2,
                           fmt::format("--arm names an arm, but {} solves none; use --limbs all", kinds_words(choice)));
    if (choice.kinds == "arms" && !choice.legs.empty())
        throw CommandError(2,
                           fmt::format("--leg names a leg, but {} solves none; use --limbs all", kinds_words(choice)));
}

Between between_of(const SolveOptions& options, const std::string& targets)
{
    if (options.between.empty()) return Between::clip;
    if (targets == "clip")
        throw CommandError(2, fmt::format("--between {}: is about the rows of a table; give one with --targets FILE",
                                          options.between));
    return options.between == "hold" ? Between::hold : Between::linear;
}

}  // namespace

std::string title_of(const std::string& file)
{
    return formats::is_standard_stream(file) ? "motion" : std::filesystem::path(file).filename().string();
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

CrowdJob make_job(const SolveOptions& options, LimbChoice choice, MotionFile& file)
{
    CrowdJob job;
    if (!options.crowd.empty()) {
        job.crowd = formats::read_crowd_file(options.crowd);
        add_choice(*job.crowd, choice);
        require_named_limbs_solved(choice);
    }
    const formats::Clip& clip = file.clip();
    const FigureJoints joints = choose_joints(clip, options.file, choice);
    file.sample(joints_of(joints));
    LimbSearch search = bind_limbs(clip, joints, choice);
    job.limbs = require_limbs(search, options.file);
    for (LimbFinding& finding : search.findings)
        if (!finding.limb) job.missing.push_back(std::move(finding));
    job.plan = plan_crowd(job.crowd ? &*job.crowd : nullptr, clip, job.limbs);
    if (options.characters) job.plan.characters = *options.characters;
    if (clip.frame_time == 0 && job.plan.characters > 1)
        throw formats::InputError(options.file,
                                  "its keys lie at uneven times, and the characters of a crowd start at "
                                  "different frames; give --fps");
    if (options.seed) job.plan.seed = *options.seed;
    job.targets = options.targets ? *options.targets : job.crowd ? checked_targets(*job.crowd) : "clip";
    require_one_reader(options, job.targets);
    job.given.emplace(job.targets, between_of(options, job.targets), clip, job.limbs, job.plan.characters);
    if (options.frames > 0 && options.frames < clip.frame_count) file.cut(options.frames);
    return job;
}

}  // namespace swivel::tools
