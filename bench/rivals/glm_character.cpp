// SPDX-License-Identifier: MIT
//
// Character C on glm, one at a time, as a game would write it well: forward kinematics, feet that lock and ease, a
// sprung pelvis, a look by shares, the rifle's arm with its limits, and the other hand on the grip. Compiled once for
// each level. Flattened, as glm_bodies.cpp says.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "bench/rivals/level.h"

namespace bench::SWIVEL_LEVEL {

namespace {

glm::vec3 vec3(const float* v) { return {v[0], v[1], v[2]}; }
glm::quat quat(const float (&q)[4]) { return {q[3], q[0], q[1], q[2]}; }
void store(const glm::quat& q, float (&to)[4]) { to[0] = q.x, to[1] = q.y, to[2] = q.z, to[3] = q.w; }
void store(const glm::vec3& v, float (&to)[3]) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

// The shortest turn from one direction to another, both unit and not opposite.
glm::quat arc(const glm::vec3& from, const glm::vec3& to)
{
    const glm::vec3 axis = glm::cross(from, to);
    return glm::normalize(glm::quat(1 + glm::dot(from, to), axis.x, axis.y, axis.z));
}
// A share of a turn, up to an angle whose half has this cosine.
glm::quat part(const glm::quat& turn, float share, float cos_half_max)
{
    const glm::quat some =
        glm::normalize(glm::quat(1 - share + share * turn.w, share * turn.x, share * turn.y, share * turn.z));
    if (some.w >= cos_half_max) return some;
    const float sine = std::sqrt((1 - cos_half_max * cos_half_max) / (1 - some.w * some.w));
    return {cos_half_max, sine * some.x, sine * some.y, sine * some.z};
}

// A body as it is solved: places are from the root.
struct Body {
    BodyCharacter* of;
    glm::quat turn[kBodyJoints];
    glm::vec3 place[kBodyJoints];

