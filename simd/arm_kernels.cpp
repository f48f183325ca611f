// SPDX-License-Identifier: MIT
//
// The kernels of plain arms, compiled once for each instruction set. They load rows, call the formulas of core, and
// store rows. Arms for which the formula does not hold are gathered, and solved as whole limbs. SWIVEL_ARCH is an
// xsimd architecture or float. SWIVEL_REGISTERS is how many registers a step works on side by side.
#include <bit>

#include "core/solve_arm.h"
#include "simd/aside.h"
#include "simd/pack.h"
#include "simd/step.h"

namespace swivel::inline SWIVEL_ISA {

extern const LimbKernels limb_kernels;

namespace {

// What all steps of a run share. The elbow's local rotation is cos elbow_straight - sin elbow_hinge.
template <class T>
struct Shared {
    Rotor<T> parent_from_arm, arm_from_upper, wrist_parent_from_arm, elbow_straight, elbow_hinge;
    T pole_is_point;
};
template <class T, FeatureSet Features>
SWIVEL_INLINE Shared<T> shared_by(const SolveRun& run)
{
    const Binding bind = binding_of<Features>(run);
    return {broadcast<T>(bind.parent_from_arm),
            ~broadcast<T>(bind.upper_from_arm),
            broadcast<T>(bind.wrist_parent_from_arm),
            broadcast<T>(bind.elbow_parent_from_arm) * ~broadcast<T>(bind.fore_from_arm),
            times_blade<kI>(broadcast<T>(bind.elbow_parent_from_arm)) * ~broadcast<T>(bind.fore_from_arm),
            T(run.features & feature::pole_direction ? 0 : 1)};
}

constexpr bool has(FeatureSet features, FeatureSet one) { return features & one; }

template <class T, FeatureSet Features>
SWIVEL_INLINE ArmGoal<T> load_goal(const Rows<T, Features>& rows)
{
    return {rows.load_vector(Field::target), rows.load_vector(Field::pole), rows.load(Field::lengths, 0),
            rows.load(Field::lengths, 1)};
}
// Stores a rotation as its quaternion with w > 0. Returns false where w is 0 or NaN: there the result means nothing.
template <class T, FeatureSet Features>
SWIVEL_INLINE Mask<T> store_rotation(const Rows<T, Features>& rows, Field field, const Rotor<T>& q)
{
    const T w = q.template at<kScalar>();
    rows.store_rotor(field, with_sign_of(w, q));
    return abs(w) > T(0);
}

// Stores the rotations and flags of a pose. Returns false where the hand is bad, or a joint turns by half a turn.
template <class T, FeatureSet Features>
SWIVEL_INLINE Mask<T> store_pose(const Rows<T, Features>& rows, const Shared<T>& shared, const ArmPose<T>& pose)
{
    constexpr bool world = has(Features, feature::world), joints = has(Features, feature::joints);
    Rotor<T> shoulder = pose.shoulder;
    if constexpr (joints) {
        shoulder = pose.shoulder * shared.arm_from_upper;
        const Rotor<T> elbow = pose.cos_half * shared.elbow_straight - pose.sin_half * shared.elbow_hinge;
        rows.store_rotor(Field::elbow, hemisphere(elbow));  // folded arms turn by pi
    } else {
        rows.store(Field::elbow, 0, pose.cos_half);
        rows.store(Field::elbow, 1, pose.sin_half);
    }
    if constexpr (joints && !world) shoulder = shared.parent_from_arm * shoulder;
    rows.store(Field::flags, 0, pose.flags);
    Mask<T> holds = store_rotation(rows, Field::shoulder, shoulder);
    if constexpr (has(Features, feature::hand)) {
        const Rotor<T> given = rows.load_rotor(Field::hand);
        Rotor<T> hand = given;
        if constexpr (world) hand = ~rows.load_rotor(Field::parent_rotation) * given;
        Rotor<T> wrist = wrist_rotor(pose, hand);
        if constexpr (joints) wrist = shared.wrist_parent_from_arm * wrist;
        holds = holds & store_rotation(rows, Field::wrist, wrist) & is_orientation(given);
    }
    return holds;
}

// Solves a step of arms. Returns false where the formula does not hold; there the results mean nothing.
template <class T, FeatureSet Features>
SWIVEL_INLINE Mask<T> solve_step(const Rows<T, Features>& rows, const Shared<T>& shared)
{
    ArmGoal<T> goal = load_goal(rows);
    Mask<T> ordinary = T(0) == T(0);
    if constexpr (has(Features, feature::world)) {
        const ParentFrame<T> parent = rows.load_parent();
        const SeenGoal<T> seen = seen_by(parent, goal.wrist, goal.pole, shared.pole_is_point);
        goal = {seen.wrist, seen.pole, seen.size * goal.upper, seen.size * goal.fore};
        ordinary = is_ordinary(parent, seen);
    }
    const PlainArm<T> arm = solve_plain(goal);
    const Mask<T> holds = arm.holds & store_pose(rows, shared, arm.pose);
    if constexpr (!has(Features, feature::world)) return holds;
    return holds & ordinary;
}

// The features of plain arms that change their rows.
inline constexpr FeatureSet kPlainRows = feature::world | feature::joints | feature::hand;

// Solves the first limbs of a list, up to a block, as whole limbs. If they are a block of the run, that is done where
// they lie.
[[gnu::noinline, gnu::cold]] void solve_others(const SolveRun& run, WaitingLimbs& others)
{
    if (others.starts_with_block()) {
        limb_kernels.solve(block_of(run, others.limb[0] / kLanes));
    } else {
        BlockAside<kPlainRows> aside;
        limb_kernels.solve(aside.gather(run, others));
        aside.give_back(run, others);
    }
    others.drop_first();
}

// Calls for input rows in the order in which they lie, so that the CPU's own prefetching follows. The formula takes
// them in another order. On a virtual EPYC (Zen 4), arms with parents then took 0.6 to 0.7 times as long from memory,
// and 1.03 times from a cache. Arms without parents have fewer rows, and took up to 1.2 times as long.
SWIVEL_INLINE void call_for_rows(const float* input, std::uint32_t row_count)
{
    for (std::uint32_t row = 0; row < row_count; ++row) __builtin_prefetch(input + std::size_t{row} * kLanes);
}

// Solves whole steps from block on, and returns the first block that is left. Arms for which the formula does not hold
// go to `others`; it returns early when that list is full. It is a function of its own for each T, so that its
// constants do not take registers from another loop.
template <class T, FeatureSet Features, bool Masked>
SWIVEL_FLATTEN [[gnu::noinline]] std::uint32_t solve_steps(const SolveRun& run, std::uint32_t block,
                                                           WaitingLimbs& others)
{
    constexpr std::uint32_t lanes = lane_count<T>, blocks = lanes > kLanes ? lanes / kLanes : 1;
    const auto block_count = static_cast<std::uint32_t>(run.limb_count / kLanes);
    const Shared<T> shared = shared_by<T, Features>(run);
    const std::size_t from = std::size_t{block} * kLanes, step = blocks * kLanes;
    const float* input = run.input + row_offset(from, input_row_count(Features), 0);
    float* results = run.results + row_offset(from, result_row_count(Features), 0);
    for (; block + blocks <= block_count; block += blocks) {
        if (has(Features, feature::world) && run.from_memory) call_for_rows(input, blocks * input_row_count(Features));
        std::uint32_t fails = 0;
        for (std::uint32_t lane = 0; lane < kLanes; lane += lanes) {
            std::uint32_t chosen = kEveryLane;
            if constexpr (Masked) chosen = chosen_lanes(run, std::size_t{block} * kLanes + lane, lanes);
            if (chosen == 0) continue;
            const Mask<T> holds = solve_step(Rows<T, Features>{run, input + lane, results + lane, chosen}, shared);
            if (!all(holds)) [[unlikely]]
                fails |= (lane_bits(!holds) & chosen) << lane;
        }
        if (fails != 0) [[unlikely]] {
            others.add(std::size_t{block} * kLanes, fails);
            if (others.is_full()) return block + blocks;
        }
        input += row_offset(step, input_row_count(Features), 0);
        results += row_offset(step, result_row_count(Features), 0);
    }
    return block;
}

// Solves steps of several registers, and then the rest with one register. The formula and the bits are the same.
template <FeatureSet Features>
void solve(const SolveRun& run)
{
    using Wide = typename KernelNumber<SWIVEL_ARCH, SWIVEL_REGISTERS>::type;
    using Narrow = typename KernelNumber<SWIVEL_ARCH, 1>::type;
    const auto block_count = static_cast<std::uint32_t>(run.limb_count / kLanes);
    WaitingLimbs others;
    for (std::uint32_t block = 0; block < block_count;) {
        if (run.mask) {
            block = solve_steps<Narrow, Features, true>(run, block, others);
        } else {
            block = solve_steps<Wide, Features, false>(run, block, others);
            if (!others.is_full()) block = solve_steps<Narrow, Features, false>(run, block, others);
        }
        while (others.is_full()) solve_others(run, others);
    }
    if (others.count > 0) solve_others(run, others);
}

using PackNumber = typename KernelNumber<SWIVEL_ARCH, 1>::type;

}  // namespace

extern const ArmKernels arm_kernels;
const ArmKernels arm_kernels{{solve<0>, solve<1>, solve<2>, solve<3>, solve<4>, solve<5>, solve<6>, solve<7>},
                             {pack<PackNumber, 0>, pack<PackNumber, feature::joints>, pack<PackNumber, feature::hand>,
                              pack<PackNumber, feature::joints | feature::hand>}};

}  // namespace swivel::inline SWIVEL_ISA
