// SPDX-License-Identifier: MIT
//
// The promise: whatever a planted leg does, swivel_explain() says what its flags say, and its numbers are right. It
// names each bad input with its range, and explains a whole body in the room that there is for the text.
#include "tests/approved_texts.h"
#include "tests/gliding_leg.h"
#include "tests/test_random.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr swivel_features kPlants = GlidingLeg::kPlants, kStands = GlidingLeg::kStands;

}  // namespace

TEST_CASE("explain names each bad input of a body, and its range as the library describes it")
{
    for (const swivel_features features :
         {kStands | SWIVEL_WITH_CAP, kPlants | SWIVEL_WITH_PELVIS_FIT | SWIVEL_WITH_NEXT_TARGET,
          swivel_features{SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD | SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_WEIGHTS}}) {
        GlidingLeg leg(features);
        if (!(features & SWIVEL_WITH_PLANT)) leg.crowd.write_all(SWIVEL_TARGET, 0, Float3{0, 0.2f, 0.1f});
        leg.glide(1, 0, 3);
        swivel_field_info field;
        for (std::uint32_t g = 0; g < leg.groups.size(); ++g)
            for (std::uint32_t n = 0; swivel_describe_field(n, &field); ++n) {
                const std::uint32_t size = swivel_field_row_count(leg.crowd.get(), g, field.field);
                // Ground that is out of its range is none, and no bad input.
                if (field.kind != SWIVEL_FIELD_INPUT || size == 0 || field.field == SWIVEL_GROUND) continue;
                std::vector<float> good(size), bad(size, 2e16f);  // which is out of every range
                const std::size_t bytes = size * sizeof(float);
                check(swivel_read(leg.crowd.get(), field.field, g, 0, 1, {good.data(), bytes}));
                check(swivel_write(leg.crowd.get(), field.field, g, 0, 1, {bad.data(), bytes}));
                for (const bool is_solved : {false, true}) {
                    if (is_solved) leg.solve();
                    if (!is_solved && field.field == SWIVEL_LENGTHS) continue;  // it tells of those of the last solve
                    INFO(leg.text(g));
                    CHECK_THAT(leg.text(g), Catch::Contains("Bad input: " + std::string(field.name) + " (2e+16"));
                    CHECK_THAT(leg.text(g),
                               Catch::Contains(") is out of its range, " + std::string(field.range) + "."));
                }
                if (g == 0) CHECK(leg.flags() == SWIVEL_BAD_INPUT);
                check(swivel_write(leg.crowd.get(), field.field, g, 0, 1, {good.data(), bytes}));
                leg.solve();
                CHECK_THAT(leg.text(g), !Catch::Contains("Bad input"));
            }
    }
}

