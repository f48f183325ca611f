// SPDX-License-Identifier: MIT
//
// Random arms with joint limits, solved by the library's formula, and where their elbows may go: the circle of the
// swivel. The arms and what their limits say are judged in angles (limit_oracle.h).
#pragma once

#include "core/limb.h"
#include "tests/formula_limb.h"
#include "tests/limit_oracle.h"

namespace swivel::test {

struct LimitedArm {
    Arm arm;
    Quaterniond hand;
    LimitUse use;
    Vector3d shoulder_axis, hand_axis, twist_axis;
    double shoulder_cos, hand_cos;
    AngleRange humeral, forearm, hand_twist;
    AngleBox shoulder_box, wrist_box;
};

template <class T>
Range<T> formula_range(const AngleRange& range)
{
    const auto turned = [](double x) { return Turned<T>{static_cast<T>(std::cos(x)), static_cast<T>(std::sin(x))}; };
    Range<T> out{turned(range.middle), turned(range.half)};
    out.half.sin = std::fabs(out.half.sin);
    return out;
}
inline AngleRange rounded_range(const AngleRange& range)
{
    const Range<float> r = formula_range<float>(range);
    return {std::atan2(double{r.middle.sin}, double{r.middle.cos}), std::atan2(double{r.half.sin}, double{r.half.cos})};
}
inline Vector3d rounded(const Vector3d& v) { return v.cast<float>().cast<double>(); }
inline double rounded(double x) { return static_cast<float>(x); }

inline AngleRange random_range(Random& random, double least)
{
    return rounded_range({random.between(-kPi, kPi), random.spread(least, kPi)});
}
inline AngleBox random_box(Random& random, const EulerOrder& order)
{
    AngleBox box{{order.first, order.middle, order.last}, {}};
    const double least = random.below(4) ? 0.1 : 0.004;
    for (AngleRange& range : box.range) range = random_range(random, least);
    if (random.below(2)) box.range[1] = rounded_range({random.between(-0.5, 0.5), random.spread(least, 1)});
    return box;
}

inline LimitedArm random_limited_arm(Random& random)
{
    LimitedArm a;
    const double upper = random.between(0.2, 0.4), fore = upper * random.between(0.6, 1.6);
    const double near = std::fabs(upper - fore), far = upper + fore;
    const Vector3d line = random.direction();
    // One number a line: all compilers then draw them in the same order.
    const double distance = random.between(near + 0.02 * (far - near), far);
    const double along = random.between(-1, 1), aside = random.spread(0.05, 1);
    a.arm = rounded(Arm{distance * line, along * line + aside * random.across(line), upper, fore});
    a.hand = random.rotation();
    a.hand.coeffs() = a.hand.coeffs().cast<float>().cast<double>();
    a.hand.normalize();
    const auto axis = [&] { return rounded(random.direction()); };
    a.shoulder_axis = axis(), a.hand_axis = axis(), a.twist_axis = axis();
    a.shoulder_cos = rounded(random.between(-0.99, 0.99)), a.hand_cos = rounded(random.between(-0.99, 0.95));
    a.humeral = random_range(random, 0.05), a.forearm = random_range(random, 0.05);
    a.hand_twist = random_range(random, 0.05);
    const std::uint32_t kinds = random.word();
    a.use.shoulder_cone = kinds & 1, a.use.humeral_twist = kinds & 2;
    a.use.hand_cone = kinds & 4 && kinds & 8, a.use.forearm_twist = kinds & 16 && kinds & 32;
    a.use.hand_twist = kinds & 64 && kinds & 128, a.use.shoulder_box = kinds & 256 && kinds & 512;
    a.use.wrist_box = kinds & 1024 && kinds & 2048;
    a.use.shoulder_order = kEulerOrders[random.below(6)], a.use.wrist_order = kEulerOrders[random.below(6)];
    a.shoulder_box = random_box(random, a.use.shoulder_order), a.wrist_box = random_box(random, a.use.wrist_order);
    return a;
}

template <class T>
LimbGoal<T> goal_of(const LimitedArm& a)
{
    LimbGoal<T> goal{};
    goal.arm = {mv<T>(a.arm.wrist), mv<T>(a.arm.pole), static_cast<T>(a.arm.upper), static_cast<T>(a.arm.fore)};
    goal.hand = rotor(static_cast<T>(a.hand.x()), static_cast<T>(a.hand.y()), static_cast<T>(a.hand.z()),
                      static_cast<T>(a.hand.w()));
    JointLimits<T>& limits = goal.limits;
    limits.shoulder_cone = {mv<T>(a.shoulder_axis), static_cast<T>(a.shoulder_cos)};
    limits.hand_cone = {mv<T>(a.hand_axis), static_cast<T>(a.hand_cos)};
    limits.humeral_twist = formula_range<T>(a.humeral);
    limits.forearm_twist = formula_range<T>(a.forearm);
    limits.hand_twist = {mv<T>(a.twist_axis), formula_range<T>(a.hand_twist)};
    for (int n = 0; n < 3; ++n) {
        limits.shoulder_box[n] = formula_range<T>(a.shoulder_box.range[n]);
        limits.wrist_box[n] = formula_range<T>(a.wrist_box.range[n]);
    }
    return goal;
}
// wish: what the goal's pole is.
template <class T>
SolvedLimb<T> solve(const LimitedArm& a, const LimbGoal<T>& goal, Wish wish)
{
    LimbUse use;
    use.hand = true;
    use.limits = a.use;
    use.wish = wish;
    return solve_limb<false>(use, goal, Mask<T>(true));
}
template <class T>
SolvedLimb<T> solve(const LimitedArm& a)
{
    return solve(a, goal_of<T>(a), Wish::pole);
}

// The arm at a swivel from the wish, in double, from its elbow's place.
struct ArmAt {
    Quaterniond shoulder, wrist;
};
struct SwivelCircle {
    Vector3d line, wish, across;  // across: a quarter turn on from the wish
    double along, away;           // the upper arm, of length 1, along the line and from it
    Quaterniond elbow, hand;

