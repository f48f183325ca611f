// SPDX-License-Identifier: MIT
//
// The digests that prove a cache's files: XXH3 of 64 bits, of the library xxHash. Knows no file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swivel::tools {

// A digest of bytes, never 0: XXH3 without a seed, and 1 in place of 0. Any thread; no allocation.
std::uint64_t digest_of(std::span<const std::byte> bytes);
// The same of words, as little-endian bytes.
inline std::uint64_t digest_of(const std::vector<std::uint64_t>& words)
{
    return digest_of(std::as_bytes(std::span(words)));
}

}  // namespace swivel::tools
