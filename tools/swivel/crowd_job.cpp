// SPDX-License-Identifier: MIT
#include "tools/swivel/crowd_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/cli/command_error.h"
#include "tools/crowd/crowd_checks.h"
#include "tools/feet/leg_motion.h"
#include "tools/feet/standing.h"
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

// The joint that all limbs hang on, or the first one.
int common_joint(const formats::Clip& clip, std::span<const Limb> limbs)
{
    int body = joint_at(clip, limbs.front().upper()).parent;
    for (const Limb& limb : limbs)
        if (body >= 0) body = fork_of(clip, body, limb.upper());
    return std::max(body, 0);
}

// Puts the clip as it goes on in place of the clip: as many frames as are solved, wherever in the loop one starts.
void go_round(const SolveOptions& options, MotionFile& file, CrowdJob& job)
{
    const formats::Given<formats::LoopFrames>& asked = *job.crowd->loop;
    const formats::Clip& clip = file.clip();
    const auto refuse = [&](const std::string& cause) {
        throw formats::InputError(job.crowd->path, asked.line, fmt::format("{}: {}", asked.key, cause));
    };
    if (clip.frame_time == 0) refuse("the clip's keys lie at uneven times; give --fps");
    if (clip.frame_count < 2) refuse("the clip has one frame; take this out");
    const int body = common_joint(clip, job.limbs);
    if (asked.value) {
        const auto [first, last] = *asked.value;
        if (last >= clip.frame_count)
            refuse(fmt::format("frame {} does not exist; the clip has frames 0 to {}", last, clip.frame_count - 1));
        if (last - first < 2) refuse("a loop has two frames or more; write [first, last]");
        job.loop = FoundLoop{{first, last}, 0};
    } else {
        if (clip.frame_count > kMostSearched)
            refuse(fmt::format("\"auto\" compares up to {} frames, and the clip has {}; write [first, last]",
                               kMostSearched, clip.frame_count));
        job.loop = find_loop(clip, body);
        if (!std::isfinite(job.loop->gap)) refuse("the clip is shorter than half a second; write [first, last]");
    }
    if (options.frames > 0) job.frame_count = options.frames;
    const double bytes = static_cast<double>((job.frame_count + job.loop->loop.length()) * clip.joints.size()) * 32;
    if (bytes > 0x1p33)
        refuse(fmt::format("{} frames of {} joints take {:.1f} GiB, more than 8; give fewer --frames", job.frame_count,
                           clip.joints.size(), bytes / 0x1p30));
    file.replace(looped(clip, body, job.loop->loop, job.frame_count + job.loop->loop.length()));
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
    job.frame_count = job.clip_frames = clip.frame_count;
    if (job.crowd && job.crowd->loop) go_round(options, file, job);
    job.plan = plan_crowd(job.crowd ? &*job.crowd : nullptr, clip, job.limbs);
    if (job.crowd && job.crowd->ground) {
        stand_on_ground(*job.crowd, clip, job.limbs, {search.facing.up_w, carrier_of(clip, joints)}, job.plan);
        if (job.crowd->ground->heights)
            job.heights = (job.crowd->path.parent_path() / job.crowd->ground->heights->value).string();
    }
    if (job.loop) job.plan.starts = job.loop->loop.length();
    if (options.characters) job.plan.characters = *options.characters;
    if (clip.frame_time == 0 && job.plan.characters > 1)
        throw formats::InputError(options.file,
                                  "its keys lie at uneven times, and the characters of a crowd start at "
                                  "different frames; give --fps");
    if (options.seed) job.plan.seed = *options.seed;
    job.targets = options.targets ? *options.targets : job.crowd ? checked_targets(*job.crowd) : "clip";
    require_one_reader(options, job.targets);
    job.given.emplace(job.targets, between_of(options, job.targets), job.frame_count, job.limbs, job.plan.characters);
    if (!job.loop && options.frames > 0 && options.frames < clip.frame_count) {
        file.cut(options.frames);
        job.frame_count = options.frames;
    }
    return job;
}

}  // namespace swivel::tools
