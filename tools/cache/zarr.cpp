// SPDX-License-Identifier: MIT
#include "tools/cache/zarr.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#ifdef SWIVEL_WITH_BLOSC
#include <blosc.h>
#endif

#include "tools/formats/error.h"
#include "tools/formats/output_file.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using formats::InputError;
using Json = nlohmann::ordered_json;

constexpr const char* kMeaning = "long_name";  // words for people, in which no two versions must agree
constexpr const char* kChanged = "was changed or cut; take it from a copy, or make the cache anew";

void write_json(const fs::path& path, const Json& json)
{
    formats::OutputFile file(path);
    file.write(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    file.commit();
}

Json read_json(const fs::path& path)
{
    std::error_code reason;
    if (!fs::exists(path, reason) && !reason)
        throw InputError(path, "is missing; take it from a copy, or make the cache anew");
    const Json json = Json::parse(formats::read_text(path), nullptr, false);
    if (!json.is_object()) throw InputError(path, fmt::format("is no JSON object: it {}", kChanged));
    return json;
}

void make_folder(const fs::path& path)
{
    std::error_code reason;
    const bool is_new = fs::create_directory(path, reason);
    if (reason)
        throw InputError(path,
                         fmt::format("cannot be created: {}; check the folder and its permissions", reason.message()));
    if (is_new) formats::sync_folder(path.parent_path());
}

#ifdef SWIVEL_WITH_BLOSC
std::vector<char> packed(std::span<const std::byte> bytes, std::size_t number_bytes)
{
    std::vector<char> out(bytes.size() + BLOSC_MAX_OVERHEAD);
    const int size = blosc_compress_ctx(5, BLOSC_SHUFFLE, number_bytes, bytes.size(), bytes.data(), out.data(),
                                        out.size(), BLOSC_LZ4_COMPNAME, 0, 1);
    if (size <= 0) throw std::runtime_error("Blosc cannot pack a chunk");  // write_array() refuses those too large
    out.resize(static_cast<std::size_t>(size));
    return out;
}
bool unpack(std::string_view file, std::span<std::byte> to)
{
    std::size_t size = 0;
    return blosc_cbuffer_validate(file.data(), file.size(), &size) == 0 && size == to.size() &&
           blosc_decompress_ctx(file.data(), to.data(), to.size(), 1) == static_cast<int>(to.size());
}
Json compressor() { return {{"id", "blosc"}, {"cname", "lz4"}, {"clevel", 5}, {"shuffle", 1}, {"blocksize", 0}}; }
#endif

}  // namespace

std::size_t ZarrArray::chunk_bytes() const
{
    std::size_t bytes = number_bytes();
    for (const std::uint64_t count : chunks) bytes *= static_cast<std::size_t>(count);
    return bytes;
}

std::vector<std::uint64_t> ZarrArray::chunk_counts() const
{
    std::vector<std::uint64_t> counts;
    for (std::size_t n = 0; n < shape.size(); ++n) counts.push_back((shape[n] + chunks[n] - 1) / chunks[n]);
    return counts;
}

std::size_t ZarrArray::chunk_count() const
{
    std::size_t count = 1;
    for (const std::uint64_t along : chunk_counts()) count *= static_cast<std::size_t>(along);
    return count;
}

std::size_t ZarrArray::chunk_index(const ChunkPlace& place) const
{
    const std::vector<std::uint64_t> counts = chunk_counts();
    std::size_t index = 0;
    for (std::size_t n = 0; n < counts.size(); ++n)
        index = index * static_cast<std::size_t>(counts[n]) + static_cast<std::size_t>(n < place.size() ? place[n] : 0);
    return index;
}

ZarrStore::ZarrStore(fs::path folder, bool is_compressed) : folder_(std::move(folder)), is_compressed_(is_compressed)
{
#ifndef SWIVEL_WITH_BLOSC
    if (is_compressed_)
        throw InputError(folder_, "is compressed by Blosc, which this build lacks; build swivel with libblosc");
#endif
}

Json ZarrStore::description(const ZarrArray& array) const
{
    Json out{{"zarr_format", 2}, {"shape", array.shape}, {"chunks", array.chunks}, {"dtype", array.type},
             {"order", "C"},     {"filters", nullptr},   {"compressor", nullptr}};
    out["fill_value"] = array.type[1] == 'f' ? Json("NaN") : Json(0);
#ifdef SWIVEL_WITH_BLOSC
    if (is_compressed_) out["compressor"] = compressor();
#endif
    return out;
}

