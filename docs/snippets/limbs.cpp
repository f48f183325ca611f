// SPDX-License-Identifier: MIT
#include "check.h"

namespace {

constexpr Float3 kTarget{0.3f, 0.1f, 0.3f};

// An arm with its elbow down, unless a page's program says otherwise.
void give_arm(swivel::Crowd& crowd, const Float3& target = kTarget)
{
    crowd.write_all(SWIVEL_LENGTHS, 0, {0.30f, 0.26f});
    crowd.write_all(SWIVEL_TARGET, 0, target);
    if (swivel_field_row_count(crowd.get(), 0, SWIVEL_POLE))
        crowd.write_all(SWIVEL_POLE, 0, {0, -1, 0});
}

Eigen::Vector3d elbow_of(const swivel::Crowd& crowd)
{
    std::array<Double3, 1> elbow;
    crowd.elbows(0, elbow);
    return vec(elbow[0]);
}
Eigen::Vector3d wrist_of(const swivel::Crowd& crowd)
{
    std::array<Double3, 1> wrist;
    crowd.wrists(0, wrist);
    return vec(wrist[0]);
}

// The elbow is in the half plane of the line and the pole.
void check_side(const swivel::Crowd& crowd, const Eigen::Vector3d& pole)
{
    const Eigen::Vector3d elbow = elbow_of(crowd),
                          normal = vec(kTarget).cross(pole).normalized(),
                          side = normal.cross(vec(kTarget)).normalized();
    CHECK(std::abs(elbow.dot(normal)) < 1e-6);
    CHECK(elbow.dot(side) > 0.05);
}

}  // namespace

TEST_CASE("docs: legs")
{
    // [leg]
    // Pelvis, hip, knee and ankle at rest: bones down -y, knees forward, +z.
    const std::int32_t parents[] = {-1, 0, 1, 2};
    const Float3 translations[] = {
        {0, 0.95f, 0}, {0.1f, 0, 0}, {0, -0.45f, 0}, {0, -0.42f, 0}};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = 4;
    skeleton.parents = swivel::stream(parents);
    skeleton.translations = swivel::stream(translations);
    swivel_limb_joints leg = swivel_default_limb_joints(1, 2, 3);
    leg.bend[2] = -1;  // the knee bends backwards
    swivel_limb_def left_leg = swivel::limbs(1, SWIVEL_WORLD | SWIVEL_JOINTS);
    left_leg.binding = swivel::bind(skeleton, leg);
    swivel::Crowd crowd({left_leg});
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0.1f, 0.95f, 0});  // the hip
    // The ankle, on a step.
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.1f, 0.25f, 0.1f});
    // In front: where the knee points.
    crowd.write_all(SWIVEL_POLE, 0, Float3{0.1f, 0.5f, 2});
    crowd.solve();
    std::array<Float4, 1> thigh, shin;  // local rotations, x, y, z, w
    crowd.read(SWIVEL_SHOULDER, 0, thigh);
    crowd.read(SWIVEL_ELBOW, 0, shin);
    // [end]
    const Eigen::Vector3d hip(0.1, 0.95, 0),
        knee = hip + quat(thigh[0]) * Eigen::Vector3d(0, -0.45, 0);
    const Eigen::Vector3d ankle =
        knee + quat(thigh[0]) * (quat(shin[0]) * Eigen::Vector3d(0, -0.42, 0));
    CHECK((ankle - Eigen::Vector3d(0.1, 0.25, 0.1)).norm() < 1e-6);
    CHECK(knee.z() > 0.2);
}

