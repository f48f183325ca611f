// SPDX-License-Identifier: MIT
//
// The promise: swivel_explain() says whether a line of sight meets its target, else by how many degrees it misses and
// why. All turns here are about the upright axis through the eye, so the angles are known without the library.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/test_arm.h"
#include "tests/test_crowd.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

bool has(const std::string& text, const std::string& part)
{
    const bool is_there = text.find(part) != std::string::npos;
    if (!is_there) UNSCOPED_INFO(text);
    return is_there;
}
double number_after(const std::string& text, const std::string& words)
{
    const std::size_t at = text.find(words);
    INFO(text << " lacks " << words);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + words.size()));
}

// A spine, a neck and a head, one above the other. The eye is over all of them.
struct UprightLook {
    static constexpr std::array<std::int32_t, 3> kParents = {-1, 0, 1};
    static constexpr std::array<Float3, 3> kOffsets = {{{0, 1, 0}, {0, 0.5f, 0}, {0, 0.2f, 0}}};

    Crowd crowd;
    std::array<Float4, 3> rotations{};
    float time = 0.02f;

    explicit UprightLook(const swivel_look& look) : crowd(skeleton(), 1, std::array{group(look)})
    {
        rotations.fill({0, 0, 0, 1});
    }
    static swivel_look look(std::uint32_t count, double cone)
    {
        swivel_look made = swivel_default_look();
        made.joint_count = count;
        for (std::uint32_t n = 0; n < count; ++n) {
            made.joints[n] = 3 - count + n;
            made.cos_most[n] = static_cast<float>(std::cos(cone * kDegree));
        }
        made.rate = 0;
        return made;
    }
    // At an angle from straight ahead, as high as the eye.
    void aim(double degrees, double distance = 2)
    {
        crowd.write_all(
            SWIVEL_LOOK_TARGET, 0,
            floats(Vector3d(distance * std::sin(degrees * kDegree), 1.7, distance * std::cos(degrees * kDegree))));
    }
    std::string text() const { return crowd.explain(0, 0); }
    std::string solved(int frames = 1)
    {
        for (int n = 0; n < frames; ++n) {
            std::array<Float4, 3> results = rotations;
            swivel_pose pose = swivel_default_pose();
            pose.rotations = {rotations.data(), sizeof rotations, sizeof rotations[0], nullptr};
            pose.results = {results.data(), sizeof results, sizeof results[0], nullptr};
            pose.time = {&time, 0};
            crowd.solve({.pose = &pose});
        }
        return text();
    }

private:
    static swivel_group_def group(const swivel_look& look)
    {
        swivel_group_def def = swivel_default_group_def(0);
        def.features = SWIVEL_LOOK;
        def.look = look;
        return def;
    }
    static swivel_skeleton skeleton()
    {
        swivel_skeleton made = swivel_default_skeleton();
        made.parents = stream(kParents);
        made.translations = stream(kOffsets);
        made.joint_count = 3;
        return made;
    }
};

}  // namespace

TEST_CASE("explain says that a line of sight meets its target, or that there is none")
{
    UprightLook of(UprightLook::look(3, 30));
    CHECK(of.text() == "It was never solved, or was reset: it begins at its next target.");
    CHECK(of.solved() == "It has nothing to look at, so the chain has its incoming pose.");
    of.aim(20);
    CHECK(of.solved() == "The line of sight meets its target, 2 from the eye.");
    // Shares of a third each are 28 degrees, so no cone holds.
    of.aim(84);
    CHECK(of.solved() == "The line of sight meets its target, 2 from the eye.");
    const std::string changed = (of.aim(60), of.text());
    CHECK(has(changed, "Its target changed since it was solved. "));
    CHECK(number_after(changed, "The line of sight is ") == Approx(24).epsilon(2e-3));
    of.crowd.write_all(SWIVEL_LOOK_TARGET, 0, Float3{kNone, kNone, kNone});
    CHECK(has(of.text(), "Its target changed since it was solved. It has nothing to look at"));
    CHECK(swivel_reset(of.crowd.get(), 0, 0, 1) == SWIVEL_OK);
    CHECK(has(of.text(), "or was reset"));
}

TEST_CASE("explain warns of a target that is very far away")
{
    UprightLook of(UprightLook::look(3, 30));
    of.aim(20, 1e4);
    CHECK(of.solved().find("Warning") == std::string::npos);
    of.aim(20, 1e5);
    CHECK(has(of.solved(), "Warning: its target is 1e+05 away, more than ten thousand times as far"));
}

