// SPDX-License-Identifier: MIT
//
// Which way a figure faces: all that tells it agrees, or straight limbs, which bend by it alone, are refused.
#include "tests/rig_body.h"

using namespace swivel::test;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

TEST_CASE("rigs: what hangs on a foot and points elsewhere is no toe")
{
    // Straight legs that face +z, these joints below each foot.
    const auto faces = [](const std::vector<std::pair<std::string, Vector3d>>& below, bool mirrored = false) {
        GltfRig rig;
        const int hips = rig.add("Hips", -1, {0, 1, 0});
        for (const std::string side : {"Left", "Right"}) {
            const double x = (side == "Left") == mirrored ? -0.1 : 0.1;
            int at = rig.add(side + "UpLeg", hips, {x, 0, 0});
            at = rig.add(side + "Foot", rig.add(side + "Leg", at, {0, -0.5, 0}), {0, -0.5, 0});
            for (const auto& [name, step] : below) rig.add(side + name, at, {10 * x * step.x(), step.y(), step.z()});
        }
        const json report = rig_report(rig);
        return std::pair(vector_of(report.at("faces")), report.at("faces_by").get<std::string>());
    };
    const std::string by_hips = "left and right hip", by_toes = "the toes";
    const auto is = [](const std::pair<Vector3d, std::string>& said, const Vector3d& way, const std::string& by) {
        CHECK(degrees_between(said.first, way) < 1e-3);
        CHECK(said.second == by);
    };
    const Vector3d front = Vector3d::UnitZ();
    is(faces({{"Heel", {0, -0.02, -0.05}}}), front, by_hips);
    is(faces({{"Socket", {0.05, 0, -0.01}}}), front, by_hips);
    is(faces({{"Bone", {0.02, -0.02, 0.1}}}), front, by_toes);  // turned out, both alike
    is(faces({{"ToeBack", {0, 0, -0.16}}, {"ToeInner", {0, 0, 0.1}}}), front, by_hips);
    is(faces({{"ToeBack", {0, 0, -0.1}}, {"ToeInner", {0.01, 0, 0.1}}}), front, by_hips);
    is(faces({{"ToeBack", {0, 0, -0.16}}, {"ToeInner", {0, 0, 0.1}}, {"ToeOuter", {0.02, 0, 0.1}}}), front, by_toes);
    // A mirror that was baked into the joints: the toes know.
    is(faces({{"Toe", {0, 0, 0.1}}}, true), front, by_toes);
    is(faces({{"Bone", {0, 0, 0.1}}}, true), -front, by_hips);
}

TEST_CASE("rig front: a figure may face and stand anyhow")
{
    for (const double degrees : {0.0, 37.0, 90.0, 180.0})
        for (const Vector3d& axis : {kX, kY, kZ, Vector3d(1, 2, 3).normalized()}) {
            CHECK(doubt_of({.turn = turned(degrees, axis)}).empty());
            CHECK(doubt_of({.on_foot = {{"Toe", {0, -0.05, 0.1}}}, .turn = turned(degrees, axis)}).empty());
            CHECK(doubt_of({.limbs = kLegs, .turn = turned(degrees, axis)}).empty());
        }
    CHECK(doubt_of({.left_bone = {0.1, -0.3, 0}}).empty());
}

TEST_CASE("rig front: shoulders, hips and toes that face apart are in doubt")
{
    const std::string apart = "shoulders and hips face apart";
    CHECK(doubt_of({.chest_turn = turned(55, kY)}, turned(55, kY) * kZ).empty());
    for (const double twist : {65.0, 100.0, -65.0}) CHECK(doubt_of({.chest_turn = turned(twist, kY)}) == apart);
    CHECK(doubt_of({.shoulders = -0.2}) == apart);  // crossed
    CHECK(doubt_of({.hips = -0.1}) == apart);

    const std::string toes = "the toes point otherwise than shoulders and hips face";
    const auto toe = [](const Vector3d& step) { return Body{.on_foot = {{"ToeBase", step}}}; };
    CHECK(doubt_of(toe({0.08, 0, 0.1})).empty());  // turned out
    CHECK(doubt_of(toe({0, 0, -0.1})) == toes);    // kneeling
    CHECK(doubt_of(toe({0, -0.1, -0.07})) == toes);
    CHECK(doubt_of(toe({0, -0.1, -0.05})).empty());  // pointed feet tell nothing
    CHECK(doubt_of(toe({0, -0.1, 0})).empty());
    Body heel;
    heel.on_foot = {{"Heel", {0, 0, -0.1}}};
    CHECK(doubt_of(heel).empty());

    // What is near enough to one place tells nothing; what is left does.
    for (const double noise : {0.0, 1e-9, -1e-7, 0.03, -0.03}) {
        CHECK(doubt_of({.shoulders = noise}).empty());
        CHECK(doubt_of({.shoulders = noise, .limbs = kArms}) == "neither shoulders nor hips tell left from right");
        CHECK(doubt_of({.shoulders = noise, .hips = noise}) == "neither shoulders nor hips tell left from right");
        CHECK(doubt_of({.shoulders = noise, .hips = noise, .on_foot = {{"Toe", {0, 0, 0.1}}}}).empty());
    }
}

