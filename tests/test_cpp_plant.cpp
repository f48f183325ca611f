// SPDX-License-Identifier: MIT
//
// The promise: in C++, feet stand on their supports while they are labelled, whatever axis is up. What is carried can
// be saved and set back, and supports change without a jump. Judged by a forward kinematics of the solved poses.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "tests/pose_buffer.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kBodies = 20, kFoot = 3;
constexpr double kSecond = 60;  // frames
constexpr double kLeg = 0.87;
constexpr float kWish = -0.12f;  // of the shift: knees well bent

struct Support {
    std::array<double, 3> position{};
    Float4 rotation{0, 0, 0, 1};

    Vector3d from_world(const Vector3d& p) const { return quat(rotation).normalized().inverse() * (p - place()); }
    Vector3d place() const { return {position[0], position[1], position[2]}; }
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

// Legs that walk in place, some of them on platforms that drift and turn.
class Walkers {
public:
    explicit Walkers(const Float3& up) : Walkers(up, [&](auto&&... given) { return Crowd(given..., up); }) {}
    static Walkers with_usual_up()
    {
        return {{0, 1, 0}, [](auto&&... given) { return Crowd(given...); }};
    }

    // Solves a frame of the walk. Other supports may be given for the ground.
    void solve(int frame, const Supports& supports)
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
        for (const Support& each : supports) places.push_back(floats(each.place()));
        pose.time = {&time, 0};
        pose.support_position = stream(places);
        pose.support_rotation = stream(supports, &Support::rotation);
        CHECK(crowd_.solve({.frames = {leg, shift}, .pose = &pose}) == kBodies);
        CHECK(!crowd_.find(SWIVEL_BAD_INPUT));
    }
    void solve(int frame) { solve(frame, supports(frame)); }

    Supports supports(int frame) const
    {
        Supports made(kBodies);
        for (std::uint32_t n = 0; n < kBodies; ++n) {
            const double t = n % 2 ? frame / kSecond : 0;
            const Vector3d place = turn_ * Vector3d(n + 0.05 * t, 0.01 * t, 0);
            made[n].position = {place.x(), place.y(), place.z()};
            made[n].rotation = floats(turn_ * Eigen::AngleAxisd(0.05 * t, Vector3d::UnitY()) * turn_.conjugate());
        }
        return made;
    }

    // Where the foot is in the world: the root is shifted, too.
    Vector3d foot(std::uint32_t n) const
    {
        const Body solved = poses_.read(n, bodies_[n]);
        const Vector3d shift = turn_ * Vector3d(0, shifts_[n][0], 0);
        return joints_at(skeleton_, solved)[kFoot].place + vec(solved.root_position) + shift;
    }
    const LegState& leg(std::uint32_t n) const { return legs_[n]; }
    float shift(std::uint32_t n) const { return shifts_[n][0]; }
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
    Walkers(const Float3& up, const Make& make)
        : turn_(turn_between(Vector3d::UnitY(), vec(up))),
          skeleton_{{-1, 0, 1, 2}, std::vector<Float4>(4, {0, 0, 0, 1}), places(), {{1, 2, kFoot, ahead(), {}}}},
          bodies_(kBodies, {skeleton_.rotations, skeleton_.translations, std::vector<Float3>(4, {1, 1, 1})}),
          poses_({.roots = true, .gap = 8}, bodies_),
          joints_(skeleton_.joints(0)),
          crowd_(make(skeleton_.view(), kBodies,
                      std::array{body_group(joints_, SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT | SWIVEL_WITH_FIT),
                                 fit_group({.drop = 0.3f, .rise = 0.05f, .half = 0.05f, .ahead = 0.3f})}))
    {
        crowd_.write_all(SWIVEL_SHIFT_WISH, 1, kWish);
    }
    std::vector<Float3> places() const
    {
        std::vector<Float3> made;
        for (const Vector3d& v : {Vector3d(0, 0, 0), {0.1, 0, 0}, {0, -0.45, 0}, {0, -0.42, 0}})
            made.push_back(floats(turn_ * v));
        return made;
    }
    Float3 ahead() const { return floats(turn_ * Vector3d(0, 0, -1)); }  // where a knee's flexion carries the shin
    static double phase(int frame, std::uint32_t n) { return 2 * std::numbers::pi * (frame / kSecond + 0.07 * n); }
    Body posed(int frame, std::uint32_t n) const
    {
        const double at = phase(frame, n), lift = std::max(0.0, std::cos(at)), bend = 0.2 + 0.6 * lift * lift;
        Body body = bodies_[n];
        const auto about_x = [&](double angle) {
            return floats(turn_ * Eigen::AngleAxisd(angle, Vector3d::UnitX()) * turn_.conjugate());
        };
        body.rotations[1] = about_x(-0.1 * std::sin(at) - bend / 2);
        body.rotations[2] = about_x(bend);
        body.root_position = floats(turn_ * Vector3d(n, 0.86 + 0.008 * std::sin(2 * at), 0));
        return body;
    }

