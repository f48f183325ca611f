// SPDX-License-Identifier: MIT
//
// `swivel rig`: what a file's skeleton is to the solver, limb by limb, and why.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/formats/text.h"
#include "tools/swivel/command_error.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/common_options.h"
#include "tools/swivel/limb_axes.h"
#include "tools/swivel/limb_words.h"
#include "tools/swivel/limbs.h"
#include "tools/swivel/motion_file.h"
#include "tools/swivel/report.h"
#include "tools/swivel/validators.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::printable;

struct Options {
    std::string file, kinds = "all";
    MotionChoice motion;
    std::vector<std::string> arms, legs;
    bool joints = false, json = false;
};

std::string name_of(const Clip& clip, int joint) { return printable_name(joint_at(clip, joint)); }

std::string vector_text(const Eigen::Vector3d& v)
{
    const Eigen::Array3d shown = (1000 * v).array().round() / 1000 + 0.0;  // no -0.000
    return fmt::format("({:.3f} {:.3f} {:.3f})", shown.x(), shown.y(), shown.z());
}

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

// What limits are written by.
void print_frame(const Clip& clip, const Limb& limb, const Front& front)
{
    for (int n = 0; n < 3; ++n) {
        const Eigen::Vector3d axis_w = limb.axes_w.col(n);
        fmt::print("           {:<21} {} {} {}\n", n == 0 ? "limits' axes at rest:" : "", "xyz"[n], vector_text(axis_w),
                   direction_words(axis_w, front));
    }
    const std::optional<LimbRange> range = range_of(clip, limb);
    if (!range) return;
    const LimbWords& words = words_of(limb.name.kind);
    fmt::print("           in the clip the {} is {:.1f} to {:.1f} degrees from z; all of it fits into\n", words.upper,
               range->from_z.least, range->from_z.most);
    fmt::print("           [limb.{}.limits]\n", limb_word(limb.name));
    fmt::print("           shoulder_cone = {{ axis = [{:.3f}, {:.3f}, {:.3f}], opening_deg = {:.1f} }}\n",
               range->axis.x() + 0.0, range->axis.y() + 0.0, range->axis.z() + 0.0, range->opening_deg);
    fmt::print("           flexion_deg = [{:.1f}, {:.1f}]\n", range->flexion.least, range->flexion.most);
}

void print_limb(const Clip& clip, const Limb& limb, const Front& front)
{
    fmt::print("{:<10} {} > {} > {}, named {} {}\n", plain_name(limb.name), name_of(clip, limb.upper()),
               name_of(clip, limb.lower()), name_of(clip, limb.end()), limb.habit.starts_with('-') ? "by" : "as",
               limb.habit);
    fmt::print("           {:.6g} + {:.6g} long in the world, scale {:.6g}{}\n", limb.bound.lengths[0],
               limb.bound.lengths[1], limb.scale, limb.mirrored ? ", mirrored" : "");
    fmt::print("           bones along {} and {} of their joints' axes\n", vector_text(limb.upper_bone),
               vector_text(limb.lower_bone));
    fmt::print("           hinge {}: {}\n", vector_text(limb.hinge), limb.hinge_source);
    print_frame(clip, limb, front);
    if (const auto inner = between(limb); !inner.empty())
        fmt::print("           twist bones in between, which keep their own motion: {}\n", list(clip, inner));
    if (!limb.side_twists.empty())
        fmt::print("           twist bones beside, which keep their own motion: {}\n", list(clip, limb.side_twists));
}

void print_joints(const Clip& clip)
{
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint)
        fmt::print("#{:<5} {}{}\n", clip.joints[joint].number,
                   printable(formats::joint_path(clip, static_cast<int>(joint)), 400),
                   clip.joints[joint].is_bone ? "" : " (no bone)");
}

std::vector<double> vector_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json json_of(const AngleRange& range) { return {range.least, range.most}; }

nlohmann::ordered_json json_of_frame(const Clip& clip, const Limb& limb, const Front& front)
{
    nlohmann::ordered_json out;
    for (int n = 0; n < 3; ++n) {
        const Eigen::Vector3d axis_w = limb.axes_w.col(n);
        out["axes"][std::array{"x", "y", "z"}[static_cast<std::size_t>(n)]] = {
            {"world", vector_of(axis_w)}, {"points", direction_words(axis_w, front)}};
    }
    if (const std::optional<LimbRange> range = range_of(clip, limb))
        out["clip_range"] = {{"upper_from_z_deg", json_of(range->from_z)},
                             {"shoulder_cone", {{"axis", vector_of(range->axis)}, {"opening_deg", range->opening_deg}}},
                             {"flexion_deg", json_of(range->flexion)}};
    return out;
}

