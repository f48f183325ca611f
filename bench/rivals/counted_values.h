// SPDX-License-Identifier: MIT
//
// Vectors and rotors of numbers that count.
#pragma once

#include "bench/rivals/counted.h"
#include "core/space.h"

namespace bench {

using swivel::Rotor;

inline swivel::Vector<Counted> vector(double x, double y, double z)
{
    return swivel::vector(Counted(x), Counted(y), Counted(z));
}
inline Rotor<Counted> rotor(double x, double y, double z, double w)
{
    return swivel::rotor(Counted(x), Counted(y), Counted(z), Counted(w));
}
// A joint's rotation as it is stored: on the incoming one's side.
inline void store(const Rotor<Counted>& local, const Rotor<Counted>& incoming)
{
    swivel::with_sign_of(swivel::scalar_product(~incoming, local), local);
}

}  // namespace bench
