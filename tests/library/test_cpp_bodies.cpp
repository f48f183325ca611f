// SPDX-License-Identifier: MIT
//
// The promise: crowds of bodies that swivel.hpp makes and drives have the bits of crowds made and driven in C. Standing
// crowds of the corpus are played both ways: groups from makers, state as the caller's structures, ground from a
// function, which may throw.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>

#include "swivel/swivel_bodies.hpp"
#include "tools/corpus/corpus.h"

namespace {

using namespace swivel;
using corpus::Recipe;

const Recipe& standing(std::string_view name) { return corpus::recipe_of(corpus::Part::standing, name); }

// A standing crowd of the corpus, and the poses that it is solved with.
class Player {
public:
    explicit Player(const Recipe& recipe, std::uint32_t body_count = 20)
        : crowd(corpus::make_crowd(recipe, body_count)), recipe_(recipe), standing_(recipe, body_count)
    {
    }
    // With another crowd of the same groups, which gets the inputs of the corpus.
    Player(const Recipe& recipe, Crowd made) : Player(recipe, swivel_group_limb_count(made.get(), 0))
    {
        for (std::uint32_t group = 0; group < swivel_group_count(made.get()); ++group) {
            const swivel_rows from = swivel_input_rows(crowd.get(), group), to = swivel_input_rows(made.get(), group);
            REQUIRE(from.row_count == to.row_count);
            std::copy_n(from.base, std::size_t{from.block_count} * from.row_count * SWIVEL_LANES, to.base);
        }
        crowd = std::move(made);
    }

    // Frames from the first on, each solved by solve(job).
    template <class Solve>
    Player& play(std::uint32_t frames, const Solve& solve)
    {
        for (std::uint32_t frame = 0; frame < frames; ++frame) {
            standing_.go_to(frame, crowd);
            corpus::with_job(standing_.poses(), solve);
        }
        return *this;
    }
    Player& play(std::uint32_t frames = 20)
    {
        return play(frames, [&](const Job& job) { crowd.solve(job); });
    }
    std::uint64_t digest() { return corpus::digest_poses(standing_.poses(), crowd.digest()); }
    // The same without probes, which feet with bad input have only where ground is asked for.
    std::uint64_t digest_but_probes()
    {
        std::uint64_t hash = corpus::digest_poses(standing_.poses(), corpus::kDigestStart);
        for (std::uint32_t group = 0; group < swivel_group_count(crowd.get()); ++group)
            for (const swivel_field field : corpus::results_of(crowd, group)) {
                if (field == SWIVEL_PROBE) continue;
                for (const std::uint32_t word : corpus::read_field(crowd, recipe_, field, group))
                    hash = corpus::fold(hash, word);
            }
        return hash;
    }

    Crowd crowd;

private:
    const Recipe& recipe_;
    corpus::Standing standing_;
};

// Calls take() with C's definition of a crowd of 20 bodies.
template <class Take>
void with_definition(const Recipe& recipe, const Take& take)
{
    corpus::with_definition(recipe, {20, 20, 20}, take);
}

// A group as the makers of swivel.hpp make it, with the members that they do not take.
swivel_body_limb_def made_as(const swivel_body_limb_def& in_c)
{
    swivel_body_limb_def made = body_limb(*in_c.joints, in_c.features);
    made.on_bad_input = in_c.on_bad_input;
    made.shoulder_order = in_c.shoulder_order, made.wrist_order = in_c.wrist_order;
    made.plant = in_c.plant, made.ground = in_c.ground, made.link = in_c.link, made.region = in_c.region;
    return made;
}
swivel_look_def made_as(const swivel_look_def& in_c)
{
    swivel_look_def made = in_c;
    const swivel_look_def chain = look(std::span(in_c.joints).first(in_c.joint_count));
    made.joint_count = chain.joint_count;
    std::ranges::copy(chain.joints, made.joints);
    return made;
}
std::vector<Definition> made_as(const swivel_crowd_def& in_c)
{
    std::vector<Definition> made;
    for (const swivel_group_def& group : std::span(in_c.groups, in_c.group_count)) {
        if (group.body_limb) made.push_back(made_as(*group.body_limb));
        if (group.look) made.push_back(made_as(*group.look));
        if (group.prop) made.push_back(*group.prop);
        if (group.shift) made.push_back(*group.shift);
    }
    return made;
}

// A hill for each body. Heels have ground of another slope than toes.
void put_hill(std::uint32_t group, std::uint32_t body, const float (&place)[3], float (&ground)[3], float (&normal)[3])
{
    const float slope = 0.1f * static_cast<float>(body % 3 + group);
    std::copy_n(place, 3, ground);
    ground[1] = slope * place[0];
    normal[0] = -slope, normal[1] = 1, normal[2] = 0;
}
void put_hills(const swivel_probes& probes)
{
    for (std::size_t n = 0; n < probes.count; ++n)
        put_hill(probes.group, probes.bodies[n], probes.places[n], probes.grounds[n], probes.normals[n]);
}
// The same in C.
void put_hills_in_c(const swivel_probes* probes, void*)
{
    for (std::uint32_t n = 0; n < probes->count; ++n)
        put_hill(probes->group, probes->bodies[n], probes->places[n], probes->grounds[n], probes->normals[n]);
}

}  // namespace

