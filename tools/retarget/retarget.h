// SPDX-License-Identifier: MIT
//
// Puts a clip's motion on another skeleton: rotations by transfers, the hips by the ratio of leg lengths, and goals of
// hands and feet. Knows clips and rigs, no solver.
#pragma once

#include <optional>
#include <vector>

#include "tools/formats/targets_csv.h"
#include "tools/retarget/transfers.h"

namespace swivel::tools {

// How high the joints are that feet stand on, along each figure's up, from its world's origin: toes, or ankles where a
// foot of either has no toes.
struct GroundHeights {
    double source, target;
    bool of_toes;
};

struct Retargeted {
    formats::Clip clip;                   // the target, with the source's frames; its hips alone move against a parent
    int hips = -1;                        // of the target
    double leg_ratio = 1;                 // lengths of the target for one of the source
    std::optional<GroundHeights> ground;  // none if the source's ground is unknown
    // Wrists and ankles, of the limbs that both have: their places in the target's world, and where elbow and knee
    // lean. [frame * limbs.size() + limb]
    std::vector<formats::Target> goals;
    std::vector<formats::Target> eased;  // the goals to solve, which differ near pops of knees and elbows
    std::vector<formats::LimbName> limbs;
};

// Joints turn as transfers_of() says; those without a partner rest. The world is scaled about the origin by the ratio
// of leg lengths. It is turned from the source's left, up and forwards to the target's. If both stances say their
// height, it is raised: feet that stand in the source then stand on the target's ground. In that world
// - toes, or else ankles, go to the source's places, so that standing feet stand. The target's own foot then gives its
//   ankle's place;
// - the hips go to where the middle of the hip joints is the source's. Flat feet may differ in length and height: by
//   that the hips are moved, in the pelvis's axes. Then they are moved so that knees bend as in the source.
// The latter is by least squares of the knees' angles, and of the way that this takes, which is at most a tenth of a
// leg. The leg that is straighter has more weight, because a length tells more of its angle.
// Wrists have the source's place from the shoulder, times the ratio of arm lengths. An arm that is bent, its wrist
// nearer than 0.7 of its length, has it from the middle of the shoulders. So hands that meet still meet. From 0.7 to
// 0.95 the one fades into the other.
// Goals are eased in this: no knee or elbow turns faster than the source's by more than 360 degrees a second, or than
// that one's fastest turn.
//
// target: its frames tell its stance alone. Both need hips and a leg: throws std::invalid_argument without. Bones of
// limbs that both have need a length. Scales of the target's joints rest, too. Memory: the clip's, and the goals'.
Retargeted retarget(const formats::Clip& source, const formats::Clip& target, const JointPairs& pairs);

}  // namespace swivel::tools
