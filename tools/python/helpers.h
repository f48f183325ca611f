// SPDX-License-Identifier: MIT
//
// The parts of the module that need no crowd: values of limit fields, bindings, regions, the library itself, caches.
#pragma once

#include <pybind11/pybind11.h>

namespace swivel::python {

void add_limits(pybind11::module_& module);    // range, cone, flexion, turn, aim, mirror, needed features
void add_steps(pybind11::module_& module);     // Entity, steps, blade names
void add_bindings(pybind11::module_& module);  // Binding, bind
void add_regions(pybind11::module_& module);   // Region
void add_library(pybind11::module_& module);   // version, instruction sets, verify, packed words
void add_cache(pybind11::module_& module);     // filling crowds in folders

}  // namespace swivel::python
