// SPDX-License-Identifier: MIT
//
// Calls of the C interface that do not solve: they copy values in and out, ask about limbs, or need no crowd.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "tests/fuzz/interface_session.h"
#include "tests/three_joints.h"

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

template <std::size_t N>
bool is_near_unit(const std::array<float, N>& value, std::size_t first, std::size_t count)
{
    double sum = 0;
    for (std::size_t n = first; n < first + count; ++n) sum += double{value[n]} * double{value[n]};
    return std::abs(sum - 1) < 1e-5;
}

double take_angle(Bytes& bytes) { return bytes.one_in(3) ? bytes.any_double() : 4 * double{bytes.share()}; }

// A helper's outcome: sound values, or the old ones.
template <std::size_t N>
void check_helper(swivel_status status, const std::array<float, N>& value, bool is_sound)
{
    SWIVEL_REQUIRE(status == SWIVEL_OK || status == SWIVEL_INVALID_ARGUMENT);
    std::array<float, N> old;
    old.fill(7);
    SWIVEL_REQUIRE(status == SWIVEL_OK ? is_sound : value == old);
}

void call_limits(Bytes& bytes)
{
    const double min = take_angle(bytes), max = take_angle(bytes);
    const std::array<double, 3> axis = {take_angle(bytes), take_angle(bytes), take_angle(bytes)};
    std::array<float, 4> range, cone;
    std::array<float, 2> flexion;
    std::array<float, 5> aim;
    range.fill(7), cone.fill(7), flexion.fill(7), aim.fill(7);
    const swivel_status ranged = swivel_range(min, max, range.data()),
                        coned = swivel_cone(axis.data(), max, cone.data()),
                        flexed = swivel_flexion(min, max, flexion.data()),
                        aimed = swivel_aim(axis.data(), max, aim.data());
    check_helper(ranged, range, is_near_unit(range, 0, 2) && is_near_unit(range, 2, 2) && range[3] >= 0);
    check_helper(coned, cone, is_near_unit(cone, 0, 3) && std::abs(cone[3]) <= 1);
    check_helper(flexed, flexion, flexion[0] <= 1 && flexion[0] >= flexion[1] && flexion[1] >= 0);
    check_helper(aimed, aim, is_near_unit(aim, 0, 3) && is_near_unit(aim, 3, 2) && aim[3] >= 0 && aim[4] >= 0);
    swivel_cos_sin(min, flexion.data());
    SWIVEL_REQUIRE(!std::isfinite(min) || is_near_unit(flexion, 0, 2));
}

void call_mirror(Bytes& bytes)
{
    const auto field = static_cast<swivel_field>(bytes.below(SWIVEL_RESULT_END + 2));
    const auto order = static_cast<swivel_euler_order>(bytes.below(8));
    std::array<float, 12> value, mirrored;
    for (float& x : value) x = bytes.any_float();
    mirrored = value;
    const swivel_status status = swivel_mirror(field, order, mirrored.data(), mirrored.data());
    SWIVEL_REQUIRE((status == SWIVEL_OK) == (field < SWIVEL_INPUT_END && order <= SWIVEL_ZYX));
    if (status == SWIVEL_OK) swivel_mirror(field, order, mirrored.data(), mirrored.data());
    SWIVEL_REQUIRE(std::memcmp(value.data(), mirrored.data(), sizeof value) == 0);
}

using BindingNumbers = std::array<float, sizeof(swivel_binding) / sizeof(float)>;

swivel_binding untouched_binding()
{
    BindingNumbers numbers;
    numbers.fill(7);
    swivel_binding binding = std::bit_cast<swivel_binding>(numbers);
    binding.size = sizeof binding;
    return binding;
}
void check_binding(swivel_status status, const swivel_binding& bound)
{
    constexpr std::size_t first = offsetof(swivel_binding, parent_from_arm) / sizeof(float),
                          lengths = offsetof(swivel_binding, lengths) / sizeof(float),
                          bones = offsetof(swivel_binding, twist_parent_from_arm) / sizeof(float),
                          end = bones + 2 * 4 * SWIVEL_MAX_TWIST_BONES;
    const auto numbers = std::bit_cast<BindingNumbers>(bound);
    bool is_sound = bound.twist_bone_count <= SWIVEL_MAX_TWIST_BONES;
    for (const float length : bound.lengths) is_sound = is_sound && length > 0 && std::isfinite(length);
    for (std::size_t n = first; n < end; n += 4) {
        if (n == lengths) n = bones;
        is_sound = is_sound && is_near_unit(numbers, n, 4);
    }
    std::array<float, end - first> members;
    std::copy_n(numbers.begin() + first, members.size(), members.begin());
    check_helper(status, members, is_sound);
}

