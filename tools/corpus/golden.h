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
    0x1c18711c60d19dbbu,  // ordinary
    0xbdab33c3b85403efu,  // hard
    0x4dc389bb313fc64au,  // limbs
    0xecd8766e5dd91cc1u,  // bodies
};

// Crowd by crowd, so that a failure has a name.
struct GoldenCrowd {
    Part part;
    const char* name;
    std::uint64_t digest;
};
inline constexpr GoldenCrowd kGoldenCrowds[] = {
    {Part::ordinary, "arms", 0xc53b31053f40f6a9u},
    {Part::ordinary, "compact", 0x8636df37a7e37b6bu},
    {Part::ordinary, "joints", 0x8be582be0ddddcc4u},
    {Part::ordinary, "joints-compact", 0xacb2466b3f76eb68u},
    {Part::ordinary, "hand", 0x02c7f04cbbd0a7e0u},
    {Part::ordinary, "hand-compact", 0x75f3360201dc35c0u},
    {Part::ordinary, "joints-hand", 0xb09323d31aaf972au},
    {Part::ordinary, "joints-hand-compact", 0x2b169e291a635216u},
    {Part::ordinary, "world", 0xd89a249948fdb8a7u},
    {Part::ordinary, "world-compact", 0x59122d2f8c2ed460u},
    {Part::ordinary, "world-joints", 0x45788decbb643f48u},
    {Part::ordinary, "world-joints-compact", 0x8b1a3a492968ccecu},
    {Part::ordinary, "world-hand", 0xe98e2eafa729ba66u},
    {Part::ordinary, "world-hand-compact", 0xfa52a4a7f2ea013au},
    {Part::ordinary, "world-joints-hand", 0xfd98f4a059352a35u},
    {Part::ordinary, "world-joints-hand-compact", 0x81effad05b5e94cfu},
    {Part::ordinary, "world-direction", 0x71ddd77fd4064e33u},
    {Part::ordinary, "world-direction-compact", 0xed7da697a44ed847u},
    {Part::ordinary, "world-joints-direction", 0xb410ca9bb0eb53fau},
    {Part::ordinary, "world-joints-direction-compact", 0xd6f7a2c7925171e4u},
    {Part::ordinary, "world-hand-direction", 0x8db3541c3b98f012u},
    {Part::ordinary, "world-hand-direction-compact", 0xc9c5bc83bdba003eu},
    {Part::ordinary, "world-joints-hand-direction", 0xe85c85db7895f2a8u},
    {Part::ordinary, "world-joints-hand-direction-compact", 0x161b730ebb5fa6b3u},
    {Part::hard, "arms", 0x5fd934b6de6ad86eu},
    {Part::hard, "compact", 0x0da6b38af37eb8f7u},
    {Part::hard, "joints", 0x300763d69a1d991du},
    {Part::hard, "joints-compact", 0xa5b1d5d69733c40du},
    {Part::hard, "hand", 0x6e36324cee2de0f0u},
    {Part::hard, "hand-compact", 0xba4bd49e98d1cda5u},
    {Part::hard, "joints-hand", 0x7afe7a5a1dfae9b0u},
    {Part::hard, "joints-hand-compact", 0xfdd6dc78e868ba07u},
    {Part::hard, "world", 0x7d05b8eb11cc811eu},
    {Part::hard, "world-compact", 0x9bd9a316dc700c2au},
    {Part::hard, "world-joints", 0xdbeaa5f80a7eaab8u},
    {Part::hard, "world-joints-compact", 0x810a088d46af4f05u},
    {Part::hard, "world-hand", 0xfc6f7fe6c292bdb4u},
    {Part::hard, "world-hand-compact", 0xc818bec8847b2752u},
    {Part::hard, "world-joints-hand", 0x973c889f9dc7b866u},
    {Part::hard, "world-joints-hand-compact", 0xbe101dc1aa322149u},
    {Part::hard, "world-direction", 0x62d9ebde480657ffu},
    {Part::hard, "world-direction-compact", 0x1edb0e35a28a8076u},
    {Part::hard, "world-joints-direction", 0xe69575b7ef2a81fau},
    {Part::hard, "world-joints-direction-compact", 0xf65d460f25eec96fu},
    {Part::hard, "world-hand-direction", 0x21dfc4f78de85328u},
    {Part::hard, "world-hand-direction-compact", 0xaa6d80ed0bcd7be3u},
    {Part::hard, "world-joints-hand-direction", 0xa734e00d636517efu},
    {Part::hard, "world-joints-hand-direction-compact", 0x7e96a0c758d5eb22u},
    {Part::limbs, "effector", 0xbf8a1621f539572eu},
    {Part::limbs, "angle", 0x3b90e277603c906au},
    {Part::limbs, "pole-normal", 0x2b5f5b97a3e035bfu},
    {Part::limbs, "incoming", 0xca9ba58a81502c71u},
    {Part::limbs, "incoming-hand", 0x9ffca58e29699ae1u},
    {Part::limbs, "pole-incoming", 0xd766299fe902ff52u},
    {Part::limbs, "weights", 0x7e32728eb3436330u},
    {Part::limbs, "weights-hand", 0xe1664e2acd8b4841u},
    {Part::limbs, "reach", 0x0cb10ee58de0ca3cu},
    {Part::limbs, "step", 0xe5ac68743be775bbu},
    {Part::limbs, "flexion", 0x26c6600b172fae13u},
    {Part::limbs, "shoulder-cone", 0x62544eae85e89d50u},
    {Part::limbs, "humeral-twist", 0xae2c894b17448105u},
    {Part::limbs, "shoulder-box-xyz", 0x78c7a3cb688fe192u},
    {Part::limbs, "shoulder-box-xzy", 0xbc2699918ea6de74u},
    {Part::limbs, "shoulder-box-yzx", 0x716bcac5a3a58fffu},
    {Part::limbs, "shoulder-box-yxz", 0xdf425712ab6a8cf9u},
    {Part::limbs, "shoulder-box-zxy", 0x55c5e7316dc3a76au},
    {Part::limbs, "shoulder-box-zyx", 0x933d772894794b06u},
    {Part::limbs, "hand-cone", 0x60291bf4bfd00c70u},
    {Part::limbs, "forearm-twist", 0x895e626ae754cdf8u},
    {Part::limbs, "hand-twist", 0x1325b55dd9915d23u},
    {Part::limbs, "wrist-box-xyz", 0x441c03d58fdb1bccu},
    {Part::limbs, "wrist-box-xzy", 0x83720bbc97d14bd2u},
    {Part::limbs, "wrist-box-yzx", 0xffff27acbdfa1398u},
    {Part::limbs, "wrist-box-yxz", 0x8f37c2425f0bc78eu},
    {Part::limbs, "wrist-box-zxy", 0xcc0d0da1bcc1429au},
    {Part::limbs, "wrist-box-zyx", 0x0a7bd7bf90c0b6b5u},
    {Part::limbs, "twist-bones-1", 0x9932c152069459c3u},
    {Part::limbs, "twist-bones-3", 0x567a9bec382d0e90u},
    {Part::limbs, "twist-bones-7", 0xc5c22d83e9e796c0u},
    {Part::limbs, "twist-bones-3-joints", 0xc89d80da016ee9d3u},
    {Part::limbs, "aim", 0xc460a4aa272ce7c0u},
    {Part::limbs, "aim-hand", 0x3491d01edd878e8bu},
    {Part::limbs, "clavicle", 0x36534da584926980u},
    {Part::limbs, "angle-world-direction", 0x7cf2578bd3b83bc1u},
    {Part::limbs, "compact-angle", 0x947b9a0329337cbfu},
    {Part::limbs, "compact-limits", 0xe71a1f1e1f50e90au},
    {Part::limbs, "set-incoming", 0xb4da0ac9c812d7fau},
    {Part::limbs, "set-world-joints-normal-angle-step", 0x155114c97833b532u},
    {Part::limbs, "set-joints-hand-incoming-pole-flexion-reach", 0xc2e7fb9c8aa5ac6du},
    {Part::limbs, "set-shoulder-cone", 0xea975fdb10426c5du},
    {Part::limbs, "set-shoulder-box", 0x57d5925c4c1d95f4u},
    {Part::limbs, "set-both-boxes", 0xb5b96eb563f999e3u},
    {Part::limbs, "set-world-hand-twists", 0x5e1826605a5f39deu},
    {Part::limbs, "set-all-limits", 0x7c5de983fe18f996u},
    {Part::limbs, "set-aim", 0x5feb754970b69c5du},
    {Part::limbs, "set-clavicle", 0xf4af5926a6889548u},
    {Part::bodies, "rotations", 0x38a70cf8627f4b64u},
    {Part::bodies, "rotations-places", 0x513422de38624f20u},
    {Part::bodies, "rotations-scales", 0x6d3e5822aa44c6bdu},
    {Part::bodies, "rotations-all", 0x927daa939149abe2u},
    {Part::bodies, "rows", 0xf7ebfc63d1df30e4u},
    {Part::bodies, "columns", 0x44b17eb2668cc9b0u},
    {Part::bodies, "columns3", 0x33a5ad302ea9bc18u},
    {Part::bodies, "far", 0x774388fe470c125bu},
    {Part::bodies, "far-pole-incoming", 0x344437ec9c84f7c8u},
    {Part::bodies, "offsets-apart", 0x92be68a2b05814a6u},
    {Part::bodies, "rows-offsets-apart", 0x6e817df0f4bc47dfu},
    {Part::bodies, "rests", 0x9477bf8b5e75bb82u},
    {Part::bodies, "columns-rests", 0xc6ec37641dec02b7u},
    {Part::bodies, "lengths", 0x6ffa1f9764279165u},
    {Part::bodies, "pole-incoming", 0x6db505dfe8f328a1u},
    {Part::bodies, "pole-normal-angle", 0xf1df4c75d6bef05eu},
    {Part::bodies, "pole-direction", 0xa36c5b6947bf6025u},
    {Part::bodies, "weights", 0x20437530bbada8f8u},
    {Part::bodies, "weights-hand-pole-incoming", 0x9d7707e266913d85u},
    {Part::bodies, "effector", 0xb2d96340e2c00751u},
    {Part::bodies, "reach-step", 0x723c79f8492aea7du},
    {Part::bodies, "aim-step", 0x24ab5a22aba0c323u},
    {Part::bodies, "aim-hand", 0x334f49b267489ff1u},
    {Part::bodies, "set-both-boxes", 0x96e5310314989cc8u},
    {Part::bodies, "set-all-limits", 0x7decda7e756fd629u},
};

}  // namespace swivel::corpus
