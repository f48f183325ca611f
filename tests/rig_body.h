#pragma once
// SPDX-License-Identifier: MIT
// A made-up figure, and what is in doubt of its front.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/rig_report.h"

namespace swivel::test {

// A figure that faces +z and stands along +y, its limbs straight.
struct Body {
    double shoulders = 0.2, hips = 0.1;  // half the distance of each pair
    Eigen::Vector3d chest = {0, 1.5, 0}, pelvis = {0, 1, 0};
    Eigen::Vector3d left_bone = {0.3, 0, 0}, leg_bone = {0, -0.45, 0};  // of an arm, of a leg
    Eigen::Quaterniond chest_turn = Eigen::Quaterniond::Identity();     // of the shoulders about the chest
    // Joints by name, without side; x is to the side.
    std::vector<std::pair<std::string, Eigen::Vector3d>> on_foot = {};
    std::vector<std::string> limbs = {"LeftArm", "RightArm", "LeftUpLeg", "RightUpLeg"};
    bool one_trunk = true;
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();  // of the whole
    Eigen::Vector3d scale = {1, 1, 1};                         // of what is above it
    double elbow = 0, knee = 0;                                // degrees at rest, as elbows and knees bend
    double right_knee = std::nan("");                          // where it is another
    Eigen::Vector3d knee_axis = {1, 0, 0};
    double clip_elbow = 0, clip_knee = 0;  // in the clip's mean, which there is where one of them is not 0
};

inline GltfRig rig_of(const Body& body)
{
    GltfRig rig;
    const int scene = rig.add("Scene", -1, {0, 0, 0}, Eigen::Quaterniond::Identity(), body.scale);
    const int root = rig.add("Root", scene, {0, 0, 0}, body.turn);
    const int pelvis = rig.add("Pelvis", body.one_trunk ? root : scene, body.pelvis);
    const int chest = body.one_trunk ? rig.add("Chest", pelvis, body.chest - body.pelvis, body.chest_turn)
                                     : rig.add("Chest", root, body.chest, body.chest_turn);
    const bool moves = body.clip_elbow != 0 || body.clip_knee != 0;
    const int animation = moves ? rig.add_animation("clip") : -1;
    for (const std::string& limb : body.limbs) {
        const bool is_arm = limb.ends_with("Arm");
        const double x = limb.starts_with("Left") ? 1 : -1;
        const std::string side = x > 0 ? "Left" : "Right";
        const Eigen::Vector3d bone =
            is_arm ? Eigen::Vector3d(x * body.left_bone.x(), body.left_bone.y(), body.left_bone.z()) : body.leg_bone;
        const Eigen::Vector3d axis =
            is_arm ? Eigen::Vector3d(bone.cross(Eigen::Vector3d::UnitZ()).normalized()) : body.knee_axis;
        const double knee = x < 0 && !std::isnan(body.right_knee) ? body.right_knee : body.knee;
        const double at_rest = is_arm ? body.elbow : knee, in_clip = is_arm ? body.clip_elbow : body.clip_knee;
        const int upper = rig.add(limb, is_arm ? chest : pelvis, {x * (is_arm ? body.shoulders : body.hips), 0, 0});
        const int lower = rig.add(side + (is_arm ? "ForeArm" : "Leg"), upper, bone,
                                  Eigen::Quaterniond(Eigen::AngleAxisd(at_rest * kDegree, axis)));
        const int end = rig.add(side + (is_arm ? "Hand" : "Foot"), lower, bone);
        if (in_clip != 0)
            rig.add_keys(animation, lower, "rotation", {0, 1.0f / 30}, turns(axis, {0.5 * in_clip, 1.5 * in_clip}));
        if (!is_arm)
            for (const auto& [name, step] : body.on_foot) rig.add(side + name, end, {x * step.x(), step.y(), step.z()});
    }
    return rig;
}

// What is in doubt of the front, which then no straight limb is bound by; empty where all are bound and it is `front`.
inline std::string doubt_of(const Body& body, const Eigen::Vector3d& front = Eigen::Vector3d::UnitZ())
{
    const nlohmann::json report = rig_report(rig_of(body));
    INFO(report.dump());
    const std::string doubt = report.value("faces_in_doubt", "");
    std::size_t count = 0;
    for (const nlohmann::json& limb : report.at("limbs")) {
        if (limb.value("problem", "").starts_with("no joints have names")) continue;
        ++count;
        const bool arm = limb.at("limb").get<std::string>().ends_with("arm");
        const bool tells = (arm ? body.elbow : body.knee) > 5 || (arm ? body.clip_elbow : body.clip_knee) != 0;
        CHECK(limb.at("bound") == (doubt.empty() || tells));
        if (limb.at("bound") == false)
            CHECK(limb.at("problem").get<std::string>().find("tells which way it bends, and " + doubt + "; use") !=
                  std::string::npos);
    }
    CHECK(count == body.limbs.size());
    if (doubt.empty()) CHECK(degrees_between(vector_of(report.at("faces")), body.turn * front) < 1e-3);
    return doubt;
}

inline Eigen::Quaterniond turned(double degrees, const Eigen::Vector3d& axis)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kDegree, axis));
}

inline const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kY = Eigen::Vector3d::UnitY(),
                             kZ = Eigen::Vector3d::UnitZ();
inline const std::vector<std::string> kArms = {"LeftArm", "RightArm"}, kLegs = {"LeftUpLeg", "RightUpLeg"};

}  // namespace swivel::test
