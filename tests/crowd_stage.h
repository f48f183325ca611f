#pragma once
// SPDX-License-Identifier: MIT
// A folder with a clip of real motion and a crowd file, the command to solve them, and the solved poses for the tests
// of crowd files. One forward kinematics judges all that is written: that of plain_motion.h. Rotations are about the
// arm frame's axes.

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "tests/plain_motion.h"
#include "tests/run_command.h"
#include "tests/solve_tables.h"
#include "tests/test_data.h"
#include "tools/formats/clip.h"

namespace swivel::test {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

inline constexpr double kDegrees = 180 / std::numbers::pi;

// The axes of a limb's arm frame in its joints' axes, which at rest are the world's: columns x, y, z.
struct ArmAxes {
    Matrix3d in_joint;

    Quaterniond of(const Quaterniond& local) const
    {
        const Quaterniond axes(in_joint);
        const Quaterniond q = axes.conjugate() * local * axes;
        return q.w() < 0 ? Quaterniond(-q.coeffs()) : q;
    }
};

// One of a motion's joints in a frame.
PlainPose joint_in(const PlainMotion& motion, std::size_t frame, std::string_view name);
// Its rotation against the joint above it.
Matrix3d local_rotation(const PlainMotion& motion, std::size_t frame, std::string_view name);
// All joints of a clip that may be in no file, by products of its own rotations and translations.
std::vector<Eigen::Isometry3d> joints_of(const formats::Clip& clip, std::size_t frame);

// The floor of a motion by the rule of crowds: in a quarter of all frames the lowest joint is lower.
double floor_of(const PlainMotion& motion);

struct CrowdStage {
    TempFolder folder;
    PlainMotion clip;
    std::vector<PlainArm> arms, legs;

    explicit CrowdStage(std::size_t first = 100, std::size_t step = 25);

    Outcome run(const std::string& toml, Words more) const;
    std::string output(const std::string& toml, const std::string& out, Words more = {}) const;
    PlainMotion motion(const std::string& toml, const Words& more = {}) const;
    // columns: what the table has beside.
    std::vector<PoseLine> rows(const std::string& toml, const std::string& limb, const std::string& columns = "",
                               const Words& more = {}) const;
    nlohmann::json json(const std::string& toml, Words more = {}) const;
    // Where the figure faces at rest, level: joints have the world's axes then.
    Vector3d face() const;
    // The axes of a limb whose bones lie on one line at rest, as this clip's arms do. The hinge is the one that is
    // reported.
    ArmAxes axes(std::size_t arm) const;
};

// "[x, y, z]", every digit.
std::string text_of(const Vector3d& v);

// By the right hand about the unit vector u, from a to b, in degrees.
double angle_about(const Vector3d& u, const Vector3d& a, const Vector3d& b);
double angle_between(const Vector3d& a, const Vector3d& b);

// The normal of the swivel plane: cross(line from shoulder to wrist, elbow), not of unit length.
inline Vector3d plane_normal(const PlainArmPose& at) { return (at.wrist - at.shoulder).cross(at.elbow - at.shoulder); }

}  // namespace swivel::test