// Joints as they come: what is no limb must be refused, and nothing outside the arrays be read.
void call_bind_joints(Bytes& bytes)
{
    const std::uint32_t count = bytes.below(12);
    const bool any_bits = bytes.one_in(4);
    std::vector<std::int32_t> parents(count);
    for (std::int32_t& parent : parents)
        parent = bytes.one_in(32) ? bytes.take<std::int32_t>() : static_cast<std::int32_t>(bytes.below(count + 1)) - 1;
    std::vector<float> rotations(std::size_t{4} * count), translations(std::size_t{3} * count);
    for (std::vector<float>* const values : {&rotations, &translations})
        for (float& x : *values) x = any_bits ? bytes.any_float() : bytes.share();
    std::vector<std::uint32_t> twist_bones(bytes.below(9));
    for (std::uint32_t& joint : twist_bones) joint = bytes.below(count + 1);
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = count;
    skeleton.parents = {parents.data(), sizeof(std::int32_t)};
    skeleton.translations = {translations.data(), 3 * sizeof(float)};
    if (bytes.one_in(2)) skeleton.rotations = {rotations.data(), 4 * sizeof(float)};
    swivel_limb_joints joints =
        swivel_default_limb_joints(bytes.below(count + 1), bytes.below(count + 1), bytes.below(count + 1));
    joints.twist_bones = twist_bones.data();
    joints.twist_bone_count = static_cast<std::uint32_t>(twist_bones.size());
    for (float& x : joints.bend) x = any_bits ? bytes.any_float() : bytes.share();
    swivel_binding bound = untouched_binding();
    const swivel_status status = swivel_bind_joints(&skeleton, &joints, &bound);
    check_binding(status, bound);
}

// A limb alone, which is one in shape, and then joints as they come.
void call_bind(Bytes& bytes)
{
    test::ThreeJoints limb;
    const bool any_bits = bytes.one_in(3);
    const auto fill = [&](auto& numbers) {
        for (float& x : numbers) x = any_bits ? bytes.any_float() : bytes.share();
    };
    for (auto& rotation : limb.rotations) fill(rotation);
    for (auto* const v : {&limb.translations[1], &limb.translations[2], &limb.bend}) fill(*v);
    const swivel_skeleton skeleton = limb.skeleton();
    swivel_limb_joints joints = limb.joints();
    if (bytes.one_in(4)) joints.size = bytes.take<std::uint8_t>();
    swivel_binding bound = untouched_binding();
    const swivel_status status = swivel_bind_joints(&skeleton, &joints, &bound);
    check_binding(status, bound);
    if (bytes.one_in(2)) call_bind_joints(bytes);
}

// What is saved of all bodies and loaded again is the state that was there.
void check_state(const Session& session)
{
    const std::size_t body_bytes = swivel_state_bytes(session.crowd);
    const std::uint32_t count = swivel_group_limb_count(session.crowd, 0);
    std::vector<std::byte> state(body_bytes * count), again(state.size());
    const std::uint64_t digest = swivel_state_digest(session.crowd);
    const swivel_status status = swivel_save(session.crowd, 0, count, state.data(), state.size());
    SWIVEL_REQUIRE((status == SWIVEL_OK) == (body_bytes > 0));
    if (status != SWIVEL_OK) return;
    SWIVEL_REQUIRE(swivel_load(session.crowd, 0, count, state.data(), state.size()) == SWIVEL_OK);
    SWIVEL_REQUIRE(swivel_save(session.crowd, 0, count, again.data(), again.size()) == SWIVEL_OK);
    SWIVEL_REQUIRE(again == state && swivel_state_digest(session.crowd) == digest);
}

void call_unpack(Bytes& bytes)
{
    const auto stride = 1 + bytes.below(20);
    std::vector<std::uint16_t> words(2 * stride + 1);
    for (std::uint16_t& word : words) word = bytes.take<std::uint16_t>();
    std::array<float, 4> xyzw;
    swivel_unpack_rotation(words.data(), stride, xyzw.data());
    for (const float x : xyzw) SWIVEL_REQUIRE(std::abs(x) <= 1);
    swivel_unpack_half(words[0]);
}

