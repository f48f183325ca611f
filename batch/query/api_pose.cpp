// SPDX-License-Identifier: MIT
//
// The C entry points about single poses: the swivels that limits allow, and the solved pose as positions, errors and
// joint angles.
#include <algorithm>
#include <cstring>
#include <tuple>
#include <utility>

#include "batch/api/check.h"
#include "batch/api/use.h"
#include "batch/query/allowed_arcs.h"
#include "batch/query/forward.h"
#include "batch/query/one_limb.h"
#include "batch/refusal/status.h"
#include "simd/float_env.h"
#include "simd/rows.h"

using namespace swivel;

namespace {

void store(const swivel_out& out, std::size_t n, const Vector<double>& v)
{
    if (out.data) std::memcpy(static_cast<char*>(out.data) + n * out.stride, v.c, sizeof v.c);
}
void store(const swivel_out& out, std::size_t n, const Rotor<double>& q)
{
    const double xyzw[4] = {q.at<kI>(), q.at<kJ>(), q.at<kK>(), q.at<kScalar>()};
    if (out.data) std::memcpy(static_cast<char*>(out.data) + n * out.stride, xyzw, sizeof xyzw);
}

// Calls take(group, limb, n) for the nth limb from `first` on. A body's limb comes as a free one.
template <class Take>
void for_each_free_limb(const Group& group, std::uint32_t first, std::uint32_t limb_count, const Take& take)
{
    if (group.features & kBody) {
        OneLimb one(group);
        for (std::uint32_t n = 0; n < limb_count; ++n) {
            one.take(first + n);
            take(one.group(), 0, n);
        }
    } else {
        for (std::uint32_t n = 0; n < limb_count; ++n) take(group, first + n, n);
    }
}

}  // namespace

swivel_status swivel_allowed_arcs(const swivel_crowd* crowd, uint32_t group, uint32_t limb, swivel_arc* arcs,
                                  uint32_t capacity, uint32_t* arc_count)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::shared);
    swivel_status status = use.for_limbs(group, limb, 1);
    if (status == SWIVEL_OK) status = check_kept(*crowd, group, "swivel_allowed_arcs");
    if (status != SWIVEL_OK) return status;
    if (!arc_count) return refuse("swivel_allowed_arcs: arc_count is null");
    if (!arcs && capacity > 0) return refuse("swivel_allowed_arcs: arcs is null");
    ArcEnds ends[kMaxArcs];
    *arc_count = allowed_arcs(crowd->groups[group], limb, ends);
    for (std::uint32_t n = 0; n < std::min(*arc_count, capacity); ++n)
        arcs[n] = {{ends[n].from[0], ends[n].from[1]}, {ends[n].to[0], ends[n].to[1]}};
    return SWIVEL_OK;
}

swivel_status swivel_forward(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                             swivel_out elbow, swivel_out wrist, swivel_out hand)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::shared);
    swivel_status status = use.for_limbs(group, first, limb_count);
    if (status == SWIVEL_OK) status = check_kept(*crowd, group, "swivel_forward");
    if (status != SWIVEL_OK) return status;
    if (hand.data && !(crowd->groups[group].features & SWIVEL_WITH_HAND))
        return refuse("swivel_forward: group %u has no hands; create it with SWIVEL_WITH_HAND", group);
    for (const auto& [name, out, component_count] :
         {std::tuple{"elbow", elbow, 3u}, {"wrist", wrist, 3u}, {"hand", hand, 4u}})
        if (status == SWIVEL_OK && out.data)
            status =
                check_stride(group, name, limb_count, out.data, out.stride, component_count * sizeof(double), false);
    if (status != SWIVEL_OK) return status;
    const Group& all = crowd->groups[group];
    const Rotor<double> joint = hand_from_arm(all);
    for_each_free_limb(all, first, limb_count, [&](const Group& free_limbs, std::uint32_t limb, std::uint32_t n) {
        const LimbPose pose = forward(free_limbs, limb);
        store(elbow, n, pose.elbow);
        store(wrist, n, pose.wrist);
        store(hand, n, pose.hand * joint);
    });
    return SWIVEL_OK;
}

swivel_status swivel_residuals(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                               swivel_out distance)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::shared);
    swivel_status status = use.for_limbs(group, first, limb_count);
    if (status == SWIVEL_OK) status = check_kept(*crowd, group, "swivel_residuals");
    if (status == SWIVEL_OK)
        status = check_stride(group, "distance", limb_count, distance.data, distance.stride, sizeof(double), false);
    if (status != SWIVEL_OK) return status;
    for_each_free_limb(crowd->groups[group], first, limb_count,
                       [&](const Group& free_limbs, std::uint32_t limb, std::uint32_t n) {
                           const double value = residual(free_limbs, limb);
                           std::memcpy(static_cast<char*>(distance.data) + n * distance.stride, &value, sizeof value);
                       });
    return SWIVEL_OK;
}

swivel_status swivel_joint_angles(const swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                  swivel_euler_order shoulder_order, swivel_euler_order wrist_order, int family,
                                  swivel_out angles)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::shared);
    swivel_status status = use.for_limbs(group, first, limb_count);
    if (status == SWIVEL_OK) status = check_limbs(*crowd, group, "swivel_joint_angles");
    if (status != SWIVEL_OK) return status;
    for (const auto& [order, name] :
         {std::pair{shoulder_order, "shoulder_order"}, std::pair{wrist_order, "wrist_order"}})
        if (static_cast<unsigned>(order) > SWIVEL_ZYX)
            return refuse("swivel_joint_angles: %s is %d; it is one of SWIVEL_XYZ to SWIVEL_ZYX", name,
                          static_cast<int>(order));
    if (family != 0 && family != 1) return refuse("swivel_joint_angles: family is %d; it is 0 or 1", family);
    status = check_stride(group, "angles", limb_count, angles.data, angles.stride, 7 * sizeof(double), false);
    if (status != SWIVEL_OK) return status;
    const Group& g = crowd->groups[group];
    for (std::uint32_t n = 0; n < limb_count; ++n) {
        const JointAngles seven = joint_angles(arm_rotors(g, first + n), shoulder_order, wrist_order, family);
        std::memcpy(static_cast<char*>(angles.data) + n * angles.stride, &seven, sizeof seven);
    }
    return SWIVEL_OK;
}
