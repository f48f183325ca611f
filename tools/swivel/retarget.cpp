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
#include "tools/formats/text.h"
#include "tools/retarget/joint_pairs.h"
#include "tools/retarget/retarget_limbs.h"
#include "tools/retarget/verdict.h"
#include "tools/rig/body_doubts.h"
#include "tools/rig/clip_doubts.h"
#include "tools/rig/facing.h"
#include "tools/rig/limb_choice.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/limbs.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/many_files.h"
#include "tools/swivel/motion_file.h"
#include "tools/swivel/report.h"
#include "tools/swivel/root_motion.h"
#include "tools/swivel/solve_files.h"

namespace swivel::tools {

namespace {

// The parts of --arm, --leg, --head, --rest and --up that are about one body.
struct BodyChoice {
    LimbChoice limbs;
    std::optional<NamedJoint> head;
    RestChoice rest;
};

// The option's text behind "source:" or "target:", if it is about this side.
std::optional<std::string_view> about(BodySide side, const char* option, std::string_view text)
{
    for (const BodySide each : {BodySide::source, BodySide::target}) {
        const std::string_view prefix = each == BodySide::source ? "source:" : "target:";
        if (!text.starts_with(prefix)) continue;
        if (each != side) return std::nullopt;
        return text.substr(prefix.size());
    }
    throw CommandError(2, fmt::format("{} {}: does not say whose; write source: or target: in front", option,
                                      formats::printable(text, formats::kMaxQuoted)));
}

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
    const auto axis = axis_of(said);
    if (!axis)
        throw CommandError(2, fmt::format("--up: {} is not an axis; give x, y, z, -x, -y or -z",
                                          formats::printable(said, formats::kMaxQuoted)));
    return *axis;
}

// Throws CommandError for an option that names no body or is given twice for one, and for the first three beside --map.
BodyChoice body_choice(const RetargetOptions& options, BodySide side)
{
    BodyChoice choice;
    const auto read = [&](const char* option, const std::vector<std::string>& texts, const auto& take) {
        for (const std::string& text : texts)
            if (const auto said = about(side, option, text)) take(*said);
    };
    const auto read_joints = [&](const char* option, const std::vector<std::string>& texts, const auto& take) {
        if (!options.map.empty() && !texts.empty())
            throw CommandError(2, fmt::format("{}: --map says already which joints are whose; write them into the "
                                              "table, or leave --map out",
                                              option));
        read(option, texts, take);
    };
    const auto require_once = [&](bool is_given, const char* option) {
        if (is_given) throw CommandError(2, fmt::format("{}: it is given twice for one body; give it once", option));
    };
    read_joints("--arm", options.arms,
                [&](std::string_view said) { choice.limbs.arms.push_back(limb_of_option(said, "--arm")); });
    read_joints("--leg", options.legs,
                [&](std::string_view said) { choice.limbs.legs.push_back(limb_of_option(said, "--leg")); });
    read_joints("--head", options.heads, [&](std::string_view said) {
        if (choice.head) throw CommandError(2, "--head: a body has one head, and two joints are given");
        choice.head = NamedJoint{std::string(said), {"--head"}};
    });
    read("--rest", options.rests, [&](std::string_view said) {
        require_once(choice.rest.frame.has_value(), "--rest");
        choice.rest.frame = frame_of_option(said);
    });
    read("--up", options.ups, [&](std::string_view said) {
        require_once(choice.rest.up_w.has_value(), "--up");
        choice.rest.up_w = axis_of_option(said);
    });
    return choice;
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
class MovedJoints {
public:
    explicit MovedJoints(const Retargeted& motion)
    {
        const Clip& clip = motion.clip;
        for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
            const formats::UnkeyedPose rest = pose_without_keys(clip.joints[joint]);
            std::vector<Eigen::Quaterniond> rotations;
            for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
                rotations.push_back(clip.rotation[frame * clip.joints.size() + joint]);
            const bool rests = std::ranges::all_of(
                rotations, [&](const auto& turn) { return turn.angularDistance(rest.rotation) < 1e-9; });
            if (rests) rotations.clear();
            if (!rests || static_cast<int>(joint) == motion.hips)
                tracks_.push_back({static_cast<int>(joint), std::move(rotations)});
        }
        for (const auto& [joint, rotations] : tracks_)
            keys_.push_back({joint, rotations,
                             joint == motion.hips ? std::span(clip.translation) : std::span<const Eigen::Vector3d>()});
    }
    std::span<const formats::JointKeys> keys() const { return keys_; }

private:
    std::vector<std::pair<int, std::vector<Eigen::Quaterniond>>> tracks_;
    std::vector<formats::JointKeys> keys_;
};

// The target's root, for --root-motion.
RootMotion root_of(const Retargeted& motion, int root, const KnownLimbs& limbs)
{
    const Eigen::Vector3d up_w = nearest_axis(facing_of(motion.clip, limbs).up_w);
    const LimbJoints& leg = limbs[2] ? *limbs[2] : *limbs[3];
    const double level =
        motion.ground && !rests_on_ground(motion.clip, leg[0], leg[2], up_w) ? motion.ground->target : 0;
    return {motion.clip, root, {motion.hips, motion.hips, up_w, [level](const Eigen::Vector3d&) { return level; }}};
}

void print_pairs(std::FILE* to, const Clip& source, const Clip& target, const JointPairs& pairs)
{
    const auto count = std::ranges::count_if(pairs, &PairedPart::is_paired);
    const auto parts =
        std::ranges::count_if(pairs, [](const auto& each) { return each.is_paired() && !each.name.empty(); });
    say(to, "paired    {} parts of the body, {} more joints by their names\n", parts, count - parts);
    say(to, "at rest   of TARGET: {}\n", names_of(target, unpaired_bones(pairs, target, BodySide::target)));
    say(to, "unused    of SOURCE: {}\n", names_of(source, unpaired_bones(pairs, source, BodySide::source)));
}

// problems: of each limb, why it was not solved; empty: it was.
void print_motion(std::FILE* to, const Retargeted& motion, const std::vector<std::string>& problems,
                  const std::vector<GoalMiss>& misses)
{
    say(to, "lengths   {:.6g} of TARGET for 1 of SOURCE, by the legs\n", motion.leg_ratio);
    for (std::size_t n = 0; n < misses.size(); ++n) {
        const formats::LimbName limb = motion.limbs[n];
        if (!problems[n].empty())
            say(to, "{:<9} not solved: {}\n", plain_name(limb), problems[n]);
        else
            say(to, "{:<9} {} from its goal: {:.2g} of the limb's length in the mean, most {:.2g} in frame {}\n",
                plain_name(limb), words_of(limb.kind).end_joint, misses[n].mean, misses[n].max, misses[n].max_frame);
    }
}

void print_clips(std::FILE* to, const RetargetOptions& options, const MotionFile& source, const MotionFile& target)
{
    say(to, "source    {}: {}, {} frames\n", shown_file(options.source), source.describe(), source.clip().frame_count);
    for (const std::string& note : source.notes()) say(to, "note      {}\n", note);
    say(to, "target    {}: {}\n", shown_file(options.target), target.describe());
    for (const std::string& note : target.notes()) say(to, "note      {}\n", note);
}

void print_verdict(std::FILE* to, const Verdict& verdict)
{
    for (const std::string& doubt : verdict.doubts) say(to, "look      {}\n", doubt);
    for (const std::string& fault : verdict.faults) say(to, "garbage   {}\n", fault);
    if (verdict.is_good()) say(to, "good      no bone, goal, knee, hand or foot stands out\n");
}

nlohmann::ordered_json names_json(const Clip& clip, const std::vector<int>& joints)
{
    nlohmann::ordered_json names = nlohmann::ordered_json::array();
    for (const int joint : joints) names.push_back(joint_at(clip, joint).name);
    return names;
}

nlohmann::ordered_json json_of(const RetargetOptions& options, const MotionFile& source, const MotionFile& target,
                               const JointPairs& pairs, const Retargeted& motion,
                               const std::vector<std::string>& problems, const Verdict& verdict)
{
    const auto of_file = [](const std::string& name, const MotionFile& file) {
        return nlohmann::ordered_json{{"file", name}, {"motion", file.describe()}, {"notes", file.notes()}};
    };
    nlohmann::ordered_json out = {
        {"source", of_file(options.source, source)},
        {"target", of_file(options.target, target)},
        {"frames", source.clip().frame_count},
        {"frame_time", frame_time_of(source.clip())},
        {"paired", std::ranges::count_if(pairs, &PairedPart::is_paired)},
        {"at_rest", names_json(target.clip(), unpaired_bones(pairs, target.clip(), BodySide::target))},
        {"unused", names_json(source.clip(), unpaired_bones(pairs, source.clip(), BodySide::source))},
        {"leg_ratio", motion.leg_ratio}};
    for (std::size_t n = 0; n < verdict.misses.size(); ++n) {
        const GoalMiss& miss = verdict.misses[n];
        nlohmann::ordered_json& limb = out["limbs"].emplace_back();
        limb["limb"] = limb_word(motion.limbs[n]);
        if (problems[n].empty())
            limb["missed"] = {{"mean", miss.mean}, {"max", miss.max}, {"frame", miss.max_frame}};
        else
            limb["problem"] = problems[n];
    }
    out["verdict"] = verdict.is_good() ? "good" : verdict.faults.empty() ? "look" : "garbage";
    out["look"] = verdict.doubts;
    out["garbage"] = verdict.faults;
    return out;
}

void print_written(std::FILE* to, std::initializer_list<std::string> outputs)
{
    for (const std::string& name : outputs)
        if (!name.empty())
            say(to, "written   {}\n", formats::is_standard_stream(name) ? "to standard output" : shown_file(name));
}

// Throws CommandError for files and options that do not go together.
void require_usage(const RetargetOptions& options)
{
    if (options.files.size() < 2)
        throw CommandError(2, "TARGET is missing; give SOURCE, and then TARGET; see swivel retarget --help");
    std::vector<std::string> inputs = options.files;
    inputs.push_back(options.map);
    const auto read_from_stream =
        std::ranges::count_if(inputs, [](const std::string& name) { return formats::is_standard_stream(name); });
    if (read_from_stream > 1)
        throw CommandError(2, "more than one of SOURCE, TARGET and --map is -, standard input; name the others");
    const std::size_t sources = options.files.size() - 1;
    if (read_from_stream > 0 && (sources > 1 || is_to_folder(options.out, sources)))
        throw CommandError(2,
                           "-, standard input, is read once and has no name; name files where there are several "
                           "SOURCEs, or a folder as --out");
    if (sources > 1 && !options.export_map.empty())
        throw CommandError(
            2, fmt::format("--export-map: a table is of one SOURCE, not of {}; run each by itself", sources));
}

// One SOURCE, to its file. reports: null for none. json: what it says of it is added there.
FileOutcome run_one(const RetargetOptions& options, const BodyChoice& of_source, const BodyChoice& of_target,
                    std::FILE* reports, nlohmann::ordered_json& json)
{
    MotionFile source_file(options.source, {options.clip, options.rate, of_source.rest}),
        target_file(options.target, {{}, 0, of_target.rest});
    if (!options.out.empty()) target_file.require_can_write(options.out, "TARGET", "");
    const std::string outputs[] = {options.out, options.export_map};
    require_not_beside(outputs, source_file);
    require_not_beside(outputs, target_file);
    const Clip &source = source_file.clip(), &target = target_file.clip();
    source_file.sample(all_bones(source));
    target_file.sample(all_bones(target));
    const JointPairs pairs = options.map.empty() ? pair_joints(parted_body(source, options.source, of_source),
                                                               parted_body(target, options.target, of_target))
                                                 : read_joint_map(options.map, source, target);
    if (source.frame_time == 0) throw formats::InputError(options.source, "its keys lie at uneven times; give --fps");
    source_file.fix_rest_pose(limbs_of(parts_of(pairs, BodySide::source)));
    target_file.fix_rest_pose(limbs_of(parts_of(pairs, BodySide::target)), true);
    require_bodies(options, pairs, source, target);
    const KnownLimbs limbs = limbs_of(parts_of(pairs, BodySide::target));
    const int root =
        options.root_motion
            ? root_joint(target, joints_of(parts_of(pairs, BodySide::target), "hips").front(), options.target)
            : -1;
    Retargeted motion = retarget(source, target, pairs);
    const std::vector<std::string> problems =
        solve_limbs(motion, parts_of(pairs, BodySide::target), options.map.empty() ? options.target : options.map);
    Verdict verdict = verdict_of(source, motion, pairs);
    for (const std::string& doubt : clip_doubts(source, parts_of(pairs, BodySide::source)))
        verdict.doubts.push_back("SOURCE: " + doubt);
    for (const std::string& doubt : body_doubts(target, parts_of(pairs, BodySide::target)))
        verdict.doubts.push_back("TARGET: " + doubt);
    const bool is_done = verdict.faults.empty() || options.force, is_written = is_done && !options.out.empty();
    const std::string map = is_done ? options.export_map : "";
    if (is_written) {
        const MovedJoints moved(motion);
        std::vector<formats::JointKeys> keys(moved.keys().begin(), moved.keys().end());
        std::optional<RootMotion> way;
        if (options.root_motion) {
            way.emplace(root_of(motion, root, limbs));
            way->add_to(keys);
        }
        target_file.write(options.out, keys,
                          formats::NewFrames{source.frame_count, source.frame_time,
                                             std::filesystem::path(title_of(options.source)).stem().string()},
                          way ? way->added() : std::nullopt);
    }
    if (!map.empty())
        write_joint_map(map, pairs, source, target, [&](int joint) { return target_file.can_key(joint); });
    if (reports) {
        print_clips(reports, options, source_file, target_file);
        print_pairs(reports, source, target, pairs);
        print_motion(reports, motion, problems, verdict.misses);
        print_verdict(reports, verdict);
        print_written(reports, {map, is_written ? options.out : ""});
    }
    if (options.json) {
        json.push_back(json_of(options, source_file, target_file, pairs, motion, problems, verdict));
        if (is_written) json.back()["out"] = options.out;
        if (!map.empty()) json.back()["export_map"] = map;
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
    const BodyChoice of_source = body_choice(options, BodySide::source),
                     of_target = body_choice(options, BodySide::target);
    const bool to_folder = is_to_folder(options.out, sources.size());
    const std::vector<std::string> outputs =
        outputs_of(sources, options.out, to_folder ? MotionFile(options.target, {}).suffix() : "");
    std::vector<std::string> written = outputs;
    written.push_back(options.export_map);
    if (to_folder) written.push_back(manifest_in(options.out));
    std::vector<ReadFile> read;
    for (const std::string& source : sources) read.push_back({source, "SOURCE"});
    read.push_back({options.target, "TARGET"}), read.push_back({options.map, "the table of pairs"});
    require_own_outputs(written, read);
    std::FILE* const to = report_stream(written);
    std::FILE* const reports = options.quiet || options.json ? nullptr : to;
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    const auto run = [&](std::size_t n) {
        options.source = sources[n], options.out = outputs[n];
        return run_one(options, of_source, of_target, to_folder ? nullptr : reports, json);
    };
    const auto print_all = [&] {
        if (options.json) print_json({{"clips", json}}, to);
    };
    if (sources.size() > 1 || to_folder) {
        const std::size_t failed =
            run_files(sources, {to_folder ? given.out : "", options.quiet, to_folder ? reports : nullptr}, run);
        print_all();
        return require_none_failed(failed, sources.size());
    }
    const FileOutcome outcome = run(0);
    const std::vector<std::string>& faults = outcome.garbage;
    print_all();
    if (outcome.is_refused)
        throw CommandError(
            1, fmt::format("{}: {}{}{}; see swivel rig of both{}", options.out.empty() ? options.target : options.out,
                           faults.front(), faults.size() == 1 ? "" : fmt::format(", and {} more", faults.size() - 1),
                           options.out.empty() && options.export_map.empty() ? "" : "; nothing is written",
                           options.out.empty() && options.export_map.empty() ? "" : ", or give --force"));
}

}  // namespace swivel::tools
