// SPDX-License-Identifier: MIT
//
// Arms and legs are found by the names that exporters give joints. Each exporter's names appear once, as its files
// spell them. On each skeleton, the joints of every limb stand among others.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "tools/rig/joint_names.h"
#include "tools/rig/limb_joints.h"
#include "tools/rig/limbs.h"
#include "tools/rig/name_table.h"

using namespace swivel;
using formats::Clip;
using formats::Side;

namespace {

using Names = std::vector<std::string>;

// A root, and chains of joints on it.
Clip skeleton(const std::vector<Names>& chains)
{
    Clip clip;
    clip.joints.push_back({"Root", -1, {0, 0, 0}});
    for (const Names& chain : chains) {
        int parent = 0;
        for (const std::string& name : chain) {
            clip.joints.push_back({name, parent, {1, 0, 0}});
            parent = static_cast<int>(clip.joints.size()) - 1;
            clip.joints.back().number = parent;
        }
    }
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

// The last three joints of each chain are these limbs, of arms or of legs, and there are no others.
void require_pair(bool are_arms, const Names& left, const Names& right)
{
    INFO(left[0]);
    const auto last_three = [](const Names& names) { return Names(names.end() - 3, names.end()); };
    std::array<Names, 4> wanted;
    wanted[are_arms ? 0 : 2] = last_three(left);
    wanted[are_arms ? 1 : 3] = last_three(right);
    CHECK((found(skeleton({right, left})) == wanted));
}
void arms(const Names& left, const Names& right) { require_pair(true, left, right); }
void legs(const Names& left, const Names& right) { require_pair(false, left, right); }

}  // namespace

TEST_CASE("limb joints: legs by the names in use")
{
    legs({"LHipJoint", "LeftUpLeg", "LeftLeg", "LeftFoot"}, {"RHipJoint", "RightUpLeg", "RightLeg", "RightFoot"});
    legs({"mixamorig:LeftUpLeg", "mixamorig:LeftLeg", "mixamorig:LeftFoot"},
         {"mixamorig:RightUpLeg", "mixamorig:RightLeg", "mixamorig:RightFoot"});
    legs({"mixamorigLeftUpLeg", "mixamorigLeftLeg", "mixamorigLeftFoot"},
         {"mixamorigRightUpLeg", "mixamorigRightLeg", "mixamorigRightFoot"});
    legs({"thigh_l", "calf_l", "foot_l"}, {"thigh_r", "calf_r", "foot_r"});
    legs({"LeftUpperLeg", "LeftLowerLeg", "LeftFoot"}, {"RightUpperLeg", "RightLowerLeg", "RightFoot"});
    legs({"leftUpperLeg", "leftLowerLeg", "leftFoot"}, {"rightUpperLeg", "rightLowerLeg", "rightFoot"});
    legs({"J_Bip_L_UpperLeg", "J_Bip_L_LowerLeg", "J_Bip_L_Foot"},
         {"J_Bip_R_UpperLeg", "J_Bip_R_LowerLeg", "J_Bip_R_Foot"});
    legs({"thigh.L", "shin.L", "foot.L"}, {"thigh.R", "shin.R", "foot.R"});
    legs({"DEF-thigh.L", "DEF-shin.L", "DEF-foot.L"}, {"DEF-thigh.R", "DEF-shin.R", "DEF-foot.R"});
    legs({"UpperLeg.L", "LowerLeg.L", "Foot.L"}, {"UpperLeg.R", "LowerLeg.R", "Foot.R"});
    legs({"LeftHip", "LeftKnee", "LeftAnkle"}, {"RightHip", "RightKnee", "RightAnkle"});
    legs({"LeftUpLeg", "LeftLowLeg", "LeftFoot"}, {"RightUpLeg", "RightLowLeg", "RightFoot"});
    legs({"lThigh", "lShin", "lFoot"}, {"rThigh", "rShin", "rFoot"});
    legs({"Bip01 L Thigh", "Bip01 L Calf", "Bip01 L Foot"}, {"Bip01 R Thigh", "Bip01 R Calf", "Bip01 R Foot"});
    legs({"CC_Base_L_Thigh", "CC_Base_L_Calf", "CC_Base_L_Foot"},
         {"CC_Base_R_Thigh", "CC_Base_R_Calf", "CC_Base_R_Foot"});
    legs({"ValveBiped.Bip01_L_Thigh", "ValveBiped.Bip01_L_Calf", "ValveBiped.Bip01_L_Foot"},
         {"ValveBiped.Bip01_R_Thigh", "ValveBiped.Bip01_R_Calf", "ValveBiped.Bip01_R_Foot"});
    legs({"L_Hip", "L_Knee", "L_Ankle"}, {"R_Hip", "R_Knee", "R_Ankle"});
    legs({"mHipLeft", "mKneeLeft", "mAnkleLeft"}, {"mHipRight", "mKneeRight", "mAnkleRight"});
    legs({"左足", "左ひざ", "左足首"}, {"右足", "右ひざ", "右足首"});
    legs({"Left leg", "Left knee", "Left ankle"}, {"Right leg", "Right knee", "Right ankle"});
    legs({"leg_L", "knee_L", "ankle_L"}, {"leg_R", "knee_R", "ankle_R"});
    legs({"thigh_stretch.l", "leg_stretch.l", "foot.l"}, {"thigh_stretch.r", "leg_stretch.r", "foot.r"});
    legs({"leg_upper_L", "leg_lower_L", "ankle_L"}, {"leg_upper_R", "leg_lower_R", "ankle_R"});
    legs({"UpperLeg_L", "LowerLeg_L", "Ankle_L"}, {"UpperLeg_R", "LowerLeg_R", "Ankle_R"});
    legs({"leg left thigh", "leg left knee", "leg left ankle"},
         {"leg right thigh", "leg right knee", "leg right ankle"});
    legs({"lhipjoint", "lfemur", "ltibia", "lfoot"}, {"rhipjoint", "rfemur", "rtibia", "rfoot"});
    legs({"Character1_LeftUpLeg", "Character1_LeftLeg", "Character1_LeftFoot"},
         {"Character1_RightUpLeg", "Character1_RightLeg", "Character1_RightFoot"});
    legs({"足.L", "ひざ.L", "足首.L"}, {"足.R", "ひざ.R", "足首.R"});
    legs({"bip_hip_L", "bip_knee_L", "bip_foot_L"}, {"bip_hip_R", "bip_knee_R", "bip_foot_R"});
    legs({"UpLeg.L", "Leg.L", "Foot.L"}, {"UpLeg.R", "Leg.R", "Foot.R"});
    legs({"L_hip", "L_knee", "L_foot"}, {"R_hip", "R_knee", "R_foot"});
    legs({"UpLeg_L", "LoLeg_L", "Foot_L"}, {"UpLeg_R", "LoLeg_R", "Foot_R"});
}

TEST_CASE("limb joints: arms by the names in use")
{
    arms({"LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand"},
         {"RightShoulder", "RightArm", "RightForeArm", "RightHand"});
    arms({"mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:LeftHand"},
         {"mixamorig:RightArm", "mixamorig:RightForeArm", "mixamorig:RightHand"});
    arms({"clavicle_l", "upperarm_l", "lowerarm_l", "hand_l"}, {"clavicle_r", "upperarm_r", "lowerarm_r", "hand_r"});
    arms({"LeftUpperArm", "LeftLowerArm", "LeftHand"}, {"RightUpperArm", "RightLowerArm", "RightHand"});
    arms({"J_Bip_L_UpperArm", "J_Bip_L_LowerArm", "J_Bip_L_Hand"},
         {"J_Bip_R_UpperArm", "J_Bip_R_LowerArm", "J_Bip_R_Hand"});
    arms({"DEF-upper_arm.L", "DEF-forearm.L", "DEF-hand.L"}, {"DEF-upper_arm.R", "DEF-forearm.R", "DEF-hand.R"});
    arms({"LeftCollar", "LeftShoulder", "LeftElbow", "LeftWrist"},
         {"RightCollar", "RightShoulder", "RightElbow", "RightWrist"});
    arms({"lCollar", "lShldr", "lForeArm", "lHand"}, {"rCollar", "rShldr", "rForeArm", "rHand"});
    arms({"Bip01 L UpperArm", "Bip01 L Forearm", "Bip01 L Hand"},
         {"Bip01 R UpperArm", "Bip01 R Forearm", "Bip01 R Hand"});
    arms({"Left shoulder", "Left arm", "Left elbow", "Left wrist"},
         {"Right shoulder", "Right arm", "Right elbow", "Right wrist"});
    arms({"shoulder_L", "arm_L", "elbow_L", "wrist_L"}, {"shoulder_R", "arm_R", "elbow_R", "wrist_R"});
    arms({"shoulder.l", "arm_stretch.l", "forearm_stretch.l", "hand.l"},
         {"shoulder.r", "arm_stretch.r", "forearm_stretch.r", "hand.r"});
    arms({"clavicle_L", "arm_upper_L", "arm_lower_L", "hand_L"},
         {"clavicle_R", "arm_upper_R", "arm_lower_R", "hand_R"});
    arms({"Clavicle_L", "Shoulder_L", "Elbow_L", "Hand_L"}, {"Clavicle_R", "Shoulder_R", "Elbow_R", "Hand_R"});
    arms({"arm left shoulder 1", "arm left shoulder 2", "arm left elbow", "arm left wrist"},
         {"arm right shoulder 1", "arm right shoulder 2", "arm right elbow", "arm right wrist"});
    arms({"lclavicle", "lhumerus", "lradius", "lwrist"}, {"rclavicle", "rhumerus", "rradius", "rwrist"});
    arms({"Character1_LeftShoulder", "Character1_LeftArm", "Character1_LeftForeArm", "Character1_LeftHand"},
         {"Character1_RightShoulder", "Character1_RightArm", "Character1_RightForeArm", "Character1_RightHand"});
    arms({"腕.L", "ひじ.L", "手首.L"}, {"腕.R", "ひじ.R", "手首.R"});
    arms({"upperarm.l", "lowerarm.l", "wrist.l"}, {"upperarm.r", "lowerarm.r", "wrist.r"});
    arms({"bip_upperArm_L", "bip_lowerArm_L", "bip_hand_L"}, {"bip_upperArm_R", "bip_lowerArm_R", "bip_hand_R"});
    arms({"mixamorig:LeftShoulder_08", "mixamorig:LeftArm_09", "mixamorig:LeftForeArm_010", "mixamorig:LeftHand_011"},
         {"mixamorig:RightShoulder_032", "mixamorig:RightArm_00", "mixamorig:RightForeArm_034",
          "mixamorig:RightHand_035"});
    arms({"shoulder_l_012", "arm_stretch_l_013", "forearm_stretch_l_016", "hand_l_019"},
         {"shoulder_r_035", "arm_stretch_r_036", "forearm_stretch_r_038", "hand_r_041"});
    arms({"CC_Base_L_Upperarm_050", "CC_Base_L_Forearm_051", "CC_Base_L_Hand_055"},
         {"CC_Base_R_Upperarm_078", "CC_Base_R_Forearm_079", "CC_Base_R_Hand_083"});
    arms({"LeftArm_09_21", "LeftForeArm_010_22", "LeftHand_011_23"},
         {"RightArm_032_50", "RightForeArm_033_51", "RightHand_034_52"});
    arms({"L_Shoulder_JNT", "L_Elbow_JNT", "L_Wrist_JNT"}, {"R_Shoulder_JNT", "R_Elbow_JNT", "R_Wrist_JNT"});
    arms({"L_shoulder", "L_elbow", "L_hand"}, {"R_shoulder", "R_elbow", "R_hand"});
    arms({"UpArm_L", "LoArm_L", "Hand_L"}, {"UpArm_R", "LoArm_R", "Hand_R"});
    arms({"lhumerus", "lulna", "lwrist"}, {"rhumerus", "rulna", "rwrist"});
    arms({"Bob_L_shoulder", "Bob_L_elbow", "Bob_L_wrist"}, {"Bob_R_shoulder", "Bob_R_elbow", "Bob_R_wrist"});
    arms({"armFBXASC046L", "forearmFBXASC046L", "handFBXASC046L"},
         {"armFBXASC046R", "forearmFBXASC046R", "handFBXASC046R"});
    for (const std::string prefix : {"jnt_", "joint_", "QuickRigCharacter_", "Bip01 ", "Bip001 "})
        arms({prefix + "LeftArm", prefix + "LeftForeArm", prefix + "LeftHand"},
             {prefix + "RightArm", prefix + "RightForeArm", prefix + "RightHand"});
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
    CHECK(left_arm({{"LeftArm", "LeftShoulder", "LeftForeArm", "LeftHand"}}).empty());
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
    const std::vector<std::vector<Names>> figures = {
        {unreal, mixamo},
        {mixamo, mixamo},
        {mixamo, {"A:LeftArm", "A:LeftForeArm", "A:LeftHand"}},
        {{"LeftArm_1", "LeftForeArm_2", "LeftHand_3"}, {"LeftArm_4", "LeftForeArm_5", "LeftHand_6"}}};
    for (const std::vector<Names>& chains : figures) {
        const std::string said = problem(chains);
        INFO(said);
        CHECK(said.find("#1,#2,#3") != std::string::npos);
        CHECK(said.find("#4,#5,#6") != std::string::npos);
        CHECK(tools::joints_by_file(skeleton(chains))[0].advice.find("--arm left:#") != std::string::npos);
    }
    CHECK(left_arm({mixamo, {"LeftArm"}, {"LeftHand"}}) == mixamo);  // which are no chain
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
