// SPDX-License-Identifier: MIT
#include "tools/formats/gltf_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "tools/formats/error.h"

namespace swivel::formats {
namespace {

using Json = nlohmann::ordered_json;

bool is_index(const Json& value)
{
    if (!value.is_number()) return false;
    const auto number = value.get<double>();
    return number >= 0 && number <= 2147483647 && number == std::floor(number);
}

bool is_numbers(const Json& value, std::size_t count)
{
    return value.is_array() && value.size() == count &&
           std::all_of(value.begin(), value.end(), [](const Json& each) { return each.is_number(); });
}

bool is_indices(const Json& value) { return value.is_array() && std::all_of(value.begin(), value.end(), is_index); }

// One object of the document, and how messages call it.
struct Element {
    const std::filesystem::path& path;
    std::string name;
    const Json& object;

    [[noreturn]] void refuse(const char* member, const char* wanted) const
    {
        throw InputError(path, fmt::format("{} has a bad {}: {} is needed", name, member, wanted));
    }
    template <class Test>
    void may_have(const char* member, const char* wanted, Test&& test) const
    {
        if (const auto found = object.find(member); found != object.end() && !test(*found)) refuse(member, wanted);
    }
    void may_have_index(const char* member) const { may_have(member, "a whole number from 0", is_index); }
    void may_have_text(const char* member) const
    {
        may_have(member, "a text", [](const Json& value) { return value.is_string(); });
    }
    void must_have(const char* member, const char* wanted) const
    {
        if (!object.contains(member)) refuse(member, wanted);
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
    node.may_have("translation", "a list of 3 numbers", numbers(3));
    node.may_have("rotation", "a list of 4 numbers", numbers(4));
    node.may_have("scale", "a list of 3 numbers", numbers(3));
    node.may_have("matrix", "a list of 16 numbers", numbers(16));
}

void check_channel(const Element& channel)
{
    channel.must_have("sampler", "a whole number from 0");
    channel.may_have_index("sampler");
    const auto target = channel.object.find("target");
    if (target == channel.object.end() || !target->is_object()) channel.refuse("target", "an object");
    const Element at{channel.path, "the target of " + channel.name, *target};
    at.may_have_index("node");
    at.must_have("path", "a text");
    at.may_have_text("path");
}

void check_sampler(const Element& sampler)
{
    for (const char* member : {"input", "output"}) {
        sampler.must_have(member, "a whole number from 0");
        sampler.may_have_index(member);
    }
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
    accessor.may_have_index("bufferView");
    accessor.may_have("normalized", "true or false", [](const Json& value) { return value.is_boolean(); });
    accessor.may_have("sparse", "an object", [](const Json& value) { return value.is_object(); });
}

}  // namespace

void check_members(const std::filesystem::path& path, const Json& document)
{
    check_list(path, document, "nodes", "node", check_node);
    check_list(path, document, "skins", "skin",
               [](const Element& skin) { skin.may_have("joints", "a list of nodes", is_indices); });
    check_list(path, document, "animations", "animation", check_animation);
    check_list(path, document, "accessors", "accessor", check_accessor);
    check_list(path, document, "buffers", "buffer", [](const Element& buffer) { buffer.may_have_text("uri"); });
}

}  // namespace swivel::formats
