// SPDX-License-Identifier: MIT
//
// Character B on glm, one body at a time, as a game would write it well: forward kinematics, and for each limb the
// elbow on its circle at its incoming side, arcs that carry the bones there, and local rotations back. Compiled once
// for each level. Flattened, so that no function of glm stays in the object for another level's linker to pick.
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "bench/rivals/level.h"

namespace bench::SWIVEL_LEVEL {

namespace {

glm::vec3 vec3(const float* v) { return {v[0], v[1], v[2]}; }
glm::quat quat(const float (&q)[4]) { return {q[3], q[0], q[1], q[2]}; }
void store(const glm::quat& q, float (&to)[4]) { to[0] = q.x, to[1] = q.y, to[2] = q.z, to[3] = q.w; }

// The shortest turn from one direction to another, both unit and not opposite.
glm::quat arc(const glm::vec3& from, const glm::vec3& to)
{
    const glm::vec3 axis = glm::cross(from, to);
    return glm::normalize(glm::quat(1 + glm::dot(from, to), axis.x, axis.y, axis.z));
}

}  // namespace

[[gnu::flatten]] void solve_bodies(BodyCharacter* bodies, std::size_t count)
{
    for (std::size_t n = 0; n < count; ++n) {
        BodyCharacter& body = bodies[n];
        const glm::vec3 root = vec3(body.root_place);
        glm::quat turn[kBodyJoints];
        glm::vec3 place[kBodyJoints];
        for (std::size_t j = 0; j < kBodyJoints; ++j) {
            const std::int32_t parent = kBodyParents[j];
            const glm::quat above = parent < 0 ? quat(body.root_rotation) : turn[parent];
            turn[j] = above * quat(body.rotations[j]);
            place[j] = (parent < 0 ? glm::vec3(0) : place[parent]) + above * vec3(kBodyOffsets[j]);
        }
        for (std::size_t limb = 0; limb < kBodyLimbs; ++limb) {
            const BodyChain& chain = kBodyChains[limb];
            const glm::vec3 shoulder = place[chain.first], upper = place[chain.middle] - shoulder,
                            fore = place[chain.last] - place[chain.middle],
                            goal = vec3(body.goals[limb].target) - root - shoulder;
            const float l1 = glm::length(upper), l2 = glm::length(fore), wanted = glm::length(goal),
                        d = glm::clamp(wanted, std::abs(l1 - l2), l1 + l2);
            const glm::vec3 u = goal / wanted, side = glm::normalize(upper - glm::dot(upper, u) * u);
            const float along = (l1 * l1 + d * d - l2 * l2) / (2 * d),
                        off = std::sqrt(std::max(l1 * l1 - along * along, 0.0f));
            const glm::vec3 new_upper = along * u + off * side, new_fore = d * u - new_upper;

            const glm::quat first = arc(upper / l1, new_upper / l1);
            const glm::quat second = arc(first * fore / l2, new_fore / l2);
            const glm::quat upper_turn = first * turn[chain.first], fore_turn = second * first * turn[chain.middle];
            store(glm::conjugate(turn[kBodyParents[chain.first]]) * upper_turn, body.rotations[chain.first]);
            store(glm::conjugate(upper_turn) * fore_turn, body.rotations[chain.middle]);
            store(glm::conjugate(fore_turn) * quat(body.goals[limb].hand), body.rotations[chain.last]);
        }
    }
}

}  // namespace bench::SWIVEL_LEVEL
