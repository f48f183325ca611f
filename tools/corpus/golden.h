// SPDX-License-Identifier: MIT
//
// The bits that every CPU must give. Changing a number here changes results for everyone: it needs an entry under
// "Results changed" in CHANGELOG.md and at least a minor version. `print_digest golden` prints
// this file's numbers.
#pragma once

#include <cstdint>
#include <span>

#include "tools/corpus/recipe.h"

namespace swivel::corpus {

// In the order of enum Part: the digests of a part's crowds below, folded.
inline constexpr std::uint64_t kGoldenDigests[] = {
    0x1c18711c60d19dbbu,  // ordinary
    0xbdab33c3b85403efu,  // hard
    0x9bc3f799f3bb343du,  // limbs
    0xdd73f6065170d93bu,  // bodies
    0x4bd41e1c04aa5317u,  // standing
};

// The standing part's start, which stands for it under emulators.
inline constexpr std::uint64_t kGoldenStart = 0xe08422af2c94dc51u;

// Crowd by crowd, in the order of recipes_of(), so that a failure has a name.
// clang-format off
inline constexpr std::uint64_t kGoldenOrdinary[] = {
    0xc53b31053f40f6a9u, 0x8636df37a7e37b6bu, 0x8be582be0ddddcc4u, 0xacb2466b3f76eb68u, 0x02c7f04cbbd0a7e0u,
    0x75f3360201dc35c0u, 0xb09323d31aaf972au, 0x2b169e291a635216u, 0xd89a249948fdb8a7u, 0x59122d2f8c2ed460u,
    0x45788decbb643f48u, 0x8b1a3a492968ccecu, 0xe98e2eafa729ba66u, 0xfa52a4a7f2ea013au, 0xfd98f4a059352a35u,
    0x81effad05b5e94cfu, 0x71ddd77fd4064e33u, 0xed7da697a44ed847u, 0xb410ca9bb0eb53fau, 0xd6f7a2c7925171e4u,
    0x8db3541c3b98f012u, 0xc9c5bc83bdba003eu, 0xe85c85db7895f2a8u, 0x161b730ebb5fa6b3u
};
inline constexpr std::uint64_t kGoldenHard[] = {
    0x5fd934b6de6ad86eu, 0x0da6b38af37eb8f7u, 0x300763d69a1d991du, 0xa5b1d5d69733c40du, 0x6e36324cee2de0f0u,
    0xba4bd49e98d1cda5u, 0x7afe7a5a1dfae9b0u, 0xfdd6dc78e868ba07u, 0x7d05b8eb11cc811eu, 0x9bd9a316dc700c2au,
    0xdbeaa5f80a7eaab8u, 0x810a088d46af4f05u, 0xfc6f7fe6c292bdb4u, 0xc818bec8847b2752u, 0x973c889f9dc7b866u,
    0xbe101dc1aa322149u, 0x62d9ebde480657ffu, 0x1edb0e35a28a8076u, 0xe69575b7ef2a81fau, 0xf65d460f25eec96fu,
    0x21dfc4f78de85328u, 0xaa6d80ed0bcd7be3u, 0xa734e00d636517efu, 0x7e96a0c758d5eb22u
};
inline constexpr std::uint64_t kGoldenLimbs[] = {
    0xbf8a1621f539572eu, 0x3b90e277603c906au, 0x2b5f5b97a3e035bfu, 0xca9ba58a81502c71u, 0x9ffca58e29699ae1u,
    0xd766299fe902ff52u, 0xb9848c6a145e8af9u, 0x7dd08b12b94c40b4u, 0x7e32728eb3436330u, 0xe1664e2acd8b4841u,
    0x0cb10ee58de0ca3cu, 0xe5ac68743be775bbu, 0x26c6600b172fae13u, 0x62544eae85e89d50u, 0xae2c894b17448105u,
    0x78c7a3cb688fe192u, 0xbc2699918ea6de74u, 0x716bcac5a3a58fffu, 0xdf425712ab6a8cf9u, 0x55c5e7316dc3a76au,
    0x933d772894794b06u, 0xfd47368a2e80acc1u, 0xb084e2c312b1a363u, 0x88a8fff90b2ac4a5u, 0x09175467d77b00d0u,
    0x60291bf4bfd00c70u, 0x895e626ae754cdf8u, 0x1325b55dd9915d23u, 0x441c03d58fdb1bccu, 0x83720bbc97d14bd2u,
    0xffff27acbdfa1398u, 0x8f37c2425f0bc78eu, 0xcc0d0da1bcc1429au, 0x0a7bd7bf90c0b6b5u, 0x9932c152069459c3u,
    0x567a9bec382d0e90u, 0xc5c22d83e9e796c0u, 0xc89d80da016ee9d3u, 0xc460a4aa272ce7c0u, 0x3491d01edd878e8bu,
    0x36534da584926980u, 0x7cf2578bd3b83bc1u, 0x947b9a0329337cbfu, 0xe71a1f1e1f50e90au, 0xb4da0ac9c812d7fau,
    0x155114c97833b532u, 0xc2e7fb9c8aa5ac6du, 0xea975fdb10426c5du, 0x57d5925c4c1d95f4u, 0xb5b96eb563f999e3u,
    0x5e1826605a5f39deu, 0x7c5de983fe18f996u, 0x5feb754970b69c5du, 0xf4af5926a6889548u
};
inline constexpr std::uint64_t kGoldenBodies[] = {
    0x234b216aae50b623u, 0x21801dbaea96155bu, 0xc9ba02d85741e959u, 0x21cfed94a4800629u, 0xd069e2ea6aebf572u,
    0x2d7760df74e56edau, 0xa24eb69048b251e4u, 0xfdcd8954e11986e9u, 0x15632bf8498dea1fu, 0xeb2d9d696e8b1791u,
    0xcab625fe8c44d78du, 0x69d76a673cff9d8du, 0xf6ed67f2cda024e9u, 0x957fbd13b20700ecu, 0xb5460049775f50b2u,
    0x835f16c930ed419au, 0x4f25d17dde1d68acu, 0x63a2d62b3d8214b1u, 0x06bd55d90da72569u, 0xa7cc7cc2b8e25587u,
    0x0ff224cc4e957db6u, 0x5d4f38f9504e2842u, 0x7998a8d936b74851u, 0x10e9a772384b9427u, 0x8e91eaa429cfbb02u,
    0x080c0fe1632e75b2u, 0x76de37bf505505dau, 0xb87f594f9b7362ddu, 0x6b8823c32fb9e248u, 0x69baa9717beeae3bu,
    0x9aa66bbe89edda04u, 0x94f511ffbe24dd3eu, 0x913b6e0b02eabb46u, 0x07313a99c03b1d58u, 0xaf07ff321125e08cu,
    0x2462188a4319716fu, 0x382c2240f88f80f7u, 0xa07cff9f6643a3d5u, 0x892c5f09dfbf7a64u, 0x855bd9b560c44cbdu,
    0x883129f2dc796deeu, 0x29bea7f6e429d177u, 0xf40cbad297b99514u
};
inline constexpr std::uint64_t kGoldenStanding[] = {
    0x16f6cf27ae6a0daeu, 0xc5ae5068626a5093u, 0x8fb9ab132cba6a09u, 0xc87df7e7d6f62559u, 0x53006f4efc109a79u,
    0x6a1e0423f7254994u, 0x69e85f722e39d0bdu, 0x597d721db5e7da31u, 0xce1a15fcf0b3f251u, 0x39e7bedd1200d911u,
    0xedc3847abd7b467eu, 0x2b134db2fcec0ff4u
};
// clang-format on
inline constexpr std::span<const std::uint64_t> kGoldenCrowds[] = {kGoldenOrdinary, kGoldenHard, kGoldenLimbs,
                                                                   kGoldenBodies, kGoldenStanding};

}  // namespace swivel::corpus
