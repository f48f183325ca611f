// SPDX-License-Identifier: MIT
#include "tools/swivel/solve_report.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tools/cli/streams.h"
#include "tools/crowd/characters.h"
#include "tools/formats/printable.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

// What the user should know of the motion, a line each; mostly nothing.
std::vector<std::string> motion_notes(const SolveOptions& options, const MotionFile& file, const CrowdJob& job)
{
    std::vector<std::string> notes = file.notes();
    if (!file.has_motion() && job.plan.characters > 1)
        notes.push_back(
            fmt::format("{0} has no motion: all {1} characters stand in its rest pose, but for limbs with "
                        "targets; swivel retarget puts a motion on it",
                        shown_file(options.file), job.plan.characters));
    return notes;
}

std::string number_of_clip(const CrowdJob& job, std::size_t n)
{
    return job.loops.size() > 1 ? fmt::format(" {}", n + 1) : "";
}

// The same of loops.
std::vector<std::string> loop_notes(const CrowdJob& job)
{
    std::vector<std::string> notes;
    for (std::size_t n = 0; n < job.loops.size(); ++n)
        if (job.loops[n].gap > kWideGap)
            notes.push_back(
                fmt::format("the clip{} never comes back to a pose while it moves: at the loop's seam its "
                            "joints are {:.0f} degrees apart, and this shows; {}take a clip that repeats "
                            "itself",
                            number_of_clip(job, n), job.loops[n].gap * 180 / std::numbers::pi,
                            job.further.empty() ? "name [first, last], or " : ""));
    return notes;
}

// Who walks beside the picture of heights, where the ground goes on level: a line, or nothing.
std::vector<std::string> ground_notes(const formats::Clip& clip, const CrowdJob& job)
{
    if (job.heights.empty()) return {};
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    std::vector<Eigen::AlignedBox2d> ways(clip.frame_count);  // from each frame that a clip begins with
    std::vector<ClipPart> parts = job.plan.clips;
    if (parts.empty()) parts = {{0, clip.frame_count}};
    for (const ClipPart& part : parts)
        for (std::size_t frame = part.first; frame < part.first + part.count; ++frame) {
            formats::world_pose(clip, frame, pose_w);
            const Eigen::Vector3d& at = pose_w[static_cast<std::size_t>(job.limbs[0].upper())].position;
            ways[part.first].extend(Eigen::Vector2d(at.x(), at.z()));
        }
    const goal_ground& grid = job.plan.ground->grid;
    const Eigen::Vector2d middle(grid.place[0], grid.place[2]), half(grid.size[0] / 2, grid.size[2] / 2);
    const Eigen::AlignedBox2d picture(middle - half, middle + half);
    const std::vector<goal_character> characters = characters_of(job.plan, job.limbs, clip.frame_count);
    const auto leaves = [&](const goal_character& who) {
        const Eigen::AlignedBox2d& way = ways[who.first];
        const Eigen::Vector2d place(who.place[0], who.place[2]);
        return !picture.contains(Eigen::AlignedBox2d(place + who.size * way.min(), place + who.size * way.max()));
    };
    const auto first = std::ranges::find_if(characters, leaves);
    if (first == characters.end()) return {};
    return {fmt::format(
        "{} of {} characters walk beside the picture, which lies from {:.4g} to {:.4g} along x and from {:.4g} to "
        "{:.4g} "
        "along z, and where the ground goes on level: character {} is the first. Give a larger picture, or a smaller "
        "crowd.spacing",
        std::ranges::count_if(characters, leaves), characters.size(), picture.min().x(), picture.max().x(),
        picture.min().y(), picture.max().y(), first - characters.begin())};
}

}  // namespace

std::string shown_file(const std::string& name) { return formats::printable(name, std::string::npos); }

