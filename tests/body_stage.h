// SPDX-License-Identifier: MIT
//
// A crowd of random bodies with goals and weights, for tests of bits.
#pragma once

#include "tests/body_crowd.h"

namespace swivel::test {

inline constexpr std::uint32_t kStageBodies = 150;  // several runs, and a block that is not full
inline constexpr swivel_features kBodyFeatures = SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS;

struct BodyStage {
    BodySkeleton skeleton;
    std::vector<Body> bodies;
    BodyGoals goals;
    std::vector<Float3> weights;

    explicit BodyStage(std::uint64_t seed, std::uint32_t body_count = kStageBodies)
    {
        Random random{seed};
        skeleton = random_body_skeleton(random, {5, 3, 1, false});
        for (std::uint32_t n = 0; n < body_count; ++n) {
            bodies.push_back(random_body(random, skeleton, {true, true, true}));
            weights.push_back({static_cast<float>(random.unit()), static_cast<float>(random.unit()),
                               random.below(2) ? 0 : static_cast<float>(random.unit())});
        }
        for (std::size_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
            goals.emplace_back();
            for (const Body& body : bodies) goals.back().push_back(random_goal(random, skeleton, body, limb));
        }
    }
    Crowd crowd() const
    {
        Crowd made = body_crowd(skeleton, kBodyFeatures, static_cast<std::uint32_t>(bodies.size()));
        write_goals(made, goals);
        for (std::uint32_t g = 0; g < goals.size(); ++g) made.write(SWIVEL_WEIGHTS, g, weights);
        return made;
    }
};

inline PoseLayout layout_of(int n)
{
    PoseLayout layout;
    layout.form = static_cast<swivel_pose_form>(n);
    layout.translates = layout.scales = layout.roots = true;
    return layout;
}

// The bits of all rotations of a body.
inline std::vector<std::uint32_t> pose_bits(const PoseBuffer& poses, std::size_t n)
{
    std::vector<std::uint32_t> bits(poses.joint_count * (poses.layout.form == SWIVEL_ROTATIONS ? 4 : 12));
    std::memcpy(bits.data(), &poses.bytes[n * poses.body_stride], bits.size() * sizeof bits[0]);
    return bits;
}

}  // namespace swivel::test
