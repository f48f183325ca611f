// SPDX-License-Identifier: MIT
//
// The kernels of plain arms, compiled once for each instruction set. solve_arms() passes a run to solve_slices(), which
// calls solve_slice() for each slice. That loads rows, calls the formula of core/solve_arm.h and stores rows. Arms for
// which the formula does not hold are gathered, and solved as whole limbs. SWIVEL_ARCH is an xsimd architecture or
// float. SWIVEL_REGISTERS is how many registers a slice works on side by side.
#include "core/solve_arm.h"
#include "simd/kernels/aside.h"
#include "simd/pack.h"
#include "simd/slice.h"
#include "simd/strip_rows.h"

namespace swivel::inline SWIVEL_ISA {

extern const LimbKernels limb_kernels;

namespace {

// The constants of a run, for all of its slices. The elbow's local rotation is cos_half * elbow_straight - sin_half *
// elbow_hinge.
template <class T>
struct RunConstants {
    Rotor<T> parent_from_arm, arm_from_upper, wrist_parent_from_arm, elbow_straight, elbow_hinge;
    T pole_is_point;
};
template <class T, swivel_features Features>
SWIVEL_INLINE RunConstants<T> run_constants(const SolveRun& run)
{
    const Binding bind = binding_of<Features>(run);
    return {broadcast<T>(bind.parent_from_arm),
            ~broadcast<T>(bind.upper_from_arm),
            broadcast<T>(bind.wrist_parent_from_arm),
            broadcast<T>(bind.elbow_parent_from_arm) * ~broadcast<T>(bind.fore_from_arm),
            times_blade<kI>(broadcast<T>(bind.elbow_parent_from_arm)) * ~broadcast<T>(bind.fore_from_arm),
            T(run.features & SWIVEL_POLE_DIRECTION ? 0 : 1)};
}

constexpr bool has(swivel_features features, swivel_features one) { return features & one; }

template <class T, swivel_features Features>
SWIVEL_INLINE ArmGoal<T> load_goal(const Rows<T, Features>& rows)
{
    return {rows.load_vector(SWIVEL_TARGET), rows.load_vector(SWIVEL_POLE), rows.load(SWIVEL_LENGTHS, 0),
            rows.load(SWIVEL_LENGTHS, 1)};
}
// Stores a rotation as its quaternion with w > 0. Returns false where w is 0 or NaN: there the result means nothing.
template <class T, swivel_features Features>
SWIVEL_INLINE Mask<T> store_rotation(const Rows<T, Features>& rows, swivel_field field, const Rotor<T>& q)
{
    const T w = q.template at<kScalar>();
    rows.store(field, 0, flip_sign(q, w));
    return abs(w) > T(0);
}

// Stores the rotations and flags of a pose. Returns false where the hand is bad, or a joint turns by half a turn.
template <class T, swivel_features Features>
SWIVEL_INLINE Mask<T> store_pose(const Rows<T, Features>& rows, const RunConstants<T>& run, const ArmPose<T>& pose)
{
    constexpr bool world = has(Features, SWIVEL_WORLD), joints = has(Features, SWIVEL_JOINTS);
    Rotor<T> shoulder = pose.shoulder;
    if constexpr (joints) {
        shoulder = pose.shoulder * run.arm_from_upper;
        const Rotor<T> elbow = pose.cos_half * run.elbow_straight - pose.sin_half * run.elbow_hinge;
        rows.store(SWIVEL_ELBOW, 0, hemisphere(elbow));  // w may be 0: a folded arm turns by pi
    } else {
        rows.store(SWIVEL_ELBOW, 0, pose.cos_half);
        rows.store(SWIVEL_ELBOW, 1, pose.sin_half);
    }
    if constexpr (joints && !world) shoulder = run.parent_from_arm * shoulder;
    rows.store(SWIVEL_FLAGS, 0, pose.flags);
    Mask<T> holds = store_rotation(rows, SWIVEL_SHOULDER, shoulder);
    if constexpr (has(Features, SWIVEL_WITH_HAND)) {
        const Rotor<T> given = rows.load_rotor(SWIVEL_HAND);
        Rotor<T> hand = given;
        if constexpr (world) hand = ~rows.load_rotor(SWIVEL_PARENT_ROTATION) * given;
        Rotor<T> wrist = wrist_rotor(pose, hand);
        if constexpr (joints) wrist = run.wrist_parent_from_arm * wrist;
        holds = holds & store_rotation(rows, SWIVEL_WRIST, wrist) & is_orientation(given);
    }
    return holds;
}

// Solves a slice of arms. Returns false where the formula does not hold; there the results mean nothing.
template <class T, swivel_features Features>
SWIVEL_INLINE Mask<T> solve_slice(const Rows<T, Features>& rows, const RunConstants<T>& run)
{
    ArmGoal<T> goal = load_goal(rows);
    Mask<T> ordinary = all_lanes<T>();
    if constexpr (has(Features, SWIVEL_WORLD)) {
        const ParentFrame<T> parent = rows.load_parent();
        const SeenGoal<T> seen = seen_by(parent, goal.wrist, goal.pole, run.pole_is_point);
        goal = {seen.wrist, seen.pole, seen.size * goal.upper, seen.size * goal.fore};
        ordinary = is_ordinary(parent, seen);
    }
    const PlainArm<T> arm = solve_plain(goal);
    const Mask<T> holds = arm.holds & store_pose(rows, run, arm.pose);
    if constexpr (!has(Features, SWIVEL_WORLD)) return holds;
    return holds & ordinary;
}

// Solves the first limbs of a list, up to a block, as whole limbs. If they are a block of the run, that is done where
// they lie.
[[gnu::noinline, gnu::cold]] void solve_others(const SolveRun& run, WaitingLimbs& others)
{
    alignas(64) float strip[kPlainStripFloats];
    const auto solve_block = [&](SolveRun block) {
        block.strip = {strip, 1};
        limb_kernels.solve_limbs(block);
    };
    if (others.starts_with_block()) {
        solve_block(block_of(run, others.limb[0] / kLanes));
    } else {
        BlockAside<kFormulaFeatures> aside;
        solve_block(aside.gather(run, others));
        aside.give_back(run, others);
    }
    others.drop_first();
}

// Prefetches input rows in the order in which they lie, so that the CPU's own prefetching follows. The formula takes
// them in another order. On a virtual EPYC (Zen 4), arms with parents then took 0.6 to 0.7 times as long from memory,
// and 1.03 times from a cache. Arms without parents have fewer rows, and took up to 1.2 times as long.
SWIVEL_INLINE void prefetch_rows(const float* input, std::uint32_t row_count)
{
    for (std::uint32_t row = 0; row < row_count; ++row) __builtin_prefetch(input + std::size_t{row} * kLanes);
}

// The results of a slice before they are stored. Limbs that are not chosen keep the results in their rows, and those
// with bad input may keep them, too.
template <class T, swivel_features Features>
struct SliceAside {
    static constexpr std::uint32_t kRows = kPlan<Features>.result_count;
    alignas(64) float results[kRows * kLanes];

