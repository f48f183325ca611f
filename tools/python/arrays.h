// SPDX-License-Identifier: MIT
//
// NumPy arrays as swivel sees them: memory and a stride from limb to limb. Arrays of the right type whose numbers of a
// value lie side by side are given as they are, whatever the stride; others are converted. Knows no crowd.
#pragma once

#include <pybind11/numpy.h>

#include <cstddef>
#include <string>

#include "swivel/swivel.h"

namespace swivel::python {

// What an array must hold: one value for each of limb_count limbs, of component_count numbers. Its shape is
// (limb_count, component_count), or (limb_count,) for values of one number. name is what messages call it.
struct Values {
    std::string name;
    std::size_t limb_count, component_count;
};

// Memory that no array may share with swivel, which it then gets as a copy: a crowd's own rows.
struct Memory {
    const void* begin = nullptr;
    std::size_t byte_count = 0;
};

// An array to read, and what keeps its memory.
struct Input {
    swivel_in values;
    pybind11::array owner;
};
// object: anything NumPy makes an array of. Numbers of another type are converted as NumPy's casting="same_kind" does,
// else TypeError; another shape is a ValueError that names both. With one_for_all a single value, of shape
// (component_count,) or (), is every limb's.
Input input(const Values& wanted, pybind11::handle object, const pybind11::dtype& type, bool one_for_all,
            const Memory& apart = {});

// An array to write. What swivel writes is `direct`. Where that is not `given`, start() copies what is there, for calls
// that leave some values as they are, and finish() brings the results back.
struct Output {
    swivel_out values;
    pybind11::array given, direct;

    void start() const;
    pybind11::array finish() const;
};
// object: None for a new array, or an array of the wanted shape and type that may be written (else ValueError or
// TypeError), of any strides.
Output output(const Values& wanted, pybind11::handle object, const pybind11::dtype& type, const Memory& apart = {});

// "(3, 4)", for messages.
std::string shape_text(const pybind11::array& array);

}  // namespace swivel::python
