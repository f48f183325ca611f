// SPDX-License-Identifier: MIT
//
// The promise: where the step wins, no elbow turns further in a frame than its step, whatever limits, target and pole
// do; and it is where its limits allow within half a second. Eigen judges, from the results.
#include <catch2/catch.hpp>

#include "tests/region_arms.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kCharacters = 500;
constexpr int kFrames = 300, kHalfSecond = 30;  // at 60 a second
constexpr double kStep = 0.15;                  // radians a frame

struct Kind {
    const char* name;
    swivel_features feature;
    bool LimitUse::*use = nullptr;
};
constexpr Kind kKinds[] = {{"shoulder cone", SWIVEL_WITH_SHOULDER_CONE, &LimitUse::shoulder_cone},
                           {"humeral twist", SWIVEL_WITH_HUMERAL_TWIST, &LimitUse::humeral_twist},
                           {"shoulder box", SWIVEL_WITH_SHOULDER_BOX, &LimitUse::shoulder_box},
                           {"hand cone", SWIVEL_WITH_HAND_CONE, &LimitUse::hand_cone},
                           {"forearm twist", SWIVEL_WITH_FOREARM_TWIST, &LimitUse::forearm_twist},
                           {"hand twist", SWIVEL_WITH_HAND_TWIST, &LimitUse::hand_twist},
                           {"wrist box", SWIVEL_WITH_WRIST_BOX, &LimitUse::wrist_box},
                           {"region", SWIVEL_WITH_REGION}};

// Arms with one kind of limit, whose wrists, poles and hands go round smoothly.
struct Walk {
    RegionArms arms;
    std::vector<LimitedArm> start;
    std::vector<Vector3d> axis;

    Walk(Random& random, const Kind& kind) : arms(random, kCharacters)
    {
        arms.features = SWIVEL_WITH_HAND | kind.feature;
        for (LimitedArm& arm : arms.arms) {
            arm.use = {};
            arm.use.shoulder_order = kEulerOrders[arms.orders[0]], arm.use.wrist_order = kEulerOrders[arms.orders[1]];
            if (kind.use) arm.use.*kind.use = true;
            axis.push_back(random.direction());
        }
        start = arms.arms;
    }
    void go_to(int frame)
    {
        for (std::size_t n = 0; n < start.size(); ++n) {
            const double time = frame / 60.0;
            const auto turn = [&](double speed) { return Quaterniond(Eigen::AngleAxisd(speed * time, axis[n])); };
            Arm& arm = arms.arms[n].arm;
            arm.wrist = rounded(turn(0.7) * start[n].arm.wrist);
            arm.pole = rounded(turn(-0.5) * start[n].arm.pole);
            arms.arms[n].hand = turn(0.6) * start[n].hand;
            arms.arms[n].hand.coeffs() = arms.arms[n].hand.coeffs().cast<float>().cast<double>();
            arms.arms[n].hand.normalize();
        }
    }
    bool is_within(std::uint32_t n, const ArmAt& pose) const
    {
        return arms.features & SWIVEL_WITH_REGION ? arms.region_room(pose) >= -1e-6
                                                  : violation(arms.arms[n], pose) <= 5e-6;
    }
};

struct Seen {
    double largest = 0;  // turn of a frame
    int longest = 0;     // frames outside, while some place is allowed
    int outside = 0, jumped = 0, unflagged = 0;

    Seen(Random random, const Kind& kind, swivel_features more)
    {
        Walk walk(random, kind);
        Crowd crowd = walk.arms.crowd(SWIVEL_WITH_MOST_SWIVEL | more);
        crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(kStep));
        std::vector<Vector3d> before(kCharacters);
        std::vector<int> lasts(kCharacters);
        for (int frame = 0; frame < kFrames; ++frame) {
            walk.go_to(frame);
            for (std::uint32_t n = 0; n < kCharacters; ++n) walk.arms.write(crowd, n);
            crowd.solve();
            for (std::uint32_t n = 0; n < kCharacters; ++n) {
                const SolvedLimb<float> limb = solved_limb(crowd, n);
                const ArmAt pose = pose_of(limb);
                const Vector3d now = pose.shoulder * Vector3d::UnitX(), line = walk.arms.arms[n].arm.wrist.normalized();
                const Vector3d carried = before[n] - before[n].dot(line) * line;
                if (frame > 0) largest = std::max(largest, std::atan2(carried.cross(now).norm(), carried.dot(now)));
                before[n] = now;
                const bool is_out = !(limb.arm.flags & SWIVEL_INFEASIBLE) && !walk.is_within(n, pose);
                lasts[n] = is_out ? lasts[n] + 1 : 0;
                longest = std::max(longest, lasts[n]);
                outside += is_out;
                unflagged += is_out && !(limb.arm.flags & SWIVEL_LIMITED_STEP);
                jumped += (limb.arm.flags & SWIVEL_JUMPED) != 0;
            }
        }
    }
};

TEST_CASE("where the step wins no elbow pops, whatever the limit, and each is within its limits within half a second")
{
    Random random{41};
    for (const Kind& kind : kKinds) {
        const Seen popping(random, kind, 0), seen(random, kind, SWIVEL_STEP_WINS);
        INFO(kind.name << ": " << seen.largest << " rad a frame, without " << popping.largest << "; outside for "
                       << seen.longest << " frames, " << seen.outside << " in all; without, jumped " << popping.jumped);
        CHECK(seen.largest <= kStep + 1e-5);
        CHECK(seen.longest <= kHalfSecond);
        CHECK(seen.unflagged == 0);
        CHECK(seen.jumped == 0);
        CHECK(seen.outside > 0);
        CHECK(popping.largest > kStep + 0.05);
        CHECK(popping.jumped > 0);
    }
}

