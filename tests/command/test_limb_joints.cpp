// SPDX-License-Identifier: MIT
//
// Arms and legs are found by the names that exporters give joints: those of the table in docs/rigs.md, with what
// exporters add to them. test_body_names.cpp has whole figures.
#include <catch2/catch.hpp>

#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/made_body.h"
#include "tests/test_data.h"
#include "tools/rig/joint_names.h"
#include "tools/rig/limbs.h"
#include "tools/rig/name_search.h"
#include "tools/rig/name_table.h"

using namespace swivel;
using formats::Clip;
using formats::Side;
using test::Names;

namespace {

// A root, and chains of joints on it.
Clip skeleton(const std::vector<Names>& chains)
{
    Clip clip;
    test::add_chain(clip, -1, {"Root"});
    for (const Names& chain : chains) test::add_chain(clip, 0, chain);
    return clip;
}

// The names of the four limbs that are found, in order; none of a limb that is not.
std::array<Names, 4> found(const Clip& clip)
{
    std::array<Names, 4> limbs;
    const auto joints = tools::joints_by_file(clip);
    for (std::size_t n = 0; n < 4; ++n)
        if (joints[n].joints)
            for (const int joint : *joints[n].joints) limbs[n].push_back(joint_at(clip, joint).name);
    return limbs;
}

Names left_arm(const std::vector<Names>& chains) { return found(skeleton(chains))[0]; }

std::string problem(const std::vector<Names>& chains)
{
    const tools::FoundJoints arm = tools::joints_by_file(skeleton(chains))[0];
    CHECK_FALSE(arm.joints);
    return arm.problem;
}

// Both limbs of a name for each joint, in which `*` stands for the side, are found, right before left: their last three
// joints.
void require_pair(bool are_arms, const Names& names, const std::string& left, const std::string& right)
{
    std::vector<Names> chains;
    std::array<Names, 4> wanted;
    for (const std::string& side : {right, left}) {
        Names& chain = chains.emplace_back(names);
        for (std::string& name : chain) name = tools::with_side(name, side);
        wanted[(are_arms ? 0 : 2) + (side == right)] = Names(chain.end() - 3, chain.end());
    }
    INFO(names[0] << " of " << left);
    CHECK((found(skeleton(chains)) == wanted));
}

// The limbs that a cell of the page's table names: three joints in one piece of code, or one in each of three. A piece
// without a side is another word for the last joint.
std::vector<Names> limbs_in_cell(const std::string& cell)
{
    static const std::regex code("`([^`]*)`"), ending("[A-Za-z0-9]+(?=.\\*$)");
    std::vector<Names> limbs;
    Names alone;
    for (std::sregex_iterator at(cell.begin(), cell.end(), code), end; at != end; ++at) {
        const std::string piece = (*at)[1];
        if (const auto sides = std::ranges::count(piece, '*'); sides == 3) {
            std::istringstream words(piece);
            limbs.emplace_back(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>());
        } else if (sides == 1) {
            alone.push_back(piece);
        } else {
            limbs.push_back(limbs[0]);
            limbs.back().back() = std::regex_replace(limbs[0].back(), ending, piece);
        }
    }
    if (!alone.empty()) limbs.push_back(alone);
    return limbs;
}

}  // namespace

TEST_CASE("limb joints: every row of the page's table is found, with every word for a side")
{
    std::istringstream page(test::slurp(std::string(SWIVEL_SOURCE_DIR) + "/docs/rigs.md"));
    std::string line, arm, leg;
    while (line != "| arm | leg | from |") REQUIRE(std::getline(page, line));
    std::getline(page, line);
    int limb_count = 0;
    while (std::getline(page, line) && line.starts_with('|')) {
        std::istringstream cells(line.substr(1));
        std::getline(std::getline(cells, arm, '|'), leg, '|');
        for (const bool are_arms : {true, false})
            for (const Names& names : limbs_in_cell(are_arms ? arm : leg)) {
                for (const auto& [left, right] : {std::pair("left", "right"), {"L", "R"}})
                    require_pair(are_arms, names, left, right);
                if (names[0].find(' ') == std::string::npos) require_pair(are_arms, names, "左", "右");
                ++limb_count;
            }
    }
    CHECK(limb_count > 50);
}

