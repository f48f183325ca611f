// SPDX-License-Identifier: MIT
//
// The promise: errors have their texts and belong to their thread, and definitions of older headers are read as far as
// they go.
#include "tests/posed_bodies.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"

#include <array>
#include <cstddef>
#include <limits>
#include <list>
#include <span>
#include <string>
#include <thread>

using namespace swivel;
using namespace swivel::test;

TEST_CASE("statuses and errors have their texts, errors belong to their thread")
{
    for (const int status : {0, 1, 2, 3, 4, 77}) {
        const std::string text = swivel_status_text(static_cast<swivel_status>(status));
        CHECK(is_one_line(text));
        CHECK((text == "unknown status") == (status == 77));
    }
    CHECK(swivel_version() == SWIVEL_VERSION);
    swivel_solve(nullptr, nullptr);
    const std::string here = swivel_last_error();
    std::string before, after;
    std::thread([&] {
        before = swivel_last_error();
        swivel_use_isa("no such thing");
        after = swivel_last_error();
    }).join();
    CHECK(before.empty());
    CHECK(is_one_line(after));
    CHECK(swivel_last_error() == here);
}

TEST_CASE("a binding of an older header gets what it has room for")
{
    const ThreeJoints limb = arm_frame_joints();
    const swivel_skeleton skeleton = limb.skeleton();
    const swivel_limb_joints joints = limb.joints();
    swivel_binding whole = swivel_default_binding(), part = whole;
    part.size = offsetof(swivel_binding, lengths);
    REQUIRE(swivel_bind_joints(&skeleton, &joints, &whole) == SWIVEL_OK);
    REQUIRE(swivel_bind_joints(&skeleton, &joints, &part) == SWIVEL_OK);
    CHECK(std::ranges::equal(part.wrist_rest, whole.wrist_rest));
    CHECK(part.lengths[0] == 0);
    CHECK(whole.lengths[0] == 1);
}

namespace {

// Definitions as older headers had them: each has only so many bytes.
struct Older {
    std::list<std::vector<unsigned char>> all;

    template <class Def>
    const Def* operator()(const Def& def, std::size_t size)
    {
        std::vector<unsigned char>& bytes = all.emplace_back(size);
        std::memcpy(bytes.data(), &def, size);
        std::memcpy(bytes.data(), &size, sizeof size);
        return reinterpret_cast<const Def*>(bytes.data());
    }
};

}  // namespace

TEST_CASE("a definition of an older header is read as far as it goes")
{
    // As a first release's header might have had them: without bodies, without a limb's binding, and without memory.
    constexpr std::size_t step = offsetof(swivel_group_def, body_limb), length = offsetof(swivel_crowd_def, memory);
    Older older;
    alignas(swivel_group_def) std::array<unsigned char, 2 * step> groups;
    for (const std::uint32_t n : {0u, 1u}) {
        swivel_group_def group = swivel_default_group_def();
        group.size = step;
        group.limb = older(limbs(3 + n), offsetof(swivel_limb_def, binding));
        std::memcpy(groups.data() + n * step, &group, step);
    }
    swivel_crowd_def def = swivel_default_crowd_def();
    def.group_count = 2;
    def.groups = reinterpret_cast<const swivel_group_def*>(groups.data());
    def.memory = groups.data();  // never read
    def.size = length;
    swivel_crowd* crowd = nullptr;
    REQUIRE(swivel_crowd_create(&def, &crowd) == SWIVEL_OK);
    CHECK(swivel_group_limb_count(crowd, 0) == 3);
    CHECK(swivel_group_limb_count(crowd, 1) == 4);
    swivel_crowd_destroy(crowd);

    swivel_group_def joints = swivel_default_group_def();
    joints.limb = older(limbs(3, SWIVEL_JOINTS), offsetof(swivel_limb_def, binding));
    const swivel_crowd_def unbound = def_of(joints);
    CHECK_REFUSED(swivel_crowd_create(&unbound, &crowd), SWIVEL_INVALID_ARGUMENT);
    CHECK_THAT(swivel_last_error(), Catch::Contains("group 0 has no binding"));
}

