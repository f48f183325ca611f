// SPDX-License-Identifier: MIT
//
// The lecture's five steps for people: every entity that core/pipeline.h makes, and why an arm has none.
#include "include/swivel/lecture.h"

#include <cmath>
#include <cstdio>

#include "core/pipeline.h"
#include "simd/float_env.h"

using namespace swivel;

namespace {

constexpr double kMin = 1e-9;  // below this share a length or a sine is rounding: dividing by it says nothing
constexpr double kShortest = 1e-15, kLongest = 1e15;  // valid input, docs/fields.md: eighth powers stay finite

// Blades in the order of their numbers; a coefficient's blade is in the multivector's type.
template <BladeSet S>
void store(const Mv<double, S>& m, double (&to)[32])
{
    std::size_t n = 0;
    for (Blade blade = 0; blade < 32; ++blade)
        if (S >> blade & 1u) to[blade] = m.c[n++];
}
void store(double scalar, double (&to)[32]) { to[kScalar] = scalar; }

struct Entities {
    swivel_entity* next;

    template <class Value>
    void add(uint32_t step, const char* name, const Value& value, const char* meaning)
    {
        *next = {name, meaning, step, {}};
        store(value, next++->coefficients);
    }
};

void add_all(const PipelineSteps<double>& m, Entities to)
{
    to.add(1, "p_w", m.p_w, "the wrist's target, a point");
    to.add(1, "pi_swivel", m.pi_swivel, "the swivel plane: through shoulder, target and pole");
    to.add(1, "S1", m.s1, "the sphere about the target with the forearm's length");
    to.add(1, "S2", m.s2, "the sphere about the shoulder with the upper arm's length");
    to.add(1, "PP", m.pp, "the point pair where both spheres and the plane meet: S1 ^ S2 ^ pi_swivel");
    to.add(1, "p_e", m.p_e, "the elbow: the pair's point on the pole's side");
    to.add(2, "line_se", m.line_se, "the line of the upper arm, through shoulder and elbow");
    to.add(2, "line_ew", m.line_ew, "the line of the forearm, through elbow and wrist");
    to.add(2, "c4", m.c4, "the cosine of the angle between them, the flexion");
    to.add(2, "q_e", m.q_e, "the elbow's rotation: half-angle formulas, no arc cosine");
    to.add(3, "p_ze", m.p_ze, "the elbow at rest, on e3");
    to.add(3, "pi_M", m.pi_m, "the plane in the middle between both elbows: p_ze - p_e");
    to.add(3, "pi_e", m.pi_e, "the plane through shoulder and both elbows");
    to.add(3, "l_M", m.l_m, "the middle line, where these planes meet: pi_e ^ pi_M");
    to.add(4, "q12", m.q12, "the turn by pi about the middle line: l_M / |l_M|");
    to.add(5, "c3", m.c3, "the cosine of the angle that is left, about the upper arm");
    to.add(5, "q3", m.q3, "the turn about the upper arm into the swivel plane");
    to.add(5, "q_s", m.q_s, "the shoulder's rotation: q12 q3");
}

bool is_valid(const Vector<double>& v)
{
    for (const double c : v.c)
        if (!(std::fabs(c) <= kLongest)) return false;
    return true;
}
bool is_valid(double length) { return length >= kShortest && length <= kLongest; }
double length(const Vector<double>& v) { return std::sqrt(len2(v)); }

const char* no_circle(const char* why, double distance)
{
    thread_local char line[128];
    std::snprintf(line, sizeof line, "S1 and S2 meet in no circle: %s by %g", why, distance);
    return line;
}

// Why spheres and plane are not there or do not meet in two points; null: they do.
const char* refuse(const Vector<double>& target, const Vector<double>& pole, double upper, double fore)
{
    const double distance = length(target), sum = upper + fore, difference = std::fabs(upper - fore);
    if (!is_valid(target) || !is_valid(pole))
        return "target or pole is not finite or too large; components are at most 1e15";
    if (!is_valid(upper) || !is_valid(fore)) return "upper or fore is no length; give 1e-15 to 1e15";
    if (distance < kMin * sum) return "pi_swivel is undefined: the target is on the shoulder";
    if (length(pole) < kShortest || length(cross(target, pole)) < kMin * distance * length(pole))
        return "pi_swivel is undefined: the pole is on the line from shoulder to target";
    if (distance > sum * (1 + kMin)) return no_circle("the target is too far", distance - sum);
    if (distance < difference - kMin * sum) return no_circle("the target is too near", difference - distance);
    if (distance > sum * (1 - kMin)) return "PP is one point: the arm is straight";
    if (distance < difference + kMin * sum) return "PP is one point: the arm is folded";
    return nullptr;
}

// How far the rotors put the wrist from the target, in arm lengths.
double closing_error_of(const PipelineSteps<double>& m, const Vector<double>& target, double upper, double fore)
{
    const Vector<double> e3 = vector(0.0, 0.0, 1.0);
    const Vector<double> wrist = sandwich(m.q_s, upper * e3) + sandwich(Rotor<double>(m.q_s * m.q_e), fore * e3);
    return length(wrist - target) / (upper + fore);
}

}  // namespace

const char* swivel_steps(const double target[3], const double pole[3], double upper, double fore,
                         swivel_entity entities[SWIVEL_ENTITY_COUNT], double* closing_error)
{
    const FloatEnv env(upper, fore);
    const Vector<double> to = vector(target[0], target[1], target[2]), side = vector(pole[0], pole[1], pole[2]);
    if (const char* const why = refuse(to, side, upper, fore)) return why;
    const PipelineSteps<double> steps = solve_pipeline(to, normalise(cross(to, side)), upper, fore);
    if (!(length(steps.pi_e) >= kMin * upper * upper))
        return "l_M is undefined: the upper arm is along e3 or -e3, so pi_e or pi_M is no plane";
    add_all(steps, {entities});
    *closing_error = closing_error_of(steps, to, upper, fore);
    return nullptr;
}

const char* swivel_blade_name(uint32_t blade)
{
    static constexpr const char* kNames[32] = {
        "1",       "e1",         "e2",         "k",         "e3",         "j",         "i",         "e1^e2^e3",
        "einf",    "e1^einf",    "e2^einf",    "k^einf",    "e3^einf",    "j^einf",    "i^einf",    "e1^e2^e3^einf",
        "e0",      "e1^e0",      "e2^e0",      "k^e0",      "e3^e0",      "j^e0",      "i^e0",      "e1^e2^e3^e0",
        "einf^e0", "e1^einf^e0", "e2^einf^e0", "k^einf^e0", "e3^einf^e0", "j^einf^e0", "i^einf^e0", "e1^e2^e3^einf^e0"};
    return blade < 32 ? kNames[blade] : nullptr;
}
