// SPDX-License-Identifier: MIT
#include "tools/python/joint_arrays.h"

#include <algorithm>

namespace py = pybind11;

namespace swivel::python {

namespace {

// The strides of a value's own axes, of floats.
struct Form {
    swivel_pose_form form;
    Shape strides;
};
const Form kForms[] = {{SWIVEL_ROTATIONS, {4}},
                       {SWIVEL_MATRIX_ROWS, {16, 4}},
                       {SWIVEL_MATRIX_COLUMNS, {4, 16}},
                       {SWIVEL_MATRIX_COLUMNS3, {4, 12}}};

Shape each_joint(const JointValues& wanted)
{
    Shape shape = wanted.value;
    shape.insert(shape.begin(), static_cast<py::ssize_t>(wanted.joint_count));
    return shape;
}

Shape each_body(const JointValues& wanted)
{
    Shape shape = each_joint(wanted);
    shape.insert(shape.begin(), static_cast<py::ssize_t>(wanted.body_count));
    return shape;
}

// The form in which an array lies: none where the numbers of a value are not side by side, or values in each other.
const Form* form_of(const JointValues& wanted, const py::array& array, bool may_repeat)
{
    const py::ssize_t *const end = array.strides() + array.ndim(), *const own = end - wanted.value.size();
    py::ssize_t bytes = array.itemsize();
    for (const py::ssize_t count : wanted.value) bytes *= count;
    for (py::ssize_t axis = 0; axis < own - array.strides(); ++axis)
        if (array.shape(axis) > 1 && array.strides(axis) < bytes && !(may_repeat && array.strides(axis) == 0))
            return nullptr;
    const auto* const found = std::find_if(std::begin(kForms), std::end(kForms), [&](const Form& each) {
        return std::equal(own, end, each.strides.begin(), each.strides.end());
    });
    return found == std::end(kForms) ? nullptr : found;
}

JointArray view(const JointValues& wanted, const py::array& array, const Form& form)
{
    const auto joints = static_cast<std::size_t>(array.ndim()) - wanted.value.size() - 1;
    const bool is_one = joints == 0 || wanted.body_count == 1;
    const auto stride = [&](std::size_t axis) { return static_cast<std::size_t>(array.strides()[axis]); };
    return {{const_cast<void*>(array.data()), is_one ? 0 : stride(0), stride(joints), nullptr}, form.form, array};
}

}  // namespace

JointArray joint_input(const JointValues& wanted, py::handle object, const Memory& apart)
{
    const auto floats = py::dtype::of<float>();
    py::array given = given_array(wanted.name, object);
    if (const Shape shape = shape_of(given); shape != each_body(wanted) && shape != each_joint(wanted))
        throw py::value_error(wanted.name + ": expected shape " + shape_text(each_body(wanted)) + ", or " +
                              shape_text(each_joint(wanted)) + " for all bodies, got " + shape_text(given));
    const bool as_it_is = given.dtype().equal(floats) && form_of(wanted, given, true) && !touches(given, apart);
    if (!as_it_is) given = converted(wanted.name, given, floats);
    return view(wanted, given, *form_of(wanted, given, true));
}

JointArray joint_output(const JointValues& wanted, py::handle object, const Memory& apart)
{
    const py::array given = array_to_write(wanted.name, each_body(wanted), object, py::dtype::of<float>(), apart);
    const Form* const form = form_of(wanted, given, false);
    if (!form)
        throw py::value_error(wanted.name +
                              ": the numbers of a value must lie side by side, and joints and bodies apart; give an "
                              "array that numpy.ascontiguousarray() makes");
    return view(wanted, given, *form);
}

}  // namespace swivel::python
