// SPDX-License-Identifier: MIT
//
// The promise: aims and clavicles do as they say, by the skeleton's own forward kinematics in Eigen. With a given
// flexion and a given wrist, the hand's ray goes through the target, and the elbow is on the pole's side. A target that
// the hand cannot aim at has a flag. Limits of the shoulder and regions hold. The clavicle turns towards the target by
// its share, as a curve in Eigen says, and the arm hangs from the turned clavicle. A share of 0, or a position weight
// of 0, changes nothing.
#include "tests/limited_arms.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// One limb's aim, in the wrist joint's own frame.
struct Aim {
    Vector3d axis, effector;
    double flexion;
};

Aim random_aim(Random& random)
{
    return {random.direction(), vec(floats(random.vector(0, 0.3))), random.between(0, 3)};
}

std::array<float, 5> value_of(const Aim& aim)
{
    std::array<float, 5> value;
    CHECK(swivel_aim(aim.axis.data(), aim.flexion, value.data()) == SWIVEL_OK);
    return value;
}

// How far a point is from a ray.
double off_ray(const Vector3d& point, const Vector3d& from, const Vector3d& axis)
{
    const Vector3d ahead = point - from;
    return (ahead - std::max(ahead.dot(axis), 0.0) * axis).norm();
}

}  // namespace

TEST_CASE("the hand's ray goes through the target, with the flexion and the wrist given")
{
    constexpr std::uint32_t count = 300;
    Random random{1};
    const BoundLimb limb = bound_limb(random);
    Crowd crowd = crowd_of(kWorldJointsHand | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_AIM, count, limb.bound);
    std::vector<Limb> limbs;
    std::vector<Aim> aims;
    for (std::uint32_t n = 0; n < count; ++n) {
        Limb each = random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]});
        const Parent parent = each.parent();
        each.target = floats(Vector3d(parent.position + parent.scale * random.vector(0.2, 8)));
        write_limb(crowd, 0, n, each);  // SWIVEL_HAND is the wrist's local rotation
        aims.push_back(random_aim(random));
        put(crowd, SWIVEL_EFFECTOR, n, floats(aims[n].effector));
        put(crowd, SWIVEL_AIM, n, value_of(aims[n]));
        limbs.push_back(each);
    }
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    std::vector<double> residuals(count);
    crowd.residuals(0, residuals);
    std::uint32_t aimed = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        INFO("limb " << n << ", flags " << flags[n]);
        const Parent parent = limbs[n].parent();
        const LocalPose pose = local_pose(crowd, n);
        const Vector3d tip =
            pose.wrist_place(limb.rest, parent) + parent.scale * (pose.hand(parent) * aims[n].effector);
        const double length = parent.scale * (limb.bound.lengths[0] + limb.bound.lengths[1]);
        const double miss = off_ray(vec(limbs[n].target), tip, pose.hand(parent) * aims[n].axis) / length;
        CHECK(residuals[n] == Approx(miss).margin(1e-6));
        CHECK(distance(pose.wrist, quat(limbs[n].hand).normalized()) <= 1e-6);
        const double bent = angle_between(vec(limb.rest.translations[1]), pose.elbow * vec(limb.rest.translations[2]));
        CHECK(bent == Approx(aims[n].flexion).margin(2e-6));
        if (flags[n] == SWIVEL_REACHED) {
            ++aimed;
            CHECK(miss <= 1e-5);  // 2e-6 of the target's distance at most
            const Vector3d elbow = parent.rotation * pose.shoulder * vec(limb.rest.translations[1]);
            const Vector3d line = (vec(limbs[n].target) - parent.position).normalized();
            const Vector3d pole = vec(limbs[n].pole) - parent.position, across = pole - pole.dot(line) * line;
            const Vector3d out = elbow - elbow.dot(line) * line;
            CHECK(angle_between(out, across) <= 1e-5 / std::min(out.norm(), across.norm()) + 1e-5);
        } else {
            CHECK(flags[n] == SWIVEL_CLAMPED_NEAR);
        }
    }
    CHECK(aimed > 150);
    CHECK(aimed < count);
}