TEST_CASE("explain says which cone holds a line of sight back")
{
    UprightLook chain(UprightLook::look(3, 20));
    chain.aim(80);
    const std::string text = chain.solved();
    CHECK(number_after(text, "misses its target by ") == Approx(20).epsilon(2e-3));
    CHECK(has(text, " The cone of joint 2, 20 degrees, holds it back."));
    chain.crowd.write_all(SWIVEL_LOOK_WEIGHT, 0, std::array{0.9f});
    CHECK(has(chain.solved(), "With a weight of 0.9 it takes a part of the turn. A cone holds a joint"));

    swivel_look uneven = UprightLook::look(2, 5);
    uneven.cos_most[1] = -1;
    UprightLook made_up(uneven);
    made_up.aim(50);
    CHECK(has(made_up.solved(), "from the eye. A cone holds a joint of the chain back, and those after it make up"));

    swivel_look offset = UprightLook::look(2, 10);
    offset.eye[0] = 0.1f;
    UprightLook aside(offset);
    aside.aim(70);
    CHECK(has(aside.solved(), "The cone of joint 2, 10 degrees, holds it back, unless the target is nearer"));
}

TEST_CASE("explain says that a target is nearer to the last joint than the line of sight comes")
{
    swivel_look offset = UprightLook::look(1, 180);
    offset.eye[0] = 0.3f;
    offset.fade_distance = 0, offset.cos_full = -0.9f, offset.cos_none = -1;
    UprightLook of(offset);
    of.aim(0, 0.1);
    CHECK(has(of.solved(), "degrees. The target is nearer to joint 2 than the line of sight comes"));
    of.aim(0, 0.4);
    CHECK(has(of.solved(), "meets its target"));
}

TEST_CASE("explain says by how much the rate holds a line of sight back")
{
    swivel_look eased = UprightLook::look(2, 90);
    eased.rate = 1;
    UprightLook of(eased);
    of.aim(0);
    of.solved();
    of.aim(40);
    const std::string text = of.solved(5);
    const double left = 40 - 5 * 0.02 / kDegree;
    CHECK(number_after(text, "misses its target by ") == Approx(left).epsilon(3e-3));
    CHECK(number_after(text, "Its rate of 57.3 degrees a second holds it back by ") == Approx(left).epsilon(3e-3));
    CHECK(has(of.solved(60), "meets its target"));
    of.crowd.write_all(SWIVEL_LOOK_TARGET, 0, Float3{kNone, kNone, kNone});
    CHECK(
        of.solved() ==
        "It has nothing to look at, and the chain is on its way back to its incoming pose, by 57.3 degrees a second.");
    CHECK(of.solved(60) == "It has nothing to look at, so the chain has its incoming pose.");
}

TEST_CASE("explain says that a target is behind, or that it may be too near")
{
    UprightLook of(UprightLook::look(2, 45));
    of.aim(170);
    CHECK(has(of.solved(),
              "misses its target by 170 degrees. The target is behind, more than 154.2 degrees from the "
              "incoming line, so the look has faded out."));
    // Two thirds of the way to where it fades out: less than a third of the turn is left.
    of.aim(140);
    CHECK(has(of.solved(), "The target is behind, more than 95.74 degrees from the incoming line, so the look fades."));
    of.aim(30, 0.03);
    const std::string near = of.solved();
    CHECK(has(near, "or nearer to the eye than 0.05 of the last joint's unit: it is 0.03 away."));
    of.aim(30);
    of.crowd.write_all(SWIVEL_LOOK_WEIGHT, 0, std::array{0.0f});
    CHECK(has(of.solved(), "misses its target by 30 degrees. Its weight is 0, so the chain has its incoming pose."));
}

TEST_CASE("explain names the bad input of a look")
{
    UprightLook of(UprightLook::look(2, 45));
    of.aim(10);
    of.solved();
    of.crowd.write_all(SWIVEL_LOOK_WEIGHT, 0, std::array{1.5f});
    CHECK(has(of.solved(), "Bad input: look_weight (1.5) is out of its range"));
    of.crowd.write_all(SWIVEL_LOOK_WEIGHT, 0, std::array{1.0f});
    of.crowd.write_all(SWIVEL_LOOK_TARGET, 0, Float3{0, std::numeric_limits<float>::infinity(), 0});
    CHECK(has(of.solved(), "Bad input: look_target (0, inf, 0) is out of its range"));
    of.aim(10);
    of.rotations[2] = {0, 0, 0, kNone};
    CHECK(has(of.solved(), "Bad input: in the pose, its time, or a rotation"));
    of.rotations[2] = {0, 0, 0, 1};
    CHECK(has(of.solved(), "meets its target"));
}
