// SPDX-License-Identifier: MIT
//
// The promise: swivel_explain() says of a planted limb why it stands or slides, with numbers that the animation and the
// places of its target confirm. Of a shift it says where it goes; calls that need a limb refuse one.
#include "tests/gliding_leg.h"
#include "tests/test_random.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr double kLength = GlidingLeg::kLength;
constexpr float kFrame = GlidingLeg::kFrame;
constexpr swivel_features kPlants = GlidingLeg::kPlants;

// The first number after these words.
double number_after(const std::string& text, const std::string& words)
{
    const std::size_t at = text.find(words);
    INFO(text << " lacks " << words);
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + words.size()));
}
bool has(const std::string& text, const std::string& part)
{
    INFO(text);
    return text.find(part) != std::string::npos;
}
Catch::Detail::Approx four_digits(double x) { return Approx(x).epsilon(6e-4).margin(2e-6); }

swivel_plant with(float swivel_plant::*member, float value)
{
    swivel_plant plant = swivel_default_plant();
    plant.*member = value;
    return plant;
}

}  // namespace

TEST_CASE("explain says that a planted point runs in, for how long and how far, and then that it stands")
{
    GlidingLeg leg;
    leg.glide(0, 0.5, 3);
    leg.glide(1, 0.5);
    std::vector<std::string> texts = {leg.text()};
    for (int n = 0; n < 8; ++n) {
        leg.glide(1, 0);
        texts.push_back(leg.text());
    }
    const Vector3d anchor = leg.sent.back();
    for (std::size_t n = 0; n < 5; ++n) {
        const std::string& text = texts[n];
        const double since = 1000 * double{kFrame} * static_cast<double>(n);
        CHECK(number_after(text, "it locked ") == Approx(since));
        CHECK(number_after(text, "comes to rest in ") == Approx(100 - since));
        CHECK(number_after(text, " ms, ") == four_digits((leg.sent[3 + n] - anchor).norm()));
    }
    CHECK(number_after(texts[0], " ms, ") > 5e-3);
    for (std::size_t n = 5; n < 9; ++n)
        CHECK(texts[n].starts_with("It is planted, and its target stands. The target is"));
    leg.crowd.write_all(SWIVEL_CONTACT, 0, std::array{0.4f});
    CHECK(has(leg.text(), "Its label of contact is 0.4 by now: the next solve releases it."));
}

TEST_CASE("explain warns of what is in another unit or from another origin")
{
    constexpr swivel_features kStands = kPlants | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_GROUND;
    const auto warning = [](GlidingLeg& leg) {
        leg.glide(1, 0, 30);
        const std::string text = leg.text();
        return text.starts_with("Warning: ") ? text.substr(9, text.find('.') - 9) : "";
    };
    GlidingLeg leg(kStands);
    CHECK(warning(leg).empty());
    leg.stretch = 1.8f;
    CHECK(warning(leg).empty());
    leg.stretch = 2;
    CHECK(warning(leg) == "its bones are 2 times as long as the skeleton's");
    leg.stretch = 0.5f;
    CHECK(warning(leg) == "its bones are 0");  // 0.5

    GlidingLeg effector(kStands);
    for (const auto& [length, warns] : {std::pair{8.9f, false}, {11.0f, true}}) {
        effector.crowd.write_all(SWIVEL_EFFECTOR, 0, std::array{0.0f, 0.0f, length});
        CHECK(has(warning(effector) + ".", warns ? "its effector is 12" : "."));
    }
    GlidingLeg target(kPlants | SWIVEL_WITH_WEIGHTS);
    for (const auto& [weight, warns] : {std::pair{1.0f, true}, {0.0f, false}}) {
        target.crowd.write_all(SWIVEL_TARGET, 0, std::array{0.0f, 13.0f, 0.0f});
        target.crowd.write_all(SWIVEL_WEIGHTS, 0, std::array{weight, 1.0f, 1.0f});
        CHECK(warning(target).starts_with(warns ? "its target is 1" : ""));
        CHECK(warning(target).empty() == !warns);
    }
    GlidingLeg ground(kStands);
    for (const auto& [height, warns] : {std::pair{8.0f, false}, {50.0f, true}}) {
        ground.crowd.write_all(SWIVEL_GROUND, 0, std::array{0.0f, height, 0.0f});
        ground.crowd.write_all(SWIVEL_GROUND_NORMAL, 0, std::array{0.0f, 1.0f, 0.0f});
        CHECK((ground.glide(1, 0, 30), has(ground.text() + ".", "the ground below it is 55")) == warns);
    }
    GlidingLeg far;
    far.root[0] = 1e5f;
    CHECK(has(warning(far), "its point is 1e+05 from the support that it is planted on"));
    GlidingLeg near;
    near.root[0] = near.support[0] = 1e5f;
    CHECK(warning(near).empty());
    near.time = 16;
    CHECK(warning(near) == "the last solve had a time of 16 seconds");
}

