// SPDX-License-Identifier: MIT
#include "tests/fuzz/interface_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace swivel::fuzz {
namespace {

constexpr std::uint32_t kFlags = (2 * SWIVEL_CUT - 1) | SWIVEL_LIMITED_REGION;  // of limbs
constexpr std::size_t kMaxComponents = 28;                                      // of seven twist bones

double length_of(const float* v, std::size_t count)
{
    double sum = 0;
    for (std::size_t n = 0; n < count; ++n) sum += double{v[n]} * double{v[n]};
    return std::sqrt(sum);
}
bool is_unit(const float* v, std::size_t count, double slack) { return std::abs(length_of(v, count) - 1) <= slack; }

// w >= 0, and at w = 0 the first of x, y, z that is not zero is positive.
bool is_on_its_side(const float* q)
{
    if (q[3] != 0) return q[3] > 0;
    for (int n = 0; n < 3; ++n)
        if (q[n] != 0) return q[n] > 0;
    return false;
}

// A lane has the bits that it had before the call at hand.
void require_untouched(const Session& session, const swivel_rows& rows, std::size_t lane)
{
    for (std::size_t row = 0; row < rows.row_count; ++row) {
        const float& now = number_at(rows, lane, row);
        SWIVEL_REQUIRE(std::memcmp(&now, session.before(&now), sizeof now) == 0);
    }
}
// Where a field's rows begin and end.
std::array<std::size_t, 2> rows_of_field(const Session& session, std::uint32_t group, swivel_field field)
{
    const std::size_t first = swivel_field_first_row(session.crowd, group, field);
    return {first, first + swivel_field_row_count(session.crowd, group, field)};
}

struct Reader {
    const Session& session;
    std::uint32_t group, limb;
    std::array<float, kMaxComponents> value{};

