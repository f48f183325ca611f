// SPDX-License-Identifier: MIT
//
// `swivel retarget`: motions of skeletons on another one: pairs joints, turns them, solves hands and feet, reports,
// writes.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/command_error.h"
#include "tools/cli/streams.h"
#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/retarget/joint_pairs.h"
#include "tools/retarget/retarget_limbs.h"
#include "tools/retarget/verdict.h"
#include "tools/rig/clip_doubts.h"
#include "tools/rig/facing.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/limbs.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/motion_file.h"
#include "tools/swivel/report.h"
#include "tools/swivel/root_motion.h"
#include "tools/swivel/run_files.h"

namespace swivel::tools {

namespace {

// The parts of --arm, --leg, --head, --rest and --up that are about one body.
struct BodyChoice {
    LimbChoice limbs;
    std::optional<NamedJoint> head;
    RestChoice rest;
};
struct BodyChoices {
    BodyChoice source, target;
};

std::size_t frame_of_option(std::string_view said)
{
    std::uint32_t frame = 0;
    const auto [end, error] = std::from_chars(said.data(), said.data() + said.size(), frame);
    if (error == std::errc() && end == said.data() + said.size()) return frame;
    throw CommandError(2, fmt::format("--rest: {} is not a frame; give a whole number, counted from 0",
                                      formats::printable(said, formats::kMaxQuoted)));
}

Eigen::Vector3d axis_of_option(std::string_view said)
{
    if (const auto axis = axis_of(said)) return *axis;
    throw CommandError(2, fmt::format("--up: {} is not an axis; give x, y, z, -x, -y or -z",
                                      formats::printable(said, formats::kMaxQuoted)));
}

// Throws CommandError for an option that names no body or is given twice for one, and for the first three beside --map.
BodyChoices body_choices(const RetargetOptions& options)
{
    BodyChoices choices;
    // Reads an option's texts, behind "source:" or "target:".
    const auto read = [&](const char* option, const std::vector<std::string>& texts, const auto& take) {
        for (const std::string_view text : texts) {
            const bool is_source = text.starts_with("source:");
            if (!is_source && !text.starts_with("target:"))
                throw CommandError(2, fmt::format("{} {}: does not say whose; write source: or target: in front",
                                                  option, formats::printable(text, formats::kMaxQuoted)));
            take(is_source ? choices.source : choices.target, text.substr(text.find(':') + 1));
        }
    };
    for (const auto& [option, texts] :
         {std::pair("--arm", &options.arms), {"--leg", &options.legs}, {"--head", &options.heads}})
        if (!options.map.empty() && !texts->empty())
            throw CommandError(2, fmt::format("{}: --map says already which joints are whose; write them into the "
                                              "table, or leave --map out",
                                              option));
    const auto require_once = [&](bool is_given, const char* option) {
        if (is_given) throw CommandError(2, fmt::format("{}: it is given twice for one body; give it once", option));
    };
    read("--arm", options.arms,
         [](BodyChoice& body, std::string_view said) { body.limbs.arms.push_back(limb_of_option(said, "--arm")); });
    read("--leg", options.legs,
         [](BodyChoice& body, std::string_view said) { body.limbs.legs.push_back(limb_of_option(said, "--leg")); });
    read("--head", options.heads, [](BodyChoice& body, std::string_view said) {
        if (body.head) throw CommandError(2, "--head: a body has one head, and two joints are given");
        body.head = NamedJoint{std::string(said), {"--head"}};
    });
    read("--rest", options.rests, [&](BodyChoice& body, std::string_view said) {
        require_once(body.rest.frame.has_value(), "--rest");
        body.rest.frame = frame_of_option(said);
    });
    read("--up", options.ups, [&](BodyChoice& body, std::string_view said) {
        require_once(body.rest.up_w.has_value(), "--up");
        body.rest.up_w = axis_of_option(said);
    });
    return choices;
}

// Throws InputError as choose_joints() and body_of() do.
PartedBody parted_body(const formats::Clip& clip, const std::string& file, const BodyChoice& choice)
{
    return {clip, body_of(clip, file, choose_joints(clip, file, choice.limbs), choice.head)};
}

using formats::Clip;
using formats::position_of;

constexpr double kMinBone = 1e-6;  // of its limb

std::vector<int> all_bones(const Clip& clip)
{
    std::vector<int> bones;
    for (std::size_t n = 0; n < clip.joints.size(); ++n)
        if (clip.joints[n].is_bone) bones.push_back(static_cast<int>(n));
    return bones;
}

std::string names_of(const Clip& clip, const std::vector<int>& joints)
{
    std::string names;
    for (std::size_t n = 0; n < joints.size(); ++n) {
        if (names.size() > formats::kMaxQuoted) return names + fmt::format(" and {} more", joints.size() - n);
        names += (names.empty() ? "" : ", ") + printable_name(joint_at(clip, joints[n]));
    }
    return names.empty() ? "none" : names;
}

// A bone of no length has no direction, and its limb no knee or elbow.
void require_bones(const std::string& file, const Clip& clip, const LimbJoints& joints)
{
    const std::vector<formats::JointPose> pose_w = formats::rest_pose(clip);
    const auto length = [&](std::size_t n) {
        return (position_of(pose_w, joints[n + 1]) - position_of(pose_w, joints[n])).norm();
    };
    for (std::size_t n = 0; n < 2; ++n)
        if (!(length(n) > kMinBone * (length(0) + length(1))))
            throw formats::InputError(
                file,
                fmt::format("the bone from {0} to {1} has no length at rest; give {1} an OFFSET or translation where "
                            "the figure is made, leave its limb out, or give other joints by --map FILE",
                            printable_name(joint_at(clip, joints[n])), printable_name(joint_at(clip, joints[n + 1]))));
}

// Refuses limbs that are not below the hips: they would stay behind while the hips walk.
void require_below(const std::string& file, const Clip& clip, int hips, int joint)
{
    if (is_above(clip, hips, joint)) return;
    throw formats::InputError(
        file, fmt::format("'{}' does not hang below the hips, '{}', and would stay behind; give other joints by --map "
                          "FILE, or leave its limb out there",
                          printable_name(joint_at(clip, joint)), printable_name(joint_at(clip, hips))));
}

// Both bodies need hips and a leg that the other has, too. Limbs that both have need bones.
void require_bodies(const RetargetOptions& options, const JointPairs& pairs, const Clip& source_clip,
                    const Clip& target_clip)
{
    const auto refuse = [&](BodySide side, const char* what) {
        const bool is_source = side == BodySide::source;
        throw formats::InputError(is_source ? options.source : options.target,
                                  fmt::format("no {} of it can be told by the names of its joints; swivel rig says "
                                              "why; name them by --leg {}:left:HIP,KNEE,ANKLE and the same of the "
                                              "right, or give all pairs by --map FILE",
                                              what, is_source ? "source" : "target"));
    };
    const std::vector<BodyPart> source = parts_of(pairs, BodySide::source), target = parts_of(pairs, BodySide::target);
    if (joints_of(source, "hips").empty()) refuse(BodySide::source, "hips");
    if (joints_of(target, "hips").empty()) refuse(BodySide::target, "hips");
    const KnownLimbs from = limbs_of(source), to = limbs_of(target);
    if (!(from[2] && to[2]) && !(from[3] && to[3]))
        refuse(from[2] || from[3] ? BodySide::target : BodySide::source, "leg");
    for (std::size_t n = 0; n < from.size(); ++n) {
        if (!from[n] || !to[n]) continue;
        require_bones(options.source, source_clip, *from[n]);
        require_bones(options.target, target_clip, *to[n]);
        require_below(options.target, target_clip, joints_of(target, "hips").front(), (*to[n])[0]);
    }
}

// The joints that ever leave what the file has them at, with the hips' way.
std::vector<TurnedJoint> moved_joints(const Retargeted& motion)
{
    const Clip& clip = motion.clip;
    std::vector<TurnedJoint> moved;
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        TurnedJoint joint{static_cast<int>(n), {}, {}};
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
            joint.rotation.push_back(clip.rotation[frame * clip.joints.size() + n]);
        const Eigen::Quaterniond rest = pose_without_keys(clip.joints[n]).rotation;
        if (std::ranges::all_of(joint.rotation, [&](const auto& turn) { return turn.angularDistance(rest) < 1e-9; }))
            joint.rotation.clear();
        if (joint.joint == motion.hips) joint.translation = clip.translation;
        if (!joint.rotation.empty() || !joint.translation.empty()) moved.push_back(std::move(joint));
    }
    return moved;
}

// The target's body, for --root-motion.
MovedBody moved_body(const Retargeted& motion, int root, const KnownLimbs& limbs)
{
    const Eigen::Vector3d up_w = nearest_axis(facing_of(motion.clip, limbs).up_w);
    const LimbJoints& leg = limbs[2] ? *limbs[2] : *limbs[3];
    const double level =
        motion.ground && !rests_on_ground(motion.clip, leg[0], leg[2], up_w) ? motion.ground->target : 0;
    return {root, motion.hips, motion.hips, up_w, [level](const Eigen::Vector3d&) { return level; }};
}

void print_pairs(std::FILE* reports, const Clip& source, const Clip& target, const JointPairs& pairs)
{
    const auto count = std::ranges::count_if(pairs, &PairedPart::is_paired);
    const auto parts =
        std::ranges::count_if(pairs, [](const auto& each) { return each.is_paired() && !each.name.empty(); });
    say(reports, "paired    {} parts of the body, {} more joints by their names\n", parts, count - parts);
    say(reports, "at rest   of TARGET: {}\n", names_of(target, unpaired_bones(pairs, target, BodySide::target)));
    say(reports, "unused    of SOURCE: {}\n", names_of(source, unpaired_bones(pairs, source, BodySide::source)));
}

// problems: of each limb, why it was not solved; empty: it was.
void print_motion(std::FILE* reports, const Retargeted& motion, const std::vector<std::string>& problems,
                  const std::vector<GoalMiss>& misses)
{
    say(reports, "lengths   {:.6g} of TARGET for 1 of SOURCE, by the legs\n", motion.leg_ratio);
    for (std::size_t n = 0; n < misses.size(); ++n) {
        const formats::LimbName limb = motion.limbs[n];
        if (!problems[n].empty())
            say(reports, "{:<9} not solved: {}\n", plain_name(limb), problems[n]);
        else
            say(reports, "{:<9} {} from its goal: {:.2g} of the limb's length in the mean, most {:.2g} in frame {}\n",
                plain_name(limb), words_of(limb.kind).end_joint, misses[n].mean, misses[n].max, misses[n].max_frame);
    }
}

void print_clips(std::FILE* reports, const RetargetOptions& options, const MotionFile& source, const MotionFile& target)
{
    say(reports, "source    {}: {}, {} frames\n", shown_file(options.source), source.describe(),
        source.clip().frame_count);
    for (const std::string& note : source.notes()) say(reports, "note      {}\n", note);
    say(reports, "target    {}: {}\n", shown_file(options.target), target.describe());
    for (const std::string& note : target.notes()) say(reports, "note      {}\n", note);
}

void print_verdict(std::FILE* reports, const Verdict& verdict)
{
    for (const std::string& doubt : verdict.doubts) say(reports, "look      {}\n", doubt);
    for (const std::string& fault : verdict.faults) say(reports, "garbage   {}\n", fault);
    if (verdict.is_good()) say(reports, "good      no bone, goal, knee, hand or foot stands out\n");
}

Json json_of(const RetargetOptions& options, const MotionFile& source, const MotionFile& target,
             const JointPairs& pairs, const Retargeted& motion, const std::vector<std::string>& problems,
             const Verdict& verdict)
{
    const auto of_file = [](const std::string& name, const MotionFile& file) {
        return Json{{"file", name}, {"motion", file.describe()}, {"notes", file.notes()}};
    };
    Json out = {{"source", of_file(options.source, source)},
                {"target", of_file(options.target, target)},
                {"frames", source.clip().frame_count},
                {"frame_time", frame_time_of(source.clip())},
                {"paired", std::ranges::count_if(pairs, &PairedPart::is_paired)},
                {"at_rest", names_json(target.clip(), unpaired_bones(pairs, target.clip(), BodySide::target))},
                {"unused", names_json(source.clip(), unpaired_bones(pairs, source.clip(), BodySide::source))},
                {"leg_ratio", motion.leg_ratio}};
    for (std::size_t n = 0; n < verdict.misses.size(); ++n) {
        const GoalMiss& miss = verdict.misses[n];
        Json& limb = out["limbs"].emplace_back();
        limb["limb"] = limb_word(motion.limbs[n]);
        if (problems[n].empty())
            limb["missed"] = {{"mean", miss.mean}, {"max", miss.max}, {"frame", miss.max_frame}};
        else
            limb["problem"] = problems[n];
    }
    out["verdict"] = verdict_word(!verdict.is_good(), !verdict.faults.empty());
    out["look"] = verdict.doubts;
    out["garbage"] = verdict.faults;
    return out;
}

// Throws CommandError for files and options that do not go together.
void require_usage(const RetargetOptions& options)
{
    if (options.files.size() < 2)
        throw CommandError(2, "TARGET is missing; give SOURCE, and then TARGET; see swivel retarget --help");
    std::vector<std::string> inputs = options.files;
    inputs.push_back(options.map);
    require_one_reader(inputs, "SOURCE, TARGET and --map");
    require_many_files(inputs, options.files.size() - 1, options.out, "SOURCE", {{"--export-map", options.export_map}});
}

// One SOURCE, to its file. reports: null for none. clips: its JSON is added there.
FileOutcome run_one(const RetargetOptions& options, const BodyChoices& choices, std::FILE* reports, Json& clips)
{
    MotionFile source_file(options.source, {options.clip, options.rate, choices.source.rest}),
        target_file(options.target, {{}, 0, choices.target.rest});
    if (!options.out.empty()) target_file.require_can_write(options.out, true);
    const std::string outputs[] = {options.out, options.export_map};
    require_not_beside(outputs, source_file);
    require_not_beside(outputs, target_file);
    const Clip &source = source_file.clip(), &target = target_file.clip();
    source_file.sample(all_bones(source));
    target_file.sample(all_bones(target));
    const JointPairs pairs = options.map.empty() ? pair_joints(parted_body(source, options.source, choices.source),
                                                               parted_body(target, options.target, choices.target))
                                                 : read_joint_map(options.map, source, target);
    if (source.frame_time == 0) throw formats::InputError(options.source, "its keys lie at uneven times; give --fps");
    source_file.fix_rest_pose(limbs_of(parts_of(pairs, BodySide::source)));
    const std::vector<BodyPart> parts = parts_of(pairs, BodySide::target);
    target_file.fix_rest_pose(limbs_of(parts), true);
    require_bodies(options, pairs, source, target);
    std::optional<int> root;
    if (options.root_motion) root = root_joint(target, joints_of(parts, "hips").front(), options.target);
    Retargeted motion = retarget(source, target, pairs);
    const std::vector<std::string> problems =
        solve_limbs(motion, parts, options.map.empty() ? options.target : options.map);
    Verdict verdict = verdict_of(source, motion, pairs);
    const auto add = [&](const char* whose, const std::vector<ClipDoubt>& doubts) {
        for (const ClipDoubt& doubt : doubts)
            (doubt.is_garbage ? verdict.faults : verdict.doubts).push_back(whose + doubt.text);
    };
    add("SOURCE: ", clip_doubts({source, parts_of(pairs, BodySide::source)}));
    add("TARGET: ", body_doubts({target, parts}));
    const bool is_done = verdict.faults.empty() || options.force, is_written = is_done && !options.out.empty();
    const std::string map = is_done ? options.export_map : "";
    if (is_written)
        write_joints(options.out, target_file, motion.clip, moved_joints(motion),
                     formats::NewFrames{source.frame_count, source.frame_time,
                                        std::filesystem::path(title_of(options.source)).stem().string()},
                     root ? std::optional(moved_body(motion, *root, limbs_of(parts))) : std::nullopt);
    if (!map.empty())
        write_joint_map(map, pairs, source, target, [&](int joint) { return target_file.can_key(joint); });
    if (reports) {
        print_clips(reports, options, source_file, target_file);
        print_pairs(reports, source, target, pairs);
        print_motion(reports, motion, problems, verdict.misses);
        print_verdict(reports, verdict);
        print_written(reports, {map, is_written ? options.out : ""}, 10);
    }
    if (options.json) {
        Json& json = clips.emplace_back(json_of(options, source_file, target_file, pairs, motion, problems, verdict));
        if (is_written) json["out"] = options.out;
        if (!map.empty()) json["export_map"] = map;
    }
    return {options.source, is_written ? options.out : "", verdict.doubts, verdict.faults, !is_done};
}

}  // namespace

