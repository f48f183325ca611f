// SPDX-License-Identifier: MIT
//
// swivel_verify() compares the formulas with each other. Each comparison stands alone, so that a failure names its
// cause.
// - The lecture's steps in double are compared with the dense oracle.
// - The production formula in double is compared with the lecture's steps.
// - The production formula in float is compared with its own target, through forward kinematics in double.
#include "include/swivel/lecture.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/any_arm.h"
#include "core/pipeline.h"
#include "core/reference.h"
#include "simd/float_env.h"

namespace swivel {

namespace {

// Gives the same numbers everywhere, by integers (Steele, Lea, Flood: SplitMix64, 2014) and correctly rounded
// operations alone.
struct Random {
    std::uint64_t state;

    double unit()  // in [0, 1)
    {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    double between(double a, double b) { return a + (b - a) * unit(); }
    Vector<double> direction()
    {
        for (;;) {
            const Vector<double> v = vector(between(-1, 1), between(-1, 1), between(-1, 1));
            if (len2(v) > 0.01 && len2(v) < 1) return normalise(v);
        }
    }
};

struct Error {
    double max = 0, sum2 = 0;
    std::uint64_t count = 0;

    void add(double e)
    {
        if (!std::isnan(max) && !(e <= max)) max = e;  // keeps a NaN
        sum2 += e * e;
        ++count;
    }
    double rms() const { return count ? std::sqrt(sum2 / static_cast<double>(count)) : 0; }
};

struct Report {
    void (*line)(const swivel_check* check, void* user);
    void* user;
    std::optional<FloatEnv> env = {};
    bool passed = true;

    void operator()(const char* name, const char* set, const Error& error, double max_limit, double rms_limit)
    {
        const swivel_check check{name, set, error.count, error.max, error.rms(), max_limit, rms_limit};
        passed = passed && error.count > 0 && error.max <= max_limit && (rms_limit == 0 || error.rms() <= rms_limit);
        env.reset();  // the caller's function runs in the caller's environment
        if (line) line(&check, user);
        env.emplace();
    }
};

struct Band {
    const char* name;
    double from, to;  // of the reachable shell, 0 to 1
};
constexpr Band bands[] = {{"reach 0-0.01 %", 0, 1e-4},
                          {"reach 0.01-5 %", 1e-4, 0.05},
                          {"reach 5-98 %", 0.05, 0.98},
                          {"reach 98-99.99 %", 0.98, 0.9999},
                          {"reach 99.99-100 %", 0.9999, 1}};

template <class To, class From>
Vector<To> convert(const Vector<From>& v)
{
    return vector(static_cast<To>(v.c[0]), static_cast<To>(v.c[1]), static_cast<To>(v.c[2]));
}
Rotor<double> to_double(const Rotor<float>& q)
{
    return rotor<double>(q.at<kI>(), q.at<kJ>(), q.at<kK>(), q.at<kScalar>());
}

// A random arm. The ratio of its bones is up to max_ratio to 1, either way round. Its wrist is in the band. Its pole
// is at least 1e-3 off the line, half of the poles closer than 0.1. The numbers are floats, so they are exact in both
// precisions.
ArmGoal<float> random_arm(Random& random, const Band& band, double max_ratio)
{
    const double shorter = 1 / random.between(1, max_ratio);
    const bool swap = random.unit() < 0.5;
    const float upper = static_cast<float>(swap ? shorter : 1.0), fore = static_cast<float>(swap ? 1.0 : shorter);
    const double near = std::fabs(double{upper} - fore), far = double{upper} + fore;
    const Vector<double> line = random.direction();
    const Vector<double> across = normalise(cross(line, random.direction()));
    const double sine = random.unit() < 0.5 ? random.between(0.0011, 0.1) : random.between(0.1, 1);
    const double side = random.unit() < 0.5 ? -1 : 1;
    const Vector<double> pole = (side * std::sqrt(1 - sine * sine)) * line + sine * across;
    return {convert<float>((near + (far - near) * random.between(band.from, band.to)) * line),
            convert<float>(random.between(0.1, 3) * pole), upper, fore};
}

// The reachable point nearest to the target, in double.
Vector<double> reachable(const ArmGoal<float>& goal)
{
    const Vector<double> wrist = convert<double>(goal.wrist);
    const double near = std::fabs(double{goal.upper} - goal.fore), far = double{goal.upper} + goal.fore;
    const double distance = std::sqrt(len2(wrist));
    return (std::clamp(distance, near, far) / distance) * wrist;
}

struct FloatErrors {
    Error wrist, plane, length;

