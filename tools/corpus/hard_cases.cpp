// SPDX-License-Identifier: MIT
#include "tools/corpus/hard_cases.h"

#include <iterator>

namespace swivel::corpus {

namespace {

struct HardCase {
    const char* name;
    Arm arm;
};

// Poses in the arm frame; with parents, in that of a parent that does nothing.
// clang-format off
const HardCase kPoses[] = {
    {.name = "exactly straight", .arm = {.target = {0, 0, 2}, .pole = {0, -1, 0}, .lengths = {1, 1}}},
    {.name = "exactly straight, other bones", .arm = {.target = {3, 0, 0}, .pole = {0, -1, 0}, .lengths = {1, 2}}},
    {.name = "exactly folded", .arm = {.target = {0, 0, 1}, .pole = {0, -1, 0}, .lengths = {2, 1}}},
    {.name = "exactly folded, longer forearm", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {1, 2}}},
    {.name = "equal bones, target on the shoulder", .arm = {.target = {0, 0, 0}, .pole = {0, -1, 0}, .lengths = {1, 1}}},
    {.name = "unequal bones, target on the shoulder", .arm = {.target = {0, 0, 0}, .pole = {0, -1, 0}, .lengths = {1, 2}}},
    {.name = "target nearly on the shoulder", .arm = {.target = {0, 1e-7f, 0}, .pole = {1, 0, 0}, .lengths = {1, 1}}},
    {.name = "target shorter than anything counts", .arm = {.target = {0, 1e-16f, 0}, .pole = {1, 0, 0}, .lengths = {1, 1}}},
    {.name = "target a denormal", .arm = {.target = {1e-40f, 0, 0}, .pole = {0, -1, 0}, .lengths = {1, 1}}},
    {.name = "zero upper arm, reached", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {0, 1}}},
    {.name = "zero upper arm, too far", .arm = {.target = {0, 2, 0}, .pole = {1, 0, 0}, .lengths = {0, 1}}},
    {.name = "zero upper arm, too near", .arm = {.target = {0, 0.5f, 0}, .pole = {1, 0, 0}, .lengths = {0, 1}}},
    {.name = "zero upper arm, on the shoulder", .arm = {.target = {0, 0, 0}, .pole = {1, 0, 0}, .lengths = {0, 1}}},
    {.name = "zero forearm, reached", .arm = {.target = {0, 0, -1}, .pole = {1, 0, 0}, .lengths = {1, 0}}},
    {.name = "zero forearm, too far", .arm = {.target = {3, 0, 0}, .pole = {0, -1, 0}, .lengths = {1, 0}}},
    {.name = "zero forearm, too near", .arm = {.target = {0.5f, 0, 0}, .pole = {0, -1, 0}, .lengths = {1, 0}}},
    {.name = "zero forearm, on the shoulder", .arm = {.target = {0, 0, 0}, .pole = {0, -1, 0}, .lengths = {1, 0}}},
    {.name = "both bones zero", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {0, 0}}},
    {.name = "both bones zero, on the shoulder", .arm = {.target = {0, 0, 0}, .pole = {0, -1, 0}, .lengths = {0, 0}}},
    {.name = "upper arm of 3e-12", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {3e-12f, 1}}},
    {.name = "forearm of 3e-12", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {1, 3e-12f}}},
    {.name = "both bones of 3e-12", .arm = {.target = {0, 3e-12f, 0}, .pole = {1, 0, 0}, .lengths = {3e-12f, 3e-12f}}},
    {.name = "both bones of 3e-12, target at 1", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {3e-12f, 3e-12f}}},
    {.name = "upper arm of 1e-15", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {1e-15f, 1}}},
    {.name = "everything 1e15", .arm = {.target = {0, 1e15f, 0}, .pole = {1e15f, 0, 0}, .lengths = {1e15f, 1e15f}}},
    {.name = "everything 1e15, straight", .arm = {.target = {0, 1e15f, 0}, .pole = {1e15f, 0, 0}, .lengths = {5e14f, 5e14f}}},
    {.name = "1e15 and 1", .arm = {.target = {0, 1, 0}, .pole = {1e15f, 0, 0}, .lengths = {1e15f, 1e15f}}},
    {.name = "1e15 and 1e-15", .arm = {.target = {0, 1e15f, 0}, .pole = {1e-15f, 0, 0}, .lengths = {1e-15f, 1e15f}}},
    {.name = "everything about 1e-15", .arm = {.target = {0, 2e-15f, 0}, .pole = {2e-15f, 0, 0}, .lengths = {2e-15f, 2e-15f}}},
    {.name = "everything about 1e-15, too far", .arm = {.target = {0, 9e-15f, 0}, .pole = {2e-15f, 0, 0}, .lengths = {2e-15f, 2e-15f}}},
    {.name = "1e15 away from bones of 1e-15", .arm = {.target = {0, 0, 1e15f}, .pole = {0, -1, 0}, .lengths = {1e-15f, 1e-15f}}},
    {.name = "pole along the target", .arm = {.target = {0, 1, 1}, .pole = {0, 2, 2}, .lengths = {1, 1}}},
    {.name = "pole opposite the target", .arm = {.target = {0, 1, 1}, .pole = {0, -2, -2}, .lengths = {1, 1}}},
    {.name = "pole along a target along e1", .arm = {.target = {1, 0, 0}, .pole = {2, 0, 0}, .lengths = {1, 1}}},
    {.name = "pole along a target along -e1", .arm = {.target = {-1, 0, 0}, .pole = {2, 0, 0}, .lengths = {1, 1}}},
    {.name = "pole just inside sin 1e-3", .arm = {.target = {0, 0, 1}, .pole = {0, 0.999e-3f, 1}, .lengths = {1, 1}}},
    {.name = "pole just outside sin 1e-3", .arm = {.target = {0, 0, 1}, .pole = {0, 1.001e-3f, 1}, .lengths = {1, 1}}},
    {.name = "pole just inside, opposite", .arm = {.target = {1, 0, 0}, .pole = {-1, 0, 0.999e-3f}, .lengths = {1, 1}}},
    {.name = "pole just outside, opposite", .arm = {.target = {1, 0, 0}, .pole = {-1, 0, 1.001e-3f}, .lengths = {1, 1}}},
    {.name = "no pole", .arm = {.target = {0, 1, 1}, .pole = {0, 0, 0}, .lengths = {1, 1}}},
    {.name = "no pole, target along e1", .arm = {.target = {1, 0, 0}, .pole = {0, 0, 0}, .lengths = {1, 1}}},
    {.name = "pole shorter than anything counts", .arm = {.target = {0, 0, 1}, .pole = {1e-19f, 0, 0}, .lengths = {1, 1}}},
    {.name = "pole of 1e-14", .arm = {.target = {0, 0, 1}, .pole = {0, 1e-14f, 0}, .lengths = {1, 1}}},
    {.name = "pole of 1e15", .arm = {.target = {0, 0, 1}, .pole = {0, 1e15f, 0}, .lengths = {1, 1}}},
    {.name = "target along e3", .arm = {.target = {0, 0, 1.5f}, .pole = {0, -1, 0}, .lengths = {1, 1}}},
    {.name = "target along -e3", .arm = {.target = {0, 0, -1.5f}, .pole = {0, -1, 0}, .lengths = {1, 1}}},
    {.name = "target along -e3, other poles", .arm = {.target = {0, 0, -1.5f}, .pole = {1, 1, 0}, .lengths = {1, 1}}},
    {.name = "upper arm exactly e3", .arm = {.target = {0, 1, 1}, .pole = {0, 0, 1}, .lengths = {1, 1}}},
    {.name = "upper arm exactly -e3", .arm = {.target = {0, 1, -1}, .pole = {0, 0, -1}, .lengths = {1, 1}}},
    {.name = "upper arm exactly -e3, straight", .arm = {.target = {0, 0, -2}, .pole = {0, -1, 0}, .lengths = {1, 1}}},
    {.name = "upper arm exactly -e3, hinge e2", .arm = {.target = {0, 0, -2}, .pole = {1, 0, 0}, .lengths = {1, 1}}},
    {.name = "upper arm exactly -e3, folded", .arm = {.target = {0, 0, -1}, .pole = {1, 0, 0}, .lengths = {2, 1}}},
    {.name = "upper arm a hair off -e3", .arm = {.target = {1e-7f, 0, -2}, .pole = {0, 1, 0}, .lengths = {1, 1}}},
    {.name = "upper arm level", .arm = {.target = {2, 0, 0}, .pole = {0, 0, -1}, .lengths = {1, 1}}},
    {.name = "target beyond reach", .arm = {.target = {0, 5, 0}, .pole = {1, 0, 0}, .lengths = {1, 1}}},
    {.name = "target beyond reach, pole undefined", .arm = {.target = {0, 5, 0}, .pole = {0, 1, 0}, .lengths = {1, 1}}},
    {.name = "target an ulp beyond reach", .arm = {.target = {0, 0, 2.0000002f}, .pole = {0, -1, 0}, .lengths = {1, 1}}},
    {.name = "target too near", .arm = {.target = {0, 0.5f, 0}, .pole = {1, 0, 0}, .lengths = {2, 1}}},
    {.name = "target too near, longer forearm", .arm = {.target = {0, 0.5f, 0}, .pole = {1, 0, 0}, .lengths = {1, 2}}},
    {.name = "target an ulp too near", .arm = {.target = {0, 0, 0.99999994f}, .pole = {0, -1, 0}, .lengths = {2, 1}}},
    {.name = "minus zeros", .arm = {.target = {-0.0f, -0.0f, 1.5f}, .pole = {-0.0f, -1, -0.0f}, .lengths = {1, 1}}},
    {.name = "minus zeros everywhere", .arm = {.target = {-0.0f, -0.0f, -0.0f}, .pole = {-0.0f, -0.0f, -0.0f}, .lengths = {-0.0f, -0.0f}}},
    {.name = "minus zero lengths", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {-0.0f, 1}}},
    {.name = "1000 : 1, in reach", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {1, 1e-3f}}},
    {.name = "1 : 1000, in reach", .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {1e-3f, 1}}},
    {.name = "both bones zero, pole undefined",      .arm = {.target = {0, 1, 0}, .pole = {0, 1, 0}, .lengths = {0, 0}}},
    {.name = "1e15 and a bit more",                  .arm = {.target = {0, 1.0001e15f, 0}, .lengths = {1, 1}}},
    {.name = "longer than 1e15 by two components",   .arm = {.target = {0.8e15f, 0.8e15f, 0}, .lengths = {1, 1}}},
    {.name = "pole a bit longer than 1e15",          .arm = {.pole = {0, 1.0001e15f, 0}}},
    {.name = "upper arm a bit longer than 1e15",     .arm = {.lengths = {1.0001e15f, 1}}},
    {.name = "forearm a bit longer than 1e15",       .arm = {.lengths = {1, 1.0001e15f}}},
    {.name = "upper arm a bit shorter than 1e-15",   .arm = {.lengths = {0.999e-15f, 1}}},
    {.name = "forearm a bit shorter than 1e-15",     .arm = {.lengths = {1, 0.999e-15f}}},
    {.name = "upper arm below zero",                 .arm = {.lengths = {-1, 1}}},
    {.name = "forearm below zero",                   .arm = {.lengths = {1, -1e-3f}}},
    {.name = "bones of 1e7 to 1, longer upper arm",  .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {1, 1e-7f}}},
    {.name = "bones of 1e7 to 1, longer forearm",    .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {1e-7f, 1}}},
    {.name = "bones just above 1e-7 to 1",           .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {1, 1.001e-7f}}},
    {.name = "bones just below 1e-7 to 1",           .arm = {.target = {0, 1, 0}, .pole = {1, 0, 0}, .lengths = {0.999e-7f, 1}}},
    {.name = "bones of 1e6 to 1",                    .arm = {.target = {0.6f, 0, 0.8f}, .pole = {1, 0, 0}, .lengths = {1, 1e-6f}}},
    {.name = "bones of 1000 to 1, folded",           .arm = {.target = {0, 0.999f, 0}, .pole = {1, 0, 0}, .lengths = {1, 1e-3f}}},
    {.name = "an ulp from straight",                 .arm = {.target = {0, 0, 1.9999999f}, .pole = {0, -1, 0}, .lengths = {1, 1}}},
    {.name = "an ulp from folded",                   .arm = {.target = {0, 0, 1.0000001f}, .pole = {0, -1, 0}, .lengths = {2, 1}}},
    {.name = "equal bones, folded to 1e-9",          .arm = {.target = {0, 2e-9f, 0}, .pole = {1, 0, 0}, .lengths = {1, 1}}},
    {.name = "equal bones, folded below 1e-9",       .arm = {.target = {0, 1e-10f, 0}, .pole = {1, 0, 0}, .lengths = {1, 1}}},
    {.name = "wrist at the plain formula's least",   .arm = {.target = {0, 3.2e-5f, 0}, .pole = {1, 0, 0}, .lengths = {1, 1}}},
    {.name = "wrist below the plain formula's least", .arm = {.target = {0, 3.1e-5f, 0}, .pole = {1, 0, 0}, .lengths = {1, 1}}},
    {.name = "wrist at the plain formula's most",    .arm = {.target = {0, 5900, 0}, .pole = {1, 0, 0}, .lengths = {3000, 3000}}},
    {.name = "wrist beyond the plain formula's most", .arm = {.target = {0, 5950, 0}, .pole = {1, 0, 0}, .lengths = {3000, 3000}}},
    {.name = "pole at the plain formula's most",     .arm = {.target = {0, 1, 0}, .pole = {3.4e7f, 0, 0}, .lengths = {1, 1}}},
    {.name = "pole beyond the plain formula's most", .arm = {.target = {0, 1, 0}, .pole = {3.6e7f, 0, 0}, .lengths = {1, 1}}},
    {.name = "pole at the plain formula's least",    .arm = {.target = {0, 1, 0}, .pole = {1.1e-9f, 0, 0}, .lengths = {1, 1}}},
    {.name = "pole below the plain formula's least", .arm = {.target = {0, 1, 0}, .pole = {0.9e-9f, 0, 0}, .lengths = {1, 1}}},
    {.name = "bones at the plain formula's least",   .arm = {.target = {0, 1e-4f, 0}, .pole = {1, 0, 0}, .lengths = {1e-9f, 1e-4f}}},
    {.name = "bones below the plain formula's least", .arm = {.target = {0, 1e-4f, 0}, .pole = {1, 0, 0}, .lengths = {4e-10f, 1e-4f}}},
    {.name = "pole off a slanted line, inside",      .arm = {.target = {0.6f, 0, 0.8f}, .pole = {0.6f, 0.999e-3f, 0.8f}}},
    {.name = "pole off a slanted line, outside",     .arm = {.target = {0.6f, 0, 0.8f}, .pole = {0.6f, 1.001e-3f, 0.8f}}},
    {.name = "upper arm half a turn away",           .arm = {.target = {1, 0, -1}, .pole = {0, 0, -1}, .lengths = {1, 1}}},
    {.name = "everything a denormal",                .arm = {.target = {1e-40f, 2e-40f, 0}, .pole = {0, 3e-40f, 0}, .lengths = {1e-40f, 1e-40f}}},
    {.name = "everything NaN",                       .arm = {.target = {kNan, kNan, kNan}, .pole = {kNan, kNan, kNan}, .lengths = {kNan, kNan}}},
    {.name = "everything infinite",                  .arm = {.target = {kInf, -kInf, kInf}, .pole = {-kInf, kInf, kInf}, .lengths = {kInf, kInf}}},
};

