// SPDX-License-Identifier: MIT
#include "tools/corpus/holding.h"

#include <algorithm>
#include <iterator>
#include <span>

#include "tools/corpus/hard_cases.h"

namespace swivel::corpus {

namespace {

Holder holder_of(const Recipe& recipe, std::uint32_t n, const Body& body)
{
    Holder holder{stream(recipe.seed, 1, "motion", Use::value, n), body.root_scale, {}, {}, {}, {}, {}, {}};
    Random& random = holder.random;
    const Vector up = unit(turn(unit(rotation_of(body.root_rotation)), {1, 3, -2}));  // the crowd's
    for (std::size_t group = 0; group < kGroupCount; ++group) {
        holder.grounds[group] = random_vector(random, 0.2);
        const double size = random.between(0.5, 2);
        holder.normals[group] = size * (up + random_vector(random, 0.5));
        const std::array<float, 3> place = floats(random_vector(random, has_prop(recipe) ? 0.1 * holder.scale : 0.2));
        const std::array<float, 4> rotation = floats(random_rotation(random, 0.5, 2));
        std::copy(rotation.begin(), rotation.end(), std::copy(place.begin(), place.end(), holder.grips[group].begin()));
    }
    holder.ground_way = random_vector(random, 0.2);
    for (std::size_t k = 0; k < 2; ++k) {
        holder.prop_positions[k] = random_vector(random, 0.3);
        holder.prop_rotations[k] = floats(random_rotation(random, 0.5, 2));
    }
    return holder;
}

// A body's part of all bodies' values.
template <class Value>
std::span<Value> values_of(std::vector<Value>& values, std::size_t body_count, std::uint32_t body)
{
    const std::size_t each = values.size() / body_count;
    return std::span(values).subspan(body * each, each);
}

}  // namespace

Looking::Looking(const Recipe& recipe, const std::vector<Body>& bodies, Poses& poses) : group_(look_group(recipe))
{
    const std::size_t body_count = bodies.size();
    for (std::uint32_t k = 0; k < kLookCount; ++k) {
        recipe.pose& kFar ? poses.far_look_targets[k].resize(3 * body_count) : rows_[k].targets.resize(3 * body_count);
        rows_[k].weights.resize(body_count);
    }
    for (std::uint32_t n = 0; n < body_count; ++n) {
        Looker looker{stream(recipe.seed, 2, "motion", Use::value, n), bodies[n].root_scale, {}};
        for (auto& places : looker.places)
            for (Vector& place : places) {
                const double size = looker.random.spread(-2, 4);
                place = size * random_direction(looker.random);
            }
        lookers_.push_back(looker);
    }
}

void Looking::move_body(std::uint32_t n, const Vector& root, double swing, Poses& poses)
{
    Looker& looker = lookers_[n];
    for (std::uint32_t k = 0; k < kLookCount; ++k) {
        const std::uint32_t kind = looker.random.below(64);
        const double size = (kind == 0 ? 1e6 : 1) * looker.scale;
        const bool is_none = kind == 1 || n % 16 == 15;
        const auto& [from, to] = looker.places[k];
        const Vector none{kNan, kNan, kNan}, place = is_none ? none : root + size * between(from, to, swing);
        if (poses.far_look_targets[k].empty())
            put_vector(place, &rows_[k].targets[3 * n]);
        else
            put_vector(place, &poses.far_look_targets[k][3 * n]);
        const double weights[] = {1, 1, swing, 0};
        rows_[k].weights[n] = static_cast<float>(weights[n / 2 % 4]);
    }
    if (looker.random.below(64) == 0) spoil_body(n, poses);
}

void Looking::spoil_body(std::uint32_t n, Poses& poses)
{
    Random& random = lookers_[n].random;
    const std::uint32_t k = random.below(kLookCount);
    if (random.below(2) == 0)
        spoil(random, std::span(rows_[k].weights).subspan(n, 1), 1);
    else if (poses.far_look_targets[k].empty())
        spoil(random, std::span(rows_[k].targets).subspan(3 * n, 3), 2);
    else
        spoil(random, std::span(poses.far_look_targets[k]).subspan(3 * n, 3), 2);
}

void Looking::write(Crowd& crowd) const
{
    for (std::uint32_t k = 0; k < kLookCount; ++k) {
        const Rows& rows = rows_[k];
        if (!rows.targets.empty()) write_field(crowd, SWIVEL_LOOK_TARGET, group_ + k, rows.targets);
        write_field(crowd, SWIVEL_LOOK_WEIGHT, group_ + k, rows.weights);
    }
}

Holding::Holding(const Recipe& recipe, const std::vector<Body>& bodies, Poses& poses) : recipe_(recipe)
{
    const std::size_t body_count = bodies.size(), three = 3 * body_count;
    const bool is_far = recipe.pose & kFar;
    for (std::uint32_t n = 0; n < body_count; ++n) holders_.push_back(holder_of(recipe, n, bodies[n]));
    for (std::uint32_t group = 0; group < kGroupCount; ++group) {
        if (features_of(recipe, group) & SWIVEL_WITH_GROUND) {
            is_far ? poses.far_grounds[group].resize(three) : grounds_[group].resize(three);
            normals_[group].resize(three);
        }
        if (features_of(recipe, group) & SWIVEL_WITH_LINK) grips_[group].resize(7 * body_count);
    }
    if (!has_prop(recipe)) return;
    is_far ? poses.far_props.resize(three) : props_.positions.resize(three);
    props_.rotations.resize(4 * body_count);
    props_.blends.resize(body_count);
}

// One body in eight has no ground, and others have none now and then.
void Holding::set_ground(std::uint32_t n, std::uint32_t group, const Vector& root, double swing, Poses& poses)
{
    Holder& holder = holders_[n];
    const std::uint32_t kind = holder.random.below(32);
    const bool is_none = kind == 0 || n % 8 == 7, is_steep = kind == 1;
    const Vector any = random_direction(holder.random), none{kNan, kNan, kNan},
                 from_root = holder.grounds[group] + swing * holder.ground_way,
                 place = is_none ? none : root + holder.scale * from_root;
    if (poses.far_grounds[group].empty())
        put_vector(place, &grounds_[group][3 * n]);
    else
        put_vector(place, &poses.far_grounds[group][3 * n]);
    put_vector(is_steep ? any : holder.normals[group], &normals_[group][3 * n]);
}

// One of four bodies is told where its prop is, one how it is turned, one both. The fourth has it at hand.
void Holding::set_prop(std::uint32_t n, const Vector& root, double swing, Poses& poses)
{
    Holder& holder = holders_[n];
    const bool is_far = holder.random.below(64) == 0, has_place = n % 2 == 1, has_turn = n / 2 % 2 == 1;
    const double size = (is_far ? 1000 : 1) * holder.scale;
    const Vector way = size * between(holder.prop_positions[0], holder.prop_positions[1], swing),
                 none{kNan, kNan, kNan},
                 place = !has_place                              ? none
                         : recipe_.holds == Holds::prop_at_joint ? way
                                                                 : root + way;
    if (poses.far_props.empty())
        put_vector(place, &props_.positions[3 * n]);
    else
        put_vector(place, &poses.far_props[3 * n]);
    for (std::size_t c = 0; c < 4; ++c) {
        const double from = holder.prop_rotations[0][c], to = holder.prop_rotations[1][c];
        props_.rotations[4 * n + c] = has_turn ? static_cast<float>(from + swing * (to - from)) : kNan;
    }
    const double shares[] = {0, 1, swing, 0.5};
    props_.blends[n] = static_cast<float>(shares[n / 4 % 4]);
}

void Holding::spoil_body(std::uint32_t n, Poses& poses)
{
    Random& random = holders_[n].random;
    std::vector<float>* const values[] = {&grounds_[0],      &normals_[0],   &grips_[1],        &grips_[2],
                                          &props_.positions, &props_.blends, &props_.rotations, &normals_[1]};
    std::vector<double>* const far_values[] = {&poses.far_grounds[0], &poses.far_grounds[1], &poses.far_props};
    const std::uint32_t chosen = random.below(static_cast<std::uint32_t>(std::size(values) + std::size(far_values)));
    if (chosen < std::size(values)) {
        const std::span<float> some = values_of(*values[chosen], holders_.size(), n);
        spoil(random, some, some.size() == 1 ? 1 : 3);
    } else {
        spoil(random, values_of(*far_values[chosen - std::size(values)], holders_.size(), n), 3);
    }
}

void Holding::move_body(std::uint32_t n, const Vector& root, double swing, Poses& poses)
{
    for (std::uint32_t group = 0; group < kGroupCount; ++group) {
        if (!normals_[group].empty()) set_ground(n, group, root, swing, poses);
        if (grips_[group].empty()) continue;
        const std::array<float, 7>& grip = holders_[n].grips[group];
        std::copy(grip.begin(), grip.end(), &grips_[group][7 * n]);
    }
    if (has_prop(recipe_)) set_prop(n, root, swing, poses);
    if (holders_[n].random.below(64) == 0) spoil_body(n, poses);
}

void Holding::write(Crowd& crowd) const
{
    for (std::uint32_t group = 0; group < kGroupCount; ++group) {
        if (!grounds_[group].empty()) write_field(crowd, SWIVEL_GROUND, group, grounds_[group]);
        if (!normals_[group].empty()) write_field(crowd, SWIVEL_GROUND_NORMAL, group, normals_[group]);
        if (!grips_[group].empty()) write_field(crowd, SWIVEL_GRIP, group, grips_[group]);
    }
    if (!has_prop(recipe_)) return;
    const std::uint32_t prop = prop_group(recipe_);
    if (!props_.positions.empty()) write_field(crowd, SWIVEL_PROP_POSITION, prop, props_.positions);
    write_field(crowd, SWIVEL_PROP_ROTATION, prop, props_.rotations);
    write_field(crowd, SWIVEL_HAND_BLEND, prop, props_.blends);
}

}  // namespace swivel::corpus
