// SPDX-License-Identifier: MIT
//
// The crowd file. Wrong keys are refused in one line that says what and where. Special tables override general ones.
// Documentation and examples have the same keys as the reader. What each key does is in test_crowd_goals.cpp and
// test_crowd_bounds.cpp.
#include <catch2/catch.hpp>

#include <regex>
#include <set>
#include <sstream>

#include "tests/test_data.h"
#include "tools/formats/crowd_file.h"

using namespace swivel::formats;
using namespace swivel::test;
using Catch::Matchers::Contains;

namespace {

constexpr LimbName kLeftArm{LimbKind::arm, Side::left}, kRightArm{LimbKind::arm, Side::right},
    kLeftLeg{LimbKind::leg, Side::left}, kRightLeg{LimbKind::leg, Side::right};

CrowdFile read(const std::string& text)
{
    const TempFolder folder;
    spill(folder / "c.toml", text);
    return read_crowd_file(folder / "c.toml");
}

std::string complaint(const std::string& text)
{
    const TempFolder folder;
    spill(folder / "c.toml", text);
    return complaint_of(folder, [&] { read_crowd_file(folder / "c.toml"); });
}

// What is refused, and in which words.
void require_refused(const std::vector<std::pair<std::string, std::string>>& cases)
{
    for (const auto& [text, said] : cases) {
        INFO(text);
        CHECK_THAT(complaint(text), Contains(said));
    }
}

// Every key of a table's own and of the tables in it, tables left out, by what the reader says of an unknown one.
std::set<std::string> known_keys(const std::string& table)
{
    const std::string unknown = "zzzzzzzzzzzzzzzz = 1\n", known = "unknown key; known are ";
    const std::string said = complaint((table.empty() ? "" : "[" + table + "]\n") + unknown);
    std::set<std::string> keys;
    if (said.find(known) == std::string::npos) return {table};  // a value
    std::istringstream words(said.substr(said.find(known) + known.size()));
    for (std::string word; words >> word;) {
        if (word.ends_with(',')) word.pop_back();
        keys.merge(known_keys(table.empty() ? word : table + "." + word));
    }
    return keys;
}

const fs::path kSource = SWIVEL_SOURCE_DIR;

}  // namespace

TEST_CASE("crowd file: the special table goes before the general one, and says whose side it is for")
{
    const CrowdFile file = read(
        "[limb.left_arm]\nweights.hand = 0.9\n[limb.all]\nweights.hand = 0.1\ntwist_bones = 1\nhand = true\n"
        "[limb.arms]\nweights.hand = 0.2\ntwist_bones = 2\n[limb.right]\nweights.hand = 0.3\n"
        "[limb.all.limits]\nhumeral_twist_deg = [0, 10]\nforearm_twist_deg = [0, 10]\n"
        "[limb.right_arm.limits]\nforearm_twist_deg = [0, 20]\n[limb.right.pole]\nangle_deg = 4\n");
    const auto weight = [&](LimbName limb) { return settings_of(file, limb).weights[1]->value; };
    CHECK(weight(kLeftArm) == 0.9);
    CHECK(weight(kRightArm) == 0.3);
    CHECK(weight(kLeftLeg) == 0.1);
    CHECK(weight(kRightLeg) == 0.3);
    CHECK(settings_of(file, kRightArm).twist_bones->value == 2);
    CHECK(settings_of(file, kRightLeg).twist_bones->value == 1);
    CHECK(settings_of(file, kRightArm).hand->line == 6);
    const auto limit = [&](LimbName limb, std::string_view key) {
        return *settings_of(file, limb)
                    .limits[static_cast<std::size_t>(std::ranges::find(kLimitKeys, key) - kLimitKeys.begin())];
    };
    CHECK(limit(kRightArm, "humeral_twist_deg").mirrored);
    CHECK_FALSE(limit(kLeftArm, "humeral_twist_deg").mirrored);
    CHECK_FALSE(limit(kRightArm, "forearm_twist_deg").mirrored);
    CHECK(std::get<NumberRange>(limit(kRightArm, "forearm_twist_deg").value).most == 20);
    CHECK(limit(kRightLeg, "forearm_twist_deg").mirrored);
    CHECK_FALSE(settings_of(file, kRightLeg).pole_angle_deg->mirrored);
    CHECK_FALSE(settings_of(file, kLeftLeg).pole_angle_deg);

    const CrowdFile steps =
        read("[limb.all.swivel]\nmost_deg_per_frame = 3\n[limb.legs.swivel]\nmost_deg_per_second = 90\n");
    CHECK(settings_of(steps, kLeftArm).step_deg_per_frame);
    CHECK_FALSE(settings_of(steps, kLeftLeg).step_deg_per_frame);
    CHECK(settings_of(steps, kLeftLeg).step_deg_per_second->value == 90);
}

