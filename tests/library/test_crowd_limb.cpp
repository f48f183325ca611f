// SPDX-License-Identifier: MIT
//
// The promise: swivel.h's words about the whole limb hold in crowds, through skeletons and worlds. Inputs with neutral
// values change nothing. Stretch, flexion and joint angles mean what swivel.h says. Goals of limbs in their own frame
// are in test_limb_goals.cpp, and steps of the swivel in test_swivel_steps.cpp.
//
// SWIVEL_REACHED says that the wrist of a plain arm is within 1e-6 arm lengths of its target (test_plain_arms.cpp).
// With features, wrist or effector is within 3e-6 of the target or the blended target. Limbs at random, as here, stay
// within 1e-6: only a search finds worse ones (docs/mathematics.md). The judge is the skeleton's own forward
// kinematics, in Eigen.
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

TEST_CASE("whole limbs at rest are the plain arms")
{
    constexpr std::uint32_t count = 200;
    const swivel_features at_rest =
        all_beside(SWIVEL_WITH_HAND, SWIVEL_WORLD | SWIVEL_JOINTS | kPoleFeatures | SWIVEL_WITH_INCOMING |
                                         SWIVEL_HAND_YIELDS | SWIVEL_WITH_REGION);
    for (const swivel_features features :
         {swivel_features{0}, kWorldJointsHand & ~SWIVEL_WORLD, kWorldJointsHand,
          kWorldJointsHand | SWIVEL_POLE_DIRECTION, swivel_features{SWIVEL_WORLD | SWIVEL_WITH_HAND}})
        for (const swivel_features more : {SWIVEL_WITH_ANGLE, features & SWIVEL_WITH_HAND ? at_rest : 0u}) {
            Random random{features + more};
            const BoundLimb limb = bound_limb(random);
            Crowd plain = crowd_of(features, count, limb.bound), whole = crowd_of(features | more, count, limb.bound);
            for (std::uint32_t n = 0; n < count; ++n) {
                const Limb each = random_limb(random, features, {limb.bound.lengths[0], limb.bound.lengths[1]});
                write_limb(plain, 0, n, each);
                write_limb(whole, 0, n, each);
            }
            plain.solve();
            whole.solve();
            const auto flags = read<std::uint32_t>(whole, SWIVEL_FLAGS);
            for (const swivel_field field : {SWIVEL_SHOULDER, SWIVEL_WRIST}) {
                if (!swivel_field_row_count(plain.get(), 0, field)) continue;
                const auto want = read<Float4>(plain, field), got = read<Float4>(whole, field);
                for (std::uint32_t n = 0; n < count; ++n) {
                    INFO("features " << features << ", more " << more << ", limb " << n << ", field " << field);
                    CHECK(distance(quat(got[n]), quat(want[n])) <= 4e-6);
                    CHECK(is_in_hemisphere(got[n]));
                    CHECK(flags[n] == SWIVEL_REACHED);
                }
            }
            std::vector<double> residuals(count);
            whole.residuals(0, residuals);
            for (const double residual : residuals) CHECK(residual <= kWristError);
        }
}

TEST_CASE("stretched bones reach and give their stretch back; no wrist is nearer than the least distance")
{
    Crowd crowd = crowd_of(SWIVEL_WITH_REACH, 3);
    crowd.write_all(SWIVEL_REACH, 0, Float4{0.05f, 0, 1.5f, 0});
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, -1, 0});
    const Float3 targets[] = {{0, 0, 1.2f}, {0, 0, 2.5f}, {0, 0, 4}};
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.solve();
    const auto stretch = read<Float1>(crowd, SWIVEL_STRETCH);
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    std::vector<double> residuals(3);
    crowd.residuals(0, residuals);
    CHECK(stretch[0][0] == 1);
    CHECK(flags[0] == SWIVEL_REACHED);
    CHECK(stretch[1][0] == Approx(1.25));
    CHECK(flags[1] == (SWIVEL_REACHED | SWIVEL_STRETCHED));
    CHECK(residuals[1] <= 1e-6);
    CHECK(stretch[2][0] == 1.5f);
    CHECK(flags[2] == (SWIVEL_CLAMPED_FAR | SWIVEL_STRETCHED));
    CHECK(residuals[2] == Approx(1.0 / 3));  // 1 from the target, of two bones of length 1.5 each

    crowd.write_all(SWIVEL_REACH, 0, Float4{0, 0, 1, 0.5f});  // no nearer than half of the arm
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 0, 0.25f});
    crowd.solve();
    crowd.residuals(0, residuals);
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS)[0] == SWIVEL_CLAMPED_NEAR);
    CHECK(residuals[0] == Approx(0.375));
}

