// SPDX-License-Identifier: MIT
//
// The promise: a call with a wrong argument is refused in one line, which names group, field and what is wrong. It
// writes nothing, neither to the crowd nor to the caller. Each line is a call that is right but for one argument. The
// test `interface` has wrong ranges, strides and jobs of most calls in any order; here are their words.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <cstring>

#include "swivel/swivel_explain.h"
#include "tests/posed_bodies.h"
#include "tests/refused_definitions.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

using H = HoldingBodies;

constexpr std::uint32_t kNoSuchThing = 77;

swivel_job job_with(const swivel_pose* pose)
{
    swivel_job job = swivel_default_job();
    job.pose = pose;
    return job;
}

// Where calls would write.
struct Outputs {
    float floats[16], urgency[3];
    double doubles[16];
    std::uint32_t words[16], count;
    std::uint16_t halves[16 * SWIVEL_LANES];
    swivel_arc arc;
    swivel_shape shape;
    char text[8];
    int agrees;
};

// What the calls are about.
struct Called : Outputs {
    Random random{5};
    Crowd crowd, directions;  // of free limbs: 20 and 5, in 3 blocks
    HoldingBodies made{random, 3, PoseLayout{}};
    Crowd bodies = made.crowd();
    PoseBuffer poses{made.layout, made.bodies};
    swivel_pose pose = made.view(poses);
    swivel_binding binding = bound_limb(random).bound;
    float in[16] = {1, 2, 3}, priority = 1;
    const double zeros[3] = {}, nans[3] = {0, std::nan(""), 0}, up[3] = {0, 1, 0}, far[3] = {0, 2e15, 0};

    Called()
        : crowd(crowd_with(SWIVEL_WORLD | SWIVEL_WITH_ANGLE, {group_of(20), group_of(5)})),
          directions(crowd_with(SWIVEL_WORLD | SWIVEL_POLE_DIRECTION, {group_of(5)}))
    {
        crowd.solve();
        std::memset(static_cast<Outputs*>(this), 0x7a, sizeof(Outputs));
    }
    std::string output_bytes() const
    {
        std::string bytes(sizeof(Outputs), '\0');
        std::memcpy(bytes.data(), static_cast<const Outputs*>(this), sizeof(Outputs));
        return bytes;
    }
    swivel_out out(std::size_t stride) { return {doubles, stride}; }

    swivel_status solve_bodies(const swivel_job& job) { return swivel_solve(bodies.get(), &job); }
    swivel_status solve_groups(std::initializer_list<std::uint32_t> named)
    {
        std::uint32_t bits = 0;
        for (const std::uint32_t g : named) bits |= 1u << g;
        swivel_job job = job_with(&pose);
        job.groups = &bits, job.group_word_count = 1;
        return solve_bodies(job);
    }
    swivel_status choose(const swivel_in* priorities, std::uint32_t* mask, std::uint32_t word_count)
    {
        return swivel_choose(crowd.get(), priorities, urgency, 1, mask, word_count, &count);
    }
    swivel_status compare(const swivel_crowd* asked, std::uint32_t group, std::uint32_t body, const swivel_pose* with,
                          const double* elbow, char* room, std::size_t size)
    {
        return swivel_compare(asked, group, body, with, up, elbow, up, room, size, &agrees);
    }
    swivel_status draw(const swivel_crowd* asked, std::uint32_t group, std::uint32_t limb, const swivel_pose* with)
    {
        return swivel_draw(asked, group, limb, with, &shape, 1, &count);
    }
};

// Checks calls that were refused, and that nothing of all this has changed in the end.
struct Unchanged {
    Called& c;
    const std::vector<std::uint32_t> free = all_words(c.crowd), directed = all_words(c.directions),
                                     of_bodies = all_words(c.bodies);
    const std::vector<unsigned char> poses = c.poses.bytes;
    const std::string outputs = c.output_bytes();

    void operator()(swivel_status status, const char* words) const
    {
        CHECK(status == SWIVEL_INVALID_ARGUMENT);
        CHECK(is_one_line(swivel_last_error()));
        CHECK_THAT(swivel_last_error(), Catch::Contains(words));
        swivel_use_isa("no such thing");  // another line
    }
    ~Unchanged()
    {
        CHECK(all_words(c.crowd) == free);
        CHECK(all_words(c.directions) == directed);
        CHECK(all_words(c.bodies) == of_bodies);
        CHECK(c.poses.bytes == poses);
        CHECK(c.output_bytes() == outputs);
    }
};

}  // namespace

