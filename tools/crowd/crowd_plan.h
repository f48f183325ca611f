// SPDX-License-Identifier: MIT
//
// Plans a crowd and its limbs' goals in the solver's terms: turns the command line and the crowd file into features and
// values of fields. Knows limbs and the public interface; reads no file.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "tools/crowd/carry_plan.h"
#include "tools/crowd/clip_parts.h"
#include "tools/crowd/ground.h"
#include "tools/crowd/limb_setup.h"
#include "tools/crowd/look_plan.h"
#include "tools/formats/crowd_file.h"
#include "tools/rig/limbs.h"

namespace swivel::tools {

// A character of a table of agents.
struct PlannedAgent {
    std::string name;
    goal_character who;  // its size, place, start and heading; the rest is the plan's
    std::size_t clip;    // one of the plan's clips
};

struct CrowdPlan {
    std::uint32_t characters = 1;
    std::uint64_t seed = 1;
    double spacing = 3;                              // between neighbours, in spans of two limbs
    formats::NumberRange size{0.85, 1.15};           // factors of all lengths; the first character's is 1
    Eigen::Vector3d foot = Eigen::Vector3d::Zero();  // in the clip: where characters of all sizes stand alike
    formats::NumberRange heading_deg;                // about y; the first character's is 0
    bool stagger = true;                             // characters start anywhere in their clip
    std::vector<ClipPart> clips;                     // each character performs one of them: a clip by a figure of one
                                                     // build; none: all frames are one
    std::vector<PlannedAgent> agents;                // one for each character; none: they stand in a grid
    std::uint32_t budget_blocks = 0;                 // of 16 characters, solved in a frame; 0: all
    std::optional<Ground> ground;                    // that legs stand on: see tools/feet/standing.h
    double shift_wish = 0;                           // then: of a body of size 1
    std::vector<LimbSetup> limbs;                    // one for each limb solved
    std::vector<std::vector<bool>> contacts;         // [limb][frame] of legs that stand: the foot is on the ground
    std::optional<LookPlan> look;                    // heads look at a point
    std::optional<CarryPlan> carry;                  // a box in both hands

    // Whether characters may be turned.
    bool has_headings() const { return !agents.empty() || heading_deg.min != 0 || heading_deg.max != 0; }
};

// Adds the crowd file's limbs to the choice. Its joints count for sides that no option names.
// The file's bends always count, its limbs unless the choice has kinds already. Throws InputError naming line and key
// for joints of a kind that is left out.
void add_choice(const formats::CrowdFile& file, LimbChoice& choice);

// The point below the first joint's first place, at the height of the lowest joint of the first frames.
Eigen::Vector3d foot_of(const formats::Clip& clip, std::size_t frame_count);

// Moves limbs that hold another hand behind all others, which are then solved first. Throws InputError naming line and
// key for a limb that cannot hold the one it names.
void put_holding_last(const formats::CrowdFile& file, std::vector<Limb>& limbs);

// The plan for limbs of a clip, holding ones last. file: null without a crowd file; then all is as the clip has it.
// Throws InputError naming line and key for tables of limbs that are not solved, for keys that mean nothing beside
// others, and for a clavicle that is not the limb's own.
CrowdPlan plan_crowd(const formats::CrowdFile* file, const formats::Clip& clip, std::span<const Limb> limbs);

// A limb that does all as the clip has it.
LimbSetup following_setup(const Limb& limb);

// The plan for the solver alone, limb by limb, and then the look.
std::vector<LimbSetup> limb_setups(const CrowdPlan& plan);

}  // namespace swivel::tools