nlohmann::ordered_json json_of(const Clip& clip, const LimbFinding& finding, const Front& front)
{
    nlohmann::ordered_json out{{"limb", limb_word(finding.name)}, {"bound", finding.limb.has_value()}};
    if (!finding.limb) {
        out["problem"] = finding.problem;
        return out;
    }
    const Limb& limb = *finding.limb;
    const auto names = [&](const auto& joints) {
        auto all = nlohmann::ordered_json::array();
        for (const int joint : joints) all.push_back(joint_at(clip, joint).name);
        return all;
    };
    out["named_as"] = limb.habit;
    out["joints"] = names(limb.joints);
    for (const int joint : limb.joints) out["numbers"].push_back(joint_at(clip, joint).number);
    out["lengths"] = {limb.bound.lengths[0], limb.bound.lengths[1]};
    out["scale"] = limb.scale;
    out["mirrored"] = limb.mirrored;
    out["upper_bone"] = vector_of(limb.upper_bone);
    out["lower_bone"] = vector_of(limb.lower_bone);
    out["hinge"] = vector_of(limb.hinge);
    out["hinge_source"] = limb.hinge_source;
    out.update(json_of_frame(clip, limb, front));
    out["twist_bones_between"] = names(between(limb));
    out["twist_bones_beside"] = names(limb.side_twists);
    return out;
}

void print_json_report(const Options& options, const MotionFile& motion, const LimbSearch& search)
{
    const Clip& clip = motion.clip();
    nlohmann::ordered_json out{{"file", options.file},
                               {"motion", motion.describe()},
                               {"joints", clip.joints.size()},
                               {"frames", clip.frame_count},
                               {"frame_time", clip.frame_time},
                               {"faces", vector_of(search.front.forwards)},
                               {"up", vector_of(search.front.up)},
                               {"faces_by", search.front.source}};
    for (const LimbFinding& finding : search.findings) out["limbs"].push_back(json_of(clip, finding, search.front));
    if (options.joints)
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            out["joint_list"].push_back({{"number", clip.joints[n].number},
                                         {"path", formats::joint_path(clip, static_cast<int>(n))},
                                         {"bone", clip.joints[n].is_bone}});
    print_json(out);
}

void print_report(const Options& options, const MotionFile& motion, const LimbSearch& search)
{
    const Clip& clip = motion.clip();
    const auto bones = std::count_if(clip.joints.begin(), clip.joints.end(), [](const auto& at) { return at.is_bone; });
    fmt::print("{}: {}, {} joints, {} of them bones, {} frames\n", options.file, motion.describe(), clip.joints.size(),
               bones, clip.frame_count);
    fmt::print("faces {}, told by {}; up is {}\n", vector_text(search.front.forwards), search.front.source,
               vector_text(search.front.up));
    for (const LimbFinding& finding : search.findings) {
        if (finding.limb)
            print_limb(clip, *finding.limb, search.front);
        else
            fmt::print("{:<10} {}: {}\n", plain_name(finding.name), finding.has_names ? "refused" : "missing",
                       finding.problem);
    }
    if (options.joints) print_joints(clip);
}

void run(const Options& options)
{
    if (!swivel_isa_name()) throw CommandError(1, swivel_last_error());
    const MotionFile motion(options.file, options.motion);
    LimbChoice choice;
    choice.kinds = options.kinds;
    for (const std::string& arm : options.arms) choice.arms.push_back(limb_of_option(arm, "--arm"));
    for (const std::string& leg : options.legs) choice.legs.push_back(limb_of_option(leg, "--leg"));
    const LimbSearch search = look_for_limbs(motion.clip(), options.file, choice);
    const std::vector<LimbFinding>& findings = search.findings;
    if (options.json)
        print_json_report(options, motion, search);
    else
        print_report(options, motion, search);
    if (std::none_of(findings.begin(), findings.end(), [](const LimbFinding& each) { return each.limb.has_value(); }))
        throw CommandError(
            1, fmt::format("{}: nothing binds: {}; name joints with --arm and --leg, --joints lists them", options.file,
                           findings[0].problem));
}

}  // namespace

void add_rig(CLI::App& app)
{
    CLI::App* command = app.add_subcommand(
        "rig", "Show what a skeleton is to the solver: its arms and legs, lengths, axes, hinges, and what is missing");
    auto options = std::make_shared<Options>();
    command
        ->add_option("file", options->file,
                     "Skeleton, with or without motion: .bvh, .glb, .gltf or .vrm; .fbx and .dae where swivel is built "
                     "with assimp")
        ->required()
        ->check(file_name());
    command->add_option("--limbs", options->kinds, "Which limbs to look for: arms, legs or all")
        ->capture_default_str()
        ->check(CLI::IsMember({"arms", "legs", "all"}));
    add_named_limbs(*command, options->arms, options->legs, "the other side is still looked for");
    command->add_option("--clip", options->motion.clip,
                        "Animation of a glTF, FBX or DAE file that shows the hinges, by name or index; else the first");
    command->add_flag("--joints", options->joints, "List every joint, too: number and path");
    add_json(*command, options->json);
    command->callback([options] { run(*options); });
}

}  // namespace swivel::tools