TEST_CASE("whatever happens, explain says what the flags say, and how far the animated point and the target are")
{
    Random random{3};
    int planted = 0, released = 0, broke = 0, cut = 0, free = 0, far = 0;
    for (int n = 0; n < 60; ++n) {
        swivel_features features = kPlants;
        for (const swivel_features each :
             {SWIVEL_WITH_HAND, SWIVEL_PLANT_BY_MOTION, SWIVEL_WITH_WEIGHTS, SWIVEL_WITH_CAP, SWIVEL_WITH_PELVIS_FIT})
            if (random.below(2)) features |= each;
        if (features & SWIVEL_WITH_HAND && random.below(2)) features |= SWIVEL_WITH_PLANT_ROTATION;
        swivel_plant plant = plant_with(&swivel_plant::anchor_lead, static_cast<float>(random.unit()));
        plant.height[0] = plant.height[1] = 1;
        GlidingLeg leg(features, plant);
        leg.scale = static_cast<float>(random.spread(0.3, 3));
        for (int step = 0; step < 60; ++step) {
            const double speed = random.below(4) ? random.between(-1, 1) : random.between(-9, 9);
            if (random.below(5) == 0) leg.root[1] = static_cast<float>(random.between(-0.2, 0.2)) * leg.scale;
            leg.glide(random.below(5) ? 0.9f : 0.1f, double{leg.scale} * speed, 1 + static_cast<int>(random.below(6)));
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
            planted += (flags & SWIVEL_PLANTED) != 0, released += (flags & SWIVEL_RELEASED) != 0;
            broke += (flags & SWIVEL_BROKE_AWAY) != 0, cut += (flags & SWIVEL_CUT) != 0;
            free += text.starts_with("Its target ");

            const double offset = (leg.animated() - leg.sent.back()).norm(),
                         length = GlidingLeg::kLength * double{leg.scale};
            for (const char* const words : {"contact ended: the animated point is ", "limb lengths. It is ",
                                            "fades back to the animated point: "})
                if (says(words)) CHECK(number_after(text, words) == Approx(offset).epsilon(6e-4).margin(2e-6));
            if (says("It cannot lock: "))
                CHECK(number_after(text, "It cannot lock: ") == Approx(offset / length).epsilon(6e-3));
            if (!says(" out of reach: ") || says("blended") || features & SWIVEL_WITH_PELVIS_FIT) continue;
            const Vector3d hip = vec(leg.root) + double{leg.scale} * Vector3d(0.1, 1, 0);
            const double reach = number_after(text, "the wrist is ");
            CHECK(number_after(text, "The target is ") + reach == Approx((leg.sent.back() - hip).norm()).epsilon(1e-3));
            if (says("as its bones let")) CHECK(reach == Approx(length).epsilon(1e-3));
            ++far;
        }
    }
    CHECK(std::min({planted, released, broke, cut, free, far}) > 30);
}

TEST_CASE("explain says where a shift goes, and how far it still is from there where a leg does not reach")
{
    constexpr Float3 toe{0, -0.07f, 0.13f};
    int late = 0;
    for (const swivel_features features :
         {kPlants, kStands, kPlants | SWIVEL_WITH_CAP, kPlants | SWIVEL_WITH_WEIGHTS,
          kPlants | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR, kPlants | SWIVEL_WITH_CLAVICLE,
          swivel_features{SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD}})
        for (const float rise : {-0.2f, 0.02f, 0.08f, 0.12f, 0.4f}) {
            GlidingLeg leg(features | SWIVEL_WITH_PELVIS_FIT, plant_with(&swivel_plant::unlock_radius, 5));
            leg.scale = 1.5f;
            if (features & SWIVEL_WITH_EFFECTOR) leg.crowd.write_all(SWIVEL_EFFECTOR, 0, toe);
            if (features & SWIVEL_WITH_WEIGHTS) leg.crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0.5f, 1, 1});
            if (!(features & SWIVEL_WITH_PLANT)) leg.crowd.write_all(SWIVEL_TARGET, 0, floats(leg.animated()));
            const bool is_known = !(features & SWIVEL_WITH_CLAVICLE);  // which turns the shoulder after the shift
            if (!is_known) leg.crowd.write_all(SWIVEL_CLAVICLE, 0, std::array{0.3f});
            leg.glide(1, 0, 3);
            leg.root[1] += rise;
            leg.solve();
            const std::string told = leg.text(1), of_leg = leg.text(0);
            const std::uint32_t flags = leg.flags();
            const auto shift = [&] {
                std::array<float, 3> value;
                leg.crowd.read(SWIVEL_SHIFT, 1, std::span(&value, 1));
                return double{value[0]};
            };
            const double before = shift();
            leg.glide(1, 0, 200);
            const double way = shift() - before;
            INFO(told << " " << of_leg << " It ends at " << shift());
            const bool is_late = std::fabs(way) > 2e-4;
            REQUIRE((told.find("and goes to ") != std::string::npos) == (is_known && is_late));
            CHECK((told.find("which is where it goes.") != std::string::npos) == (is_known && !is_late));
            const bool speaks = of_leg.find("It counts for the body's shift, which still goes ") != std::string::npos;
            CHECK(speaks == (is_known && is_late && (flags & SWIVEL_CLAMPED_FAR)));
            if (!is_known || !is_late) continue;
            CHECK(number_after(told, "and goes to ") == Approx(shift()).margin(1e-5).epsilon(1e-3));
            CHECK(number_after(told, "spring is late by ") == Approx(std::fabs(way)).margin(1e-5).epsilon(1e-3));
            if (speaks)
                CHECK(number_after(of_leg, way < 0 ? "still goes down by " : "still goes up by ") ==
                      Approx(std::fabs(way)).margin(1e-5).epsilon(1e-3));
            ++late;
        }
    CHECK(late > 10);
}

