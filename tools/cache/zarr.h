// SPDX-License-Identifier: MIT
//
// Arrays in a folder, as Zarr version 2 has them: a description in JSON beside files of little-endian numbers, one for
// each chunk. Source: the Zarr storage specification, version 2 (zarr-specs.readthedocs.io). Knows no crowd.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tools/cache/plain_folder.h"

namespace swivel::tools {

static_assert(std::endian::native == std::endian::little, "chunks hold numbers as this machine has them");

// Which chunk: its place along each dimension. Shorter than the dimensions: 0 along the rest.
using ChunkPlace = std::vector<std::uint64_t>;

struct ZarrArray {
    std::string name;                          // its folder within the store's, such as "clip/wrist"
    std::string type;                          // "<f4", "<f8", "<u4", "<u8", "<i4", "|u1"
    std::vector<std::string> dimensions;       // their names, the slowest first
    std::vector<std::uint64_t> shape, chunks;  // chunks at an edge are stored whole; what is past it has the fill value
    std::string meaning;                       // in a few words, with the unit

    std::size_t number_bytes() const { return static_cast<std::size_t>(type.back() - '0'); }
    std::size_t chunk_bytes() const;
    // Chunks along each dimension, and in all.
    std::vector<std::uint64_t> chunk_counts() const;
    std::size_t chunk_count() const;
    // A chunk's number, the last dimension's counted first.
    std::size_t chunk_index(const ChunkPlace& place) const;
};

// What became of a reading. damaged: the file has another size.
enum class ChunkRead { missing, damaged, whole };

class ZarrStore {
public:
    explicit ZarrStore(PlainFolder folder) : folder_(std::move(folder)) {}

    const std::filesystem::path& folder() const { return folder_.path(); }

    // Describes an array and the groups that it is in. Throws InputError if that cannot be written.
    void write_array(const ZarrArray& array) const;
    // The attributes of the whole store. Throws InputError if they cannot be written, or take more than
    // kMaxAttributes.
    void write_attributes(const nlohmann::ordered_json& attributes) const;
    // Throws InputError unless the store describes the array and its groups in this way.
    void require(const ZarrArray& array) const;

    // The file of a chunk.
    std::filesystem::path chunk_path(const ZarrArray& array, const ChunkPlace& place) const;
    // Writes a whole chunk: under a name of its own, synced, renamed. Throws InputError as OutputFile does.
    void write_chunk(const ZarrArray& array, const ChunkPlace& place, std::span<const std::byte> bytes) const;
    // Reads a whole chunk. Throws InputError for a file that may not be read.
    ChunkRead read_chunk(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const;
    // The same of an array whose chunks are one number of type <u8. Nothing: there is no such file, or it is damaged.
    void write_number(const ZarrArray& array, const ChunkPlace& place, std::uint64_t number) const;
    std::optional<std::uint64_t> read_number(const ZarrArray& array, const ChunkPlace& place) const;

    // Removes the files that writers of the array left when they were killed.
    void remove_unfinished(const ZarrArray& array) const;

private:
    PlainFolder folder_;
};

constexpr std::size_t kMaxAttributes = std::size_t{4} << 20;  // bytes: 50,000 joints or names; 100 MiB as JSON
// The attributes of the store in a folder. Throws InputError if they are missing, too long or no JSON.
nlohmann::ordered_json attributes_in(const PlainFolder& folder);

// Numbers of a chunk as a store takes them.
template <class Number>
std::span<const std::byte> bytes_in(const std::vector<Number>& numbers)
{
    return std::as_bytes(std::span(numbers));
}

}  // namespace swivel::tools
