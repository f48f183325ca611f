// SPDX-License-Identifier: MIT
//
// std::bit_cast for platforms whose standard library is older than C++20's, such as emscripten 3.1.
#pragma once

#include "core/isa.h"

namespace swivel::inline SWIVEL_ISA {

// The same bits as a value of another type of the same size.
template <class To, class From>
SWIVEL_ALWAYS_INLINE constexpr To bit_cast(const From& from)
{
    return __builtin_bit_cast(To, from);
}

}  // namespace swivel::inline SWIVEL_ISA
