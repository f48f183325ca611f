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

struct LimbPlan {
    swivel_features features = SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_RECORD;
    swivel_euler_order shoulder_order = SWIVEL_XYZ, wrist_order = SWIVEL_XYZ;
    std::uint32_t twist_bone_count = 0;
    std::vector<FixedField> fields;
    std::optional<swivel_region> region;
    swivel_ground ground = swivel_default_ground();  // with SWIVEL_WITH_GROUND
    std::vector<bool> contact;                       // then: the frames of the clip with the foot on the ground

    std::optional<std::size_t> holds;                         // a limb before this one: with SWIVEL_WITH_LINK
    std::optional<Eigen::Vector3d> target_point;              // in the clip
    Eigen::Vector3d target_offset = Eigen::Vector3d::Zero();  // added to targets; world axes
    Eigen::Vector3d effector = Eigen::Vector3d::Zero();       // in the end joint's frame as solved, of size 1
    std::optional<Eigen::Vector3d> clavicle;                  // with one: the shoulder's place in its frame
    formats::PoleKind pole = formats::PoleKind::point;        // of poles that are given
    std::optional<Eigen::Vector3d> pole_fixed;                // world axes; a point is counted from the upper joint
    std::array<float, 3> pole_behind{};                       // with SWIVEL_POLE_HALF_LINE
    std::array<float, 3> weights{1, 1, 1};                    // of position, hand, and a pole that is given
    bool holds_pole = false;                                  // the pole counts though it is the clip's own
    bool follows_pole = true;                                 // elbows go where the clip's go, unless limits forbid

    // Whether the limb only does what the clip does.
    bool follows_clip() const { return !holds && !target_point && target_offset.isZero(0) && follows_pole; }
    bool has(swivel_features feature) const { return (features & feature) != 0; }
};

// A character of a table of agents.
struct PlannedAgent {
    std::string name;
    Eigen::Vector3d place;  // as a goal_character has it, and so is the heading
    float heading;
    double size;
    std::size_t clip, start;  // one of the plan's clips, and the frame in it
};

struct CrowdPlan {
    std::uint32_t characters = 1;
    std::uint64_t seed = 1;
    double spacing = 3;                               // between neighbours, in spans of two limbs
    double min_size = 0.85, max_size = 1.15;          // factor of all lengths; the first character's is 1
    Eigen::Vector3d foot = Eigen::Vector3d::Zero();   // in the clip: where characters of all sizes stand alike
    double min_heading_deg = 0, max_heading_deg = 0;  // about y; the first character's is 0
    bool stagger = true;                              // characters start anywhere in their clip
    std::vector<ClipPart> clips;                      // each character performs one of them: a clip by a figure of one
                                                      // build; none: all frames are one
    std::vector<PlannedAgent> agents;                 // one for each character; none: they stand in a grid
    std::uint32_t budget_blocks = 0;                  // of 16 characters, solved in a frame; 0: all
    std::optional<Ground> ground;                     // that legs stand on: see tools/feet/standing.h
    double shift_wish = 0;                            // then: of a body of size 1
    std::vector<LimbPlan> limbs;                      // one for each limb solved
    std::optional<LookPlan> look;                     // heads look at a point
    std::optional<CarryPlan> carry;                   // a box in both hands

    // Whether characters may be turned.
    bool has_headings() const { return !agents.empty() || min_heading_deg != 0 || max_heading_deg != 0; }
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

// The plan for the solver alone, limb by limb, and then the look.
std::vector<LimbSetup> limb_setups(std::span<const Limb> limbs, const CrowdPlan& plan);

}  // namespace swivel::tools