    glm::quat above(std::size_t j) const
    {
        return kBodyParents[j] < 0 ? quat(of->root_rotation) : turn[static_cast<std::size_t>(kBodyParents[j])];
    }
    void find(std::size_t j)
    {
        const std::int32_t parent = kBodyParents[j];
        turn[j] = above(j) * quat(of->rotations[j]);
        place[j] = (parent < 0 ? glm::vec3(0) : place[parent]) + above(j) * vec3(kBodyOffsets[j]);
    }
    void set(std::size_t j, const glm::quat& now)
    {
        turn[j] = now;
        store(glm::conjugate(above(j)) * now, of->rotations[j]);
    }
};

// Where the bones of a limb go.
struct Bones {
    glm::vec3 upper, fore;
};
// side: the elbow's, across the line; least, most: distances of the wrist.
Bones two_bones(const glm::vec3& goal, const glm::vec3& elbow, float l1, float l2, float min, float max)
{
    const float wanted = glm::length(goal), d = glm::clamp(wanted, min, max);
    const glm::vec3 u = goal / wanted, side = glm::normalize(elbow - glm::dot(elbow, u) * u);
    const float along = (l1 * l1 + d * d - l2 * l2) / (2 * d), off = std::sqrt(std::max(l1 * l1 - along * along, 0.0f));
    const glm::vec3 upper = along * u + off * side;
    return {upper, d * u - upper};
}
void set_bones(Body& body, const BodyChain& chain, const Bones& bones, const glm::quat& hand)
{
    const glm::vec3 upper = body.place[chain.middle] - body.place[chain.first],
                    fore = body.place[chain.last] - body.place[chain.middle];
    const glm::quat first = arc(glm::normalize(upper), glm::normalize(bones.upper));
    const glm::quat second = arc(glm::normalize(first * fore), glm::normalize(bones.fore));
    body.set(chain.first, first * body.turn[chain.first]);
    body.set(chain.middle, second * first * body.turn[chain.middle]);
    body.place[chain.middle] = body.place[chain.first] + bones.upper;
    body.place[chain.last] = body.place[chain.middle] + bones.fore;
    body.set(chain.last, hand);
}

// ---- feet

// Where a foot's toe goes, and how the foot is turned.
struct FootGoal {
    glm::vec3 toe;
    glm::quat turn;
};
FootGoal stand(const Character& c, std::size_t leg, const Body& body, CharacterState::Foot& foot)
{
    constexpr float kUnlock = 0.24f, kLock = 0.12f, kBlend = 0.1f, kTurns = 0.8f;
    const std::size_t ankle = kBodyChains[kLegs + leg].last;
    const glm::vec3 root = vec3(c.body.root_place), up(0, 1, 0), normal = glm::normalize(vec3(c.normal[leg])),
                    on = vec3(c.ground[leg]);
    const auto height = [&](const glm::vec3& p) { return glm::dot(normal, p - on); };
    const bool is_contact = c.contact[leg] > 0.5f;
    // The animated toe, raised with the ground.
    const float rise = on.y - root.y;
    foot.lift += (rise - foot.lift) * (1 - std::exp2(-kFrameTime / 0.05f));
    glm::vec3 toe = root + body.place[ankle] + body.turn[ankle] * vec3(kToe) + foot.lift * up;
    const glm::vec3 was = (foot.is_locked ? vec3(foot.anchor) : toe) + vec3(foot.offset);
    if (is_contact && !foot.was_contact && glm::distance(toe, was) < kLock) {
        foot.is_locked = true;
        store(toe + (std::max(-height(toe), 0.0f) / normal.y) * up, foot.anchor);
        store(was - vec3(foot.anchor), foot.offset);
    } else if (foot.is_locked && (!is_contact || glm::distance(toe, vec3(foot.anchor)) > kUnlock)) {
        foot.is_locked = false;
        store(was - toe, foot.offset);
    }
    foot.was_contact = is_contact;
    store(std::exp2(-kFrameTime / (0.25f * kBlend)) * vec3(foot.offset), foot.offset);
    toe = (foot.is_locked ? vec3(foot.anchor) : toe) + vec3(foot.offset);
    toe += (std::max(-height(toe), 0.0f) / normal.y) * up;
    // The foot turns with the ground, and its heel stays above.
    glm::quat turn = part(arc(up, normal), 1, kTurns) * body.turn[ankle];
    const glm::vec3 heel = turn * (vec3(kHeel) - vec3(kToe));
    const float wanted = -height(toe), has = glm::dot(normal, heel), length2 = glm::dot(heel, heel);
    if (has < wanted) {
        const glm::vec3 flat = heel - has * normal;
        const float across =
            std::sqrt(std::max(length2 - wanted * wanted, 0.0f) / std::max(glm::dot(flat, flat), 1e-12f));
        turn = arc(glm::normalize(heel), glm::normalize(wanted * normal + across * flat)) * turn;
    }
    return {toe - root, turn};
}
// How far down the pelvis goes, on a critically damped spring.
float sprung(CharacterState& state, float low, float high)
{
    constexpr float kDrop = 0.1f, kRise = 0.05f, kPerTime = 2 / 0.1f;
    const float wish = low <= high ? glm::clamp(0.0f, low, high) : 0.5f * (low + high),
                goal = glm::clamp(wish, -kDrop, kRise);
    const float x = kPerTime * kFrameTime, decay = 1 / (1 + x + 0.48f * x * x + 0.235f * x * x * x);
    const float change = state.shift - goal, way = (state.shift_speed + kPerTime * change) * kFrameTime;
    state.shift_speed = (state.shift_speed - kPerTime * way) * decay;
    return state.shift = goal + (change + way) * decay;
}
void set_legs(Character& c, Body& body, CharacterState& state)
{
    constexpr float kMargin = 0.01f;
    FootGoal goals[2];
    glm::vec3 ankle[2];
    float max[2], low = -1, high = 1;
    for (std::size_t leg = 0; leg < 2; ++leg) {
        const BodyChain& chain = kBodyChains[kLegs + leg];
        goals[leg] = stand(c, leg, body, state.feet[leg]);
        ankle[leg] = goals[leg].toe - goals[leg].turn * vec3(kToe);
        const glm::vec3 hip = body.place[chain.first];
        const float l1 = glm::distance(body.place[chain.middle], hip),
                    l2 = glm::distance(body.place[chain.last], body.place[chain.middle]);
        max[leg] = std::min(glm::distance(body.place[chain.last], hip) + kMargin, l1 + l2);
        const glm::vec3 m = hip - ankle[leg];
        const float b = m.y, k2 = glm::dot(m, m) - b * b, r = std::sqrt(std::max(max[leg] * max[leg] - k2, 0.0f));
        low = std::max(low, -b - r), high = std::min(high, -b + r);
    }
    const glm::vec3 shift(0, sprung(state, low, high), 0);
    store(vec3(c.body.root_place) + shift, c.body.root_place);
    for (std::size_t leg = 0; leg < 2; ++leg) {
        const BodyChain& chain = kBodyChains[kLegs + leg];
        const glm::vec3 hip = body.place[chain.first], upper = body.place[chain.middle] - hip,
                        fore = body.place[chain.last] - body.place[chain.middle];
        const float l1 = glm::length(upper), l2 = glm::length(fore);
        set_bones(body, chain, two_bones(ankle[leg] - shift - hip, upper, l1, l2, std::abs(l1 - l2), max[leg]),
                  goals[leg].turn);
    }
}

// ---- the look

void look(const Character& c, Body& body, CharacterState& state)
{
    constexpr float kRate = 6 * kFrameTime;
    const std::size_t head = kLookChain[3];
    glm::vec3 eye = body.place[head] + body.turn[head] * vec3(kEye), axis = body.turn[head] * glm::vec3(0, 0, 1);
    const glm::quat root = quat(c.body.root_rotation);
    const glm::vec3 given = vec3(c.look) - vec3(c.body.root_place) - eye;
    const float distance = glm::length(given);
    glm::vec3 line = glm::conjugate(root) * (given / distance);
    if (state.has_line) {  // eased, in the root's frame
        const glm::quat step = arc(vec3(state.line), line);
        line = part(step, 1, std::cos(0.5f * kRate)) * vec3(state.line);
    }
    store(line, state.line), state.has_line = true;
    const glm::vec3 target = eye + distance * (root * line);
    const float fade = glm::smoothstep(-0.9f, -0.1f, glm::dot(axis, root * line));
    float left = 0;
    for (const float share : kLookShares) left += share;
    glm::quat sum(1, 0, 0, 0);
    for (std::size_t n = 0; n < 4; ++n) {
        const std::size_t j = kLookChain[n];
        const auto parent = static_cast<std::size_t>(kBodyParents[j]);
        body.place[j] = body.place[parent] + body.turn[parent] * vec3(kBodyOffsets[j]);
        const glm::quat turn = part(arc(axis, glm::normalize(target - eye)), fade * kLookShares[n] / left,
                                    std::sqrt(0.5f + 0.5f * kLookMax[n]));
        left -= kLookShares[n];
        sum = turn * sum;
        body.set(j, sum * body.above(j) * quat(body.of->rotations[j]));
        eye = body.place[j] + turn * (eye - body.place[j]), axis = turn * axis;
    }
}

// ---- arms

// Where the upper arm may point.
struct ArmRegion {
    glm::vec3 axis[4], pole[4], from[4], to[4];  // of the bridge from the cone before: its circle's pole, and both ends
    float cosine[4], wide[4];

