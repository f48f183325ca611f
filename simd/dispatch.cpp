// SPDX-License-Identifier: MIT
#include "simd/dispatch.h"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <iterator>

namespace swivel {

// Three tables for each instruction set, in its namespace.
#define SWIVEL_TABLES(isa)                 \
    inline namespace isa {                 \
    extern const ArmKernels arm_kernels;   \
    extern const LimbKernels limb_kernels; \
    extern const BodyKernels body_kernels; \
    }
SWIVEL_TABLES(scalar)
SWIVEL_TABLES(sse2)
SWIVEL_TABLES(avx2)
SWIVEL_TABLES(avx512)
SWIVEL_TABLES(neon64)
#undef SWIVEL_TABLES

namespace {

constexpr auto always = [] { return true; };

const Isa isas[] = {
#ifdef SWIVEL_HAS_avx512
    {"avx512",
     [] {
         return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                __builtin_cpu_supports("avx512vl");
     },
     {avx512::arm_kernels, avx512::limb_kernels, avx512::body_kernels}},
#endif
#ifdef SWIVEL_HAS_avx2
    {"avx2",
     [] { return __builtin_cpu_supports("avx2") != 0; },
     {avx2::arm_kernels, avx2::limb_kernels, avx2::body_kernels}},
#endif
#ifdef SWIVEL_HAS_sse2
    {"sse2", always, {sse2::arm_kernels, sse2::limb_kernels, sse2::body_kernels}},
#endif
#ifdef SWIVEL_HAS_neon64
    {"neon64", always, {neon64::arm_kernels, neon64::limb_kernels, neon64::body_kernels}},
#endif
#ifdef SWIVEL_HAS_scalar
    {"scalar", always, {scalar::arm_kernels, scalar::limb_kernels, scalar::body_kernels}},
#endif
};

std::atomic<const Isa*> chosen{nullptr};

const Isa* choose()
{
    if (const char* forced = std::getenv("SWIVEL_FORCE_ISA"); forced && *forced) {
        const Isa* isa = find_isa(forced);
        return isa && isa->can_run() ? isa : nullptr;
    }
    for (const Isa& isa : isas)
        if (isa.can_run()) return &isa;
    return nullptr;  // not reached: the last always runs
}

}  // namespace

const Isa* isa_at(std::uint32_t index) { return index < std::size(isas) ? &isas[index] : nullptr; }

const Kernels& single_limb_kernels()
{
    const Isa* isa = isas;
    while (!isa->kernels.limbs.allowed_arcs) ++isa;  // CMakeLists.txt builds one with them, whatever others it builds
    return isa->kernels;
}

const Isa* find_isa(const char* name)
{
    for (const Isa& isa : isas)
        if (std::strcmp(isa.name, name) == 0) return &isa;
    return nullptr;
}

const Isa* current_isa()
{
    const Isa* isa = chosen.load(std::memory_order_acquire);
    if (isa) return isa;
    isa = choose();
    const Isa* none = nullptr;  // a use_isa() that came first wins
    return isa && !chosen.compare_exchange_strong(none, isa, std::memory_order_acq_rel) ? none : isa;
}

void use_isa(const Isa& isa) { chosen.store(&isa, std::memory_order_release); }

}  // namespace swivel
