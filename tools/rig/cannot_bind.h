// SPDX-License-Identifier: MIT
//
// Why a skeleton's limb is not solved.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace swivel::tools {

// what() is one line that leaves out the file; advice says what to do, to follow it after a semicolon; empty: nothing.
struct CannotBind : std::runtime_error {
    CannotBind(const std::string& cause, std::string what_to_do)
        : std::runtime_error(cause), advice(std::move(what_to_do))
    {
    }
    std::string advice;
};

}  // namespace swivel::tools
