// SPDX-License-Identifier: MIT
//
// The promise: swivel_explain() names what is wrong with a limb, in the words of approved/limbs.txt, with numbers that
// forward kinematics confirms.
#include <cctype>

#include "swivel/swivel_explain.hpp"
#include "swivel/swivel_regions.h"
#include "tests/approved_texts.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

double off_cone(const Vector3d& a, const Vector3d& b, double max) { return std::acos(a.dot(b)) - max; }
double off_twist(const Quaterniond& q, const Vector3d& axis, const AngleRange& range)
{
    return range.outside(2 * std::atan2(q.vec().dot(axis), q.w()));
}
double off_box(const Quaterniond& q, const AngleBox& box)
{
    const Vector3d angles = q.toRotationMatrix().eulerAngles(box.axes[0], box.axes[1], box.axes[2]);
    const auto max = [&](double a, double b, double c) {
        return std::max({box.range[0].outside(a), box.range[1].outside(b), box.range[2].outside(c)});
    };
    return std::min(max(angles[0], angles[1], angles[2]), max(angles[0] + kPi, kPi - angles[1], angles[2] + kPi));
}

// How far a pose in the arm frame is outside of a limit, as an angle.
double off_limit(const Limit& limit, const LocalPose& pose)
{
    const Vector3d bone = Vector3d::UnitZ();
    const Quaterniond& q = pose.*limit.joint;
    if (limit.shape == LimitShape::bone_in_cone) return off_cone(limit.axis, q * bone, limit.opening);
    if (limit.shape == LimitShape::axis_in_cone) return off_cone(bone, q * limit.axis, limit.opening);
    if (limit.shape == LimitShape::box) return off_box(q, limit.angles);
    return off_twist(q, limit.axis, limit.angles.range[0]);
}

// A limb of bones of length 1 whose shoulder is at the origin, or what a scene makes of it.
struct Told {
    ApprovedTexts& texts;
    Crowd crowd;

    Told(ApprovedTexts& approved, const std::string& scene, swivel_features features,
         const swivel_binding& binding = {})
        : texts(approved), crowd(crowd_of(features, 1, binding))
    {
        texts.scene(scene);
        write(SWIVEL_TARGET, Float3{0, 0.8f, 1});
        if (features & SWIVEL_WORLD) write(SWIVEL_SHOULDER_POSITION, Float3{0, 0, 0});
    }
    template <class Value>
    void write(swivel_field field, const Value& value)
    {
        crowd.write_all(field, 0, value);
    }
    void says(const std::string& when) { texts.line(when, explain(crowd, 0, 0)); }
    void solved(const std::string& when)
    {
        crowd.solve();
        says(when);
        judge(explain(crowd, 0, 0));
    }
    template <class Value>
    void with(const std::string& when, swivel_field field, const Value& value)
    {
        write(field, value);
        solved(when);
    }

private:
    // The distances that a text names are those of swivel_forward() and swivel_residuals().
    void judge(const std::string& text) const
    {
        if (text.starts_with("Bad input")) return;
        const auto value = [&](swivel_field field, auto otherwise) {
            if (swivel_field_row_count(crowd.get(), 0, field)) crowd.read(field, 0, std::span(&otherwise, 1));
            return otherwise;
        };
        std::array<std::array<double, 3>, 1> wrist;
        std::array<std::array<double, 4>, 1> hand{{{0, 0, 0, 1}}};
        std::array<double, 1> residual;
        crowd.wrists(0, wrist);
        crowd.residuals(0, residual);
        if (swivel_group_features(crowd.get(), 0) & SWIVEL_WITH_HAND) crowd.hands(0, hand);
        const double scale = value(SWIVEL_PARENT_SCALE, Float1{1})[0];
        const Vector3d place(wrist[0].data()), effector = vec(value(SWIVEL_EFFECTOR, Float3{})),
                                               tip = place + scale * (Quaterniond(hand[0].data()) * effector);
        const double missed = (tip - vec(value(SWIVEL_TARGET, Float3{}))).norm(),
                     length = scale * double{value(SWIVEL_LENGTHS, Float2{})[0] + value(SWIVEL_LENGTHS, Float2{})[1]};
        const auto is_told = [&](const std::string& words, double wanted, double share = 1e-3) {
            const std::size_t at = text.find(words);
            if (at == std::string::npos || !std::isdigit(text[at + words.size()])) return;
            INFO(text);
            CHECK(number_after(text, words) == Approx(wanted).epsilon(share).margin(1e-6));
        };
        is_told("The target is ", missed);
        is_told("The effector's target is ", missed);
        if (!swivel_field_row_count(crowd.get(), 0, SWIVEL_CLAVICLE)) is_told(": the wrist is ", place.norm());
        is_told("zone of reach keeps the wrist ", missed);
        is_told("zone of reach keeps the effector ", missed);
        is_told(", the wrist is ", missed);
        is_told(", the effector is ", missed);
        is_told("passes it by ", length * residual[0]);
        is_told(", to within ", residual[0], 0.06);
        std::array<std::array<double, 3>, 1> elbow;
        crowd.elbows(0, elbow);
        const Float4 cone = value(SWIVEL_SHOULDER_CONE, Float4{0, 0, 1, 1});
        const double from_axis = angle_between(Vector3d(elbow[0].data()), Vector3d(cone[0], cone[1], cone[2]));
        is_told("Its pose violates shoulder_cone by ", (from_axis - std::acos(double{cone[3]})) / degrees(1));
    }
};

