// SPDX-License-Identifier: MIT
//
// Structures that begin with their size, so that the library can read the shorter ones of older headers. And
// enumerators, which C lets be any number.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "batch/refusal/status.h"

namespace swivel {

// A structure's size, which is its first member; 0 beside null.
inline std::size_t size_of(const void* given)
{
    std::size_t size = 0;
    if (given) std::memcpy(&size, given, sizeof size);
    return size;
}

// Checks that a header may have given the structure this size: whole words, and no more than this header's. name: the
// structure's name in the error message.
template <class Struct>
swivel_status check_size(const char* name, std::size_t size)
{
    if (size == 0 || size % alignof(Struct) != 0)
        return refuse("%s has size %zu; start from its default, or set the size", name, size);
    if (size > sizeof(Struct))
        return refuse("%s has size %zu, this library's has %zu; build with the header of the library that you link",
                      name, size, sizeof(Struct));
    return SWIVEL_OK;
}

// An enumerator's number, which C lets be any.
template <class Enum>
std::uint32_t number_of(const Enum& value)
{
    std::uint32_t number;
    static_assert(sizeof number == sizeof value);
    std::memcpy(&number, &value, sizeof number);
    return number;
}

// Members reserved for later releases must be 0.
template <class Struct>
swivel_status check_reserved(const char* name, const Struct& given)
{
    if (given.reserved == 0) return SWIVEL_OK;
    return refuse("%s: reserved is not 0; start from its default", name);
}

// Element n of an array has the size of the first.
template <class Struct>
swivel_status check_element(const char* name, const Struct* array, std::size_t n)
{
    const std::size_t step = size_of(array), size = size_of(reinterpret_cast<const char*>(array) + n * step);
    if (size == step) return SWIVEL_OK;
    return refuse("%s %zu has size %zu, the first has %zu; start each from its default", name, n, size, step);
}

// Element n of an array, whose step is the size of its first element. Members that a short element lacks come from
// `otherwise`.
template <class Struct>
Struct element(const Struct* array, std::size_t n, Struct otherwise)
{
    const std::size_t size = size_of(array);
    if (size == 0) return otherwise;
    std::memcpy(&otherwise, reinterpret_cast<const char*>(array) + n * size, std::min(size, sizeof otherwise));
    otherwise.size = sizeof otherwise;
    return otherwise;
}

// The structure itself. If it is shorter, a copy in `filled`, where otherwise() gives the missing members.
template <class Struct>
const Struct& whole(const Struct* given, Struct (*otherwise)(), Struct& filled)
{
    if (size_of(given) == sizeof(Struct)) return *given;
    filled = element(given, 0, otherwise());
    return filled;
}

}  // namespace swivel
