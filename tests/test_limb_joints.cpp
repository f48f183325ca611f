// SPDX-License-Identifier: MIT
//
// Arms and legs are found by the names that exporters give joints. Each exporter's names appear once, as its files
// spell them. On each skeleton, the joints of every limb stand among others.
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "tools/rig/joint_names.h"
#include "tools/rig/limb_joints.h"

using namespace swivel;
using formats::Clip;
using formats::LimbKind;
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
        }
    }
    return clip;
}

// The names of the limb found, in order; none if there is none.
Names found(const Clip& clip, LimbKind kind, Side side)
{
    const auto joints = tools::limb_by_name(clip, {kind, side}).joints;
    Names names;
    if (joints)
        for (const int joint : *joints) names.push_back(clip.joints[static_cast<std::size_t>(joint)].name);
    return names;
}

void require_found(LimbKind kind, const Names& left, const Names& right)
{
    const Clip clip = skeleton({right, left});
    INFO(left[0]);
    const auto last_three = [](const Names& names) { return Names(names.end() - 3, names.end()); };
    CHECK(found(clip, kind, Side::left) == last_three(left));
    CHECK(found(clip, kind, Side::right) == last_three(right));
    const LimbKind other = kind == LimbKind::arm ? LimbKind::leg : LimbKind::arm;
    CHECK(found(clip, other, Side::left).empty());
    CHECK(found(clip, other, Side::right).empty());
}

}  // namespace

TEST_CASE("limb joints: legs by the names in use")
{
    const auto legs = [](const Names& left, const Names& right) { require_found(LimbKind::leg, left, right); };
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
}

TEST_CASE("limb joints: legs by rarer names, with twist bones in between")
{
    const auto legs = [](const Names& left, const Names& right) { require_found(LimbKind::leg, left, right); };
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
    const auto found_leg = [](const Names& names) { return found(skeleton({names}), LimbKind::leg, Side::left); };
    CHECK(found_leg({"lThighBend", "lThighTwist", "lShin", "lFoot"}) == Names{"lThighBend", "lShin", "lFoot"});
    CHECK(found_leg({"DEF-thigh.L", "DEF-thigh.L.001", "DEF-shin.L", "DEF-shin.L.001", "DEF-foot.L"}) ==
          Names{"DEF-thigh.L", "DEF-shin.L", "DEF-foot.L"});
    CHECK(found_leg({"upperleg01.L", "upperleg02.L", "lowerleg01.L", "lowerleg02.L", "foot.L"}) ==
          Names{"upperleg01.L", "lowerleg01.L", "foot.L"});
}

TEST_CASE("limb joints: arms by the names in use")
{
    const auto arms = [](const Names& left, const Names& right) { require_found(LimbKind::arm, left, right); };
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
}

TEST_CASE("limb joints: arms by rarer names")
{
    const auto arms = [](const Names& left, const Names& right) { require_found(LimbKind::arm, left, right); };
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
}

