// SPDX-License-Identifier: MIT
#include "tests/rig_body.h"

namespace swivel::test {

namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::array<const char*, 7> kVrmNames = {"UpperArm", "LowerArm", "Hand", "UpperLeg",
                                                  "LowerLeg", "Foot",     "Toes"};

class BodyMaker {
public:
    BodyMaker(GltfRig& rig, const Body& body) : rig_(rig), body_(body) {}

    BodyNodes make()
    {
        const int scene = rig_.add("Scene", -1, {0, 0, 0}, Quaterniond::Identity(), body_.scale);
        const int root = rig_.add("Root", scene, {0, 0, 0}, body_.turn);
        const int hips = rig_.add("Hips", root, {0, 1, 0}), chest = rig_.add("Chest", hips, {0, 0.5, 0});
        if (!body_.clip.empty() || body_.between) animation_ = rig_.add_animation("clip");
        for (LimbNodes& limb : nodes_) limb = {-1, -1, -1};
        for (const std::size_t limb : body_.limbs) add_limb(limb, limb < 2 ? chest : hips);
        if (body_.vrm > 0) write_vrm();
        return nodes_;
    }

private:
    void add_limb(std::size_t limb, int parent)
    {
        const bool is_arm = limb < 2, is_left = limb % 2 == 0;
        const double x = is_left ? body_.left_at : -body_.left_at;
        const auto name = [&](std::string text) {
            return text.replace(text.find('*'), 1, is_left ? body_.left : body_.right);
        };
        const auto& names = is_arm ? body_.arm : body_.leg;
        const Vector3d of_left = is_arm ? body_.arm_bone : body_.leg_bone,
                       bone(x * of_left.x(), of_left.y(), of_left.z());
        const Vector3d flexed = is_arm ? kZ : Vector3d(-kZ), across = bone.cross(flexed);
        const Vector3d axis = across.norm() < 1e-9 ? kX : Vector3d(across.normalized());
        const auto turn = [&](double degrees) { return Quaterniond(AngleAxisd(degrees * kDegree, axis)); };
        LimbNodes& nodes = nodes_[limb];
        nodes[0] = rig_.add(name(names[0]), parent, {x * (is_arm ? 0.2 : 0.1), 0, 0});
        const bool is_split = body_.between && limb == 0;
        const int above = is_split ? add_between(nodes[0], bone) : nodes[0];
        nodes[1] = rig_.add(name(names[1]), above, is_split ? Vector3d(bone / 2) : bone, turn(body_.rest[limb]));
        nodes[2] = rig_.add(name(names[2]), nodes[1], bone, turn(-body_.rest[limb]));  // feet lie level
        if (!is_arm && body_.toe_step) {
            const Vector3d& step = *body_.toe_step;
            const int toe = rig_.add(name(body_.toe), nodes[2], {x * step.x(), step.y(), step.z()});
            say(6, is_left, toe);
        }
        for (std::size_t part = 0; part < 3; ++part) say(part + (is_arm ? 0 : 3), is_left, nodes[part]);
        if (body_.clip.empty()) return;
        const AngleAxisd aside(body_.aside[limb] * kDegree, bone.normalized());
        std::vector<double> degrees;
        for (const Bends& frame : body_.clip) degrees.push_back(frame[limb]);
        rig_.add_keys(animation_, nodes[1], "rotation", times(degrees.size()), turns(aside * axis, degrees));
    }
    int add_between(int upper, const Vector3d& bone)
    {
        const int node = rig_.add(body_.between->name, upper, bone / 2);
        rig_.add_keys(animation_, node, "rotation", times(2), turns(body_.between->axis, {0, body_.between->degrees}));
        return node;
    }
    static std::vector<float> times(std::size_t count)
    {
        std::vector<float> seconds;
        for (std::size_t n = 0; n < count; ++n) seconds.push_back(static_cast<float>(n) / 30);
        return seconds;
    }

    void say(std::size_t part, bool is_left, int node)
    {
        human_.emplace_back((is_left ? "left" : "right") + std::string(kVrmNames[part]), node);
    }
    void write_vrm()
    {
        const bool is_old = body_.vrm < 1;
        nlohmann::json bones = is_old ? nlohmann::json::array() : nlohmann::json::object();
        for (const auto& [bone, node] : human_)
            if (is_old)
                bones.push_back({{"bone", bone}, {"node", node}, {"useDefaultValues", true}});
            else
                bones[bone] = {{"node", node}};
        nlohmann::json vrm = {{"humanoid", {{"humanBones", bones}}}};
        vrm["specVersion"] = is_old ? "0.0" : "1.0";
        const char* const key = is_old ? "VRM" : "VRMC_vrm";
        rig_.json["extensionsUsed"] = {key};
        rig_.json["extensions"][key] = vrm;
    }

    GltfRig& rig_;
    const Body& body_;
    BodyNodes nodes_{};
    int animation_ = -1;
    std::vector<std::pair<std::string, int>> human_;  // VRM's name of a bone, and its node
};

}  // namespace

BodyNodes add_body(GltfRig& rig, const Body& body) { return BodyMaker(rig, body).make(); }

GltfRig rig_of(const Body& body)
{
    GltfRig rig;
    add_body(rig, body);
    return rig;
}

}  // namespace swivel::test
