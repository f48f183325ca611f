// SPDX-License-Identifier: MIT
//
// Calls of the C interface that solve, with jobs of all kinds, and that choose the most urgent.
#include <algorithm>
#include <bit>
#include <memory>

#include "tests/fuzz/interface_session.h"

namespace swivel::fuzz {
namespace {

struct Blocks {
    std::uint32_t first, count;
    bool is_valid;
};
Blocks take_blocks(Session& session)
{
    const std::uint32_t has = swivel_block_count(session.crowd), first = session.bytes.below(has + 1);
    if (session.bytes.one_in(16)) return {first, has - first + 1 + session.bytes.take<std::uint32_t>() / 2, false};
    return {first, session.bytes.below(has - first + 1), true};
}

std::vector<bool> lanes_of(const Session& session, const Blocks& blocks)
{
    std::vector<bool> lanes(session.lane_count());
    for (std::size_t lane = std::size_t{blocks.first} * SWIVEL_LANES;
         lane < (std::size_t{blocks.first} + blocks.count) * SWIVEL_LANES; ++lane)
        lanes[lane] = true;
    return lanes;
}

// Words of a bit for each lane, one in 16 times too few or too many.
std::vector<std::uint32_t> take_words(Session& session)
{
    const std::size_t count = (swivel_block_count(session.crowd) + 1) / 2;
    std::vector<std::uint32_t> words(session.bytes.one_in(16) ? session.bytes.below(4) : count);
    for (std::uint32_t& word : words) word = session.bytes.take<std::uint32_t>();
    return words;
}
bool are_enough(const Session& session, const std::vector<std::uint32_t>& words)
{
    return words.size() == (swivel_block_count(session.crowd) + 1) / 2;
}
bool has(const std::vector<std::uint32_t>& words, std::size_t lane) { return words[lane / 32] >> lane % 32 & 1; }

// Lanes that are limbs.
std::vector<bool> limbs_of(const Session& session)
{
    std::vector<bool> lanes(session.lane_count());
    for (std::uint32_t group = 0; group < session.group_count; ++group)
        for (std::uint32_t n = 0; n < swivel_group_limb_count(session.crowd, group); ++n)
            lanes[swivel_group_first_limb(session.crowd, group) + n] = true;
    return lanes;
}

// One entry for each group; of bodies one alone.
struct Priorities {
    std::vector<Strided> values;
    std::vector<swivel_in> in;
    bool are_valid = true;

