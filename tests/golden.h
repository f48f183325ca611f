// SPDX-License-Identifier: MIT
//
// The bits that every CPU must give. Changing this number changes results for everyone: it needs an entry under
// "Results changed" in CHANGELOG.md and at least a minor version.
#pragma once

#include <cstdint>

namespace swivel::test {

// golden_digest(1000, ...) of tools/swivel/golden_crowd.h, as the scalar build gives it.
inline constexpr std::uint64_t kGoldenDigest = 0xe57b634633512ac0u;

// limb_digest(1000, ...) of the same: every feature of whole limbs, three frames of it.
inline constexpr std::uint64_t kGoldenLimbDigest = 0x0c97e4e5f1ed5b0au;

}  // namespace swivel::test