TEST_CASE("limb joints: names of Blender's MikuMikuDance, KayKit, Source 1 and Maya's prefixes")
{
    const auto arms = [](const Names& left, const Names& right) { require_found(LimbKind::arm, left, right); };
    const auto legs = [](const Names& left, const Names& right) { require_found(LimbKind::leg, left, right); };
    arms({"腕.L", "ひじ.L", "手首.L"}, {"腕.R", "ひじ.R", "手首.R"});
    legs({"足.L", "ひざ.L", "足首.L"}, {"足.R", "ひざ.R", "足首.R"});
    arms({"upperarm.l", "lowerarm.l", "wrist.l"}, {"upperarm.r", "lowerarm.r", "wrist.r"});
    CHECK(found(skeleton({{"upperarm.l", "lowerarm.l", "wrist.l", "hand.l"}}), LimbKind::arm, Side::left) ==
          Names{"upperarm.l", "lowerarm.l", "wrist.l"});
    arms({"bip_upperArm_L", "bip_lowerArm_L", "bip_hand_L"}, {"bip_upperArm_R", "bip_lowerArm_R", "bip_hand_R"});
    legs({"bip_hip_L", "bip_knee_L", "bip_foot_L"}, {"bip_hip_R", "bip_knee_R", "bip_foot_R"});
    legs({"UpLeg.L", "Leg.L", "Foot.L"}, {"UpLeg.R", "Leg.R", "Foot.R"});
    for (const std::string prefix : {"jnt_", "joint_", "QuickRigCharacter_", "Bip01 ", "Bip001 "})
        arms({prefix + "LeftArm", prefix + "LeftForeArm", prefix + "LeftHand"},
             {prefix + "RightArm", prefix + "RightForeArm", prefix + "RightHand"});
    // Advanced Skeleton's parts of a bone say that they are; a shoulder's number does not.
    CHECK(found(skeleton({{"Shoulder_L", "ShoulderPart1_L", "ShoulderPart2_L", "Elbow_L", "ElbowPart1_L", "Wrist_L"}}),
                LimbKind::arm, Side::left) == Names{"Shoulder_L", "Elbow_L", "Wrist_L"});
    CHECK(found(skeleton({{"Hip_L", "HipPart1_L", "Knee_L", "Ankle_L"}}), LimbKind::leg, Side::left) ==
          Names{"Hip_L", "Knee_L", "Ankle_L"});
    CHECK(found(skeleton({{"Shoulder_L", "ScapulaPart1_L", "Elbow_L", "Wrist_L"}}), LimbKind::arm, Side::left).empty());
}

TEST_CASE("limb joints: endings that converters put behind every name")
{
    const auto arms = [](const Names& left, const Names& right) { require_found(LimbKind::arm, left, right); };
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
    const auto left_arm = [](const std::vector<Names>& chains) {
        return found(skeleton(chains), LimbKind::arm, Side::left);
    };
    CHECK(left_arm({{"upperarm01.L_09", "upperarm02.L_010", "lowerarm01.L_011", "wrist.L_012"}}) ==
          Names{"upperarm01.L_09", "lowerarm01.L_011", "wrist.L_012"});
    CHECK(left_arm({{"DEF-upper_arm.L_03", "DEF-upper_arm.L.001_04", "DEF-forearm.L_05", "DEF-forearm.L.001_06",
                     "DEF-hand.L_07"}}) == Names{"DEF-upper_arm.L_03", "DEF-forearm.L_05", "DEF-hand.L_07"});
    // Two of a name but for the number: no guess. One with the whole name goes before one with a number behind it.
    CHECK(
        left_arm({{"LeftArm_1", "LeftForeArm_2", "LeftHand_3"}, {"LeftArm_4", "LeftForeArm_5", "LeftHand_6"}}).empty());
    CHECK(left_arm({{"LeftArm", "LeftForeArm", "LeftHand", "LeftHand_1"}}) ==
          Names{"LeftArm", "LeftForeArm", "LeftHand"});
    CHECK(left_arm({{"LeftArm", "LeftForeArm"}, {"LeftHand"}, {"LeftHand_1"}}).empty());
    CHECK(left_arm({{"LeftArm_1", "LeftForeArm_2", "LeftHand_3"}, {"LeftShoulder", "LeftElbow", "LeftWrist"}}).empty());
    CHECK(tools::side_of("thigh_l_055", Side::right) == Side::left);
    CHECK(tools::side_of("thigh_r_055", Side::left) == Side::right);
    CHECK(tools::side_of("_7", Side::right) == Side::right);
}

