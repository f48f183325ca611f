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

}  // namespace SWIVEL_NAMESPACE
#endif
