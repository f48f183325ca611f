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
    std::uint32_t number;
    PosedBody posed{crowd, pose, number};
    Reading came = reading(false), solved = reading(true);
    Vector<double> zero = vector(0.0, 0.0, 0.0);
    Vector<double> origin = pose.root_is_double ? posed.root_place() : zero;
    Vector<double> root = pose.root_is_double ? zero : posed.root_place();
    Vector<double> up = turned(posed.root_rotation(came), crowd_up());
    Vector<double> shift = shifted();

    Reading reading(bool is_solved) const
    {
        Reading how(pose);
        how.root_place = pose.root_is_double ? 0 : 1;
        how.solved = is_solved;
        return how;
    }
    Vector<double> crowd_up() const
    {
        const float(&v)[3] = crowd.groups[0].plan.up;
        return vector<double>(v[0], v[1], v[2]);
    }
    // By what the last solve shifted the root; the pose's weight counts for it, too.
    Vector<double> shifted() const
    {
        for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
            if (!(crowd.groups[g].features & kShift)) continue;
            const LimbValue value(crowd.groups[g], number, SWIVEL_SHIFT);
            const double weight = pose.weight.data ? double{value_at<float>(pose.weight, number)} : 1;
            return value[2] == 0 ? zero : value[0] * weight * up;  // 0: reset, or never solved
        }
        return zero;
    }
    Vector<double> came_at(std::uint32_t joint) const { return joint == 0 ? root : posed.place(joint, came); }
    Vector<double> solved_at(std::uint32_t joint) const
    {
        return joint == 0 ? root + shift : posed.place(joint, solved) + shift;
    }
    // A twentieth of the way to the joint that is furthest from the root.
    double size() const
    {
        double max2 = 0;
        for (std::uint32_t joint = 1; joint < crowd.joint_count; ++joint)
            max2 = std::fmax(max2, len2(came_at(joint) - root));
        return std::sqrt(max2) / 20;
    }

    void draw_skeleton(Drawing& to) const
    {
        to.axes(root, posed.root_rotation(came));
        if (pose.results.data)  // else the solved bones have replaced them
            for (std::uint32_t joint = 1; joint < crowd.joint_count; ++joint)
                to.line(SWIVEL_SHAPE_INCOMING, came_at(posed.parent(joint)), came_at(joint));
        for (std::uint32_t joint = 1; joint < crowd.joint_count; ++joint)
            to.line(SWIVEL_SHAPE_BONE, solved_at(posed.parent(joint)), solved_at(joint));
    }
    void draw_group(std::uint32_t g, Drawing& to) const
    {
        const Group& group = crowd.groups[g];
        to.group = g;
        if (group.features & kShift)
            draw_shift(group, to);
        else if (group.features & kLook)
            draw_look(group, to);
        else if (group.features & kProp)
            draw_prop(g, to);
        else
            draw_body_limb(g, to);
        if (group.features & kNoLimb && flags_of(group, number) & SWIVEL_BAD_INPUT)
            to.point(SWIVEL_SHAPE_BAD_INPUT, root);
    }