TEST_CASE("crowd file: wrong keys, types and values, with what to write")
{
    require_refused({
        {"\n[crowd]\ncharacter = 3\n", "c.toml:3: crowd.character: unknown key; did you mean characters?"},
        {"[limb.arms.limits]\nshoulder_cone.opening = 3\n",
         "limb.arms.limits.shoulder_cone.opening: unknown key; did you mean opening_deg?"},
        {"[limb.arms.reach]\nbounce = 0.1\n",
         "c.toml:2: limb.arms.reach.bounce: unknown key; known are soft_far, soft_near"},
        {"[limb.arms]\njoints = [\"a\", \"b\", \"c\"]\n", "limb.arms.joints: is of one limb"},
        {"[limb.arms]\n\"a\\nb\" = 3\n", "limb.arms.a\\x0ab: unknown key"},
        {"crowd = 3\n", "c.toml:1: crowd: is a whole number; write a table, [crowd]"},
        {"[crowd]\ncharacters = \"3\"\n", "c.toml:2: crowd.characters: is text; write a whole number from 1"},
        {"[crowd]\ncharacters = 6.5\n",
         "c.toml:2: crowd.characters: is a number; write a whole number from 1 to 10000000"},
        {"[crowd]\nsize = 1\n", "crowd.size: is a whole number; write [least, most]"},
        {"[crowd]\ntargets = \"\"\n", "crowd.targets: is empty"},
        {"[limb.arms]\neffector = [1, 2]\n", "limb.arms.effector: has 2 values; write [x, y, z]"},
        {"[limb.arms]\neffector = [1, 2, true]\n", "limb.arms.effector: is true or false; write [x, y, z]"},
        {"[limb.left_arm]\njoints = [\"a\", \"b\", 3]\n", "limb.left_arm.joints: is a whole number; write a list of 3"},
        {"[limb.arms.pole]\nkind = \"nomal\"\n", "limb.arms.pole.kind: there is no 'nomal'; did you mean normal?"},
        {"\n\n[limb.left_arm.limits.shoulder_cone]\nopening_deg = 190\n",
         "c.toml:4: limb.left_arm.limits.shoulder_cone.opening_deg: 190 is more than 180; write a number from 0 to "
         "180"},
        {"\n\n[limb.left_arm.limits.shoulder_cone]\nopening_deg = 20\naxis = [0, 0, 0]\n",
         "c.toml:5: limb.left_arm.limits.shoulder_cone.axis: has no length"},
        {"\n\n[limb.left_arm.limits.shoulder_cone]\naxis = [0, 0, 1]\n",
         "c.toml:3: limb.left_arm.limits.shoulder_cone: opening_deg is missing"},
        {"[limb.legs.aim]\naxis = [0, 0, 1]\n", "limb.legs.aim: flexion_deg is missing"},
        {"[limb.arms.limits]\nflexion_deg = [90, 30]\n",
         "limb.arms.limits.flexion_deg: the least, 90, is more than the most, 30"},
        {"[limb.arms.limits]\nhumeral_twist_deg = [-200, 200]\n", "humeral_twist_deg: -200 to 200 is wider than 360"},
        {"[limb.arms.limits.wrist_box]\norder = \"XYZ\"\n", "wrist_box: limits nothing"},
        {"[limb.arms.limits.region]\nforbidden = [{opening_deg = 3}]\n", "region: allows nothing; give cones"},
        {"[limb.arms.limits.region]\ncones = [{opening_deg = 3}, {opening_deg = 180}]\n",
         "limb.arms.limits.region.cones[1].opening_deg: 180 is more than 179.4"},
        {"[limb.arms.limits.region]\ncones = [{opening_deg = 3}]\nforbidden = [{opening_deg = 0}]\n",
         "limb.arms.limits.region.forbidden[0].opening_deg: 0 is less than 0.6"},
        {"[limb.arms.limits.region]\ncones = {}\n", "region.cones: is a table; write a list of tables, [{...}, {...}]"},
        {"[limb.arms.limits.region]\ncones = [3]\n", "region.cones: is a whole number; write a list of tables"},
        {"[limb.arms.limits.region]\ncones = [{opening_deg = 3}, {axis = [0, 0, 1]}]\n",
         "c.toml:2: limb.arms.limits.region.cones[1]: opening_deg is missing"},
        {"[limb.arms.limits.region]\npolygons = [{corners = [[1, 0, 0], 3]}]\n",
         "region.polygons[0].corners: is a whole number; write a list of [x, y, z], three numbers each"},
        {"[limb.arms.limits.region]\npolygons = [{corner = []}]\n",
         "region.polygons[0].corner: unknown key; did you mean corners?"},
        {"[limb.arms.limits.region]\nclip_cones = 3\n", "region.clip_cones: means nothing without clip_margin_deg"},
        {"[limb.arms.limits.region]\ncones = [{opening_deg = 3}]\nclosed = true\n",
         "region.closed: means nothing with fewer than three cones"},
        {"[limb.arms]\neffector = [1e16, 0, 0]\n", "effector: is 1e+16 long"},
        {"[limb.arms]\neffector = [inf, 0, 0]\n", "effector: inf is not finite"},
        {"[limb.arms.swivel]\nmost_deg_per_frame = 3\nmost_deg_per_second = 3\n",
         "c.toml:3: limb.arms.swivel.most_deg_per_second: most_deg_per_frame is given, too"},
    });
}