    Quaterniond turn_;  // from a world with +y up
    BodySkeleton skeleton_;
    std::vector<Body> bodies_;
    PoseBuffer poses_;
    swivel_limb_joints joints_;
    Crowd crowd_;
    std::vector<LegState> legs_ = std::vector<LegState>(kBodies);
    std::vector<Float3> shifts_ = std::vector<Float3>(kBodies);
};

void check_standing(Walkers walkers)
{
    std::vector<std::optional<Vector3d>> stood(kBodies);
    int standing = 0, released = 0, lowered = 0;
    double worst = 0;
    for (int frame = 0; frame < 180; ++frame) {
        walkers.solve(frame);
        const Supports supports = walkers.supports(frame);
        for (std::uint32_t n = 0; n < kBodies; ++n) {
            const LegState& leg = walkers.leg(n);
            released += (leg.flags & SWIVEL_RELEASED) != 0;
            if (!leg.stands()) {
                stood[n].reset();
                continue;
            }
            CHECK(leg.flags & SWIVEL_REACHED);
            const Vector3d now = supports[n].from_world(walkers.foot(n));
            if (!stood[n]) stood[n] = now;
            worst = std::max(worst, (now - *stood[n]).norm());
            lowered += walkers.shift(n) < 0.9f * kWish;
            ++standing;
        }
    }
    CHECK(worst < 3e-6 * kLeg + 1.2e-6);  // of a solve, and of the rounding of places 20 m from the origin
    CHECK(standing > 900);
    CHECK(released > 30);
    CHECK(lowered == standing);
}

}  // namespace

TEST_CASE("C++: while a foot is planted, it does not move on its support")
{
    check_standing(Walkers::with_usual_up());
    check_standing(Walkers({0, 0, 2}));
}

TEST_CASE("C++: what is carried can be saved and set back, in the same crowd or another")
{
    Walkers walkers({0, 1, 0}), other({0, 1, 0}), anew({0, 1, 0});
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

TEST_CASE("C++: a changed support moves no foot")
{
    Walkers walkers({0, 1, 0}), changed({0, 1, 0});
    constexpr std::uint32_t kFirst = 4, kCount = 3;
    constexpr int kChange = 66;
    int standing = 0;
    for (int frame = 0; frame < 85; ++frame) {
        const Supports ground(kBodies);
        Supports supports(kBodies);
        for (std::uint32_t n = kFirst; n < kFirst + kCount; ++n)
            supports[n] = {{1.0 * n, 0.25, -2}, floats(quat({0.5f, 0.3f, 0.2f * static_cast<float>(n), 0.7f}))};
        if (frame == kChange) changed.crowd().change_support(0, kFirst, kCount, view(ground), view(supports, kFirst));
        walkers.solve(frame, ground);
        changed.solve(frame, frame < kChange ? ground : supports);
        for (std::uint32_t n = 0; n < kBodies; ++n) {
            const bool is_changed = frame >= kChange && n >= kFirst && n < kFirst + kCount;
            CHECK((walkers.foot(n) - changed.foot(n)).norm() <= (is_changed ? 2e-6 : 0));
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