TEST_CASE("docs: joints of a skeleton")
{
    // [skeleton]
    struct Joint {
        std::int32_t parent;
        Float3 place;     // in the parent's frame
        Float4 rotation;  // relative to the parent
    };
    const Float4 none = {0, 0, 0, 1};
    const std::vector<Joint> joints = {
        {-1, {0, 1.4f, 0}, none},  // 0: chest
        {0, {0.2f, 0, 0}, none},   // 1: upper arm
        {1, {0.15f, 0, 0}, none},  // 2: a roll joint in it
        {2, {0.15f, 0, 0}, none},  // 3: forearm
        {3, {0.13f, 0, 0}, none},  // 4: its twist bone
        {3, {0.26f, 0, 0}, none},  // 5: hand
    };
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = 6;
    skeleton.parents = swivel::stream(joints, &Joint::parent);
    skeleton.translations = swivel::stream(joints, &Joint::place);
    skeleton.rotations = swivel::stream(joints, &Joint::rotation);

    swivel_limb_joints left = swivel_default_limb_joints(1, 3, 5);
    const std::uint32_t twist_bones[] = {4};
    left.twist_bones = twist_bones;
    left.twist_bone_count = 1;
    left.bend[2] = 1;  // the elbow bends forwards
    swivel_limb_def left_arm =
        swivel::limbs(1, SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND);
    left_arm.binding = swivel::bind(skeleton, left);
    left_arm.twist_bone_count = 1;
    // [end]
    swivel::Crowd crowd({left_arm});
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, {0.2f, 1.4f, 0});
    crowd.write_all(SWIVEL_TARGET, 0, {0.3f, 1.2f, 0.35f});
    crowd.write_all(SWIVEL_HAND, 0, {0.6f, 0, 0, 0.8f});
    crowd.solve();
    CHECK((wrist_of(crowd) - Eigen::Vector3d(0.3, 1.2, 0.35)).norm() < 1e-6);
    std::array<Float4, 1> hand, twist;
    crowd.read(SWIVEL_WRIST, 0, hand);
    crowd.read(SWIVEL_TWIST_BONES, 0, twist);
    const auto about_x = [](const Float4& q) { return 2 * std::atan2(q[0], q[3]); };
    CHECK(std::abs(about_x(twist[0]) - about_x(hand[0]) / 2) < 0.0022f);
}

TEST_CASE("docs: mirrored limits")
{
    // [mirror]
    const std::array<float, 4> left = swivel::range(-1.5, 0.4);
    std::array<float, 4> right;
    swivel::check(
        swivel_mirror(SWIVEL_HUMERAL_TWIST, SWIVEL_XYZ, left.data(), right.data()));
    // [end]
    const std::array<float, 4> want = swivel::range(-0.4, 1.5);
    for (std::size_t n = 0; n < 4; ++n) CHECK(std::abs(right[n] - want[n]) < 1e-6f);
}

TEST_CASE("docs: hand orientation")
{
    // [hand]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_HAND)});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.3f, 0.1f, 0.3f});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0.30f, 0.26f});
    // A quarter turn about y.
    crowd.write_all(SWIVEL_HAND, 0, Float4{0, 0.7071068f, 0, 0.7071068f});
    crowd.solve();

    std::array<Float4, 1> wrist;  // the hand relative to the forearm
    crowd.read(SWIVEL_WRIST, 0, wrist);
    // [end]
    std::array<Double4, 1> hand;
    crowd.hands(0, hand);
    CHECK(turn_between(hand[0], Float4{0, 1, 0, 1}) < 1e-6);
    CHECK(turn_between(wrist[0], Float4{0, 0, 0, 1}) > 0.1);
}

TEST_CASE("docs: effector")
{
    // [effector]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR)});
    // The palm, as the hand has it.
    crowd.write_all(SWIVEL_EFFECTOR, 0, Float3{0, -0.02f, 0.09f});
    crowd.write_all(SWIVEL_HAND, 0, Float4{0, 0.6f, 0, 0.8f});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.3f, 0.1f, 0.3f});  // where the palm goes
    // [end]
    give_arm(crowd);
    crowd.solve();
    const Eigen::Quaterniond hand(0.8, 0, 0.6, 0);
    const Eigen::Vector3d palm =
        wrist_of(crowd) + hand * Eigen::Vector3d(0, -0.02, 0.09);
    CHECK((palm - vec(kTarget)).norm() < 1e-6);
}

