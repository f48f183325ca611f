// SPDX-License-Identifier: MIT
//
// The promise: a body is shifted so that its limbs reach, and says by how much; its limbs then do, by forward
// kinematics of Eigen's. What cannot be gets a line. That a capped limb gets no straighter than its margin allows is in
// test_fit.cpp, and where its pose comes in in test_body_limbs.cpp.
#include <catch2/catch.hpp>

#include "tests/posed_bodies.h"
#include "tests/test_crowd.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr swivel_features kFitting = SWIVEL_WITH_PELVIS_FIT | SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD;
constexpr std::size_t kBodies = 80;
constexpr std::uint32_t kLimbs[] = {1, 2, 3};  // groups; the shift is the first

// Bodies that stand still, with targets that all limbs reach from one shift.
struct FitStage : PosedBodies {
    std::vector<double> lengths;  // that drop and rise are shares of

    explicit FitStage(Random random, swivel_features features = kFitting)
        : PosedBodies(random, {3, 3, 1, false}, kBodies, {.roots = true}, 2)
    {
        add(swivel_default_shift_def());
        shift_def().drop = 0.5f, shift_def().rise = 0.4f;
        add_limbs(features);
        const swivel_binding first = bind(skeleton.view(), joints[0]);
        std::vector<double> shifts;
        for (Body& body : bodies) {
            body.root_scale = static_cast<float>(random.spread(0.5, 2));
            lengths.push_back((double{first.lengths[0]} + first.lengths[1]) * body.root_scale);
            shifts.push_back(random.between(-0.45, 0.35) * lengths.back());
        }
        for (const std::uint32_t g : kLimbs) {
            give(g, SWIVEL_TARGET, [&](std::size_t n) {
                const LimbAt limb = limb_at(g, n);
                const double near = std::fabs(limb.upper - limb.fore),
                             distance = near + random.between(0.6, 0.98) * (limb.length() - near);
                return floats(Vector3d(shoulder(g, n) + shifts[n] * up(n) + distance * random.direction()));
            });
            give(g, SWIVEL_PELVIS_FIT_WEIGHT, [](std::size_t) { return Float1{1}; });
        }
    }
    swivel_shift_def& shift_def() { return std::get<swivel_shift_def>(groups[0]); }
    const swivel_shift_def& shift_def() const { return std::get<swivel_shift_def>(groups[0]); }
    Vector3d up(std::size_t n) const { return quat(bodies[n].root_rotation).normalized() * Vector3d::UnitY(); }
    Vector3d shoulder(std::uint32_t group, std::size_t n) const
    {
        return vec(bodies[n].root_position) +
               joints_at(skeleton, bodies[n])[skeleton.limbs[limb_of[group]].shoulder].place;
    }
    LimbAt limb_at(std::uint32_t group, std::size_t n) const
    {
        return LimbAt(skeleton, bodies[n], joints_at(skeleton, bodies[n]), skeleton.limbs[limb_of[group]]);
    }
    // The shift nearest to the wish from which all limbs that count reach.
    double wanted(std::size_t n, std::initializer_list<std::uint32_t> counts = {1, 2, 3}) const
    {
        double low = -1e9, high = 1e9;
        for (const std::uint32_t g : counts) {
            const double length = limb_at(g, n).length();
            const Vector3d away = shoulder(g, n) - vec(value(g, SWIVEL_TARGET, n, kNoPlace));
            const double height = away.dot(up(n)), across2 = away.squaredNorm() - height * height;
            const double room = std::sqrt(std::max(0.0, length * length - across2));
            low = std::max(low, -height - room), high = std::min(high, room - height);
        }
        const swivel_shift_def& with = shift_def();
        const double wish = value(0, SWIVEL_SHIFT_WISH, n, Float1{})[0];
        return std::clamp(std::clamp(wish, low, std::max(low, high)), -with.drop * lengths[n], with.rise * lengths[n]);
    }
    // A shift is known as well as floats know the root.
    double off(std::size_t n) const { return 3e-6 * (1 + vec(bodies[n].root_position).norm()); }
};
double shift_of(const SolvedBodies& solved, std::size_t n) { return solved.result<Float3>(SWIVEL_SHIFT, 0, n)[0]; }
void weigh(SolvedBodies& solved, float weight)
{
    for (const std::uint32_t g : kLimbs) solved.crowd.write_all(SWIVEL_PELVIS_FIT_WEIGHT, g, weight);
}
// Lets no limb count until bodies have had their first solve, after which a shift comes slowly.
SolvedBodies unshifted(FitStage& stage, float time)
{
    stage.time = time;
    for (BodyInput& input : stage.inputs)
        if (input.field == SWIVEL_PELVIS_FIT_WEIGHT) input.numbers.assign(kBodies, 0);
    SolvedBodies solved(stage);
    for (std::size_t n = 0; n < kBodies; ++n) REQUIRE(shift_of(solved, n) == 0);
    weigh(solved, 1);
    return solved;
}

}  // namespace