TEST_CASE("explain warns where all bodies are reset before each solve")
{
    GlidingLeg leg;
    for (const bool warns : {false, true, true}) {
        leg.crowd.reset(0);
        leg.glide(1, 0.5);
        CHECK(leg.text().starts_with("Warning: all bodies were reset before each of the last ") == warns);
    }
    leg.glide(1, 0.5);
    CHECK(!leg.text().starts_with("Warning: all"));
}

TEST_CASE(
    "explain warns of a solve without time that writes over the pose, which a pause would correct again and again")
{
    GlidingLeg leg;
    const std::string warning = "Warning: the last solve had a time of 0 and wrote its results over the pose.";
    for (const auto& [is_in_place, time, warns] :
         {std::tuple{true, 0.0f, true}, {false, 0.0f, false}, {true, GlidingLeg::kFrame, false}}) {
        leg.is_in_place = is_in_place;
        leg.time = time;
        leg.solve();
        CHECK(leg.text().starts_with(warning) == warns);
        CHECK(leg.text(SWIVEL_EVERY_GROUP).starts_with(warning) == warns);
        CHECK(has(leg.text(SWIVEL_EVERY_GROUP), warns ? "\ngroup 0: " : "group 0: "));
    }
}

TEST_CASE("explain says why a point is not locked: by its label, or by its motion and its bars")
{
    GlidingLeg leg;
    leg.glide(0.3f, 0.5, 3);
    CHECK(
        leg.text().starts_with("Its target is the animated point. It is not in contact: its label is 0.3, not above "
                               "0.5. The target is reached"));
    leg.crowd.write_all(SWIVEL_CONTACT, 0, std::array{0.9f});
    CHECK(has(leg.text(), "It is in contact by now: the next solve locks it."));
    leg.glide(0.9f, 0.5);
    CHECK(leg.text().starts_with("It is planted"));

    swivel_plant low = with(&swivel_plant::again, 0.07f);
    low.speed[0] = 0.55f, low.height[0] = 0.45f, low.height[1] = 0.5f;  // the ankle is 0.14 over the root
    GlidingLeg moves(kPlants | SWIVEL_PLANT_BY_MOTION, low);
    moves.glide(0, 0.8, 3);
    CHECK(number_after(moves.text(), "Its motion shows no contact, which begins below ") == Approx(0.55));
    CHECK(number_after(moves.text(), "limb lengths a second and ") == Approx(0.45));
    moves.glide(0, 0.1, 9);
    CHECK(moves.text().starts_with("It is planted, and its target stands."));
    moves.glide(0, 0.8);
    CHECK(moves.text().starts_with("It was just released, because its contact ended: the animated point is 0.0"));
    CHECK(number_after(moves.text(), "Its motion ends it above ") == Approx(0.8));
    CHECK(number_after(moves.text(), "limb lengths a second or ") == Approx(0.5));
}

TEST_CASE("explain says that a point was released, how far it is from the animation, and how it fades back")
{
    GlidingLeg leg;
    leg.glide(1, 0, 10);
    leg.glide(1, 0.4, 5);
    leg.glide(0, 0.4);
    CHECK((leg.flags() & SWIVEL_RELEASED) != 0);
    CHECK((leg.animated() - leg.sent.back()).norm() > 0.03);
    CHECK(number_after(leg.text(), "It was just released, because its contact ended: the animated point is ") ==
          four_digits((leg.animated() - leg.sent.back()).norm()));
    CHECK(number_after(leg.text(), "fades back, within ") == Approx(200));
    for (int n = 1; n <= 9; ++n) {
        leg.glide(0, 0.4);
        CHECK(number_after(leg.text(), "Its target fades back to the animated point: ") ==
              four_digits((leg.animated() - leg.sent.back()).norm()));
        CHECK(number_after(leg.text(), "is left, for ") == Approx(200 - 20 * n));
    }
    leg.glide(0, 0.4, 2);
    CHECK(leg.text().starts_with("Its target is the animated point. It is not in contact"));
    CHECK((leg.animated() - leg.sent.back()).norm() < 1e-6);
}