TEST_CASE("where the step wins an elbow ends where it would be without a step")
{
    Random random{42};
    const RegionArms before(random, kCharacters);
    RegionArms arms = before;
    for (LimitedArm& arm : arms.arms) arm.arm.wrist = rounded(arm.arm.wrist.norm() * random.direction());
    Crowd crowd = before.crowd(SWIVEL_WITH_MOST_SWIVEL | SWIVEL_STEP_WINS), free = arms.crowd();
    crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(kStep));
    crowd.solve(), free.solve();
    for (std::uint32_t n = 0; n < kCharacters; ++n) arms.write(crowd, n);
    crowd.solve();
    int on_their_way = 0, limited = 0;
    for (std::uint32_t n = 0; n < kCharacters; ++n)
        on_their_way += (solved_limb(crowd, n).arm.flags & SWIVEL_LIMITED_STEP) != 0;
    for (int frame = 0; frame < kHalfSecond; ++frame) crowd.solve();
    for (std::uint32_t n = 0; n < kCharacters; ++n) {
        const SolvedLimb<float> limb = solved_limb(crowd, n), wanted = solved_limb(free, n);
        CHECK(limb.arm.flags == wanted.arm.flags);
        CHECK(distance(eigen(limb.arm.shoulder), eigen(wanted.arm.shoulder)) < 1e-5);
        limited += (limb.arm.flags & SWIVEL_LIMITED_REGION) != 0;
    }
    CHECK(on_their_way > 100);
    CHECK(limited > 100);
}

// An arm whose elbow goes 0.1 a frame, from where it is wished towards where a cone allows it.
struct Explained {
    static constexpr double kMost = 1.0;  // of the cone
    Crowd crowd{group(1, SWIVEL_WITH_MOST_SWIVEL | SWIVEL_STEP_WINS | SWIVEL_WITH_SHOULDER_CONE)};

    Explained()
    {
        crowd.write_all(SWIVEL_LENGTHS, 0, std::array{0.3f, 0.3f});
        crowd.write_all(SWIVEL_TARGET, 0, std::array{0.0f, 0.0f, 0.4f});
        crowd.write_all(SWIVEL_POLE, 0, std::array{1.0f, 0.0f, 0.0f});
        crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(0.1));
        crowd.solve();
    }
    void limit(const std::array<double, 3>& axis, double most)
    {
        crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone(axis, most));
        crowd.solve();
    }
    void check(const std::string& words, double degrees = -1, const std::string& after = "")
    {
        const std::string text = crowd.explain(0, 0);
        INFO(text);
        const std::size_t at = text.find(words);
        REQUIRE(at != std::string::npos);
        if (degrees < 0) return;
        const std::size_t number = text.find(after, at);
        REQUIRE(number != std::string::npos);
        CHECK(std::stod(text.substr(number + after.size())) == Approx(degrees).margin(0.06));
    }
    // Of the upper arm from the axis -x.
    double to_side() const
    {
        std::array<std::array<double, 3>, 1> elbow;
        crowd.elbows(0, elbow);
        return std::acos(-elbow[0][0] / 0.3);
    }
};
double in_degrees(double angle) { return angle * 180 / kPi; }

TEST_CASE("explain says that an elbow is on its way, and how far outside it is; then how far its wish was")
{
    Explained arm;
    arm.limit({-1, 0, 0}, Explained::kMost);
    arm.check("breaks shoulder_cone: it is on its way to the nearest place that keeps all limits.",
              in_degrees(arm.to_side() - Explained::kMost), "Its pose violates shoulder_cone by ");
    arm.check("The next solve goes one step further.");
    for (int frame = 0; frame < 40; ++frame) arm.crowd.solve();
    // The upper arm is asin(sqrt(5) / 3) from the line, about which the elbow turns.
    const double turned = std::acos(-std::cos(Explained::kMost) / (std::sqrt(5.0) / 3));
    arm.check("Where the elbow was wished it breaks shoulder_cone", in_degrees(turned), "keeps all limits is ");
    CHECK(arm.crowd.explain(0, 0).find("on its way") == std::string::npos);
}

TEST_CASE("explain says that an elbow is on its way to where it violates its limits least")
{
    Explained arm;
    arm.limit({-1, 0, 0}, 0.2);
    arm.check("No place of the elbow keeps shoulder_cone: it is on its way to the one that violates them least.",
              in_degrees(arm.to_side() - 0.2), "Its pose violates shoulder_cone by ");
    for (int frame = 0; frame < 40; ++frame) arm.crowd.solve();
    arm.check("No place of the elbow keeps shoulder_cone: the one that violates them least is taken.",
              in_degrees(arm.to_side() - 0.2), "Its pose violates shoulder_cone by ");
}

TEST_CASE("explain says that an elbow is on its way to its wish, where its limits allow that")
{
    Explained arm;
    arm.limit({0, 0, 1}, 2);
    arm.crowd.write_all(SWIVEL_POLE, 0, std::array{-1.0f, 0.1f, 0.0f});
    arm.crowd.solve();
    arm.check("The elbow is on its way to where it is wished.");
    arm.check("The next solve goes one step further.");
    const std::string text = arm.crowd.explain(0, 0);
    INFO(text);
    CHECK(text.ends_with(" The elbow is on its way to where it is wished. The next solve goes one step further."));
}

}  // namespace
