// SPDX-License-Identifier: MIT
//
// The job of solve, view and store: a clip, its limbs and their goals, from the command line and the crowd file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/crowd/clip_loop.h"
#include "tools/crowd/crowd_plan.h"
#include "tools/crowd/given_targets.h"
#include "tools/crowd/proportions.h"
#include "tools/swivel/commands.h"
#include "tools/swivel/motion_file.h"

namespace swivel::tools {

// Another motion besides the clip.
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
    Eigen::Vector3d faces_w;  // the figure's forwards at rest, level even if its back leans
    CrowdPlan plan;
    std::vector<FoundLoop> loops;  // one for each clip, if they loop
    std::vector<FurtherMotion> further;
    // The figures that perform the clips: the first one performs all, then the next one.
    std::vector<Proportions> builds = std::vector<Proportions>(1);
    std::size_t frame_count = 0;  // to solve: the first clip's or fewer; with loops any number
    std::size_t clip_frames = 0;  // in the file
    std::string targets;          // "clip" or a file
    std::optional<GivenTargets> given;
    // The picture of the ground, and the tables of contacts and agents; empty: none.
    std::string heights, contacts, agents;
};

// The joint that all limbs hang on, or the first one. limbs: one or more.
int common_joint(const formats::Clip& clip, std::span<const Limb> limbs);

// The title of a motion's file on pages and in caches, and the names of the performed clips.
std::string title_of(const std::string& file);
std::string motion_of(const MotionFile& file, const CrowdJob& job);

// The limbs that the options name. Throws CommandError where they contradict each other.
LimbChoice choice_of(const SolveOptions& options);

// Options override the crowd file, which overrides defaults. Samples `file`. Throws InputError and CommandError as the
// readers do.
CrowdJob make_job(const SolveOptions& options, LimbChoice choice, MotionFile& file);

}  // namespace swivel::tools
