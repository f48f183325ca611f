// SPDX-License-Identifier: MIT
//
// Draws limbs and bodies as lines and points, for renderers of debug views. Everything is in the space of the targets
// in rows; where that counts from a root in doubles, the root is added last.
#pragma once

#include <cstdint>

#include "batch/crowd/crowd.h"
#include "batch/query/forward.h"
#include "core/conformal.h"
#include "include/swivel/swivel_explain.h"

namespace swivel {

// The caller's shapes, and what they share.
struct Drawing {
    swivel_shape* shapes;
    std::uint32_t capacity, count = 0;
    std::uint32_t group = SWIVEL_EVERY_GROUP;  // that is being drawn
    Vector<double> origin{};                   // of the space of the targets, in the world
    double size = 0;                           // the length of axes and normals

    // Leaves out what is not finite.
    void line(swivel_shape_kind kind, const Vector<double>& start, const Vector<double>& end);
    void point(swivel_shape_kind kind, const Vector<double>& at) { line(kind, at, at); }
    // direction: of any length.
    void ray(swivel_shape_kind kind, const Vector<double>& start, const Vector<double>& direction, double length);
    void axes(const Vector<double>& at, const Rotor<double>& rotation);
    // The points centre + cos(t) a + sin(t) b, for t from start to start + angle, radians.
    void arc(swivel_shape_kind kind, const Vector<double>& centre, const Vector<double>& a, const Vector<double>& b,
             double start, double angle);
    void circle(swivel_shape_kind kind, const Vector<double>& centre, const Vector<double>& normal, double radius);
};

// Draws what swivel_draw() promises of a free limb, or, with a valid pose of full size, of a body.
void draw(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t limb, const swivel_pose* pose,
          Drawing& drawing);

// draw_limb.cpp: a limb's goal as it was written, and its solved pose.
void draw_free_limb(const Group& group, std::uint32_t limb, Drawing& drawing);
// The same of a body's limb. Its pose is known from its record alone. parent: where the last solve has the shoulder's
// parent joint before the body's shift; a clavicle turns the shoulder about it. shift: the whole shift, which the
// record has. with_incoming: its bones as they came, too.
void draw_body_limb(const Group& group, std::uint32_t limb, const Vector<double>& parent, const Vector<double>& shift,
                    bool with_incoming, Drawing& drawing);

// draw_limits.cpp: the cones and the region of a free limb's solved pose.
void draw_limits(const Group& group, std::size_t limb, const LimbPose& pose, Drawing& drawing);
// The elbow without limits, and the arcs where these allow it, of a free limb or one with a record.
void draw_allowed(const Group& group, std::uint32_t limb, Drawing& drawing);

}  // namespace swivel
