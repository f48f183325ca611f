// SPDX-License-Identifier: MIT
#include "tools/corpus/limb_values.h"

#include <stdexcept>
#include <string>

#include "tools/corpus/hard_cases.h"
#include "tools/corpus/interface.h"
#include "tools/corpus/vectors.h"

namespace swivel::corpus {

namespace {

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
void make_shares(double* v, int count, double most)
{
    for (int n = 0; n < count; ++n) v[n] = most * size_of(v[n]);
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
        case Field::most_swivel:
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
            throw std::logic_error("corpus: limb_values.cpp has no shape for field " +
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

std::vector<float> limb_values(const Recipe& recipe, Field field, std::uint32_t group, std::span<const Arm> arms)
{
    Random random = stream(recipe.seed, group, field, Use::value, 0),
           spoiling = stream(recipe.seed, group, field, Use::spoil, 0);
    const std::uint32_t components = component_count(recipe, field, group);
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
