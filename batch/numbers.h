// SPDX-License-Identifier: MIT
//
// The public numbers of features and fields, as the kernels count them. The only place that knows both.
#pragma once

#include <bit>
#include <iterator>

#include "batch/swivel.h"
#include "simd/fields.h"

namespace swivel {

static_assert(kLanes == SWIVEL_LANES && kMostTwistBones == SWIVEL_MOST_TWIST_BONES);

// Results have a range of public numbers of their own, so that a new input moves none.
inline constexpr std::uint32_t kFirstResult = SWIVEL_SHOULDER;
constexpr bool is_field(swivel_field field)
{
    const auto n = static_cast<std::uint32_t>(field);
    return n < kInputCount || (n >= kFirstResult && n - kFirstResult < kFieldCount - kInputCount);
}
// Of a number that is a field's.
constexpr Field field_of(swivel_field field)
{
    const auto n = static_cast<std::uint32_t>(field);
    return static_cast<Field>(n < kInputCount ? n : kInputCount + n - kFirstResult);
}

struct FieldNumber {
    swivel_field number;
    Field own;
};
inline constexpr FieldNumber kFieldNumbers[] = {
    {SWIVEL_TARGET, Field::target},
    {SWIVEL_POLE, Field::pole},
    {SWIVEL_LENGTHS, Field::lengths},
    {SWIVEL_SHOULDER_POSITION, Field::shoulder_position},
    {SWIVEL_PARENT_ROTATION, Field::parent_rotation},
    {SWIVEL_PARENT_SCALE, Field::parent_scale},
    {SWIVEL_HAND, Field::hand},
    {SWIVEL_EFFECTOR, Field::effector},
    {SWIVEL_ANGLE, Field::angle},
    {SWIVEL_INCOMING_SHOULDER, Field::incoming_shoulder},
    {SWIVEL_INCOMING_ELBOW, Field::incoming_elbow},
    {SWIVEL_INCOMING_WRIST, Field::incoming_wrist},
    {SWIVEL_WEIGHTS, Field::weights},
    {SWIVEL_REACH, Field::reach},
    {SWIVEL_MOST_SWIVEL, Field::most_swivel},
    {SWIVEL_FLEXION_LIMIT, Field::flexion_limit},
    {SWIVEL_SHOULDER_CONE, Field::shoulder_cone},
    {SWIVEL_HUMERAL_TWIST, Field::humeral_twist},
    {SWIVEL_SHOULDER_BOX, Field::shoulder_box},
    {SWIVEL_HAND_CONE, Field::hand_cone},
    {SWIVEL_FOREARM_TWIST, Field::forearm_twist},
    {SWIVEL_HAND_TWIST, Field::hand_twist},
    {SWIVEL_WRIST_BOX, Field::wrist_box},
    {SWIVEL_AIM, Field::aim},
    {SWIVEL_CLAVICLE, Field::clavicle},
    {SWIVEL_SHOULDER, Field::shoulder},
    {SWIVEL_ELBOW, Field::elbow},
    {SWIVEL_WRIST, Field::wrist},
    {SWIVEL_FLAGS, Field::flags},
    {SWIVEL_STRETCH, Field::stretch},
    {SWIVEL_NORMAL, Field::normal},
    {SWIVEL_TWIST_BONES, Field::twist_bones},
    {SWIVEL_CLAVICLE_TURN, Field::clavicle_turn},
};
static_assert(std::size(kFieldNumbers) == kFieldCount);
static_assert([] {
    for (const FieldNumber& field : kFieldNumbers)
        if (!is_field(field.number) || field_of(field.number) != field.own) return false;
    return true;
}());

static_assert(SWIVEL_INPUT_END == kInputCount && SWIVEL_RESULT_END - SWIVEL_SHOULDER == kFieldCount - kInputCount);

// The bits of features are equal in both.
struct FeatureName {
    FeatureSet number, own;
    const char* name;
};
inline constexpr FeatureName kFeatureNames[] = {
    {SWIVEL_WORLD, feature::world, "SWIVEL_WORLD"},
    {SWIVEL_JOINTS, feature::joints, "SWIVEL_JOINTS"},
    {SWIVEL_WITH_HAND, feature::hand, "SWIVEL_WITH_HAND"},
    {SWIVEL_POLE_DIRECTION, feature::pole_direction, "SWIVEL_POLE_DIRECTION"},
    {SWIVEL_COMPACT, feature::compact, "SWIVEL_COMPACT"},
    {SWIVEL_WITH_EFFECTOR, feature::effector, "SWIVEL_WITH_EFFECTOR"},
    {SWIVEL_WITH_ANGLE, feature::angle, "SWIVEL_WITH_ANGLE"},
    {SWIVEL_POLE_NORMAL, feature::pole_normal, "SWIVEL_POLE_NORMAL"},
    {SWIVEL_WITH_INCOMING, feature::incoming, "SWIVEL_WITH_INCOMING"},
    {SWIVEL_POLE_INCOMING, feature::pole_incoming, "SWIVEL_POLE_INCOMING"},
    {SWIVEL_WITH_WEIGHTS, feature::weights, "SWIVEL_WITH_WEIGHTS"},
    {SWIVEL_WITH_REACH, feature::reach, "SWIVEL_WITH_REACH"},
    {SWIVEL_WITH_MOST_SWIVEL, feature::most_swivel, "SWIVEL_WITH_MOST_SWIVEL"},
    {SWIVEL_WITH_FLEXION_LIMIT, feature::flexion_limit, "SWIVEL_WITH_FLEXION_LIMIT"},
    {SWIVEL_WITH_SHOULDER_CONE, feature::shoulder_cone, "SWIVEL_WITH_SHOULDER_CONE"},
    {SWIVEL_WITH_HUMERAL_TWIST, feature::humeral_twist, "SWIVEL_WITH_HUMERAL_TWIST"},
    {SWIVEL_WITH_SHOULDER_BOX, feature::shoulder_box, "SWIVEL_WITH_SHOULDER_BOX"},
    {SWIVEL_WITH_HAND_CONE, feature::hand_cone, "SWIVEL_WITH_HAND_CONE"},
    {SWIVEL_WITH_FOREARM_TWIST, feature::forearm_twist, "SWIVEL_WITH_FOREARM_TWIST"},
    {SWIVEL_WITH_HAND_TWIST, feature::hand_twist, "SWIVEL_WITH_HAND_TWIST"},
    {SWIVEL_WITH_WRIST_BOX, feature::wrist_box, "SWIVEL_WITH_WRIST_BOX"},
    {SWIVEL_WITH_AIM, feature::aim, "SWIVEL_WITH_AIM"},
    {SWIVEL_WITH_CLAVICLE, feature::clavicle, "SWIVEL_WITH_CLAVICLE"},
    {SWIVEL_WITH_TWIST_BONES, feature::twist_bones, "SWIVEL_WITH_TWIST_BONES"},
    {SWIVEL_BUDGET, feature::budget, "SWIVEL_BUDGET"},
};
static_assert([] {
    for (const FeatureName& feature : kFeatureNames)
        if (feature.number != feature.own) return false;
    return true;
}());

// Every feature, with the number of twist bones at its largest.
inline constexpr FeatureSet kKnownFeatures = [] {
    FeatureSet known = kMostTwistBones * feature::twist_bones;
    for (const FeatureName& feature : kFeatureNames) known |= feature.own;
    return known;
}();

// The name of the lowest feature of a set; empty for none.
constexpr const char* feature_name(FeatureSet features)
{
    for (const FeatureName& feature : kFeatureNames)
        if (features & feature.own) return feature.name;
    return "";
}

}  // namespace swivel