TEST_CASE("a target too near for the flexion: the ray's nearest point to the shoulder is on its line")
{
    // A straight arm of length 2 that aims along its forearm: from 2 on there is something to aim at.
    Crowd crowd = crowd_of(SWIVEL_WITH_AIM, 4);
    const Float3 targets[] = {{0, 0, 1.5f}, {0, 0, 2}, {3, 0, 0}, {0, 0, 0}};
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    std::vector<double> residuals(4);
    crowd.residuals(0, residuals);
    CHECK(flags[0] == SWIVEL_CLAMPED_NEAR);
    CHECK(residuals[0] == Approx(0.25));
    CHECK(flags[1] == SWIVEL_REACHED);
    CHECK(residuals[1] <= 1e-7);
    CHECK(flags[2] == SWIVEL_REACHED);
    CHECK(residuals[2] <= 1e-6);
    CHECK(flags[3] == (SWIVEL_CLAMPED_NEAR | SWIVEL_SWIVEL_UNDEFINED));

    // A ray that leads back past the shoulder, 1.6 from it at best.
    const std::array<float, 5> back = {0.8f, 0, -0.6f, 1, 0};
    crowd.write_all(SWIVEL_AIM, 0, back);
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 0, 0.5f});
    crowd.solve();
    const Quaterniond turn = quat(read<Float4>(crowd, SWIVEL_SHOULDER)[0]).normalized();
    const Vector3d nearest = turn * (Vector3d(0, 0, 2) + 1.2 * Vector3d(0.8, 0, -0.6));
    CHECK((nearest.normalized() - Vector3d::UnitZ()).norm() <= 1e-6);
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS)[0] == SWIVEL_CLAMPED_NEAR);
}

TEST_CASE("a straight arm that aims along itself bends its elbow the way the pole says once it bends")
{
    Crowd crowd = crowd_of(SWIVEL_WITH_AIM, 2);
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 0, 5});
    crowd.write_all(SWIVEL_POLE, 0, Float3{1, 0, 0});
    const Aim aims[] = {{Vector3d::UnitZ(), {}, 0}, {Vector3d::UnitZ(), {}, 0.01}};
    const std::array<float, 5> values[] = {value_of(aims[0]), value_of(aims[1])};
    crowd.write(SWIVEL_AIM, 0, values);
    crowd.solve();
    const auto shoulders = read<Float4>(crowd, SWIVEL_SHOULDER);
    CHECK(distance(quat(shoulders[0]), quat(shoulders[1])) <= 0.01);
}

TEST_CASE("limits of the shoulder and regions hold for aims")
{
    constexpr std::uint32_t count = 200;
    Random random{4};
    int kept = 0;
    for (int n = 0; n < 5; ++n) {
        LimitedArms arms(random, count, true);
        arms.features = SWIVEL_WITH_HAND | SWIVEL_WITH_AIM | kUpperArmLimits | SWIVEL_WITH_REGION;
        for (LimitedArm& each : arms.arms) each.arm.wrist = rounded(random.between(2, 8) * each.arm.wrist.normalized());
        Crowd crowd = arms.crowd();
        for (std::uint32_t arm = 0; arm < count; ++arm) put(crowd, SWIVEL_AIM, arm, value_of(random_aim(random)));
        crowd.solve();
        for (std::uint32_t arm = 0; arm < count; ++arm) {
            const LimbPose pose = pose_of(crowd, arm);
            CHECK(crowd.allowed_arcs(0, arm).empty() == ((pose.flags & SWIVEL_INFEASIBLE) != 0));
            if (pose.flags & SWIVEL_INFEASIBLE) continue;
            CHECK(arms.room(arm, pose) >= -1e-6);
            kept += (pose.flags & (SWIVEL_LIMITED_SHOULDER_CONE | SWIVEL_LIMITED_REGION)) != 0;
        }
    }
    CHECK(kept > 50);
}

namespace {

constexpr swivel_features kFeatures = kWorldJointsHand | SWIVEL_WITH_CLAVICLE;

// tan(turn / 2) = share sin theta / (2 (1 - share) + share (1 + cos theta)), about the bone's way to the target.
Quaterniond turn_of(const Vector3d& bone, const Vector3d& target, double share)
{
    const Vector3d axis = bone.cross(target);
    const double theta = std::atan2(axis.norm(), bone.dot(target));
    const double turn = 2 * std::atan2(share * std::sin(theta), 2 * (1 - share) + share * (1 + std::cos(theta)));
    return Quaterniond(Eigen::AngleAxisd(turn, axis.normalized()));
}

struct Shoulder {
    Limb limb;
    Vector3d bone;  // from the clavicle's joint to the shoulder's, in the clavicle's frame
    float share;
};
// Shares of none and of all among them, and targets up to half a degree from behind the bone.
Shoulder random_shoulder(Random& random, const BoundLimb& limb)
{
    Shoulder made{random_limb(random, kFeatures, {limb.bound.lengths[0], limb.bound.lengths[1]}),
                  vec(floats(Vector3d(random.spread(0.1, 0.5) * random.direction()))), 0};
    if (const std::uint32_t kind = random.below(8); kind > 0)
        made.share = kind == 1 ? 1 : static_cast<float>(random.between(0, 0.9));
    if (random.below(6)) return made;
    const Parent parent = made.limb.parent();
    const Vector3d behind =
        -random.between(1, 3) *
        (Eigen::AngleAxisd(random.spread(0.5 * degrees(1), 0.3), random.across(made.bone)) * made.bone);
    made.limb.target = floats(Vector3d(parent.position + parent.scale * (parent.rotation * (behind - made.bone))));
    return made;
}
void write_shoulder(Crowd& crowd, std::uint32_t n, const Shoulder& shoulder)
{
    write_limb(crowd, 0, n, shoulder.limb);
    const Float3 bone = floats(shoulder.bone);
    put(crowd, SWIVEL_CLAVICLE, n, Float4{bone[0], bone[1], bone[2], shoulder.share});
}

}  // namespace

