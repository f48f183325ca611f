// SPDX-License-Identifier: MIT
//
// Random limbs with a parent, and where an arm in its own frame puts elbow, wrist and hand, by Eigen in double. Then
// whole limbs through the public interface: skeletons with nothing aligned, local rotations and where they put the
// wrist, and limits of angles.
#pragma once

#include <array>
#include <catch2/catch.hpp>
#include <cctype>
#include <cmath>
#include <span>
#include <string>

#include "tests/limit_oracle.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

namespace swivel::test {

struct Parent {
    Vector3d position;
    Quaterniond rotation;  // unit
    double scale;
};

// What goes into the rows of one limb, as it was rounded to floats.
struct Limb {
    Float3 target, pole;
    Float2 lengths;
    Float3 position;
    Float4 rotation;
    Float1 scale;
    Float4 hand;

    Parent parent() const { return {vec(position), quat(rotation).normalized(), scale[0]}; }
};

// A limb in reach, bent, its pole well off the line; parent and hand quaternions of any length that is allowed.
inline Limb random_limb(Random& random, swivel_features features, const Float2& lengths)
{
    Limb limb;
    limb.lengths = lengths;
    const bool world = features & SWIVEL_WORLD;
    limb.position = world ? floats(random.vector(0, 5)) : Float3{0, 0, 0};
    const auto any_length = [&] {
        return floats(Quaterniond(random.spread(1.001e-9, 0.999e9) * random.rotation().coeffs()));
    };
    limb.rotation = world ? any_length() : Float4{0, 0, 0, 1};
    limb.scale = {world ? static_cast<float>(random.spread(0.1, 10)) : 1.0f};
    limb.hand = any_length();
    const Parent parent = limb.parent();
    const double far = parent.scale * (double{lengths[0]} + lengths[1]),
                 near = parent.scale * std::fabs(double{lengths[0]} - lengths[1]);
    const Vector3d line = random.direction();
    limb.target = floats(Vector3d(parent.position + (near + (far - near) * random.between(0.05, 0.95)) * line));
    const Vector3d pole = random.between(-1, 1) * line + random.between(0.3, 2) * random.across(line);
    limb.pole = floats(Vector3d(features & SWIVEL_POLE_DIRECTION ? pole : parent.position + parent.scale * pole));
    return limb;
}

inline Vector3d pole_direction(const Limb& limb, swivel_features features)
{
    return features & SWIVEL_POLE_DIRECTION ? vec(limb.pole) : vec(limb.pole) - vec(limb.position);
}

inline void write_limb(Crowd& crowd, std::uint32_t group, std::uint32_t n, const Limb& limb)
{
    put(crowd, SWIVEL_TARGET, n, limb.target, group);
    put(crowd, SWIVEL_POLE, n, limb.pole, group);
    put(crowd, SWIVEL_LENGTHS, n, limb.lengths, group);
    put(crowd, SWIVEL_SHOULDER_POSITION, n, limb.position, group);
    put(crowd, SWIVEL_PARENT_ROTATION, n, limb.rotation, group);
    put(crowd, SWIVEL_PARENT_SCALE, n, limb.scale, group);
    put(crowd, SWIVEL_HAND, n, limb.hand, group);
}

struct Places {
    Vector3d elbow, wrist;
    Quaterniond hand;
};

// An arm in its own frame carried along by its parent.
inline Places places_of(const Limb& limb, const Float4& shoulder, const Float2& elbow, const Float4& wrist)
{
    const Parent parent = limb.parent();
    const Quaterniond q_s = parent.rotation * quat(shoulder).normalized();
    const Quaterniond q_e = Quaterniond(elbow[0], -double{elbow[1]}, 0, 0).normalized();
    const Vector3d elbow_w = parent.position + parent.scale * (q_s * Vector3d(0, 0, limb.lengths[0]));
    return {elbow_w, elbow_w + parent.scale * (q_s * q_e * Vector3d(0, 0, limb.lengths[1])),
            q_s * q_e * quat(wrist).normalized()};
}

// 1.5e-6 arm lengths: the wrist's own 1e-6 and the rounding of the frame's rotor.
inline constexpr double kWristError = 1.5e-6;

inline void check_places(const Limb& limb, swivel_features features, const Places& got, std::uint32_t flags)
{
    const double length = double{limb.scale[0]} * (double{limb.lengths[0]} + limb.lengths[1]);
    CHECK((got.wrist - vec(limb.target)).norm() <= kWristError * length);
    const Vector3d line = (vec(limb.target) - vec(limb.position)).normalized();
    const Vector3d pole = pole_direction(limb, features), across = (pole - pole.dot(line) * line).normalized();
    const Vector3d elbow = got.elbow - vec(limb.position);
    CHECK(elbow.dot(across) > 0);
    CHECK(std::fabs(elbow.dot(line.cross(across))) <= 3e-6 * length);  // in the plane of shoulder, target and pole
    if (features & SWIVEL_WITH_HAND) CHECK(distance(got.hand, quat(limb.hand).normalized()) <= 1e-6);
    CHECK(flags == SWIVEL_REACHED);
}

// tolerance: with skeletons the library goes by the binding's floats, the places here by the skeleton itself.
inline void check_forward(const Crowd& crowd, std::uint32_t group, const std::vector<Limb>& limbs,
                          const std::vector<Places>& places, double tolerance)
{
    const std::size_t count = limbs.size();
    std::vector<std::array<double, 3>> elbows(count), wrists(count);
    std::vector<std::array<double, 4>> hands(count);
    std::vector<double> residuals(count);
    crowd.elbows(group, elbows);
    crowd.wrists(group, wrists);
    crowd.residuals(group, residuals);
    const bool with_hand = swivel_field_row_count(crowd.get(), group, SWIVEL_HAND);
    if (with_hand) crowd.hands(group, hands);
    for (std::size_t n = 0; n < count; ++n) {
        const double length = double{limbs[n].scale[0]} * (double{limbs[n].lengths[0]} + limbs[n].lengths[1]);
        const double size = length + vec(limbs[n].position).norm();
        CHECK((Vector3d(elbows[n].data()) - places[n].elbow).norm() <= tolerance * size);
        CHECK((Vector3d(wrists[n].data()) - places[n].wrist).norm() <= tolerance * size);
        const double residual = (places[n].wrist - vec(limbs[n].target)).norm() / length;
        CHECK(std::fabs(residuals[n] - residual) <= tolerance * size / length);
        if (with_hand) CHECK(distance(Quaterniond(hands[n].data()), places[n].hand) <= tolerance);
    }
}

inline constexpr swivel_features kWorldJointsHand = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND;
// The flag that a limit of the swivel has, by its name; 0 for another field.
inline std::uint32_t flag_of(swivel_field limit)
{
    std::string name = std::string("LIMITED_") + describe(limit).name;
    for (char& c : name) c = static_cast<char>(std::toupper(c));
    for (std::uint32_t flag = 1; flag != 0; flag <<= 1)
        if (const char* const each = swivel_flag_name(flag); each && name == each) return flag;
    return 0;
}

// A skeleton's limb with nothing aligned: random rest rotations, bones and bend.
inline ThreeJoints skewed_joints(Random& random)
{
    ThreeJoints limb;
    const Vector3d upper = random.direction(), hinge = random.across(upper);
    const Quaterniond elbow = random.rotation();
    const Vector3d fore = elbow.conjugate() * (Eigen::AngleAxisd(-random.between(0, 1), hinge) * upper);
    limb.rotations[0] = floats(random.rotation());
    limb.rotations[1] = floats(elbow);
    limb.rotations[2] = floats(random.rotation());
    limb.translations[1] = floats(Vector3d(random.between(0.5, 1) * upper));
    limb.translations[2] = floats(Vector3d(random.between(0.5, 1) * fore));
    limb.bend = floats(Vector3d(upper.cross(hinge)));
    return limb;
}

struct BoundLimb {
    ThreeJoints rest;
    swivel_binding bound = swivel_default_binding();
};
inline BoundLimb bound_limb(Random& random)
{
    const ThreeJoints rest = skewed_joints(random);
    return {rest, rest.bound()};
}

// The local rotations of one limb, and where the skeleton then has its wrist and its hand.
struct LocalPose {
    Quaterniond shoulder, elbow, wrist;

