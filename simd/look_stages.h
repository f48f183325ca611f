// SPDX-License-Identifier: MIT
//
// The stage of a look: a chain of a body's joints turns to a target, and what hangs below it turns along.
#pragma once

#include "core/look.h"
#include "simd/joint_stages.h"
#include "simd/sent_rows.h"

namespace swivel::inline SWIVEL_ISA {

// What a body is to look at, and where its line of sight comes.
template <class S>
struct LookGoal {
    using T = typename S::T;
    const LookRules& rules;
    LineOfSight<T> sight;  // as it comes; places are from the root's
    Vector<T> target;      // the one that is followed
    T weight;
    FollowedLine<T> line;  // in the root's frame
    Mask<T> is_given, is_behind, is_faded;

    SWIVEL_INLINE explicit LookGoal(const S& s) : rules(s.strip.run.limb->look)
    {
        const BodyLimb& look = *s.strip.run.limb;
        const std::uint32_t last = look.turned[look.turned_count - 1].row;
        const Rotor<T> turn = s.body_rotor(last + kTurnRow), root = s.body_rotor(kRootJoint + kTurnRow);
        const T scale = s.body_row(last + kScaleRow), own_weight = s.io.load(SWIVEL_LOOK_WEIGHT, 0);
        const Vector<T> given = s.io.load_vector(SWIVEL_LOOK_TARGET), root_place = s.body_vector(kRootRow);
        const T given2 = len2(given);
        is_given = given2 == given2;
        s.require(is_share(own_weight) & ((given2 <= T(kHuge2)) | !is_given) & (len2(root_place) <= T(kHuge2)) &
                  is_within(scale, kTiny, kHuge));
        for (std::uint32_t n = 0; n < look.turned_count; ++n)
            s.require(is_within(len2(s.body_rotor(look.turned[n].row + kTurnRow)), 0.99, 1.01) &
                      (len2(s.body_vector(look.turned[n].row + kPlaceRow)) <= T(kHuge2)));
        const auto constant = [](const float(&v)[3]) SWIVEL_INLINE_LAMBDA { return vector(T(v[0]), T(v[1]), T(v[2])); };
        sight = {s.body_vector(last + kPlaceRow) + turned(turn, scale * constant(rules.eye)),
                 turned(turn, constant(rules.axis))};
        s.require(len2(sight.eye) <= T(kHuge2));
        target = select(is_given, given - root_place, sight.eye + sight.axis);
        const Vector<T> to = target - sight.eye;
        const T distance = sqrt(len2(to));
        const Mask<T> leads = is_given & (distance > T(kTiny));
        line.direction = turned(~root, select(leads, (T(1) / select(leads, distance, T(1))) * to, sight.axis));
        line.nearness = T(1) / hi(select(is_given, distance, T(kHuge)), T(kTiny));
        is_behind = T(1) < T(0);
        if (rules.rate > 0) follow(s, root);
        const T fade = look_weight(sight, target, rules.fade, scale);
        is_faded = (is_given | is_behind) & (fade < T(1));
        weight = select(is_given | is_behind, own_weight * fade, T(0));
    }

private:
    SWIVEL_INLINE void follow(const S& s, const Rotor<T>& root)
    {
        const T time = s.body_row(kTimeRow);
        s.require(is_within(time, 0, kHuge));
        const Vector<T> direction = s.io.load_result_vector(SWIVEL_LOOK_LINE, 0);
        const T nearness = s.io.load_result(SWIVEL_LOOK_LINE, 3);
        const Mask<T> has_begun = is_within(len2(direction), 0.99, 1.01) & is_within(nearness, 0, kHuge);
        const FollowedLine<T> was{select(has_begun, direction, line.direction),
                                  select(has_begun, nearness, line.nearness)};
        const FollowedLine<T> goal{line.direction, select(is_given, line.nearness, was.nearness)};
        const T lever = sqrt(len2(sight.eye - s.body_vector(s.strip.run.limb->turned[0].row + kPlaceRow)));
        const FollowedStep<T> step = followed(was, goal, lever, T(0.5f * rules.rate) * time);
        const Mask<T> stands = has_begun & (time == T(0));  // nothing that is carried changes
        line = {select(stands, was.direction, step.line.direction), select(stands, was.nearness, step.line.nearness)};
        is_behind = has_begun & step.behind;
        const Vector<T> followed_target =
            sight.eye + (T(1) / hi(line.nearness, T(kTiny))) * turned(root, line.direction);
        target = select(is_behind, followed_target, target);
    }
};

template <>
struct StageBody<Stage::look> {
    template <class S>
    SWIVEL_INLINE static void slice(const S& s)
    {
        using T = typename S::T;
        const BodyLimb& look = *s.strip.run.limb;
        const LookGoal<S> goal(s);
        const Mask<T> valid = lanes_where<T>(s.good()), kept = (goal.weight == T(0)) | !valid;
        Chain<T> chain;
        chain.sight = goal.sight;
        turn_chain(s, goal, valid, kept, chain);
        if (s.strip.run.strip.pose->space == SWIVEL_IN_BODY) set_motions(s, kept, chain);
        for (std::uint32_t n = 0; n < look.following_count; ++n) {
            const FollowingJoint& joint = look.following[n];
            const LookedJoint<T>& with = chain.joint[joint.number];
            const Rotor<T> was = s.body_rotor(joint.row + kTurnRow);
            const Vector<T> came = s.body_vector(joint.row + kPlaceRow);
            set_frame(s, joint.row, kept, with.sum * was, with.place + turned(with.sum, came - with.came));
        }
        for (std::uint32_t n = 0; n < look.turned_count; ++n)
            set_frame(s, look.turned[n].row, kept, chain.joint[n].rotation, chain.joint[n].place);
        store(s, goal, chain, valid);
    }

private:
    template <class T>
    struct LookedJoint {
        Rotor<T> sum;       // by which it has turned, and all that follows it
        Rotor<T> rotation;  // its own, in the world
        Vector<T> place, came;
    };
    template <class T>
    struct Chain {
        LookedJoint<T> joint[kMostLookJoints];
        LineOfSight<T> sight;
        Mask<T> held;  // by a cone
    };

