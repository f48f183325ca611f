// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

struct Arm {
    Float3 shoulder, elbow, wrist;  // at rest; the last two in the joint above
    Float3 bend, target, pole;
};
struct Pose {
    Float4 shoulder, elbow;
};

// The same calls in every engine.
Pose solved(const Arm& arm)
{
    // [solve]
    const std::int32_t parents[] = {-1, 0, 1};
    const Float3 translations[] = {arm.shoulder, arm.elbow, arm.wrist};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = 3;
    skeleton.parents = swivel::stream(parents);
    skeleton.translations = swivel::stream(translations);
    swivel_limb_joints joints = swivel_default_limb_joints(0, 1, 2);
    std::ranges::copy(arm.bend, joints.bend);
    swivel_limb_def limb = swivel::limbs(1, SWIVEL_WORLD | SWIVEL_JOINTS);
    limb.binding = swivel::bind(skeleton, joints);
    swivel::Crowd crowd({limb});
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, arm.shoulder);
    crowd.write_all(SWIVEL_TARGET, 0, arm.target);
    crowd.write_all(SWIVEL_POLE, 0, arm.pole);
    crowd.solve();
    std::array<Float4, 1> shoulder, elbow;  // local rotations, x, y, z, w
    crowd.read(SWIVEL_SHOULDER, 0, shoulder);
    crowd.read(SWIVEL_ELBOW, 0, elbow);
    // [end]
    return {shoulder[0], elbow[0]};
}

// The engine's forward kinematics puts elbow and wrist where the picture says.
void check_pose(const Arm& arm, const Pose& pose, const Eigen::Vector3d& elbow)
{
    const Eigen::Vector3d got =
        vec(arm.shoulder) + quat(pose.shoulder) * vec(arm.elbow);
    const Eigen::Vector3d wrist =
        got + quat(pose.shoulder) * (quat(pose.elbow) * vec(arm.wrist));
    const double size = vec(arm.elbow).norm() + vec(arm.wrist).norm();
    CHECK((got - elbow).norm() < 1e-6 * size);
    CHECK((wrist - vec(arm.target)).norm() < 1e-6 * size);
}

// The right arm of a T-pose: 0.3 and 0.4 long, shoulder 0.2 to the right and 1.4 up,
// wrist 0.5 in front of it, elbow below: a triangle of 3, 4 and 5.
Arm unity()
{
    // [unity]
    const Arm arm{.shoulder = {0.2f, 1.4f, 0},
                  .elbow = {0.3f, 0, 0},  // bones along x
                  .wrist = {0.4f, 0, 0},
                  .bend = {0, 0, 1},
                  .target = {0.2f, 1.4f, 0.5f},
                  .pole = {0.2f, 0.4f, 0.2f}};
    // [end]
    return arm;
}

Arm unreal()
{
    // [unreal]
    const Arm arm{.shoulder = {0, 20, 140},
                  .elbow = {0, 30, 0},  // bones along y
                  .wrist = {0, 40, 0},
                  .bend = {1, 0, 0},
                  .target = {50, 20, 140},  // half a metre in front
                  .pole = {20, 20, 40}};    // below
    // [end]
    return arm;
}

// The same arm as a skeletal mesh has it, which looks along +y.
Arm unreal_mesh()
{
    // [unreal_mesh]
    const Arm arm{.shoulder = {-20, 0, 140},
                  .elbow = {-30, 0, 0},  // bones along -x
                  .wrist = {-40, 0, 0},
                  .bend = {0, 1, 0},
                  .target = {-20, 50, 140},
                  .pole = {-20, 20, 40}};
    // [end]
    return arm;
}

Arm godot()
{
    // [godot]
    const Arm arm{.shoulder = {0.2f, 1.4f, 0},
                  .elbow = {0.3f, 0, 0},  // bones along x
                  .wrist = {0.4f, 0, 0},
                  .bend = {0, 0, -1},
                  .target = {0.2f, 1.4f, -0.5f},
                  .pole = {0.2f, 0.4f, -0.2f}};
    // [end]
    return arm;
}

Arm blender()
{
    // [blender]
    const Arm arm{.shoulder = {-0.2f, 0, 1.4f},
                  .elbow = {-0.3f, 0, 0},  // bones along -x
                  .wrist = {-0.4f, 0, 0},
                  .bend = {0, -1, 0},
                  .target = {-0.2f, -0.5f, 1.4f},
                  .pole = {-0.2f, -0.2f, 0.4f}};
    // [end]
    return arm;
}