// Parents and hands, in crowds that have them.
const HardCase kFrames[] = {
    {.name = "parent of length 1e-9",          .arm = {.parent_rotation = {0.6e-9f, 0, 0, 0.8001e-9f}}},
    {.name = "parent of length 1e9",           .arm = {.parent_rotation = {0.6e9f, 0, 0, 0.7999e9f}}},
    {.name = "parent shorter than 1e-9",       .arm = {.parent_rotation = {0.6e-9f, 0, 0, 0.799e-9f}}},
    {.name = "parent longer than 1e9",         .arm = {.parent_rotation = {0.6e9f, 0, 0, 0.801e9f}}},
    {.name = "parent of no length",            .arm = {.parent_rotation = {0, 0, 0, 0}}},
    {.name = "parent of minus zeros",          .arm = {.parent_rotation = {-0.0f, -0.0f, -0.0f, -0.0f}}},
    {.name = "parent's square just above 0.5", .arm = {.parent_rotation = {0, 0.5001f, 0, 0.5001f}}},
    {.name = "parent's square just below 0.5", .arm = {.parent_rotation = {0, 0.4999f, 0, 0.4999f}}},
    {.name = "parent's square just below 2",   .arm = {.parent_rotation = {0, 0, 0.9999f, 0.9999f}}},
    {.name = "parent's square just above 2",   .arm = {.parent_rotation = {0, 0, 1.0001f, 1.0001f}}},
    {.name = "parent turned half about e1",    .arm = {.parent_rotation = {1, 0, 0, 0}}},
    {.name = "parent turned half about e2",    .arm = {.parent_rotation = {0, 1, 0, -0.0f}}},
    {.name = "parent negated",                 .arm = {.parent_rotation = {0, 0, 0, -1}}},
    {.name = "parent of scale 1e-5",           .arm = {.target = {1e-5f, 0, 0}, .pole = {0, 1e-5f, 0}, .parent_scale = {1e-5f}}},
    {.name = "parent of scale below 1e-5",     .arm = {.target = {1e-5f, 0, 0}, .pole = {0, 1e-5f, 0}, .parent_scale = {0.999e-5f}}},
    {.name = "parent of scale 1e5",            .arm = {.target = {1e5f, 0, 0}, .pole = {0, 1e5f, 0}, .parent_scale = {1e5f}}},
    {.name = "parent of scale above 1e5",      .arm = {.target = {1e5f, 0, 0}, .pole = {0, 1e5f, 0}, .parent_scale = {1.001e5f}}},
    {.name = "parent of scale 1e-15",          .arm = {.target = {1e-15f, 0, 0}, .pole = {0, 1e-15f, 0}, .parent_scale = {1e-15f}}},
    {.name = "parent of scale 1e15",           .arm = {.target = {0.9e15f, 0, 0}, .pole = {0, 1e14f, 0}, .parent_scale = {1e15f}}},
    {.name = "parent of scale below 1e-15",    .arm = {.parent_scale = {0.9e-15f}}},
    {.name = "parent of scale above 1e15",     .arm = {.parent_scale = {1.001e15f}}},
    {.name = "parent of no scale",             .arm = {.parent_scale = {0}}},
    {.name = "parent of scale minus zero",     .arm = {.parent_scale = {-0.0f}}},
    {.name = "parent of scale -1",             .arm = {.parent_scale = {-1}}},
    {.name = "target too long for the parent", .arm = {.target = {1e14f, 0, 0}, .parent_scale = {0.01f}}},
    {.name = "pole too long for the parent",   .arm = {.pole = {0, 1e14f, 0}, .parent_scale = {0.01f}}},
    {.name = "both long, not too long",        .arm = {.target = {1e12f, 0, 0}, .pole = {0, 1e12f, 0}, .parent_scale = {0.01f}}},
    {.name = "parent 1e4 away",                .arm = {.target = {10000.5f, 10000, 1}, .pole = {10000, 9999, 1}, .parent_position = {10000, 10000, 0}}},
    {.name = "parent 1e6 away",                .arm = {.target = {1000001, 0, 0.5f}, .pole = {1000000, 1, 0}, .parent_position = {1000000, 0, 0}}},
    {.name = "parent 2^24 away",               .arm = {.target = {0, 0x1.000002p24f, 0}, .pole = {1, 0x1p24f, 0}, .parent_position = {0, 0x1p24f, 0}}},
    {.name = "parent 1e13 away",               .arm = {.target = {1e13f, 1, 0}, .pole = {1e13f, 0, 1}, .parent_position = {1e13f, 0, 0}}},
    {.name = "parent beyond 1e13",             .arm = {.target = {1.1e13f, 1, 0}, .pole = {1.1e13f, 0, 1}, .parent_position = {1.1e13f, 0, 0}}},
    {.name = "parent 1e15 away",               .arm = {.target = {0, -1e15f, 1}, .pole = {0, -1e15f, -1}, .parent_position = {0, -1e15f, 0}}},
    {.name = "parent further than 1e15",       .arm = {.parent_position = {0.6e15f, 0.6e15f, 0.6e15f}}},
    {.name = "target at the parent",           .arm = {.target = {3, 4, 5}, .pole = {3, 4, 6}, .parent_position = {3, 4, 5}}},
    {.name = "pole at the parent",             .arm = {.target = {3, 4, 6}, .pole = {3, 4, 5}, .parent_position = {3, 4, 5}}},
    {.name = "target and pole at the parent",  .arm = {.target = {3, 4, 5}, .pole = {3, 4, 5}, .parent_position = {3, 4, 5}}},
    {.name = "hand of length 1e-9",            .arm = {.hand = {0, 0.6e-9f, 0, 0.8001e-9f}}},
    {.name = "hand of length 1e9",             .arm = {.hand = {0, 0.6e9f, 0, 0.7999e9f}}},
    {.name = "hand shorter than 1e-9",         .arm = {.hand = {0, 0.6e-9f, 0, 0.799e-9f}}},
    {.name = "hand longer than 1e9",           .arm = {.hand = {0, 0.6e9f, 0, 0.801e9f}}},
    {.name = "hand and parent of length 1e-9", .arm = {.parent_rotation = {0, 0, 1.001e-9f, 0}, .hand = {1.001e-9f, 0, 0, 0}}},
    {.name = "hand and parent of length 1e9",  .arm = {.parent_rotation = {0, 0, 0.999e9f, 0}, .hand = {0.999e9f, 0, 0, 0}}},
    {.name = "hand of no length",              .arm = {.hand = {0, 0, 0, 0}}},
    {.name = "hand of minus zeros",            .arm = {.hand = {-0.0f, -0.0f, -0.0f, -0.0f}}},
    {.name = "hand at rest, straight arm",     .arm = {.target = {0, 0, 2}, .pole = {0, -1, 0}, .lengths = {1, 1}, .hand = {0, 0, 0, 1}}},
    {.name = "hand turned half about e1",      .arm = {.target = {0, 0, 2}, .pole = {0, -1, 0}, .lengths = {1, 1}, .hand = {1, 0, 0, 0}}},
    {.name = "hand turned half about -e3",     .arm = {.target = {0, 0, 2}, .pole = {0, -1, 0}, .lengths = {1, 1}, .hand = {0, 0, -1, -0.0f}}},
};
// clang-format on