TEST_CASE("the elbow bends within its range, and says where that keeps the wrist from its target")
{
    constexpr std::uint32_t count = 300;
    Random random{11};
    const BoundLimb limb = bound_limb(random);
    const double upper = limb.bound.lengths[0], fore = limb.bound.lengths[1];
    Crowd crowd = crowd_of(kWorldJointsHand | SWIVEL_WITH_FLEXION_LIMIT, count, limb.bound);
    std::vector<double> wanted, min, max;
    for (std::uint32_t n = 0; n < count; ++n) {
        const Limb each = random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]});
        write_limb(crowd, 0, n, each);
        const Parent parent = each.parent();
        const double reach = (vec(each.target) - parent.position).norm() / parent.scale;
        wanted.push_back(std::acos((reach * reach - upper * upper - fore * fore) / (2 * upper * fore)));
        min.push_back(random.between(0, 2.5));
        max.push_back(random.between(min[n], kPi));
        Float2 range;
        CHECK(swivel_flexion(min[n], max[n], range.data()) == SWIVEL_OK);
        put(crowd, SWIVEL_FLEXION_LIMIT, n, range);
    }
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    int straight = 0, bent = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        const Vector3d a = vec(limb.rest.translations[1]),
                       b = local_pose(crowd, n).elbow * vec(limb.rest.translations[2]);
        const double flexion = std::atan2(a.cross(b).norm(), a.dot(b));
        INFO("limb " << n << ", wanted " << wanted[n] << " of " << min[n] << " to " << max[n]);
        CHECK(flexion == Approx(std::clamp(wanted[n], min[n], max[n])).margin(2e-5));
        straight += wanted[n]<min[n], bent += wanted[n]> max[n];
        if (wanted[n] < min[n] - 1e-4) CHECK(flags[n] == (SWIVEL_CLAMPED_FAR | SWIVEL_LIMITED_FLEXION));
        if (wanted[n] > max[n] + 1e-4) CHECK(flags[n] == (SWIVEL_CLAMPED_NEAR | SWIVEL_LIMITED_FLEXION));
    }
    CHECK(straight > 30);
    CHECK(bent > 30);
}

