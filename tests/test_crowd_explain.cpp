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

double off_cone(const Vector3d& a, const Vector3d& b, double most) { return std::acos(a.dot(b)) - most; }
double off_twist(const Quaterniond& q, const Vector3d& axis, const AngleRange& range)
{
    return range.outside(2 * std::atan2(q.vec().dot(axis), q.w()));
}
double off_box(const Quaterniond& q, const AngleBox& box)
{
    const Vector3d angles = q.toRotationMatrix().eulerAngles(box.axes[0], box.axes[1], box.axes[2]);
    const auto most = [&](double a, double b, double c) {
        return std::max({box.range[0].outside(a), box.range[1].outside(b), box.range[2].outside(c)});
    };
    return std::min(most(angles[0], angles[1], angles[2]), most(angles[0] + kPi, kPi - angles[1], angles[2] + kPi));
}

}  // namespace

TEST_CASE("explain names inputs that were never written, or are out of range, and no other")
{
    constexpr swivel_features features = SWIVEL_WORLD | SWIVEL_WITH_HAND | SWIVEL_WITH_SHOULDER_CONE;
    const swivel_group_def group = swivel_default_group_def(20);
    Crowd crowd = crowd_with(features, {&group, 1});
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
    CHECK(crowd.explain(0, 7) ==
          "Bad input: pole (inf, 0, 0) is out of its range, no further than 1e15. The limb has its rest pose.");
    CHECK(says(crowd, 8, "hand (0, 0, 0, 0) is out of its range, a quaternion of length 1e-9 to 1e9"));
    CHECK(crowd.explain(0, 1).starts_with("The target is reached, to within "));
    crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>{{1e14f, 0, 0}}, 9);
    crowd.write(SWIVEL_PARENT_SCALE, 0, std::vector<Float1>{{1e-3f}}, 9);
    crowd.solve();
    CHECK(says(crowd, 9, "each input is in its range, but not as the parent's"));
}

TEST_CASE("explain measures how far a target is out of reach, from the shoulder as the clavicle has turned it")
{
    Random random{4};
    Crowd crowd = crowd_of(SWIVEL_WORLD, 1), turned = crowd_of(SWIVEL_WORLD | SWIVEL_WITH_CLAVICLE, 1);
    turned.write_all(SWIVEL_CLAVICLE, 0, Float4{0.1f, 0.2f, -0.1f, 0.5f});
    for (int n = 0; n < 40; ++n) {
        const bool is_far = n % 2 == 0;
        const auto number = [](double x) { return static_cast<float>(x); };
        const float upper = number(random.between(0.5, 1)), fore = number(random.between(0.2, 0.4)),
                    scale = number(random.spread(0.1, 10));
        const double distance = is_far ? random.between(2, 4) : random.between(0.01, 0.05);
        const Float3 shoulder = floats(Vector3d(3 * random.direction())),
                     target = floats(Vector3d(vec(shoulder) + double{scale} * distance * random.direction()));
        for (Crowd* const each : {&crowd, &turned}) {
            each->write_all(SWIVEL_TARGET, 0, target);
            each->write_all(SWIVEL_SHOULDER_POSITION, 0, shoulder);
            each->write_all(SWIVEL_LENGTHS, 0, Float2{upper, fore});
            each->write_all(SWIVEL_PARENT_SCALE, 0, Float1{scale});
            each->solve();
        }
        const std::string text = crowd.explain(0, 0);
        const double end = double{scale} * (is_far ? double{upper} + double{fore} : double{upper} - double{fore});
        const double missed = std::fabs((vec(target) - vec(shoulder)).norm() - end);
        CHECK(text.find(is_far ? "out of reach" : "too near") != std::string::npos);
        CHECK(number_after(text, "The target is ") == Approx(missed).epsilon(1e-3));
        CHECK(number_after(text, "the wrist is ") == Approx(end).epsilon(1e-3));
        if (is_far) CHECK(number_after(turned.explain(0, 0), "the wrist is ") == Approx(end).epsilon(1e-3));
    }
}

