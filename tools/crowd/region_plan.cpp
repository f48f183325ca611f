// SPDX-License-Identifier: MIT
#include "tools/crowd/region_plan.h"

#include <fmt/format.h>

#include <numbers>

#include "swivel/swivel.hpp"
#include "tools/formats/error.h"

namespace swivel::tools {

namespace {

constexpr double kPerDegree = std::numbers::pi / 180;

std::array<float, 3> floats(const Eigen::Vector3d& v)
{
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
swivel_region_cone cone_of(const formats::ConeLimit& cone)
{
    const auto [x, y, z] = floats(cone.axis);
    return {{x, y, z}, static_cast<float>(kPerDegree * cone.opening_deg)};
}

// Where the upper bone points in each frame, in the arm frame.
std::vector<std::array<float, 3>> directions_in(const formats::Clip& clip, const Limb& limb)
{
    const float(&q)[4] = limb.bound.parent_from_arm;
    const Eigen::Quaterniond arm(double{q[3]}, double{q[0]}, double{q[1]}, double{q[2]});
    std::vector<std::array<float, 3>> directions;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const ChainPose pose = chain_pose(clip, frame, limb.chain);
        const Eigen::Vector3d bone = (pose.position[1] - pose.position[0]).normalized();
        directions.push_back(floats(arm.conjugate() * limb.as_solved(bone)));
    }
    return directions;
}

}  // namespace

swivel_region region_of(const formats::CrowdFile& file, const formats::Given<formats::RegionLimit>& from,
                        const formats::Clip& clip, const Limb& limb)
{
    const formats::RegionLimit& given = from.value;
    swivel::Region region;
    const auto add = [&](std::string_view part, const auto& call) {
        try {
            call();
        } catch (const swivel::Error& error) {
            const std::string_view text = error.what();  // after the name of the call
            throw formats::InputError(file.path, from.line,
                                      fmt::format("{}.{}: {}", from.key, part, text.substr(text.find(": ") + 2)));
        }
    };
    std::vector<swivel_region_cone> cones;
    for (const formats::ConeLimit& cone : given.cones) cones.push_back(cone_of(cone));
    if (!cones.empty()) add("cones", [&] { region.add_cones(cones, given.closed); });
    for (std::size_t n = 0; n < given.polygons.size(); ++n) {
        std::vector<std::array<float, 3>> corners;
        for (const Eigen::Vector3d& corner : given.polygons[n]) corners.push_back(floats(corner.stableNormalized()));
        add(fmt::format("polygons[{}]", n), [&] { region.add_polygon(corners); });
    }
    for (std::size_t n = 0; n < given.forbidden.size(); ++n)
        add(fmt::format("forbidden[{}]", n), [&] { region.forbid(cone_of(given.forbidden[n])); });
    if (from.mirrored) region = region.mirrored();
    if (given.clip_margin_deg > 0)  // of the limb itself, so never mirrored
        add("clip_margin_deg", [&] {
            region.add_directions(directions_in(clip, limb), static_cast<float>(kPerDegree * given.clip_margin_deg),
                                  static_cast<std::uint32_t>(given.clip_cones));
        });
    return region.get();
}

}  // namespace swivel::tools
