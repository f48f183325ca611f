// SPDX-License-Identifier: MIT
//
// Which levels of rivals run here. __builtin_cpu_supports() also asks the operating system. Some compilers do not know
// the levels' names. So this asks for the instruction sets that float loops use of each level.
#include "bench/rivals/level.h"

namespace bench {

#if defined(__x86_64__)
namespace v2 {
extern const Level level;
}
namespace v3 {
extern const Level level;
}
namespace v4 {
extern const Level level;
}
#else
namespace plain {
extern const Level level;
}
#endif

std::vector<const Level*> runnable_levels()
{
    std::vector<const Level*> levels;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        levels.push_back(&v4::level);
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
        levels.push_back(&v3::level);
    if (__builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt")) levels.push_back(&v2::level);
#else
    levels.push_back(&plain::level);
#endif
    return levels;
}

}  // namespace bench