TEST_CASE("explain says how exactly a target is reached in lengths of the limb, as residuals do, whatever the unit")
{
    Random random{7};
    for (const swivel_features features : {SWIVEL_WORLD, SWIVEL_WORLD | SWIVEL_WITH_AIM}) {
        Crowd crowd = crowd_of(features, 40);
        crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
        crowd.write_all(SWIVEL_LENGTHS, 0, Float2{300, 200});
        float aim[5];
        const double axis[3] = {0, 0, 1};
        REQUIRE(swivel_aim(axis, 0.3, aim) == SWIVEL_OK);
        if (features & SWIVEL_WITH_AIM) crowd.write_all(SWIVEL_AIM, 0, aim);
        const double near = features & SWIVEL_WITH_AIM ? 600 : 200;  // an aim reaches beyond the arm
        for (std::uint32_t n = 0; n < 40; ++n) {
            const double distance = random.between(near, near + 290);
            crowd.write(SWIVEL_TARGET, 0, std::vector{floats(Vector3d(distance * random.direction()))}, n);
        }
        crowd.solve();
        std::vector<double> off(40);
        crowd.residuals(0, off);
        const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
        int reached = 0;
        for (std::uint32_t n = 0; n < 40; ++n) {
            if (!(flags[n] & SWIVEL_REACHED)) continue;
            const std::string text = crowd.explain(0, n);
            CHECK(number_after(text, ", to within ") == Approx(off[n]).epsilon(0.06));  // of two digits
            CHECK(text.find(" of the limb's length.") != std::string::npos);
            ++reached;
        }
        CHECK(reached > 10);
    }
}

TEST_CASE("explain of bones without a length, of aims, and of inputs left as they start")
{
    Crowd crowd = crowd_of(SWIVEL_WORLD, 2);
    crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{1, 0, 0});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{1, 0, 2});
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{0, 0});
    crowd.solve();
    CHECK(number_after(crowd.explain(0, 0), "The target is ") == 2);
    CHECK(says(crowd, 0, "bones of no length"));
    CHECK(says(crowd, 0, "Its parent_rotation is the identity"));
    crowd.write_all(SWIVEL_PARENT_ROTATION, 0, Float4{0, 0, 0.6f, 0.8f});
    CHECK(!says(crowd, 0, "parent_rotation"));

    Crowd aiming = crowd_of(SWIVEL_WITH_AIM, 2);
    aiming.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    float aim[5];
    const double axis[3] = {0, 0.3, 1};
    REQUIRE(swivel_aim(axis, 1.2, aim) == SWIVEL_OK);
    aiming.write_all(SWIVEL_AIM, 0, aim);
    aiming.write(SWIVEL_TARGET, 0, std::vector<Float3>{{0.3f, 2, 3}, {0, 0, 0.01f}});
    aiming.solve();
    const auto flags = read<std::uint32_t>(aiming, SWIVEL_FLAGS);
    CHECK(flags[0] & SWIVEL_REACHED);
    CHECK(says(aiming, 0, "The hand aims at the target"));
    CHECK(flags[1] & SWIVEL_CLAMPED_NEAR);
    std::array<double, 2> off;
    aiming.residuals(0, off);
    CHECK(number_after(aiming.explain(0, 1), "the hand's ray passes it by ") == Approx(2 * off[1]).epsilon(1e-3));
}