    ArmRegion()
    {
        for (std::size_t n = 0; n < 4; ++n) {
            axis[n] = glm::normalize(vec3(kArmCones[n].axis));
            cosine[n] = std::cos(kArmCones[n].angle);
            if (n == 0) continue;
            pole[n] = glm::normalize(glm::cross(axis[n - 1], axis[n]));
            from[n] = glm::cross(pole[n], axis[n - 1]), to[n] = glm::cross(axis[n], pole[n]);
            wide[n] = std::sin(std::min(kArmCones[n - 1].angle, kArmCones[n].angle));
        }
    }
    // How deep the direction is in the best of the cones and of the bridges.
    float room(const glm::vec3& d) const
    {
        float max = glm::dot(axis[0], d) - cosine[0];
        for (std::size_t n = 1; n < 4; ++n)
            max = std::max(
                {max, glm::dot(axis[n], d) - cosine[n],
                 std::min({wide[n] - std::abs(glm::dot(pole[n], d)), glm::dot(from[n], d), glm::dot(to[n], d)})});
        return max;
    }
};
void set_arms(const Character& c, const ArmRegion& region, Body& body)
{
    const BodyChain& chain = kBodyChains[kRightArm];
    const BodyGoal& rifle = c.body.goals[kRightArm];
    const glm::vec3 shoulder = body.place[chain.first], elbow = body.place[chain.middle] - shoulder,
                    wrist = body.place[chain.last] - shoulder;
    const glm::vec3 goal = glm::mix(wrist, vec3(rifle.target) - vec3(c.body.root_place) - shoulder, c.weights[0]);
    const glm::quat hand = glm::normalize(glm::slerp(body.turn[chain.last], quat(rifle.hand), c.weights[1]));
    const float l1 = glm::length(elbow), l2 = glm::distance(body.place[chain.last], body.place[chain.middle]);
    const float min = std::sqrt(l1 * l1 + l2 * l2 + 2 * l1 * l2 * std::cos(kMaxFlexion)),
                max = std::sqrt(l1 * l1 + l2 * l2 + 2 * l1 * l2 * std::cos(kMinFlexion));
    Bones bones = two_bones(goal, elbow, l1, l2, min, max);
    // The upper arm as its cones see it: the bone lies along -x, and bends to z.
    const glm::quat frame = glm::conjugate(body.above(chain.first));
    const auto seen = [&](const glm::vec3& upper) {
        const glm::vec3 v = frame * upper / l1;
        return glm::vec3(-v.y, v.z, -v.x);
    };
    if (region.room(seen(bones.upper)) < 0) {  // to the nearest swivel that is allowed, in steps of 5 degrees
        const glm::vec3 u = glm::normalize(goal), d = bones.upper + bones.fore;
        for (int step = 1; step <= 36; ++step) {
            const glm::vec3 to = glm::angleAxis(0.0872665f * static_cast<float>(step), u) * bones.upper,
                            fro = glm::angleAxis(-0.0872665f * static_cast<float>(step), u) * bones.upper;
            const bool is_to = region.room(seen(to)) >= 0;
            if (!is_to && region.room(seen(fro)) < 0) continue;
            bones = is_to ? Bones{to, d - to} : Bones{fro, d - fro};
            break;
        }
    }
    set_bones(body, chain, bones, hand);

    const BodyChain& left = kBodyChains[0];
    const glm::vec3 grip = body.place[chain.last] + hand * vec3(kGrip), from = body.place[left.first],
                    upper = body.place[left.middle] - from;
    const float m1 = glm::length(upper), m2 = glm::distance(body.place[left.last], body.place[left.middle]);
    set_bones(body, left, two_bones(grip - from, upper, m1, m2, std::abs(m1 - m2), m1 + m2), hand);
}

}  // namespace

[[gnu::flatten]] void solve_characters(const Character* in, Character* out, CharacterState* states, std::size_t count)
{
    const ArmRegion region;
    for (std::size_t n = 0; n < count; ++n) {
        Character& c = out[n] = in[n];
        Body body{&c.body, {}, {}};
        for (std::size_t j = 0; j < kBodyJoints; ++j) body.find(j);
        set_legs(c, body, states[n]);
        look(c, body, states[n]);
        for (const std::size_t j : {6, 7, 8, 9, 10, 11, 12, 13}) body.find(j);
        set_arms(c, region, body);
    }
}

}  // namespace bench::SWIVEL_LEVEL
