// SPDX-License-Identifier: MIT
//
// Describes a crowd of the corpus. Its names stand for the library's here and in interface.cpp alone.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "swivel/swivel.hpp"

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

// ---- the library's names, by names of the corpus; none of their numbers is in a digest
// clang-format off
inline constexpr std::uint64_t
    kWorld = SWIVEL_WORLD, kJoints = SWIVEL_JOINTS, kHand = SWIVEL_WITH_HAND, kPoleDirection = SWIVEL_POLE_DIRECTION,
    kEffector = SWIVEL_WITH_EFFECTOR, kAngle = SWIVEL_WITH_ANGLE, kPoleNormal = SWIVEL_POLE_NORMAL,
    kIncoming = SWIVEL_WITH_INCOMING, kPoleIncoming = SWIVEL_POLE_INCOMING, kWeights = SWIVEL_WITH_WEIGHTS,
    kReach = SWIVEL_WITH_REACH, kStep = SWIVEL_WITH_MAX_SWIVEL, kFlexion = SWIVEL_WITH_FLEXION_LIMIT,
    kShoulderCone = SWIVEL_WITH_SHOULDER_CONE, kHumeralTwist = SWIVEL_WITH_HUMERAL_TWIST,
    kShoulderBox = SWIVEL_WITH_SHOULDER_BOX, kHandCone = SWIVEL_WITH_HAND_CONE,
    kForearmTwist = SWIVEL_WITH_FOREARM_TWIST, kHandTwist = SWIVEL_WITH_HAND_TWIST,
    kWristBox = SWIVEL_WITH_WRIST_BOX, kAim = SWIVEL_WITH_AIM, kClavicle = SWIVEL_WITH_CLAVICLE,
    kRecord = SWIVEL_WITH_RECORD, kPlant = SWIVEL_WITH_PLANT, kPlantRotation = SWIVEL_WITH_PLANT_ROTATION,
    kByMotion = SWIVEL_PLANT_BY_MOTION, kCap = SWIVEL_WITH_CAP, kFit = SWIVEL_WITH_PELVIS_FIT, kNextTarget = SWIVEL_WITH_NEXT_TARGET,
    kYields = SWIVEL_HAND_YIELDS, kGround = SWIVEL_WITH_GROUND, kLink = SWIVEL_WITH_LINK,
    kHandTransform = SWIVEL_WITH_HAND_TRANSFORM, kRegion = SWIVEL_WITH_REGION, kStepWins = SWIVEL_STEP_WINS,
    kPoleHand = SWIVEL_POLE_HAND,
    kCompact = 1ull << 63;  // the corpus's own: results are digested as they are packed
