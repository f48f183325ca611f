// SPDX-License-Identifier: MIT
//
// The promise: in C++, crowds that hold something and stand on ground are made as in C, and ground comes by two calls
// or by one that asks, with the same bits. What a callback throws comes out of solve().
#include <catch2/catch.hpp>

#include <atomic>
#include <mutex>

#include "tests/pose_buffer.h"

namespace {

using namespace swivel;
using namespace swivel::test;

enum : std::uint32_t { kHips, kChest, kLeftWrist = 4, kRightWrist = 7, kAnkle = 10 };  // joints
enum : std::uint32_t { kLegGroup, kLeftGroup, kRightGroup, kRifleGroup };              // groups
constexpr int kHoldFrames = 16;
constexpr Float3 kToePoint{0, -0.0625f, 0.125f}, kHeelPoint{0, -0.0625f, -0.0625f};
constexpr swivel_ground kSloped{{kHeelPoint[0], kHeelPoint[1], kHeelPoint[2]}, 0.015625f, 0.03125f, 0.96875f, 0.125f};
constexpr swivel_features kArmFeatures = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND,
                          kLegFeatures = kArmFeatures | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_PLANT | SWIVEL_WITH_GROUND;
constexpr std::array<float, 7> kLeftGrip{0.125f, 0, 0.0625f, 0, 0, 0.25f, 1},
    kRightGrip{-0.125f, 0, 0, 0.125f, 0, 0, 1}, kClasp{0.03125f, -0.0625f, 0, 0, 0.5f, 0, 1};

BodySkeleton holding_figure()
{
    return {{-1, kHips, kChest, 2, 3, kChest, 5, 6, kHips, 8, 9},
            std::vector<Float4>(11, {0, 0, 0, 1}),
            {{0, 0.921875f, 0},
             {0, 0.5f, 0},
             {0.1875f, 0, 0},
             {0.3125f, 0, 0},
             {0.25f, 0, 0},
             {-0.1875f, 0, 0},
             {-0.3125f, 0, 0},
             {-0.25f, 0, 0},
             {0.125f, 0, 0},
             {0, -0.4375f, 0},
             {0, -0.4375f, 0}},
            {{8, 9, kAnkle, {0, 0, -1}, {}}, {2, 3, kLeftWrist, {0, 0, 1}, {}}, {5, 6, kRightWrist, {0, 0, 1}, {}}}};
}

// A plane for each body, through the place from which its root starts.
struct BodySlope {
    float ahead, aside = 0.125f, start;

    explicit BodySlope(std::uint32_t body) : ahead(0.25f * (static_cast<float>(body % 3) - 1)), start(root(body)) {}
    static float root(std::uint32_t body) { return 0.25f * static_cast<float>(body % 20); }
    double height(double x, double z) const { return double(ahead) * z + double(aside) * (x - double(start)); }
    void put(const float (&place)[3], float (&ground)[3], float (&up)[3]) const
    {
        ground[0] = place[0], ground[1] = static_cast<float>(height(double(place[0]), double(place[2])));
        ground[2] = place[2];
        up[0] = -aside, up[1] = 1, up[2] = -ahead;
    }
};
void put_slopes(const Probes& probes)
{
    for (std::size_t n = 0; n < probes.bodies.size(); ++n)
        BodySlope(probes.bodies[n]).put(probes.places[n], probes.grounds[n], probes.normals[n]);
}

struct HoldWish {
    swivel_prop prop{kChest, 0.03125f};
    bool has_rifle = true;  // otherwise the right hand holds the left
    std::uint32_t body_count = 20;
    bool in_c = false;
};

class Holders {
public:
    explicit Holders(const HoldWish& wish = {})
        : wish_(wish),
          bodies_(wish.body_count, {rest(), skeleton_.translations, std::vector<Float3>(11, {1, 1, 1})}),
          poses_({.roots = true, .gap = 8}, bodies_),
          joints_{skeleton_.joints(0), skeleton_.joints(1), skeleton_.joints(2)},
          crowd_(wish.in_c ? made_in_c() : made())
    {
        crowd_.write_all(SWIVEL_EFFECTOR, kLegGroup, kToePoint);
        crowd_.write_all(SWIVEL_GRIP, kRightGroup, wish.has_rifle ? kRightGrip : kClasp);
        if (wish.has_rifle) crowd_.write_all(SWIVEL_GRIP, kLeftGroup, kLeftGrip);
        crowd_.write(wish.has_rifle ? SWIVEL_PROP_PLACE : SWIVEL_TARGET, wish.has_rifle ? kRifleGroup : kLeftGroup,
                     goals());
    }

