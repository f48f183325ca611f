// SPDX-License-Identifier: MIT
//
// Names in Python: enums, keywords, messages. Features, fields and flags are those that the library describes; no list
// of them is kept here.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <span>
#include <string>

#include "swivel/swivel.h"

namespace swivel::python {

// All fields, in the order of their numbers.
std::span<const swivel_field_info> fields();
const swivel_field_info& info_of(swivel_field field);
// Whether groups of a kind may have the field.
inline bool has_kind(const swivel_field_info& info, swivel_kind kind) { return (info.kinds >> kind & 1) != 0; }
// The fewest features with which a group has the field: those that it needs, and those that they need in turn.
swivel_features needed_features(swivel_field field);

// A line of the library with Python's names: "create it with SWIVEL_WITH_HAND" has Feature.WITH_HAND, and no function
// has the prefix of C.
std::string in_python(const std::string& line);

// An enumerator's number that came from Python; ValueError if there is none.
swivel_field field_of(std::int64_t number);
swivel_euler_order order_of(std::int64_t number);
swivel_on_bad_input on_bad_input_of(std::int64_t number);
swivel_pose_space pose_space_of(std::int64_t number);

// The object of this name in the package swivel, such as a class that is written in Python.
pybind11::object package(const char* name);
// A set of features as Python's Feature, and a kind as its Kind.
pybind11::object feature_set(swivel_features features);
pybind11::object kind_member(swivel_kind kind);

// Makes Feature, Field, Flag, Kind and other enums in the module, and Arms, which has a place for each result.
void add_enums(pybind11::module_& module);

}  // namespace swivel::python
