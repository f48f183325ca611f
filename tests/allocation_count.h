// SPDX-License-Identifier: MIT
//
// Counts every allocation of the process, operator new's included, whoever asks for it.
#pragma once

#include <cstddef>

namespace swivel::test {

// How many there have been so far, on all threads.
std::size_t allocation_count();

// If set, it is asked at every allocation whether that one fails. Not beside sanitizers.
extern bool (*allocation_fails)();

}  // namespace swivel::test
