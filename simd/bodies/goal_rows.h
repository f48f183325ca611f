// SPDX-License-Identifier: MIT
//
// Shared by the stages that compute the goal of a body's limb (plant, link): its frame, where it is animated, and the
// rows in which their results wait.
#pragma once

#include "core/ground.h"
#include "core/limb_bones.h"
#include "core/spring.h"
#include "simd/limbs/goal_stages.h"

namespace swivel::inline SWIVEL_ISA {

// The results of a limb that wait until all of its input is known to be good, among the rows of its goal.
inline constexpr swivel_field kWaitingResults[] = {SWIVEL_PLANT,       SWIVEL_PLANT_ROTATION, SWIVEL_CONTACT_STATE,
                                                   SWIVEL_SOLVED_GOAL, SWIVEL_PROBE,          SWIVEL_LIFT};
constexpr std::uint32_t waiting_row(swivel_field field)
{
    std::uint32_t row = kGoalResultsRow;
    for (const swivel_field each : kWaitingResults) {
        if (each == field) break;
        row += row_of(each).component_count;
    }
    return row;
}
static_assert(waiting_row(SWIVEL_RESULT_END) == kGoalRows);
// Lets a value of such a result wait, from one of its components on.
template <class S, class Value>
SWIVEL_INLINE void hold_back(const S& s, swivel_field field, std::uint32_t component, const Value& value)
{
    s.body.set(s.strip.run.plan->limb.goal + waiting_row(field) + component, value);
}

// A body's axis of heights and shifts, in the world.
template <class S>
SWIVEL_INLINE Vector<typename S::T> up_of(const S& s)
{
    using T = typename S::T;
    const float(&up)[3] = s.strip.run.plan->up;
    return turned(s.body.rotor(kRootJoint + kTurnRow), vector(T(up[0]), T(up[1]), T(up[2])));
}

// The ground below a foot.
template <class S>
SWIVEL_INLINE GroundPlane<typename S::T> ground_of(const S& s, const Vector<typename S::T>& up)
{
    using T = typename S::T;
    const Vector<T> normal = s.io.load_vector(SWIVEL_GROUND_NORMAL);
    s.require(is_within(len2(normal), 1e-18, 1e18));
    return ground_plane(s.io.load_vector(SWIVEL_GROUND) - s.body.vector(kRootRow), normal, up);
}

// The frame that planted points are carried in, as the body's root sees it.
template <class T>
struct SupportFrame {
    bool is_turned;  // of no body, if the pose has no rotations of supports
    Rotor<T> rotation;
    Vector<T> root;  // the root's place from the support's, along the world's axes