void print_clip(std::FILE* to, const SolveOptions& options, const MotionFile& file, const CrowdJob& job)
{
    const formats::Clip& clip = file.clip();
    const std::vector<Limb>& limbs = job.limbs;
    const std::uint32_t characters = job.plan.characters;
    say(to, "clip     {}: {}, {} joints, {} frame{}, {}\n", shown_file(options.file), file.describe(),
        clip.joints.size(), job.frame_count, job.frame_count == 1 ? "" : "s",
        clip.frame_time > 0 ? fmt::format("{:.1f} frames/s", 1 / clip.frame_time) : "at the times of its keys");
    for (const std::string& note : motion_notes(options, file, job)) say(to, "note     {}\n", note);
    const auto shown = [&](int joint) { return printable_name(joint_at(clip, joint)); };
    for (const Limb& limb : limbs)
        say(to, "{:<8} {:<5} {} > {} > {}, {:.4g} + {:.4g} long, limb.{}.bend = {}: {}\n", kind_name(limb.name.kind),
            side_name(limb.name.side), shown(limb.upper()), shown(limb.lower()), shown(limb.end()),
            limb.bound.lengths[0], limb.bound.lengths[1], limb_word(limb.name), toml_row(limb.bend), limb.bend_source);
    for (const Limb& limb : limbs)
        for (const std::string& note : limb.notes) say(to, "note     {}: {}\n", plain_name(limb.name), note);
    for (const LimbFinding& finding : job.missing)
        say(to, "{:<8} {:<5} {}: {}\n", kind_name(finding.name.kind), side_name(finding.name.side),
            finding.has_joints ? "refused" : "missing", problem_text(finding));
    for (const FurtherMotion& each : job.further) say(to, "clip     {}\n", each.words);
    for (std::size_t n = 0; n < job.loops.size(); ++n) {
        const FoundLoop& found = job.loops[n];
        say(to, "loop     frames {} to {} of the clip{}, {:.2f} s{}\n", found.loop.first, found.loop.last,
            number_of_clip(job, n), static_cast<double>(found.loop.length()) * clip.frame_time,
            found.gap > 0 ? fmt::format("; a joint's pose and motion differ by {:.1f} degrees",
                                        found.gap * 180 / std::numbers::pi)
                          : "");
    }
    for (const std::string& note : loop_notes(job)) say(to, "note     {}\n", note);
    if (const std::size_t count = job.given->left_out(); count > 0)
        say(to, "note     {}: {} row{} left out, of limbs that are not solved\n", shown_file(job.targets), count,
            count == 1 ? " is" : "s are");
    std::string counts;
    for (const formats::LimbKind kind : {formats::LimbKind::arm, formats::LimbKind::leg}) {
        const auto of_kind = [&](const Limb& limb) { return limb.name.kind == kind; };
        const auto count = static_cast<std::size_t>(std::count_if(limbs.begin(), limbs.end(), of_kind));
        if (count > 0)
            counts += fmt::format(", {} {}{}", count * characters, kind_name(kind), count * characters == 1 ? "" : "s");
    }
    if (const auto& ground = job.plan.ground)
        say(to, "ground   {}; feet stand{}, bodies hang lower by {:.3g}\n",
            job.heights.empty()
                ? "level"
                : fmt::format("{}, {} x {} pixels", shown_file(job.heights), ground->grid.columns, ground->grid.rows),
            job.contacts.empty() ? "" : " when " + shown_file(job.contacts) + " says", -job.plan.shift_wish);
    for (const std::string& note : ground_notes(clip, job)) say(to, "note     {}\n", note);
    if (job.builds.size() > 1) {
        const auto factors = [&](double Proportions::*of) {
            const auto [least, most] = std::ranges::minmax(job.builds, {}, of);
            return fmt::format("{:.3g} to {:.3g}", least.*of, most.*of);
        };
        say(to, "builds   {}: legs {}, arms {}, spine {}, speed {} times the clip's own\n", job.builds.size(),
            factors(&Proportions::legs), factors(&Proportions::arms), factors(&Proportions::spine),
            factors(&Proportions::speed));
    }
    for (std::size_t n = 0; n < limbs.size(); ++n)
        if (const auto held = job.plan.limbs[n].holds)
            say(to, "hold     the {} keeps its hand to that of the {}, as in the clip\n", plain_name(limbs[n].name),
                plain_name(limbs[*held].name));
    if (const auto& carry = job.plan.carry)
        say(to, "carry    {} of {} characters have a box in both hands, {:.3g} x {:.3g} x {:.3g}\n",
            std::ranges::count(characters_of(job.plan, limbs, clip.frame_count), 1u, &goal_character::carries),
            characters, carry->size.x(), carry->size.y(), carry->size.z());
    say(to, "crowd    {} character{}{}, targets from {}{}\n", characters, characters == 1 ? "" : "s", counts,
        job.targets == "clip" ? "the clip" : shown_file(job.targets),
        options.crowd.empty() ? "" : fmt::format(", all else from {}", shown_file(options.crowd)));
}

