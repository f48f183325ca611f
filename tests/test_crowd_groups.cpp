// SPDX-License-Identifier: MIT
//
// The promise: groups with features of their own have, in one crowd and one job, the bits that each has in a crowd of
// its own. A job solves the groups that it names and touches no other. With SWIVEL_KEEP_POSE a limb with bad input
// keeps its results, its values in frames and what it carries.
#include "tests/test_crowd.h"
#include "tests/test_isa_scope.h"
#include "tests/test_limb.h"

#include <rapidcheck/catch.h>
#include <cmath>
#include <fstream>
#include <regex>

using namespace swivel;
using namespace swivel::test;

namespace {

// Kinds of limbs that a game has: plain legs, arms, arms with limits, arms that blend, arms that step.
constexpr swivel_features kPlainLeg = SWIVEL_WORLD | SWIVEL_JOINTS, kPlainArm = kPlainLeg | SWIVEL_WITH_HAND,
                          kKinds[] = {
                              0,
                              kPlainLeg,
                              kPlainArm,
                              kPlainArm | SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST,
                              kPlainArm | SWIVEL_WITH_SHOULDER_BOX | SWIVEL_WITH_WRIST_BOX | SWIVEL_WITH_REACH,
                              kPlainArm | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_EFFECTOR,
                              SWIVEL_WITH_MOST_SWIVEL | SWIVEL_WITH_SHOULDER_CONE,
                              kPlainArm | SWIVEL_WITH_CLAVICLE | 3 * SWIVEL_WITH_TWIST_BONES,
                              kPlainArm | SWIVEL_WITH_INCOMING | SWIVEL_POLE_INCOMING,
};

template <std::size_t Size>
void put_value(Crowd& crowd, swivel_field field, std::uint32_t group, std::uint32_t n,
               const std::array<float, Size>& value)
{
    if (swivel_field_row_count(crowd.get(), group, field) > 0) crowd.write(field, group, std::span(&value, 1), n);
}

// Random goals and limits for a limb; one in sixteen has bad input.
void write_random_limb(Crowd& crowd, std::uint32_t group, std::uint32_t n, Random& random)
{
    const swivel_features features = swivel_group_features(crowd.get(), group);
    Limb limb = random_limb(random, features, {static_cast<float>(random.spread(0.5, 2)), 1});
    if (random.below(16) == 0) limb.pole[random.below(3)] = kNan;
    write_limb(crowd, group, n, limb);
    const auto direction = [&] {
        const Vector3d v = random.direction();
        return std::array{v.x(), v.y(), v.z()};
    };
    put_value(crowd, SWIVEL_SHOULDER_CONE, group, n, cone(direction(), random.between(0.5, 2)));
    put_value(crowd, SWIVEL_HUMERAL_TWIST, group, n, range(-random.between(0, 2), random.between(0, 2)));
    put_value(crowd, SWIVEL_WEIGHTS, group, n,
              Float3{static_cast<float>(random.between(0, 1)), static_cast<float>(random.between(0, 1)), 1});
    for (const swivel_field incoming : {SWIVEL_INCOMING_SHOULDER, SWIVEL_INCOMING_ELBOW, SWIVEL_INCOMING_WRIST})
        put_value(crowd, incoming, group, n, floats(random.rotation()));
    put_value(crowd, SWIVEL_MOST_SWIVEL, group, n, turn(random.between(0, 1)));
    const Vector3d clavicle = 0.3 * random.direction();
    put_value(crowd, SWIVEL_CLAVICLE, group, n,
              Float4{static_cast<float>(clavicle.x()), static_cast<float>(clavicle.y()),
                     static_cast<float>(clavicle.z()), 0.5f});
}

std::vector<swivel_group_def> random_groups(Random& random)
{
    std::vector<swivel_group_def> groups;
    for (std::uint32_t n = 1 + random.below(5); n > 0; --n) {
        swivel_group_def def = group_of(1 + random.below(70));
        def.features = kKinds[random.below(std::size(kKinds))];
        groups.push_back(def);
    }
    return groups;
}

// All words of a group's rows, of limbs alone.
std::vector<std::uint32_t> group_words(const Crowd& crowd, std::uint32_t group)
{
    std::vector<std::uint32_t> words;
    const auto take = [&](const auto& rows) {
        for (std::size_t n = 0; n < swivel_group_limb_count(crowd.get(), group); ++n)
            for (std::size_t row = 0; row < rows.row_count; ++row) {
                const auto number =
                    rows.base[(n / SWIVEL_LANES * rows.row_count + row) * SWIVEL_LANES + n % SWIVEL_LANES];
                std::uint32_t word = 0;
                std::memcpy(&word, &number, sizeof number);
                words.push_back(word);
            }
    };
    take(swivel_input_rows(crowd.get(), group));
    take(swivel_result_rows(crowd.get(), group));
    return words;
}

}  // namespace

