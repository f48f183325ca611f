// SPDX-License-Identifier: MIT
//
// The kernels of plain arms, compiled once for each instruction set. They load rows, call the formulas of core, and
// store rows. SWIVEL_ARCH is an xsimd architecture or float. SWIVEL_REGISTERS is how many registers a step works on
// side by side.
#include "core/solve_arm.h"
#include "core/space.h"
#include "simd/kernels.h"
#include "simd/lanes.h"
#include "simd/pack.h"
#include "simd/rows.h"

namespace swivel::inline SWIVEL_ISA {

namespace {

// The rows of one step of T's lanes: the places of its first lane in the first input row and in the first result row. A
// step covers whole blocks or lies in one. So every other place is a constant away.
template <class T, FeatureSet Features>
struct Rows {
    const float* input;
    float* results;

    SWIVEL_INLINE T load(Field field, std::uint32_t component) const
    {
        const std::uint32_t row = field_first_row(Features, field) + component;
        return load_lanes<T>([&](std::size_t lane) SWIVEL_INLINE_LAMBDA {
            return input + row_offset(lane, input_row_count(Features), row);
        });
    }
    SWIVEL_INLINE Vector<T> load_vector(Field field) const
    {
        return vector(load(field, 0), load(field, 1), load(field, 2));
    }
    SWIVEL_INLINE Rotor<T> load_rotor(Field field) const
    {
        return rotor(load(field, 0), load(field, 1), load(field, 2), load(field, 3));
    }
    template <class Value>
    SWIVEL_INLINE void store(Field field, std::uint32_t component, const Value& value) const
    {
        const std::uint32_t row = field_first_row(Features, field) + component;
        store_lanes([&](std::size_t lane)
                        SWIVEL_INLINE_LAMBDA { return results + row_offset(lane, result_row_count(Features), row); },
                    value);
    }
    SWIVEL_INLINE void store_rotor(Field field, const Rotor<T>& q) const
    {
        store(field, 0, q.template at<kI>());
        store(field, 1, q.template at<kJ>());
        store(field, 2, q.template at<kK>());
        store(field, 3, q.template at<kScalar>());
    }
};

// What all steps of a run share.
template <class T>
struct Shared {
    Binding<T> bind;
    T pole_is_point;
};
template <class T>
SWIVEL_INLINE Shared<T> shared_by(const SolveRun& run)
{
    const RestFrames& b = *run.frames;
    return {
        binding(broadcast<T>(b.parent_from_arm), broadcast<T>(b.upper_from_arm), broadcast<T>(b.elbow_parent_from_arm),
                broadcast<T>(b.fore_from_arm), broadcast<T>(b.wrist_parent_from_arm), broadcast<T>(b.shoulder_rest),
                broadcast<T>(b.elbow_rest), broadcast<T>(b.wrist_rest)),
        T(run.pole_is_point)};
}

constexpr bool has(FeatureSet features, FeatureSet one) { return features & one; }

template <class T, FeatureSet Features>
SWIVEL_INLINE ArmGoal<T> load_goal(const Rows<T, Features>& rows)
{
    return {rows.load_vector(Field::target), rows.load_vector(Field::pole), rows.load(Field::lengths, 0),
            rows.load(Field::lengths, 1)};
}
template <class T, FeatureSet Features>
SWIVEL_INLINE ParentFrame<T> load_parent(const Rows<T, Features>& rows)
{
    return {rows.load_vector(Field::shoulder_position), rows.load_rotor(Field::parent_rotation),
            rows.load(Field::parent_scale, 0)};
}

// The wanted hand orientations in the space of the poses; the identity in crowds without hands.
template <class T, FeatureSet Features>
SWIVEL_INLINE Rotor<T> load_hand(const Rows<T, Features>& rows)
{
    if constexpr (!has(Features, feature::hand))
        return rotor(T(0), T(0), T(0), T(1));
    else if constexpr (has(Features, feature::world))
        return ~rows.load_rotor(Field::parent_rotation) * rows.load_rotor(Field::hand);
    else
        return rows.load_rotor(Field::hand);
}

// The goals as the formula takes them, and in which lanes their other numbers are plain, too.
template <class T, FeatureSet Features>
SWIVEL_INLINE SeenGoal<T> seen_goal(const Rows<T, Features>& rows, const Shared<T>& shared)
{
    SeenGoal<T> seen{load_goal(rows), T(0) == T(0)};
    if constexpr (has(Features, feature::world)) seen = seen_by(load_parent(rows), seen.goal, shared.pole_is_point);
    if constexpr (has(Features, feature::hand)) seen.plain = seen.plain & is_valid(rows.load_rotor(Field::hand));
    return seen;
}

// The rotations of a pose, as the features want them.
template <class T>
struct Rotations {
    Rotor<T> shoulder, elbow, wrist;  // elbow: with JOINTS; wrist: with a hand
};
template <FeatureSet Features, class T>
SWIVEL_INLINE Rotations<T> rotations_of(const ArmPose<T>& pose, const Shared<T>& shared, const Rotor<T>& hand)
{
    constexpr bool world = has(Features, feature::world), joints = has(Features, feature::joints);
    Rotations<T> q;
    q.shoulder = pose.shoulder;
    if constexpr (joints) q.shoulder = shoulder_local(shared.bind, pose);
    if constexpr (joints && !world) q.shoulder = shared.bind.parent_from_arm * q.shoulder;
    if constexpr (joints) q.elbow = elbow_local(shared.bind, pose);
    if constexpr (has(Features, feature::hand)) q.wrist = wrist_rotor(pose, hand);
    if constexpr (joints && has(Features, feature::hand)) q.wrist = wrist_local(shared.bind, q.wrist);
    return q;
}
template <class T, FeatureSet Features>
SWIVEL_INLINE void store_rest(const Rows<T, Features>& rows, const ArmPose<T>& pose)
{
    if constexpr (!has(Features, feature::joints)) {
        rows.store(Field::elbow, 0, pose.cos_half);
        rows.store(Field::elbow, 1, pose.sin_half);
    }
    rows.store(Field::flags, 0, pose.flags);
}

// Stores a rotation as its quaternion with w > 0. Returns false where w is 0 or NaN: there the result means nothing.
template <class T, FeatureSet Features>
SWIVEL_INLINE Mask<T> store_plain(const Rows<T, Features>& rows, Field field, const Rotor<T>& q)
{
    const T w = q.template at<kScalar>();
    rows.store_rotor(field, with_sign_of(w, q));
    return abs(w) > T(0);
}

// Solves a step of plain arms. Returns false where an arm is not plain, or turns by half a turn. Its results mean
// nothing there.
template <class T, FeatureSet Features>
SWIVEL_INLINE Mask<T> solve_plain_step(const Rows<T, Features>& rows, const Shared<T>& shared)
{
    constexpr bool world = has(Features, feature::world), joints = has(Features, feature::joints),
                   with_hand = has(Features, feature::hand);
    const SeenGoal<T> seen = seen_goal(rows, shared);
    const PlainArm<T> arm = solve_plain(seen.goal);
    const Rotations<T> q = rotations_of<Features>(arm.pose, shared, load_hand(rows));
    store_rest(rows, arm.pose);
    Mask<T> holds = arm.holds & store_plain(rows, Field::shoulder, q.shoulder);
    if constexpr (joints) rows.store_rotor(Field::elbow, hemisphere(q.elbow));  // folded arms turn by pi
    if constexpr (with_hand) holds = holds & store_plain(rows, Field::wrist, q.wrist);
    if constexpr (world || with_hand) holds = holds & seen.plain;
    return holds;
}

// Solves a step of any arms. Plain arms get the same bits as above.
template <class T, FeatureSet Features>
SWIVEL_FLATTEN [[gnu::noinline, gnu::cold]] void solve_any_step(const Rows<T, Features> rows, const SolveRun& run)
{
    const Shared<T> shared = shared_by<T>(run);
    constexpr bool world = has(Features, feature::world), joints = has(Features, feature::joints),
                   with_hand = has(Features, feature::hand);
    const SeenGoal<T> seen = seen_goal(rows, shared);
    ArmGoal<T> asked = load_goal(rows);
    Mask<T> good = T(0) == T(0);
    ArmAxes<T> axes = arm_axes<T>();
    if constexpr (world) {
        const ParentFrame<T> parent = load_parent(rows);
        good = is_valid(parent) & (len2(asked.wrist) <= T(kHuge2)) & (len2(asked.pole) <= T(kHuge2));
        asked = seen_by_any(parent, asked, shared.pole_is_point);
    }
    if constexpr (world && joints) {
        const Turn<T> turn = turn_by(shared.bind.parent_from_arm);
        axes = {turn.e1, turn.e2, turn.e3};
    }
    if constexpr (with_hand) good = good & is_valid(rows.load_rotor(Field::hand));

    const Mask<T> holds = solve_plain(seen.goal).holds & seen.plain;
    const ArmPose<T> pose = solve_any(seen.goal, holds, asked, good, axes);
    const Rotor<T> one = rotor(T(0), T(0), T(0), T(1));
    const Rotations<T> q = rotations_of<Features>(pose, shared, select(pose.valid, load_hand(rows), one));
    const auto store = [&](Field field, const Rotor<T>& each, const Rotor<T>& rest) SWIVEL_INLINE_LAMBDA {
        rows.store_rotor(field, hemisphere(select(pose.valid, each, rest)));
    };
    store(Field::shoulder, q.shoulder, joints ? shared.bind.shoulder_rest : one);
    if constexpr (joints) store(Field::elbow, q.elbow, shared.bind.elbow_rest);
    if constexpr (with_hand) store(Field::wrist, q.wrist, joints ? shared.bind.wrist_rest : one);
    store_rest(rows, pose);
}

// The same for a step of any width, one register after the other. Such arms are rare, so one build of the function is
// enough.
template <class T, FeatureSet Features>
SWIVEL_INLINE void solve_any_registers(const Rows<T, Features>& rows, const SolveRun& run)
{
    using One = typename KernelNumber<SWIVEL_ARCH, 1>::type;
    for (std::size_t lane = 0; lane < lane_count<T>; lane += lane_count<One>)
        solve_any_step(Rows<One, Features>{rows.input + row_offset(lane, input_row_count(Features), 0),
                                           rows.results + row_offset(lane, result_row_count(Features), 0)},
                       run);
}

// Prefetches the rows of a block that is solved 8 blocks later. This is far enough for memory to answer, and the rows
// of 8 blocks still fit a level 1 cache of 32 KiB. A prefetch moves no values. So it does no harm past the end of the
// run or of the crowd.
template <FeatureSet Features>
SWIVEL_INLINE void prefetch_rows(const float* input, const float* results)
{
    constexpr std::size_t ahead = 8 * kLanes;
    for (std::uint32_t row = 0; row < input_row_count(Features); ++row)
        __builtin_prefetch(input + row_offset(ahead, input_row_count(Features), row), 0);
    for (std::uint32_t row = 0; row < result_row_count(Features); ++row)
        __builtin_prefetch(results + row_offset(ahead, result_row_count(Features), row), 1);
}

// Solves whole steps from block on, and returns the first block that is left. It is a function of its own for each T,
// so that its constants do not take registers from another loop.
template <class T, FeatureSet Features>
SWIVEL_FLATTEN [[gnu::noinline]] std::uint32_t solve_steps(const SolveRun& run, std::uint32_t block)
{
    constexpr std::uint32_t lanes = lane_count<T>, blocks = lanes > kLanes ? lanes / kLanes : 1;
    const Shared<T> shared = shared_by<T>(run);
    const std::size_t from = std::size_t{block} * kLanes, step = blocks * kLanes;
    const float* input = run.input + row_offset(from, input_row_count(Features), 0);
    float* results = run.results + row_offset(from, result_row_count(Features), 0);
    for (; block + blocks <= run.block_count; block += blocks) {
        if (run.prefetch)
            for (std::uint32_t n = 0; n < blocks; ++n)
                prefetch_rows<Features>(input + row_offset(n * kLanes, input_row_count(Features), 0),
                                        results + row_offset(n * kLanes, result_row_count(Features), 0));
        for (std::uint32_t lane = 0; lane < kLanes; lane += lanes) {
            const Rows<T, Features> rows{input + lane, results + lane};
            if (!all(solve_plain_step(rows, shared))) [[unlikely]]
                solve_any_registers(rows, run);
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
    const std::uint32_t done =
        solve_steps<typename KernelNumber<SWIVEL_ARCH, SWIVEL_REGISTERS>::type, Features>(run, 0);
    solve_steps<typename KernelNumber<SWIVEL_ARCH, 1>::type, Features>(run, done);
}

using PackNumber = typename KernelNumber<SWIVEL_ARCH, 1>::type;

}  // namespace

extern const ArmKernels arm_kernels;
const ArmKernels arm_kernels{{solve<0>, solve<1>, solve<2>, solve<3>, solve<4>, solve<5>, solve<6>, solve<7>},
                             {pack<PackNumber, 0>, pack<PackNumber, feature::joints>, pack<PackNumber, feature::hand>,
                              pack<PackNumber, feature::joints | feature::hand>}};

}  // namespace swivel::inline SWIVEL_ISA
