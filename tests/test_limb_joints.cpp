// SPDX-License-Identifier: MIT
//
// Arms and legs are found by the names that exporters give joints. Each exporter's names appear once, as its files
// spell them; test_rig_table.cpp has more. On each skeleton, the joints of every limb stand among others.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "tests/named_skeleton.h"
#include "tools/rig/joint_names.h"
#include "tools/rig/limb_joints.h"
#include "tools/rig/limbs.h"
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
Names left_leg(const std::vector<Names>& chains) { return found(skeleton(chains))[2]; }

std::string problem(const std::vector<Names>& chains)
{
    const tools::FoundJoints arm = tools::joints_by_file(skeleton(chains))[0];
    CHECK_FALSE(arm.joints);
    return arm.problem;
}

// Two chains, in which `*` stands for the side: their last three joints are these limbs, and there are no others.
void require_pair(bool are_arms, const Names& names, const std::string& left, const std::string& right)
{
    INFO(names[0] << " of " << left);
    std::vector<Names> chains;
    std::array<Names, 4> wanted;
    for (const std::string& side : {left, right}) {
        Names& chain = chains.emplace_back(names);
        for (std::string& name : chain) name.replace(name.find('*'), 1, side);
        wanted[(are_arms ? 0 : 2) + (side == right)] = Names(chain.end() - 3, chain.end());
    }
    std::swap(chains[0], chains[1]);
    CHECK((found(skeleton(chains)) == wanted));
}
void arms(const Names& names, const char* left, const char* right) { require_pair(true, names, left, right); }
void legs(const Names& names, const char* left, const char* right) { require_pair(false, names, left, right); }

}  // namespace

TEST_CASE("limb joints: legs by the names in use")
{
    legs({"*UpLeg", "*Leg", "*Foot"}, "Left", "Right");
    legs({"mixamorig:*UpLeg", "mixamorig:*Leg", "mixamorig:*Foot"}, "Left", "Right");
    legs({"mixamorig*UpLeg", "mixamorig*Leg", "mixamorig*Foot"}, "Left", "Right");
    legs({"thigh_*", "calf_*", "foot_*"}, "l", "r");
    legs({"*UpperLeg", "*LowerLeg", "*Foot"}, "Left", "Right");
    legs({"*UpperLeg", "*LowerLeg", "*Foot"}, "left", "right");
    legs({"J_Bip_*_UpperLeg", "J_Bip_*_LowerLeg", "J_Bip_*_Foot"}, "L", "R");
    legs({"thigh.*", "shin.*", "foot.*"}, "L", "R");
    legs({"DEF-thigh.*", "DEF-shin.*", "DEF-foot.*"}, "L", "R");
    legs({"UpperLeg.*", "LowerLeg.*", "Foot.*"}, "L", "R");
    legs({"*Hip", "*Knee", "*Ankle"}, "Left", "Right");
    legs({"*UpLeg", "*LowLeg", "*Foot"}, "Left", "Right");
    legs({"*Thigh", "*Shin", "*Foot"}, "l", "r");
    legs({"Bip01 * Thigh", "Bip01 * Calf", "Bip01 * Foot"}, "L", "R");
    legs({"CC_Base_*_Thigh", "CC_Base_*_Calf", "CC_Base_*_Foot"}, "L", "R");
    legs({"ValveBiped.Bip01_*_Thigh", "ValveBiped.Bip01_*_Calf", "ValveBiped.Bip01_*_Foot"}, "L", "R");
    legs({"*_Hip", "*_Knee", "*_Ankle"}, "L", "R");
    legs({"mHip*", "mKnee*", "mAnkle*"}, "Left", "Right");
    legs({"*足", "*ひざ", "*足首"}, "左", "右");
    legs({"* leg", "* knee", "* ankle"}, "Left", "Right");
    legs({"leg_*", "knee_*", "ankle_*"}, "L", "R");
    legs({"thigh_stretch.*", "leg_stretch.*", "foot.*"}, "l", "r");
    legs({"leg_upper_*", "leg_lower_*", "ankle_*"}, "L", "R");
    legs({"UpperLeg_*", "LowerLeg_*", "Ankle_*"}, "L", "R");
    legs({"leg * thigh", "leg * knee", "leg * ankle"}, "left", "right");
    legs({"*hipjoint", "*femur", "*tibia", "*foot"}, "l", "r");
    legs({"Character1_*UpLeg", "Character1_*Leg", "Character1_*Foot"}, "Left", "Right");
    legs({"足.*", "ひざ.*", "足首.*"}, "L", "R");
    legs({"bip_hip_*", "bip_knee_*", "bip_foot_*"}, "L", "R");
    legs({"UpLeg.*", "Leg.*", "Foot.*"}, "L", "R");
    legs({"*Leg", "*Shin", "*Foot"}, "Left", "Right");
}

