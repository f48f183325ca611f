// SPDX-License-Identifier: MIT
//
// The promise: what hands hold and where heads look depends, in every bit, on their own body alone. It is the same on
// every instruction set, in every order of bodies, in chunks, on threads, masked and listed, from rows and from frames,
// in place and elsewhere, in every form of poses, and far from the origin.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <functional>
#include <numeric>

#include "tests/holding_bodies.h"
#include "tests/looking_bodies.h"
#include "tests/test_isa_scope.h"

namespace {

using namespace swivel;
using namespace swivel::test;

using HeldBits = std::vector<std::vector<std::uint32_t>>;

struct HoldingWay {
    bool has_frames = false, is_apart = false;
    std::function<void(Crowd&, const Job&)> solve = [](Crowd& crowd, const Job& job) { crowd.solve(job); };
};

PoseLayout any_layout(Random& random, bool in_body, const BodySkeleton* skeleton)
{
    PoseLayout layout;
    layout.form = static_cast<swivel_pose_form>(random.below(SWIVEL_MATRIX_COLUMNS3 + 1));
    layout.translates = layout.scales = layout.roots = true;
    layout.in_body = in_body ? skeleton : nullptr;
    return layout;
}

HeldBits held_bits(const LinkedBodies& of, const HoldingWay& way = {})
{
    PoseBuffer poses(of.layout, of.bodies), results = poses;
    swivel_pose pose = of.view(poses);
    if (way.is_apart) {
        const swivel_pose to = results.view();
        pose.results = to.rotations;
        if (of.layout.in_body) pose.translation_results = to.translations;
    }
    LinkedBodies without = of;
    if (way.has_frames) without.inputs.clear();
    Crowd crowd = without.crowd();
    std::vector<Frame> frames(of.groups.size());
    for (const LinkedInput& input : of.inputs)
        frames[input.group].in(input.field, swivel_in{input.numbers.data(), input.size * sizeof(float)});
    Job job{.pose = &pose};
    if (way.has_frames) job.frames = frames;
    way.solve(crowd, job);
    HeldBits bits;
    for (std::size_t n = 0; n < of.bodies.size(); ++n)
        bits.push_back(bits_of_body(of, crowd, way.is_apart ? results : poses, n));
    return bits;
}

void in_chunks(Crowd& crowd, Job job)
{
    job.on_this_thread = true;
    for (std::uint32_t first = swivel_block_count(crowd.get()); first-- > 0;) {
        job.blocks = swivel_blocks{first, 1};
        crowd.solve(job);
    }
}
void in_halves(Crowd& crowd, Job job, bool by_list)
{
    const std::uint32_t bodies = swivel_group_limb_count(crowd.get(), 0);
    for (const std::uint32_t odd : {1u, 0u}) {
        std::vector<std::uint32_t> mask((swivel_block_count(crowd.get()) + 1) / 2), list;
        for (std::uint32_t n = 0; n < bodies; ++n)
            if ((n * 7 / 5) % 2 == odd) mask[n / 32] |= 1u << n % 32, list.push_back(n);
        if (by_list)
            job.limbs = list;
        else
            job.mask = mask;
        crowd.solve(job);
    }
}

LinkedBodies shuffled(const LinkedBodies& of, const std::vector<std::uint32_t>& order)
{
    LinkedBodies to = of;
    for (std::size_t n = 0; n < order.size(); ++n) {
        to.bodies[n] = of.bodies[order[n]];
        for (std::size_t i = 0; i < of.inputs.size(); ++i)
            std::copy_n(&of.inputs[i].numbers[order[n] * of.inputs[i].size], of.inputs[i].size, to.inputs[i].at(n));
    }
    return to;
}

// Bodies that hold, or that look.
LinkedBodies any_bodies(Random& random, std::size_t count)
{
    const PoseLayout layout = any_layout(random, false, nullptr);
    if (random.below(2)) return HoldingBodies(random, count, layout);
    LookingBodies looking(random, count, layout);
    for (const std::uint32_t group : looking.looks)
        looking.groups[group].look.rate = static_cast<float>(random.below(2));
    return looking;
}

}  // namespace

TEST_CASE("hands that hold and heads that look have the same bits on every instruction set")
{
    const IsaScope scope;
    const std::vector<std::string> isas = runnable_isas();
    rc::prop("whatever they hold or see", [&](std::uint64_t seed) {
        Random random{seed};
        LinkedBodies bodies = any_bodies(random, 1 + random.below(60));
        if (random.below(4) == 0) bodies.layout.in_body = &bodies.skeleton;
        HeldBits first;
        for (const std::string& isa : isas) {
            check(swivel_use_isa(isa.c_str()));
            const HeldBits bits = held_bits(bodies);
            if (first.empty()) first = bits;
            RC_ASSERT((bits == first));
        }
    });
}

