// SPDX-License-Identifier: MIT
//
// C++ on top of swivel.h: a crowd that frees itself, ranges instead of pointers and strides, exceptions instead of
// statuses. Header only; adds no behaviour. Contracts, units and layouts are swivel.h's.
#pragma once

#if __cplusplus <= 201703L
#error "swivel.hpp is C++20 (-std=c++20); older C++ and C programs use swivel.h"
#else

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <ranges>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "swivel.h"

namespace swivel {

// A failed call: its status, and swivel_last_error() as the text.
struct Error : std::runtime_error {
    explicit Error(swivel_status failed) : std::runtime_error(swivel_last_error()), status(failed) {}
    swivel_status status;
};

inline void check(swivel_status status)
{
    if (status != SWIVEL_OK) throw Error(status);
}

// Limbs that share a binding, for a crowd with SWIVEL_JOINTS; or limbs in the arm frame.
inline swivel_group_def group(std::uint32_t limb_count, const swivel_binding& binding)
{
    swivel_group_def made = swivel_default_group_def(limb_count);
    made.binding = binding;
    return made;
}
inline swivel_group_def group(std::uint32_t limb_count) { return swivel_default_group_def(limb_count); }

// A limb's alignments and bone lengths from its rest pose: swivel_bind().
inline swivel_binding bind(const swivel_chain& chain)
{
    swivel_binding binding;
    check(swivel_bind(&chain, &binding));
    return binding;
}

// Values of limit fields from angles in radians: swivel_range(), swivel_cone(), swivel_flexion(), swivel_aim(),
// swivel_turn().
inline std::array<float, 4> range(double least, double most)
{
    std::array<float, 4> value;
    check(swivel_range(least, most, value.data()));
    return value;
}
inline std::array<float, 4> cone(const std::array<double, 3>& axis, double most)
{
    std::array<float, 4> value;
    check(swivel_cone(axis.data(), most, value.data()));
    return value;
}
inline std::array<float, 2> flexion(double least, double most)
{
    std::array<float, 2> value;
    check(swivel_flexion(least, most, value.data()));
    return value;
}
inline std::array<float, 5> aim(const std::array<double, 3>& axis, double flexion)
{
    std::array<float, 5> value;
    check(swivel_aim(axis.data(), flexion, value.data()));
    return value;
}
inline std::array<float, 2> turn(double angle)
{
    std::array<float, 2> value;
    swivel_turn(angle, value.data());
    return value;
}

// A limb's value: a struct or array of plain floats, a float, or a uint32_t (flags). Doubles, and arrays of them, would
// be taken for floats and do not compile.
template <class Value>
constexpr bool holds_words()
{
    if constexpr (std::is_arithmetic_v<Value>)
        return std::same_as<Value, float> || std::same_as<Value, std::uint32_t>;
    else if constexpr (std::is_array_v<Value>)
        return holds_words<std::remove_cv_t<std::remove_extent_t<Value>>>();
    else if constexpr (requires { typename Value::value_type; })
        return std::is_trivially_copyable_v<Value> && holds_words<std::remove_cv_t<typename Value::value_type>>();
    else
        return std::is_trivially_copyable_v<Value>;
}
template <class Value>
concept FieldValue = holds_words<std::remove_cv_t<Value>>();
template <class Range>
concept FieldRange = std::ranges::contiguous_range<Range> && FieldValue<std::ranges::range_value_t<Range>>;

// The same for what is in double, positions and forward kinematics: a double, or a struct or array of plain doubles.
template <class Value>
constexpr bool holds_doubles()
{
    if constexpr (std::is_arithmetic_v<Value>)
        return std::same_as<Value, double>;
    else if constexpr (std::is_array_v<Value>)
        return holds_doubles<std::remove_cv_t<std::remove_extent_t<Value>>>();
    else if constexpr (requires { typename Value::value_type; })
        return std::is_trivially_copyable_v<Value> && holds_doubles<std::remove_cv_t<typename Value::value_type>>();
    else
        return std::is_trivially_copyable_v<Value>;
}
template <class Range>
concept DoubleRange = std::ranges::contiguous_range<Range> &&
    holds_doubles<std::remove_cv_t<std::ranges::range_value_t<Range>>>();

// Owns one crowd; moves, does not copy. Ranges passed in or out hold one value for each limb from `first` of the group
// on, each value starting with the field's floats (doubles for forward kinematics); larger values are stepped over by
// size.
class Crowd {
public:
    Crowd(std::uint32_t features, std::span<const swivel_group_def> groups)
    {
        swivel_crowd_def def = swivel_default_crowd_def();
        def.features = features;
        def.group_count = static_cast<std::uint32_t>(groups.size());
        def.groups = groups.data();
        check(swivel_crowd_create(&def, &crowd_));
    }
    explicit Crowd(const swivel_crowd_def& def) { check(swivel_crowd_create(&def, &crowd_)); }
    Crowd(Crowd&& other) noexcept : crowd_(std::exchange(other.crowd_, nullptr)) {}
    Crowd& operator=(Crowd&& other) noexcept
    {
        std::swap(crowd_, other.crowd_);
        return *this;
    }
    ~Crowd() { swivel_crowd_destroy(crowd_); }

    swivel_crowd* get() const { return crowd_; }

