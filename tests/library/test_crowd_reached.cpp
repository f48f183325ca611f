// SPDX-License-Identifier: MIT
//
// The promise of SWIVEL_REACHED: the wrist of a plain arm is within 1e-6 arm lengths of its target. With features,
// wrist or effector is within 3e-6 of the target or the blended target. Limbs at random, as here, stay within 1e-6:
// only a search finds worse ones (docs/mathematics.md). By the skeleton's own forward kinematics, in Eigen.
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr swivel_features kBlends = SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS;

// What a limb of a skeleton has beside the goal.
struct More {
    Float3 effector = {0, 0, 0}, weights = {1, 1, 1};
    Float4 clavicle = {0, 0, 0, 0};
    Float4 shoulder = {0, 0, 0, 1}, elbow = {0, 0, 0, 1}, wrist = {0, 0, 0, 1};  // incoming
};
More random_more(Random& random, double length)
{
    const auto place = [&] { return floats(Vector3d(length * random.vector(0, 0.5))); };
    More more;
    more.effector = place();
    const Float3 bone = place();
    more.clavicle = {bone[0], bone[1], bone[2], static_cast<float>(random.unit())};
    more.weights = {random.below(2) ? 1 : static_cast<float>(random.unit()), static_cast<float>(random.unit()),
                    static_cast<float>(random.unit())};
    more.shoulder = floats(random.rotation()), more.elbow = floats(random.rotation());
    more.wrist = floats(random.rotation());
    return more;
}
void write_more(Crowd& crowd, std::uint32_t n, const More& more)
{
    const auto put_there = [&](swivel_field field, const auto& value) {
        if (swivel_field_row_count(crowd.get(), 0, field)) put(crowd, field, n, value);
    };
    put_there(SWIVEL_EFFECTOR, more.effector);
    put_there(SWIVEL_WEIGHTS, more.weights);
    put_there(SWIVEL_CLAVICLE, more.clavicle);
    put_there(SWIVEL_INCOMING_SHOULDER, more.shoulder);
    put_there(SWIVEL_INCOMING_ELBOW, more.elbow);
    put_there(SWIVEL_INCOMING_WRIST, more.wrist);
}

// How far the limb is from its target, or from its blended target, in arm lengths.
double off_target(const Crowd& crowd, std::uint32_t n, const Chained& limb, const Limb& goal, const More& more,
                  swivel_features features)
{
    Parent parent = goal.parent();
    if (features & SWIVEL_WITH_CLAVICLE) {
        Float4 turned;
        crowd.read(SWIVEL_CLAVICLE_TURN, 0, std::span(&turned, 1), n);
        const Quaterniond turn = quat(turned).normalized();
        const Vector3d bone(more.clavicle[0], more.clavicle[1], more.clavicle[2]);
        parent.position += parent.scale * (parent.rotation * (turn * bone - bone));
        parent.rotation = parent.rotation * turn;
    }
    const LocalPose pose = local_pose(crowd, n);
    Vector3d wanted = vec(goal.target);
    if (features & SWIVEL_WITH_EFFECTOR) wanted -= parent.scale * (pose.hand(parent) * vec(more.effector));
    if (features & SWIVEL_WITH_WEIGHTS) {
        const LocalPose was{quat(more.shoulder).normalized(), quat(more.elbow).normalized(), {}};
        const double weight = more.weights[0];
        wanted = (1 - weight) * was.wrist_place(limb.chain, parent) + weight * wanted;
    }
    const double length = parent.scale * (double{limb.bound.lengths[0]} + limb.bound.lengths[1]);
    return (pose.wrist_place(limb.chain, parent) - wanted).norm() / length;
}

}  // namespace

TEST_CASE("with SWIVEL_REACHED, a plain arm's wrist is within 1e-6 of its target, for bones up to 1000 to 1")
{
    Random random{1};
    std::vector<Arm> arms;
    for (int n = 0; n < 100'000; ++n) {
        const double upper = random.spread(0.03, 30), fore = upper * random.spread(1e-3, 1e3);
        const Float2 lengths = {static_cast<float>(upper), static_cast<float>(fore)};
        const double near = std::fabs(double{lengths[0]} - lengths[1]), far = double{lengths[0]} + lengths[1];
        const Vector3d line = random.direction(), pole = random.between(-1, 1) * line + random.across(line);
        arms.push_back({floats(Vector3d((near + (far - near) * random.unit()) * line)), floats(pole), lengths});
    }
    const std::vector<Pose> poses = solve(arms);
    double worst = 0;
    std::size_t reached = 0;
    for (std::size_t n = 0; n < arms.size(); ++n) {
        if (!(poses[n].flags & SWIVEL_REACHED)) continue;  // an end of the reach, rounded
        worst = std::max(worst, (poses[n].wrist_point(arms[n]) - vec(arms[n].target)).norm() / arms[n].length());
        ++reached;
    }
    CHECK(worst <= 1e-6);
    CHECK(reached > 99'000);
}

TEST_CASE("with SWIVEL_REACHED and features, the random limbs of skeletons are within 1e-6 of where they should be")
{
    Random random{2};
    for (const swivel_features features :
         {kWorldJointsHand, kWorldJointsHand | SWIVEL_WITH_EFFECTOR, kWorldJointsHand | kBlends,
          kWorldJointsHand | SWIVEL_WITH_CLAVICLE, kWorldJointsHand | SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_EFFECTOR,
          kWorldJointsHand | SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_EFFECTOR | kBlends | 3 * SWIVEL_WITH_TWIST_BONES}) {
        INFO("features " << features);
        double worst = 0;
        int reached = 0;
        for (int skeletons = 0; skeletons < 10; ++skeletons) {
            constexpr std::uint32_t count = 1000;
            const Chained limb = chained(random);
            Crowd crowd = crowd_of(features, count, limb.bound);
            std::vector<Limb> limbs;
            std::vector<More> more;
            for (std::uint32_t n = 0; n < count; ++n) {
                limbs.push_back(random_limb(random, features, {limb.bound.lengths[0], limb.bound.lengths[1]}));
                more.push_back(random_more(random, double{limb.bound.lengths[0]} + limb.bound.lengths[1]));
                write_limb(crowd, 0, n, limbs[n]);
                write_more(crowd, n, more[n]);
            }
            crowd.solve();
            const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
            for (std::uint32_t n = 0; n < count; ++n) {
                if (!(flags[n] & SWIVEL_REACHED)) continue;
                worst = std::max(worst, off_target(crowd, n, limb, limbs[n], more[n], features));
                ++reached;
            }
        }
        CHECK(worst <= 1e-6);
        CHECK(reached > 3000);
    }
}
