// SPDX-License-Identifier: MIT
#include "tools/rig/vectors.h"

#include <fmt/format.h>

namespace swivel::tools {

std::string vector_text(const Eigen::Vector3d& v)
{
    const Eigen::Vector3d shown = to_three_decimals(v);
    return fmt::format("({:.3f} {:.3f} {:.3f})", shown.x(), shown.y(), shown.z());
}

std::string toml_row(const Eigen::Vector3d& v)
{
    const Eigen::Vector3d shown = to_three_decimals(v);
    return fmt::format("[{:.3f}, {:.3f}, {:.3f}]", shown.x(), shown.y(), shown.z());
}

}  // namespace swivel::tools