    // Turns the joints of the chain, each in the frame that those before it have turned.
    template <class S>
    SWIVEL_INLINE static void turn_chain(const S& s, const LookGoal<S>& goal, const Mask<typename S::T>& valid,
                                         const Mask<typename S::T>& kept, Chain<typename S::T>& chain)
    {
        using T = typename S::T;
        const BodyLimb& look = *s.strip.run.limb;
        const std::uint32_t last = look.turned_count - 1;
        Rotor<T> sum = one<T>();
        chain.held = T(1) < T(0);
        for (std::uint32_t n = 0; n <= last; ++n) {
            const TurnedJoint& joint = look.turned[n];
            LookedJoint<T>& is = chain.joint[n];
            is.came = is.place = s.body_vector(joint.row + kPlaceRow);
            if (n > 0) is.place = chain.joint[n - 1].place + turned(sum, is.came - chain.joint[n - 1].came);
            const LookTurn<T> turn =
                n < last ? share_of_look(chain.sight, goal.target, goal.weight, goal.rules.joint[n])
                         : rest_of_look(chain.sight, is.place, goal.target, goal.weight, goal.rules.joint[n]);
            chain.sight = {is.place + turned(turn.turn, chain.sight.eye - is.place),
                           turned(turn.turn, chain.sight.axis)};
            chain.held = chain.held | turn.held;
            const bool hangs_on_last = n > 0 && joint.parent == look.turned[n - 1].row;
            const Rotor<T> parent =
                hangs_on_last ? chain.joint[n - 1].rotation : sum * s.body_rotor(joint.parent + kTurnRow);
            sum = unit_rotation(turn.turn * sum);
            is.sum = sum;
            is.rotation = sum * s.body_rotor(joint.row + kTurnRow);
            const Rotor<T> local = unit_rotation(~parent * is.rotation);
            set_local(s, joint.row, local, local, valid, kept);
        }
    }
    // How the joints move in the body's space, from the pose as it came: after the looks above.
    template <class S>
    SWIVEL_INLINE static void set_motions(const S& s, const Mask<typename S::T>& kept,
                                          const Chain<typename S::T>& chain)
    {
        using T = typename S::T;
        const BodyLimb& look = *s.strip.run.limb;
        const Rotor<T> root = s.body_rotor(kRootJoint + kTurnRow);
        const T shrink = T(1) / s.body_row(kRootJoint + kScaleRow);
        const bool has_above = look.above != 0;
        const Rotor<T> above = has_above ? s.body_rotor(look.above + kMotionRow) : one<T>();
        const Vector<T> above_shift = has_above ? s.body_vector(look.above + kShiftRow) : vector(T(0), T(0), T(0));
        for (std::uint32_t n = 0; n < look.turned_count; ++n) {
            const LookedJoint<T>& joint = chain.joint[n];
            const Rotor<T> turn = hemisphere(unit_rotation(~root * joint.sum * root));
            const auto in_body = [&](const Vector<T>& place)
                                     SWIVEL_INLINE_LAMBDA { return turned(~root, shrink * place); };
            const Vector<T> shift = in_body(joint.place) - turned(turn, in_body(joint.came));
            const std::uint32_t row = look.turned[n].row;
            s.set_body_rotor(row + kMotionRow, select(kept, above, has_above ? turn * above : turn));
            s.set_body_vector(row + kShiftRow,
                              select(kept, above_shift, has_above ? turned(turn, above_shift) + shift : shift));
        }
    }
    template <class S>
    SWIVEL_INLINE static void set_frame(const S& s, std::uint32_t row, const Mask<typename S::T>& kept,
                                        const Rotor<typename S::T>& rotation, const Vector<typename S::T>& place)
    {
        s.set_body_rotor(row + kTurnRow, select(kept, s.body_rotor(row + kTurnRow), rotation));
        s.set_body_vector(row + kPlaceRow, select(kept, s.body_vector(row + kPlaceRow), place));
    }
    template <class S>
    SWIVEL_INLINE static void store(const S& s, const LookGoal<S>& goal, const Chain<typename S::T>& chain,
                                    const Mask<typename S::T>& valid)
    {
        using T = typename S::T;
        const Rows<T, kTold> out = good_rows(s);
        out.store_vector(SWIVEL_SIGHT, chain.sight.eye + s.body_vector(kRootRow));
        out.store_vector(SWIVEL_SIGHT, chain.sight.axis, 3);
        out.store_vector(SWIVEL_LOOK_LINE, goal.line.direction);
        out.store(SWIVEL_LOOK_LINE, 3, goal.line.nearness);
        Rows<T, kTold> all = s.io, cleared = s.io;
        all.chosen = s.chosen() == S::kEvery ? kEveryLane : s.chosen();
        cleared.chosen = s.strip.run.keeps ? 0 : s.chosen() & ~s.good();
        if (cleared.chosen != 0)
            for (int n = 0; n < 4; ++n) cleared.store(SWIVEL_LOOK_LINE, n, T(0));
        const Mask<T> meets =
            goal.is_given & sees(chain.sight, s.io.load_vector(SWIVEL_LOOK_TARGET) - s.body_vector(kRootRow));
        const Word<T> flags = word_where(meets, SWIVEL_REACHED) |
                              word_where(chain.held & (goal.weight > T(0)), SWIVEL_LIMITED_LOOK) |
                              word_where(goal.is_behind, SWIVEL_LIMITED_STEP) | word_where(goal.is_faded, SWIVEL_FADED);
        all.store(SWIVEL_FLAGS, 0, select(valid, flags, word<T>(SWIVEL_BAD_INPUT)));
    }
};

}  // namespace swivel::inline SWIVEL_ISA