void tell_of_inputs(ApprovedTexts& texts)
{
    constexpr swivel_features features = SWIVEL_WORLD | SWIVEL_WITH_HAND | SWIVEL_WITH_SHOULDER_CONE;
    Told none(texts, "inputs that were never written", features);
    none.write(SWIVEL_TARGET, Float3{kNan, kNan, kNan});
    none.write(SWIVEL_SHOULDER_POSITION, Float3{kNan, kNan, kNan});
    none.says("not solved");
    none.with("without lengths either", SWIVEL_LENGTHS, Float2{kNan, kNan});

    Told bad(texts, "inputs out of range", features);
    bad.with("pole", SWIVEL_POLE, Float3{kInf, 0, 0});
    bad.with("hand, too", SWIVEL_HAND, Float4{0, 0, 0, 0});
    bad.write(SWIVEL_POLE, Float3{0, -1, 0});
    bad.write(SWIVEL_HAND, Float4{0, 0, 0, 1});
    bad.with("one number of three", SWIVEL_TARGET, Float3{0, kNan, 1});
    bad.write(SWIVEL_TARGET, Float3{1e14f, 0, 0});
    bad.with("too far for a small parent", SWIVEL_PARENT_SCALE, Float1{1e-3f});
    bad.write(SWIVEL_PARENT_SCALE, Float1{1});
    bad.with("cone's axis", SWIVEL_SHOULDER_CONE, Float4{0, 0, 1.5f, 0.2f});

    Told pair(texts, "pairs that are not of unit length", SWIVEL_WITH_SHOULDER_BOX);
    Float12 box = {1, 0, -1, 0, 0, 0.5f, -1, 0, 1, 0, -2, 0};
    pair.with("two pairs of a box", SWIVEL_SHOULDER_BOX, box);

    Told changed(texts, "inputs that changed", SWIVEL_WORLD);
    changed.solved("solved");
    changed.write(SWIVEL_TARGET, Float3{0, 3, 0});
    changed.says("another target");

    swivel_limb_def keeps = group_of(1);
    keeps.on_bad_input = SWIVEL_KEEP_POSE;
    Told kept(texts, "a limb that keeps its pose", 0);
    kept.crowd = Crowd(keeps);
    kept.with("target", SWIVEL_TARGET, Float3{0, 2e15f, 0});
}

