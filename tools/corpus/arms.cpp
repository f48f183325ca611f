// SPDX-License-Identifier: MIT
#include "tools/corpus/arms.h"

#include <algorithm>

#include "simd/fields.h"
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
// One in eight is 0, and one in eight is 1.
double as_share(double x) { return x >= -1 && x < -0.75 ? 0 : x > 0.75 && x <= 1 ? 1 : size_of(x); }

// Numbers scaled to unit length. What cannot be scaled stays bad.
void make_unit(double* v, int count)
{
    double length2 = 0;
    for (int n = 0; n < count; ++n) length2 += v[n] * v[n];
    for (int n = 0; n < count; ++n) v[n] /= square_root(length2);
}
// The cosine and sine of an angle in 0 to pi.
void make_half_turn(double* v)
{
    v[1] = size_of(v[1]);
    make_unit(v, 2);
}

// Numbers in -1..1, some of them perhaps hard, become a part of a value. length: of the arm.
void shape(ValuePart part, double* v, double length)
{
    switch (part) {
        case ValuePart::axis:
            return make_unit(v, 3);
        case ValuePart::half_turn:
            return make_half_turn(v);
        case ValuePart::right_turn:
            v[0] = size_of(v[0]);
            return make_half_turn(v);
        case ValuePart::range:
            make_unit(v, 2);
            return make_half_turn(v + 2);
        case ValuePart::flexion:
            v[0] = 0.5 + 0.5 * size_of(v[0]);
            v[1] = 0.5 * size_of(v[1]);
            return;
        case ValuePart::point:
            for (int n = 0; n < 3; ++n) v[n] *= 0.25 * length;
            return;
        case ValuePart::stretch:
            v[0] = 1 + 0.25 * size_of(v[0]);
            return;
        case ValuePart::share:
            v[0] = as_share(v[0]);
            return;
        case ValuePart::length:
        case ValuePart::scale:
        case ValuePart::time:
            v[0] = size_of(v[0]);
            return;
        default:  // any numbers will do
            return;
    }
}

// The same of a whole value, part after part.
void shape(swivel_field field, std::span<double> value, double length)
{
    for_each_part(row_of(field), static_cast<std::uint32_t>(value.size()), [&](ValuePart part, std::uint32_t first) {
        shape(part, &value[first], length);
        // Margins and zones of the reach, which leave some of it.
        if (part == ValuePart::share && (field == SWIVEL_REACH || field == SWIVEL_CAP)) value[first] *= 0.25;
    });
}

// Some bodies keep their pose, and some their elbow.
void keep_some(std::uint32_t body, std::span<double> weights)
{
    if (body % 8 == 5) weights[0] = weights[1] = weights[2] = 0;
    if (body % 8 == 6) weights[2] = 0;
}

}  // namespace

std::span<float> Arm::values(swivel_field field)
{
    switch (field) {
        case SWIVEL_TARGET:
            return target;
        case SWIVEL_POLE:
            return pole;
        case SWIVEL_LENGTHS:
            return lengths;
        case SWIVEL_SHOULDER_POSITION:
            return parent_position;
        case SWIVEL_PARENT_ROTATION:
            return parent_rotation;
        case SWIVEL_PARENT_SCALE:
            return parent_scale;
        case SWIVEL_HAND:
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
    const Vector pole = random_pole(poles, line, arm.length());
    arm.pole = placed(arm, pole, !(recipe.features & (SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL)));
}

std::vector<Arm> ordinary_arms(const Recipe& recipe, std::uint32_t group, std::uint32_t limb_count, std::uint32_t frame)
{
    const auto random_of = [&](swivel_field field, std::uint32_t in_frame) {
        return stream(recipe.seed, group, field, Use::value, in_frame);
    };
    Random targets = random_of(SWIVEL_TARGET, frame), poles = random_of(SWIVEL_POLE, frame),
           lengths = random_of(SWIVEL_LENGTHS, 0), positions = random_of(SWIVEL_SHOULDER_POSITION, 0),
           rotations = random_of(SWIVEL_PARENT_ROTATION, 0), scales = random_of(SWIVEL_PARENT_SCALE, 0),
           hands = random_of(SWIVEL_HAND, 0);
    const bool world = recipe.features & SWIVEL_WORLD;
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

std::vector<float> limb_values(const Recipe& recipe, swivel_field field, std::uint32_t components, std::uint32_t group,
                               std::span<const Arm> arms)
{
    Random random = stream(recipe.seed, group, field, Use::value, 0),
           spoiling = stream(recipe.seed, group, field, Use::spoil, 0);
    std::vector<float> values;
    values.reserve(components * arms.size());
    std::vector<double> value(components);
    for (std::uint32_t limb = 0; limb < arms.size(); ++limb) {
        for (double& x : value) x = random.signed_unit();
        if (recipe.part != Part::standing && is_spoilt_run(limb)) spoil(spoiling, std::span(value), 64);
        shape(field, value, arms[limb].length());
        if (recipe.part == Part::bodies && field == SWIVEL_WEIGHTS) keep_some(limb, value);
        for (const double x : value) values.push_back(static_cast<float>(x));
    }
    return values;
}

}  // namespace swivel::corpus
