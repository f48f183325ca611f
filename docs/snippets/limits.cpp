// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

void give_arm(swivel::Crowd& crowd)
{
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.25f, 0.15f, 0.25f});
    crowd.write_all(SWIVEL_POLE, 0, Float3{-1, 1, 0});
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.30f, 0.26f});
}

std::uint32_t flags_of(const swivel::Crowd& crowd)
{
    std::array<std::uint32_t, 1> flags;
    crowd.read(SWIVEL_FLAGS, 0, flags);
    return flags[0];
}

Eigen::Vector3d elbow_of(const swivel::Crowd& crowd)
{
    std::array<Double3, 1> elbow;
    crowd.elbows(0, elbow);
    return vec(elbow[0]);
}

}  // namespace

TEST_CASE("docs: cones")
{
    // [cone]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_SHOULDER_CONE)});
    // No further than 0.9 radians from the arm at rest.
    crowd.write_all(SWIVEL_SHOULDER_CONE, 0, swivel::cone({0, 0, 1}, 0.9));
    // [end]
    give_arm(crowd);
    crowd.solve();
    CHECK(elbow_of(crowd).normalized().z() >= std::cos(0.9) - 1e-6);
    CHECK(flags_of(crowd) == (SWIVEL_REACHED | SWIVEL_LIMITED_SHOULDER_CONE));
}

TEST_CASE("docs: regions")
{
    // [region]
    swivel::Region region;
    region.add_cones({{{0, 0.3f, 1}, 0.5f}, {{1, 0, 0.4f}, 0.5f}});
    region.forbid({{-0.8f, 0, 1}, 0.4f});  // where the chest is
    swivel_limb_def arms = swivel::limbs(1, SWIVEL_WITH_REGION);
    arms.region = &region.get();
    swivel::Crowd crowd({arms});
    // [end]
    give_arm(crowd);
    crowd.solve();
    const Eigen::Vector3f to = elbow_of(crowd).cast<float>();
    CHECK(region.room({to.x(), to.y(), to.z()}) >= -1e-6f);
    CHECK(flags_of(crowd) == (SWIVEL_REACHED | SWIVEL_LIMITED_REGION));
}

TEST_CASE("docs: a region of a clip")
{
    const Eigen::Vector3f z = Eigen::Vector3f::UnitZ();
    const Eigen::Quaternionf parent_from_arm(0.8f, 0.6f, 0, 0),
        upper_from_arm(0.6f, 0, 0, 0.8f);
    std::vector<Eigen::Quaternionf> clip;
    for (int n = 0; n < 50; ++n)
        clip.emplace_back(Eigen::AngleAxisf(0.03f * static_cast<float>(n),
                                            Eigen::Vector3f(1, 2, 3).normalized()));
    // [clip]
    // Where the upper arm points, from the shoulder joint's local rotation.
    const auto pointing = [&](const Eigen::Quaternionf& local) {
        const Eigen::Vector3f direction =
            parent_from_arm.conjugate() * (local * (upper_from_arm * z));
        return Float3{direction.x(), direction.y(), direction.z()};
    };
    std::vector<Float3> directions;
    for (const Eigen::Quaternionf& local : clip) directions.push_back(pointing(local));
    swivel::Region region;
    const auto margin = static_cast<float>(swivel::degrees(5));
    region.add_directions(directions, margin, 4);
    // [end]
    for (const Float3& direction : directions) {
        CHECK(region.room(direction) > 0);
        CHECK(region.room({-direction[0], -direction[1], -direction[2]}) < 0);
    }
}

TEST_CASE("docs: twists")
{
    // [twist]
    const swivel_features twists =
        SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_FOREARM_TWIST;
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_HAND | twists)});
    crowd.write_all(SWIVEL_HUMERAL_TWIST, 0, swivel::range(-1.5, 1.2));
    // Of the hand, about the forearm.
    crowd.write_all(SWIVEL_FOREARM_TWIST, 0, swivel::range(-1.4, 1.4));
    // [end]
    give_arm(crowd);
    crowd.solve();
    const auto twist_of = [&](swivel_field field) {
        std::array<Float4, 1> q;
        crowd.read(field, 0, q);
        return 2 * std::atan(quat(q[0]).z() / quat(q[0]).w());
    };
    CHECK(twist_of(SWIVEL_SHOULDER) <= 1.2 + 1e-5);
    CHECK(twist_of(SWIVEL_SHOULDER) >= -1.5 - 1e-5);
    CHECK(std::abs(twist_of(SWIVEL_WRIST)) <= 1.4 + 1e-5);
}

