// SPDX-License-Identifier: MIT
//
// `swivel rig`: shows how a file's skeleton is bound, limb by limb, and why.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/command_error.h"
#include "tools/cli/streams.h"
#include "tools/formats/printable.h"
#include "tools/rig/clip_doubts.h"
#include "tools/rig/limb_axes.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/limbs.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/crowd_job.h"
#include "tools/swivel/motion_file.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

using formats::Clip;

// The file's own number of a joint; null for the one above a root.
Json number_of(const Clip& clip, int joint) { return joint < 0 ? Json() : Json(joint_at(clip, joint).number); }

Json json_of(const AngleRange& range) { return {range.min, range.max}; }

Json json_of_frame(const Clip& clip, const Limb& limb, const Facing& facing)
{
    Json out;
    for (int n = 0; n < 3; ++n) {
        const Eigen::Vector3d axis_w = limb.axes_w.col(n);
        out["axes"][std::string(1, "xyz"[n])] = {{"world", axis_w}, {"points", direction_words(axis_w, facing)}};
    }
    if (const std::optional<LimbRange> range = range_of(clip, limb))
        out["clip_range"] = {{"bend", range->bend},
                             {"upper_from_z_deg", json_of(range->from_z)},
                             {"shoulder_cone", {{"axis", range->axis}, {"opening_deg", range->opening_deg}}},
                             {"flexion_deg", json_of(range->flexion)}};
    return out;
}

// The limb alone, as Python's bind_joints() takes a skeleton: joint 0 is the shoulder, 1 the elbow, 2 the wrist.
Json json_of(const formats::LimbRest& rest)
{
    return {{"parents", {-1, 0, 1}},
            {"translations", {{0, 0, 0}, rest.elbow_offset, rest.wrist_offset}},
            {"rotations", {rest.shoulder_rotation, rest.elbow_rotation, rest.wrist_rotation}}};
}

Json json_of(const Clip& clip, const LimbFinding& finding, const Facing& facing)
{
    Json out{{"limb", limb_word(finding.name)}, {"bound", finding.limb.has_value()}};
    if (!finding.limb) {
        out["problem"] = problem_text(finding);
        return out;
    }
    const Limb& limb = *finding.limb;
    out["named_by"] = limb.from;
    out["joints"] = names_json(clip, limb.joints);
    for (const int joint : limb.joints) out["numbers"].push_back(joint_at(clip, joint).number);
    out["lengths"] = limb.bound.lengths;
    out["scale"] = limb.scale;
    out["mirrored"] = limb.mirrored;
    out["upper_bone"] = limb.upper_bone;
    out["lower_bone"] = limb.lower_bone;
    out["bend"] = limb.bend;
    out["bend_source"] = limb.bend_source;
    out["skeleton"] = json_of(limb_rest(clip, limb.chain, limb.bend));
    out.update(json_of_frame(clip, limb, facing));
    out["joints_between"] = names_json(clip, limb.chain.between());
    out["unevenness"] = limb.unevenness;
    if (!limb.notes.empty()) out["notes"] = limb.notes;
    return out;
}

Json json_of(const MotionFile& motion, const std::string& file, const LimbSearch& search, bool with_joints)
{
    const Clip& clip = motion.clip();
    const Facing& facing = search.facing;
    Json out{{"file", file},
             {"motion", motion.describe()},
             {"joints", clip.joints.size()},
             {"frames", clip.frame_count},
             {"frame_time", frame_time_of(clip)},
             {"faces", facing.forwards_w},
             {"faces_by", facing.forwards_source},
             {"up", facing.up_w},
             {"up_by", facing.up_source}};
    if (const auto notes = motion.notes(); !notes.empty()) out["notes"] = notes;
    if (const auto doubts = texts_of(clip_doubts({clip, search.body})); !doubts.empty()) out["doubts"] = doubts;
    for (const LimbFinding& finding : search.findings) out["limbs"].push_back(json_of(clip, finding, facing));
    for (const BodyPart& part : search.body)
        for (const int joint : part.joints) out["body"][part.name].push_back(joint_at(clip, joint).number);
    const std::vector<formats::JointPose> rest_w = formats::rest_pose(clip);
    if (with_joints)
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            out["joint_list"].push_back({{"number", clip.joints[n].number},
                                         {"name", clip.joints[n].name},
                                         {"parent", number_of(clip, clip.joints[n].parent)},
                                         {"place", rest_w[n].position},
                                         {"bone", clip.joints[n].is_bone}});
    return out;
}

