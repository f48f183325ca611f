// SPDX-License-Identifier: MIT
//
// The crowd file. Every key is read. Wrong ones are refused in one line that says what and where. Special tables
// override general ones. Documentation and examples have the same keys as the reader.
#include <catch2/catch.hpp>

#include <algorithm>
#include <random>
#include <regex>
#include <set>
#include <sstream>

#include "tests/test_data.h"
#include "tools/formats/crowd_file.h"
#include "tools/formats/error.h"

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

// What InputError says, without the folder; empty if the text is read.
std::string complaint(const std::string& text)
{
    const TempFolder folder;
    spill(folder / "c.toml", text);
    try {
        read_crowd_file(folder / "c.toml");
    } catch (const InputError& error) {
        const std::string what = error.what();
        REQUIRE(what.find('\n') == std::string::npos);
        return what.substr((folder.path / "").string().size());
    }
    return {};
}

void require_refused(const std::string& text, const std::string& said)
{
    INFO(text);
    CHECK_THAT(complaint(text), Contains(said));
}

const fs::path kSource = SWIVEL_SOURCE_DIR;

}  // namespace

TEST_CASE("crowd file: values arrive where they belong")
{
    const CrowdFile file = read(slurp(kSource / "examples" / "crowd.toml"));
    CHECK(file.characters->value == 40);
    CHECK(file.characters->key == "crowd.characters");
    CHECK(file.seed->value == 7);
    CHECK(file.size->value.most == 1.1);
    CHECK(file.spacing->value == 3);
    CHECK(file.stagger->value);
    CHECK(file.limbs->value == "all");
    CHECK(file.targets->value == "clip");
    CHECK(file.budget_blocks->value == 8);

    const LimbSettings left = settings_of(file, kLeftArm), right = settings_of(file, kRightArm);
    CHECK(left.joints->value == std::vector<std::string>{"LeftArm", "LeftForeArm", "LeftHand"});
    CHECK(left.bend->value.norm() == Approx(1));
    CHECK(left.target_offset->value == Eigen::Vector3d(0, 0.5, 0));
    CHECK_FALSE(left.target_point);
    CHECK(left.hand->value);
    CHECK(left.effector->value == Eigen::Vector3d(0, -0.4, 0));
    CHECK(left.pole_kind->value == PoleKind::point);
    CHECK(left.pole_angle_deg->value == 5);
    CHECK(left.position_weight->value == 1);
    CHECK(left.hand_weight->value == 1);
    CHECK(left.pole_weight->value == 0.9);
    CHECK(left.soft_far->value == 0.05);
    CHECK(left.soft_near->value == 0.05);
    CHECK(left.least_distance->value == 0.1);
    CHECK(left.most_stretch->value == 1.1);
    CHECK(left.clavicle_share->value == 0.2);
    CHECK(left.most_swivel_deg_per_second->value == 900);
    CHECK(left.flexion_deg->value.most == 150);
    CHECK(left.humeral_twist_deg->value.least == -90);
    CHECK(left.forearm_twist_deg->value.most == 80);
    CHECK(left.shoulder_cone->value.opening_deg == 110);
    CHECK(left.shoulder_cone->value.axis.isApprox(Eigen::Vector3d(0, 0.5, 1).normalized()));
    CHECK(left.hand_cone->value.opening_deg == 90);
    CHECK(left.hand_twist->value.range_deg.least == -90);
    CHECK(left.wrist_box->value.order == EulerOrder::xyz);
    CHECK(left.wrist_box->value.about_deg[1].most == 45);
    CHECK(left.twist_bones->value == 2);
    CHECK(left.priority->value == 2);
    CHECK_FALSE(left.shoulder_box);
    CHECK(right.shoulder_box->value.order == EulerOrder::zxy);
    CHECK(settings_of(file, kRightLeg).pole_fixed->value == Eigen::Vector3d(0, -8, 20));

    const CrowdFile kick = read(slurp(kSource / "examples" / "kick.toml"));
    CHECK(settings_of(kick, kRightLeg).aim->value.flexion_deg == 20);
    CHECK(settings_of(kick, kRightLeg).target_point->value == Eigen::Vector3d(0, 12, 60));
    CHECK(settings_of(kick, kLeftArm).pole_kind->value == PoleKind::direction);
    CHECK(settings_of(kick, kLeftArm).most_swivel_deg_per_frame->value == 4);
}

