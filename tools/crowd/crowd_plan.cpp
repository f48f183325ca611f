// SPDX-License-Identifier: MIT
#include "tools/crowd/crowd_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "swivel/swivel_regions.hpp"
#include "tools/crowd/crowd_checks.h"
#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

constexpr double kRadians = std::numbers::pi / 180;

std::array<float, 3> floats(const Eigen::Vector3d& v)
{
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
swivel_region_cone cone_of(const formats::ConeLimit& cone)
{
    const auto [x, y, z] = floats(cone.axis);
    return {{x, y, z}, static_cast<float>(kRadians * cone.opening_deg)};
}

// The upper bone's direction in each frame, in the arm frame.
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

// The region of a limb's upper bone from a crowd file: cones, polygons, and directions around the clip's own. Throws
// InputError that names line and key if it is no valid region.
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
            region.add_directions(directions_in(clip, limb), static_cast<float>(kRadians * given.clip_margin_deg),
                                  static_cast<std::uint32_t>(given.clip_cones));
        });
    return region.get();
}

using formats::CrowdFile;
using formats::LimbSettings;
using formats::Maybe;
using formats::PoleKind;

static_assert(static_cast<int>(formats::EulerOrder::zyx) == SWIVEL_ZYX &&
              static_cast<int>(formats::EulerOrder::yxz) == SWIVEL_YXZ);
swivel_euler_order order_of(const formats::BoxLimit& box) { return static_cast<swivel_euler_order>(box.order); }

// A limit as the solver takes it, from its front on.
struct LimitValue {
    swivel_field field;
    std::array<float, 12> value{};

    void put_range(const formats::NumberRange& deg, std::size_t at)
    {
        check(swivel_range(kRadians * deg.min, kRadians * deg.max, &value[at]));
    }
    void operator()(const formats::NumberRange& deg)
    {
        if (field == SWIVEL_FLEXION_LIMIT)
            check(swivel_flexion(kRadians * deg.min, kRadians * deg.max, value.data()));
        else
            put_range(deg, 0);
    }
    void operator()(const formats::ConeLimit& cone)
    {
        check(swivel_cone(cone.axis.data(), kRadians * cone.opening_deg, value.data()));
    }
    void operator()(const formats::TwistLimit& twist)
    {
        for (int n = 0; n < 3; ++n) value[static_cast<std::size_t>(n)] = static_cast<float>(twist.axis[n]);
        put_range(twist.range_deg, 3);
    }
    // Ranges about x, y and z in the order's own sequence.
    void operator()(const formats::BoxLimit& box)
    {
        constexpr std::size_t kAxes[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
        for (std::size_t n = 0; n < 3; ++n) put_range(box.about_deg[kAxes[order_of(box)][n]], 4 * n);
    }
};

// By PoleKind.
constexpr swivel_features kPoleFeatures[] = {
    0, SWIVEL_POLE_DIRECTION, SWIVEL_POLE_NORMAL, SWIVEL_POLE_INCOMING, SWIVEL_POLE_HAND, SWIVEL_POLE_HALF_LINE};

// Fills in one limb's plan, key by key.
struct Planner {
    const LimbSettings& from;
    const formats::Clip& clip;
    const Limb& limb;
    LimbSetup setup = following_setup(limb);
    goal_plan& goals = setup.goals;

    // Converts from the end joint's axes to those that it is solved in.
    Eigen::Vector3d in_hand(const Eigen::Vector3d& v) const
    {
        return parent_at_rest(clip, limb.end()).mirrored ? formats::mirrored(v) : v;
    }

    // Fixes the value of a field, for which the limb gets the features that the field needs.
    template <std::size_t Count>
    void fix(swivel_field field, const std::array<float, Count>& value, bool mirrored = false,
             swivel_euler_order order = SWIVEL_XYZ)
    {
        FixedField fixed{field, {}};
        std::copy(value.begin(), value.end(), fixed.value.begin());
        if (mirrored) check(swivel_mirror(field, order, fixed.value.data(), fixed.value.data()));
        setup.features |= describe(field).needs;
        setup.fields.push_back(fixed);
    }

    void goal()
    {
        goals.has_target_point = from.target_point.has_value();
        if (from.target_point) put(from.target_point->value, goals.target_point);
        if (from.target_offset) put(from.target_offset->value, goals.target_offset);
        if (from.hand && !from.hand->value) setup.features &= ~SWIVEL_WITH_HAND;
        if (from.effector) {
            const Eigen::Vector3d effector = in_hand(from.effector->value);
            put(effector, goals.effector);
            fix(SWIVEL_EFFECTOR, floats(effector));
        }
        if (from.twist_bones) setup.twist_bone_count = static_cast<std::uint32_t>(from.twist_bones->value);
    }

