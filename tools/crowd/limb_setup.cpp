// SPDX-License-Identifier: MIT
#include "tools/crowd/limb_setup.h"

#include <algorithm>

namespace swivel::tools {

LimbSkeleton skeleton_of(std::span<const LimbSetup> limbs)
{
    constexpr std::array<float, 4> still{0, 0, 0, 1};
    LimbSkeleton skeleton;
    const auto add = [&](std::int32_t parent, const std::array<float, 3>& place, const std::array<float, 4>& rotation) {
        skeleton.parents.push_back(parent);
        skeleton.translations.push_back(place);
        skeleton.rotations.push_back(rotation);
        return static_cast<std::int32_t>(skeleton.parents.size()) - 1;
    };
    for (const LimbSetup& limb : limbs) {
        std::array<float, 3> place;
        std::ranges::transform(limb.goals.shoulder_place, place.begin(),
                               [](double x) { return static_cast<float>(x); });
        const std::int32_t above = add(-1, {0, 0, 0}, still);
        const std::int32_t shoulder = add(above, place, std::to_array(limb.chain.shoulder_rotation));
        const std::int32_t elbow =
            add(shoulder, std::to_array(limb.chain.elbow_offset), std::to_array(limb.chain.elbow_rotation));
        add(elbow, std::to_array(limb.chain.wrist_offset), std::to_array(limb.chain.wrist_rotation));
        LimbSkeleton::OfLimb& of = skeleton.limbs.emplace_back();
        of.shoulder = static_cast<std::uint32_t>(shoulder);
        of.bend = std::to_array(limb.chain.bend);
        for (unsigned n = 0; n < limb.twist_bone_count(); ++n)
            of.twist_bones.push_back(static_cast<std::uint32_t>(add(elbow, {0, 0, 0}, still)));
    }
    return skeleton;
}

}  // namespace swivel::tools
