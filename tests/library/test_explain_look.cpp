// SPDX-License-Identifier: MIT
//
// The promise: swivel_explain() says whether a line of sight meets its target, else by how many degrees it misses and
// why, in the words of approved/looks.txt. All turns here are about the upright axis through the eye, so a scene's own
// degrees say by how many it misses.
#include <catch2/catch.hpp>

#include <cmath>

#include "tests/approved_texts.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// A spine, a neck and a head, one above the other. The eye is over all of them.
struct ToldLook {
    static constexpr std::array<std::int32_t, 3> kParents = {-1, 0, 1};
    static constexpr std::array<Float3, 3> kOffsets = {{{0, 1, 0}, {0, 0.5f, 0}, {0, 0.2f, 0}}};

    ApprovedTexts& texts;
    Crowd crowd;
    std::array<Float4, 3> rotations{};

    ToldLook(ApprovedTexts& to, const std::string& scene, const swivel_look& look)
        : texts(to), crowd(skeleton(), 1, std::array{group(look)})
    {
        texts.scene(scene);
        rotations.fill({0, 0, 0, 1});
    }
    static swivel_look look(std::uint32_t count, double cone)
    {
        swivel_look made = swivel_default_look();
        made.joint_count = count;
        for (std::uint32_t n = 0; n < count; ++n) {
            made.joints[n] = 3 - count + n;
            made.cos_most[n] = static_cast<float>(std::cos(degrees(cone)));
        }
        made.rate = 0;
        return made;
    }
    // At an angle from straight ahead, as high as the eye.
    void aim(double angle, double distance = 2)
    {
        const double at = degrees(angle);
        crowd.write_all(SWIVEL_LOOK_TARGET, 0, floats(distance * Vector3d(std::sin(at), 1.7 / distance, std::cos(at))));
    }
    void aim_at_nothing() { crowd.write_all(SWIVEL_LOOK_TARGET, 0, Float3{kNan, kNan, kNan}); }
    void weigh(float weight) { crowd.write_all(SWIVEL_LOOK_WEIGHT, 0, std::array{weight}); }
    void says(const std::string& when) { texts.line(when, crowd.explain(0, 0)); }
    void solved(const std::string& when, int frames = 1)
    {
        const float time = 0.02f;
        for (int n = 0; n < frames; ++n) {
            std::array<Float4, 3> results = rotations;
            swivel_pose pose = swivel_default_pose();
            pose.rotations = {rotations.data(), sizeof rotations, sizeof rotations[0], nullptr};
            pose.results = {results.data(), sizeof results, sizeof results[0], nullptr};
            pose.time = {&time, 0};
            crowd.solve({.pose = &pose});
        }
        says(when);
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

void tell_of_targets(ApprovedTexts& texts)
{
    ToldLook of(texts, "targets", ToldLook::look(3, 30));
    of.says("not solved");
    of.solved("no target");
    of.aim(20), of.solved("at 20 degrees");
    of.aim(84), of.solved("at 84 degrees, of which each of three joints takes 28");
    of.aim(60), of.says("moved by 24 degrees");
    of.aim_at_nothing(), of.says("gone");
    of.aim(20, 1e4), of.solved("at 20 degrees, far away");
    of.aim(20, 1e5), of.solved("farther");
    CHECK(swivel_reset(of.crowd.get(), 0, 0, 1) == SWIVEL_OK);
    of.says("reset");
}

void tell_of_what_holds_back(ApprovedTexts& texts)
{
    ToldLook chain(texts, "three cones of 20 degrees", ToldLook::look(3, 20));
    chain.aim(80), chain.solved("at 80 degrees");
    chain.weigh(0.9f), chain.solved("with a weight");
    chain.aim(30), chain.weigh(0), chain.solved("at 30 degrees, with a weight of 0");

    swivel_look uneven = ToldLook::look(2, 5);
    uneven.cos_most[1] = -1;
    ToldLook made_up(texts, "a cone of 5 degrees, and then one of 180", uneven);
    made_up.aim(50), made_up.solved("at 50 degrees");

    swivel_look offset = ToldLook::look(2, 10);
    offset.eye[0] = 0.1f;
    ToldLook aside(texts, "an eye beside its joint", offset);
    aside.aim(70), aside.solved("at 70 degrees");

    offset = ToldLook::look(1, 180);
    offset.eye[0] = 0.3f;
    offset.fade_distance = 0, offset.cos_full = -0.9f, offset.cos_none = -1;
    ToldLook near(texts, "an eye further beside its joint", offset);
    near.aim(0, 0.1), near.solved("too near");
    near.aim(0, 0.4), near.solved("not too near");

    swivel_look eased = ToldLook::look(2, 90);
    eased.rate = 1;
    ToldLook eases(texts, "a rate of 1 radian a second, which is 1.146 degrees a frame", eased);
    eases.aim(0), eases.solved("straight ahead");
    eases.aim(40), eases.solved("at 40 degrees, for 5 frames", 5);
    eases.solved("for 60 frames more", 60);
    eases.aim_at_nothing(), eases.solved("gone");
    eases.solved("for 60 frames", 60);

    ToldLook fades(texts, "targets behind", ToldLook::look(2, 45));
    fades.aim(170), fades.solved("at 170 degrees");
    fades.aim(140), fades.solved("at 140 degrees");
    fades.aim(30, 0.03), fades.solved("near the eye");
}

void tell_of_bad_input(ApprovedTexts& texts)
{
    ToldLook of(texts, "bad input of a look", ToldLook::look(2, 45));
    of.aim(10), of.weigh(1.5f), of.solved("its weight");
    of.weigh(1);
    of.crowd.write_all(SWIVEL_LOOK_TARGET, 0, Float3{0, kInf, 0});
    of.solved("its target");
    of.aim(10), of.rotations[2] = {0, 0, 0, kNan}, of.solved("its head");
    of.rotations[2] = {0, 0, 0, 1}, of.solved("none");
}

}  // namespace

TEST_CASE("explain speaks of looks as approved")
{
    ApprovedTexts texts("looks.txt");
    tell_of_targets(texts);
    tell_of_what_holds_back(texts);
    tell_of_bad_input(texts);
    texts.compare();
}
