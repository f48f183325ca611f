// SPDX-License-Identifier: MIT
#include "tests/fuzz/interface_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace swivel::fuzz {
namespace {

// The pose's values of joints.
enum Array : std::size_t {
    kRotations,
    kTranslations,
    kScales,
    kResults,
    kTranslationResults,
    kJointRotations,
    kJointPositions
};
constexpr swivel_joint_values swivel_pose::*kArrays[] = {
    &swivel_pose::rotations,      &swivel_pose::translations,        &swivel_pose::scales,
    &swivel_pose::results,        &swivel_pose::translation_results, &swivel_pose::joint_rotations,
    &swivel_pose::joint_positions};

// Its values of bodies, which are like those of a field.
struct Root {
    swivel_in swivel_pose::*member;
    swivel_field likeness;
    std::size_t count;
    bool is_place = false;

    std::size_t number_bytes(const swivel_pose& pose) const
    {
        return is_place && pose.root_is_double ? sizeof(double) : sizeof(float);
    }
};
constexpr Root kRoots[] = {{&swivel_pose::root_position, SWIVEL_TARGET, 3, true},
                           {&swivel_pose::root_rotation, SWIVEL_INCOMING_SHOULDER, 4},
                           {&swivel_pose::root_scale, SWIVEL_PARENT_SCALE, 1},
                           {&swivel_pose::time, SWIVEL_NEXT_TIME, 1},
                           {&swivel_pose::support_position, SWIVEL_TARGET, 3, true},
                           {&swivel_pose::support_rotation, SWIVEL_INCOMING_SHOULDER, 4},
                           {&swivel_pose::weight, SWIVEL_PELVIS_FIT_WEIGHT, 1}};

// Bytes of a rotation or a matrix, as far as a solve may touch them.
std::size_t rotation_bytes(swivel_pose_form form)
{
    return (form == SWIVEL_ROTATIONS ? 4 : form == SWIVEL_MATRIX_COLUMNS ? 15 : 12) * sizeof(float);
}

void make_matrix(Random& random, swivel_pose_form form, std::span<float> value)
{
    std::array<float, 4> q;
    make_value(random, SWIVEL_INCOMING_SHOULDER, 0, q);
    const float scale = 0.5f + std::abs(random.share()),
                s = 2 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] + 1e-9f);
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
            const std::size_t third = 3 - row - column, step = form == SWIVEL_MATRIX_COLUMNS ? 4 : 3,
                              n = form == SWIVEL_MATRIX_ROWS ? 4 * row + column : step * column + row;
            if (column == 3)
                value[n] = random.share();
            else if (row == column)
                value[n] =
                    scale * (1 - s * (q[(row + 1) % 3] * q[(row + 1) % 3] + q[(row + 2) % 3] * q[(row + 2) % 3]));
            else
                value[n] =
                    scale * s * (q[row] * q[column] + ((row + 1) % 3 == column ? -1.0f : 1.0f) * q[third] * q[3]);
        }
}
// As make_value(), of a joint, one in eight of which is as hard as kind says. likeness: a field whose values are alike.
void make_joint_value(Random& random, swivel_field likeness, swivel_pose_form form, std::uint32_t kind,
                      std::span<float> value)
{
    if (random.below(8) != 0) kind = 0;
    if (value.size() >= 12 && kind % 8 < 6) return make_matrix(random, form, value);
    make_value(random, likeness, kind, value);
    if (likeness == SWIVEL_PARENT_SCALE && kind % 8 < 6) std::ranges::fill(value, value[0]);
}

void take(Session& session, std::optional<JointArray>& values, swivel_joint_values& view, std::size_t bytes,
          swivel_field likeness, swivel_pose_form form)
{
    const std::uint32_t kind = session.bytes.take<std::uint8_t>();
    Random random{session.bytes.take<std::uint16_t>()};
    values.emplace(session.bytes, *session.bodies, bytes);
    values->fill([&](char* at) {
        std::array<float, 15> value;
        make_joint_value(random, likeness, form, kind, std::span(value).first(bytes / sizeof(float)));
        std::memcpy(at, value.data(), bytes);
    });
    view = values->view();
}
void take_root(Session& session, std::optional<Strided>& values, swivel_pose& pose, const Root& root)
{
    if (session.bytes.one_in(2)) return;
    const std::uint32_t kind = session.bytes.take<std::uint8_t>();
    const std::size_t each = root.number_bytes(pose);
    Random random{session.bytes.take<std::uint16_t>()};
    values.emplace(session.bytes, session.bodies->body_count, root.count * each, true);
    values->fill([&](std::size_t, char* at) { put_value(random, root.likeness, kind, root.count, at, each, 1e6); });
    pose.*root.member = values->in();
}