TEST_CASE("rig front: straight limbs that are turned about their own bones are in doubt")
{
    const auto toe = [](double degrees) {
        return Body{.on_foot = {{"Toe", {0.1 * std::sin(degrees * kDegree), 0, 0.1 * std::cos(degrees * kDegree)}}}};
    };
    CHECK(doubt_of(toe(40)).empty());
    CHECK(doubt_of(toe(50)) == "the left leg's foot points aside");
    CHECK(doubt_of(toe(75)) == "the left leg's foot points aside");  // both together tell nothing
    CHECK(doubt_of({.left_bone = {-0.1, -0.28, 0}}).empty());
    CHECK(doubt_of({.left_bone = {-0.28, -0.1, 0}}) == "the left arm crosses the body");
    // A side split, and one leg kicked up.
    const auto split = [](double left, double right) {
        GltfRig rig = rig_of({});
        for (auto& node : rig.json["nodes"]) {
            const std::string name = node.value("name", "");
            const double degrees = name == "LeftUpLeg" ? left : name == "RightUpLeg" ? right : 0;
            const Quaterniond turn(AngleAxisd(degrees * kDegree, kZ));
            node["rotation"] = {turn.x(), turn.y(), turn.z(), turn.w()};
        }
        return rig_report(rig).value("faces_in_doubt", "");
    };
    CHECK(split(55, -55).empty());
    CHECK(split(65, -65) == "the left leg stands off the trunk");
    CHECK(split(0, -100) == "the right leg stands off the trunk");
}

TEST_CASE("rig front: a trunk that does not stand on its legs is in doubt")
{
    const std::string doubt = "the trunk does not stand on the legs";
    CHECK(doubt_of({.chest = {0, 0.5, 0}}) == doubt);
    CHECK(doubt_of({.chest = {0, 1, 0.5}}) == doubt);
    for (const Vector3d& near :
         {Vector3d(0, 1.05, 0), Vector3d(0, 1, -0.05), Vector3d(0, 0.95, 0)})  // too short to tell
        CHECK(doubt_of({.chest = near}).empty());
    CHECK(doubt_of({.chest = {0, 1, 0}, .pelvis = {0, 1, 0}}).empty());
    // Arms of one figure and legs of another.
    CHECK(doubt_of({.one_trunk = false}) == "the joint that all limbs hang on is far from the hips");
    CHECK(doubt_of({.limbs = kArms, .one_trunk = false}).empty());
}

TEST_CASE("rig front: limbs on no common joint tell nothing together")
{
    GltfRig rig;
    for (const std::string side : {"Left", "Right"}) {
        const double x = side == "Left" ? 1 : -1;
        const int upper = rig.add(side + "Arm", -1, {0.2 * x, 1.5, 0});
        rig.add(side + "Hand", rig.add(side + "ForeArm", upper, {0.3 * x, 0, 0}), {0.3 * x, 0, 0});
    }
    const json arms = rig_report(rig);
    CHECK(arms.at("faces_in_doubt") == "neither shoulders nor hips tell left from right");
    CHECK(problem_of(arms, "left_arm").starts_with("neither rest pose nor clip tells"));
    const int pelvis = rig.add("Pelvis", -1, {0, 1, 0});
    for (const std::string side : {"Left", "Right"}) {
        const int upper = rig.add(side + "UpLeg", pelvis, {side == "Left" ? 0.1 : -0.1, 0, 0});
        rig.add(side + "Foot", rig.add(side + "Leg", upper, {0, -0.45, 0}), {0, -0.45, 0});
    }
    CHECK(rig_report(rig).at("faces_in_doubt") == "the limbs do not hang on one trunk");
}

