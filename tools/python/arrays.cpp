// SPDX-License-Identifier: MIT
#include "tools/python/arrays.h"

#include <pybind11/stl.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace py = pybind11;

namespace swivel::python {

namespace {

std::string text_of(py::handle object) { return py::str(object); }

Shape one_value(const Values& wanted)
{
    return wanted.component_count == 1 ? Shape{} : Shape{static_cast<py::ssize_t>(wanted.component_count)};
}

Shape each_limb(const Values& wanted)
{
    Shape shape = one_value(wanted);
    shape.insert(shape.begin(), static_cast<py::ssize_t>(wanted.limb_count));
    return shape;
}

// Bytes from one limb's value to the next, as the array lies.
py::ssize_t stride_of(const Values& wanted, const py::array& array)
{
    const auto value_bytes = static_cast<py::ssize_t>(wanted.component_count) * array.itemsize();
    return array.ndim() > 0 && wanted.limb_count > 1 ? array.strides(0) : value_bytes;
}

// Whether the numbers of each value lie side by side, and no value in another: swivel's idea of an array.
bool lies_well(const Values& wanted, const py::array& array, bool may_repeat)
{
    const py::ssize_t stride = stride_of(wanted, array);
    const bool inside = wanted.component_count == 1 || array.strides(array.ndim() - 1) == array.itemsize();
    return inside && (stride >= static_cast<py::ssize_t>(wanted.component_count) * array.itemsize() ||
                      (may_repeat && stride == 0));
}

}  // namespace

Shape shape_of(const py::array& array) { return {array.shape(), array.shape() + array.ndim()}; }

std::string shape_text(const Shape& shape) { return text_of(py::tuple(py::cast(shape))); }
std::string shape_text(const py::array& array) { return shape_text(shape_of(array)); }

std::size_t length_of(const std::string& name, const py::object& given)
{
    const py::array array = given_array(name, given);
    return array.ndim() > 0 ? static_cast<std::size_t>(array.shape(0)) : 0;
}

bool touches(const py::array& array, const Memory& apart)
{
    const auto* begin = static_cast<const std::byte*>(array.data());
    const std::byte* end = begin + array.itemsize();
    for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
        const py::ssize_t span = array.strides(axis) * (array.shape(axis) - 1);
        (span < 0 ? begin : end) += span;
    }
    const std::less<> before;
    const auto* const first = static_cast<const std::byte*>(apart.begin);
    return array.size() > 0 && before(begin, first + apart.byte_count) && before(first, end);
}

py::array given_array(const std::string& name, py::handle object)
{
    try {
        return py::module_::import("numpy").attr("asarray")(object);
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
        py::raise_from(error, error.type().ptr(), (name + ": not an array of numbers").c_str());
        throw py::error_already_set();
    }
}

// A copy of the given numbers as this type, values one after the other.
py::array converted(const std::string& name, const py::array& given, const py::dtype& type)
{
    const py::module_ numpy = py::module_::import("numpy");
    if (!numpy.attr("can_cast")(given.dtype(), type, "same_kind").cast<bool>())
        throw py::type_error(name + ": expected numbers that can become " + text_of(type) + ", got dtype " +
                             text_of(given.dtype()));
    return numpy.attr("array")(given, type, py::arg("order") = "C", py::arg("copy") = true);
}

py::array array_to_write(const std::string& name, const Shape& shape, py::handle object, const py::dtype& type,
                         const Memory& apart)
{
    if (!py::isinstance<py::array>(object))
        throw py::type_error(name + ": expected an array to write to, got " +
                             text_of(py::type::handle_of(object).attr("__name__")));
    auto given = py::reinterpret_borrow<py::array>(object);
    if (!given.dtype().equal(type))
        throw py::type_error(name + ": expected dtype " + text_of(type) + ", got " + text_of(given.dtype()));
    if (shape_of(given) != shape)
        throw py::value_error(name + ": expected shape " + shape_text(shape) + ", got " + shape_text(given));
    if (!given.writeable()) throw py::value_error(name + ": the array is read-only");
    if (touches(given, apart)) throw py::value_error(name + ": the array is the crowd's own rows");
    return given;
}

Input input(const Values& wanted, py::handle object, const py::dtype& type, bool one_for_all, const Memory& apart)
{
    py::array given = given_array(wanted.name, object);
    const bool one = one_for_all && shape_of(given) == one_value(wanted);
    if (!one && shape_of(given) != each_limb(wanted))
        throw py::value_error(
            wanted.name + ": expected shape " + shape_text(each_limb(wanted)) +
            (one_for_all ? ", or " + shape_text(one_value(wanted)) + " for all " + wanted.each : std::string()) +
            ", got " + shape_text(given));
    const Values held{wanted.name, one ? 1 : wanted.limb_count, wanted.component_count};
    const bool as_it_is = given.dtype().equal(type) && lies_well(held, given, true) && !touches(given, apart);
    if (!as_it_is) given = converted(wanted.name, given, type);
    const std::size_t stride = one ? 0 : static_cast<std::size_t>(stride_of(held, given));
    return {{given.data(), stride}, given};
}

Output output(const Values& wanted, py::handle object, const py::dtype& type, const Memory& apart)
{
    const Shape shape = each_limb(wanted);
    const py::array given =
        object.is_none() ? py::array(type, shape) : array_to_write(wanted.name, shape, object, type, apart);
    const py::array direct = lies_well(wanted, given, false) ? given : py::array(type, shape);
    return {{direct.request(true).ptr, static_cast<std::size_t>(stride_of(wanted, direct))}, given, direct};
}

void Output::start() const
{
    if (!given.is(direct)) py::module_::import("numpy").attr("copyto")(direct, given);
}

py::array Output::finish() const
{
    if (!given.is(direct)) py::module_::import("numpy").attr("copyto")(given, direct);
    return given;
}

}  // namespace swivel::python