using formats::printable;

std::string name_of(const Clip& clip, int joint) { return printable_name(joint_at(clip, joint)); }

std::string list(const Clip& clip, const std::vector<int>& joints, const char* between)
{
    std::string text;
    for (const int joint : joints) text += (text.empty() ? "" : between) + name_of(clip, joint);
    return text;
}

// A joint as a TOML string that names it alone: its name where no other joint has it, else its number.
std::string toml_name(const Clip& clip, int joint)
{
    const std::string& name = joint_at(clip, joint).name;
    using Errors = Json::error_handler_t;
    const auto dumped = [&](Errors errors) { return Json(name).dump(-1, ' ', false, errors); };
    // One text replaces bytes that are no UTF-8, the other drops them. So the texts are equal only without such bytes.
    const std::string quoted = dumped(Errors::replace);
    const bool can_be_written = name == printable(name, name.size()) && quoted == dumped(Errors::ignore);
    if (can_be_written && formats::find_joints(clip, name).size() == 1) return quoted;
    return fmt::format("\"#{}\"", joint_at(clip, joint).number);
}

// Where the limits' axes point.
void print_axes(const Limb& limb, const Facing& facing)
{
    for (int n = 0; n < 3; ++n) {
        const Eigen::Vector3d axis_w = limb.axes_w.col(n);
        say(stdout, "           {:<21} {} {} {}\n", n == 0 ? "limits' axes at rest:" : "", "xyz"[n],
            vector_text(axis_w), direction_words(axis_w, facing));
    }
}

// The limits that the clip fits into, as lines of a crowd file that bind the limb as they were taken.
void print_range(const Clip& clip, const Limb& limb)
{
    const std::optional<LimbRange> range = range_of(clip, limb);
    if (!range) return;
    const std::string_view word = limb_word(limb.name);
    say(stdout, "           in the clip the {} is {:.1f} to {:.1f} degrees from z; all its frames fit into\n",
        words_of(limb.name.kind).upper, range->from_z.min, range->from_z.max);
    say(stdout, "           [limb.{}]\n", word);
    say(stdout, "           joints = [{}, {}, {}]\n", toml_name(clip, limb.upper()), toml_name(clip, limb.lower()),
        toml_name(clip, limb.end()));
    say(stdout, "           bend = {}\n", toml_row(range->bend));
    say(stdout, "           [limb.{}.limits]\n", word);
    say(stdout, "           shoulder_cone = {{ axis = {}, opening_deg = {:.1f} }}\n", toml_row(range->axis),
        range->opening_deg);
    say(stdout, "           flexion_deg = [{:.1f}, {:.1f}]\n", range->flexion.min, range->flexion.max);
}

void print_limb(const Clip& clip, const Limb& limb, const Facing& facing)
{
    say(stdout, "{:<10} {} > {} > {}, named by {}\n", plain_name(limb.name), name_of(clip, limb.upper()),
        name_of(clip, limb.lower()), name_of(clip, limb.end()), limb.from);
    say(stdout, "           {:.6g} + {:.6g} long in the world, scale {:.6g}{}\n", limb.bound.lengths[0],
        limb.bound.lengths[1], limb.scale, limb.mirrored ? ", mirrored" : "");
    say(stdout, "           bones along {} and {} of their joints' axes\n", vector_text(limb.upper_bone),
        vector_text(limb.lower_bone));
    say(stdout, "           bends towards {} in its joint's axes: {}\n", vector_text(limb.bend), limb.bend_source);
    print_axes(limb, facing);
    if (const auto inner = limb.chain.between(); !inner.empty())
        say(stdout, "           joints in between, which keep their own motion: {}\n", list(clip, inner, ", "));
    for (const std::string& note : limb.notes) say(stdout, "           note: {}\n", note);
    print_range(clip, limb);
}

