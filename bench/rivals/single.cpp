// SPDX-License-Identifier: MIT
//
// The textbook solver as people write it on glm: one arm, law of cosines, acos, a frame that looks at the target, axis
// and angle. Compiled once for each level.
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "bench/rivals/level.h"

namespace bench::SWIVEL_LEVEL {

namespace {

SinglePose solve(const SingleArm& arm)
{
    const glm::vec3 target(arm.target[0], arm.target[1], arm.target[2]), pole(arm.pole[0], arm.pole[1], arm.pole[2]);
    const float wanted = glm::length(target), far = arm.upper + arm.fore, near = std::abs(arm.upper - arm.fore);
    const float d = glm::clamp(wanted, near, far);
    const glm::vec3 u = target / wanted;
    const glm::vec3 n = glm::normalize(glm::cross(u, pole));

    const float l1 = arm.upper, l2 = arm.fore;
    const float flexion = std::acos(glm::clamp((d * d - l1 * l1 - l2 * l2) / (2 * l1 * l2), -1.0f, 1.0f));
    const float lift = std::acos(glm::clamp((l1 * l1 + d * d - l2 * l2) / (2 * l1 * d), -1.0f, 1.0f));

    const glm::quat look = glm::quat_cast(glm::mat3(n, glm::cross(u, n), u));
    const glm::quat shoulder = look * glm::angleAxis(lift, glm::vec3(1, 0, 0));
    return {{shoulder.x, shoulder.y, shoulder.z, shoulder.w},
            std::cos(flexion / 2),
            std::sin(flexion / 2),
            wanted > far    ? 8u
            : wanted < near ? 16u
                            : 1u};
}

}  // namespace

// Flattened, so that no function of glm stays in the object for another level's linker to pick.
[[gnu::flatten]] void solve_single(const SingleArm* arms, SinglePose* poses, std::size_t count)
{
    for (std::size_t n = 0; n < count; ++n) poses[n] = solve(arms[n]);
}

}  // namespace bench::SWIVEL_LEVEL