    // Frames of the animation, whose ground is sampled by solve(holders, job).
    template <class Solve>
    Holders& play(const Solve& solve)
    {
        for (int frame = 0; frame < kHoldFrames; ++frame) {
            swivel_pose pose = posed(frame);
            solve(*this, Job{.pose = &pose});
            CHECK(!crowd_.find(SWIVEL_BAD_INPUT));
        }
        return *this;
    }
    swivel_pose posed(int frame)
    {
        for (std::uint32_t n = 0; n < wish_.body_count; ++n) {
            bodies_[n].rotations[kChest][1] = 0.125f * static_cast<float>(n % 3);
            bodies_[n].root_position = {BodySlope::root(n), 0, 0.0078125f * static_cast<float>(frame)};
            poses_.write(n, bodies_[n]);
        }
        crowd_.write_all(SWIVEL_CONTACT, kLegGroup, frame >= 2 ? 1.0f : 0.0f);
        swivel_pose pose = poses_.view();
        pose.time = {&kFrameTime, 0};
        return pose;
    }
    // Samples at the probes as they are, between two calls.
    void sample()
    {
        std::vector<std::uint32_t> all(wish_.body_count);
        std::vector<Float3> places(all.size()), grounds(all.size()), normals(all.size());
        crowd_.read(SWIVEL_PROBE, kLegGroup, places);
        for (std::uint32_t n = 0; n < all.size(); ++n) {
            float place[3] = {places[n][0], places[n][1], places[n][2]}, ground[3], normal[3];
            BodySlope(n).put(place, ground, normal);
            grounds[n] = {ground[0], ground[1], ground[2]}, normals[n] = {normal[0], normal[1], normal[2]};
        }
        crowd_.write(SWIVEL_GROUND, kLegGroup, grounds);
        crowd_.write(SWIVEL_GROUND_NORMAL, kLegGroup, normals);
    }

    std::vector<Float3> goals() const
    {
        std::vector<Float3> made;
        for (std::uint32_t n = 0; n < wish_.body_count; ++n)
            made.push_back({wish_.has_rifle ? 0 : BodySlope::root(n), wish_.has_rifle ? -0.0625f : 1.375f,
                            0.3125f + 0.015625f * static_cast<float>(n % 20)});
        return made;
    }
    std::uint32_t flags(std::uint32_t group, std::uint32_t n) const
    {
        std::uint32_t one[1];
        crowd_.read(SWIVEL_FLAGS, group, one, n);
        return one[0];
    }
    std::uint32_t size() const { return wish_.body_count; }
    const std::vector<unsigned char>& poses() const { return poses_.bytes; }
    Crowd& crowd() { return crowd_; }
    bool operator==(const Holders& b) const { return poses() == b.poses() && crowd_.digest() == b.crowd_.digest(); }

private:
    static std::vector<Float4> rest()
    {
        return {{0, 0, 0, 1},       {0, 0, 0, 1},         {0, -0.25f, -0.25f, 1}, {0, -0.5f, 0, 1},
                {0, 0, 0, 1},       {0, 0.25f, 0.25f, 1}, {0, 0.5f, 0, 1},        {0, 0, 0, 1},
                {-0.125f, 0, 0, 1}, {0.25f, 0, 0, 1},     {-0.125f, 0, 0, 1}};
    }
    void link(swivel_group_def& leg, swivel_group_def& left, swivel_group_def& right) const
    {
        leg.ground = kSloped;
        left.link = right.link = wish_.has_rifle ? kRifleGroup : kLeftGroup;
        if (!wish_.has_rifle) left.features = kArmFeatures;
    }
    Crowd made() const
    {
        swivel_group_def leg = body_group(joints_[0], kLegFeatures),
                         left = body_group(joints_[1], kArmFeatures | SWIVEL_WITH_LINK),
                         right = body_group(joints_[2], kArmFeatures | SWIVEL_WITH_LINK);
        link(leg, left, right);
        std::vector<swivel_group_def> groups{leg, left, right};
        if (wish_.has_rifle) groups.push_back(prop_group(wish_.prop));
        return {skeleton_.view(), wish_.body_count, groups};
    }
    Crowd made_in_c() const
    {
        swivel_group_def groups[4];
        for (std::size_t g = 0; g < 3; ++g) groups[g] = swivel_default_body_group_def(&joints_[g]);
        groups[kLegGroup].features = kLegFeatures;
        groups[kLeftGroup].features = groups[kRightGroup].features = kArmFeatures | SWIVEL_WITH_LINK;
        link(groups[kLegGroup], groups[kLeftGroup], groups[kRightGroup]);
        groups[kRifleGroup] = swivel_default_prop_group_def();
        groups[kRifleGroup].prop = wish_.prop;
        const swivel_skeleton skeleton = skeleton_.view();
        swivel_crowd_def def = swivel_default_crowd_def();
        def.skeleton = &skeleton, def.body_count = wish_.body_count;
        def.groups = groups, def.group_count = wish_.has_rifle ? 4 : 3;
        return Crowd(def);
    }

