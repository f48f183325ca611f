// SPDX-License-Identifier: MIT
//
// The promise: a crowd far from the origin is as exact as one near it, through writes and through frames. Its positions
// are doubles, from which an origin is subtracted before they are rounded. Plain floats there are not exact.
#include "tests/solve_jobs.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_limb.h"

#include <rapidcheck/catch.h>
#include <array>
#include <bit>
#include <cfenv>
#include <cmath>

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr double kFar = 1e7;
constexpr swivel_features kFeatureSets[] = {SWIVEL_WORLD, SWIVEL_WORLD | SWIVEL_WITH_HAND, SWIVEL_WORLD | SWIVEL_JOINTS,
                                            SWIVEL_WORLD | SWIVEL_POLE_DIRECTION};

using Double3 = std::array<double, 3>;

// A limb's positions in the world, in double; the rest in floats.
struct FarLimb {
    Double3 target, pole, position, origin;
    Limb rest;
};

Double3 doubles(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Vector3d vec(const Double3& v) { return Vector3d(v.data()); }
using test::vec;

// Multiples of 2^-20 below 2^4 keep all their digits 1e7 away: a double there counts in steps of 2^-29.
Float3 on_grid(const Float3& v)
{
    Float3 grid;
    for (std::size_t c = 0; c < 3; ++c) grid[c] = static_cast<float>(std::round(double{v[c]} * 0x1p20) * 0x1p-20);
    return grid;
}

Limb grid_limb(Random& random, swivel_features features)
{
    Limb limb = random_limb(random, features, {1, 1.25f});
    limb.scale[0] = 1;
    if (!(features & SWIVEL_POLE_DIRECTION)) limb.pole = floats(Vector3d(vec(limb.position) + random.direction()));
    const Vector3d reach = random.between(0.3, 2.2) * random.direction();
    limb.target = on_grid(floats(Vector3d(vec(limb.position) + reach)));
    limb.pole = on_grid(limb.pole);
    limb.position = on_grid(limb.position);
    return limb;
}

void write_rest(Crowd& crowd, std::uint32_t n, const Limb& limb)
{
    crowd.write(SWIVEL_LENGTHS, 0, std::span(&limb.lengths, 1), n);
    crowd.write(SWIVEL_PARENT_ROTATION, 0, std::span(&limb.rotation, 1), n);
    crowd.write(SWIVEL_PARENT_SCALE, 0, std::span(&limb.scale, 1), n);
    if (swivel_field_row_count(crowd.get(), 0, SWIVEL_HAND)) crowd.write(SWIVEL_HAND, 0, std::span(&limb.hand, 1), n);
}

// The limbs' positions from their origins.
void write_far(Crowd& crowd, swivel_features features, const std::vector<FarLimb>& limbs)
{
    const swivel_in origins{&limbs[0].origin, sizeof limbs[0]};
    const auto count = static_cast<std::uint32_t>(limbs.size());
    const auto put = [&](swivel_field field, const Double3 FarLimb::*member, swivel_in from) {
        check(swivel_write_doubles(crowd.get(), field, 0, 0, count, {&(limbs[0].*member), sizeof limbs[0]}, from));
    };
    put(SWIVEL_TARGET, &FarLimb::target, origins);
    put(SWIVEL_POLE, &FarLimb::pole, features & SWIVEL_POLE_DIRECTION ? swivel_in{} : origins);
    put(SWIVEL_SHOULDER_POSITION, &FarLimb::position, origins);
    for (std::uint32_t n = 0; n < count; ++n) write_rest(crowd, n, limbs[n].rest);
}

}  // namespace

