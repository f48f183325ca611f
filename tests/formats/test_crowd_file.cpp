// SPDX-License-Identifier: MIT
//
// The crowd file. Special tables override general ones. Documentation and examples have the same keys as the reader.
// What each key does is in test_crowd_goals.cpp and test_crowd_bounds.cpp, and what is said of wrong ones in
// tests/transcripts/crowd_keys.txt.
#include <catch2/catch.hpp>

#include <regex>
#include <set>
#include <sstream>

#include "tests/test_data.h"
#include "tools/formats/crowd_file.h"

using namespace swivel::formats;
using namespace swivel::test;

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
    CHECK(std::get<NumberRange>(limit(kRightArm, "forearm_twist_deg").value).max == 20);
    CHECK(limit(kRightLeg, "forearm_twist_deg").mirrored);
    CHECK_FALSE(settings_of(file, kRightLeg).pole_angle_deg->mirrored);
    CHECK_FALSE(settings_of(file, kLeftLeg).pole_angle_deg);

    const CrowdFile steps =
        read("[limb.all.swivel]\nmax_deg_per_frame = 3\n[limb.legs.swivel]\nmax_deg_per_second = 90\n");
    CHECK(settings_of(steps, kLeftArm).step_deg_per_frame);
    CHECK_FALSE(settings_of(steps, kLeftLeg).step_deg_per_frame);
    CHECK(settings_of(steps, kLeftLeg).step_deg_per_second->value == 90);
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
