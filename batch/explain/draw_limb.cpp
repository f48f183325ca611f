// SPDX-License-Identifier: MIT
//
// A body's limb is drawn as the free limb that its record tells of (one_limb.h).
#include "batch/explain/draw.h"

#include <cmath>

#include "batch/query/limb_value.h"
#include "batch/query/one_limb.h"

namespace swivel {

namespace {

bool has(const Group& group, swivel_field field) { return field_row_count(group.features, field) > 0; }
Rotor<double> unit_of(const LimbValue& value, std::uint32_t first = 0) { return normalise(rotor_of(value, first)); }

// The goal as the caller wrote it, and as plants and grips have it. NaN, which stands for the pose's own, is left out.
void draw_goal(const Group& group, std::uint32_t limb, Drawing& to)
{
    const bool is_solved = flags_of(group, limb) != 0, aims = group.features & SWIVEL_WITH_AIM;
    if (has(group, SWIVEL_TARGET)) {
        const Vector<double> target = vector_of({group, limb, SWIVEL_TARGET});
        to.point(SWIVEL_SHAPE_TARGET, target);
        if (has(group, SWIVEL_HAND) && !aims) to.axes(target, unit_of({group, limb, SWIVEL_HAND}));
    }
    if (!has(group, SWIVEL_SOLVED_GOAL) || !is_solved) return;
    const LimbValue goal(group, limb, SWIVEL_SOLVED_GOAL);
    to.point(SWIVEL_SHAPE_GOAL, vector_of(goal));
    if (has(group, SWIVEL_HAND)) to.axes(vector_of(goal), unit_of(goal, 3));
}

// The bones as they came, from the solved shoulder on, and how their binding has them bent.
void draw_incoming(const Group& group, std::size_t limb, bool with_bones, Drawing& to)
{
    const ArmFrame arm = arm_frame(group, limb);
    const LimbValue lengths(group, limb, SWIVEL_LENGTHS);
    Rotor<double> shoulder = unit_of({group, limb, SWIVEL_INCOMING_SHOULDER}),
                  elbow = unit_of({group, limb, SWIVEL_INCOMING_ELBOW});
    if (group.features & SWIVEL_JOINTS) {
        const swivel_binding& b = group.binding;
        shoulder = ~rotor_of(b.parent_from_arm) * shoulder * rotor_of(b.upper_from_arm);
        elbow = ~rotor_of(b.elbow_parent_from_arm) * elbow * rotor_of(b.fore_from_arm);
    }
    const Rotor<double> upper = arm.rotation * shoulder, fore = upper * elbow;
    const Vector<double> elbow_at = arm.shoulder + sandwich(upper, vector(0.0, 0.0, arm.scale * lengths[0]));
    to.ray(SWIVEL_SHAPE_BEND, elbow_at, sandwich(upper, vector(0.0, 1.0, 0.0)), 2 * to.size);
    if (!with_bones) return;
    to.line(SWIVEL_SHAPE_INCOMING, arm.shoulder, elbow_at);
    to.line(SWIVEL_SHAPE_INCOMING, elbow_at, elbow_at + sandwich(fore, vector(0.0, 0.0, arm.scale * lengths[1])));
}

// The wrist or effector, and how it misses its target.
void draw_end(const Group& group, std::size_t limb, const LimbPose& pose, Drawing& to)
{
    const Vector<double> target = vector_of({group, limb, SWIVEL_TARGET});
    Vector<double> end = pose.wrist;
    if (group.features & SWIVEL_WITH_EFFECTOR) {
        const double scale = arm_frame(group, limb).scale;
        end = end + scale * sandwich(pose.hand, vector_of({group, limb, SWIVEL_EFFECTOR}));
        to.line(SWIVEL_SHAPE_EFFECTOR, pose.wrist, end);
    }
    if (group.features & SWIVEL_WITH_AIM)
        to.ray(SWIVEL_SHAPE_SIGHT, end, aim_axis(group, limb, pose.hand), std::sqrt(len2(target - end)));
    else
        to.line(SWIVEL_SHAPE_MISS, end, target);
}

void draw_pole(const Group& group, std::size_t limb, const LimbPose& pose, Drawing& to)
{
    if (group.features & SWIVEL_POLE_HALF_LINE) {
        const float(&v)[3] = group.half_line.behind;
        const Vector<double> behind = sandwich(arm_frame(group, limb).rotation, vector<double>(v[0], v[1], v[2]));
        to.ray(SWIVEL_SHAPE_POLE, pose.shoulder, behind, 2 * to.size);
    }
    if (!has(group, SWIVEL_POLE)) return;
    const Vector<double> pole = vector_of({group, limb, SWIVEL_POLE});
    if (group.features & SWIVEL_POLE_NORMAL)
        to.ray(SWIVEL_SHAPE_NORMAL, pose.shoulder, pole, 2 * to.size);
    else if (group.features & SWIVEL_POLE_DIRECTION)
        to.ray(SWIVEL_SHAPE_POLE, pose.elbow, pole, 2 * to.size);
    else
        to.line(SWIVEL_SHAPE_POLE, pose.elbow, pole);
}

// group: of free limbs.
void draw_pose(const Group& group, std::size_t limb, bool with_bones, bool with_incoming, Drawing& to)
{
    const LimbPose pose = forward(group, limb);
    if (has(group, SWIVEL_INCOMING_SHOULDER)) draw_incoming(group, limb, with_incoming, to);
    if (with_bones) to.line(SWIVEL_SHAPE_BONE, pose.shoulder, pose.elbow);
    if (with_bones) to.line(SWIVEL_SHAPE_BONE, pose.elbow, pose.wrist);
    draw_end(group, limb, pose, to);
    draw_pole(group, limb, pose, to);
    draw_limits(group, limb, pose, to);
}

// Not inlined, so that the one limb is gone from the stack before draw_allowed() needs another.
[[gnu::noinline]] void draw_recorded(const Group& group, std::uint32_t limb, bool with_incoming, Drawing& to)
{
    OneLimb one(group);
    one.take(limb);
    draw_pose(one.group(), 0, false, with_incoming, to);
}

}  // namespace

void draw_limb(const swivel_crowd& crowd, std::uint32_t g, std::uint32_t limb, bool with_incoming, Drawing& to)
{
    const Group& group = crowd.groups[g];
    draw_goal(group, limb, to);
    if (!(group.features & kBody)) {
        draw_pose(group, limb, true, with_incoming, to);
        if (flags_of(group, limb) & SWIVEL_BAD_INPUT) to.point(SWIVEL_SHAPE_BAD_INPUT, arm_frame(group, limb).shoulder);
    } else if (group.features & SWIVEL_WITH_RECORD && flags_of(group, limb) != 0 &&
               !(flags_of(group, limb) & SWIVEL_BAD_INPUT)) {  // which keeps the results of an older solve
        draw_recorded(group, limb, with_incoming, to);
    } else {
        return;
    }
    draw_allowed(crowd, g, limb, to);
}

}  // namespace swivel
