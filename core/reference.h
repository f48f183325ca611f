#pragma once
// SPDX-License-Identifier: MIT
//
// The oracle: the five steps of D. Hildenbrand, "Inverse Kinematics of a Virtual Character" (TU Darmstadt, 2019), to
// the letter, in double, on 32-coefficient multivectors. It is slow and obviously right, and shares no code with the
// solvers that are checked against it. The caller must avoid degenerate poses: see ReferenceArm.

namespace swivel {

// A goal in the arm's frame: shoulder at the origin; at rest both bones lie along +e3, the hinge is e1, and flexion
// carries the forearm towards +e2. Lengths and coordinates share one unit, any. The pose must not be singular:
//   the wrist is reachable, and not at the shoulder;
//   the pole is not along the wrist's line;
//   the arm is neither straight nor folded;
//   the upper arm is not along +e3 or -e3, where p_ze and p_e have no middle line.
// The lecture's formulas lose digits towards these. We measured the wrist's error relative to upper + fore. An upper
// arm at an angle t from +e3 gives up to 4e-15 / t. A twist theta3 at an angle t from 0 or pi gives up to 3e-16 / t.
// Nothing is checked or clamped. A singular pose may give NaN, and so may a twist of 0 or pi whose c3 rounds past 1.
struct ReferenceArm {
    double wrist[3];
    double pole[3];  // the elbow lies on this point's side of the wrist's line
    double upper, fore;
};

// The answer. Rotors are unit quaternions in x, y, z, w order; their overall sign is the formulas' own.
struct ReferencePose {
    double elbow[3];
    double cos_flexion;        // c4, cosine of the angle between the bones
    double elbow_rotor[4];     // q_e, about the hinge
    double middle_rotor[4];    // q12, by pi about the middle line: e3 to the upper arm
    double twist_rotor[4];     // q3, about e3: puts the forearm into the swivel plane
    double shoulder_rotor[4];  // q_s = q12 q3: e3 to the upper arm, e1 to the swivel plane's normal
};

// Rotations that put the wrist on its target. Allocates nothing; threads may call it together; about 0.1 ms.
ReferencePose solve_reference(const ReferenceArm& arm);

}  // namespace swivel
