// SPDX-License-Identifier: MIT
//
// The promise: what bodies that stand give and carry depends, in every bit, on their own inputs alone. It is the same
// on every instruction set, in every order of bodies, in chunks, on threads, masked and listed, at any distances in
// memory, from rows and from frames, in place and elsewhere, and far from the origin.
#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>
#include <numeric>
#include <vector>

#include <rapidcheck/catch.h>

#include "tests/plant_frames.h"
#include "tests/pose_buffer.h"
#include "tests/test_isa_scope.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::array<double, 3> kFar = {1048576.0 * 64, -1048576.0 * 32, 1048576.0 * 8};

// How the same frames are solved.
struct Way {
    std::vector<std::uint32_t> order = {};  // body n of the crowd is this one of the frames
    std::size_t gap = 0;                    // bytes after each value of a body
    bool has_frames = false, is_apart = false, is_far = false;
    std::function<void(Crowd&, const Job&)> solve = [](Crowd& crowd, const Job& job) { crowd.solve(job); };
};

// Values of bodies in memory, with a gap after each.
struct Spread {
    std::vector<char> bytes = {};
    std::size_t stride = 0;

    template <class Value>
    void put(const std::vector<Value>& values, std::size_t gap)
    {
        stride = sizeof(Value) + gap;
        bytes.assign(values.size() * stride, 0x5a);
        for (std::size_t n = 0; n < values.size(); ++n) std::memcpy(&bytes[n * stride], &values[n], sizeof values[n]);
    }
    swivel_in in() const { return {bytes.data(), stride}; }
};

std::array<double, 3> far_from_origin(const Float3& v)
{
    return {kFar[0] + double{v[0]}, kFar[1] + double{v[1]}, kFar[2] + double{v[2]}};
}

class Played {
public:
    Played(const PlantFrames& of, const Way& way)
        : of_(of), way_(way), order_(way.order), crowd_(crowd_of(of, body_count()))
    {
        if (order_.empty()) {
            order_.resize(body_count());
            std::iota(order_.begin(), order_.end(), 0u);
        }
        for (std::uint32_t f = 0; f < of.frames.size(); ++f) play(f);
    }
    // All results of all frames, body by body of the frames' order, and their poses.
    std::vector<std::vector<std::uint32_t>> bits;

private:
    static Crowd crowd_of(const PlantFrames& of, std::uint32_t body_count)
    {
        std::vector<swivel_limb_joints> joints;
        for (std::size_t g = 0; g < of.features.size(); ++g) joints.push_back(of.skeleton.joints(g));
        std::vector<swivel_group_def> groups;
        for (std::size_t g = 0; g < joints.size(); ++g) {
            groups.push_back(body_group(joints[g], of.features[g]));
            groups.back().plant = of.plants[g];
        }
        if (of.has_shift) groups.push_back(swivel_default_fit_group_def());
        return Crowd(of.skeleton.view(), body_count, groups);
    }
    std::uint32_t body_count() const { return static_cast<std::uint32_t>(of_.frames[0].bodies.size()); }
    std::uint32_t group_count() const { return swivel_group_count(crowd_.get()); }

    template <class Value>
    std::vector<Value> ordered(const std::vector<Value>& values) const
    {
        std::vector<Value> to;
        for (const std::uint32_t n : order_) to.push_back(values[n]);
        return to;
    }
    template <class Value>
    Spread& spread(const std::vector<Value>& values)
    {
        spreads_.emplace_back().put(ordered(values), way_.gap);
        return spreads_.back();
    }
    Spread& spread_places(const std::vector<Float3>& places)
    {
        if (!way_.is_far) return spread(places);
        std::vector<std::array<double, 3>> far;
        for (const Float3& v : places) far.push_back(far_from_origin(v));
        return spread(far);
    }