    SWIVEL_INLINE void store(float* to, std::uint32_t lanes) const
    {
        const Mask<T> where = lanes_where<T>(lanes);
        for (std::uint32_t row = 0; row < kRows; ++row) {
            const std::size_t at = std::size_t{row} * kLanes;
            store_lanes(to + at, load_lanes<T>(results + at, blocks_of(kRows)), where, blocks_of(kRows));
        }
    }
};

// Solves whole slices from block on, and returns the first block that is left. Arms for which the formula does not hold
// go to `others`; it returns early when that list is full. Selective: there is a mask, or limbs keep results. It is a
// function of its own for each T, so that its constants do not take registers from another loop.
template <class T, swivel_features Features, bool Selective>
SWIVEL_FLATTEN [[gnu::noinline]] std::uint32_t solve_slices(const SolveRun& run, std::uint32_t block,
                                                            WaitingLimbs& others)
{
    constexpr std::uint32_t lanes = lane_count<T>, blocks = lanes > kLanes ? lanes / kLanes : 1;
    const auto block_count = static_cast<std::uint32_t>(run.limb_count / kLanes);
    const RunConstants<T> constants = run_constants<T, Features>(run);
    const std::size_t from = std::size_t{block} * kLanes, slice = blocks * kLanes;
    constexpr std::uint32_t inputs = kPlan<Features>.input_count, outputs = kPlan<Features>.result_count;
    const float* input = run.input + row_offset(from, inputs, 0);
    float* results = run.results + row_offset(from, outputs, 0);
    for (; block + blocks <= block_count; block += blocks) {
        if (has(Features, SWIVEL_WORLD) && run.exceeds_cache) prefetch_rows(input, blocks * inputs);
        std::uint32_t fails = 0;
        for (std::uint32_t lane = 0; lane < kLanes; lane += lanes) {
            const auto solve_to = [&](float* to) SWIVEL_INLINE_LAMBDA {
                return solve_slice(Rows<T, Features>{run, input + lane, to, kEveryLane}, constants);
            };
            if constexpr (Selective) {
                const std::uint32_t chosen = chosen_lanes(run, std::size_t{block} * kLanes + lane, lanes);
                if (chosen == 0) continue;
                SliceAside<T, Features> aside;
                const std::uint32_t failed = lane_bits(!solve_to(aside.results)) & chosen;
                aside.store(results + lane, run.keeps_pose ? chosen & ~failed : chosen);
                fails |= failed << lane;
            } else {
                const Mask<T> holds = solve_to(results + lane);
                if (!all(holds)) [[unlikely]]
                    fails |= lane_bits(!holds) << lane;
            }
        }
        if (fails != 0) [[unlikely]] {
            others.add(std::size_t{block} * kLanes, fails);
            if (others.is_full()) return block + blocks;
        }
        input += row_offset(slice, inputs, 0);
        results += row_offset(slice, outputs, 0);
    }
    return block;
}

// Solves a run of plain arms: slices of several registers, and then the rest with one register. The formula and the
// bits are the same. From memory all slices have one register. With AVX-512 on a virtual EPYC (Zen 4), two registers,
// which read and write two blocks side by side, took 2.1 times as long there, and 1.6 times for arms with parents.
// Other instruction sets took as long either way.
template <swivel_features Features>
void solve_arms(const SolveRun& run)
{
    using Wide = typename KernelNumber<SWIVEL_ARCH, SWIVEL_REGISTERS>::type;
    using Narrow = typename KernelNumber<SWIVEL_ARCH, 1>::type;
    const auto block_count = static_cast<std::uint32_t>(run.limb_count / kLanes);
    WaitingLimbs others;
    for (std::uint32_t block = 0; block < block_count;) {
        if (run.mask || run.keeps_pose) {
            block = solve_slices<Narrow, Features, true>(run, block, others);
        } else {
            if (!run.exceeds_cache) block = solve_slices<Wide, Features, false>(run, block, others);
            if (!others.is_full()) block = solve_slices<Narrow, Features, false>(run, block, others);
        }
        while (others.is_full()) solve_others(run, others);
    }
    if (others.count > 0) solve_others(run, others);
}

}  // namespace

extern const ArmKernels arm_kernels;
const ArmKernels arm_kernels{{solve_arms<0>, solve_arms<1>, solve_arms<2>, solve_arms<3>, solve_arms<4>, solve_arms<5>,
                              solve_arms<6>, solve_arms<7>},
                             pack<typename KernelNumber<SWIVEL_ARCH, 1>::type>};

}  // namespace swivel::inline SWIVEL_ISA
