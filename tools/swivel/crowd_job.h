// SPDX-License-Identifier: MIT
//
// A clip, its limbs and what they are asked for, from the command line and the crowd file: what solve, view and store
// begin with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/crowd/clip_loop.h"
#include "tools/crowd/crowd_plan.h"
#include "tools/crowd/given_targets.h"
#include "tools/crowd/proportions.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

// A motion beside the clip.
struct FurtherMotion {
    std::filesystem::path file;
    std::string words;  // for people
};

// The job that the options and the crowd file describe.
struct CrowdJob {
    std::optional<formats::CrowdFile> crowd;
    std::vector<Limb> limbs;
    std::vector<LimbFinding> missing;
    std::vector<BodyPart> body;
    Eigen::Vector3d faces_w;  // where the figure looks at rest: forwards, and level, though its back may lean
    CrowdPlan plan;
    std::vector<FoundLoop> loops;  // of each clip, where they go on and on
    std::vector<FurtherMotion> further;
    // Figures that perform the clips: all clips by the first one, then by the next one.
    std::vector<Proportions> builds = std::vector<Proportions>(1);
    std::size_t frame_count = 0;  // to solve: those of the first clip, fewer, or of loops any number
    std::size_t clip_frames = 0;  // that the file has
    std::string targets;          // "clip" or a file
    std::optional<GivenTargets> given;
    std::string heights, contacts;  // the picture of the ground, the table of contacts; empty: none
};

// A motion's file as pages and caches call it, and what is performed of it and of further clips.
std::string title_of(const std::string& file);
std::string motion_of(const MotionFile& file, const CrowdJob& job);

// The limbs that the options name. Throws CommandError where they contradict each other.
LimbChoice choice_of(const SolveOptions& options);

// The command line before the crowd file before what is so without both. Samples file. Throws InputError and
// CommandError as what it reads does.
CrowdJob make_job(const SolveOptions& options, LimbChoice choice, MotionFile& file);

}  // namespace swivel::tools
