// SPDX-License-Identifier: MIT
//
// The subcommands: their options and their functions, which throw CommandError, formats::InputError or swivel::Error on
// failure. run_swivel() turns these into one line and an exit code.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/rig/standing_rest.h"

namespace swivel::tools {

// The animation to take from a file, its rate, and the rest pose.
struct MotionChoice {
    std::string clip;  // name or index of an animation; empty: the first
    double rate = 0;   // frames a second; 0: as the file has them
    RestChoice rest{};
};

struct DemoOptions {
    std::uint32_t characters = 10'000, frames = 240;
    std::uint64_t seed = 1;
    std::string view;  // the page to write; empty: none
    unsigned threads = 0;
    bool quiet = false, json = false;
};
void run_demo(const DemoOptions& options);

struct SolveOptions {
    std::string file, crowd, out, export_targets;
    std::string view;          // the page to write; empty: none
    std::uint32_t frames = 0;  // of the clip, from its first; 0: all
    MotionChoice motion;
    std::vector<std::string> arms, legs;
    std::string kinds;
    std::string between;                 // hold, linear, or empty: limbs without a row follow the clip
    std::optional<std::string> targets;  // these three: not given: the crowd file's, else "clip", 1 and 1
    std::optional<std::uint32_t> characters;
    std::optional<std::uint64_t> seed;
    unsigned threads = 0;
    bool quiet = false, json = false;
};
void run_solve(const SolveOptions& options);
// The same for the page alone, whose name comes from the file's unless `view` says it. The file may be a cache;
// without one it is the figure that is installed with the command, on hills.
// about_clip: the first given option that caches do not take; empty: none.
void run_view(SolveOptions options, const std::string& about_clip);

struct RetargetOptions {
    std::vector<std::string> files;  // sources, and the target as the last
    std::string source, target;      // of one run: run_retarget() takes them from `files`
    std::string out;                 // a file, or for several sources a folder; empty: none
    std::string map, export_map;     // tables of pairs
    // "source:left:SHOULDER,ELBOW,WRIST", "target:HEAD", "source:0", "source:z"
    std::vector<std::string> arms, legs, heads, rests, ups;
    std::string clip;    // of source, as MotionChoice has it
    double rate = 0;     // so is this
    bool force = false;  // also writes a motion that is judged as garbage
    bool root_motion = false;
    bool quiet = false, json = false;
};
void run_retarget(const RetargetOptions& options);

struct StoreOptions {
    SolveOptions crowd;  // its outputs are not used
    std::string folder;
    std::string chunk;  // "FRAMES,CHARACTERS"; empty: by the crowd's size
    bool no_poses = false;
};
void run_store(const StoreOptions& options);

struct FillCommand {
    std::string folder, shard;
    bool proves = false;  // check, not fill
    bool quiet = false, json = false;
    unsigned threads = 0;
};
void run_fill(const FillCommand& options);

struct ReplayOptions {
    std::string folder, frames = ":", characters = ":", out;
    bool quiet = false, json = false;
    unsigned threads = 0;
};
void run_replay(const ReplayOptions& options);

struct FeetOptions {
    std::vector<std::string> files;
    std::string out;  // a file, or for several clips a folder; empty: none
    std::string contacts, export_contacts;
    std::string ground, ground_size;  // the picture of hills, "X,Y,Z"; empty: a level floor
    MotionChoice motion;
    std::vector<std::string> legs;
    double speed = 0.8, height = 0.085;  // see ContactBars
    bool travel = false;                 // moves the root of a clip that walks in place
    bool root_motion = false;
    bool force = false;  // also writes clips that are garbage
    bool quiet = false, json = false;
};
void run_feet(const FeetOptions& options);

struct RigOptions {
    SolveOptions clip;  // its file, motion and limbs
    bool joints = false, json = false;
};
void run_rig(const RigOptions& options);

struct InspectOptions {
    std::vector<std::string> files;
    SolveOptions clip;  // its motion and limbs
    bool quiet = false, json = false;
};
void run_inspect(const InspectOptions& options);

struct StepsOptions {
    std::string target = "1.1,1.1,1.1", pole = "1.1,1.1,0", lengths = "1.4,1.3";  // of an arm, in its arm frame
    bool json = false;
};
void run_steps(const StepsOptions& options);

struct VerifyOptions {
    std::uint64_t arms = 1'000'000, seed = 1;
    bool quiet = false, json = false;
};
void run_verify(const VerifyOptions& options);

struct BenchOptions {
    double seconds = 8;
    bool json = false;
};
void run_bench(const BenchOptions& options);

struct InfoOptions {
    bool json = false;
};
void run_info(const InfoOptions& options);

// The whole command as a function.
// Runs the command line, argv[0] being the command's own name. Returns the exit code: 0 done, 1 failed, 2 bad usage,
// 128 plus its number for a signal that ended the run. Prints an error as one line on stderr.
int run_swivel(int argc, const char* const* argv);

}  // namespace swivel::tools
