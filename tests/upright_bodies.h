// SPDX-License-Identifier: MIT
//
// A spine, a neck and a head that look, as crowds of one skeleton.
#pragma once

#include <algorithm>
#include <utility>

#include "tests/looking_bodies.h"

namespace swivel::test {

// A spine of two bones, a neck and a head, upright, whose eyes look along z.
struct Upright {
    BodySkeleton skeleton;
    swivel_group_def look = swivel_default_group_def(0);

    Upright()
    {
        const Float3 offsets[] = {{0, 1, 0}, {0, 0.15f, 0}, {0, 0.3f, 0.02f}, {0, 0.12f, 0.01f}};
        for (int n = 0; n < 4; ++n) {
            skeleton.parents.push_back(n - 1);
            skeleton.rotations.push_back({0, 0, 0, 1});
            skeleton.translations.push_back(offsets[n]);
            look.look.joints[n] = static_cast<std::uint32_t>(n);
        }
        look.features = SWIVEL_LOOK;
        look.look.joint_count = 4;
        const float most[] = {0.97f, 0.94f, 0.8f, 0.5f}, share[] = {1, 1, 2, 4};  // 14, 20, 37 and 60 degrees
        std::copy_n(most, 4, look.look.cos_most), std::copy_n(share, 4, look.look.share);
        look.look.eye[1] = 0.08f, look.look.eye[2] = 0.1f;
        look.look.rate = 0;
    }
    Vector3d eye() const { return {0, 1.65, 0.13}; }
};
// The bodies of a crowd of these: where they look, and their joints.
struct UprightCrowd {
    Crowd crowd;
    std::vector<std::array<Float4, 4>> rotations;

    UprightCrowd(const Upright& of, std::size_t count)
        : crowd(of.skeleton.view(), static_cast<std::uint32_t>(count), std::span(&of.look, 1)), rotations(count)
    {
        reset();
    }
    void reset()
    {
        std::ranges::fill(rotations, std::array<Float4, 4>{{{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}}});
    }
    void solve(const std::vector<Float3>& targets, float time = 0)
    {
        swivel_pose pose = swivel_default_pose();
        pose.rotations = {rotations.data(), sizeof rotations[0], sizeof(Float4), nullptr};
        pose.time = {&time, 0};
        crowd.write(SWIVEL_LOOK_TARGET, 0, std::span(targets));
        crowd.solve({.pose = &pose});
    }
    // Where the line of sight starts and where it points, by forward kinematics.
    std::pair<Vector3d, Vector3d> sight(const Upright& of, std::size_t n) const
    {
        Quaterniond turn = Quaterniond::Identity();
        Vector3d place = Vector3d::Zero();
        for (std::size_t joint = 0; joint < 4; ++joint) {
            place += turn * vec(of.skeleton.translations[joint]);
            turn = turn * quat(rotations[n][joint]).normalized();
        }
        return {place + turn * vec(of.look.look.eye), turn * vec(of.look.look.axis)};
    }
    Vector3d line(std::size_t n)
    {
        Float6 sight;
        check(swivel_read(crowd.get(), SWIVEL_SIGHT, 0, static_cast<std::uint32_t>(n), 1, {&sight, sizeof sight}));
        return {sight[3], sight[4], sight[5]};
    }
    std::uint32_t flags(std::uint32_t n)
    {
        std::uint32_t flags;
        check(swivel_read(crowd.get(), SWIVEL_FLAGS, 0, n, 1, {&flags, sizeof flags}));
        return flags;
    }
};

}  // namespace swivel::test
