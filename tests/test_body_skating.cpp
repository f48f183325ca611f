// SPDX-License-Identifier: MIT
//
// The promise on recorded motion. Feet skate where legs do not fit a clip. Planted, capped and fitted, they hardly do.
// It prints what it measures: test_clips -# "[#test_body_skating]".
#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>

#include "tests/shared_figures.h"
#include "tests/skating.h"
#include "tools/formats/bvh.h"

namespace {

using namespace swivel::test;

struct Case {
    const char* words;
    const char* file;
    Retarget retarget;
    Skating before, after;
};
// 30 mm are the most that the root goes. A spring that makes up half of it in 0.1 s moves by 3.1 mm a frame at most.
constexpr double kMostShift = 3.1;
// What the formulas' prototype makes of the clips: a cap 8 mm beyond the clip, a pelvis that goes up or down by 30 mm.
const Case kCases[] = {
    {"walk, legs x 0.8",
     "cmu_02_01_walk.bvh",
     {.legs = 0.8},
     {.272, .598, 158, 6.3, 0},
     {.037, .489, 21, 11.8, kMostShift}},
    {"dance, legs x 0.8",
     "cmu_05_06_dance.bvh",
     {.legs = 0.8},
     {.142, .752, 63, 10.1, 0},
     {.028, .527, 12, 13.0, kMostShift}},
    {"jump, legs x 0.8",
     "cmu_01_01_forward_jump.bvh",
     {.legs = 0.8},
     {.088, .679, 112, 26.5, 0},
     {.008, .474, 10, 21.9, kMostShift}},
    {"walk, root x 1.25",
     "cmu_02_01_walk.bvh",
     {.way = 1.25},
     {.383, .870, 222, 6.3, 0},
     {.057, .640, 33, 11.0, kMostShift}},
};

void print(const char* words, const Skating& is)
{
    std::printf("%-20s %6.4f  %6.4f  %6.2f  %6.2f  %6.2f\n", words, is.mean, is.most, is.way, is.knee, is.shift);
}

// Within half of the last digit that the prototype's figures have.
void require_figures(const Skating& is, const Skating& wanted)
{
    REQUIRE(std::abs(is.mean - wanted.mean) <= 5e-4);
    REQUIRE(std::abs(is.most - wanted.most) <= 5e-4);
    REQUIRE(std::abs(is.way - wanted.way) <= 0.5);
    REQUIRE(std::abs(is.knee - wanted.knee) <= 0.05);
    REQUIRE(is.shift == wanted.shift);
}

// No worse than the prototype by more than a twentieth.
void require_as_good(const Skating& is, const Skating& wanted)
{
    REQUIRE(is.mean <= 1.05 * wanted.mean);
    REQUIRE(is.most <= 1.05 * wanted.most);
    REQUIRE(is.way <= 1.05 * wanted.way);
    REQUIRE(is.knee <= 1.05 * wanted.knee);
    REQUIRE(is.shift <= wanted.shift);
}

// How far a toe moves from frame to frame at most, mm, where it has been locked for longer than it takes to stop, and
// its leg reaches.
double slide_locked(const PlantedMotion& planted, const Planting& planting)
{
    const LegPlaces places = leg_places(planted.motion);
    double most = 0;
    int held = 0;
    for (std::size_t leg = 0; leg < 2; ++leg) {
        double locked = 0;  // s
        bool stood = false;
        for (std::size_t frame = 0; frame < planted.flags[leg].size(); ++frame) {
            const std::uint32_t flags = planted.flags[leg][frame];
            locked = flags & SWIVEL_PLANTED ? locked + kFrameTime : 0;
            const bool stands = flags & SWIVEL_REACHED && locked > planting.stop + kFrameTime;
            if (stands && stood) {
                most = std::max(most, 1e3 * (places.toes[leg][frame] - places.toes[leg][frame - 1]).norm());
                ++held;
            }
            stood = stands;
        }
    }
    REQUIRE(held > 20);
    return most;
}

}  // namespace

TEST_CASE("planted, capped and fitted legs hardly skate on the shared clips")
{
    std::printf("Toes in contact: m/s, mean and most; mm a step. A knee, degrees a frame; the root, mm a frame.\n");
    for (const Case& each : kCases) {
        const fs::path path = find_or_warn(each.file);
        if (path.empty()) continue;
        INFO(each.words);
        const swivel::formats::Clip clip = swivel::formats::read_bvh(path).clip;
        const Contacts contacts = contacts_of(leg_motion(clip));
        const LegMotion motion = leg_motion(clip, each.retarget);
        const Planting planting;
        const PlantedMotion solved = planted(motion, contacts, planting);
        const Skating before = skating_of(motion, contacts), after = skating_of(solved.motion, contacts);
        const double slide = slide_locked(solved, planting);
        print(each.words, before);
        print("  planted", after);
        print("  wanted within 5 %", each.after);
        std::printf("  locked and reached, a toe slides by %.4f mm a frame\n", slide);
        require_figures(before, each.before);
        require_as_good(after, each.after);
        REQUIRE(slide < 0.1);
    }
}
