// SPDX-License-Identifier: MIT
#include "tools/crowd/goals.h"

#include <stddef.h>
#include <string.h>

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
template <class Number>
Vec3 turned(const Number (&q)[4], const Vec3& v)
{
    const Vec3 axis{q[0], q[1], q[2]};
    const Vec3 twice = 2.0 * cross(axis, v);
    return v + static_cast<double>(q[3]) * twice + cross(axis, twice);
}

template <class Number>
void store(const Vec3& v, Number (&to)[3])
{
    to[0] = static_cast<Number>(v.x), to[1] = static_cast<Number>(v.y), to[2] = static_cast<Number>(v.z);
}
template <class From, class To, int count>
void copy(const From (&from)[count], To (&to)[count])
{
    for (int n = 0; n < count; ++n) to[n] = static_cast<To>(from[n]);
}

// The shoulder in the world.
Vec3 shoulder_of(const goal_source& from, const goal_character& who)
{
    return vec3(who.place) + who.size * vec3(from.origin);
}

Vec3 target_of(const goal_plan& plan, const goal_source& from, const goal_character& who)
{
    const Vec3 place =
        plan.has_target_point
            ? vec3(who.place) + who.size * vec3(plan.target_point)
            : shoulder_of(from, who) + who.size * (vec3(from.wrist) + turned(from.hand, vec3(plan.effector)));
    return place + vec3(plan.target_offset);
}

// As the plan's kind of pole has it.
Vec3 pole_of(const goal_plan& plan, const goal_source& from, const goal_character& who)
{
    const Vec3 elbow = vec3(from.elbow);
    if (plan.pole == GOAL_POLE_POINT)
        return shoulder_of(from, who) + (plan.has_pole_fixed ? vec3(plan.pole_fixed) : who.size * elbow);
    if (plan.has_pole_fixed) return vec3(plan.pole_fixed);
    return plan.pole == GOAL_POLE_NORMAL ? cross(vec3(from.wrist), elbow) : elbow;
}

void fill(const goal_plan& plan, const goal_source& from, const Vec3& root, const goal_character& who,
          goal_input& input)
{
    const goal asked = swivel_goal(&plan, &from, &who);
    input = {};
    copy(asked.target, input.target);
    copy(asked.pole, input.pole);
    copy(asked.hand, input.hand);
    copy(plan.weights, input.weights);
    if (!plan.has_pole_fixed && !plan.holds_pole) input.weights[2] = 0;
    store(vec3(from.origin) - root - turned(from.parent, vec3(plan.shoulder_place)), input.places[0]);
    copy(plan.shoulder_place, input.places[1]);
    for (int bone = 0; bone < 2; ++bone) store(from.lengths[bone] * vec3(plan.bones[bone]), input.places[2 + bone]);
    copy(from.parent, input.rotations[0]);
    copy(from.shoulder, input.rotations[1]);
    copy(from.elbow_local, input.rotations[2]);
    copy(from.wrist_local, input.rotations[3]);
    input.rotations[4][3] = 1;
}

// What a group's limb reads.
struct GroupInputs {
    swivel_frame_field fields[4];
    swivel_frame frame;
};
void list_inputs(const swivel_crowd* crowd, uint32_t group, const goal_input& first, size_t stride, GroupInputs& to)
{
    const struct {
        swivel_field field;
        const void* data;
    } inputs[] = {{SWIVEL_TARGET, first.target},
                  {SWIVEL_POLE, first.pole},
                  {SWIVEL_HAND, first.hand},
                  {SWIVEL_WEIGHTS, first.weights}};
    to.frame = swivel_default_frame();
    to.frame.fields = to.fields;
    for (const auto& input : inputs)
        if (swivel_field_row_count(crowd, group, input.field) > 0)
            to.fields[to.frame.field_count++] = {input.field, const_cast<void*>(input.data), stride};
}

uint32_t twist_bones_of(const swivel_crowd* crowd, uint32_t group)
{
    return swivel_field_row_count(crowd, group, SWIVEL_TWIST_BONES) / 4;
}

}  // namespace