TEST_CASE("crowd file: no TOML, and too large or too deep for the parser")
{
    require_refused({
        {"[crowd\n", "c.toml:1: column 7: is no TOML: Error while parsing table header: expected ']', saw '\\n'"},
        {"[crowd]\nseed = 1\nseed = 2\n", "c.toml:3: column 8: is no TOML: "},
        {"", "c.toml: is empty"},
    });
    CHECK_THROWS_WITH(read_crowd_file("/nowhere/c.toml"), Contains("/nowhere/c.toml: ") && Contains("No such file"));
    const auto dotted = [](int parts, const char* between) {
        std::string key = "a";
        for (int n = 1; n < parts; ++n) key.append(between).append("a");
        return key;
    };
    const std::string said = "c.toml:2: the line has more than 64 dots; no key has so many parts";
    std::string nested;  // a table in a list in a table, as deep as lines let it
    for (int n = 0; n < 7'000; ++n) nested += dotted(60, ".") + " = [ {\n";
    require_refused({{"[crowd]\n" + dotted(200'000, ".") + " = 1\n", said},
                     {"\n[" + dotted(200'000, " . ") + "]\n", said},
                     {"[" + dotted(65, ".") + "]\n", "c.toml:1: a: unknown key"},
                     {nested, "c.toml:"},
                     {"#" + std::string(1'000'000, 'x'), "has 1000001 bytes; a file of settings has at most 1000000"}});
    CHECK(complaint("# ..........................................................................\n[crowd]\n").empty());
}

TEST_CASE("crowd file: documentation, examples and reader know the same keys")
{
    const std::string page = slurp(kSource / "docs" / "crowd_file.md");
    std::set<std::string> documented;
    const std::regex row("\\n\\| `([a-zA-Z_.]+)` \\|");
    for (std::sregex_iterator at(page.begin(), page.end(), row), end; at != end; ++at) documented.insert((*at)[1]);
    std::set<std::string> known;
    for (std::string key : known_keys("")) {
        if (key.starts_with("limb.")) key.replace(5, key.find('.', 5) - 5, "SELECTOR");
        known.insert(key);
    }
    CHECK(documented == known);

    std::set<std::string> shown;
    for (const std::string name : {"crowd.toml", "kick.toml", "hills.toml"}) {
        std::istringstream lines(slurp(kSource / "examples" / name));
        std::string table;
        for (std::string line; std::getline(lines, line);) {
            std::smatch found;
            if (std::regex_search(line, found, std::regex("^\\[(.+)\\]"))) table = found[1];
            table = std::regex_replace(table, std::regex("^limb\\.[a-z_]+"), "limb.SELECTOR");
            if (std::regex_search(line, found, std::regex("^(?:# )?([a-z_]+) = ")))
                shown.insert(table + "." + found[1].str());
        }
    }
    CHECK(shown == known);
}
