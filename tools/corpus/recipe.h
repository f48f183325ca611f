// SPDX-License-Identifier: MIT
//
// Describes the crowds of the corpus: their features, the form of their poses, and the things that limbs hold.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "swivel/swivel_bodies.h"

namespace swivel::corpus {

enum class Part : std::uint8_t {
    ordinary,  // plain arms that the plain formula holds for
    hard,      // plain arms of bad numbers, degenerate poles, straight, folded, of every size
    limbs,     // whole limbs: each feature alone, and many together
    bodies,    // poses of bodies go in and out
    standing,  // bodies over many frames: plants, caps, shifts, ground and looks, which start from what the last frame
               // left, and what hands hold
};
inline constexpr Part kParts[] = {Part::ordinary, Part::hard, Part::limbs, Part::bodies, Part::standing};
constexpr bool is_of_bodies(Part part) { return part == Part::bodies || part == Part::standing; }

// Further parts of the poses, and where results go.
enum PoseFeature : std::uint32_t {
    kTranslations = 1u << 0,  // joints have places of their own; always with matrices
    kScales = 1u << 1,        // and scales of their own; the same
    kRoots = 1u << 2,         // bodies stand somewhere, turned and scaled
    kFar = 1u << 3,           // with kRoots: far away, so that places and goals are doubles
    kBetween = 1u << 4,       // joints in between
    kLengths = 1u << 5,       // bones have the lengths that are written
    kOffsets = 1u << 6,       // joints lie in another order than in the skeleton
    kApart = 1u << 7,         // solved joints go elsewhere
    kRests = 1u << 8,         // limbs with bad input get the rest pose
    kInBody = 1u << 9,        // joints are relative to the root, and all below a limb's move with it
    kAllJoints = 1u << 10,    // where all needed joints are comes out, too
    kSupports = 1u << 11,     // what they stand on moves and turns, and is changed now and then
    kLooks = 1u << 12,        // the trunk looks, and an eye on it
};

// The things that limbs hold.
enum class Holds : std::uint8_t {
    nothing,
    hand,           // the last group's holds the first one's hand
    prop,           // the last two hold a prop, which is a group more
    prop_at_joint,  // the same, and it hangs on the trunk
};

inline constexpr std::uint32_t kGroupCount = 3;  // of limbs
inline constexpr std::uint32_t kLookCount = 2;   // groups more: the trunk's look, and the eye's

struct Recipe {
    Part part;
    std::string name;
    swivel_features features = 0;
    bool is_packed = false;  // results are digested as swivel_pack() gives them
    std::uint32_t twist_bones = 0;
    swivel_euler_order shoulder_order = SWIVEL_XYZ, wrist_order = SWIVEL_XYZ;
    swivel_pose_form form = SWIVEL_ROTATIONS;
    std::uint32_t pose = 0;  // of enum PoseFeature
    Holds holds = Holds::nothing;
    swivel_features holding = 0;  // the features of limbs that hold something, in place of the others'
    std::uint64_t seed = 0;       // a hash of the full name, so that a further recipe moves no other's numbers
};

inline bool has_shift(const Recipe& recipe) { return recipe.features & SWIVEL_WITH_PELVIS_FIT; }
inline bool has_prop(const Recipe& recipe) { return recipe.holds >= Holds::prop; }
// The groups after the limbs': the shift, the prop, and the looks.
inline std::uint32_t prop_group(const Recipe& recipe) { return kGroupCount + (has_shift(recipe) ? 1 : 0); }
inline std::uint32_t look_group(const Recipe& recipe) { return prop_group(recipe) + (has_prop(recipe) ? 1 : 0); }
// Whether a group's limb holds something.
inline bool is_holding(const Recipe& recipe, std::uint32_t group)
{
    return group == 2 ? recipe.holds != Holds::nothing : group == 1 && has_prop(recipe);
}
inline swivel_features features_of(const Recipe& recipe, std::uint32_t group)
{
    return is_holding(recipe, group) ? recipe.holding : recipe.features;
}

const char* name_of(Part part);
// "hard world-joints", for messages.
std::string full_name(const Recipe& recipe);

// The crowds of a part:
// - ordinary, hard: every set of plain arms' features.
// - limbs: each feature that free limbs may have, alone with what it needs, in the order of
//   swivel_describe_feature(); and sets of several.
// - bodies: each form of poses, each thing that they may have, and features of limbs, many together.
// - standing: features that carry something from frame to frame, on bodies of a few joints' movements.
std::span<const Recipe> recipes_of(Part part);
// Throws std::out_of_range where there is none.
const Recipe& recipe_of(Part part, std::string_view name);

}  // namespace swivel::corpus