    void pole()
    {
        const PoleKind kind = from.pole_kind ? from.pole_kind->value : PoleKind::point;
        goals.pole = kind == PoleKind::point    ? GOAL_POLE_POINT
                     : kind == PoleKind::normal ? GOAL_POLE_NORMAL
                                                : GOAL_POLE_DIRECTION;
        setup.features |= kPoleFeatures[static_cast<std::size_t>(kind)];
        if (kind == PoleKind::half_line && limb.name.kind == formats::LimbKind::leg)
            put(knee_side(), setup.pole_behind);
        goals.has_pole_fixed = from.pole_fixed.has_value();
        if (from.pole_fixed) put(from.pole_fixed->value, goals.pole_fixed);
        if (from.pole_angle_deg)
            fix(SWIVEL_ANGLE, cos_sin(kRadians * from.pole_angle_deg->value), from.pole_angle_deg->mirrored);
        goals.holds_pole = from.pole_angle_deg || kind == PoleKind::hand || kind == PoleKind::half_line;
    }

    // No wrist goes behind the back, where an elbow points at rest, and no ankle, where a knee bends to.
    Eigen::Vector3d knee_side() const
    {
        return quaternion(limb.rest.shoulder_rotation) * Eigen::Vector3f(limb.rest.bend).cast<double>();
    }

    void aim()
    {
        if (!from.aim) return;
        setup.features &= ~SWIVEL_WITH_WEIGHTS;
        const Eigen::Vector3d axis = in_hand(from.aim->value.axis);
        std::array<float, 5> value;
        check(swivel_aim(axis.data(), kRadians * from.aim->value.flexion_deg, value.data()));
        fix(SWIVEL_AIM, value);
    }

    void clavicle()
    {
        if (!from.clavicle_share) return;
        put(limb.scale * formats::joint_at(clip, limb.upper()).offset, goals.shoulder_place);
        fix(SWIVEL_CLAVICLE, std::array{static_cast<float>(from.clavicle_share->value)});
    }

    void weights()
    {
        for (std::size_t n = 0; n < from.weights.size(); ++n)
            if (from.weights[n]) goals.weights[n] = static_cast<float>(from.weights[n]->value);
    }

    void reach()
    {
        std::array<float, 4> value{0, 0, 1, 0};
        if (std::ranges::none_of(from.reach, [](const auto& given) { return given.has_value(); })) return;
        for (std::size_t n = 0; n < value.size(); ++n)
            if (from.reach[n]) value[n] = static_cast<float>(from.reach[n]->value);
        fix(SWIVEL_REACH, value);
    }

    void swivel()
    {
        double max_deg = 180;
        if (from.step_deg_per_frame) max_deg = from.step_deg_per_frame->value;
        if (from.step_deg_per_second) max_deg = std::min(180.0, clip.frame_time * from.step_deg_per_second->value);
        if (from.step_deg_per_frame || from.step_deg_per_second)
            fix(SWIVEL_MAX_SWIVEL, cos_sin(in_a_60th(kRadians * max_deg)));
        if (from.step_wins && from.step_wins->value) setup.features |= SWIVEL_STEP_WINS;
    }

    // Converts a frame's step to SWIVEL_MAX_SWIVEL, a step for a 60th of a second: its half-tangent is proportional to
    // time.
    double in_a_60th(double in_a_frame) const
    {
        return 2 * std::atan(std::tan(std::min(in_a_frame, 3.1415) / 2) / (60 * clip.frame_time));
    }

    void limits()
    {
        for (std::size_t n = 0; n < from.limits.size(); ++n) {
            const Maybe<formats::Limit>& given = from.limits[n];
            if (!given) continue;
            const LimitInfo info = limit_info(n);
            LimitValue limit{info.field};
            std::visit(limit, given->value);
            swivel_euler_order order = SWIVEL_XYZ;
            if (const auto* const box = std::get_if<formats::BoxLimit>(&given->value))
                order = (info.is_of_hand ? setup.wrist_order : setup.shoulder_order) = order_of(*box);
            fix(info.field, limit.value, given->mirrored, order);
        }
    }
};

}  // namespace

