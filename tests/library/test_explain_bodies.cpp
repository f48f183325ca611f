// SPDX-License-Identifier: MIT
//
// The promise: swivel_explain() says what a hand holds, and of a prop where its place comes from, how far it moved for
// its hands, and how far each is from its grip. Forward kinematics of Eigen's confirm the numbers. It says whether a
// line of sight meets its target, else by how many degrees it misses and why, in the words of approved/looks.txt. Bad
// input is named.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <cmath>

#include "swivel/swivel_explain.hpp"
#include "tests/approved_texts.h"
#include "tests/looking_bodies.h"
#include "tests/prop_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kBody = 20;  // with nothing written of its prop

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
std::string group_name(std::uint32_t g) { return "group " + std::to_string(g); }

// As four digits say it.
bool is_told(double told, double is, double off) { return std::fabs(told - is) <= 6e-4 * std::fabs(is) + off; }

HoldingBodies holding(std::uint64_t seed)
{
    Random random{seed};
    PoseLayout layout;
    layout.roots = true;
    HoldingBodies bodies(random, 40, layout);
    bodies.leave_in_hand(kBody);
    return bodies;
}
std::string text_of(const PosedBodies& bodies, std::uint32_t group, std::uint32_t body = kBody)
{
    return explain(SolvedBodies(bodies).crowd, group, body);
}

// The others have numbers, which are judged as numbers.
std::string first_sentence(const std::string& text) { return text.substr(0, text.find(". ") + 1); }

// A spine, a neck and a head, one above the other. The eye is over all of them. SWIVEL_SIGHT and the target judge what
// is said of a solve.
struct ToldLook {
    ApprovedTexts& texts;
    UprightCrowd bodies;
    Crowd& crowd = bodies.crowd;
    Float3 target = kNoPlace;