goal swivel_goal(const goal_plan* plan, const goal_source* source, const goal_character* character)
{
    goal asked;
    store(target_of(*plan, *source, *character), asked.target);
    store(pole_of(*plan, *source, *character), asked.pole);
    if (plan->hand_is_local)
        copy(source->wrist_local, asked.hand);
    else
        copy(source->hand, asked.hand);
    return asked;
}

void swivel_goals(const goal_plan* plans, const goal_source* const* sources, uint32_t limb_count, uint32_t frame_count,
                  uint32_t frame, const goal_character* characters, uint32_t count, goal_root* roots,
                  goal_input* inputs)
{
    for (uint32_t n = 0; n < count; ++n) {
        const uint64_t at = (uint64_t{frame} + characters[n].start) % frame_count;
        const Vec3 root = vec3(sources[0][at].root);
        store(vec3(characters[n].place) + characters[n].size * root, roots[n].place);
        roots[n].size = static_cast<float>(characters[n].size);
        roots[n].reserved = 0;
        for (uint32_t limb = 0; limb < limb_count; ++limb)
            fill(plans[limb], sources[limb][at], root, characters[n], inputs[n * limb_count + limb]);
    }
}

swivel_status swivel_goals_solve(swivel_crowd* crowd, const goal_root* roots, const goal_input* inputs, float* poses,
                                 swivel_job* job)
{
    constexpr size_t kMostJoints = size_t{GOAL_MOST_LIMBS} * (size_t{GOAL_JOINTS} + SWIVEL_MOST_TWIST_BONES);
    constexpr size_t kRotation = 4 * sizeof(float), kPlace = 3 * sizeof(float);
    const uint32_t limb_count = swivel_group_count(crowd);
    if (limb_count > GOAL_MOST_LIMBS) return SWIVEL_INVALID_ARGUMENT;
    const size_t stride = limb_count * sizeof(goal_input);
    size_t rotations[kMostJoints], places[kMostJoints], results[kMostJoints], joint = 0;
    GroupInputs lists[GOAL_MOST_LIMBS];
    swivel_frame frames[GOAL_MOST_LIMBS];
    for (uint32_t limb = 0; limb < limb_count; ++limb) {
        list_inputs(crowd, limb, inputs[limb], stride, lists[limb]);
        frames[limb] = lists[limb].frame;
        const uint32_t joint_count = GOAL_JOINTS + twist_bones_of(crowd, limb);
        for (uint32_t n = 0; n < joint_count; ++n, ++joint) {
            const size_t begin = limb * sizeof(goal_input), turn = n < GOAL_JOINTS ? n : uint32_t{GOAL_JOINTS},
                         place = n < GOAL_JOINTS ? n : 0;  // of twist bones it does not matter
            rotations[joint] = begin + offsetof(goal_input, rotations) + turn * kRotation;
            places[joint] = begin + offsetof(goal_input, places) + place * kPlace;
            results[joint] = joint * kRotation;
        }
    }
    swivel_pose pose = swivel_default_pose();
    pose.root_is_double = 1;
    void* const data = const_cast<goal_input*>(inputs);  // which are only read
    pose.rotations = {data, stride, 0, rotations};
    pose.translations = {data, stride, 0, places};
    pose.results = {poses, joint * kRotation, 0, results};
    pose.root_position = {roots[0].place, sizeof(goal_root)};
    pose.root_scale = {&roots[0].size, sizeof(goal_root)};
    job->frames = frames;
    job->pose = &pose;
    const swivel_status status = swivel_solve(crowd, job);
    job->frames = nullptr;
    job->pose = nullptr;
    return status;
}

uint32_t swivel_goal_pose_size(const swivel_crowd* crowd)
{
    uint32_t size = 0;
    for (uint32_t limb = 0; limb < swivel_group_count(crowd); ++limb)
        size += 4 * (GOAL_JOINTS + twist_bones_of(crowd, limb));
    return size;
}

uint64_t swivel_goals_digest(const swivel_crowd* crowd, const float* poses)
{
    const uint64_t count = uint64_t{swivel_goal_pose_size(crowd)} * swivel_group_limb_count(crowd, 0);
    uint64_t hash = swivel_digest(crowd);
    for (uint64_t n = 0; n < count; ++n) {
        uint32_t word;
        memcpy(&word, &poses[n], sizeof word);
        hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}
