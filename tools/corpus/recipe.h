// SPDX-License-Identifier: MIT
//
// Describes a crowd of the corpus, in words of the corpus alone. Features, fields and flags have numbers of their own
// here. These never change, whatever the library calls them. interface.cpp knows the library's.
#pragma once

#include <cstdint>

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

enum Feature : std::uint64_t {
    kWorld = 1u << 0,
    kJoints = 1u << 1,
    kHand = 1u << 2,
    kPoleDirection = 1u << 3,
    kCompact = 1u << 4,  // results are digested as they are packed
    kEffector = 1u << 5,
    kAngle = 1u << 6,
    kPoleNormal = 1u << 7,
    kIncoming = 1u << 8,
    kPoleIncoming = 1u << 9,
    kWeights = 1u << 10,
    kReach = 1u << 11,
    kStep = 1u << 12,
    kFlexion = 1u << 13,
    kShoulderCone = 1u << 14,
    kHumeralTwist = 1u << 15,
    kShoulderBox = 1u << 16,
    kHandCone = 1u << 17,
    kForearmTwist = 1u << 18,
    kHandTwist = 1u << 19,
    kWristBox = 1u << 20,
    kAim = 1u << 21,
    kClavicle = 1u << 22,
    kRecord = 1u << 23,
    kPlant = 1u << 24,
    kPlantTurn = 1u << 25,
    kByMotion = 1u << 26,
    kCap = 1u << 27,
    kFit = 1u << 28,  // and a group more, which is the shift
    kComing = 1u << 29,
    kYields = 1u << 30,
    kGround = 1ull << 31,
    kLink = 1ull << 32,
    kHandFrame = 1ull << 33,
    kRegion = 1ull << 34,
    kStepWins = 1ull << 35,
    kPoleHand = 1ull << 36,
};

// Random numbers of a field depend on its number here.
enum class Field : std::uint8_t {
    none = 0,
    target = 1,
    pole = 2,
    lengths = 3,
    parent_position = 4,
    parent_rotation = 5,
    parent_scale = 6,
    hand = 7,
    effector = 8,
    angle = 9,
    incoming_shoulder = 10,
    incoming_elbow = 11,
    incoming_wrist = 12,
    weights = 13,
    reach = 14,
    most_swivel = 15,
    flexion_limit = 16,
    shoulder_cone = 17,
    humeral_twist = 18,
    shoulder_box = 19,
    hand_cone = 20,
    forearm_twist = 21,
    hand_twist = 22,
    wrist_box = 23,
    aim = 24,
    clavicle = 25,
    contact = 26,
    cap = 27,
    fit_weight = 28,
    coming = 29,
    coming_time = 30,
    ground = 31,
    // of bodies, which have no rows of them
    skeleton = 32,
    joint_rotation = 33,
    joint_translation = 34,
    joint_scale = 35,
    bend = 36,
    root_position = 37,
    root_rotation = 38,
    root_scale = 39,
    motion = 40,  // all that changes from frame to frame
    // inputs again
    ground_normal = 41,
    ground_weight = 42,
    grip = 43,
    // results
    shoulder = 64,
    elbow = 65,
    wrist = 66,
    flags = 67,
    stretch = 68,
    normal = 69,
    twist = 70,
    clavicle_turn = 71,
    record = 72,
    plant = 73,
    plant_turn = 74,
    plant_motion = 75,
    goal = 76,
    probe = 77,
    lift = 78,
    hand_frame = 79,
};

// Bits of the flag words that are digested.
enum Flag : std::uint32_t {
    kReached = 1u << 0,
    kSoftened = 1u << 1,
    kStretched = 1u << 2,
    kClampedFar = 1u << 3,
    kClampedNear = 1u << 4,
    kSwivelUndefined = 1u << 5,
    kLimitedFlexion = 1u << 6,
    kLimitedShoulderCone = 1u << 7,
    kLimitedHumeralTwist = 1u << 8,
    kLimitedShoulderBox = 1u << 9,
    kLimitedHandCone = 1u << 10,
    kLimitedForearmTwist = 1u << 11,
    kLimitedHandTwist = 1u << 12,
    kLimitedWristBox = 1u << 13,
    kLimitedStep = 1u << 14,
    kInfeasible = 1u << 15,
    kJumped = 1u << 16,
    kBadInput = 1u << 17,
    kPlanted = 1u << 18,
    kReleased = 1u << 19,
    kBrokeAway = 1u << 20,
    kCut = 1u << 21,
    kLimitedLook = 1u << 22,
    kFaded = 1u << 23,
    kLimitedRegion = 1u << 24,
    kUnknownFlag = 1u << 31,  // the library set a bit that the corpus does not know
};
inline constexpr std::uint32_t kPlantFlags = kPlanted | kReleased | kBrokeAway | kCut,
                               kLookFlags = kLimitedLook | kFaded, kEveryFlag = (1u << 25) - 1;

enum class Order : std::uint8_t { xyz, xzy, yzx, yxz, zxy, zyx };

// What bodies' poses hold of a joint: a rotation, or all of it in a matrix.
enum class Form : std::uint8_t { rotations, rows, columns, columns3 };

// What else the poses have, and where results go.
enum PoseFeature : std::uint32_t {
    kTranslations = 1u << 0,  // joints have places of their own; always with matrices
    kScales = 1u << 1,        // and scales of their own; the same
    kRoots = 1u << 2,         // bodies stand somewhere, turned and scaled
    kFar = 1u << 3,           // with kRoots: far away, so that places and goals are doubles
    kBetween = 1u << 4,       // joints in between
    kLengths = 1u << 5,       // bones have the lengths that are written
    kOffsets = 1u << 6,       // joints lie in another order than in the skeleton
    kApart = 1u << 7,         // solved joints go elsewhere
    kRests = 1u << 8,         // bad input gets the rest pose
    kInBody = 1u << 9,        // joints are relative to the root, and all below a limb's move with it
    kAllJoints = 1u << 10,    // where all needed joints are comes out, too
    kSupports = 1u << 11,     // what they stand on moves and turns, and is changed now and then
    kLooks = 1u << 12,        // the trunk looks, and an eye on it
};

// What limbs hold.
enum class Holds : std::uint8_t {
    nothing,
    hand,           // the last group's holds the first one's hand
    prop,           // the last two hold a prop, which is a group more
    prop_at_joint,  // the same, and it hangs on the trunk
};

struct Recipe {
    Part part;
    const char* name;
    std::uint64_t seed;
    std::uint64_t features;  // of enum Feature
    std::uint32_t twist_bones = 0;
    Order shoulder_order = Order::xyz, wrist_order = Order::xyz;
    Form form = Form::rotations;
    std::uint32_t pose = 0;  // of enum PoseFeature
    Holds holds = Holds::nothing;
    std::uint64_t holding = 0;  // the features of limbs that hold something, in place of the others'
};

constexpr bool has_prop(const Recipe& recipe) { return recipe.holds >= Holds::prop; }
// Whether a group's limb holds something.
constexpr bool is_holding(const Recipe& recipe, std::uint32_t group)
{
    return group == 2 ? recipe.holds != Holds::nothing : group == 1 && has_prop(recipe);
}
constexpr std::uint64_t features_of(const Recipe& recipe, std::uint32_t group)
{
    return is_holding(recipe, group) ? recipe.holding : recipe.features;
}

}  // namespace swivel::corpus
