// SPDX-License-Identifier: MIT
#include "tests/body_crowd.h"

namespace swivel::test {

BodyGoal own_goal(const BodySkeleton& skeleton, const Body& body, std::size_t limb)
{
    const JointAt wrist = joints_at(skeleton, body)[skeleton.limbs[limb].wrist];
    return {floats(Vector3d(vec(body.root_position) + wrist.place)), {0, 0, 1}, floats(wrist.rotation)};
}

BodyGoal random_goal(Random& random, const BodySkeleton& skeleton, const Body& body, std::size_t limb)
{
    const BodyLimbJoints& of = skeleton.limbs[limb];
    const std::vector<JointAt> at = joints_at(skeleton, body);
    const Vector3d shoulder = vec(body.root_position) + at[of.shoulder].place;
    const double upper = (at[of.elbow].place - at[of.shoulder].place).norm(),
                 fore = (at[of.wrist].place - at[of.elbow].place).norm(), near = std::fabs(upper - fore);
    const double distance = near + random.between(0.02, 0.98) * (upper + fore - near);
    return {floats(Vector3d(shoulder + distance * random.direction())),
            floats(Vector3d(shoulder + upper * random.direction())), floats(random.rotation())};
}

}  // namespace swivel::test
