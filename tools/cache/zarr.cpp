// SPDX-License-Identifier: MIT
#include "tools/cache/zarr.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <stdexcept>

#ifdef SWIVEL_WITH_BLOSC
#include <blosc.h>
#endif

#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using formats::InputError;
using Json = nlohmann::ordered_json;

constexpr const char* kMeaning = "long_name";  // words for people, in which no two versions must agree
constexpr const char* kChanged = "was changed or cut; take it from a copy, or make the cache anew";
constexpr const char *kGroup = ".zgroup", *kArray = ".zarray", *kAttributes = ".zattrs";
constexpr std::size_t kMostDescription = 65'536;  // bytes; a description has some hundred
constexpr int kMostDepth = 8;                     // of lists within lists; a cache's have 6. Copies recurse that deep

std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json read_json(const PlainFolder& folder, const std::string& name, std::size_t most)
{
    const fs::path path = folder.path() / name;
    const std::optional<std::string> text = folder.read(name, most);
    if (!text) throw InputError(path, "is missing; take it from a copy, or make the cache anew");
    if (text->size() > most) throw InputError(path, fmt::format("is longer than {} bytes: it {}", most, kChanged));
    const auto is_shallow = [&](int depth, Json::parse_event_t, Json&) {
        if (depth > kMostDepth) throw InputError(path, fmt::format("has too many lists within lists: it {}", kChanged));
        return true;
    };
    Json json = Json::parse(*text, is_shallow, false);
    if (!json.is_object()) throw InputError(path, fmt::format("is no JSON object: it {}", kChanged));
    return json;
}

// A value for a message.
std::string shown(const Json& json) { return formats::printable(json.dump(), 80); }

// The file of a chunk within the store.
std::string chunk_name(const ZarrArray& array, const ChunkPlace& place)
{
    ChunkPlace whole = place;
    whole.resize(array.shape.size());
    return fmt::format("{}/{}", array.name, fmt::join(whole, "."));
}

