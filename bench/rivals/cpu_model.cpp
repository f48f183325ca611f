// SPDX-License-Identifier: MIT
#include "bench/rivals/cpu_model.h"

#include <fstream>

namespace bench {

std::string cpu_model()
{
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name"))
            if (const std::size_t colon = line.find(':'); colon + 2 < line.size()) return line.substr(colon + 2);
    return "unknown";
}

}  // namespace bench
