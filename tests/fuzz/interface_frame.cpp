// SPDX-License-Identifier: MIT
#include "tests/fuzz/interface_frame.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>

#include "tests/fuzz/crowd_of_bytes.h"
#include "tests/fuzz/require.h"

namespace swivel::fuzz {
namespace {

struct Input {
    swivel_field field;
    swivel_in swivel_frame::*member;
};
constexpr Input kInputs[] = {
    {SWIVEL_TARGET, &swivel_frame::target},
    {SWIVEL_POLE, &swivel_frame::pole},
    {SWIVEL_LENGTHS, &swivel_frame::lengths},
    {SWIVEL_SHOULDER_POSITION, &swivel_frame::shoulder_position},
    {SWIVEL_PARENT_ROTATION, &swivel_frame::parent_rotation},
    {SWIVEL_PARENT_SCALE, &swivel_frame::parent_scale},
    {SWIVEL_HAND, &swivel_frame::hand},
    {SWIVEL_EFFECTOR, &swivel_frame::effector},
    {SWIVEL_ANGLE, &swivel_frame::angle},
    {SWIVEL_INCOMING_SHOULDER, &swivel_frame::incoming_shoulder},
    {SWIVEL_INCOMING_ELBOW, &swivel_frame::incoming_elbow},
    {SWIVEL_INCOMING_WRIST, &swivel_frame::incoming_wrist},
    {SWIVEL_WEIGHTS, &swivel_frame::weights},
    {SWIVEL_REACH, &swivel_frame::reach},
    {SWIVEL_MOST_SWIVEL, &swivel_frame::most_swivel},
    {SWIVEL_FLEXION_LIMIT, &swivel_frame::flexion_limit},
    {SWIVEL_SHOULDER_CONE, &swivel_frame::shoulder_cone},
    {SWIVEL_HUMERAL_TWIST, &swivel_frame::humeral_twist},
    {SWIVEL_SHOULDER_BOX, &swivel_frame::shoulder_box},
    {SWIVEL_HAND_CONE, &swivel_frame::hand_cone},
    {SWIVEL_FOREARM_TWIST, &swivel_frame::forearm_twist},
    {SWIVEL_HAND_TWIST, &swivel_frame::hand_twist},
    {SWIVEL_WRIST_BOX, &swivel_frame::wrist_box},
    {SWIVEL_AIM, &swivel_frame::aim},
    {SWIVEL_CLAVICLE, &swivel_frame::clavicle},
};
static_assert(std::size(kInputs) == SWIVEL_INPUT_END);
struct Output {
    swivel_field field;
    swivel_out swivel_frame::*member;
};
constexpr Output kOutputs[] = {
    {SWIVEL_SHOULDER, &swivel_frame::shoulder},
    {SWIVEL_ELBOW, &swivel_frame::elbow},
    {SWIVEL_WRIST, &swivel_frame::wrist},
    {SWIVEL_FLAGS, &swivel_frame::flags},
    {SWIVEL_STRETCH, &swivel_frame::stretch},
    {SWIVEL_NORMAL, &swivel_frame::normal},
    {SWIVEL_TWIST_BONES, &swivel_frame::twist_bones},
    {SWIVEL_CLAVICLE_TURN, &swivel_frame::clavicle_turn},
};
static_assert(std::size(kOutputs) == SWIVEL_RESULT_END - SWIVEL_SHOULDER);

// Whether a member is given: mostly not one that the crowd does not have.
bool is_given(Session& session, swivel_field field)
{
    return session.bytes.one_in(component_count(session, field) > 0 ? 2 : 64);
}

}  // namespace

Frame::Frame(Session& session, std::uint32_t group)
{
    const std::uint32_t limb_count = swivel_group_limb_count(session.crowd, group);
    if (session.bytes.one_in(4)) take_origin(session, limb_count);
    for (const Input& input : kInputs)
        if (is_given(session, input.field)) take_input(session, input.field, input.member, limb_count);
    for (const Output& output : kOutputs)
        if (!(session.features & SWIVEL_COMPACT) || session.bytes.one_in(64))
            if (is_given(session, output.field)) take_output(session, output.field, output.member, limb_count);
}

// Null data is a member that is not given.
void Frame::judge(const Session& session, swivel_field field, const Strided& values)
{
    const bool is_wrong = component_count(session, field) == 0 || !values.is_valid();
    if (!values.is_null() && is_wrong) is_valid = false;
}

void Frame::take_input(Session& session, swivel_field field, swivel_in swivel_frame::*member, std::uint32_t limb_count)
{
    const bool is_position = field == SWIVEL_TARGET || field == SWIVEL_POLE || field == SWIVEL_SHOULDER_POSITION;
    const std::size_t each = frame.origin.data && is_position ? sizeof(double) : sizeof(float),
                      components = std::max(component_count(session, field), 1u);
    const std::uint32_t kind = session.bytes.take<std::uint8_t>();
    Random random{session.bytes.take<std::uint16_t>()};
    Strided& values = inputs.emplace_back(session.bytes, limb_count, components * each, true);
    values.fill([&](std::size_t, char* at) {
        std::array<float, 12> value{};
        make_value(random, field, kind, std::span(value).first(components));
        for (std::size_t c = 0; c < components; ++c) {
            const double wide = static_cast<double>(value[c]);
            std::memcpy(at + c * each, each == sizeof wide ? static_cast<const void*>(&wide) : &value[c], each);
        }
    });
    frame.*member = values.in();
    judge(session, field, values);
}

void Frame::take_origin(Session& session, std::uint32_t limb_count)
{
    Strided& values = inputs.emplace_back(session.bytes, limb_count, 3 * sizeof(double), true);
    values.fill([&](std::size_t, char* at) { std::memset(at, 0, 3 * sizeof(double)); });
    frame.origin = values.in();
    if (!values.is_null() && !values.is_valid()) is_valid = false;
}

void Frame::take_output(Session& session, swivel_field field, swivel_out swivel_frame::*member,
                        std::uint32_t limb_count)
{
    const std::size_t components = std::max(component_count(session, field), 1u);
    Strided& values = outputs.emplace_back(session.bytes, limb_count, components * sizeof(float), false);
    output_fields.push_back(field);
    frame.*member = values.out();
    judge(session, field, values);
    if (!values.is_null() && (session.features & SWIVEL_COMPACT)) is_valid = false;
}

void Frame::check(const Session& session, std::uint32_t group, const std::vector<bool>& chosen) const
{
    const std::uint32_t limb_count = swivel_group_limb_count(session.crowd, group),
                        first = swivel_group_first_limb(session.crowd, group);
    const auto lane = chosen.begin() + first;
    const bool is_untouched = std::find(lane, lane + limb_count, true) == lane + limb_count;
    for (std::size_t n = 0; n < outputs.size(); ++n) {
        outputs[n].check_gaps(is_untouched);
        if (is_untouched || outputs[n].is_null()) continue;
        std::array<char, 28 * sizeof(float)> result;  // seven twist bones
        for (std::uint32_t limb = 0; limb < limb_count; ++limb) {
            if (lane[limb])
                swivel_read(session.crowd, output_fields[n], group, limb, 1, {result.data(), result.size()});
            else
                result.fill(Strided::kPattern);
            SWIVEL_REQUIRE(std::memcmp(result.data(), outputs[n].at(limb), outputs[n].value_bytes()) == 0);
        }
    }
}

}  // namespace swivel::fuzz
