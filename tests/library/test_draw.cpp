// SPDX-License-Identifier: MIT
//
// The promise: swivel_draw() draws each kind of shape where its feature is on, and nowhere else
// (test_draw_limits.cpp has those of limits). Misses are as long as residuals, and poles are where they were written.
// Shapes are finite, always the same ones in the same order, and named and coloured by their kinds; drawing allocates
// nothing (tests/drawn_shapes.h).
#include <catch2/catch.hpp>

#include <array>
#include <functional>

#include "tests/drawn_shapes.h"
#include "tests/posed_bodies.h"

using namespace swivel;
using namespace swivel::test;

namespace {

const KindNames kKept = {"miss", "incoming", "bend"};
const KindNames kSent = kKept + kAxes + KindNames{"goal"};
constexpr Float3 kFoot = {0.1f, 0.1f, 0.2f};

// The kinds that the leg of a figure has, which is solved as often.
KindNames leg_names(swivel_features features, const std::function<void(Crowd&)>& write, int frames = 1)
{
    Figure figure;
    Crowd crowd = figure.crowd({body_limb(figure.leg, features)});
    write(crowd);
    return names_of(figure.solved(crowd, frames), 0);
}
void write_foot(Crowd& crowd) { crowd.write_all(SWIVEL_TARGET, 0, kFoot); }
void write_contact(Crowd& crowd, float contact) { crowd.write_all(SWIVEL_CONTACT, 0, std::array{contact}); }

}  // namespace

TEST_CASE("a free limb's kinds follow from its features")
{
    const KindNames base = {"bone", "target", "miss", "pole"};
    CHECK(limb_names(free_limb(0)) == base);
    CHECK(limb_names(free_limb(SWIVEL_WITH_HAND)) == base + kAxes);
    CHECK(limb_names(free_limb(SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR)) == base + kAxes + KindNames{"effector"});
    CHECK(limb_names(SWIVEL_WITH_AIM, SWIVEL_AIM, aim({0, 0, 1}, 1)) == KindNames{"bone", "target", "pole", "sight"});
    CHECK(limb_names(free_limb(SWIVEL_POLE_NORMAL)) == KindNames{"bone", "target", "miss", "normal"});
    CHECK(limb_names(free_limb(SWIVEL_WORLD | SWIVEL_POLE_DIRECTION)) == base);
    CHECK(limb_names(free_limb(SWIVEL_POLE_HALF_LINE)) == base);
    CHECK(limb_names(free_limb(SWIVEL_WITH_INCOMING)) == base + KindNames{"incoming", "bend"});
    CHECK(limb_names(free_limb(SWIVEL_WITH_INCOMING | SWIVEL_POLE_INCOMING)) ==
          KindNames{"bone", "target", "miss", "incoming", "bend"});
    CHECK(limb_names(0, SWIVEL_TARGET, kNoPlace) == KindNames{"bone", "pole", "bad_input"});
}

TEST_CASE("a body's kinds follow from its groups")
{
    CHECK(leg_names(kFigureLimb, write_foot) == kKept + KindNames{"target"});
    CHECK(leg_names(kFigureLimb & ~SWIVEL_WITH_RECORD, write_foot) == KindNames{"target"});
    CHECK(leg_names(kFigureLimb, write_foot, 0) == KindNames{"target"});
    CHECK(leg_names(kFigureLimb, [](Crowd&) {}).count("bad_input") == 1);
    const swivel_features plants = kFigureLimb | SWIVEL_WITH_PLANT;
    CHECK(leg_names(
              plants, [](Crowd& crowd) { write_contact(crowd, 1); }, 3) == kSent + KindNames{"anchor"});
    CHECK(leg_names(
              plants, [](Crowd& crowd) { write_contact(crowd, 0); }, 3) == kSent);
    const swivel_features grounds = plants | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_GROUND;
    const auto write_ground = [](const Float3& place) {
        return [place](Crowd& crowd) {
            write_contact(crowd, 0);
            crowd.write_all(SWIVEL_GROUND, 0, place);
            crowd.write_all(SWIVEL_GROUND_NORMAL, 0, {0.0f, 1.0f, 0.0f});
        };
    };
    const KindNames on_ground = kSent + KindNames{"effector", "probe"};
    CHECK(leg_names(grounds, write_ground({0.1f, 0, 0})) == on_ground + KindNames{"ground"});
    CHECK(leg_names(grounds, write_ground(kNoPlace)) == on_ground);

    Figure figure;
    swivel_body_limb_def hand = body_limb(figure.arm, kFigureLimb | SWIVEL_WITH_LINK);
    hand.link = 3;
    Crowd all =
        figure.crowd({look({Figure::kHead}), swivel_default_shift_def(),
                      body_limb(figure.leg, kFigureLimb | SWIVEL_WITH_PELVIS_FIT), swivel_default_prop_def(), hand});
    all.write_all(SWIVEL_LOOK_TARGET, 0, {0.3f, 1.7f, 2.0f});
    all.write_all(SWIVEL_TARGET, 2, kFoot);
    all.write_all(SWIVEL_GRIP, 4, {0.0f, 0.1f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f});
    const Shapes shapes = figure.solved(all);
    CHECK(names_of(shapes, 0) == KindNames{"sight", "target"});
    CHECK(names_of(shapes, 1) == KindNames{"shift"});
    CHECK(names_of(shapes, 2) == kKept + KindNames{"target"});
    CHECK(names_of(shapes, 3) == kAxes + KindNames{"prop"});
    CHECK(names_of(shapes, 4) == kSent);
    for (const swivel_shape& bend : of_kind(shapes, SWIVEL_SHAPE_BEND)) {  // knees bend backwards, elbows forwards
        const double forwards = (end_of(bend) - start_of(bend)).normalized().z();
        CHECK((bend.group == 2 ? -forwards : forwards) > 0.99);
    }
    CHECK(swivel_reset(all.get(), 0, 0, 1) == SWIVEL_OK);
    CHECK(swivel_reset(all.get(), 1, 0, 1) == SWIVEL_OK);
    const Shapes anew = drawn_body(all, 0, figure.pose());
    CHECK(names_of(anew, 0) == KindNames{"target"});
    CHECK(names_of(anew, 1).empty());
}

TEST_CASE("misses are as long as residuals, and poles where they were written")
{
    Random random{8};
    for (const swivel_features features : {swivel_features{0}, SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR}) {
        for (int n = 0; n < 50; ++n) {
            Crowd crowd = free_limb(features | SWIVEL_WORLD);
            const Float3 pole = floats(random.vector(1, 5));
            crowd.write_all(SWIVEL_TARGET, 0, floats(Vector3d(Vector3d(1, 2, 3) + random.vector(0, 4))));
            crowd.write_all(SWIVEL_POLE, 0, pole);
            if (features) crowd.write_all(SWIVEL_EFFECTOR, 0, floats(random.vector(0, 0.2)));
            crowd.solve();
            std::array<double, 1> residual;
            crowd.residuals(0, residual);
            const Shapes shapes = drawn(crowd, 0, 0);
            CHECK(length_of(of_kind(shapes, SWIVEL_SHAPE_MISS).at(0)) == Approx(1.9 * residual[0]).margin(1e-6));
            CHECK(end_of(of_kind(shapes, SWIVEL_SHAPE_POLE).at(0)) == vec(pole));
        }
    }
}