TEST_CASE("reads and writes with wrong arguments are refused")
{
    Called c;
    const Unchanged refused{c};
    swivel_crowd *const crowd = c.crowd.get(), *const bodies = c.bodies.get(), *const directions = c.directions.get();
    refused(swivel_write(nullptr, SWIVEL_TARGET, 0, 0, 1, {c.in, 12}), "crowd is null");
    refused(swivel_write(crowd, SWIVEL_TARGET, 1, 0, 1, {c.in, 4}),
            "group 1, target: stride 4 is smaller than a value, 12 bytes");
    refused(swivel_write(crowd, SWIVEL_POLE, 0, 0, 1, {nullptr, 12}), "group 0, pole: data is null");
    refused(swivel_write(crowd, SWIVEL_HAND, 1, 0, 1, {c.in, 0}),
            "group 1, hand: not part of this group; create it with SWIVEL_WITH_HAND");
    refused(swivel_write(bodies, SWIVEL_PARENT_SCALE, H::free, 0, 1, {c.in, 0}),
            "group 4, parent_scale: the pose of a body gives it; leave it out");
    refused(swivel_write(bodies, SWIVEL_TARGET, H::prop, 0, 1, {c.in, 0}),
            "group 0, target: the group is a prop, which has none");
    refused(swivel_write(bodies, SWIVEL_GRIP, H::shift, 0, 1, {c.in, 0}),
            "group 7, grip: the group is a body's shift, which has none");
    refused(swivel_write(bodies, SWIVEL_LOOK_TARGET, H::free, 0, 1, {c.in, 0}),
            "group 4, look_target: the group is a body's limb, which has none");
    refused(swivel_write(crowd, SWIVEL_HAND_BLEND, 1, 0, 1, {c.in, 0}),
            "group 1, hand_blend: the group is a free limb, which has none");
    refused(swivel_write(crowd, SWIVEL_CONTACT, 0, 0, 1, {c.in, 0}),
            "group 0, contact: the group is a free limb, which has none");
    refused(swivel_write(crowd, SWIVEL_FLAGS, 0, 0, 1, {c.in, 0}),
            "flags is a result; swivel_write takes inputs and what is carried");
    refused(swivel_write(crowd, SWIVEL_INPUT_END, 0, 0, 1, {c.in, 0}), "there is no field ");
    refused(swivel_write(crowd, SWIVEL_TARGET, 2, 0, 1, {c.in, 12}), "group 2 does not exist; this crowd has 2");
    refused(swivel_read(crowd, SWIVEL_TARGET, 0, 1, ~0u, c.out(12)),
            "4294967295 limbs from limb 1 on are not all in group 0, which has 20");
    refused(swivel_reset(nullptr, 0, 0, 1), "crowd is null");
    refused(swivel_reset(crowd, 1, 3, 3), "3 limbs from limb 3 on are not all in group 1, which has 5");
    refused(swivel_pack(crowd, 0, {1, ~0u}, c.halves), "blocks 1 + 4294967295 are out of range; group 0 has 2");

    const char* const unequal = ": group 1 has 5 limbs, group 0 has 20; a body has a limb of each";
    refused(swivel_save(nullptr, 0, 1, c.halves, sizeof c.halves), "crowd is null");
    refused(swivel_load(nullptr, 0, 1, c.halves, sizeof c.halves), "crowd is null");
    refused(swivel_reset_body(nullptr, 0, 1), "crowd is null");
    refused(swivel_save(crowd, 0, 1, c.halves, sizeof c.halves), ("swivel_save" + std::string(unequal)).c_str());
    refused(swivel_load(crowd, 0, 1, c.halves, sizeof c.halves), ("swivel_load" + std::string(unequal)).c_str());
    refused(swivel_reset_body(crowd, 0, 1), ("swivel_reset_body" + std::string(unequal)).c_str());
    refused(swivel_save(bodies, 1, 3, c.halves, sizeof c.halves),
            "swivel_save: 3 bodies from body 1 on are not all in this crowd, which has 3");
    refused(swivel_load(bodies, 4, 0, c.halves, sizeof c.halves),
            "swivel_load: 0 bodies from body 4 on are not all in this crowd, which has 3");
    refused(swivel_reset_body(bodies, 2, ~0u), "swivel_reset_body: 4294967295 bodies from body 2 on are not all in");
    refused(swivel_save(bodies, 0, 1, nullptr, 512), "swivel_save: bytes is null");
    refused(swivel_load(bodies, 0, 1, nullptr, 512), "swivel_load: bytes is null");
    const std::size_t each = swivel_state_bytes(bodies);
    REQUIRE(each <= sizeof c.halves);
    const std::string sizes = "size is " + std::to_string(each - 1) + ", but 1 bodies have " + std::to_string(each);
    refused(swivel_save(bodies, 0, 1, c.halves, each - 1), ("swivel_save: " + sizes).c_str());
    refused(swivel_load(bodies, 0, 1, c.halves, each - 1), ("swivel_load: " + sizes).c_str());
    refused(swivel_load(bodies, 0, 1, c.halves, each), "swivel_load: state 0 is of another kind of crowd");

    refused(swivel_read(crowd, SWIVEL_ELBOW, 0, 0, 1, c.out(0)),
            "group 0, elbow: stride 0 is smaller than a value, 8 bytes");
    refused(swivel_read(crowd, SWIVEL_WRIST, 0, 0, 1, c.out(16)),
            "group 0, wrist: not part of this group; create it with SWIVEL_WITH_HAND");
    refused(swivel_read(bodies, SWIVEL_TWIST_BONES, H::free, 0, 1, c.out(16)),
            "group 4, twist_bones: not part of this group; create it with a twist_bone_count, or joints that name "
            "twist bones");
    refused(swivel_read(bodies, SWIVEL_SOLVED_GOAL, H::free, 0, 1, c.out(28)),
            "group 4, solved_goal: not part of this group; create it with SWIVEL_WITH_RECORD and SWIVEL_WITH_PLANT or "
            "_WITH_LINK");
    refused(swivel_read(bodies, SWIVEL_SIGHT, H::prop, 0, 1, c.out(24)),
            "group 0, sight: the group is a prop, which has none");
    refused(swivel_write(bodies, SWIVEL_POLE, H::left, 0, 1, {c.in, 0}),
            "group 1, pole: not part of this group; create it without SWIVEL_POLE_INCOMING");
    refused(swivel_read(crowd, SWIVEL_INPUT_END, 0, 0, 1, c.out(16)), "there is no field ");
    refused(swivel_write_doubles(crowd, SWIVEL_TARGET, 0, 0, 1, {c.up, 0}, {c.up, 23}),
            "group 0, origin: stride 23 is smaller than a value, 24 bytes");
    refused(swivel_write_doubles(crowd, SWIVEL_LENGTHS, 0, 0, 1, {c.up, 0}, {}),
            "group 0, lengths: not a position; write it by swivel_write()");
    refused(swivel_write_doubles(directions, SWIVEL_POLE, 0, 0, 1, {c.up, 0}, {c.up, 0}),
            "group 0, pole: it is a direction here, which has no origin; give null");
}

