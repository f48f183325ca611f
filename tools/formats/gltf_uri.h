#pragma once
// SPDX-License-Identifier: MIT
// Addresses in a glTF file: data URIs, names of files, and how these names change when the glTF file moves. Reads no
// files.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace swivel::formats {

// Whether the address holds bytes, as a data URI does.
bool is_data_uri(std::string_view uri);

// The bytes that an address holds itself as base64; nothing for any other address, and for a fault in the base64.
std::optional<std::string> bytes_in_uri(std::string_view uri);

// An address that holds these bytes.
std::string data_uri_of(std::string_view bytes);

// Every address of the document, but none in `extras`, which are the user's own: call(object) gets each object with a
// text `uri`. Document: a nlohmann::json, const or not.
template <class Document, class Call>
void for_each_uri(Document& document, const Call& call)
{
    if (document.is_object()) {
        if (const auto uri = document.find("uri"); uri != document.end() && uri->is_string()) call(document);
        for (auto at = document.begin(); at != document.end(); ++at)
            if (at.key() != "extras") for_each_uri(at.value(), call);
    } else if (document.is_array()) {
        for (auto& each : document) for_each_uri(each, call);
    }
}

// The file that a relative address names for the glTF file `beside`, percent signs resolved. Empty for an address with
// a scheme or of an absolute path: no file of a glTF asset lies there.
std::filesystem::path file_at(const std::string& uri, const std::filesystem::path& beside);

// A relative address in the glTF file `from`, rewritten for the glTF file `to`, whether these exist or not. Other
// addresses stay as they are.
std::string moved_uri(const std::string& uri, const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace swivel::formats