    explicit SwivelCircle(const LimitedArm& a)
        : line(a.arm.wrist.normalized()), wish(a.arm.normal()), across(line.cross(wish)), hand(a.hand)
    {
        const double d = std::min(a.arm.wrist.norm(), a.arm.length()), upper = a.arm.upper, fore = a.arm.fore;
        along = (d * d + upper * upper - fore * fore) / (2 * d * upper);
        away = std::sqrt(std::max(0.0, 1 - along * along));
        const double cosine = (d * d - upper * upper - fore * fore) / (2 * upper * fore);
        elbow = Quaterniond(Eigen::AngleAxisd(-std::acos(std::clamp(cosine, -1.0, 1.0)), Vector3d::UnitX()));
    }
    // With the elbow as far from the line as floats put it.
    template <class T>
    SwivelCircle(const LimitedArm& a, const SolvedLimb<T>& pose) : SwivelCircle(a)
    {
        elbow = elbow_rotation(pose.arm).normalized();
        const Vector3d wrist = a.arm.upper * Vector3d::UnitZ() + elbow * (a.arm.fore * Vector3d::UnitZ());
        along = wrist.normalized().z();
        away = wrist.normalized().head<2>().norm();
    }
    ArmAt at(double swivel) const
    {
        const Vector3d normal = std::cos(swivel) * wish + std::sin(swivel) * across;
        const Vector3d bone = along * line + away * normal.cross(line);
        Eigen::Matrix3d r;
        r << normal, bone.cross(normal), bone;
        const Quaterniond shoulder(r);
        return {shoulder, (shoulder * elbow).conjugate() * hand};
    }
};

inline double violation(const LimitedArm& a, const ArmAt& at)
{
    double worst = -1;
    const auto broken = [&](double by) { worst = std::max(worst, by); };
    const Vector3d e3 = Vector3d::UnitZ();
    if (a.use.shoulder_cone) broken(cone_violation(a.shoulder_axis, a.shoulder_cos, at.shoulder * e3));
    if (a.use.humeral_twist) broken(twist_violation(e3, a.humeral, at.shoulder));
    if (a.use.shoulder_box) broken(box_violation(a.shoulder_box, at.shoulder.toRotationMatrix()));
    if (a.use.hand_cone) broken(cone_violation(e3, a.hand_cos, at.wrist * a.hand_axis));
    if (a.use.forearm_twist) broken(twist_violation(e3, a.forearm, at.wrist));
    if (a.use.hand_twist) broken(twist_violation(a.twist_axis, a.hand_twist, at.wrist));
    if (a.use.wrist_box) broken(box_violation(a.wrist_box, at.wrist.toRotationMatrix()));
    return worst;
}

template <class T>
double violation(const LimitedArm& a, const SolvedLimb<T>& pose)
{
    return violation(a, {eigen(pose.arm.shoulder).normalized(), eigen(pose.wrist).normalized()});
}
// How far off floats know the elbow's distance from the line: of a straight arm, a root of their digits. The most of 3
// million arms was 2.6e-7.
inline double elbow_error(const SwivelCircle& exact) { return 3e-7 / exact.away; }

// The swivel that a pose took, from the wish, -pi to pi.
template <class T>
double swivel_of(const LimitedArm& a, const SolvedLimb<T>& pose)
{
    const Vector3d line = a.arm.wrist.normalized(), wish = a.arm.normal();
    const Vector3d normal = eigen(pose.arm.shoulder).normalized() * Vector3d::UnitX();
    return std::atan2(wish.cross(normal).dot(line), wish.dot(normal));
}

}  // namespace swivel::test