TEST_CASE("a body is shifted so that all limbs reach, as near to a wish as they do, within drop and rise, and at once")
{
    const auto [room, min_far, min_short] = GENERATE(table<float, int, int>({{0.5f, 21, 0}, {0.02f, 0, 11}}));
    FitStage stage(Random{1});
    stage.time = 0;
    stage.shift_def().drop = room, stage.shift_def().rise = 0.8f * room;
    if (GENERATE(true, false))
        stage.give(0, SWIVEL_SHIFT_WISH, [](std::size_t n) { return Float1{0.002f * static_cast<float>(n) - 0.08f}; });
    const SolvedBodies solved(stage);
    int far_count = 0, short_count = 0;
    for (std::size_t n = 0; n < kBodies; ++n) {
        const SolvedBody body(solved, n);
        const double shift = shift_of(solved, n);
        REQUIRE(std::fabs(shift - stage.wanted(n)) <= stage.off(n));
        bool all = true;
        for (const std::uint32_t g : kLimbs) {
            const Vector3d wrist = body.root() + shift * stage.up(n) + body.solved[body.joints(g).wrist].place;
            // At the very end of its reach a limb may lack the shift's rounding, and be flagged as clamped.
            const double missed = (wrist - vec(stage.value(g, SWIVEL_TARGET, n, kNoPlace))).norm();
            all &= missed <= body.limb(g).wrist_bound() + stage.off(n) / 3;
        }
        REQUIRE(solved.flags(0, n) == (all ? SWIVEL_REACHED : SWIVEL_CLAMPED_FAR));
        far_count += std::fabs(shift) > 0.01, short_count += !all;
    }
    REQUIRE(far_count >= min_far);
    REQUIRE(short_count >= min_short);
    REQUIRE((short_count == 0) == (min_short == 0));
}

TEST_CASE("a shift that is not there yet comes by a critically damped spring, and none while time stands still")
{
    FitStage stage(Random{2});
    stage.shift_def().half_life = 0.15f;
    SolvedBodies solved = unshifted(stage, 0);
    const double k = 1.6783469900166605 / 0.15;
    for (int frame = 0; frame <= 60; ++frame) {
        stage.time = frame == 0 ? 0 : 1 / 60.0f;
        solved.solve_next();
        const double x = k * frame * double{stage.time}, done = 1 - (1 + x) * std::exp(-x);
        for (std::size_t n = 0; n < kBodies; ++n) {
            const double to = stage.wanted(n);
            REQUIRE(std::fabs(shift_of(solved, n) - done * to) <= 1e-5 * (1 + std::fabs(to)));
            if (frame == 0) REQUIRE(shift_of(solved, n) == 0);
        }
    }
    FitStage quick(Random{3});
    quick.shift_def().half_life = 0;
    SolvedBodies at_once = unshifted(quick, 0.01f);
    at_once.solve_next();
    for (std::size_t n = 0; n < kBodies; ++n)
        REQUIRE(std::fabs(shift_of(at_once, n) - quick.wanted(n)) <= quick.off(n));
}