TEST_CASE("limb joints: no guess where names repeat, joints are no chain, or a joint is missing")
{
    const auto left_leg = [](const std::vector<Names>& chains) {
        return found(skeleton(chains), LimbKind::leg, Side::left);
    };
    REQUIRE_FALSE(left_leg({{"LeftUpLeg", "LeftLeg", "LeftFoot"}}).empty());
    CHECK(left_leg({{"LeftUpLeg", "LeftLeg", "LeftFoot"}, {"LeftLeg"}}).empty());
    CHECK(left_leg({{"LeftUpLeg", "LeftLeg"}, {"LeftFoot"}}).empty());
    CHECK(left_leg({{"LeftUpLeg", "LeftLeg"}}).empty());
    CHECK(left_leg({{"LeftUpLeg", "LeftLeg2", "LeftLeg", "LeftFoot"}}).empty());
    CHECK(left_leg({{"RightUpLeg", "RightLeg", "RightFoot"}}).empty());
}

TEST_CASE("limb joints: what lies between is a part of the bone by name, or the limb is none")
{
    const auto left_arm = [](const std::vector<Names>& chains) {
        return tools::limb_by_name(skeleton(chains), {LimbKind::arm, Side::left});
    };
    const auto stranger = [&](const Names& names) {
        CHECK(left_arm({names}).problem == "'" + names[1] + "' lies between '" + names[0] + "' and '" + names[2] +
                                               "' and is no twist bone by its name");
    };
    stranger({"LeftShoulder", "LeftShoulder1", "LeftElbow", "LeftWrist"});  // the first is the clavicle
    stranger({"Shoulder.L", "Shoulder.L.001", "Elbow.L", "Wrist.L"});
    stranger({"LeftArm", "LeftArm1", "LeftForeArm", "LeftHand"});
    stranger({"LeftCollar", "LeftShoulderController", "LeftElbow", "LeftWrist"});
    stranger({"LeftArm", "LeftScroll", "LeftForeArm", "LeftHand"});
    for (const std::string twist : {"upperarm_twist_01_l", "腕捩", "Disc_Twist_L"}) CHECK(tools::is_twist_name(twist));
    for (const std::string roll : {"lForearmRoll", "WristRoll", "ArmRoll1_L"}) {
        CHECK(tools::is_roll_name(roll));
        CHECK_FALSE(tools::is_twist_name(roll));
    }
    for (const std::string other : {"Controller", "scroll_l", "LeftStroller", "Hand"}) {
        CHECK_FALSE(tools::is_twist_name(other));
        CHECK_FALSE(tools::is_roll_name(other));
    }
}

TEST_CASE("limb joints: of two figures in one file none is taken")
{
    const Names mixamo = {"LeftArm", "LeftForeArm", "LeftHand"}, unreal = {"upperarm_l", "lowerarm_l", "hand_l"};
    const auto problem = [](const std::vector<Names>& chains) {
        const auto limb = tools::limb_by_name(skeleton(chains), {LimbKind::arm, Side::left});
        CHECK_FALSE(limb.joints);
        return limb.problem;
    };
    CHECK(problem({unreal, mixamo}) == "'LeftArm' and 'upperarm_l' both begin a left arm");
    CHECK(problem({mixamo, {"LArm", "LForeArm", "LHand"}}) == "'LeftArm' and 'LArm' both begin a left arm");
    CHECK(problem({{"A:LeftArm", "A:LeftForeArm", "A:LeftHand"}, {"B:LeftArm", "B:LeftForeArm", "B:LeftHand"}}) ==
          "'A:LeftArm' and 'B:LeftArm' both have the name of its shoulder");
    CHECK(problem({mixamo, mixamo}) == "2 joints are called 'LeftArm'");
    // Two figures of one habit beside a third of another.
    CHECK(problem({mixamo, mixamo, unreal}) == "'upperarm_l' and 'LeftArm' both begin a left arm");
    CHECK(problem({{"LeftArm_1", "LeftForeArm_2", "LeftHand_3"}, {"LeftShoulder", "LeftElbow", "LeftWrist"}}) ==
          "'LeftShoulder' and 'LeftArm_1' both begin a left arm");
    // Controls that no skin names are no figure, however many.
    for (const std::vector<Names>& controls : {std::vector<Names>{mixamo}, {mixamo, mixamo}}) {
        std::vector<Names> chains = {unreal};
        chains.insert(chains.end(), controls.begin(), controls.end());
        Clip clip = skeleton(chains);
        for (std::size_t n = 1 + unreal.size(); n < clip.joints.size(); ++n) clip.joints[n].is_bone = false;
        CHECK(found(clip, LimbKind::arm, Side::left) == unreal);
    }
    CHECK(problem({{"upperarm_l", "lowerarm_l"}}) == "no joint is called 'hand_l' or alike for its wrist");
    // One limb by two habits is one: the palm and the fist of one arm.
    CHECK(found(skeleton({{"UpperArm.L", "LowerArm.L", "Palm.L", "Fist.L"}}), LimbKind::arm, Side::left) ==
          Names{"UpperArm.L", "LowerArm.L", "Palm.L"});
}

