#pragma once
// SPDX-License-Identifier: MIT
// Figures that are made up: a body as a BVH file, with the names of the CMU library, of which it is known without the
// code where each joint is; and skeletons of names alone.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <numbers>
#include <string>
#include <vector>

#include "tests/plain_motion.h"
#include "tools/formats/clip.h"

namespace swivel::test {

inline constexpr double kRad = std::numbers::pi / 180;

inline Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle_deg)
{
    return Eigen::AngleAxisd(angle_deg * kRad, axis).toRotationMatrix();
}

// A body that faces +Z and stands along +Y before `world` turns it.
struct MadeBody {
    int spine = 3;
    double size = 1;
    double arms_down_deg = 0, legs_out_deg = 0, toes_out_deg = 0;  // of its rest
    double forearm = 0.26, shin = 0.42, foot = 0.13;
    Eigen::Matrix3d world = Eigen::Matrix3d::Identity();

    std::string joint(const std::string& name, const Eigen::Vector3d& offset, const std::string& below) const
    {
        const Eigen::Vector3d at = size * (world * offset);
        const std::string kind = name == "Hips" ? "ROOT " : "JOINT ";
        const std::string channels = name == "Hips" ? "CHANNELS 6 Xposition Yposition Zposition " : "CHANNELS 3 ";
        return kind + name + fmt::format("\n{{\nOFFSET {} {} {}\n", at.x(), at.y(), at.z()) + channels +
               "Zrotation Xrotation Yrotation\n" + below + "}\n";
    }
    std::string arm(const std::string& name, double left) const
    {
        const Eigen::Vector3d way =
            about(Eigen::Vector3d::UnitZ(), -left * arms_down_deg) * Eigen::Vector3d(left, 0, 0);
        const std::string hand = joint(name + "Hand", forearm * way, "End Site\n{\nOFFSET 0 0 0\n}\n");
        return joint(name + "Shoulder", {0.03 * left, 0.02, 0},
                     joint(name + "Arm", {0.12 * left, 0, 0}, joint(name + "ForeArm", 0.3 * way, hand)));
    }
    std::string leg(const std::string& name, double left) const
    {
        const Eigen::Vector3d way = about(Eigen::Vector3d::UnitZ(), left * legs_out_deg) * Eigen::Vector3d(0, -1, 0);
        const Eigen::Vector3d toe =
            about(Eigen::Vector3d::UnitY(), left * toes_out_deg) * Eigen::Vector3d(0, -0.06, foot);
        const std::string toes = joint(name + "ToeBase", toe, "End Site\n{\nOFFSET 0 0 0\n}\n");
        return joint(name + "UpLeg", {0.1 * left, -0.05, 0},
                     joint(name + "Leg", 0.45 * way, joint(name + "Foot", shin * way, toes)));
    }
    std::string hierarchy() const
    {
        std::string above = joint("Neck", {0, 0.06, 0}, joint("Head", {0, 0.1, 0}, "End Site\n{\nOFFSET 0 0 0\n}\n")) +
                            arm("Left", 1) + arm("Right", -1);
        for (int n = spine; n > 0; --n) above = joint(fmt::format("Spine{}", n), {0, 0.5 / spine, 0}, above);
        return "HIERARCHY\n" + joint("Hips", Eigen::Vector3d::Zero(), leg("Left", 1) + leg("Right", -1) + above) +
               "MOTION\n";
    }
    // A frame's values at rest.
    std::vector<double> rest_row() const
    {
        std::size_t count = 0;
        for (const PlainJoint& of : plain_motion(hierarchy() + "Frame Time\n").joints) count += of.channels.size();
        return std::vector<double>(count);
    }
    // With these rows of values; none: one frame at rest.
    std::string text(const std::vector<std::vector<double>>& rows = {}) const
    {
        if (rows.empty()) return text({rest_row()});
        std::string frames;
        for (const std::vector<double>& row : rows) frames += fmt::format("{}\n", fmt::join(row, " "));
        return hierarchy() + fmt::format("Frames: {}\nFrame Time: 0.02\n{}", rows.size(), frames);
    }
};

using Names = std::vector<std::string>;

// Puts a chain of joints below one; -1: below none. Returns the last of them.
inline int add_chain(formats::Clip& clip, int parent, const Names& names)
{
    for (const std::string& name : names) {
        clip.joints.push_back({name, parent, {1, 0, 0}});
        parent = static_cast<int>(clip.joints.size()) - 1;
        clip.joints.back().number = parent;
    }
    return parent;
}

}  // namespace swivel::test
