// SPDX-License-Identifier: MIT
#include "tools/python/errors.h"

#include <pybind11/pybind11.h>

#include <exception>

#include "swivel/swivel.hpp"
#include "tools/python/names.h"

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

}  // namespace

void translate_errors()
{
    pybind11::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Error& error) {
            PyErr_SetString(exception_for(error.status), in_python(error.what()).c_str());
        }
    });
}

}  // namespace swivel::python
