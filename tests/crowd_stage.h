#pragma once
// SPDX-License-Identifier: MIT
// A folder with a clip of real motion and a crowd file, the command to solve them, and the solved poses as the tests of
// crowd files look at them: places by forward kinematics of the written BVH, rotations about the arm frame's axes.

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>

#include "swivel/swivel.h"
#include "tests/plain_motion.h"
#include "tests/pose_rows.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

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

struct CrowdStage {
    TempFolder folder;
    PlainMotion clip;
    std::vector<PlainArm> arms, legs;

    explicit CrowdStage(std::size_t first = 100, std::size_t step = 25)
    {
        spill(folder / "clip.bvh", cut(plain_motion_of(must_find_jump()), first, step));
        clip = plain_motion_of(folder / "clip.bvh");
        arms = arms_of(clip);
        legs = legs_of(clip);
    }

    Outcome run(const std::string& toml, std::vector<std::string> more) const
    {
        spill(folder / "c.toml", toml);
        more.insert(more.begin(), {"solve", "clip.bvh", "--crowd", "c.toml"});
        return run_command(folder.path, more);
    }
    std::string output(const std::string& toml, const std::string& out, std::vector<std::string> more = {}) const
    {
        more.insert(more.end(), {"--out", out});
        const Outcome outcome = run(toml, more);
        INFO(toml << outcome.err);
        REQUIRE(outcome.exit_code == 0);
        REQUIRE(outcome.err.empty());
        return slurp(folder / out);
    }
    PlainMotion motion(const std::string& toml, const std::vector<std::string>& more = {}) const
    {
        return plain_motion(output(toml, "out.bvh", more));
    }
    // columns: what the table has beside.
    std::vector<PoseLine> rows(const std::string& toml, const std::string& limb, const std::string& columns = "",
                               const std::vector<std::string>& more = {}) const
    {
        std::vector<PoseLine> lines = pose_lines(output(toml, "out.csv", more), columns);
        std::erase_if(lines, [&](const PoseLine& line) { return line.limb != limb; });
        REQUIRE_FALSE(lines.empty());
        return lines;
    }
    nlohmann::json json(const std::string& toml, std::vector<std::string> more = {}) const
    {
        more.push_back("--json");
        const Outcome outcome = run(toml, more);
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return nlohmann::json::parse(outcome.out);
    }
    // Of a limb whose bones lie on one line at rest, as this clip's arms do. The hinge is the one that is reported.
    ArmAxes axes(std::size_t arm) const
    {
        const nlohmann::json hinge = json("[crowd]\n").at("arms_bound").at(arm).at("hinge");
        const Vector3d z = clip.joint(arms[arm].elbow).offset.normalized();
        const Vector3d given(hinge.at(0), hinge.at(1), hinge.at(2));
        const Vector3d x = (given - given.dot(z) * z).normalized();
        Matrix3d m;
        m << x, z.cross(x), z;
        return {m};
    }
    void require_refused(const std::string& toml, const std::string& said, const std::string& out = "out.csv",
                         std::vector<std::string> more = {}) const
    {
        more.insert(more.end(), {"--out", out});
        fs::remove(folder / out);
        const Outcome outcome = run(toml, more);
        INFO(toml << outcome.err);
        CHECK(outcome.exit_code == 1);
        CHECK_THAT(outcome.err, Catch::Matchers::StartsWith("swivel: ") && Catch::Matchers::Contains(said));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        CHECK_FALSE(fs::exists(folder / out));
    }
};

// "[x, y, z]", every digit.
inline std::string text_of(const Vector3d& v)
{
    std::array<char, 100> text{};
    std::snprintf(text.data(), text.size(), "[%.17g, %.17g, %.17g]", v.x(), v.y(), v.z());
    return text.data();
}

// By the right hand about the unit vector u, from a to b, in degrees.
inline double angle_about(const Vector3d& u, const Vector3d& a, const Vector3d& b)
{
    const Vector3d from = a - a.dot(u) * u, to = b - b.dot(u) * u;
    return std::atan2(u.dot(from.cross(to)), from.dot(to)) * kDegrees;
}
inline double angle_between(const Vector3d& a, const Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

// Of the swivel plane: cross(line from shoulder to wrist, elbow), not of unit length.
inline Vector3d plane_normal(const PlainArmPose& at) { return (at.wrist - at.shoulder).cross(at.elbow - at.shoulder); }

}  // namespace swivel::test