    // Measures the wrist and the lengths of rotors, and returns the pose with rotors of unit length. There is no wrist
    // to measure where the target is on the shoulder or the bones have no length.
    ArmPose<double> add_wrist(const ArmGoal<float>& goal)
    {
        const ArmPose<float> pose = solve_arm(goal);
        const Rotor<double> shoulder = to_double(pose.shoulder);
        const double halves = std::hypot(double{pose.cos_half}, double{pose.sin_half});
        length.add(std::max(std::fabs(std::sqrt(len2(shoulder)) - 1), std::fabs(halves - 1)));

        const ArmPose<double> exact{normalise(shoulder), pose.cos_half / halves, pose.sin_half / halves, 0, true};
        const double upper = goal.upper, fore = goal.fore;
        if (len2(convert<double>(goal.wrist)) >= kTiny2 && upper + fore > 0)
            wrist.add(std::sqrt(len2(wrist_of(exact, upper, fore) - reachable(goal))) / (upper + fore));
        return exact;
    }
    void add(const ArmGoal<float>& goal)
    {
        const ArmPose<double> exact = add_wrist(goal);
        // How far the hinge is from the swivel plane's normal, times the sine by which the normal loses digits.
        const Vector<double> line = normalise(convert<double>(goal.wrist)),
                             pole = normalise(convert<double>(goal.pole));
        const Vector<double> normal = cross(line, pole), hinge = sandwich(exact.shoulder, vector(1.0, 0.0, 0.0));
        plane.add(std::sqrt(len2(normal - std::sqrt(len2(normal)) * hinge)));
    }
};

double distance(const Rotor<double>& a, const Rotor<double>& b)  // of two rotations; q and -q are one
{
    return std::sqrt(std::min(len2(a - b), len2(a + b)));
}

// Away from every singular pose of the lecture's formulas.
bool is_regular(const PipelineSteps<double>& steps)
{
    const double sine3 = steps.q3.at<kScalar>() * steps.q3.at<kK>();
    const double height = steps.elbow().at<kE3>() / std::sqrt(len2(steps.elbow()));
    return std::fabs(steps.c4) < 0.99 && height > -0.9 && height < 0.99 && std::fabs(sine3) > 0.05;
}

void verify_double(Random& random, std::uint64_t arm_count, Report& report)
{
    Error against_oracle, production;
    const Band middle{"", 0.1, 0.95};
    for (std::uint64_t n = 0; n < arm_count; ++n) {
        const ArmGoal<float> arm = random_arm(random, middle, 4);
        const ArmGoal<double> goal{convert<double>(arm.wrist), convert<double>(arm.pole), arm.upper, arm.fore};
        const Vector<double> normal = normalise(cross(goal.wrist, goal.pole));
        const PipelineSteps<double> steps = solve_pipeline(goal.wrist, normal, goal.upper, goal.fore);
        if (!is_regular(steps) || len2(cross(normalise(goal.wrist), normalise(goal.pole))) < 0.01) continue;

        const ReferencePose oracle = solve_reference({{goal.wrist.c[0], goal.wrist.c[1], goal.wrist.c[2]},
                                                      {goal.pole.c[0], goal.pole.c[1], goal.pole.c[2]},
                                                      goal.upper,
                                                      goal.fore});
        const auto& q = oracle.shoulder_rotor;
        const auto& e = oracle.elbow_rotor;
        against_oracle.add(std::max(distance(steps.q_s, rotor(q[0], q[1], q[2], q[3])),
                                    distance(steps.q_e, rotor(e[0], e[1], e[2], e[3]))));

        const ArmPose<double> pose = solve_arm(goal);
        production.add(std::max(distance(steps.q_s, pose.shoulder),
                                distance(steps.q_e, rotor(-pose.sin_half, 0.0, 0.0, pose.cos_half))));
    }
    report("pipeline<double> - oracle, rotors", "regular arms", against_oracle, 1e-12, 0);
    report("production<double> - pipeline<double>, rotors", "regular arms", production, 1e-12, 0);
}

void verify_float(Random& random, std::uint64_t arm_count, Report& report)
{
    for (const Band& band : bands) {
        FloatErrors errors;
        for (std::uint64_t n = 0; n < arm_count; ++n) errors.add(random_arm(random, band, n % 2 ? 1000 : 1.5));
        report("production<float>, wrist to target", band.name, errors.wrist, 1e-6, 1.5e-7);
        report("production<float>, hinge to swivel plane", band.name, errors.plane, 1e-6, 0);
        report("production<float>, rotor lengths", band.name, errors.length, 1e-6, 0);
    }
}

// Every combination of awkward wrists, poles and lengths; only the wrist and the lengths of rotors can be promised.
void verify_hard(Report& report)
{
    const float places[] = {-2, -1, -1e-7f, 0, 1e-15f, 3e-12f, 0.5f, 1, 2, 1e15f};
    const float bones[] = {0, 1e-15f, 3e-12f, 1e-3f, 1, 1.0000001f, 1e15f};
    FloatErrors errors;
    for (const float x : places)
        for (const float y : places)
            for (const float z : places)
                for (const float upper : bones)
                    for (const float fore : bones)
                        for (const float side : {-1.0f, 0.0f, 1e-3f, 1.0f})
                            errors.add_wrist(
                                {vector(x * 0.5f, y * 0.5f, z * 0.5f), vector(x * 0.5f, side, z * 0.5f), upper, fore});
    report("production<float>, wrist to target", "hard poses", errors.wrist, 1e-6, 0);
    report("production<float>, rotor lengths", "hard poses", errors.length, 1e-6, 0);
}

}  // namespace

}  // namespace swivel

int swivel_verify(uint64_t arm_count, uint64_t seed, void (*report)(const swivel_check* check, void* user), void* user)
{
    using namespace swivel;
    Report lines{report, user};
    lines.env.emplace();
    Random random{seed};
    verify_double(random, std::clamp<std::uint64_t>(arm_count / 100, 100, 4000), lines);
    verify_float(random, arm_count, lines);
    verify_hard(lines);
    return lines.passed;
}