    Vector3d wrist_place(const ThreeJoints& rest, const Parent& parent) const
    {
        const Vector3d fore = shoulder * (vec(rest.translations[1]) + elbow * vec(rest.translations[2]));
        return parent.position + parent.scale * (parent.rotation * fore);
    }
    Quaterniond hand(const Parent& parent) const { return parent.rotation * shoulder * elbow * wrist; }
};
inline LocalPose local_pose(const Crowd& crowd, std::uint32_t n)
{
    Float4 q[3];
    const swivel_field fields[] = {SWIVEL_SHOULDER, SWIVEL_ELBOW, SWIVEL_WRIST};
    for (int f = 0; f < 3; ++f) {
        crowd.read(fields[f], 0, std::span(q + f, 1), n);
        CHECK(is_unit(q[f]));
    }
    return {quat(q[0]).normalized(), quat(q[1]).normalized(), quat(q[2]).normalized()};
}

// What the joints add to rest, in the arm frame.
inline LocalPose added_to_rest(const LocalPose& pose, const swivel_binding& b)
{
    const Quaterniond parent = quat(b.parent_from_arm), upper = quat(b.upper_from_arm), fore = quat(b.fore_from_arm),
                      hand_rest = fore.conjugate() * quat(b.wrist_rest);
    return {(parent.conjugate() * pose.shoulder * upper).normalized(),
            (upper.conjugate() * pose.elbow * fore).normalized(),
            (fore.conjugate() * pose.wrist * hand_rest.conjugate()).normalized()};
}

using Float7 = std::array<float, 7>;
using Float12 = std::array<float, 12>;

inline Float4 range_of(const AngleRange& each) { return range(each.middle - each.half, each.middle + each.half); }
inline Float12 box_of(const AngleBox& box)
{
    Float12 value;
    for (std::size_t n = 0; n < 3; ++n) std::ranges::copy(range_of(box.range[n]), value.begin() + 4 * n);
    return value;
}

// ---- limits of the swivel, in angles

// At rest the bone of a joint lies along the e3 of the arm frame.
enum class LimitShape {
    bone_in_cone,     // about an axis that does not turn with the joint
    axis_in_cone,     // about the bone; the axis turns with the joint
    turn_about_bone,  // a range of angles
    turn_about_axis,  // the same
    box               // three ranges, of Euler angles
};
struct Limit {
    swivel_field field;
    Quaterniond LocalPose::*joint;
    LimitShape shape;
    swivel_features feature = describe(field).needs;
    Vector3d axis = Vector3d::UnitZ();  // unit; that of a turn about the bone stays so
    double opening = kPi;               // of a cone
    AngleBox angles = {};               // a turn's range is the first

