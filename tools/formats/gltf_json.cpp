// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "tools/formats/error.h"
#include "tools/formats/printable.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int kMaxLevels = 500;  // whoever walks the document recurses

bool is_within(const Json& value, int levels)
{
    if (!value.is_structured()) return true;
    const auto each_is = [&](const Json& each) { return is_within(each, levels - 1); };
    return levels > 0 && std::all_of(value.begin(), value.end(), each_is);
}

Json parse(const fs::path& path, std::string_view text)
{
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        std::string_view said = error.what();  // "[json.exception.parse_error.101] ..."
        said.remove_prefix(said.find(']') + 2);
        throw InputError(path, fmt::format("is not glTF: {}; export the file again", printable(said, 160)));
    }
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

Json gltf_document(const fs::path& path, std::string_view json)
{
    Json document = parse(path, json);
    if (!document.is_object()) throw InputError(path, "is not glTF: its JSON is no object; export the file again");
    if (!is_within(document, kMaxLevels))
        throw InputError(path, fmt::format("its JSON is nested deeper than {} levels, as no exporter does; export the "
                                           "file again",
                                           kMaxLevels));
    refuse_compression(path, document);
    check_members(path, document);
    return document;
}

}  // namespace swivel::formats
