// SPDX-License-Identifier: MIT
//
// C++ on top of swivel_bodies.h.
#pragma once

#include "swivel.hpp"

#ifdef SWIVEL_NAMESPACE  // C++20; swivel.hpp refuses older C++
namespace SWIVEL_NAMESPACE {

// The limb of each body that has these joints, which must live until the crowd is made.
inline swivel_body_limb_def body_limb(const swivel_limb_joints& joints, swivel_features features = 0)
{
    swivel_body_limb_def made = swivel_default_body_limb_def(&joints);
    made.features = features;
    return made;
}
swivel_body_limb_def body_limb(const swivel_limb_joints&& joints, swivel_features features = 0) = delete;

// A chain of joints of each body that looks, from the first to the last, such as spine, neck and head: 1 to 8 of them.
inline swivel_look_def look(std::span<const std::uint32_t> joints)
{
    swivel_look_def made = swivel_default_look_def();
    made.joint_count = static_cast<std::uint32_t>(joints.size());
    for (std::size_t n = 0; n < joints.size() && n < SWIVEL_MAX_LOOK_JOINTS; ++n) made.joints[n] = joints[n];
    return made;
}
inline swivel_look_def look(std::initializer_list<std::uint32_t> joints)
{
    return look(std::span(joints.begin(), joints.size()));
}

// Feet of one group that want to know the ground, as swivel_probes: one entry of each range for a foot. Where there is
// no ground, a number of `grounds` becomes NaN.
struct Probes {
    Probes(const swivel_probes& asked)
        : group(asked.group),
          bodies(asked.bodies, asked.count),
          places(asked.places, asked.count),
          grounds(asked.grounds, asked.count),
          normals(asked.normals, asked.count)
    {
    }
    std::uint32_t group;
    std::span<const std::uint32_t> bodies;
    std::span<const float[3]> places;
    std::span<float[3]> grounds, normals;
};

// swivel_change_support(), of some bodies from `first` on: {.position = {&place, 0}} is one support for all.
inline void change_support(Crowd& crowd, std::uint32_t group, std::uint32_t first, std::uint32_t body_count,
                           const swivel_supports& from, const swivel_supports& to)
{
    check(swivel_change_support(crowd.get(), group, first, body_count, from, to));
}

}  // namespace SWIVEL_NAMESPACE
#endif
