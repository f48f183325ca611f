// SPDX-License-Identifier: MIT
#include "batch/explain/draw.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "batch/crowd/streams.h"
#include "batch/explain/explain.h"
#include "batch/explain/posed_body.h"
#include "batch/query/limb_value.h"

namespace swivel {

namespace {

struct KindRow {
    const char* name;
    std::uint32_t color;
};
// In the order of swivel_shape_kind, in the colours that it names.
constexpr KindRow kKinds[] = {
    {"bone", 0xffffffff},   {"incoming", 0x808080ff}, {"bend", 0xfa8072ff},     {"axis_x", 0xff0000ff},
    {"axis_y", 0x00a000ff}, {"axis_z", 0x0040ffff},   {"target", 0xffff00ff},   {"goal", 0xff8c00ff},
    {"miss", 0xff0000ff},   {"effector", 0xd0d0d0ff}, {"pole", 0xff00ffff},     {"normal", 0xee82eeff},
    {"wish", 0xff80c0ff},   {"allowed", 0x90ee90ff},  {"cone", 0x00ffffff},     {"region", 0x008080ff},
    {"anchor", 0xffd700ff}, {"probe", 0x87ceebff},    {"ground", 0xa0522dff},   {"sight", 0xa0ff00ff},
    {"shift", 0x800080ff},  {"prop", 0xf5deb3ff},     {"bad_input", 0xdc143cff}};
static_assert(std::size(kKinds) == SWIVEL_SHAPE_END);

constexpr double kMaxChord = std::numbers::pi / 18;

bool is_finite(const Vector<double>& v)
{
    return std::isfinite(v.c[0]) && std::isfinite(v.c[1]) && std::isfinite(v.c[2]);
}

// A body of a pose, in the space of its targets: from its root where that is doubles, else in the world.
struct DrawnBody {
    const swivel_crowd& crowd;
    const swivel_pose& pose;
    const std::uint32_t number;
    const PosedBody posed;
    Reading came, solved;
    Vector<double> origin, root, up;
    Vector<double> shift;  // of the root, as the pose's weight leaves it

    DrawnBody(const swivel_crowd& bodies, const swivel_pose& given, std::uint32_t body)
        : crowd(bodies), pose(given), number(body), posed{bodies, given, body}, came(given), solved(given)
    {
        const Vector<double> zero = vector(0.0, 0.0, 0.0);
        came.root_place = solved.root_place = given.root_is_double ? 0 : 1;
        solved.solved = true;
        origin = given.root_is_double ? posed.root_place() : zero;
        root = given.root_is_double ? zero : posed.root_place();
        const float(&axis)[3] = bodies.groups[0].plan.up;
        up = turned(posed.root_rotation(came), vector<double>(axis[0], axis[1], axis[2]));
        const double weight = given.weight.data ? double{value_at<float>(given.weight, body)} : 1;
        shift = shifted(weight >= 0 && weight <= 1 ? weight : 0);  // a weight out of its range counts as 0 in a solve
    }
    Vector<double> place(std::uint32_t joint, const Reading& how) const
    {
        return joint == 0 ? root : posed.place(joint, how);
    }
    Vector<double> came_at(std::uint32_t joint) const { return place(joint, came); }
    Vector<double> solved_at(std::uint32_t joint) const { return place(joint, solved) + shift; }
    // A twentieth of the way to the joint that is furthest from the root.
    double size() const
    {
        double max2 = 0;
        for (std::uint32_t joint = 1; joint < crowd.joint_count; ++joint)
            max2 = std::fmax(max2, len2(came_at(joint) - root));
        return std::sqrt(max2) / 20;
    }