TEST_CASE("rig front: a mirror counts above the pair that tells")
{
    // Shoulders too close to tell, below a mirror of their own or not; hips below one or not.
    const auto in_doubt = [](double above_all, double above_arms) {
        GltfRig rig;
        const int pelvis = rig.add("Pelvis", -1, {0, 1, 0}, Quaterniond::Identity(), {above_all, 1, 1});
        const int chest = rig.add("Chest", pelvis, {0, 0.5, 0}, Quaterniond::Identity(), {above_arms, 1, 1});
        for (const std::string side : {"Left", "Right"}) {
            const double x = side == "Left" ? 1 : -1;
            const int arm = rig.add(side + "Arm", chest, {0.01 * x, 0, 0}),
                      leg = rig.add(side + "UpLeg", pelvis, {0.1 * x, 0, 0});
            rig.add(side + "Hand", rig.add(side + "ForeArm", arm, {0.3 * x, 0, 0}), {0.3 * x, 0, 0});
            rig.add(side + "Foot", rig.add(side + "Leg", leg, {0, -0.45, 0}), {0, -0.45, 0});
        }
        return rig_report(rig).value("faces_in_doubt", "").starts_with("without toes the mirror");
    };
    CHECK(in_doubt(-1, 1));
    CHECK(in_doubt(-1, -1));
    CHECK_FALSE(in_doubt(1, -1));
    CHECK_FALSE(in_doubt(1, 1));
}

TEST_CASE("rig front: a mirror without toes leaves open what is left and right")
{
    const std::string doubt =
        "without toes the mirror above the figure leaves open whether left and right are exchanged";
    for (const Vector3d& mirror : {Vector3d(-1, 1, 1), Vector3d(1, 1, -1), Vector3d(-1, -1, -1)}) {
        CHECK(doubt_of({.scale = mirror}) == doubt);
        CHECK(rig_report(rig_of({.on_foot = {{"Toe", {0, 0, 0.1}}}, .scale = mirror})).at("faces_by") == "the toes");
        CHECK_FALSE(
            rig_report(rig_of({.on_foot = {{"Toe", {0, 0, 0.1}}}, .scale = mirror})).contains("faces_in_doubt"));
        if (mirror.y() > 0)
            CHECK(doubt_of({.limbs = {"LeftArm"}, .scale = mirror}) ==
                  "the mirror above the left arm leaves open whether left and right are exchanged");
        CHECK(doubt_of({.scale = mirror, .elbow = 12, .knee = 12}) == doubt);  // bound all the same
    }
}

TEST_CASE("rig front: below a mirror the toes tell whether left and right are exchanged")
{
    const std::vector<std::pair<std::string, Vector3d>> toe = {{"Toe", {0, 0, 0.1}}};
    for (const double ahead : {0.0, 0.1}) {  // in a T-pose, and swung from there out of its own side
        const Body exchanged = {.left_bone = {0.3, 0, ahead}, .on_foot = toe, .scale = {-1, 1, 1}};
        const Body in_place = {
            .shoulders = -0.2, .hips = -0.1, .left_bone = {-0.3, 0, ahead}, .on_foot = toe, .scale = {-1, 1, 1}};
        CHECK(doubt_of(exchanged).empty());
        CHECK(doubt_of(in_place).empty());
    }
}

TEST_CASE("rig front: the file's own axes are taken where nothing speaks against them")
{
    const std::string trunk = "the trunk does not stand along the file's +Y", side = "is not on its side of a figure";
    const auto says = [](const std::string& doubt, const std::string& part) {
        INFO(doubt);
        return doubt.find(part) != std::string::npos;
    };
    CHECK(doubt_of({.limbs = kArms}).empty());
    CHECK(doubt_of({.limbs = kArms, .turn = turned(180, kY)}).empty());
    CHECK(rig_report(rig_of({.limbs = kArms, .turn = turned(50, kX)})).contains("faces_in_doubt") == false);
    for (const double back : {-90.0, 70.0, 90.0, 180.0}) {  // +z is up, or the figure lies
        CHECK(doubt_of({.limbs = kArms, .turn = turned(back, kX)}) == trunk);
        CHECK(doubt_of({.limbs = kArms, .turn = turned(back, kX), .elbow = 25}) == trunk);
    }
    CHECK(doubt_of({.limbs = kArms, .turn = turned(90, kZ)}) == trunk);

    for (const std::string limb : {"LeftArm", "RightArm", "LeftUpLeg", "RightUpLeg"}) {
        INFO(limb);
        CHECK(doubt_of({.limbs = {limb}}).empty());
        CHECK_FALSE(rig_report(rig_of({.limbs = {limb}, .turn = turned(40, kY)})).contains("faces_in_doubt"));
        for (const double away : {90.0, 180.0, 270.0})
            CHECK(says(doubt_of({.limbs = {limb}, .turn = turned(away, kY)}), side));
        for (const double back : {-90.0, 90.0})
            CHECK(says(doubt_of({.limbs = {limb}, .turn = turned(back, kX)}), "stand along the file's +Y"));
    }
    CHECK(doubt_of({.shoulders = 0, .left_bone = {0, -0.3, 0}, .limbs = {"LeftArm"}}) ==
          "nothing tells that the figure faces the file's +Z");
}