    void change_carried(const PlantFrames::Of& frame, const PlantFrames::Of* before)
    {
        for (std::uint32_t n = 0; n < body_count(); ++n) {
            const std::uint32_t body = order_[n], reset = frame.resets[body];
            if (reset < group_count()) check(swivel_reset(crowd_.get(), reset, n, 1));
            if (!before || before->stands_on[body] == frame.stands_on[body]) continue;
            std::array<std::array<double, 3>, 2> places;
            std::array<swivel_supports, 2> supports;
            for (std::size_t k = 0; k < 2; ++k) {
                const Float3& v = frame.supports[k][body];
                places[k] = way_.is_far ? far_from_origin(v) : std::array<double, 3>{v[0], v[1], v[2]};
                supports[k] = {{places[k].data(), 0}, {&frame.support_rotations[k][body], 0}};
            }
            const std::uint32_t to = frame.stands_on[body];
            for (std::uint32_t g = 0; g < of_.features.size(); ++g)
                if (of_.features[g] & SWIVEL_WITH_PLANT)
                    check(swivel_change_support(crowd_.get(), g, n, 1, supports[1 - to], supports[to]));
        }
    }
    // Calls give(field, values) for each input that a group has.
    template <class Give>
    void each_input(const PlantFrames::Of& frame, std::uint32_t g, const Give& give)
    {
        const auto has = [&](swivel_field field) { return swivel_field_row_count(crowd_.get(), g, field) > 0; };
        if (has(SWIVEL_SHIFT_WISH)) give(SWIVEL_SHIFT_WISH, spread(frame.wishes));
        if (g >= of_.features.size()) return;
        give(SWIVEL_TARGET, spread_places(frame.targets[g]));
        if (has(SWIVEL_CONTACT)) give(SWIVEL_CONTACT, spread(frame.contacts[g]));
        if (has(SWIVEL_COMING)) give(SWIVEL_COMING, spread_places(frame.comings[g]));
        if (has(SWIVEL_COMING_TIME)) give(SWIVEL_COMING_TIME, spread(frame.coming_times));
        if (has(SWIVEL_EFFECTOR)) give(SWIVEL_EFFECTOR, spread(std::vector<Float3>(body_count(), {0.05f, 0.1f, 0})));
    }
    void give_bodies(const PlantFrames::Of& frame, swivel_pose& pose)
    {
        std::vector<Float3> roots, supports;
        std::vector<Float4> rotations;
        for (std::uint32_t n = 0; n < body_count(); ++n) {
            roots.push_back(frame.bodies[n].root_position);
            supports.push_back(frame.supports[frame.stands_on[n]][n]);
            rotations.push_back(frame.support_rotations[frame.stands_on[n]][n]);
        }
        pose.root_is_double = way_.is_far;
        pose.root_position = spread_places(roots).in();
        pose.time = spread(frame.times).in();
        pose.support_position = spread_places(supports).in();
        pose.support_rotation = spread(rotations).in();
    }

    void play(std::uint32_t f)
    {
        const PlantFrames::Of& frame = of_.frames[f];
        change_carried(frame, f > 0 ? &of_.frames[f - 1] : nullptr);
        PoseLayout layout;
        layout.translates = layout.scales = layout.roots = true;
        layout.gap = way_.gap;
        PoseBuffer poses(layout, ordered(frame.bodies)), results = poses;
        swivel_pose pose = poses.view();
        if (way_.is_apart) pose.results = results.view().rotations;
        spreads_.clear();
        spreads_.reserve(64);
        give_bodies(frame, pose);
        std::vector<Frame> frames(group_count());
        for (std::uint32_t g = 0; g < group_count(); ++g)
            each_input(frame, g, [&](swivel_field field, const Spread& values) {
                if (way_.has_frames || way_.is_far)
                    frames[g].in(field, values.in());
                else
                    check(swivel_write(crowd_.get(), field, g, 0, body_count(), values.in()));
            });
        Job job{.pose = &pose};
        if (way_.has_frames || way_.is_far) job.frames = frames;
        way_.solve(crowd_, job);
        read(way_.is_apart ? results : poses);
    }
    void read(const PoseBuffer& poses)
    {
        const std::size_t first = bits.size();
        bits.resize(first + body_count());
        swivel_field_info info;
        for (std::uint32_t g = 0; g < group_count(); ++g)
            for (std::uint32_t i = 0; swivel_describe_field(i, &info); ++i) {
                const std::uint32_t count = swivel_field_row_count(crowd_.get(), g, info.field);
                if (info.kind == SWIVEL_FIELD_INPUT || count == 0) continue;
                std::vector<std::uint32_t> words(std::size_t{count} * body_count());
                check(
                    swivel_read(crowd_.get(), info.field, g, 0, body_count(), {words.data(), count * sizeof words[0]}));
                for (std::uint32_t n = 0; n < body_count(); ++n)
                    bits[first + order_[n]].insert(bits[first + order_[n]].end(), &words[n * count],
                                                   &words[n * count] + count);
            }
        for (std::uint32_t n = 0; n < body_count(); ++n) {
            std::vector<std::uint32_t> words(4 * poses.joint_count);
            std::memcpy(words.data(), &poses.bytes[n * poses.body_stride], words.size() * sizeof words[0]);
            bits[first + order_[n]].insert(bits[first + order_[n]].end(), words.begin(), words.end());
        }
    }