bool are_valid(const swivel_joint_values& values, std::size_t bytes, bool may_repeat, std::uint32_t bodies)
{
    if (!values.data) return true;
    const bool is_apart = values.body_stride >= bytes || (values.body_stride == 0 && (may_repeat || bodies == 1));
    return is_apart && (values.offsets || values.joint_stride >= bytes || (values.joint_stride == 0 && may_repeat));
}
bool is_valid_root(const swivel_pose& pose, const Root& root)
{
    const swivel_in& values = pose.*root.member;
    return !values.data || values.stride == 0 || values.stride >= root.count * root.number_bytes(pose);
}

}  // namespace

Pose::Pose(Session& session)
{
    Bytes& bytes = session.bytes;
    constexpr std::size_t three = 3 * sizeof(float), four = 4 * sizeof(float);
    const auto form = static_cast<swivel_pose_form>(bytes.below(SWIVEL_MATRIX_COLUMNS3 + 1));
    given.form = form;
    given.space = bytes.one_in(3) ? SWIVEL_IN_BODY : SWIVEL_LOCAL;
    given.root_is_double = bytes.one_in(3);
    const auto take_in = [&](Array n, std::size_t size, swivel_field likeness) {
        take(session, arrays[n], given.*kArrays[n], size, likeness, form);
    };
    const auto take_out = [&](Array n, std::size_t size) {
        given.*kArrays[n] = arrays[n].emplace(bytes, *session.bodies, size).view();
    };
    take_in(kRotations, rotation_bytes(form), SWIVEL_INCOMING_SHOULDER);
    const bool has_others = form == SWIVEL_ROTATIONS || bytes.one_in(64);
    if (has_others && bytes.one_in(2)) take_in(kTranslations, three, SWIVEL_EFFECTOR);
    if (has_others && bytes.one_in(2)) take_in(kScales, three, SWIVEL_PARENT_SCALE);
    if (bytes.one_in(2)) take_out(kResults, rotation_bytes(form));
    const bool moves = given.space == SWIVEL_IN_BODY && given.translations.data && given.results.data;
    if (moves != bytes.one_in(16)) take_out(kTranslationResults, three);
    if (bytes.one_in(4)) take_out(kJointRotations, four);
    if (bytes.one_in(4)) take_out(kJointPositions, three);
    for (std::size_t n = 0; n < roots.size(); ++n) take_root(session, roots[n], given, kRoots[n]);
    if (bytes.one_in(32)) given.size = bytes.below(sizeof given + 9);
    if (bytes.one_in(64)) given.reserved = bytes.below(9);
    if (bytes.one_in(64)) {  // C lets it be any number
        const std::uint32_t any = SWIVEL_MATRIX_COLUMNS3 + 1 + bytes.below(9);
        bytes.one_in(2) ? std::memcpy(&given.space, &any, sizeof any) : std::memcpy(&given.form, &any, sizeof any);
    }
}

swivel_pose Pose::seen() const
{
    swivel_pose pose = swivel_default_pose();
    std::memcpy(&pose, &given, std::min(given.size, sizeof pose));
    pose.size = sizeof pose;
    return pose;
}

bool Pose::is_valid(const Session& session, const std::vector<bool>& named) const
{
    const swivel_pose pose = seen();
    std::uint32_t form, space;
    std::memcpy(&form, &pose.form, sizeof form);
    std::memcpy(&space, &pose.space, sizeof space);
    const bool is_sized = given.size > 0 && given.size % alignof(swivel_pose) == 0 && given.size <= sizeof given;
    if (!is_sized || form > SWIVEL_MATRIX_COLUMNS3 || space > SWIVEL_IN_BODY || pose.reserved != 0) return false;
    if (!pose.rotations.data) return false;
    if (pose.form != SWIVEL_ROTATIONS && (pose.translations.data || pose.scales.data)) return false;
    const bool moves = pose.space == SWIVEL_IN_BODY && pose.translations.data;
    if (pose.translation_results.data ? !moves : moves && pose.results.data) return false;
    const std::size_t bytes = rotation_bytes(pose.form), three = 3 * sizeof(float), four = 4 * sizeof(float);
    bool needs_time = false;
    for (std::uint32_t group = 0; group < session.group_count; ++group)
        needs_time = needs_time ||
                     (named[group] &&
                      (has_features(session, group, SWIVEL_WITH_PLANT) || is_of(session, group, SWIVEL_KIND_SHIFT) ||
                       (is_of(session, group, SWIVEL_KIND_LOOK) && session.bodies->groups[group].look.rate > 0)));
    const auto are_right = [&](const swivel_joint_values& values, std::size_t size, bool is_written) {
        return are_valid(values, size, !is_written, session.bodies->body_count);
    };
    return are_right(pose.rotations, bytes, !pose.results.data) && are_right(pose.results, bytes, true) &&
           are_right(pose.translations, three, moves && !pose.translation_results.data) &&
           are_right(pose.scales, three, false) && are_right(pose.translation_results, three, true) &&
           are_right(pose.joint_rotations, four, true) && are_right(pose.joint_positions, three, true) &&
           std::ranges::all_of(kRoots, [&](const Root& root) { return is_valid_root(pose, root); }) &&
           (pose.root_position.data || !pose.root_is_double) && (pose.time.data || !needs_time);
}

