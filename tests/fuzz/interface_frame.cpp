// SPDX-License-Identifier: MIT
//
// The call of the C interface that copies in, solves and copies out, for all groups at once.
#include <array>
#include <cstring>
#include <vector>

#include "tests/fuzz/crowd_of_bytes.h"
#include "tests/fuzz/interface_session.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/strided.h"

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
    {SWIVEL_AIM, &swivel_frame::aim},
    {SWIVEL_CLAVICLE, &swivel_frame::clavicle},
};
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
    {SWIVEL_TWIST, &swivel_frame::twist},
    {SWIVEL_CLAVICLE_TURN, &swivel_frame::clavicle_turn},
};

// One group's frame and the arrays that it points to.
struct Frame {
    swivel_frame frame{};
    std::vector<Strided> inputs, outputs;
    std::vector<swivel_field> output_fields;
    bool is_valid = true;

    // Whether a member is given: mostly not one that the crowd does not have.
    static bool is_given(Session& session, swivel_field field)
    {
        return session.bytes.one_in(component_count(session, field) > 0 ? 2 : 64);
    }
    // Null data is a member that is not given.
    void judge(const Session& session, swivel_field field, const Strided& values)
    {
        const bool is_wrong = component_count(session, field) == 0 || !values.is_valid();
        if (!values.is_null() && is_wrong) is_valid = false;
    }

    void take_input(Session& session, const Input& input, std::uint32_t limb_count, bool doubles)
    {
        const bool is_position =
            input.field == SWIVEL_TARGET || input.field == SWIVEL_POLE || input.field == SWIVEL_SHOULDER_POSITION;
        const std::size_t each = doubles && is_position ? sizeof(double) : sizeof(float),
                          components = std::max(component_count(session, input.field), 1u);
        const std::uint32_t kind = session.bytes.take<std::uint8_t>();
        Random random{session.bytes.take<std::uint16_t>()};
        Strided& values = inputs.emplace_back(session.bytes, limb_count, components * each, true);
        values.fill([&](std::size_t, char* at) {
            std::array<float, 12> value{};
            make_value(random, input.field, kind, std::span(value).first(components));
            for (std::size_t c = 0; c < components; ++c) {
                const double wide = static_cast<double>(value[c]);
                std::memcpy(at + c * each, each == sizeof wide ? static_cast<const void*>(&wide) : &value[c], each);
            }
        });
        frame.*input.member = values.in();
        judge(session, input.field, values);
    }

    void take_origin(Session& session, std::uint32_t limb_count)
    {
        Strided& values = inputs.emplace_back(session.bytes, limb_count, 3 * sizeof(double), true);
        values.fill([&](std::size_t, char* at) { std::memset(at, 0, 3 * sizeof(double)); });
        frame.origin = values.in();
        if (!values.is_null() && !values.is_valid()) is_valid = false;
    }

    void take_output(Session& session, const Output& output, std::uint32_t limb_count)
    {
        const std::size_t components = std::max(component_count(session, output.field), 1u);
        Strided& values = outputs.emplace_back(session.bytes, limb_count, components * sizeof(float), false);
        output_fields.push_back(output.field);
        frame.*output.member = values.out();
        judge(session, output.field, values);
        if (!values.is_null() && (session.features & SWIVEL_COMPACT)) is_valid = false;
    }

    Frame(Session& session, std::uint32_t group)
    {
        const std::uint32_t limb_count = swivel_group_limb_count(session.crowd, group);
        if (session.bytes.one_in(4)) take_origin(session, limb_count);
        const bool doubles = frame.origin.data != nullptr;
        for (const Input& input : kInputs)
            if (is_given(session, input.field)) take_input(session, input, limb_count, doubles);
        for (const Output& output : kOutputs)
            if (!(session.features & SWIVEL_COMPACT) || session.bytes.one_in(64))
                if (is_given(session, output.field)) take_output(session, output, limb_count);
    }

    // Outputs of limbs in these blocks are the crowd's results; others are as they were.
    void check(const Session& session, std::uint32_t group, bool is_solved, std::uint32_t first_block,
               std::uint32_t block_count) const
    {
        const std::uint32_t limb_count = swivel_group_limb_count(session.crowd, group),
                            group_block = swivel_group_first_limb(session.crowd, group) / SWIVEL_LANES;
        for (std::size_t n = 0; n < outputs.size(); ++n) {
            outputs[n].check_gaps(!is_solved);
            if (!is_solved || outputs[n].is_null()) continue;
            std::array<char, 28 * sizeof(float)> result;  // seven twist bones
            for (std::uint32_t limb = 0; limb < limb_count; ++limb) {
                const std::uint32_t block = group_block + limb / SWIVEL_LANES;
                if (block < first_block || block >= first_block + block_count) continue;
                swivel_read(session.crowd, output_fields[n], group, limb, 1, {result.data(), result.size()});
                SWIVEL_REQUIRE(std::memcmp(result.data(), outputs[n].at(limb), outputs[n].value_bytes()) == 0);
            }
        }
    }
};

}  // namespace

void call_solve_frame(Session& session)
{
    const bool whole = session.bytes.one_in(2);
    const std::uint32_t has = swivel_block_count(session.crowd), first_block = whole ? 0 : session.bytes.below(has + 1),
                        block_count = whole ? has : session.bytes.below(has - first_block + 1);
    std::vector<Frame> frames;
    std::vector<swivel_frame> given;
    bool is_valid = true;
    for (std::uint32_t group = 0; group < session.group_count; ++group) {
        given.push_back(frames.emplace_back(session, group).frame);
        const std::uint32_t from = swivel_group_first_limb(session.crowd, group) / SWIVEL_LANES,
                            to = from + (swivel_group_limb_count(session.crowd, group) - 1) / SWIVEL_LANES;
        if (block_count > 0 && from < first_block + block_count && to >= first_block)
            is_valid = is_valid && frames.back().is_valid;  // others are not looked at
    }
    const swivel_status status = whole
                                     ? swivel_solve_frame(session.crowd, given.data())
                                     : swivel_solve_frame_blocks(session.crowd, given.data(), first_block, block_count);
    check_status(session, status, is_valid);
    for (std::uint32_t group = 0; group < session.group_count; ++group)
        frames[group].check(session, group, status == SWIVEL_OK, first_block, block_count);
    if (status != SWIVEL_OK) return;
    std::vector<bool> chosen(session.lane_count());
    for (std::size_t lane = 0; lane < chosen.size(); ++lane)
        chosen[lane] = lane / SWIVEL_LANES >= first_block && lane / SWIVEL_LANES < first_block + block_count;
    check_solved(session, chosen);
}

}  // namespace swivel::fuzz