    ToldLook(ApprovedTexts& to, const std::string& scene, const swivel_look_def& look)
        : texts(to), bodies(upright(look), 1)
    {
        texts.scene(scene);
    }
    static Upright upright(const swivel_look_def& look)
    {
        Upright made({{0, 1, 0}, {0, 0.5f, 0}, {0, 0.2f, 0}});
        made.look = look;
        return made;
    }
    static swivel_look_def look(std::uint32_t count, double cone)
    {
        swivel_look_def made = swivel_default_look_def();
        made.joint_count = count;
        for (std::uint32_t n = 0; n < count; ++n) {
            made.joints[n] = 3 - count + n;
            made.cos_max[n] = static_cast<float>(std::cos(degrees(cone)));
        }
        made.rate = 0;
        return made;
    }
    void aim_at(const Float3& place) { crowd.write_all(SWIVEL_LOOK_TARGET, 0, target = place); }
    // At an angle from straight ahead, as high as the eye.
    void aim(double angle, double distance = 2)
    {
        const double at = degrees(angle);
        aim_at(floats(distance * Vector3d(std::sin(at), 1.7 / distance, std::cos(at))));
    }
    void aim_at_nothing() { aim_at(kNoPlace); }
    void weigh(float weight) { crowd.write_all(SWIVEL_LOOK_WEIGHT, 0, std::array{weight}); }
    void says(const std::string& when) { texts.line(when, explain(crowd, 0, 0)); }
    // Solves a pose of this weight.
    void solve(float pose_weight)
    {
        const auto came = bodies.rotations;
        bodies.solve({target}, 0.02f, pose_weight);
        bodies.rotations = came;
    }
    void solved(const std::string& when, int frames = 1)
    {
        for (int n = 0; n < frames; ++n) solve(1);
        says(when);
        judge(explain(crowd, 0, 0));
    }

private:
    void judge(const std::string& text) const
    {
        const auto sight = value_of<std::array<float, 6>>(crowd, SWIVEL_SIGHT, 0, 0);
        const Vector3d eye(sight[0], sight[1], sight[2]), axis(sight[3], sight[4], sight[5]), to = vec(target) - eye;
        const double off = std::atan2(axis.cross(to).norm(), axis.dot(to));
        CAPTURE(text, off);
        if (const char* const misses = "misses its target by "; has(text, misses))
            CHECK(number_after(text, misses) == Approx(off / degrees(1)).epsilon(5e-3));  // three digits
        if (const char* const meets = "meets its target, "; has(text, meets)) {
            CHECK(off <= 1e-4);
            CHECK(is_told(number_after(text, meets), to.norm(), 0));
        }
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

    swivel_look_def uneven = ToldLook::look(2, 5);
    uneven.cos_max[1] = -1;
    ToldLook made_up(texts, "a cone of 5 degrees, and then one of 180", uneven);
    made_up.aim(50), made_up.solved("at 50 degrees");

    swivel_look_def offset = ToldLook::look(2, 10);
    offset.eye[0] = 0.1f;
    ToldLook aside(texts, "an eye beside its joint", offset);
    aside.aim(70), aside.solved("at 70 degrees");
    aside.bodies.root_scale = 2, aside.solve(1);  // nothing says how large the last joint's unit is
    CHECK_THAT(explain(aside.crowd, 0, 0),
               Catch::EndsWith(" A cone holds a joint of the chain back. The target may also be nearer to joint 2 than "
                               "the line of sight comes."));

    offset = ToldLook::look(1, 180);
    offset.eye[0] = 0.3f;
    offset.fade_distance = 0, offset.cos_full = -0.9f, offset.cos_none = -1;
    ToldLook near(texts, "an eye further beside its joint", offset);
    near.aim(0, 0.1), near.solved("too near");
    near.aim(0, 0.4), near.solved("not too near");
    near.solve(0.5f);
    CHECK_THAT(explain(near.crowd, 0, 0), Catch::EndsWith("degrees. The pose has a weight below 1."));
    near.bodies.root_scale = 2, near.solve(0.5f);
    CHECK_THAT(explain(near.crowd, 0, 0),
               Catch::EndsWith("degrees. Either the target is nearer to joint 2 than the line of sight comes, or the "
                               "pose has a weight below 1."));

    swivel_look_def eased = ToldLook::look(2, 90);
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
    fades.aim(100), fades.solve(1);  // which turns it so far that its present angle does not tell
    CHECK_THAT(explain(fades.crowd, 0, 0),
               Catch::Contains(" behind, more than 95.74 degrees from the incoming line, so the look fades."));
    fades.aim(30, 0.03), fades.solved("near the eye");
    fades.aim(140), fades.bodies.root_scale = 2, fades.solve(1);
    CHECK_THAT(explain(fades.crowd, 0, 0),
               Catch::Contains(" The look fades, because its target was nearer to the eye than 0.05 of the last "
                               "joint's unit, or behind, more than 95.74 degrees from the incoming line. By now it "));
}

void tell_of_bad_input(ApprovedTexts& texts)
{
    ToldLook of(texts, "bad input of a look", ToldLook::look(2, 45));
    of.aim(10), of.weigh(1.5f), of.solved("its weight");
    of.weigh(1);
    of.aim_at({0, kInf, 0});
    of.solved("its target");
    of.aim(10), of.bodies.rotations[0][2] = {0, 0, 0, kNan}, of.solved("its head");
    of.bodies.rotations[0][2] = {0, 0, 0, 1}, of.solved("none");
}

}  // namespace

TEST_CASE("explain says of a prop how far it moved, and how far each hand is from its grip")
{
    rc::prop("as forward kinematics have it", [](std::uint64_t seed) {
        Random random{seed};
        PropBodies bodies(random, 20);
        for (const std::uint32_t arm : bodies.arms) bodies.limb_def(arm).features |= SWIVEL_WITH_RECORD;
        const SolvedBodies solved(bodies);
        for (std::uint32_t n = 0; n < 20; ++n) {
            const std::string text = explain(solved.crowd, bodies.prop, n);
            INFO(text);
            const SolvedBody body(solved, n);
            const Vector3d root = bodies.root(n, solved);
            const UnmovedProp wanted = bodies.unmoved(body, root);
            const Held told = held(solved.result<Float7>(SWIVEL_PROP_TRANSFORM, bodies.prop, n)),
                       is{told.rotation, told.place - root};
            const bool reaches = solved.flags(bodies.prop, n) == SWIVEL_REACHED,
                       may_move = bodies.prop_def().max_move > 0, is_known = bodies.prop_def().joint < 0;
            const double moved = (is.place - wanted.frame.place).norm();
            if (is_known && moved > 1e-4 * body.length(bodies.arms[0]))
                RC_ASSERT(is_told(number_after(text, "It moved by "), moved, wanted.off));
            if (is_known && moved < wanted.off && wanted.off < 3e-6 * body.length(bodies.arms[0]))
                RC_ASSERT(!has(text, "It moved by"));
            if (solved.flags(bodies.prop, n) == SWIVEL_CLAMPED_NEAR)
                RC_ASSERT(has(text, "A grip is nearer to the shoulder than its arm gets"));
            else if (reaches)
                RC_ASSERT((has(text, "It need not move: all hands reach it.") ||
                           has(text, "no more than it must for all hands to reach it.") || !is_known));
            else
                RC_ASSERT(has(text, may_move ? "Not all hands reach it, wherever it goes within "
                                             : "It never moves, and not all hands reach it."));
            for (const std::uint32_t arm : bodies.arms) {
                const double missed = (body.point(arm).place - body.wanted(arm, is).place).norm();
                RC_ASSERT(is_told(number_after(text, "The hand of " + group_name(arm) + " is "), missed,
                                  wanted.off + 4e-6 * body.length(arm)));
                const std::string hand = explain(solved.crowd, arm, n);
                INFO(hand);
                RC_ASSERT(has(hand, "It holds the prop of " + group_name(bodies.prop) +
                                        (reaches ? ". " : ", which not all hands reach. ")));
            }
        }
    });
}