TEST_CASE("docs: swivel angle")
{
    // [angle]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_ANGLE)});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    // Radians on from the pole, about the line to the wrist.
    crowd.write_all(SWIVEL_ANGLE, 0, swivel::cos_sin(0.35));
    // [end]
    give_arm(crowd);
    crowd.solve();
    const Eigen::AngleAxisd on(0.35, vec(kTarget).normalized());
    check_side(crowd, on * Eigen::Vector3d(0, -1, 0));
}

TEST_CASE("docs: the hand as the pole")
{
    // [hand_pole]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_HAND | SWIVEL_POLE_HAND)});
    // The hand points to the side, so the forearm comes from the other.
    crowd.write_all(SWIVEL_HAND, 0, Float4{0, 0.6f, 0, 0.8f});
    // [end]
    give_arm(crowd);
    crowd.solve();
    check_side(crowd, Eigen::Quaterniond(0.8, 0, 0.6, 0) * -Eigen::Vector3d::UnitZ());
}

TEST_CASE("docs: no pole")
{
    // [half_line]
    const swivel_limb_def arms = swivel::limbs(1, SWIVEL_POLE_HALF_LINE);
    swivel_limb_def legs = arms;
    legs.pole_behind[1] = 1;  // behind: where knees bend to
    swivel::Crowd crowd({arms, legs});
    // [end]
    give_arm(crowd);
    crowd.write_all(SWIVEL_LENGTHS, 1, {0.45f, 0.43f});
    crowd.write_all(SWIVEL_TARGET, 1, {0, -0.5f, 0.5f});
    crowd.solve();
    for (const std::uint32_t group : {0u, 1u}) {
        std::array<std::uint32_t, 1> flags;
        crowd.read(SWIVEL_FLAGS, group, flags);
        CHECK(flags[0] == SWIVEL_REACHED);
    }
    // The normal is (u - R) x V: R behind, V so that an elbow at rest lies there, too.
    const Eigen::Vector3d u = vec(kTarget).normalized(), r(0, -1, 0), v(0, 0, 1),
                          normal = (u - r).cross(v);
    check_side(crowd, normal.cross(u));
}

TEST_CASE("docs: aiming")
{
    // [aim]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_AIM)});
    // Along the hand, +z at rest, with the elbow bent by half a radian.
    const Double3 along_hand{0, 0, 1};
    crowd.write_all(SWIVEL_AIM, 0, swivel::aim(along_hand, 0.5));
    crowd.write_all(SWIVEL_TARGET, 0, Float3{2, 1, 5});  // what to point at
    // [end]
    give_arm(crowd, {2, 1, 5});
    crowd.solve();
    const Eigen::Vector3d upper = elbow_of(crowd), fore = wrist_of(crowd) - upper,
                          ray = Eigen::Vector3d(2, 1, 5) - wrist_of(crowd);
    CHECK((ray.normalized() - fore.normalized()).norm() < 1e-6);
    CHECK(std::acos(upper.normalized().dot(fore.normalized())) == Approx(0.5));
}

TEST_CASE("docs: clavicle")
{
    // [clavicle]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WORLD | SWIVEL_WITH_CLAVICLE)});
    // The shoulder, as the clavicle's joint has it, and a third of the way.
    crowd.write_all(SWIVEL_CLAVICLE, 0, Float4{0.15f, 0, 0, 0.33f});
    // As they are without this turn.
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0.2f, 1.4f, 0});
    crowd.write_all(SWIVEL_PARENT_ROTATION, 0, Float4{0, 0, 0, 1});
    // [end]
    give_arm(crowd, {0.3f, 1.8f, 0.2f});
    crowd.solve();
    std::array<Float4, 1> turn;
    crowd.read(SWIVEL_CLAVICLE_ROTATION, 0, turn);
    const Eigen::Vector3d joint(0.05, 1.4, 0), bone(0.15, 0, 0);
    const Eigen::Vector3d shoulder = joint + quat(turn[0]) * bone;
    CHECK((shoulder - Eigen::Vector3d(0.2, 1.4, 0)).norm() > 0.02);
    CHECK((elbow_of(crowd) - shoulder).norm() == Approx(0.30));
    CHECK((wrist_of(crowd) - Eigen::Vector3d(0.3, 1.8, 0.2)).norm() < 1e-6);
}