private:
    void draw_shift(const Group& group, Drawing& to) const
    {
        if (LimbValue(group, number, SWIVEL_SHIFT)[2] != 0) to.line(SWIVEL_SHAPE_SHIFT, root, root + shift);
    }
    void draw_look(const Group& group, Drawing& to) const
    {
        const LimbValue sight(group, number, SWIVEL_SIGHT);
        const Vector<double> target = vector_of({group, number, SWIVEL_LOOK_TARGET}), eye = vector_of(sight);
        const double distance = std::sqrt(len2(target - eye));
        to.point(SWIVEL_SHAPE_TARGET, target);
        if (LimbValue(group, number, SWIVEL_LOOK_TURNS)[0] == 0) return;  // never solved, or reset
        to.ray(SWIVEL_SHAPE_SIGHT, eye, vector_of(sight, 3), std::isfinite(distance) ? distance : 20 * to.size);
    }
    void draw_prop(std::uint32_t g, Drawing& to) const
    {
        const Group& group = crowd.groups[g];
        const LimbValue frame(group, number, SWIVEL_PROP_TRANSFORM);
        // On a joint, the prop's position is in that joint's frame.
        if (group.plan.prop.joint == 0) to.point(SWIVEL_SHAPE_TARGET, vector_of({group, number, SWIVEL_PROP_POSITION}));
        if (flags_of(group, number) == 0) return;  // never solved
        to.axes(vector_of(frame), normalise(rotor_of(frame, 3)));
        to.point(SWIVEL_SHAPE_PROP, vector_of(frame));
        for (std::uint32_t n = 0; n < crowd.group_count; ++n) {
            const Group& hand = crowd.groups[n];
            if (!(hand.features & SWIVEL_WITH_LINK && hand.features & SWIVEL_WITH_RECORD)) continue;
            if (hand.plan.limb.link.group == g && flags_of(hand, number) != 0)
                to.line(SWIVEL_SHAPE_PROP, vector_of(frame), vector_of({hand, number, SWIVEL_SOLVED_GOAL}));
        }
    }
    void draw_body_limb(std::uint32_t g, Drawing& to) const
    {
        const Group& group = crowd.groups[g];
        draw_limb(crowd, g, number, !pose.results.data, to);
        if (group.features & SWIVEL_WITH_PLANT && is_locked(group, number)) draw_anchor(group, to);
        if (group.features & SWIVEL_WITH_GROUND) draw_ground(group, to);
        if (flags_of(group, number) & SWIVEL_BAD_INPUT)
            to.point(SWIVEL_SHAPE_BAD_INPUT, solved_at(joint_at(crowd, group.plan.limb.shoulder)));
    }
    void draw_anchor(const Group& group, Drawing& to) const
    {
        const Vector<double> mark = vector_of({group, number, SWIVEL_PLANT}),
                             at = posed.support_place() - origin + turned(posed.support_rotation(), mark);
        const double length = double{group.plan.rest_length} * posed.root_scale();
        to.point(SWIVEL_SHAPE_ANCHOR, at);
        to.circle(SWIVEL_SHAPE_ANCHOR, at, up, double{group.plan.limb.plant.given.unlock_radius} * length);
    }
    void draw_ground(const Group& group, Drawing& to) const
    {
        const Vector<double> ground = vector_of({group, number, SWIVEL_GROUND}),
                             probe = vector_of({group, number, SWIVEL_PROBE}),
                             normal = normalise(vector_of({group, number, SWIVEL_GROUND_NORMAL}));
        if (LimbValue(group, number, SWIVEL_LIFT)[2] != 0) {  // else it was never solved, or reset
            to.point(SWIVEL_SHAPE_PROBE, probe);
            to.line(SWIVEL_SHAPE_PROBE, probe, ground);
        }
        const Vector<double> across = 2 * to.size * any_across(normal), along = cross(normal, across);
        const Vector<double> corner[4] = {ground + across + along, ground + along - across, ground - across - along,
                                          ground + across - along};
        for (int n = 0; n < 4; ++n) to.line(SWIVEL_SHAPE_GROUND, corner[n], corner[(n + 1) % 4]);
        to.ray(SWIVEL_SHAPE_GROUND, ground, normal, to.size);
    }
};

}  // namespace

void Drawing::line(swivel_shape_kind kind, const Vector<double>& from, const Vector<double>& to)
{
    const Vector<double> a = origin + from, b = origin + to;
    if (!is_finite(a) || !is_finite(b)) return;
    if (count < capacity) {
        swivel_shape& shape = shapes[count];
        std::copy_n(a.c, 3, shape.from);
        std::copy_n(b.c, 3, shape.to);
        shape.name = kKinds[kind].name;
        shape.kind = kind;
        shape.color = kKinds[kind].color;
        shape.group = group;
    }
    ++count;
}
void Drawing::ray(swivel_shape_kind kind, const Vector<double>& from, const Vector<double>& direction, double length)
{
    line(kind, from, from + length * normalise(direction));
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

void draw(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t limb, const swivel_pose* pose, Drawing& to)
{
    if (!pose) {
        to.group = group;
        to.size = length_of(crowd.groups[group], limb) / 10;
        return draw_limb(crowd, group, limb, true, to);
    }
    const DrawnBody body{crowd, *pose, limb};
    to.origin = body.origin;
    to.size = body.size();
    body.draw_skeleton(to);
    for (std::uint32_t g = 0; g < crowd.group_count; ++g)
        if (group == SWIVEL_EVERY_GROUP || group == g) body.draw_group(g, to);
}

}  // namespace swivel