void tell_of_reach(ApprovedTexts& texts)
{
    Told limb(texts, "reach", SWIVEL_WORLD);
    limb.solved("in reach");
    limb.with("a turned parent", SWIVEL_PARENT_ROTATION, Float4{0, 0, 0.6f, 0.8f});
    limb.with("too far", SWIVEL_TARGET, Float3{0, 0, 3});
    limb.with("twice as large", SWIVEL_PARENT_SCALE, Float1{2});
    limb.with("too far by two of its own units", SWIVEL_TARGET, Float3{0, 0, 8});
    limb.write(SWIVEL_PARENT_SCALE, Float1{1});
    limb.write(SWIVEL_TARGET, Float3{0, 0, 0.25f});
    limb.with("too near", SWIVEL_LENGTHS, Float2{1, 0.5f});
    limb.with("no bones", SWIVEL_LENGTHS, Float2{0, 0});
    limb.write(SWIVEL_LENGTHS, Float2{1, 1});
    limb.write(SWIVEL_TARGET, Float3{0, 0, 1.5f});
    limb.with("pole on the target's line", SWIVEL_POLE, Float3{0, 0, -3});

    Told clavicle(texts, "a clavicle takes its share, so the shoulder moves", SWIVEL_WORLD | SWIVEL_WITH_CLAVICLE);
    clavicle.write(SWIVEL_CLAVICLE, Float4{0.3f, 0, 0, 0.5f});
    clavicle.with("too far", SWIVEL_TARGET, Float3{0, 0, 3});

    Told hand(texts, "the hand says where the elbow goes", SWIVEL_WITH_HAND | SWIVEL_POLE_HAND);
    hand.with("along the target's line", SWIVEL_TARGET, Float3{0, 0, 1.5f});

    constexpr swivel_features bounds = SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_REACH |
                                       SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS;
    for (const bool blends : {false, true}) {
        Told bound(texts, blends ? "bounds with a position weight" : "bounds of reach", bounds);
        if (blends) bound.write(SWIVEL_WEIGHTS, Float3{0.75f, 1, 1});
        if (blends) bound.write(SWIVEL_INCOMING_ELBOW, Float4{-0.6f, 0, 0, 0.8f});
        bound.solved("in reach");
        Float2 flexion;
        CHECK(swivel_flexion(0.5, 2, flexion.data()) == SWIVEL_OK);
        bound.write(SWIVEL_FLEXION_LIMIT, flexion);
        bound.with("an elbow that cannot be straight", SWIVEL_TARGET, Float3{0, 0, 3});
        bound.with("an elbow that cannot fold", SWIVEL_TARGET, Float3{0, 0, 0.1f});
        bound.write(SWIVEL_FLEXION_LIMIT, Float2{1, 0});
        bound.write(SWIVEL_REACH, Float4{0.2f, 0, 1, 0});
        bound.with("a soft zone", SWIVEL_TARGET, Float3{0, 0, 1.9f});
        bound.with("an effector", SWIVEL_EFFECTOR, Float3{0.1f, 0, 0});
        bound.write(SWIVEL_TARGET, Float3{0, 0, 2.7f});
        bound.with("stretched", SWIVEL_REACH, Float4{0, 0, 1.25f, 0});
    }

    Told aims(texts, "an arm that aims", SWIVEL_WITH_AIM);
    aims.write(SWIVEL_AIM, aim({0, 0.3, 1}, 1.2));
    aims.with("from where it can", SWIVEL_TARGET, Float3{0.3f, 2, 3});
    aims.with("too near", SWIVEL_TARGET, Float3{0, 0, 0.01f});
}

