// SPDX-License-Identifier: MIT
#include "tests/random_figure.h"

#include <algorithm>
#include <cmath>

namespace swivel::test {

namespace {

class FigureMaker {
public:
    FigureMaker(std::mt19937& random, const FigureWish& wish) : random_(random), wish_(wish) {}

    Figure make(const FigureNames& names)
    {
        const double size = wish_.scales > 0 ? std::pow(10.0, 2 * any()) : 1;
        Eigen::Vector3d scale = Eigen::Vector3d::Constant(size);
        if (likely(wish_.mirrors)) scale.x() = -size;
        figure_.is_mirrored = scale.x() < 0;
        if (likely(wish_.uneven)) spoil(scale);
        const Eigen::Quaterniond turn = wish_.random_axes ? any_turn() : Eigen::Quaterniond::Identity();
        const int armature =
            add("Armature", -1, Eigen::Isometry3d(Eigen::Translation3d(any(), any(), any()) * turn), scale);
        figure_.front = (poses_[0].linear() * Eigen::Vector3d::UnitZ()).normalized();
        const int hips = joint("hips", armature, {0, 1, 0}, Part::trunk),
                  chest = joint("chest", hips, {0, 1.5, 0}, Part::trunk);
        for (std::size_t limb = 0; limb < 4; ++limb) add_limb(names, limb, limb < 2 ? chest : hips);
        if (wish_.moves) move();
        return figure_;
    }

private:
    double any() { return std::uniform_real_distribution<double>(-1, 1)(random_); }
    bool likely(double share) { return std::uniform_real_distribution<double>(0, 1)(random_) < share; }
    Eigen::Quaterniond any_turn() { return Eigen::Quaterniond(any(), any(), any(), any()).normalized(); }
    void spoil(Eigen::Vector3d& scale) { scale.y() *= 1 + wish_.uneven_by; }

    // A node whose axes lie as `frame` has it in its parent's.
    int add(const std::string& name, int parent, const Eigen::Isometry3d& frame, const Eigen::Vector3d& scale)
    {
        const int node =
            figure_.rig.add(name, parent, frame.translation(), Eigen::Quaterniond(frame.rotation()), scale);
        const Eigen::Affine3d above =
            parent < 0 ? Eigen::Affine3d::Identity() : poses_[static_cast<std::size_t>(parent)];
        poses_.push_back(above * frame * Eigen::Scaling(scale));
        return node;
    }
    enum class Part { trunk, bone, tip };