TEST_CASE("groups of any features have the bits of crowds of their own")
{
    rc::prop("random groups, masks and named groups, twice", [](std::uint64_t seed) {
        Random random{seed};
        const std::vector<swivel_group_def> groups = random_groups(random);
        const auto count = static_cast<std::uint32_t>(groups.size());
        Crowd together(groups);
        std::vector<Crowd> alone;
        for (std::uint32_t g = 0; g < count; ++g) {
            alone.emplace_back(std::span(&groups[g], 1));
            const std::uint64_t goals = random.word();
            for (std::uint32_t n = 0; n < groups[g].limb_count; ++n) {
                Random of_limb{goals + n}, again = of_limb;
                write_random_limb(together, g, n, of_limb);
                write_random_limb(alone[g], 0, n, again);
            }
        }
        for (int solve = 0; solve < 2; ++solve) {  // the second from what the first carries
            std::vector<std::uint32_t> named, mask((swivel_block_count(together.get()) + 1) / 2);
            for (std::uint32_t& word : mask) word = random.word() | random.word();
            for (std::uint32_t g = 0; g < count; ++g) {
                if (random.below(4) == 0) continue;
                named.push_back(g);
                std::vector<std::uint32_t> own((swivel_block_count(alone[g].get()) + 1) / 2);
                for (std::uint32_t n = 0; n < groups[g].limb_count; ++n) {
                    const std::uint32_t limb = swivel_group_first_limb(together.get(), g) + n;
                    own[n / 32] |= (mask[limb / 32] >> limb % 32 & 1) << n % 32;
                }
                alone[g].solve({.mask = own});
            }
            together.solve({.groups = named, .mask = mask, .on_this_thread = random.below(2) == 0});
            for (std::uint32_t g = 0; g < count; ++g) {
                const bool same = group_words(together, g) == group_words(alone[g], 0);
                RC_ASSERT(same);
            }
        }
    });
}

TEST_CASE("a large crowd of several kinds has the same bits on threads")
{
    constexpr std::uint32_t kLimbs = 3000 * std::size(kKinds);
    std::vector<swivel_group_def> groups;
    for (const swivel_features features : kKinds) {
        groups.push_back(group_of(3000));
        groups.back().features = features;
    }
    Crowd one(groups), several(groups);
    for (Crowd* crowd : {&one, &several})
        for (std::uint32_t g = 0; g < groups.size(); ++g) {
            Random random{g};
            for (std::uint32_t n = 0; n < 3000; ++n) write_random_limb(*crowd, g, n, random);
        }
    CHECK(one.solve({.blocks = swivel_blocks{0, swivel_block_count(one.get())}, .on_this_thread = true}) == kLimbs);
    CHECK(several.solve() == kLimbs);
    CHECK(one.digest() == several.digest());
    CHECK(several.solve({.groups = {2u, 5u}}) == 6000);
}

