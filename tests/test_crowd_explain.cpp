// SPDX-License-Identifier: MIT
//
// The promise: swivel_explain() names what is wrong with a limb, with numbers that forward kinematics confirms.
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

bool says(const Crowd& crowd, std::uint32_t limb, const std::string& part)
{
    const std::string text = crowd.explain(0, limb);
    INFO(text);
    CHECK(is_one_line(text.substr(0, 255)));
    return text.find(part) != std::string::npos;
}

// The first number after these words.
double number_after(const std::string& text, const std::string& words)
{
    const std::size_t at = text.find(words);
    INFO(text);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + words.size()));
}

}  // namespace

TEST_CASE("explain names inputs that were never written, or are out of range, and no other")
{
    constexpr std::uint32_t features = SWIVEL_WORLD | SWIVEL_WITH_HAND | SWIVEL_WITH_SHOULDER_CONE;
    const swivel_group_def group = swivel_default_group_def(20);
    for (const std::uint32_t compact : {0u, std::uint32_t{SWIVEL_COMPACT}}) {
        Crowd crowd(features | compact, {&group, 1});
        CHECK(says(crowd, 3, "it never was"));
        crowd.solve();
        const std::string none = crowd.explain(0, 19);
        for (const char* field : {"target", "lengths", "shoulder_position"})
            CHECK(none.find(std::string(field) + " (nan") != std::string::npos);
        for (const char* field : {"pole", "hand", "parent", "cone"}) CHECK(none.find(field) == std::string::npos);
        crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 1, 1});
        crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
        crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
        crowd.write(SWIVEL_POLE, 0, std::vector<Float3>{{kInf, 0, 0}}, 7);
        crowd.write(SWIVEL_HAND, 0, std::vector<Float4>{{0, 0, 0, 0}}, 8);
        CHECK(says(crowd, 1, "Its inputs changed since it was solved"));
        crowd.solve();
        CHECK(crowd.explain(0, 7) == "Bad input: pole (inf, 0, 0) is out of its range. The limb has its rest pose.");
        CHECK(says(crowd, 8, "hand (0, 0, 0, 0) is out of its range"));
        CHECK(crowd.explain(0, 1).starts_with("The target is reached, to within "));
        crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>{{1e14f, 0, 0}}, 9);
        crowd.write(SWIVEL_PARENT_SCALE, 0, std::vector<Float1>{{1e-3f}}, 9);
        crowd.solve();
        CHECK(says(crowd, 9, "each input is in its range, but not as the parent's"));
    }
}

TEST_CASE("explain measures how far a target is out of reach")
{
    Random random{4};
    Crowd crowd = crowd_of(SWIVEL_WORLD, 40);
    std::vector<Float3> targets(40), shoulders(40);
    std::vector<Float2> lengths(40);
    std::vector<Float1> scales(40);
    for (std::size_t n = 0; n < 40; ++n) {
        const Vector3d shoulder = 3 * random.direction();
        const double upper = random.between(0.5, 1), fore = random.between(0.2, 0.4), scale = random.spread(0.1, 10);
        const double distance = n % 2 == 0 ? random.between(2, 4) : random.between(0.01, 0.05);
        shoulders[n] = floats(shoulder);
        targets[n] = floats(Vector3d(shoulder + scale * distance * random.direction()));
        lengths[n] = {static_cast<float>(upper), static_cast<float>(fore)};
        scales[n] = {static_cast<float>(scale)};
    }
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.write(SWIVEL_SHOULDER_POSITION, 0, shoulders);
    crowd.write(SWIVEL_LENGTHS, 0, lengths);
    crowd.write(SWIVEL_PARENT_SCALE, 0, scales);
    crowd.solve();
    for (std::uint32_t n = 0; n < 40; ++n) {
        const std::string text = crowd.explain(0, n);
        const double scale = double{scales[n][0]}, upper = double{lengths[n][0]}, fore = double{lengths[n][1]};
        const double end = scale * (n % 2 == 0 ? upper + fore : upper - fore);
        const double missed = std::fabs((vec(targets[n]) - vec(shoulders[n])).norm() - end);
        CHECK(text.find(n % 2 == 0 ? "out of reach" : "too near") != std::string::npos);
        CHECK(number_after(text, "The target is ") == Approx(missed).epsilon(1e-3));
        CHECK(number_after(text, "the wrist is ") == Approx(end).epsilon(1e-3));
    }
}

