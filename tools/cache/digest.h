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

// A chunk's digest, never 0: of the words that the digests of each frame's crowds are, in order, as little-endian
// bytes. One object belongs to one thread.
class ChunkDigest {
public:
    void add(const std::vector<std::uint64_t>& of_frame);
    std::uint64_t value() const { return digest_of(std::as_bytes(std::span(words_))); }

private:
    std::vector<std::uint64_t> words_;  // at most 4 for each of a chunk's 65,536 frames
};

}  // namespace swivel::tools
