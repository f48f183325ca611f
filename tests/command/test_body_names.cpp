// SPDX-License-Identifier: MIT
//
// Heads, necks, toes and fingers are found by the names that rigging tools give joints, each as its files spell them.
// Names of limbs alone: tests/command/test_limb_joints.cpp.
#include <catch2/catch.hpp>

#include <map>
#include <set>
#include <sstream>

#include "tests/made_body.h"
#include "tools/retarget/joint_pairs.h"
#include "tools/rig/joint_names.h"
#include "tools/rig/limbs.h"
#include "tools/rig/name_table.h"

using namespace swivel;
using formats::Clip;
using test::add_chain;
using test::Names;

namespace {

// A tool's names of a figure, each list with commas; * is the side. The last three of an arm are its limb, as the three
// before the toe are of a leg.
struct Convention {
    std::string tool, trunk, neck, head, arm, leg, left, right;  // the trunk: from the hips to the chest
};

// As public pages and files have them: avastar.online/knowledge/the-sl-skeleton;
// wiki.facepunch.com/gmod/ValveBiped_Bones; docs.blender.org on Rigify, where the last joint of a spine is the head;
// the lists of joints of SOMA, SMPL, AMASS and Kinect (JointType); BVH files of iPi; figures of the others. AccuRig
// names joints as Character Creator does.
const std::vector<Convention> kConventions = {
    {"SOMA", "Hips, Spine1, Spine2, Chest", "Neck1, Neck2", "Head", "*Shoulder, *Arm, *ForeArm, *Hand",
     "*Leg, *Shin, *Foot, *ToeBase", "Left", "Right"},
    {"iPi", "Hip, LowerSpine, MiddleSpine, Chest", "Neck", "Head", "*Clavicle, *Shoulder, *Forearm, *Hand",
     "*Thigh, *Shin, *Foot, *Toe", "L", "R"},
    {"Character Creator", "CC_Base_Hip, CC_Base_Waist, CC_Base_Spine01, CC_Base_Spine02",
     "CC_Base_NeckTwist01, CC_Base_NeckTwist02", "CC_Base_Head",
     "CC_Base_*_Clavicle, CC_Base_*_Upperarm, CC_Base_*_Forearm, CC_Base_*_Hand",
     "CC_Base_*_Thigh, CC_Base_*_Calf, CC_Base_*_Foot, CC_Base_*_ToeBase", "L", "R"},
    {"Auto-Rig Pro", "root.x, spine_01.x, spine_02.x", "neck.x", "head.x",
     "shoulder.*, arm_stretch.*, forearm_stretch.*, hand.*", "thigh_stretch.*, leg_stretch.*, foot.*, toes_01.*", "l",
     "r"},
    {"Advanced Skeleton", "Root_M, Spine1_M, Chest_M", "Neck_M", "Head_M", "Scapula_*, Shoulder_*, Elbow_*, Wrist_*",
     "Hip_*, Knee_*, Ankle_*, Toes_*", "L", "R"},
    {"Second Life", "mPelvis, mTorso, mChest", "mNeck", "mHead", "mCollar*, mShoulder*, mElbow*, mWrist*",
     "mHip*, mKnee*, mAnkle*, mFoot*", "Left", "Right"},
    {"Valve", "ValveBiped.Bip01_Pelvis, ValveBiped.Bip01_Spine, ValveBiped.Bip01_Spine2", "ValveBiped.Bip01_Neck1",
     "ValveBiped.Bip01_Head1",
     "ValveBiped.Bip01_*_Clavicle, ValveBiped.Bip01_*_UpperArm, ValveBiped.Bip01_*_Forearm, ValveBiped.Bip01_*_Hand",
     "ValveBiped.Bip01_*_Thigh, ValveBiped.Bip01_*_Calf, ValveBiped.Bip01_*_Foot, ValveBiped.Bip01_*_Toe0", "L", "R"},
    {"Rigify", "DEF-spine, DEF-spine.001, DEF-spine.002, DEF-spine.003", "DEF-spine.004, DEF-spine.005",
     "DEF-spine.006", "DEF-shoulder.*, DEF-upper_arm.*, DEF-forearm.*, DEF-hand.*",
     "DEF-thigh.*, DEF-shin.*, DEF-foot.*, DEF-toe.*", "L", "R"},
    {"XNALara", "root hips, spine lower, spine upper", "head neck lower", "head neck upper",
     "arm * shoulder 1, arm * shoulder 2, arm * elbow, arm * wrist", "leg * thigh, leg * knee, leg * ankle, leg * toes",
     "left", "right"},
    {"SMPL", "Pelvis, Spine1, Spine2, Spine3", "Neck", "Head", "*_Collar, *_Shoulder, *_Elbow, *_Wrist",
     "*_Hip, *_Knee, *_Ankle, *_Foot", "L", "R"},
    {"AMASS", "pelvis, spine1, spine2, spine3", "neck", "head", "*_collar, *_shoulder, *_elbow, *_wrist",
     "*_hip, *_knee, *_ankle, *_foot", "left", "right"},
    {"Kinect", "SpineBase, SpineMid, SpineShoulder", "Neck", "Head", "Shoulder*, Elbow*, Wrist*",
     "Hip*, Knee*, Ankle*, Foot*", "Left", "Right"},
};

Names split(const std::string& list)
{
    Names names;
    std::istringstream in(list);
    for (std::string name; std::getline(in >> std::ws, name, ',');) names.push_back(name);
    return names;
}
Names sided(const std::string& list, const std::string& side)
{
    Names names = split(list);
    for (std::string& name : names) name = tools::with_side(name, side);
    return names;
}

Clip figure(const Convention& of)
{
    Clip clip;
    const int chest = add_chain(clip, -1, split(of.trunk));
    for (const std::string& side : {of.left, of.right}) {
        add_chain(clip, chest, sided(of.arm, side));
        add_chain(clip, 0, sided(of.leg, side));
    }
    const int head = add_chain(clip, add_chain(clip, chest, split(of.neck)), {of.head});
    add_chain(clip, head, {"jaw"});
    return clip;
}

std::vector<tools::BodyPart> body(const Clip& clip)
{
    return tools::body_of(clip, "figure", tools::choose_joints(clip, "figure", {}), {});
}

// The parts by the names of their joints.
std::map<std::string, Names> named_parts(const Clip& clip)
{
    std::map<std::string, Names> parts;
    for (const tools::BodyPart& part : body(clip))
        for (const int joint : part.joints) parts[part.name].push_back(joint_at(clip, joint).name);
    return parts;
}

std::map<std::string, Names> expected_parts(const Convention& of)
{
    const Names trunk = split(of.trunk);
    std::map<std::string, Names> parts = {{"hips", {trunk[0]}},
                                          {"spine", {trunk.begin() + 1, trunk.end()}},
                                          {"neck", split(of.neck)},
                                          {"head", {of.head}}};
    for (const auto& [word, side] : {std::pair("left", of.left), std::pair("right", of.right)}) {
        const auto add = [&parts, prefix = std::string(word)](const Names& of_side, const Names& to) {
            for (std::size_t n = 1; n <= std::min(of_side.size(), to.size()); ++n)  // from the end
                parts[prefix + to[to.size() - n]] = {of_side[of_side.size() - n]};
        };
        add(sided(of.arm, side), {"Shoulder", "UpperArm", "LowerArm", "Hand"});
        add(sided(of.leg, side), {"UpperLeg", "LowerLeg", "Foot", "Toes"});
    }
    return parts;
}

// A chest with arms, on which these chains hang.
std::string head_of(const std::vector<Names>& chains, const Names& no_bones = {})
{
    Clip clip;
    const int chest = add_chain(clip, -1, {"Hips", "Chest"});
    for (const char* const side : {"Left", "Right"}) {
        add_chain(clip, chest, sided("*Arm, *ForeArm, *Hand", side));
        add_chain(clip, 0, sided("*UpLeg, *Leg, *Foot", side));
    }
    for (const Names& chain : chains) add_chain(clip, chest, chain);
    for (formats::Joint& joint : clip.joints)
        joint.is_bone = std::find(no_bones.begin(), no_bones.end(), joint.name) == no_bones.end();
    const auto parts = named_parts(clip);
    return parts.contains("head") ? parts.at("head").front() : "";
}

Names toes_below(const std::string& ankle, const Names& below)
{
    Clip clip;
    const int end = add_chain(clip, -1, {"LeftHip", "LeftKnee", ankle});
    for (const std::string& name : below) add_chain(clip, end, {name});
    Names toes;
    for (const int joint : tools::toes_of(clip, formats::Side::left, end)) toes.push_back(joint_at(clip, joint).name);
    return toes;
}

// Each tool's words for five fingers, thumb first, and how it puts side, finger and bone together.
struct Fingers {
    std::string tool;
    std::array<std::string, 5> words;
    std::string left, right;
    std::string name;  // * the side, % the finger, # the bone

