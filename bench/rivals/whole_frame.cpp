// SPDX-License-Identifier: MIT
#include "bench/rivals/whole_frame.h"

#include <algorithm>
#include <cmath>

#include "bench/rivals/check.h"
#include "bench/rivals/limbs.h"

namespace bench {

namespace {

constexpr float kUpper = 0.30f, kFore = 0.26f;

// Bones along +x on the left and -x on the right; both bend forwards, towards +z.
swivel_binding binding(float side) { return arm_along_x(side * kUpper, side * kFore); }
Rig rig(float side)
{
    const swivel_binding b = binding(side);
    Rig rig{kUpper, kFore, {side * kUpper, 0, 0}, {side * kFore, 0, 0}, {}, {}, {}};
    std::copy_n(b.parent_from_arm, 4, rig.parent_from_arm);
    std::copy_n(b.upper_from_arm, 4, rig.upper_from_arm);
    std::copy_n(b.fore_from_arm, 4, rig.fore_from_arm);
    return rig;
}

using Poses = std::vector<CharacterPose>;
using Goals = std::vector<CharacterGoal>;
swivel::Streams frame(const Poses& world, const Goals& goals, Poses& local, std::size_t side)
{
    constexpr std::size_t pose = sizeof(CharacterPose), goal = sizeof(CharacterGoal);
    swivel::Streams frame;
    frame.in(SWIVEL_TARGET, {goals[0].arm[side].wrist, goal})
        .in(SWIVEL_POLE, {goals[0].arm[side].pole, goal})
        .in(SWIVEL_SHOULDER_POSITION, {world[0].arm[side].shoulder.position, pose})
        .in(SWIVEL_PARENT_ROTATION, {world[0].chest.rotation, pose})
        .in(SWIVEL_PARENT_SCALE, {world[0].chest.scale, pose})
        .out(SWIVEL_SHOULDER, {local[0].arm[side].shoulder.rotation, pose})
        .out(SWIVEL_ELBOW, {local[0].arm[side].elbow.rotation, pose});
    return frame;
}

FramedCrowd make_framed(const Poses& world, const Goals& goals, Poses& local)
{
    const auto count = static_cast<std::uint32_t>(world.size());
    swivel_limb_def left = swivel::limbs(count, kResident), right = left;
    left.binding = binding(1);
    right.binding = binding(-1);
    swivel::Crowd crowd({left, right});
    for (std::uint32_t side = 0; side < kArms; ++side) crowd.write_all(SWIVEL_LENGTHS, side, std::array{kUpper, kFore});
    return {std::move(crowd), {frame(world, goals, local, 0), frame(world, goals, local, 1)}};
}

void store(const float (&v)[3], float (&to)[4]) { std::copy_n(v, 3, to); }

}  // namespace

WholeFrame::WholeFrame(std::size_t character_count)
    : world_(character_count),
      local_(character_count),
      goals_(character_count),
      rigs_{rig(1), rig(-1)},
      framed_(make_framed(world_, goals_, local_))
{
    const std::vector<Limb> limbs = random_limbs(arm_count());
    for (std::size_t n = 0; n < character_count; ++n) {
        const Limb& chest = limbs[kArms * n];
        store(chest.position, world_[n].chest.position);
        std::copy_n(chest.rotation, 4, world_[n].chest.rotation);
        std::fill_n(world_[n].chest.scale, 3, chest.scale[0]);
        for (std::size_t side = 0; side < kArms; ++side) {
            const Limb& limb = limbs[kArms * n + side];
            const float offset[3] = {side == 0 ? 0.2f : -0.2f, 0.1f, 0};
            const float resize = (kUpper + kFore) / (limb.lengths[0] + limb.lengths[1]);
            float shoulder[3], wrist[3], pole[3];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                shoulder[axis] = offset[axis];
                wrist[axis] = offset[axis] + resize * limb.target[axis];
                pole[axis] = offset[axis] + limb.pole[axis];
            }
            to_world(chest, shoulder), to_world(chest, wrist), to_world(chest, pole);
            store(shoulder, world_[n].arm[side].shoulder.position);
            store(wrist, goals_[n].arm[side].wrist);
            store(pole, goals_[n].arm[side].pole);
        }
    }
}

double WholeFrame::worst_error() const
{
    double worst = 0;
    for (std::size_t n = 0; n < world_.size(); ++n)
        for (std::size_t side = 0; side < kArms; ++side) {
            const auto& local = local_[n].arm[side];
            const Rig& rig = rigs_[side];
            const double scale = world_[n].chest.scale[0], length = scale * (rig.upper + rig.fore);
            const Vec shoulder = vec(world_[n].arm[side].shoulder.position);
            const Vec wanted = vec(goals_[n].arm[side].wrist) - shoulder;
            // The bones are nearly equal: whatever is not stretched or folded is reached.
            if (const double share = norm(wanted) / length; share < 0.15 || share > 0.98) continue;
            const Vec fore = vec(rig.elbow_offset) + turn(local.elbow.rotation, vec(rig.wrist_offset));
            const Vec wrist = scale * turn(world_[n].chest.rotation, turn(local.shoulder.rotation, fore));
            const double error = norm(wrist - wanted) / length;
            if (!std::isfinite(error)) return INFINITY;
            worst = std::fmax(worst, error);
        }
    return worst;
}

void WholeFrame::spoil()
{
    for (CharacterPose& pose : local_)
        for (auto& arm : pose.arm) {
            std::fill_n(arm.shoulder.rotation, 4, NAN);
            std::fill_n(arm.elbow.rotation, 4, NAN);
        }
}

}  // namespace bench
