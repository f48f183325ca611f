// SPDX-License-Identifier: MIT
#include "tools/crowd/clip_crowd.h"

#include <algorithm>
#include <array>
#include <chrono>

#include "tools/crowd/heading.h"
#include "tools/crowd/parallel.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

static_assert(formats::kMaxTwistBones == SWIVEL_MAX_TWIST_BONES);  // a format knows no solver

std::vector<std::span<const goal_source>> sources_of(const ClipMotion& motion, std::size_t limb_count)
{
    std::vector<std::span<const goal_source>> sources;
    for (std::size_t limb = 0; limb < limb_count; ++limb) sources.push_back(motion.sources(limb));
    return sources;
}

}  // namespace

ClipCrowd::ClipCrowd(const formats::Clip& clip, std::span<const Limb> limbs, const CrowdPlan& plan)
    : clip_(clip),
      motion_(clip, limbs, plan),
      limbs_(limbs),
      plan_(plan),
      setups_(limb_setups(plan)),
      crowd_(setups_, sources_of(motion_, setups_.size()), characters_of(plan, limbs, motion_.frame_count()),
             plan.budget_blocks, plan.ground ? &*plan.ground : nullptr, clip.frame_time)
{
    given_at_.resize(limbs.size(), std::vector<std::int32_t>(plan.characters));
    rows_.resize(limbs.size() * plan.characters);
    if (columns().has_extras()) extras_.resize(rows_.size());
}

std::size_t ClipCrowd::limb_index(formats::LimbName name) const
{
    return static_cast<std::size_t>(std::ranges::find(limbs_, name, &Limb::name) - limbs_.begin());
}

// Whether the limb holds a box.
bool ClipCrowd::carries(std::size_t limb, std::uint32_t character) const
{
    return swivel_goal_carries(&motion_.sources(limb)[clip_frame(character)], &characters()[character]);
}

Vector3d ClipCrowd::headed(std::uint32_t character, Vector3d v) const
{
    turn_with(characters()[character], v.x(), v.z());
    return v;
}
Quaterniond ClipCrowd::headed(std::uint32_t character, const Quaterniond& q) const
{
    const goal_character& who = characters()[character];
    const HalfTurn turn = half_turn_of(who);
    return who.heading == 0 ? q : Quaterniond(turn.w, 0, turn.y, 0) * q;
}

Vector3d ClipCrowd::offset(std::size_t limb, std::uint32_t character) const
{
    return headed(character, Vector3d(setups_[limb].goals.target_offset));
}

// Whether elbow and upper arm should be as in the clip.
bool ClipCrowd::follows_clip(std::size_t limb, std::uint32_t character) const
{
    const LimbSetup& setup = setups_[limb];
    const goal_plan& goals = setup.goals;
    const bool has_own_goal = goals.holds || goals.has_target_point || !Vector3d(goals.target_offset).isZero(0) ||
                              given(limb, character) || carries(limb, character);
    const bool has_own_pole = goals.has_pole_fixed || goals.holds_pole;
    return !has_own_goal && !has_own_pole && !setup.has(SWIVEL_WITH_AIM | SWIVEL_WITH_CLAVICLE) && !crowd_.has_ground();
}

const formats::Target* ClipCrowd::given(std::size_t limb, std::uint32_t character) const
{
    const std::int32_t at = given_at_[limb][character];
    return at < 0 ? nullptr : &given_[static_cast<std::size_t>(at)];
}

// Parts that a given target lacks stay as planned.
void ClipCrowd::set_given(std::size_t limb, std::uint32_t character)
{
    const LimbSetup& setup = setups_[limb];
    const formats::Target& target = *given(limb, character);
    goal_input& input = crowd_.input(limb, character);
    put(target.position + offset(limb, character), input.target);
    std::copy_n(setup.goals.weights, 2, input.weights);
    if (target.has_pole && !setup.goals.has_pole_fixed) {
        put(target.pole, input.pole);
        input.weights[2] = setup.goals.weights[2];
    }
    if (target.has_orientation && !setup.has(SWIVEL_WITH_AIM)) put(target.orientation.coeffs(), input.hand);
}

