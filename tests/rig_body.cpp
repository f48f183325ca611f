// SPDX-License-Identifier: MIT
#include "tests/rig_body.h"

#include <catch2/catch.hpp>

namespace swivel::test {

GltfRig rig_of(const Body& body)
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

std::string doubt_of(const Body& body, const Eigen::Vector3d& front)
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

Eigen::Quaterniond turned(double degrees, const Eigen::Vector3d& axis)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * kDegree, axis));
}

}  // namespace swivel::test
