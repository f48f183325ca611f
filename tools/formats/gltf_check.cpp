// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/formats/error.h"
#include "tools/formats/printable.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::json;

constexpr const char *kIndex = "a whole number from 0 to 2147483647", *kSize = "a whole number of bytes";

// glTF has whole numbers without a fraction, be it .0; a reader that wants them so takes others for missing.
bool is_whole(const Json& value, std::uint64_t most)
{
    return value.is_number_integer() && (value.is_number_unsigned() || value.get<std::int64_t>() >= 0) &&
           value.get<std::uint64_t>() <= most;
}

bool is_index(const Json& value) { return is_whole(value, INT32_MAX); }
bool is_size(const Json& value) { return is_whole(value, std::uint64_t{1} << 53); }  // as JSON's numbers go
bool is_text(const Json& value) { return value.is_string(); }
bool is_object(const Json& value) { return value.is_object(); }

// Of the size of floats, which accessors have, too: squares and products of some are still finite.
bool is_float(const Json& value) { return value.is_number() && std::abs(value.get<double>()) <= double{FLT_MAX}; }
bool is_numbers(const Json& value, std::size_t count)
{
    return value.is_array() && value.size() == count && std::all_of(value.begin(), value.end(), is_float);
}

bool is_indices(const Json& value) { return value.is_array() && std::all_of(value.begin(), value.end(), is_index); }

// One object of the document, and how messages call it.
struct Element {
    const std::filesystem::path& path;
    std::string name;
    const Json& object;

    [[noreturn]] void refuse(const char* member, const char* wanted) const
    {
        const auto found = object.find(member);
        const std::string value = found == object.end() ? "nothing" : printable(found->dump(), 60);
        throw InputError(path, fmt::format("{} has a bad {}: {} is needed, not {}", name, member, wanted, value));
    }
    template <class Test>
    void may_have(const char* member, const char* wanted, Test&& test) const
    {
        if (const auto found = object.find(member); found != object.end() && !test(*found)) refuse(member, wanted);
    }
    template <class Test>
    void must_have(const char* member, const char* wanted, Test&& test) const
    {
        const auto found = object.find(member);
        if (found == object.end() || !test(*found)) refuse(member, wanted);
    }
    void may_have_text(const char* member) const { may_have(member, "a text", is_text); }
    // An object in it, and how messages call that.
    Element part(const char* member, const std::string& call) const
    {
        must_have(member, "an object", is_object);
        return {path, call, object.at(member)};
    }
};

template <class Check>
void check_list(const std::filesystem::path& path, const Json& owner, const char* list, const std::string& name,
                Check&& check)
{
    const auto found = owner.find(list);
    if (found == owner.end()) return;
    if (!found->is_array()) throw InputError(path, fmt::format("its {} are no list", list));
    for (std::size_t n = 0; n < found->size(); ++n) {
        const Element element{path, fmt::format("{} {}", name, n), (*found)[n]};
        if (!element.object.is_object()) throw InputError(path, fmt::format("{} is no object", element.name));
        check(element);
    }
}

void check_node(const Element& node)
{
    const auto numbers = [](std::size_t count) {
        return [count](const Json& value) { return is_numbers(value, count); };
    };
    node.may_have_text("name");
    node.may_have("children", "a list of nodes", is_indices);
    node.may_have("translation", "a list of 3 numbers that floats can hold", numbers(3));
    node.may_have("rotation", "a list of 4 numbers that floats can hold", numbers(4));
    node.may_have("scale", "a list of 3 numbers that floats can hold", numbers(3));
    node.may_have("matrix", "a list of 16 numbers that floats can hold", numbers(16));
}

void check_channel(const Element& channel)
{
    channel.must_have("sampler", kIndex, is_index);
    const Element at = channel.part("target", "the target of " + channel.name);
    at.may_have("node", kIndex, is_index);
    at.must_have("path", "a text", is_text);
}

void check_sampler(const Element& sampler)
{
    for (const char* member : {"input", "output"}) sampler.must_have(member, kIndex, is_index);
    sampler.may_have_text("interpolation");
}

void check_animation(const Element& animation)
{
    animation.may_have_text("name");
    check_list(animation.path, animation.object, "channels", animation.name + ", channel", check_channel);
    check_list(animation.path, animation.object, "samplers", animation.name + ", sampler", check_sampler);
}

void check_accessor(const Element& accessor)
{
    accessor.may_have("bufferView", kIndex, is_index);
    accessor.may_have("byteOffset", kSize, is_size);
    accessor.must_have("componentType", kIndex, is_index);
    accessor.must_have("count", kIndex, is_index);
    accessor.must_have("type", "a text", is_text);
    accessor.may_have("normalized", "true or false", [](const Json& value) { return value.is_boolean(); });
    if (!accessor.object.contains("sparse")) return;
    const Element sparse = accessor.part("sparse", "the sparse part of " + accessor.name);
    sparse.must_have("count", kIndex, is_index);
    for (const char* member : {"indices", "values"}) {
        const Element part = sparse.part(member, fmt::format("{}, {},", sparse.name, member));
        part.must_have("bufferView", kIndex, is_index);
        part.may_have("byteOffset", "a whole number of bytes below 2 GiB", is_index);
    }
    sparse.part("indices", sparse.name + ", indices,").must_have("componentType", kIndex, is_index);
}

void check_view(const Element& view)
{
    view.must_have("buffer", kIndex, is_index);
    view.must_have("byteLength", kSize, is_size);
    view.may_have("byteOffset", kSize, is_size);
    view.may_have("byteStride", "a multiple of 4 from 4 to 252", [](const Json& value) {
        return is_whole(value, 252) && value.get<int>() >= 4 && value.get<int>() % 4 == 0;
    });
}

void check_buffer(const Element& buffer)
{
    buffer.must_have("byteLength", kSize, is_size);
    buffer.may_have_text("uri");
}

}  // namespace

void check_members(const std::filesystem::path& path, const Json& document)
{
    const Element whole{path, "the file", document};
    whole.part("asset", "its asset").must_have("version", "\"2.0\"", [](const Json& value) {
        return value.is_string() && value.get<std::string>().starts_with("2.");
    });
    check_list(path, document, "nodes", "node", check_node);
    check_list(path, document, "skins", "skin",
               [](const Element& skin) { skin.may_have("joints", "a list of nodes", is_indices); });
    check_list(path, document, "animations", "animation", check_animation);
    check_list(path, document, "accessors", "accessor", check_accessor);
    check_list(path, document, "bufferViews", "buffer view", check_view);
    check_list(path, document, "buffers", "buffer", check_buffer);
}

}  // namespace swivel::formats
