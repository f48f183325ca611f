// SPDX-License-Identifier: MIT
#include "tests/fuzz/interface_session.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace swivel::fuzz {
namespace {

// Whether a field is listed: mostly not one that the group does not have.
bool is_given(Session& session, std::uint32_t group, swivel_field field)
{
    return session.bytes.one_in(component_count(session, group, field) > 0 ? 2 : 64);
}

}  // namespace

JobStreams::JobStreams(Session& session, std::uint32_t group, const Strided* of_bodies) : root(of_bodies)
{
    const bool has_origin = session.bytes.one_in(4);
    if (has_origin && !session.bodies) take_origin(session, swivel_group_limb_count(session.crowd, group));
    if (has_origin && root) origin = root->in();
    swivel_field_info info;
    for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n) {
        const bool is_input = info.kind == SWIVEL_FIELD_INPUT;
        if (!is_given(session, group, info.field)) continue;
        is_input ? take_input(session, group, info.field) : take_output(session, group, info.field);
    }
    for (std::size_t n = fields.size(); n > 1; --n)  // in any order
        std::swap(fields[n - 1], fields[session.bytes.below(static_cast<std::uint32_t>(n))]);
    if (!fields.empty() && session.bytes.one_in(64)) {
        fields.push_back(fields[session.bytes.below(static_cast<std::uint32_t>(fields.size()))]);
        if (fields.back().data) is_valid = false;  // twice; null is not given
    }
}

swivel_streams JobStreams::view() const
{
    swivel_streams frame = swivel_default_streams();
    frame.fields = fields.data();
    frame.field_count = static_cast<std::uint32_t>(fields.size());
    frame.origin = origin;
    return frame;
}

// Null data is a field that is not given.
void JobStreams::add(const Session& session, std::uint32_t group, swivel_field field, const Strided& values)
{
    fields.push_back({field, values.data(), values.stride()});
    const bool is_wrong = component_count(session, group, field) == 0 || !values.is_valid();
    if (!values.is_null() && is_wrong) is_valid = false;
}

void JobStreams::take_input(Session& session, std::uint32_t group, swivel_field field)
{
    const std::size_t each = (origin.data || root) && is_position(field) ? sizeof(double) : sizeof(float),
                      components = std::max(component_count(session, group, field), 1u);
    const std::uint32_t kind = session.bytes.take<std::uint8_t>();
    Random random{session.bytes.take<std::uint16_t>()};
    Strided& values =
        inputs.emplace_back(session.bytes, swivel_group_limb_count(session.crowd, group), components * each, true);
    input_fields.push_back(field);
    values.fill([&](std::size_t, char* at) { put_value(random, field, kind, components, at, each); });
    add(session, group, field, values);
}

void JobStreams::take_origin(Session& session, std::uint32_t limb_count)
{
    Strided& values = inputs.emplace_back(session.bytes, limb_count, 3 * sizeof(double), true);
    input_fields.push_back(SWIVEL_INPUT_END);  // none
    values.fill([&](std::size_t, char* at) { std::memset(at, 0, 3 * sizeof(double)); });
    origin = values.in();
    if (!values.is_null() && !values.is_valid()) is_valid = false;
}

void JobStreams::take_output(Session& session, std::uint32_t group, swivel_field field)
{
    const std::size_t components = std::max(component_count(session, group, field), 1u);
    Strided& values = outputs.emplace_back(session.bytes, swivel_group_limb_count(session.crowd, group),
                                           components * sizeof(float), false);
    output_fields.push_back(field);
    add(session, group, field, values);
}

// What is subtracted from a position. Origins of free limbs are zeros, and directions have none.
double JobStreams::from(const Session& session, std::uint32_t group, swivel_field field, std::uint32_t limb,
                        std::size_t c) const
{
    double place = 0;
    if (root && !is_direction(session, group, field))
        std::memcpy(&place, root->at(limb) + c * sizeof place, sizeof place);
    return place;
}

void JobStreams::check_inputs(const Session& session, std::uint32_t group, std::uint32_t limb, bool asks) const
{
    const swivel_rows rows = swivel_input_rows(session.crowd, group);
    for (std::size_t n = 0; n < inputs.size(); ++n) {
        if (input_fields[n] == SWIVEL_INPUT_END || inputs[n].is_null()) continue;
        const bool is_ground = input_fields[n] == SWIVEL_GROUND || input_fields[n] == SWIVEL_GROUND_NORMAL;
        if (is_ground && asks) continue;  // it may be another by now
        const std::uint32_t components = component_count(session, group, input_fields[n]),
                            first_row = swivel_field_first_row(session.crowd, group, input_fields[n]);
        const bool is_wide = inputs[n].value_bytes() == components * sizeof(double);
        for (std::uint32_t c = 0; c < components; ++c) {
            float wanted;
            double wide;
            if (is_wide) std::memcpy(&wide, inputs[n].at(limb) + c * sizeof wide, sizeof wide);
            std::memcpy(&wanted, inputs[n].at(limb) + c * sizeof wanted, sizeof wanted);
            if (is_wide) wanted = static_cast<float>(wide - from(session, group, input_fields[n], limb, c));
            const float got = number_at(rows, limb, first_row + c);
            SWIVEL_REQUIRE(std::memcmp(&got, &wanted, sizeof got) == 0 || (is_wide && wanted != wanted && got != got));
        }
    }
}

void JobStreams::check(const Session& session, std::uint32_t group, const std::vector<bool>& chosen, bool asks) const
{
    const auto limb_count = static_cast<std::uint32_t>(chosen.size());
    const bool is_untouched = std::find(chosen.begin(), chosen.end(), true) == chosen.end();
    for (std::uint32_t limb = 0; limb < limb_count; ++limb)
        if (chosen[limb]) check_inputs(session, group, limb, asks);
    for (std::size_t n = 0; n < outputs.size(); ++n) {
        outputs[n].check_gaps(is_untouched);
        if (is_untouched || outputs[n].is_null()) continue;
        std::array<char, 28 * sizeof(float)> result;  // seven twist bones
        for (std::uint32_t limb = 0; limb < limb_count; ++limb) {
            if (chosen[limb] && (output_fields[n] == SWIVEL_FLAGS || !is_kept(session, group, limb)))
                swivel_read(session.crowd, output_fields[n], group, limb, 1, {result.data(), result.size()});
            else
                result.fill(Strided::kPattern);
            SWIVEL_REQUIRE(std::memcmp(result.data(), outputs[n].at(limb), outputs[n].value_bytes()) == 0);
        }
    }
}

}  // namespace swivel::fuzz