// The target as given or made, without the plan's offset.
formats::Target ClipCrowd::target(std::size_t limb, std::uint32_t character) const
{
    const goal_input& input = crowd_.input(limb, character);
    const formats::Target* const told = given(limb, character);
    formats::Target target;
    target.position = told ? told->position : Vector3d(Vector3d(input.target) - offset(limb, character));
    target.pole = Vector3d(input.pole);
    target.orientation =
        told && told->has_orientation ? told->orientation : headed(character, in_clip(limb, character).hand);
    target.frame = static_cast<std::uint32_t>(frame_);
    target.character = character;
    target.limb = limbs_[limb].name;
    target.has_pole =
        crowd_.has(limb, SWIVEL_POLE) && (!setups_[limb].has(SWIVEL_WITH_WEIGHTS) || input.weights[2] > 0);
    target.has_orientation = true;
    return target;
}

double ClipCrowd::length(std::size_t limb, std::uint32_t character) const
{
    const goal_source& source = motion_.sources(limb)[clip_frame(character)];
    return characters()[character].size * (source.lengths[0] + source.lengths[1]);
}

void ClipCrowd::set_frame(std::size_t frame, std::span<const formats::Target> given)
{
    frame_ = frame;
    crowd_.set_frame(static_cast<std::uint32_t>(frame));
    for (std::vector<std::int32_t>& at : given_at_) std::ranges::fill(at, -1);
    given_.assign(given.begin(), given.end());
    for (std::size_t n = 0; n < given_.size(); ++n) {
        const std::size_t limb = limb_index(given_[n].limb);
        given_at_[limb][given_[n].character] = static_cast<std::int32_t>(n);
        set_given(limb, given_[n].character);
    }
}

std::vector<GivenPlace> ClipCrowd::given_places() const
{
    std::vector<GivenPlace> places;
    for (const formats::Target& target : given_) places.push_back({limb_index(target.limb), target.character});
    return places;
}

