// SPDX-License-Identifier: MIT
//
// The limb is solved again in a crowd of its own, on the stack. Which input is bad, and what a limit did, is found by
// giving it up: with a value that asks for nothing in its place the limb is good, or goes where it was wished to.
// Degrees are for people: trigonometry is allowed here, as no solve sees it.
#include "batch/explain.h"

#include <bit>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <numbers>

#include "batch/edge.h"
#include "batch/solve.h"
#include "simd/dispatch.h"
#include "simd/float_env.h"
#include "simd/rows.h"

namespace swivel {

namespace {

// Text as far as there is room, always with a 0 at its end.
class Text {
public:
    explicit Text(std::span<char> room) : room_(room) { room_[0] = 0; }

#if defined(__GNUC__)
    [[gnu::format(printf, 2, 3)]]
#endif
    void
    add(const char* format, ...)
    {
        std::va_list arguments;
        va_start(arguments, format);
        const int length = std::vsnprintf(room_.data() + used_, room_.size() - used_, format, arguments);
        va_end(arguments);
        if (length > 0) used_ = std::min(used_ + static_cast<std::size_t>(length), room_.size() - 1);
    }
    bool is_empty() const { return used_ == 0; }

private:
    std::span<char> room_;
    std::size_t used_ = 0;
};

// A crowd of one limb, which takes a limb of another.
class Probe {
public:
    Probe(const swivel_crowd& of, const Group& group, std::uint32_t limb)
        : from_(std::size_t{group.first_block} * SWIVEL_LANES + limb)
    {
        swivel_group_def alone = swivel_default_group_def(1);
        alone.binding = group.binding;
        swivel_crowd_def def = swivel_default_crowd_def();
        def.features = of.features & ~std::uint32_t{SWIVEL_BUDGET};
        def.groups = &alone;
        def.group_count = 1;
        def.shoulder_order = of.shoulder_order;
        def.wrist_order = of.wrist_order;
        crowd_ = place_crowd(def, arena_);
        copy_lane(of.input, of.input_row_count, crowd_->input);
        if (of.features & SWIVEL_WITH_MOST_SWIVEL)  // the normal that the next step is from
            copy_lane(of.results, of.result_row_count, crowd_->results);
    }

    const swivel_crowd& crowd() const { return *crowd_; }
    LimbPose pose() const { return forward(*crowd_, crowd_->groups[0], 0); }
    double residual_length() const
    {
        const double lengths = double{value(SWIVEL_LENGTHS, 0)} + double{value(SWIVEL_LENGTHS, 1)};
        return residual(*crowd_, crowd_->groups[0], 0) * scale() * lengths;
    }
    double scale() const { return crowd_->features & SWIVEL_WORLD ? double{value(SWIVEL_PARENT_SCALE, 0)} : 1.0; }
    Vector<double> shoulder() const
    {
        if (!(crowd_->features & SWIVEL_WORLD)) return vector(0.0, 0.0, 0.0);
        const auto at = [&](std::uint32_t c) { return double{value(SWIVEL_SHOULDER_POSITION, c)}; };
        return vector(at(0), at(1), at(2));
    }
    std::uint32_t component_count(swivel_field field) const { return field_row_count(crowd_->features, field); }
    float value(swivel_field field, std::uint32_t component) const
    {
        return crowd_->input[row_offset(0, 0, field_first_row(crowd_->features, field) + component)];
    }