TEST_CASE("joint angles turn back into the rotations they are of, in every order and both families")
{
    constexpr std::uint32_t count = 60;
    Random random{7};
    const BoundLimb limb = bound_limb(random);
    Crowd crowd = crowd_of(kWorldJointsHand, count, limb.bound);
    for (std::uint32_t n = 0; n < count; ++n)
        write_limb(crowd, 0, n, random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]}));
    crowd.solve();
    const int axes[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
    for (int order = 0; order < 6; ++order)
        for (const int family : {0, 1}) {
            std::vector<std::array<double, 7>> angles(count);
            REQUIRE(swivel_joint_angles(crowd.get(), 0, 0, count, static_cast<swivel_euler_order>(order),
                                        static_cast<swivel_euler_order>(5 - order), family,
                                        {angles.data(), sizeof angles[0]}) == SWIVEL_OK);
            for (std::uint32_t n = 0; n < count; ++n) {
                const auto rotation = [&](int o, int first) {
                    Quaterniond q = Quaterniond::Identity();
                    for (int k = 0; k < 3; ++k)
                        q = q * Quaterniond(Eigen::AngleAxisd(angles[n][static_cast<std::size_t>(first + k)],
                                                              Vector3d::Unit(axes[o][k])));
                    return q;
                };
                const LocalPose turns = added_to_rest(local_pose(crowd, n), limb.bound);
                INFO("limb " << n << ", order " << order << ", family " << family);
                CHECK(distance(rotation(order, 0), turns.shoulder) <= 1e-6);
                CHECK(distance(rotation(5 - order, 4), turns.wrist) <= 1e-6);
                const Quaterniond elbow(Eigen::AngleAxisd(-angles[n][3], Vector3d::UnitX()));
                CHECK(distance(elbow, turns.elbow) <= 1e-6);
                CHECK((std::fabs(angles[n][1]) <= kPi / 2) == (family == 0));
            }
        }
}

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
    put(crowd, SWIVEL_EFFECTOR, n, more.effector);
    put(crowd, SWIVEL_WEIGHTS, n, more.weights);
    put(crowd, SWIVEL_CLAVICLE, n, more.clavicle);
    put(crowd, SWIVEL_INCOMING_SHOULDER, n, more.shoulder);
    put(crowd, SWIVEL_INCOMING_ELBOW, n, more.elbow);
    put(crowd, SWIVEL_INCOMING_WRIST, n, more.wrist);
}

// How far the limb is from its target, or from its blended target, in arm lengths.
double off_target(const Crowd& crowd, std::uint32_t n, const BoundLimb& limb, const Limb& goal, const More& more,
                  swivel_features features)
{
    Parent parent = goal.parent();
    if (features & SWIVEL_WITH_CLAVICLE) {
        Float4 turned;
        crowd.read(SWIVEL_CLAVICLE_ROTATION, 0, std::span(&turned, 1), n);
        const Quaterniond turn = quat(turned).normalized();
        const Vector3d bone(more.clavicle[0], more.clavicle[1], more.clavicle[2]);
        parent.position += parent.scale * (parent.rotation * (turn * bone - bone));
        parent.rotation = parent.rotation * turn;
    }
    const LocalPose pose = local_pose(crowd, n);
    Vector3d wanted = vec(goal.target);
    if (features & SWIVEL_WITH_EFFECTOR) wanted -= parent.scale * (pose.hand(parent) * vec(more.effector));
    if (features & SWIVEL_WITH_WEIGHTS) {
        const LocalPose incoming{quat(more.shoulder).normalized(), quat(more.elbow).normalized(), {}};
        const double weight = more.weights[0];
        wanted = (1 - weight) * incoming.wrist_place(limb.rest, parent) + weight * wanted;
    }
    const double length = parent.scale * (double{limb.bound.lengths[0]} + limb.bound.lengths[1]);
    return (pose.wrist_place(limb.rest, parent) - wanted).norm() / length;
}

}  // namespace

TEST_CASE("with SWIVEL_REACHED and features, the random limbs of skeletons are within 1e-6 of where they should be")
{
    Random random{2};
    constexpr swivel_features kAll = kWorldJointsHand | SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_EFFECTOR | kBlends;
    for (const swivel_features features : {kWorldJointsHand, kWorldJointsHand | SWIVEL_WITH_EFFECTOR,
                                           kWorldJointsHand | kBlends, kWorldJointsHand | SWIVEL_WITH_CLAVICLE,
                                           kWorldJointsHand | SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_EFFECTOR, kAll}) {
        INFO("features " << features);
        double worst = 0;
        int reached = 0;
        for (int skeletons = 0; skeletons < 10; ++skeletons) {
            constexpr std::uint32_t count = 1000;
            const BoundLimb limb = bound_limb(random);
            Crowd crowd = crowd_of(features, count, limb.bound, features == kAll ? 3 : 0);
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