TEST_CASE("a limb with bad input does not count, and costs no other a bit")
{
    struct Fault {
        swivel_field field;
        Float3 value;
        swivel_features needs = 0;
    };
    const Fault faults[] = {{SWIVEL_TARGET, {kNan, 0, 0}},
                            {SWIVEL_LENGTHS, {-1, 1, 0}},
                            {SWIVEL_LENGTHS, {kInf, 1, 0}},
                            {SWIVEL_PELVIS_FIT_WEIGHT, {kNan, 0, 0}},
                            {SWIVEL_PELVIS_FIT_WEIGHT, {2, 0, 0}},
                            {SWIVEL_NEXT_TARGET, {kNan, 0, 0}, SWIVEL_WITH_NEXT_TARGET},
                            {SWIVEL_NEXT_TIME, {-1, 0, 0}, SWIVEL_WITH_NEXT_TARGET},
                            {SWIVEL_CAP, {kNan, 0, 0}, SWIVEL_WITH_CAP},
                            {SWIVEL_EFFECTOR, {kNan, 0, 0}, SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_HAND}};
    for (const Fault& fault : faults) {
        INFO("field " << fault.field << ", " << fault.value[0]);
        FitStage stage(Random{6}, kFitting | fault.needs);
        SolvedBodies solved(stage), other(stage);  // of which the other's limb does not count
        const auto spoil = [](Crowd& crowd, swivel_field field, const Float3& value) {
            crowd.reset(0);
            check(swivel_write(crowd.get(), field, 2, 17, 1, {&value, sizeof value}));
        };
        spoil(solved.crowd, fault.field, fault.value);
        spoil(other.crowd, SWIVEL_PELVIS_FIT_WEIGHT, {});
        solved.solve_next(), other.solve_next();
        CHECK(solved.flags(2, 17) == SWIVEL_BAD_INPUT);
        for (std::uint32_t g = 0; g <= 3; ++g)
            for (std::size_t n = 0; n < kBodies; ++n)
                if (g != 2 || n != 17) CHECK(bits_of_group(solved.crowd, g, n) == bits_of_group(other.crowd, g, n));
        for (const std::uint32_t limb : {0u, 2u}) {
            const std::uint32_t shoulder = stage.skeleton.limbs[limb].shoulder;
            CHECK(solved.poses.joint_bytes(17, shoulder) == other.poses.joint_bytes(17, shoulder));
        }
    }
}

TEST_CASE("bad input of a shift is the shift's alone, which then stays")
{
    FitStage stage(Random{7});
    SolvedBodies solved(stage);
    using Bits = std::array<std::uint32_t, 3>;
    const Bits before = solved.result<Bits>(SWIVEL_SHIFT, 0, 17);
    solved.crowd.write(SWIVEL_SHIFT_WISH, 0, std::vector<float>{kNan}, 17);
    solved.solve_next();
    CHECK(solved.result<Bits>(SWIVEL_SHIFT, 0, 17) == before);
    for (const std::uint32_t g : kLimbs) CHECK(!(solved.flags(g, 17) & SWIVEL_BAD_INPUT));
    for (std::size_t n = 0; n < kBodies; ++n)
        CHECK(solved.flags(0, n) == (n == 17 ? SWIVEL_BAD_INPUT : SWIVEL_REACHED));
}

TEST_CASE("a coming target is prepared for the nearer it is")
{
    FitStage stage(Random{8}, kFitting | SWIVEL_WITH_NEXT_TARGET);
    stage.time = 0;
    SolvedBodies solved(stage);
    // The limbs' own wrists are their targets, so only what is coming shifts.
    weigh(solved, 0);
    solved.crowd.write_all(SWIVEL_PELVIS_FIT_WEIGHT, 1, 1.0f);
    for (const std::uint32_t g : kLimbs) {
        std::vector<Float3> next_target, own;
        for (std::size_t n = 0; n < kBodies; ++n) {
            next_target.push_back(stage.value(g, SWIVEL_TARGET, n, kNoPlace));
            own.push_back(own_goal(stage.skeleton, stage.bodies[n], g - 1).target);
        }
        solved.crowd.write(SWIVEL_NEXT_TARGET, g, next_target), solved.crowd.write(SWIVEL_TARGET, g, own);
        solved.crowd.write_all(SWIVEL_NEXT_TIME, g, 1e15f);
    }
    std::vector<double> last(kBodies);
    int shifted_count = 0;
    for (const float time : {0.31f, 0.3f, 0.2f, 0.1f, 0.0f}) {
        solved.crowd.write_all(SWIVEL_NEXT_TIME, 1, time);
        solved.crowd.reset(0);
        solved.solve_next();
        const double near = std::max(0.0, 1 - double{time} / stage.shift_def().lookahead);
        for (std::size_t n = 0; n < kBodies; ++n) {
            const double shift = std::fabs(shift_of(solved, n)), whole = std::fabs(stage.wanted(n, {1}));
            if (near == 0) REQUIRE(shift == 0);
            REQUIRE(shift >= last[n] - 1e-7);
            REQUIRE(shift <= near * near * whole + stage.off(n));
            last[n] = shift;
            shifted_count += near > 0 && shift > 1e-3;
        }
    }
    REQUIRE(shifted_count > 10);
}

