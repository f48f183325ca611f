// SPDX-License-Identifier: MIT
#include "tools/formats/joint_keys.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace swivel::formats {

void require_keys(const Clip& clip, std::span<const JointKeys> keys, std::size_t frame_count)
{
    const auto require = [](bool is_met, const char* what) {
        if (!is_met) throw std::invalid_argument(what);
    };
    const auto fits = [&](const auto& list) { return list.empty() || list.size() == frame_count; };
    std::set<int> seen;
    for (const JointKeys& each : keys) {
        require(each.joint >= 0 && static_cast<std::size_t>(each.joint) < clip.joints.size(), "keys of no joint");
        require(seen.insert(each.joint).second, "keys for one joint twice");
        require(fits(each.rotation) && fits(each.translation), "keys are not one per frame");
        require(
            std::ranges::all_of(each.rotation, [](const auto& q) { return q.norm() > 0 && std::isfinite(q.norm()); }),
            "a rotation is zero or not finite");
        require(std::ranges::all_of(each.translation, [](const auto& place) { return place.allFinite(); }),
                "a translation is not finite");
    }
}

}  // namespace swivel::formats
