// SPDX-License-Identifier: MIT
#include "batch/query/one_limb.h"

#include <cmath>

#include "batch/query/forward.h"
#include "batch/query/limb_value.h"
#include "batch/solve/solve.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr swivel_features free_features(swivel_features features)
{
    if (!(features & kBody)) return features;
    // An aim sees the hand that the record has.
    const swivel_features hand = features & SWIVEL_WITH_AIM ? SWIVEL_WITH_HAND : 0;
    return (features & ~(kBodyFeatures | SWIVEL_WITH_CLAVICLE | kTwistBones)) | hand;
}

}  // namespace

Rotor<double> hand_from_arm(const Group& group)
{
    if (!(group.features & kBody)) return rotor(0.0, 0.0, 0.0, 1.0);
    return normalise(~rotor_of(group.binding.wrist_parent_from_arm) * rotor_of(group.binding.wrist_rest));
}

Rotor<double> incoming_hand(const Group& group, std::uint32_t limb)
{
    const LimbValue record(group, limb, SWIVEL_RECORD);
    Rotor<double> arm = rotor_of(record, kRecordArm);
    if (group.features & SWIVEL_WITH_CLAVICLE) {  // the record has the arm as the clavicle turned it
        const Rotor<double> parent_from_arm = rotor_of(group.binding.parent_from_arm);
        const Rotor<double> turn = rotor_of(LimbValue(group, limb, SWIVEL_CLAVICLE_ROTATION));
        arm = arm * ~parent_from_arm * ~turn * parent_from_arm;
    }
    const Rotor<double> hand = rotor_of(record, kRecordIncoming) * rotor_of(record, kRecordIncoming + 4) *
                               rotor_of(record, kRecordIncoming + 8);
    return normalise(arm * hand * hand_from_arm(group));
}

Rotor<double> wanted_hand(const Group& group, std::uint32_t limb)
{
    const Rotor<double> hand = rotor_of(LimbValue(group, limb, SWIVEL_HAND));
    return std::isnan(len2(hand)) ? incoming_hand(group, limb) : hand;
}

OneLimb::OneLimb(const Group& group) : source_(group)
{
    GroupDef alone = default_group();
    alone.features = free_features(group.features);
    alone.limb_count = 1;
    alone.on_bad_input = SWIVEL_REST_POSE;
    alone.shoulder_order = group.shoulder_order;
    alone.wrist_order = group.wrist_order;
    alone.binding = group.binding;
    place_group(alone, 0, rows_, group_);
    group_.region = group.region;
    rest(group_);
}

void OneLimb::take(std::uint32_t limb)
{
    for (const FieldRow& row : kFields) {
        const std::uint32_t count = field_row_count(group().features, row.field);
        if (count == 0 || field_row_count(source_.features, row.field) != count) continue;
        copy_lane(count, LimbValue(source_, limb, row.field).first, LimbValue(group(), 0, row.field).first);
    }
    if (source_.features & kBody) take_record(limb);
}

void OneLimb::take_record(std::uint32_t limb)
{
    const LimbValue record(source_, limb, SWIVEL_RECORD);
    set(SWIVEL_SHOULDER_POSITION, vector_of(record, kRecordShoulder));
    set(SWIVEL_PARENT_ROTATION, rotor_of(record, kRecordArm));
    set(SWIVEL_PARENT_SCALE, 0, record[kRecordScale]);
    set(SWIVEL_LENGTHS, 0, record[kRecordLengths]);
    set(SWIVEL_LENGTHS, 1, record[kRecordLengths + 1]);
    set(SWIVEL_INCOMING_SHOULDER, rotor_of(record, kRecordIncoming));
    set(SWIVEL_INCOMING_ELBOW, rotor_of(record, kRecordIncoming + 4));
    const swivel_features features = source_.features;
    const Rotor<double> hand = hand_from_arm(source_);
    if (group().features & SWIVEL_WITH_HAND) set(SWIVEL_INCOMING_WRIST, rotor_of(record, kRecordIncoming + 8));
    if (features & SWIVEL_WITH_AIM) {
        set(SWIVEL_HAND, rotor_of(record, kRecordIncoming + 8));
        if (!(features & SWIVEL_WITH_HAND)) set(SWIVEL_WRIST, rotor_of(record, kRecordIncoming + 8));
        set(SWIVEL_AIM, sandwich(hand, vector_of({source_, limb, SWIVEL_AIM})));
    } else if (features & SWIVEL_WITH_HAND) {
        const Rotor<double> wanted =
            features & kLibraryGoal ? rotor_of({source_, limb, SWIVEL_SOLVED_GOAL}, 3) : wanted_hand(source_, limb);
        set(SWIVEL_HAND, wanted * ~hand);
    }
    if (features & kLibraryGoal) set(SWIVEL_TARGET, vector_of({source_, limb, SWIVEL_SOLVED_GOAL}));
    if (features & SWIVEL_WITH_EFFECTOR)
        set(SWIVEL_EFFECTOR, sandwich(hand, vector_of({source_, limb, SWIVEL_EFFECTOR})));
}

void OneLimb::set(swivel_field field, std::uint32_t component, double value)
{
    LimbValue(group(), 0, field).first[component * kLanes] = static_cast<float>(value);
}
void OneLimb::set(swivel_field field, const Vector<double>& v)
{
    for (std::uint32_t c = 0; c < 3; ++c) set(field, c, v.c[c]);
}
void OneLimb::set(swivel_field field, const Rotor<double>& q)
{
    set(field, 0, q.at<kI>());
    set(field, 1, q.at<kJ>());
    set(field, 2, q.at<kK>());
    set(field, 3, q.at<kScalar>());
}

}  // namespace swivel