    bool is_cone() const { return shape == LimitShape::bone_in_cone || shape == LimitShape::axis_in_cone; }
    bool has_own_axis() const { return is_cone() || shape == LimitShape::turn_about_axis; }
    std::span<AngleRange> ranges()
    {
        const std::size_t count = is_cone() ? 0 : shape == LimitShape::box ? 3 : 1;
        return {angles.range, count};
    }

    // Makes it the limit of the other side of the body. Turns about the mirrored axis e1 keep their sense.
    void mirror()
    {
        axis.x() = -axis.x();
        for (std::size_t n = 0; n < ranges().size(); ++n)
            if (shape != LimitShape::box || angles.axes[n] != 0) angles.range[n].middle = -angles.range[n].middle;
    }
    // How far a pose in the arm frame is outside, in units of a cosine; negative inside.
    double outside(const LocalPose& pose) const
    {
        const Vector3d bone = Vector3d::UnitZ();
        const Quaterniond& q = pose.*joint;
        if (shape == LimitShape::bone_in_cone) return cone_violation(axis, std::cos(opening), q * bone);
        if (shape == LimitShape::axis_in_cone) return cone_violation(bone, std::cos(opening), q * axis);
        if (shape == LimitShape::box) return box_violation(angles, q.toRotationMatrix());
        return twist_violation(axis, angles.range[0], q);
    }
    // Calls take(field, value).
    template <class Take>
    void give(const Take& take) const
    {
        const Float4 about = cone({axis.x(), axis.y(), axis.z()}, opening), turns = range_of(angles.range[0]);
        if (is_cone()) take(field, about);
        if (shape == LimitShape::turn_about_bone) take(field, turns);
        if (shape == LimitShape::turn_about_axis)
            take(field, Float7{about[0], about[1], about[2], turns[0], turns[1], turns[2], turns[3]});
        if (shape == LimitShape::box) take(field, box_of(angles));
    }
};
// All limits of the swivel, wide open, in the order in which LimitedArms draws their features.
inline const auto kOpenLimits = std::to_array<Limit>({
    {SWIVEL_SHOULDER_CONE, &LocalPose::shoulder, LimitShape::bone_in_cone},
    {SWIVEL_HUMERAL_TWIST, &LocalPose::shoulder, LimitShape::turn_about_bone},
    {SWIVEL_HAND_CONE, &LocalPose::wrist, LimitShape::axis_in_cone},
    {SWIVEL_FOREARM_TWIST, &LocalPose::wrist, LimitShape::turn_about_bone},
    {SWIVEL_HAND_TWIST, &LocalPose::wrist, LimitShape::turn_about_axis},
    {SWIVEL_SHOULDER_BOX, &LocalPose::shoulder, LimitShape::box},
    {SWIVEL_WRIST_BOX, &LocalPose::wrist, LimitShape::box},
});
// Those of the upper arm that are no box.
inline constexpr swivel_features kUpperArmLimits = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST;
// The features of all limits, the flexion's too.
inline const swivel_features kLimits = [] {
    swivel_features limits = SWIVEL_WITH_FLEXION_LIMIT;
    for (const Limit& limit : kOpenLimits) limits |= limit.feature;
    return limits;
}();

// A limb's limits, about random axes; at first they are wide open.
struct LimbLimits {
    std::array<Limit, kOpenLimits.size()> each = kOpenLimits;