TEST_CASE("explain says that a point broke away by distance, and what it waits for")
{
    for (const auto& [again, scale] : {std::pair{0.06f, 1.0f}, {0.0f, 1.0f}, {0.06f, 2.5f}}) {
        GlidingLeg leg(kPlants, with(&swivel_plant::again, again));
        leg.scale = scale;
        const double length = kLength * double{scale}, speed = 0.5 * double{scale};
        leg.glide(1, 0, 10);
        while (!(leg.flags() & SWIVEL_RELEASED)) leg.glide(1, speed);
        const double distance = (leg.animated() - leg.sent.back()).norm();
        CHECK(distance > 0.24 * length);
        const std::string broke = leg.text();
        CHECK(number_after(broke, "locked than unlock, ") == Approx(0.24));
        CHECK(number_after(broke, "limb lengths. It is ") == four_digits(distance));
        leg.glide(1, speed, 2);
        const std::string waits = leg.text();
        CHECK(has(waits, "It broke away and is still in contact, so it waits to lock until"));
        CHECK(has(waits, " contact ends and begins anew."));
        CHECK(has(waits, "slower than again, 0.06 limb lengths a second, or") == (again > 0));
        CHECK(number_after(waits, "It cannot lock: ") ==
              Approx((leg.animated() - leg.sent.back()).norm() / length).epsilon(6e-3));
        CHECK(number_after(waits, "more than lock, ") == Approx(0.12));
        leg.glide(1, 0, 20);
        CHECK(leg.text().starts_with("It is planted") == (again > 0));
    }
}

TEST_CASE("explain says that an offset is too long to lock, and that a speed was cut")
{
    GlidingLeg leg;
    leg.glide(1, 0, 10);
    while (!(leg.flags() & SWIVEL_RELEASED)) leg.glide(1, 0.5);
    leg.glide(0, 0.5);
    leg.glide(1, 0.5);
    CHECK(!has(leg.text(), "waits"));
    CHECK(number_after(leg.text(), "It cannot lock: ") > 0.12);
    GlidingLeg fast;
    fast.glide(0, 8, 3);
    CHECK(!has(fast.text(), "was cut"));
    fast.glide(1, 8);
    CHECK((fast.flags() & SWIVEL_CUT) != 0);
    CHECK(has(fast.text(), "Its speed was too high to be eased away and was cut, so its target jumps."));
}

TEST_CASE("whatever happens, what explain says is what the flags say")
{
    Random random{3};
    int planted = 0, released = 0, broke = 0, cut = 0, free = 0;
    for (int n = 0; n < 60; ++n) {
        swivel_features features = kPlants;
        for (const swivel_features each :
             {SWIVEL_WITH_HAND, SWIVEL_PLANT_BY_MOTION, SWIVEL_WITH_WEIGHTS, SWIVEL_WITH_CAP, SWIVEL_WITH_FIT})
            if (random.below(2)) features |= each;
        if (features & SWIVEL_WITH_HAND && random.below(2)) features |= SWIVEL_WITH_PLANT_TURN;
        swivel_plant plant = with(&swivel_plant::run, static_cast<float>(random.unit()));
        plant.height[0] = plant.height[1] = 1;
        GlidingLeg leg(features, plant);
        for (int step = 0; step < 60; ++step) {
            const double speed = random.below(4) ? random.between(-1, 1) : random.between(-9, 9);
            leg.glide(random.below(5) ? 0.9f : 0.1f, speed, 1 + static_cast<int>(random.below(6)));
            const std::string text = leg.text();
            INFO(text);
            const std::uint32_t flags = leg.flags();
            const auto says = [&](const char* part) { return text.find(part) != std::string::npos; };
            CHECK((flags & SWIVEL_BAD_INPUT) == 0);
            CHECK(text.starts_with("It is planted") == ((flags & SWIVEL_PLANTED) != 0));
            CHECK(text.starts_with("It broke away") == ((flags & SWIVEL_BROKE_AWAY) != 0));
            CHECK((says("It was just released") || says("It broke away, though")) == ((flags & SWIVEL_RELEASED) != 0));
            CHECK(says("was cut") == ((flags & SWIVEL_CUT) != 0));
            CHECK(text.starts_with("Its target ") == ((flags & (SWIVEL_PLANTED | SWIVEL_RELEASED)) == 0));
            CHECK(!says("nan"));
            CHECK(text.ends_with("."));
            planted += (flags & SWIVEL_PLANTED) != 0, released += (flags & SWIVEL_RELEASED) != 0;
            broke += (flags & SWIVEL_BROKE_AWAY) != 0, cut += (flags & SWIVEL_CUT) != 0;
            free += text.starts_with("Its target ");
        }
    }
    CHECK(std::min({planted, released, broke, cut, free}) > 30);
}

