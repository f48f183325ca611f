// SPDX-License-Identifier: MIT
#include "tools/swivel/rig_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "tools/cli/streams.h"
#include "tools/formats/text.h"
#include "tools/rig/limb_axes.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"
#include "tools/swivel/report.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::printable;

std::string name_of(const Clip& clip, int joint) { return printable_name(joint_at(clip, joint)); }

// The joints between the limb's three.
std::vector<int> between(const Limb& limb)
{
    std::vector<int> found;
    for (const int joint : limb.chain.joints)
        if (std::find(limb.joints.begin(), limb.joints.end(), joint) == limb.joints.end()) found.push_back(joint);
    return found;
}

std::string list(const Clip& clip, const std::vector<int>& joints)
{
    std::string text;
    for (const int joint : joints) text += (text.empty() ? "" : ", ") + name_of(clip, joint);
    return text;
}

// A joint as a TOML string that names it alone: its name where no other joint has it, else its number.
std::string toml_name(const Clip& clip, int joint)
{
    const std::string& name = joint_at(clip, joint).name;
    const std::string quoted = nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    const bool can_be_written = name == printable(name, name.size()) && nlohmann::json::parse(quoted) == name;
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

// A comment of a TOML file, which is UTF-8 as a whole.
std::string toml_comment(const std::string& text)
{
    const nlohmann::json json = text;
    return "# " + nlohmann::json::parse(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
                      .get<std::string>();
}

// Which joints are meant, as a line of a crowd file.
std::string joints_line(const Clip& clip, const Limb& limb)
{
    return fmt::format("joints = [{}, {}, {}]", toml_name(clip, limb.upper()), toml_name(clip, limb.lower()),
                       toml_name(clip, limb.end()));
}

// What the clip fits into, as lines of a crowd file that bind the limb as they were taken.
void print_range(const Clip& clip, const Limb& limb)
{
    const std::optional<LimbRange> range = range_of(clip, limb);
    if (!range) return;
    const auto row = [](const Eigen::Vector3d& v) {
        return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", v.x(), v.y(), v.z());
    };
    const std::string_view word = limb_word(limb.name);
    say(stdout, "           in the clip the {} is {:.1f} to {:.1f} degrees from z; all its frames fit into\n",
        words_of(limb.name.kind).upper, range->from_z.least, range->from_z.most);
    say(stdout, "           [limb.{}]\n", word);
    say(stdout, "           {}\n", joints_line(clip, limb));
    say(stdout, "           bend = {}\n", row(range->bend));
    say(stdout, "           [limb.{}.limits]\n", word);
    say(stdout, "           shoulder_cone = {{ axis = {}, opening_deg = {:.1f} }}\n", row(range->axis),
        range->opening_deg);
    say(stdout, "           flexion_deg = [{:.1f}, {:.1f}]\n", range->flexion.least, range->flexion.most);
}

void print_limb(const Clip& clip, const Limb& limb, const Facing& facing)
{
    say(stdout, "{:<10} {} > {} > {}, named by {}\n", plain_name(limb.name), name_of(clip, limb.upper()),
        name_of(clip, limb.lower()), name_of(clip, limb.end()), limb.from);
    say(stdout, "           {:.6g} + {:.6g} long in the world, scale {:.6g}{}\n", limb.bound.lengths[0],
        limb.bound.lengths[1], limb.scale, limb.mirrored ? ", mirrored" : "");
    say(stdout, "           bones along {} and {} of their joints' axes\n", vector_text(limb.upper_bone),
        vector_text(limb.lower_bone));
    say(stdout, "           bends towards {}: {}\n", vector_text(limb.bend), limb.bend_source);
    print_axes(limb, facing);
    if (const auto inner = between(limb); !inner.empty())
        say(stdout, "           joints in between, which keep their own motion: {}\n", list(clip, inner));
    if (limb.unevenness > 1e-5)
        say(stdout, "           uneven scales put the {} off by at most {:.1e} of the length\n",
            words_of(limb.name.kind).end_joint, limb.unevenness);
    if (!limb.note.empty()) say(stdout, "           note: {}\n", limb.note);
    print_range(clip, limb);
}

void print_joints(const Clip& clip)
{
    const std::vector<Eigen::Vector3d> places_w = formats::rest_positions(clip);
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint)
        say(stdout, "#{:<5} {:<24} {}{}\n", clip.joints[joint].number, vector_text(places_w[joint]),
            printable(formats::joint_path(clip, static_cast<int>(joint)), 400),
            clip.joints[joint].is_bone ? "" : " (no bone)");
}

std::vector<double> vector_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json json_of(const AngleRange& range) { return {range.least, range.most}; }

nlohmann::ordered_json json_of_frame(const Clip& clip, const Limb& limb, const Facing& facing)
{
    nlohmann::ordered_json out;
    for (int n = 0; n < 3; ++n) {
        const Eigen::Vector3d axis_w = limb.axes_w.col(n);
        out["axes"][std::array{"x", "y", "z"}[static_cast<std::size_t>(n)]] = {
            {"world", vector_of(axis_w)}, {"points", direction_words(axis_w, facing)}};
    }
    if (const std::optional<LimbRange> range = range_of(clip, limb))
        out["clip_range"] = {{"bend", vector_of(range->bend)},
                             {"upper_from_z_deg", json_of(range->from_z)},
                             {"shoulder_cone", {{"axis", vector_of(range->axis)}, {"opening_deg", range->opening_deg}}},
                             {"flexion_deg", json_of(range->flexion)}};
    return out;
}

// What bind() takes, field by field.
nlohmann::ordered_json json_of_chain(const swivel_chain& chain)
{
    return {{"elbow_offset", chain.elbow_offset},           {"wrist_offset", chain.wrist_offset},
            {"shoulder_rotation", chain.shoulder_rotation}, {"elbow_rotation", chain.elbow_rotation},
            {"wrist_rotation", chain.wrist_rotation},       {"bend", chain.bend}};
}

nlohmann::ordered_json json_of(const Clip& clip, const LimbFinding& finding, const Facing& facing)
{
    nlohmann::ordered_json out{{"limb", limb_word(finding.name)}, {"bound", finding.limb.has_value()}};
    if (!finding.limb) {
        out["problem"] = problem_text(finding);
        return out;
    }
    const Limb& limb = *finding.limb;
    const auto names = [&](const auto& joints) {
        auto all = nlohmann::ordered_json::array();
        for (const int joint : joints) all.push_back(joint_at(clip, joint).name);
        return all;
    };
    out["named_by"] = limb.from;
    out["joints"] = names(limb.joints);
    for (const int joint : limb.joints) out["numbers"].push_back(joint_at(clip, joint).number);
    out["lengths"] = {limb.bound.lengths[0], limb.bound.lengths[1]};
    out["scale"] = limb.scale;
    out["mirrored"] = limb.mirrored;
    out["upper_bone"] = vector_of(limb.upper_bone);
    out["lower_bone"] = vector_of(limb.lower_bone);
    out["bend"] = vector_of(limb.bend);
    out["bend_source"] = limb.bend_source;
    out["chain"] = json_of_chain(rest_chain(clip, limb.chain, limb.bend));
    out.update(json_of_frame(clip, limb, facing));
    out["joints_between"] = names(between(limb));
    out["unevenness"] = limb.unevenness;
    if (!limb.note.empty()) out["note"] = limb.note;
    return out;
}

}  // namespace