    // The components; 0 where the group has no such field.
    std::uint32_t read(swivel_field field)
    {
        const std::uint32_t count = component_count(session, group, field);
        if (count > 0)
            SWIVEL_REQUIRE(swivel_read(session.crowd, field, group, limb, 1, {value.data(), sizeof value}) ==
                           SWIVEL_OK);
        return count;
    }
    void check_quaternions(swivel_field field, bool any_side)
    {
        const std::uint32_t count = read(field);
        for (std::uint32_t n = 0; n < count; n += 4) {
            SWIVEL_REQUIRE(is_unit(value.data() + n, 4, 1e-6));
            SWIVEL_REQUIRE(any_side || is_on_its_side(value.data() + n));
        }
    }
};

void check_rotations(Reader& reader)
{
    const swivel_features features = swivel_group_features(reader.session.crowd, reader.group);
    const bool follows_incoming = reader.session.bodies || features & SWIVEL_WITH_INCOMING;
    reader.check_quaternions(SWIVEL_SHOULDER, follows_incoming);
    reader.check_quaternions(SWIVEL_WRIST, follows_incoming);
    reader.check_quaternions(SWIVEL_TWIST_BONES, follows_incoming);
    reader.check_quaternions(SWIVEL_CLAVICLE_ROTATION, follows_incoming);
    if (features & SWIVEL_JOINTS) return reader.check_quaternions(SWIVEL_ELBOW, follows_incoming);
    reader.read(SWIVEL_ELBOW);
    SWIVEL_REQUIRE(reader.value[0] >= 0 && reader.value[1] >= 0);
    SWIVEL_REQUIRE(is_unit(reader.value.data(), 2, 1e-6));
}

// What stands, and what it stands with: numbers, and a state that there is.
void check_plant(Reader& reader)
{
    for (const swivel_field field :
         {SWIVEL_PLANT_ROTATION, SWIVEL_CONTACT_STATE, SWIVEL_SHIFT, SWIVEL_LIFT, SWIVEL_PLANT}) {
        const std::uint32_t count = reader.read(field);
        for (std::uint32_t n = 0; n < count; ++n) SWIVEL_REQUIRE(std::isfinite(reader.value[n]));
    }
    if (component_count(reader.session, reader.group, SWIVEL_PLANT) == 0) return;
    const float state = reader.value[10], left = reader.value[9];
    SWIVEL_REQUIRE(state == 0 || (state >= 8 && state < 16 && state == std::floor(state)));
    SWIVEL_REQUIRE(left >= 0);
    if (state != 0 && reader.read(SWIVEL_PLANT_ROTATION) > 0) SWIVEL_REQUIRE(is_unit(reader.value.data(), 4, 1e-5));
}

// Whether a limb is so long that its hand may be further away than any place.
bool is_endless(Reader& reader) { return reader.read(SWIVEL_LENGTHS) > 0 && reader.value[0] + reader.value[1] > 1e13f; }
// A place and a rotation. All of it may be NaN where the limb's input is bad, or it has no place.
void check_streams(Reader& reader, swivel_field field, bool is_bad)
{
    if (reader.read(field) == 0) return;
    bool is_none = true;
    for (std::size_t n = 0; n < 7; ++n) is_none = is_none && std::isnan(reader.value[n]);
    if (is_none && is_bad) return;
    for (std::size_t n = 0; n < 3; ++n) SWIVEL_REQUIRE(std::isfinite(reader.value[n]));
    SWIVEL_REQUIRE(is_unit(reader.value.data() + 3, 4, 1e-6) && is_on_its_side(reader.value.data() + 3));
}

void check_sight(const Session& session, std::uint32_t group, std::uint32_t limb, std::uint32_t flags)
{
    constexpr std::uint32_t kOfLooks = SWIVEL_REACHED | SWIVEL_LIMITED_LOOK | SWIVEL_LIMITED_STEP | SWIVEL_FADED;
    SWIVEL_REQUIRE((flags & ~kOfLooks) == 0 || flags == SWIVEL_BAD_INPUT);
    if (flags == SWIVEL_BAD_INPUT) return;
    Reader reader{session, group, limb};
    reader.read(SWIVEL_SIGHT);
    for (std::size_t n = 0; n < 3; ++n) SWIVEL_REQUIRE(std::isfinite(reader.value[n]));
    SWIVEL_REQUIRE(is_unit(reader.value.data() + 3, 3, 1e-5));
    reader.read(SWIVEL_LOOK_TURNS);
    SWIVEL_REQUIRE(reader.value[0] == 1);
    for (std::size_t n = 1; n < 25; n += 3)
        SWIVEL_REQUIRE(std::hypot(reader.value[n], reader.value[n + 1], reader.value[n + 2]) <= 1 + 1e-5);
}

void check_places(const Session& session, std::uint32_t group, std::uint32_t limb)
{
    std::array<double, 11> places{};
    const swivel_out hand = {has_features(session, group, SWIVEL_WITH_HAND) ? places.data() + 6 : nullptr, 32};
    SWIVEL_REQUIRE(swivel_forward(session.crowd, group, limb, 1, {places.data(), 24}, {places.data() + 3, 24}, hand) ==
                   SWIVEL_OK);
    SWIVEL_REQUIRE(swivel_residuals(session.crowd, group, limb, 1, {places.data() + 10, 8}) == SWIVEL_OK);
    for (const double each : places) SWIVEL_REQUIRE(std::isfinite(each));
}

}  // namespace

void check_results(const Session& session, std::uint32_t group, std::uint32_t limb)
{
    Reader reader{session, group, limb};
    reader.read(SWIVEL_FLAGS);
    std::uint32_t flags = 0;
    std::memcpy(&flags, reader.value.data(), sizeof flags);
    if (is_of(session, group, SWIVEL_KIND_LOOK)) return check_sight(session, group, limb, flags);
    SWIVEL_REQUIRE((flags & ~kFlags) == 0 || flags == SWIVEL_BAD_INPUT);
    check_plant(reader);
    check_streams(reader, SWIVEL_PROP_TRANSFORM, false);
    check_streams(reader, SWIVEL_HAND_TRANSFORM, flags == SWIVEL_BAD_INPUT || is_endless(reader));
    if (!has_limbs(session, group))
        return SWIVEL_REQUIRE(flags == SWIVEL_REACHED || flags == SWIVEL_CLAMPED_FAR || flags == SWIVEL_CLAMPED_NEAR ||
                              flags == SWIVEL_BAD_INPUT);
    check_rotations(reader);
    if (reader.read(SWIVEL_STRETCH) > 0) SWIVEL_REQUIRE(reader.value[0] >= 1 && reader.value[0] <= 1000);
    if (reader.read(SWIVEL_NORMAL) > 0) {
        const bool is_clear = length_of(reader.value.data(), 3) == 0, is_normal = is_unit(reader.value.data(), 3, 1e-6);
        SWIVEL_REQUIRE(is_kept(session, group, limb) ? is_clear || is_normal
                       : flags == SWIVEL_BAD_INPUT   ? is_clear
                                                     : is_normal);
    }
    if (flags != SWIVEL_BAD_INPUT && is_known(session, group)) check_places(session, group, limb);
}

