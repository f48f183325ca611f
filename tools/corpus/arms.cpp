// SPDX-License-Identifier: MIT
#include "tools/corpus/arms.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "tools/corpus/hard_cases.h"
#include "tools/corpus/random.h"
#include "tools/corpus/vectors.h"

namespace swivel::corpus {

namespace {

// Bones of 1/16 to 128 together: as long as each other, or up to 20 times as long. Either may be the longer.
std::array<float, 2> random_lengths(Random& random)
{
    const double both = random.spread(-4, 7);
    const std::uint32_t kind = random.below(8);
    const double ratio = kind == 0 ? 1 : kind < 5 ? random.between(1, 2) : random.between(1, 20);
    const double shorter = both / (1 + ratio);
    const bool swapped = random.below(2) == 1;
    const float one = static_cast<float>(shorter), other = static_cast<float>(shorter * ratio);
    return swapped ? std::array{other, one} : std::array{one, other};
}

// The wrist's distance from the shoulder, in one of the bands of reach; 1/50 of both bones at least.
double random_distance(Random& random, const std::array<float, 2>& lengths)
{
    const double upper = lengths[0], fore = lengths[1], far = upper + fore,
                 near = upper > fore ? upper - fore : fore - upper;
    double distance = 0;
    switch (random.below(8)) {
        case 0:  // nearly straight
            distance = far * (1 - 1 / random.spread(3, 21));
            break;
        case 1:  // nearly folded
            distance = near * (1 + 1 / random.spread(3, 21));
            break;
        case 2:  // out of reach
            distance = far * random.between(1, 3);
            break;
        case 3:  // too near
            distance = near * random.unit();
            break;
        default:
            distance = near + (far - near) * random.between(0.02, 0.98);
    }
    return std::max(distance, 0.02 * far);
}

// A pole off the line by a sine of 0.024 at least, up to eight arms away.
Vector random_pole(Random& random, const Vector& line, double far)
{
    const Vector across = random_across(random, line);
    const double slope = random.below(4) == 0 ? random.between(-40, 40) : random.between(-2, 2);
    const double distance = far * random.spread(-3, 3);
    return (distance / square_root(1 + slope * slope)) * (across + slope * line);
}

// From the parent's frame to the world, if the arm has a parent.
std::array<float, 3> placed(const Arm& arm, const Vector& v, bool is_point)
{
    const Vector turned = turn(unit(rotation_of(arm.parent_rotation)), v);
    if (!is_point) return floats(turned);
    return floats(vector_of(arm.parent_position) + double{arm.parent_scale[0]} * turned);
}

double size_of(double x) { return x < 0 ? -x : x; }

// Numbers scaled to unit length. What cannot be scaled stays bad.
void make_unit(double* v, int count)
{
    double length2 = 0;
    for (int n = 0; n < count; ++n) length2 += v[n] * v[n];
    for (int n = 0; n < count; ++n) v[n] /= square_root(length2);
}
// A cosine and a sine.
void make_turn(double* pair) { make_unit(pair, 2); }
// The same of an angle in 0 to pi.
void make_half(double* pair)
{
    pair[1] = size_of(pair[1]);
    make_unit(pair, 2);
}
void make_range(double* four)
{
    make_turn(four);
    make_half(four + 2);
}
void make_shares(double* v, int count, double max)
{
    for (int n = 0; n < count; ++n) v[n] = max * size_of(v[n]);
}
// Soft far and near, most stretch, least distance.
void make_reach(double* v)
{
    make_shares(v, 4, 0.25);
    v[2] += 1;
}
void make_longer(double* v, int count, double factor)
{
    for (int n = 0; n < count; ++n) v[n] *= factor;
}

// Numbers in -1..1, some of them perhaps hard, become a value of the field. length: of the arm.
void shape(Field field, double* v, std::uint32_t count, double length)
{
    switch (field) {
        case Field::effector:
            return make_longer(v, 3, 0.25 * length);
        case Field::angle:
        case Field::incoming_shoulder:
        case Field::incoming_elbow:
        case Field::incoming_wrist:
            return;
        case Field::weights:
            return make_shares(v, 3, 1);
        case Field::reach:
            return make_reach(v);
        case Field::cap:
            return make_shares(v, 3, 0.5);
        case Field::max_swivel:
            return make_half(v);
        case Field::flexion_limit:
            v[0] = 0.5 + 0.5 * size_of(v[0]);
            v[1] = 0.5 * size_of(v[1]);
            return;
        case Field::shoulder_cone:
        case Field::hand_cone:
            return make_unit(v, 3);
        case Field::humeral_twist:
        case Field::forearm_twist:
            return make_range(v);
        case Field::hand_twist:
            make_unit(v, 3);
            return make_range(v + 3);
        case Field::shoulder_box:
        case Field::wrist_box:
            for (int n = 0; n < 12; n += 4) make_range(v + n);
            return;
        case Field::aim:
            make_unit(v, 3);
            v[3] = size_of(v[3]);
            return make_half(v + 3);
        case Field::clavicle:
            if (count == 1) return make_shares(v, 1, 1);  // of bodies
            make_longer(v, 3, 0.25 * length);
            v[3] = size_of(v[3]);
            return;
        default:
            throw std::logic_error("corpus: arms.cpp has no shape for field " +
                                   std::to_string(static_cast<int>(field)));
    }
}

// Some bodies keep their pose, and some their elbow.
void keep_some(std::uint32_t body, std::span<double> weights)
{
    if (body % 8 == 5) weights[0] = weights[1] = weights[2] = 0;
    if (body % 8 == 6) weights[2] = 0;
}

}  // namespace

std::span<float> Arm::values(Field field)
{
    switch (field) {
        case Field::target:
            return target;
        case Field::pole:
            return pole;
        case Field::lengths:
            return lengths;
        case Field::parent_position:
            return parent_position;
        case Field::parent_rotation:
            return parent_rotation;
        case Field::parent_scale:
            return parent_scale;
        case Field::hand:
            return hand;
        default:
            return {};
    }
}

void set_goals(const Recipe& recipe, Random& targets, Random& poles, Arm& arm)
{
    const Vector line = random_direction(targets);
    const double distance = random_distance(targets, arm.lengths);
    arm.target = placed(arm, distance * line, true);
    const Vector pole = random_pole(poles, line, double{arm.lengths[0]} + arm.lengths[1]);
    arm.pole = placed(arm, pole, !(recipe.features & (kPoleDirection | kPoleNormal)));
}

std::vector<Arm> ordinary_arms(const Recipe& recipe, std::uint32_t group, std::uint32_t limb_count, std::uint32_t frame)
{
    const auto random_of = [&](Field field, std::uint32_t in_frame) {
        return stream(recipe.seed, group, field, Use::value, in_frame);
    };
    Random targets = random_of(Field::target, frame), poles = random_of(Field::pole, frame),
           lengths = random_of(Field::lengths, 0), positions = random_of(Field::parent_position, 0),
           rotations = random_of(Field::parent_rotation, 0), scales = random_of(Field::parent_scale, 0),
           hands = random_of(Field::hand, 0);
    const bool world = recipe.features & kWorld;
    std::vector<Arm> arms(limb_count);
    for (Arm& arm : arms) {
        arm.lengths = random_lengths(lengths);
        if (world) {
            for (float& x : arm.parent_position) x = static_cast<float>(8 * positions.signed_unit());
            arm.parent_rotation = floats(random_rotation(rotations, 0.78, 1.34));
            arm.parent_scale = {static_cast<float>(scales.spread(-2, 2))};
        }
        arm.hand = floats(random_rotation(hands, 0.5, 2));
        set_goals(recipe, targets, poles, arm);
    }
    return arms;
}

std::vector<float> limb_values(const Recipe& recipe, Field field, std::uint32_t components, std::uint32_t group,
                               std::span<const Arm> arms)
{
    Random random = stream(recipe.seed, group, field, Use::value, 0),
           spoiling = stream(recipe.seed, group, field, Use::spoil, 0);
    std::vector<float> values;
    values.reserve(components * arms.size());
    std::vector<double> value(components);
    for (std::uint32_t limb = 0; limb < arms.size(); ++limb) {
        for (double& x : value) x = random.signed_unit();
        if (is_spoilt_run(limb)) spoil(spoiling, std::span(value), 64);
        const Arm& arm = arms[limb];
        shape(field, value.data(), components, double{arm.lengths[0]} + arm.lengths[1]);
        if (recipe.part == Part::bodies && field == Field::weights) keep_some(limb, value);
        for (const double x : value) values.push_back(static_cast<float>(x));
    }
    return values;
}

}  // namespace swivel::corpus