TEST_CASE("C++: groups from makers and a crowd from a skeleton have the bits of C's definitions")
{
    for (const Recipe& recipe : corpus::recipes_of(corpus::Part::standing)) {
        std::optional<Crowd> crowd;
        with_definition(recipe, [&](const swivel_crowd_def& def) {
            crowd.emplace(*def.skeleton, def.body_count, made_as(def), std::array{def.up[0], def.up[1], def.up[2]});
        });
        INFO(corpus::full_name(recipe));
        CHECK(Player(recipe, std::move(*crowd)).play().digest() == Player(recipe).play().digest());
    }
}

TEST_CASE("C++: what a maker is not told is as in C: constants, what bad input gets, and up")
{
    const swivel_limb_joints joints = swivel_default_limb_joints(0, 1, 2);
    const swivel_body_limb_def limb = body_limb(joints, SWIVEL_WITH_HAND);
    CHECK((limb.joints == &joints && limb.features == SWIVEL_WITH_HAND));
    CHECK((limb.on_bad_input == SWIVEL_KEEP_POSE && limb.link == UINT32_MAX));
    CHECK(limb.plant.stop_time == swivel_default_plant().stop_time);
    CHECK((limbs(7).limb_count == 7 && limbs(7).on_bad_input == SWIVEL_REST_POSE));
    const swivel_look_def of_three = look({3, 1, 4});
    CHECK(of_three.rate == swivel_default_look_def().rate);
    CHECK((of_three.joint_count == 3 && of_three.joints[2] == 4));

    const Recipe& recipe = standing("feet");
    std::vector<std::uint64_t> digests;
    with_definition(recipe, [&](const swivel_crowd_def& def) {
        const std::vector<Definition> groups = made_as(def);
        digests.push_back(Player(recipe, Crowd(*def.skeleton, 20, groups)).play().digest());
        for (const std::array<float, 3>& up : {std::array{0.0f, 2.0f, 0.0f}, std::array{0.0f, 0.0f, 1.0f}})
            digests.push_back(Player(recipe, Crowd(*def.skeleton, 20, groups, up)).play().digest());
        CHECK_THROWS_WITH(Crowd(*def.skeleton, 20, {look({0, 1, 2, 3, 4, 5, 6, 7, 8})}),
                          Catch::Contains("look.joint_count is 9"));
    });
    CHECK(digests[0] == digests[1]);
    CHECK(digests[0] != digests[2]);
}

TEST_CASE("C++: what is carried is read and set back as the caller's structures, and supports change for some bodies")
{
    struct Leg {
        std::array<float, 11> plant;
        std::uint32_t mark;
    };
    Player feet(standing("feet-by-motion"));
    feet.play();
    std::vector<Leg> legs(20, Leg{{}, 7});
    std::vector<std::array<float, 11>> plants(20), again(20);
    feet.crowd.read(SWIVEL_PLANT, 1, legs);
    feet.crowd.read(SWIVEL_PLANT, 1, plants);
    for (std::size_t n = 0; n < legs.size(); ++n) CHECK((legs[n].plant == plants[n] && legs[n].mark == 7));
    Player other(standing("feet-by-motion"));
    other.crowd.write(SWIVEL_PLANT, 1, legs);
    other.crowd.read(SWIVEL_PLANT, 1, again);
    CHECK(plants == again);

    const std::vector<corpus::Support> from(2, {{1, 2, 3}, {0, 0, 0, 1}}),
        to{{{1, 2.25, 3}, {0, 0.6f, 0, 0.8f}}, {{0, 2, 3}, {0, 0, 0.6f, 0.8f}}};
    Player in_c(standing("feet-by-motion"));
    in_c.play();
    const auto view = [](const std::vector<corpus::Support>& supports) {
        return swivel_supports{.position = stream(supports, &corpus::Support::position),
                               .rotation = stream(supports, &corpus::Support::rotation)};
    };
    check(swivel_change_support(feet.crowd.get(), 0, 4, 2, view(from), view(to)));
    for (std::uint32_t n = 0; n < 2; ++n) corpus::change_support(in_c.crowd, 0, 4 + n, from[n], to[n]);
    CHECK(feet.digest() == in_c.digest());
    CHECK(feet.digest() != Player(standing("feet-by-motion")).play().digest());
}

