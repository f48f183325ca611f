// SPDX-License-Identifier: MIT
//
// NumPy arrays as swivel sees them: memory and a stride from limb to limb. Arrays of the right type whose numbers of a
// value lie side by side are given as they are, whatever the stride; others are converted. Knows no crowd.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "swivel/swivel.h"

namespace swivel::python {

// The shape that an array must have: one value for each of limb_count limbs, of component_count numbers. Its shape is
// (limb_count, component_count), or (limb_count,) for values of one number. Messages call it name, and limbs `each`.
struct Values {
    std::string name;
    std::size_t limb_count, component_count;
    const char* each = "limbs";
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

// Copies one value of so many floats.
inline void copy(const std::string& name, const pybind11::object& given, std::span<float> numbers)
{
    const Input in = input({name, 1, numbers.size()}, given, pybind11::dtype::of<float>(), true);
    std::copy_n(static_cast<const char*>(in.values.data), numbers.size_bytes(),
                reinterpret_cast<char*>(numbers.data()));
}
// One place or direction, in double.
inline std::array<double, 3> vector_of(const std::string& name, const pybind11::object& given)
{
    const Input in = input({name, 1, 3}, given, pybind11::dtype::of<double>(), true);
    std::array<double, 3> numbers;
    std::copy_n(static_cast<const char*>(in.values.data), sizeof numbers, reinterpret_cast<char*>(numbers.data()));
    return numbers;
}
// The length of what NumPy makes an array of.
std::size_t length_of(const std::string& name, const pybind11::object& given);

// The steps of input() and output(), for arrays of other shapes. They throw the same; name is for messages.
using Shape = std::vector<pybind11::ssize_t>;
Shape shape_of(const pybind11::array& array);
std::string shape_text(const pybind11::array& array);  // "(3, 4)"
std::string shape_text(const Shape& shape);
pybind11::array given_array(const std::string& name, pybind11::handle object);
pybind11::array converted(const std::string& name, const pybind11::array& given, const pybind11::dtype& type);
pybind11::array array_to_write(const std::string& name, const Shape& shape, pybind11::handle object,
                               const pybind11::dtype& type, const Memory& apart);
// Whether any byte from the array's first to its last lies there.
bool touches(const pybind11::array& array, const Memory& apart);

}  // namespace swivel::python