    void draw_skeleton(Drawing& drawing) const
    {
        drawing.axes(root, posed.root_rotation(came));
        if (pose.results.data)  // else the solved bones have replaced them
            for (std::uint32_t joint = 1; joint < crowd.joint_count; ++joint)
                drawing.line(SWIVEL_SHAPE_INCOMING, came_at(posed.parent(joint)), came_at(joint));
        for (std::uint32_t joint = 1; joint < crowd.joint_count; ++joint)
            drawing.line(SWIVEL_SHAPE_BONE, solved_at(posed.parent(joint)), solved_at(joint));
    }
    void draw_group(std::uint32_t g, Drawing& drawing) const
    {
        const Group& group = crowd.groups[g];
        drawing.group = g;
        if (group.features & kShift)
            draw_shift(group, drawing);
        else if (group.features & kLook)
            draw_look(group, drawing);
        else if (group.features & kProp)
            draw_prop(g, drawing);
        else
            draw_limb(g, drawing);
        if (group.features & kNoLimb && flags_of(group, number) & SWIVEL_BAD_INPUT)
            drawing.point(SWIVEL_SHAPE_BAD_INPUT, root);
    }

private:
    // By what the last solve shifted the root, times a weight.
    Vector<double> shifted(double weight) const
    {
        for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
            if (!(crowd.groups[g].features & kShift)) continue;
            const LimbValue value(crowd.groups[g], number, SWIVEL_SHIFT);
            if (value[2] != 0) return value[0] * weight * up;  // 0: reset, or never solved
        }
        return vector(0.0, 0.0, 0.0);
    }
    void draw_shift(const Group& group, Drawing& drawing) const
    {
        if (LimbValue(group, number, SWIVEL_SHIFT)[2] != 0) drawing.line(SWIVEL_SHAPE_SHIFT, root, root + shift);
    }
    void draw_look(const Group& group, Drawing& drawing) const
    {
        const LimbValue sight(group, number, SWIVEL_SIGHT);
        const Vector<double> target = vector_of({group, number, SWIVEL_LOOK_TARGET}), eye = vector_of(sight);
        const double distance = std::sqrt(len2(target - eye));
        drawing.point(SWIVEL_SHAPE_TARGET, target);
        if (LimbValue(group, number, SWIVEL_LOOK_TURNS)[0] == 0) return;  // never solved, or reset
        drawing.ray(SWIVEL_SHAPE_SIGHT, eye, vector_of(sight, 3),
                    std::isfinite(distance) ? distance : 20 * drawing.size);
    }
    void draw_prop(std::uint32_t g, Drawing& drawing) const
    {
        const Group& group = crowd.groups[g];
        const LimbValue frame(group, number, SWIVEL_PROP_TRANSFORM);
        // On a joint, the prop's position is in that joint's frame.
        if (group.plan.prop.joint == 0)
            drawing.point(SWIVEL_SHAPE_TARGET, vector_of({group, number, SWIVEL_PROP_POSITION}));
        if (flags_of(group, number) == 0) return;  // never solved
        drawing.axes(vector_of(frame), normalise(rotor_of(frame, 3)));
        drawing.point(SWIVEL_SHAPE_PROP, vector_of(frame));
        for (std::uint32_t n = 0; n < crowd.group_count; ++n) {
            const Group& hand = crowd.groups[n];
            if (!(hand.features & SWIVEL_WITH_LINK && hand.features & SWIVEL_WITH_RECORD)) continue;
            if (hand.plan.limb.link.group == g && flags_of(hand, number) != 0)
                drawing.line(SWIVEL_SHAPE_PROP, vector_of(frame), vector_of({hand, number, SWIVEL_SOLVED_GOAL}));
        }
    }
    void draw_limb(std::uint32_t g, Drawing& drawing) const
    {
        const Group& group = crowd.groups[g];
        const Vector<double> parent = place(joint_at(crowd, group.plan.limb.parent), solved);
        // Records have the whole shift, whatever the pose's weight.
        draw_body_limb(group, number, parent, shifted(1), !pose.results.data, drawing);
        if (group.features & SWIVEL_WITH_PLANT && is_locked(group, number)) draw_anchor(group, drawing);
        if (group.features & SWIVEL_WITH_GROUND) draw_ground(group, drawing);
        if (flags_of(group, number) & SWIVEL_BAD_INPUT)
            drawing.point(SWIVEL_SHAPE_BAD_INPUT, solved_at(joint_at(crowd, group.plan.limb.shoulder)));
    }
    void draw_anchor(const Group& group, Drawing& drawing) const
    {
        const Vector<double> mark = vector_of({group, number, SWIVEL_PLANT}),
                             at = posed.support_place() - origin + turned(posed.support_rotation(), mark);
        const double length = double{group.plan.rest_length} * posed.root_scale();
        drawing.point(SWIVEL_SHAPE_ANCHOR, at);
        drawing.circle(SWIVEL_SHAPE_ANCHOR, at, up, double{group.plan.limb.plant.given.unlock_radius} * length);
    }
    void draw_ground(const Group& group, Drawing& drawing) const
    {
        const Vector<double> ground = vector_of({group, number, SWIVEL_GROUND}),
                             probe = vector_of({group, number, SWIVEL_PROBE}),
                             normal = normalise(vector_of({group, number, SWIVEL_GROUND_NORMAL}));
        if (LimbValue(group, number, SWIVEL_LIFT)[2] != 0) {  // else it was never solved, or reset
            drawing.point(SWIVEL_SHAPE_PROBE, probe);
            drawing.line(SWIVEL_SHAPE_PROBE, probe, ground);
        }
        const Vector<double> across = 2 * drawing.size * any_across(normal), along = cross(normal, across);
        const Vector<double> corner[4] = {ground + across + along, ground + along - across, ground - across - along,
                                          ground + across - along};
        for (int n = 0; n < 4; ++n) drawing.line(SWIVEL_SHAPE_GROUND, corner[n], corner[(n + 1) % 4]);
        drawing.ray(SWIVEL_SHAPE_GROUND, ground, normal, drawing.size);
    }
};

}  // namespace