TEST_CASE("C++: a function is asked for ground at each foot's probe, and gives the bits of C's function")
{
    const Recipe& recipe = standing("ground");
    Player asking(recipe, 300), calling(recipe, 300);
    std::mutex one_at_a_time;
    std::set<std::pair<std::uint32_t, std::uint32_t>> asked;
    std::vector<std::vector<std::array<float, 3>>> grounds;  // of each group's bodies, as their rows have them
    asking.play(3, [&](Job job) {
        asked.clear();
        grounds.clear();
        for (std::uint32_t g = 0; g < swivel_group_count(asking.crowd.get()); ++g) {
            grounds.emplace_back(300);
            if (swivel_group_features(asking.crowd.get(), g) & SWIVEL_WITH_GROUND)
                asking.crowd.read(SWIVEL_GROUND, g, grounds.back());
        }
        job.sample = [&](const swivel_probes& probes) {
            const std::lock_guard lock(one_at_a_time);
            for (std::size_t n = 0; n < probes.count; ++n) {
                CHECK(asked.insert({probes.group, probes.bodies[n]}).second);
                const float given = grounds[probes.group][probes.bodies[n]][1];
                CHECK(std::isnan(given) == std::isnan(probes.grounds[n][1]));
            }
            put_hills(probes);
        };
        asking.crowd.solve(job);
    });
    CHECK(asked.size() > 3 * 290);  // a few have bad input
    calling.play(3, [&](const Job& job) {
        swivel_job in_c = swivel_default_job();
        in_c.pose = job.pose, in_c.sample = put_hills_in_c;
        check(swivel_solve(calling.crowd.get(), &in_c));
    });
    CHECK(asking.digest() == calling.digest());
    CHECK(asking.digest() != Player(recipe, 300).play(3).digest());
}

TEST_CASE("C++: what a function throws comes out of solve, which is done, and no more feet ask")
{
    const Recipe& recipe = standing("ground");
    const auto solved = [&](const Sample& sample, bool on_this_thread, const char* throws) {
        Player player(recipe, 300);
        player.play(1, [&](Job job) {
            job.sample = sample, job.on_this_thread = on_this_thread;
            if (throws)
                CHECK_THROWS_WITH(player.crowd.solve(job), throws);
            else
                player.crowd.solve(job);
        });
        return player.digest_but_probes();
    };
    const std::uint64_t untold = solved({}, true, nullptr), told = solved(put_hills, true, nullptr);
    CHECK(told != untold);
    for (const bool on_this_thread : {true, false})
        for (const int last : {1, 2}) {
            std::atomic<int> calls = 0;
            const auto throwing = [&](const swivel_probes& probes) {
                if (++calls >= last) throw std::runtime_error("no ground loaded");
                put_hills(probes);
            };
            const std::uint64_t digest = solved(throwing, on_this_thread, "no ground loaded");
            CHECK((digest == untold) == (last == 1));
            CHECK(digest != told);
            if (on_this_thread) CHECK(calls == last);
        }
}

TEST_CASE("C++: frames of bodies have values of their fields' widths and kinds")
{
    std::vector<std::array<float, 11>> plants(2);
    std::vector<std::array<double, 3>> places(2);
    Streams frame;
    CHECK_NOTHROW(frame.out(SWIVEL_PLANT, stream(plants)));
    CHECK_NOTHROW(frame.in(SWIVEL_NEXT_TARGET, stream(places)));
    CHECK_THROWS_WITH(frame.out(SWIVEL_SHIFT, stream(plants)), Catch::Contains("11 floats is no value"));
    CHECK_THROWS_WITH(frame.in(SWIVEL_CAP, stream(places)), Catch::Contains("is no position"));

    Player far(standing("prop-at-joint"));
    far.play(1, [&](Job job) {
        const std::vector<std::array<float, 3>> grounds(20);
        std::vector<Streams> frames(swivel_group_count(far.crowd.get()));
        frames[0].in(SWIVEL_GROUND, stream(grounds));
        job.streams.assign(frames.begin(), frames.end());
        CHECK_THROWS_WITH(far.crowd.solve(job),
                          Catch::Contains("ground is in floats, but the pose has root_is_double"));
    });
    std::vector<std::array<double, 3>> origins(20);
    std::uint32_t prop = 0;
    while (swivel_group_kind(far.crowd.get(), prop) != SWIVEL_KIND_PROP) ++prop;
    CHECK_NOTHROW(far.crowd.write_doubles(SWIVEL_PROP_POSITION, prop, origins));
    CHECK_THROWS_WITH(far.crowd.write_doubles(SWIVEL_PROP_POSITION, prop, origins, stream(origins)),
                      Catch::Contains("it is in a joint's frame here, which has no origin; give null"));
}