    std::string of(std::size_t finger, int bone, const std::string& side) const
    {
        std::string text = tools::with_side(name, side);
        text.replace(text.find('%'), 1, words[finger]);
        text.replace(text.find('#'), 1, std::to_string(bone));
        return text;
    }
};
const std::array<std::string, 5> kPinkies = {"thumb", "index", "middle", "ring", "pinky"};
const std::vector<Fingers> kFingers = {
    {"Unreal", kPinkies, "l", "r", "%_0#_*"},
    {"Rigify", {"thumb", "f_index", "f_middle", "f_ring", "f_pinky"}, "L", "R", "DEF-%.0#.*"},
    {"Mixamo", {"Thumb", "Index", "Middle", "Ring", "Pinky"}, "Left", "Right", "mixamorig:*Hand%#"},
    {"Character Creator", {"Thumb", "Index", "Mid", "Ring", "Pinky"}, "L", "R", "CC_Base_*_%#"},
    {"VRoid", {"Thumb", "Index", "Middle", "Ring", "Little"}, "L", "R", "J_Bip_*_%#"},
    {"SMPL-X", kPinkies, "left", "right", "*_%#"},
    {"Second Life", {"Thumb", "Index", "Middle", "Ring", "Pinky"}, "Left", "Right", "mHand%#*"},
};

// Both hands alone.
Clip hands(const Fingers& of)
{
    Clip clip;
    add_chain(clip, -1, {"Root"});
    for (const std::string& side : {of.left, of.right})
        for (std::size_t finger = 0; finger < 5; ++finger)
            add_chain(clip, 0, {of.of(finger, 1, side), of.of(finger, 2, side), of.of(finger, 3, side)});
    return clip;
}

}  // namespace

