// SPDX-License-Identifier: MIT
//
// The promise: an axis or a pair of cosine and sine whose squared length is not 1 within 1e-6 is bad input, and
// explain says how long it is. What swivel_cone(), swivel_range(), swivel_aim() and swivel_turn() make is always valid.
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// Consecutive numbers of a field that must have unit length together.
struct UnitPart {
    swivel_field field;
    swivel_features features;
    std::uint32_t first, size;
};
std::vector<UnitPart> every_part()
{
    std::vector<UnitPart> parts = {
        {SWIVEL_SHOULDER_CONE, SWIVEL_WITH_SHOULDER_CONE, 0, 3},
        {SWIVEL_HAND_CONE, SWIVEL_WITH_HAND | SWIVEL_WITH_HAND_CONE, 0, 3},
        {SWIVEL_HAND_TWIST, SWIVEL_WITH_HAND | SWIVEL_WITH_HAND_TWIST, 0, 3},
        {SWIVEL_HAND_TWIST, SWIVEL_WITH_HAND | SWIVEL_WITH_HAND_TWIST, 3, 2},
        {SWIVEL_HAND_TWIST, SWIVEL_WITH_HAND | SWIVEL_WITH_HAND_TWIST, 5, 2},
        {SWIVEL_AIM, SWIVEL_WITH_AIM, 0, 3},
        {SWIVEL_AIM, SWIVEL_WITH_AIM, 3, 2},
        {SWIVEL_MOST_SWIVEL, SWIVEL_WITH_MOST_SWIVEL, 0, 2},
    };
    for (const std::uint32_t first : {0u, 2u}) {
        parts.push_back({SWIVEL_HUMERAL_TWIST, SWIVEL_WITH_HUMERAL_TWIST, first, 2});
        parts.push_back({SWIVEL_FOREARM_TWIST, SWIVEL_WITH_HAND | SWIVEL_WITH_FOREARM_TWIST, first, 2});
    }
    for (std::uint32_t first = 0; first < 12; first += 2) {
        parts.push_back({SWIVEL_SHOULDER_BOX, SWIVEL_WITH_SHOULDER_BOX, first, 2});
        parts.push_back({SWIVEL_WRIST_BOX, SWIVEL_WITH_HAND | SWIVEL_WITH_WRIST_BOX, first, 2});
    }
    return parts;
}

// An axis of any length, often with components that vanish in the others.
Vector3d any_axis(Random& random)
{
    Vector3d axis = random.direction();
    if (random.below(2)) axis[random.below(3)] *= random.spread(1e-12, 1);
    return random.spread(1e-30, 1e30) * axis;
}
// An angle from 0 to most, often next to an end or a right angle.
double any_angle(Random& random, double most)
{
    const double angle = random.below(2) ? random.between(0, most) : kPi / 2 * random.below(3);
    return std::clamp(angle + random.spread(1e-12, 1e-2) * random.between(-1, 1), 0.0, most);
}
void make_range(Random& random, float* range)
{
    const double middle = 4 * any_angle(random, kPi) - 2 * kPi, half = any_angle(random, kPi);
    REQUIRE(swivel_range(middle - half, middle + half, range) == SWIVEL_OK);
}
// A value from the library's own functions.
Float12 made_value(Random& random, swivel_field field)
{
    Float12 value = {};
    const Vector3d axis = any_axis(random);
    switch (field) {
        case SWIVEL_SHOULDER_CONE:
        case SWIVEL_HAND_CONE:
            REQUIRE(swivel_cone(axis.data(), any_angle(random, kPi), value.data()) == SWIVEL_OK);
            break;
        case SWIVEL_HAND_TWIST:
            REQUIRE(swivel_cone(axis.data(), 1, value.data()) == SWIVEL_OK);
            make_range(random, value.data() + 3);
            break;
        case SWIVEL_AIM:
            REQUIRE(swivel_aim(axis.data(), any_angle(random, kPi), value.data()) == SWIVEL_OK);
            break;
        case SWIVEL_MOST_SWIVEL:
            swivel_turn(any_angle(random, 3.14159), value.data());
            break;
        case SWIVEL_HUMERAL_TWIST:
        case SWIVEL_FOREARM_TWIST:
            make_range(random, value.data());
            break;
        default:  // boxes
            for (std::size_t n = 0; n < 12; n += 4) make_range(random, value.data() + n);
    }
    return value;
}

std::vector<std::uint32_t> flags_of(const UnitPart& part, const std::vector<Float12>& values,
                                    const swivel_binding& binding = {})
{
    const auto count = static_cast<std::uint32_t>(values.size());
    const swivel_features joints = binding.lengths[0] > 0 ? SWIVEL_JOINTS : 0;
    Crowd crowd = crowd_of(part.features | joints, count, binding);
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.2f, 0.3f, 0.6f});
    REQUIRE(swivel_write(crowd.get(), part.field, 0, 0, count, {values.data(), sizeof values[0]}) == SWIVEL_OK);
    crowd.solve();
    return read<std::uint32_t>(crowd, SWIVEL_FLAGS);
}

}  // namespace