nlohmann::ordered_json json_of(const MotionFile& motion, const std::string& file, const LimbSearch& search,
                               bool with_joints)
{
    const Clip& clip = motion.clip();
    const Facing& facing = search.facing;
    nlohmann::ordered_json out{{"file", file},
                               {"motion", motion.describe()},
                               {"joints", clip.joints.size()},
                               {"frames", clip.frame_count},
                               {"frame_time", frame_time_of(clip)},
                               {"faces", vector_of(facing.forwards)},
                               {"faces_by", facing.source},
                               {"up", vector_of(facing.up)},
                               {"up_by", facing.up_source}};
    for (const LimbFinding& finding : search.findings) out["limbs"].push_back(json_of(clip, finding, facing));
    const std::vector<Eigen::Vector3d> places_w = formats::rest_positions(clip);
    if (with_joints)
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            out["joint_list"].push_back({{"number", clip.joints[n].number},
                                         {"place", vector_of(places_w[n])},
                                         {"path", formats::joint_path(clip, static_cast<int>(n))},
                                         {"bone", clip.joints[n].is_bone}});
    return out;
}

void print_rig(const MotionFile& motion, const std::string& file, const LimbSearch& search, bool with_joints)
{
    const Clip& clip = motion.clip();
    const Facing& facing = search.facing;
    const auto bones = std::count_if(clip.joints.begin(), clip.joints.end(), [](const auto& at) { return at.is_bone; });
    say(stdout, "{}: {}, {} joints, {} of them bones, {} frame{}\n", file, motion.describe(), clip.joints.size(), bones,
        clip.frame_count, clip.frame_count == 1 ? "" : "s");
    say(stdout, "faces {}, told by {}; up is {}, told by {}\n", vector_text(facing.forwards), facing.source,
        vector_text(facing.up), facing.up_source);
    for (const LimbFinding& finding : search.findings) {
        if (finding.limb)
            print_limb(clip, *finding.limb, facing);
        else
            say(stdout, "{:<10} {}: {}\n", plain_name(finding.name), finding.has_joints ? "refused" : "missing",
                problem_text(finding));
    }
    if (with_joints) print_joints(clip);
}

void print_crowd_file(const MotionFile& motion, const std::string& file, const LimbSearch& search)
{
    const Clip& clip = motion.clip();
    say(stdout, "{}\n", toml_comment("The limbs of " + printable(file, 400)));
    for (const LimbFinding& finding : search.findings) {
        if (!finding.limb) {
            say(stdout, "\n{}\n",
                toml_comment(fmt::format("{} {}: {}", plain_name(finding.name),
                                         finding.has_joints ? "refused" : "missing", problem_text(finding))));
            continue;
        }
        const Limb& limb = *finding.limb;
        say(stdout, "\n[limb.{}]\n{}\n", limb_word(limb.name), joints_line(clip, limb));
        say(stdout, "bend = [{:#}, {:#}, {:#}]  {}\n", limb.bend.x(), limb.bend.y(), limb.bend.z(),
            toml_comment(limb.bend_source));
    }
}

}  // namespace swivel::tools
