// SPDX-License-Identifier: MIT
#include "bench/rivals/cpu_model.h"

#include <fstream>

namespace bench {

std::string cpu_model()
{
    std::ifstream info("/proc/cpuinfo");
    std::string name = "unknown", family, model;
    for (std::string line; std::getline(info, line) && !line.empty();) {  // of the first core
        const std::size_t colon = line.find(':');
        if (colon == std::string::npos || colon + 2 >= line.size()) continue;
        const std::string value = line.substr(colon + 2);
        if (line.starts_with("model name")) name = value;
        if (line.starts_with("cpu family")) family = ", family " + value;
        if (line.starts_with("model\t")) model = ", model " + value;
    }
    return name + family + model;
}

}  // namespace bench