// The files that describe an array, those of the groups that it is in first.
std::vector<std::pair<fs::path, Json>> ZarrStore::metadata(const ZarrArray& array) const
{
    std::vector<std::pair<fs::path, Json>> files;
    fs::path folder = folder_;
    for (const fs::path& part : fs::path(array.name)) {
        files.emplace_back(folder / ".zgroup", Json{{"zarr_format", 2}});
        folder /= part;
    }
    files.emplace_back(folder / ".zarray", description(array));
    files.emplace_back(folder / ".zattrs", Json{{"_ARRAY_DIMENSIONS", array.dimensions}, {kMeaning, array.meaning}});
    return files;
}

void ZarrStore::write_array(const ZarrArray& array) const
{
#ifdef SWIVEL_WITH_BLOSC
    if (is_compressed_ && array.chunk_bytes() > BLOSC_MAX_BUFFERSIZE)
        throw InputError(folder_, fmt::format("chunks of {} have {} bytes, more than Blosc can pack; make them smaller",
                                              array.name, array.chunk_bytes()));
#endif
    for (const auto& [path, json] : metadata(array)) {
        make_folder(path.parent_path());
        const bool is_group = path.filename() == ".zgroup";  // of other arrays, too
        if (std::error_code ignored; !is_group || !fs::exists(path, ignored)) write_json(path, json);
    }
}

void ZarrStore::write_attributes(const Json& attributes) const { write_json(folder_ / ".zattrs", attributes); }

Json ZarrStore::attributes() const { return read_json(folder_ / ".zattrs"); }

void ZarrStore::require(const ZarrArray& array) const
{
    for (const auto& [path, wanted] : metadata(array)) {
        const Json found = read_json(path);
        for (const auto& [key, value] : wanted.items())
            if (key != kMeaning && (!found.contains(key) || found[key] != value))
                throw InputError(
                    path, fmt::format("{} is {} instead of {}: it {}", key,
                                      found.contains(key) ? found[key].dump() : "missing", value.dump(), kChanged));
    }
}

fs::path ZarrStore::chunk_path(const ZarrArray& array, const ChunkPlace& place) const
{
    ChunkPlace whole = place;
    whole.resize(array.shape.size());
    return folder_ / array.name / fmt::format("{}", fmt::join(whole, "."));
}

std::size_t ZarrStore::write_chunk(const ZarrArray& array, const ChunkPlace& place,
                                   std::span<const std::byte> bytes) const
{
    formats::OutputFile file(chunk_path(array, place));
    std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
#ifdef SWIVEL_WITH_BLOSC
    std::vector<char> small;
    if (is_compressed_) {
        small = packed(bytes, array.number_bytes());
        content = {small.data(), small.size()};
    }
#endif
    file.write(content);
    file.commit();
    return content.size();
}

ChunkRead ZarrStore::read_chunk(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const
{
    const fs::path path = chunk_path(array, place);
    std::error_code reason;
    if (!fs::exists(path, reason) && !reason) return ChunkRead::missing;  // open_text() says any other reason
    const auto file = formats::open_text(path);
    std::string content;
    formats::append_bytes(path, file.get(), bytes.size() + 64, content);  // more than a chunk, if it is too long
#ifdef SWIVEL_WITH_BLOSC
    if (is_compressed_) return unpack(content, bytes) ? ChunkRead::whole : ChunkRead::damaged;
#endif
    if (content.size() != bytes.size()) return ChunkRead::damaged;
    std::memcpy(bytes.data(), content.data(), bytes.size());
    return ChunkRead::whole;
}

std::size_t ZarrStore::write_number(const ZarrArray& array, const ChunkPlace& place, std::uint64_t number) const
{
    return write_chunk(array, place, std::as_bytes(std::span(&number, 1)));
}

std::optional<std::uint64_t> ZarrStore::read_number(const ZarrArray& array, const ChunkPlace& place) const
{
    std::uint64_t number = 0;
    if (read_chunk(array, place, std::as_writable_bytes(std::span(&number, 1))) != ChunkRead::whole) return {};
    return number;
}

std::uint64_t digest_of(std::span<const std::byte> bytes)
{
    std::uint64_t digest = 0xcbf29ce484222325u;
    for (std::size_t at = 0; at < bytes.size(); at += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, &bytes[at], std::min<std::size_t>(8, bytes.size() - at));
        digest = (digest ^ word) * 0x100000001b3u;
    }
    return digest == 0 ? 1 : digest;
}

}  // namespace swivel::tools
