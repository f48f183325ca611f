// SPDX-License-Identifier: MIT
//
// C++ on top of swivel.h. A crowd frees itself, ranges replace pointers and strides, and exceptions replace statuses.
// Calls check how many values a range has. Header only. Contracts, units and layouts are swivel.h's.
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
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <optional>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "swivel_bodies.h"

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define SWIVEL_HAS_EXCEPTIONS 1
#define SWIVEL_NAMESPACE swivel
#else
// A name of its own. Otherwise a linker could give these functions to a file that expects an exception.
#define SWIVEL_NAMESPACE swivel::inline without_exceptions
#ifndef SWIVEL_ON_ERROR
#define SWIVEL_ON_ERROR(status, text) std::fprintf(stderr, "swivel: %s\n", text)
#endif
#endif
namespace SWIVEL_NAMESPACE {

// A failed call: its status, and one line of text, which is swivel_last_error() where the library refused it.
struct Error : std::runtime_error {
    Error(swivel_status failed, const std::string& text) : std::runtime_error(text), status(failed) {}
    swivel_status status;
};
[[noreturn]] inline void fail([[maybe_unused]] swivel_status status, [[maybe_unused]] const std::string& text)
{
#ifdef SWIVEL_HAS_EXCEPTIONS
    throw Error(status, text);
#else
    SWIVEL_ON_ERROR(status, text.c_str());
    std::abort();
#endif
}
[[noreturn]] inline void fail(const std::string& text) { fail(SWIVEL_INVALID_ARGUMENT, text); }
inline void check(swivel_status status)
{
    if (status != SWIVEL_OK) fail(status, swivel_last_error());
}
inline std::uint32_t count_of(const auto& values) { return static_cast<std::uint32_t>(std::ranges::size(values)); }

// A group of a crowd, of one of the kinds.
using Definition =
    std::variant<swivel_limb_def, swivel_body_limb_def, swivel_look_def, swivel_prop_def, swivel_shift_def>;

// Free limbs that share features; those with SWIVEL_JOINTS share a binding, too.
inline swivel_limb_def limbs(std::uint32_t limb_count, swivel_features features = 0)
{
    swivel_limb_def made = swivel_default_limb_def(limb_count);
    made.features = features;
    return made;
}
// The limb of each body that has these joints, which must live until the crowd is made.
inline swivel_body_limb_def body_limb(const swivel_limb_joints& joints, swivel_features features = 0)
{
    swivel_body_limb_def made = swivel_default_body_limb_def(&joints);
    made.features = features;
    return made;
}
swivel_body_limb_def body_limb(const swivel_limb_joints&& joints, swivel_features features = 0) = delete;
// A chain of joints of each body that looks, from the first to the last, such as spine, neck and head: 1 to 8 of them.
inline swivel_look_def look(std::span<const std::uint32_t> joints)
{
    swivel_look_def made = swivel_default_look_def();
    made.joint_count = count_of(joints);
    for (std::size_t n = 0; n < joints.size() && n < SWIVEL_MAX_LOOK_JOINTS; ++n) made.joints[n] = joints[n];
    return made;
}
inline swivel_look_def look(std::initializer_list<std::uint32_t> joints) { return look(std::vector(joints)); }

// A limb's alignments and bone lengths from its rest pose: swivel_bind_joints().
inline swivel_binding bind(const swivel_skeleton& skeleton, const swivel_limb_joints& joints)
{
    swivel_binding binding = swivel_default_binding();
    check(swivel_bind_joints(&skeleton, &joints, &binding));
    return binding;
}

// The numbers that a function of swivel.h writes to its last argument.
template <std::size_t size, class Number = float, class Make, class... Arguments>
std::array<Number, size> written_by(Make make, Arguments... arguments)
{
    std::array<Number, size> value;
    check(make(arguments..., value.data()));
    return value;
}
using Axis = std::array<double, 3>;  // of any length but zero
// A direction of the character at rest in the arm frame: swivel_arm_axis().
inline Axis arm_axis(const swivel_binding& binding, const std::array<float, 4>& parent_rotation, const Axis& direction)
{
    return written_by<3, double>(swivel_arm_axis, &binding, parent_rotation.data(), direction.data());
}
// Values of fields from angles in radians, as swivel_range(), swivel_cone() and so on make them.
inline std::array<float, 4> range(double min, double max) { return written_by<4>(swivel_range, min, max); }
inline std::array<float, 4> cone(const Axis& axis, double max) { return written_by<4>(swivel_cone, axis.data(), max); }
inline std::array<float, 2> flexion(double min, double max) { return written_by<2>(swivel_flexion, min, max); }
inline std::array<float, 5> aim(const Axis& axis, double flexion)
{
    return written_by<5>(swivel_aim, axis.data(), flexion);
}
inline std::array<float, 2> cos_sin(double angle)
{
    std::array<float, 2> value;
    swivel_cos_sin(angle, value.data());
    return value;
}
constexpr double degrees(double angle) { return angle * (3.14159265358979323846 / 180); }  // of degrees, in radians

// Whether a limb's value is made of one of these numbers: an arithmetic type itself, an array, a container with a
// value_type, or a plain structure that starts with a number. Other classes are taken at their word.
template <class Value, class... Numbers>
constexpr bool is_made_of()
{
    using Each = std::remove_cv_t<std::remove_all_extents_t<Value>>;
    constexpr auto starts_with = [](auto number) {
        return std::is_aggregate_v<Each> && requires { Each{number}; };
    };
    if constexpr (std::is_arithmetic_v<Each>)
        return (std::same_as<Each, Numbers> || ...);
    else if constexpr (requires { typename Each::value_type; })
        return is_made_of<typename Each::value_type, Numbers...>();
    else if constexpr (starts_with(1.0))  // a float would do, too
        return (std::same_as<double, Numbers> || ...);
    else  // it starts with one of these, or with no number
        return (starts_with(Numbers()) || ...) || !(starts_with(1.0f) || starts_with(1u) || starts_with(1));
}
template <class Value, class... Numbers>
concept MadeOf = std::is_trivially_copyable_v<std::remove_cv_t<Value>> && is_made_of<Value, Numbers...>();
// A field's value is of floats, or a uint32_t (flags). Positions and forward kinematics may be of doubles.
template <class Value>
concept FieldValue = MadeOf<Value, float, std::uint32_t>;
template <class Value>
concept DoubleValue = MadeOf<Value, double>;
template <class Range>
concept FieldRange = std::ranges::contiguous_range<Range> && FieldValue<std::ranges::range_value_t<Range>>;
template <class Range>
concept DoubleRange = std::ranges::contiguous_range<Range> && DoubleValue<std::ranges::range_value_t<Range>>;

inline swivel_field_info describe(swivel_field field)
{
    swivel_field_info info;
    for (std::uint32_t index = 0; swivel_describe_field(index, &info); ++index)
        if (info.field == field) return info;
    fail("there is no field " + std::to_string(field));
}
// Refuses flags in floats, and an array of more than four floats for a field of at most four: a matrix is no rotation.
template <class Value>
void check_value(swivel_field field)
{
    constexpr bool is_list = std::is_array_v<Value> || requires { typename Value::value_type; };
    constexpr std::size_t size = sizeof(Value) / sizeof(float);
    if constexpr (!MadeOf<Value, std::uint32_t>)
        if (field == SWIVEL_FLAGS) fail("flags are bits; give a uint32_t for each limb");
    if constexpr (is_list && size > 4 && FieldValue<Value>)
        if (describe(field).max_components <= 4)
            fail("an array of " + std::to_string(size) + " floats is no value of " + describe(field).name);
}

// A member of the caller's structures, for streams, for swivel_in, or for swivel_out unless it is const.
template <class Value>
struct Stream {
    Value* data;
    std::size_t stride;
    operator swivel_in() const { return {data, stride}; }
    operator swivel_out() const requires(!std::is_const_v<Value>) { return {data, stride}; }
};
// A member of each structure: swivel::stream(characters, &Character::grip), or a function that returns a reference.
// Without characters it is null, which leaves the field out. Doubles are for positions, int32_t for skeletons' parents.
template <std::ranges::contiguous_range Range, class Member = std::identity>
requires std::ranges::borrowed_range<Range>
auto stream(Range&& values, Member member = {})
{
    auto* const first = std::ranges::data(values);
    using Value = std::remove_reference_t<decltype(std::invoke(member, *first))>;
    static_assert(MadeOf<Value, float, double, std::uint32_t, std::int32_t>);
    return Stream<Value>{std::ranges::empty(values) ? nullptr : &std::invoke(member, *first), sizeof *first};
}

// A group's values in the caller's arrays, which must outlive it and stay where they are. Keep it from solve to solve.
// It becomes a swivel_streams, which views it until it moves or ends, without what is added later.
class Streams {
public:
    Streams& in(swivel_field field, const swivel_in& values) &
    {
        if (field >= SWIVEL_INPUT_END) fail("streams take in no result; give it by out()");
        return add({field, const_cast<void*>(values.data), values.stride});  // inputs are only read
    }
    Streams& out(swivel_field field, const swivel_out& values) &
    {
        if (field < SWIVEL_INPUT_END) fail("streams put out no input; give it by in()");
        return add({field, values.data, values.stride});
    }
    template <class Value>
    Streams& in(swivel_field, const Stream<Value>&)& = delete;  // neither floats nor doubles
    template <class Value>
    requires(FieldValue<Value> || DoubleValue<Value>) Streams& in(swivel_field field, const Stream<Value>& values) &
    {
        check_value<std::remove_cv_t<Value>>(field);
        const bool may_be_floats = FieldValue<Value>, may_be_doubles = DoubleValue<Value>;
        const swivel_field_info info = describe(field);
        if (!may_be_floats && !info.is_position) fail(info.name + std::string(" is no position; give it floats"));
        if (info.is_position && may_be_floats != may_be_doubles) {
            if (view_.positions == (may_be_floats ? SWIVEL_DOUBLES : SWIVEL_FLOATS))
                fail("streams mix positions in floats and in doubles; give all in one");
            view_.positions = may_be_floats ? SWIVEL_FLOATS : SWIVEL_DOUBLES;
        }
        return in(field, swivel_in(values));
    }
    template <class Value>
    Streams& out(swivel_field, const Stream<Value>&) & = delete;  // no floats to write to
    template <FieldValue Value>
    requires(!std::is_const_v<Value>) Streams& out(swivel_field field, const Stream<Value>& values) &
    {
        check_value<Value>(field);
        return out(field, swivel_out(values));
    }
    void origin(const swivel_in& values) { view_.origin = values; }  // positions are doubles; this is subtracted
    operator swivel_streams() const&
    {
        swivel_streams view = view_;
        view.fields = fields_.data();
        return view;
    }
    operator swivel_streams() const&& = delete;  // which would view what ends with its line

private:
    Streams& add(const swivel_stream& field)
    {
        if (view_.field_count == fields_.size()) fail("streams list more fields than a group has");
        fields_[view_.field_count++] = field;
        return *this;
    }
    std::array<swivel_stream, 64> fields_ = {};       // as many as a group has
    swivel_streams view_ = swivel_default_streams();  // views start from it; it counts the fields added
};

// Samples the ground, on several threads at once. A capture of more than two pointers may allocate; std::ref does not.
using Sample = std::function<void(const swivel_probes&)>;
// Samples for one solve. An exception waits here until the solve is over, because none may cross C.
struct Sampling {
    const Sample& ask;
    std::atomic<std::uint32_t> failures = 0;  // a word: some CPUs exchange no single byte
    std::exception_ptr exception = {};
    static void answer(const swivel_probes* asked, void* user)
    {
        auto& self = *static_cast<Sampling*>(user);
        if (self.failures.load(std::memory_order_relaxed) > 0) return;
#ifdef SWIVEL_HAS_EXCEPTIONS
        try {
            self.ask(*asked);
        } catch (...) {
            if (self.failures.fetch_add(1) == 0) self.exception = std::current_exception();
        }
#else
        self.ask(*asked);
#endif
    }
};

// One solve, as swivel_job. By default it solves every limb, from and to rows, on oneTBB. It views groups, mask and
// Streams objects, which must outlive it and stay where they are. To make streams allocates; keep the Job.
struct Job {
    std::optional<swivel_blocks> blocks = {};
    std::optional<std::span<const std::uint32_t>> groups = {};  // their numbers, which a solve allocates bits for
    std::optional<std::span<const std::uint32_t>> mask = {};    // bits, (swivel_block_count() + 1) / 2 words of them
    std::vector<swivel_streams> streams = {};  // one for each group named, in the crowd's order; empty: rows
    bool on_this_thread = false;
    void* workspace = nullptr;          // memory for this call alone; null: one of the crowd's workspaces
    const swivel_pose* pose = nullptr;  // of bodies; null in a crowd of free limbs
    // For groups WITH_GROUND. If it throws, no more feet ask, and solve() throws the first exception at its end.
    Sample sample = {};
};

// Owns one crowd; moves, does not copy. A range has a value for each limb of the group or, with `first`, for some limbs
// from that one on. Each value starts with the field's numbers; the rest of a larger value is skipped.
class Crowd {
public:
    using First = std::optional<std::uint32_t>;
    explicit Crowd(const swivel_crowd_def& def) { check(swivel_crowd_create(&def, &crowd_)); }
    explicit Crowd(const std::vector<Definition>& groups) { create(swivel_default_crowd_def(), groups); }
    Crowd(std::initializer_list<Definition> groups) : Crowd(std::vector(groups)) {}
    explicit Crowd(const Definition& group) : Crowd(std::vector{group}) {}
    // Bodies of one skeleton: groups of their limbs, and of looks, props and a shift. up: see swivel_crowd_def.
    Crowd(const swivel_skeleton& skeleton, std::uint32_t body_count, const std::vector<Definition>& groups,
          const std::array<float, 3>& up = {0, 1, 0})
    {
        swivel_crowd_def def = swivel_default_crowd_def();
        def.skeleton = &skeleton;
        def.body_count = body_count;
        for (std::size_t c = 0; c < 3; ++c) def.up[c] = up[c];
        create(def, groups);
    }
    Crowd(Crowd&& other) noexcept : crowd_(std::exchange(other.crowd_, nullptr)) {}
    Crowd& operator=(Crowd&& other) noexcept
    {
        std::swap(crowd_, other.crowd_);
        return *this;
    }
    ~Crowd() { swivel_crowd_destroy(crowd_); }
    swivel_crowd* get() const { return crowd_; }
    void write(swivel_field field, std::uint32_t group, const FieldRange auto& values, First first = {})
    {
        check_value<std::ranges::range_value_t<decltype(values)>>(field);
        check(swivel_write(crowd_, field, group, first.value_or(0), checked(group, values, first), stream(values)));
    }
    // The same value for every limb of the group; numbers may be in braces.
    void write_all(swivel_field field, std::uint32_t group, const FieldValue auto& value)
    {
        check_value<std::remove_cvref_t<decltype(value)>>(field);
        check(swivel_write(crowd_, field, group, 0, 0, {&value, sizeof value}));  // group, field and size are right
        check(swivel_write(crowd_, field, group, 0, swivel_group_limb_count(crowd_, group), {&value, 0}));
    }
    template <std::size_t size>
    void write_all(swivel_field field, std::uint32_t group, const float (&value)[size])
    {
        write_all<float[size]>(field, group, value);
    }
    // Positions in double, from origins as in swivel.h: {&origin, 0} is one for all.
    void write_doubles(swivel_field field, std::uint32_t group, const DoubleRange auto& values, swivel_in origins = {},
                       First first = {})
    {
        check(swivel_write_doubles(crowd_, field, group, first.value_or(0), checked(group, values, first),
                                   stream(values), origins));
    }
    void read(swivel_field field, std::uint32_t group, FieldRange auto&& values, First first = {}) const
    {
        check_value<std::ranges::range_value_t<decltype(values)>>(field);
        check(swivel_read(crowd_, field, group, first.value_or(0), checked(group, values, first), stream(values)));
    }
    // swivel_solve(): crowd.solve(), or crowd.solve({.streams = {arms}}). Returns how many limbs were solved.
    std::uint32_t solve(const Job& wanted = {})
    {
        swivel_job job = swivel_default_job();
        std::vector<std::uint32_t> named;
        if (wanted.blocks) job.blocks = &*wanted.blocks;
        if (wanted.groups) {
            named = bits_of(*wanted.groups);
            job.groups = named.data();
            job.group_word_count = count_of(named);
        }
        if (wanted.mask) {
            static constexpr std::uint32_t no_words = 0;  // the library refuses it; a null mask would be none
            job.mask = wanted.mask->empty() ? &no_words : wanted.mask->data();
            job.mask_word_count = count_of(*wanted.mask);
        }
        if (!wanted.streams.empty()) {
            check_count(wanted.streams.size(), "streams",
                        wanted.groups ? wanted.groups->size() : swivel_group_count(crowd_), "groups");
            job.streams = wanted.streams.data();
        }
        job.on_this_thread = wanted.on_this_thread;
        job.workspace = wanted.workspace;
        job.pose = wanted.pose;
        Sampling sampling{wanted.sample};
        job.sample = wanted.sample ? &Sampling::answer : nullptr;
        job.sample_user = &sampling;
        std::uint32_t solved = 0;
        job.solved_count = &solved;
        check(swivel_solve(crowd_, &job));
        if (sampling.exception) std::rethrow_exception(sampling.exception);
        return solved;
    }
    // swivel_choose(): marks limbs in a mask and returns how many. Without urgency, priorities alone decide.
    std::uint32_t choose(std::span<const swivel_in> priorities, std::span<float> urgency, std::uint32_t max_blocks,
                         std::span<std::uint32_t> mask)
    {
        const bool is_of_bodies = swivel_group_kind(crowd_, 0) != SWIVEL_KIND_LIMB;
        check_count(priorities.size(), "priorities", is_of_bodies ? 1 : swivel_group_count(crowd_), "groups");
        if (!urgency.empty()) check_count(urgency.size(), "urgencies", swivel_block_count(crowd_), "blocks");
        std::uint32_t chosen = 0;
        check(swivel_choose(crowd_, priorities.data(), urgency.empty() ? nullptr : urgency.data(), max_blocks,
                            mask.data(), count_of(mask), &chosen));
        return chosen;
    }
    void reset(std::uint32_t group) { check(swivel_reset(crowd_, group, 0, swivel_group_limb_count(crowd_, group))); }
    // The state of bodies: swivel_reset_body() of some, swivel_save() and swivel_load() of all.
    void reset_bodies(std::uint32_t first, std::uint32_t count) { check(swivel_reset_body(crowd_, first, count)); }
    void save(std::span<std::byte> out) const { check(swivel_save(crowd_, 0, body_count(), out.data(), out.size())); }
    void load(std::span<const std::byte> in) { check(swivel_load(crowd_, 0, body_count(), in.data(), in.size())); }
    std::uint64_t state_digest() const { return swivel_state_digest(crowd_); }
    std::vector<swivel_arc> allowed_arcs(std::uint32_t group, std::uint32_t limb) const
    {
        std::uint32_t arc_count = 0;
        check(swivel_allowed_arcs(crowd_, group, limb, nullptr, 0, &arc_count));
        std::vector<swivel_arc> arcs(arc_count);
        check(swivel_allowed_arcs(crowd_, group, limb, arcs.data(), arc_count, &arc_count));
        return arcs;
    }
    // swivel_forward(), of one joint; swivel_joint_angles(); swivel_residuals().
    void elbows(std::uint32_t group, DoubleRange auto&& values, First first = {}) const
    {
        check(swivel_forward(crowd_, group, first.value_or(0), checked(group, values, first), stream(values), {}, {}));
    }
    void wrists(std::uint32_t group, DoubleRange auto&& values, First first = {}) const
    {
        check(swivel_forward(crowd_, group, first.value_or(0), checked(group, values, first), {}, stream(values), {}));
    }
    void hands(std::uint32_t group, DoubleRange auto&& values, First first = {}) const
    {
        check(swivel_forward(crowd_, group, first.value_or(0), checked(group, values, first), {}, {}, stream(values)));
    }
    void joint_angles(std::uint32_t group, swivel_euler_order shoulder, swivel_euler_order wrist, int family,
                      DoubleRange auto&& values, First first = {}) const
    {
        check(swivel_joint_angles(crowd_, group, first.value_or(0), checked(group, values, first), shoulder, wrist,
                                  family, stream(values)));
    }
    void residuals(std::uint32_t group, DoubleRange auto&& values, First first = {}) const
    {
        check(swivel_residuals(crowd_, group, first.value_or(0), checked(group, values, first), stream(values)));
    }
    // swivel_pack(): the words of a group's results, all of its blocks.
    std::vector<std::uint16_t> pack(std::uint32_t group) const
    {
        const std::uint32_t blocks = (swivel_group_limb_count(crowd_, group) + SWIVEL_LANES - 1) / SWIVEL_LANES;
        const std::size_t rows = swivel_packed_row(crowd_, group, SWIVEL_RESULT_END);
        std::vector<std::uint16_t> words(blocks * rows * SWIVEL_LANES);
        check(swivel_pack(crowd_, group, {0, blocks}, words.data()));
        return words;
    }
    std::uint64_t digest() const { return swivel_digest(crowd_); }

private:
    std::uint32_t body_count() const { return swivel_group_limb_count(crowd_, 0); }
    void create(swivel_crowd_def def, const std::vector<Definition>& groups)
    {
        std::vector<swivel_group_def> defs;
        for (const Definition& group : groups) {
            swivel_group_def& each = defs.emplace_back(swivel_default_group_def());
            each.limb = std::get_if<swivel_limb_def>(&group);
            each.body_limb = std::get_if<swivel_body_limb_def>(&group);
            each.look = std::get_if<swivel_look_def>(&group);
            each.prop = std::get_if<swivel_prop_def>(&group);
            each.shift = std::get_if<swivel_shift_def>(&group);
        }
        def.groups = defs.data();
        def.group_count = count_of(defs);
        check(swivel_crowd_create(&def, &crowd_));
    }
    // How many values there are for limbs from `first` on: without it one for each limb of the group.
    std::uint32_t checked(std::uint32_t group, const auto& values, First first) const
    {
        const std::uint32_t has = swivel_group_limb_count(crowd_, group);  // 0: the call says that there is no group
        if (!first && has > 0)
            check_count(count_of(values), "values", has, "limbs", ", or pass the number of the first limb, too");
        return count_of(values);
    }
    static void check_count(std::size_t given, const char* what, std::size_t wanted, const char* of_what,
                            const char* or_else = "")
    {
        if (given != wanted)
            fail(std::to_string(given) + " " + what + " for " + std::to_string(wanted) + " " + of_what +
                 "; give one for each" + or_else);
    }
    // A bit for each group, set for these.
    std::vector<std::uint32_t> bits_of(std::span<const std::uint32_t> groups) const
    {
        const std::uint32_t count = swivel_group_count(crowd_);
        std::vector<std::uint32_t> words((count + 31) / 32);
        for (const std::uint32_t group : groups) {
            if (group >= count)
                fail("group " + std::to_string(group) + " does not exist; this crowd has " + std::to_string(count));
            if (words[group / 32] >> group % 32 & 1) fail("group " + std::to_string(group) + " is named twice");
            words[group / 32] |= 1u << group % 32;
        }
        return words;
    }
    swivel_crowd* crowd_ = nullptr;
};

}  // namespace swivel
#endif