    // A joint at a place in the armature's space, with any axes. A bone may have a mirror of its own; the scale of a
    // tip moves no limb.
    int joint(const std::string& name, int parent, const Eigen::Vector3d& place, Part part)
    {
        const Eigen::Affine3d& above = poses_[static_cast<std::size_t>(parent)];
        const Eigen::Vector3d local = above.inverse() * (poses_[0] * place);
        double size = likely(wish_.scales) ? std::exp(any()) : 1;
        Eigen::Vector3d scale = Eigen::Vector3d::Constant(size);
        if (part != Part::trunk && likely(wish_.mirrors / 3)) scale[static_cast<int>(random_() % 3)] = -size;
        if (part != Part::trunk && likely(wish_.mirrors / 3)) scale = -scale;
        if (part != Part::tip && likely(wish_.uneven / 10)) spoil(scale);
        if (part == Part::tip && likely(wish_.uneven)) scale.z() *= 1.3;
        const Eigen::Quaterniond turn = wish_.random_axes ? any_turn() : Eigen::Quaterniond::Identity();
        return add(name, parent, Eigen::Isometry3d(Eigen::Translation3d(local) * turn), scale);
    }
    int twists(const std::string& base, int parent, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
    {
        if (likely(wish_.twist_bones))
            joint(base + "_twist_01", parent, from + 0.3 * (to - from), Part::tip);  // beside
        if (likely(wish_.twist_bones)) {
            parent = joint(base + " Bob", parent, from + 0.5 * (to - from), Part::bone);
            twists_.push_back(parent);
        }
        if (likely(wish_.twist_bones)) {
            parent = joint(base + "_twist_02", parent, from + 0.8 * (to - from), Part::bone);
            twists_.push_back(parent);
        }
        return parent;
    }
    void add_limb(const FigureNames& names, std::size_t limb, int parent)
    {
        const bool is_arm = limb < 2;
        const double side = limb % 2 == 0 ? 1 : -1;  // a figure that faces +Z has its left at +X
        const auto name = [&](std::size_t part) {
            std::string text = is_arm ? names.arm[part] : names.leg[part];
            return text.replace(text.find('*'), 1, side > 0 ? names.left : names.right);
        };
        const double bend = figure_.bend[limb] = wish_.bent ? 0.2 + std::abs(any()) : 0;
        const Eigen::Vector3d top = is_arm ? Eigen::Vector3d(0.2 * side, 1.5, 0) : Eigen::Vector3d(0.1 * side, 1, 0);
        const Eigen::Vector3d along =
            is_arm ? Eigen::Vector3d(side, 0.3 * any(), 0).normalized() : Eigen::Vector3d(0, -1, 0);
        const Eigen::Vector3d flexed = is_arm ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(0, 0, -1);
        const Eigen::Vector3d elbow = top + (0.3 + 0.1 * any()) * along;
        const Eigen::Vector3d wrist = elbow + (0.3 + 0.1 * any()) * (std::cos(bend) * along + std::sin(bend) * flexed);
        LimbNodes& nodes = figure_.limbs[limb];
        nodes[0] = joint(name(0), parent, top, Part::bone);
        nodes[1] = joint(name(1), twists(name(0), nodes[0], top, elbow), elbow, Part::bone);
        nodes[2] = joint(name(2), twists(name(1), nodes[1], elbow, wrist), wrist, Part::tip);
        if (!is_arm && wish_.toes)
            joint(names.leg[2] + std::string("Toe") + (side > 0 ? "L" : "R"), nodes[2],
                  wrist + Eigen::Vector3d(0, -0.05, 0.15), Part::tip);
        figure_.upper[limb] = (poses_[0].linear() * (elbow - top)).norm();
        figure_.lower[limb] = (poses_[0].linear() * (wrist - elbow)).norm();
    }
    bool is_between(int node) const { return std::find(twists_.begin(), twists_.end(), node) != twists_.end(); }
    // A turn of a joint; what lies between two of a limb's turns about the bone.
    Eigen::Quaterniond turn_of(int node)
    {
        if (!is_between(node)) return any_turn();
        const auto& at = figure_.rig.json["nodes"][static_cast<std::size_t>(node)];
        const std::vector<double> along = at["translation"], rest = at["rotation"];
        const Eigen::Vector3d bone = Eigen::Vector3d(along[0], along[1], along[2]).normalized();
        return Eigen::AngleAxisd(2 * any(), bone) * Eigen::Quaterniond(rest[3], rest[0], rest[1], rest[2]);
    }
    // Five keys for every joint; now and then a bone stretches.
    void move()
    {
        const int animation = figure_.rig.add_animation("motion");
        const std::vector<float> times = {0, 0.25f, 0.5f, 0.75f, 1};
        for (int node = 1; node < static_cast<int>(poses_.size()); ++node) {
            std::vector<float> keys;
            for (std::size_t n = 0; n < times.size(); ++n)
                for (const double part : Eigen::Vector4d(turn_of(node).coeffs()))
                    keys.push_back(static_cast<float>(part));
            figure_.rig.add_keys(animation, node, "rotation", times, keys, random_() % 4 == 0 ? "STEP" : "LINEAR");
            if (is_between(node) || !likely(wish_.scales / 4)) continue;
            const std::vector<double> rest = figure_.rig.json["nodes"][static_cast<std::size_t>(node)]["translation"];
            std::vector<float> places;
            for (std::size_t n = 0; n < times.size(); ++n)
                for (const double part : rest)
                    places.push_back(static_cast<float>(part * (1 + 0.2 * static_cast<double>(n))));
            figure_.rig.add_keys(animation, node, "translation", times, places);
        }
    }

    std::mt19937& random_;
    FigureWish wish_;
    Figure figure_;
    std::vector<Eigen::Affine3d> poses_;  // of each node, in the world
    std::vector<int> twists_;             // nodes
};

}  // namespace

const std::vector<FigureNames>& figure_names()
{
    static const std::vector<FigureNames> names = {
        {"Mixamo",
         {"mixamorig:*Arm", "mixamorig:*ForeArm", "mixamorig:*Hand"},
         {"mixamorig:*UpLeg", "mixamorig:*Leg", "mixamorig:*Foot"},
         "Left",
         "Right"},
        {"Unreal", {"upperarm_*", "lowerarm_*", "hand_*"}, {"thigh_*", "calf_*", "foot_*"}, "l", "r"},
        {"VRM",
         {"J_Bip_*_UpperArm", "J_Bip_*_LowerArm", "J_Bip_*_Hand"},
         {"J_Bip_*_UpperLeg", "J_Bip_*_LowerLeg", "J_Bip_*_Foot"},
         "L",
         "R"},
        {"Biped",
         {"Bip01 * UpperArm", "Bip01 * Forearm", "Bip01 * Hand"},
         {"Bip01 * Thigh", "Bip01 * Calf", "Bip01 * Foot"},
         "L",
         "R"},
        {"MakeHuman",
         {"upperarm01.*", "lowerarm01.*", "wrist.*"},
         {"upperleg01.*", "lowerleg01.*", "foot.*"},
         "L",
         "R"},
    };
    return names;
}

Figure random_figure(std::mt19937& random, const FigureWish& wish, const FigureNames& names)
{
    return FigureMaker(random, wish).make(names);
}

}  // namespace swivel::test