void tell_of_limits(ApprovedTexts& texts)
{
    Told limited(texts, "limits of the elbow's place", SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST);
    limited.with("a cone on the other side", SWIVEL_SHOULDER_CONE, cone({0, 1, 0.2}, 0.5));
    limited.with("a cone that no place keeps", SWIVEL_SHOULDER_CONE, cone({0, -1, 0}, 0.5));
    limited.with("a twist, too", SWIVEL_HUMERAL_TWIST, range(2, 2.1));

    Told edge(texts, "a straight arm at the edge of a cone", SWIVEL_WITH_SHOULDER_CONE);
    edge.write(SWIVEL_TARGET, Float3{0, 0, 3});
    edge.with("outside by 0.003 degrees", SWIVEL_SHOULDER_CONE, cone({0, 1, 0}, degrees(89.997)));

    Told box(texts, "a box of the shoulder", SWIVEL_WITH_SHOULDER_BOX);
    Float12 ranges;
    for (std::size_t k = 0; k < 3; ++k) std::ranges::copy(range(-0.5, k == 1 ? 1.6 : 0.5), ranges.begin() + 4 * k);
    box.write(SWIVEL_TARGET, Float3{1.95f, 0, 0});
    box.write(SWIVEL_POLE, Float3{0, 1, 0.2f});
    box.with("near its pole", SWIVEL_SHOULDER_BOX, ranges);
    box.with("far from it", SWIVEL_TARGET, Float3{0.2f, 0.2f, 1.5f});

    Told hand(texts, "limits of the hand", SWIVEL_WITH_HAND | SWIVEL_WITH_WRIST_BOX | SWIVEL_WITH_HAND_CONE);
    for (std::size_t k = 0; k < 3; ++k) std::ranges::copy(range(-0.2, 0.2), ranges.begin() + 4 * k);
    hand.write(SWIVEL_HAND_CONE, cone({0, 0, 1}, 0.3));
    hand.with("none kept", SWIVEL_WRIST_BOX, ranges);

    Told step(texts, "a step from solve to solve", SWIVEL_WITH_MAX_SWIVEL | SWIVEL_WITH_SHOULDER_CONE);
    step.write(SWIVEL_MAX_SWIVEL, cos_sin(0.3));
    step.solved("at first");
    step.write(SWIVEL_POLE, Float3{1, 5, 3});
    step.says("another pole");
    step.solved("a step later");
    std::vector<std::array<double, 3>> elbow(1);
    step.crowd.elbows(0, elbow);
    step.write(SWIVEL_SHOULDER_CONE, cone(elbow[0], 0.1));
    step.says("a cone about the elbow");
    step.solved("where the step ends");
    step.with("a cone out of reach", SWIVEL_SHOULDER_CONE, cone({-1, 0, -1}, 0.1));

    for (const double opening : {1.0, 0.2}) {  // the upper arm is asin(sqrt(5) / 3) from the line to the target
        Told way(texts, opening == 1 ? "an elbow on its way" : "an elbow on its way to where no limit is kept",
                 SWIVEL_WITH_MAX_SWIVEL | SWIVEL_STEP_WINS | SWIVEL_WITH_SHOULDER_CONE);
        way.write(SWIVEL_LENGTHS, Float2{0.3f, 0.3f});
        way.write(SWIVEL_TARGET, Float3{0, 0, 0.4f});
        way.write(SWIVEL_MAX_SWIVEL, cos_sin(0.1));
        way.with("at first", SWIVEL_POLE, Float3{1, 0, 0});
        way.with("a step later", SWIVEL_SHOULDER_CONE, cone({-1, 0, 0}, opening));
        for (int n = 0; n < 40; ++n) way.crowd.solve();
        way.solved("40 steps later");
        way.write(SWIVEL_SHOULDER_CONE, cone({0, 0, 1}, 2));  // which the wish keeps
        way.with("another pole", SWIVEL_POLE, Float3{1, 0.1f, 0});
    }

    swivel_region about_z = swivel_default_region();
    const swivel_region_cone half{{0, 0, 1}, 0.5f};
    REQUIRE(swivel_region_add_cones(&about_z, &half, 1, 0) == SWIVEL_OK);
    swivel_limb_def about = limbs(1, SWIVEL_WITH_REGION);
    about.region = &about_z;
    Told region(texts, "a region", 0);
    region.crowd = Crowd(about);
    region.write(SWIVEL_LENGTHS, Float2{1, 1});
    region.write(SWIVEL_POLE, Float3{0, 5, 0});
    // The upper arm is 60 degrees from the line to the target, and that 40.1 degrees from +z. So the wish is 60 + 40.1
    // degrees off, and some swivel is within the cone's 28.65.
    region.with("a target beside it", SWIVEL_TARGET, Float3{0, 0.644f, 0.765f});
    region.with("a target in its middle, 60 - 28.65 degrees off", SWIVEL_TARGET, Float3{0, 0, 1});
}

}  // namespace

