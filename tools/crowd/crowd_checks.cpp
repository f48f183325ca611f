// SPDX-License-Identifier: MIT
#include "tools/crowd/crowd_checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/formats/error.h"
#include "tools/formats/text.h"
#include "tools/rig/limb_words.h"

namespace swivel::tools {

namespace {

using formats::CrowdFile;
using formats::Given;
using formats::InputError;
using formats::LimbSettings;
using formats::PoleKind;

template <class T>
[[noreturn]] void refuse(const CrowdFile& file, const Given<T>& given, std::string_view cause)
{
    throw InputError(file.path, given.line, fmt::format("{}: {}", given.key, cause));
}

// Refuses the first of them that is given. There may be lists among them.
void refuse_given(const CrowdFile& file, std::string_view cause, const auto&... given)
{
    const auto check = [&](const auto& each) {
        if (each) refuse(file, *each, cause);
    };
    const auto check_all = [&](const auto& one_or_many) {
        if constexpr (requires { one_or_many.begin(); })
            std::ranges::for_each(one_or_many, check);
        else
            check(one_or_many);
    };
    (check_all(given), ...);
}

std::vector<formats::Maybe<formats::Limit>> hand_limits(const LimbSettings& settings)
{
    std::vector<formats::Maybe<formats::Limit>> limits;
    for (std::size_t n = 0; n < settings.limits.size(); ++n)
        if (limit_info(n).is_of_hand) limits.push_back(settings.limits[n]);
    return limits;
}

void require_no_idle_key(const CrowdFile& file, const LimbSettings& s)
{
    // None of these is given beside what makes it mean nothing.
    const auto refuse_beside = [&](const auto& what, std::string_view value, const auto&... useless) {
        const std::string cause =
            fmt::format("means nothing beside {}{} in line {}; take one of them out", what->key, value, what->line);
        refuse_given(file, cause, useless...);
    };
    const bool has_no_hand = s.hand && !s.hand->value;
    const auto has_pole = [&](PoleKind kind) { return s.pole_kind && s.pole_kind->value == kind; };
    if (has_no_hand) refuse_beside(s.hand, " = false", s.effector, s.weights[1], hand_limits(s), s.twist_bones, s.aim);
    if (has_pole(PoleKind::hand)) refuse_beside(s.pole_kind, " = \"hand\"", s.pole_fixed, s.aim);
    if (has_pole(PoleKind::hand) && has_no_hand) refuse_beside(s.hand, " = false", s.pole_kind);
    if (has_pole(PoleKind::half_line)) refuse_beside(s.pole_kind, " = \"half_line\"", s.pole_fixed);
    if (s.hold) refuse_beside(s.hold, "", s.aim, s.target_point, s.target_offset);
    if (s.hold && has_no_hand) refuse_beside(s.hand, " = false", s.hold);
    if (s.aim) refuse_beside(s.aim, "", s.weights, s.reach, s.limits[0], hand_limits(s));
    if (has_pole(PoleKind::incoming)) refuse_beside(s.pole_kind, " = \"incoming\"", s.pole_fixed, s.weights[2]);
    const bool points = has_pole(PoleKind::direction) || has_pole(PoleKind::normal);
    if (points && s.pole_fixed && !(s.pole_fixed->value.stableNorm() > 1e-15))
        refuse(file, *s.pole_fixed,
               fmt::format("has no length, so no direction, and {} in line {} wants one; write [x, y, z], not all of "
                           "them 0",
                           s.pole_kind->key, s.pole_kind->line));
    if (s.step_wins && s.step_wins->value && !s.step_deg_per_frame && !s.step_deg_per_second)
        refuse(file, *s.step_wins,
               "means nothing without max_deg_per_second or max_deg_per_frame; give that, or take this out");
}

void require_own_clavicle(const CrowdFile& file, const LimbSettings& s, const formats::Clip& clip, const Limb& limb)
{
    if (!s.clavicle_share) return;
    const std::string name = plain_name(limb.name);
    const auto refuse_clavicle = [&](const std::string& cause) { refuse(file, *s.clavicle_share, cause); };
    const int above = formats::joint_at(clip, limb.upper()).parent;
    if (above < 0) refuse_clavicle(fmt::format("there is no joint above the {}", name));
    const formats::Joint& joint = formats::joint_at(clip, above);
    const std::string shown = fmt::format("the joint above the {}, {},", name, printable_name(joint));
    if (formats::child_joints(clip, above).size() > 1)
        refuse_clavicle(shown + " carries other joints, which would turn along");
    if (formats::joint_at(clip, limb.upper()).offset.isZero(0))
        refuse_clavicle(fmt::format("the {} starts where the joint above it is; there is no bone to turn", name));
    if (limb.mirrored || joint.rest_scale.minCoeff() < 0 || joint.scale_track >= 0)
        refuse_clavicle(shown + " is mirrored or changes its scale; such a joint is not turned");
}

void require_can_stand(const CrowdFile& file, const LimbSettings& s)
{
    const std::string cause =
        fmt::format("keeps a leg from standing on the ground of line {}; take one of them out", file.ground->line);
    refuse_given(file, cause, s.hold, s.aim, s.target_point, s.reach);
    if (s.hand && !s.hand->value) refuse_given(file, cause, s.hand);
}

void require_can_carry(const CrowdFile& file, const LimbSettings& s)
{
    const std::string cause = fmt::format(
        "is of a hand's goal, and with the table of line {}, carry, hands go along with forearms; take one "
        "of them out",
        file.carry->line);
    if (s.hand && s.hand->value) refuse_given(file, cause, s.hand);
    if (s.pole_kind && s.pole_kind->value == PoleKind::hand) refuse_given(file, cause, s.pole_kind);
    refuse_given(file, cause, s.aim, s.effector, s.weights[1], hand_limits(s), s.twist_bones);
}

}  // namespace

std::string checked_targets(const CrowdFile& file)
{
    if (!file.targets || file.targets->value == "clip") return "clip";
    if (formats::is_standard_stream(file.targets->value)) return file.targets->value;
    const std::filesystem::path path = beside(file, *file.targets);
    std::error_code unknown;
    if (std::filesystem::is_fifo(path, unknown)) return path.string();  // opened twice it would lose its writer
    try {
        formats::open_text(path);
    } catch (const InputError& error) {
        refuse(file, *file.targets, error.what());
    }
    return path.string();
}

LimitInfo limit_info(std::size_t limit)
{
    std::string name(formats::kLimitKeys[limit]);
    if (name.ends_with("_deg")) name.resize(name.size() - 4);
    swivel_field_info info{};
    for (std::uint32_t n = 0; swivel_describe_field(n, &info) && info.name != name && info.name != name + "_limit";)
        ++n;
    swivel_feature_info brings{};
    for (std::uint32_t n = 0; swivel_describe_feature(n, &brings) && brings.feature != info.needs;) ++n;
    return {info.field, (brings.needs & SWIVEL_WITH_HAND) != 0};
}

void require_sense(const CrowdFile& file, const LimbSettings& s, const formats::Clip& clip, const Limb& limb)
{
    require_no_idle_key(file, s);
    require_own_clavicle(file, s, clip, limb);
    if (s.step_deg_per_second && clip.frame_time == 0)
        refuse(file, *s.step_deg_per_second, "needs even frames, and the clip's keys lie at uneven times; give --fps");
    const bool is_leg = limb.name.kind == formats::LimbKind::leg;
    if (file.ground && is_leg) require_can_stand(file, s);
    if (file.carry && !is_leg) require_can_carry(file, s);
}

void require_can_hold(const CrowdFile& file, std::span<const Limb> limbs)
{
    for (const Limb& limb : limbs) {
        const LimbSettings settings = settings_of(file, limb.name);
        if (!settings.hold) continue;
        const auto refuse_hold = [&](const std::string& cause) { refuse(file, *settings.hold, cause); };
        const formats::LimbName held = settings.hold->value;
        const std::string name = plain_name(held);
        if (held == limb.name) refuse_hold("is this limb itself; name the other one");
        if (std::ranges::find(limbs, held, &Limb::name) == limbs.end())
            refuse_hold(fmt::format("the {} is not solved; see crowd.limbs", name));
        const LimbSettings of_held = settings_of(file, held);
        if (of_held.hold)
            refuse_hold(fmt::format("the {} holds something itself, by line {}; take one of them out", name,
                                    of_held.hold->line));
        const bool has_arm = limb.name.kind == formats::LimbKind::arm || held.kind == formats::LimbKind::arm;
        if (file.carry && has_arm)
            refuse_hold(fmt::format("hands that carry a box, by line {}, hold nothing else; take one of them out",
                                    file.carry->line));
        if (of_held.hand && !of_held.hand->value)
            refuse_hold(
                fmt::format("the {} goes without a hand, by line {}; take one of them out", name, of_held.hand->line));
    }
}

void require_solved(const CrowdFile& file, std::span<const Limb> limbs)
{
    for (const formats::LimbSection& section : file.sections) {
        const auto is_meant = [&](const Limb& limb) { return selects(section.selector, limb.name); };
        if (std::any_of(limbs.begin(), limbs.end(), is_meant)) continue;
        throw InputError(file.path, section.line,
                         fmt::format("limb.{}: no such limb is solved; see crowd.limbs and limb.*.joints, or --limbs",
                                     section.selector));
    }
}

void require_fits_motion(const CrowdFile& file, std::span<const Limb> limbs)
{
    for (const Limb& limb : limbs) {
        const LimbSettings settings = settings_of(file, limb.name);
        if (const auto& stretch = settings.reach[2]; stretch && stretch->value > 1)
            refuse(
                file, *stretch,
                "the bones of a written clip keep their length; write a .csv, which has the stretch, or take this out");
        if (settings.twist_bones && settings.twist_bones->value > 0)
            refuse(file, *settings.twist_bones,
                   "a written clip keeps the joints it has; write a .csv, which has the twist bones, or take this out");
    }
}

}  // namespace swivel::tools
