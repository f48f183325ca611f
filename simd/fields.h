// SPDX-License-Identifier: MIT
//
// The table of features and fields. A row is all that the library knows of one, except its meaning (swivel.h) and its
// formula. Layout, checks, messages, frames and swivel_describe_field() read it.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <limits>

#include "include/swivel/swivel_bodies.h"

namespace swivel {

inline constexpr std::uint32_t kLanes = SWIVEL_LANES;  // limbs in a block

// ---- what the library knows of a group besides its features, as further bits: no caller gives or sees them
inline constexpr swivel_features kBody = UINT64_C(1) << 52;         // of bodies: limb i is body i's
inline constexpr swivel_features kLibraryGoal = UINT64_C(1) << 53;  // the library makes the limb's goal: plants, links
inline constexpr swivel_features kShift = UINT64_C(1) << 54;
inline constexpr swivel_features kProp = UINT64_C(1) << 55;
inline constexpr swivel_features kLook = UINT64_C(1) << 56;
inline constexpr swivel_features kOneTwistBone = UINT64_C(1) << 57;  // times their number
inline constexpr swivel_features kTwistBones = SWIVEL_MAX_TWIST_BONES * kOneTwistBone, kPublicFeatures = kBody - 1;
// The bits that every group of bodies has, and those that make one no limb.
inline constexpr swivel_features kOfBodies = kBody | SWIVEL_WORLD | SWIVEL_WITH_INCOMING,
                                 kNoLimb = kShift | kProp | kLook;

// ---- kinds of groups
constexpr swivel_kind kind_of(swivel_features features)
{
    return features & kLook    ? SWIVEL_KIND_LOOK
           : features & kProp  ? SWIVEL_KIND_PROP
           : features & kShift ? SWIVEL_KIND_SHIFT
           : features & kBody  ? SWIVEL_KIND_BODY_LIMB
                               : SWIVEL_KIND_LIMB;
}
// A group of a kind, in messages.
constexpr const char* text_of(swivel_kind kind)
{
    constexpr const char* texts[] = {"a free limb", "a body's limb", "a look", "a prop", "a body's shift"};
    return texts[kind];
}
inline constexpr std::uint32_t kFreeLimbs = 1u << SWIVEL_KIND_LIMB, kBodyLimbs = 1u << SWIVEL_KIND_BODY_LIMB,
                               kLimbs = kFreeLimbs | kBodyLimbs;

// ---- features: which kinds of groups may have each, which others it needs and excludes, and what it does to a limb
inline constexpr swivel_features kHandLimits =
    SWIVEL_WITH_HAND_CONE | SWIVEL_WITH_FOREARM_TWIST | SWIVEL_WITH_HAND_TWIST | SWIVEL_WITH_WRIST_BOX;
// These say where elbows go; a group has one of them, or a pole that is a point.
inline constexpr swivel_features kPoles =
    SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL | SWIVEL_POLE_INCOMING | SWIVEL_POLE_HAND;
enum FeatureTrait : std::uint32_t {
    kIsSpecial = 1,  // limbs with it need the stages `bones` and `wish`, because `place` does not ask for it (stages.h)
    kBounds = 2,     // it may move a limb whose weights ask for nothing
    kTurnsWish = 4   // it may turn an elbow that is wished as in the incoming pose
};
struct FeatureRow {
    swivel_features feature;
    const char* name;
    swivel_features needs = 0, excludes = 0;
    std::uint32_t kinds = kLimbs, traits = 0;
};
// Bodies' limbs have the needs of WORLD and WITH_INCOMING without the features. A new feature comes last, because seeds
// of the fuzzers name features by their place.
constexpr FeatureRow kFeatures[] = {
    {SWIVEL_WORLD, "WORLD", 0, 0, kFreeLimbs},
    {SWIVEL_JOINTS, "JOINTS", 0, 0, kFreeLimbs},
    {SWIVEL_WITH_HAND, "WITH_HAND"},
    {SWIVEL_POLE_DIRECTION, "POLE_DIRECTION", SWIVEL_WORLD, kPoles & ~SWIVEL_POLE_DIRECTION},
    {SWIVEL_WITH_EFFECTOR, "WITH_EFFECTOR", SWIVEL_WITH_HAND},
    {SWIVEL_WITH_ANGLE, "WITH_ANGLE", 0, 0, kLimbs, kTurnsWish},
    {SWIVEL_POLE_NORMAL, "POLE_NORMAL", 0, kPoles & ~SWIVEL_POLE_NORMAL},
    {SWIVEL_WITH_INCOMING, "WITH_INCOMING", 0, 0, kFreeLimbs, kIsSpecial},
    {SWIVEL_POLE_INCOMING, "POLE_INCOMING", SWIVEL_WITH_INCOMING, kPoles & ~SWIVEL_POLE_INCOMING},
    {SWIVEL_WITH_WEIGHTS, "WITH_WEIGHTS", SWIVEL_WITH_INCOMING},
    {SWIVEL_WITH_REACH, "WITH_REACH", 0, 0, kLimbs, kIsSpecial | kBounds},
    {SWIVEL_WITH_MAX_SWIVEL, "WITH_MAX_SWIVEL", 0, 0, kLimbs, kIsSpecial | kBounds},
    {SWIVEL_WITH_FLEXION_LIMIT, "WITH_FLEXION_LIMIT", 0, 0, kLimbs, kIsSpecial | kBounds},
    {SWIVEL_WITH_SHOULDER_CONE, "WITH_SHOULDER_CONE"},
    {SWIVEL_WITH_HUMERAL_TWIST, "WITH_HUMERAL_TWIST"},
    {SWIVEL_WITH_SHOULDER_BOX, "WITH_SHOULDER_BOX"},
    {SWIVEL_WITH_HAND_CONE, "WITH_HAND_CONE", SWIVEL_WITH_HAND},
    {SWIVEL_WITH_FOREARM_TWIST, "WITH_FOREARM_TWIST", SWIVEL_WITH_HAND},
    {SWIVEL_WITH_HAND_TWIST, "WITH_HAND_TWIST", SWIVEL_WITH_HAND},
    {SWIVEL_WITH_WRIST_BOX, "WITH_WRIST_BOX", SWIVEL_WITH_HAND},
    {SWIVEL_WITH_AIM, "WITH_AIM", 0, SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_REACH | SWIVEL_WITH_FLEXION_LIMIT | kHandLimits,
     kLimbs, kIsSpecial},
    {SWIVEL_WITH_CLAVICLE, "WITH_CLAVICLE", SWIVEL_WORLD},
    {SWIVEL_WITH_RECORD, "WITH_RECORD", 0, 0, kBodyLimbs},
    {SWIVEL_WITH_PLANT, "WITH_PLANT", 0, SWIVEL_WITH_AIM, kBodyLimbs},
    {SWIVEL_WITH_PLANT_ROTATION, "WITH_PLANT_ROTATION", SWIVEL_WITH_PLANT | SWIVEL_WITH_HAND, 0, kBodyLimbs},
    {SWIVEL_PLANT_BY_MOTION, "PLANT_BY_MOTION", SWIVEL_WITH_PLANT, 0, kBodyLimbs},
    {SWIVEL_WITH_CAP, "WITH_CAP", SWIVEL_WITH_INCOMING, SWIVEL_WITH_AIM | SWIVEL_WITH_REACH, kLimbs, kBounds},
    {SWIVEL_WITH_PELVIS_FIT, "WITH_PELVIS_FIT", 0, SWIVEL_WITH_AIM, kBodyLimbs},
    {SWIVEL_WITH_NEXT_TARGET, "WITH_NEXT_TARGET", SWIVEL_WITH_PELVIS_FIT, 0, kBodyLimbs},
    {SWIVEL_HAND_YIELDS, "HAND_YIELDS", SWIVEL_WITH_EFFECTOR, SWIVEL_WITH_AIM},
    {SWIVEL_WITH_HAND_TRANSFORM, "WITH_HAND_TRANSFORM", SWIVEL_WITH_HAND, 0, kBodyLimbs},
    {SWIVEL_WITH_LINK, "WITH_LINK", SWIVEL_WITH_HAND, SWIVEL_WITH_AIM | SWIVEL_WITH_PLANT | SWIVEL_WITH_PELVIS_FIT,
     kBodyLimbs},
    {SWIVEL_WITH_GROUND, "WITH_GROUND", SWIVEL_WITH_PLANT | SWIVEL_WITH_EFFECTOR, 0, kBodyLimbs},
    {SWIVEL_WITH_REGION, "WITH_REGION"},
    {SWIVEL_STEP_WINS, "STEP_WINS", SWIVEL_WITH_MAX_SWIVEL},
    {SWIVEL_POLE_HAND, "POLE_HAND", SWIVEL_WITH_HAND, (kPoles & ~SWIVEL_POLE_HAND) | SWIVEL_WITH_AIM, kLimbs,
     kIsSpecial},
};
constexpr swivel_features features_with(FeatureTrait trait)
{
    swivel_features found = 0;
    for (const FeatureRow& row : kFeatures)
        if (row.traits & trait) found |= row.feature;
    return found;
}

inline constexpr swivel_features kKnownFeatures = [] {
    swivel_features known = 0;
    for (const FeatureRow& row : kFeatures) known |= row.feature;
    return known;
}();
static_assert((kKnownFeatures & ~kPublicFeatures) == 0);
// The name of the first feature of a set that has one.
constexpr const char* feature_name(swivel_features features)
{
    const FeatureRow* row = kFeatures;
    while (!(features & row->feature)) ++row;
    return row->name;
}

// ---- fields, in the order of their rows: inputs, then results
// What the numbers of a value are, part after part.
enum class ValuePart : std::uint8_t {
    none,
    position,    // where something is: it may be given in double, from an origin
    point,       // of a joint's own frame
    direction,   // of any length, as are the next two
    quaternion,  // a rotation
    turn,        // cosine and sine of an angle
    axis,        // unit, as are the next three
    half_turn,   // cosine and sine of an angle of at most half a turn: 0 to pi
    right_turn,  // the same of at most a right angle: 0 to pi / 2
    range,       // of angles: cosine and sine of its middle, and of half its width
    cosine,      // of a cone's max angle
    flexion,     // cosines of half the min and half the max flexion
    length,      // of a bone
    scale,
    stretch,
    share,
    time,
    offset,  // along a given line
    count
};
// The kernels check values where they use them. min and max are for explanations of what stages of bodies read.
struct PartRow {
    ValuePart part;
    std::uint32_t count;       // numbers
    std::uint32_t unit_count;  // of these, so many at a time have unit length; 0: none
    float start[4];            // a value that changes nothing
    // Of the number, or of the length of several.
    double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
};
constexpr PartRow kValueParts[] = {
    {ValuePart::none, 0, 0, {}},
    {ValuePart::position, 3, 0, {0, 0, 0}, 0, 1e15},
    {ValuePart::point, 3, 0, {0, 0, 0}, 0, 1e15},
    {ValuePart::direction, 3, 0, {0, 1, 0}, 1e-9, 1e9},
    {ValuePart::quaternion, 4, 0, {0, 0, 0, 1}, 1e-9, 1e9},
    {ValuePart::turn, 2, 0, {1, 0}},
    {ValuePart::axis, 3, 3, {0, 0, 1}},
    {ValuePart::half_turn, 2, 2, {-1, 0}},
    {ValuePart::right_turn, 2, 2, {1, 0}},
    {ValuePart::range, 4, 2, {1, 0, -1, 0}},  // its middle 0, half its width pi
    {ValuePart::cosine, 1, 0, {-1}},
    {ValuePart::flexion, 2, 0, {1, 0}},
    {ValuePart::length, 1, 0, {1}},
    {ValuePart::scale, 1, 0, {1}},
    {ValuePart::stretch, 1, 0, {1}},
    {ValuePart::share, 1, 0, {1}, 0, 1},
    {ValuePart::time, 1, 0, {1e15f}, 0, 1e15},
    {ValuePart::offset, 1, 0, {0}, -1e15, 1e15},
};
static_assert([] {
    std::size_t n = 0;
    for (const PartRow& row : kValueParts)
        if (static_cast<std::size_t>(row.part) != n++) return false;
    return n == static_cast<std::size_t>(ValuePart::count);
}());
constexpr const PartRow& row_of(ValuePart part) { return kValueParts[static_cast<std::size_t>(part)]; }
struct ValueLayout {
    const char* words;  // what its numbers must be
    ValuePart parts[4] = {};
};
inline constexpr std::uint32_t kMaxComponents = 25;  // of an input, and of what is carried
// The numbers of SWIVEL_RECORD, by the first of each value.
enum RecordNumber : int {
    kRecordShoulder,
    kRecordArm = kRecordShoulder + 3,
    kRecordScale = kRecordArm + 4,
    kRecordLengths = kRecordScale + 1,
    kRecordIncoming = kRecordLengths + 2,
    kRecordSize = kRecordIncoming + 12
};
static_assert(std::uint32_t{kRecordSize} <= kMaxComponents);
// Those of SWIVEL_LIFT behind the three of the height: the normal that the foot turns with, and its rate.
enum LiftNumber : int { kSlope = 3, kSlopeRate = kSlope + 3 };
enum class Start : std::uint8_t { neutral, unknown };  // unknown: NaN until it is given
struct FieldRow {
    swivel_field field;
    const char* name;
    std::uint32_t component_count;  // see field_row_count()
    swivel_field_kind kind;
    swivel_features needs = 0, excludes = 0;
    ValueLayout value = {""};
    float start[kMaxComponents] = {};  // what padding starts with, and limbs unless unknown; of results the arm at rest
    Start starts = Start::neutral;
    std::uint32_t start_count = 0;  // of the numbers of a start that is not that of the value's parts

