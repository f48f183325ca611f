// SPDX-License-Identifier: MIT
#include "batch/explain/posed_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "batch/crowd/streams.h"
#include "core/matrix_frame.h"

namespace swivel {

namespace {

template <class Number, std::size_t Count>
std::array<double, Count> load(const char* from)
{
    Number numbers[Count];
    std::memcpy(numbers, from, sizeof numbers);
    std::array<double, Count> loaded;
    std::copy_n(numbers, Count, loaded.begin());
    return loaded;
}
Vector<double> vector_of(const std::array<double, 3>& v) { return vector(v[0], v[1], v[2]); }

Rotor<double> load_rotation(const char* from, bool w_first, bool is_inverse)
{
    const auto q = load<float, 4>(from);
    const Rotor<double> unit = normalise(w_first ? rotor(q[1], q[2], q[3], q[0]) : rotor(q[0], q[1], q[2], q[3]));
    return is_inverse ? ~unit : unit;
}

const char* value_of(const swivel_in& values, std::uint32_t body)
{
    return static_cast<const char*>(values.data) + std::size_t{body} * values.stride;
}

}  // namespace

const char* PosedBody::value_of(const swivel_joint_values& values, std::uint32_t joint) const
{
    return static_cast<const char*>(values.data) + std::size_t{body} * values.body_stride +
           offset_of(values, skeleton_joint(joint));
}

std::uint32_t PosedBody::steps_up(std::uint32_t joint, std::uint32_t above) const
{
    std::uint32_t steps = 0;
    for (; joint > above; joint = parent(joint)) ++steps;
    return joint == above ? steps : 0;
}

bool PosedBody::may_be_columns(std::uint32_t joint) const
{
    constexpr std::size_t whole = 16 * sizeof(float);
    const swivel_joint_values& values = pose.rotations;
    const std::size_t at = offset_of(values, skeleton_joint(joint));
    if (!values.offsets && values.joint_stride < whole) return false;
    for (std::uint32_t other = 1; other < crowd.joint_count; ++other) {
        const std::size_t start = offset_of(values, skeleton_joint(other));
        if (other != joint && std::max(at, start) - std::min(at, start) < whole) return false;
    }
    const auto m = load<float, 12>(value_of(values, joint));
    if (m[3] != 0 || m[7] != 0 || m[11] != 0) return false;
    const Given given = given_matrix(joint, Reading(pose));
    return len2(given.translation) == 0 || std::isnan(given.scale);
}

Vector<double> PosedBody::rest(std::uint32_t joint) const
{
    const float(&v)[3] = crowd.joints[joint].translation;
    return vector<double>(v[0], v[1], v[2]);
}

bool PosedBody::has_translations(const Reading& how) const
{
    return !how.at_rest && (how.form != SWIVEL_ROTATIONS || pose.translations.data);
}

PosedBody::Given PosedBody::given_matrix(std::uint32_t joint, const Reading& how) const
{
    const char* const from = value_of(pose.rotations, joint);
    const auto column = [&](std::size_t c) {
        std::array<double, 3> v;
        for (std::size_t r = 0; r < 3; ++r) {
            const bool is_turned_over = how.joints_inverse && c < 3;
            const std::size_t at = is_turned_over ? entry_offset(how.form, c, r) : entry_offset(how.form, r, c);
            v[r] = load<float, 1>(from + at)[0];
        }
        return vector_of(v);
    };
    const MatrixFrame<double> frame = matrix_frame(column(0), column(1), column(2));
    return {frame.rotation, how.at_rest ? rest(joint) : column(3),
            !frame.valid   ? std::numeric_limits<double>::quiet_NaN()
            : how.unscaled ? 1
                           : frame.scale};
}

PosedBody::Given PosedBody::given(std::uint32_t joint, const Reading& how) const
{
    if (how.form != SWIVEL_ROTATIONS) return given_matrix(joint, how);
    Given given{load_rotation(value_of(pose.rotations, joint), how.joints_w_first, how.joints_inverse), rest(joint), 1};
    if (has_translations(how)) given.translation = vector_of(load<float, 3>(value_of(pose.translations, joint)));
    if (pose.scales.data && !how.unscaled) {
        const auto scale = load<float, 3>(value_of(pose.scales, joint));
        given.scale = uniform_scale(scale[0], scale[1], scale[2]);
    }
    return given;
}

Vector<double> PosedBody::root_place(const Reading& how) const
{
    if (!pose.root_position.data) return vector(0.0, 0.0, 0.0);
    const char* const from = swivel::value_of(pose.root_position, body);
    const bool is_double = (pose.root_is_double != 0) != how.root_in_other_numbers;
    return vector_of(is_double ? load<double, 3>(from) : load<float, 3>(from));
}
Rotor<double> PosedBody::rotation(std::uint32_t joint, const Reading& how) const
{
    Rotor<double> turn = given(joint, how).rotation;
    while (how.space == SWIVEL_LOCAL && (joint = parent(joint)) != 0) turn = given(joint, how).rotation * turn;
    if (!pose.root_rotation.data) return turn;
    return load_rotation(swivel::value_of(pose.root_rotation, body), how.root_w_first, how.root_inverse) * turn;
}
double PosedBody::rotation_length(std::uint32_t joint) const
{
    if (pose.form != SWIVEL_ROTATIONS) return 1;
    const auto q = load<float, 4>(value_of(pose.rotations, joint));
    return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}
bool PosedBody::may_have_double_root() const
{
    return pose.root_position.stride >= 3 * sizeof(double) && body + 1 < crowd.groups[0].limb_count;
}
double PosedBody::time() const { return pose.time.data ? double{value_at<float>(pose.time, body)} : 0; }

Vector<double> PosedBody::place_along(std::uint32_t joint, const Reading& how) const
{
    Vector<double> place = given(joint, how).translation;
    while ((joint = parent(joint)) != 0) {
        const Given above = given(joint, how);
        place = above.translation + turned(above.rotation, above.scale * place);
    }
    return place;
}

Vector<double> PosedBody::place_in_body(std::uint32_t joint, const Reading& how) const
{
    if (has_translations(how)) return given(joint, how).translation;
    Vector<double> place = vector(0.0, 0.0, 0.0);
    while (joint != 0) {
        const Vector<double> translation = rest(joint);
        joint = parent(joint);
        if (joint == 0) return place + translation;
        const Given above = given(joint, how);
        place = place + turned(above.rotation, above.scale * translation);
    }
    return place;
}

Vector<double> PosedBody::place(std::uint32_t joint, const Reading& how) const
{
    Vector<double> place = how.space == SWIVEL_IN_BODY ? place_in_body(joint, how) : place_along(joint, how);
    const double scale = pose.root_scale.data ? double{value_at<float>(pose.root_scale, body)} : 1;
    for (int n = 0; n < how.root_scale; ++n) place = scale * place;
    if (pose.root_rotation.data) {
        const char* const from = swivel::value_of(pose.root_rotation, body);
        const Rotor<double> turn = load_rotation(from, how.root_w_first, how.root_inverse);
        for (int n = 0; n < how.root_turn; ++n) place = turned(turn, place);
    }
    return place + static_cast<double>(how.root_place) * root_place(how);
}

}  // namespace swivel