TEST_CASE("explain says whether bones or a cap keep a limb from its planted point, and by how much")
{
    for (const swivel_features cap : {swivel_features{0}, SWIVEL_WITH_CAP}) {
        GlidingLeg leg(kPlants | cap, with(&swivel_plant::unlock, 5));
        leg.glide(1, 0, 3);
        leg.root[1] += 0.3f;
        leg.solve();
        const Vector3d hip = vec(leg.root) + Vector3d(0.1, 1, 0);
        const double posed = (leg.animated() - hip).norm(),
                     reach = cap ? posed + 0.01 * kLength : kLength,  // the margin that it starts with
            missed = (leg.sent.back() - hip).norm() - reach;
        CHECK(posed < 0.9);
        CHECK(leg.text().starts_with("It is planted, and its target stands. The target is "));
        CHECK(number_after(leg.text(), "The target is ") == four_digits(missed));
        CHECK(number_after(leg.text(), "the wrist is ") == four_digits(reach));
        CHECK(has(leg.text(), cap ? "as far as its cap let" : "as far as its bones let"));
        if (!cap) continue;
        leg.crowd.write_all(SWIVEL_CAP, 0, Float3{0.01f, 1, 0});  // as far as the bones reach
        leg.solve();
        CHECK(has(leg.text(), "as far as its bones let"));
    }
}

TEST_CASE("explain says how far weights take a limb from its planted point")
{
    GlidingLeg leg(kPlants | SWIVEL_WITH_WEIGHTS);
    leg.crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0.25f, 1, 1});
    leg.glide(1, 0, 10);
    leg.glide(1, 0.5, 5);
    const double missed = 0.75 * (leg.animated() - leg.sent.back()).norm();
    CHECK(leg.text().starts_with("It is planted, and its target stands. The blended target is reached."));
    CHECK(number_after(leg.text(), "With a position weight of 0.25, the wrist is ") == Approx(missed).epsilon(2e-3));
}

TEST_CASE("explain names what is bad of a planted limb: labels, what is given, and what only the pose has")
{
    GlidingLeg leg(kPlants | SWIVEL_WITH_HAND);
    const auto says = [&](const std::string& part) {
        leg.solve();
        CHECK((leg.flags() & SWIVEL_BAD_INPUT) != 0);
        return has(leg.text(), "Bad input: " + part) && has(leg.text(), "The limb keeps its incoming pose.");
    };
    leg.glide(1, 0, 3);
    CHECK(leg.text().starts_with("It is planted"));
    leg.crowd.write_all(SWIVEL_CONTACT, 0, std::array{1.5f});
    CHECK(leg.text().starts_with("Bad input: contact (1.5) is out of its range, 0 to 1."));  // before it is solved
    CHECK(says("contact (1.5) is out of its range, 0 to 1."));
    leg.crowd.write_all(SWIVEL_CONTACT, 0, std::array{kNan});
    CHECK(says("contact (nan) is not a number"));
    leg.crowd.write_all(SWIVEL_CONTACT, 0, std::array{1.0f});
    leg.crowd.write_all(SWIVEL_HAND, 0, Float4{0, 0, 0, 0});
    CHECK(says("hand (0, 0, 0, 0) is out of its range, a quaternion of length 1e-9 to 1e9"));
    leg.crowd.write_all(SWIVEL_HAND, 0, Float4{kNan, kNan, kNan, kNan});
    leg.crowd.write_all(SWIVEL_TARGET, 0, Float3{kInf, 0, 0});
    CHECK(says("target (inf, 0, 0) is out of its range, no further than 1e15"));
    leg.crowd.write_all(SWIVEL_TARGET, 0, Float3{kNan, kNan, kNan});
    for (const float time : {-0.1f, kNan, 1e16f}) {
        leg.time = time;
        CHECK(says("in the pose, the root, its time or support was not a number or out of its range, unless"));
    }
    leg.time = kFrame;
    leg.support[2] = kNan;
    CHECK(says("in the pose, the root, its time or support was not a number or out of its range, unless"));
    leg.support[2] = 0;
    const Float4 thigh = std::exchange(leg.rotations[1], Float4{0, 0, 0, 0});
    CHECK(says("in the pose, a rotation, place or scale of the limb's joints"));
    leg.rotations[1] = thigh;
    leg.solve();
    CHECK(leg.text().starts_with("It is planted"));
    CHECK(swivel_reset(leg.crowd.get(), 0, 0, 1) == SWIVEL_OK);
    CHECK(leg.text().starts_with("It was reset, so its planted point starts anew."));
}