TEST_CASE("an axis or pair whose squared length is not 1 within 1e-6 is bad input")
{
    Random random{1};
    for (const UnitPart& part : every_part()) {
        INFO("field " << part.field << ", from " << part.first);
        std::vector<Float12> values;
        std::vector<double> off;
        while (values.size() < 400) {
            Float12 value = made_value(random, part.field);
            const double length = std::sqrt(1 + random.spread(1e-8, 1e-2) * (random.below(2) ? 1 : -1));
            double length2 = 0;
            for (std::uint32_t c = part.first; c < part.first + part.size; ++c) {
                value[c] = static_cast<float>(length * double{value[c]});
                length2 += double{value[c]} * double{value[c]};
            }
            values.push_back(value);
            off.push_back(std::fabs(length2 - 1));
        }
        const auto flags = flags_of(part, values);
        int good = 0, bad = 0;
        for (std::size_t n = 0; n < values.size(); ++n) {
            INFO("off by " << off[n]);
            const bool is_bad = flags[n] & SWIVEL_BAD_INPUT;
            if (off[n] < 7.5e-7) CHECK_FALSE(is_bad);  // 2e-7 and more from 1e-6: floats sum that well
            if (off[n] > 1.25e-6) CHECK(is_bad);
            good += off[n]<7.5e-7, bad += off[n]> 1.25e-6;
        }
        CHECK(good > 50);
        CHECK(bad > 50);
    }
}

TEST_CASE("axes and pairs that the library makes from angles are valid, for joints of a skeleton, too")
{
    Random random{2};
    constexpr std::size_t count = 20'000;
    for (const UnitPart& part : every_part()) {
        if (part.first != 0) continue;  // once for each field
        INFO("field " << part.field);
        for (const bool joints : {false, true}) {
            std::vector<Float12> values;
            for (std::size_t n = 0; n < count; ++n) values.push_back(made_value(random, part.field));
            for (std::size_t n = 0; n < count; n += 2) {  // half of them as the other side has them
                float* const value = values[n].data();
                REQUIRE(swivel_mirror(part.field, SWIVEL_XYZ, value, value) == SWIVEL_OK);
            }
            const auto flags = flags_of(part, values, joints ? chained(random).bound : swivel_default_binding());
            CHECK(std::ranges::count_if(flags, [](std::uint32_t f) { return (f & SWIVEL_BAD_INPUT) != 0; }) == 0);
        }
    }
}

TEST_CASE("limits hold to 3e-6 of a cosine with axes and pairs as far from unit length as is valid")
{
    constexpr std::uint32_t count = 20'000;
    constexpr swivel_features features = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST;
    Random random{4};
    Crowd crowd = crowd_of(features, count);
    std::vector<Float4> cones, twists;
    for (std::uint32_t n = 0; n < count; ++n) {
        write_limb(crowd, 0, n, random_limb(random, features, {1, 1}));
        const auto scaled = [&](float* part, int size) {
            for (int c = 0; c < size; ++c) part[c] *= random.below(2) ? 1.0000004f : 0.9999996f;
        };
        Float4 cone =
            swivel::cone({random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}, random.between(0.1, 3));
        Float4 twist;
        make_range(random, twist.data());
        scaled(cone.data(), 3);
        scaled(twist.data(), 2);
        scaled(twist.data() + 2, 2);
        cones.push_back(cone);
        twists.push_back(twist);
    }
    crowd.write(SWIVEL_SHOULDER_CONE, 0, cones);
    crowd.write(SWIVEL_HUMERAL_TWIST, 0, twists);
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    const auto shoulders = read<Float4>(crowd, SWIVEL_SHOULDER);
    const Vector3d e3 = Vector3d::UnitZ();
    double worst = -1;
    int limited = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        REQUIRE_FALSE(flags[n] & SWIVEL_BAD_INPUT);
        if (flags[n] & SWIVEL_INFEASIBLE) continue;
        const Quaterniond q = quat(shoulders[n]).normalized();
        const Float4 &cone = cones[n], &twist = twists[n];
        const AngleRange range{std::atan2(double{twist[1]}, double{twist[0]}),
                               std::atan2(double{twist[3]}, double{twist[2]})};
        const Vector3d axis = Vector3d(cone[0], cone[1], cone[2]).normalized();
        worst = std::max({worst, cone_violation(axis, double{cone[3]}, q * e3), twist_violation(e3, range, q)});
        limited += (flags[n] & (SWIVEL_LIMITED_SHOULDER_CONE | SWIVEL_LIMITED_HUMERAL_TWIST)) != 0;
    }
    CHECK(worst <= 3e-6);
    CHECK(worst > 2e-7);  // the axes' own error shows
    CHECK(limited > 1000);
}

TEST_CASE("explain says how long each axis and pair is that is not of unit length, and no other")
{
    Random random{3};
    for (const UnitPart& part : every_part()) {
        Float12 value = made_value(random, part.field);
        double length2 = 0;
        for (std::uint32_t c = part.first; c < part.first + part.size; ++c) {
            value[c] *= 1.5f;
            length2 += double{value[c]} * double{value[c]};
        }
        Crowd crowd = crowd_of(part.features, 1);
        crowd.write_all(SWIVEL_TARGET, 0, Float3{0.2f, 0.3f, 0.6f});
        REQUIRE(swivel_write(crowd.get(), part.field, 0, 0, 1, {value.data(), sizeof value}) == SWIVEL_OK);
        crowd.solve();
        const std::string text = crowd.explain(0, 0), is = part.size == 2 ? "its pair " : "its axis ";
        INFO(text);
        const std::size_t at = text.find(is);
        REQUIRE(at != std::string::npos);
        CHECK(text.find("its pair ", at + 1) == std::string::npos);
        CHECK(text.find("its axis ", at + 1) == std::string::npos);
        if (part.size == 2)
            CHECK(std::stod(text.substr(at + 9)) == Approx(double{value[part.first]}).epsilon(1e-5).margin(1e-12));
        CHECK(std::stod(text.substr(text.find(" is ", at) + 4)) == Approx(std::sqrt(length2)).epsilon(1e-7));
    }
}
