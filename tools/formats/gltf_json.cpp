// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tools/formats/error.h"
#include "tools/formats/gltf_check.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

// How deep brackets lie in each other, those in strings aside.
std::size_t depth_of(std::string_view json)
{
    std::size_t depth = 0, deepest = 0;
    bool in_string = false;
    for (std::size_t at = 0; at < json.size(); ++at) {
        const char c = json[at];
        if (in_string && c == '\\')
            ++at;
        else if (c == '"')
            in_string = !in_string;
        else if (!in_string && (c == '{' || c == '['))
            deepest = std::max(deepest, ++depth);
        else if (!in_string && (c == '}' || c == ']') && depth > 0)
            --depth;
    }
    return deepest;
}

// What the JSON library says, without its number for it: "[json.exception.parse_error.101] ".
std::string cause_of(const Json::exception& error)
{
    const std::string_view said = error.what();
    const std::size_t end = said.starts_with('[') ? said.find("] ") : std::string_view::npos;
    return printable(end == std::string_view::npos ? said : said.substr(end + 2), 160);
}

// Takes all out that is in it, as deep as parse() lets it be.
void empty(Json& value) noexcept
{
    if (!value.is_structured()) return;
    for (Json& each : value) empty(each);
    value.clear();
}

GltfDocument parse(const fs::path& path, std::string_view text)
{
    if (depth_of(text) > 500)
        throw InputError(path, "its JSON is nested deeper than 500 levels; no exporter does that");
    try {
        GltfDocument document(new Json);
        nlohmann::detail::json_sax_dom_parser<Json> builder(
            *document);  // what Json::parse() uses, into a document of ours
        Json::sax_parse(text, &builder);
        if (document->is_object()) return document;
    } catch (const Json::exception& error) {
        throw InputError(path, fmt::format("is not glTF: {}", cause_of(error)));
    }
    throw InputError(path, "is not glTF: its JSON is no object");
}

void refuse_compression(const fs::path& path, const Json& document)
{
    const auto found = document.find("extensionsRequired");
    if (found == document.end() || !found->is_array()) return;
    for (const Json& name : *found)
        if (name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression")
            throw InputError(path, fmt::format("its buffers are compressed ({}); export it without, or decompress it",
                                               name.get<std::string>()));
}

}  // namespace

void FreeDocument::operator()(Json* document) const noexcept
{
    empty(*document);
    delete document;
}

GltfDocument gltf_document(const fs::path& path, std::string_view json)
{
    GltfDocument document = parse(path, json);
    refuse_compression(path, *document);
    check_members(path, *document);
    return document;
}

}  // namespace swivel::formats
