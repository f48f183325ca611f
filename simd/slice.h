// SPDX-License-Identifier: MIT
//
// A slice is the limbs that a kernel works on at once, one in each lane. Here is what it reads and writes: its rows,
// and how a skeleton's joints lie to its arms. The kernels of plain arms and of whole limbs both use it.
#pragma once

#include "core/joint_limits.h"
#include "core/space.h"
#include "simd/component_rows.h"
#include "simd/kernels.h"
#include "simd/lanes.h"
#include "simd/rows.h"

namespace swivel::inline SWIVEL_ISA {

// A kernel is compiled for one set of features, or for those that each run has.
inline constexpr swivel_features kRuntimeFeatures = ~swivel_features{0};

template <swivel_features Features>
inline constexpr RowPlan kPlan{Features};

template <swivel_features Features>
SWIVEL_ALWAYS_INLINE constexpr swivel_features features_of(const SolveRun& run)
{
    return Features == kRuntimeFeatures ? run.features : Features;
}

// Where the lanes of a slice lie in blocks of so many rows.
SWIVEL_ALWAYS_INLINE constexpr LaneBlocks blocks_of(std::uint32_t row_count)
{
    return {kLanes, std::size_t{row_count} * kLanes};
}

// The rows of one slice of T's lanes: the places of its first lane in the first input row and in the first result row.
// A slice covers whole blocks or lies in one. So every other place is a constant away. A slice of runtime features lies
// in one.
template <class T, swivel_features Features>
struct Rows {
    static_assert(Features != kRuntimeFeatures || lane_count<T> <= kLanes);
    const SolveRun& run;
    const float* input;
    float* results;
    std::uint32_t chosen;  // bits of the lanes whose results are stored: see chosen_lanes()

    SWIVEL_ALWAYS_INLINE std::uint32_t row(swivel_field field, int component) const
    {
        const std::uint32_t first =
            Features == kRuntimeFeatures ? run.first_row[index_of(field)] : kPlan<Features>.first[index_of(field)];
        return first + static_cast<std::uint32_t>(component);
    }
    // Where an input or a result lies, and how its lanes lie in blocks.
    SWIVEL_ALWAYS_INLINE const float* at(swivel_field field, int component) const
    {
        return (is_input(field) ? input : results) + std::size_t{row(field, component)} * kLanes;
    }
    SWIVEL_ALWAYS_INLINE static constexpr LaneBlocks blocks(swivel_field field)
    {
        return blocks_of(is_input(field) ? kPlan<Features>.input_count : kPlan<Features>.result_count);
    }
    SWIVEL_ALWAYS_INLINE T load(swivel_field field, int component) const
    {
        return load_lanes<T>(at(field, component), blocks(field));
    }
    SWIVEL_ALWAYS_INLINE Vector<T> load_vector(swivel_field field, int first = 0) const
    {
        return load_vector_rows<T>(at(field, first), blocks(field));
    }
    SWIVEL_ALWAYS_INLINE Rotor<T> load_rotor(swivel_field field, int first = 0) const
    {
        return load_rotor_rows<T>(at(field, first), blocks(field));
    }
    SWIVEL_ALWAYS_INLINE Turned<T> load_turned(swivel_field field, int first = 0) const
    {
        return {load(field, first), load(field, first + 1)};
    }
    SWIVEL_ALWAYS_INLINE Range<T> load_range(swivel_field field, int first = 0) const
    {
        return {load_turned(field, first), load_turned(field, first + 2)};
    }
    SWIVEL_ALWAYS_INLINE Cone<T> load_cone(swivel_field field) const { return {load_vector(field), load(field, 3)}; }
    SWIVEL_ALWAYS_INLINE ParentFrame<T> load_parent() const
    {
        return {load_vector(SWIVEL_SHOULDER_POSITION), load_rotor(SWIVEL_PARENT_ROTATION),
                load(SWIVEL_PARENT_SCALE, 0)};
    }

    template <class Value>
    SWIVEL_ALWAYS_INLINE void store(swivel_field field, int component, const Value& value) const
    {
        store_at(results + std::size_t{row(field, component)} * kLanes, value);
    }
    // to: a place among the results.
    template <class Value>
    SWIVEL_ALWAYS_INLINE void store_at(float* to, const Value& value) const
    {
        constexpr LaneBlocks where = blocks_of(kPlan<Features>.result_count);
        if (chosen == kEveryLane)
            store_rows(to, value, where);
        else
            store_rows(to, value, lanes_where<T>(chosen), where);
    }
};

// How a skeleton's joints lie to the arm frame, all of unit length; identities in groups without joints. They are
// spread over lanes where they are used, because a limb's own values leave no registers for them.
struct Binding {
    Rotor<float> parent_from_arm, upper_from_arm, elbow_parent_from_arm, fore_from_arm, wrist_parent_from_arm;
    Rotor<float> hand_from_arm;  // the hand joint's own frame when the arm lies in the arm frame at rest
};
template <swivel_features Features>
SWIVEL_INLINE Binding binding_of(const SolveRun& run)
{
    const Rotor<float> q = rotor(0.0f, 0.0f, 0.0f, 1.0f);
    if (!(features_of<Features>(run) & (SWIVEL_JOINTS | kBody))) return {q, q, q, q, q, q};
    const swivel_binding& b = *run.binding;
    const Rotor<float> wrist_parent = broadcast<float>(b.wrist_parent_from_arm);
    return {broadcast<float>(b.parent_from_arm),
            broadcast<float>(b.upper_from_arm),
            broadcast<float>(b.elbow_parent_from_arm),
            broadcast<float>(b.fore_from_arm),
            wrist_parent,
            normalise(~wrist_parent * broadcast<float>(b.wrist_rest))};
}
template <class T>
SWIVEL_ALWAYS_INLINE Rotor<T> broadcast(const Rotor<float>& q)
{
    return rotor(T(q.at<kI>()), T(q.at<kJ>()), T(q.at<kK>()), T(q.at<kScalar>()));
}

}  // namespace swivel::inline SWIVEL_ISA