TEST_CASE("shifts and limbs that stand or fit get a line if they cannot be")
{
    const FitStage stage(Random{11});
    const swivel_skeleton view = stage.skeleton.view();
    const std::vector<swivel_limb_joints>& joints = stage.joints;
    swivel_shift_def shift;
    swivel_body_limb_def fits, stands;
    std::vector<swivel_group_def> groups;
    swivel_crowd_def def = swivel_default_crowd_def();
    constexpr swivel_features kStanding = SWIVEL_WITH_PLANT | SWIVEL_WITH_RECORD | SWIVEL_POLE_INCOMING |
                                          SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_HAND_YIELDS |
                                          SWIVEL_WITH_GROUND;
    const auto start = [&] {
        shift = swivel_default_shift_def();
        fits = body_limb(joints[0], kFitting), stands = body_limb(joints[1], kStanding);
        groups.assign(3, swivel_default_group_def());
        groups[0].shift = &shift, groups[1].body_limb = &fits, groups[2].body_limb = &stands;
        def = swivel_default_crowd_def();
        def.skeleton = &view, def.body_count = 2;
    };
    const auto refused = [&](const char* words = "") {
        def.groups = groups.data(), def.group_count = static_cast<std::uint32_t>(groups.size());
        swivel_crowd* crowd = nullptr;
        CHECK_REFUSED(swivel_crowd_create(&def, &crowd), SWIVEL_INVALID_ARGUMENT);
        CHECK_THAT(swivel_last_error(), Catch::Contains(words));
        CHECK(crowd == nullptr);
        CHECK(swivel_crowd_bytes(&def) == 0);
    };
    start();
    def.groups = groups.data(), def.group_count = 3;
    Crowd good(def);
    SECTION("two shifts") { groups.push_back(groups[0]), refused("group 3 is a shift, and group 0 too"); }
    SECTION("a shift for no limb") { groups.erase(groups.begin() + 1), refused("group 0 is a body's shift, but no"); }
    SECTION("a limb without a shift") { groups.erase(groups.begin()), refused("but no group is a body's shift"); }
    SECTION("a shift that is also a limb") { groups[0].body_limb = &stands, refused("group 0 has 2 definitions"); }
    SECTION("an axis of no length") { std::ranges::fill(def.up, 0.0f), refused(); }
    SECTION("an axis that is none") { def.up[1] = kNan, refused(); }
    SECTION("features that do not go together")
    {
        for (const swivel_features bad :
             {SWIVEL_WITH_PLANT | SWIVEL_WITH_AIM, SWIVEL_WITH_PLANT_ROTATION | SWIVEL_WITH_HAND,
              SWIVEL_PLANT_BY_MOTION, SWIVEL_WITH_PLANT | SWIVEL_WITH_PLANT_ROTATION,
              SWIVEL_WITH_CAP | SWIVEL_WITH_REACH, SWIVEL_WITH_CAP | SWIVEL_WITH_AIM, SWIVEL_WITH_NEXT_TARGET,
              SWIVEL_WITH_PELVIS_FIT | SWIVEL_WITH_AIM})
            start(), stands.features = bad, refused();
        start(), stands.features &= ~(SWIVEL_WITH_EFFECTOR | SWIVEL_HAND_YIELDS), refused("WITH_EFFECTOR");
        start(), stands.features &= ~SWIVEL_WITH_PLANT, refused("WITH_PLANT");
        for (const swivel_features bad : {SWIVEL_WITH_PLANT, SWIVEL_WITH_PELVIS_FIT, SWIVEL_WITH_CAP}) {
            const swivel_limb_def limb = limbs(1, bad);
            const swivel_group_def free = c_group(limb);
            swivel_crowd* crowd = nullptr;
            const swivel_crowd_def of = def_of(free);
            CHECK_REFUSED(swivel_crowd_create(&of, &crowd), SWIVEL_INVALID_ARGUMENT);
        }
    }
}