TEST_CASE("explain solves a limb again with the hand that it came with, where nobody wrote one")
{
    Random random{4};
    for (const swivel_features more :
         std::initializer_list<swivel_features>{0, SWIVEL_WITH_EFFECTOR, SWIVEL_POLE_HAND, SWIVEL_WITH_CLAVICLE}) {
        PosedBodies bodies(random, {3, 1, 1, true}, 20, {}, 2);
        bodies.add_limbs(SWIVEL_WITH_HAND | SWIVEL_WITH_RECORD | more);
        bodies.give(0, SWIVEL_TARGET, [&](std::size_t n) { return bodies.goal(random, 0, n).target; });
        if (more != SWIVEL_POLE_HAND)
            bodies.give(0, SWIVEL_POLE, [&](std::size_t n) { return bodies.goal(random, 0, n).pole; });
        if (more & SWIVEL_WITH_EFFECTOR)
            bodies.give(0, SWIVEL_EFFECTOR, [&](std::size_t) { return floats(random.vector(0, 0.05)); });
        if (more & SWIVEL_WITH_CLAVICLE) bodies.give(0, SWIVEL_CLAVICLE, [](std::size_t) { return Float1{0.5f}; });
        SolvedBodies solved(bodies);
        const auto text_is = [&](std::uint32_t n, const std::string& part, bool wanted) {
            const std::string text = explain(solved.crowd, 0, n);
            INFO(text << ", features " << more);
            CHECK(has(text, part) == wanted);
        };
        for (std::uint32_t n = 0; n < 20; ++n) text_is(n, "Bad input", false), text_is(n, "Its inputs changed", false);
        solved.crowd.write(SWIVEL_HAND, 0, std::vector<Float4>{Float4{}}, 3);
        bodies.bodies[5].rotations[bodies.skeleton.limbs[0].wrist][1] = kNan;
        solved.solve_next();
        text_is(3, "Bad input: hand (0, 0, 0, 0) is out of its range, a quaternion of length 1e-9 to 1e9.", true);
        text_is(5, "Bad input: in the pose, ", true);
    }
}

