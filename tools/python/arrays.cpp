// SPDX-License-Identifier: MIT
#include "tools/python/arrays.h"

#include <pybind11/stl.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace py = pybind11;

namespace swivel::python {

namespace {

using Shape = std::vector<py::ssize_t>;

std::string text_of(py::handle object) { return py::str(object); }

Shape shape_of(const py::array& array) { return {array.shape(), array.shape() + array.ndim()}; }

std::string text_of(const Shape& shape) { return text_of(py::tuple(py::cast(shape))); }

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

[[noreturn]] void refuse_shape(const Values& wanted, const py::array& given, bool one_for_all)
{
    std::string message = wanted.name + ": expected shape " + text_of(each_limb(wanted));
    if (one_for_all) message += ", or " + text_of(one_value(wanted)) + " for all limbs";
    throw py::value_error(message + ", got " + shape_text(given));
}

// Whether any byte from the array's first to its last lies there.
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

py::array as_array(const Values& wanted, py::handle object)
{
    try {
        return py::module_::import("numpy").attr("asarray")(object);
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
        py::raise_from(error, error.type().ptr(), (wanted.name + ": not an array of numbers").c_str());
        throw py::error_already_set();
    }
}

// A copy of the given numbers as this type, values one after the other.
py::array converted(const Values& wanted, const py::array& given, const py::dtype& type)
{
    const py::module_ numpy = py::module_::import("numpy");
    if (!numpy.attr("can_cast")(given.dtype(), type, "same_kind").cast<bool>())
        throw py::type_error(wanted.name + ": expected numbers that can become " + text_of(type) + ", got dtype " +
                             text_of(given.dtype()));
    return numpy.attr("array")(given, type, py::arg("order") = "C", py::arg("copy") = true);
}

}  // namespace

std::string shape_text(const py::array& array) { return text_of(shape_of(array)); }

Input input(const Values& wanted, py::handle object, const py::dtype& type, bool one_for_all, const Memory& apart)
{
    py::array given = as_array(wanted, object);
    const bool one = one_for_all && shape_of(given) == one_value(wanted);
    if (!one && shape_of(given) != each_limb(wanted)) refuse_shape(wanted, given, one_for_all);
    const Values held{wanted.name, one ? 1 : wanted.limb_count, wanted.component_count};
    const bool as_it_is = given.dtype().equal(type) && lies_well(held, given, true) && !touches(given, apart);
    if (!as_it_is) given = converted(wanted, given, type);
    const std::size_t stride = one ? 0 : static_cast<std::size_t>(stride_of(held, given));
    return {{given.data(), stride}, given};
}

Output output(const Values& wanted, py::handle object, const py::dtype& type, const Memory& apart)
{
    py::array given;
    if (object.is_none()) {
        given = py::array(type, each_limb(wanted));
    } else {
        if (!py::isinstance<py::array>(object))
            throw py::type_error(wanted.name + ": expected an array to write to, got " +
                                 text_of(py::type::handle_of(object).attr("__name__")));
        given = py::reinterpret_borrow<py::array>(object);
        if (!given.dtype().equal(type))
            throw py::type_error(wanted.name + ": expected dtype " + text_of(type) + ", got " + text_of(given.dtype()));
        if (shape_of(given) != each_limb(wanted)) refuse_shape(wanted, given, false);
        if (!given.writeable()) throw py::value_error(wanted.name + ": the array is read-only");
        if (touches(given, apart)) throw py::value_error(wanted.name + ": the array is the crowd's own rows");
    }
    const py::array direct = lies_well(wanted, given, false) ? given : py::array(type, each_limb(wanted));
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
