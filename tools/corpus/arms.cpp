// SPDX-License-Identifier: MIT
#include "tools/corpus/arms.h"

#include <algorithm>

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

}  // namespace swivel::corpus