TEST_CASE("questions about limbs are refused where nothing answers them")
{
    Called c;
    const Unchanged refused{c};
    const swivel_crowd *const crowd = c.crowd.get(), *const bodies = c.bodies.get();
    refused(swivel_forward(crowd, 0, 0, 1, c.out(23), {}, {}),
            "group 0, elbow: stride 23 is smaller than a value, 24 bytes");
    refused(swivel_forward(crowd, 1, 0, 1, {}, c.out(8), {}),
            "group 1, wrist: stride 8 is smaller than a value, 24 bytes");
    refused(swivel_forward(crowd, 0, 0, 1, {}, {}, c.out(32)), "group 0 has no hands; create it with SWIVEL_WITH_HAND");
    refused(swivel_residuals(nullptr, 0, 0, 1, c.out(8)), "crowd is null");
    refused(swivel_residuals(crowd, 0, 0, 1, c.out(7)), "group 0, distance: stride 7 is smaller than a value, 8 bytes");
    refused(swivel_residuals(crowd, 1, 0, 1, {}), "group 1, distance: data is null");
    refused(swivel_joint_angles(crowd, 0, 0, 1, SWIVEL_XYZ, static_cast<swivel_euler_order>(6), 0, c.out(56)),
            "wrist_order is 6; it is one of SWIVEL_XYZ to SWIVEL_ZYX");
    refused(swivel_joint_angles(crowd, 0, 0, 1, SWIVEL_XYZ, SWIVEL_XYZ, 2, c.out(56)), "family is 2; it is 0 or 1");
    refused(swivel_allowed_arcs(crowd, 0, 0, &c.arc, 1, nullptr), "arc_count is null");
    refused(swivel_allowed_arcs(crowd, 0, 0, nullptr, 1, &c.count), "arcs is null");
    refused(swivel_pack(nullptr, 0, {0, 1}, c.halves), "crowd is null");
    refused(swivel_pack(crowd, 0, {0, 1}, nullptr), "swivel_pack: words is null");

    const char* const no_text = "text is null or of no size";
    refused(swivel_explain(nullptr, 0, 0, c.text, 8), "crowd is null");
    refused(swivel_explain(crowd, 2, 0, c.text, 8), "group 2 does not exist; this crowd has 2");
    refused(swivel_explain(crowd, 0, 20, c.text, 8), "limb 20 on are not all in group 0, which has 20");
    refused(swivel_explain(bodies, SWIVEL_EVERY_GROUP, 3, c.text, 8), "limb 3 on are not all in group 0, which has 3");
    refused(swivel_explain(crowd, SWIVEL_EVERY_GROUP, 0, c.text, 8),
            "this crowd has no bodies; name one of its 2 groups");
    refused(swivel_explain(crowd, 0, 0, nullptr, 8), no_text);
    refused(swivel_explain(crowd, 0, 0, c.text, 0), no_text);
    const swivel_pose none = swivel_default_pose();
    refused(c.compare(nullptr, 0, 0, &c.pose, c.up, c.text, 8), "crowd is null");
    refused(c.compare(crowd, 0, 0, &c.pose, c.up, c.text, 8), "this crowd has no bodies, so it has no pose");
    refused(c.compare(bodies, 12, 0, &c.pose, c.up, c.text, 8), "group 12 does not exist; this crowd has 10");
    refused(c.compare(bodies, H::free, 3, &c.pose, c.up, c.text, 8), "limb 3 on are not all in group 4, which has 3");
    refused(c.compare(bodies, H::shift, 0, &c.pose, c.up, c.text, 8),
            "group 7 is a body's shift; name a group of limbs");
    refused(c.compare(bodies, H::free, 0, nullptr, c.up, c.text, 8), "swivel_compare: pose is null");
    refused(c.compare(bodies, H::free, 0, &none, c.up, c.text, 8), "the pose has no rotations; give them");
    refused(c.compare(bodies, H::free, 0, &c.pose, nullptr, c.text, 8), "swivel_compare: elbow is null");
    refused(c.compare(bodies, H::free, 0, &c.pose, c.nans, c.text, 8), "elbow is not finite or further than 1e15");
    refused(c.compare(bodies, H::free, 0, &c.pose, c.far, c.text, 8), "elbow is not finite or further than 1e15");
    refused(c.compare(bodies, H::free, 0, &c.pose, c.up, nullptr, 8), no_text);
    refused(c.compare(bodies, H::free, 0, &c.pose, c.up, c.text, 0), no_text);

    refused(c.draw(nullptr, 0, 0, nullptr), "crowd is null");
    refused(c.draw(crowd, 2, 0, nullptr), "group 2 does not exist; this crowd has 2");
    refused(c.draw(crowd, 0, 20, nullptr), "limb 20 on are not all in group 0, which has 20");
    refused(c.draw(bodies, SWIVEL_EVERY_GROUP, 3, &c.pose), "limb 3 on are not all in group 0, which has 3");
    refused(c.draw(crowd, SWIVEL_EVERY_GROUP, 0, nullptr), "this crowd has no bodies; name one of its 2 groups");
    refused(c.draw(crowd, 0, 0, &c.pose), "this crowd has no bodies, so it has no pose; give null");
    refused(c.draw(bodies, H::free, 0, nullptr), "swivel_draw: pose is null; give the one of the last solve");
    refused(c.draw(bodies, H::free, 0, &none), "the pose has no rotations; give them");
    refused(swivel_draw(crowd, 0, 0, nullptr, nullptr, 1, &c.count), "swivel_draw: shapes is null");
    refused(swivel_draw(crowd, 0, 0, nullptr, &c.shape, 1, nullptr), "swivel_draw: shape_count is null");

    refused(swivel_residuals(bodies, H::shift, 0, 1, c.out(8)),
            "swivel_residuals: group 7 is a body's shift; name a group of limbs");
    refused(swivel_forward(bodies, H::prop, 0, 1, c.out(24), {}, {}),
            "swivel_forward: group 0 is a prop; name a group of limbs");
    refused(swivel_allowed_arcs(bodies, H::shift, 0, &c.arc, 1, &c.count),
            "swivel_allowed_arcs: group 7 is a body's shift");
    refused(swivel_joint_angles(bodies, H::shift, 0, 1, SWIVEL_XYZ, SWIVEL_XYZ, 0, c.out(56)),
            "swivel_joint_angles: group 7 is a body's shift");
    const Crowd unrecorded(c.made.skeleton.view(), 3, {body_limb(c.made.joints[0])});
    const char* const no_record = "group 0 is of bodies; create it with SWIVEL_WITH_RECORD";
    refused(swivel_residuals(unrecorded.get(), 0, 0, 1, c.out(8)), no_record);
    refused(swivel_explain(unrecorded.get(), 0, 0, c.text, 8), no_record);
    refused(swivel_forward(unrecorded.get(), 0, 0, 0, {}, {}, {}), no_record);
    refused(swivel_allowed_arcs(unrecorded.get(), 0, 0, nullptr, 0, &c.count), no_record);
}