TEST_CASE("docs: soft reach and stretch")
{
    // [reach]
    swivel::Crowd crowd({swivel::limbs(3, SWIVEL_WITH_REACH)});
    // Shares of both bones' length: eased 0.1 before the far end, not at the near one;
    // stretched up to 1.05; no wrist nearer than 0.2.
    crowd.write_all(SWIVEL_REACH, 0, Float4{0.1f, 0, 1.05f, 0.2f});
    // [end]
    crowd.write_all(SWIVEL_LENGTHS, 0, {0.5f, 0.5f});
    crowd.write(SWIVEL_TARGET, 0,
                std::array<Float3, 3>{{{0, 0, 0.98f}, {0, 0, 2}, {0, 0, 0.1f}}});
    crowd.solve();
    std::array<Double3, 3> wrists;
    crowd.wrists(0, wrists);
    CHECK(distance(wrists[0], Float3{0, 0, 0.98f}) < 1e-6);
    CHECK(distance(wrists[1], Float3{0, 0, 1.05f}) < 1e-6);
    CHECK(distance(wrists[2], Float3{0, 0, 0.2f}) < 1e-6);
}

TEST_CASE("docs: incoming pose and weights")
{
    // Of a straight arm along z.
    const Float4 shoulder{0, 0, 0, 1}, elbow{0, 0, 0, 1};
    // [incoming]
    swivel::Crowd crowd({swivel::limbs(
        1, SWIVEL_WITH_INCOMING | SWIVEL_POLE_INCOMING | SWIVEL_WITH_WEIGHTS)});
    // The clip's pose: whole quaternions, x, y, z, w.
    crowd.write_all(SWIVEL_INCOMING_SHOULDER, 0, shoulder);
    crowd.write_all(SWIVEL_INCOMING_ELBOW, 0, elbow);
    // Half way from the clip's wrist to the target.
    crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0.5f, 1, 1});
    // [end]
    give_arm(crowd);
    crowd.solve();
    CHECK((wrist_of(crowd) - Eigen::Vector3d(0.15, 0.05, 0.43)).norm() < 1e-5);
}

TEST_CASE("docs: step limit")
{
    // [step]
    swivel::Crowd crowd({swivel::limbs(1, SWIVEL_WITH_MAX_SWIVEL)});
    // Radians for each solve: 0.1 at 60 a second is 6 a second.
    crowd.write_all(SWIVEL_MAX_SWIVEL, 0, swivel::cos_sin(0.1));
    // [end]
    give_arm(crowd);
    crowd.solve();
    check_side(crowd, {0, -1, 0});
    crowd.write_all(SWIVEL_POLE, 0, {0, 1, 0});  // the elbow starts towards it
    crowd.solve();
    CHECK(elbow_of(crowd).y() < 0);
    // [step_reset]
    // After a teleport: the group's next solve goes straight to its wish.
    crowd.reset(0);
    crowd.solve();
    // [end]
    check_side(crowd, {0, 1, 0});
}

