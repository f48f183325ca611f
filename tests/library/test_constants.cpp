// SPDX-License-Identifier: MIT
//
// The promise: swivel_describe_constant() tells every constant of groups, with the default that the header gives it. A
// number beyond a bound is refused by its name. docs/fields.md has the table as the library has it, and says which
// inputs of bodies and of free limbs start as NaN.
#include <catch2/catch.hpp>

#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "swivel/swivel_bodies.hpp"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"

using namespace swivel;
using namespace swivel::test;

namespace {

std::vector<swivel_constant_info> every_constant()
{
    std::vector<swivel_constant_info> all;
    for (swivel_constant_info info; swivel_describe_constant(static_cast<std::uint32_t>(all.size()), &info);)
        all.push_back(info);
    return all;
}
std::string name_of(const swivel_constant_info& info) { return std::string(info.structure) + "." + info.name; }
std::string text_of(const char* file)
{
    std::ifstream in(std::string(SWIVEL_SOURCE_DIR "/") + file);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A body with a group of each kind, and a limb that needs the constants of plants and grounds. Eight joints look.
struct EveryStructure {
    std::vector<std::int32_t> parents = {-1, 0, 1, 2, 3, 4, 5, 6, 0, 8, 9, 0, 11, 12};
    std::vector<Float3> offsets = std::vector<Float3>(parents.size(), Float3{0, 0, 1});
    swivel_skeleton skeleton = swivel_default_skeleton();
    swivel_limb_joints joints[2] = {swivel_default_limb_joints(8, 9, 10), swivel_default_limb_joints(11, 12, 13)};
    swivel_body_limb_def foot = body_limb(joints[0]), hand = body_limb(joints[1]);
    swivel_look_def look = swivel::look({0, 1, 2, 3, 4, 5, 6, 7});
    swivel_prop_def prop = swivel_default_prop_def();
    swivel_shift_def shift = swivel_default_shift_def();
    std::vector<swivel_group_def> groups = std::vector<swivel_group_def>(5, swivel_default_group_def());
    swivel_crowd_def def = swivel_default_crowd_def();

    EveryStructure()
    {
        skeleton.parents = {parents.data(), sizeof parents[0]};
        skeleton.translations = {offsets.data(), sizeof(Float3)};
        skeleton.joint_count = static_cast<std::uint32_t>(parents.size());
        for (swivel_limb_joints& limb : joints) limb.bend[1] = 1;
        foot.features =
            SWIVEL_WITH_PLANT | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_GROUND | SWIVEL_WITH_PELVIS_FIT;
        hand.features = SWIVEL_WITH_HAND | SWIVEL_WITH_LINK, hand.link = 3;
        groups[0].body_limb = &foot, groups[1].body_limb = &hand, groups[2].look = &look;
        groups[3].prop = &prop, groups[4].shift = &shift;
        def.skeleton = &skeleton, def.body_count = 1;
        def.groups = groups.data(), def.group_count = static_cast<std::uint32_t>(groups.size());
    }
    EveryStructure(const EveryStructure&) = delete;
    EveryStructure& operator=(const EveryStructure&) = delete;

    float* values(const swivel_constant_info& info)
    {
        const std::map<std::string, void*> structures = {
            {"plant", &foot.plant}, {"ground", &foot.ground}, {"shift", &shift}, {"prop", &prop}, {"look", &look}};
        return reinterpret_cast<float*>(static_cast<std::byte*>(structures.at(info.structure)) + info.offset);
    }
};

// Checks which inputs of a crowd start as NaN by a column of the page's table: 2 is that of bodies, 3 that of free
// limbs.
void check_starts(const Crowd& crowd, int column)
{
    const std::string page = text_of("docs/fields.md");
    const std::size_t table = page.find("| Field | Bodies start with | Free limbs start with |");
    REQUIRE(table != std::string::npos);
    swivel_field_info info;
    for (std::uint32_t n = 0; swivel_describe_field(n, &info); ++n)
        for (std::uint32_t group = 0; group < swivel_group_count(crowd.get()); ++group) {
            if (info.kind != SWIVEL_FIELD_INPUT || !swivel_field_row_count(crowd.get(), group, info.field)) continue;
            std::string name = info.name;
            for (char& letter : name) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
            const std::size_t row = page.find("| `" + name + "` |", table);
            std::istringstream cells(row == std::string::npos ? "" : page.substr(row, page.find('\n', row) - row));
            std::string cell;
            for (int c = 0; c <= column; ++c) std::getline(cells, cell, '|');
            const std::uint32_t first = swivel_field_first_row(crowd.get(), group, info.field);
            const bool starts_as_nan = std::isnan(swivel_input_rows(crowd.get(), group).base[first * SWIVEL_LANES]);
            INFO("group " << group << ", " << name);
            CHECK((cell.find(" NaN") == 0) == starts_as_nan);
        }
}

}  // namespace

TEST_CASE("every constant of the header is described, with its default")
{
    const auto structures =
        nlohmann::ordered_json::parse(text_of("tools/headers/headers.json")).at("swivel_bodies").at("structures");
    std::vector<std::string> wanted, got;
    for (const std::string structure : {"plant", "ground", "shift_def", "prop_def", "look_def"})
        for (const auto& [name, member] : structures.at("swivel_" + structure).at("members").items())
            if (member.at("type") == "float")  // the others are sizes and numbers of joints
                wanted.push_back(structure.substr(0, structure.find("_def")) + "." + name);
    EveryStructure given;
    const swivel_constant_info* before = nullptr;
    const std::vector<swivel_constant_info> constants = every_constant();
    for (const swivel_constant_info& info : constants) {
        INFO(name_of(info));
        got.push_back(name_of(info));
        CHECK(*info.text != 0);
        REQUIRE((info.count >= 1 && info.count <= SWIVEL_MAX_LOOK_JOINTS));
        for (std::uint32_t n = 0; n < info.count; ++n) {
            CHECK(info.defaults[n] == given.values(info)[n]);
            CHECK((info.min <= info.defaults[n] && info.defaults[n] <= info.max));
        }
        // They lie side by side, as JavaScript writes them, so each is the member that it is called.
        if (before && before->structure == std::string_view(info.structure))
            CHECK(info.offset == before->offset + before->count * sizeof(float));
        before = &info;
    }
    CHECK(got == wanted);
    CHECK(given.foot.plant.unlock_radius == 0.24f);
    CHECK(!swivel_describe_constant(0, nullptr));
    swivel_constant_info none;
    CHECK(!swivel_describe_constant(UINT32_MAX, &none));
}

TEST_CASE("a constant beyond a bound is refused by its name, and one at a bound is not")
{
    EveryStructure given;
    REQUIRE(swivel_crowd_bytes(&given.def) > 0);
    for (const swivel_constant_info& info : every_constant()) {
        std::ostringstream range;
        range << "; it is " << info.min << " to " << info.max;
        for (std::uint32_t n = 0; n < info.count; ++n) {
            float& value = given.values(info)[n];
            for (const float bad :
                 {std::nextafter(info.min, -kInf), std::nextafter(info.max, kInf), -kInf, kInf, kNan}) {
                INFO(name_of(info) << ", number " << n << ", is " << bad);
                value = bad;
                swivel_crowd* crowd = nullptr;
                CHECK_REFUSED(swivel_crowd_create(&given.def, &crowd), SWIVEL_INVALID_ARGUMENT);
                CHECK_THAT(swivel_last_error(), Catch::Contains(", " + name_of(info)));
                if (info.count != 3)  // three are a place or an axis, whose length counts
                    CHECK_THAT(swivel_last_error(), Catch::Contains(range.str()));
            }
            for (const float good : {info.min, info.max}) {  // it may not go with another constant
                INFO(name_of(info) << ", number " << n << ", is " << good);
                value = good;
                if (swivel_crowd_bytes(&given.def) == 0) CHECK_THAT(swivel_last_error(), !Catch::Contains("; it is "));
            }
            value = info.defaults[n];
        }
    }
}

TEST_CASE("a point is not released before it may lock")
{
    EveryStructure given;
    given.foot.plant.unlock_radius = 0.1f;
    swivel_crowd* crowd = nullptr;
    CHECK_REFUSED(swivel_crowd_create(&given.def, &crowd), SWIVEL_INVALID_ARGUMENT);
    CHECK_THAT(swivel_last_error(),
               Catch::Contains("group 0, plant.unlock_radius is 0.1, less than plant.lock_radius, 0.12"));
}

TEST_CASE("the page of fields has the constants as the library has them")
{
    std::ostringstream table;
    table << "| Constant | Default | Bounds | Unit | Meaning |\n|---|---|---|---|---|\n";
    for (const swivel_constant_info& info : every_constant()) {
        table << "| `" << name_of(info) << "` | ";
        const std::uint32_t shown = info.count == SWIVEL_MAX_LOOK_JOINTS ? 1 : info.count;  // of all joints the same
        for (std::uint32_t n = 0; n < shown; ++n) table << (n > 0 ? ", " : "") << info.defaults[n];
        table << " | " << info.min << " to " << info.max << " | " << info.unit << " | "
              << static_cast<char>(std::toupper(static_cast<unsigned char>(*info.text))) << info.text + 1 << ". |\n";
    }
    CHECK_THAT(text_of("docs/fields.md"), Catch::Contains(table.str()));
}

TEST_CASE("the page of fields says which inputs of bodies start as NaN")
{
    const EveryStructure given;
    check_starts(Crowd(given.def), 2);
}

TEST_CASE("the page of fields says which inputs of free limbs start as NaN")
{
    constexpr swivel_features kNeedMore = SWIVEL_JOINTS | SWIVEL_WITH_REGION;  // a binding, and a region
    for (const swivel_features first : {SWIVEL_WORLD, SWIVEL_WITH_INCOMING | SWIVEL_WITH_CAP})
        check_starts(crowd_with(all_beside(first, kNeedMore), {limbs(1)}), 3);
}