TEST_CASE("jobs and choices that cannot be are refused, and so is a job that names a part of what is linked")
{
    Called c;
    {
        const Unchanged refused{c};
        const swivel_in good[] = {{&c.priority, 0}, {&c.priority, 0}}, narrow[] = {good[0], {&c.priority, 3}},
                        null[] = {{nullptr, 4}, good[1]};
        refused(swivel_solve(nullptr, nullptr), "crowd is null");
        refused(swivel_choose(nullptr, good, c.urgency, 1, c.words, 2, &c.count), "crowd is null");
        refused(c.choose(nullptr, c.words, 2), "priorities are missing; give one for each of this crowd's 2 groups");
        refused(c.choose(narrow, c.words, 2), "group 1, priority: stride 3 is smaller than a value, 4 bytes");
        refused(c.choose(null, c.words, 2), "group 0, priority: data is null");
        refused(c.choose(good, nullptr, 2), "the mask is null");
        for (const std::uint32_t count : {0u, 1u, 3u})
            refused(c.choose(good, c.words, count), "words; this crowd of 3 blocks has 2, a bit for each lane");

        const auto refused_job = [&](const char* words, const auto& change) {
            swivel_job job = swivel_default_job();
            change(job);
            refused(swivel_solve(c.crowd.get(), &job), words);
        };
        const std::uint32_t mask[] = {~0u, ~0u};
        const swivel_blocks beyond{3, 1}, wrapped{1, ~0u};
        refused_job("the mask is null", [](auto& job) { job.mask_word_count = 2; });
        refused_job("a mask of 1 words; this crowd of 3 blocks has 2, a bit for each lane",
                    [&](auto& job) { job.mask = mask, job.mask_word_count = 1; });
        refused_job("job has size 0", [](auto& job) { job.size = 0; });
        refused_job("build with the header", [](auto& job) { job.size += 8; });
        refused_job("start from its default", [](auto& job) { job.size -= 4; });  // half a member
        for (const swivel_blocks* const blocks : {&beyond, &wrapped})
            refused_job("blocks ", [&](auto& job) { job.blocks = blocks; });
        refused(c.solve_groups({H::follower}), "the job names group 5, but not group 4; they are linked, name both");
        refused(c.solve_groups({H::third}), "the job names group 3, but not group 1; they are linked, name both");
        refused(c.solve_groups({H::left, H::right}), "they are linked, name both");
        refused(c.solve_groups({H::prop}), "they are linked, name both");
        refused(c.solve_groups({H::prop, H::left}), "they are linked, name both");
        refused(c.solve_groups({H::handle}), "they are linked, name both");
    }
    CHECK(c.crowd.solve({.mask = std::array{~0u, ~0u}}) == 25);  // bits of padding are ignored
    CHECK(c.solve_groups({H::free}) == SWIVEL_OK);
    CHECK(c.solve_groups({H::free, H::follower}) == SWIVEL_OK);
    CHECK(c.solve_groups({H::prop, H::left, H::right}) == SWIVEL_OK);
    CHECK(c.solve_groups({H::prop, H::left, H::right, H::third}) == SWIVEL_OK);
    CHECK(c.solve_groups({H::handle, H::on_handle}) == SWIVEL_OK);
}

