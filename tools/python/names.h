// SPDX-License-Identifier: MIT
//
// The enumerations of swivel.h as tables of names, for Python's enums and for messages. A new enumerator of the header
// is one line in names.cpp and one in swivel/_core.pyi; a test tells which is missing.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <span>
#include <string>

#include "swivel/swivel.h"

namespace swivel::python {

struct Named {
    const char* name;  // without SWIVEL_
    std::int64_t value;
};
std::span<const Named> features();
std::span<const Named> fields();

// A line of the library with Python's names: "create it with SWIVEL_BUDGET" has Feature.BUDGET, and no function has the
// prefix of C.
std::string in_python(const std::string& line);

// What messages and keywords call a field: "shoulder_position".
std::string field_name(swivel_field field);
// The field of a number that came from Python; ValueError if there is none.
swivel_field field_of(std::int64_t number);
// The order of a number that came from Python; ValueError if there is none.
swivel_euler_order order_of(std::int64_t number);

// Makes Feature, Field, Flag and EulerOrder in the module.
void add_enums(pybind11::module_& module);

}  // namespace swivel::python
