// SPDX-License-Identifier: MIT
#include "tools/corpus/recipes.h"

namespace swivel::corpus {

namespace {

using enum Field;
using enum Part;

// clang-format off
constexpr Recipe kOrdinary[] = {
    {ordinary, "arms", 0xd1a6e55e9b9b1325u, 0, {target, pole, lengths}, {shoulder, elbow, flags}},
    {ordinary, "compact", 0x566bf9d7c55a45f8u, kCompact, {target, pole, lengths}, {shoulder, elbow, flags}},
    {ordinary, "joints", 0xcf0c26ef4243ed52u, kJoints, {target, pole, lengths}, {shoulder, elbow, flags}},
    {ordinary, "joints-compact", 0x5d96cf7f265beda9u, kJoints | kCompact,
     {target, pole, lengths}, {shoulder, elbow, flags}},
    {ordinary, "hand", 0xc1d77cffb7decc0cu, kHand, {target, pole, lengths, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "hand-compact", 0x5e6a0a2edd70e34du, kHand | kCompact,
     {target, pole, lengths, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "joints-hand", 0x0463513755ac0ecdu, kJoints | kHand,
     {target, pole, lengths, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "joints-hand-compact", 0xb37523a53b4a3ee2u, kJoints | kHand | kCompact,
     {target, pole, lengths, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "world", 0x4de45321ad915a36u, kWorld,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {ordinary, "world-compact", 0x9823beb1e6ba3ad7u, kWorld | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {ordinary, "world-joints", 0xdd4eabbd1fcfb980u, kWorld | kJoints,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {ordinary, "world-joints-compact", 0x683447c10cc8af11u, kWorld | kJoints | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {ordinary, "world-hand", 0xbfb637dd5bae2d26u, kWorld | kHand,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "world-hand-compact", 0xaed09b824ca87fc2u, kWorld | kHand | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "world-joints-hand", 0x158d003d9a0b2361u, kWorld | kJoints | kHand,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "world-joints-hand-compact", 0x1ff135342e825ce1u, kWorld | kJoints | kHand | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "world-direction", 0x33f5f28807f0cbd4u, kWorld | kPoleDirection,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {ordinary, "world-direction-compact", 0x00d9f4ad53a2f2b6u, kWorld | kPoleDirection | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {ordinary, "world-joints-direction", 0x4cc346363c234038u, kWorld | kJoints | kPoleDirection,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {ordinary, "world-joints-direction-compact", 0xd330a5494d14cf1au, kWorld | kJoints | kPoleDirection | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {ordinary, "world-hand-direction", 0x668dc8f46a423cf9u, kWorld | kHand | kPoleDirection,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "world-hand-direction-compact", 0xd178403035c9a8c4u, kWorld | kHand | kPoleDirection | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "world-joints-hand-direction", 0x765890e0f94855d0u, kWorld | kJoints | kHand | kPoleDirection,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {ordinary, "world-joints-hand-direction-compact", 0xaf5d8bb09f2e9ea4u, kWorld | kJoints | kHand | kPoleDirection |
     kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
};
// clang-format on

// clang-format off
constexpr Recipe kHard[] = {
    {hard, "arms", 0xa9dfdec6baecde5bu, 0, {target, pole, lengths}, {shoulder, elbow, flags}},
    {hard, "compact", 0x699f071a5fd8e665u, kCompact, {target, pole, lengths}, {shoulder, elbow, flags}},
    {hard, "joints", 0xf82d5644ef7d9967u, kJoints, {target, pole, lengths}, {shoulder, elbow, flags}},
    {hard, "joints-compact", 0xfdfb462fd6fad8dbu, kJoints | kCompact,
     {target, pole, lengths}, {shoulder, elbow, flags}},
    {hard, "hand", 0xdb18bd763f20134cu, kHand, {target, pole, lengths, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "hand-compact", 0x0e46c215b5fa5b0cu, kHand | kCompact,
     {target, pole, lengths, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "joints-hand", 0xbf416c30f1f0742au, kJoints | kHand,
     {target, pole, lengths, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "joints-hand-compact", 0x422acab59248b974u, kJoints | kHand | kCompact,
     {target, pole, lengths, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "world", 0x476354b65ed08d6bu, kWorld,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {hard, "world-compact", 0x3a7cfb366088155fu, kWorld | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {hard, "world-joints", 0x37c990fad57dcafdu, kWorld | kJoints,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {hard, "world-joints-compact", 0x26ad41ef88c279d9u, kWorld | kJoints | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {hard, "world-hand", 0x6dbb8cb8ef65ed78u, kWorld | kHand,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "world-hand-compact", 0x0e0bc896afbec9a6u, kWorld | kHand | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "world-joints-hand", 0xdd63d2a5d1764460u, kWorld | kJoints | kHand,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "world-joints-hand-compact", 0xda0aea0eaa72870bu, kWorld | kJoints | kHand | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "world-direction", 0x07bda21c604af42au, kWorld | kPoleDirection,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {hard, "world-direction-compact", 0xd17737815438a5b5u, kWorld | kPoleDirection | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {hard, "world-joints-direction", 0xeee45145f585675fu, kWorld | kJoints | kPoleDirection,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {hard, "world-joints-direction-compact", 0x84d0c3f0b2e73ae0u, kWorld | kJoints | kPoleDirection | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale}, {shoulder, elbow, flags}},
    {hard, "world-hand-direction", 0x5c80f9be67fd4c1eu, kWorld | kHand | kPoleDirection,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "world-hand-direction-compact", 0xaa5bf36518677db7u, kWorld | kHand | kPoleDirection | kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "world-joints-hand-direction", 0xea394aba6a42ed19u, kWorld | kJoints | kHand | kPoleDirection,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
    {hard, "world-joints-hand-direction-compact", 0x70faf36fb78eda4fu, kWorld | kJoints | kHand | kPoleDirection |
     kCompact,
     {target, pole, lengths, parent_position, parent_rotation, parent_scale, hand}, {shoulder, elbow, wrist, flags}},
};
// clang-format on

}  // namespace

std::span<const Recipe> ordinary_recipes() { return kOrdinary; }
std::span<const Recipe> hard_recipes() { return kHard; }

}  // namespace swivel::corpus