    static constexpr float kFrameTime = 0.015625f;
    HoldWish wish_;
    BodySkeleton skeleton_ = holding_figure();
    std::vector<Body> bodies_;
    PoseBuffer poses_;
    std::array<swivel_limb_joints, 3> joints_;
    Crowd crowd_;
};

// The ways to sample the ground.
void by_two_calls(Holders& holders, const Job& job)
{
    Job probes = job;
    probes.probes_only = true;
    const std::vector<unsigned char> before = holders.poses();
    CHECK(holders.crowd().solve(probes) == holders.size());
    CHECK(holders.poses() == before);
    holders.sample();
    CHECK(holders.crowd().solve(job) == holders.size());
}
void by_asking(Holders& holders, const Job& job)
{
    CHECK(holders.crowd().solve({.pose = job.pose, .sample = [](const Probes& probes) { put_slopes(probes); }}) ==
          holders.size());
}
void in_c(Holders& holders, const Job& given)
{
    swivel_job job = swivel_default_job();
    job.pose = given.pose;
    job.probes_only = 1;
    check(swivel_solve(holders.crowd().get(), &job));
    holders.sample();
    job.probes_only = 0;
    check(swivel_solve(holders.crowd().get(), &job));
}

// Bodies on a thread, which sample by what throws at its nth call. Gives how often it was called.
int calls_of_throwing(Holders& holders, int throws_at, bool on_this_thread)
{
    std::atomic<int> calls = 0;
    const auto fails = [&](const Probes& probes) {
        if (++calls >= throws_at) throw std::runtime_error("no ground loaded");
        put_slopes(probes);
    };
    const swivel_pose pose = holders.posed(0);
    CHECK_THROWS_WITH(holders.crowd().solve({.on_this_thread = on_this_thread, .pose = &pose, .sample = fails}),
                      "no ground loaded");
    return calls;
}

}  // namespace

TEST_CASE("C++: what hands hold is made as in C, by calls and by asking, and every constant of it counts")
{
    for (const bool has_rifle : {true, false}) {
        Holders holders({.has_rifle = has_rifle});
        holders.play(by_two_calls);
        for (std::uint32_t n = 0; n < holders.size(); ++n)
            CHECK((holders.flags(kLegGroup, n) & SWIVEL_PLANTED) == SWIVEL_PLANTED);
        CHECK(Holders({.has_rifle = has_rifle}).play(by_asking) == holders);
        CHECK(Holders({.has_rifle = has_rifle, .in_c = true}).play(in_c) == holders);
        if (!has_rifle) continue;
        for (const swivel_prop& other : {swivel_prop{kHips, 0.03125f}, swivel_prop{kChest, 0}, swivel_default_prop()})
            CHECK(!(Holders({.prop = other}).play(by_two_calls) == holders));
    }
}

TEST_CASE("C++: each foot asks once, at its probe, and hears the ground that it has")
{
    Holders holders({.body_count = 300});
    std::mutex one_at_a_time;
    std::vector<int> asked(holders.size());
    std::vector<Float3> places(holders.size());
    const auto counts = [&](const Probes& probes) {
        const std::lock_guard lock(one_at_a_time);
        CHECK(probes.group == kLegGroup);
        CHECK(probes.bodies.size() <= 128);
        for (std::size_t n = 0; n < probes.bodies.size(); ++n) {
            ++asked[probes.bodies[n]];
            places[probes.bodies[n]] = {probes.places[n][0], probes.places[n][1], probes.places[n][2]};
            CHECK(std::isnan(probes.grounds[n][1]));
            CHECK(probes.normals[n][1] == 1);
        }
    };
    const swivel_pose pose = holders.posed(0);
    const Job job{.pose = &pose, .sample = counts};
    CHECK(holders.crowd().solve(job) == holders.size());
    CHECK(asked == std::vector<int>(holders.size(), 1));
    std::vector<Float3> probes(holders.size());
    holders.crowd().read(SWIVEL_PROBE, kLegGroup, probes);
    CHECK(places == probes);

    // A function is called as well as an object is.
    Holders by_function({.body_count = 300}), by_lambda({.body_count = 300});
    by_function.play([](Holders& each, const Job& of) { each.crowd().solve({.pose = of.pose, .sample = put_slopes}); });
    CHECK(by_function == by_lambda.play(by_asking));
    CHECK(!(by_function == holders));
}

