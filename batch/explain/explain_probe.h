// SPDX-License-Identifier: MIT
//
// Solves one limb alone to find causes. To test a bad input or a limit, the probe replaces it by a neutral value. If it
// was the cause, the limb is then good, or reaches its wish. Degrees are for people.
#pragma once

#include <initializer_list>

#include "batch/query/forward.h"
#include "batch/query/limb_value.h"
#include "batch/query/one_limb.h"

namespace swivel {

// Calls act(row) for each limit of the swivel.
template <class Act>
void for_each_limit(const Act& act)
{
    for (const FlagRow& row : kFlags)
        if (row.limit != SWIVEL_INPUT_END || row.flag == SWIVEL_LIMITED_REGION) act(row);
}

// A probe takes nearly half of the stack that a call may use. So there is only one, which takes the limb anew for each
// question.
class Probe {
public:
    Probe(const Group& group, std::uint32_t limb) : source_(group), limb_(limb), one_(group) { take(); }
    // Takes the limb as it is.
    void take();
    // Solves the limb and gives its flags.
    std::uint32_t solve();

    LimbPose pose() const { return forward(group(), 0); }
    // The direction of the line that the solved limb swivels about, which goes from its shoulder to its wrist, or with
    // an aim to its target. It is the solver's also where these are on the shoulder. Of unit length.
    Vector<double> swivel_axis() const;
    std::uint32_t flags() const { return flags_of(group(), 0); }
    double missed() const { return distance_missed(group(), 0); }
    double missed_share() const { return residual(group(), 0); }
    // The length of both bones, scaled and stretched.
    double length() const { return length_of(group(), 0); }
    // By how many degrees the pose violates a limit; 0 or less where it keeps it, or the group has none.
    double violation(const FlagRow& limit) const;
    // The angles of shoulder_box, in radians.
    double middle_angle() const;
    // Whether the probe's results are the limb's, to the bit.
    bool has_bits_of_limb() const;

    bool has(swivel_features feature) const { return source_.features & feature; }
    bool is_of_body() const { return has(kBody); }
    std::uint32_t component_count(swivel_field field) const { return field_row_count(group().features, field); }
    float value(swivel_field field, std::uint32_t component) const
    {
        return LimbValue(group(), 0, field).number(component);
    }
    bool is(swivel_field field, std::initializer_list<float> wanted) const;
    // Whether a body's pose gave the field instead of the caller.
    bool is_posed(swivel_field field) const;

    // Replaces the field, or a limit's input, by a neutral value.
    void give_up(swivel_field field);
    void give_up(const FlagRow& limit);
    // All limits of the swivel, and a step that wins over them. The limb then takes the swivel that arcs count from.
    void give_up_limits();
    void give_up_all_but(swivel_field kept);

private:
    const Group& group() const { return one_.group(); }
    double outside(swivel_field limit) const;

    const Group& source_;
    std::uint32_t limb_;
    OneLimb one_;
};

// outside_limit.cpp: by how many radians a pose is outside of a limit on the swivel; 0 or less where it keeps it.
// value: as the limit's rows hold it. order: a box's.
double outside_limit(const ArmRotors& arm, swivel_field limit, const float* value, swivel_euler_order order);

// The same of the upper arm's region.
double outside_region(const ArmRotors& arm, const swivel_region& region);

}  // namespace swivel