TEST_CASE("docs: flexion")
{
    // [flexion]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_FLEXION_LIMIT)});
    // Never quite straight.
    crowd.write_all(SWIVEL_FLEXION_LIMIT, 0, swivel::flexion(0.1, 2.4));
    // [end]
    give_arm(crowd);
    crowd.write_all(SWIVEL_TARGET, 0, {0, 0, 9});
    crowd.solve();
    std::array<Float2, 1> elbow;  // of half the angle
    crowd.read(SWIVEL_ELBOW, 0, elbow);
    CHECK(elbow[0][1] == Approx(std::sin(0.05)).margin(5e-6));
    CHECK(flags_of(crowd) == (SWIVEL_CLAMPED_FAR | SWIVEL_LIMITED_FLEXION));
}

TEST_CASE("docs: Euler boxes")
{
    // [box]
    swivel_limb_def arms = swivel::limbs(1, SWIVEL_WITH_SHOULDER_BOX);
    arms.shoulder_order = SWIVEL_YXZ;
    swivel::Crowd crowd({arms});
    std::array<float, 12> box;
    swivel::check(swivel_range(-1.0, 1.0, &box[0]));  // about y
    swivel::check(swivel_range(-0.4, 1.6, &box[4]));  // then x
    swivel::check(swivel_range(-0.8, 0.8, &box[8]));  // then z
    crowd.write_all(SWIVEL_SHOULDER_BOX, 0, box);
    // [end]
    give_arm(crowd);
    crowd.solve();
    std::array<std::array<double, 7>, 1> angles;
    crowd.joint_angles(0, SWIVEL_YXZ, SWIVEL_XYZ, 0, angles);
    CHECK(std::abs(angles[0][0]) < 1 + 1e-5);
    CHECK(std::abs(angles[0][1] - 0.6) < 1 + 1e-5);
    CHECK(std::abs(angles[0][2]) < 0.8 + 1e-5);
    CHECK(flags_of(crowd) == (SWIVEL_REACHED | SWIVEL_LIMITED_SHOULDER_BOX));
}

TEST_CASE("docs: allowed arcs")
{
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_SHOULDER_CONE)});
    give_arm(crowd);
    crowd.write_all(SWIVEL_SHOULDER_CONE, 0, swivel::cone({0, 0, 1}, 0.9));
    std::vector<std::array<double, 2>> shown;
    // [arcs]
    for (const swivel_arc& arc : crowd.allowed_arcs(0, 0)) {  // group 0, its limb 0
        // Radians on from the wish, about the line from shoulder to wrist.
        const double from = std::atan2(arc.from[1], arc.from[0]);
        const double to = std::atan2(arc.to[1], arc.to[0]);
        shown.push_back({from, to});
    }
    // [end]
    REQUIRE(shown.size() == 1);
    CHECK(shown[0][0] != shown[0][1]);
}

TEST_CASE("docs: limits that do not pop")
{
    // [wins]
    swivel::Crowd crowd({swivel::limbs(
        1, SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_MAX_SWIVEL | SWIVEL_STEP_WINS)});
    // 540 degrees a second, at 60 frames a second.
    crowd.write_all(SWIVEL_MAX_SWIVEL, 0, swivel::cos_sin(swivel::degrees(9)));
    // [end]
    give_arm(crowd);
    crowd.solve();
    crowd.write_all(SWIVEL_SHOULDER_CONE, 0, swivel::cone({0, 0, 1}, 0.6));
    crowd.solve();
    CHECK(flags_of(crowd) ==
          (SWIVEL_REACHED | SWIVEL_LIMITED_SHOULDER_CONE | SWIVEL_LIMITED_STEP));
    for (int frame = 0; frame < 20; ++frame) crowd.solve();
    CHECK(flags_of(crowd) == (SWIVEL_REACHED | SWIVEL_LIMITED_SHOULDER_CONE));
}

TEST_CASE("docs: limits in the character's axes")
{
    const swivel_binding left = bound({0.30f, 0, 0}, {0.26f, 0, 0}, {0, 0, 1});
    swivel_limb_def arm =
        swivel::limbs(1, SWIVEL_JOINTS | SWIVEL_WORLD | SWIVEL_WITH_SHOULDER_CONE);
    arm.binding = left;
    swivel::Crowd crowd({arm});
    // [character]
    // Within 80 degrees of forwards and down: the character faces +z, with y up.
    const std::array<float, 4> clavicle{0, 0, 0,
                                        1};  // its world rotation in the rest pose
    const std::array<double, 3> axis = swivel::arm_axis(left, clavicle, {0, -1, 1});
    crowd.write_all(SWIVEL_SHOULDER_CONE, 0, swivel::cone(axis, swivel::degrees(80)));
    // [end]
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.1f, -0.1f, -0.3f});  // behind
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, 0, -1});
    crowd.solve();
    const double cosine =
        elbow_of(crowd).normalized().dot(Eigen::Vector3d(0, -1, 1).normalized());
    CHECK(std::acos(cosine) < swivel::degrees(80) + 1e-3);
    CHECK(flags_of(crowd) == (SWIVEL_REACHED | SWIVEL_LIMITED_SHOULDER_CONE));
}