TEST_CASE("limb joints: what exporters add to every name does not count")
{
    const Names known = {"",       "mixamorig:", "mixamorig",          "DEF-",   "Character1_", "jnt_",
                         "joint_", "rig|Tool:",  "QuickRigCharacter_", "Bip01 ", "Bip001 ",     "bip_"};
    const Names any = {"J_Bip_", "CC_Base_", "Hero_"};  // before a side that is a word of its own
    for (const std::string after : {"", "_08", "_012", "_09_21", "_jnt", "_JNT", "_joint"}) {
        const auto arm = [&](const std::string& before) {
            return Names{before + "UpperArm" + after, before + "LowerArm" + after, before + "Hand" + after};
        };
        for (const std::string& before : known) require_pair(true, arm(before + "*"), "Left", "Right");
        for (const Names& all : {known, any})
            for (const std::string& before : all) require_pair(true, arm(before + "*_"), "L", "R");
    }
    require_pair(true, {"armFBXASC046*", "forearmFBXASC046*", "handFBXASC046*"}, "L", "R");
    require_pair(true, {"shoulder_*_012", "arm_stretch_*_013", "forearm_stretch_*_016", "hand_*_019"}, "l", "r");
    require_pair(false, {"*hipjoint", "*femur", "*tibia", "*foot"}, "l", "r");
    require_pair(false, {"ValveBiped.Bip01_*_Thigh", "ValveBiped.Bip01_*_Calf", "ValveBiped.Bip01_*_Foot"}, "L", "R");
}

TEST_CASE("limb joints: which joints of a chain are the limb")
{
    struct Row {
        const char* why;
        std::vector<Names> chains;
        Names wanted = {};  // of the left limb; empty: none is found
    };
    const Names mixamo = {"LeftUpLeg", "LeftLeg", "LeftFoot"}, soma = {"LeftLeg", "LeftShin", "LeftFoot"},
                arm = {"LeftArm", "LeftForeArm", "LeftHand"}, elbow = {"LeftArm", "LeftElbow", "LeftWrist"},
                ipi = {"LeftShoulder", "LeftForeArm", "LeftHand"}, rigify = {"DEF-thigh.L", "DEF-shin.L", "DEF-foot.L"};
    const std::vector<Row> rows = {
        {"any name may lie between", {{"LeftArm", "Gadget", "LeftForeArm", "LeftHand"}}, arm},
        {"bones in parts", {{"DEF-thigh.L", "DEF-thigh.L.001", "DEF-shin.L", "DEF-shin.L.001", "DEF-foot.L"}}, rigify},
        {"twist bones", {{"lThighBend", "lThighTwist", "lShin", "lFoot"}}, {"lThighBend", "lShin", "lFoot"}},
        {"a clavicle", {{"LeftShoulder", "LeftArm", "LeftElbow", "LeftWrist"}}, elbow},
        {"an upper joint of another row lies between", {{"LeftArm", "LeftCollar", "LeftForeArm", "LeftHand"}}},
        {"a leg is a shin", {mixamo}, mixamo},
        {"a leg is a thigh", {soma}, soma},
        {"a shin has no thigh below it", {{"LeftUpLeg", "LeftLeg", "LeftShin", "LeftFoot"}}, soma},
        {"a shoulder is a clavicle", {{"LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand"}}, arm},
        {"a shoulder is an upper arm", {{"LeftClavicle", "LeftShoulder", "LeftForeArm", "LeftHand"}}, ipi},
        {"no chain", {{"LeftUpLeg", "LeftLeg"}, {"LeftFoot"}}},
        {"no foot", {{"LeftUpLeg", "LeftLeg"}}},
        {"another order", {{"LeftUpLeg", "LeftFoot", "LeftLeg"}}},
        {"the other side", {{"RightUpLeg", "RightLeg", "RightFoot"}}},
    };
    for (const Row& row : rows) {
        INFO(row.why);
        const auto limbs = found(skeleton(row.chains));
        CHECK((limbs[0].empty() ? limbs[2] : limbs[0]) == row.wanted);
    }
    CHECK(problem({{"LeftArm", "LeftForeArm"}}) == "no joint is called 'lefthand' or alike for its wrist");
    CHECK(problem({{"LeftHand"}}).empty());  // one name alone says nothing
}