TEST_CASE("of each kind of bodies' groups, what an older header lacks is as its default has it")
{
    using H = HoldingBodies;
    Random random{12};
    HoldingBodies bodies(random, 20, {.roots = true});
    bodies.limb_def(H::leg).features |= SWIVEL_WITH_PLANT;
    bodies.give(H::leg, SWIVEL_CONTACT, [](std::size_t) { return Float1{1}; });
    const std::uint32_t head = bodies.add(look({0}));

    Older older;
    std::vector<swivel_group_def> groups = c_groups(bodies.groups);
    for (swivel_group_def& group : groups) {
        if (group.body_limb) group.body_limb = older(*group.body_limb, offsetof(swivel_body_limb_def, region));
        if (group.look) group.look = older(*group.look, offsetof(swivel_look_def, rate));
        if (group.prop && group.prop->joint < 0) group.prop = older(*group.prop, offsetof(swivel_prop_def, joint));
        if (group.shift) group.shift = older(*group.shift, offsetof(swivel_shift_def, half_life));
    }
    const swivel_skeleton skeleton = bodies.skeleton.view();
    swivel_crowd_def def = swivel_default_crowd_def();
    def.groups = groups.data(), def.group_count = static_cast<std::uint32_t>(groups.size());
    def.skeleton = &skeleton, def.body_count = bodies.body_count();
    Crowd whole = bodies.crowd(), part(def);
    bodies.write(part);
    int planted = 0, on_its_way = 0;
    for (int frame = 0; frame < 3; ++frame) {
        std::vector<Float3> seen;
        for (const Body& body : bodies.bodies)
            seen.push_back(floats(Vector3d(vec(body.root_position) + 20 * random.direction())));
        for (Crowd* const crowd : {&whole, &part}) crowd->write(SWIVEL_LOOK_TARGET, head, seen);
        PoseBuffer poses = bodies.incoming(), others = poses;
        const swivel_pose pose = bodies.view(poses), other = bodies.view(others);
        whole.solve({.pose = &pose}), part.solve({.pose = &other});
        CHECK((all_words(part) == all_words(whole)));
        CHECK(others.bytes == poses.bytes);
        for (std::uint32_t n = 0; n < bodies.body_count(); ++n) {
            planted += frame > 0 && flags_of(whole, H::leg, n) & SWIVEL_PLANTED;
            on_its_way += frame > 0 && flags_of(whole, head, n) & SWIVEL_LIMITED_STEP;
        }
        for (Body& body : bodies.bodies) body.root_position[0] += 0.01f * body.root_scale;
    }
    CHECK(planted > 5);
    CHECK(on_its_way > 5);
}

TEST_CASE("frames and jobs of an older header are read as far as they go, frames as far apart as the first says")
{
    constexpr std::size_t step = offsetof(swivel_streams, origin);  // as if a first release had no origins
    const swivel_limb_def groups[] = {group_of(20), group_of(5)};
    Crowd framed = crowd_with(0, groups), rows = crowd_with(0, groups);
    alignas(swivel_streams) std::array<unsigned char, 2 * step> frames;
    std::vector<Float3> targets[] = {std::vector<Float3>(20, Float3{0, 1, 1}), std::vector<Float3>(5, Float3{1, 0, 1})};
    Streams own[2];
    for (std::uint32_t g = 0; g < 2; ++g) {
        swivel_streams frame = own[g].in(SWIVEL_TARGET, {targets[g].data(), sizeof(Float3)});
        frame.size = step;
        std::memcpy(frames.data() + g * step, &frame, step);
        for (Crowd* crowd : {&framed, &rows}) crowd->write_all(SWIVEL_LENGTHS, g, Float2{1, 1});
        rows.write(SWIVEL_TARGET, g, targets[g]);
    }
    rows.solve();
    swivel_job job = swivel_default_job();
    job.streams = reinterpret_cast<const swivel_streams*>(frames.data());
    REQUIRE(swivel_solve(framed.get(), &job) == SWIVEL_OK);
    CHECK((all_words(framed) == all_words(rows)));

    // And a job: there, to the blocks alone.
    const swivel_blocks none{3, 0};
    job.blocks = &none, job.mask_word_count = 7;
    job.size = offsetof(swivel_job, mask);
    CHECK(swivel_solve(framed.get(), &job) == SWIVEL_OK);
}

TEST_CASE("a crowd that is null has nothing")
{
    CHECK(swivel_block_count(nullptr) == 0);
    CHECK(swivel_group_first_limb(nullptr, 0) == 0);
    CHECK(swivel_group_limb_count(nullptr, 0) == 0);
    CHECK(swivel_field_first_row(nullptr, 0, SWIVEL_POLE) == 0);
    CHECK(swivel_field_row_count(nullptr, 0, SWIVEL_POLE) == 0);
    CHECK(swivel_packed_row(nullptr, 0, SWIVEL_RESULT_END) == 0);
    CHECK((!swivel_input_rows(nullptr, 0).base && swivel_input_rows(nullptr, 0).row_count == 0));
    CHECK((!swivel_result_rows(nullptr, 0).base && swivel_result_rows(nullptr, 0).row_count == 0));
}
