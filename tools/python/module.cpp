// SPDX-License-Identifier: MIT
//
// The extension module swivel._core: swivel.hpp for Python and NumPy. The package swivel shows all of it as its own.
// Knows the public headers and, for caches of crowds, tools/cache.
#include <pybind11/pybind11.h>

#include <exception>

#include "swivel/swivel.hpp"
#include "tools/python/crowd.h"
#include "tools/python/helpers.h"
#include "tools/python/names.h"
#include "tools/python/structures.h"

namespace py = pybind11;

namespace swivel::python {

namespace {

PyObject* exception_for(swivel_status status)
{
    switch (status) {
        case SWIVEL_INVALID_ARGUMENT:
        case SWIVEL_UNKNOWN_ISA:
            return PyExc_ValueError;
        case SWIVEL_OUT_OF_MEMORY:
            return PyExc_MemoryError;
        default:
            return PyExc_RuntimeError;
    }
}

// From here on swivel::Error becomes ValueError (a wrong argument, an unknown instruction set), MemoryError, or
// RuntimeError (an instruction set that this CPU does not run), with the library's own text in Python's names.
void translate_errors()
{
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Error& error) {
            PyErr_SetString(exception_for(error.status), in_python(error.what()).c_str());
        }
    });
}

}  // namespace
}  // namespace swivel::python

PYBIND11_MODULE(_core, module)
{
    using namespace swivel::python;
    if (swivel_version() != SWIVEL_VERSION)
        throw py::import_error("swivel: the library is version " + std::to_string(swivel_version()) +
                               ", this module was built for " + std::to_string(SWIVEL_VERSION));
    module.doc() = "Limbs of crowds on NumPy arrays; import swivel.";
    translate_errors();
    add_enums(module);
    add_constants(module);
    add_bindings(module);
    add_regions(module);
    CrowdClass crowd(module, "Crowd");
    crowd.attr("__module__") = "swivel";  // what the package shows is the package's, also in help() and errors
    add_creation(crowd);
    add_shape(crowd);
    add_copies(crowd);
    add_solving(crowd);
    add_answers(crowd);
    add_limits(module);
    add_steps(module);
    add_library(module);
    add_cache(module);
}
