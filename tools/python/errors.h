// SPDX-License-Identifier: MIT
//
// The library's failures as Python's exceptions, with the library's own text in Python's names.
#pragma once

namespace swivel::python {

// From here on swivel::Error becomes ValueError (a wrong argument, an unknown instruction set), MemoryError, or
// RuntimeError (an instruction set that this CPU does not run).
void translate_errors();

}  // namespace swivel::python
