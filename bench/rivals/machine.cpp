// SPDX-License-Identifier: MIT
#include "bench/rivals/machine.h"

#include <algorithm>
#include <fstream>

namespace bench {

namespace {

std::size_t cache_bytes(int level)
{
    const std::string folder = "/sys/devices/system/cpu/cpu0/cache/index";
    for (int n = 0; n < 8; ++n) {
        const std::string index = folder + std::to_string(n);
        std::ifstream level_file(index + "/level"), type_file(index + "/type"), size_file(index + "/size");
        int found = 0;
        std::string type;
        std::size_t size = 0;
        char unit = 0;
        if (!(level_file >> found && type_file >> type && size_file >> size >> unit)) continue;
        if (found == level && type != "Instruction") return unit == 'M' ? size << 20 : size << 10;
    }
    return std::array<std::size_t, 3>{32 << 10, 512 << 10, 16 << 20}[static_cast<std::size_t>(level - 1)];
}

}  // namespace

std::string library_build() { return SWIVEL_BUILD_TEXT; }

std::array<std::size_t, 4> working_sets()
{
    const std::size_t l3 = cache_bytes(3);
    return {cache_bytes(1) / 2, cache_bytes(2) / 2, l3 / 2,
            std::clamp(4 * l3, std::size_t{256} << 20, std::size_t{1} << 30)};
}

}  // namespace bench