TEST_CASE("explain does not say where a shift goes where it cannot tell, nor of a leg that does not count for it")
{
    const struct {
        const char* when;
        void (*prepare)(GlidingLeg& leg);
        bool is_known, counts;
    } cases[] = {
        {"all is known", [](GlidingLeg&) {}, true, true},
        {"the root is turned",
         [](GlidingLeg& leg) {
             leg.root_turn = {0, 0, std::sin(0.1f), std::cos(0.1f)};
         },
         false, true},
        {"joints have scales", [](GlidingLeg& leg) { leg.has_joint_scales = true; }, false, true},
        {"a look is above the leg",
         [](GlidingLeg& leg) {
             swivel_look_def look = swivel_default_look_def();
             look.joint_count = 1;  // the hips
             leg.groups.push_back(look);
             leg.crowd = Crowd(GlidingLeg::skeleton(), 1, leg.groups);
             leg.glide(1, 0, 3);
         },
         false, true},
        {"the job has a mask", [](GlidingLeg& leg) { leg.is_masked = true; }, false, true},
        {"the leg has bad input",
         [](GlidingLeg& leg) {
             leg.crowd.write_all(SWIVEL_CAP, 0, Float3{2, 2, 0});
         },
         false, true},
        {"the leg has no weight",
         [](GlidingLeg& leg) { leg.crowd.write_all(SWIVEL_PELVIS_FIT_WEIGHT, 0, std::array{0.0f}); }, true, false},
        {"the leg's target has no weight",
         [](GlidingLeg& leg) {
             leg.crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0, 1, 1});
         },
         true, false},
    };
    for (const auto& [when, prepare, is_known, counts] : cases) {
        GlidingLeg leg(kPlants | SWIVEL_WITH_CAP | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_PELVIS_FIT,
                       plant_with(&swivel_plant::unlock_radius, 5));
        leg.glide(1, 0, 3);
        leg.crowd.write_all(SWIVEL_SHIFT_WISH, 1, std::array{-0.05f});  // so the shift goes down without the leg, too
        prepare(leg);
        leg.root[1] += 0.15f;
        leg.solve();
        const std::string told = leg.text(1), of_leg = leg.text(0);
        INFO(when << ": " << told << " " << of_leg);
        CHECK((told.find("and goes to ") != std::string::npos) == is_known);
        CHECK(told.find("which is where it goes.") == std::string::npos);
        CHECK((of_leg.find("It counts for the body's shift") != std::string::npos) == (is_known && counts));
    }
}

TEST_CASE("a body is explained group after group, in a line each, as far as there is room")
{
    GlidingLeg leg(kPlants | SWIVEL_WITH_PELVIS_FIT);
    leg.glide(1, 0, 3);
    const std::string all = "group 0: " + leg.text(0) + "\ngroup 1: " + leg.text(1);
    const auto before = all_words(leg.crowd);
    for (const std::uint32_t group : {0u, 1u, std::uint32_t{SWIVEL_EVERY_GROUP}})
        check_room(group == SWIVEL_EVERY_GROUP ? all : leg.text(group),
                   [&](char* room, std::size_t size) { return swivel_explain(leg.crowd.get(), group, 0, room, size); });
    CHECK((all_words(leg.crowd) == before));
}
