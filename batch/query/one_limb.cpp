// SPDX-License-Identifier: MIT
#include "batch/query/one_limb.h"

#include <cmath>

#include "batch/query/forward.h"
#include "batch/query/limb_value.h"
#include "batch/solve/rest.h"
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

Rotor<double> incoming_arm_rotation(const Group& group, std::uint32_t limb)
{
    const Rotor<double> arm = rotor_of(LimbValue(group, limb, SWIVEL_RECORD), kRecordArm);
    if (!(group.features & SWIVEL_WITH_CLAVICLE)) return arm;
    const Rotor<double> parent_from_arm = rotor_of(group.binding.parent_from_arm);
    const Rotor<double> turn = rotor_of(LimbValue(group, limb, SWIVEL_CLAVICLE_ROTATION));
    return arm * ~parent_from_arm * ~turn * parent_from_arm;
}

Rotor<double> incoming_hand(const Group& group, std::uint32_t limb)
{
    const LimbValue record(group, limb, SWIVEL_RECORD);
    const Rotor<double> hand = rotor_of(record, kRecordIncoming) * rotor_of(record, kRecordIncoming + 4) *
                               rotor_of(record, kRecordIncoming + 8);
    return normalise(incoming_arm_rotation(group, limb) * hand * hand_from_arm(group));
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
    group_.half_line = group.half_line;
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
    store(vector_of(record, kRecordShoulder), own(SWIVEL_SHOULDER_POSITION));
    store(rotor_of(record, kRecordArm), own(SWIVEL_PARENT_ROTATION));
    own(SWIVEL_PARENT_SCALE).set(0, record[kRecordScale]);
    own(SWIVEL_LENGTHS).set(0, record[kRecordLengths]);
    own(SWIVEL_LENGTHS).set(1, record[kRecordLengths + 1]);
    store(rotor_of(record, kRecordIncoming), own(SWIVEL_INCOMING_SHOULDER));
    store(rotor_of(record, kRecordIncoming + 4), own(SWIVEL_INCOMING_ELBOW));
    const swivel_features features = source_.features;
    const Rotor<double> hand = hand_from_arm(source_);
    if (group().features & SWIVEL_WITH_HAND) store(rotor_of(record, kRecordIncoming + 8), own(SWIVEL_INCOMING_WRIST));
    if (features & SWIVEL_WITH_AIM) {
        store(rotor_of(record, kRecordIncoming + 8), own(SWIVEL_HAND));
        if (!(features & SWIVEL_WITH_HAND)) store(rotor_of(record, kRecordIncoming + 8), own(SWIVEL_WRIST));
        store(sandwich(hand, vector_of({source_, limb, SWIVEL_AIM})), own(SWIVEL_AIM));
    } else if (features & SWIVEL_WITH_HAND) {
        const Rotor<double> wanted =
            features & kLibraryGoal ? rotor_of({source_, limb, SWIVEL_SOLVED_GOAL}, 3) : wanted_hand(source_, limb);
        store(wanted * ~hand, own(SWIVEL_HAND));
    }
    if (features & kLibraryGoal) store(vector_of({source_, limb, SWIVEL_SOLVED_GOAL}), own(SWIVEL_TARGET));
    if (features & SWIVEL_WITH_EFFECTOR)
        store(sandwich(hand, vector_of({source_, limb, SWIVEL_EFFECTOR})), own(SWIVEL_EFFECTOR));
}

}  // namespace swivel