TEST_CASE("exact shifts, of each limb or of all, give the bits of home, whichever way they are given")
{
    const std::uint32_t count = 200;
    for (const swivel_features features : kFeatureSets)
        for (const bool one_for_all : {false, true}) {
            INFO("features " << features << ", one for all " << one_for_all);
            const swivel_group_def group = group_of(count);
            Crowd home = crowd_with(features, {&group, 1}), far = crowd_with(features, {&group, 1}),
                  framed = crowd_with(features, {&group, 1});
            Random random{features};
            std::vector<FarLimb> limbs;
            for (std::uint32_t n = 0; n < count; ++n) {
                const Limb limb = grid_limb(random, features);
                write_limb(home, 0, n, limb);
                const Vector3d shift = Vector3d(kFar, -kFar, 0.5 * kFar) + (one_for_all ? 0 : n) * Vector3d(1, 7, -9);
                const Vector3d pole = vec(limb.pole);
                limbs.push_back({doubles(shift + vec(limb.target)),
                                 doubles(features & SWIVEL_POLE_DIRECTION ? pole : Vector3d(shift + pole)),
                                 doubles(shift + vec(limb.position)), doubles(shift), limb});
                write_rest(framed, n, limb);
            }
            home.solve();
            write_far(far, features, limbs);
            far.solve();
            CHECK(all_words(far) == all_words(home));
            CHECK(all_words(far) == all_words(home));

            Frame frame;
            frame.in(SWIVEL_TARGET, {&limbs[0].target, sizeof limbs[0]});
            frame.in(SWIVEL_POLE, {&limbs[0].pole, sizeof limbs[0]});
            frame.in(SWIVEL_SHOULDER_POSITION, {&limbs[0].position, sizeof limbs[0]});
            frame.origin({&limbs[0].origin, one_for_all ? 0 : sizeof limbs[0]});
            framed.solve({.frames = {frame}});
            CHECK(all_words(framed) == all_words(home));
            CHECK(all_words(framed) == all_words(home));
        }
}

TEST_CASE("without a world the origin is the shoulder's place")
{
    const std::uint32_t count = 40;
    Crowd home = crowd_of(0, count), far = crowd_of(0, count);
    Random random{2};
    const Double3 shoulder = {kFar, 3 * kFar, -kFar};
    for (std::uint32_t n = 0; n < count; ++n) {
        const Float3 target = on_grid(floats(random.direction())), pole = on_grid(floats(random.direction()));
        home.write(SWIVEL_TARGET, 0, std::span(&target, 1), n);
        home.write(SWIVEL_POLE, 0, std::span(&pole, 1), n);
        const Double3 there[] = {doubles(vec(shoulder) + vec(target)), doubles(vec(shoulder) + vec(pole))};
        far.write_doubles(SWIVEL_TARGET, 0, std::span(&there[0], 1), {&shoulder, 0}, n);
        far.write_doubles(SWIVEL_POLE, 0, std::span(&there[1], 1), {&shoulder, 0}, n);
    }
    home.solve();
    far.solve();
    CHECK(all_words(far) == all_words(home));
}

TEST_CASE("any shift: wrists within 1e-6 of the arm, which floats out there are not")
{
    const std::uint32_t count = 2000;
    const swivel_features features = SWIVEL_WORLD;
    Random random{3};
    const swivel_group_def group = group_of(count);
    enum { at_shoulder, near, in_floats };
    for (const int from : {at_shoulder, near, in_floats}) {
        INFO("from " << from);
        Crowd crowd = crowd_with(features, {&group, 1});
        std::vector<FarLimb> limbs;
        for (std::uint32_t n = 0; n < count; ++n) {
            Limb limb = random_limb(random, features, {0.3f, 0.26f});
            limb.scale[0] = 1;
            const Vector3d shoulder = kFar * random.direction() + random.between(0, 1) * random.direction();
            const Vector3d line = random.direction();
            const Vector3d target = shoulder + random.between(0.1, 0.5) * line;
            const Vector3d pole = shoulder + random.between(0.2, 0.5) * random.across(line);
            const Vector3d origin = shoulder + (from == near ? 0.5 : 0.0) * random.direction();
            limbs.push_back({doubles(target), doubles(pole), doubles(shoulder), doubles(origin), limb});
            if (from == in_floats) {
                limb.target = floats(target);
                limb.pole = floats(pole);
                limb.position = floats(shoulder);
                write_limb(crowd, 0, n, limb);
            }
        }
        if (from != in_floats) write_far(crowd, features, limbs);
        crowd.solve();
        const auto shoulders = read<Float4>(crowd, SWIVEL_SHOULDER);
        const auto elbows = read<Float2>(crowd, SWIVEL_ELBOW);
        double worst = 0, least_bend_side = 1;
        for (std::uint32_t n = 0; n < count; ++n) {
            // From the shoulder, so that the check itself rounds little.
            const FarLimb& limb = limbs[n];
            Limb home = limb.rest;
            home.position = {0, 0, 0};
            const Places places = places_of(home, shoulders[n], elbows[n], {0, 0, 0, 1});
            const Vector3d to_target = vec(limb.target) - vec(limb.position);
            const Vector3d to_pole = vec(limb.pole) - vec(limb.position);
            const double length = double{home.lengths[0]} + home.lengths[1];
            worst = std::max(worst, (places.wrist - to_target).norm() / length);
            const Vector3d line = to_target.normalized();
            least_bend_side = std::min(least_bend_side, places.elbow.dot(to_pole - to_pole.dot(line) * line));
        }
        INFO("worst " << worst);
        if (from == in_floats) {
            CHECK(worst > 0.1);
            CHECK(least_bend_side < 0);
        } else {
            CHECK(worst <= 1e-6);
            CHECK(least_bend_side > 0);
        }
    }
}