void add_choice(const CrowdFile& file, LimbChoice& choice)
{
    if (choice.kinds.empty() && file.limbs) {
        choice.kinds = file.limbs->value;
        choice.kinds_source = {file.limbs->key, file.path, file.limbs->line};
    }
    for (const formats::LimbSection& section : file.sections) {
        const auto name = formats::limb_of_word(section.selector);
        if (!name) continue;
        const bool is_arm = name->kind == formats::LimbKind::arm;
        const auto& joints = section.settings.joints;
        if (joints && choice.kinds == (is_arm ? "legs" : "arms"))
            throw formats::InputError(file.path, joints->line,
                                      fmt::format("{}: {} solves no {}; solve \"all\", or take this out", joints->key,
                                                  kinds_words(choice), is_arm ? "arms" : "legs"));
        if (joints)
            (is_arm ? choice.arms : choice.legs)
                .push_back({joints->value, name->side, {joints->key, file.path, joints->line}});
        if (const auto& bend = section.settings.bend)
            choice.bends.push_back(
                {*name, bend->value, bend->key, formats::printable(file.path.string(), std::string::npos)});
    }
}

Eigen::Vector3d foot_of(const formats::Clip& clip, std::size_t frame_count)
{
    Eigen::Vector3d foot = Eigen::Vector3d::Zero();
    double ground = std::numeric_limits<double>::infinity();
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
        formats::world_pose(clip, frame, pose_w);
        if (frame == 0) foot = pose_w[0].position;
        for (const formats::JointPose& joint : pose_w) ground = std::min(ground, joint.position.y());
    }
    return {foot.x(), std::isfinite(ground) ? ground : 0, foot.z()};
}

void put_holding_last(const CrowdFile& file, std::vector<Limb>& limbs)
{
    require_can_hold(file, limbs);
    std::stable_partition(limbs.begin(), limbs.end(),
                          [&](const Limb& limb) { return !settings_of(file, limb.name).hold; });
}

CrowdPlan plan_crowd(const CrowdFile* file, const formats::Clip& clip, std::span<const Limb> limbs)
{
    CrowdPlan plan;
    plan.foot = foot_of(clip, clip.frame_count);
    std::ranges::transform(limbs, std::back_inserter(plan.limbs), following_setup);
    if (!file) return plan;
    require_solved(*file, limbs);
    if (file->characters) plan.characters = static_cast<std::uint32_t>(file->characters->value);
    if (file->seed) plan.seed = static_cast<std::uint64_t>(file->seed->value);
    if (file->spacing) plan.spacing = file->spacing->value;
    if (file->size) plan.size = file->size->value;
    if (file->heading_deg) plan.heading_deg = file->heading_deg->value;
    if (file->stagger) plan.stagger = file->stagger->value;
    if (file->budget_blocks) plan.budget_blocks = static_cast<std::uint32_t>(file->budget_blocks->value);
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        const LimbSettings settings = settings_of(*file, limbs[n].name);
        require_sense(*file, settings, clip, limbs[n]);
        Planner planner{settings, clip, limbs[n]};
        if (file->carry && limbs[n].name.kind == formats::LimbKind::arm) planner.setup.features &= ~SWIVEL_WITH_HAND;
        planner.goal();
        if (settings.hold) {
            const auto held = std::ranges::find(limbs, settings.hold->value, &Limb::name) - limbs.begin();
            planner.setup.features |= SWIVEL_WITH_LINK;
            planner.goals.holds = static_cast<std::uint32_t>(held + 1);
        }
        planner.pole();
        planner.aim();
        planner.clavicle();
        planner.weights();
        planner.reach();
        planner.swivel();
        planner.limits();
        if (settings.region) {
            planner.setup.features |= SWIVEL_WITH_REGION;
            planner.setup.region = region_of(*file, *settings.region, clip, limbs[n]);
        }
        plan.limbs[n] = std::move(planner.setup);
    }
    return plan;
}

LimbSetup following_setup(const Limb& limb)
{
    LimbSetup setup;
    setup.rest = limb.rest;
    setup.mirrored = limb.mirrored;
    setup.features = SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_RECORD;
    put(limb.as_solved(limb.upper_bone), setup.goals.bones[0]);
    put(limb.as_solved(limb.lower_bone), setup.goals.bones[1]);
    std::ranges::fill(setup.goals.weights, 1.0f);
    return setup;
}

std::vector<LimbSetup> limb_setups(const CrowdPlan& plan)
{
    std::vector<LimbSetup> setups = plan.limbs;
    for (LimbSetup& setup : setups) {
        goal_plan& goals = setup.goals;
        goals.hand_is_local = setup.has(SWIVEL_WITH_AIM);
        goals.goes_along = !goals.holds && !goals.has_target_point && Eigen::Vector3d(goals.target_offset).isZero(0) &&
                           !setup.has(SWIVEL_WITH_PLANT | SWIVEL_WITH_AIM);
        goals.clearance = setup.ground.toe_clearance;
    }
    if (plan.look) setups.push_back(plan.look->setup);
    return setups;
}

}  // namespace swivel::tools