    // Solves the limb and gives its flags.
    std::uint32_t solve()
    {
        const FloatEnv env;
        solve_group(*crowd_, find_isa("scalar")->kernels, crowd_->groups[0], 0, 1);
        const std::size_t at = std::size_t{field_first_row(crowd_->features, SWIVEL_FLAGS)} * SWIVEL_LANES;
        if (crowd_->words) return crowd_->words[at] | std::uint32_t{crowd_->words[at + SWIVEL_LANES]} << 16;
        return std::bit_cast<std::uint32_t>(crowd_->results[at]);
    }
    // Whether these are the results that the limb has.
    bool has_bits_of(const swivel_crowd& of) const
    {
        for (std::uint32_t row = 0; row < of.result_row_count; ++row) {
            const std::size_t theirs = row_offset(from_, of.result_row_count, row), ours = row_offset(0, 0, row);
            if (of.words ? of.words[theirs] != crowd_->words[ours]
                         : std::memcmp(of.results + theirs, crowd_->results + ours, sizeof(float)) != 0)
                return false;
        }
        return true;
    }
    // The field asks for nothing: it has what padding has, an ordinary arm without limits.
    void give_up(swivel_field field)
    {
        float* const rows = crowd_->input + row_offset(0, 0, field_first_row(crowd_->features, field));
        for (std::uint32_t row = 0; row < component_count(field); ++row)
            rows[row * SWIVEL_LANES] = rows[row * SWIVEL_LANES + 1];
    }
    void give_up_all_but(swivel_field kept)
    {
        for (std::uint32_t f = 0; f < kInputFieldCount; ++f)
            if (f != static_cast<std::uint32_t>(kept)) give_up(static_cast<swivel_field>(f));
    }

private:
    void copy_lane(const float* rows, std::uint32_t row_count, float* to) const
    {
        for (std::uint32_t row = 0; row < row_count; ++row)
            to[row_offset(0, 0, row)] = rows[row_offset(from_, row_count, row)];
    }

