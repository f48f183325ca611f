// SPDX-License-Identifier: MIT
#include "tools/cache/digest.h"

#include <xxhash.h>

#include <bit>

namespace swivel::tools {

static_assert(std::endian::native == std::endian::little, "words are hashed as this machine has them");

std::uint64_t digest_of(std::span<const std::byte> bytes)
{
    const std::uint64_t digest = XXH3_64bits(bytes.data(), bytes.size());
    return digest == 0 ? 1 : digest;
}

}  // namespace swivel::tools
