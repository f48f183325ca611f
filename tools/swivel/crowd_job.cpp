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
#include "tools/formats/printable.h"
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

// A clip's loop, as the crowd file asks for it.
FoundLoop loop_of(const formats::CrowdFile& file, const formats::Clip& clip, int body)
{
    const formats::Given<formats::LoopFrames>& asked = *file.loop;
    const auto refuse = [&](const std::string& cause) {
        throw formats::InputError(file.path, asked.line, fmt::format("{}: {}", asked.key, cause));
    };
    if (clip.frame_time == 0) refuse("the clip's keys lie at uneven times; give --fps");
    if (clip.frame_count < 2) refuse("the clip has one frame; take this out");
    if (asked.value) {
        const auto [first, last] = *asked.value;
        if (last >= clip.frame_count)
            refuse(fmt::format("frame {} does not exist; the clip has frames 0 to {}", last, clip.frame_count - 1));
        if (last - first < 2) refuse("a loop has two frames or more; write [first, last]");
        if (!file.clips.empty()) refuse("is for one clip, and there are several; write \"auto\" or false");
        return {{first, last}, 0};
    }
    if (clip.frame_count > kMostSearched)
        refuse(fmt::format("\"auto\" compares up to {} frames, and the clip has {}; write [first, last]", kMostSearched,
                           clip.frame_count));
    const FoundLoop found = find_loop(clip, body);
    if (!std::isfinite(found.gap)) refuse("the clip is shorter than half a second; write [first, last]");
    return found;
}

// A clip as it is performed: as it goes on, for as many frames as are solved, wherever in the loop one starts; or its
// first frames. Adds what it is to the plan.
formats::Clip performed(const SolveOptions& options, const formats::Clip& clip, int body, CrowdJob& job)
{
    std::size_t first = job.plan.clips.empty() ? 0 : job.plan.clips.back().first + job.plan.clips.back().count;
    if (!job.crowd->loop) {
        const std::size_t count =
            options.frames > 0 ? std::min<std::size_t>(options.frames, clip.frame_count) : clip.frame_count;
        job.plan.clips.push_back({first, count, count});
        return frames_of(clip, {0, count, count});
    }
    const ClipLoop loop = job.loops.emplace_back(loop_of(*job.crowd, clip, body)).loop;
    const std::size_t count = job.frame_count + loop.length();
    const double bytes = static_cast<double>((first + count) * clip.joints.size()) * 32;
    if (bytes > 0x1p33)
        throw formats::InputError(
            job.crowd->path, job.crowd->loop->line,
            fmt::format("{}: {} frames of {} joints take {:.1f} GiB, more than 8; give fewer --frames",
                        job.crowd->loop->key, job.frame_count, clip.joints.size(), bytes / 0x1p30));
    job.plan.clips.push_back({first, count, loop.length()});
    return looped(clip, body, loop, count);
}

// Reads one of the further clips. Its joints are the same ones.
formats::Clip further_clip(const SolveOptions& options, const formats::FurtherClip& from, const formats::Clip& first,
                           std::span<const int> joints, CrowdJob& job)
{
    const std::filesystem::path path =
        from.file.empty() ? std::filesystem::path(options.file) : job.crowd->path.parent_path() / from.file;
    const auto refuse = [&](const std::string& cause) {
        throw formats::InputError(job.crowd->path, from.line,
                                  fmt::format("{}: {}: {}", from.key, formats::printable(path.string()), cause));
    };
    if (formats::is_standard_stream(path)) refuse("standard input is read once; name a file");
    MotionFile file(path, {from.animation, options.motion.rate});
    if (const std::string difference = difference_of(first, file.clip()); !difference.empty())
        refuse(difference + "; put it on this skeleton by swivel retarget");
    file.sample(joints);
    if (std::abs(file.clip().frame_time - first.frame_time) > 1e-3 * first.frame_time)
        refuse("its frames come at another rate than the clip's; give --fps");
    job.clip_files.push_back(path);
    job.clips.push_back(fmt::format("{}: {}", formats::printable(title_of(path.string())), file.describe()));
    return file.clip();
}

// Puts what the crowd performs in place of the clip: clips as they go on, or several of them, one after the other.
void perform(const SolveOptions& options, std::span<const int> joints, MotionFile& file, CrowdJob& job)
{
    const formats::Clip& clip = file.clip();
    const int body = common_joint(clip, job.limbs);
    if (job.crowd->loop && options.frames > 0) job.frame_count = options.frames;
    std::vector<formats::Clip> clips{performed(options, clip, body, job)};
    for (const formats::FurtherClip& each : job.crowd->clips)
        clips.push_back(performed(options, further_clip(options, each, clip, joints, job), body, job));
    if (!job.crowd->loop) job.frame_count = clips[0].frame_count;
    file.replace(clips.size() == 1 ? std::move(clips[0]) : joined(clips, body));
}

}  // namespace

std::string title_of(const std::string& file)
{
    return formats::is_standard_stream(file) ? "motion" : std::filesystem::path(file).filename().string();
}

std::string motion_of(const MotionFile& file, const CrowdJob& job)
{
    const std::size_t more = job.clips.size();
    return file.describe() + (more > 0 ? fmt::format(", and {} clip{} more", more, more == 1 ? "" : "s") : "");
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
    job.body = search.body, job.forwards_w = search.facing.forwards_w;
    for (LimbFinding& finding : search.findings)
        if (!finding.limb) job.missing.push_back(std::move(finding));
    job.frame_count = job.clip_frames = clip.frame_count;
    if (job.crowd && (job.crowd->loop || !job.crowd->clips.empty())) perform(options, joints_of(joints), file, job);
    std::vector<ClipPart> parts = std::move(job.plan.clips);
    job.plan = plan_crowd(job.crowd ? &*job.crowd : nullptr, clip, job.limbs);
    job.plan.clips = std::move(parts);
    if (job.crowd && job.crowd->ground) {
        stand_on_ground(*job.crowd, clip, job.limbs, {search.facing.up_w, carrier_of(clip, joints)}, job.plan);
        if (job.crowd->ground->heights)
            job.heights = (job.crowd->path.parent_path() / job.crowd->ground->heights->value).string();
    }
    if (options.characters) job.plan.characters = *options.characters;
    if (clip.frame_time == 0 && job.plan.characters > 1)
        throw formats::InputError(options.file,
                                  "its keys lie at uneven times, and the characters of a crowd start at "
                                  "different frames; give --fps");
    if (options.seed) job.plan.seed = *options.seed;
    job.targets = options.targets ? *options.targets : job.crowd ? checked_targets(*job.crowd) : "clip";
    require_one_reader(options, job.targets);
    job.given.emplace(job.targets, between_of(options, job.targets), job.frame_count, job.limbs, job.plan.characters);
    if (job.plan.clips.empty() && options.frames > 0 && options.frames < clip.frame_count) {
        file.cut(options.frames);
        job.frame_count = options.frames;
    }
    return job;
}

}  // namespace swivel::tools
