// SPDX-License-Identifier: MIT
//
// The promise: in C++, what is carried can be saved and set back in values of any type, supports change for some
// bodies, and up is +y unless it is given. How feet stand is in test_body_plant.cpp.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "tests/pose_buffer.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kBodies = 20;
constexpr double kSecond = 60;   // frames
constexpr float kWish = -0.12f;  // of the shift: knees well bent

struct Support {
    std::array<double, 3> position{};
    Float4 rotation{0, 0, 0, 1};
};
using Supports = std::vector<Support>;
swivel_supports view(const Supports& supports, std::size_t first = 0)
{
    const std::span<const Support> some = std::span(supports).subspan(first);
    return {.position = stream(some, &Support::position), .rotation = stream(some, &Support::rotation)};
}

// What a solve of a leg gives and starts the next one from.
struct LegState {
    std::array<float, 11> plant;
    std::uint32_t flags;

    bool stands() const { return flags & SWIVEL_PLANTED && plant[9] == 0; }  // nothing fades any more
    bool operator==(const LegState&) const = default;
};
using State = std::pair<std::vector<LegState>, std::vector<Float3>>;  // legs and shifts

// Legs that walk in place.
class Walkers {
public:
    Walkers() : Walkers([](auto&&... given) { return Crowd(given...); }) {}
    explicit Walkers(const Float3& up) : Walkers([&](auto&&... given) { return Crowd(given..., up); }) {}

    void solve(int frame, const Supports& supports = Supports(kBodies))
    {
        std::vector<float> contact;
        for (std::uint32_t n = 0; n < kBodies; ++n) {
            bodies_[n] = posed(frame, n);
            poses_.write(n, bodies_[n]);
            contact.push_back(std::cos(phase(frame, n)) < 0);
        }
        Frame leg, shift;
        leg.in(SWIVEL_CONTACT, stream(contact)).out(SWIVEL_FLAGS, stream(legs_, &LegState::flags));
        leg.out(SWIVEL_PLANT, stream(legs_, &LegState::plant));
        shift.out(SWIVEL_SHIFT, stream(shifts_));
        constexpr auto time = static_cast<float>(1 / kSecond);
        swivel_pose pose = poses_.view();
        std::vector<Float3> places;  // of supports, in floats as the roots are
        for (const Support& each : supports)
            places.push_back(floats(Vector3d(each.position[0], each.position[1], each.position[2])));
        pose.time = {&time, 0};
        pose.support_position = stream(places);
        pose.support_rotation = stream(supports, &Support::rotation);
        CHECK(crowd_.solve({.frames = {leg, shift}, .pose = &pose}) == kBodies);
        CHECK(!crowd_.find(SWIVEL_BAD_INPUT));
    }
    const LegState& leg(std::uint32_t n) const { return legs_[n]; }
    const std::vector<unsigned char>& poses() const { return poses_.bytes; }
    Crowd& crowd() { return crowd_; }

    State state() const
    {
        std::vector<LegState> legs(kBodies);
        std::vector<Float3> shifts(kBodies);
        std::vector<std::array<float, 11>> plants(kBodies);
        std::vector<std::uint32_t> flags(kBodies);
        crowd_.read(SWIVEL_PLANT, 0, plants), crowd_.read(SWIVEL_FLAGS, 0, flags), crowd_.read(SWIVEL_SHIFT, 1, shifts);
        for (std::uint32_t n = 0; n < kBodies; ++n) legs[n] = {plants[n], flags[n]};
        return {legs, shifts};
    }
    void set(const State& state)
    {
        crowd_.write(SWIVEL_PLANT, 0, state.first);  // with flags behind, which are stepped over
        crowd_.write(SWIVEL_SHIFT, 1, state.second);
    }

private:
    template <class Make>
    explicit Walkers(const Make& make)
        : skeleton_{{-1, 0, 1, 2},
                    std::vector<Float4>(4, {0, 0, 0, 1}),
                    {{0, 0, 0}, {0.1f, 0, 0}, {0, -0.45f, 0}, {0, -0.42f, 0}},
                    {{1, 2, 3, {0, 0, -1}, {}}}},
          bodies_(kBodies, {skeleton_.rotations, skeleton_.translations, std::vector<Float3>(4, {1, 1, 1})}),
          poses_({.roots = true, .gap = 8}, bodies_),
          joints_(skeleton_.joints(0)),
          crowd_(make(skeleton_.view(), kBodies,
                      std::array{body_group(joints_, SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT | SWIVEL_WITH_FIT),
                                 fit_group({.drop = 0.3f, .rise = 0.05f, .half = 0.05f, .ahead = 0.3f})}))
    {
        crowd_.write_all(SWIVEL_SHIFT_WISH, 1, kWish);
    }
    static double phase(int frame, std::uint32_t n) { return 2 * std::numbers::pi * (frame / kSecond + 0.07 * n); }
    Body posed(int frame, std::uint32_t n) const
    {
        const double at = phase(frame, n), lift = std::max(0.0, std::cos(at)), bend = 0.2 + 0.6 * lift * lift;
        Body body = bodies_[n];
        const auto about_x = [](double angle) {
            return floats(Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitX())));
        };
        body.rotations[1] = about_x(-0.1 * std::sin(at) - bend / 2);
        body.rotations[2] = about_x(bend);
        body.root_position = floats(Vector3d(n, 0.86 + 0.008 * std::sin(2 * at), 0));
        return body;
    }

    BodySkeleton skeleton_;
    std::vector<Body> bodies_;
    PoseBuffer poses_;
    swivel_limb_joints joints_;
    Crowd crowd_;
    std::vector<LegState> legs_ = std::vector<LegState>(kBodies);
    std::vector<Float3> shifts_ = std::vector<Float3>(kBodies);
};

}  // namespace