TEST_CASE("crowd file: the special table goes before the general one, and says whose side it is for")
{
    const CrowdFile file = read(
        "[limb.left_arm]\npriority = 9\n[limb.all]\npriority = 1\ntwist_bones = 1\nhand = true\n"
        "[limb.arms]\npriority = 2\ntwist_bones = 2\n[limb.right]\npriority = 3\n"
        "[limb.all.limits]\nhumeral_twist_deg = [0, 10]\nforearm_twist_deg = [0, 10]\n"
        "[limb.right_arm.limits]\nforearm_twist_deg = [0, 20]\n[limb.right.pole]\nangle_deg = 4\n");
    const auto priority = [&](LimbName limb) { return settings_of(file, limb).priority->value; };
    CHECK(priority(kLeftArm) == 9);
    CHECK(priority(kRightArm) == 3);
    CHECK(priority(kLeftLeg) == 1);
    CHECK(priority(kRightLeg) == 3);
    CHECK(settings_of(file, kRightArm).twist_bones->value == 2);
    CHECK(settings_of(file, kRightLeg).twist_bones->value == 1);
    CHECK(settings_of(file, kRightArm).hand->line == 6);
    CHECK(settings_of(file, kRightArm).humeral_twist_deg->mirrored);
    CHECK_FALSE(settings_of(file, kLeftArm).humeral_twist_deg->mirrored);
    CHECK_FALSE(settings_of(file, kRightArm).forearm_twist_deg->mirrored);
    CHECK(settings_of(file, kRightArm).forearm_twist_deg->value.most == 20);
    CHECK(settings_of(file, kRightLeg).forearm_twist_deg->mirrored);
    CHECK_FALSE(settings_of(file, kRightLeg).pole_angle_deg->mirrored);
    CHECK_FALSE(settings_of(file, kLeftLeg).pole_angle_deg);

    const CrowdFile steps =
        read("[limb.all.swivel]\nmost_deg_per_frame = 3\n[limb.legs.swivel]\nmost_deg_per_second = 90\n");
    CHECK(settings_of(steps, kLeftArm).most_swivel_deg_per_frame);
    CHECK_FALSE(settings_of(steps, kLeftLeg).most_swivel_deg_per_frame);
    CHECK(settings_of(steps, kLeftLeg).most_swivel_deg_per_second->value == 90);
}

TEST_CASE("crowd file: wrong keys, with the one that was meant")
{
    require_refused("\n[crowd]\ncharacter = 3\n", "c.toml:3: crowd.character: unknown key; did you mean characters?");
    require_refused("[crowds]\n", "c.toml:1: crowds: unknown key; did you mean crowd?");
    require_refused("[limb.left_harm]\n", "c.toml:1: limb.left_harm: unknown key; did you mean left_arm?");
    require_refused("[limb.arms.limits.sholder_cone]\nopening_deg = 3\n",
                    "limb.arms.limits.sholder_cone: unknown key; did you mean shoulder_cone?");
    require_refused("[limb.arms.limits]\nshoulder_cone.opening = 3\n",
                    "limb.arms.limits.shoulder_cone.opening: unknown key; did you mean opening_deg?");
    require_refused("[limb.arms.reach]\nbounce = 0.1\n",
                    "c.toml:2: limb.arms.reach.bounce: unknown key; known are soft_far, soft_near");
    require_refused("[limb.arms]\njoints = [\"a\", \"b\", \"c\"]\n", "limb.arms.joints: unknown key");
    require_refused("[limb.arms]\n\"a\\nb\" = 3\n", "limb.arms.a\\x0ab: unknown key");
}