TEST_CASE("docs: twist bones")
{
    // [twist_bones]
    swivel_limb_def arm = swivel::limbs(1, SWIVEL_WITH_HAND);
    arm.twist_bone_count = 3;
    swivel::Crowd crowd({arm});
    // [end]
    give_arm(crowd);
    crowd.write_all(SWIVEL_HAND, 0, {0, 0, 0.6f, 0.8f});
    crowd.solve();
    std::array<std::array<Float4, 3>, 1> twist;
    crowd.read(SWIVEL_TWIST_BONES, 0, twist);
    std::array<Float4, 1> wrist;
    crowd.read(SWIVEL_WRIST, 0, wrist);
    const auto about_forearm = [](const Float4& q) {
        return 2 * std::atan2(quat(q).z(), quat(q).w());
    };
    const double whole = about_forearm(wrist[0]);
    CHECK(std::abs(whole) > 0.3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(std::abs(about_forearm(twist[0][i]) -
                       whole * static_cast<double>(i + 1) / 4) < 0.0022);
}

TEST_CASE("docs: results")
{
    swivel::Crowd crowd({swivel::limbs(2)});
    give_arm(crowd);
    const std::array<Float3, 2> targets{{kTarget, {0, 0.2f, 9}}};
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.solve();
    std::uint32_t far = 0;
    // [flags]
    std::array<std::uint32_t, 2> flags;
    crowd.read(SWIVEL_FLAGS, 0, flags);
    for (const std::uint32_t flag : flags) {
        if (flag & SWIVEL_BAD_INPUT)
            continue;  // a bad number went in; the limb has its rest pose
        if (flag & SWIVEL_CLAMPED_FAR)
            ++far;  // out of reach: step closer, lean, let go
    }
    // [end]
    CHECK(far == 1);
    // [forward]
    std::array<Double3, 2> elbows, wrists;  // in the targets' space
    std::array<double, 2> off;              // from target to wrist, in arm lengths
    crowd.elbows(0, elbows);
    crowd.wrists(0, wrists);
    crowd.residuals(0, off);
    // [end]
    CHECK(distance(wrists[0], kTarget) < 1e-6);
    CHECK(off[0] < 1e-6);
    CHECK(off[1] == Approx((std::hypot(0.2, 9.0) - 0.56) / 0.56));
    // [angles]
    // Radians: shoulder y, x, z; flexion; wrist (0 without a hand).
    std::array<std::array<double, 7>, 2> angles;
    crowd.joint_angles(0, SWIVEL_YXZ, SWIVEL_XYZ, 0, angles);
    // [end]
    using Eigen::AngleAxisd;
    const Eigen::Vector3d fore(0, std::sin(angles[0][3]), std::cos(angles[0][3]));
    const Eigen::Vector3d wrist = AngleAxisd(angles[0][0], Eigen::Vector3d::UnitY()) *
                                  AngleAxisd(angles[0][1], Eigen::Vector3d::UnitX()) *
                                  AngleAxisd(angles[0][2], Eigen::Vector3d::UnitZ()) *
                                  (Eigen::Vector3d(0, 0, 0.30) + 0.26 * fore);
    CHECK((wrist - vec(kTarget)).norm() < 1e-6);
    // [pack]
    // 16-bit rows: keep these, send them, or give them to a GPU.
    const std::vector<std::uint16_t> words = crowd.pack(0);  // of group 0
    const std::uint32_t row = swivel_packed_row(crowd.get(), 0, SWIVEL_SHOULDER);
    Float4 shoulder;  // limb 1 of block 0
    swivel_unpack_rotation(words.data() + row * SWIVEL_LANES + 1, SWIVEL_LANES,
                           shoulder.data());
    // [end]
    std::array<Float4, 2> want;
    crowd.read(SWIVEL_SHOULDER, 0, want);
    CHECK(turn_between(shoulder, want[1]) < 1.54e-4);
}

TEST_CASE("docs: rows")
{
    swivel::Crowd crowd({swivel::limbs(2)});
    give_arm(crowd);
    // [rows]
    const swivel_rows in = swivel_input_rows(crowd.get(), 0);  // group 0
    const std::uint32_t row = swivel_field_first_row(crowd.get(), 0, SWIVEL_TARGET);
    const std::uint32_t limb = 1;  // of the group
    float* const x = in.base +
                     (limb / SWIVEL_LANES * in.row_count + row) * SWIVEL_LANES +
                     limb % SWIVEL_LANES;
    x[0] = 0.1f;
    x[SWIVEL_LANES] = 0.2f;      // y
    x[2 * SWIVEL_LANES] = 0.3f;  // z
    crowd.solve();
    // [end]
    std::array<Double3, 2> wrists;
    crowd.wrists(0, wrists);
    CHECK(distance(wrists[1], Float3{0.1f, 0.2f, 0.3f}) < 1e-6);
}