enum class Field : std::uint16_t {
    target = SWIVEL_TARGET, pole = SWIVEL_POLE, lengths = SWIVEL_LENGTHS, parent_position = SWIVEL_SHOULDER_POSITION,
    parent_rotation = SWIVEL_PARENT_ROTATION, parent_scale = SWIVEL_PARENT_SCALE, hand = SWIVEL_HAND,
    effector = SWIVEL_EFFECTOR, angle = SWIVEL_ANGLE, incoming_shoulder = SWIVEL_INCOMING_SHOULDER,
    incoming_elbow = SWIVEL_INCOMING_ELBOW, incoming_wrist = SWIVEL_INCOMING_WRIST, weights = SWIVEL_WEIGHTS,
    reach = SWIVEL_REACH, max_swivel = SWIVEL_MAX_SWIVEL, flexion_limit = SWIVEL_FLEXION_LIMIT,
    shoulder_cone = SWIVEL_SHOULDER_CONE, humeral_twist = SWIVEL_HUMERAL_TWIST, shoulder_box = SWIVEL_SHOULDER_BOX,
    hand_cone = SWIVEL_HAND_CONE, forearm_twist = SWIVEL_FOREARM_TWIST, hand_twist = SWIVEL_HAND_TWIST,
    wrist_box = SWIVEL_WRIST_BOX, aim = SWIVEL_AIM, clavicle = SWIVEL_CLAVICLE, contact = SWIVEL_CONTACT,
    cap = SWIVEL_CAP, pelvis_fit_weight = SWIVEL_PELVIS_FIT_WEIGHT, next_target = SWIVEL_NEXT_TARGET, next_time = SWIVEL_NEXT_TIME,
    ground = SWIVEL_GROUND, ground_normal = SWIVEL_GROUND_NORMAL, ground_weight = SWIVEL_GROUND_WEIGHT,
    grip = SWIVEL_GRIP, shoulder = SWIVEL_SHOULDER, elbow = SWIVEL_ELBOW, wrist = SWIVEL_WRIST, flags = SWIVEL_FLAGS,
    stretch = SWIVEL_STRETCH, normal = SWIVEL_NORMAL, twist = SWIVEL_TWIST_BONES,
    clavicle_rotation = SWIVEL_CLAVICLE_ROTATION, record = SWIVEL_RECORD, plant = SWIVEL_PLANT,
    plant_rotation = SWIVEL_PLANT_ROTATION, plant_motion = SWIVEL_CONTACT_STATE, goal = SWIVEL_SOLVED_GOAL, probe = SWIVEL_PROBE,
    lift = SWIVEL_LIFT, hand_transform = SWIVEL_HAND_TRANSFORM,
    // of bodies, which have no rows of them; motion: all that changes from frame to frame
    skeleton = 0x8000, joint_rotation, joint_translation, joint_scale, bend, root_position, root_rotation, root_scale,
    motion
};
// The inputs of limbs and bodies. Random numbers of a field depend on its place here: further ones come last.
inline constexpr auto kDrawn = [] {
    using enum Field;
    return std::to_array({
        target, pole, lengths, parent_position, parent_rotation, parent_scale, hand, effector, angle,
        incoming_shoulder, incoming_elbow, incoming_wrist, weights, reach, max_swivel, flexion_limit, shoulder_cone,
        humeral_twist, shoulder_box, hand_cone, forearm_twist, hand_twist, wrist_box, aim, clavicle, contact, cap,
        pelvis_fit_weight, next_target, next_time, ground, skeleton, joint_rotation, joint_translation, joint_scale, bend,
        root_position, root_rotation, root_scale, motion, ground_normal, ground_weight, grip});
}();
// Results, in the order in which they are digested.
inline constexpr auto kResults = [] {
    using enum Field;
    return std::to_array({
        shoulder, elbow, wrist, flags, stretch, normal, twist, clavicle_rotation, record, plant, plant_rotation, plant_motion,
        goal, probe, lift, hand_transform});
}();
// Flags, in the order of the bits that are digested for them.
inline constexpr std::uint32_t kFlags[] = {
    SWIVEL_REACHED, SWIVEL_SOFTENED, SWIVEL_STRETCHED, SWIVEL_CLAMPED_FAR, SWIVEL_CLAMPED_NEAR,
    SWIVEL_SWIVEL_UNDEFINED, SWIVEL_LIMITED_FLEXION, SWIVEL_LIMITED_SHOULDER_CONE, SWIVEL_LIMITED_HUMERAL_TWIST,
    SWIVEL_LIMITED_SHOULDER_BOX, SWIVEL_LIMITED_HAND_CONE, SWIVEL_LIMITED_FOREARM_TWIST, SWIVEL_LIMITED_HAND_TWIST,
    SWIVEL_LIMITED_WRIST_BOX, SWIVEL_LIMITED_STEP, SWIVEL_INFEASIBLE, SWIVEL_JUMPED, SWIVEL_BAD_INPUT, SWIVEL_PLANTED,
    SWIVEL_RELEASED, SWIVEL_BROKE_AWAY, SWIVEL_CUT, SWIVEL_LIMITED_LOOK, SWIVEL_FADED, SWIVEL_LIMITED_REGION};
enum class Order : std::uint8_t {
    xyz = SWIVEL_XYZ, xzy = SWIVEL_XZY, yzx = SWIVEL_YZX, yxz = SWIVEL_YXZ, zxy = SWIVEL_ZXY, zyx = SWIVEL_ZYX
};
// The form in which bodies' poses hold a joint: a rotation, or all of it in a matrix.
enum class Form : std::uint8_t {
    rotations = SWIVEL_ROTATIONS, rows = SWIVEL_MATRIX_ROWS, columns = SWIVEL_MATRIX_COLUMNS, columns3 = SWIVEL_MATRIX_COLUMNS3
};
// clang-format on

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
    kRests = 1u << 8,         // limbs with bad input get the rest pose, and looks begin anew
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
    const char* name;
    std::uint64_t seed;
    std::uint64_t features;  // and kCompact
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

// The tables of the corpus's crowds, part by part. Rows may be added at a table's end.
//
// Both have the same sets of features: all of plain arms.
std::span<const Recipe> ordinary_recipes();
std::span<const Recipe> hard_recipes();
// Each feature alone, with what it needs, and sets of many.
std::span<const Recipe> limb_recipes();
// Each form of poses, and each thing that they may have; the features of limbs, many together.
std::span<const Recipe> body_recipes();
// Bodies of a few joints' movements, for the features that carry something from frame to frame.
std::span<const Recipe> standing_recipes();

}  // namespace swivel::corpus