TEST_CASE("explain says which limit turned the elbow from its wish, by how much, and why none is kept")
{
    Random random{6};
    constexpr std::uint32_t count = 300;
    constexpr swivel_features limits = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST;
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

TEST_CASE("explain says by how many degrees the pose that violates limits least is outside of each")
{
    Random random{8};
    constexpr std::uint32_t count = 150;
    const auto narrow = [&] { return AngleRange{random.between(-3, 3), random.between(0.05, 0.6)}; };
    int named = 0;
    for (const swivel_features limits :
         {SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST | SWIVEL_WITH_HAND_CONE,
          SWIVEL_WITH_FOREARM_TWIST | SWIVEL_WITH_HAND_TWIST | SWIVEL_WITH_SHOULDER_CONE,
          SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX, SWIVEL_WITH_WRIST_BOX | SWIVEL_WITH_HAND_CONE}) {
        const Chained limb = chained(random);
        swivel_group_def group = swivel::group(count, limb.bound, kWorldJointsHand | limits);
        group.shoulder_order = SWIVEL_ZXY;
        group.wrist_order = SWIVEL_YXZ;
        Crowd crowd(group);
        LimbLimits l(random);
        l.shoulder = 0.5, l.hand = 0.3;
        l.humeral = narrow(), l.forearm = narrow(), l.twist = narrow();
        l.shoulder_box = {{2, 0, 1}, {narrow(), narrow(), narrow()}};
        l.wrist_box = {{1, 0, 2}, {narrow(), narrow(), narrow()}};
        std::vector<Limb> limbs;
        for (std::uint32_t n = 0; n < count; ++n)
            limbs.push_back(random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]}));
        each_limit(l, [&](swivel_field field, const auto& value) {
            if (swivel_field_row_count(crowd.get(), 0, field)) crowd.write_all(field, 0, value);
        });
        for (std::uint32_t n = 0; n < count; ++n) write_limb(crowd, 0, n, limbs[n]);
        crowd.solve();
        const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
        for (std::uint32_t n = 0; n < count; ++n) {
            if (!(flags[n] & SWIVEL_INFEASIBLE)) continue;
            const std::string text = crowd.explain(0, n);
            INFO(text);
            const LocalPose q = added_to_rest(local_pose(crowd, n), limb.bound);
            const Vector3d bone = Vector3d::UnitZ();
            const std::tuple<std::uint32_t, std::string, double> off[] = {
                {SWIVEL_WITH_SHOULDER_CONE, "shoulder_cone", off_cone(l.shoulder_axis, q.shoulder * bone, 0.5)},
                {SWIVEL_WITH_HUMERAL_TWIST, "humeral_twist", off_twist(q.shoulder, bone, l.humeral)},
                {SWIVEL_WITH_SHOULDER_BOX, "shoulder_box", off_box(q.shoulder, l.shoulder_box)},
                {SWIVEL_WITH_HAND_CONE, "hand_cone", off_cone(bone, q.wrist * l.hand_axis, 0.3)},
                {SWIVEL_WITH_FOREARM_TWIST, "forearm_twist", off_twist(q.wrist, bone, l.forearm)},
                {SWIVEL_WITH_HAND_TWIST, "hand_twist", off_twist(q.wrist, l.twist_axis, l.twist)},
                {SWIVEL_WITH_WRIST_BOX, "wrist_box", off_box(q.wrist, l.wrist_box)},
            };
            const std::string pose = text.substr(text.find("Its pose violates"));
            for (const auto& [limit, name, angle] : off) {
                const double degrees_off = angle / degrees(1);
                const bool is_named = pose.find(name + " by") != std::string::npos;
                if (!(limits & limit) || degrees_off < -0.03) CHECK_FALSE(is_named);
                if ((limits & limit) && degrees_off > 0.03) {
                    REQUIRE(is_named);
                    CHECK(number_after(pose, name + " by") == Approx(degrees_off).margin(0.03));
                    ++named;
                }
            }
        }
    }
    CHECK(named > 500);
}

TEST_CASE("explain says how near an arm that its box turned is to the box's pole")
{
    Random random{9};
    constexpr std::uint32_t count = 2000;
    swivel_group_def group = swivel::group(count, SWIVEL_WITH_SHOULDER_BOX);
    group.shoulder_order = SWIVEL_ZXY;
    Crowd crowd(group);
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    const Float4 narrow = range(-0.5, 0.5), wide = range(-1.6, 1.6);
    Float12 box;
    for (std::size_t k = 0; k < 3; ++k) std::ranges::copy(k == 1 ? wide : narrow, box.begin() + 4 * k);
    crowd.write_all(SWIVEL_SHOULDER_BOX, 0, box);
    for (std::uint32_t n = 0; n < count; ++n) {
        const Float3 target = floats(1.5 * random.direction()), pole = floats(random.direction());
        crowd.write(SWIVEL_TARGET, 0, std::span(&target, 1), n);
        crowd.write(SWIVEL_POLE, 0, std::span(&pole, 1), n);
    }
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    int near = 0, far = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        if (!(flags[n] & SWIVEL_LIMITED_SHOULDER_BOX)) continue;
        const std::string text = crowd.explain(0, n), words = "degrees from the pole of shoulder_box";
        INFO(text);
        // The middle angle's sine is the entry of the first axis and the last.
        const double sine = quat(read<Float4>(crowd, SWIVEL_SHOULDER)[n]).toRotationMatrix()(2, 1);
        const double off = std::acos(std::fabs(sine)) / degrees(1);
        const bool is_said = text.find(words) != std::string::npos;
        if (std::fabs(off - 15) > 0.01) CHECK(is_said == (off < 15));
        if (is_said) CHECK(number_after(text, "It is ") == Approx(off).margin(0.51));
        (is_said ? near : far) += 1;
    }
    CHECK(near > 0);
    CHECK(far > 0);
}

