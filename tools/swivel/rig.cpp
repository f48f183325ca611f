// SPDX-License-Identifier: MIT
//
// `swivel rig`: what a file's skeleton is to the solver, limb by limb, and why.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/formats/text.h"
#include "tools/swivel/command_error.h"
#include "tools/swivel/commands.h"
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

const formats::Joint& joint_at(const Clip& clip, int joint) { return clip.joints[static_cast<std::size_t>(joint)]; }

std::string name_of(const Clip& clip, int joint) { return printable(joint_at(clip, joint).name, 80); }

std::string vector_text(const Eigen::Vector3d& v)
{
    return fmt::format("({:.3f} {:.3f} {:.3f})", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
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

void print_limb(const Clip& clip, const Limb& limb)
{
    fmt::print("{:<10} {} > {} > {}, named {} {}\n", plain_name(limb.name), name_of(clip, limb.upper()),
               name_of(clip, limb.lower()), name_of(clip, limb.end()), limb.habit.starts_with('-') ? "by" : "as",
               limb.habit);
    fmt::print("           {:.6g} + {:.6g} long in the world, scale {:.6g}{}\n", limb.bound.lengths[0],
               limb.bound.lengths[1], limb.scale, limb.mirrored ? ", mirrored" : "");
    fmt::print("           bones along {} and {} of their joints' axes\n", vector_text(limb.upper_bone),
               vector_text(limb.lower_bone));
    fmt::print("           hinge {}: {}\n", vector_text(limb.hinge), limb.hinge_source);
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

nlohmann::ordered_json json_of(const Clip& clip, const LimbFinding& finding)
{
    nlohmann::ordered_json out{{"limb", limb_word(finding.name)}, {"bound", finding.limb.has_value()}};
    if (!finding.limb) {
        out["problem"] = finding.problem;
        return out;
    }
    const Limb& limb = *finding.limb;
    const auto vector = [](const Eigen::Vector3d& v) { return std::vector<double>{v.x(), v.y(), v.z()}; };
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
    out["upper_bone"] = vector(limb.upper_bone);
    out["lower_bone"] = vector(limb.lower_bone);
    out["hinge"] = vector(limb.hinge);
    out["hinge_source"] = limb.hinge_source;
    out["twist_bones_between"] = names(between(limb));
    out["twist_bones_beside"] = names(limb.side_twists);
    return out;
}

void print_json_report(const Options& options, const MotionFile& motion, const std::vector<LimbFinding>& findings)
{
    const Clip& clip = motion.clip();
    nlohmann::ordered_json out{{"file", options.file},
                               {"motion", motion.describe()},
                               {"joints", clip.joints.size()},
                               {"frames", clip.frame_count},
                               {"frame_time", clip.frame_time}};
    for (const LimbFinding& finding : findings) out["limbs"].push_back(json_of(clip, finding));
    if (options.joints)
        for (std::size_t n = 0; n < clip.joints.size(); ++n)
            out["joint_list"].push_back({{"number", clip.joints[n].number},
                                         {"path", formats::joint_path(clip, static_cast<int>(n))},
                                         {"bone", clip.joints[n].is_bone}});
    print_json(out);
}

void print_report(const Options& options, const MotionFile& motion, const std::vector<LimbFinding>& findings)
{
    const Clip& clip = motion.clip();
    const auto bones = std::count_if(clip.joints.begin(), clip.joints.end(), [](const auto& at) { return at.is_bone; });
    fmt::print("{}: {}, {} joints, {} of them bones, {} frames\n", options.file, motion.describe(), clip.joints.size(),
               bones, clip.frame_count);
    for (const LimbFinding& finding : findings) {
        if (finding.limb)
            print_limb(clip, *finding.limb);
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
    const std::vector<LimbFinding> findings = look_for_limbs(motion.clip(), options.file, choice);
    if (options.json)
        print_json_report(options, motion, findings);
    else
        print_report(options, motion, findings);
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
    command
        ->add_option("--arm", options->arms,
                     "Joints of an arm, SHOULDER,ELBOW,WRIST, by name, path or number (#12), where their names do not "
                     "tell; up to twice; left: or right: in front sets the side")
        ->allow_extra_args(false);
    command->add_option("--leg", options->legs, "Joints of a leg, HIP,KNEE,ANKLE, in the same way")
        ->allow_extra_args(false);
    command->add_option("--clip", options->motion.clip,
                        "Animation of a glTF, FBX or DAE file that shows the hinges, by name or index; else the first");
    command->add_flag("--joints", options->joints, "List every joint, too: number and path");
    command->add_flag("--json", options->json, "Print JSON");
    command->callback([options] { run(*options); });
}

}  // namespace swivel::tools