    template <FieldRange R>
    void write(swivel_field field, std::uint32_t group, const R& values, std::uint32_t first = 0)
    {
        check(swivel_write(crowd_, field, group, first, count(values), {std::ranges::data(values), value_bytes<R>}));
    }
    // The same value for every limb of the group.
    template <FieldValue Value>
    void write_all(swivel_field field, std::uint32_t group, const Value& value)
    {
        check(swivel_write(crowd_, field, group, 0, 0, {&value, sizeof value}));  // group, field and size are right
        check(swivel_write(crowd_, field, group, 0, swivel_group_limb_count(crowd_, group), {&value, 0}));
    }
    // Positions in double, from origins as in swivel.h: {&origin, 0} is one for all.
    template <DoubleRange R>
    void write_doubles(swivel_field field, std::uint32_t group, const R& values, swivel_in origins = {},
                       std::uint32_t first = 0)
    {
        const swivel_in in{std::ranges::data(values), value_bytes<R>};
        check(swivel_write_doubles(crowd_, field, group, first, count(values), in, origins));
    }
    template <FieldRange R>
    void read(swivel_field field, std::uint32_t group, R&& values, std::uint32_t first = 0) const
    {
        check(swivel_read(crowd_, field, group, first, count(values), {std::ranges::data(values), value_bytes<R>}));
    }

    void solve() { check(swivel_solve(crowd_)); }
    void solve_blocks(std::uint32_t first, std::uint32_t count) { check(swivel_solve_blocks(crowd_, first, count)); }
    // One bit for each limb, 32 in a word.
    void solve_active(std::span<const std::uint32_t> words)
    {
        check(swivel_solve_active(crowd_, words.data(), count(words)));
    }
    void solve_active_blocks(std::span<const std::uint32_t> words, std::uint32_t first, std::uint32_t block_count)
    {
        check(swivel_solve_active_blocks(crowd_, words.data(), count(words), first, block_count));
    }
    void solve_list(std::span<const std::uint32_t> limbs)
    {
        check(swivel_solve_list(crowd_, limbs.data(), count(limbs)));
    }
    // One entry of priorities for each group. Both return how many limbs were chosen.
    std::uint32_t choose(std::span<const swivel_in> priorities, std::uint32_t most_blocks,
                         std::span<std::uint32_t> words)
    {
        std::uint32_t chosen = 0;
        check(swivel_choose(crowd_, for_all_groups(priorities), most_blocks, words.data(), count(words), &chosen));
        return chosen;
    }
    std::uint32_t solve_budget(std::span<const swivel_in> priorities, std::uint32_t most_blocks)
    {
        std::uint32_t solved = 0;
        check(swivel_solve_budget(crowd_, for_all_groups(priorities), most_blocks, &solved));
        return solved;
    }
    // One frame for each group.
    void solve_frame(std::span<const swivel_frame> frames)
    {
        check(swivel_solve_frame(crowd_, for_all_groups(frames)));
    }
    void solve_frame_blocks(std::span<const swivel_frame> frames, std::uint32_t first, std::uint32_t count)
    {
        check(swivel_solve_frame_blocks(crowd_, for_all_groups(frames), first, count));
    }

    // swivel_find(): the next limb with any of these flags, from a place on.
    struct Place {
        std::uint32_t group = 0, limb = 0;  // limb: counted within the group
    };
    std::optional<Place> find(std::uint32_t flags) const { return find(flags, {}); }
    std::optional<Place> find(std::uint32_t flags, Place from) const
    {
        return swivel_find(crowd_, flags, &from.group, &from.limb) ? std::optional(from) : std::nullopt;
    }

    void reset(std::uint32_t group) { check(swivel_reset(crowd_, group, 0, swivel_group_limb_count(crowd_, group))); }
    std::vector<swivel_arc> allowed_arcs(std::uint32_t group, std::uint32_t limb) const
    {
        std::uint32_t arc_count = 0;
        check(swivel_allowed_arcs(crowd_, group, limb, nullptr, 0, &arc_count));
        std::vector<swivel_arc> arcs(arc_count);
        check(swivel_allowed_arcs(crowd_, group, limb, arcs.data(), arc_count, &arc_count));
        return arcs;
    }

    template <DoubleRange R>
    void elbows(std::uint32_t group, R&& values, std::uint32_t first = 0) const
    {
        check(swivel_forward(crowd_, group, first, count(values), {std::ranges::data(values), value_bytes<R>}, {}, {}));
    }
    template <DoubleRange R>
    void wrists(std::uint32_t group, R&& values, std::uint32_t first = 0) const
    {
        check(swivel_forward(crowd_, group, first, count(values), {}, {std::ranges::data(values), value_bytes<R>}, {}));
    }
    template <DoubleRange R>
    void hands(std::uint32_t group, R&& values, std::uint32_t first = 0) const
    {
        check(swivel_forward(crowd_, group, first, count(values), {}, {}, {std::ranges::data(values), value_bytes<R>}));
    }
    template <DoubleRange R>
    void joint_angles(std::uint32_t group, swivel_euler_order shoulder, swivel_euler_order wrist, int family,
                      R&& values, std::uint32_t first = 0) const
    {
        check(swivel_joint_angles(crowd_, group, first, count(values), shoulder, wrist, family,
                                  {std::ranges::data(values), value_bytes<R>}));
    }
    template <DoubleRange R>
    void residuals(std::uint32_t group, R&& values, std::uint32_t first = 0) const
    {
        check(swivel_residuals(crowd_, group, first, count(values), {std::ranges::data(values), value_bytes<R>}));
    }

private:
    template <class R>
    static constexpr std::size_t value_bytes = sizeof(std::ranges::range_value_t<R>);
    template <class R>
    static std::uint32_t count(const R& values)
    {
        return static_cast<std::uint32_t>(std::ranges::size(values));
    }

    // Null, which the call refuses, if they are too few: then there are limbs in a group past the last one's.
    template <class Each>
    const Each* for_all_groups(std::span<const Each> each) const
    {
        return swivel_group_limb_count(crowd_, count(each)) == 0 ? each.data() : nullptr;
    }

    swivel_crowd* crowd_ = nullptr;
};

}  // namespace swivel

#endif