void call_isa(Bytes& bytes)
{
    const char* const name = swivel_isa_at(bytes.below(6));
    if (name && swivel_isa_runs(name)) {
        SWIVEL_REQUIRE(swivel_use_isa(name) == SWIVEL_OK);
        SWIVEL_REQUIRE(swivel_isa_name() == name);
    } else {
        const char* const before = swivel_isa_name();
        SWIVEL_REQUIRE(swivel_use_isa(name) != SWIVEL_OK);
        SWIVEL_REQUIRE(swivel_isa_name() == before);
    }
}

// What a call may take or give: null stands for nothing.
bool is_sound(const Strided& values) { return values.is_null() || values.is_valid(); }

bool are_solved(const Session& session, const Limbs& limbs)
{
    for (std::uint32_t n = 0; limbs.is_valid && n < limbs.count; ++n)
        if (!session.is_solved[limbs.group][limbs.first + n]) return false;
    return limbs.is_valid;
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
        session.bytes.one_in(8) ? SWIVEL_NEXT_TARGET : take_field(session, SWIVEL_SHOULDER_POSITION + 1);
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

void call_reset(Session& session)
{
    if (session.bodies && session.bytes.one_in(2)) return call_change_support(session);
    const Limbs limbs = take_limbs(session);
    check_status(session, swivel_reset(session.crowd, limbs.group, limbs.first, limbs.count), limbs.is_valid);
    const bool has_normals = limbs.is_valid && component_count(session, limbs.group, SWIVEL_NORMAL) > 0;
    for (std::uint32_t n = 0; has_normals && n < limbs.count; ++n)
        session.is_solved[limbs.group][limbs.first + n] = false;  // their normal is none
    for (std::uint32_t n = 0; limbs.is_valid && n < limbs.count; ++n)
        session.is_overwritten[limbs.group][limbs.first + n] = false;
    check_state(session);
}

void call_change_support(Session& session)
{
    const Limbs limbs = take_limbs(session);
    Bytes& bytes = session.bytes;
    const std::size_t count = limbs.is_valid ? limbs.count : 1;
    std::array<Strided, 4> values = {Strided(bytes, count, 24, true), Strided(bytes, count, 16, true),
                                     Strided(bytes, count, 24, true), Strided(bytes, count, 16, true)};
    const bool any_bits = bytes.one_in(8);
    Random random{bytes.take<std::uint16_t>()};
    for (const std::size_t n : {0u, 2u})
        values[n].fill([&](std::size_t, char* at) { put_place(random, any_bits, at); });
    for (const std::size_t n : {1u, 3u})
        values[n].fill([&](std::size_t, char* at) { put_value(random, SWIVEL_HAND, any_bits ? 7 : 0, 4, at); });
    const swivel_status status =
        swivel_change_support(session.crowd, limbs.group, limbs.first, limbs.count, {values[0].in(), values[1].in()},
                              {values[2].in(), values[3].in()});
    const bool may_be = limbs.is_valid && has_features(session, limbs.group, SWIVEL_WITH_PLANT) &&
                        std::ranges::all_of(values, is_sound);
    // Whether numbers of any bits are supports is the library's to say.
    if (!any_bits || !may_be || status != SWIVEL_OK) check_status(session, status, may_be && !any_bits);
    for (std::uint32_t n = 0; status == SWIVEL_OK && any_bits && n < limbs.count; ++n)
        session.is_overwritten[limbs.group][limbs.first + n] = true;
}

void call_allowed_arcs(Session& session)
{
    const Limbs limbs = take_limbs(session);
    const bool is_valid = limbs.is_valid && is_known(session, limbs.group) &&
                          limbs.first < swivel_group_limb_count(session.crowd, limbs.group);
    std::vector<swivel_arc> arcs(session.bytes.below(6));
    std::uint32_t count = ~0u;
    // A range of bad limbs may be bad for its count alone, and this takes none.
    if (!is_valid && is_known(session, limbs.group) && limbs.group < session.group_count &&
        limbs.first < swivel_group_limb_count(session.crowd, limbs.group))
        return;
    const swivel_status status = swivel_allowed_arcs(session.crowd, limbs.group, limbs.first, arcs.data(),
                                                     static_cast<std::uint32_t>(arcs.size()), &count);
    check_status(session, status, is_valid);
    SWIVEL_REQUIRE((status == SWIVEL_OK) == (count != ~0u));
    for (std::size_t n = 0; status == SWIVEL_OK && n < std::min<std::size_t>(count, arcs.size()); ++n)
        for (const auto* end : {&arcs[n].from, &arcs[n].to})
            SWIVEL_REQUIRE(std::abs(std::hypot((*end)[0], (*end)[1]) - 1) < 1e-4f);
}

void call_joint_angles(Session& session)
{
    const Limbs limbs = take_limbs(session);
    const auto shoulder_order = static_cast<swivel_euler_order>(session.bytes.below(7)),
               wrist_order = static_cast<swivel_euler_order>(session.bytes.below(7));
    const int family = static_cast<int>(session.bytes.take<std::uint8_t>() % 8) / 3;
    Strided angles(session.bytes, limbs.is_valid ? limbs.count : 1, 7 * sizeof(double), false);
    const swivel_status status = swivel_joint_angles(session.crowd, limbs.group, limbs.first, limbs.count,
                                                     shoulder_order, wrist_order, family, angles.out());
    check_status(session, status,
                 limbs.is_valid && has_limbs(session, limbs.group) && shoulder_order <= SWIVEL_ZYX &&
                     wrist_order <= SWIVEL_ZYX && family < 2 && angles.is_valid());
    angles.check_gaps(status != SWIVEL_OK);
    if (status != SWIVEL_OK || !are_solved(session, limbs)) return;
    for (std::size_t n = 0; n < limbs.count; ++n) {
        std::array<double, 7> seven;
        std::memcpy(seven.data(), angles.at(n), sizeof seven);
        for (const double angle : seven) SWIVEL_REQUIRE(std::abs(angle) <= 6.2831854);
    }
}

void call_forward(Session& session)
{
    const Limbs limbs = take_limbs(session);
    const std::size_t count = limbs.is_valid ? limbs.count : 1;
    Strided elbow(session.bytes, count, 24, false), wrist(session.bytes, count, 24, false),
        hand(session.bytes, count, 32, false);
    const swivel_status status =
        swivel_forward(session.crowd, limbs.group, limbs.first, limbs.count, elbow.out(), wrist.out(), hand.out());
    check_status(session, status,
                 limbs.is_valid && is_known(session, limbs.group) && is_sound(elbow) && is_sound(wrist) &&
                     is_sound(hand) && (hand.is_null() || has_features(session, limbs.group, SWIVEL_WITH_HAND)));
    for (const Strided* out : {&elbow, &wrist, &hand}) out->check_gaps(status != SWIVEL_OK);
}

void call_residuals(Session& session)
{
    const Limbs limbs = take_limbs(session);
    Strided distance(session.bytes, limbs.is_valid ? limbs.count : 1, sizeof(double), false);
    const swivel_status status = swivel_residuals(session.crowd, limbs.group, limbs.first, limbs.count, distance.out());
    check_status(session, status, limbs.is_valid && is_known(session, limbs.group) && distance.is_valid());
    distance.check_gaps(status != SWIVEL_OK);
}

void call_pack(Session& session)
{
    const std::uint32_t group = session.bytes.below(session.group_count + 1),
                        blocks = (swivel_group_limb_count(session.crowd, group) + SWIVEL_LANES - 1) / SWIVEL_LANES,
                        rows = swivel_packed_row(session.crowd, group, SWIVEL_RESULT_END);
    const swivel_blocks range{session.bytes.below(blocks + 2), session.bytes.below(blocks + 2)};
    const bool is_valid = blocks > 0 && range.first + range.count <= blocks;
    std::vector<std::uint16_t> words(is_valid ? std::size_t{range.count} * rows * SWIVEL_LANES + 1 : 1);
    check_status(session, swivel_pack(session.crowd, group, range, words.data()), is_valid);
    SWIVEL_REQUIRE(words.back() == 0);
}

void call_helper(Session& session)
{
    constexpr std::array helpers = {call_limits, call_mirror, call_bind, call_unpack, call_isa};
    helpers[session.bytes.below(helpers.size())](session.bytes);
}

}  // namespace swivel::fuzz