constexpr float kBad[] = {kNan, kInf, -kInf, -0.0f, 1e-45f, -1e-38f, 1e-20f, 3e38f};
// Numbers that spoil values: some of them good.
constexpr float kSpoiling[] = {0.0f,  -0.0f,  1e-15f, -3e-12f, 1e-38f, 1e-45f, 1.0f,  -1.0f,
                               1e15f, -1e15f, 2e15f,  3e38f,   kNan,   kInf,   -kInf, 0.5f};

constexpr std::uint32_t kPoseCount = std::size(kPoses), kFrameCount = std::size(kFrames), kBadCount = std::size(kBad),
                        kArmNumbers = 20;
static_assert(kLimbCaseCount <= kPoseCount);

// Number c of a good arm replaced.
Arm with_number(std::uint32_t c, float bad)
{
    Arm arm;
    for (const swivel_field field : kArmFields) {
        const std::span<float> values = arm.values(field);
        if (c < values.size()) values[c] = bad;
        c -= static_cast<std::uint32_t>(values.size());
        if (c >= kArmNumbers) break;  // it has wrapped around
    }
    return arm;
}

// Powers of two and signed permutations of axes are exact.
Arm moved(const Arm& arm, std::uint32_t pass)
{
    constexpr float sizes[] = {1, 0x1p10f, 0x1p-10f, 0x1p30f, 0x1p-30f};
    const float size = sizes[pass % 5], sign = pass % 2 == 0 ? 1.0f : -1.0f;
    Arm to = arm;
    for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t from = (c + pass) % 3;
        to.target[c] = size * (c == 0 ? sign : 1.0f) * arm.target[from];
        to.pole[c] = size * (c == 0 ? sign : 1.0f) * arm.pole[from];
    }
    for (float& length : to.lengths) length *= size;
    return to;
}

}  // namespace

std::uint32_t hard_case_count() { return kPoseCount + kFrameCount + kArmNumbers * kBadCount; }

Arm hard_case(std::uint32_t n)
{
    const std::uint32_t pass = n / hard_case_count();
    n %= hard_case_count();
    if (n < kPoseCount) return moved(kPoses[n].arm, pass);
    n -= kPoseCount;
    if (n < kFrameCount) return kFrames[n].arm;
    n -= kFrameCount;
    return with_number(n / kBadCount, kBad[n % kBadCount]);
}

void spoil(Random& random, std::span<float> values, std::uint32_t one_in)
{
    for (float& x : values)
        if (random.below(one_in) == 0) x = kSpoiling[random.below(std::size(kSpoiling))];
}
void spoil(Random& random, std::span<double> values, std::uint32_t one_in)
{
    for (double& x : values)
        if (random.below(one_in) == 0) x = double{kSpoiling[random.below(std::size(kSpoiling))]};
}

}  // namespace swivel::corpus