TEST_CASE("explain speaks of limbs as approved")
{
    ApprovedTexts texts("limbs.txt");
    tell_of_inputs(texts);
    tell_of_reach(texts);
    tell_of_limits(texts);
    texts.compare();
}

TEST_CASE("explain says by which angles a limit turned the elbow, or a pose that keeps not all is outside of each")
{
    Random random{8};
    constexpr std::uint32_t count = 150;
    const auto narrow = [&] { return AngleRange{random.between(-3, 3), random.between(0.05, 0.6)}; };
    int named = 0, turned = 0;
    for (const swivel_features limits :
         {kUpperArmLimits, kUpperArmLimits | SWIVEL_WITH_HAND_CONE,
          SWIVEL_WITH_FOREARM_TWIST | SWIVEL_WITH_HAND_TWIST | SWIVEL_WITH_SHOULDER_CONE,
          SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX, SWIVEL_WITH_WRIST_BOX | SWIVEL_WITH_HAND_CONE}) {
        const BoundLimb limb = bound_limb(random);
        swivel_limb_def def = swivel::limbs(count, kWorldJointsHand | limits);
        def.binding = limb.bound;
        def.shoulder_order = SWIVEL_ZXY;
        def.wrist_order = SWIVEL_YXZ;
        Crowd crowd(def), free = crowd_of(kWorldJointsHand, count, limb.bound);
        LimbLimits l(random, def.shoulder_order, def.wrist_order);
        // Without a hand's cone a wide twist of the upper arm lets many arms keep all limits.
        const bool has_hand_cone = limits & SWIVEL_WITH_HAND_CONE;
        l.draw(
            [&](const Limit& limit) {
                return limit.shape == LimitShape::axis_in_cone ? 0.3 : has_hand_cone ? 0.5 : 1.1;
            },
            [&](const Limit& limit) {
                return limit.field == SWIVEL_HUMERAL_TWIST && !has_hand_cone ? AngleRange{0.1, 1.6} : narrow();
            });
        each_limit(l, [&](swivel_field field, const auto& value) {
            if (swivel_field_row_count(crowd.get(), 0, field)) crowd.write_all(field, 0, value);
        });
        std::vector<Limb> limbs;
        for (std::uint32_t n = 0; n < count; ++n) {
            limbs.push_back(random_limb(random, kWorldJointsHand, {limb.bound.lengths[0], limb.bound.lengths[1]}));
            for (Crowd* const each : {&crowd, &free}) write_limb(*each, 0, n, limbs[n]);
        }
        crowd.solve();
        free.solve();
        const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
        std::vector<std::array<double, 3>> elbow(count), wished(count);
        crowd.elbows(0, elbow);
        free.elbows(0, wished);
        for (std::uint32_t n = 0; n < count; ++n) {
            const std::string text = explain(crowd, 0, n);
            INFO(text);
            const LocalPose q = added_to_rest(local_pose(crowd, n), limb.bound);
            const std::size_t violates = text.find("Its pose violates");
            REQUIRE((violates != std::string::npos) == ((flags[n] & SWIVEL_INFEASIBLE) != 0));
            for (const Limit& limit : l.each) {
                const bool has_limit = limits & limit.feature;
                const std::string name = describe(limit.field).name;
                if (violates == std::string::npos) {
                    CHECK((text.find(name) != std::string::npos) == ((flags[n] & flag_of(limit.field)) != 0));
                    continue;
                }
                const double degrees_off = off_limit(limit, q) / degrees(1);
                const std::string pose = text.substr(violates);
                const bool is_named = pose.find(name + " by") != std::string::npos;
                if (!has_limit || degrees_off < -0.03) CHECK_FALSE(is_named);
                if (has_limit && degrees_off > 0.03) {
                    REQUIRE(is_named);
                    CHECK(number_after(pose, name + " by") == Approx(degrees_off).margin(0.03));
                    ++named;
                }
            }
            if (text.find("keeps all limits is ") == std::string::npos) continue;
            const Vector3d line = (vec(limbs[n].target) - vec(limbs[n].position)).normalized();
            const auto across = [&](const std::array<double, 3>& at) {
                const Vector3d v = Vector3d(at.data()) - vec(limbs[n].position);
                return Vector3d(v - v.dot(line) * line);
            };
            CHECK(number_after(text, "keeps all limits is ") ==
                  Approx(angle_between(across(elbow[n]), across(wished[n])) / degrees(1)).margin(0.11));
            ++turned;
        }
    }
    CHECK(named > 500);
    CHECK(turned > 20);
}

