// SPDX-License-Identifier: MIT
#include "batch/query/one_limb.h"

#include <cmath>

#include "batch/query/forward.h"
#include "batch/solve/rest.h"
#include "simd/rows.h"

namespace swivel {

namespace {

constexpr swivel_features kBodyFeatures = [] {
    swivel_features found = kBody | kLibraryGoal;
    for (const FeatureRow& row : kFeatures)
        if (row.kinds == kBodyLimbs) found |= row.feature;
    return found;
}();
constexpr swivel_features free_features(swivel_features features)
{
    if (!(features & kBody)) return features;
    // An aim sees the hand that the record has.
    const swivel_features hand = features & SWIVEL_WITH_AIM ? SWIVEL_WITH_HAND : 0;
    return (features & ~(kBodyFeatures | SWIVEL_WITH_CLAVICLE | kTwistBones)) | hand;
}

// A value of a limb, among the input or the result rows.
float* value_of(const Group& group, std::uint32_t limb, swivel_field field)
{
    float* const rows = is_input(field) ? group.input : group.results;
    const std::uint32_t row_count = is_input(field) ? group.input_row_count : group.result_row_count;
    return rows + row_offset(limb, row_count, field_first_row(group.features, field));
}
// A rotor of a limb, from the first of its numbers on.
Rotor<double> rotor_from(const float* first)
{
    return rotor<double>(first[0], first[kLanes], first[2 * kLanes], first[3 * kLanes]);
}

}  // namespace

Rotor<double> hand_from_arm(const Group& group)
{
    if (!(group.features & kBody)) return rotor(0.0, 0.0, 0.0, 1.0);
    return normalise(~rotor_of(group.binding.wrist_parent_from_arm) * rotor_of(group.binding.wrist_rest));
}

Rotor<double> incoming_hand(const Group& group, std::uint32_t limb)
{
    const float* const record = value_of(group, limb, SWIVEL_RECORD);
    const auto rotor_at = [&](int n) { return rotor_from(record + static_cast<std::size_t>(n) * kLanes); };
    Rotor<double> arm = rotor_at(kRecordArm);
    if (group.features & SWIVEL_WITH_CLAVICLE) {  // the record has the arm as the clavicle turned it
        const Rotor<double> parent_from_arm = rotor_of(group.binding.parent_from_arm);
        const Rotor<double> turn = rotor_from(value_of(group, limb, SWIVEL_CLAVICLE_ROTATION));
        arm = arm * ~parent_from_arm * ~turn * parent_from_arm;
    }
    const Rotor<double> hand =
        rotor_at(kRecordIncoming) * rotor_at(kRecordIncoming + 4) * rotor_at(kRecordIncoming + 8);
    return normalise(arm * hand * hand_from_arm(group));
}

Rotor<double> wanted_hand(const Group& group, std::uint32_t limb)
{
    const Rotor<double> hand = rotor_from(value_of(group, limb, SWIVEL_HAND));
    return std::isnan(len2(hand)) ? incoming_hand(group, limb) : hand;
}

OneLimb::OneLimb(const Group& group) : source_(group)
{
    static_assert(block_bytes(kEveryFeature & ~kBodyFeatures) <= sizeof rows_);
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
        copy_lane(count, value_of(source_, limb, row.field), value_of(group(), 0, row.field));
    }
    if (source_.features & kBody) take_record(limb);
}

void OneLimb::take_record(std::uint32_t limb)
{
    const float* const record = value_of(source_, limb, SWIVEL_RECORD);
    const auto number = [&](int n) { return static_cast<double>(record[static_cast<std::size_t>(n) * kLanes]); };
    const auto rotor_at = [&](int n) { return rotor_from(record + static_cast<std::size_t>(n) * kLanes); };
    const auto vector_of = [&](swivel_field field) {
        const float* const v = value_of(source_, limb, field);
        return vector<double>(v[0], v[kLanes], v[2 * kLanes]);
    };
    set(SWIVEL_SHOULDER_POSITION,
        vector(number(kRecordShoulder), number(kRecordShoulder + 1), number(kRecordShoulder + 2)));
    set(SWIVEL_PARENT_ROTATION, rotor_at(kRecordArm));
    set(SWIVEL_PARENT_SCALE, 0, number(kRecordScale));
    set(SWIVEL_LENGTHS, 0, number(kRecordLengths));
    set(SWIVEL_LENGTHS, 1, number(kRecordLengths + 1));
    set(SWIVEL_INCOMING_SHOULDER, rotor_at(kRecordIncoming));
    set(SWIVEL_INCOMING_ELBOW, rotor_at(kRecordIncoming + 4));
    const swivel_features features = source_.features;
    const Rotor<double> hand = hand_from_arm(source_);
    if (group().features & SWIVEL_WITH_HAND) set(SWIVEL_INCOMING_WRIST, rotor_at(kRecordIncoming + 8));
    if (features & SWIVEL_WITH_AIM) {
        set(SWIVEL_HAND, rotor_at(kRecordIncoming + 8));
        if (!(features & SWIVEL_WITH_HAND)) set(SWIVEL_WRIST, rotor_at(kRecordIncoming + 8));
        set(SWIVEL_AIM, sandwich(hand, vector_of(SWIVEL_AIM)));
    } else if (features & SWIVEL_WITH_HAND) {
        const Rotor<double> wanted = features & kLibraryGoal
                                         ? rotor_from(value_of(source_, limb, SWIVEL_SOLVED_GOAL) + 3 * kLanes)
                                         : wanted_hand(source_, limb);
        set(SWIVEL_HAND, wanted * ~hand);
    }
    if (features & kLibraryGoal) set(SWIVEL_TARGET, vector_of(SWIVEL_SOLVED_GOAL));
    if (features & SWIVEL_WITH_EFFECTOR) set(SWIVEL_EFFECTOR, sandwich(hand, vector_of(SWIVEL_EFFECTOR)));
}

void OneLimb::set(swivel_field field, std::uint32_t component, double value)
{
    value_of(group(), 0, field)[component * kLanes] = static_cast<float>(value);
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
