// SPDX-License-Identifier: MIT
//
// The promise: a job names groups of a crowd of several kinds of limbs. A wrong job is refused with one line and
// changes nothing. The library describes its own fields, features and flags. That each limb of a job has the bits that
// it has alone, and that no other limb changes, is the test `interface`'s; threads are test_bits.cpp's.
#include "tests/test_arm.h"
#include "tests/test_crowd.h"

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

// And those of bodies, of which one is their shift.
constexpr swivel_features kOfBodies = SWIVEL_BODY | SWIVEL_WORLD | SWIVEL_WITH_INCOMING,
                          kOfCrowds[] = {
                              kOfBodies | SWIVEL_WITH_PLANT | SWIVEL_WITH_CAP | SWIVEL_WITH_FIT | SWIVEL_WITH_COMING,
                              kOfBodies | SWIVEL_WITH_HAND | SWIVEL_WITH_PLANT | SWIVEL_WITH_PLANT_TURN |
                                  SWIVEL_PLANT_BY_MOTION | SWIVEL_WITH_RECORD | SWIVEL_SENT | SWIVEL_WITH_GROUND |
                                  SWIVEL_WITH_EFFECTOR,
                              kOfBodies | SWIVEL_WITH_HAND | SWIVEL_WITH_LINK | SWIVEL_SENT | SWIVEL_WITH_HAND_FRAME,
                              kOfBodies | SWIVEL_FIT,
                              kOfBodies | SWIVEL_PROP,
                              kOfBodies | SWIVEL_LOOK,
};

bool is_of(const swivel_field_info& field, swivel_features features)
{
    return (features & field.needs) == field.needs && !(features & field.excludes);
}

}  // namespace

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
        constexpr std::array carried = {SWIVEL_NORMAL, SWIVEL_PLANT, SWIVEL_PLANT_TURN, SWIVEL_MOTION,
                                        SWIVEL_SHIFT,  SWIVEL_LIFT,  SWIVEL_LOOK_TURNS};
        CHECK((field.kind == SWIVEL_FIELD_CARRIED) == (std::ranges::find(carried, field.field) != carried.end()));
        CHECK((*field.range != 0) == is_input);
        // A group has the field just if it has what the field needs and lacks what it excludes.
        for (const swivel_features features : kKinds) {
            const Crowd crowd({group(1, group_of(1).binding, features)});
            CHECK((swivel_field_row_count(crowd.get(), 0, field.field) > 0) == is_of(field, features));
            CHECK((swivel_component_count(field.field, features) > 0) == is_of(field, features));
        }
        for (const swivel_features features : kOfCrowds)
            CHECK((swivel_component_count(field.field, features) > 0) == is_of(field, features));
    }
    CHECK(got == wanted);
    got.clear();
    swivel_feature_info feature;
    for (std::uint32_t n = 0; swivel_describe_feature(n, &feature); ++n) got.push_back(feature.name);
    CHECK(got == names_in(header, std::regex(R"(\n#define SWIVEL_(\w+)[ \\\n]+\(UINT64_C\()")));
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

TEST_CASE("a job chooses in one way, and lists and priorities are for the whole crowd")
{
    const swivel_group_def group = group_of(40);
    Crowd crowd = crowd_with(0, {&group, 1});
    const std::uint32_t mask[] = {~0u, ~0u}, limb = 3;
    const swivel_limbs list{&limb, 1};
    const float priority = 1;
    const swivel_in priorities{&priority, 0};
    const swivel_blocks all{0, 3};
    const auto before = all_words(crowd);
    const auto refuse = [&](const auto& edit, const std::string& line) {
        swivel_job job = swivel_default_job();
        edit(job);
        CHECK_REFUSED(swivel_solve(crowd.get(), &job), SWIVEL_INVALID_ARGUMENT);
        CHECK(std::string(swivel_last_error()).find(line) != std::string::npos);
        CHECK((all_words(crowd) == before));
    };
    const auto give_mask = [&](swivel_job& job) { job.mask = mask, job.mask_word_count = 2; };
    const auto give_list = [&](swivel_job& job) { job.limbs = &list; };
    const auto give_priorities = [&](swivel_job& job) { job.priorities = &priorities, job.most_blocks = 1; };
    refuse([&](swivel_job& job) { give_mask(job), give_list(job); }, "give one of them");
    refuse([&](swivel_job& job) { give_list(job), give_priorities(job); }, "give one of them");
    refuse([&](swivel_job& job) { give_mask(job), give_priorities(job); }, "give one of them");
    refuse([&](swivel_job& job) { give_list(job), job.blocks = &all; },
           "a job with a list of limbs is for the whole crowd");
    refuse([&](swivel_job& job) { give_list(job), job.on_this_thread = 1; }, "leave on_this_thread out");
    refuse([&](swivel_job& job) { give_priorities(job), job.blocks = &all; }, "leave blocks out");
    refuse([&](swivel_job& job) { give_priorities(job), job.on_this_thread = 1; },
           "a job with priorities is for the whole");
    refuse([&](swivel_job& job) { job.mask_word_count = 2; }, "the mask is null");
    refuse([&](swivel_job& job) { job.most_blocks = 2; }, "most_blocks goes with priorities");
    refuse([&](swivel_job& job) { give_mask(job), job.most_blocks = 2; }, "most_blocks goes with priorities");
    refuse([](swivel_job& job) { job.size = 0; }, "job has size 0");
    refuse([](swivel_job& job) { job.size += 8; }, "build with the header");
    refuse([](swivel_job& job) { job.size -= 4; }, "start from its default");  // half a member

    // One of an older header is read as far as it goes: there, to the blocks alone.
    swivel_job job = swivel_default_job();
    const swivel_blocks none{3, 0};
    job.blocks = &none;
    job.size = offsetof(swivel_job, mask);
    give_list(job);
    CHECK(swivel_solve(crowd.get(), &job) == SWIVEL_OK);
    CHECK((all_words(crowd) == before));
}

TEST_CASE("wrong choices are refused with one line and change nothing")
{
    Crowd crowd({group(20), group(5), group(40)});
    const auto before = all_words(crowd);
    const auto refuse = [&](const Job& job, const std::string& line) {
        CHECK_THROWS_WITH(crowd.solve(job), Catch::Contains(line));
        CHECK((all_words(crowd) == before));
    };
    refuse({.mask = std::vector<std::uint32_t>(2)},
           "a mask of 2 words; this crowd of 6 blocks has 3, a bit for each lane");
    // Padding lies at 20 to 31, 37 to 47 and 88 to 95; the crowd ends at 96.
    for (const std::uint32_t wrong : {20u, 31u, 37u, 47u, 88u, 95u})
        refuse({.limbs = std::vector<std::uint32_t>{3, 48, 87, wrong}},
               "entry 3 of the list: " + std::to_string(wrong) + " is no limb of this crowd, but padding");
    for (const std::uint32_t wrong : {96u, 1u << 31, ~0u})
        refuse({.limbs = std::vector<std::uint32_t>{wrong}}, " is no limb of this crowd, but past its end");
    refuse({.blocks = swivel_blocks{6, 1}}, "");
    refuse({.blocks = swivel_blocks{1, ~0u}}, "");
    CHECK(crowd.solve({.limbs = std::vector<std::uint32_t>{19, 36, 87, 19}}) ==
          3);  // nothing is left of the lists refused
}