TEST_CASE("forward kinematics and residuals are from the origin, too")
{
    Crowd crowd = crowd_of(SWIVEL_WORLD, 1);
    const Double3 origin[] = {{kFar, 0, 0}}, target[] = {{kFar + 1, 0.5, 0}}, shoulder[] = {{kFar, 0.25, 0}};
    crowd.write_doubles(SWIVEL_TARGET, 0, target, {origin, 0});
    crowd.write_doubles(SWIVEL_SHOULDER_POSITION, 0, shoulder, {origin, 0});
    crowd.solve();
    std::vector<Double3> wrist(1);
    std::vector<double> off(1);
    crowd.wrists(0, wrist);
    crowd.residuals(0, off);
    CHECK((vec(wrist[0]) - Vector3d(1, 0.5, 0)).norm() < 2e-6);
    CHECK(off[0] < 1e-6);
}

TEST_CASE("rows hold the difference, rounded once, for any stride, place and rounding mode")
{
    rc::prop("random doubles", [](std::uint64_t seed) {
        Random random{seed};
        const std::uint32_t count = 1 + random.below(70);
        Crowd crowd = crowd_of(SWIVEL_WORLD, count);
        const std::uint32_t first = random.below(count), limbs = random.below(count - first + 1);
        const swivel_field fields[] = {SWIVEL_TARGET, SWIVEL_POLE, SWIVEL_SHOULDER_POSITION};
        const swivel_field field = fields[random.below(3)];
        const std::size_t stride = 24 + random.below(20), origin_stride = random.below(2) ? 24 + random.below(20) : 0;
        const bool with_origin = random.below(4) > 0;
        std::vector<unsigned char> values(3 + limbs * stride), origins(3 + limbs * origin_stride + 24);
        unsigned char *const value = values.data() + random.below(4), *const origin = origins.data() + random.below(4);
        std::vector<float> expected;
        const auto far = [&] { return random.spread(1e-3, 1e9) * (random.below(2) ? 1 : -1); };
        Double3 from;
        for (std::uint32_t n = 0; n < limbs; ++n) {
            if (n == 0 || origin_stride > 0)
                for (double& x : from) x = far();
            Double3 at;
            for (std::size_t c = 0; c < 3; ++c) {
                at[c] = random.below(2) ? from[c] + random.between(-3, 3) : far();
                expected.push_back(static_cast<float>(with_origin ? at[c] - from[c] : at[c]));
            }
            if (n + 1 < limbs || stride >= 24) std::memcpy(value + n * stride, &at, sizeof at);
            std::memcpy(origin + n * origin_stride, &from, sizeof from);
        }
        const auto before = read<Float3>(crowd, field);
        const int modes[] = {FE_TONEAREST, FE_UPWARD, FE_TOWARDZERO};
        const int mode = modes[random.below(3)];
        std::fesetround(mode);
        const swivel_status status = swivel_write_doubles(crowd.get(), field, 0, first, limbs, {value, stride},
                                                          with_origin ? swivel_in{origin, origin_stride} : swivel_in{});
        const int mode_after = std::fegetround();
        std::fesetround(FE_TONEAREST);
        RC_ASSERT(status == SWIVEL_OK);
        RC_ASSERT(mode_after == mode);
        const auto after = read<Float3>(crowd, field);
        for (std::uint32_t n = 0; n < count; ++n)
            for (std::size_t c = 0; c < 3; ++c) {
                const bool written = n >= first && n < first + limbs;
                const float wanted = written ? expected[(n - first) * 3 + c] : before[n][c];
                RC_ASSERT(std::bit_cast<std::uint32_t>(after[n][c]) == std::bit_cast<std::uint32_t>(wanted));
            }
    });
}