TEST_CASE("explain names what is bad of a limb that fits")
{
    GlidingLeg leg(kPlants | SWIVEL_WITH_FIT | SWIVEL_WITH_COMING);
    leg.glide(1, 0, 3);
    const auto says = [&](swivel_field field, const auto& value, const auto& good, const std::string& part) {
        leg.crowd.write_all(field, 0, value);
        leg.solve();
        CHECK((leg.flags() & SWIVEL_BAD_INPUT) != 0);
        const bool is_said = has(leg.text(), "Bad input: " + part);
        leg.crowd.write_all(field, 0, good);
        return is_said;
    };
    CHECK(says(SWIVEL_FIT_WEIGHT, std::array{1.5f}, std::array{1.0f}, "fit_weight (1.5) is out of its range, 0 to 1."));
    CHECK(says(SWIVEL_COMING, Float3{0, kNan, 0}, Float3{0, 0, 0}, "coming (0, nan, 0) is not a number."));
    CHECK(says(SWIVEL_COMING_TIME, std::array{-1.0f}, std::array{1.0f},
               "coming_time (-1) is out of its range, 0 to 1e15."));
}

TEST_CASE("explain names the share of a body's clavicle")
{
    GlidingLeg limb(SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD | SWIVEL_WITH_CLAVICLE);
    limb.crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 0.2f, 0.1f});
    limb.crowd.write_all(SWIVEL_CLAVICLE, 0, std::array{1.5f});
    limb.solve();
    CHECK(has(limb.text(), "Bad input: clavicle (1.5) is out of its range"));
    CHECK(!has(limb.text(), "in the pose"));
}

TEST_CASE("a cap that binds is no limit of the flexion")
{
    GlidingLeg leg(kPlants | SWIVEL_WITH_CAP | SWIVEL_WITH_FLEXION_LIMIT, with(&swivel_plant::unlock, 5));
    leg.glide(1, 0, 3);
    leg.root[1] += 0.3f;
    leg.solve();
    CHECK((leg.flags() & SWIVEL_CLAMPED_FAR) != 0);
    CHECK((leg.flags() & SWIVEL_LIMITED_FLEXION) == 0);  // it is wide open
    CHECK(has(leg.text(), "as far as its cap let"));
}

TEST_CASE("explain says where a shift goes and whether all limbs reach there")
{
    GlidingLeg leg(kPlants | SWIVEL_WITH_FIT, with(&swivel_plant::unlock, 5));
    CHECK(leg.text(1) == "It was never solved, so it has no shift.");
    leg.glide(1, 0, 3);
    CHECK(leg.text(1) ==
          "The body is shifted by 0 along up, at 0 a second. All limbs that count reach from where it goes.");
    const auto shift = [&] {
        std::array<float, 3> is;
        leg.crowd.read(SWIVEL_SHIFT, 1, std::span(&is, 1));
        return is;
    };
    leg.root[1] += 0.15f;
    leg.solve();
    CHECK(shift()[0] < -1e-3f);
    CHECK(number_after(leg.text(1), "The body is shifted by ") == four_digits(double{shift()[0]}));
    CHECK(number_after(leg.text(1), "along up, at ") == four_digits(double{shift()[1]}));
    CHECK(has(leg.text(1), "All limbs that count reach"));
    leg.root[1] += 0.5f;
    leg.crowd.write_all(SWIVEL_SHIFT_WISH, 1, std::array{0.03f});
    leg.solve();
    CHECK(has(leg.text(1),
              "No shift from 0.1 limb lengths down to 0.05 up lets all limbs that count reach. The wish is 0.03."));
    leg.time = kNan;
    leg.solve();
    CHECK(has(leg.text(1), "Bad input: in the pose, its time, or the root's rotation or scale, was not a number"));
    leg.time = kFrame;
    leg.crowd.write_all(SWIVEL_SHIFT_WISH, 1, std::array{kInf});
    CHECK(leg.text(1) ==
          "Bad input: shift_wish (inf) is out of its range, no further than 1e15 from 0. The shift stays as "
          "it was.");
    std::array<char, 1> room;
    CHECK(swivel_explain(leg.crowd.get(), 1, 0, room.data(), 1) == SWIVEL_OK);
    CHECK(room[0] == 0);
}

