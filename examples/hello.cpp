// SPDX-License-Identifier: MIT
// Two arms, from nothing to their rotations. The README shows this program.
#include <cstdio>
#include <swivel/swivel.hpp>

int main()
{
    const float targets[2][3] = {{0.3f, 0.1f, 0.3f}, {0.0f, 0.2f, 9.0f}};  // for the wrists; the second is out of reach
    const float pole[3] = {0, -1, 0}, lengths[2] = {0.30f, 0.26f};         // upper arm, forearm
    swivel::Crowd crowd({swivel::limbs(2)});  // group 0: two arms, in the arm frame, whose origin is the shoulder
    crowd.write(SWIVEL_TARGET, 0, targets);
    crowd.write_all(SWIVEL_POLE, 0, pole);
    crowd.write_all(SWIVEL_LENGTHS, 0, lengths);
    crowd.solve();
    float shoulder[2][4];  // x, y, z, w
    double off[2];         // from target to wrist, in arm lengths
    crowd.read(SWIVEL_SHOULDER, 0, shoulder);
    crowd.residuals(0, off);
    std::printf("wrists off by %.7f and %.1f\n", off[0], off[1]);
}
