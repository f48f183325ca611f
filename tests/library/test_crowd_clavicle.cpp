// SPDX-License-Identifier: MIT
//
// The promise: the clavicle turns towards the target by its share, as a curve in Eigen says. The arm hangs from the
// turned clavicle, in the skeleton's own forward kinematics. A share of 0, or a position weight of 0, changes nothing.
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

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
Shoulder random_shoulder(Random& random, const Chained& limb)
{
    return {random_limb(random, kFeatures, {limb.bound.lengths[0], limb.bound.lengths[1]}),
            vec(floats(Vector3d(random.spread(0.1, 0.5) * random.direction()))),
            static_cast<float>(random.between(0, 0.9))};
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
    const Chained limb = chained(random);
    Crowd crowd = crowd_of(kFeatures, count, limb.bound);
    std::vector<Shoulder> shoulders;
    for (std::uint32_t n = 0; n < count; ++n) {
        shoulders.push_back(random_shoulder(random, limb));
        write_shoulder(crowd, n, shoulders[n]);
    }
    crowd.solve();
    const auto turns = read<Float4>(crowd, SWIVEL_CLAVICLE_TURN);
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
        CHECK(distance(turn, turn_of(bone, target, share)) <= 2e-6);

        const LocalPose pose = local_pose(crowd, n);
        const Parent turned{parent.position + parent.scale * (parent.rotation * (turn * bone - bone)),
                            parent.rotation * turn, parent.scale};
        const double length = parent.scale * (limb.bound.lengths[0] + limb.bound.lengths[1]);
        const Vector3d wrist = pose.wrist_place(limb.chain, turned);
        CHECK((wrist - Vector3d(wrists[n].data())).norm() <= 1e-5 * (length + parent.position.norm()));
        CHECK(distance(pose.hand(turned), quat(each.hand).normalized()) <= 2e-6);
        CHECK(residuals[n] == Approx((wrist - vec(each.target)).norm() / length).margin(1e-5));
        if (!(flags[n] & SWIVEL_REACHED)) continue;
        ++reached;
        CHECK(residuals[n] <= 3e-6);
    }
    CHECK(reached > 200);
}

TEST_CASE("no share turns nothing; nor does a position weight of 0")
{
    constexpr std::uint32_t count = 50;
    Random random{2};
    const Chained limb = chained(random);
    Crowd plain = crowd_of(kWorldJointsHand | SWIVEL_WITH_ANGLE, count, limb.bound),
          none = crowd_of(kFeatures, count, limb.bound),
          kept = crowd_of(kFeatures | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS, count, limb.bound);
    for (std::uint32_t n = 0; n < count; ++n) {
        Shoulder shoulder = random_shoulder(random, limb);
        write_shoulder(kept, n, shoulder);
        shoulder.share = 0;
        write_shoulder(none, n, shoulder);
        write_limb(plain, 0, n, shoulder.limb);
    }
    kept.write_all(SWIVEL_WEIGHTS, 0, Float3{0, 1, 1});
    for (Crowd* crowd : {&plain, &none, &kept}) crowd->solve();
    for (const Crowd* crowd : {&none, &kept})
        for (const Float4& turn : read<Float4>(*crowd, SWIVEL_CLAVICLE_TURN))
            CHECK(distance(quat(turn), Quaterniond::Identity()) <= 1e-6);
    const auto want = read<Float4>(plain, SWIVEL_SHOULDER), got = read<Float4>(none, SWIVEL_SHOULDER);
    for (std::uint32_t n = 0; n < count; ++n) CHECK(distance(quat(got[n]), quat(want[n])) <= 4e-6);
}

TEST_CASE("the turn is the curve's all around, whatever the share, up to nearly behind")
{
    constexpr std::uint32_t count = 720;
    for (const float share : {0.1f, 0.5f, 0.9f, 1.0f}) {
        Crowd crowd = crowd_of(SWIVEL_WORLD | SWIVEL_WITH_CLAVICLE, count);
        std::vector<Float3> targets;
        for (std::uint32_t n = 0; n < count; ++n) {  // about the clavicle's joint, which is at the origin
            const double angle = 2 * kPi * n / count;
            targets.push_back(floats(Vector3d(std::cos(angle), 0.0, std::sin(angle))));
        }
        crowd.write(SWIVEL_TARGET, 0, targets);
        crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0.25f, 0, 0});
        crowd.write_all(SWIVEL_CLAVICLE, 0, Float4{0.25f, 0, 0, share});
        crowd.write_all(SWIVEL_POLE, 0, Float3{0, -5, 0});
        crowd.solve();
        const auto turns = read<Float4>(crowd, SWIVEL_CLAVICLE_TURN);
        for (std::uint32_t n = 0; n < count; ++n) {
            INFO("share " << share << ", target " << n);
            // Half a degree from behind the turn's axis is known to 1e-5.
            const bool is_on_line = n == 0 || n == count / 2;
            if (!is_on_line)
                CHECK(distance(quat(turns[n]), turn_of(Vector3d::UnitX(), vec(targets[n]), double{share})) <= 1.5e-5);
            else if (n == 0 || share < 1)
                CHECK(distance(quat(turns[n]), Quaterniond::Identity()) <= 1e-5);
        }
    }
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
    for (const Float4& turn : read<Float4>(tiny, SWIVEL_CLAVICLE_TURN))
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
    const auto turns = read<Float4>(crowd, SWIVEL_CLAVICLE_TURN);
    for (std::uint32_t n = 1; n < count; ++n) CHECK(distance(quat(turns[n - 1]), quat(turns[n])) <= 0.1);
}