TEST_CASE("jobs name groups; frames are given for those alone")
{
    Crowd crowd({group(20), group(5), group(40)});
    const Float3 target{0.3f, 0.2f, 1};
    for (std::uint32_t g = 0; g < 3; ++g) crowd.write_all(SWIVEL_LENGTHS, g, Float2{1, 1});
    Frame frame;
    frame.in(SWIVEL_TARGET, {&target, 0});
    CHECK(crowd.solve({.groups = {0u, 2u}, .frames = {frame, frame}}) == 60);
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS, 0)[19] == SWIVEL_REACHED);
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS, 1)[4] == 0);  // never solved
    CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS, 2)[39] == SWIVEL_REACHED);
    CHECK(crowd.solve({.groups = {1u}, .limbs = {3u, 32u}}) == 1);
    CHECK(crowd.solve({.groups = std::vector<std::uint32_t>()}) == 0);
    CHECK_THROWS_WITH(crowd.solve({.groups = {1u}, .frames = {frame, frame}}),
                      "2 frames for 1 groups; give one for each");
    CHECK_THROWS_WITH(crowd.solve({.groups = {3u}}), "group 3 does not exist; this crowd has 3");

    const std::uint32_t bits[2] = {5, 0};
    swivel_job job = swivel_default_job();
    job.groups = bits;
    for (const std::uint32_t wrong : {0u, 2u}) {
        job.group_word_count = wrong;
        CHECK_REFUSED(swivel_solve(crowd.get(), &job), SWIVEL_INVALID_ARGUMENT);
    }
    job.groups = nullptr;
    job.group_word_count = 1;
    CHECK_REFUSED(swivel_solve(crowd.get(), &job), SWIVEL_INVALID_ARGUMENT);
}

TEST_CASE("bad input keeps the pose where the group says so")
{
    const IsaScope scope;
    for (const std::string& isa : runnable_isas()) {
        REQUIRE(swivel_use_isa(isa.c_str()) == SWIVEL_OK);
        for (const swivel_features features : kKinds) {
            for (const bool masked : {false, true}) {
                INFO(isa << ", features " << features << (masked ? ", masked" : ""));
                const std::uint32_t count = 200;
                swivel_group_def def = group_of(count);
                def.features = features;
                Crowd rests({def});
                def.on_bad_input = SWIVEL_KEEP_POSE;
                Crowd keeps({def});
                std::vector<std::uint32_t> mask((swivel_block_count(keeps.get()) + 1) / 2, masked ? 0xfbfdeff7u : ~0u);
                const auto chosen = [&](std::uint32_t n) { return (mask[n / 32] >> n % 32 & 1) != 0; };
                const auto solve = [&] {
                    const Job job = masked ? Job{.mask = mask} : Job{};
                    rests.solve(job);
                    keeps.solve(job);
                };
                for (std::uint32_t n = 0; n < count; ++n)
                    for (Crowd* crowd : {&rests, &keeps}) {
                        Random random{1000 + n};
                        write_random_limb(*crowd, 0, n, random);
                        put_value(*crowd, SWIVEL_POLE, 0, n, Float3{0.3f, -0.8f, 0.1f});  // all good
                    }
                solve();
                std::vector<std::vector<std::uint32_t>> before;
                for (std::uint32_t n = 0; n < count; ++n) before.push_back(result_words(keeps, n));
                Random random{7};
                std::vector<bool> bad(count);
                for (std::uint32_t n = 0; n < count; ++n) {
                    bad[n] = random.below(3) == 0 || (n >= 64 && n < 96);  // whole blocks, too
                    if (!bad[n]) continue;
                    for (Crowd* crowd : {&rests, &keeps}) put_value(*crowd, SWIVEL_TARGET, 0, n, Float3{kNan, 0, 0});
                }
                solve();
                const std::size_t flags = swivel_field_first_row(keeps.get(), 0, SWIVEL_FLAGS);
                for (std::uint32_t n = 0; n < count; ++n) {
                    std::vector<std::uint32_t> expected = before[n];
                    if (bad[n] && chosen(n)) expected[flags] = SWIVEL_BAD_INPUT;
                    if (!bad[n]) expected = result_words(rests, n);
                    REQUIRE(result_words(keeps, n) == expected);
                }
            }
        }
    }
}

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
            }
            const std::string says = crowd.explain(0, 0);
            CHECK(says.find(std::isnan(before[0].target[1]) ? "keeps the pose it had" : "reached") !=
                  std::string::npos);
        }
}