TEST_CASE("frames that cannot be are refused")
{
    Called c;
    const swivel_in origin{c.doubles, 0}, narrow_origin{c.doubles, 23};
    const struct {
        const char* words;
        std::vector<swivel_stream> fields;  // of group 1
        std::uint32_t positions = SWIVEL_NUMBERS_UNSPECIFIED;
        swivel_in origin = {};
    } rows[] = {
        {"group 1, target: stride 11 is smaller than a value, 12 bytes", {{SWIVEL_TARGET, c.floats, 11}}},
        {"group 1, elbow: stride 7 is smaller than a value", {{SWIVEL_POLE, c.floats, 0}, {SWIVEL_ELBOW, c.floats, 7}}},
        {"group 1, flags: ", {{SWIVEL_FLAGS, c.floats, 0}}},  // one place for all: results cannot
        {"group 1, hand: not part of this group; create it with SWIVEL_WITH_HAND", {{SWIVEL_HAND, c.floats, 16}}},
        {"group 1, incoming_wrist: not part of this group; create it with ", {{SWIVEL_INCOMING_WRIST, c.floats, 16}}},
        {"create it with SWIVEL_WITH_CLAVICLE", {{SWIVEL_CLAVICLE_ROTATION, c.floats, 16}}},
        {"streams of group 1 list pole twice; list it once", {{SWIVEL_POLE, c.floats, 0}, {SWIVEL_POLE, c.floats, 0}}},
        {"there is no field ", {{SWIVEL_INPUT_END, c.floats, 0}}},
        {"target is in doubles, but floats are read without an origin; give floats, or an",
         {{SWIVEL_TARGET, c.doubles, 24}},
         SWIVEL_DOUBLES},
        {"target is in floats, but the streams have an origin; give doubles",
         {{SWIVEL_TARGET, c.floats, 24}},
         SWIVEL_FLOATS,
         origin},
        {"positions is 3; it is a swivel_numbers, 0 to 2", {{SWIVEL_TARGET, c.floats, 24}}, 3},
        {"origin: stride 23 is smaller than a value, 24 bytes", {}, SWIVEL_NUMBERS_UNSPECIFIED, narrow_origin},
        {"target: stride 12 is smaller than a value, 24 bytes",  // which is enough for floats
         {{SWIVEL_TARGET, c.doubles, 12}},
         SWIVEL_NUMBERS_UNSPECIFIED,
         origin},
    };
    const swivel_blocks whole{0, 3}, of_second{2, 1}, of_first{0, 2};
    swivel_streams frames[2] = {swivel_default_streams(), swivel_default_streams()};
    swivel_job job = swivel_default_job();
    job.streams = frames;
    {
        const Unchanged refused{c};
        for (const auto& [words, fields, positions, from] : rows) {
            frames[1].fields = fields.data(), frames[1].field_count = static_cast<std::uint32_t>(fields.size());
            frames[1].positions = positions, frames[1].origin = from;
            for (const swivel_blocks* const blocks : {&whole, &of_second}) {
                job.blocks = blocks, job.on_this_thread = blocks == &of_second;
                refused(swivel_solve(c.crowd.get(), &job), words);
            }
        }
        frames[1] = swivel_default_streams(), frames[1].field_count = 1;
        refused(swivel_solve(c.crowd.get(), &job), "null");
        for (const std::uint32_t size : {0u, static_cast<std::uint32_t>(sizeof frames[0]) + 8}) {
            frames[0].size = size;
            refused(swivel_solve(c.crowd.get(), &job), "size ");
        }
    }
    frames[0] = swivel_default_streams();
    job.blocks = &of_first;  // the second frame is not looked at
    CHECK(swivel_solve(c.crowd.get(), &job) == SWIVEL_OK);
}

