// SPDX-License-Identifier: MIT
//
// Calls of the C interface that copy values in and out.
#include <array>
#include <cstring>

#include "tests/fuzz/caller_arrays.h"
#include "tests/fuzz/interface_session.h"

namespace swivel::fuzz {
namespace {

// A field, one in 16 times any that C++ lets the enum hold.
swivel_field take_field(Session& session, std::uint32_t limit)
{
    static_assert(SWIVEL_RESULT_END < 512);  // up to there C++ lets the enumeration have any value
    if (session.bytes.one_in(16)) return static_cast<swivel_field>(session.bytes.below(512));
    return static_cast<swivel_field>(session.bytes.below(limit));
}

swivel_field take_any_field(Session& session)
{
    const swivel_field field = take_field(session, SWIVEL_INPUT_END + SWIVEL_RESULT_END - SWIVEL_SHOULDER + 1);
    if (field < SWIVEL_INPUT_END || field >= SWIVEL_SHOULDER) return field;
    return static_cast<swivel_field>(field - SWIVEL_INPUT_END + SWIVEL_SHOULDER);  // results, too
}

// Bytes of a value; those of a float for a field that the group does not have.
std::size_t value_bytes(const Session& session, std::uint32_t group, swivel_field field)
{
    return sizeof(float) * std::max(component_count(session, group, field), 1u);
}

// The values lie where the header's layout has them.
void require_equal_rows(const Session& session, swivel_field field, const Limbs& limbs, const Strided& values)
{
    const swivel_rows rows = is_carried(field) ? swivel_result_rows(session.crowd, limbs.group)
                                               : swivel_input_rows(session.crowd, limbs.group);
    const std::size_t first_row = swivel_field_first_row(session.crowd, limbs.group, field);
    for (std::size_t n = 0; n < limbs.count; ++n)
        for (std::size_t c = 0; c < values.value_bytes() / sizeof(float); ++c) {
            const float* const at = &number_at(rows, limbs.first + n, first_row + c);
            SWIVEL_REQUIRE(std::memcmp(at, values.at(n) + c * sizeof(float), sizeof(float)) == 0);
        }
}

}  // namespace

void call_write(Session& session)
{
    const swivel_field field = take_any_field(session);
    const Limbs limbs = take_limbs(session);
    const std::uint32_t kind = session.bytes.take<std::uint8_t>();
    Random random{session.bytes.take<std::uint16_t>()};
    Strided values(session.bytes, limbs.is_valid ? limbs.count : 1, value_bytes(session, limbs.group, field), true);
    const bool is_there =
        (field < SWIVEL_SHOULDER || is_carried(field)) && component_count(session, limbs.group, field) > 0;
    if (is_there)
        values.fill(
            [&](std::size_t, char* at) { put_value(random, field, kind, values.value_bytes() / sizeof(float), at); });
    const swivel_status status = swivel_write(session.crowd, field, limbs.group, limbs.first, limbs.count, values.in());
    check_status(session, status, limbs.is_valid && is_there && values.is_valid());
    if (status == SWIVEL_OK) require_equal_rows(session, field, limbs, values);
    for (std::uint32_t n = 0; status == SWIVEL_OK && is_carried(field) && n < limbs.count; ++n)
        session.is_overwritten[limbs.group][limbs.first + n] = true;
}

void call_write_doubles(Session& session)
{
    Bytes& bytes = session.bytes;
    const swivel_field field =
        session.bytes.one_in(8) ? SWIVEL_COMING : take_field(session, SWIVEL_SHOULDER_POSITION + 1);
    const Limbs limbs = take_limbs(session);
    const bool any_bits = bytes.one_in(3), has_origins = bytes.one_in(2);
    Random random{bytes.take<std::uint16_t>()};
    const auto fill = [&](std::size_t, char* at) { put_place(random, any_bits, at); };
    const std::size_t count = limbs.is_valid ? limbs.count : 1, size = 3 * sizeof(double);
    Strided values(bytes, count, size, true), origins(bytes, count, size, true);
    values.fill(fill);
    origins.fill(fill);
    const bool is_given = has_origins && !origins.is_null();
    const swivel_status status =
        swivel_write_doubles(session.crowd, field, limbs.group, limbs.first, limbs.count, values.in(),
                             has_origins ? origins.in() : swivel_in{nullptr, origins.stride()});
    const bool is_there = is_position(field) && component_count(session, limbs.group, field) > 0;
    const bool is_wrong_origin = is_given && (is_direction(session, limbs.group, field) || !origins.is_valid());
    check_status(session, status, limbs.is_valid && is_there && values.is_valid() && !is_wrong_origin);
}

void call_read(Session& session)
{
    const swivel_field field = take_any_field(session);
    const Limbs limbs = take_limbs(session);
    Strided values(session.bytes, limbs.is_valid ? limbs.count : 1, value_bytes(session, limbs.group, field), false);
    const bool is_there = component_count(session, limbs.group, field) > 0;
    const swivel_status status = swivel_read(session.crowd, field, limbs.group, limbs.first, limbs.count, values.out());
    check_status(session, status, limbs.is_valid && is_there && values.is_valid());
    values.check_gaps(status != SWIVEL_OK);
    SWIVEL_REQUIRE(status != SWIVEL_OK || limbs.count == 0 ||
                   std::memcmp(session.arena.data(), session.arena_before.data(), session.arena.size()) == 0);
}

}  // namespace swivel::fuzz