TEST_CASE("limb joints: several limbs are candidates, and none is taken")
{
    const Names mixamo = {"LeftArm", "LeftForeArm", "LeftHand"}, unreal = {"upperarm_l", "lowerarm_l", "hand_l"};
    CHECK(left_arm({mixamo, {"LeftArm_1", "LeftForeArm_2", "LeftHand_3"}}).empty());  // see test_rig_table.cpp
    CHECK(left_arm({mixamo, {"LeftArm"}, {"LeftHand"}}) == mixamo);                   // which are no chain
    // One limb by two rows is one: the palm and the fist of one arm.
    CHECK(left_arm({{"UpperArm.L", "LowerArm.L", "Palm.L", "Fist.L"}}) == Names{"UpperArm.L", "LowerArm.L", "Palm.L"});
    // Controls that no skin names are no figure, however many.
    Clip clip = skeleton({unreal, mixamo, mixamo});
    for (std::size_t n = 1 + unreal.size(); n < clip.joints.size(); ++n) clip.joints[n].is_bone = false;
    CHECK(found(clip)[0] == unreal);
}

TEST_CASE("limb joints: time in proportion to the joints, whatever their names")
{
    Names names(200'000, "LeftForeArm");  // in square time this takes longer than CTest waits for this suite
    names.insert(names.end(), {"LeftArm", "LeftForeArm", "LeftHand"});
    CHECK(left_arm({names}) == Names{"LeftArm", "LeftForeArm", "LeftHand"});
}

TEST_CASE("limb joints: a file that says which joints are a limb's is believed")
{
    const Names names = {"LeftArm", "LeftForeArm", "LeftHand"};
    Clip clip = skeleton({{"a", "b", "c"}, names});
    clip.human_bones = {{"leftUpperArm", 1}, {"leftLowerArm", 2}, {"leftHand", 3}};
    CHECK(found(clip)[0] == Names{"a", "b", "c"});
    clip.human_bones.erase("leftHand");
    CHECK(tools::joints_by_file(clip)[0].problem.find("leftHand") != std::string::npos);
    clip.human_bones["leftHand"] = 6;
    CHECK(found(clip)[0].empty());  // no chain
    clip.human_bones = {{"rightUpperArm", 1}};
    CHECK(found(clip)[0] == names);
}

TEST_CASE("limb joints: of two limbs with one joint that the file names none is taken")
{
    Clip clip = skeleton({{"LeftArm", "LeftForeArm", "LeftHand"}});
    tools::LimbChoice all;
    all.kinds = "all";
    const auto chosen = [&] { return tools::choose_joints(clip, "rig.glb", all); };
    CHECK(chosen()[0].joints.joints);
    clip.human_bones = {{"rightUpperArm", 1}, {"rightLowerArm", 2}, {"rightHand", 3}};  // VRM's word against the names
    const tools::FigureJoints figure = chosen();
    CHECK_FALSE(figure[0].joints.joints);
    CHECK_FALSE(figure[1].joints.joints);
    CHECK(figure[0].joints.problem == "'LeftArm' is found for the right arm, too");
    CHECK(figure[1].joints.problem == "'LeftArm' is found for the left arm, too");
}

TEST_CASE("limb joints: a name of many escapes is read in one go")
{
    std::string name = "left", plain = "left";
    for (int n = 0; n < 100'000; ++n) name += "FBXASC046FBXASC999FBXASC", plain += "fbxasc999fbxasc";
    CHECK(tools::plain(name) == plain);
    CHECK(tools::plain("LeftFBXASC046ArmFBXASC04") == "leftarmfbxasc04");
}

TEST_CASE("limb joints: the side a name speaks of")
{
    for (const std::string name : {"LeftUpLeg", "thigh_l", "thigh.L", "lThigh", "mixamorig:LeftArm", "DEF-thigh.L",
                                   "thigh_l_055", "LeftCollar", "lFemur", "LeftFoo", "Foo_l"})
        CHECK(tools::side_of(name, Side::right) == Side::left);
    for (const std::string name : {"RightUpLeg", "thigh_r", "thigh.R", "rThigh", "mixamorig:RightArm", "DEF-thigh.R",
                                   "thigh_r_055", "leg.R", "RightFoo", "R Foo"})
        CHECK(tools::side_of(name, Side::left) == Side::right);
    for (const std::string name : {"Bone3", "Shoulder", "_7"}) {
        CHECK(tools::side_of(name, Side::left) == Side::left);
        CHECK(tools::side_of(name, Side::right) == Side::right);
    }
}