TEST_CASE("poses are refused exactly where results of two bodies overlap by their strides")
{
    rc::prop("rotations of a limb's joints, or positions of all that it needs", [] {
        ArmDef arm;
        arm.joints[0].elbow = 3, arm.joints[0].wrist = 6;
        arm.limbs[0].features = SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING;
        const auto body_count = *rc::gen::inRange<std::uint32_t>(1, 5);
        arm.def.body_count = body_count;
        Crowd crowd(arm.def);
        const bool has_positions = *rc::gen::arbitrary<bool>();
        const std::size_t size = has_positions ? 12 : 16;
        const auto body_stride = *rc::gen::inRange<std::size_t>(4, 40) * 4,
                   joint_stride = *rc::gen::inRange<std::size_t>(4, 40) * 4;
        Float4 unturned = {0, 0, 0, 1};
        std::vector<float> room(500), apart(4 * 7 * 4);
        const swivel_joint_values values = {room.data(), body_stride, joint_stride, nullptr};
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {unturned.data(), 0, 0, nullptr};
        pose.results = {apart.data(), 7 * sizeof(Float4), sizeof(Float4), nullptr};
        (has_positions ? pose.joint_positions : pose.results) = values;
        const std::vector<std::size_t> written =
            has_positions ? std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6} : std::vector<std::size_t>{1, 3, 6};
        bool overlaps = false;
        for (std::size_t n = 1; n < body_count; ++n)
            for (const std::size_t a : written)
                for (const std::size_t b : written) {
                    const std::size_t one = a * joint_stride, other = n * body_stride + b * joint_stride;
                    overlaps = overlaps || (one < other + size && other < one + size);
                }
        const swivel_job job = job_with(&pose);
        RC_ASSERT((swivel_solve(crowd.get(), &job) != SWIVEL_OK) == overlaps);
        if (!overlaps) return;
        RC_ASSERT(is_one_line(swivel_last_error()));
        RC_ASSERT(std::string(swivel_last_error()).find(has_positions ? "joint_positions" : "results") !=
                  std::string::npos);
    });
}