void check_alone(Session& session, std::uint32_t group, std::uint32_t limb)
{
    swivel_crowd*& alone = session.alone[group];
    if (!alone) {
        swivel_limb_def limb_def = session.limb_defs[group];
        limb_def.limb_count = 1;
        swivel_group_def def = swivel_default_group_def();
        def.limb = &limb_def;
        swivel_crowd_def of_one = swivel_default_crowd_def();
        of_one.groups = &def;
        of_one.group_count = 1;
        SWIVEL_REQUIRE(swivel_crowd_create(&of_one, &alone) == SWIVEL_OK);
    }
    copy_limb(session, group, limb, alone, 0);
    solve_scalar(alone, nullptr);
    check_equal(session, group, limb, alone, 0);
}

void copy_limb(const Session& session, std::uint32_t group, std::uint32_t limb, swivel_crowd* alone, std::uint32_t to)
{
    const swivel_rows inputs = swivel_input_rows(session.crowd, group),
                      results = swivel_result_rows(session.crowd, group), put = swivel_input_rows(alone, to),
                      got = swivel_result_rows(alone, to);
    for (std::size_t row = 0; row < put.row_count; ++row)
        std::memcpy(&number_at(put, 0, row), &number_at(inputs, limb, row), sizeof(float));
    for (std::size_t row = 0; row < got.row_count; ++row)
        std::memcpy(&number_at(got, 0, row), session.before(&number_at(results, limb, row)), sizeof(float));
}

void solve_scalar(swivel_crowd* alone, const swivel_job* job)
{
    const char* const isa = swivel_isa_name();
    SWIVEL_REQUIRE(swivel_use_isa("scalar") == SWIVEL_OK);
    SWIVEL_REQUIRE(swivel_solve(alone, job) == SWIVEL_OK);
    SWIVEL_REQUIRE(swivel_use_isa(isa) == SWIVEL_OK);
}

void check_equal(const Session& session, std::uint32_t group, std::uint32_t limb, swivel_crowd* alone, std::uint32_t to,
                 swivel_field except)
{
    if (is_overwritten(session, group, limb)) return;
    const swivel_rows results = swivel_result_rows(session.crowd, group), got = swivel_result_rows(alone, to);
    const auto [first, end] = rows_of_field(session, group, except);
    for (std::size_t row = 0; row < got.row_count; ++row)
        if (row < first || row >= end)
            SWIVEL_REQUIRE(std::memcmp(&number_at(got, 0, row), &number_at(results, limb, row), sizeof(float)) == 0);
}

void check_others(const Session& session, const SomeLimbs& chosen)
{
    for (std::uint32_t group = 0; group < session.group_count; ++group) {
        const std::size_t limb_count = chosen[group].size();
        const auto is_chosen = [&](std::size_t limb) -> bool { return chosen[group][limb]; };
        for (std::size_t first = 0; first < limb_count; first += SWIVEL_LANES) {
            const std::size_t end = std::min(first + SWIVEL_LANES, limb_count);
            bool is_untouched = true;
            for (std::size_t limb = first; limb < end; ++limb) is_untouched = is_untouched && !is_chosen(limb);
            for (std::size_t lane = first; lane < first + SWIVEL_LANES; ++lane) {
                if (!is_untouched && (lane >= end || is_chosen(lane))) continue;
                for (const swivel_rows& rows :
                     {swivel_input_rows(session.crowd, group), swivel_result_rows(session.crowd, group)})
                    require_untouched(session, rows, lane);
            }
        }
    }
}

}  // namespace swivel::fuzz