TEST_CASE("body names: every part of a figure, by each tool's names")
{
    for (const Convention& each : kConventions) {
        INFO(each.tool);
        CHECK(named_parts(figure(each)) == expected_parts(each));
    }
}

TEST_CASE("body names: m and x as a last word say the middle")
{
    for (const char* const name : {"Head_M", "head.x", "head.x_05", "Head_M_jnt", "headFBXASC046x", "rig:Head_M"})
        CHECK(tools::plain(name) == "head");
    CHECK(tools::plain("spine_01.x") == "spine01");  // the number is its own
    CHECK(tools::plain("Helm") == "helm");
    CHECK(tools::plain("x") == "x");
}

TEST_CASE("body names: a joint called head is the head before one of which that is the last word, and bones before all")
{
    CHECK(head_of({{"Neck", "Head"}}) == "Head");
    CHECK(head_of({{"Hero_Head_07"}}) == "Hero_Head_07");
    CHECK(head_of({{"Mace_Head"}, {"Head"}}) == "Head");
    CHECK(head_of({{"Neck", "spine.006", "Head"}}) == "Head");
    CHECK(head_of({{"head"}, {"DEF-spine.006"}}, {"head"}) == "DEF-spine.006");  // a control, and the bone
    CHECK(head_of({{"head"}}, {"head"}) == "head");
    CHECK(head_of({{"Neck", "Forehead"}, {"HeadTop_End"}, {"headlight"}, {"head_lamp"}}).empty());
    CHECK(head_of({{"mHead", "HEAD"}}) == "mHead");  // Second Life has a volume of that name below
}

TEST_CASE("body names: what is called foot is the toe below a joint that is not")
{
    CHECK(toes_below("LeftAnkle", {"LeftFoot"}) == Names{"LeftFoot"});
    CHECK(toes_below("LeftFoot", {"LeftFootEnd"}).empty());
    CHECK(toes_below("LeftAnkle", {"LeftFoot", "LeftToe"}) == Names{"LeftToe"});
    CHECK(toes_below("LeftAnkle", {"LeftHeel"}).empty());
}

TEST_CASE("body names: fingers pair, whoever names them")
{
    for (const Fingers& from : kFingers)
        for (const Fingers& to : kFingers) {
            INFO(from.tool << " to " << to.tool);
            const Clip source = hands(from), target = hands(to);
            std::set<std::pair<std::string, std::string>> pairs, wanted;
            for (const tools::PairedPart& each : tools::pair_joints({source, {}}, {target, {}}))
                pairs.emplace(joint_at(source, each.source.at(0)).name, joint_at(target, each.target.at(0)).name);
            wanted.emplace("Root", "Root");
            for (std::size_t finger = 0; finger < 5; ++finger)
                for (int bone = 1; bone < 4; ++bone) {
                    wanted.emplace(from.of(finger, bone, from.left), to.of(finger, bone, to.left));
                    wanted.emplace(from.of(finger, bone, from.right), to.of(finger, bone, to.right));
                }
            CHECK(pairs == wanted);
        }
}

TEST_CASE("body names: a hand's only finger stands for all, and pairs with its own name alone")
{
    Clip cmu;
    add_chain(cmu, -1, {"LeftHand", "LeftHandIndex1"});
    const Clip unreal = hands(kFingers[0]), mixamo = hands(kFingers[2]);
    CHECK(tools::pair_joints({cmu, {}}, {unreal, {}}).empty());
    CHECK(tools::pair_joints({unreal, {}}, {cmu, {}}).empty());
    CHECK(tools::pair_joints({cmu, {}}, {mixamo, {}}).size() == 1);
}

TEST_CASE("body names: no finger is what only sounds like one")
{
    CHECK(tools::finger_bone(tools::plain("LeftHandIndex1")) == "left index 1");
    for (const char* const name : {"index_01", "LeftHandIndex", "LeftIndexProximal", "Spring1_L", "LeftEarring1",
                                   "LeftToeIndex1", "LeftHandIndex12", "LeftHandRing0", "LeftHand1", "LeftThumbnail1"})
        CHECK(tools::finger_bone(tools::plain(name)).empty());
}