    explicit LimbLimits(Random& random, swivel_euler_order shoulder_order = SWIVEL_XYZ,
                        swivel_euler_order wrist_order = SWIVEL_XYZ)
    {
        constexpr int axes[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
        for (Limit& limit : each) {
            if (limit.has_own_axis()) limit.axis = random.direction();
            std::ranges::copy(axes[limit.joint == &LocalPose::shoulder ? shoulder_order : wrist_order],
                              limit.angles.axes);
        }
    }
    // Takes each cone's opening from opening(limit), and then each range of the other limits from range(limit).
    template <class Opening, class Range>
    void draw(const Opening& opening, const Range& range)
    {
        for (Limit& limit : each)
            if (limit.is_cone()) limit.opening = opening(limit);
        for (Limit& limit : each)
            for (AngleRange& drawn : limit.ranges()) drawn = range(limit);
    }
};
// Calls put(field, value) for each limit.
template <class Put>
void each_limit(const LimbLimits& limits, const Put& put)
{
    for (const Limit& limit : limits.each) limit.give(put);
}
// How far a pose in the arm frame is outside of the worst of some limits, in units of a cosine; negative inside.
inline double violation_of(const LimbLimits& limits, swivel_features some, const LocalPose& pose)
{
    double worst = -1;
    for (const Limit& limit : limits.each)
        if (some & limit.feature) worst = std::max(worst, limit.outside(pose));
    return worst;
}

}  // namespace swivel::test