TEST_CASE("crowd file: wrong types")
{
    require_refused("crowd = 3\n", "c.toml:1: crowd: is a whole number; write a table, [crowd]");
    require_refused("[crowd]\ncharacters = \"3\"\n",
                    "c.toml:2: crowd.characters: is text; write a whole number from 1");
    require_refused("[crowd]\ncharacters = 6.5\n",
                    "c.toml:2: crowd.characters: must be a whole number from 1 to 10000000, not 6.5");
    require_refused("[crowd]\ncharacters = 3.0\n", "10000000, not 3.0");
    require_refused("[crowd]\nstagger = 1\n", "crowd.stagger: is a whole number; write true or false");
    require_refused("[crowd]\nsize = 1\n", "crowd.size: is a whole number; write [least, most]");
    require_refused("[crowd]\ntargets = 1979-05-27\n", "crowd.targets: is a date or time; write text");
    require_refused("[crowd]\ntargets = \"\"\n", "crowd.targets: is empty");
    require_refused("[limb.arms.reach]\nsoft_far = \"a\"\n",
                    "limb.arms.reach.soft_far: is text; write a number from 0 to 1");
    require_refused("[limb.arms]\nreach = 0.5\n", "limb.arms.reach: is a number; write a table, [limb.arms.reach]");
    require_refused("[limb.arms]\neffector = [1, 2]\n", "limb.arms.effector: has 2 values; write [x, y, z]");
    require_refused("[limb.arms]\neffector = [1, 2, true]\n", "limb.arms.effector: is true or false; write [x, y, z]");
    require_refused("[limb.left_arm]\njoints = [\"a\", \"b\"]\n",
                    "limb.left_arm.joints: has 2 values; write a list of 3");
    require_refused("[limb.left_arm]\njoints = [\"a\", \"b\", 3]\n",
                    "limb.left_arm.joints: is a whole number; write a list of 3");
    require_refused("[limb.arms.pole]\nkind = \"nomal\"\n",
                    "limb.arms.pole.kind: there is no 'nomal'; did you mean normal?");
    require_refused("[limb.arms.limits.shoulder_box]\norder = \"XYX\"\nx_deg = [0, 1]\n",
                    "shoulder_box.order: there is no 'XYX'; ");
    require_refused("[limb.arms.limits]\nshoulder_cone = 30\n",
                    "limb.arms.limits.shoulder_cone: is a whole number; write a table");
}

TEST_CASE("crowd file: impossible values")
{
    const std::string cone = "\n\n[limb.left_arm.limits.shoulder_cone]\n";
    require_refused(
        cone + "opening_deg = 190\n",
        "c.toml:4: limb.left_arm.limits.shoulder_cone.opening_deg: 190 is more than 180; write a number from 0 to 180");
    require_refused(cone + "opening_deg = -1\n", "opening_deg: -1 is less than 0");
    require_refused(cone + "opening_deg = nan\n", "opening_deg: nan is not finite");
    require_refused(cone + "opening_deg = 20\naxis = [0, 0, 0]\n",
                    "c.toml:5: limb.left_arm.limits.shoulder_cone.axis: has no length");
    require_refused(cone + "axis = [0, 0, 1]\n",
                    "c.toml:3: limb.left_arm.limits.shoulder_cone: opening_deg is missing");
    require_refused("[limb.legs.aim]\naxis = [0, 0, 1]\n", "limb.legs.aim: flexion_deg is missing");
    require_refused("[limb.legs.aim]\nflexion_deg = 3\n", "limb.legs.aim: axis is missing");
    require_refused("[limb.arms.limits.hand_twist]\n", "limb.arms.limits.hand_twist: range_deg is missing");
    require_refused("[limb.arms.limits]\nflexion_deg = [90, 30]\n",
                    "limb.arms.limits.flexion_deg: the least, 90, is more than the most, 30");
    require_refused("[limb.arms.limits]\nflexion_deg = [-10, 30]\n", "flexion_deg: -10 is less than 0");
    require_refused("[limb.arms.limits]\nhumeral_twist_deg = [-200, 200]\n",
                    "humeral_twist_deg: -200 to 200 is wider than 360");
    require_refused("[limb.arms.limits.wrist_box]\norder = \"XYZ\"\n", "wrist_box: limits nothing");
    require_refused("[limb.arms.weights]\nposition = 1.5\n", "limb.arms.weights.position: 1.5 is more than 1");
    require_refused("[limb.arms.reach]\nmost_stretch = 0.5\n", "most_stretch: 0.5 is less than 1");
    require_refused("[limb.arms]\ntwist_bones = 8\n", "limb.arms.twist_bones: 8 is more than 7");
    require_refused("[limb.arms]\neffector = [1e16, 0, 0]\n", "effector: is 1e+16 long");
    require_refused("[limb.arms]\neffector = [inf, 0, 0]\n", "effector: inf is not finite");
    require_refused("[limb.arms.swivel]\nmost_deg_per_frame = 3\nmost_deg_per_second = 3\n",
                    "c.toml:3: limb.arms.swivel.most_deg_per_second: most_deg_per_frame is given, too");
    require_refused("[crowd]\ncharacters = 0\n", "crowd.characters: 0 is less than 1");
    require_refused("[crowd]\nsize = [1.2, 0.8]\n", "crowd.size: the least, 1.2, is more than the most, 0.8");
    require_refused("[budget]\nblocks = 0\n", "budget.blocks: 0 is less than 1");
}