TEST_CASE("explain says which limit turned the elbow from its wish, by how much, and why none is kept")
{
    Random random{6};
    constexpr std::uint32_t count = 300, limits = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST;
    const Chained limb = chained(random);
    Crowd limited = crowd_of(kWorldJointsHand | limits, count, limb.bound),
          free = crowd_of(kWorldJointsHand, count, limb.bound);
    limited.write_all(SWIVEL_SHOULDER_CONE, 0, cone({0.2, 0.5, 1}, 1.1));
    limited.write_all(SWIVEL_HUMERAL_TWIST, 0, range(-0.7, 0.9));
    std::vector<Limb> limbs;
    for (std::uint32_t n = 0; n < count; ++n) {
        limbs.push_back(random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]}));
        for (Crowd* crowd : {&limited, &free}) write_limb(*crowd, 0, n, limbs.back());
    }
    limited.solve();
    free.solve();
    const auto flags = read<std::uint32_t>(limited, SWIVEL_FLAGS);
    std::vector<std::array<double, 3>> elbow[2], wrist(count);
    for (std::size_t k : {0u, 1u}) {
        elbow[k].resize(count);
        (k == 0 ? limited : free).elbows(0, elbow[k]);
    }
    limited.wrists(0, wrist);
    std::size_t turned = 0, impossible = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        const std::string text = limited.explain(0, n);
        INFO(text);
        const bool is_named = text.find("shoulder_cone") != std::string::npos;
        if (!(flags[n] & SWIVEL_INFEASIBLE)) CHECK(is_named == ((flags[n] & SWIVEL_LIMITED_SHOULDER_CONE) != 0));
        if (flags[n] & SWIVEL_INFEASIBLE) {
            CHECK(text.find("No place of the elbow keeps ") != std::string::npos);
            ++impossible;
        } else if (flags[n] & (SWIVEL_LIMITED_SHOULDER_CONE | SWIVEL_LIMITED_HUMERAL_TWIST)) {
            const auto at = [&](const std::array<double, 3>& p) {
                return Vector3d(Vector3d(p[0], p[1], p[2]) - vec(limbs[n].position));
            };
            const Vector3d line = at(wrist[n]).normalized();
            const auto across = [&](const Vector3d& v) { return Vector3d(v - v.dot(line) * line).normalized(); };
            const double cosine = across(at(elbow[0][n])).dot(across(at(elbow[1][n])));
            const double degrees_off = std::acos(std::clamp(cosine, -1.0, 1.0)) / degrees(1);
            CHECK(number_after(text, "keeps all limits is ") == Approx(degrees_off).margin(0.11));
            ++turned;
        }
    }
    CHECK(turned > 20);
    CHECK(impossible > 20);
}

TEST_CASE("explain writes no further than it may, changes nothing and refuses what is not there")
{
    Crowd crowd = crowd_of(SWIVEL_WITH_MOST_SWIVEL | SWIVEL_WITH_SHOULDER_CONE, 20);
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 1, 1});
    crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(0.1));
    crowd.solve();
    crowd.write_all(SWIVEL_POLE, 0, Float3{0, 5, -3});
    crowd.solve();
    const auto before = all_words(crowd);
    CHECK(says(crowd, 0, "more than a step from the swivel that is carried now"));
    const std::string whole = crowd.explain(0, 0);
    for (const std::size_t size : {std::size_t{1}, std::size_t{2}, std::size_t{30}, whole.size(), whole.size() + 1}) {
        std::vector<char> text(size + 8, '?');
        REQUIRE(swivel_explain(crowd.get(), 0, 0, text.data(), size) == SWIVEL_OK);
        CHECK(std::string(text.data()) == whole.substr(0, size - 1));
        CHECK(std::count(text.begin() + static_cast<std::ptrdiff_t>(size), text.end(), '?') == 8);
    }
    CHECK((all_words(crowd) == before));
    char text[8];
    CHECK_REFUSED(swivel_explain(nullptr, 0, 0, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_explain(crowd.get(), 1, 0, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_explain(crowd.get(), 0, 20, text, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_explain(crowd.get(), 0, 0, nullptr, 8), SWIVEL_INVALID_ARGUMENT);
    CHECK_REFUSED(swivel_explain(crowd.get(), 0, 0, text, 0), SWIVEL_INVALID_ARGUMENT);
}
