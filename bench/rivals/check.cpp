// SPDX-License-Identifier: MIT
#include "bench/rivals/check.h"

namespace bench {

double worst_error(std::span<const Limb> limbs, const Poses& poses)
{
    double worst = 0;
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        const Limb& limb = limbs[n];
        if (!limb.ordinary) continue;
        const double q[4] = {poses[0][n], poses[1][n], poses[2][n], poses[3][n]}, c = poses[4][n], s = poses[5][n];
        const double upper = limb.lengths[0], fore = limb.lengths[1];
        const Vec elbow = turn(q, {0, 0, upper});
        const Vec wrist = turn(q, {0, 2 * c * s * fore, upper + (c * c - s * s) * fore});
        const Vec target = vec(limb.target), pole = vec(limb.pole);
        const double error = norm(wrist - target) / (upper + fore);
        // Both measured from the target's line.
        const bool right_side = dot(elbow, pole) - dot(target, elbow) * dot(target, pole) / dot(target, target) > 0;
        if (!right_side || !std::isfinite(error)) return INFINITY;
        worst = std::fmax(worst, error);
    }
    return worst;
}

}  // namespace bench