TEST_CASE("a limb that only moves along with a look has results that may overlap, too")
{
    const ArmDef arm;
    swivel_limb_joints joints = swivel_default_limb_joints(2, 3, 4);
    joints.bend[1] = 1;
    swivel_look_def look = swivel::look({1});
    look.rate = 0;
    Crowd crowd(arm.skeleton, 2, {look, body_limb(joints)});
    Float4 unturned = {0, 0, 0, 1};
    std::vector<float> room(100);
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {unturned.data(), 0, 0, nullptr};
    pose.results = {room.data(), sizeof(Float4), sizeof(Float4), nullptr};
    const std::uint32_t look_alone = 1;
    swivel_job job = job_with(&pose);
    job.groups = &look_alone, job.group_word_count = 1;
    CHECK(swivel_solve(crowd.get(), &job) == SWIVEL_OK);  // joint 1 alone is written
    pose.space = SWIVEL_IN_BODY;
    CHECK_REFUSED(swivel_solve(crowd.get(), &job), SWIVEL_INVALID_ARGUMENT);
    CHECK_THAT(swivel_last_error(), Catch::Contains("the pose's results: by a body_stride of 16"));
}

TEST_CASE("poses that cannot be are refused")
{
    using Values = swivel_joint_values;
    const struct {
        const char* words;
        void (*change)(swivel_pose& pose, const Values& other);
    } rows[] = {
        {"the pose has no rotations", [](auto& p, auto&) { p.rotations = {}; }},
        {"rotations: body_stride 0 is smaller", [](auto& p, auto&) { p.rotations.body_stride = 0; }},
        {"rotations: joint_stride 12 is smaller than a value, 16",
         [](auto& p, auto&) { p.rotations.joint_stride = 12; }},
        {"the pose's root is in doubles, but has no position", [](auto& p, auto&) { p.root_is_double = 1; }},
        {"root_rotation: stride 8",
         [](auto& p, auto& o) {
             p.root_rotation = {o.data, 8};
         }},
        {"the pose has matrices and scales",
         [](auto& p, auto& o) { p.form = SWIVEL_MATRIX_ROWS, p.rotations = p.scales = o; }},
        {"the pose's form is 77", [](auto& p, auto&) { std::memcpy(&p.form, &kNoSuchThing, 4); }},
        {"the pose's space is 77", [](auto& p, auto&) { std::memcpy(&p.space, &kNoSuchThing, 4); }},
        {"only translations in the body's space change", [](auto& p, auto& o) { p.translation_results = o; }},
        {"but no translation_results",
         [](auto& p, auto& o) { p.space = SWIVEL_IN_BODY, p.translations = p.results = o; }},
        {"the pose's results: by a body_stride of 16 and a joint_stride of 16 joint ",
         [](auto& p, auto& o) {
             p.results = {o.data, 16, 16, nullptr};
         }},
        {"joint_positions: body_stride 8",
         [](auto& p, auto& o) {
             p.joint_positions = {o.data, 8, 16, nullptr};
         }},
        {"reserved is not 0", [](auto& p, auto&) { p.reserved = 1; }},
        {"pose has size 0", [](auto& p, auto&) { p.size = 0; }},
        {"the pose has no time, which plants, shifts and looks with a rate need", [](auto& p, auto&) { p.time = {}; }},
    };
    Called c;
    {
        const Unchanged refused{c};
        std::vector<float> numbers(3 * c.made.skeleton.size() * 16);
        const Values other = {numbers.data(), c.made.skeleton.size() * 64, 64, nullptr};
        for (const auto& [words, change] : rows) {
            swivel_pose pose = c.pose;
            change(pose, other);
            refused(c.solve_bodies(job_with(&pose)), words);
        }
        refused(c.solve_bodies(job_with(nullptr)), "this crowd is of bodies; give the job their pose");
        const swivel_job posed = job_with(&c.pose);
        refused(swivel_solve(c.crowd.get(), &posed), "this crowd has no bodies, so it takes no pose");
    }
    CHECK(c.solve_bodies(job_with(&c.pose)) == SWIVEL_OK);
    c.pose.time = {};  // which a comparison does not need
    CHECK(c.compare(c.bodies.get(), H::leg, 0, &c.pose, c.up, c.text, 8) == SWIVEL_OK);
}

