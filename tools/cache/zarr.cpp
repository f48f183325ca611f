// SPDX-License-Identifier: MIT
#include "tools/cache/zarr.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

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
constexpr std::size_t kMaxDescription = 65'536;  // bytes; a description has some hundred
constexpr int kMaxDepth = 8;                     // of lists within lists; a cache's have 6. Copies recurse that deep

std::string text_of(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json read_json(const PlainFolder& folder, const std::string& name, std::size_t max)
{
    const fs::path path = folder.path() / name;
    const std::optional<std::string> text = folder.read(name, max);
    if (!text) throw InputError(path, "is missing; take it from a copy, or make the cache anew");
    if (text->size() > max) throw InputError(path, fmt::format("is longer than {} bytes: it {}", max, kChanged));
    const auto is_shallow = [&](int depth, Json::parse_event_t, Json&) {
        if (depth > kMaxDepth) throw InputError(path, fmt::format("has too many lists within lists: it {}", kChanged));
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
    std::string name = array.name + "/";
    for (std::size_t n = 0; n < whole.size(); ++n) name += (n > 0 ? "." : "") + std::to_string(whole[n]);
    return name;
}

Json description_of(const ZarrArray& array)
{
    return {{"zarr_format", 2},       {"shape", array.shape},
            {"chunks", array.chunks}, {"dtype", array.type},
            {"order", "C"},           {"filters", nullptr},
            {"compressor", nullptr},  {"fill_value", array.type[1] == 'f' ? Json("NaN") : Json(0)}};
}

// The files that describe an array, those of the groups that it is in first.
std::vector<std::pair<std::string, Json>> metadata_of(const ZarrArray& array)
{
    std::vector<std::pair<std::string, Json>> files{{kGroup, Json{{"zarr_format", 2}}}};
    for (std::size_t slash = array.name.find('/'); slash != std::string::npos; slash = array.name.find('/', slash + 1))
        files.emplace_back(fmt::format("{}/{}", array.name.substr(0, slash), kGroup), Json{{"zarr_format", 2}});
    files.emplace_back(fmt::format("{}/{}", array.name, kArray), description_of(array));
    files.emplace_back(fmt::format("{}/{}", array.name, kAttributes),
                       Json{{"_ARRAY_DIMENSIONS", array.dimensions}, {kMeaning, array.meaning}});
    return files;
}

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

void ZarrStore::write_array(const ZarrArray& array) const
{
    for (const auto& [name, json] : metadata_of(array)) {
        if (const std::size_t slash = name.rfind('/'); slash != std::string::npos) folder_.make(name.substr(0, slash));
        const bool is_group = name.ends_with(kGroup);  // of other arrays, too
        if (!is_group || !folder_.has(name)) folder_.write(name, text_of(json));
    }
}

void ZarrStore::write_attributes(const Json& attributes) const
{
    const std::string text = text_of(attributes);
    if (text.size() > kMaxAttributes) {
        const bool has_long_names = 2 * text_of(attributes.value("names", Json::array())).size() > text.size();
        throw InputError(
            folder(),
            fmt::format("its attributes would take {} bytes, more than {}; take {}, or shorter names", text.size(),
                        kMaxAttributes,
                        has_long_names ? "fewer agents, whose names they hold" : "a skeleton with fewer joints"));
    }
    folder_.write(kAttributes, text);
}

Json attributes_in(const PlainFolder& folder) { return read_json(folder, kAttributes, kMaxAttributes); }

void ZarrStore::require(const ZarrArray& array) const
{
    for (const auto& [name, wanted] : metadata_of(array)) {
        const Json found = read_json(folder_, name, kMaxDescription);
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

void ZarrStore::write_chunk(const ZarrArray& array, const ChunkPlace& place, std::span<const std::byte> bytes) const
{
    folder_.write(chunk_name(array, place), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

ChunkRead ZarrStore::read_chunk(const ZarrArray& array, const ChunkPlace& place, std::span<std::byte> bytes) const
{
    const std::optional<std::string> file = folder_.read(chunk_name(array, place), bytes.size());
    if (!file) return ChunkRead::missing;
    if (file->size() != bytes.size()) return ChunkRead::damaged;
    std::memcpy(bytes.data(), file->data(), bytes.size());
    return ChunkRead::whole;
}

void ZarrStore::write_number(const ZarrArray& array, const ChunkPlace& place, std::uint64_t number) const
{
    write_chunk(array, place, std::as_bytes(std::span(&number, 1)));
}

std::optional<std::uint64_t> ZarrStore::read_number(const ZarrArray& array, const ChunkPlace& place) const
{
    std::uint64_t number = 0;
    if (read_chunk(array, place, std::as_writable_bytes(std::span(&number, 1))) != ChunkRead::whole) return {};
    return number;
}

void ZarrStore::remove_unfinished(const ZarrArray& array) const
{
    for (bool is_new = true; is_new;) {  // some file systems leave names out while others are removed
        is_new = false;
        folder_.for_names(array.name, [&](const std::string& name) {
            if (!is_unfinished(name)) return;
            folder_.remove_file(fmt::format("{}/{}", array.name, name));
            is_new = true;
        });
    }
}

}  // namespace swivel::tools