TEST_CASE("explain says how far a limit turned the elbow of an arm that aims, about the line to its target")
{
    Random random{11};
    constexpr std::uint32_t count = 300;
    Crowd crowd = crowd_of(SWIVEL_WITH_AIM | SWIVEL_WITH_SHOULDER_CONE, count), free = crowd_of(SWIVEL_WITH_AIM, count);
    std::vector<Float3> targets;
    std::vector<std::array<float, 5>> aims;
    std::vector<Float3> poles;
    for (std::uint32_t n = 0; n < count; ++n) {
        const Vector3d ray = random.direction();
        targets.push_back(floats(random.vector(2, 8)));
        aims.push_back(aim({ray.x(), ray.y(), ray.z()}, random.between(0.2, 2)));
        poles.push_back(floats(random.vector(1, 2)));
    }
    for (Crowd* const each : {&crowd, &free}) {
        each->write_all(SWIVEL_LENGTHS, 0, Float2{1, 0.8f});
        each->write(SWIVEL_TARGET, 0, targets);
        each->write(SWIVEL_AIM, 0, aims);
        each->write(SWIVEL_POLE, 0, poles);
    }
    crowd.write_all(SWIVEL_SHOULDER_CONE, 0, cone({0, 0, 1}, 1));
    crowd.solve();
    free.solve();
    std::vector<std::array<double, 3>> elbow(count), wished(count);
    crowd.elbows(0, elbow);
    free.elbows(0, wished);
    int turned = 0;
    for (std::uint32_t n = 0; n < count; ++n) {
        const std::string text = explain(crowd, 0, n), words = "keeps all limits is ";
        if (text.find(words) == std::string::npos) continue;
        const Vector3d line = vec(targets[n]).normalized();
        const auto across = [&](const std::array<double, 3>& at) { return Vector3d(line.cross(Vector3d(at.data()))); };
        INFO(text);
        CHECK(number_after(text, words) ==
              Approx(angle_between(across(elbow[n]), across(wished[n])) / degrees(1)).margin(0.11));
        ++turned;
    }
    CHECK(turned > 20);
}

TEST_CASE("SWIVEL_EXPLANATION_BYTES hold the longest text, of a limb whose every input is bad")
{
    const swivel_features all = all_beside(kWorldJointsHand, kPoleFeatures | SWIVEL_WITH_REGION),
                          aim = kWorldJointsHand | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_AIM;
    Random random{10};
    for (const swivel_features features : {all, aim}) {
        Crowd crowd = crowd_of(features, 1, bound_limb(random).bound);
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
            CHECK(explain(crowd, 0, 0) == whole);  // however long
        }
    }
}
