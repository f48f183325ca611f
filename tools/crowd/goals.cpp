// SPDX-License-Identifier: MIT
#include "tools/crowd/goals.h"

namespace {

struct Vec3 {
    double x, y, z;
};

Vec3 vec3(const double (&v)[3]) { return {v[0], v[1], v[2]}; }
Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(double s, const Vec3& v) { return {s * v.x, s * v.y, s * v.z}; }
Vec3 cross(const Vec3& a, const Vec3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// v turned by the unit quaternion x, y, z, w.
Vec3 turned(const double (&q)[4], const Vec3& v)
{
    const Vec3 axis{q[0], q[1], q[2]};
    const Vec3 twice = 2.0 * cross(axis, v);
    return v + q[3] * twice + cross(axis, twice);
}

void store(const Vec3& v, double (&to)[3]) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }
template <class From, class To, int count>
void copy(const From (&from)[count], To (&to)[count])
{
    for (int n = 0; n < count; ++n) to[n] = static_cast<To>(from[n]);
}

Vec3 target_of(const goal_plan& plan, const goal_source& from, double size)
{
    const Vec3 offset = vec3(plan.target_offset);
    if (!plan.has_target_point) return size * (vec3(from.wrist) + turned(from.hand, vec3(plan.effector))) + offset;
    Vec3 origin = vec3(from.origin);
    if (plan.is_mirrored) origin.x = -origin.x;
    return size * (vec3(plan.target_point) - origin) + offset;
}

// As the plan's kind of pole has it.
Vec3 pole_of(const goal_plan& plan, const goal_source& from, double size)
{
    if (plan.has_pole_fixed) return vec3(plan.pole_fixed);
    const Vec3 elbow = vec3(from.elbow);
    if (plan.pole == GOAL_POLE_POINT) return size * elbow;
    return plan.pole == GOAL_POLE_NORMAL ? cross(vec3(from.wrist), elbow) : elbow;
}

void fill(const goal_plan& plan, const goal_source& from, double size, goal_input& input)
{
    const goal asked = swivel_goal(&plan, &from, size);
    input = {};
    copy(asked.target, input.target);
    copy(asked.pole, input.pole);
    for (int bone = 0; bone < 2; ++bone) input.lengths[bone] = static_cast<float>(size * from.lengths[bone]);
    copy(from.parent, input.rotation);
    copy(asked.hand, input.hand);
    copy(from.shoulder, input.shoulder);
    copy(from.elbow_local, input.elbow);
    copy(from.wrist_local, input.wrist);
}

}  // namespace

goal swivel_goal(const goal_plan* plan, const goal_source* source, double size)
{
    goal asked;
    store(target_of(*plan, *source, size), asked.target);
    store(pole_of(*plan, *source, size), asked.pole);
    if (plan->hand_is_local)
        copy(source->wrist_local, asked.hand);
    else
        copy(source->hand, asked.hand);
    return asked;
}

void swivel_goals(const goal_plan* plan, const goal_source* sources, uint32_t frame_count, uint32_t frame,
                  const goal_character* characters, uint32_t count, goal_input* inputs)
{
    for (uint32_t n = 0; n < count; ++n) {
        const uint64_t at = uint64_t{frame} + characters[n].start;
        fill(*plan, sources[at % frame_count], characters[n].size, inputs[n]);
    }
}

swivel_status swivel_goals_write(swivel_crowd* crowd, uint32_t group, uint32_t count, const goal_input* inputs)
{
    const struct {
        swivel_field field;
        const float* first;
    } values[] = {{SWIVEL_TARGET, inputs->target},
                  {SWIVEL_POLE, inputs->pole},
                  {SWIVEL_LENGTHS, inputs->lengths},
                  {SWIVEL_SHOULDER_POSITION, inputs->position},
                  {SWIVEL_PARENT_ROTATION, inputs->rotation},
                  {SWIVEL_HAND, inputs->hand},
                  {SWIVEL_INCOMING_SHOULDER, inputs->shoulder},
                  {SWIVEL_INCOMING_ELBOW, inputs->elbow},
                  {SWIVEL_INCOMING_WRIST, inputs->wrist}};
    for (const auto& value : values) {
        if (swivel_field_row_count(crowd, group, value.field) == 0) continue;
        const swivel_status status =
            swivel_write(crowd, value.field, group, 0, count, {value.first, sizeof(goal_input)});
        if (status != SWIVEL_OK) return status;
    }
    return SWIVEL_OK;
}
