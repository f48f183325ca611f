// SPDX-License-Identifier: MIT
//
// The extension module swivel._core: swivel.hpp for Python and NumPy. The package swivel shows all of it as its own.
// Knows the public headers and, for caches of crowds, tools/cache.
#include <pybind11/pybind11.h>

#include "tools/python/crowd.h"
#include "tools/python/errors.h"
#include "tools/python/helpers.h"
#include "tools/python/names.h"

namespace py = pybind11;

PYBIND11_MODULE(_core, module)
{
    using namespace swivel::python;
    if (swivel_version() != SWIVEL_VERSION)
        throw py::import_error("swivel: the library is version " + std::to_string(swivel_version()) +
                               ", this module was built for " + std::to_string(SWIVEL_VERSION));
    module.doc() = "Limbs of crowds on NumPy arrays; import swivel.";
    translate_errors();
    add_enums(module);
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
