// SPDX-License-Identifier: MIT
#include "tests/crowd_stage.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <limits>

namespace swivel::test {

std::string text_of(const Vector3d& v)
{
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "[%.17g, %.17g, %.17g]", v.x(), v.y(), v.z());
    return text.data();
}

double angle_about(const Vector3d& u, const Vector3d& a, const Vector3d& b)
{
    const Vector3d from = a - a.dot(u) * u, to = b - b.dot(u) * u;
    return std::atan2(u.dot(from.cross(to)), from.dot(to)) * kDegrees;
}

double angle_between(const Vector3d& a, const Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

PlainPose joint_in(const PlainMotion& motion, std::size_t frame, std::string_view name)
{
    return pose_of(motion, frame)[static_cast<std::size_t>(joint_named(motion, name))];
}

Matrix3d local_rotation(const PlainMotion& motion, std::size_t frame, std::string_view name)
{
    const std::vector<PlainPose> pose = pose_of(motion, frame);
    const int joint = joint_named(motion, name), above = motion.joint(joint).parent;
    const Matrix3d& turn = pose[static_cast<std::size_t>(joint)].rotation;
    return above < 0 ? turn : Matrix3d(pose[static_cast<std::size_t>(above)].rotation.transpose() * turn);
}

std::vector<Eigen::Isometry3d> joints_of(const formats::Clip& clip, std::size_t frame)
{
    std::vector<Eigen::Isometry3d> to;
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        const Eigen::Isometry3d local = Eigen::Translation3d(formats::local_translation(clip, frame, n)) *
                                        clip.rotation[frame * clip.joints.size() + n];
        const int parent = clip.joints[n].parent;
        to.push_back(parent < 0 ? local : to[static_cast<std::size_t>(parent)] * local);
    }
    return to;
}

double floor_of(const PlainMotion& motion)
{
    std::vector<double> lowest(motion.lines.size(), std::numeric_limits<double>::infinity());
    for (std::size_t frame = 0; frame < lowest.size(); ++frame)
        for (const PlainPose& joint : pose_of(motion, frame))
            lowest[frame] = std::min(lowest[frame], joint.position.y());
    std::ranges::sort(lowest);
    return lowest[(lowest.size() - 1) / 4];
}

CrowdStage::CrowdStage(std::size_t first, std::size_t step)
{
    spill(folder / "clip.bvh", cut(plain_motion_of(must_find_jump()), first, step));
    clip = plain_motion_of(folder / "clip.bvh");
    arms = arms_of(clip);
    legs = legs_of(clip);
}

Outcome CrowdStage::run(const std::string& toml, Words more) const
{
    spill(folder / "c.toml", toml);
    more.insert(more.begin(), {"solve", "clip.bvh", "--crowd", "c.toml"});
    return run_command(folder.path, more);
}

std::string CrowdStage::output(const std::string& toml, const std::string& out, Words more) const
{
    more.insert(more.end(), {"--out", out});
    const Outcome outcome = run(toml, more);
    INFO(toml << outcome.err);
    REQUIRE(outcome.exit_code == 0);
    REQUIRE(outcome.err.empty());
    return slurp(folder / out);
}

PlainMotion CrowdStage::motion(const std::string& toml, const Words& more) const
{
    return plain_motion(output(toml, "out.bvh", more));
}

std::vector<PoseLine> CrowdStage::rows(const std::string& toml, const std::string& limb, const std::string& columns,
                                       const Words& more) const
{
    std::vector<PoseLine> lines = pose_lines(output(toml, "out.csv", more), columns);
    std::erase_if(lines, [&](const PoseLine& line) { return line.limb != limb; });
    REQUIRE_FALSE(lines.empty());
    return lines;
}

nlohmann::json CrowdStage::json(const std::string& toml, Words more) const
{
    more.push_back("--json");
    return nlohmann::json::parse(done(run(toml, more)).out);
}

Vector3d CrowdStage::face() const
{
    const Outcome rig = run_command(folder.path, {"rig", "clip.bvh", "--json"});
    REQUIRE(rig.exit_code == 0);
    const nlohmann::json faces = nlohmann::json::parse(rig.out).at("faces");
    return Vector3d(faces.at(0), 0, faces.at(2)).normalized();
}

ArmAxes CrowdStage::axes(std::size_t arm) const
{
    const nlohmann::json bend = json("[crowd]\n").at("arms_bound").at(arm).at("bend");
    const Vector3d z = clip.joint(arms[arm].elbow).offset.normalized();
    const Vector3d given(bend.at(0), bend.at(1), bend.at(2));
    const Vector3d y = (given - given.dot(z) * z).normalized();
    Matrix3d m;
    m << y.cross(z), y, z;
    return {m};
}

}  // namespace swivel::test
