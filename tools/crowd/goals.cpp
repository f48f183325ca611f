// SPDX-License-Identifier: MIT
#include "tools/crowd/goals.h"

#include <stddef.h>
#include <string.h>
#include <cmath>

#include "tools/crowd/ground.h"
#include "tools/crowd/heading.h"
#include "tools/crowd/strides.h"

using namespace swivel::tools;

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
void store(const Vec3& v, Number (&result)[3])
{
    result[0] = static_cast<Number>(v.x), result[1] = static_cast<Number>(v.y), result[2] = static_cast<Number>(v.z);
}
template <class Number, class Result, int count>
void copy(const Number (&numbers)[count], Result (&results)[count])
{
    for (int n = 0; n < count; ++n) results[n] = static_cast<Result>(numbers[n]);
}

// A vector of the clip, turned along with a character; and a rotation of the clip.
Vec3 headed(const goal_character& who, Vec3 v)
{
    turn_with(who, v.x, v.z);
    return v;
}
template <class Number>
void turn_along(const goal_character& who, Number (&q)[4])
{
    if (who.heading == 0) return;
    const auto [y, w] = half_turn_of(who);
    const double before[4] = {q[0], q[1], q[2], q[3]};
    q[0] = static_cast<Number>(w * before[0] + y * before[2]);
    q[1] = static_cast<Number>(w * before[1] + y * before[3]);
    q[2] = static_cast<Number>(w * before[2] - y * before[0]);
    q[3] = static_cast<Number>(w * before[3] - y * before[1]);
}

// The shoulder in the world.
Vec3 shoulder_of(const goal_source& from, const goal_character& who)
{
    return vec3(who.place) + headed(who, who.size * vec3(from.origin));
}

Vec3 target_of(const goal_plan& plan, const goal_source& from, const goal_character& who)
{
    if (plan.is_look) return vec3(plan.target_offset);
    if (swivel_goal_carries(&from, &who)) return shoulder_of(from, who) + headed(who, who.size * vec3(from.carried));
    const Vec3 place = plan.has_target_point
                           ? vec3(who.place) + headed(who, who.size * vec3(plan.target_point))
                           : shoulder_of(from, who) +
                                 headed(who, who.size * (vec3(from.wrist) + turned(from.hand, vec3(plan.effector))));
    return place + headed(who, vec3(plan.target_offset));
}

// As the plan's kind of pole has it.
Vec3 pole_of(const goal_plan& plan, const goal_source& from, const goal_character& who)
{
    const Vec3 elbow = vec3(from.elbow);
    if (plan.pole == GOAL_POLE_POINT)
        return shoulder_of(from, who) + headed(who, plan.has_pole_fixed ? vec3(plan.pole_fixed) : who.size * elbow);
    if (plan.has_pole_fixed) return headed(who, vec3(plan.pole_fixed));
    return headed(who, plan.pole == GOAL_POLE_NORMAL ? cross(vec3(from.wrist), elbow) : elbow);
}

// Where the clip has a hand, or its effector, on another limb's hand.
void put_grip(const goal_plan& plan, const goal_source& from, const goal_source& held, float (&grip)[7])
{
    const double back[4] = {-held.hand[0], -held.hand[1], -held.hand[2], held.hand[3]};
    const Vec3 hand = vec3(from.origin) + vec3(from.wrist) + turned(from.hand, vec3(plan.effector));
    const Vec3 place = turned(back, hand - vec3(held.origin) - vec3(held.wrist));
    const Vec3 u{back[0], back[1], back[2]}, v{from.hand[0], from.hand[1], from.hand[2]};  // of both quaternions
    const Vec3 turn = back[3] * v + from.hand[3] * u + cross(u, v);
    const double numbers[7] = {place.x,
                               place.y,
                               place.z,
                               turn.x,
                               turn.y,
                               turn.z,
                               back[3] * from.hand[3] - (u.x * v.x + u.y * v.y + u.z * v.z)};
    copy(numbers, grip);
}

