// SPDX-License-Identifier: MIT
#include "tools/swivel/shared_options.h"

#include "tools/rig/vectors.h"

namespace swivel::tools {

CLI::Option* add_of_body(CLI::App& command, const std::string& name, const std::string& type,
                         std::vector<std::string>& texts, const std::string& meaning)
{
    return command.add_option(name, texts, meaning)->type_name(type)->allow_extra_args(false);
}

CLI::Option* add_threads(CLI::App& command, unsigned& threads, const std::string& meaning)
{
    return add_value(command, "--threads", threads, whole_number(0, 1024), meaning)->capture_default_str();
}

CLI::Option* add_json(CLI::App& command, bool& json) { return command.add_flag("--json", json, "Print JSON"); }

CLI::Option* add_quiet(CLI::App& command, bool& quiet, const std::string& meaning)
{
    return command.add_flag("--quiet", quiet, meaning);
}

void add_quiet_and_json(CLI::App& command, bool& quiet, bool& json)
{
    add_quiet(command, quiet, "Print errors, and what --json asks for, and nothing else");
    add_json(command, json);
}

CLI::Option* add_file(CLI::App& command, std::string& file, const std::string& meaning)
{
    return add_file_option(
               command, "FILE", file,
               meaning +
                   ": BVH or glTF (.glb, .gltf, .vrm, .vrma), as its first bytes say. In BVH a joint's position "
                   "channels replace its OFFSET. - is standard input")
        ->required()
        ->option_text(" ");
}

void add_files(CLI::App& command, std::vector<std::string>& files, const std::string& more)
{
    add_file_option(command, "FILE", files,
                    "Motion files: BVH or glTF (.glb, .gltf, .vrm, .vrma), as their first bytes say. " + more +
                        "- is standard input")
        ->required()
        ->option_text("...");
}

CLI::Option* add_kinds(CLI::App& command, std::string& kinds, const std::string& meaning)
{
    return add_value(command, "--limbs", kinds, one_of({"arms", "legs", "all"}), meaning);
}

void add_animation(CLI::App& command, std::string& clip, double& rate, const std::string& use)
{
    add_value(command, "--clip", clip, name("name an animation, or leave the option out for the first"),
              "Which animation of a glTF FILE, by name or, counted from 0, by index. Without it the first. " + use);
    add_value(command, "--fps", rate, number(0.001, 10'000),
              "Sample the motion at about this many even frames a second, 0.001 to 10000. Without it the frames of a "
              "BVH file, or the limbs' own keys (docs/motion_files.md)");
}

void add_motion(CLI::App& command, MotionChoice& motion, const std::string& use)
{
    add_animation(command, motion.clip, motion.rate, use);
    add_value(command, "--rest", motion.rest.frame, whole_number(0, UINT32_MAX),
              "The frame that is taken as FILE's rest pose, counted from 0. Without it the file's own, or the most "
              "upright frame where that cannot stand");
    takes(command.add_option_function<std::string>(
              "--up", [&motion](const std::string& axis) { motion.rest.up_w = *axis_of(axis); },
              "The axis that is up in FILE. Its rest pose is then a frame that stands along it"),
          one_of({"x", "y", "z", "-x", "-y", "-z"}));
}

void add_root_motion(CLI::App& command, bool& root_motion)
{
    command.add_flag("--root-motion", root_motion,
                     "Put the way over the ground and the heading on a joint called root above the hips. No joint "
                     "moves in the world");
}

void add_named_limbs(CLI::App& command, std::vector<std::string>& arms, std::vector<std::string>& legs,
                     const std::string& other_side)
{
    add_of_body(command, "--arm", "JOINTS", arms,
                "Joints of an arm, SHOULDER,ELBOW,WRIST, where their names do not tell. Each is a name, a path or a "
                "number (#12). left: or right: in front sets the side. May be given twice. " +
                    other_side);
    add_of_body(command, "--leg", "JOINTS", legs, "Joints of a leg, HIP,KNEE,ANKLE, in the same way");
}

void add_view(CLI::App& command, std::string& view)
{
    add_file_option(command, "--view", view,
                    "Also write a page that shows the crowd in a browser and solves it live: swivel help "
                    "view. - is standard output");
}

void add_frames(CLI::App& command, std::uint32_t& frames)
{
    add_value(command, "--frames", frames, whole_number(1, 1'000'000),
              "Frames of the clip at most, from the first, 1 to 1 million. Without it all. With crowd.loop the crowd "
              "goes on for so many");
}

CLI::Option* add_crowd_of_clip(CLI::App& command, SolveOptions& options)
{
    CLI::Option* const file = add_file(command, options.file, "Motion file");
    add_motion(command, options.motion, "A file without animations is solved in its rest pose");
    add_file_option(command, "--targets", options.targets,
                    "Where wrists, elbows and hands (ankles, knees and feet) must be. 'clip' is the clip's own "
                    "motion. A CSV file has the columns\nframe,character,limb,x,y,z[,pole_x,pole_y,pole_z]"
                    "[,qx,qy,qz,qw], in the world. limb is left_arm, right_arm, left_leg or right_leg. - is "
                    "standard input. docs/motion_files.md says more")
        ->default_str("clip");
    add_value(command, "--between", options.between, one_of({"hold", "linear"}),
              "In frames between a limb's rows, hold the last row, or go on to the next in a linear way. Without it "
              "the limb follows the clip there");
    add_file_option(command, "--crowd", options.crowd,
                    "TOML file that says what the crowd is and what is asked of its limbs: goals, weights, "
                    "reach, limits, budget. docs/crowd_file.md has every key. Options given here override "
                    "it. - is standard input");
    add_kinds(command, options.kinds,
              "Which limbs to solve: arms, legs or all. Each is named by --arm or --leg, or found by the names in use. "
              "Without it those named alone, or else the arms");
    add_named_limbs(command, options.arms, options.legs, "With --limbs the side that is not named is looked for");
    add_characters(command, options.characters,
                   ", differing in arm lengths, place and start; the first is the clip's own")
        ->default_str("1");
    add_seed(command, options.seed, "the characters' differences");
    add_threads(command, options.threads);
    return file;
}

}  // namespace swivel::tools