TEST_CASE("limb joints: arms by the names in use")
{
    arms({"*Shoulder", "*Arm", "*ForeArm", "*Hand"}, "Left", "Right");
    arms({"mixamorig:*Arm", "mixamorig:*ForeArm", "mixamorig:*Hand"}, "Left", "Right");
    arms({"clavicle_*", "upperarm_*", "lowerarm_*", "hand_*"}, "l", "r");
    arms({"*UpperArm", "*LowerArm", "*Hand"}, "Left", "Right");
    arms({"J_Bip_*_UpperArm", "J_Bip_*_LowerArm", "J_Bip_*_Hand"}, "L", "R");
    arms({"DEF-upper_arm.*", "DEF-forearm.*", "DEF-hand.*"}, "L", "R");
    arms({"*Collar", "*Shoulder", "*Elbow", "*Wrist"}, "Left", "Right");
    arms({"*Collar", "*Shldr", "*ForeArm", "*Hand"}, "l", "r");
    arms({"Bip01 * UpperArm", "Bip01 * Forearm", "Bip01 * Hand"}, "L", "R");
    arms({"* shoulder", "* arm", "* elbow", "* wrist"}, "Left", "Right");
    arms({"shoulder_*", "arm_*", "elbow_*", "wrist_*"}, "L", "R");
    arms({"shoulder.*", "arm_stretch.*", "forearm_stretch.*", "hand.*"}, "l", "r");
    arms({"clavicle_*", "arm_upper_*", "arm_lower_*", "hand_*"}, "L", "R");
    arms({"Clavicle_*", "Shoulder_*", "Elbow_*", "Hand_*"}, "L", "R");
    arms({"arm * shoulder 1", "arm * shoulder 2", "arm * elbow", "arm * wrist"}, "left", "right");
    arms({"*clavicle", "*humerus", "*radius", "*wrist"}, "l", "r");
    arms({"Character1_*Shoulder", "Character1_*Arm", "Character1_*ForeArm", "Character1_*Hand"}, "Left", "Right");
    arms({"腕.*", "ひじ.*", "手首.*"}, "L", "R");
    arms({"upperarm.*", "lowerarm.*", "wrist.*"}, "l", "r");
    arms({"bip_upperArm_*", "bip_lowerArm_*", "bip_hand_*"}, "L", "R");
    arms({"mixamorig:*Shoulder_08", "mixamorig:*Arm_09", "mixamorig:*ForeArm_010", "mixamorig:*Hand_011"}, "Left",
         "Right");
    arms({"shoulder_*_012", "arm_stretch_*_013", "forearm_stretch_*_016", "hand_*_019"}, "l", "r");
    arms({"CC_Base_*_Upperarm_050", "CC_Base_*_Forearm_051", "CC_Base_*_Hand_055"}, "L", "R");
    arms({"*Arm_09_21", "*ForeArm_010_22", "*Hand_011_23"}, "Left", "Right");
    arms({"*_Shoulder_JNT", "*_Elbow_JNT", "*_Wrist_JNT"}, "L", "R");
    arms({"armFBXASC046*", "forearmFBXASC046*", "handFBXASC046*"}, "L", "R");
    arms({"*Clavicle", "*Shoulder", "*Forearm", "*Hand"}, "L", "R");
    for (const std::string prefix : {"jnt_", "joint_", "QuickRigCharacter_", "Bip01 ", "Bip001 "})
        arms({prefix + "*Arm", prefix + "*ForeArm", prefix + "*Hand"}, "Left", "Right");
}

TEST_CASE("limb joints: what lies between may have any name but that of another upper or lower joint")
{
    CHECK(left_arm({{"LeftArm", "Gadget", "LeftForeArm", "LeftHand"}}) == Names{"LeftArm", "LeftForeArm", "LeftHand"});
    CHECK(left_arm({{"Shoulder_L", "ShoulderPart1_L", "Elbow_L", "ElbowPart1_L", "Wrist_L"}}) ==
          Names{"Shoulder_L", "Elbow_L", "Wrist_L"});
    CHECK(left_leg({{"DEF-thigh.L", "DEF-thigh.L.001", "DEF-shin.L", "DEF-shin.L.001", "DEF-foot.L"}}) ==
          Names{"DEF-thigh.L", "DEF-shin.L", "DEF-foot.L"});
    CHECK(left_leg({{"lThighBend", "lThighTwist", "lShin", "lFoot"}}) == Names{"lThighBend", "lShin", "lFoot"});
    // The first may be a clavicle.
    CHECK(left_arm({{"LeftShoulder", "LeftArm", "LeftElbow", "LeftWrist"}}) ==
          Names{"LeftArm", "LeftElbow", "LeftWrist"});
    CHECK(left_arm({{"LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist"}}) ==
          Names{"LeftShoulder", "LeftElbow", "LeftWrist"});
    CHECK(left_arm({{"LeftArm", "LeftCollar", "LeftForeArm", "LeftHand"}}).empty());
}

TEST_CASE("limb joints: a name that is a thigh to some and a shin to others is what those around it make of it")
{
    const Names mixamo = {"LeftUpLeg", "LeftLeg", "LeftFoot"}, soma = {"LeftLeg", "LeftShin", "LeftFoot"};
    CHECK(left_leg({mixamo}) == mixamo);
    CHECK(left_leg({soma}) == soma);
    CHECK(left_leg({{"LeftUpLeg", "LeftLeg", "LeftShin", "LeftFoot"}}) == soma);  // a shin has no thigh below it
    const Names arm = {"LeftArm", "LeftForeArm", "LeftHand"}, ipi = {"LeftShoulder", "LeftForeArm", "LeftHand"};
    CHECK(left_arm({{"LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand"}}) == arm);
    CHECK(left_arm({{"LeftClavicle", "LeftShoulder", "LeftForeArm", "LeftHand"}}) == ipi);
}

TEST_CASE("limb joints: none where joints are no chain, or a joint is missing")
{
    REQUIRE_FALSE(left_leg({{"LeftUpLeg", "LeftLeg", "LeftFoot"}}).empty());
    CHECK(left_leg({{"LeftUpLeg", "LeftLeg"}, {"LeftFoot"}}).empty());
    CHECK(left_leg({{"LeftUpLeg", "LeftLeg"}}).empty());
    CHECK(left_leg({{"LeftUpLeg", "LeftFoot", "LeftLeg"}}).empty());
    CHECK(left_leg({{"RightUpLeg", "RightLeg", "RightFoot"}}).empty());
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