TEST_CASE("angles and axes that make no limit, and bindings that are none, are refused")
{
    Called c;
    const Unchanged refused{c};
    refused(swivel_range(1, 0, c.floats), "swivel_range: least 1 is above most 0");
    refused(swivel_range(0, 6.4, c.floats), "swivel_range: 0 to 6.4 is wider than a whole turn");
    refused(swivel_range(std::nan(""), 1, c.floats), "swivel_range: nan to 1 is not finite");
    refused(swivel_range(0, 1, nullptr), "swivel_range: range is null");
    refused(swivel_cone(c.zeros, 1, c.floats), "swivel_cone: axis (0, 0, 0) has no direction");
    refused(swivel_cone(c.up, -0.1, c.floats), "swivel_cone: largest angle -0.1 is not in 0 to pi");
    refused(swivel_cone(c.up, 3.2, c.floats), "swivel_cone: largest angle 3.2 is not in 0 to pi");
    refused(swivel_flexion(-0.1, 1, c.floats), "swivel_flexion: -0.1 to 1 is not a range within 0 to pi");
    refused(swivel_flexion(1, 0.5, c.floats), "swivel_flexion: 1 to 0.5 is not a range within 0 to pi");
    refused(swivel_flexion(1, 3.2, c.floats), "swivel_flexion: 1 to 3.2 is not a range within 0 to pi");
    refused(swivel_aim(c.up, 4, c.floats), "swivel_aim: flexion 4 is not in 0 to pi");
    refused(swivel_aim(c.zeros, 1, c.floats), "swivel_aim: axis (0, 0, 0) has no direction");
    refused(swivel_aim(nullptr, 1, c.floats), "swivel_aim: axis is null");
    refused(swivel_mirror(SWIVEL_RESULT_END, SWIVEL_XYZ, c.in, c.floats), "there is no field ");
    refused(swivel_mirror(SWIVEL_ELBOW, SWIVEL_XYZ, c.in, c.floats), "swivel_mirror: elbow is a result");
    const float *const turned = c.in, *const nothing = c.in + 8;
    swivel_binding binding = c.binding, no_binding = swivel_default_binding();
    refused(swivel_arm_axis(nullptr, turned, c.up, c.doubles), "swivel_arm_axis: binding is null");
    refused(swivel_arm_axis(&binding, turned, nullptr, c.doubles), "is null");
    refused(swivel_arm_axis(&binding, nothing, c.up, c.doubles), "the parent's rotation is zero or not finite");
    refused(swivel_arm_axis(&binding, turned, c.zeros, c.doubles), "direction (0, 0, 0) is not 1e-15..1e15 long");
    refused(swivel_arm_axis(&binding, turned, c.nans, c.doubles), "direction (0, nan, 0) is not 1e-15..1e15 long");
    refused(swivel_arm_axis(&no_binding, turned, c.up, c.doubles), "the binding holds a quaternion not of unit length");
    const swivel_skeleton skeleton = c.made.skeleton.view();
    refused(swivel_bind_joints(nullptr, &c.made.joints[0], &binding), "skeleton, joints or binding is null");
    refused(swivel_bind_joints(&skeleton, nullptr, &binding), "skeleton, joints or binding is null");
    refused(swivel_bind_joints(&skeleton, &c.made.joints[0], nullptr), "skeleton, joints or binding is null");
    no_binding.size = 0;
    refused(swivel_bind_joints(&skeleton, &c.made.joints[0], &no_binding), "binding has size 0");
}