// Names from the root down to the joint; of long ones the end.
std::string shown_path(const Clip& clip, int joint)
{
    std::string path = joint_at(clip, joint).name;
    for (int up = joint_at(clip, joint).parent; up >= 0; up = joint_at(clip, up).parent) {
        path = (path.size() < 200 ? joint_at(clip, up).name : "...") + '/' + path;
        if (path.starts_with("...")) break;
    }
    return printable(path, formats::kMaxQuoted);
}

// The parts that are no joints of limbs.
void print_body(const Clip& clip, const std::vector<BodyPart>& body)
{
    const char* heading = "body";
    for (const BodyPart& part : body) {
        if (is_limb_part(part)) continue;
        say(stdout, "{:<10} {}: {}\n", heading, part.name,
            printable(list(clip, part.joints, " > "), formats::kMaxQuoted));
        heading = "";
    }
    if (!joints_of(body, "spine").empty() && joints_of(body, "head").empty())
        say(stdout,
            "{:<10} head: missing: no joint above the chest has a name in use for one; look.head of a crowd file or "
            "--head of swivel retarget names it\n",
            "");
}

void print_joints(const Clip& clip)
{
    const std::vector<formats::JointPose> rest_w = formats::rest_pose(clip);
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint)
        say(stdout, "#{:<5} {:<24} {}{}\n", clip.joints[joint].number, vector_text(rest_w[joint].position),
            shown_path(clip, static_cast<int>(joint)), clip.joints[joint].is_bone ? "" : " (no bone)");
}

// On stdout. file: as the user wrote it; with_joints: every joint, too.
void print_rig(const MotionFile& motion, const std::string& file, const LimbSearch& search, bool with_joints)
{
    const Clip& clip = motion.clip();
    const Facing& facing = search.facing;
    say(stdout, "{}: {}, {} joints, {} of them bones, {}\n", shown_file(file), motion.describe(), clip.joints.size(),
        std::ranges::count(clip.joints, true, &formats::Joint::is_bone), counted(clip.frame_count, "frame"));
    say(stdout, "faces {}, told by {}; up is {}, told by {}\n", vector_text(facing.forwards_w), facing.forwards_source,
        vector_text(facing.up_w), facing.up_source);
    for (const std::string& note : motion.notes()) say(stdout, "note: {}\n", note);
    for (const ClipDoubt& doubt : clip_doubts({clip, search.body})) say(stdout, "look: {}\n", doubt.text);
    for (const LimbFinding& finding : search.findings) {
        if (finding.limb)
            print_limb(clip, *finding.limb, facing);
        else
            say(stdout, "{:<10} {}: {}\n", plain_name(finding.name), finding.has_joints ? "refused" : "missing",
                problem_text(finding));
    }
    print_body(clip, search.body);
    if (with_joints) print_joints(clip);
}

}  // namespace

void run_rig(const RigOptions& options)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const std::string& file = options.clip.file;
    const LimbChoice choice = choice_of(options.clip);
    MotionFile motion(file, options.clip.motion);
    const FigureJoints joints = motion.find_limbs(choice);
    const LimbSearch search = bind_limbs(motion.clip(), joints, choice);
    const std::vector<LimbFinding>& findings = search.findings;
    if (options.json)
        print_json(json_of(motion, file, search, options.joints));
    else
        print_rig(motion, file, search, options.joints);
    if (std::ranges::any_of(findings, [](const LimbFinding& each) { return each.limb.has_value(); })) return;
    throw CommandError(
        1, fmt::format("{}: nothing binds: {}{}", file, problem_text(findings[0]),
                       findings[0].advice.empty() ? "; name joints with --arm and --leg, --joints lists them" : ""));
}

}  // namespace swivel::tools
