// SPDX-License-Identifier: MIT
//
// `swivel rig`: what a file's skeleton is to the solver, limb by limb, and why.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/swivel/command_error.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/common_options.h"
#include "tools/swivel/limbs.h"
#include "tools/swivel/motion_file.h"
#include "tools/swivel/report.h"
#include "tools/swivel/rig_report.h"
#include "tools/swivel/validators.h"

namespace swivel::tools {

namespace {

struct Options {
    std::string file, kinds = "all";
    MotionChoice motion;
    std::vector<std::string> arms, legs;
    bool joints = false, json = false;
};

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
        print_json(json_of(motion, options.file, search, options.joints));
    else
        print_rig(motion, options.file, search, options.joints);
    if (std::any_of(findings.begin(), findings.end(), [](const LimbFinding& each) { return each.limb.has_value(); }))
        return;
    throw CommandError(
        1, fmt::format("{}: nothing binds: {}{}", options.file, problem_text(findings[0]),
                       findings[0].advice.empty() ? "; name joints with --arm and --leg, --joints lists them" : ""));
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
    add_motion(*command, options->motion,
               "it decides the limits that are printed and, where the rest pose is straight or bends otherwise, hinges "
               "and axes");
    command->add_flag("--joints", options->joints, "List every joint, too: number, place at rest in the world, path");
    add_json(*command, options->json);
    command->callback([options] { run(*options); });
}

}  // namespace swivel::tools
