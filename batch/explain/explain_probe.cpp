// SPDX-License-Identifier: MIT
#include "batch/explain/explain_probe.h"

#include <cmath>
#include <cstring>

#include "batch/explain/explain_text.h"
#include "batch/solve/solve.h"
#include "include/swivel/swivel_regions.h"
#include "simd/dispatch.h"

namespace swivel {

namespace {

// A region that allows every direction: its part has no half-spaces.
constexpr swivel_region kEverywhere = {sizeof(swivel_region), 0, 1, {}, {}};

}  // namespace

void Probe::take()
{
    one_.take(limb_);
    one_.set_region(source_.region);
}

std::uint32_t Probe::solve()
{
    alignas(64) float strip[kStripBlockFloats];
    run_kernels(single_limb_kernels(), group(), {0, 1}, {strip, 1});
    return flags();
}

Vector<double> Probe::swivel_axis() const
{
    const ArmFrame frame = arm_frame(group(), 0);
    if (has(SWIVEL_WITH_AIM)) {
        const Vector<double> way = vector_of({group(), 0, SWIVEL_TARGET}) - frame.shoulder;
        if (len2(way) >= kTiny2 * frame.scale * frame.scale) return normalise(way);
        return sandwich(frame.rotation, vector(0.0, 0.0, 1.0));  // as the solver has it (core/wrist_goal.h)
    }
    // The wrist from the shoulder in the upper arm's frame, by the flexion alone. Where equal bones fold up, the wrist
    // is on the shoulder, and the difference of the two would be noise.
    const ArmRotors arm = arm_rotors(group(), 0);
    const double cos_half = std::fabs(arm.elbow.at<kScalar>()), sin_half = std::fabs(arm.elbow.at<kI>());
    const LimbValue lengths(group(), 0, SWIVEL_LENGTHS);
    const double upper = lengths[0], fore = lengths[1];
    Vector<double> way = vector(0.0, 2 * fore * cos_half * sin_half, upper - fore + 2 * fore * cos_half * cos_half);
    if (len2(way) == 0) way = vector(0.0, sin_half, cos_half);  // where it goes as equal bones fold up
    return normalise(sandwich(frame.rotation * arm.shoulder, way));
}

double Probe::violation(const FlagRow& limit) const
{
    const auto of_region = [&] { return source_.region ? outside_region(arm_rotors(group(), 0), *source_.region) : 0; };
    return in_degrees(limit.flag == SWIVEL_LIMITED_REGION ? of_region() : outside(limit.limit));
}

double Probe::outside(swivel_field limit) const
{
    float values[kMaxComponents] = {};
    const std::uint32_t count = component_count(limit);
    for (std::uint32_t c = 0; c < count; ++c) values[c] = value(limit, c);
    const swivel_euler_order order = limit == SWIVEL_WRIST_BOX ? source_.wrist_order : source_.shoulder_order;
    return count == 0 ? 0 : outside_limit(arm_rotors(group(), 0), limit, values, order);
}

double Probe::middle_angle() const
{
    return joint_angles(arm_rotors(group(), 0), source_.shoulder_order, source_.wrist_order, 0).shoulder[1];
}

bool Probe::has_bits_of_limb() const
{
    for (std::uint32_t row = 0; row < source_.result_row_count; ++row) {
        const std::size_t theirs = row_offset(limb_, source_.result_row_count, row), ours = row_offset(0, 0, row);
        if (std::memcmp(source_.results + theirs, group().results + ours, sizeof(float)) != 0) return false;
    }
    return true;
}

bool Probe::is(swivel_field field, std::initializer_list<float> wanted) const
{
    std::uint32_t c = 0;
    for (const float x : wanted)
        if (component_count(field) == 0 || value(field, c++) != x) return false;
    return true;
}

bool Probe::is_posed(swivel_field field) const
{
    if (!is_of_body()) return false;
    const LimbValue given(source_, limb_, field);
    if (field == SWIVEL_HAND && !has(SWIVEL_WITH_AIM)) return std::isnan(given.length(0, 4));
    return row_of(field).excludes & kBody || (field == SWIVEL_LENGTHS && std::isnan(given[0]));
}

// It gets the padding's value, from an ordinary arm without limits.
void Probe::give_up(swivel_field field)
{
    float* const rows = LimbValue(group(), 0, field).first;
    for (std::uint32_t row = 0; row < component_count(field); ++row)
        rows[row * SWIVEL_LANES] = rows[row * SWIVEL_LANES + 1];
}

void Probe::give_up(const FlagRow& limit)
{
    if (limit.flag == SWIVEL_LIMITED_REGION)
        one_.set_region(&kEverywhere);
    else
        give_up(limit.limit);
}

void Probe::give_up_limits()
{
    for_each_limit([&](const FlagRow& row) { give_up(row); });
    if (has(SWIVEL_STEP_WINS)) give_up(SWIVEL_MAX_SWIVEL);  // other steps come before limits
}

void Probe::give_up_all_but(swivel_field kept)
{
    for (const FieldRow& row : kFields)
        if (row.kind == SWIVEL_FIELD_INPUT && row.field != kept) give_up(row.field);
}

}  // namespace swivel
