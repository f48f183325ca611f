// SPDX-License-Identifier: MIT
//
// The probes by name. probes.inc has a line PROBE(isa) for each instruction set that is built.
#include <cstring>
#include <stdexcept>

#include "bench/rivals/probe.h"

namespace bench {

#define PROBE(isa)            \
    namespace isa {           \
    extern const Probe probe; \
    }
#include "probes.inc"
#undef PROBE

const Probe& probe_of(const char* isa)
{
#define PROBE(name) \
    if (std::strcmp(isa, #name) == 0) return name::probe;
#include "probes.inc"
#undef PROBE
    throw std::invalid_argument(isa);
}

}  // namespace bench