    template <class S>
    SWIVEL_INLINE static SupportFrame of(const S& s)
    {
        const bool is_turned = s.strip.run.strip.pose->support_rotation.data != nullptr;
        return {is_turned, is_turned ? s.body.rotor(kSupportRow) : one<T>(), s.body.vector(kRootFromSupportRow)};
    }
    SWIVEL_INLINE Vector<T> from_root(const Vector<T>& place) const
    {
        return is_turned ? turned(~rotation, place + root) : place + root;
    }
    SWIVEL_INLINE Vector<T> turned_back(const Vector<T>& v) const { return is_turned ? turned(~rotation, v) : v; }
    SWIVEL_INLINE Vector<T> to_root(const Vector<T>& place) const
    {
        return (is_turned ? turned(rotation, place) : place) - root;
    }
};

// The rotation in the world that the caller wants a limb's hand to have, of any length. Where it is NaN, as it starts,
// the hand keeps the incoming one.
template <class T>
struct WantedHand {
    Rotor<T> rotation;
    Mask<T> is_written;
};
template <class S>
SWIVEL_INLINE WantedHand<typename S::T> wanted_hand(const S& s)
{
    using T = typename S::T;
    const Rotor<T> hand = s.io.load_rotor(SWIVEL_HAND);
    const T length2 = len2(hand);
    const Mask<T> is_written = length2 == length2;
    return {select(is_written, hand, s.body.rotor(s.strip.run.plan->limb.wrist + kTurnRow)), is_written};
}

// Where a limb's point is as animated, from the root's place, and the hand's rotation. Values that the caller has
// written replace the pose's.
template <class T>
struct AnimatedHand {
    Vector<T> point;
    Rotor<T> rotation;
    Mask<T> is_posed;  // nothing was written
};
template <class S>
SWIVEL_INLINE AnimatedHand<typename S::T> animated_hand(const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    AnimatedHand<T> animated{s.body.vector(limb.wrist + kPlaceRow), s.body.rotor(limb.wrist + kTurnRow),
                             all_lanes<T>()};
    if (s.has(SWIVEL_WITH_EFFECTOR))
        animated.point = animated.point + s.body.get(limb.parent + kScaleRow) *
                                              turned(animated.rotation, s.io.load_vector(SWIVEL_EFFECTOR));
    const Vector<T> target = s.io.load_vector(SWIVEL_TARGET);
    const T distance2 = len2(target);
    if (const Mask<T> is_given = distance2 == distance2; any(is_given)) {
        animated.point = select(is_given, target - s.body.vector(kRootRow), animated.point);
        animated.is_posed = !is_given;
    }
    if (s.has(SWIVEL_WITH_HAND)) {
        const WantedHand<T> hand = wanted_hand(s);
        if (any(hand.is_written)) {
            s.require(is_orientation(hand.rotation) | !hand.is_written);
            animated.rotation = select(hand.is_written, normalise(hand.rotation), animated.rotation);
            animated.is_posed = animated.is_posed & !hand.is_written;
        }
    }
    return animated;
}

// Gives a limb its goal, from the root's place as kGoalPlaceRow has it. Bad input makes it NaN, which the limb finds.
template <class S>
SWIVEL_INLINE void set_goal(const S& s, const Vector<typename S::T>& place, const Rotor<typename S::T>& hand)
{
    using T = typename S::T;
    const std::uint32_t goal = s.strip.run.plan->limb.goal;
    s.body.set(goal + kGoalPlaceRow, or_nan(lanes_where<T>(s.good()), place));
    s.body.set(goal + kGoalHandRow, hand);
    if (!s.has(SWIVEL_WITH_RECORD)) return;
    hold_back(s, SWIVEL_SOLVED_GOAL, 0, place + s.body.vector(kRootRow));
    hold_back(s, SWIVEL_SOLVED_GOAL, 3, hand);
}

// A height that a spring eases towards a goal. It carries where it is, its rate, and 1 once it has begun. It begins at
// the goal, and anew where that is asked for.
template <class T>
struct EasedHeight {
    T at, rate;
    T before;  // before this step; 0 where it had not begun
};
template <class S>
SWIVEL_INLINE EasedHeight<typename S::T> eased(const S& s, swivel_field carried, const typename S::T& goal,
                                               const Mask<typename S::T>& anew, const SpringRule& rule)
{
    using T = typename S::T;
    const T time = s.body.get(kTimeRow);
    const Spring<T> previous{s.io.load(carried, 0), s.io.load(carried, 1)};
    const Mask<T> is_number = (previous.at == previous.at) & (previous.rate == previous.rate), stands = time == T(0),
                  begun = (s.io.load(carried, 2) > T(0.5)) & is_number & !anew;
    const Spring<T> next = sprung(previous, goal, time, rule);
    const EasedHeight<T> height{select(begun, select(stands, previous.at, next.at), goal),
                                select(begun, select(stands, previous.rate, next.rate), T(0)),
                                select(begun, previous.at, T(0))};
    s.require(is_within(height.at, -kHuge, kHuge) & (height.rate == height.rate));
    return height;
}
// The normal that a foot turns with, of any length but 0. A spring eases it towards `goal`. A planted foot takes its
// goal at once, and so does one where `fresh` holds or nothing usable is carried. Where time stands still no bit
// changes.
template <class S>
SWIVEL_INLINE Spring<Vector<typename S::T>> eased_normal(const S& s, const Vector<typename S::T>& goal,
                                                         const Vector<typename S::T>& up,
                                                         const Mask<typename S::T>& fresh,
                                                         const Mask<typename S::T>& planted, const SpringRule& rule)
{
    using T = typename S::T;
    const T time = s.body.get(kTimeRow);
    const Spring<Vector<T>> carried{s.io.load_vector(SWIVEL_LIFT, kSlope), s.io.load_vector(SWIVEL_LIFT, kSlopeRate)};
    const Spring<Vector<T>> next = sprung(carried, goal, time, rule);
    const Mask<T> usable = (scalar_product(carried.at, up) > T(1e-3)) & (len2(carried.at) <= T(1e6)) &
                           (len2(carried.rate) <= T(kHuge2)) & !fresh,
                  stays = usable & (time == T(0)), eases = usable & !planted & !stays;
    const Vector<T> none = vector(T(0), T(0), T(0));
    return {select(stays, carried.at, select(eases, next.at, goal)),
            select(stays, carried.rate, select(eases, next.rate, none))};
}

// How far a limb's wrist gets from its shoulder, and from where on it is eased before that; and how near it gets.
template <class T>
struct LimbReach {
    T far, exact, near;
};
template <class S>
SWIVEL_INLINE LimbReach<typename S::T> limb_reach(const S& s)
{
    using T = typename S::T;
    const BodyLimb& limb = s.strip.run.plan->limb;
    const T scale = s.body.get(limb.parent + kScaleRow);
    const Vector<T> shoulder = s.body.vector(limb.shoulder + kPlaceRow), elbow = s.body.vector(limb.elbow + kPlaceRow),
                    wrist = s.body.vector(limb.wrist + kPlaceRow);
    const auto length = [&](int bone, const Vector<T>& posed) SWIVEL_INLINE_LAMBDA {
        const T given = s.io.load(SWIVEL_LENGTHS, bone);
        s.require(is_length(given) | !(given == given));
        return select(given == given, scale * given, sqrt(len2(posed)));
    };
    const T upper = length(0, elbow - shoulder), fore = length(1, wrist - elbow), bones = upper + fore;
    T far = bones, near = abs(upper - fore);
    if (s.has(SWIVEL_WITH_FLEXION_LIMIT)) {
        const T cos_half = s.io.load(SWIVEL_FLEXION_LIMIT, 0), cos_half_max = s.io.load(SWIVEL_FLEXION_LIMIT, 1);
        s.require(is_within(cos_half, 0, 1) & is_within(cos_half_max, 0, 1));
        far = lo(bent_reach(upper, fore, cos_half), far);
        near = hi(bent_reach(upper, fore, cos_half_max), near);
    }
    if (s.has(SWIVEL_WITH_REACH)) {
        const ReachGoal<T> reach{s.io.load(SWIVEL_REACH, 0), s.io.load(SWIVEL_REACH, 1), s.io.load(SWIVEL_REACH, 2),
                                 s.io.load(SWIVEL_REACH, 3)};
        s.require(is_valid(reach));
        return {far, hi(far - reach.soft_far * bones, T(0)), hi(near, reach.min_distance * far)};
    }
    if (!s.has(SWIVEL_WITH_CAP)) return {far, far, near};
    const Cap<T> cap{s.io.load(SWIVEL_CAP, 0), s.io.load(SWIVEL_CAP, 1), s.io.load(SWIVEL_CAP, 2),
                     sqrt(len2(wrist - shoulder))};
    s.require(is_valid(cap));
    const CappedReach<T> capped = capped_reach(cap, far, bones);
    return {capped.far, hi(capped.far - capped.zone, T(0)), near};
}

}  // namespace swivel::inline SWIVEL_ISA