TEST_CASE("explain says what hands hold, where props lie and why, and what depends on bad input, as approved")
{
    using H = HoldingBodies;
    ApprovedTexts texts("hands.txt");
    texts.scene("where a prop lies");
    const struct {
        const char* when;
        std::uint32_t group;
        float share, weight;
        bool has_place, has_turn;
    } places[] = {{"as a hand has it", H::prop, 0, 1, false, false},
                  {"as the other hand has it", H::prop, 1, 1, false, false},
                  {"between the hands", H::prop, 0.5f, 1, false, false},
                  {"its place is written", H::prop, 0, 1, true, false},
                  {"its rotation is written", H::prop, 1, 1, false, true},
                  {"both are written", H::prop, 0, 1, true, true},
                  {"both, with a weight", H::prop, 0, 0.25f, true, true},
                  {"at a joint", H::handle, 0, 1, false, false},
                  {"at a place in a joint's frame", H::handle, 0, 1, true, false},
                  {"at a rotation in a joint's frame", H::handle, 0, 1, false, true},
                  {"at both in a joint's frame, with a weight", H::handle, 0, 0.25f, true, true}};
    for (const auto& [when, group, share, weight, has_place, has_turn] : places) {
        HoldingBodies bodies = holding(2);
        const Float3 place = group == H::prop ? bodies.bodies[kBody].root_position : Float3{0.1f, 0, 0};
        bodies.give(group, SWIVEL_HAND_BLEND, [&, is = share](std::size_t) { return Float1{is}; });
        bodies.give(group, SWIVEL_PROP_WEIGHT, [&, is = weight](std::size_t) { return Float1{is}; });
        bodies.give(group, SWIVEL_PROP_POSITION, [&, has = has_place](std::size_t) { return has ? place : kNoPlace; });
        bodies.give(group, SWIVEL_PROP_ROTATION, [has = has_turn](std::size_t) {
            return has ? Float4{0.6f, 0, 0, 0.8f} : kNoTurn;
        });
        texts.line(when, first_sentence(text_of(bodies, group)));
    }
    texts.scene("a hand that holds another limb's");
    for (const char* const when : {"which reaches", "which does not", "whose input is bad"}) {
        HoldingBodies bodies = holding(1);
        Float3& target = *reinterpret_cast<Float3*>(bodies.find(H::free, SWIVEL_TARGET)->at(kBody));
        if (std::string(when) == "which does not") target[0] += 1e3f;
        if (std::string(when) == "whose input is bad") target[0] = kNan;
        texts.line(when, first_sentence(text_of(bodies, H::follower)));
    }
    const Crowd unsolved = holding(1).crowd();
    for (const std::uint32_t group : {H::follower, H::prop})
        texts.line("never solved, " + group_name(group), explain(unsolved, group, 0));
    const auto tell = [&](const char* scene, const auto& spoil) {
        HoldingBodies bodies = holding(2);
        for (BodyInput& input : bodies.inputs)
            if (input.field == SWIVEL_GRIP) input.write(kBody, Float7{0, 0, 0.1f, 0, 0, 0, 1});
        spoil(bodies);
        const SolvedBodies solved(bodies);
        texts.scene(scene);
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g)
            if (const std::string text = explain(solved.crowd, g, kBody); text.starts_with("Bad input"))
                texts.line(group_name(g), text);
    };
    const struct {
        const char* scene;
        std::uint32_t group;
        swivel_field field;
        std::size_t first, count;  // the numbers of its value that are bad
        float bad;
    } inputs[] = {
        {"a grip that is too far", H::follower, SWIVEL_GRIP, 1, 1, 2e15f},
        {"a grip of the hand that says where the prop is", H::left, SWIVEL_GRIP, 5, 1, kNan},
        {"a share above 1", H::prop, SWIVEL_HAND_BLEND, 0, 1, 1.5f},
        {"a share that is no number", H::prop, SWIVEL_HAND_BLEND, 0, 1, kNan},
        {"a place", H::prop, SWIVEL_PROP_POSITION, 0, 3, 1e15f},
        {"no rotation", H::prop, SWIVEL_PROP_ROTATION, 0, 4, 0},
        {"a target that is written for a hand on a prop", H::left, SWIVEL_TARGET, 0, 3, 1e15f},
    };
    for (const auto& input : inputs)
        tell(input.scene, [&](HoldingBodies& bodies) {
            std::fill_n(bodies.find(input.group, input.field)->at(kBody) + input.first, input.count, input.bad);
        });
    tell("a weight below 0", [](HoldingBodies& bodies) {
        bodies.give(H::prop, SWIVEL_PROP_WEIGHT, [](std::size_t n) { return Float1{n == kBody ? -0.5f : 1}; });
    });
    tell("a target of a hand on a limb, which is no input", [](HoldingBodies& bodies) {
        bodies.give(H::follower, SWIVEL_TARGET, [](std::size_t) { return Float3{1e15f, 1e15f, 1e15f}; });
    });
    tell("an elbow of a hand on a prop", [](HoldingBodies& bodies) {
        bodies.bodies[kBody].rotations[bodies.skeleton.limbs[1].elbow][0] = kNan;
        CHECK_THAT(text_of(bodies, H::prop),
                   Catch::Contains("The hand of group 2 has bad input, so nothing is done for it."));
    });
    tell("a root", [](HoldingBodies& bodies) { bodies.bodies[kBody].root_rotation[0] = kNan; });
    texts.compare();
}

TEST_CASE("explain speaks of looks as approved")
{
    ApprovedTexts texts("looks.txt");
    tell_of_targets(texts);
    tell_of_what_holds_back(texts);
    tell_of_bad_input(texts);
    texts.compare();
}