void run_retarget(const RetargetOptions& given)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    require_usage(given);
    RetargetOptions options = given;
    const std::vector<std::string> sources(given.files.begin(), given.files.end() - 1);
    options.target = given.files.back();
    const BodyChoices choices = body_choices(options);
    const bool to_folder = is_to_folder(options.out, sources.size());
    std::vector<std::string> outputs =
        outputs_of(sources, options.out, to_folder ? MotionFile(options.target, {}).suffix() : "");
    outputs.push_back(options.export_map);
    std::vector<ReadFile> read;
    for (const std::string& source : sources) read.push_back({source, "SOURCE"});
    read.push_back({options.target, "TARGET"}), read.push_back({options.map, "the table of pairs"});
    require_own_outputs(outputs, read);
    std::FILE* const stream = report_stream(outputs);
    std::FILE* const reports = options.quiet || options.json ? nullptr : stream;
    const std::vector<FileOutcome> outcomes = run_files(
        sources, {given.out, given.quiet, reports, given.json ? stream : nullptr}, [&](std::size_t n, Json& clips) {
            options.source = sources[n], options.out = outputs[n];
            return run_one(options, choices, to_folder ? nullptr : reports, clips);
        });
    if (sources.size() > 1 || to_folder) return require_none_failed(outcomes);
    require_not_refused(outcomes.front(), given.out.empty() ? options.target : given.out, "swivel rig of both",
                        !given.out.empty() || !given.export_map.empty());
}

}  // namespace swivel::tools
