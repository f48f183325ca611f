// SPDX-License-Identifier: MIT
//
// The promise on real motion: each frame of each shared clip is a body. With its own wrists and ankles as targets it
// comes back as it was, and no joint turns between two frames as the clip does not. Eigen poses both, in double.
#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>

#include "tests/clip_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;
using formats::Clip;

// Two ways to leave elbows where they come: to give no pole, and to give one without weight.
constexpr swivel_features kOwnElbows[] = {SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING,
                                          SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS};

// The frames after a solve whose goals are their own wrists and hands.
std::vector<Body> solved(const ClipBodies& clip, swivel_features features)
{
    Crowd crowd = body_crowd(clip.skeleton, features, static_cast<std::uint32_t>(clip.frames.size()));
    BodyGoals goals(clip.skeleton.limbs.size());
    for (std::uint32_t limb = 0; limb < goals.size(); ++limb) {
        for (const Body& body : clip.frames) goals[limb].push_back(own_goal(clip.skeleton, body, limb));
        if (features & SWIVEL_WITH_WEIGHTS) crowd.write_all(SWIVEL_WEIGHTS, limb, Float3{1, 1, 0});
    }
    write_goals(crowd, goals);
    PoseLayout layout;
    layout.translates = layout.scales = true;
    PoseBuffer poses(layout, clip.frames);
    solve_poses(crowd, poses.view());
    std::uint32_t group = 0, limb = 0;
    CHECK(!swivel_find(crowd.get(), SWIVEL_BAD_INPUT, &group, &limb));
    std::vector<Body> bodies;
    for (std::size_t n = 0; n < clip.frames.size(); ++n) bodies.push_back(poses.read(n, clip.frames[n]));
    return bodies;
}

void require_same(const ClipBodies& clip, const std::vector<Body>& bodies)
{
    for (std::size_t n = 0; n < bodies.size(); ++n) {
        const std::vector<JointAt> was = joints_at(clip.skeleton, clip.frames[n]),
                                   is = joints_at(clip.skeleton, bodies[n]);
        for (const BodyLimbJoints& limb : clip.skeleton.limbs)
            REQUIRE(strayed(LimbAt(clip.skeleton, clip.frames[n], was, limb), limb, was, is) <= 1);
    }
}

void solve_back(const Clip& clip, std::size_t limb_count, const Words& options = {})
{
    const ClipBodies bodies(clip, options);
    REQUIRE(bodies.skeleton.limbs.size() == limb_count);
    for (const swivel_features features : kOwnElbows) require_same(bodies, solved(bodies, features));
}

// A joint's turn from the frame before, in degrees, relative to its parent.
double turn_to(const std::vector<Body>& frames, std::size_t n, std::uint32_t joint)
{
    const auto rotation = [&](std::size_t frame) { return quat(frames[frame].rotations[joint]).normalized(); };
    return rotation(n).angularDistance(rotation(n - 1)) * 180 / std::numbers::pi;
}

}  // namespace

TEST_CASE("untouched goals give back every frame of the shared clips and figures' animations")
{
    for_each_shared_clip([](const std::string& name, const Clip& clip, std::size_t limb_count, const Words& options) {
        INFO(name);
        solve_back(clip, limb_count, options);
    });
}

TEST_CASE("a clip's own wrists turn no joint of a limb between two frames as the clip does not")
{
    // Its knees are bent by some degrees, to either side. Measured: 0.003 degrees more than the clip.
    const fs::path path = find_or_warn("m2m_human_ymca.glb");
    if (path.empty()) return;
    const ClipBodies clip(read_clip(path).clip);
    for (const swivel_features features : kOwnElbows) {
        const std::vector<Body> bodies = solved(clip, features);
        for (std::size_t n = 1; n < bodies.size(); ++n)
            for (const BodyLimbJoints& limb : clip.skeleton.limbs)
                for (const std::uint32_t joint : {limb.shoulder, limb.elbow, limb.wrist})
                    REQUIRE(turn_to(bodies, n, joint) <= turn_to(clip.frames, n, joint) + 1);
    }
}