// The place that a file's name is, such as "0.0.3"; nothing: it is none within the array's shape.
std::optional<ChunkPlace> place_of(const ZarrArray& array, const std::string& name)
{
    ChunkPlace place;
    for (std::size_t begin = 0, end = 0; begin <= name.size(); begin = end + 1) {
        end = std::min(name.find('.', begin), name.size());
        const std::string part = name.substr(begin, end - begin);
        const auto number = formats::parse_integer(part);
        if (!number || *number < 0 || fmt::format("{}", *number) != part) return std::nullopt;
        place.push_back(static_cast<std::uint64_t>(*number));
    }
    const auto counts = array.chunk_counts();
    const bool fits = std::ranges::equal(place, counts, std::less<>());
    return place.size() == counts.size() && fits ? std::optional(place) : std::nullopt;
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

ZarrStore::ZarrStore(PlainFolder folder, bool is_compressed) : folder_(std::move(folder)), is_compressed_(is_compressed)
{
#ifndef SWIVEL_WITH_BLOSC
    if (is_compressed_)
        throw InputError(folder_.path(), "is compressed by Blosc, which this build lacks; build swivel with libblosc");
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
std::vector<std::pair<std::string, Json>> ZarrStore::metadata(const ZarrArray& array) const
{
    std::vector<std::pair<std::string, Json>> files{{kGroup, Json{{"zarr_format", 2}}}};
    for (std::size_t slash = array.name.find('/'); slash != std::string::npos; slash = array.name.find('/', slash + 1))
        files.emplace_back(fmt::format("{}/{}", array.name.substr(0, slash), kGroup), Json{{"zarr_format", 2}});
    files.emplace_back(fmt::format("{}/{}", array.name, kArray), description(array));
    files.emplace_back(fmt::format("{}/{}", array.name, kAttributes),
                       Json{{"_ARRAY_DIMENSIONS", array.dimensions}, {kMeaning, array.meaning}});
    return files;
}

void ZarrStore::write_array(const ZarrArray& array) const
{
#ifdef SWIVEL_WITH_BLOSC
    if (is_compressed_ && array.chunk_bytes() > BLOSC_MAX_BUFFERSIZE)
        throw InputError(
            folder(), fmt::format("chunks of {} have {} bytes, more than Blosc can pack; make them smaller", array.name,
                                  array.chunk_bytes()));
#endif
    for (const auto& [name, json] : metadata(array)) {
        if (const std::size_t slash = name.rfind('/'); slash != std::string::npos) folder_.make(name.substr(0, slash));
        const bool is_group = name.ends_with(kGroup);  // of other arrays, too
        if (!is_group || !folder_.has(name)) folder_.write(name, text_of(json));
    }
}

void ZarrStore::write_attributes(const Json& attributes) const
{
    const std::string text = text_of(attributes);
    if (text.size() > kMostAttributes)
        throw InputError(folder(), fmt::format("its attributes would take {} bytes, more than {}; take a skeleton with "
                                               "fewer joints, or shorter names",
                                               text.size(), kMostAttributes));
    folder_.write(kAttributes, text);
}

Json attributes_in(const PlainFolder& folder) { return read_json(folder, kAttributes, kMostAttributes); }

void ZarrStore::require(const ZarrArray& array) const
{
    for (const auto& [name, wanted] : metadata(array)) {
        const Json found = read_json(folder_, name, kMostDescription);
        for (const auto& [key, value] : wanted.items())
            if (key != kMeaning && (!found.contains(key) || found[key] != value))
                throw InputError(folder() / name, fmt::format("{} is {} instead of {}: it {}", key,
                                                              found.contains(key) ? shown(found[key]) : "missing",
                                                              value.dump(), kChanged));
    }
}

fs::path ZarrStore::chunk_path(const ZarrArray& array, const ChunkPlace& place) const
{
    return folder() / chunk_name(array, place);
}

void ZarrStore::for_chunks(const ZarrArray& array, const std::function<void(const ChunkPlace&)>& each) const
{
    folder_.for_names(array.name, [&](const std::string& name) {
        if (const auto place = place_of(array, name)) each(*place);
    });
}

std::size_t ZarrStore::write_chunk(const ZarrArray& array, const ChunkPlace& place,
                                   std::span<const std::byte> bytes) const
{
    std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
#ifdef SWIVEL_WITH_BLOSC
    std::vector<char> small;
    if (is_compressed_) {
        small = packed(bytes, array.number_bytes());
        content = {small.data(), small.size()};
    }
#endif
    folder_.write(chunk_name(array, place), content);
    return content.size();
}

ChunkRead ZarrStore::read_chunk(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const
{
    // Blosc may add 16 bytes to a chunk. One that is longer than that is damaged.
    const std::optional<std::string> file = folder_.read(chunk_name(array, place), bytes.size() + 64);
    if (!file) return ChunkRead::missing;
#ifdef SWIVEL_WITH_BLOSC
    if (is_compressed_) return unpack(*file, bytes) ? ChunkRead::whole : ChunkRead::damaged;
#endif
    if (file->size() != bytes.size()) return ChunkRead::damaged;
    std::memcpy(bytes.data(), file->data(), bytes.size());
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

void ZarrStore::remove_in(const std::string& folder, const std::function<bool(const std::string&)>& is_own) const
{
    const std::string before = folder.empty() ? "" : folder + "/";
    for (bool is_new = true; is_new;) {  // some file systems leave names out while others are removed
        is_new = false;
        folder_.for_names(folder, [&](const std::string& name) {
            if (!is_own(name)) return;
            folder_.remove_file(before + name);
            is_new = true;
        });
    }
}

void ZarrStore::remove_unfinished(const ZarrArray& array) const { remove_in(array.name, is_unfinished); }
void ZarrStore::remove_unfinished_attributes() const { remove_in("", is_unfinished); }

void ZarrStore::remove(const ZarrArray& array) const
{
    remove_in(array.name, [&](const std::string& name) {
        return name == kArray || name == kAttributes || is_unfinished(name) || place_of(array, name);
    });
    folder_.remove_if_empty(array.name);
    for (std::string group = array.name; group.find('/') != std::string::npos;) {
        group.resize(group.rfind('/'));
        bool has_others = false;
        folder_.for_names(group, [&](const std::string& name) { has_others |= name != kGroup; });
        if (has_others) return;
        folder_.remove_file(fmt::format("{}/{}", group, kGroup));
        folder_.remove_if_empty(group);
    }
}

}  // namespace swivel::tools
