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
    0x8dddd8f5bbb1a0cau,  // hard
    0x720c23ade69a3d4eu,  // limbs
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
    {Part::hard, "arms", 0xc50c595fc27d3abdu},
    {Part::hard, "compact", 0xbff303be63ef2166u},
    {Part::hard, "joints", 0x300763d69a1d991du},
    {Part::hard, "joints-compact", 0x31f8bb5c779a9440u},
    {Part::hard, "hand", 0x1960a314e6f83fe2u},
    {Part::hard, "hand-compact", 0x8f8b0c3995662069u},
    {Part::hard, "joints-hand", 0xe6812707dd41b86du},
    {Part::hard, "joints-hand-compact", 0x2fa1c585de66dc1au},
    {Part::hard, "world", 0x245fcb02a3528d7du},
    {Part::hard, "world-compact", 0xb2a8534c3bf3f7e7u},
    {Part::hard, "world-joints", 0x80d11d160f1cbe39u},
    {Part::hard, "world-joints-compact", 0x8a2a15d99bfa7133u},
    {Part::hard, "world-hand", 0x6e282657e6f6b3dcu},
    {Part::hard, "world-hand-compact", 0xc19c7b4c7bab2c9du},
    {Part::hard, "world-joints-hand", 0x993efe74757679f5u},
    {Part::hard, "world-joints-hand-compact", 0x2eebcfbbd5daad5fu},
    {Part::hard, "world-direction", 0xf34f3a519d00fa9fu},
    {Part::hard, "world-direction-compact", 0xd5e64eef95d7324bu},
    {Part::hard, "world-joints-direction", 0x403c1803a7815ff6u},
    {Part::hard, "world-joints-direction-compact", 0x049ece9bf654aa69u},
    {Part::hard, "world-hand-direction", 0xc95f22ff94bdb072u},
    {Part::hard, "world-hand-direction-compact", 0x8b3ac1471c46bb42u},
    {Part::hard, "world-joints-hand-direction", 0x341b9e969de6392fu},
    {Part::hard, "world-joints-hand-direction-compact", 0x5ceb3258f4048ff6u},
    {Part::limbs, "effector", 0xe7f190e674c54672u},
    {Part::limbs, "angle", 0x6419354c6e89afe5u},
    {Part::limbs, "pole-normal", 0x467c215418dc9f1au},
    {Part::limbs, "incoming", 0x274ca0f594d94f91u},
    {Part::limbs, "incoming-hand", 0x9f2cc166a351b4c3u},
    {Part::limbs, "pole-incoming", 0x7d532d8f92eaebd2u},
    {Part::limbs, "weights", 0x988cbd03ed44eb4du},
    {Part::limbs, "weights-hand", 0x106590120b315038u},
    {Part::limbs, "reach", 0xa214ae7d76f5b0d8u},
    {Part::limbs, "step", 0x71a032f78b0919a6u},
    {Part::limbs, "flexion", 0xe53b6b88e23a9242u},
    {Part::limbs, "shoulder-cone", 0x1597b04521d3732bu},
    {Part::limbs, "humeral-twist", 0x8f5dcbb317015154u},
    {Part::limbs, "shoulder-box-xyz", 0x576b3fdae9888aaeu},
    {Part::limbs, "shoulder-box-xzy", 0x1598702f115e8b42u},
    {Part::limbs, "shoulder-box-yzx", 0x9db6946d076be538u},
    {Part::limbs, "shoulder-box-yxz", 0xf26305e8be97264eu},
    {Part::limbs, "shoulder-box-zxy", 0xe9376265843df395u},
    {Part::limbs, "shoulder-box-zyx", 0x57111934dec3c878u},
    {Part::limbs, "hand-cone", 0x7fd5b23cf89365afu},
    {Part::limbs, "forearm-twist", 0x64ebd0809871022cu},
    {Part::limbs, "hand-twist", 0xd47943d70693ea80u},
    {Part::limbs, "wrist-box-xyz", 0x9f4294545fa9d342u},
    {Part::limbs, "wrist-box-xzy", 0x8c61128489bfde7du},
    {Part::limbs, "wrist-box-yzx", 0x0c7f3cbfd9998febu},
    {Part::limbs, "wrist-box-yxz", 0x70020c0d8a3b9930u},
    {Part::limbs, "wrist-box-zxy", 0x0b6f0c4f425d717cu},
    {Part::limbs, "wrist-box-zyx", 0x82b1102c5dcb47cdu},
    {Part::limbs, "twist-bones-1", 0x9dea3addf1f52a1bu},
    {Part::limbs, "twist-bones-3", 0x0ee4efd65dfd9b1du},
    {Part::limbs, "twist-bones-7", 0x0e0fd1f1ca5fab9bu},
    {Part::limbs, "twist-bones-3-joints", 0x5759f7484effb256u},
    {Part::limbs, "aim", 0x5b78987ba525674du},
    {Part::limbs, "aim-hand", 0x28906f562b034b55u},
    {Part::limbs, "clavicle", 0x632da86696c6957au},
    {Part::limbs, "angle-world-direction", 0xf3eda7d09d8b828eu},
    {Part::limbs, "compact-angle", 0xc5f7613f30497e67u},
    {Part::limbs, "compact-limits", 0xf784b86242842b2eu},
    {Part::limbs, "set-incoming", 0x43eb0a988253d3f3u},
    {Part::limbs, "set-world-joints-normal-angle-step", 0x54497bdc79f02007u},
    {Part::limbs, "set-joints-hand-incoming-pole-flexion-reach", 0xad0708566a54b469u},
    {Part::limbs, "set-shoulder-cone", 0x37160b48660d213fu},
    {Part::limbs, "set-shoulder-box", 0x015bf116c480a904u},
    {Part::limbs, "set-both-boxes", 0x908173ec8fa1a536u},
    {Part::limbs, "set-world-hand-twists", 0x630f0b5b76121327u},
    {Part::limbs, "set-all-limits", 0x68e36753aa44881au},
    {Part::limbs, "set-aim", 0x07790a59b69e0e7du},
    {Part::limbs, "set-clavicle", 0x85292fb54fa24409u},
};

}  // namespace swivel::corpus
