// SPDX-License-Identifier: MIT
//
// The promise: swivel_explain() says of a foot what the ground does to it: how far it lifts and turns it, and why not.
// The animation and the plane confirm the numbers. Bad input gets its name and range.
#include "tests/gliding_leg.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr Float3 kToe{0, -0.07f, 0.13f}, kHeel{0, -0.07f, -0.05f};  // in the foot's frame
constexpr swivel_features kStands =
    GlidingLeg::kPlants | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_HAND_YIELDS | SWIVEL_WITH_GROUND;

swivel_ground sole()
{
    swivel_ground ground = swivel_default_ground();
    std::copy(kHeel.begin(), kHeel.end(), ground.heel);
    return ground;
}
double number_after(const std::string& text, const std::string& words)
{
    const std::size_t at = text.find(words);
    INFO(text << " lacks " << words);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + words.size()));
}
bool has(const std::string& text, const std::string& part)
{
    INFO(text);
    return text.find(part) != std::string::npos;
}
double in_degrees(double radians) { return radians * 180 / 3.14159265358979323846; }

// A leg over a plane, with its foot level.
struct StandingLeg {
    GlidingLeg leg;
    Quaterniond foot = Quaterniond::Identity();  // as animated

    explicit StandingLeg(swivel_features features = kStands, const swivel_ground& ground = sole())
        : leg(features, swivel_default_plant(), ground)
    {
        leg.crowd.write_all(SWIVEL_EFFECTOR, 0, kToe);
        turn(foot);
    }
    void turn(const Quaterniond& to)
    {
        foot = to;
        leg.rotations[3] = floats(Quaterniond((quat(leg.rotations[1]) * quat(leg.rotations[2])).conjugate() * to));
    }
    Vector3d toe() const { return leg.animated() + foot * vec(kToe); }
    // Ground of a slope below the toe, which is `over` above it.
    void write(double over, double slope, const Vector3d& axis = Vector3d::UnitX())
    {
        leg.crowd.write_all(SWIVEL_GROUND, 0, floats(Vector3d(toe() - over * Vector3d::UnitY())));
        leg.crowd.write_all(SWIVEL_GROUND_NORMAL, 0,
                            floats(Vector3d(Eigen::AngleAxisd(slope, axis) * Vector3d::UnitY())));
    }
    std::string text(float label, int frames)
    {
        leg.glide(label, 0, frames);
        return leg.text();
    }
};

}  // namespace

TEST_CASE("explain says that no ground is known, or that it is too steep")
{
    StandingLeg of;
    CHECK(
        of.text(1, 3).starts_with("It is planted, and its target stands. No ground is known below its foot, which goes "
                                  "as it is animated. The target is "));
    of.write(0, 1.54);
    CHECK(has(of.text(0, 3), "The ground below its foot is 88.2 degrees steep and counts as none. The target "));
    of.write(0, 1.5);
    CHECK(!has(of.text(0, 3), "counts as none"));
    of.leg.crowd.write_all(SWIVEL_GROUND, 0, Float3{0, kInf, 0});
    CHECK(has(of.text(0, 3), "No ground is known below its foot"));
}

TEST_CASE("explain says how far the ground lifts a foot, and how fast")
{
    for (const double height : {0.05, -0.04}) {
        StandingLeg of;
        const double level = of.toe().y();
        // The root stands at 0, and the plane is at this height.
        of.write(level, 0);
        of.text(0, 3);
        of.write(level - height, 0);
        const char* const words = height > 0 ? "The ground lifts its foot by " : "The ground lowers its foot by ";
        double last = 0;
        for (int n = 0; n < 4; ++n) {
            const std::string text = of.text(0, 1);
            const double is = of.leg.sent.back().y() - of.toe().y();
            CHECK(number_after(text, words) == Approx(std::fabs(is)).epsilon(1e-3));
            CHECK(std::fabs(is) > std::fabs(last));
            CHECK(number_after(text, " along up, at ") * height > 0);
            last = is;
        }
        CHECK(number_after(of.text(0, 40), words) == Approx(std::fabs(height)).epsilon(1e-3));
    }
}

TEST_CASE("explain says by what angle a foot turns with the ground, and if it may no further")
{
    for (const double slope : {0.1, -0.35, 0.6}) {
        StandingLeg of;
        of.turn(Quaterniond(Eigen::AngleAxisd(slope > 0 ? 0.2 : -0.2, Vector3d::UnitZ())));
        of.write(0.3, slope, Vector3d::UnitZ());
        const std::string text = of.text(0, 3);
        CHECK(number_after(text, "The foot turns by ") == Approx(in_degrees(std::fabs(slope))).margin(0.06));
        CHECK(!has(text, "the most that it may"));
    }
    StandingLeg of;
    of.write(0.5, 0.9, Vector3d::UnitZ());
    const std::string text = of.text(0, 3);
    CHECK(number_after(text, "The foot turns by ") == Approx(in_degrees(std::acos(0.8))).margin(0.06));
    CHECK(number_after(text, "with the ground, the most that it may, not by ") == Approx(in_degrees(0.9)).margin(0.06));
    of.leg.crowd.write_all(SWIVEL_GROUND_WEIGHT, 0, std::array{0.5f});
    const double half = 2 * std::atan2(0.5 * std::sin(0.9), 1 + 0.5 * (1 + std::cos(0.9)));
    CHECK(number_after(of.text(0, 3), "The foot turns by ") == Approx(in_degrees(half)).margin(0.06));
    of.leg.crowd.write_all(SWIVEL_GROUND_WEIGHT, 0, std::array{0.0f});
    CHECK(!has(of.text(0, 3), "The foot turns"));
}

