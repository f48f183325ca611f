// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

// A pose to start from: what a plain crowd makes of another target.
void pose_of(const Float3& target, Float4& shoulder, Float4& elbow)
{
    swivel::Crowd crowd({swivel::limbs(1)});
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    crowd.write_all(SWIVEL_TARGET, 0, target);
    crowd.write_all(SWIVEL_POLE, 0, Float3{-1, -1, 0});
    crowd.solve();
    std::array<Float4, 1> q;
    std::array<Float2, 1> flexion;
    crowd.read(SWIVEL_SHOULDER, 0, q);
    crowd.read(SWIVEL_ELBOW, 0, flexion);
    shoulder = q[0];
    elbow = {-flexion[0][1], 0, 0, flexion[0][0]};
}

}  // namespace

TEST_CASE("docs: incoming pose and weights")
{
    Float4 shoulder, elbow;
    pose_of({0.5f, 0.2f, 1.2f}, shoulder, elbow);
    // [shown]
    swivel::Crowd crowd({swivel::limbs(
        1, SWIVEL_WITH_INCOMING | SWIVEL_POLE_INCOMING | SWIVEL_WITH_WEIGHTS)});
    // The clip's pose: whole quaternions, x, y, z, w.
    crowd.write_all(SWIVEL_INCOMING_SHOULDER, 0, shoulder);
    crowd.write_all(SWIVEL_INCOMING_ELBOW, 0, elbow);
    // Half way from the clip's wrist to the target.
    crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0.5f, 1, 1});
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.9f, 0.5f, 1.1f});
    crowd.solve();
    std::array<Double3, 1> wrist;
    crowd.wrists(0, wrist);
    CHECK(distance(wrist[0], Float3{0.7f, 0.35f, 1.15f}) < 1e-5);
    std::array<std::uint32_t, 1> flags;
    crowd.read(SWIVEL_FLAGS, 0, flags);
    CHECK(flags[0] == SWIVEL_REACHED);
}