nlohmann::ordered_json json_of_clip(const SolveOptions& options, const MotionFile& file, const CrowdJob& job)
{
    const formats::Clip& clip = file.clip();
    nlohmann::ordered_json out{{"clip", options.file},
                               {"motion", file.describe()},
                               {"joints", clip.joints.size()},
                               {"frames", job.frame_count},
                               {"frame_time", frame_time_of(clip)},
                               {"characters", job.plan.characters},
                               {"seed", job.plan.seed},
                               {"targets", job.targets}};
    if (!options.crowd.empty()) out["crowd"] = options.crowd;
    if (const auto& carry = job.plan.carry)
        out["carry"] = {{"share", carry->share}, {"size", {carry->size.x(), carry->size.y(), carry->size.z()}}};
    if (job.plan.ground) out["ground"] = job.heights.empty() ? "level" : job.heights;
    if (!job.contacts.empty()) out["contacts"] = job.contacts;
    for (std::size_t n = 0; n < job.plan.clips.size(); ++n) {
        const ClipPart& part = job.plan.clips[n];
        nlohmann::ordered_json& of = out["performed"].emplace_back();
        const std::size_t which = n % (1 + job.further.size());
        const Proportions& build = job.builds[n / (1 + job.further.size())];
        of = {{"motion", which == 0 ? file.describe() : job.further[which - 1].words},
              {"first", part.first},
              {"frames", part.count}};
        if (!job.loops.empty()) of["loop"] = {job.loops[which].loop.first, job.loops[which].loop.last};
        if (job.builds.size() > 1)
            of["legs"] = build.legs, of["arms"] = build.arms, of["spine"] = build.spine, of["speed"] = part.pace;
    }
    if (!job.loops.empty()) out["loop"] = {job.loops[0].loop.first, job.loops[0].loop.last};
    std::vector<std::string> notes = motion_notes(options, file, job);
    std::ranges::copy(loop_notes(job), std::back_inserter(notes));
    if (!notes.empty()) out["notes"] = notes;
    for (const Limb& limb : job.limbs) {
        const LimbWords& words = words_of(limb.name.kind);
        out[fmt::format("{}_bound", words.limbs)].push_back(
            {{"side", side_name(limb.name.side)},
             {words.upper_joint, joint_at(clip, limb.upper()).name},
             {words.lower_joint, joint_at(clip, limb.lower()).name},
             {words.end_joint, joint_at(clip, limb.end()).name},
             {"lengths", {limb.bound.lengths[0], limb.bound.lengths[1]}},
             {"bend", {limb.bend.x(), limb.bend.y(), limb.bend.z()}},
             {"bend_source", limb.bend_source},
             {"unevenness", limb.unevenness},
             {"notes", limb.notes}});
        const auto held = job.plan.limbs[static_cast<std::size_t>(&limb - job.limbs.data())].holds;
        if (held) out[fmt::format("{}_bound", words.limbs)].back()["holds"] = limb_word(job.limbs[*held].name);
    }
    for (const LimbFinding& finding : job.missing)
        out["missing"].push_back({{"limb", limb_word(finding.name)}, {"problem", problem_text(finding)}});
    return out;
}

}  // namespace swivel::tools
