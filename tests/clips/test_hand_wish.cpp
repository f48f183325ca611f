// SPDX-License-Identifier: MIT
//
// The promise of SWIVEL_POLE_HAND on real motion: elbows that follow the hands are nearer to the clip's own than with
// the best pole that stays where it is, wherever elbows move. None moves more in a frame than three times as far as the
// clip's do at most.
#include <catch2/catch.hpp>

#include <numbers>

#include "tests/clip_bodies.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// A clip's arm: places from the shoulder, in its parent's frame, for each frame.
struct ClipArm {
    std::vector<Vector3d> elbow, wrist, solved;
    double upper = 0, fore = 0;

    ClipArm(const ClipBodies& clip, std::size_t limb)
    {
        const BodyLimbJoints& joints = clip.skeleton.limbs[limb];
        const auto parent = static_cast<std::uint32_t>(clip.skeleton.parents[joints.shoulder]);
        swivel_group_def def = group(static_cast<std::uint32_t>(clip.frames.size()),
                                     swivel::bind(clip.skeleton.view(), clip.skeleton.joints(limb)),
                                     SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_POLE_HAND);
        Crowd crowd(def);
        std::vector<Vector3d> shoulders;
        std::vector<Quaterniond> parents;
        for (std::uint32_t n = 0; n < clip.frames.size(); ++n) {
            const std::vector<JointAt> at = joints_at(clip.skeleton, clip.frames[n]);
            const Vector3d shoulder = at[joints.shoulder].place;
            const auto put = [&](swivel_field field, const auto& value) {
                crowd.write(field, 0, std::span(&value, 1), n);
            };
            upper = (at[joints.elbow].place - shoulder).norm();
            fore = (at[joints.wrist].place - at[joints.elbow].place).norm();
            put(SWIVEL_TARGET, floats(at[joints.wrist].place));
            put(SWIVEL_HAND, floats(at[joints.wrist].rotation));
            put(SWIVEL_SHOULDER_POSITION, floats(shoulder));
            put(SWIVEL_PARENT_ROTATION, floats(at[parent].rotation));
            put(SWIVEL_LENGTHS, Float2{static_cast<float>(upper), static_cast<float>(fore)});
            shoulders.push_back(shoulder);
            parents.push_back(at[parent].rotation.conjugate());
            elbow.push_back(parents[n] * (at[joints.elbow].place - shoulder));
            wrist.push_back(parents[n] * (at[joints.wrist].place - shoulder));
        }
        crowd.solve();
        std::vector<std::array<double, 3>> elbows(clip.frames.size());
        crowd.elbows(0, elbows);
        for (std::size_t n = 0; n < elbows.size(); ++n)
            solved.push_back(parents[n] * (Vector3d(elbows[n].data()) - shoulders[n]));
    }
    double length() const { return upper + fore; }
    double mean_miss(const std::vector<Vector3d>& elbows) const
    {
        double sum = 0;
        for (std::size_t n = 0; n < elbows.size(); ++n) sum += (elbows[n] - elbow[n]).norm();
        return sum / static_cast<double>(elbows.size());
    }
    // The elbows with a pole that stays in this direction.
    std::vector<Vector3d> with_pole(const Vector3d& pole) const
    {
        std::vector<Vector3d> made;
        for (std::size_t n = 0; n < wrist.size(); ++n) {
            const double d = wrist[n].norm(), along = (upper * upper + d * d - fore * fore) / (2 * d);
            const Vector3d line = wrist[n] / d, side = (pole - pole.dot(line) * line).normalized();
            made.push_back(along * line + std::sqrt(std::max(upper * upper - along * along, 0.0)) * side);
        }
        return made;
    }
    double best_miss() const
    {
        constexpr int kPoles = 1000;
        double best = 1e9;
        for (int n = 0; n < kPoles; ++n) {
            const double z = 1 - (2 * n + 1.0) / kPoles, turn = n * std::numbers::pi * (3 - std::sqrt(5.0)),
                         r = std::sqrt(1 - z * z);
            best = std::min(best, mean_miss(with_pole({r * std::cos(turn), r * std::sin(turn), z})));
        }
        return best;
    }
};
double largest_step(const std::vector<Vector3d>& places)
{
    double most = 0;
    for (std::size_t n = 1; n < places.size(); ++n) most = std::max(most, (places[n] - places[n - 1]).norm());
    return most;
}

TEST_CASE("on shared clips, elbows that follow hands are nearer than with the best fixed pole, and move smoothly")
{
    // Where a fixed pole is within this share of the arm, the elbow hardly moves. A hand whose wrist bends does not
    // tell it better then.
    constexpr double kStill = 0.015;
    int judged = 0;
    const bool all = for_each_shared_clip(
        [&](const std::string& name, const formats::Clip& clip, std::size_t, const Words& options) {
            const ClipBodies bodies(clip, options, "arms");
            for (std::size_t limb = 0; limb < bodies.skeleton.limbs.size(); ++limb) {
                const ClipArm arm(bodies, limb);
                const double miss = arm.mean_miss(arm.solved), best = arm.best_miss();
                INFO(name << ", arm " << limb << ": " << miss / arm.length() << " of the arm, the best fixed pole "
                          << best / arm.length() << ", step " << largest_step(arm.solved) / arm.length()
                          << ", the clip's " << largest_step(arm.elbow) / arm.length());
                CHECK(largest_step(arm.solved) <= 3 * largest_step(arm.elbow) + 1e-3 * arm.length());
                if (best < kStill * arm.length()) {
                    CHECK(miss <= 0.1 * arm.length());
                } else {
                    CHECK(miss <= 0.7 * best);
                    ++judged;
                }
            }
        });
    if (all) CHECK(judged >= 6);
}

}  // namespace
