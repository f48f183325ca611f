// SPDX-License-Identifier: MIT
//
// The C entry point that changes what planted points stand on.
#include <cmath>
#include <cstring>

#include "batch/api/check.h"
#include "batch/api/use.h"
#include "batch/query/limb_value.h"
#include "batch/refusal/status.h"
#include "core/joint_frame.h"
#include "simd/float_env.h"

using namespace swivel;

namespace {

struct Support {
    Vector<double> position;
    Rotor<double> rotation;
};
Support support_at(const swivel_supports& supports, std::size_t n)
{
    double p[3] = {};
    float q[4] = {0, 0, 0, 1};
    const auto read = [n](const swivel_in& values, auto& to) {
        if (values.data) std::memcpy(to, static_cast<const char*>(values.data) + n * values.stride, sizeof to);
    };
    read(supports.position, p);
    read(supports.rotation, q);
    return {vector(p[0], p[1], p[2]), normalise(rotor<double>(q[0], q[1], q[2], q[3]))};
}

swivel_status check_supports(std::uint32_t limb_count, const swivel_supports& supports)
{
    struct Values {
        const char* name;
        swivel_in values;
        std::size_t bytes;
    };
    for (const auto& [name, values, bytes] : {Values{"position", supports.position, 3 * sizeof(double)},
                                              Values{"rotation", supports.rotation, 4 * sizeof(float)}})
        if (values.data && values.stride != 0 && values.stride < bytes)
            return refuse("swivel_change_support: the %s's stride %zu is smaller than a value, %zu bytes", name,
                          values.stride, bytes);
    for (std::uint32_t n = 0; n < limb_count; ++n) {
        const Support support = support_at(supports, n);
        const double sizes[] = {len2(support.position), len2(support.rotation)};
        if (!(sizes[0] <= kHuge2 && std::isfinite(sizes[1])))
            return refuse("swivel_change_support: support %u is not finite or has a rotation of no length", n);
    }
    return SWIVEL_OK;
}

}  // namespace

swivel_status swivel_change_support(swivel_crowd* crowd, uint32_t group, uint32_t first, uint32_t limb_count,
                                    swivel_supports from, swivel_supports to)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::alone);
    if (const swivel_status status = use.for_limbs(group, first, limb_count); status != SWIVEL_OK) return status;
    const Group& planted = crowd->groups[group];
    if (!(planted.features & SWIVEL_WITH_PLANT))
        return refuse("swivel_change_support: group %u does not plant; create it with SWIVEL_WITH_PLANT", group);
    for (const swivel_supports& supports : {from, to})
        if (const swivel_status status = check_supports(limb_count, supports); status != SWIVEL_OK) return status;
    for (std::uint32_t n = 0; n < limb_count; ++n) {
        const Support before = support_at(from, n), after = support_at(to, n);
        const Rotor<double> turn = ~after.rotation * before.rotation;
        const auto move_place = [&](const LimbValue& value) {
            const Vector<double> place =
                sandwich(before.rotation, vector_of(value)) + (before.position - after.position);
            store(sandwich(~after.rotation, place), value);
        };
        const auto turn_vector = [&](const LimbValue& value, std::uint32_t at) {
            store(sandwich(turn, vector_of(value, at)), value, at);
        };
        const std::uint32_t limb = first + n;
        const LimbValue plant(planted, limb, SWIVEL_PLANT);
        if (plant[10] == 0) continue;  // it was not solved, so it carries no state
        move_place(plant);
        turn_vector(plant, 3);
        turn_vector(plant, 6);
        if (planted.features & SWIVEL_PLANT_BY_MOTION) move_place({planted, limb, SWIVEL_CONTACT_STATE});
        if (!(planted.features & SWIVEL_WITH_PLANT_ROTATION)) continue;
        const LimbValue rotation(planted, limb, SWIVEL_PLANT_ROTATION);
        store(turn * rotor_of(rotation), rotation);
        turn_vector(rotation, 4);
        turn_vector(rotation, 7);
    }
    return SWIVEL_OK;
}
