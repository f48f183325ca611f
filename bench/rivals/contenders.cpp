// SPDX-License-Identifier: MIT
#include "bench/rivals/contenders.h"

namespace bench {

namespace {

struct LoopRun {
    Arms arms;
    Poses poses;
};
Contender loop_contender(const Level& level, const Loop& loop, std::span<const Limb> limbs)
{
    const auto run = std::make_shared<LoopRun>(LoopRun{arms_of(limbs), Poses(limbs.size())});
    const auto poses = [run] {
        Poses copy(run->poses.count());
        for (std::size_t row = 0; row < 7; ++row)
            for (std::size_t n = 0; n < copy.count(); ++n) copy[row][n] = run->poses[row][n];
        return copy;
    };
    return {loop.name, level.name, [run, solve = loop.solve] { solve(run->arms, run->poses); }, poses};
}

struct SingleRun {
    std::vector<SingleArm> arms;
    std::vector<SinglePose> poses;
};
Contender single_contender(const Level& level, std::span<const Limb> limbs)
{
    const auto run =
        std::make_shared<SingleRun>(SingleRun{single_arms_of(limbs), std::vector<SinglePose>(limbs.size())});
    const auto poses = [run] {
        Poses copy(run->poses.size());
        for (std::size_t n = 0; n < copy.count(); ++n) {
            const SinglePose& pose = run->poses[n];
            for (std::size_t c = 0; c < 4; ++c) copy[c][n] = pose.shoulder[c];
            copy[4][n] = pose.cos_half, copy[5][n] = pose.sin_half;
        }
        return copy;
    };
    const auto solve = [run, one_by_one = level.solve_single] {
        one_by_one(run->arms.data(), run->poses.data(), run->arms.size());
    };
    return {"single_glm", level.name, solve, poses};
}

}  // namespace

std::vector<Contender> contenders(const Level& level, std::span<const Limb> limbs)
{
    std::vector<Contender> all;
    for (const Loop& loop : level.loops) all.push_back(loop_contender(level, loop, limbs));
    all.push_back(single_contender(level, limbs));
    return all;
}

}  // namespace bench