TEST_CASE("crowd file: no TOML")
{
    require_refused("[crowd\n", "c.toml:1: column 7: is no TOML: expected ']', saw '\\n' (table header)");
    require_refused("[crowd]\nseed = 1\nseed = 2\n",
                    "c.toml:3: column 8: is no TOML: cannot redefine existing integer");
    require_refused("", "c.toml: ");
    CHECK_THROWS_WITH(read_crowd_file("/nowhere/c.toml"), Contains("/nowhere/c.toml: ") && Contains("No such file"));
}

TEST_CASE("crowd file: too large or too deep for the parser")
{
    const auto dotted = [](int parts, const char* between) {
        std::string key = "a";
        for (int n = 1; n < parts; ++n) key.append(between).append("a");
        return key;
    };
    const std::string said = "c.toml:2: the line has more than 64 dots; no key has so many parts";
    CHECK(complaint("[crowd]\n" + dotted(200'000, ".") + " = 1\n") == said);
    CHECK(complaint("\n[" + dotted(200'000, " . ") + "]\n") == said);
    CHECK(complaint("\nx = [ { " + dotted(66, ".") + " = 1 } ]\n") == said);
    require_refused("[" + dotted(65, ".") + "]\n", "c.toml:1: a: unknown key");
    std::string nested;  // a table in a list in a table, as deep as lines let it
    for (int n = 0; n < 7'000; ++n) nested += dotted(60, ".") + " = [ {\n";
    require_refused(nested, "c.toml:");
    CHECK(complaint("# ..........................................................................\n[crowd]\n").empty());
    CHECK(complaint("#" + std::string(1'000'000, 'x')) ==
          "c.toml: has 1000001 bytes; a file of settings has at most 1000000");
}

TEST_CASE("crowd file: mutated files are read or refused in one line")
{
    std::mt19937 random(11);
    const std::string text = slurp(kSource / "examples" / "crowd.toml");
    int read_count = 0;
    for (int round = 0; round < 1000; ++round) {
        const std::string changed = mutated(text, random);
        CAPTURE(round);
        read_count += complaint(changed).empty();
    }
    CHECK(read_count > 50);
    CHECK(read_count < 950);
}

TEST_CASE("crowd file: documentation, examples and reader know the same keys")
{
    const std::string page = slurp(kSource / "docs" / "crowd_file.md");
    std::set<std::string> documented;
    const std::regex row("\\n\\| `([a-zA-Z_.]+)` \\|");
    for (std::sregex_iterator at(page.begin(), page.end(), row), end; at != end; ++at) documented.insert((*at)[1]);
    std::set<std::string> known;
    const std::vector<std::string> keys = crowd_file_keys();
    for (const std::string& key : keys) {
        const auto is_within = [&](const std::string& other) { return other.starts_with(key + "."); };
        if (std::none_of(keys.begin(), keys.end(), is_within)) known.insert(key);  // a value, no table
    }
    known.erase("limb.SELECTOR.hinge");  // of files of 0.1, refused by name
    CHECK(documented == known);

    std::set<std::string> shown;
    for (const std::string name : {"crowd.toml", "kick.toml"}) {
        std::istringstream lines(slurp(kSource / "examples" / name));
        std::string table;
        for (std::string line; std::getline(lines, line);) {
            std::smatch found;
            if (std::regex_search(line, found, std::regex("^\\[(.+)\\]"))) table = found[1];
            table = std::regex_replace(table, std::regex("^limb\\.[a-z_]+"), "limb.SELECTOR");
            if (std::regex_search(line, found, std::regex("^([a-z_]+) = "))) shown.insert(table + "." + found[1].str());
        }
    }
    CHECK(shown == known);
}
