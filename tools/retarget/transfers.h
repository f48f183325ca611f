// SPDX-License-Identifier: MIT
//
// What each joint of a skeleton takes from which joint of another. Knows figures at rest, no motion.
#pragma once

#include <optional>
#include <vector>

#include "tools/retarget/joint_pairs.h"
#include "tools/retarget/rest_figure.h"

namespace swivel::tools {

// A target's joint turns from rest as a source's joint does, or as what lies between two.
struct Transfer {
    int before = -1, after = -1;  // joints of the source; before -1: the world, which never turns
    double share = 1;             // of the way from `before` to `after`
    // The target's rest brought to the source's, in the figure's axes: first this turn, then the source's.
    Eigen::Quaterniond align = Eigen::Quaterniond::Identity();
};

// A figure at rest, and how it stands.
struct StandingFigure {
    const formats::Clip& clip;
    const RestFigure& rest;
    const Stance& stance;
};

// One for each joint of the target; nothing: it keeps its rest. Where a part has n joints and m in the target, the m
// divide the part's turns evenly among them: its last joint turns as the source's last does.
// Limbs and fingers are aligned bone by bone, each by the least turn beyond that of the joint above. A foot is aligned
// so that it is flat where the source's is. Where one of the two does not say when it is flat, it takes the source's
// direction. Hips, spine, neck, head and clavicles are not aligned: both figures rest upright, whatever the shape of
// their backs.
std::vector<std::optional<Transfer>> transfers_of(const JointPairs& pairs, const StandingFigure& source,
                                                  const StandingFigure& target);

}  // namespace swivel::tools
