// SPDX-License-Identifier: MIT
#include "tools/corpus/recipe.h"

#include <array>
#include <cstdint>
#include <iterator>

namespace swivel::corpus {

namespace {

using enum Part;

// One kind of crowd, which the ordinary and the hard part both have.
struct PlainCrowd {
    const char* name;
    std::uint64_t ordinary_seed, hard_seed;
    std::uint64_t features;
};

// clang-format off
constexpr PlainCrowd kPlainCrowds[] = {
    {"arms", 0xd1a6e55e9b9b1325u, 0xa9dfdec6baecde5bu, 0},
    {"compact", 0x566bf9d7c55a45f8u, 0x699f071a5fd8e665u, kCompact},
    {"joints", 0xcf0c26ef4243ed52u, 0xf82d5644ef7d9967u, kJoints},
    {"joints-compact", 0x5d96cf7f265beda9u, 0xfdfb462fd6fad8dbu, kJoints | kCompact},
    {"hand", 0xc1d77cffb7decc0cu, 0xdb18bd763f20134cu, kHand},
    {"hand-compact", 0x5e6a0a2edd70e34du, 0x0e46c215b5fa5b0cu, kHand | kCompact},
    {"joints-hand", 0x0463513755ac0ecdu, 0xbf416c30f1f0742au, kJoints | kHand},
    {"joints-hand-compact", 0xb37523a53b4a3ee2u, 0x422acab59248b974u, kJoints | kHand | kCompact},
    {"world", 0x4de45321ad915a36u, 0x476354b65ed08d6bu, kWorld},
    {"world-compact", 0x9823beb1e6ba3ad7u, 0x3a7cfb366088155fu, kWorld | kCompact},
    {"world-joints", 0xdd4eabbd1fcfb980u, 0x37c990fad57dcafdu, kWorld | kJoints},
    {"world-joints-compact", 0x683447c10cc8af11u, 0x26ad41ef88c279d9u, kWorld | kJoints | kCompact},
    {"world-hand", 0xbfb637dd5bae2d26u, 0x6dbb8cb8ef65ed78u, kWorld | kHand},
    {"world-hand-compact", 0xaed09b824ca87fc2u, 0x0e0bc896afbec9a6u, kWorld | kHand | kCompact},
    {"world-joints-hand", 0x158d003d9a0b2361u, 0xdd63d2a5d1764460u, kWorld | kJoints | kHand},
    {"world-joints-hand-compact", 0x1ff135342e825ce1u, 0xda0aea0eaa72870bu, kWorld | kJoints | kHand | kCompact},
    {"world-direction", 0x33f5f28807f0cbd4u, 0x07bda21c604af42au, kWorld | kPoleDirection},
    {"world-direction-compact", 0x00d9f4ad53a2f2b6u, 0xd17737815438a5b5u, kWorld | kPoleDirection | kCompact},
    {"world-joints-direction", 0x4cc346363c234038u, 0xeee45145f585675fu, kWorld | kJoints | kPoleDirection},
    {"world-joints-direction-compact", 0xd330a5494d14cf1au, 0x84d0c3f0b2e73ae0u, kWorld | kJoints | kPoleDirection | kCompact},
    {"world-hand-direction", 0x668dc8f46a423cf9u, 0x5c80f9be67fd4c1eu, kWorld | kHand | kPoleDirection},
    {"world-hand-direction-compact", 0xd178403035c9a8c4u, 0xaa5bf36518677db7u, kWorld | kHand | kPoleDirection | kCompact},
    {"world-joints-hand-direction", 0x765890e0f94855d0u, 0xea394aba6a42ed19u, kWorld | kJoints | kHand | kPoleDirection},
    {"world-joints-hand-direction-compact", 0xaf5d8bb09f2e9ea4u, 0x70faf36fb78eda4fu, kWorld | kJoints | kHand | kPoleDirection | kCompact},
};
// clang-format on

constexpr auto plain_recipes_of(Part part)
{
    std::array<Recipe, std::size(kPlainCrowds)> recipes = {};
    for (std::size_t n = 0; n < recipes.size(); ++n) {
        const PlainCrowd& crowd = kPlainCrowds[n];
        const std::uint64_t seed = part == ordinary ? crowd.ordinary_seed : crowd.hard_seed;
        recipes[n] = {part, crowd.name, seed, crowd.features};
    }
    return recipes;
}
constexpr auto kOrdinary = plain_recipes_of(ordinary), kHard = plain_recipes_of(hard);

}  // namespace

std::span<const Recipe> ordinary_recipes() { return kOrdinary; }
std::span<const Recipe> hard_recipes() { return kHard; }

}  // namespace swivel::corpus