void Drawing::line(swivel_shape_kind kind, const Vector<double>& start, const Vector<double>& end)
{
    const Vector<double> start_w = origin + start, end_w = origin + end;
    if (!is_finite(start_w) || !is_finite(end_w)) return;
    if (count < capacity) {
        swivel_shape& shape = shapes[count];
        std::copy_n(start_w.c, 3, shape.from);
        std::copy_n(end_w.c, 3, shape.to);
        shape.name = kKinds[kind].name;
        shape.kind = kind;
        shape.color = kKinds[kind].color;
        shape.group = group;
    }
    ++count;
}
void Drawing::ray(swivel_shape_kind kind, const Vector<double>& start, const Vector<double>& direction, double length)
{
    line(kind, start, start + length * normalise(direction));
}
void Drawing::axes(const Vector<double>& at, const Rotor<double>& rotation)
{
    line(SWIVEL_SHAPE_AXIS_X, at, at + turned(rotation, vector(size, 0.0, 0.0)));
    line(SWIVEL_SHAPE_AXIS_Y, at, at + turned(rotation, vector(0.0, size, 0.0)));
    line(SWIVEL_SHAPE_AXIS_Z, at, at + turned(rotation, vector(0.0, 0.0, size)));
}
void Drawing::arc(swivel_shape_kind kind, const Vector<double>& centre, const Vector<double>& a,
                  const Vector<double>& b, double start, double angle)
{
    const int chords = std::max(1, static_cast<int>(std::ceil(angle / kMaxChord - 1e-9)));  // 1e-9: of rounding
    const auto at = [&](int n) {
        const double t = start + n * angle / chords;
        return Vector<double>(centre + std::cos(t) * a + std::sin(t) * b);
    };
    for (int n = 0; n < chords; ++n) line(kind, at(n), at(n + 1));
}
void Drawing::circle(swivel_shape_kind kind, const Vector<double>& centre, const Vector<double>& normal, double radius)
{
    const Vector<double> unit = normalise(normal), a = radius * any_across(unit);
    arc(kind, centre, a, cross(unit, a), 0, 2 * std::numbers::pi);
}

void draw(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t limb, const swivel_pose* pose, Drawing& drawing)
{
    if (!pose) {
        drawing.group = group;
        drawing.size = length_of(crowd.groups[group], limb) / 10;
        return draw_free_limb(crowd.groups[group], limb, drawing);
    }
    const DrawnBody body(crowd, *pose, limb);
    drawing.origin = body.origin;
    drawing.size = body.size();
    body.draw_skeleton(drawing);
    for (std::uint32_t g = 0; g < crowd.group_count; ++g)
        if (group == SWIVEL_EVERY_GROUP || group == g) body.draw_group(g, drawing);
}

}  // namespace swivel