template <class Take>
void Pose::for_each_written(const Session& session, std::uint32_t group, const Take& take)
{
    const swivel_pose pose = seen();
    const bool in_body = pose.space == SWIVEL_IN_BODY;
    const BodyDef& bodies = *session.bodies;
    for (const std::uint32_t joint : in_body ? bodies.moved_joints(group) : bodies.turned_joints(group)) {
        take(pose.results.data ? kResults : kRotations, joint);
        if (in_body && pose.translations.data)
            take(pose.translation_results.data ? kTranslationResults : kTranslations, joint);
    }
    for (std::uint32_t joint = 0; joint < bodies.joint_count(); ++joint) {
        if (!bodies.is_needed(joint)) continue;
        if (pose.joint_rotations.data) take(kJointRotations, joint);
        if (pose.joint_positions.data) take(kJointPositions, joint);
    }
}

void Pose::check_all() const
{
    for (const std::optional<JointArray>& values : arrays)
        if (values) values->check();
    for (const auto& values : roots)
        if (values) values->check_gaps(false);
}

swivel_pose Pose::of_body(std::uint32_t body, std::array<std::vector<char>, 7>& memory) const
{
    swivel_pose pose = seen();
    for (std::size_t n = 0; n < arrays.size(); ++n) {
        if (!(pose.*kArrays[n]).data) continue;
        memory[n] = arrays[n]->values_of(body);
        pose.*kArrays[n] = {memory[n].data(), memory[n].size(), arrays[n]->value_bytes(), nullptr};
    }
    for (std::size_t n = 0; n < roots.size(); ++n)
        if (swivel_in& values = pose.*kRoots[n].member; values.data) values.data = roots[n]->at(body);
    return pose;
}

void Pose::check_body(Session& session, const SomeLimbs& chosen, std::uint32_t body, bool asks)
{
    std::uint32_t named = 0;
    for (std::uint32_t group = 0; group < session.group_count; ++group)
        if (chosen[group][body]) named |= 1u << group;
    if (named == 0) return;
    swivel_crowd*& alone = session.alone[0];
    if (!alone) {
        const swivel_crowd_def def = session.bodies->crowd_def(1);
        SWIVEL_REQUIRE(swivel_crowd_create(&def, &alone) == SWIVEL_OK);
    }
    for (std::uint32_t group = 0; group < session.group_count; ++group) copy_limb(session, group, body, alone, group);
    std::array<std::vector<char>, 7> memory;
    const swivel_pose pose = of_body(body, memory);
    swivel_job job = swivel_default_job();
    job.groups = &named, job.group_word_count = 1;
    job.pose = &pose;  // ground that was asked for lies in rows by now
    solve_scalar(alone, &job);
    for (std::uint32_t group = 0; group < session.group_count; ++group) {
        if (!chosen[group][body]) continue;
        // Bad input keeps the probe that was asked at, which another ground may have moved.
        const bool has_asked = asks && is_bad(session, group, body);
        check_equal(session, group, body, alone, group, has_asked ? SWIVEL_PROBE : SWIVEL_RESULT_END);
        for_each_written(session, group, [&](Array n, std::uint32_t joint) {
            const char* const value = &memory[n][joint * arrays[n]->value_bytes()];
            arrays[n]->expect(body, joint, is_overwritten(session, group, body) ? nullptr : value);
        });
    }
}

void Pose::check(Session& session, const SomeLimbs& chosen, bool asks)
{
    for (std::uint32_t body = 0; body < session.bodies->body_count; ++body) check_body(session, chosen, body, asks);
    check_all();
}

}  // namespace swivel::fuzz
