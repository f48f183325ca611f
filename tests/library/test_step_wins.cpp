// SPDX-License-Identifier: MIT
//
// The promise: where the step wins, no elbow turns further in a frame than its step, whatever limits, target and pole
// do; and it is where its limits allow within half a second. Eigen judges, from the results.
#include <catch2/catch.hpp>

#include "tests/limited_arms.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kCharacters = 500;
constexpr int kFrames = 300, kHalfSecond = 30;  // at 60 a second
constexpr double kStep = 0.15;                  // radians a frame

struct Kind {
    const char* name;
    swivel_features feature;
};
constexpr Kind kKinds[] = {{"shoulder cone", SWIVEL_WITH_SHOULDER_CONE}, {"humeral twist", SWIVEL_WITH_HUMERAL_TWIST},
                           {"shoulder box", SWIVEL_WITH_SHOULDER_BOX},   {"hand cone", SWIVEL_WITH_HAND_CONE},
                           {"forearm twist", SWIVEL_WITH_FOREARM_TWIST}, {"hand twist", SWIVEL_WITH_HAND_TWIST},
                           {"wrist box", SWIVEL_WITH_WRIST_BOX},         {"region", SWIVEL_WITH_REGION}};

// Arms with one kind of limit, whose wrists, poles and hands go round smoothly.
struct Walk {
    LimitedArms arms;
    std::vector<LimitedArm> start;
    std::vector<Vector3d> axis;

    Walk(Random& random, const Kind& kind) : arms(random, kCharacters, true)
    {
        arms.features = SWIVEL_WITH_HAND | kind.feature;
        for (std::uint32_t n = 0; n < kCharacters; ++n) axis.push_back(random.direction());
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
    bool is_within(std::uint32_t n, const LimbPose& pose) const { return arms.room(n, pose) >= -5e-6; }
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
                const LimbPose pose = pose_of(crowd, n);
                const Vector3d now = pose.hinge(), line = walk.arms.arms[n].arm.wrist.normalized();
                const Vector3d carried = before[n] - before[n].dot(line) * line;
                if (frame > 0) largest = std::max(largest, std::atan2(carried.cross(now).norm(), carried.dot(now)));
                before[n] = now;
                const bool is_out = !(pose.flags & SWIVEL_INFEASIBLE) && !walk.is_within(n, pose);
                lasts[n] = is_out ? lasts[n] + 1 : 0;
                longest = std::max(longest, lasts[n]);
                outside += is_out;
                unflagged += is_out && !(pose.flags & SWIVEL_LIMITED_STEP);
                jumped += (pose.flags & SWIVEL_JUMPED) != 0;
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
    const LimitedArms before(random, kCharacters, true);
    LimitedArms arms = before;
    for (LimitedArm& arm : arms.arms) arm.arm.wrist = rounded(arm.arm.wrist.norm() * random.direction());
    Crowd crowd = before.crowd(SWIVEL_WITH_MOST_SWIVEL | SWIVEL_STEP_WINS), free = arms.crowd();
    crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(kStep));
    crowd.solve(), free.solve();
    for (std::uint32_t n = 0; n < kCharacters; ++n) arms.write(crowd, n);
    crowd.solve();
    int on_their_way = 0, limited = 0;
    for (std::uint32_t n = 0; n < kCharacters; ++n)
        on_their_way += (pose_of(crowd, n).flags & SWIVEL_LIMITED_STEP) != 0;
    for (int frame = 0; frame < kHalfSecond; ++frame) crowd.solve();
    for (std::uint32_t n = 0; n < kCharacters; ++n) {
        const LimbPose limb = pose_of(crowd, n), wanted = pose_of(free, n);
        CHECK(limb.flags == wanted.flags);
        CHECK(distance(limb.shoulder, wanted.shoulder) < 1e-5);
        limited += (limb.flags & SWIVEL_LIMITED_REGION) != 0;
    }
    CHECK(on_their_way > 100);
    CHECK(limited > 100);
}

// An arm whose elbow goes 0.1 a frame, from where it is wished towards where a cone allows it.
struct Explained {
    FreeLimb limb{{{0, 0, 0.4}, {1, 0, 0}, 0.3, 0.3},
                  SWIVEL_WITH_MOST_SWIVEL | SWIVEL_STEP_WINS | SWIVEL_WITH_SHOULDER_CONE};
    LimbPose pose;

    Explained()
    {
        limb.write(SWIVEL_MOST_SWIVEL, turn(0.1));
        solve();
    }
    void solve(int times = 1)
    {
        for (int n = 0; n < times; ++n) pose = limb.solve();
    }
    // That explain says these words, and this angle after others.
    void check(const std::string& words, double angle = -1, const std::string& after = "") const
    {
        const std::string text = limb.crowd.explain(0, 0);
        INFO(text);
        const std::size_t at = text.find(words);
        REQUIRE(at != std::string::npos);
        if (angle < 0) return;
        const std::size_t number = text.find(after, at);
        REQUIRE(number != std::string::npos);
        CHECK(std::stod(text.substr(number + after.size())) == Approx(angle * 180 / kPi).margin(0.06));
    }
    // Of the upper arm from the axis -x.
    double to_side() const { return std::acos(-pose.elbow_place().normalized().x()); }
};

TEST_CASE("explain says that an elbow is on its way, and how far outside it is; then how far its wish was")
{
    const std::string violates = "Its pose violates shoulder_cone by ";
    Explained arm;
    arm.limb.write(SWIVEL_SHOULDER_CONE, cone({-1, 0, 0}, 1)), arm.solve();
    arm.check("breaks shoulder_cone: it is on its way to the nearest place that keeps all limits.", arm.to_side() - 1,
              violates);
    arm.check("The next solve goes one step further.");
    arm.solve(40);
    // The upper arm is asin(sqrt(5) / 3) from the line, about which the elbow turns.
    arm.check("Where the elbow was wished it breaks shoulder_cone", std::acos(-std::cos(1) / (std::sqrt(5.0) / 3)),
              "keeps all limits is ");
    CHECK(arm.limb.crowd.explain(0, 0).find("on its way") == std::string::npos);

    Explained none;  // no place keeps the cone
    none.limb.write(SWIVEL_SHOULDER_CONE, cone({-1, 0, 0}, 0.2)), none.solve();
    none.check("No place of the elbow keeps shoulder_cone: it is on its way to the one that violates them least.",
               none.to_side() - 0.2, violates);
    none.solve(40);
    none.check("No place of the elbow keeps shoulder_cone: the one that violates them least is taken.",
               none.to_side() - 0.2, violates);

    Explained free;  // the wish itself keeps it
    free.limb.write(SWIVEL_SHOULDER_CONE, cone({0, 0, 1}, 2)), free.solve();
    free.limb.write(SWIVEL_POLE, Float3{-1, 0.1f, 0}), free.solve();
    free.check("The elbow is on its way to where it is wished. The next solve goes one step further.");
}

}  // namespace