TEST_CASE("hands that hold and heads that look have the same bits in any order, memory and choice")
{
    rc::prop("whatever they hold or see", [](std::uint64_t seed) {
        Random random{seed};
        LinkedBodies bodies = any_bodies(random, 1 + random.below(60));
        if (random.below(4) == 0) bodies.layout.in_body = &bodies.skeleton;
        const HeldBits wanted = held_bits(bodies);
        std::vector<std::uint32_t> order(bodies.bodies.size());
        std::iota(order.begin(), order.end(), 0u);
        for (std::uint32_t n = bodies.body_count(); n > 1; --n) std::swap(order[n - 1], order[random.below(n)]);
        const HeldBits moved = held_bits(shuffled(bodies, order));
        for (std::size_t n = 0; n < order.size(); ++n) RC_ASSERT((moved[n] == wanted[order[n]]));
        RC_ASSERT((held_bits(bodies, {.has_frames = true}) == wanted));
        RC_ASSERT((held_bits(bodies, {.is_apart = true}) == wanted));
        RC_ASSERT((held_bits(bodies, {.solve = in_chunks}) == wanted));
        for (const bool by_list : {false, true})
            RC_ASSERT((held_bits(bodies, {.solve = [&](Crowd& crowd, const Job& job) {
                                     in_halves(crowd, job, by_list);
                                 }}) == wanted));
    });
}

TEST_CASE("many bodies have the same bits on threads")
{
    Random random{3};
    const HoldingBodies holding(random, 2500, any_layout(random, false, nullptr));
    CHECK((held_bits(holding) == held_bits(holding, {.solve = in_chunks})));
    const LookingBodies looking(random, 2500, any_layout(random, false, nullptr));
    CHECK((held_bits(looking) == held_bits(looking, {.solve = in_chunks})));
}

TEST_CASE("a prop's place in doubles far from the origin gives the pose of floats near it")
{
    constexpr double far[3] = {1048576.0 * 64, -1048576.0 * 32, 1048576.0 * 8};
    Random random{4};
    PoseLayout layout;
    layout.roots = true;
    HoldingBodies bodies(random, 40, layout);
    // Of so few digits that doubles far away hold them exactly. A root that is shifted is rounded where it is.
    const auto shorten = [](float& x) { x = std::round(x * 65536) / 65536; };
    const auto is_place = [](swivel_field field) { return is_position(field); };
    for (Body& body : bodies.bodies) std::ranges::for_each(body.root_position, shorten);
    for (LinkedInput& input : bodies.inputs)
        if (is_place(input.field)) std::ranges::for_each(input.numbers, shorten);
    bodies.give(HoldingBodies::leg, SWIVEL_FIT_WEIGHT, [](std::size_t) { return Float1{0}; });
    PoseBuffer near(layout, bodies.bodies), poses(layout, bodies.bodies);
    Crowd crowd = bodies.crowd(), other = bodies.crowd();
    solve_poses(crowd, bodies.view(near));

    std::vector<std::vector<double>> doubles;
    const auto far_from = [&](const float* first, std::size_t count) {
        doubles.emplace_back();
        for (std::size_t n = 0; n < count; ++n) doubles.back().push_back(far[n % 3] + double{first[n]});
        return doubles.back().data();
    };
    doubles.reserve(bodies.inputs.size() + 1);
    std::vector<float> root_numbers;
    for (const Body& body : bodies.bodies)
        root_numbers.insert(root_numbers.end(), body.root_position.begin(), body.root_position.end());
    swivel_pose pose = bodies.view(poses);
    pose.root_is_double = 1;
    pose.root_position = {far_from(root_numbers.data(), root_numbers.size()), 24};
    std::vector<Frame> frames(bodies.groups.size());
    for (const LinkedInput& input : bodies.inputs)
        if (is_place(input.field))
            frames[input.group].in(input.field, swivel_in{far_from(input.numbers.data(), input.numbers.size()), 24});
    other.solve({.frames = frames, .pose = &pose});
    CHECK((poses.bytes == near.bytes));
    int written = 0;
    for (std::uint32_t n = 0; n < bodies.body_count(); ++n)
        written += !std::isnan(bodies.value(HoldingBodies::prop, SWIVEL_PROP_PLACE, n, kNoPlace)[0]);
    CHECK(written >= 8);
}