TEST_CASE("doubles that no float holds are bad input of their own limb")
{
    Crowd crowd = crowd_of(SWIVEL_WORLD, 4);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Double3 targets[] = {{0, 0, 1}, {1e300, 0, 0}, {0, nan, 0}, {0, 1, 1}};
    crowd.write_doubles(SWIVEL_TARGET, 0, targets);
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    CHECK(flags == std::vector<std::uint32_t>{SWIVEL_REACHED, SWIVEL_BAD_INPUT, SWIVEL_BAD_INPUT, SWIVEL_REACHED});
}

TEST_CASE("wrong doubles are refused with one line and change nothing")
{
    const swivel_group_def group = group_of(5);
    Crowd points = crowd_with(SWIVEL_WORLD | SWIVEL_WITH_HAND, {&group, 1}), plain = crowd_with(0, {&group, 1}),
          directions = crowd_with(SWIVEL_WORLD | SWIVEL_POLE_DIRECTION, {&group, 1});
    swivel_crowd* const c = points.get();
    double values[] = {5, 6, 7};
    const swivel_in good{values, 0}, none{}, narrow{values, 23};
    const auto before = all_words(points), before_directions = all_words(directions);
    const auto bad = SWIVEL_INVALID_ARGUMENT;
    CHECK_REFUSED(swivel_write_doubles(nullptr, SWIVEL_TARGET, 0, 0, 1, good, good), bad);
    CHECK_REFUSED(swivel_write_doubles(c, SWIVEL_TARGET, 1, 0, 1, good, good), bad);
    CHECK_REFUSED(swivel_write_doubles(c, SWIVEL_TARGET, 0, 4, 2, good, good), bad);
    CHECK_REFUSED(swivel_write_doubles(c, SWIVEL_TARGET, 0, 0, 1, none, good), bad);
    CHECK_REFUSED(swivel_write_doubles(c, SWIVEL_TARGET, 0, 0, 1, narrow, good), bad);
    CHECK_REFUSED(swivel_write_doubles(c, SWIVEL_TARGET, 0, 0, 1, good, narrow), bad);
    CHECK(std::string(swivel_last_error()) == "group 0, origin: stride 23 is smaller than a value, 24 bytes");
    for (const swivel_field field : {SWIVEL_LENGTHS, SWIVEL_PARENT_ROTATION, SWIVEL_PARENT_SCALE, SWIVEL_HAND,
                                     SWIVEL_SHOULDER, SWIVEL_FLAGS, SWIVEL_INPUT_END})
        CHECK_REFUSED(swivel_write_doubles(c, field, 0, 0, 1, good, none), bad);
    swivel_write_doubles(c, SWIVEL_LENGTHS, 0, 0, 1, good, none);
    CHECK(std::string(swivel_last_error()) ==
          "group 0, lengths: not a position; doubles are for target, pole and shoulder_position");
    CHECK_REFUSED(swivel_write_doubles(plain.get(), SWIVEL_SHOULDER_POSITION, 0, 0, 1, good, good), bad);
    CHECK_REFUSED(swivel_write_doubles(directions.get(), SWIVEL_POLE, 0, 0, 1, good, good), bad);
    CHECK(std::string(swivel_last_error()) == "group 0, pole: it is a direction here, which has no origin; give null");
    CHECK(all_words(directions) == before_directions);
    CHECK(swivel_write_doubles(directions.get(), SWIVEL_POLE, 0, 0, 1, good, none) == SWIVEL_OK);
    CHECK(read<Float3>(directions, SWIVEL_POLE)[0] == Float3{5, 6, 7});

    swivel_frame frame = swivel_default_frame();
    frame.origin = narrow;
    CHECK_REFUSED(solve_frame(c, &frame), bad);
    frame.origin = good;
    swivel_frame_field target{SWIVEL_TARGET, values, 12};  // enough for floats
    frame.fields = &target;
    frame.field_count = 1;
    CHECK_REFUSED(solve_frame(c, &frame), bad);
    CHECK(std::string(swivel_last_error()) == "group 0, target: stride 12 is smaller than a value, 24 bytes");
    CHECK(all_words(points) == before);
    target.stride = 0;
    CHECK(solve_frame(c, &frame) == SWIVEL_OK);
    CHECK(read<Float3>(points, SWIVEL_TARGET)[4] == Float3{0, 0, 0});
}
