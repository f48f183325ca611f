// SPDX-License-Identifier: MIT
//
// Compiled once for each instruction set: loads rows, calls the formulas of core, stores rows. SWIVEL_ARCH is an xsimd
// architecture or float; SWIVEL_REGISTERS how many registers a step works on side by side.
#include "simd/kernels.h"

#include "core/solve_arm.h"
#include "core/space.h"
#include "simd/lanes.h"
#include "simd/rows.h"

namespace swivel::inline SWIVEL_ISA {

namespace {

// The rows of one step of T's lanes: where its first lane is in the first input row and in the first result row. A step
// does not cross blocks unevenly, so every other place is a constant away.
template <class T, std::uint32_t Features>
struct Rows {
    const float* input;
    float* results;

    SWIVEL_INLINE T load(swivel_field field, std::uint32_t component) const
    {
        const std::uint32_t row = field_first_row(Features, field) + component;
        return load_lanes<T>([&](std::size_t lane) SWIVEL_INLINE_LAMBDA {
            return input + row_offset(lane, input_row_count(Features), row);
        });
    }
    SWIVEL_INLINE Vector<T> load_vector(swivel_field field) const
    {
        return vector(load(field, 0), load(field, 1), load(field, 2));
    }
    SWIVEL_INLINE Rotor<T> load_rotor(swivel_field field) const
    {
        return rotor(load(field, 0), load(field, 1), load(field, 2), load(field, 3));
    }
    template <class Value>
    SWIVEL_INLINE void store(swivel_field field, std::uint32_t component, const Value& value) const
    {
        const std::uint32_t row = field_first_row(Features, field) + component;
        store_lanes([&](std::size_t lane)
                        SWIVEL_INLINE_LAMBDA { return results + row_offset(lane, result_row_count(Features), row); },
                    value);
    }
    SWIVEL_INLINE void store_rotor(swivel_field field, const Rotor<T>& either) const
    {
        const Rotor<T> q = hemisphere(either);
        store(field, 0, q.template at<kI>());
        store(field, 1, q.template at<kJ>());
        store(field, 2, q.template at<kK>());
        store(field, 3, q.template at<kScalar>());
    }
};

template <class T>
SWIVEL_INLINE Rotor<T> broadcast(const float (&q)[4])
{
    return rotor(T(q[0]), T(q[1]), T(q[2]), T(q[3]));
}

template <class T, std::uint32_t Features>
SWIVEL_INLINE void solve_step(const Rows<T, Features>& rows, const Binding<T>& bind, const T& pole_is_point)
{
    constexpr bool world = Features & SWIVEL_WORLD, joints = Features & SWIVEL_JOINTS,
                   with_hand = Features & SWIVEL_WITH_HAND;
    const Rotor<T> one = rotor(T(0), T(0), T(0), T(1));

    ArmGoal<T> goal{rows.load_vector(SWIVEL_TARGET), rows.load_vector(SWIVEL_POLE), rows.load(SWIVEL_LENGTHS, 0),
                    rows.load(SWIVEL_LENGTHS, 1)};
    Mask<T> good = T(0) == T(0);
    Rotor<T> world_from_arm = one;
    if constexpr (world) {
        const ParentFrame<T> parent{rows.load_vector(SWIVEL_PARENT_POSITION), rows.load_rotor(SWIVEL_PARENT_ROTATION),
                                    rows.load(SWIVEL_PARENT_SCALE, 0)};
        good = good & is_valid(parent) & (len2(goal.wrist) <= T(kHuge2)) & (len2(goal.pole) <= T(kHuge2));
        world_from_arm = parent.rotation;
        if constexpr (joints) world_from_arm = parent.rotation * bind.parent_from_arm;
        const IntoArm<T> into = into_arm(world_from_arm, parent.scale);
        goal.wrist = into(goal.wrist - parent.position);
        goal.pole = into(goal.pole - pole_is_point * parent.position);
    }
    Rotor<T> hand = one;
    if constexpr (with_hand) {
        hand = rows.load_rotor(SWIVEL_HAND);
        good = good & is_valid(hand);
    }

    const ArmPose<T> pose = solve_arm(goal, good);

    if constexpr (joints) {
        rows.store_rotor(SWIVEL_SHOULDER, shoulder_local(bind, pose));
        rows.store_rotor(SWIVEL_ELBOW, elbow_local(bind, pose));
    } else {
        rows.store_rotor(SWIVEL_SHOULDER, pose.shoulder);
        rows.store(SWIVEL_ELBOW, 0, pose.cos_half);
        rows.store(SWIVEL_ELBOW, 1, pose.sin_half);
    }
    if constexpr (with_hand) {
        const Rotor<T> hand_a = ~world_from_arm * hand;
        if constexpr (joints)
            rows.store_rotor(SWIVEL_WRIST, wrist_local(bind, pose, hand_a));
        else
            rows.store_rotor(SWIVEL_WRIST, wrist_rotor(pose, hand_a));
    }
    rows.store(SWIVEL_FLAGS, 0, pose.flags);
}

// Solves whole steps from limb on; returns the first limb it left. A function of its own for each T, so that its
// constants do not take registers from another's loop.
template <class T, std::uint32_t Features>
SWIVEL_FLATTEN [[gnu::noinline]] std::size_t solve_steps(const SolveRun& run, std::size_t limb)
{
    const swivel_binding& b = *run.binding;
    const Binding<T> bind{broadcast<T>(b.parent_from_arm), broadcast<T>(b.upper_from_arm),
                          broadcast<T>(b.fore_from_arm),   broadcast<T>(b.shoulder_rest),
                          broadcast<T>(b.elbow_rest),      broadcast<T>(b.wrist_rest)};
    const T pole_is_point(run.pole_is_point);
    const std::size_t limb_count = std::size_t{run.block_count} * SWIVEL_LANES;
    for (; limb + lane_count<T> <= limb_count; limb += lane_count<T>)
        solve_step(Rows<T, Features>{run.input + row_offset(limb, input_row_count(Features), 0),
                                     run.results + row_offset(limb, result_row_count(Features), 0)},
                   bind, pole_is_point);
    return limb;
}

// Steps of several registers, then the rest with one: the same formula, the same bits.
template <std::uint32_t Features>
void solve(const SolveRun& run)
{
    const std::size_t done = solve_steps<typename KernelNumber<SWIVEL_ARCH, SWIVEL_REGISTERS>::type, Features>(run, 0);
    solve_steps<typename KernelNumber<SWIVEL_ARCH, 1>::type, Features>(run, done);
}

}  // namespace

extern const Kernels kernels;
const Kernels kernels{{solve<0>, solve<1>, solve<2>, solve<3>, solve<4>, solve<5>, solve<6>, solve<7>}};

}  // namespace swivel::inline SWIVEL_ISA