TEST_CASE("C++: up is +y unless it is given")
{
    Walkers usual, given({0, 2, 0}), other({0, 0, 1});
    for (Walkers* const each : {&usual, &given, &other})
        for (int frame = 0; frame < 30; ++frame) each->solve(frame);
    CHECK(usual.poses() == given.poses());
    CHECK(usual.crowd().digest() == given.crowd().digest());
    CHECK(usual.crowd().digest() != other.crowd().digest());
}

TEST_CASE("C++: what is carried can be saved and set back, in the same crowd or another")
{
    Walkers walkers, other, anew;
    constexpr int kSaved = 50, kEnd = 80;
    for (int frame = 0; frame < kSaved; ++frame) walkers.solve(frame);
    const State saved = walkers.state();
    std::vector<std::vector<unsigned char>> poses;
    for (int frame = kSaved; frame < kEnd; ++frame) walkers.solve(frame), poses.push_back(walkers.poses());
    const State end = walkers.state();
    CHECK(saved != end);

    for (Walkers* const each : {&walkers, &other, &anew}) {
        if (each != &anew) each->set(saved);
        bool is_same = true;
        for (int frame = kSaved; frame < kEnd; ++frame) {
            each->solve(frame);
            is_same = is_same && each->poses() == poses[static_cast<std::size_t>(frame - kSaved)];
        }
        CHECK(is_same == (each != &anew));
        CHECK((each->state() == end) == (each != &anew));
    }
}

TEST_CASE("C++: supports change for some bodies alone")
{
    Walkers walkers, changed;
    constexpr std::uint32_t kFirst = 4, kCount = 3;
    const Supports ground(kBodies);
    Supports supports(kBodies);
    for (std::uint32_t n = kFirst; n < kFirst + kCount; ++n)
        supports[n] = {{1.0 * n, 0.25, -2}, floats(quat({0.5f, 0.3f, 0.2f * static_cast<float>(n), 0.7f}))};
    for (int frame = 0; frame < 66; ++frame) walkers.solve(frame), changed.solve(frame);
    changed.crowd().change_support(0, kFirst, kCount, view(ground), view(supports, kFirst));
    int standing = 0;
    for (int frame = 66; frame < 85; ++frame) {
        walkers.solve(frame), changed.solve(frame, supports);
        for (std::uint32_t n = 0; n < kBodies; ++n) {
            const bool is_changed = n >= kFirst && n < kFirst + kCount;
            CHECK((walkers.leg(n) == changed.leg(n)) == !is_changed);
            standing += is_changed && changed.leg(n).stands();
        }
    }
    CHECK(standing > 30);
    CHECK_THROWS_WITH(walkers.crowd().change_support(1, 0, 1, {}, {}), Catch::Contains("group 1 does not plant"));
}

TEST_CASE("C++: fields of feet are as wide as they are, and places to come may be doubles")
{
    std::vector<std::array<float, 11>> plants(2);
    std::vector<std::array<double, 3>> places(2);
    Frame frame;
    CHECK_NOTHROW(frame.out(SWIVEL_PLANT, stream(plants)));
    CHECK_NOTHROW(frame.in(SWIVEL_COMING, stream(places)));
    CHECK_THROWS_WITH(frame.out(SWIVEL_SHIFT, stream(plants)), Catch::Contains("11 floats is no value"));
    CHECK_THROWS_WITH(frame.in(SWIVEL_CAP, stream(places)), Catch::Contains("is no position"));
}