TEST_CASE("explain says that a heel is lifted, and by what angle")
{
    StandingLeg of;
    of.turn(Quaterniond(Eigen::AngleAxisd(-0.3, Vector3d::UnitX())));  // toes up
    of.write(of.toe().y(), 0);
    const std::string text = of.text(1, 30);
    CHECK(has(text, "It is planted, and its target stands."));
    // Its toe is in the air as animated, so it locks on the ground, and its heel would be below.
    const double wanted = in_degrees(0.3);
    CHECK(number_after(text, "It turns by ") == Approx(wanted).margin(0.06));
    CHECK(has(text, "more about its toe, so that its heel stays over the ground."));
    of.turn(Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitX())));  // heel up
    CHECK(!has(of.text(1, 30), "heel"));
}

TEST_CASE("explain takes a hand that is written for the animated one, and leaves planted rotations out")
{
    StandingLeg of;
    of.leg.crowd.write_all(SWIVEL_HAND, 0, floats(Quaterniond(Eigen::AngleAxisd(-0.2, Vector3d::UnitX()))));
    of.leg.crowd.write_all(SWIVEL_TARGET, 0, floats(of.toe()));
    of.write(0, 0);
    CHECK(number_after(of.text(1, 30), "It turns by ") == Approx(in_degrees(0.2)).margin(0.06));
    StandingLeg turns(kStands | SWIVEL_WITH_PLANT_TURN);
    turns.write(turns.toe().y(), 0.2, Vector3d::UnitZ());
    const std::string text = turns.text(1, 30);
    CHECK(has(text, "The ground lifts its foot by "));
    CHECK(!has(text, "The foot turns"));
}

TEST_CASE("explain names bad input of a foot on ground")
{
    StandingLeg of;
    of.write(0, 0);
    of.text(1, 3);
    const auto says = [&](swivel_field field, const auto& value, const auto& good, const std::string& part) {
        of.leg.crowd.write_all(field, 0, value);
        CHECK(has(of.leg.text(), "Bad input: " + part));  // before it is solved
        of.leg.solve();
        CHECK((of.leg.flags() & SWIVEL_BAD_INPUT) != 0);
        CHECK(has(of.leg.text(), "Bad input: " + part));
        CHECK(has(of.leg.text(), "The limb keeps its incoming pose."));
        of.leg.crowd.write_all(field, 0, good);
        of.leg.solve();
        CHECK((of.leg.flags() & SWIVEL_BAD_INPUT) == 0);
        CHECK(!has(of.leg.text(), "Bad input"));
    };
    const Float3 up{0, 1, 0};
    says(SWIVEL_GROUND_NORMAL, Float3{0, kNan, 0}, up, "ground_normal (0, nan, 0) is not a number");
    says(SWIVEL_GROUND_NORMAL, Float3{0, 0, 0}, up,
         "ground_normal (0, 0, 0) is out of its range, of length 1e-9 to 1e9");
    says(SWIVEL_GROUND_NORMAL, Float3{0, 2e9f, 0}, up,
         "ground_normal (0, 2e+09, 0) is out of its range, of length 1e-9 to 1e9");
    says(SWIVEL_GROUND_WEIGHT, std::array{1.5f}, std::array{1.0f}, "ground_weight (1.5) is out of its range, 0 to 1");
    says(SWIVEL_GROUND_WEIGHT, std::array{kNan}, std::array{1.0f}, "ground_weight (nan) is not a number");
    says(SWIVEL_EFFECTOR, Float3{kNan, 0, 0}, kToe, "effector (nan, 0, 0) is not a number");
    // No ground is known: that is no bad input.
    of.leg.crowd.write_all(SWIVEL_GROUND, 0, Float3{kNan, kNan, kNan});
    CHECK(!has(of.leg.text(), "Bad input"));
    of.leg.solve();
    CHECK((of.leg.flags() & SWIVEL_BAD_INPUT) == 0);
}

TEST_CASE("explain says of a foot that was reset no more than that")
{
    StandingLeg of;
    of.write(0, 0.2);
    of.text(1, 3);
    check(swivel_reset(of.leg.crowd.get(), 0, 0, 1));
    CHECK(of.leg.text().starts_with("It was reset, so its planted point starts anew. The target "));
}