    // Component c of a value of any number of components: values of twist bones are many of the row's.
    constexpr float start_of(std::uint32_t c) const { return start[c % component_count]; }
};
// Calls take(part, number) for each part of a field's value; `number` is the place of the part's first number. A group
// has only the value's last `count` numbers: a body's clavicle is its share alone. If it has more than the row says, as
// of twist bones, all parts are taken once.
template <class Take>
constexpr void for_each_part(const FieldRow& row, std::uint32_t count, const Take& take)
{
    std::uint32_t left_out = count < row.component_count ? row.component_count - count : 0, number = 0;
    for (const ValuePart part : row.value.parts) {
        const std::uint32_t part_count = row_of(part).count;
        if (left_out >= part_count) {  // ValuePart::none is always left out
            left_out -= part_count;
        } else {
            take(part, number);
            number += part_count;
        }
    }
}
constexpr swivel_field_kind kInput = SWIVEL_FIELD_INPUT, kResult = SWIVEL_FIELD_RESULT, kCarried = SWIVEL_FIELD_CARRIED;
constexpr ValueLayout kPosition = {"no further than 1e15", {ValuePart::position}},
                      kPoint = {"no further than 1e15", {ValuePart::point}},
                      kQuaternion = {"a quaternion of length 1e-9 to 1e9", {ValuePart::quaternion}},
                      kShare = {"0 to 1", {ValuePart::share}},
                      kShares = {"0 to 1 each", {ValuePart::share, ValuePart::share, ValuePart::share}},
                      kCone = {"a unit axis and a cosine; swivel_cone() makes them",
                               {ValuePart::axis, ValuePart::cosine}},
                      kRange = {"ranges of angles; swivel_range() makes them", {ValuePart::range}},
                      kBox = {kRange.words, {ValuePart::range, ValuePart::range, ValuePart::range}};
// start: unless it is that of the value's parts.
constexpr FieldRow input(swivel_field field, const char* name, swivel_features needs, const ValueLayout& value,
                         std::initializer_list<float> start = {})
{
    FieldRow row{field, name, 0, kInput, needs, 0, value};
    for (const ValuePart part : value.parts)
        for (std::uint32_t n = 0; n < row_of(part).count; ++n) row.start[row.component_count++] = row_of(part).start[n];
    row.start_count = static_cast<std::uint32_t>(start.size());
    float* number = row.start;
    for (const float x : start) *number++ = x;
    return row;
}
constexpr FieldRow unknown(FieldRow row)
{
    row.starts = Start::unknown;
    return row;
}
constexpr FieldRow but_not(swivel_features features, FieldRow row)
{
    row.excludes |= features;
    return row;
}
// One that a body's pose gives where there is one.
constexpr FieldRow unless_posed(const FieldRow& row) { return but_not(kBody, row); }
constexpr FieldRow kFields[] = {
    unknown(input(SWIVEL_TARGET, "target", 0, kPosition, {0, 0, 2})),
    but_not(SWIVEL_POLE_INCOMING | SWIVEL_POLE_HAND, input(SWIVEL_POLE, "pole", 0, kPosition, {0, -1, 0})),
    unknown(input(SWIVEL_LENGTHS, "lengths", 0, {"0 or 1e-15 to 1e15 each", {ValuePart::length, ValuePart::length}})),
    unless_posed(unknown(input(SWIVEL_SHOULDER_POSITION, "shoulder_position", SWIVEL_WORLD, kPosition))),
    unless_posed(input(SWIVEL_PARENT_ROTATION, "parent_rotation", SWIVEL_WORLD, kQuaternion)),
    unless_posed(input(SWIVEL_PARENT_SCALE, "parent_scale", SWIVEL_WORLD, {"1e-15 to 1e15", {ValuePart::scale}})),
    input(SWIVEL_HAND, "hand", SWIVEL_WITH_HAND, kQuaternion),
    input(SWIVEL_EFFECTOR, "effector", SWIVEL_WITH_EFFECTOR, kPoint),
    input(SWIVEL_ANGLE, "angle", SWIVEL_WITH_ANGLE,
          {"cos and sin, 1e-9 to 1e9 long; swivel_cos_sin() makes them", {ValuePart::turn}}),
    unless_posed(input(SWIVEL_INCOMING_SHOULDER, "incoming_shoulder", SWIVEL_WITH_INCOMING, kQuaternion)),
    unless_posed(input(SWIVEL_INCOMING_ELBOW, "incoming_elbow", SWIVEL_WITH_INCOMING, kQuaternion)),
    unless_posed(input(SWIVEL_INCOMING_WRIST, "incoming_wrist", SWIVEL_WITH_INCOMING | SWIVEL_WITH_HAND, kQuaternion)),
    input(SWIVEL_WEIGHTS, "weights", SWIVEL_WITH_WEIGHTS, kShares),
    input(SWIVEL_REACH, "reach", SWIVEL_WITH_REACH,
          {"0 to 1 each, the stretch 1 to 1000",
           {ValuePart::share, ValuePart::share, ValuePart::stretch, ValuePart::share}},
          {0, 0, 1, 0}),
    input(SWIVEL_MAX_SWIVEL, "max_swivel", SWIVEL_WITH_MAX_SWIVEL,
          {"cos and sin of 0 to pi; swivel_cos_sin() makes them", {ValuePart::half_turn}}),
    input(SWIVEL_FLEXION_LIMIT, "flexion_limit", SWIVEL_WITH_FLEXION_LIMIT,
          {"cosines of half angles; swivel_flexion() makes them", {ValuePart::flexion}}),
    input(SWIVEL_SHOULDER_CONE, "shoulder_cone", SWIVEL_WITH_SHOULDER_CONE, kCone),
    input(SWIVEL_HUMERAL_TWIST, "humeral_twist", SWIVEL_WITH_HUMERAL_TWIST, kRange),
    input(SWIVEL_SHOULDER_BOX, "shoulder_box", SWIVEL_WITH_SHOULDER_BOX, kBox),
    input(SWIVEL_HAND_CONE, "hand_cone", SWIVEL_WITH_HAND_CONE, kCone),
    input(SWIVEL_FOREARM_TWIST, "forearm_twist", SWIVEL_WITH_FOREARM_TWIST, kRange),
    input(SWIVEL_HAND_TWIST, "hand_twist", SWIVEL_WITH_HAND_TWIST,
          {"a unit axis and a range of angles; swivel_range() makes it", {ValuePart::axis, ValuePart::range}}),
    input(SWIVEL_WRIST_BOX, "wrist_box", SWIVEL_WITH_WRIST_BOX, kBox),
    input(SWIVEL_AIM, "aim", SWIVEL_WITH_AIM,
          {"a unit axis, cos and sin; swivel_aim() makes them", {ValuePart::axis, ValuePart::right_turn}}),
    input(SWIVEL_CLAVICLE, "clavicle", SWIVEL_WITH_CLAVICLE,
          {"a place no further than 1e15 and a share of 0 to 1", {ValuePart::point, ValuePart::share}}, {0, 0, 0, 0}),
    but_not(SWIVEL_PLANT_BY_MOTION, input(SWIVEL_CONTACT, "contact", SWIVEL_WITH_PLANT, kShare, {0})),
    input(SWIVEL_CAP, "cap", SWIVEL_WITH_CAP, kShares, {0.01f, 0.9f, 0}),
    input(SWIVEL_PELVIS_FIT_WEIGHT, "pelvis_fit_weight", SWIVEL_WITH_PELVIS_FIT, kShare),
    input(SWIVEL_NEXT_TARGET, "next_target", SWIVEL_WITH_NEXT_TARGET, kPosition),
    input(SWIVEL_NEXT_TIME, "next_time", SWIVEL_WITH_NEXT_TARGET, {"0 to 1e15", {ValuePart::time}}),
    input(SWIVEL_SHIFT_WISH, "shift_wish", kShift, {"no further than 1e15 from 0", {ValuePart::offset}}),
    unknown(input(SWIVEL_GROUND, "ground", SWIVEL_WITH_GROUND, kPosition)),
    input(SWIVEL_GROUND_NORMAL, "ground_normal", SWIVEL_WITH_GROUND, {"of length 1e-9 to 1e9", {ValuePart::direction}}),
    input(SWIVEL_GROUND_WEIGHT, "ground_weight", SWIVEL_WITH_GROUND, kShare),
    input(SWIVEL_GRIP, "grip", SWIVEL_WITH_LINK,
          {"a place no further than 1e15 and a quaternion of length 1e-9 to 1e9",
           {ValuePart::point, ValuePart::quaternion}}),
    unknown(input(SWIVEL_PROP_POSITION, "prop_position", kProp, kPosition)),
    unknown(input(SWIVEL_PROP_ROTATION, "prop_rotation", kProp, kQuaternion)),
    input(SWIVEL_HAND_BLEND, "hand_blend", kProp, kShare, {0}),
    input(SWIVEL_PROP_WEIGHT, "prop_weight", kProp, kShare),
    unknown(input(SWIVEL_LOOK_TARGET, "look_target", kLook, kPosition)),
    input(SWIVEL_LOOK_WEIGHT, "look_weight", kLook, kShare),
    {SWIVEL_SHOULDER, "shoulder", 4, kResult, 0, 0, {""}, {0, 0, 0, 1}},
    {SWIVEL_ELBOW, "elbow", 2, kResult, 0, 0, {""}, {1, 0}},
    {SWIVEL_WRIST, "wrist", 4, kResult, SWIVEL_WITH_HAND, 0, {""}, {0, 0, 0, 1}},
    {SWIVEL_FLAGS, "flags", 1, kResult},
    {SWIVEL_STRETCH, "stretch", 1, kResult, SWIVEL_WITH_REACH, 0, {""}, {1}},
    {SWIVEL_NORMAL, "normal", 3, kCarried, SWIVEL_WITH_MAX_SWIVEL},
    {SWIVEL_TWIST_BONES, "twist_bones", 4, kResult, SWIVEL_WITH_HAND, 0, {""}, {0, 0, 0, 1}},
    {SWIVEL_CLAVICLE_ROTATION, "clavicle_rotation", 4, kResult, SWIVEL_WITH_CLAVICLE, 0, {""}, {0, 0, 0, 1}},
    {SWIVEL_RECORD, "record", kRecordSize, kResult, SWIVEL_WITH_RECORD, 0, {""}, {0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0,
                                                                                  0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}},
    {SWIVEL_PLANT, "plant", 11, kCarried, SWIVEL_WITH_PLANT},
    {SWIVEL_PLANT_ROTATION, "plant_rotation", 10, kCarried, SWIVEL_WITH_PLANT_ROTATION},
    {SWIVEL_CONTACT_STATE, "contact_state", 4, kCarried, SWIVEL_PLANT_BY_MOTION},
    {SWIVEL_SOLVED_GOAL, "solved_goal", 7, kResult, kLibraryGoal | SWIVEL_WITH_RECORD, 0, {""}, {0, 0, 0, 0, 0, 0, 1}},
    {SWIVEL_SHIFT, "shift", 3, kCarried, kShift},
    {SWIVEL_PROBE, "probe", 3, kResult, SWIVEL_WITH_GROUND},
    {SWIVEL_LIFT, "lift", 9, kCarried, SWIVEL_WITH_GROUND},
    {SWIVEL_HAND_TRANSFORM, "hand_transform", 7, kResult, SWIVEL_WITH_HAND_TRANSFORM, 0, {""}, {0, 0, 0, 0, 0, 0, 1}},
    {SWIVEL_PROP_TRANSFORM, "prop_transform", 7, kResult, kProp, 0, {""}, {0, 0, 0, 0, 0, 0, 1}},
    {SWIVEL_SIGHT, "sight", 6, kResult, kLook, 0, {""}, {0, 0, 0, 0, 0, 1}},
    {SWIVEL_LOOK_TURNS, "look_turns", 1 + 3 * SWIVEL_MAX_LOOK_JOINTS, kCarried, kLook},
};
inline constexpr std::size_t kFieldCount = sizeof kFields / sizeof *kFields, kInputCount = SWIVEL_INPUT_END;

// Results have a range of numbers of their own, so that a new input moves none.
constexpr bool is_field(swivel_field field)
{
    return static_cast<std::size_t>(field) < kInputCount || (field >= SWIVEL_SHOULDER && field < SWIVEL_RESULT_END);
}
constexpr bool is_input(swivel_field field) { return field < SWIVEL_INPUT_END; }
// A field's place in the table.
constexpr std::size_t index_of(swivel_field field)
{
    return static_cast<std::size_t>(field) - (is_input(field) ? 0 : SWIVEL_SHOULDER - kInputCount);
}
constexpr const FieldRow& row_of(swivel_field field) { return kFields[index_of(field)]; }
constexpr const char* name_of(swivel_field field) { return row_of(field).name; }
static_assert([] {
    for (std::size_t n = 0; n < kFieldCount; ++n)
        if (index_of(kFields[n].field) != n || is_input(kFields[n].field) != (kFields[n].kind == kInput)) return false;
    return kFieldCount == kInputCount + SWIVEL_RESULT_END - SWIVEL_SHOULDER;
}());
static_assert([] {
    for (const FieldRow& row : kFields)
        if (row.kind != kResult && row.component_count > kMaxComponents) return false;
    return true;
}());
static_assert([] {
    for (const FieldRow& row : kFields)
        if (row.start_count != 0 && row.start_count != row.component_count) return false;
    return true;
}());

// The kinds of groups that may have a field.
constexpr std::uint32_t kinds_of(const FieldRow& row)
{
    if (row.field == SWIVEL_FLAGS)
        return kLimbs | 1u << SWIVEL_KIND_LOOK | 1u << SWIVEL_KIND_PROP | 1u << SWIVEL_KIND_SHIFT;
    if (row.needs & kNoLimb) return 1u << kind_of(row.needs);
    std::uint32_t kinds = row.excludes & kBody ? kFreeLimbs : row.needs & kLibraryGoal ? kBodyLimbs : kLimbs;
    for (const FeatureRow& feature : kFeatures)
        if (row.needs & feature.feature) kinds &= feature.kinds;
    return kinds;
}

// Whether limbs of a group start with NaN for a value that is not given. The library or the pose then gives it, or else
// it is bad input. A hand that aims is relative to the forearm and starts as the identity.
constexpr bool may_be_missing(const FieldRow& row, swivel_features features)
{
    const bool is_posed_hand = row.field == SWIVEL_HAND && features & kBody && !(features & SWIVEL_WITH_AIM);
    return row.starts == Start::unknown || is_posed_hand;
}

// The features with which limbs carry something from solve to solve.
inline constexpr swivel_features kCarryingFeatures = [] {
    swivel_features carrying = 0;
    for (const FieldRow& row : kFields)
        if (row.kind == kCarried) carrying |= row.needs;
    return carrying;
}();

// ---- flags
struct FlagRow {
    swivel_flag flag;
    const char* name;
    swivel_field limit = SWIVEL_INPUT_END;  // of the swivel, which forbids what was wished for
};
constexpr FlagRow kFlags[] = {
    {SWIVEL_REACHED, "REACHED"},
    {SWIVEL_SOFTENED, "SOFTENED"},
    {SWIVEL_STRETCHED, "STRETCHED"},
    {SWIVEL_CLAMPED_FAR, "CLAMPED_FAR"},
    {SWIVEL_CLAMPED_NEAR, "CLAMPED_NEAR"},
    {SWIVEL_SWIVEL_UNDEFINED, "SWIVEL_UNDEFINED"},
    {SWIVEL_LIMITED_FLEXION, "LIMITED_FLEXION"},
    {SWIVEL_LIMITED_SHOULDER_CONE, "LIMITED_SHOULDER_CONE", SWIVEL_SHOULDER_CONE},
    {SWIVEL_LIMITED_HUMERAL_TWIST, "LIMITED_HUMERAL_TWIST", SWIVEL_HUMERAL_TWIST},
    {SWIVEL_LIMITED_SHOULDER_BOX, "LIMITED_SHOULDER_BOX", SWIVEL_SHOULDER_BOX},
    {SWIVEL_LIMITED_HAND_CONE, "LIMITED_HAND_CONE", SWIVEL_HAND_CONE},
    {SWIVEL_LIMITED_FOREARM_TWIST, "LIMITED_FOREARM_TWIST", SWIVEL_FOREARM_TWIST},
    {SWIVEL_LIMITED_HAND_TWIST, "LIMITED_HAND_TWIST", SWIVEL_HAND_TWIST},
    {SWIVEL_LIMITED_WRIST_BOX, "LIMITED_WRIST_BOX", SWIVEL_WRIST_BOX},
    {SWIVEL_LIMITED_STEP, "LIMITED_STEP"},
    {SWIVEL_INFEASIBLE, "INFEASIBLE"},
    {SWIVEL_JUMPED, "JUMPED"},
    {SWIVEL_PLANTED, "PLANTED"},
    {SWIVEL_RELEASED, "RELEASED"},
    {SWIVEL_BROKE_AWAY, "BROKE_AWAY"},
    {SWIVEL_CUT, "CUT"},
    {SWIVEL_LIMITED_REGION, "LIMITED_REGION"},
    {SWIVEL_LIMITED_LOOK, "LIMITED_LOOK"},
    {SWIVEL_FADED, "FADED"},
    {SWIVEL_BAD_INPUT, "BAD_INPUT"},
};

// ---- limits of the swivel
// Those that are one line each on the circle of swivels (core/joint_limits.h), in the order of their lines. A limit of
// the hand is among kHandLimits, too.
inline constexpr swivel_field kLineLimits[] = {SWIVEL_SHOULDER_CONE, SWIVEL_HUMERAL_TWIST, SWIVEL_HAND_CONE,
                                               SWIVEL_FOREARM_TWIST, SWIVEL_HAND_TWIST};
inline constexpr std::size_t kLineLimitCount = std::size(kLineLimits);
inline constexpr swivel_features kLineFeatures = [] {
    swivel_features features = 0;
    for (const swivel_field limit : kLineLimits) features |= row_of(limit).needs;
    return features;
}();
inline constexpr swivel_features kBoxFeatures = SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX;
// All of them.
inline constexpr swivel_features kSwivelLimits = kLineFeatures | kBoxFeatures | SWIVEL_WITH_REGION;
// The lines, their features and their flags are in one order. Each line has one feature, whose bit places it behind the
// lines of lower bits (limit_stages.h).
static_assert([] {
    for (const swivel_field limit : kLineLimits)
        if (!std::has_single_bit(row_of(limit).needs)) return false;
    std::size_t n = 0;
    swivel_features before = 0;
    for (const FlagRow& row : kFlags) {
        if (row.limit == SWIVEL_INPUT_END || row_of(row.limit).needs & kBoxFeatures) continue;
        if (n == kLineLimitCount || kLineLimits[n++] != row.limit || row_of(row.limit).needs <= before) return false;
        before = row_of(row.limit).needs;
    }
    return n == kLineLimitCount;
}());

}  // namespace swivel