void fill(const goal_plan& plan, const goal_source& from, const Vec3& root, const goal_character& who, bool on_ground,
          goal_input& input)
{
    const goal asked = swivel_goal(&plan, &from, &who);
    input = {};
    copy(asked.target, input.target);
    copy(asked.pole, input.pole);
    copy(asked.hand, input.hand);
    copy(plan.weights, input.weights);
    if (!plan.has_pole_fixed && !plan.holds_pole) input.weights[2] = 0;
    if (on_ground && plan.goes_along && !swivel_goal_carries(&from, &who)) input.weights[0] = input.weights[1] = 0;
    store(headed(who, vec3(from.origin) - root - turned(from.parent, vec3(plan.shoulder_place))), input.places[0]);
    copy(plan.shoulder_place, input.places[1]);
    for (int bone = 0; bone < 2; ++bone) store(from.lengths[bone] * vec3(plan.bones[bone]), input.places[2 + bone]);
    copy(from.parent, input.rotations[0]);
    turn_along(who, input.rotations[0]);
    copy(from.shoulder, input.rotations[1]);
    copy(from.elbow_local, input.rotations[2]);
    copy(from.wrist_local, input.rotations[3]);
    input.rotations[4][3] = 1;
    input.contact = from.contact;
}

// The foot's place in this frame of its stride.
void put_foot(const Stride& stride, goal_input& input)
{
    input.target[0] = stride.plane[0], input.target[2] = stride.plane[2];
    copy(stride.plane, input.plane);
    copy(stride.slopes, input.slopes);
    input.room = static_cast<float>(stride.room);
}

double length_of(const float (&v)[3])
{
    return std::sqrt(double{v[0]} * v[0] + double{v[1]} * v[1] + double{v[2]} * v[2]);
}

// The ground of a solve's feet. Positions of probes are relative to the roots.
struct Standing {
    const goal_ground* ground;
    const float* heights;
    const goal_root* roots;
    const goal_input* inputs;
    uint32_t limb_count;
};
// The plane below a foot's probe at x and z in the world: its stride's, or the ground itself if the foot has a given
// target.
GroundPoint plane_below(const Standing& on, const goal_root& root, const goal_input& foot, double x, double z)
{
    constexpr double kMaxRaised = 0.01;  // leg lengths: a man's centimetre, which nobody sees as a jump
    const GroundPoint below = ground_at(*on.ground, on.heights, x, z);
    if (foot.target[0] != foot.plane[0] || foot.target[2] != foot.plane[2]) return below;
    const double slope_x{foot.slopes[0]}, slope_z{foot.slopes[1]};
    const double level = foot.plane[1] + slope_x * (x - foot.plane[0]) + slope_z * (z - foot.plane[2]);
    // No toe is in the ground, except where it would jump up an edge.
    const double lacks = below.height - level - double{foot.room},
                 max = kMaxRaised * double{root.size} * (length_of(foot.places[2]) + length_of(foot.places[3]));
    return {level + (lacks < 0 ? 0 : lacks < max ? lacks : max), slope_x, slope_z};
}
void sample(const swivel_probes* probes, void* user)
{
    const Standing& on = *static_cast<const Standing*>(user);
    for (uint32_t n = 0; n < probes->count; ++n) {
        const float(&probe)[3] = probes->places[n];
        const goal_root& root = on.roots[probes->bodies[n]];
        const goal_input& foot = on.inputs[probes->bodies[n] * on.limb_count + probes->group];
        const GroundPoint plane =
            plane_below(on, root, foot, root.place[0] + double{probe[0]}, root.place[2] + double{probe[2]});
        store({double{probe[0]}, plane.height - root.place[1], double{probe[2]}}, probes->grounds[n]);
        store({-plane.slope_x, 1, -plane.slope_z}, probes->normals[n]);
    }
}

// The input streams of a group's limb.
struct GroupInputs {
    swivel_stream fields[7];
    swivel_streams frame;
};
void list_inputs(const swivel_crowd* crowd, uint32_t group, const goal_input& first, size_t stride, GroupInputs& list)
{
    const struct {
        swivel_field field;
        const void* data;
    } inputs[] = {{SWIVEL_TARGET, first.target},     {SWIVEL_POLE, first.pole},        {SWIVEL_HAND, first.hand},
                  {SWIVEL_WEIGHTS, first.weights},   {SWIVEL_CONTACT, &first.contact}, {SWIVEL_GRIP, first.grip},
                  {SWIVEL_LOOK_TARGET, first.target}};
    list.frame = swivel_default_streams();
    list.frame.fields = list.fields;
    for (const auto& input : inputs)
        if (swivel_field_row_count(crowd, group, input.field) > 0)
            list.fields[list.frame.field_count++] = {input.field, const_cast<void*>(input.data), stride};
}

