// SPDX-License-Identifier: MIT
#include "tests/plant_frames.h"

#include <limits>

namespace swivel::test {

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

// Of so few digits that differences are exact, in floats and far away in doubles.
Float3 short_place(Random& random, double size)
{
    Float3 v = floats(random.vector(0, size));
    for (float& x : v) x = std::round(x * 65536) / 65536;
    return v;
}
Float3 moved(const Float3& from, const Float3& by) { return {from[0] + by[0], from[1] + by[1], from[2] + by[2]}; }

swivel_features random_features(Random& random, swivel_features left_out)
{
    swivel_features features = SWIVEL_POLE_INCOMING;
    const auto may = [&](swivel_features more) {
        if (random.below(2)) features |= more & ~left_out;
    };
    may(SWIVEL_WITH_RECORD);
    may(SWIVEL_WITH_CAP);
    may(SWIVEL_WITH_FIT);
    if (features & SWIVEL_WITH_FIT) may(SWIVEL_WITH_COMING);
    may(SWIVEL_WITH_HAND);
    if (features & SWIVEL_WITH_HAND) may(SWIVEL_WITH_EFFECTOR);
    if (features & SWIVEL_WITH_EFFECTOR) may(SWIVEL_HAND_YIELDS);
    if (random.below(4) == 0) return features;
    features |= SWIVEL_WITH_PLANT;
    may(SWIVEL_PLANT_BY_MOTION);
    if (features & SWIVEL_WITH_HAND) may(SWIVEL_WITH_PLANT_TURN);
    return features;
}

swivel_plant random_plant(Random& random)
{
    swivel_plant plant = swivel_default_plant();
    const auto number = [&](double most) { return static_cast<float>(random.between(0, most)); };
    plant.lock = number(2), plant.unlock = plant.lock + number(2);
    plant.stop = number(0.2), plant.blend = number(0.2), plant.run = number(1);
    plant.again = number(4), plant.longest = random.below(2) ? 0.5f : 0;
    plant.speed[0] = plant.speed[1] = number(20);
    plant.height[0] = plant.height[1] = number(4) - 1;
    return plant;
}

Float4 between(const Float4& a, const Float4& b, float share)
{
    Float4 q;
    const float side = quat(a).dot(quat(b)) < 0 ? -1.0f : 1.0f;
    for (std::size_t n = 0; n < 4; ++n) q[n] = (1 - share) * a[n] + share * side * b[n];
    return q;
}
Body between(const Body& a, const Body& b, float share)
{
    Body body = a;
    for (std::size_t n = 0; n < body.rotations.size(); ++n)
        body.rotations[n] = between(a.rotations[n], b.rotations[n], share);
    body.root_rotation = between(a.root_rotation, b.root_rotation, share);
    return body;
}

// One body through all frames.
void add_body(Random& random, PlantFrames& of)
{
    const Body from = random_body(random, of.skeleton, {true, true, true}),
               to = random_body(random, of.skeleton, {true, true, true});
    Float3 root = short_place(random, 3);
    const Float3 support = short_place(random, 3);
    std::uint32_t stands_on = 0;
    float share = 0;
    for (PlantFrames::Of& frame : of.frames) {
        if (random.below(2)) share = static_cast<float>(random.unit()), root = moved(root, short_place(random, 0.2));
        frame.bodies.push_back(between(from, to, share));
        frame.bodies.back().root_position = root;
        frame.times.push_back(static_cast<float>(random.below(8) ? random.between(0, 0.1) : random.below(3)));
        if (random.below(64) == 0) frame.times.back() = random.below(2) ? kNone : -1;
        frame.wishes.push_back(static_cast<float>(random.between(-0.1, 0.1)));
        frame.coming_times.push_back(static_cast<float>(random.between(0, 0.5)));
        for (std::size_t k = 0; k < 2; ++k) {
            frame.supports[k].push_back(moved(support, short_place(random, 0.5)));
            frame.support_rotations[k].push_back(floats(random.rotation()));
        }
        const bool changes = random.below(8) == 0;
        if (changes) stands_on = 1 - stands_on;
        frame.stands_on.push_back(stands_on);
        // Also one of which the length is beyond floats, but not where it is changed to.
        if (!changes && random.below(64) == 0) frame.support_rotations[stands_on].back()[random.below(4)] = 3e38f;
        frame.resets.push_back(random.below(64) == 0 ? random.below(4) : ~0u);
        for (std::size_t g = 0; g < of.features.size(); ++g) {
            frame.contacts[g].push_back(random.below(3) ? 1 : 0);
            frame.comings[g].push_back(moved(root, short_place(random, 1)));
            const bool is_given = !(of.features[g] & SWIVEL_WITH_PLANT) || random.below(4) == 0;
            frame.targets[g].push_back(is_given ? moved(root, short_place(random, 1)) : Float3{kNone, kNone, kNone});
        }
    }
}

}  // namespace

PlantFrames::PlantFrames(Random& random, std::uint32_t body_count, swivel_features left_out)
    : skeleton(random_body_skeleton(random, {4, 3, 1, false})), frames(kPlantFrames)
{
    for (std::size_t g = 0; g < skeleton.limbs.size(); ++g) {
        features.push_back(random_features(random, left_out));
        plants.push_back(random_plant(random));
        has_shift = has_shift || features[g] & SWIVEL_WITH_FIT;
    }
    for (Of& frame : frames) {
        frame.contacts.resize(features.size());
        frame.targets.resize(features.size());
        frame.comings.resize(features.size());
    }
    for (std::uint32_t n = 0; n < body_count; ++n) add_body(random, *this);
}

}  // namespace swivel::test