    static constexpr std::size_t kArenaBytes = 16 * 1024;
    static_assert(block_bytes(kEveryFeature) + 4096 <= kArenaBytes, "rows, and what stands before them");
    alignas(64) unsigned char arena_[kArenaBytes];
    swivel_crowd* crowd_;
    std::size_t from_;
};

// Inputs that are bad whatever the others are.
void explain_bad_input(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, Text& text)
{
    text.add("Bad input: ");
    bool is_found = false;
    for (std::uint32_t f = 0; f < kInputFieldCount; ++f) {
        const auto field = static_cast<swivel_field>(f);
        Probe probe(crowd, group, limb);
        if (probe.component_count(field) == 0) continue;
        probe.give_up_all_but(field);
        if (!(probe.solve() & SWIVEL_BAD_INPUT)) continue;
        text.add("%s%s (", is_found ? "; " : "", field_name(field));
        bool is_number = true;
        for (std::uint32_t c = 0; c < probe.component_count(field); ++c) {
            const double x = double{probe.value(field, c)};
            text.add("%s%g", c == 0 ? "" : ", ", x);
            is_number = is_number && !std::isnan(x);
        }
        text.add(") is %s", is_number ? "out of its range" : "not a number: was it ever written?");
        is_found = true;
    }
    text.add("%s", is_found
                       ? ". The limb has its rest pose."
                       : "each input is in its range, but not as the parent's rotation and scale have it. The limb "
                         "has its rest pose.");
}

void explain_reach(const Probe& solved, std::uint32_t flags, Text& text)
{
    const double missed = solved.residual_length();
    const Vector<double> line = solved.pose().wrist - solved.shoulder();
    const double reached = std::sqrt(len2(line));
    const char* const by = flags & SWIVEL_LIMITED_FLEXION ? "its bones and its flexion limit" : "its bones";
    if (flags & SWIVEL_CLAMPED_FAR)
        text.add("The target is %.4g out of reach: the wrist is %.4g from the shoulder, as far as %s let it.", missed,
                 reached, by);
    else if (flags & SWIVEL_CLAMPED_NEAR)
        text.add("The target is %.4g too near: the wrist is %.4g from the shoulder, as near as %s let it.", missed,
                 reached, by);
    else if (flags & SWIVEL_SOFTENED)
        text.add("A soft zone of reach keeps the wrist %.4g from its target.", missed);
    else
        text.add("The target is reached, to within %.2g.", missed);
    if (flags & SWIVEL_STRETCHED) text.add(" The bones are stretched for it.");
    if (flags & SWIVEL_SWIVEL_UNDEFINED)
        text.add(" The pole does not say where the elbow goes: it is of no length or on the target's line.");
}

struct Limit {
    std::uint32_t flag;
    swivel_field field;
};
constexpr Limit kLimits[] = {
    {SWIVEL_LIMITED_SHOULDER_CONE, SWIVEL_SHOULDER_CONE}, {SWIVEL_LIMITED_HUMERAL_TWIST, SWIVEL_HUMERAL_TWIST},
    {SWIVEL_LIMITED_SHOULDER_BOX, SWIVEL_SHOULDER_BOX},   {SWIVEL_LIMITED_HAND_CONE, SWIVEL_HAND_CONE},
    {SWIVEL_LIMITED_FOREARM_TWIST, SWIVEL_FOREARM_TWIST}, {SWIVEL_LIMITED_HAND_TWIST, SWIVEL_HAND_TWIST},
    {SWIVEL_LIMITED_WRIST_BOX, SWIVEL_WRIST_BOX},
};

// Whether this limit alone leaves the elbow no place.
bool forbids_all(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, swivel_field limit)
{
    Probe only(crowd, group, limb);
    for (const Limit& other : kLimits)
        if (other.field != limit) only.give_up(other.field);
    return only.solve() & SWIVEL_INFEASIBLE;
}

// By how many degrees the elbow of one pose is turned from that of another, about the line to the wrist.
double swivel_between(const Vector<double>& shoulder, const LimbPose& a, const LimbPose& b)
{
    const Vector<double> n = cross(a.wrist - shoulder, a.elbow - shoulder),
                         m = cross(b.wrist - shoulder, b.elbow - shoulder);
    return std::atan2(std::sqrt(len2(cross(n, m))), scalar_product(n, m)) * 180 / std::numbers::pi;
}

void explain_limits(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, const Probe& solved,
                    std::uint32_t flags, Text& text)
{
    char room[2][200];
    Text broken(room[0]), alone(room[1]);
    Probe wished(crowd, group, limb);
    for (const Limit& limit : kLimits) {
        wished.give_up(limit.field);
        if (!(flags & limit.flag)) continue;
        broken.add("%s%s", broken.is_empty() ? "" : " and ", field_name(limit.field));
        if (flags & SWIVEL_INFEASIBLE && forbids_all(crowd, group, limb, limit.field))
            alone.add("%s%s", alone.is_empty() ? "" : " and ", field_name(limit.field));
    }
    if (broken.is_empty()) return;
    if (flags & SWIVEL_INFEASIBLE) {
        text.add(" No place of the elbow keeps %s%s: the one that violates them least is taken.",
                 alone.is_empty() ? "all limits at once, as the wish breaks " : "",
                 alone.is_empty() ? room[0] : room[1]);
        return;
    }
    wished.solve();
    text.add(" Where the elbow was wished it breaks %s: the nearest place that keeps all limits is %.1f degrees away.",
             room[0], swivel_between(solved.shoulder(), solved.pose(), wished.pose()));
}

}  // namespace

void explain(const swivel_crowd& crowd, const Group& group, std::uint32_t limb, std::span<char> room)
{
    Text text(room);
    Probe solved(crowd, group, limb);
    const std::uint32_t flags = solved.solve();
    // A step's results are not those of the next one.
    if (!(crowd.features & SWIVEL_WITH_MOST_SWIVEL) && !solved.has_bits_of(crowd))
        text.add("Its inputs changed since it was solved, or it never was. As they are now: ");
    if (flags & SWIVEL_BAD_INPUT) return explain_bad_input(crowd, group, limb, text);
    explain_reach(solved, flags, text);
    explain_limits(crowd, group, limb, solved, flags, text);
    if (flags & SWIVEL_JUMPED)
        text.add(" Joint limits turn the swivel further than a step may.");
    else if (flags & SWIVEL_LIMITED_STEP)
        text.add(" The wish is more than a step from the swivel that is carried now; the one before cannot be seen.");
}

}  // namespace swivel
