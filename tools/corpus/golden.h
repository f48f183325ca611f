// SPDX-License-Identifier: MIT
//
// The bits that every CPU must give. A crowd's number changes only where results change for everyone: that needs an
// entry under "Results changed" in CHANGELOG.md and at least a minor version. A new crowd adds its number and changes
// those of its whole part, without a changed result. `print_digest golden` prints this file's numbers.
#pragma once

#include <cstdint>
#include <span>

#include "tools/corpus/recipe.h"

namespace swivel::corpus {

// In the order of enum Part: the digests of a part's crowds below, folded.
inline constexpr std::uint64_t kGoldenDigests[] = {
    0x102ddd89a848eeecu,  // ordinary
    0x4c9cfe4793c94983u,  // hard
    0x137adefff955795du,  // limbs
    0x8efc18ec3aee43f3u,  // bodies
    0xeda726784abc4d9eu,  // standing
};

// The standing part's start, which stands for it under emulators.
inline constexpr std::uint64_t kGoldenStart = 0x338e2c75073e182cu;

// Crowd by crowd, in the order of recipes_of(), so that a failure has a name.
// clang-format off
inline constexpr std::uint64_t kGoldenOrdinary[] = {
    0x8f42e445ca55828cu, 0xb763c08b56522a61u, 0x53ca587833d49664u, 0x493a6f8ec5b5b20eu, 0xad53867289b0a06au,
    0x72a44888f7218206u, 0xf96806b25bab67c0u, 0x2362847a789c128cu, 0x14fde413ca1cf3eeu, 0xf3e0e53d01dcc915u,
    0xfca607b9e2f967cau, 0xab8ee62512f5f3d8u, 0x87cdc0be60613c18u, 0x8d2aa0a5618212b7u, 0x14cf7ec48ef2eba0u,
    0xf5d229ec3b705895u, 0x384e2953e1755bc8u, 0xd60b13347f7cf7d9u, 0x0f38c9a5c48c190du, 0xc8be5210ca915978u,
    0x8babefb8dc8040b8u, 0x28bcb46a6eb7c433u, 0xab1f26e5eaa49553u, 0xf096e77c6062290bu
};
inline constexpr std::uint64_t kGoldenHard[] = {
    0xf9737d9d15bac74du, 0x697bb3cd6311f98au, 0xb4593a90e17d7ed6u, 0x41c2810cf93f67f9u, 0x971ed58991b5c875u,
    0x2689945344480f7bu, 0x532228da1669d6feu, 0x5431c67faebdba67u, 0x19d3ca48f8def2c2u, 0xb4f6c60865979003u,
    0x4272eed1cd922523u, 0xd8b274771653d896u, 0xac5b35a207251274u, 0x79a6564fc123de3au, 0xa66d64d79f9434e9u,
    0x008584bda80301e1u, 0xa44f80961ae3c45fu, 0x059c4649fed68656u, 0x99f8728c0e67450eu, 0x66bda62cbd334220u,
    0x7517880e9e33959fu, 0x365104b69e0936e9u, 0xe6bc5afef8690ab9u, 0x029f040312dd2950u
};
inline constexpr std::uint64_t kGoldenLimbs[] = {
    0x87c9eb9cb734c506u, 0x13d0a08f05d11bedu, 0xd636519b0b8e372cu, 0xee8e30dcea6d3bfau, 0xd762ebe0d44b800fu,
    0x5b7ac894ea66764au, 0x8fe421596b0cb72du, 0x5882b060e84693b3u, 0x9a3d5af671910fa7u, 0xfe79cc62f8ff45f6u,
    0x3c4c85b5223d2fcfu, 0xebb3cbc607ddb097u, 0x7f2c351081b87096u, 0x0d68980e157d2a25u, 0x8f56d18562078dbfu,
    0x70c12cfc18fe70c4u, 0x2ee10b4d84ff30ddu, 0x5d5e66438f4991c6u, 0xb44fd43d970cf6f3u, 0x408695d02787baddu,
    0xadfa384b1c2ba3fcu, 0xee6256124ac6bacbu, 0x78f44f31ec5a18a3u, 0x2118fefc8b51e907u, 0x7a7aaed815a57216u,
    0x45c58bdf1f5b9cacu, 0xbab71de9e0e6aac5u, 0xf4acbb12a6e72293u, 0x39cd14968dd5f0d0u, 0x14a7350acb8a88eeu,
    0xb5bec9e4426fdfc7u, 0x82277d25eabc6cbbu, 0x644cbefbde98fbbbu, 0x1cf4e67e8fd25c3du, 0xf37aab46e11b2195u,
    0x257db8b85b965a2bu, 0x642f387b76fb44afu, 0xcc02b93dac888aa7u, 0xdc96419940fe6966u, 0xb75044d59e57d2fdu,
    0x7f1c014fb2cf3f77u, 0x42f2db8f2145212eu, 0x2527f6abcb5d54d6u, 0x23e866acb6d58cadu, 0x0ff64a155a8a1a21u,
    0xd67df4747f157157u, 0x418e5732874cfb0au, 0xf3457aff5c58f46bu, 0xa0b3ab16ef65e51du, 0x6f976b20bc4f2349u,
    0x85c5b743006a6bf7u, 0x69bed976b47b7d44u, 0x9efaccc5266f7870u, 0x1abbeee8747cf0fdu, 0x84a6924fa0b5faacu,
    0x2e8fac3f3b5e7530u, 0xb1348f833e291908u, 0x7be9355e38b87d1eu, 0x9af83723aaa9708du
};
inline constexpr std::uint64_t kGoldenBodies[] = {
    0x8c2c7c22522967c7u, 0xc1f1f2c196fea9a9u, 0xbf5290e66677003au, 0xc5eaf77490bc7aa2u, 0xb0b265a0488dad02u,
    0x4b0894a0f4a18f73u, 0xba687366bcdb713du, 0x2fe48a488a550787u, 0xb52d7452422d0bcfu, 0x3fe5e34473663918u,
    0x984977a13a66dfebu, 0x903fb20b5e8348b6u, 0xdbb358e73a83a900u, 0x6f87191102be2949u, 0xd8895edf7caaae74u,
    0xba82a2786b745549u, 0x72e8abf22124bd2fu, 0x736e771cfe76b794u, 0xa008e68060cc36cbu, 0x30a4b957ade15a74u,
    0xea6a343f15002cd1u, 0x7d8db9054f82b11cu, 0xce30bf8f3447aa9au, 0x138de9d6ed62aaaau, 0x678238a080bcc51fu,
    0xb40af945b1d500e5u, 0xd6bc009a480ca1c5u, 0xa836b306df336821u, 0x2ab12ec3ed32ba19u, 0x0030462c33c4ec86u,
    0x41c65f70bc6cea66u, 0x241d3c1de87b5c3cu, 0x7270ce6a09130ea8u, 0xfc0dc4473fc8d634u, 0x7a18dfd82cb5a9c7u,
    0x3458410b3ca0c0ebu, 0x9e99e255f2f70b35u, 0x22926f270346e8c5u, 0xd340930d9f2cfc21u, 0x10d3a056742db283u,
    0x5a65fc8c689395cdu, 0x88011486bea8c6a1u, 0xaf9ba9c5dd4b83f3u, 0x17466e39996f3b63u
};
inline constexpr std::uint64_t kGoldenStanding[] = {
    0x5d9861cd0c1184c4u, 0x87e5d93e23d6e525u, 0x5c570d1c1b50d9c1u, 0xa057236c25769ed7u, 0x0905034d133b1622u,
    0x2e33e76266aab744u, 0x84b5c74bdddadfc8u, 0xc6595e36ae0eebbfu, 0xc4ae7d80f27fc3c5u, 0xa565063480e3524bu,
    0xf87cb90d614a8f5au, 0x34892d532a08ae04u
};
// clang-format on
inline constexpr std::span<const std::uint64_t> kGoldenCrowds[] = {kGoldenOrdinary, kGoldenHard, kGoldenLimbs,
                                                                   kGoldenBodies, kGoldenStanding};

}  // namespace swivel::corpus