TEST_CASE("the clavicle takes its share, and the arm reaches from where it then is")
{
    constexpr std::uint32_t count = 300;
    Random random{1};
    const BoundLimb limb = bound_limb(random);
    Crowd crowd = crowd_of(kFeatures, count, limb.bound);
    Crowd kept = crowd_of(kFeatures | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS, count, limb.bound);
    std::vector<Shoulder> shoulders;
    for (std::uint32_t n = 0; n < count; ++n) {
        shoulders.push_back(random_shoulder(random, limb));
        for (Crowd* const each : {&crowd, &kept}) write_shoulder(*each, n, shoulders[n]);
    }
    kept.write_all(SWIVEL_WEIGHTS, 0, Float3{0, 1, 1});  // of the position: nothing turns
    crowd.solve(), kept.solve();
    for (const Float4& turn : read<Float4>(kept, SWIVEL_CLAVICLE_ROTATION))
        CHECK(distance(quat(turn), Quaterniond::Identity()) <= 1e-6);
    const auto turns = read<Float4>(crowd, SWIVEL_CLAVICLE_ROTATION);
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    std::vector<std::array<double, 3>> wrists(count);
    std::vector<double> residuals(count);
    crowd.wrists(0, wrists);
    crowd.residuals(0, residuals);
    int reached = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        INFO("limb " << n << ", flags " << flags[n]);
        const auto& [each, bone, share] = shoulders[n];
        const Parent parent = each.parent();
        // In the clavicle's frame, before it turns.
        const Vector3d target =
            parent.rotation.conjugate() * (vec(each.target) - parent.position) / parent.scale + bone;
        CHECK(is_unit(turns[n]));
        const Quaterniond turn = quat(turns[n]).normalized();
        const bool is_behind = angle_between(bone, target) > kPi - 0.1;  // there the turn's axis is known to 1e-5
        CHECK(distance(turn, turn_of(bone, target, double{share})) <= (is_behind ? 1.5e-5 : 2e-6));

        const LocalPose pose = local_pose(crowd, n);
        const Parent turned{parent.position + parent.scale * (parent.rotation * (turn * bone - bone)),
                            parent.rotation * turn, parent.scale};
        const double length = parent.scale * (limb.bound.lengths[0] + limb.bound.lengths[1]);
        const Vector3d wrist = pose.wrist_place(limb.rest, turned);
        CHECK((wrist - Vector3d(wrists[n].data())).norm() <= 1e-5 * (length + parent.position.norm()));
        CHECK(distance(pose.hand(turned), quat(each.hand).normalized()) <= 2e-6);
        CHECK(residuals[n] == Approx((wrist - vec(each.target)).norm() / length).margin(1e-5));
        if (!(flags[n] & SWIVEL_REACHED)) continue;
        ++reached;
        CHECK(residuals[n] <= 3e-6);
    }
    CHECK(reached > 200);
}

TEST_CASE("a bone under 1e-15 has no direction; shares just under 1 turn smoothly past behind")
{
    Crowd tiny = crowd_of(SWIVEL_WORLD | SWIVEL_WITH_CLAVICLE, 3);
    tiny.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
    tiny.write_all(SWIVEL_TARGET, 0, Float3{0.6f, 0.5f, 0.9f});
    const Float4 bones[] = {{1e-36f, 0, 0, 0.5f}, {3e-37f, 0, 0, 0.5f}, {1e-26f, 0, 0, 0.5f}};
    tiny.write(SWIVEL_CLAVICLE, 0, bones);
    tiny.solve();
    std::vector<double> residuals(3);
    tiny.residuals(0, residuals);
    for (const double residual : residuals) CHECK(residual <= kWristError);
    for (const Float4& turn : read<Float4>(tiny, SWIVEL_CLAVICLE_ROTATION))
        CHECK(distance(quat(turn), Quaterniond::Identity()) <= 1e-6);

    constexpr std::uint32_t count = 4001;
    Crowd crowd = crowd_of(SWIVEL_WORLD | SWIVEL_WITH_CLAVICLE, count);
    std::vector<Float3> targets;
    for (std::uint32_t n = 0; n < count; ++n)
        targets.push_back(floats(Vector3d(-1, 0, 0.01 * (static_cast<double>(n) - 2000) / 2000)));
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0.25f, 0, 0});
    crowd.write_all(SWIVEL_CLAVICLE, 0, Float4{0.25f, 0, 0, 0.9999f});
    crowd.solve();
    const auto turns = read<Float4>(crowd, SWIVEL_CLAVICLE_ROTATION);
    for (std::uint32_t n = 1; n < count; ++n) CHECK(distance(quat(turns[n - 1]), quat(turns[n])) <= 0.1);
}