uint32_t twist_bones_of(const swivel_crowd* crowd, uint32_t group)
{
    return swivel_field_row_count(crowd, group, SWIVEL_TWIST_BONES) / 4;
}

// With the look.
uint32_t limb_count_of(const swivel_crowd* crowd)
{
    const auto has = [&](uint32_t group, swivel_field field) {
        return swivel_field_row_count(crowd, group, field) > 0;
    };
    uint32_t count = 0;
    while (has(count, SWIVEL_SHOULDER) || has(count, SWIVEL_LOOK_TARGET)) ++count;
    return count;
}

// Tells all roots their bodies' shifts.
swivel_status put_shifts(const swivel_crowd* crowd, uint32_t group, goal_root* roots)
{
    constexpr uint32_t kMany = 64;
    float shifts[kMany][3];
    const uint32_t count = swivel_group_limb_count(crowd, group);
    for (uint32_t first = 0; first < count; first += kMany) {
        const uint32_t some = count - first < kMany ? count - first : kMany;
        if (const swivel_status status =
                swivel_read(crowd, SWIVEL_SHIFT, group, first, some, {shifts, sizeof shifts[0]}))
            return status;
        for (uint32_t n = 0; n < some; ++n) roots[first + n].shift = shifts[n][0];
    }
    return SWIVEL_OK;
}

}  // namespace

goal swivel_goal(const goal_plan* plan, const goal_source* source, const goal_character* character)
{
    goal asked;
    store(target_of(*plan, *source, *character), asked.target);
    store(pole_of(*plan, *source, *character), asked.pole);
    if (plan->hand_is_local) {
        copy(source->wrist_local, asked.hand);
    } else {
        copy(source->hand, asked.hand);
        turn_along(*character, asked.hand);
    }
    return asked;
}

void swivel_goals(const goal_plan* plans, const goal_source* const* sources, uint32_t limb_count, uint32_t frame,
                  const goal_ground* ground, const float* heights, const goal_character* characters, uint32_t count,
                  goal_root* roots, goal_input* inputs)
{
    for (uint32_t n = 0; n < count; ++n) {
        goal_character who = characters[n];
        const uint32_t at = swivel_goal_frame(&who, frame);
        const Vec3 root = vec3(sources[0][at].root);
        Vec3 root_w = vec3(who.place) + headed(who, who.size * root);
        Stride strides[GOAL_MAX_LIMBS];  // of limbs that stand, in their order
        uint32_t feet = 0;
        if (ground)
            for (uint32_t limb = 0; limb < limb_count; ++limb)
                if (sources[limb][at].stride.leaves > 0)
                    strides[feet++] = stride_at(plans[limb], sources[limb], at, who, *ground, heights);
        if (feet > 0) {
            const double level = body_level({strides, feet});
            who.place[1] += level - root_w.y;
            root_w.y = level;
        }
        store(root_w, roots[n].place);
        roots[n].size = static_cast<float>(who.size);
        roots[n].shift = 0;
        const Stride* stride = strides;
        for (uint32_t limb = 0; limb < limb_count; ++limb) {
            goal_input& input = inputs[n * limb_count + limb];
            fill(plans[limb], sources[limb][at], root, who, ground, input);
            if (ground && sources[limb][at].stride.leaves > 0) put_foot(*stride++, input);
            if (const uint32_t holds = plans[limb].holds)
                put_grip(plans[limb], sources[limb][at], sources[holds - 1][at], input.grip);
        }
    }
}

double swivel_ground_height(const goal_ground* ground, const float* heights, double x, double z)
{
    return ground_at(*ground, heights, x, z).height;
}

