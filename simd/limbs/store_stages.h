// SPDX-License-Identifier: MIT
//
// The last stages of the whole limb: they lift the arm out of the line, and store the results.
#pragma once

#include "core/forearm_twist.h"
#include "simd/limbs/bone_stages.h"
#include "simd/limbs/limit_stages.h"

namespace swivel::inline SWIVEL_ISA {

// Stores results of a slice. Lanes that are not chosen keep theirs. Lanes with bad input get their rest pose, or in
// groups that say so keep all but their flags.
template <class S>
struct Results {
    using T = typename S::T;
    const S& s;
    Rows<T, kRuntimeFeatures> out;
    Mask<T> valid;

    SWIVEL_INLINE explicit Results(const S& slice)
        : s(slice),
          out(slice.strip.run.keeps_pose ? slice.good_rows() : slice.chosen_rows()),
          valid(lanes_where<T>(slice.good()))
    {
    }
    // A joint's rotation: of its two quaternions the one nearer to the incoming pose's, or else the one with w >= 0.
    SWIVEL_INLINE void store_joint(swivel_field field, swivel_field incoming, const Rotor<T>& q,
                                   const Rotor<T>& rest) const
    {
        const Rotor<T> safe = select(valid, q, hemisphere(rest));
        if (!s.has(SWIVEL_WITH_INCOMING) || s.has(kBody)) return out.store(field, 0, hemisphere(safe));
        const T side = scalar_product(~out.load_rotor(incoming), safe);
        out.store(field, 0, flip_sign(safe, select(valid, side, T(1))));
    }
};

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::store>, const S& s)
{
    using T = typename S::T;
    constexpr bool joints = S::template is<SWIVEL_JOINTS>();
    const Binding& bind = s.strip.bind;
    const swivel_binding& b = *s.strip.run.binding;
    const Results<S> results(s);
    const Vector<T> line = s.rows.vector(kLineRow);
    Vector<T> normal = s.rows.vector(kNormalRow);
    Word<T> flags = s.rows.word(kFlagsRow);
    if (s.has(kLibraryGoal)) flags = flags | s.body.word(s.strip.run.plan->limb.goal + kGoalFlagsRow);
    Continuity<T> continuity;
    if (s.has(SWIVEL_WITH_MAX_SWIVEL)) load_continuity(s, continuity);
    if (s.strip.run.features & kSwivelLimits) {
        normal = swivelled(normal, line, {s.rows.get(kSwivelRow), s.rows.get(kSwivelRow + 1)});
        if (s.has(SWIVEL_WITH_MAX_SWIVEL) && !s.has(SWIVEL_STEP_WINS))
            flags = flags | word_where(jumps(continuity, normal, line), SWIVEL_JUMPED);
    }
    if (s.has(SWIVEL_STEP_WINS)) normal = last_step(continuity, normal, line, flags);
    const Rotor<T> shoulder = lifted(line, normal, lift_of(s));
    if (s.has(SWIVEL_WITH_HAND)) s.rows.set(kShoulderRow, shoulder);  // for the stage `wrist`
    const T cos = select(results.valid, s.rows.get(kFlexionRow), T(1)),
            sin = select(results.valid, s.rows.get(kFlexionRow + 1), T(0));
    const Rotor<T> safe = select(results.valid, shoulder, one<T>());

    s.store_flags(flags);
    if constexpr (joints) {
        results.store_joint(SWIVEL_SHOULDER, SWIVEL_INCOMING_SHOULDER,
                            broadcast<T>(bind.parent_from_arm) * safe * ~broadcast<T>(bind.upper_from_arm),
                            broadcast<T>(b.shoulder_rest));
        results.store_joint(
            SWIVEL_ELBOW, SWIVEL_INCOMING_ELBOW,
            broadcast<T>(bind.elbow_parent_from_arm) * hinge(cos, -sin) * ~broadcast<T>(bind.fore_from_arm),
            broadcast<T>(b.elbow_rest));
    } else {
        results.store_joint(SWIVEL_SHOULDER, SWIVEL_INCOMING_SHOULDER, safe, one<T>());
        results.out.store(SWIVEL_ELBOW, 0, cos);
        results.out.store(SWIVEL_ELBOW, 1, sin);
    }
    if (s.has(SWIVEL_WITH_CLAVICLE)) {
        const Rotor<T> parent_from_arm = broadcast<T>(bind.parent_from_arm);
        const Rotor<T> turn = parent_from_arm * s.rows.rotor(kClavicleRow) * ~parent_from_arm;
        results.out.store(SWIVEL_CLAVICLE_ROTATION, 0, hemisphere(select(results.valid, turn, one<T>())));
    }
    if (s.has(SWIVEL_WITH_REACH))
        results.out.store(SWIVEL_STRETCH, 0, select(results.valid, s.rows.get(kStretchRow), T(1)));
    if (s.has(SWIVEL_WITH_MAX_SWIVEL))
        results.out.store(SWIVEL_NORMAL, 0, select(results.valid, normalise(normal), vector(T(0), T(0), T(0))));
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::wrist>, const S& s)
{
    using T = typename S::T;
    constexpr bool joints = S::template is<SWIVEL_JOINTS>();
    const Binding& bind = s.strip.bind;
    const Results<S> results(s);
    Rotor<T> wrist = s.rows.rotor(kHandRow);  // with aim it is relative to the forearm
    if (!s.has(SWIVEL_WITH_AIM)) wrist = ~(s.rows.rotor(kShoulderRow) * s.elbow()) * wrist;
    wrist = select(results.valid, wrist, one<T>());
    s.rows.set(kTwistRow, wrist);
    if constexpr (joints) wrist = broadcast<T>(bind.wrist_parent_from_arm) * wrist * broadcast<T>(bind.hand_from_arm);
    results.store_joint(SWIVEL_WRIST, SWIVEL_INCOMING_WRIST, wrist,
                        joints ? broadcast<T>(s.strip.run.binding->wrist_rest) : one<T>());
}

template <class S>
SWIVEL_INLINE void advance(AtStage<Stage::twist_bones>, const S& s)
{
    using T = typename S::T;
    const swivel_binding& b = *s.strip.run.binding;
    const Results<S> results(s);
    const auto if_joints = [&](const float(&q)[4])
                               SWIVEL_INLINE_LAMBDA { return s.has(SWIVEL_JOINTS) ? broadcast<T>(q) : one<T>(); };
    Turned<T> twist = twist_rotor(s.rows.rotor(kTwistRow));
    if (s.has(kBody)) {  // from the incoming one, the short way
        const Turned<T> incoming{s.body.get(kTwistInRow), s.body.get(kTwistInRow + 1)};
        const T cos = twist.cos * incoming.cos + twist.sin * incoming.sin,
                sin = twist.sin * incoming.cos - twist.cos * incoming.sin;
        twist = {abs(cos), flip_sign(sin, cos)};
        twist = {select(results.valid, twist.cos, T(1)), select(results.valid, twist.sin, T(0))};
    }
    const int bones = static_cast<int>(twist_bone_count(s.strip.run.features));
    for (int n = 0; n < bones; ++n) {
        const Turned<T> share = shared_twist(twist, (n + 1.0) / (bones + 1.0));
        const auto turn = share.cos * unit<T, kScalar>() + share.sin * unit<T, kK>();
        const Rotor<T> parent = if_joints(b.twist_parent_from_arm[n]), bone = if_joints(b.twist_from_arm[n]);
        results.out.store(SWIVEL_TWIST_BONES, 4 * n, hemisphere(parent * turn * ~bone));
    }
}

}  // namespace swivel::inline SWIVEL_ISA
