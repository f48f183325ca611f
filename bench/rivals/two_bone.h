// SPDX-License-Identifier: MIT
//
// The textbook solver as people write it on glm: one arm, law of cosines, acos, a frame that looks at the target, axis
// and angle. The arm frame is swivel's.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace bench::SWIVEL_LEVEL {

struct TwoBone {
    glm::quat shoulder;
    float flexion;
    std::uint32_t flags;
};

inline TwoBone solve_two_bone(const glm::vec3& target, const glm::vec3& pole, float l1, float l2)
{
    const float wanted = glm::length(target), far = l1 + l2, near = std::abs(l1 - l2);
    const float d = glm::clamp(wanted, near, far);
    const glm::vec3 u = target / wanted;
    const glm::vec3 n = glm::normalize(glm::cross(u, pole));

    const float flexion = std::acos(glm::clamp((d * d - l1 * l1 - l2 * l2) / (2 * l1 * l2), -1.0f, 1.0f));
    const float lift = std::acos(glm::clamp((l1 * l1 + d * d - l2 * l2) / (2 * l1 * d), -1.0f, 1.0f));

    const glm::quat look = glm::quat_cast(glm::mat3(n, glm::cross(u, n), u));
    return {look * glm::angleAxis(lift, glm::vec3(1, 0, 0)), flexion, wanted > far ? 8u : wanted < near ? 16u : 1u};
}

}  // namespace bench::SWIVEL_LEVEL
