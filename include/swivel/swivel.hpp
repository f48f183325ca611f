// SPDX-License-Identifier: MIT
//
// C++ on top of swivel.h: a crowd that frees itself, ranges instead of pointers and strides, exceptions instead of
// statuses, and checks of how many values a range has. Header only. Contracts, units and layouts are swivel.h's.
//
// A call that fails throws swivel::Error. Without exceptions (-fno-exceptions) it prints the error's line and aborts.
// To do something else before the abort, define SWIVEL_ON_ERROR(status, text) before each include, everywhere the same.
// The text is a const char*. A program that must go on after an error uses swivel.h, whose calls return statuses.
#pragma once

// Microsoft's compiler tells its standard here; there __cplusplus is that of C++98 without /Zc:__cplusplus.
#if (!defined(_MSVC_LANG) || _MSVC_LANG <= 201703L) && __cplusplus <= 201703L
#error "swivel.hpp is C++20 (-std=c++20); older C++ and C programs use swivel.h"
#else

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "swivel.h"

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
namespace swivel {

// A failed call: its status, and one line of text, which is swivel_last_error() where the library refused it.
struct Error : std::runtime_error {
    explicit Error(swivel_status failed) : Error(failed, swivel_last_error()) {}
    Error(swivel_status failed, const std::string& text) : std::runtime_error(text), status(failed) {}
    swivel_status status;
};

[[noreturn]] inline void fail(swivel_status status, const std::string& text) { throw Error(status, text); }
#else
#ifndef SWIVEL_ON_ERROR
#define SWIVEL_ON_ERROR(status, text) std::fprintf(stderr, "swivel: %s\n", text)
#endif
// A name of its own. Otherwise a linker could give these functions to a file that expects an exception.
namespace swivel::inline without_exceptions {

[[noreturn]] inline void fail([[maybe_unused]] swivel_status status, [[maybe_unused]] const std::string& text)
{
    SWIVEL_ON_ERROR(status, text.c_str());
    std::abort();
}
#endif

inline void check(swivel_status status)
{
    if (status != SWIVEL_OK) fail(status, swivel_last_error());
}

// Limbs that share features; those with SWIVEL_JOINTS share a binding, too.
inline swivel_group_def group(std::uint32_t limb_count, swivel_features features = 0)
{
    swivel_group_def made = swivel_default_group_def(limb_count);
    made.features = features;
    return made;
}
inline swivel_group_def group(std::uint32_t limb_count, const swivel_binding& binding, swivel_features features)
{
    swivel_group_def made = group(limb_count, features);
    made.binding = binding;
    return made;
}

// A limb's alignments and bone lengths from its rest pose: swivel_bind().
inline swivel_binding bind(const swivel_chain& chain)
{
    swivel_binding binding;
    check(swivel_bind(&chain, &binding));
    return binding;
}
// The same from joints of a skeleton: swivel_bind_joints().
inline swivel_binding bind(const swivel_skeleton& skeleton, const swivel_limb_joints& joints)
{
    swivel_binding binding;
    check(swivel_bind_joints(&skeleton, &joints, &binding));
    return binding;
}

// A direction of the character at rest in the arm frame: swivel_arm_axis().
inline std::array<double, 3> arm_axis(const swivel_binding& binding, const std::array<float, 4>& parent_rotation,
                                      const std::array<double, 3>& direction)
{
    std::array<double, 3> axis;
    check(swivel_arm_axis(&binding, parent_rotation.data(), direction.data(), axis.data()));
    return axis;
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

// The lecture's five steps for one arm, entity by entity: swivel_steps().
struct Steps {
    std::vector<swivel_entity> entities;
    double closing_error;  // from target to wrist, in arm lengths
};
inline Steps steps(const std::array<double, 3>& target, const std::array<double, 3>& pole, double upper, double fore)
{
    Steps made{{}, 0};
    std::uint32_t count = 0;
    check(swivel_steps(target.data(), pole.data(), upper, fore, nullptr, 0, &count, &made.closing_error));
    made.entities.resize(count);
    check(swivel_steps(target.data(), pole.data(), upper, fore, made.entities.data(), count, nullptr, nullptr));
    return made;
}

// An angle in radians, as all of swivel takes them.
constexpr double degrees(double angle) { return angle * (3.14159265358979323846 / 180); }

// Converts to such numbers and to nothing else.
template <class... Numbers>
struct Only {
    template <class Number>
    requires(std::same_as<Number, Numbers> || ...) operator Number() const;
};
struct AnyNumber {
    template <class Number>
    requires std::is_arithmetic_v<Number>
    operator Number() const;
};

// Whether a limb's value is made of such numbers: one of them, an array of them, or a container that says so by its
// value_type. A plain structure must not start with another number; classes with constructors are taken at their word.
template <class Value, class... Numbers>
constexpr bool holds()
{
    using Each = std::remove_cv_t<Value>;
    if constexpr (std::is_arithmetic_v<Each>)
        return (std::same_as<Each, Numbers> || ...);
    else if constexpr (std::is_array_v<Each>)
        return holds<std::remove_extent_t<Each>, Numbers...>();
    else if constexpr (requires { typename Each::value_type; })
        return std::is_trivially_copyable_v<Each> && holds<typename Each::value_type, Numbers...>();
    else if constexpr (std::is_aggregate_v<Each> && requires { Each{AnyNumber()}; })
        return std::is_trivially_copyable_v<Each> && requires { Each{Only<Numbers...>()}; };
    else
        return std::is_trivially_copyable_v<Each>;
}

// A field's value: floats, or a uint32_t (flags). And what is in double: positions and forward kinematics.
template <class Value>
concept FieldValue = holds<Value, float, std::uint32_t>();
template <class Value>
concept DoubleValue = holds<Value, double>();
// What structures have beside: an int32_t is a skeleton's parent.
template <class Value>
concept StreamValue = FieldValue<Value> || holds<Value, std::int32_t>();
template <class Range>
concept FieldRange = std::ranges::contiguous_range<Range> && FieldValue<std::ranges::range_value_t<Range>>;
template <class Range>
concept DoubleRange = std::ranges::contiguous_range<Range> && DoubleValue<std::ranges::range_value_t<Range>>;

// A member of the caller's structures as frames take it: for a field of a frame, swivel_in, or swivel_out unless it is
// const.
template <class Byte>
struct Stream {
    Byte* data;
    std::size_t stride;

    operator swivel_in() const { return {data, stride}; }
    operator swivel_out() const requires(!std::is_const_v<Byte>) { return {data, stride}; }
};
template <std::ranges::contiguous_range Range, class Struct, class Value>
auto stream_of(Range&& values, Value Struct::*member)
{
    using Element = std::remove_reference_t<std::ranges::range_reference_t<Range>>;
    using Byte = std::conditional_t<std::is_const_v<Element> || std::is_const_v<Value>, const void, void>;
    const auto data = std::ranges::data(values);
    return Stream<Byte>{std::ranges::empty(values) ? nullptr : &(data->*member), sizeof(Element)};
}
// swivel::stream(characters, &Character::grip): where the first one's member is, and the stride. Of no characters it is
// null, which leaves the field out.
template <class Range, class Struct, StreamValue Value>
requires std::ranges::contiguous_range<Range> && std::ranges::borrowed_range<Range>
auto stream(Range&& values, Value Struct::*member) { return stream_of(values, member); }
// The same for positions in double, beside a frame's origin.
template <class Range, class Struct, DoubleValue Value>
requires std::ranges::contiguous_range<Range> && std::ranges::borrowed_range<Range>
auto stream_doubles(Range&& values, Value Struct::*member) { return stream_of(values, member); }

// A group's values in the caller's own arrays, which must outlive it. It becomes a swivel_frame, which views it. Keep
// it from solve to solve while the arrays stay where they are.
//     swivel::Frame frame;
//     frame.in(SWIVEL_TARGET, swivel::stream(characters, &Character::grip));
//     frame.out(SWIVEL_SHOULDER, swivel::stream(characters, &Character::upper_arm));
class Frame {
public:
    Frame& in(swivel_field field, const swivel_in& values)
    {
        if (field >= SWIVEL_INPUT_END) fail(SWIVEL_INVALID_ARGUMENT, "a frame takes in no result; give it by out()");
        fields_.push_back({field, const_cast<void*>(values.data), values.stride});  // inputs are only read
        return *this;
    }
    Frame& out(swivel_field field, const swivel_out& values)
    {
        if (field < SWIVEL_INPUT_END) fail(SWIVEL_INVALID_ARGUMENT, "a frame puts out no input; give it by in()");
        fields_.push_back({field, values.data, values.stride});
        return *this;
    }
    // Positions are doubles, and this is subtracted.
    Frame& origin(const swivel_in& values)
    {
        origin_ = values;
        return *this;
    }
    operator swivel_frame() const
    {
        swivel_frame frame = swivel_default_frame();
        frame.fields = fields_.data();
        frame.field_count = static_cast<std::uint32_t>(fields_.size());
        frame.origin = origin_;
        return frame;
    }

private:
    std::vector<swivel_frame_field> fields_;
    swivel_in origin_ = {};
};

// A range that was given, empty or not; or none. It views a std::span, or a range that has a name, and that range must
// outlive it. Values in braces and other ranges without a name end with their line. It keeps copies of those, which
// allocates.
template <class Each>
class Given {
public:
    Given() = default;
    Given(const Each* first, std::size_t count) : values_(std::span<const Each>(first, count)) {}
    Given(std::initializer_list<Each> values) : values_(std::vector<Each>(values)) {}
    template <std::convertible_to<std::span<const Each>> Range>
    Given(Range&& range)
    {
        const std::span<const Each> values(range);
        if constexpr (std::is_lvalue_reference_v<Range> || std::ranges::borrowed_range<Range>)
            values_ = values;
        else
            values_ = std::vector<Each>(values.begin(), values.end());
    }
    explicit operator bool() const { return values_.index() > 0; }
    std::span<const Each> operator*() const
    {
        const auto* const kept = std::get_if<std::vector<Each>>(&values_);
        return kept ? std::span<const Each>(*kept) : *std::get_if<std::span<const Each>>(&values_);
    }

private:
    std::variant<std::monostate, std::span<const Each>, std::vector<Each>> values_;
};

// What a solve does, as swivel_job; left out, it is every limb, from and to rows, on oneTBB. Of mask, limbs and
// priorities at most one is given.
struct Job {
    std::optional<swivel_blocks> blocks = {};
    Given<std::uint32_t> groups = {};  // their numbers, which a solve allocates bits for
    Given<std::uint32_t> mask = {}, limbs = {};
    Given<swivel_in> priorities = {};  // one for each group
    std::span<float> urgency = {};     // with priorities: one for each block, kept by the caller
    std::uint32_t most_blocks = 0;     // with priorities
    Given<swivel_frame> frames = {};   // one for each group that is named; a Frame converts to one
    bool on_this_thread = false;
};

// Owns one crowd; moves, does not copy. Ranges passed in or out hold one value for each limb of the group; or, with
// `first`, for some limbs from that one on. Each value starts with the field's floats (doubles for forward kinematics);
// larger values are stepped over by size.
class Crowd {
public:
    explicit Crowd(std::span<const swivel_group_def> groups)
    {
        swivel_crowd_def def = swivel_default_crowd_def();
        def.group_count = static_cast<std::uint32_t>(groups.size());
        def.groups = groups.data();
        check(swivel_crowd_create(&def, &crowd_));
    }
    // Groups in braces: {left_arms, right_arms}. Their addresses would be taken for the ends of a range.
    Crowd(std::initializer_list<swivel_group_def> groups) : Crowd(std::span(groups.begin(), groups.size())) {}
    Crowd(std::initializer_list<const swivel_group_def*> groups) = delete;
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
    void write(swivel_field field, std::uint32_t group, const R& values, std::optional<std::uint32_t> first = {})
    {
        check(swivel_write(crowd_, field, group, first.value_or(0), checked(group, count(values), first), in(values)));
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
                       std::optional<std::uint32_t> first = {})
    {
        check(swivel_write_doubles(crowd_, field, group, first.value_or(0), checked(group, count(values), first),
                                   in(values), origins));
    }
    template <FieldRange R>
    void read(swivel_field field, std::uint32_t group, R&& values, std::optional<std::uint32_t> first = {}) const
    {
        check(swivel_read(crowd_, field, group, first.value_or(0), checked(group, count(values), first), out(values)));
    }

    // swivel_solve(): crowd.solve(), or crowd.solve({.frames = {frame}}). Returns how many limbs were solved.
    std::uint32_t solve(const Job& wanted = {})
    {
        swivel_job job = swivel_default_job();
        const swivel_limbs limbs =
            wanted.limbs ? swivel_limbs{(*wanted.limbs).data(), count(*wanted.limbs)} : swivel_limbs{};
        const std::uint32_t group_count = swivel_group_count(crowd_);
        std::vector<std::uint32_t> named;
        if (wanted.blocks) job.blocks = &*wanted.blocks;
        if (wanted.groups) {
            named = bits_of(*wanted.groups);
            job.groups = named.data();
            job.group_word_count = count(named);
        }
        if (wanted.mask) {
            job.mask = data(*wanted.mask);
            job.mask_word_count = count(*wanted.mask);
        }
        if (wanted.limbs) job.limbs = &limbs;
        if (wanted.priorities) job.priorities = for_groups("priorities", *wanted.priorities, group_count).data();
        if (!wanted.urgency.empty()) job.urgency = for_blocks(wanted.urgency);
        job.most_blocks = wanted.most_blocks;
        if (wanted.frames)
            job.frames = for_groups("frames", *wanted.frames, wanted.groups ? bit_count(named) : group_count).data();
        job.on_this_thread = wanted.on_this_thread;
        std::uint32_t solved = 0;
        job.solved_count = &solved;
        check(swivel_solve(crowd_, &job));
        return solved;
    }
    // swivel_choose(): marks limbs in a mask and returns how many.
    std::uint32_t choose(std::span<const swivel_in> priorities, std::span<float> urgency, std::uint32_t most_blocks,
                         std::span<std::uint32_t> mask)
    {
        std::uint32_t chosen = 0;
        check(swivel_choose(crowd_, for_groups("priorities", priorities, swivel_group_count(crowd_)).data(),
                            urgency.empty() ? nullptr : for_blocks(urgency), most_blocks, mask.data(), count(mask),
                            &chosen));
        return chosen;
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

    // swivel_explain(): why a limb is as it is, in words.
    std::string explain(std::uint32_t group, std::uint32_t limb) const
    {
        std::string text(SWIVEL_EXPLANATION_BYTES, '\0');
        check(swivel_explain(crowd_, group, limb, text.data(), text.size()));
        text.resize(text.find('\0'));
        return text;
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
    void elbows(std::uint32_t group, R&& values, std::optional<std::uint32_t> first = {}) const
    {
        check(swivel_forward(crowd_, group, first.value_or(0), checked(group, count(values), first), out(values), {},
                             {}));
    }
    template <DoubleRange R>
    void wrists(std::uint32_t group, R&& values, std::optional<std::uint32_t> first = {}) const
    {
        check(swivel_forward(crowd_, group, first.value_or(0), checked(group, count(values), first), {}, out(values),
                             {}));
    }
    template <DoubleRange R>
    void hands(std::uint32_t group, R&& values, std::optional<std::uint32_t> first = {}) const
    {
        check(swivel_forward(crowd_, group, first.value_or(0), checked(group, count(values), first), {}, {},
                             out(values)));
    }
    template <DoubleRange R>
    void joint_angles(std::uint32_t group, swivel_euler_order shoulder, swivel_euler_order wrist, int family,
                      R&& values, std::optional<std::uint32_t> first = {}) const
    {
        check(swivel_joint_angles(crowd_, group, first.value_or(0), checked(group, count(values), first), shoulder,
                                  wrist, family, out(values)));
    }
    template <DoubleRange R>
    void residuals(std::uint32_t group, R&& values, std::optional<std::uint32_t> first = {}) const
    {
        check(swivel_residuals(crowd_, group, first.value_or(0), checked(group, count(values), first), out(values)));
    }
    std::uint64_t digest() const { return swivel_digest(crowd_); }

private:
    // How many values there are for limbs from `first` on: without it one for each limb of the group.
    std::uint32_t checked(std::uint32_t group, std::uint32_t given, std::optional<std::uint32_t> first) const
    {
        const std::uint32_t has = swivel_group_limb_count(crowd_, group);  // 0: the call says that there is no group
        if (!first && given != has && has > 0)
            fail(SWIVEL_INVALID_ARGUMENT, std::to_string(given) + " values for the " + std::to_string(has) +
                                              " limbs of group " + std::to_string(group) +
                                              "; give one for each, or say from which limb on");
        return given;
    }
    // Where values lie. An empty range may have null data, which calls refuse.
    template <class R>
    static auto data(R&& values) -> decltype(std::ranges::data(values))
    {
        static std::max_align_t nothing;
        using Data = decltype(std::ranges::data(values));
        return std::ranges::empty(values) ? reinterpret_cast<Data>(&nothing) : std::ranges::data(values);
    }
    template <class R>
    static swivel_in in(const R& values)
    {
        return {data(values), sizeof(std::ranges::range_value_t<R>)};
    }
    template <class R>
    static swivel_out out(R& values)
    {
        return {data(values), sizeof(std::ranges::range_value_t<R>)};
    }
    template <class R>
    static std::uint32_t count(const R& values)
    {
        return static_cast<std::uint32_t>(std::ranges::size(values));
    }

    template <class Each>
    static std::span<const Each> for_groups(const char* what, std::span<const Each> each, std::uint32_t groups)
    {
        if (each.size() != groups)
            fail(SWIVEL_INVALID_ARGUMENT, std::to_string(each.size()) + " " + what + " for " + std::to_string(groups) +
                                              " groups; give one for each");
        return each;
    }
    float* for_blocks(std::span<float> urgency) const
    {
        const std::uint32_t blocks = swivel_block_count(crowd_);
        if (urgency.size() != blocks)
            fail(SWIVEL_INVALID_ARGUMENT, std::to_string(urgency.size()) + " urgencies for " + std::to_string(blocks) +
                                              " blocks; give one for each");
        return urgency.data();
    }
    // A bit for each group, set for these.
    std::vector<std::uint32_t> bits_of(std::span<const std::uint32_t> groups) const
    {
        const std::uint32_t group_count = swivel_group_count(crowd_);
        std::vector<std::uint32_t> words((group_count + 31) / 32);
        for (const std::uint32_t group : groups) {
            if (group >= group_count)
                fail(SWIVEL_INVALID_ARGUMENT, "group " + std::to_string(group) + " does not exist; this crowd has " +
                                                  std::to_string(group_count));
            words[group / 32] |= 1u << group % 32;
        }
        return words;
    }
    static std::uint32_t bit_count(std::span<const std::uint32_t> words)
    {
        int bits = 0;
        for (const std::uint32_t word : words) bits += std::popcount(word);
        return static_cast<std::uint32_t>(bits);
    }

    swivel_crowd* crowd_ = nullptr;
};

}  // namespace swivel

#endif
