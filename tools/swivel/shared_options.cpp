// SPDX-License-Identifier: MIT
#include "tools/swivel/shared_options.h"

#include "tools/rig/vectors.h"

namespace swivel::tools {

CLI::Option* add_threads(CLI::App& command, unsigned& threads, const char* meaning)
{
    return takes(command.add_option("--threads", threads, meaning)->capture_default_str(), whole_number(0, 1024));
}

CLI::Option* add_json(CLI::App& command, bool& json) { return command.add_flag("--json", json, "Print JSON"); }

CLI::Option* add_quiet(CLI::App& command, bool& quiet, const std::string& meaning)
{
    return command.add_flag("--quiet", quiet, meaning);
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

CLI::Option* add_kinds(CLI::App& command, std::string& kinds, const std::string& meaning)
{
    return takes(command.add_option("--limbs", kinds, meaning), one_of({"arms", "legs", "all"}));
}

void add_animation(CLI::App& command, std::string& clip, double& rate, const std::string& use)
{
    takes(command.add_option("--clip", clip,
                             "Which animation of a glTF FILE, by name or, counted from 0, by index. "
                             "Without it the first. " +
                                 use),
          name("name an animation, or leave the option out for the first"));
    takes(
        command.add_option("--fps", rate,
                           "Sample the motion at about this many even frames a second, 0.001 to 10000. Without it the "
                           "frames of a BVH file, or the limbs' own keys (docs/motion_files.md)"),
        number(0.001, 10'000));
}

void add_motion(CLI::App& command, MotionChoice& motion, const std::string& use)
{
    add_animation(command, motion.clip, motion.rate, use);
    takes(command.add_option("--rest", motion.rest.frame,
                             "The frame that is taken as FILE's rest pose, counted from 0. Without it the file's own, "
                             "or the most upright frame where that cannot stand"),
          whole_number(0, UINT32_MAX));
    const std::vector<std::string> axes{"x", "y", "z", "-x", "-y", "-z"};
    takes(command.add_option_function<std::string>(
              "--up", [&motion](const std::string& axis) { motion.rest.up_w = *axis_of(axis); },
              "The axis that is up in FILE. Its rest pose is then a frame that stands along it"),
          one_of(axes));
}

CLI::Option* add_root_motion(CLI::App& command, bool& root_motion)
{
    return command.add_flag("--root-motion", root_motion,
                            "Put the way over the ground and the heading on a joint called root above the hips. No "
                            "joint moves in the world");
}

CLI::Option* add_named_legs(CLI::App& command, std::vector<std::string>& legs, const std::string& meaning)
{
    return command.add_option("--leg", legs, meaning)->type_name("JOINTS")->allow_extra_args(false);
}

void add_named_limbs(CLI::App& command, std::vector<std::string>& arms, std::vector<std::string>& legs,
                     const std::string& other_side)
{
    command
        .add_option("--arm", arms,
                    "Joints of an arm, SHOULDER,ELBOW,WRIST, where their names do not tell. Each is a name, a path or "
                    "a number (#12). left: or right: in front sets the side. May be given twice. " +
                        other_side)
        ->type_name("JOINTS")
        ->allow_extra_args(false);
    add_named_legs(command, legs, "Joints of a leg, HIP,KNEE,ANKLE, in the same way");
}

void add_view(CLI::App& command, std::string& view)
{
    add_file_option(command, "--view", view,
                    "Also write a page that shows the crowd in a browser and solves it live: swivel help "
                    "view. - is standard output");
}

void add_frames(CLI::App& command, std::uint32_t& frames)
{
    takes(command.add_option("--frames", frames,
                             "Frames of the clip at most, from the first, 1 to 1 million. Without it all. With "
                             "crowd.loop the crowd goes on for so many"),
          whole_number(1, 1'000'000));
}

CLI::Option* add_crowd_of_clip(CLI::App& command, SolveOptions& options)
{
    CLI::Option* const file = add_file(command, options.file, "Motion file");
    add_motion(command, options.motion, "A file without animations is solved in its rest pose");
    takes(command
              .add_option("--targets", options.targets,
                          "Where wrists, elbows and hands (ankles, knees and feet) must be. 'clip' is the clip's own "
                          "motion. A CSV file has the columns\nframe,character,limb,x,y,z[,pole_x,pole_y,pole_z]"
                          "[,qx,qy,qz,qw], in the world. limb is left_arm, right_arm, left_leg or right_leg. - is "
                          "standard input. docs/motion_files.md says more")
              ->default_str("clip"),
          file_name());
    takes(command.add_option("--between", options.between,
                             "In frames between a limb's rows, hold the last row, or go on to the next in a linear "
                             "way. Without it the limb follows the clip there"),
          one_of({"hold", "linear"}));
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
