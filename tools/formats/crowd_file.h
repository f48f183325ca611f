#pragma once
// SPDX-License-Identifier: MIT
// The crowd file: a crowd and the goals of its limbs, in TOML. docs/crowd_file.md explains every key;
// examples/crowd.toml shows them all. Angles are degrees. Knows no solver and no skeleton: the caller checks whether a
// joint or a limb exists, and every value has its line and key for the message.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tools/formats/limb_name.h"
#include "tools/formats/toml_table.h"

namespace swivel::formats {

enum class PoleKind : std::uint8_t { point, direction, normal, incoming, hand, half_line };
enum class EulerOrder : std::uint8_t { xyz, xzy, yzx, yxz, zxy, zyx };

struct ConeLimit {
    Eigen::Vector3d axis{0, 0, 1};  // unit
    double opening_deg = 0;         // the largest angle to it, 0 to 180
};
struct TwistLimit {
    Eigen::Vector3d axis{0, 0, 1};  // unit
    NumberRange range_deg;
};
struct BoxLimit {
    EulerOrder order = EulerOrder::xyz;
    std::array<NumberRange, 3> about_deg;  // x, y, z, whatever the order
};
using Limit = std::variant<NumberRange, ConeLimit, TwistLimit, BoxLimit>;
// The keys of limits, which are the solver's names for them. Ranges are in degrees and end in _deg.
constexpr std::array<std::string_view, 8> kLimitKeys = {"flexion_deg",  "shoulder_cone", "humeral_twist_deg",
                                                        "shoulder_box", "hand_cone",     "forearm_twist_deg",
                                                        "hand_twist",   "wrist_box"};
constexpr std::array<std::string_view, 4> kReachKeys = {"soft_far", "soft_near", "max_stretch", "min_distance"};

// Where an upper bone may point, in the frame of the resting limb.
struct RegionLimit {
    std::vector<ConeLimit> cones;  // in order, with bridges between neighbours
    bool closed = false;           // a bridge from the last cone to the first, too
    std::vector<std::vector<Eigen::Vector3d>> polygons;
    std::vector<ConeLimit> forbidden;
    double clip_margin_deg = 0;  // around the directions of the clip's own bone; 0: these are ignored
    int clip_cones = 4;          // the max count of cones made from the clip
};

struct AimGoal {
    Eigen::Vector3d axis{0, 0, 1};  // in the hand joint's frame, unit
    double flexion_deg = 0;         // 0 to 180
};

// The settings of a limb. Missing ones are as without a file.
struct LimbSettings {
    Maybe<std::vector<std::string>> joints;  // three
    Maybe<Eigen::Vector3d> bend;             // in the upper joint's frame, unit

    Maybe<LimbName> hold;                                // whose hand this one holds, as the clip has them
    Maybe<Eigen::Vector3d> target_point, target_offset;  // world axes
    Maybe<bool> hand;
    Maybe<Eigen::Vector3d> effector;  // in the hand joint's frame

    Maybe<AimGoal> aim;
    Maybe<double> clavicle_share;  // 0 to 1

    Maybe<PoleKind> pole_kind;
    Maybe<Eigen::Vector3d> pole_fixed;
    Maybe<double> pole_angle_deg;

    std::array<Maybe<double>, 3> weights;  // of position, hand and pole, 0 to 1
    // As kReachKeys has them: shares of the limb's length, 0 to 1; the stretch is from 1 to 1000.
    std::array<Maybe<double>, 4> reach;
    Maybe<double> step_deg_per_frame, step_deg_per_second;  // of the swivel; at most one of them
    Maybe<bool> step_wins;
    std::array<Maybe<Limit>, kLimitKeys.size()> limits;
    Maybe<RegionLimit> region;
    Maybe<std::int64_t> twist_bones;  // 0 to 7
};

// One table [limb.SELECTOR].
struct LimbSection {
    std::string selector;  // all, arms, legs, left, right, left_arm, ...
    std::size_t line = 0;
    LimbSettings settings;
};

// A loop's first frame, and the frame in which it has come back to it. Nothing: the loop is found.
using LoopFrames = std::optional<std::array<std::size_t, 2>>;

// The table [ground].
struct GroundSettings {
    std::size_t line = 0;
    Maybe<std::string> heights;     // a picture; a relative path starts at the file's folder
    Maybe<Eigen::Vector3d> size;    // of the picture: along x, of white, along z; above 0
    Maybe<Eigen::Vector3d> middle;  // where the picture's middle lies, at black
    Maybe<std::string> contacts;    // a table of when feet are down; its path as that of heights
};

// The table [look].
struct LookSettings {
    std::size_t line = 0;
    Eigen::Vector3d target;   // world axes
    double max_deg = 45;      // the max turn of each joint, 0 to 180
    Maybe<std::string> head;  // a joint by name, path or number
};

// The table [carry]: a box in both hands.
struct CarrySettings {
    std::size_t line = 0;
    double share = 0.1;                  // of the characters, 0 to 1
    Maybe<Eigen::Vector3d> size, place;  // of the box, above 0; of its middle, as CarryPlan has them
};

// One of the list crowd.clips; at least one of them is there.
struct FurtherClip {
    std::size_t line = 0;
    std::string key;        // of the list
    std::string file;       // a relative path starts at the file's folder; empty: the motion's own file
    std::string animation;  // of a glTF file; empty: its first
};

struct CrowdFile {
    std::filesystem::path path;
    Maybe<std::int64_t> characters, seed;
    Maybe<double> spacing;
    Maybe<NumberRange> size, legs, arms, spine, speed;  // factors
    Maybe<NumberRange> heading_deg;                     // about y
    Maybe<bool> stagger;
    Maybe<std::string> agents;  // a table of the characters, in place of the grid; its path as that of targets
    Maybe<LoopFrames> loop;
    std::vector<FurtherClip> clips;
    Maybe<std::string> limbs, targets;  // targets as written; a relative path starts at the file's folder
    Maybe<std::int64_t> budget_blocks;
    std::optional<GroundSettings> ground;
    std::optional<LookSettings> look;
    std::optional<CarrySettings> carry;
    std::vector<LimbSection> sections;  // those in the file, the general before the special
};

// Throws InputError that names line and key, for
// - a file that is no TOML;
// - an unknown key, with the known one that looks like it;
// - a wrong type, a value out of its range, and an axis of no length;
// - two keys that exclude each other.
CrowdFile read_crowd_file(const std::filesystem::path& path);

// One limb's settings: each key's value comes from the most special table. Tables for both sides are written for the
// left limb; a right limb's values from them are marked mirrored.
LimbSettings settings_of(const CrowdFile& file, LimbName limb);

// A file that the crowd file names: a relative path starts at its folder.
inline std::filesystem::path beside(const CrowdFile& file, const Given<std::string>& name)
{
    return file.path.parent_path() / name.value;
}

// Whether [limb.SELECTOR] selects this limb.
bool selects(std::string_view selector, LimbName limb);

}  // namespace swivel::formats
