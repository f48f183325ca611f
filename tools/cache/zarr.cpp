// SPDX-License-Identifier: MIT
#include "tools/cache/zarr.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>

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

constexpr const char* kChanged = "was changed or cut; take it from a copy, or make the cache anew";

void write_json(const fs::path& path, const Json& json)
{
    formats::OutputFile file(path);
    file.write(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    file.commit();
}

Json read_json(const fs::path& path)
{
    const Json json = Json::parse(formats::read_text(path), nullptr, false);
    if (!json.is_object()) throw InputError(path, fmt::format("is no JSON object: it {}", kChanged));
    return json;
}

void make_folder(const fs::path& path)
{
    std::error_code reason;
    fs::create_directories(path, reason);
    if (reason)
        throw InputError(path,
                         fmt::format("cannot be created: {}; check the folder and its permissions", reason.message()));
}

#ifdef SWIVEL_WITH_BLOSC
std::vector<char> packed(std::span<const std::byte> bytes, std::size_t number_bytes)
{
    std::vector<char> out(bytes.size() + BLOSC_MAX_OVERHEAD);
    const int size = blosc_compress_ctx(5, BLOSC_SHUFFLE, number_bytes, bytes.size(), bytes.data(), out.data(),
                                        out.size(), BLOSC_LZ4_COMPNAME, 0, 1);
    out.resize(static_cast<std::size_t>(std::max(size, 0)));
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
    for (const std::uint64_t count : chunks) bytes *= count;
    return bytes;
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

void ZarrStore::write_group(const std::string& name, const Json& attributes) const
{
    const fs::path folder = folder_ / name;
    make_folder(folder);
    write_json(folder / ".zgroup", {{"zarr_format", 2}});
    write_json(folder / ".zattrs", attributes);
}

void ZarrStore::write_array(const ZarrArray& array, Json attributes) const
{
    const fs::path folder = folder_ / array.name;
    make_folder(folder);
    attributes["_ARRAY_DIMENSIONS"] = array.dimensions;
    attributes["long_name"] = array.meaning;
    write_json(folder / ".zarray", description(array));
    write_json(folder / ".zattrs", attributes);
}

Json ZarrStore::attributes(const std::string& name) const { return read_json(folder_ / name / ".zattrs"); }

void ZarrStore::require(const ZarrArray& array) const
{
    const fs::path path = folder_ / array.name / ".zarray";
    const Json found = read_json(path), wanted = description(array);
    for (const auto& [key, value] : wanted.items())
        if (!found.contains(key) || found[key] != value)
            throw InputError(path,
                             fmt::format("{} is {} instead of {}: it {}", key,
                                         found.contains(key) ? found[key].dump() : "missing", value.dump(), kChanged));
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
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return ChunkRead::missing;
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

std::uint64_t digest_of(std::span<const std::byte> bytes)
{
    std::uint64_t digest = 0xcbf29ce484222325u;
    for (std::size_t at = 0; at < bytes.size(); at += 8) {
        std::uint64_t word = 0;
        std::memcpy(&word, &bytes[at], std::min<std::size_t>(8, bytes.size() - at));
        digest = (digest ^ word) * 0x100000001b3u;
    }
    return digest;
}

}  // namespace swivel::tools