Arm gltf()
{
    return {.shoulder = {-0.2f, 1.4f, 0},
            .elbow = {-0.3f, 0, 0},
            .wrist = {-0.4f, 0, 0},
            .bend = {0, 0, 1},
            .target = {-0.2f, 1.4f, 0.5f},
            .pole = {-0.2f, 0.4f, 0.2f}};
}

// [convert]
Float3 point_to_unity(const Float3& p) { return {-p[0], p[1], p[2]}; }
Float4 turn_to_unity(const Float4& q) { return {q[0], -q[1], -q[2], q[3]}; }
Float3 point_to_unreal(const Float3& p)
{
    return {100 * p[2], -100 * p[0], 100 * p[1]};
}
Float4 turn_to_unreal(const Float4& q) { return {-q[2], q[0], -q[1], q[3]}; }
Float3 point_to_unreal_mesh(const Float3& p)
{
    return {100 * p[0], 100 * p[2], 100 * p[1]};
}
Float4 turn_to_unreal_mesh(const Float4& q) { return {-q[0], -q[2], -q[1], q[3]}; }
Float3 point_to_godot(const Float3& p) { return {-p[0], p[1], -p[2]}; }
Float4 turn_to_godot(const Float4& q) { return {-q[0], q[1], -q[2], q[3]}; }
Float3 point_to_blender(const Float3& p) { return {p[0], -p[2], p[1]}; }
Float4 turn_to_blender(const Float4& q) { return {q[0], -q[2], q[1], q[3]}; }
// [end]

// A glTF arm carried over is the engine's, and so is its pose.
template <class Point, class Turn>
void check_carried(const Arm& engine, Point point, Turn turn)
{
    const Arm source = gltf();
    CHECK(distance(point(source.elbow), engine.elbow) < 1e-5);
    CHECK((vec(point(source.bend)).normalized() - vec(engine.bend)).norm() < 1e-6);
    CHECK(distance(point(source.target), engine.target) < 1e-5);
    CHECK(distance(point(source.shoulder), engine.shoulder) < 1e-5);
    const Pose carried = solved(source), own = solved(engine);
    CHECK(turn_between(turn(carried.shoulder), own.shoulder) < 1e-6);
    CHECK(turn_between(turn(carried.elbow), own.elbow) < 1e-6);
}

// The page's numbers, which follow from the triangle: all components of the upper arm's
// turn are +-1 / sqrt 20 or +-3 / sqrt 20, and the elbow makes a right angle.
void check_rotations(const Pose& pose, const Float4& shoulder, const Float4& elbow)
{
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(pose.shoulder[i] == Approx(shoulder[i]).margin(5e-5));
        CHECK(pose.elbow[i] == Approx(elbow[i]).margin(5e-5));
    }
}

}  // namespace

TEST_CASE("docs: Unity")
{
    check_pose(unity(), solved(unity()), {0.2, 1.16, 0.18});
    check_rotations(solved(unity()), {-0.2236f, -0.2236f, -0.6708f, 0.6708f},
                    {0, -0.7071f, 0, 0.7071f});
    check_carried(unity(), point_to_unity, turn_to_unity);
}

TEST_CASE("docs: Unreal")
{
    check_pose(unreal(), solved(unreal()), {18, 20, 116});
    check_rotations(solved(unreal()), {-0.6708f, -0.2236f, -0.2236f, 0.6708f},
                    {0, 0, -0.7071f, 0.7071f});
    check_carried(unreal(), point_to_unreal, turn_to_unreal);
}

TEST_CASE("docs: Unreal's skeletal meshes")
{
    check_pose(unreal_mesh(), solved(unreal_mesh()), {-20, 18, 116});
    check_carried(unreal_mesh(), point_to_unreal_mesh, turn_to_unreal_mesh);
}

TEST_CASE("docs: Godot")
{
    check_pose(godot(), solved(godot()), {0.2, 1.16, -0.18});
    check_rotations(solved(godot()), {0.2236f, 0.2236f, -0.6708f, 0.6708f},
                    {0, 0.7071f, 0, 0.7071f});
    check_carried(godot(), point_to_godot, turn_to_godot);
}

TEST_CASE("docs: Blender")
{
    check_pose(blender(), solved(blender()), {-0.2, -0.18, 1.16});
    check_rotations(solved(blender()), {-0.2236f, -0.6708f, 0.2236f, 0.6708f},
                    {0, 0, 0.7071f, 0.7071f});
    check_carried(blender(), point_to_blender, turn_to_blender);
}

TEST_CASE("docs: glTF") { check_pose(gltf(), solved(gltf()), {-0.2, 1.16, 0.18}); }
