// SPDX-License-Identifier: MIT
//
// The promise: a frame through the caller's arrays reads a limb before it writes it, and is refused where it is wrong.
// That it gives the bits of rows is test_bits.cpp's, of every field, stride and alignment the test `interface`'s.
#include "tests/solve_jobs.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

#include <algorithm>
#include <cmath>

using namespace swivel;
using namespace swivel::test;

TEST_CASE("bad input keeps the pose in a frame that is read and written in place")
{
    struct Pose {
        Float4 shoulder, elbow;
        Float3 target;
        std::uint32_t flags;
    };
    for (const bool on_this_thread : {false, true})
        for (const bool masked : {false, true}) {
            const std::uint32_t count = 100;
            swivel_group_def def = group_of(count);
            def.features = SWIVEL_JOINTS | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS;
            def.on_bad_input = SWIVEL_KEEP_POSE;
            Crowd crowd({def});
            crowd.write_all(SWIVEL_WEIGHTS, 0, Float3{0.5f, 1, 1});
            Random random{3};
            std::vector<Pose> poses(count);
            for (Pose& pose : poses) {
                pose = {floats(random.rotation()), floats(random.rotation()), floats(random.direction()), 7};
                if (random.below(2)) pose.target[1] = kNan;
            }
            const std::vector<Pose> before = poses;
            crowd.write_all(SWIVEL_TARGET, 0, Float3{1, 1, 1});
            crowd.write_all(SWIVEL_LENGTHS, 0, Float2{1, 1});
            crowd.solve();
            const auto had = read<Float4>(crowd, SWIVEL_SHOULDER);
            Frame frame;
            frame.in(SWIVEL_TARGET, {&poses[0].target, sizeof(Pose)});
            frame.in(SWIVEL_INCOMING_SHOULDER, {&poses[0].shoulder, sizeof(Pose)});
            frame.in(SWIVEL_INCOMING_ELBOW, {&poses[0].elbow, sizeof(Pose)});
            frame.out(SWIVEL_SHOULDER, {&poses[0].shoulder, sizeof(Pose)});
            frame.out(SWIVEL_FLAGS, {&poses[0].flags, sizeof(Pose)});
            frame.out(SWIVEL_ELBOW, {&poses[0].elbow, sizeof(Pose)});
            const std::vector<std::uint32_t> mask(4, 0xffffbfffu);
            const swivel_blocks all{0, swivel_block_count(crowd.get())};
            crowd.solve({.blocks = on_this_thread ? std::optional(all) : std::nullopt,
                         .mask = masked ? Given<std::uint32_t>(mask) : Given<std::uint32_t>(everything),
                         .frames = {frame},
                         .on_this_thread = on_this_thread});
            for (std::uint32_t n = 0; n < count; ++n) {
                const bool is_bad = std::isnan(before[n].target[1]), is_chosen = !masked || n % 32 != 14;
                INFO("limb " << n);
                CHECK((poses[n].flags == SWIVEL_BAD_INPUT) == (is_bad && is_chosen));
                CHECK((poses[n].flags == 7) == !is_chosen);
                CHECK((poses[n].shoulder == before[n].shoulder) == (is_bad || !is_chosen));
                CHECK((poses[n].elbow == before[n].elbow) == (is_bad || !is_chosen));
                CHECK((read<Float4>(crowd, SWIVEL_SHOULDER)[n] == had[n]) == (is_bad || !is_chosen));
            }
            const std::string says = crowd.explain(0, 0);
            CHECK(says.find(std::isnan(before[0].target[1]) ? "keeps the pose it had" : "reached") !=
                  std::string::npos);
        }
}

TEST_CASE("frames of an older header are read as far as they go, as far apart as the first says")
{
    constexpr std::size_t step = offsetof(swivel_frame, origin);  // as if a first release had no origins
    const swivel_group_def groups[] = {group_of(20), group_of(5)};
    Crowd framed = crowd_with(0, groups), rows = crowd_with(0, groups);
    alignas(swivel_frame) std::array<unsigned char, 2 * step> frames;
    std::vector<Float3> targets[] = {std::vector<Float3>(20, Float3{0, 1, 1}), std::vector<Float3>(5, Float3{1, 0, 1})};
    Frame own[2];
    for (std::uint32_t g = 0; g < 2; ++g) {
        swivel_frame frame = own[g].in(SWIVEL_TARGET, {targets[g].data(), sizeof(Float3)});
        frame.size = step;
        std::memcpy(frames.data() + g * step, &frame, step);
        for (Crowd* crowd : {&framed, &rows}) crowd->write_all(SWIVEL_LENGTHS, g, Float2{1, 1});
        rows.write(SWIVEL_TARGET, g, targets[g]);
    }
    rows.solve();
    REQUIRE(solve_frame(framed.get(), reinterpret_cast<const swivel_frame*>(frames.data())) == SWIVEL_OK);
    CHECK((all_words(framed) == all_words(rows)));
}

