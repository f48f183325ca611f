// SPDX-License-Identifier: MIT
//
// The bits that every CPU must give. Changing a number here changes results for everyone: it needs an entry under
// "Results changed" in CHANGELOG.md and at least a minor version. `print_digest golden` prints this file's tables.
#pragma once

#include <cstdint>

#include "tools/corpus/recipe.h"

namespace swivel::corpus {

// In the order of enum Part: the digests of a part's crowds below, folded.
inline constexpr std::uint64_t kGoldenDigests[] = {
    0x088cf2619f2f0762u,  // ordinary
    0x87e7298f5f910d37u,  // hard
    0x552179a41bd435bdu,  // limbs
};

// Crowd by crowd, so that a failure has a name.
struct GoldenCrowd {
    Part part;
    const char* name;
    std::uint64_t digest;
};
inline constexpr GoldenCrowd kGoldenCrowds[] = {
    {Part::ordinary, "arms", 0xc53b31053f40f6a9u},
    {Part::ordinary, "compact", 0x86e1d16b0cb30480u},
    {Part::ordinary, "joints", 0x8be582be0ddddcc4u},
    {Part::ordinary, "joints-compact", 0xc23a9143bd96a9f0u},
    {Part::ordinary, "hand", 0x02c7f04cbbd0a7e0u},
    {Part::ordinary, "hand-compact", 0xf734c93a151debc0u},
    {Part::ordinary, "joints-hand", 0xb09323d31aaf972au},
    {Part::ordinary, "joints-hand-compact", 0x78eeceb9f895639au},
    {Part::ordinary, "world", 0xd89a249948fdb8a7u},
    {Part::ordinary, "world-compact", 0xbc032cc2d0d6d35au},
    {Part::ordinary, "world-joints", 0x45788decbb643f48u},
    {Part::ordinary, "world-joints-compact", 0xcd3ce02193326ccfu},
    {Part::ordinary, "world-hand", 0xe98e2eafa729ba66u},
    {Part::ordinary, "world-hand-compact", 0xf31ad75f0bbfb9eeu},
    {Part::ordinary, "world-joints-hand", 0xfd98f4a059352a35u},
    {Part::ordinary, "world-joints-hand-compact", 0xa019bf1de0938b82u},
    {Part::ordinary, "world-direction", 0x71ddd77fd4064e33u},
    {Part::ordinary, "world-direction-compact", 0xd70cb1ced36162a8u},
    {Part::ordinary, "world-joints-direction", 0xb410ca9bb0eb53fau},
    {Part::ordinary, "world-joints-direction-compact", 0xad97b9fcbf4f81b0u},
    {Part::ordinary, "world-hand-direction", 0x8db3541c3b98f012u},
    {Part::ordinary, "world-hand-direction-compact", 0x0ff3f3f6112bf680u},
    {Part::ordinary, "world-joints-hand-direction", 0xe85c85db7895f2a8u},
    {Part::ordinary, "world-joints-hand-direction-compact", 0xbcb19be474780c46u},
    {Part::hard, "arms", 0x243fea54a6d2a9c1u},
    {Part::hard, "compact", 0x7c14fa116515ed3eu},
    {Part::hard, "joints", 0x7f0cb9012bc1e8feu},
    {Part::hard, "joints-compact", 0x9392008d4ca2256du},
    {Part::hard, "hand", 0xb48780c2e1558dc3u},
    {Part::hard, "hand-compact", 0x3ceeb808c425b6bau},
    {Part::hard, "joints-hand", 0xe4fb09d94cf0a828u},
    {Part::hard, "joints-hand-compact", 0xa17df0abac9e4a51u},
    {Part::hard, "world", 0xfecd9ca39cb9d740u},
    {Part::hard, "world-compact", 0x0567554bb02855e1u},
    {Part::hard, "world-joints", 0xfee34e2cbb5bd0edu},
    {Part::hard, "world-joints-compact", 0x3126396d51011033u},
    {Part::hard, "world-hand", 0x3e231c4462fc8c36u},
    {Part::hard, "world-hand-compact", 0xb0edb792aafb80f6u},
    {Part::hard, "world-joints-hand", 0x3c975a003e049b56u},
    {Part::hard, "world-joints-hand-compact", 0x1a55f3568cff5155u},
    {Part::hard, "world-direction", 0x1c2597ed87f2ed9au},
    {Part::hard, "world-direction-compact", 0x66daf917d9d9fb20u},
    {Part::hard, "world-joints-direction", 0xae4fe09b823c04b0u},
    {Part::hard, "world-joints-direction-compact", 0xf8a85665877572feu},
    {Part::hard, "world-hand-direction", 0x043962b26a0dd1dbu},
    {Part::hard, "world-hand-direction-compact", 0xde5a74c3c9d051f5u},
    {Part::hard, "world-joints-hand-direction", 0xfa63445b83f63964u},
    {Part::hard, "world-joints-hand-direction-compact", 0xce09fe7d9564030du},
    {Part::limbs, "effector", 0xe7f190e674c54672u},
    {Part::limbs, "angle", 0x6419354c6e89afe5u},
    {Part::limbs, "pole-normal", 0x467c215418dc9f1au},
    {Part::limbs, "incoming", 0x274ca0f594d94f91u},
    {Part::limbs, "incoming-hand", 0x9f2cc166a351b4c3u},
    {Part::limbs, "pole-incoming", 0x5904cb61d6f6a9b1u},
    {Part::limbs, "weights", 0x151c345350dbd2b8u},
    {Part::limbs, "weights-hand", 0xdea4ae309ba3b6a4u},
    {Part::limbs, "reach", 0xa214ae7d76f5b0d8u},
    {Part::limbs, "step", 0x71a032f78b0919a6u},
    {Part::limbs, "flexion", 0xe53b6b88e23a9242u},
    {Part::limbs, "shoulder-cone", 0xbee82a4194592742u},
    {Part::limbs, "humeral-twist", 0x931d7849703ffd49u},
    {Part::limbs, "shoulder-box-xyz", 0x11ff8742fe7d6577u},
    {Part::limbs, "shoulder-box-xzy", 0x52982310a11c73d5u},
    {Part::limbs, "shoulder-box-yzx", 0x5c966eeaebdd2dc3u},
    {Part::limbs, "shoulder-box-yxz", 0x9eaa75343cb10d57u},
    {Part::limbs, "shoulder-box-zxy", 0x38605240b35f843bu},
    {Part::limbs, "shoulder-box-zyx", 0xb9901809f89a0a90u},
    {Part::limbs, "hand-cone", 0xed7121703ec239feu},
    {Part::limbs, "forearm-twist", 0xd4b1aabf7cd1e0fdu},
    {Part::limbs, "hand-twist", 0xeb9ba97e259b374eu},
    {Part::limbs, "wrist-box-xyz", 0x50d8dd05b2155e00u},
    {Part::limbs, "wrist-box-xzy", 0x169052d6866fb289u},
    {Part::limbs, "wrist-box-yzx", 0x205dd64d45dd8454u},
    {Part::limbs, "wrist-box-yxz", 0xfd339ed4088da05du},
    {Part::limbs, "wrist-box-zxy", 0xf45dd875056819dau},
    {Part::limbs, "wrist-box-zyx", 0x5800861887f965b0u},
    {Part::limbs, "twist-bones-1", 0x9dea3addf1f52a1bu},
    {Part::limbs, "twist-bones-3", 0x0ee4efd65dfd9b1du},
    {Part::limbs, "twist-bones-7", 0x0e0fd1f1ca5fab9bu},
    {Part::limbs, "twist-bones-3-joints", 0x5759f7484effb256u},
    {Part::limbs, "aim", 0x5b78987ba525674du},
    {Part::limbs, "aim-hand", 0x28906f562b034b55u},
    {Part::limbs, "clavicle", 0x632da86696c6957au},
    {Part::limbs, "angle-world-direction", 0xf3eda7d09d8b828eu},
    {Part::limbs, "compact-angle", 0xc5f7613f30497e67u},
    {Part::limbs, "compact-limits", 0xa3b401e9fb7246a7u},
    {Part::limbs, "set-incoming", 0x43eb0a988253d3f3u},
    {Part::limbs, "set-world-joints-normal-angle-step", 0x54497bdc79f02007u},
    {Part::limbs, "set-joints-hand-incoming-pole-flexion-reach", 0xe3b0babd4f5cbb45u},
    {Part::limbs, "set-shoulder-cone", 0xf3adeb7f17f72cb0u},
    {Part::limbs, "set-shoulder-box", 0x0eb26454509a4337u},
    {Part::limbs, "set-both-boxes", 0xba489a692982a6f7u},
    {Part::limbs, "set-world-hand-twists", 0xca2dd582b91028f2u},
    {Part::limbs, "set-all-limits", 0x17e30e0b5cf60928u},
    {Part::limbs, "set-aim", 0x43672ffce1a74b70u},
    {Part::limbs, "set-clavicle", 0x2e2b2c7b920eae00u},
};

}  // namespace swivel::corpus