swivel_status swivel_goals_solve(swivel_crowd* crowd, const goal_ground* ground, const float* heights, float seconds,
                                 const goal_character* characters, goal_root* roots, const goal_input* inputs,
                                 float* poses, swivel_job* job)
{
    constexpr size_t kMaxJoints = size_t{GOAL_MAX_LIMBS} * (size_t{GOAL_JOINTS} + SWIVEL_MAX_TWIST_BONES);
    const uint32_t limb_count = limb_count_of(crowd);
    if (limb_count > GOAL_MAX_LIMBS) return SWIVEL_INVALID_ARGUMENT;
    const bool has_shift = swivel_group_count(crowd) > limb_count;
    if (swivel_group_count(crowd) > limb_count + 1) return SWIVEL_INVALID_ARGUMENT;
    const size_t stride = limb_count * sizeof(goal_input);
    GroupInputs lists[GOAL_MAX_LIMBS];
    swivel_streams frames[GOAL_MAX_LIMBS + 1];
    const swivel_stream wish{SWIVEL_SHIFT_WISH, const_cast<float*>(&characters[0].wish), sizeof(goal_character)};
    frames[limb_count] = swivel_default_streams();
    frames[limb_count].fields = &wish;
    frames[limb_count].field_count = 1;
    for (uint32_t limb = 0; limb < limb_count; ++limb) {
        list_inputs(crowd, limb, inputs[limb], stride, lists[limb]);
        frames[limb] = lists[limb].frame;
    }
    size_t offsets[2 * kMaxJoints];
    swivel_pose pose;
    swivel_goals_pose(crowd, characters, roots, inputs, poses, offsets, &pose);
    pose.time = {&seconds, 0};
    Standing standing{ground, heights, roots, inputs, limb_count};
    job->streams = frames;
    job->pose = &pose;
    job->sample = ground ? sample : nullptr;
    job->sample_user = &standing;
    const swivel_status status = swivel_solve(crowd, job);
    job->streams = nullptr;
    job->pose = nullptr;
    job->sample = nullptr;
    job->sample_user = nullptr;
    return status == SWIVEL_OK && has_shift ? put_shifts(crowd, limb_count, roots) : status;
}

uint32_t swivel_goal_pose_size(const swivel_crowd* crowd)
{
    uint32_t size = 0;
    for (uint32_t limb = 0; limb < limb_count_of(crowd); ++limb)
        size += 4 * (GOAL_JOINTS + twist_bones_of(crowd, limb));
    return size;
}

void swivel_goals_pose(const swivel_crowd* crowd, const goal_character* characters, const goal_root* roots,
                       const goal_input* inputs, float* poses, size_t* offsets, swivel_pose* pose)
{
    constexpr size_t kRotation = 4 * sizeof(float), kPlace = 3 * sizeof(float);
    const uint32_t limb_count = limb_count_of(crowd), joint_count = swivel_goal_pose_size(crowd) / 4;
    const size_t stride = limb_count * sizeof(goal_input);
    size_t *const rotations = offsets, *const places = offsets + joint_count;
    size_t joint = 0;
    for (uint32_t limb = 0; limb < limb_count; ++limb) {
        const uint32_t count = GOAL_JOINTS + twist_bones_of(crowd, limb);
        for (uint32_t n = 0; n < count; ++n, ++joint) {
            const size_t begin = limb * sizeof(goal_input), turn = n < GOAL_JOINTS ? n : uint32_t{GOAL_JOINTS},
                         place = n < GOAL_JOINTS ? n : 0;  // of twist bones it does not matter
            rotations[joint] = begin + offsetof(goal_input, rotations) + turn * kRotation;
            places[joint] = begin + offsetof(goal_input, places) + place * kPlace;
        }
    }
    *pose = swivel_default_pose();
    pose->root_is_double = 1;
    void* const data = const_cast<goal_input*>(inputs);  // which are only read
    pose->rotations = {data, stride, 0, rotations};
    pose->translations = {data, stride, 0, places};
    pose->results = {poses, joint_count * kRotation, kRotation, nullptr};
    pose->root_position = {roots[0].place, sizeof(goal_root)};
    pose->root_scale = {&roots[0].size, sizeof(goal_root)};
    pose->support_position = {characters[0].place, sizeof(goal_character)};
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
