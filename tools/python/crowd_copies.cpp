// SPDX-License-Identifier: MIT
//
// Arrays into and out of crowds, field by field.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "tools/python/crowd.h"
#include "tools/python/names.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

using Count = std::optional<std::int64_t>;

void write(HeldCrowd& held, std::int64_t number, const py::object& values, std::int64_t group, std::int64_t first,
           Count count)
{
    const swivel_field field = field_of(number);
    const Limbs limbs = limbs_of(held, group, first, count);
    const float none = 0;
    check(swivel_write(held.crowd.get(), field, limbs.group, 0, 0, {&none, 0}));  // what this group takes
    const Input in = input(values_of(held, field, limbs), values, py::dtype::of<float>(), true, held.rows);
    run(held, Way::kAlone,
        [&] { check(swivel_write(held.crowd.get(), field, limbs.group, limbs.first, limbs.count, in.values)); });
}

void write_doubles(HeldCrowd& held, std::int64_t number, const py::object& values, const py::object& origins,
                   std::int64_t group, std::int64_t first, Count count)
{
    const swivel_field field = field_of(number);
    const Limbs limbs = limbs_of(held, group, first, count);
    const double none[3] = {};
    check(swivel_write_doubles(held.crowd.get(), field, limbs.group, 0, 0, {none, 0}, {}));  // a position
    const auto type = py::dtype::of<double>();
    const Input in = input(values_of(held, field, limbs), values, type, true);
    Input from{};
    if (!origins.is_none()) from = input({"origins", limbs.count, 3}, origins, type, true);
    run(held, Way::kAlone, [&] {
        check(swivel_write_doubles(held.crowd.get(), field, limbs.group, limbs.first, limbs.count, in.values,
                                   from.values));
    });
}

py::array read(HeldCrowd& held, std::int64_t number, std::int64_t group, std::int64_t first, Count count,
               const py::object& out)
{
    const swivel_field field = field_of(number);
    const Limbs limbs = limbs_of(held, group, first, count);
    const Output to = output(values_of(held, field, limbs), out, type_of(field), held.rows);
    run(held, Way::kReading,
        [&] { check(swivel_read(held.crowd.get(), field, limbs.group, limbs.first, limbs.count, to.values)); });
    return to.finish();
}

}  // namespace

void add_copies(CrowdClass& crowd)
{
    crowd.def(
        "write", &write, py::arg("field"), py::arg("values"), py::arg("group") = 0, py::arg("first") = 0,
        py::arg("count") = py::none(),
        "Copies an input field in, of `count` limbs of a group from `first` on; None: to the group's end.\n"
        "Or sets back what read() gave of a field that is carried: NORMAL, PLANT, PLANT_TURN, MOTION, SHIFT, LIFT.\n\n"
        "values has shape (count, k), or (count,) for fields of one number, or is one value (k,) for all of\n"
        "them; k is component_count(field, group). float32 whose k numbers lie side by side is read where it is,\n"
        "with any stride from limb to limb, read-only or not; everything else that NumPy takes for real\n"
        "numbers is converted first. ValueError for another shape, for other results, for limbs that the crowd\n"
        "does not have and fields that the group does not have.");
    crowd.def("write_doubles", &write_doubles, py::arg("field"), py::arg("values"), py::arg("origins") = py::none(),
              py::arg("group") = 0, py::arg("first") = 0, py::arg("count") = py::none(),
              "The same for positions far from the origin: Field.TARGET, Field.POLE, Field.SHOULDER_POSITION, "
              "Field.COMING, Field.GROUND, Field.PROP_PLACE.\n\n"
              "values and origins have shape (count, 3), or (3,) for all limbs, float64. origins are subtracted in\n"
              "double, then the difference is rounded once to float32; None subtracts nothing. All positions of a\n"
              "limb must come from the same origin.");
    crowd.def("read", &read, py::arg("field"), py::arg("group") = 0, py::arg("first") = 0,
              py::arg("count") = py::none(), py::arg("out") = py::none(),
              "A field's values, input or result, of `count` limbs from `first` on; None: to the group's end.\n\n"
              "Shape (count, k), or (count,) for fields of one number, float32, or uint32 for Field.FLAGS. out: an\n"
              "array of that shape and type with any strides, which is filled and returned, instead of a new one.");
}

}  // namespace swivel::python