TEST_CASE("what needs a limb refuses a shift in one line")
{
    GlidingLeg leg(kPlants | SWIVEL_WITH_FIT);
    leg.glide(1, 0, 3);
    std::array<double, 8> room{};
    swivel_arc arc;
    std::uint32_t count = 7;
    const swivel_out out = {room.data(), sizeof room}, none = {nullptr, 0};
    const auto is_named = [](const char* call) {
        return has(swivel_last_error(), std::string(call) + ": group 1 is SWIVEL_FIT, which is no limb");
    };
    CHECK_REFUSED(swivel_residuals(leg.crowd.get(), 1, 0, 1, out), SWIVEL_INVALID_ARGUMENT);
    CHECK(is_named("swivel_residuals"));
    CHECK_REFUSED(swivel_forward(leg.crowd.get(), 1, 0, 1, out, none, none), SWIVEL_INVALID_ARGUMENT);
    CHECK(is_named("swivel_forward"));
    CHECK_REFUSED(swivel_allowed_arcs(leg.crowd.get(), 1, 0, &arc, 1, &count), SWIVEL_INVALID_ARGUMENT);
    CHECK(is_named("swivel_allowed_arcs"));
    CHECK_REFUSED(swivel_joint_angles(leg.crowd.get(), 1, 0, 1, SWIVEL_XYZ, SWIVEL_XYZ, 0, out),
                  SWIVEL_INVALID_ARGUMENT);
    CHECK(is_named("swivel_joint_angles"));
    CHECK(count == 7);
    CHECK(room == std::array<double, 8>{});
}

TEST_CASE("a body is explained group after group, in a line each, as far as there is room")
{
    GlidingLeg leg(kPlants | SWIVEL_WITH_FIT);
    leg.glide(1, 0, 3);
    const std::string first = "group 0: " + leg.text(0), all = first + "\ngroup 1: " + leg.text(1);
    std::array<char, 2 * SWIVEL_EXPLANATION_BYTES> room{};
    CHECK(swivel_explain(leg.crowd.get(), SWIVEL_EVERY_GROUP, 0, room.data(), room.size()) == SWIVEL_OK);
    CHECK(room.data() == all);
    for (std::size_t size = 1; size < all.size(); size += 7) {
        room.fill('x');
        CHECK(swivel_explain(leg.crowd.get(), SWIVEL_EVERY_GROUP, 0, room.data(), size) == SWIVEL_OK);
        const std::string cut = room.data();
        CHECK(cut.size() < size);
        CHECK(room[size] == 'x');
        CHECK(cut.substr(0, cut.size() - std::min<std::size_t>(3, cut.size())) ==
              all.substr(0, cut.size() - std::min<std::size_t>(3, cut.size())));
    }
    CHECK_REFUSED(swivel_explain(leg.crowd.get(), SWIVEL_EVERY_GROUP, 1, room.data(), room.size()),
                  SWIVEL_INVALID_ARGUMENT);

    const Crowd free_limbs({group(3)});
    CHECK_REFUSED(swivel_explain(free_limbs.get(), SWIVEL_EVERY_GROUP, 0, room.data(), room.size()),
                  SWIVEL_INVALID_ARGUMENT);
    CHECK(has(swivel_last_error(), "this crowd has no bodies; name one of its 1 groups"));

    GlidingLeg unknown(kPlants & ~SWIVEL_WITH_RECORD);
    CHECK(swivel_explain(unknown.crowd.get(), SWIVEL_EVERY_GROUP, 0, room.data(), room.size()) == SWIVEL_OK);
    CHECK(room.data() == std::string("group 0: it has no SWIVEL_WITH_RECORD, so nothing is known of it."));
}
