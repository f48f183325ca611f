// SPDX-License-Identifier: MIT
//
// Who may use a crowd beside whom, and what arguments mean for it.
#include <algorithm>
#include <string>

#include "tools/python/crowd.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

std::uint32_t& entered(HeldCrowd& held, Way way)
{
    const auto own = static_cast<std::size_t>(way);
    for (std::size_t other = 0; other < held.users.size(); ++other)
        if (held.users[other] > 0 && (other != own || way == Way::kAlone))
            throw std::runtime_error(
                "another thread is using this crowd; one crowd serves one thread at a time, but for solving blocks");
    return ++held.users[own];
}

}  // namespace

Use::Use(HeldCrowd& held, Way way) : count_(entered(held, way)) {}
Use::~Use() { --count_; }

std::uint32_t count_of(const char* name, std::int64_t number)
{
    if (number < 0 || number > std::int64_t{UINT32_MAX})
        throw py::value_error(std::string(name) + " is " + std::to_string(number) + "; it is from 0 to 4294967295");
    return static_cast<std::uint32_t>(number);
}

Limbs limbs_of(const HeldCrowd& held, std::int64_t group, std::int64_t first, std::optional<std::int64_t> count)
{
    const std::uint32_t g = count_of("group", group), begin = count_of("first", first);
    const std::uint32_t has = swivel_group_limb_count(held.crowd.get(), g);
    if (has == 0)
        throw py::value_error("group " + std::to_string(g) + " does not exist; this crowd has " +
                              std::to_string(swivel_group_count(held.crowd.get())));
    const std::uint32_t limb_count = count ? count_of("count", *count) : has - std::min(begin, has);
    if (begin > has || limb_count > has - begin)
        throw py::value_error(std::to_string(limb_count) + " limbs from limb " + std::to_string(begin) +
                              " on are not all in group " + std::to_string(g) + ", which has " + std::to_string(has));
    return {g, begin, limb_count};
}

py::dtype type_of(swivel_field field)
{
    return field == SWIVEL_FLAGS ? py::dtype::of<std::uint32_t>() : py::dtype::of<float>();
}

Values values_of(const HeldCrowd& held, swivel_field field, const Limbs& limbs)
{
    float none[1];
    check(swivel_read(held.crowd.get(), field, limbs.group, 0, 0, {none, SIZE_MAX}));
    const swivel_features features = swivel_group_features(held.crowd.get(), limbs.group);
    return {info_of(field).name, limbs.count, swivel_component_count(field, features)};
}

}  // namespace swivel::python