TEST_CASE("with a step limit, explain measures the nearest place from where the step ends")
{
    Crowd crowd = crowd_of(SWIVEL_WITH_MOST_SWIVEL | SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST, 1);
    crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
    crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 1, 1});
    crowd.write_all(SWIVEL_POLE, 0, Float3{1, 5, 3});
    crowd.write_all(SWIVEL_HUMERAL_TWIST, 0, range(-3.14, 3.14));
    crowd.write_all(SWIVEL_MOST_SWIVEL, 0, turn(0.3));
    crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone({0, 0, 1}, 3.14));
    crowd.solve();
    std::vector<std::array<double, 3>> elbow(1);
    crowd.elbows(0, elbow);
    crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone(elbow[0], 0.1));
    crowd.write_all(SWIVEL_POLE, 0, Float3{1, -5, -3});
    const std::string text = crowd.explain(0, 0);
    CHECK(text.find("Where the step takes the elbow, it breaks shoulder_cone") != std::string::npos);
    const Vector3d before = vec(read<Float3>(crowd, SWIVEL_NORMAL)[0]);
    crowd.solve();
    crowd.write_all(SWIVEL_HUMERAL_TWIST, 0, range(2, 2.1));
    CHECK(says(crowd, 0, "keeps all limits at once, as the step's end breaks shoulder_cone and humeral_twist:"));
    const double made = std::acos(before.dot(vec(read<Float3>(crowd, SWIVEL_NORMAL)[0])));
    CHECK(made > 0.05);
    CHECK(number_after(text, "keeps all limits is ") == Approx((0.3 - made) * 180 / kPi).margin(0.06));
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
    CHECK(says(crowd, 0, "the next solve goes as far as step and limits allow"));
    const std::string whole = crowd.explain(0, 0);
    for (const std::size_t size : {std::size_t{1}, std::size_t{2}, std::size_t{4}, std::size_t{30}, whole.size(),
                                   whole.size() + 1, whole.size() + 2}) {
        std::vector<char> text(size + 8, '?');
        REQUIRE(swivel_explain(crowd.get(), 0, 0, text.data(), size) == SWIVEL_OK);
        std::string expected = whole.substr(0, size - 1);
        if (expected != whole)  // cut
            for (std::size_t n = 1; n <= std::min(expected.size(), std::size_t{3}); ++n) expected.end()[-int(n)] = '.';
        CHECK(std::string(text.data()) == expected);
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

TEST_CASE("SWIVEL_EXPLANATION_BYTES hold the longest text, of a limb whose every input is bad")
{
    constexpr swivel_features all = kWorldJointsHand | kLimits | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_ANGLE |
                                    SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_REACH |
                                    SWIVEL_WITH_MOST_SWIVEL | SWIVEL_WITH_CLAVICLE,
                              aim = kWorldJointsHand | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_AIM;
    Random random{10};
    for (const swivel_features features : {all, aim}) {
        Crowd crowd = crowd_of(features, 1, chained(random).bound);
        // Written as twelve characters each; too long for some fields, too short for the others.
        for (const float bad : {-1.23456789e20f, -1.23456789e-20f, kNan, -kNan}) {
            for (int f = 0; f < SWIVEL_INPUT_END; ++f) {
                const auto field = static_cast<swivel_field>(f);
                Float12 value;
                value.fill(bad);
                if (swivel_field_row_count(crowd.get(), 0, field))
                    REQUIRE(swivel_write(crowd.get(), field, 0, 0, 1, {value.data(), sizeof value}) == SWIVEL_OK);
            }
            crowd.solve();
            std::vector<char> text(100'000);
            REQUIRE(swivel_explain(crowd.get(), 0, 0, text.data(), text.size()) == SWIVEL_OK);
            const std::string whole = text.data();
            INFO(whole);
            CHECK(whole.ends_with(" The limb has its rest pose."));
            CHECK(whole.find('?') == std::string::npos);
            CHECK(whole.size() < SWIVEL_EXPLANATION_BYTES);
        }
    }
}

TEST_CASE("with weights, explain speaks of the blended target, and of how far the limb is from the target itself")
{
    Random random{9};
    constexpr std::uint32_t count = 200;
    constexpr swivel_features features = SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_INCOMING |
                                         SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_REACH | SWIVEL_WITH_FLEXION_LIMIT;
    Crowd crowd = crowd_of(features, count);
    std::vector<Float3> targets, effectors, weights;
    for (std::uint32_t n = 0; n < count; ++n) {
        targets.push_back(floats(random.vector(0, 4)));
        effectors.push_back(n % 2 == 0 ? Float3{0, 0, 0} : floats(Vector3d(0.3 * random.direction())));
        weights.push_back({n % 4 == 0 ? 1 : static_cast<float>(random.below(4) ? random.unit() : 0), 1, 1});
    }
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.write(SWIVEL_EFFECTOR, 0, effectors);
    crowd.write(SWIVEL_WEIGHTS, 0, weights);
    crowd.write_all(SWIVEL_HAND, 0, floats(random.rotation()));
    crowd.write_all(SWIVEL_INCOMING_ELBOW, 0, Float4{-0.5f, 0, 0, 1});
    crowd.write_all(SWIVEL_REACH, 0, Float4{0.1f, 0.1f, 1, 0});
    float flexion[2];
    REQUIRE(swivel_flexion(0.2, 2.5, flexion) == SWIVEL_OK);
    crowd.write_all(SWIVEL_FLEXION_LIMIT, 0, flexion);
    crowd.solve();
    const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
    std::vector<std::array<double, 3>> wrists(count);
    std::vector<std::array<double, 4>> hands(count);
    crowd.wrists(0, wrists);
    crowd.hands(0, hands);
    int reached = 0, softened = 0, far = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        const std::string text = crowd.explain(0, n);
        INFO(text);
        const Vector3d tip = Vector3d(wrists[n].data()) + Quaterniond(hands[n].data()) * vec(effectors[n]);
        const double missed = (tip - vec(targets[n])).norm();
        const std::string point = n % 2 == 0 ? "wrist " : "effector ";
        if (weights[n][0] == 1) {
            CHECK(text.find("blended") == std::string::npos);
            if (!(flags[n] & (SWIVEL_REACHED | SWIVEL_CLAMPED_FAR | SWIVEL_CLAMPED_NEAR))) {
                CHECK(number_after(text, "A soft zone of reach keeps the " + point) == Approx(missed).epsilon(1e-3));
            }
            continue;
        }
        CHECK(text.find("to within") == std::string::npos);
        CHECK(number_after(text, "With a position weight of ") ==
              Approx(double{weights[n][0]}).epsilon(6e-3).margin(1e-12));
        const std::size_t tail = text.find("With a position weight");
        CHECK(number_after(text.substr(tail), "the " + point + "is ") == Approx(missed).epsilon(6e-4).margin(1e-5));
        if (flags[n] & SWIVEL_REACHED) {
            CHECK(text.starts_with("The blended target is reached."));
            ++reached;
        } else if (flags[n] & (SWIVEL_CLAMPED_FAR | SWIVEL_CLAMPED_NEAR)) {
            const bool is_far = flags[n] & SWIVEL_CLAMPED_FAR;
            CHECK(text.starts_with(is_far ? "The blended target is out of reach: the wrist is "
                                          : "The blended target is too near: the wrist is "));
            CHECK(number_after(text, ": the wrist is ") ==
                  Approx(Vector3d(wrists[n].data()).norm()).epsilon(6e-4).margin(1e-12));
            far += is_far;
        } else {
            CHECK(text.starts_with("A soft zone of reach keeps the "));
            CHECK(text.find(" from its blended target.") != std::string::npos);
            ++softened;
        }
    }
    CHECK(std::min({reached, softened, far}) > 5);
}