TEST_CASE("wrong frames are refused, name group and field, and change nothing")
{
    const swivel_group_def groups[] = {group_of(20), group_of(5)};
    Crowd crowd = crowd_with(0, groups);
    crowd.solve();
    swivel_crowd* const c = crowd.get();
    const auto before = all_words(crowd);
    const auto bad = SWIVEL_INVALID_ARGUMENT;
    float values[64] = {};
    swivel_frame frames[2] = {swivel_default_frame(), swivel_default_frame()};
    std::vector<swivel_frame_field> fields;
    const auto refuse = [&](const std::vector<swivel_frame_field>& of_second, const std::string& line) {
        fields = of_second;
        frames[1].fields = fields.data();
        frames[1].field_count = static_cast<std::uint32_t>(fields.size());
        CHECK_REFUSED(solve_frame(c, frames), bad);
        CHECK_THAT(swivel_last_error(), Catch::Contains(line));
        CHECK_REFUSED(solve_frame_blocks(c, frames, 1, 2), bad);
        CHECK_THAT(swivel_last_error(), Catch::Contains(line));
        CHECK((all_words(crowd) == before));
    };
    refuse({{SWIVEL_TARGET, values, 11}}, "group 1, target: stride 11 is smaller than a value, 12 bytes");
    refuse({{SWIVEL_POLE, values, 0}, {SWIVEL_ELBOW, values, 7}}, "group 1, elbow: stride 7 is smaller than a value");
    refuse({{SWIVEL_FLAGS, values, 0}}, "group 1, flags: ");  // one place for all: results cannot
    refuse({{SWIVEL_HAND, values, 16}}, "group 1, hand: not part of this group; create it with SWIVEL_WITH_HAND");
    refuse({{SWIVEL_PARENT_SCALE, values, 4}},
           "group 1, parent_scale: not part of this group; create it with SWIVEL_WORLD");
    refuse({{SWIVEL_INCOMING_WRIST, values, 16}}, "group 1, incoming_wrist: not part of this group; create it with ");
    refuse({{SWIVEL_CLAVICLE_TURN, values, 16}}, "create it with SWIVEL_WITH_CLAVICLE");
    refuse({{SWIVEL_POLE, values, 0}, {SWIVEL_POLE, values, 0}}, "frame of group 1 lists pole twice; list it once");
    refuse({{SWIVEL_INPUT_END, values, 0}}, "");
    frames[1].positions = SWIVEL_DOUBLES;
    refuse({{SWIVEL_TARGET, values, 24}},
           "target is in doubles, but floats are read without an origin; give floats, or an");
    frames[1].positions = SWIVEL_FLOATS;
    frames[1].origin = {values, 0};
    refuse({{SWIVEL_TARGET, values, 24}}, "target is in floats, but the frame has an origin; give doubles");
    frames[1].positions = 3;
    refuse({{SWIVEL_TARGET, values, 24}}, "positions is 3; it is a swivel_numbers, 0 to 2");
    frames[1].positions = SWIVEL_NUMBERS_UNSAID;
    frames[1].origin = {};
    for (const float x : values) CHECK(x == 0);
    CHECK(solve_frame_blocks(c, frames, 0, 2) == SWIVEL_OK);  // blocks of group 0 alone
    frames[1].fields = nullptr;
    CHECK_REFUSED(solve_frame(c, frames), bad);
    frames[1].field_count = 0;
    for (const std::uint32_t size : {0u, static_cast<std::uint32_t>(sizeof frames[0]) + 8}) {
        frames[0].size = size;
        CHECK_REFUSED(solve_frame(c, frames), bad);
    }
    frames[0].size = sizeof frames[0];
    CHECK_REFUSED(solve_frame(nullptr, frames), bad);
    CHECK_NOTHROW(crowd.solve({.frames = frames}));
    CHECK_THROWS_AS(crowd.solve({.frames = {frames, 1}}), Error);
}
