// SPDX-License-Identifier: MIT
//
// The C entry points that describe poses to people, in words and lines.
#include <cstring>
#include <tuple>

#include "batch/api/check.h"
#include "batch/api/use.h"
#include "batch/explain/compare.h"
#include "batch/explain/draw.h"
#include "batch/explain/explain.h"
#include "batch/refusal/status.h"
#include "batch/solve/work.h"
#include "simd/float_env.h"

using namespace swivel;

namespace {

swivel_status take_place(const double* from, const char* name, Vector<double>& place)
{
    if (!from) return refuse("swivel_compare: %s is null", name);
    std::memcpy(place.c, from, sizeof place.c);
    if (len2(place) <= kHuge2) return SWIVEL_OK;
    return refuse("swivel_compare: %s is not finite or further than 1e15 from the origin", name);
}

// Explains each of a body's groups in a line of its own.
void explain_body(const swivel_crowd& crowd, uint32_t body, Text& text)
{
    for (std::uint32_t g = 0; g < crowd.group_count; ++g) {
        text.add("%sgroup %u: ", g > 0 ? "\n" : "", g);
        if (crowd.groups[g].features & (kNoLimb | SWIVEL_WITH_RECORD))
            explain(crowd, g, body, text);
        else
            text.add("it has no SWIVEL_WITH_RECORD, so nothing is known of it.");
    }
}

}  // namespace

swivel_status swivel_explain(const swivel_crowd* crowd, uint32_t group, uint32_t limb, char* text, size_t size)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::shared);
    const bool is_body = group == SWIVEL_EVERY_GROUP;
    if (const swivel_status status = use.for_limbs(is_body ? 0 : group, limb, 1); status != SWIVEL_OK) return status;
    if (is_body && crowd->joint_count == 0)
        return refuse("swivel_explain: this crowd has no bodies; name one of its %u groups", crowd->group_count);
    if (!is_body && !(crowd->groups[group].features & kNoLimb))
        if (const swivel_status status = check_kept(*crowd, group, "swivel_explain"); status != SWIVEL_OK)
            return status;
    if (!text || size == 0) return refuse("swivel_explain: text is null or of no size");
    Text explanation({text, size});
    if (doubt_solve(*crowd, explanation)) explanation.add("%s", is_body ? "\n" : " ");
    if (is_body)
        explain_body(*crowd, limb, explanation);
    else
        explain(*crowd, group, limb, explanation);
    return SWIVEL_OK;
}

swivel_status swivel_compare(const swivel_crowd* crowd, uint32_t group, uint32_t body, const swivel_pose* pose,
                             const double shoulder[3], const double elbow[3], const double wrist[3], char* text,
                             size_t size, int* agrees)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::shared);
    if (const swivel_status status = use.for_limbs(group, body, 1); status != SWIVEL_OK) return status;
    if (crowd->joint_count == 0)
        return refuse("swivel_compare: this crowd has no bodies, so it has no pose; create it with a skeleton");
    if (const swivel_status status = check_limbs(*crowd, group, "swivel_compare"); status != SWIVEL_OK) return status;
    if (!pose) return refuse("swivel_compare: pose is null");
    if (const swivel_status status = check_pose(*crowd, pose); status != SWIVEL_OK) return status;
    LimbPlaces places{};
    for (const auto& [from, name, place] : {std::tuple{shoulder, "shoulder", &places.at[0]},
                                            {elbow, "elbow", &places.at[1]},
                                            {wrist, "wrist", &places.at[2]}})
        if (const swivel_status status = take_place(from, name, *place); status != SWIVEL_OK) return status;
    if (!text || size == 0) return refuse("swivel_compare: text is null or of no size");
    const bool agree = compare(*crowd, group, body, full_pose(pose), places, {text, size});
    if (agrees) *agrees = agree;
    return SWIVEL_OK;
}

swivel_status swivel_draw(const swivel_crowd* crowd, uint32_t group, uint32_t limb, const swivel_pose* pose,
                          swivel_shape* shapes, uint32_t capacity, uint32_t* shape_count)
{
    const FloatEnv env;
    const Use use(crowd, Sharing::shared);
    const bool is_whole = group == SWIVEL_EVERY_GROUP;
    if (const swivel_status status = use.for_limbs(is_whole ? 0 : group, limb, 1); status != SWIVEL_OK) return status;
    const bool has_bodies = crowd->joint_count > 0;
    if (is_whole && !has_bodies)
        return refuse("swivel_draw: this crowd has no bodies; name one of its %u groups", crowd->group_count);
    if (has_bodies && !pose) return refuse("swivel_draw: pose is null; give the one of the last solve");
    if (!has_bodies && pose) return refuse("swivel_draw: this crowd has no bodies, so it has no pose; give null");
    if (has_bodies)
        if (const swivel_status status = check_pose(*crowd, pose); status != SWIVEL_OK) return status;
    if (!shape_count) return refuse("swivel_draw: shape_count is null");
    if (!shapes && capacity > 0) return refuse("swivel_draw: shapes is null");
    Drawing drawing{shapes, capacity};
    const swivel_pose full = full_pose(pose);
    draw(*crowd, group, limb, has_bodies ? &full : nullptr, drawing);
    *shape_count = drawing.count;
    return SWIVEL_OK;
}
