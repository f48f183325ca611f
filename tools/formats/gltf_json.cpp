// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tools/formats/error.h"
#include "tools/formats/gltf_check.h"
#include "tools/formats/printable.h"

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
std::string without_number(std::string_view said)
{
    const std::size_t end = said.starts_with('[') ? said.find("] ") : std::string_view::npos;
    return printable(end == std::string_view::npos ? said : said.substr(end + 2), 160);
}

// As deep as parse() lets it be.
void take_all_out(Json& value) noexcept
{
    if (!value.is_structured()) return;
    for (Json& each : value) take_all_out(each);
    value.clear();
}

// Builds a document that outlives whatever stops the parser. Json::parse() destroys its own then, which asks for
// memory.
class Builder : public nlohmann::json_sax<Json> {
public:
    std::string fault;  // of the text; empty: none

    explicit Builder(Json& document) : document_(document) {}
    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(value); }
    bool number_unsigned(number_unsigned_t value) override { return put(value); }
    bool number_float(number_float_t value, const string_t&) override { return put(value); }
    bool string(string_t& value) override { return put(value); }
    bool binary(binary_t&) override { return false; }  // JSON has none
    bool start_object(std::size_t) override { return open(Json::value_t::object); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(Json::value_t::array); }
    bool end_array() override { return close(); }
    bool key(string_t& name) override
    {
        member_ = &(*open_.back())[name];
        take_all_out(*member_);  // of a member that stands twice the last counts
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const Json::exception& error) override
    {
        fault = without_number(error.what());
        return false;
    }

private:
    template <class Value>
    Json& place(Value&& value)
    {
        if (!open_.empty() && open_.back()->is_array()) return open_.back()->emplace_back(std::forward<Value>(value));
        return (open_.empty() ? document_ : *member_) = Json(std::forward<Value>(value));
    }
    template <class Value>
    bool put(Value&& value)
    {
        place(std::forward<Value>(value));
        return true;
    }
    bool open(Json::value_t kind)
    {
        open_.push_back(&place(kind));
        return true;
    }
    bool close()
    {
        open_.pop_back();
        return true;
    }

    Json& document_;
    std::vector<Json*> open_;  // objects and lists, each in the one before
    Json* member_ = nullptr;   // of the innermost object, whose value comes next
};

GltfDocument parse(const fs::path& path, std::string_view text)
{
    if (depth_of(text) > 500)
        throw InputError(path, "its JSON is nested deeper than 500 levels, as no exporter does; export the file again");
    GltfDocument document(new Json);
    Builder builder(*document);
    if (!Json::sax_parse(text, &builder))
        throw InputError(path, fmt::format("is not glTF: {}; export the file again", builder.fault));
    if (!document->is_object()) throw InputError(path, "is not glTF: its JSON is no object; export the file again");
    return document;
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
    take_all_out(*document);
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
