// SPDX-License-Identifier: MIT
//
// The promise: an axis or a pair of cosine and sine whose squared length is not 1 within 1e-6 is bad input, and
// explain says how long it is. What swivel_cone(), swivel_range(), swivel_aim() and swivel_cos_sin() make is always
// valid.
#include <string_view>

#include "swivel/swivel_explain.hpp"
#include "tests/limited_arms.h"
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
// An axis, and then pairs of cosine and sine, as the library says what is in range. A cone's cosine is no pair.
std::vector<UnitPart> every_part()
{
    std::vector<UnitPart> parts;
    swivel_field_info info;
    for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n) {
        const std::string_view range = info.range;
        const bool has_axis = range.starts_with("a unit axis"),
                   has_pairs = range.starts_with("ranges of angles") || range.starts_with("cos and sin of 0 to pi");
        if (!has_axis && !has_pairs) continue;
        const swivel_features features = info.needs | SWIVEL_WITH_HAND;  // which limits of the hand need
        if (has_axis) parts.push_back({info.field, features, 0, 3});
        for (std::uint32_t first = has_axis ? 3 : 0; first + 1 < info.max_components; first += 2)
            parts.push_back({info.field, features, first, 2});
    }
    CHECK(parts.size() >= 24);
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
double any_angle(Random& random, double max)
{
    const double angle = random.below(2) ? random.between(0, max) : kPi / 2 * random.below(3);
    return std::clamp(angle + random.spread(1e-12, 1e-2) * random.between(-1, 1), 0.0, max);
}
// A value from the library's own functions.
Float12 made_value(Random& random, swivel_field field)
{
    const Vector3d axis = any_axis(random);
    const auto any_range = [&](const Limit&) {
        return AngleRange{4 * any_angle(random, kPi) - 2 * kPi, any_angle(random, kPi)};
    };
    LimbLimits limits(random);
    for (Limit& limit : limits.each)
        if (limit.has_own_axis()) limit.axis = axis;
    limits.draw([&](const Limit&) { return any_angle(random, kPi); }, any_range);
    std::vector<float> value;
    const auto take = [&](swivel_field made, const auto& numbers) {
        if (made == field) value.assign(numbers.begin(), numbers.end());
    };
    each_limit(limits, take);
    take(SWIVEL_AIM, aim({axis.x(), axis.y(), axis.z()}, any_angle(random, kPi)));
    const Float2 pair = cos_sin(any_angle(random, 3.14159));
    if (value.empty()) {
        REQUIRE(describe(field).max_components == 2);
        value.assign(pair.begin(), pair.end());
    }
    Float12 numbers = {};
    std::ranges::copy(value, numbers.begin());
    return numbers;
}

Crowd solved_with(const UnitPart& part, const std::vector<Float12>& values, const swivel_binding& binding = {})
{
    const auto count = static_cast<std::uint32_t>(values.size());
    const swivel_features joints = binding.lengths[0] > 0 ? SWIVEL_JOINTS : 0;
    Crowd crowd = crowd_of(part.features | joints, count, binding);
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0.2f, 0.3f, 0.6f});
    REQUIRE(swivel_write(crowd.get(), part.field, 0, 0, count, {values.data(), sizeof values[0]}) == SWIVEL_OK);
    crowd.solve();
    return crowd;
}

}  // namespace

TEST_CASE("an axis or pair whose squared length is not 1 within 1e-6 is bad input, and explain says how long it is")
{
    Random random{1};
    for (const UnitPart& part : every_part()) {
        INFO("field " << part.field << ", from " << part.first);
        std::vector<Float12> values;
        std::vector<double> length2(400);
        while (values.size() < length2.size()) {
            Float12 value = made_value(random, part.field);
            const double length = std::sqrt(1 + random.spread(1e-8, 1e-2) * (random.below(2) ? 1 : -1));
            for (std::uint32_t c = part.first; c < part.first + part.size; ++c) {
                value[c] = static_cast<float>(length * double{value[c]});
                length2[values.size()] += double{value[c]} * double{value[c]};
            }
            values.push_back(value);
        }
        const Crowd crowd = solved_with(part, values);
        int good = 0, bad = 0;
        for (std::uint32_t n = 0; n < values.size(); ++n) {
            const double off = std::fabs(length2[n] - 1);
            INFO("off by " << off);
            const LimbPose pose = pose_of(crowd, n);
            const bool is_bad = pose.flags & SWIVEL_BAD_INPUT;
            if (off < 7.5e-7) {  // 2e-7 and more from 1e-6: floats sum that well
                ++good;
                CHECK_FALSE(is_bad);
                CHECK(is_unit(pose.shoulder_result));
                CHECK(std::fabs(std::hypot(double{pose.elbow_result[0]}, double{pose.elbow_result[1]}) - 1) <= 1e-6);
            }
            if (off <= 1.25e-6) continue;
            ++bad;
            CHECK(is_bad);
            const std::string text = explain(crowd, 0, n), words = part.size == 2 ? "its pair " : "its axis ";
            INFO(text);
            const std::size_t at = text.find(words);
            REQUIRE(at != std::string::npos);
            CHECK(text.find("its pair ", at + 1) == std::string::npos);
            CHECK(text.find("its axis ", at + 1) == std::string::npos);
            CHECK(std::stod(text.substr(text.find(" is ", at) + 4)) == Approx(std::sqrt(length2[n])).epsilon(1e-7));
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
            const auto flags = read<std::uint32_t>(
                solved_with(part, values, joints ? bound_limb(random).bound : swivel_default_binding()), SWIVEL_FLAGS);
            CHECK(std::ranges::count_if(flags, [](std::uint32_t f) { return (f & SWIVEL_BAD_INPUT) != 0; }) == 0);
        }
    }
}

TEST_CASE("limits hold to 3e-6 of a cosine with axes and pairs as far from unit length as is valid")
{
    Random random{4};
    LimitedArms arms(random, 20'000, false);
    arms.features = SWIVEL_WITH_HAND | kUpperArmLimits;
    Crowd crowd = arms.crowd();
    std::uint32_t limits = 0;  // their flags
    for (const UnitPart& part : every_part()) {
        if (!swivel_field_row_count(crowd.get(), 0, part.field)) continue;
        limits |= flag_of(part.field);
        std::vector<Float4> values = read<Float4>(crowd, part.field);
        for (Float4& value : values)
            for (std::uint32_t c = part.first; c < part.first + part.size; ++c)
                value[c] *= random.below(2) ? 1.0000004f : 0.9999996f;
        crowd.write(part.field, 0, values);
    }
    crowd.solve();
    double worst = -1;
    int limited = 0;
    for (std::uint32_t n = 0; n < arms.arms.size(); ++n) {
        const LimbPose pose = pose_of(crowd, n);
        REQUIRE_FALSE(pose.flags & SWIVEL_BAD_INPUT);
        if (pose.flags & SWIVEL_INFEASIBLE) continue;
        worst = std::max(worst, -arms.room(n, pose));
        limited += (pose.flags & limits) != 0;
    }
    CHECK(worst <= 3e-6);
    CHECK(worst > 2e-7);  // the axes' own error shows
    CHECK(limited > 1000);
}