void ClipCrowd::solve(Statistics& statistics)
{
    const auto before = std::chrono::steady_clock::now();
    crowd_.solve();
    statistics.solve_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

formats::PoseRow ClipCrowd::pose(std::size_t limb, std::uint32_t character) const
{
    formats::PoseRow row = solved_pose(limb, character);
    crowd_.read(limb, SWIVEL_FLAGS, character, 1, {&row.flags, sizeof row.flags});
    const LimbInClip& from = in_clip(limb, character);
    const LimbChain& chain = limbs_[limb].chain;
    const auto is_none = [](const Quaterniond& q) { return q.vec().isZero(0); };
    // The joints of most skeletons are the solver's own, to the last bit.
    if (chain.is_plain && is_none(from.upper_aim) && is_none(from.fore_aim)) return row;
    const auto unaimed = [&](const Quaterniond& aimed) { return limbs_[limb].as_solved(aimed).conjugate(); };
    const Quaterniond shoulder = quaternion(row.shoulder), fore = shoulder * quaternion(row.elbow);
    const std::array<Quaterniond, 3> own = local_rotations(
        clip_, clip_frame(character), chain,
        {shoulder * unaimed(from.upper_aim), fore * unaimed(from.fore_aim), fore * quaternion(row.wrist)});
    put(own[0].coeffs(), row.shoulder);
    put(own[1].coeffs(), row.elbow);
    put(own[2].coeffs(), row.wrist);
    return row;
}

formats::PoseRow ClipCrowd::solved_pose(std::size_t limb, std::uint32_t character) const
{
    formats::PoseRow row;
    const goal_character& who = characters()[character];
    row.character = character;
    row.place = std::to_array(who.place);
    row.place[1] += double{crowd_.rise(character)};
    row.size = who.size;
    row.start = who.first + who.start;
    row.heading_deg = degrees_of(who);
    if (!plan_.agents.empty()) row.name = plan_.agents[character].name;
    row.limb = limbs_[limb].name;
    row.shoulder = crowd_.rotation(limb, character, 1);
    row.elbow = crowd_.rotation(limb, character, 2);
    if (crowd_.has(limb, SWIVEL_WRIST))
        row.wrist = crowd_.rotation(limb, character, 3);
    else
        put(limbs_[limb].as_solved(in_clip(limb, character).local_wrist()).coeffs(), row.wrist);
    return row;
}

Quaterniond ClipCrowd::clavicle(std::size_t limb, std::uint32_t character) const
{
    float turn[4];
    crowd_.read(limb, SWIVEL_CLAVICLE_ROTATION, character, 1, {turn, sizeof turn});
    return in_clip(limb, character).local_parent * Quaterniond(turn[3], turn[0], turn[1], turn[2]);
}

Quaterniond ClipCrowd::looking(std::size_t joint, std::uint32_t character) const
{
    return quaternion(crowd_.rotation(limbs_.size(), character, 1 + joint));
}

formats::PoseExtra ClipCrowd::extra(std::size_t limb, std::uint32_t character) const
{
    formats::PoseExtra extra;
    if (crowd_.has(limb, SWIVEL_STRETCH))
        crowd_.read(limb, SWIVEL_STRETCH, character, 1, {&extra.stretch, sizeof extra.stretch});
    if (setups_[limb].has(SWIVEL_WITH_CLAVICLE)) {
        extra.has_clavicle = true;
        put(clavicle(limb, character).coeffs(), extra.clavicle);
    }
    extra.twist_count = setups_[limb].twist_bone_count;
    for (unsigned n = 0; n < extra.twist_count; ++n) extra.twist[n] = crowd_.rotation(limb, character, GOAL_JOINTS + n);
    return extra;
}

formats::PoseColumns ClipCrowd::columns() const
{
    formats::PoseColumns columns;
    for (const LimbSetup& limb : setups_) {
        columns.stretch = columns.stretch || limb.has(SWIVEL_WITH_REACH);
        columns.clavicle = columns.clavicle || limb.has(SWIVEL_WITH_CLAVICLE);
        columns.twist_count = std::max(columns.twist_count, limb.twist_bone_count);
    }
    columns.heading = plan_.has_headings();
    columns.name = !plan_.agents.empty();
    return columns;
}

template <class Row, class Make>
std::span<const Row> ClipCrowd::rows_of(std::vector<Row>& rows, const Make& make) const
{
    for_ranges(character_count(), [&](std::uint32_t begin, std::uint32_t end) {
        for (std::uint32_t n = begin; n < end; ++n)
            for (std::size_t limb = 0; limb < limbs_.size(); ++limb) rows[n * limbs_.size() + limb] = make(limb, n);
    });
    return rows;
}

std::span<const formats::Target> ClipCrowd::targets()
{
    targets_.resize(rows_.size());
    rows_of(targets_, [&](std::size_t limb, std::uint32_t character) { return target(limb, character); });
    std::erase_if(targets_, [&](const formats::Target& each) {  // targets that no limb follows
        const std::size_t limb = limb_index(each.limb);
        if (setups_[limb].goals.holds) return true;
        return crowd_.has_ground() && setups_[limb].goals.goes_along && !given(limb, each.character) &&
               !carries(limb, each.character);
    });
    return targets_;
}

std::span<const formats::PoseRow> ClipCrowd::poses()
{
    return rows_of(rows_, [&](std::size_t limb, std::uint32_t character) { return pose(limb, character); });
}

std::span<const formats::PoseExtra> ClipCrowd::extras()
{
    if (extras_.empty()) return {};
    return rows_of(extras_, [&](std::size_t limb, std::uint32_t character) { return extra(limb, character); });
}

}  // namespace swivel::tools