TEST_CASE("limb joints: limbs below trunks of one name are two figures'")
{
    const auto apart = [](const std::vector<Names>& chains) {
        const Clip clip = skeleton(chains);
        return tools::trunks_apart(clip, static_cast<int>(chains[0].size()), static_cast<int>(clip.joints.size()) - 1);
    };
    CHECK(apart({{"Hips", "LeftArm"}, {"Hips", "RightArm"}}) == std::array{1, 3});
    CHECK(apart({{"Hips", "Spine", "LeftArm"}, {"Hips", "Chest", "RightUpLeg"}}) == std::array{1, 4});
    for (const std::string again : {"B:Hips", "mixamorig:Hips", "hips"})
        CHECK(apart({{"Hips", "LeftArm"}, {again, "RightArm"}}) == std::array{1, 3});
    // A spine may be counted; a copy of a figure has more than one joint of it.
    for (const std::string end : {"_1", "_017", ".001", ".001_42"}) {
        CHECK_FALSE(apart({{"Spine", "LeftArm"}, {"Spine" + end, "LeftUpLeg"}}));
        CHECK(apart({{"Hips", "Spine", "LeftArm"}, {"Hips" + end, "Spine" + end, "RightArm"}}) == std::array{1, 4});
    }
    CHECK_FALSE(apart({{"Bone.003", "LeftArm"}, {"Bone.007", "RightArm"}}));
    CHECK_FALSE(apart({{"Bone.003", "Bone.004", "LeftArm"}, {"Bone.007", "Bone.008", "RightArm"}}));
    CHECK_FALSE(apart({{"Spine", "LeftArm"}, {"Spine_1", "Spine_2", "LeftUpLeg"}}));
    for (const std::string prefix : {"joint", "jnt", "Bip"})  // a prefix that is all of a name
        CHECK_FALSE(apart({{prefix + "_3", "LeftArm"}, {prefix + "_7", "RightArm"}}));
    CHECK_FALSE(apart({{"LeftShoulder", "LeftArm"}, {"RightShoulder", "RightArm"}}));  // one root is above both
    CHECK_FALSE(apart({{"Spine", "LeftArm"}, {"Spine1", "LeftUpLeg"}}));
    CHECK_FALSE(apart({{"", "LeftArm"}, {"", "RightArm"}}));  // no names tell nothing
}

TEST_CASE("limb joints: the side a name speaks of")
{
    for (const std::string name : {"LeftUpLeg", "thigh_l", "thigh.L", "lThigh", "mixamorig:LeftArm", "DEF-thigh.L"})
        CHECK(tools::side_of(name, Side::right) == Side::left);
    for (const std::string name : {"RightUpLeg", "thigh_r", "thigh.R", "rThigh", "mixamorig:RightArm", "DEF-thigh.R"})
        CHECK(tools::side_of(name, Side::left) == Side::right);
    for (const std::string name : {"Bone3", "Shoulder"}) {
        CHECK(tools::side_of(name, Side::left) == Side::left);
        CHECK(tools::side_of(name, Side::right) == Side::right);
    }
}