TEST_CASE("C++: what a callback throws comes out of solve, which is done, and no more feet have asked")
{
    Holders untold({.body_count = 300});
    const swivel_pose pose = untold.posed(0);
    untold.crowd().solve({.pose = &pose});
    for (const bool on_this_thread : {true, false}) {
        Holders holders({.body_count = 300});
        const int calls = calls_of_throwing(holders, 1, on_this_thread);
        CHECK(calls >= 1);
        if (on_this_thread) CHECK(calls == 1);
        CHECK(holders == untold);

        Holders some({.body_count = 300}), told({.body_count = 300});
        calls_of_throwing(some, 2, on_this_thread);
        const swivel_pose again = told.posed(0);
        told.crowd().solve({.pose = &again, .sample = put_slopes});
        CHECK(!(some == untold));
        CHECK(!(some == told));
        told.play(by_asking);
        CHECK(!told.crowd().find(SWIVEL_BAD_INPUT));
    }
}

TEST_CASE("C++: places of ground are doubles where roots are, and places of a prop on a joint are the joint's")
{
    std::vector<std::uint64_t> digests;
    for (const double far : {0.0, 0x1p33}) {
        Holders holders;
        std::vector<std::array<double, 3>> roots, grounds, places;
        for (std::uint32_t n = 0; n < holders.size(); ++n) {
            roots.push_back({double(BodySlope::root(n)) + far, 0, -far});
            grounds.push_back({roots[n][0], 0.0625, roots[n][2]});
            places.push_back({0, -0.0625, 0.3125});
        }
        Frame leg, prop;
        const Frame arm;
        leg.in(SWIVEL_GROUND, stream(grounds));
        prop.in(SWIVEL_PROP_PLACE, stream(places));
        for (Frame* const each : {&leg, &prop}) each->origin({roots.data(), sizeof roots[0]});
        swivel_pose pose = holders.posed(0);
        pose.root_is_double = 1;
        pose.root_position = pose.support_position = stream(roots);
        CHECK(holders.crowd().solve({.frames = {leg, arm, arm, prop}, .pose = &pose}) == holders.size());
        const std::vector<Float3> as_floats(holders.size());
        Frame narrow;
        narrow.in(SWIVEL_GROUND, stream(as_floats));
        CHECK_THROWS_WITH(holders.crowd().solve({.frames = {narrow, arm, arm, prop}, .pose = &pose}),
                          "frame of group 0: ground is in floats, but the pose has root_is_double; give doubles");
        CHECK(!holders.crowd().find(SWIVEL_BAD_INPUT));
        for (std::uint32_t n = 0; n < holders.size(); ++n) CHECK(holders.flags(kRifleGroup, n) == SWIVEL_REACHED);
        digests.push_back(holders.crowd().digest());
        CHECK_THROWS_WITH(holders.crowd().write_doubles(SWIVEL_PROP_PLACE, kRifleGroup, places, stream(roots)),
                          "group 3, prop_place: it is in a joint's frame here, which has no origin; give null");
        CHECK_NOTHROW(holders.crowd().write_doubles(SWIVEL_PROP_PLACE, kRifleGroup, places));
    }
    CHECK(digests[0] == digests[1]);
}

TEST_CASE("C++: what a job says of probes is refused where no group has them")
{
    Holders holders;
    const swivel_pose pose = holders.posed(0);
    const Job arms{.groups = {kLeftGroup, kRightGroup, kRifleGroup}, .pose = &pose, .probes_only = true};
    CHECK_THROWS_WITH(holders.crowd().solve(arms), Catch::Contains("names no group that is SWIVEL_WITH_GROUND"));
    CHECK_THROWS_WITH(holders.crowd().solve({.pose = &pose, .probes_only = true, .sample = put_slopes}),
                      Catch::Contains("probes_only does not call it"));
    CHECK_THROWS_WITH(Holders({.prop = {11, 1}}), Catch::Contains("prop.joint is 11"));
}