    explicit Priorities(Session& session)
    {
        for (std::uint32_t group = 0; group < (session.bodies ? 1 : session.group_count); ++group) {
            Strided& each =
                values.emplace_back(session.bytes, swivel_group_limb_count(session.crowd, group), sizeof(float), true);
            const bool any_bits = session.bytes.one_in(2);
            each.fill([&](std::size_t, char* at) {
                const float value = any_bits ? session.bytes.any_float() : session.bytes.share();
                std::memcpy(at, &value, sizeof value);
            });
            in.push_back(each.in());
            are_valid = are_valid && each.is_valid();
        }
    }
};

// Blocks are picked whole, and no more than asked for.
void check_choice(const Session& session, const std::vector<std::uint32_t>& words, std::uint32_t max_blocks,
                  std::uint32_t count)
{
    const std::vector<bool> limbs = limbs_of(session);
    std::uint32_t bits = 0, blocks = 0;
    for (const std::uint32_t word : words) bits += static_cast<std::uint32_t>(std::popcount(word));
    for (std::size_t block = 0; block < limbs.size() / SWIVEL_LANES; ++block) {
        const bool is_picked = has(words, block * SWIVEL_LANES);
        blocks += is_picked;
        for (std::size_t lane = block * SWIVEL_LANES; lane < (block + 1) * SWIVEL_LANES; ++lane)
            SWIVEL_REQUIRE(has(words, lane) == (is_picked && limbs[lane]));
    }
    SWIVEL_REQUIRE(blocks <= max_blocks && bits == count);
}

bool has_workspace(const Session& session)
{
    return session.has_workspace || swivel_workspace_bytes(session.crowd) == 0;
}

// The ground that a job asks for. It depends on the place alone, so a body has the same alone.
struct Ground {
    std::uint64_t seed = 0;
    const Session* session = nullptr;
};
// Some of it is none, some is hard, and some is left as it was.
void sample_ground(const swivel_probes* probes, void* user)
{
    const Ground& ground = *static_cast<const Ground*>(user);
    SWIVEL_REQUIRE(probes->count > 0 && probes->count <= 128);
    SWIVEL_REQUIRE(probes->group < ground.session->group_count);
    SWIVEL_REQUIRE(has_features(*ground.session, probes->group, SWIVEL_WITH_GROUND));
    for (std::uint32_t n = 0; n < probes->count; ++n) {
        SWIVEL_REQUIRE(probes->bodies[n] < ground.session->bodies->body_count);
        SWIVEL_REQUIRE(n == 0 || probes->bodies[n] > probes->bodies[n - 1]);
        std::uint64_t key = ground.seed;
        for (const float x : probes->places[n]) key = Random{key ^ std::bit_cast<std::uint32_t>(x)}.bits();
        Random random{key};
        const std::uint32_t kind = random.below(8);
        if (kind > 0) make_value(random, SWIVEL_GROUND, kind, probes->grounds[n]);
        if (kind > 1) make_value(random, SWIVEL_GROUND_NORMAL, kind, probes->normals[n]);
    }
}

// A job from bytes, what it points to, and which lanes it solves.
struct TakenJob {
    Session& session;
    swivel_job job = swivel_default_job();
    swivel_blocks blocks{0, 0};
    std::vector<std::uint32_t> words = {};
    std::unique_ptr<Pose> pose = {};
    std::vector<JobStreams> frames = {};
    std::vector<std::uint32_t> framed_groups = {}, named = {};
    std::vector<swivel_streams> frame_array = {};
    std::vector<bool> lanes;
    bool is_valid = true;
    std::uint32_t solved_count = ~0u;

    struct alignas(64) Line {
        char bytes[64];
    };
    std::vector<Line> workspace = {};
    Ground ground = {};

    explicit TakenJob(Session& in) : session(in), lanes(in.lane_count(), true)
    {
        Bytes& bytes = session.bytes;
        if (bytes.one_in(2)) take_range();
        job.on_this_thread = bytes.one_in(2);
        switch (bytes.below(5)) {
            case 2:
                take_mask();
                break;
            case 3:
                take_few();
                break;
            case 4:
                take_urgent();
                break;
        }
        if (bytes.one_in(64) && !job.mask) take_mask();  // seeds have a byte for it
        if (bytes.one_in(4)) take_groups();
        if (session.bodies) take_pose();
        if (session.bodies) take_sampling();
        if (bytes.one_in(2)) take_frames();
        if (bytes.one_in(2)) job.solved_count = &solved_count;
        take_workspace();
        if (bytes.one_in(64)) {
            job.size = bytes.one_in(2) ? 0 : sizeof job + 1 + bytes.take<std::uint8_t>();
            is_valid = false;
        }
    }

