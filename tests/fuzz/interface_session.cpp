// SPDX-License-Identifier: MIT
#include "tests/fuzz/interface_session.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace swivel::fuzz {

SomeLimbs Session::limbs_that(bool are) const
{
    SomeLimbs limbs;
    for (std::uint32_t group = 0; group < group_count; ++group)
        limbs.emplace_back(swivel_group_limb_count(crowd, group), are);
    return limbs;
}

Limbs take_limbs(Session& session)
{
    Bytes& bytes = session.bytes;
    Limbs limbs;
    limbs.group = bytes.below(session.group_count);
    const std::uint32_t has = swivel_group_limb_count(session.crowd, limbs.group);
    limbs.first = bytes.below(has + 1);
    limbs.count = bytes.below(has - limbs.first + 1);
    if (!bytes.one_in(16)) return limbs;
    limbs.is_valid = false;
    switch (bytes.take<std::uint8_t>() % 3) {
        case 0:
            limbs.group = session.group_count + bytes.take<std::uint32_t>() / 2;
            break;
        case 1:
            limbs.first = has + 1 + bytes.take<std::uint32_t>() / 2;
            break;
        default:
            limbs.count = has - limbs.first + 1 + bytes.take<std::uint32_t>() / 2;
    }
    return limbs;
}

std::uint32_t component_count(const Session& session, std::uint32_t group, swivel_field field)
{
    return swivel_field_row_count(session.crowd, group, field);
}

bool has_features(const Session& session, std::uint32_t group, swivel_features features)
{
    return (swivel_group_features(session.crowd, group) & features) != 0;
}

bool is_of(const Session& session, std::uint32_t group, swivel_kind kind)
{
    return swivel_group_kind(session.crowd, group) == kind;
}
bool has_limbs(const Session& session, std::uint32_t group)
{
    return is_of(session, group, SWIVEL_KIND_LIMB) || is_of(session, group, SWIVEL_KIND_BODY_LIMB);
}

bool is_known(const Session& session, std::uint32_t group)
{
    if (!has_limbs(session, group)) return false;
    return !session.bodies || has_features(session, group, SWIVEL_WITH_RECORD);
}

bool is_bad(const Session& session, std::uint32_t group, std::uint32_t limb)
{
    std::uint32_t flags = 0;
    swivel_read(session.crowd, SWIVEL_FLAGS, group, limb, 1, {&flags, sizeof flags});
    return flags == SWIVEL_BAD_INPUT;
}
bool is_kept(const Session& session, std::uint32_t group, std::uint32_t limb)
{
    const bool keeps = session.bodies ? session.bodies->groups[group].keeps_pose()
                                      : session.limb_defs[group].on_bad_input == SWIVEL_KEEP_POSE;
    return keeps && is_bad(session, group, limb);
}

bool is_overwritten(const Session& session, std::uint32_t group, std::uint32_t limb)
{
    if (!session.bodies) return session.is_overwritten[group][limb];
    return std::ranges::any_of(session.is_overwritten, [&](const auto& of) { return of[limb]; });
}

bool is_position(swivel_field field) { return described(field).is_position != 0; }
bool is_carried(swivel_field field) { return described(field).kind == SWIVEL_FIELD_CARRIED; }
bool is_direction(const Session& session, std::uint32_t group, swivel_field field)
{
    return field == SWIVEL_POLE && has_features(session, group, SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL);
}

void check_status(const Session& session, swivel_status status, bool expected)
{
    SWIVEL_REQUIRE((status == SWIVEL_OK) == expected);
    if (expected) return;
    SWIVEL_REQUIRE(status == SWIVEL_INVALID_ARGUMENT);
    const std::string_view said = swivel_last_error();
    SWIVEL_REQUIRE(!said.empty() && said.find('\n') == std::string_view::npos);
    SWIVEL_REQUIRE(session.arena.size() == session.arena_before.size());
    SWIVEL_REQUIRE(std::memcmp(session.arena.data(), session.arena_before.data(), session.arena.size()) == 0);
}

void check_solved(Session& session, const SomeLimbs& chosen)
{
    for (std::uint32_t group = 0; group < session.group_count; ++group)
        for (std::uint32_t limb = 0; limb < chosen[group].size(); ++limb) {
            if (!chosen[group][limb]) continue;
            session.is_solved[group][limb] = true;
            if (!is_overwritten(session, group, limb)) check_results(session, group, limb);
            if (!session.bodies) check_alone(session, group, limb);
        }
    check_others(session, chosen);
}

}  // namespace swivel::fuzz