TEST_CASE("the library describes the fields, features and flags that the header has")
{
    std::ifstream file(SWIVEL_SOURCE_DIR "/include/swivel/swivel.h");
    const std::string header{std::istreambuf_iterator<char>(file), {}};
    const auto lower = [](std::string name) {
        for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return name;
    };
    const auto names_in = [&](const std::string& text, const std::regex& pattern) {
        std::vector<std::string> names;
        for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
            names.push_back((*at)[1]);
        return names;
    };
    const std::string fields =
        header.substr(header.find("typedef enum swivel_field {"),
                      header.find("} swivel_field;") - header.find("typedef enum swivel_field {"));
    std::vector<std::string> wanted;
    for (const std::string& name : names_in(fields, std::regex(R"(\n    SWIVEL_(\w+)(?: = \d+)?,)")))
        wanted.push_back(lower(name));
    std::erase(wanted, "input_end");
    std::vector<std::string> got;
    swivel_field_info field;
    for (std::uint32_t n = 0; swivel_describe_field(n, &field); ++n) {
        got.push_back(field.name);
        const bool is_input = field.field < SWIVEL_INPUT_END;
        CHECK((field.kind == SWIVEL_FIELD_INPUT) == is_input);
        CHECK((field.kind == SWIVEL_FIELD_CARRIED) == (field.field == SWIVEL_NORMAL));
        CHECK((*field.range != 0) == is_input);
        // A group has the field just if it has what the field needs and lacks what it excludes.
        for (const swivel_features features : kKinds) {
            const Crowd crowd({group(1, group_of(1).binding, features)});
            const std::uint32_t count = swivel_component_count(field.field, features);
            const bool has = (features & field.needs) == field.needs && !(features & field.excludes);
            CHECK((swivel_field_row_count(crowd.get(), 0, field.field) > 0) == has);
            CHECK((count > 0) == has);
        }
    }
    CHECK(got == wanted);
    got.clear();
    swivel_feature_info feature;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &feature); ++n) got.push_back(feature.name);
    CHECK(got == names_in(header, std::regex(R"(\n#define SWIVEL_(\w+) \(UINT64_C\()")));
    std::vector<std::string> flags;
    for (std::uint32_t bit = 0; bit < 32; ++bit)
        if (const char* const name = swivel_flag_name(1u << bit)) flags.push_back(name);
    CHECK(flags == names_in(header, std::regex(R"(\n    SWIVEL_(\w+) = 1u << \d+,)")));
    CHECK(!swivel_flag_name(0));
    CHECK(std::string(swivel_flag_name(SWIVEL_BAD_INPUT | SWIVEL_REACHED)) == "REACHED");
    CHECK(!swivel_describe_field(0, nullptr));
    CHECK(!swivel_describe_feature(1000, &feature));
    CHECK(swivel_component_count(SWIVEL_INPUT_END, 0) == 0);
}

TEST_CASE("a job whose groups lie outside its blocks solves nothing, on threads, too")
{
    Crowd crowd({group(16 * 2000), group(16)});
    const Float3 target{0.3f, 0.2f, 1};
    for (std::uint32_t g = 0; g < 2; ++g) crowd.write_all(SWIVEL_LENGTHS, g, Float2{1, 1});
    const Frame frame = Frame().in(SWIVEL_TARGET, {&target, 0});
    CHECK(crowd.solve({.blocks = swivel_blocks{0, 2000}, .groups = {1u}, .frames = {frame}}) == 0);
    CHECK(crowd.solve({.groups = {1u}, .frames = {frame}}) == 16);
    CHECK(crowd.solve({.groups = {0u}, .frames = {frame}}) == 32000);
    CHECK_THROWS_WITH(Frame().in(SWIVEL_FLAGS, {&target, 4}), "a frame takes in no result; give it by out()");
}