    bool asks() const { return job.sample != nullptr; }
    SomeLimbs chosen() const
    {
        SomeLimbs limbs = session.limbs_that(true);
        for (std::uint32_t group = 0; group < limbs.size(); ++group)
            for (std::uint32_t n = 0; n < limbs[group].size(); ++n)
                limbs[group][n] = is_named(group) && lanes[swivel_group_first_limb(session.crowd, group) + n];
        return limbs;
    }
    // Limbs, or bodies, which are those of each named group.
    std::uint32_t count() const
    {
        std::uint32_t count = 0;
        const SomeLimbs limbs = chosen();
        for (std::uint32_t group = 0; group < limbs.size() && !(session.bodies && count > 0); ++group)
            count += static_cast<std::uint32_t>(std::ranges::count(limbs[group], true));
        return count;
    }

private:
    void keep(const std::vector<bool>& some)
    {
        for (std::size_t lane = 0; lane < lanes.size(); ++lane) lanes[lane] = lanes[lane] && some[lane];
    }
    void take_range()
    {
        const Blocks taken = take_blocks(session);
        blocks = {taken.first, taken.count};
        job.blocks = &blocks;
        is_valid = is_valid && taken.is_valid;
        if (taken.is_valid) keep(lanes_of(session, taken));
    }
    bool is_named(std::uint32_t group) const { return !job.groups || (named[group / 32] >> group % 32 & 1) != 0; }
    void take_groups()
    {
        named.assign((session.group_count + 31) / 32, session.bytes.take<std::uint8_t>());
        job.groups = named.data();
        job.group_word_count = static_cast<std::uint32_t>(named.size());
        if (session.bytes.one_in(32)) job.group_word_count = 2, is_valid = false;
    }
    void take_pose()
    {
        pose = std::make_unique<Pose>(session);
        job.pose = session.bytes.one_in(64) ? nullptr : &pose->given;
        std::vector<bool> is_solved;
        for (std::uint32_t group = 0; group < session.group_count; ++group) is_solved.push_back(is_named(group));
        if (!job.pose || !pose->is_valid(session, is_solved)) is_valid = false;
        if (!are_links_named()) is_valid = false;
    }
    // What limbs are linked to is solved with them, and no prop without all that hold it.
    bool are_links_named() const
    {
        for (std::uint32_t group = 0; group < session.group_count; ++group) {
            if (!has_features(session, group, SWIVEL_WITH_LINK)) continue;
            const std::uint32_t link = session.bodies->groups[group].limb.link;
            if (is_named(group) && !is_named(link)) return false;
            if (is_named(link) && !is_named(group) && is_of(session, link, SWIVEL_KIND_PROP)) return false;
        }
        return true;
    }
    void take_sampling()
    {
        bool has_ground = false;
        for (std::uint32_t group = 0; group < session.group_count; ++group)
            has_ground = has_ground || (is_named(group) && has_features(session, group, SWIVEL_WITH_GROUND));
        if (!has_ground && !session.bytes.one_in(32)) return;
        const std::uint32_t kind = session.bytes.below(16);
        if (kind % 4 != 2 && kind != 15) return;  // as seeds have it
        ground = {session.bytes.take<std::uint16_t>(), &session};
        job.sample = sample_ground, job.sample_user = &ground;
    }
    void take_workspace()
    {
        const std::size_t bytes = swivel_workspace_bytes(session.crowd);
        workspace.resize(bytes / sizeof(Line));
        if (job.solved_count)
            job.workspace = workspace.data();
        else if (!has_workspace(session))
            is_valid = false;
    }
    void take_mask()
    {
        words = take_words(session);
        give_words();
    }
    void give_words()
    {
        words.reserve(1);  // never null
        job.mask = words.data();
        job.mask_word_count = static_cast<std::uint32_t>(words.size());
        if (!are_enough(session, words)) return void(is_valid = false);
        std::vector<bool> some(lanes.size());
        for (std::size_t lane = 0; lane < some.size(); ++lane) some[lane] = has(words, lane);
        keep(some);
    }
    // A mask of a few limbs, or of any lanes.
    void take_few()
    {
        const std::vector<bool> limbs = limbs_of(session);
        const bool any_lane = session.bytes.one_in(8);
        words.resize((swivel_block_count(session.crowd) + 1) / 2);
        for (std::uint32_t n = session.bytes.below(20); n > 0; --n) {
            std::uint32_t lane = session.bytes.below(session.lane_count() + (any_lane ? 20 : 0));
            while (!any_lane && !limbs[lane]) --lane;  // a group's padding comes after a limb
            if (lane < session.lane_count()) words[lane / 32] |= 1u << lane % 32;
        }
        give_words();
    }
    // The mask of the most urgent blocks; of priorities that are refused none.
    void take_urgent()
    {
        const Priorities priorities(session);
        const std::uint32_t block_count = swivel_block_count(session.crowd),
                            max_blocks = session.bytes.below(block_count + 2);
        std::vector<float> urgency(block_count);
        if (session.bytes.one_in(2))
            for (float& each : urgency) each = session.bytes.any_float();
        words.resize((block_count + 1) / 2);
        const swivel_status status = swivel_choose(session.crowd, priorities.in.data(), urgency.data(), max_blocks,
                                                   words.data(), static_cast<std::uint32_t>(words.size()), nullptr);
        SWIVEL_REQUIRE((status == SWIVEL_OK) == priorities.are_valid);
        give_words();
    }
    void take_frames()
    {
        for (std::uint32_t group = 0; group < session.group_count; ++group) {
            if (!is_named(group)) continue;
            const bool is_far = job.pose && pose->seen().root_is_double && pose->root_position();
            frames.emplace_back(session, group, is_far ? &*pose->root_position() : nullptr);
            framed_groups.push_back(group);
            const std::uint32_t from = swivel_group_first_limb(session.crowd, group) / SWIVEL_LANES,
                                to = from + (swivel_group_limb_count(session.crowd, group) - 1) / SWIVEL_LANES;
            const bool is_touched =
                !job.blocks || (blocks.count > 0 && from < blocks.first + blocks.count && to >= blocks.first);
            if (is_touched && !frames.back().is_valid) is_valid = false;  // others are not looked at
        }
        for (const JobStreams& frame : frames) frame_array.push_back(frame.view());
        if (frame_array.empty())
            frame_array.push_back(swivel_default_streams());  // for no group: its size is looked at
        job.streams = frame_array.data();
    }
};

}  // namespace

void call_solve(Session& session)
{
    if (session.bytes.one_in(8)) {
        const bool can_be = has_workspace(session) && !session.bodies;  // which need a pose
        check_status(session, swivel_solve(session.crowd, nullptr), can_be);
        return check_solved(session, session.limbs_that(can_be));
    }
    TakenJob taken(session);
    const swivel_status status = swivel_solve(session.crowd, &taken.job);
    check_status(session, status, taken.is_valid);
    const bool is_solved = status == SWIVEL_OK;
    if (taken.job.solved_count) SWIVEL_REQUIRE(is_solved == (taken.solved_count != ~0u));
    const SomeLimbs chosen = is_solved ? taken.chosen() : session.limbs_that(false);
    for (std::size_t n = 0; n < taken.frames.size(); ++n)
        taken.frames[n].check(session, taken.framed_groups[n], chosen[taken.framed_groups[n]], taken.asks());
    if (taken.pose) taken.pose->check(session, chosen, taken.asks());
    if (!is_solved) return;
    check_solved(session, chosen);
    if (taken.job.solved_count) SWIVEL_REQUIRE(taken.count() == taken.solved_count);
}

void call_choose(Session& session)
{
    const std::uint32_t max_blocks = session.bytes.below(swivel_block_count(session.crowd) + 2);
    const Priorities priorities(session);
    std::uint32_t count = ~0u;
    std::vector<std::uint32_t> words = take_words(session);
    const std::vector<std::uint32_t> words_before = words;
    std::vector<float> urgency(swivel_block_count(session.crowd));
    for (float& each : urgency) each = session.bytes.any_float();
    const swivel_status status =
        swivel_choose(session.crowd, priorities.in.data(), session.bytes.one_in(2) ? urgency.data() : nullptr,
                      max_blocks, words.data(), static_cast<std::uint32_t>(words.size()), &count);
    check_status(session, status, priorities.are_valid && are_enough(session, words));
    if (status == SWIVEL_OK)
        check_choice(session, words, max_blocks, count);
    else
        SWIVEL_REQUIRE(words == words_before && count == ~0u);
}

}  // namespace swivel::fuzz