    const PlantFrames& of_;
    const Way& way_;
    std::vector<std::uint32_t> order_;
    Crowd crowd_;
    std::vector<Spread> spreads_;
};

std::vector<std::vector<std::uint32_t>> bits_of(const PlantFrames& frames, const Way& way = {})
{
    return Played(frames, way).bits;
}

// Half of the bodies, then the other half.
void solve_halves(Crowd& crowd, Job job, bool by_list)
{
    const std::uint32_t limbs = swivel_group_limb_count(crowd.get(), 0);
    for (const std::uint32_t odd : {1u, 0u}) {
        std::vector<std::uint32_t> mask((swivel_block_count(crowd.get()) + 1) / 2), list;
        for (std::uint32_t n = 0; n < limbs; ++n)
            if ((n * 7 / 5) % 2 == odd) mask[n / 32] |= 1u << n % 32, list.push_back(n);
        if (by_list)
            job.limbs = list;
        else
            job.mask = mask;
        crowd.solve(job);
    }
}
void solve_in_chunks(Crowd& crowd, Job job)
{
    const std::uint32_t blocks = swivel_block_count(crowd.get());
    job.on_this_thread = true;
    for (std::uint32_t first = blocks; first-- > 0;) {
        job.blocks = swivel_blocks{first, 1};
        crowd.solve(job);
    }
}

}  // namespace

TEST_CASE("bodies that stand have the same bits on every instruction set")
{
    const IsaScope scope;
    const std::vector<std::string> isas = runnable_isas();
    rc::prop("whatever they do", [&](std::uint64_t seed) {
        Random random{seed};
        const PlantFrames frames(random, 1 + random.below(70));
        std::vector<std::vector<std::uint32_t>> first;
        for (const std::string& isa : isas) {
            check(swivel_use_isa(isa.c_str()));
            const auto bits = bits_of(frames);
            if (first.empty()) first = bits;
            RC_ASSERT((bits == first));
        }
    });
}

TEST_CASE("bodies that stand have the same bits in any order, memory and choice")
{
    rc::prop("whatever they do", [](std::uint64_t seed) {
        Random random{seed};
        const std::uint32_t body_count = 1 + random.below(70);
        const PlantFrames frames(random, body_count);
        const auto wanted = bits_of(frames);
        Way shuffled;
        for (std::uint32_t n = 0; n < body_count; ++n) shuffled.order.push_back(n);
        for (std::uint32_t n = body_count; n > 1; --n)
            std::swap(shuffled.order[n - 1], shuffled.order[random.below(n)]);
        RC_ASSERT((bits_of(frames, shuffled) == wanted));
        RC_ASSERT((bits_of(frames, {.gap = 4 * random.below(1024)}) == wanted));
        RC_ASSERT((bits_of(frames, {.has_frames = true}) == wanted));
        RC_ASSERT((bits_of(frames, {.is_apart = true}) == wanted));
        RC_ASSERT((bits_of(frames, {.solve = solve_in_chunks}) == wanted));
        for (const bool by_list : {false, true})
            RC_ASSERT((bits_of(frames, {.solve = [&](Crowd& crowd, const Job& job) {
                                   solve_halves(crowd, job, by_list);
                               }}) == wanted));
    });
}

TEST_CASE("bodies that stand have the same bits in doubles far from the origin")
{
    rc::prop("whatever they do", [](std::uint64_t seed) {
        Random random{seed};
        // What is recorded says where it is. And a root that is shifted is rounded where it is.
        const PlantFrames frames(random, 1 + random.below(40), SWIVEL_WITH_RECORD | SWIVEL_WITH_FIT);
        RC_ASSERT((bits_of(frames, {.is_far = true}) == bits_of(frames)));
    });
}

TEST_CASE("many bodies that stand have the same bits on threads")
{
    Random random{11};
    const PlantFrames frames(random, 3000);
    CHECK(bits_of(frames) == bits_of(frames, {.solve = solve_in_chunks}));
}
