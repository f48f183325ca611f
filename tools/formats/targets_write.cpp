// SPDX-License-Identifier: MIT
#include "tools/formats/targets_csv.h"

#include <fmt/format.h>

#include <iterator>

namespace swivel::formats {

TargetsCsv::TargetsCsv(const std::filesystem::path& path) : out_(path)
{
    out_.write("frame,character,limb,x,y,z,pole_x,pole_y,pole_z,qx,qy,qz,qw\n");
}

void TargetsCsv::append(std::span<const Target> targets)
{
    fmt::memory_buffer line;
    const auto put = [&](bool is_there, const auto& numbers) {
        for (const double number : numbers) {
            line.push_back(',');
            if (is_there) fmt::format_to(std::back_inserter(line), "{}", number);
        }
    };
    for (const Target& target : targets) {
        line.clear();
        fmt::format_to(std::back_inserter(line), "{},{},{}", target.frame, target.character, limb_word(target.limb));
        put(true, target.position);
        put(target.has_pole, target.pole);
        put(target.has_orientation, target.orientation.coeffs());
        line.push_back('\n');
        out_.write({line.data(), line.size()});
    }
}

}  // namespace swivel::formats
