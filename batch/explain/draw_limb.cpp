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
void draw_goal(const Group& group, std::uint32_t limb, Drawing& drawing)
{
    const bool is_solved = flags_of(group, limb) != 0, aims = group.features & SWIVEL_WITH_AIM;
    if (has(group, SWIVEL_TARGET)) {
        const Vector<double> target = vector_of({group, limb, SWIVEL_TARGET});
        drawing.point(SWIVEL_SHAPE_TARGET, target);
        if (has(group, SWIVEL_HAND) && !aims) drawing.axes(target, unit_of({group, limb, SWIVEL_HAND}));
    }
    if (!has(group, SWIVEL_SOLVED_GOAL) || !is_solved) return;
    const LimbValue goal(group, limb, SWIVEL_SOLVED_GOAL);
    drawing.point(SWIVEL_SHAPE_GOAL, vector_of(goal));
    if (has(group, SWIVEL_HAND)) drawing.axes(vector_of(goal), unit_of(goal, 3));
}

// The bones as they came into the arm frame, and how their binding has them bent. group: of free limbs that have them.
void draw_incoming(const Group& group, std::size_t limb, const ArmFrame& arm, bool with_bones, Drawing& drawing)
{
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
    drawing.ray(SWIVEL_SHAPE_BEND, elbow_at, sandwich(upper, vector(0.0, 1.0, 0.0)), 2 * drawing.size);
    if (!with_bones) return;
    drawing.line(SWIVEL_SHAPE_INCOMING, arm.shoulder, elbow_at);
    drawing.line(SWIVEL_SHAPE_INCOMING, elbow_at, elbow_at + sandwich(fore, vector(0.0, 0.0, arm.scale * lengths[1])));
}

// The wrist or effector, and how it misses its target.
void draw_end(const Group& group, std::size_t limb, const LimbPose& pose, Drawing& drawing)
{
    const Vector<double> target = vector_of({group, limb, SWIVEL_TARGET});
    Vector<double> end = pose.wrist;
    if (group.features & SWIVEL_WITH_EFFECTOR) {
        const double scale = arm_frame(group, limb).scale;
        end = end + scale * sandwich(pose.hand, vector_of({group, limb, SWIVEL_EFFECTOR}));
        drawing.line(SWIVEL_SHAPE_EFFECTOR, pose.wrist, end);
    }
    if (group.features & SWIVEL_WITH_AIM)
        drawing.ray(SWIVEL_SHAPE_SIGHT, end, aim_axis(group, limb, pose.hand), std::sqrt(len2(target - end)));
    else
        drawing.line(SWIVEL_SHAPE_MISS, end, target);
}

void draw_pole(const Group& group, std::size_t limb, const LimbPose& pose, Drawing& drawing)
{
    if (group.features & SWIVEL_POLE_HALF_LINE) {
        const float(&v)[3] = group.half_line.behind;
        const Vector<double> behind = sandwich(arm_frame(group, limb).rotation, vector<double>(v[0], v[1], v[2]));
        drawing.ray(SWIVEL_SHAPE_POLE, pose.shoulder, behind, 2 * drawing.size);
    }
    if (!has(group, SWIVEL_POLE)) return;
    const Vector<double> pole = vector_of({group, limb, SWIVEL_POLE});
    if (group.features & SWIVEL_POLE_NORMAL)
        drawing.ray(SWIVEL_SHAPE_NORMAL, pose.shoulder, pole, 2 * drawing.size);
    else if (group.features & SWIVEL_POLE_DIRECTION)
        drawing.ray(SWIVEL_SHAPE_POLE, pose.elbow, pole, 2 * drawing.size);
    else
        drawing.line(SWIVEL_SHAPE_POLE, pose.elbow, pole);
}

// group: of free limbs.
void draw_solved(const Group& group, std::size_t limb, const LimbPose& pose, Drawing& drawing)
{
    draw_end(group, limb, pose, drawing);
    draw_pole(group, limb, pose, drawing);
    draw_limits(group, limb, pose, drawing);
}

// Not inlined, so that the one limb is gone from the stack before draw_allowed() needs another.
[[gnu::noinline]] void draw_record(const Group& group, std::uint32_t limb, const Vector<double>& parent,
                                   const Vector<double>& shift, bool with_incoming, Drawing& drawing)
{
    OneLimb one(group);
    one.take(limb);
    ArmFrame arm = arm_frame(one.group(), 0);
    arm.shoulder = arm.shoulder - shift;
    if (group.features & SWIVEL_WITH_CLAVICLE) {  // the record has the arm as the clavicle turned it
        const Rotor<double> rotation = normalise(incoming_arm_rotation(group, limb));
        arm.shoulder = parent + sandwich(rotation * ~arm.rotation, arm.shoulder - parent);
        arm.rotation = rotation;
    }
    draw_incoming(one.group(), 0, arm, with_incoming, drawing);
    draw_solved(one.group(), 0, forward(one.group(), 0), drawing);
}

}  // namespace

void draw_free_limb(const Group& group, std::uint32_t limb, Drawing& drawing)
{
    const LimbPose pose = forward(group, limb);
    draw_goal(group, limb, drawing);
    if (has(group, SWIVEL_INCOMING_SHOULDER)) draw_incoming(group, limb, arm_frame(group, limb, false), true, drawing);
    drawing.line(SWIVEL_SHAPE_BONE, pose.shoulder, pose.elbow);
    drawing.line(SWIVEL_SHAPE_BONE, pose.elbow, pose.wrist);
    draw_solved(group, limb, pose, drawing);
    if (flags_of(group, limb) & SWIVEL_BAD_INPUT)
        drawing.point(SWIVEL_SHAPE_BAD_INPUT, arm_frame(group, limb).shoulder);
    draw_allowed(group, limb, drawing);
}

void draw_body_limb(const Group& group, std::uint32_t limb, const Vector<double>& parent, const Vector<double>& shift,
                    bool with_incoming, Drawing& drawing)
{
    draw_goal(group, limb, drawing);
    const std::uint32_t flags = flags_of(group, limb);
    // A limb of bad input keeps the results of an older solve.
    if (!(group.features & SWIVEL_WITH_RECORD) || flags == 0 || flags & SWIVEL_BAD_INPUT) return;
    draw_record(group, limb, parent, shift, with_incoming, drawing);
    draw_allowed(group, limb, drawing);
}

}  // namespace swivel
