// SPDX-License-Identifier: MIT
#include "tools/corpus/standing.h"

#include <algorithm>

#include "tools/corpus/hard_cases.h"
#include "tools/corpus/vectors.h"

namespace swivel::corpus {

namespace {

double between(double from, double to, double share) { return from + share * (to - from); }
template <class Values>
void put_between(const Values& from, const Values& to, double share, float* at)
{
    for (std::size_t n = 0; n < from.size(); ++n) at[n] = static_cast<float>(between(from[n], to[n], share));
}

// From 0 to 1 and back, smoothly, in 65,536 steps. It rests for a sixth of the way at both ends.
double swing_of(std::uint32_t step)
{
    const double way = static_cast<double>(step & 0xffff) / 32768, there = way < 1 ? way : 2 - way;
    const double share = std::min(std::max(1.5 * there - 0.25, 0.0), 1.0);
    return share * share * (3 - 2 * share);
}

void take_nearer_sign(const std::array<float, 4>& from, std::array<float, 4>& to)
{
    double dot = 0;
    for (std::size_t n = 0; n < 4; ++n) dot += double{from[n]} * double{to[n]};
    for (float& x : to) x = dot < 0 ? -x : x;
}

// The number as a float holds it. g++ 12 leaves the rounding out of pairs of numbers, unless the float is volatile.
double as_float(double x)
{
    const volatile float rounded = static_cast<float>(x);
    return double{rounded};
}

Vector root_of(const Recipe& recipe, const Body& body)
{
    const auto& [x, y, z] = body.root_position;
    if (recipe.pose & kFar) return {x, y, z};
    return {as_float(x), as_float(y), as_float(z)};
}

Mover mover_of(const Recipe& recipe, std::uint32_t n, const std::array<Body, 2>& poses)
{
    Mover mover{stream(recipe.seed, 0, "motion", Use::value, n), poses[0], poses[1], {}, {}, {}, {}, {}, {}, {}};
    for (std::size_t joint = 0; joint < mover.to.rotations.size(); ++joint)
        take_nearer_sign(mover.from.rotations[joint], mover.to.rotations[joint]);
    take_nearer_sign(mover.from.root_rotation, mover.to.root_rotation);
    Random& random = mover.random;
    mover.root_way = random_vector(random, 1);
    for (std::size_t k = 0; k < 2; ++k) {
        mover.supports[k] = random_vector(random, 1);
        mover.support_ways[k] = random_vector(random, 0.5);
        for (auto& rotation : mover.support_rotations[k]) rotation = floats(random_rotation(random, 0.5, 2));
        take_nearer_sign(mover.support_rotations[k][0], mover.support_rotations[k][1]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
        mover.starts[k] = random.below(65536);
        mover.speeds[k] = 100 + random.below(1000);
    }
    return mover;
}

}  // namespace

Standing::Standing(const Recipe& recipe, std::uint32_t body_count)
    : recipe_(recipe), skeleton_(skeleton_of(recipe)), poses_(make_poses(recipe, body_count, 0))
{
    const std::vector<Body> from = bodies_of(recipe, body_count, 0), to = bodies_of(recipe, body_count, 1);
    for (std::uint32_t n = 0; n < body_count; ++n) {
        movers_.push_back(mover_of(recipe, n, {from[n], to[n]}));
        poses_.root_scales[n] = from[n].root_scale;
    }
    for (std::uint32_t group = 0; group < kGroupCount; ++group)
        for (std::uint32_t k = 0; k < 2; ++k) {
            const std::vector<Arm> arms = body_arms(recipe, group, body_count, k);
            for (std::uint32_t n = 0; n < body_count; ++n) {
                const Vector root = recipe.pose & kFar ? Vector{0, 0, 0} : root_of(recipe, k == 0 ? from[n] : to[n]);
                movers_[n].goals[k][group] = vector_of(arms[n].target) - root;
            }
        }
    const bool is_far = recipe.pose & kFar;
    poses_.times.resize(body_count);
    if (recipe.pose & kSupports) {
        poses_.support_rotations.resize(std::size_t{4} * body_count);
        if (is_far)
            poses_.far_supports.resize(std::size_t{3} * body_count);
        else
            poses_.support_positions.resize(std::size_t{3} * body_count);
    }
    for (std::uint32_t group = 0; group < kGroupCount; ++group) {
        rows_.contacts[group].resize(body_count);
        rows_.next_times[group].resize(body_count);
        rows_.next_targets[group].resize(std::size_t{3} * body_count);
        rows_.targets[group].resize(std::size_t{3} * body_count);
        if (is_far && features_of(recipe, group) & SWIVEL_WITH_NEXT_TARGET)
            poses_.far_next_targets[group].resize(std::size_t{3} * body_count);
    }
    if (is_far) poses_.far_targets[kGroupCount - 1].resize(std::size_t{3} * body_count);
    rows_.shift_wishes.resize(body_count);
    if (recipe.features & SWIVEL_WITH_GROUND || recipe.holds != Holds::nothing) holding_.emplace(recipe, from, poses_);
    if (recipe.pose & kLooks) looking_.emplace(recipe, from, poses_);
}

void Standing::set_joints(std::uint32_t n, double swing)
{
    const Mover& mover = movers_[n];
    Body body = mover.from;
    for (std::size_t joint = 0; joint < poses_.joint_count; ++joint) {
        put_between(mover.from.rotations[joint], mover.to.rotations[joint], swing, body.rotations[joint].data());
        put_between(mover.from.translations[joint], mover.to.translations[joint], swing,
                    body.translations[joint].data());
    }
    if (poses_.is_in_body) body = in_body_space(skeleton_, body);
    float* rotation = &poses_.rotations[std::size_t{4} * poses_.joint_count * n];
    for (std::size_t joint = 0; joint < poses_.joint_count; ++joint, rotation += 4)
        std::copy(body.rotations[joint].begin(), body.rotations[joint].end(), rotation);
    if (poses_.translations.empty()) return;
    float* translation = &poses_.translations[std::size_t{3} * poses_.joint_count * n];
    for (std::size_t joint = 0; joint < poses_.joint_count; ++joint, translation += 3)
        std::copy(body.translations[joint].begin(), body.translations[joint].end(), translation);
}

void Standing::set_root(std::uint32_t n, double swing)
{
    const Mover& mover = movers_[n];
    const Vector root = root_of(recipe_, mover.from) + swing * mover.root_way;
    if (recipe_.pose & kFar)
        put_vector(root, &poses_.far_roots[3 * n]);
    else
        put_vector(root, &poses_.root_positions[3 * n]);
    put_between(mover.from.root_rotation, mover.to.root_rotation, swing, &poses_.root_rotations[4 * n]);
}

Vector Standing::root_now(std::uint32_t n) const
{
    const bool is_far = recipe_.pose & kFar;
    const double* const far = is_far ? &poses_.far_roots[3 * n] : nullptr;
    const float* const near = is_far ? nullptr : &poses_.root_positions[3 * n];
    return far ? Vector{far[0], far[1], far[2]} : Vector{near[0], near[1], near[2]};
}

// Where limbs go next, and where the last group's points are, whatever the pose says.
void Standing::set_goals(std::uint32_t n, double swing, bool rests)
{
    Mover& mover = movers_[n];
    const Vector root = root_now(n);
    for (std::uint32_t group = 0; group < kGroupCount; ++group) {
        const bool flickers = mover.random.below(32) == 0, is_weak = mover.random.below(4) == 0;
        rows_.contacts[group][n] = is_weak ? (rests != flickers ? 0.75f : 0.25f) : (rests != flickers ? 1.0f : 0.0f);
        rows_.next_times[group][n] = static_cast<float>(0.5 * (1 - swing));
        const Vector goal = root + between(mover.goals[0][group], mover.goals[1][group], swing);
        put_vector(goal, &rows_.next_targets[group][3 * n]);
        put_vector(goal, &rows_.targets[group][3 * n]);
        if (!poses_.far_next_targets[group].empty()) put_vector(goal, &poses_.far_next_targets[group][3 * n]);
        if (!poses_.far_targets[group].empty()) put_vector(goal, &poses_.far_targets[group][3 * n]);
    }
    rows_.shift_wishes[n] = static_cast<float>(0.1 * (swing - 0.5));
    if (!has_prop(recipe_) || n / 8 % 2 == 0) return;
    // Half of those with props hold them as the pose has it.
    constexpr std::uint32_t last = kGroupCount - 1;
    std::fill_n(&rows_.targets[last][3 * n], 3, kNan);
    if (!poses_.far_targets[last].empty()) std::fill_n(&poses_.far_targets[last][3 * n], 3, double{kNan});
}

Support Standing::support_of(std::uint32_t n, std::uint32_t k, double swing) const
{
    const Mover& mover = movers_[n];
    const Vector position = root_of(recipe_, mover.from) + mover.supports[k] + swing * mover.support_ways[k];
    Support support{{position.x, position.y, position.z}, {}};
    if (!(recipe_.pose & kFar))
        for (double& x : support.position) x = as_float(x);
    put_between(mover.support_rotations[k][0], mover.support_rotations[k][1], swing, support.rotation.data());
    return support;
}
void Standing::set_support(std::uint32_t n, const Support& support)
{
    for (std::size_t c = 0; c < 3; ++c) {
        if (recipe_.pose & kFar)
            poses_.far_supports[3 * n + c] = support.position[c];
        else
            poses_.support_positions[3 * n + c] = static_cast<float>(support.position[c]);
    }
    std::copy(support.rotation.begin(), support.rotation.end(), &poses_.support_rotations[4 * n]);
}

void Standing::spoil_body(std::uint32_t n)
{
    Random& random = movers_[n].random;
    std::vector<float>* const values[] = {&poses_.rotations,         &poses_.root_rotations,    &poses_.times,
                                          &rows_.contacts[0],        &rows_.next_times[1],      &rows_.next_targets[2],
                                          &rows_.targets[2],         &poses_.support_rotations, &poses_.root_positions,
                                          &poses_.support_positions, &rows_.shift_wishes};
    std::vector<float>& chosen = *values[random.below(static_cast<std::uint32_t>(std::size(values)))];
    const std::size_t each = chosen.size() / movers_.size();
    spoil(random, std::span(chosen).subspan(n * each, each), each == 1 ? 1 : 8);
}

void Standing::move_body(std::uint32_t frame, std::uint32_t n)
{
    Mover& mover = movers_[n];
    const auto swing = [&](std::size_t k) { return swing_of(mover.starts[k] + frame * mover.speeds[k]); };
    const double pose = swing(0);
    set_joints(n, pose);
    set_root(n, swing(1));
    set_goals(n, pose, pose <= 0 || pose >= 1);
    if (recipe_.pose & kSupports) set_support(n, support_of(n, mover.stands_on, swing(2)));
    if (holding_) holding_->move_body(n, root_now(n), swing(2), poses_);
    if (looking_) looking_->move_body(n, root_now(n), swing(2), poses_);
    const std::uint32_t kind = mover.random.below(16);
    const double time = mover.random.between(0.004, 0.03);
    poses_.times[n] = static_cast<float>(kind == 0 ? 0 : kind == 1 ? 40 * time : time);
}

// Now and then a limb starts anew, and a body comes to stand on another thing.
void Standing::change_carried(std::uint32_t frame, std::uint32_t n, Crowd& crowd)
{
    Mover& mover = movers_[n];
    const std::uint32_t group_count = kGroupCount + (has_shift(recipe_) ? 1 : 0) + (looking_ ? kLookCount : 0);
    const bool resets = mover.random.below(256) == 0, changes = mover.random.below(64) == 0;
    if (resets) {
        carried_.push_back({mover.random.below(group_count), n, {}});
        reset_limb(crowd, carried_.back().group, n);
    }
    if (!changes || !(recipe_.pose & kSupports)) return;
    const double swing = swing_of(mover.starts[2] + frame * mover.speeds[2]);
    const Support before = support_of(n, mover.stands_on, swing), after = support_of(n, 1 - mover.stands_on, swing);
    mover.stands_on = 1 - mover.stands_on;
    for (std::uint32_t group = 0; group < kGroupCount; ++group) {
        if (!(features_of(recipe_, group) & SWIVEL_WITH_PLANT)) continue;
        carried_.push_back({group, n, {{before, after}}});
        change_support(crowd, group, n, before, after);
    }
}

// Leaves out some bodies in every fourth frame.
void Standing::choose(std::uint32_t frame)
{
    poses_.mask.clear();
    if (frame % 4 != 3) return;
    poses_.mask.resize((movers_.size() + 31) / 32);
    for (std::size_t n = 0; n < movers_.size(); ++n)
        if (movers_[n].random.below(8) != 0) poses_.mask[n / 32] |= 1u << n % 32;
}

void Standing::go_to(std::uint32_t frame, Crowd& crowd)
{
    carried_.clear();
    for (std::uint32_t n = 0; n < movers_.size(); ++n) {
        change_carried(frame, n, crowd);
        move_body(frame, n);
        if (movers_[n].random.below(64) == 0) spoil_body(n);
    }
    choose(frame);
    const bool is_far = recipe_.pose & kFar;
    for (std::uint32_t group = 0; group < kGroupCount; ++group) {
        const std::uint64_t features = features_of(recipe_, group);
        if ((features & (SWIVEL_WITH_PLANT | SWIVEL_PLANT_BY_MOTION)) == SWIVEL_WITH_PLANT)
            write_field(crowd, SWIVEL_CONTACT, group, rows_.contacts[group]);
        if (features & SWIVEL_WITH_NEXT_TARGET) {
            if (!is_far) write_field(crowd, SWIVEL_NEXT_TARGET, group, rows_.next_targets[group]);
            write_field(crowd, SWIVEL_NEXT_TIME, group, rows_.next_times[group]);
        }
    }
    if (!is_far) write_field(crowd, SWIVEL_TARGET, kGroupCount - 1, rows_.targets[kGroupCount - 1]);
    if (has_shift(recipe_)) write_field(crowd, SWIVEL_SHIFT_WISH, kGroupCount, rows_.shift_wishes);
    if (holding_) holding_->write(crowd);
    if (looking_) looking_->write(crowd);
}

}  // namespace swivel::corpus
