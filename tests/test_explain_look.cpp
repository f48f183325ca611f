// SPDX-License-Identifier: MIT
//
// The promise: swivel_explain() says whether a line of sight meets its target, by how many degrees it misses, and why.
#include <catch2/catch.hpp>

#include <numbers>
#include <string>

#include "tests/upright_bodies.h"

using namespace swivel;
using namespace swivel::test;

namespace {

const Float3 kAhead{0.3f, 1.6f, 3}, kBehind{0.3f, 1.6f, -3}, kUp{0.2f, 5, 0.2f};

// One body that looks.
struct Watcher {
    UprightCrowd bodies;

    explicit Watcher(const Upright& of) : bodies(of, 1) {}
    std::string after(const Float3& target, float weight = 1, float time = 0.01f)
    {
        bodies.reset();
        bodies.crowd.write(SWIVEL_LOOK_WEIGHT, 0, std::vector<float>{weight});
        bodies.solve({target}, time);
        return bodies.crowd.explain(0, 0);
    }
    // By how many degrees it misses, by forward kinematics.
    double missed(const Upright& of, const Float3& target)
    {
        Quaterniond turn = Quaterniond::Identity();
        Vector3d place = Vector3d::Zero();
        for (std::size_t n = 0; n < 4; ++n) {
            place += turn * vec(of.skeleton.translations[n]);
            turn = turn * quat(bodies.rotations[0][n]);
        }
        const swivel_look& look = of.look.look;
        const Vector3d eye = place + turn * vec(look.eye);
        return angle_between(turn * vec(look.axis), vec(target) - eye) * 180 / std::numbers::pi;
    }
};
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
std::string first_sentence(const std::string& text) { return text.substr(0, text.find(" degrees.") + 9); }

}  // namespace

TEST_CASE("explain says that a line of sight meets its target, or that there is nothing to look at")
{
    Upright of;
    Watcher watcher(of);
    CHECK(watcher.bodies.crowd.explain(0, 0) == "It was never solved, or was reset: the next solve looks at once.");
    CHECK(watcher.after(kAhead) == "The line of sight meets the target.");
    watcher.bodies.crowd.reset(0);
    CHECK(watcher.bodies.crowd.explain(0, 0) == "It was never solved, or was reset: the next solve looks at once.");
    CHECK(watcher.after(kNoPlace) ==
          "It has nothing to look at, because look_target is not a number. The joints have their incoming pose.");
    CHECK(watcher.after(kAhead, 0) == "Its look_weight is 0, so the joints have their incoming pose.");
    of.look.look.rate = 1;
    Watcher slow(of);
    slow.after({2, 1.6f, 3});
    CHECK(slow.after(kNoPlace) ==
          "It has nothing to look at, because look_target is not a number. Its line of sight turns back at its rate.");
}

TEST_CASE("explain says by how many degrees a line of sight misses, and why")
{
    Upright of;
    Watcher watcher(of);
    const auto check = [&](const std::string& text, const Float3& target, const std::string& why) {
        INFO(text);
        CHECK(text.starts_with("The line of sight misses the target by "));
        CHECK(std::fabs(std::stod(text.substr(39)) - watcher.missed(of, target)) <= 0.006);
        CHECK(text.substr(first_sentence(text).size()) == why);
    };
    of.look.look.cos_most[3] = 0.97f;
    watcher = Watcher(of);
    const std::string cone = " A joint turns as far as its cone, cos_most, allows.";
    check(watcher.after(kUp), kUp, cone);
    check(watcher.after(kAhead, 0.25f), kAhead, " Its look_weight is 0.25.");
    const std::string behind = watcher.after(kBehind);
    check(behind, kBehind, behind.substr(first_sentence(behind).size()));
    CHECK(has(behind, " The look fades, because the target is behind the incoming line of sight or, at 3.1"));
    of.look.look.rate = 1;
    watcher = Watcher(of);
    watcher.after(kAhead);
    check(watcher.after({-2, 1.6f, 3}), {-2, 1.6f, 3}, " It turns there at its rate, and is still on its way.");
    // Nearer to the head than its eye is.
    of.look.look.rate = 0, of.look.look.joint_count = 1, of.look.look.joints[0] = 3;
    of.look.look.cos_most[0] = -1, of.look.look.near = 0, of.look.look.eye[0] = 0.2f;
    of.look.look.cos_full = -0.99f, of.look.look.cos_none = -1;
    watcher = Watcher(of);
    const Float3 near{0.1f, 1.6f, 0.1f};
    check(watcher.after(near), near,
          " The target is nearer to the last joint than all of the line is, so no turn of that joint meets it.");
}

TEST_CASE("explain names bad input of a look, with its range, and says what the joints have then")
{
    Upright of;
    of.look.on_bad_input = SWIVEL_KEEP_POSE;
    CHECK(Watcher(of).after({0, 1e16f, 0}).starts_with("Bad input: look_target (0, 1e+16, 0) is out of its range, "));
    CHECK(Watcher(of).after(kAhead, 1.5f) ==
          "Bad input: look_weight (1.5) is out of its range, 0 to 1. The joints keep their incoming pose.");
    CHECK(
        Watcher(of).after(kAhead, kNan).starts_with("Bad input: look_weight (nan) is not a number; let it be 0 to 1."));
    of.look.on_bad_input = SWIVEL_REST_POSE;
    of.look.look.rate = 1;
    CHECK(Watcher(of).after(kAhead, 1, -1) ==
          "Bad input: in the pose, its time, the root or a joint was not a number or out of its range. The joints have "
          "their rest pose.");
}
