// SPDX-License-Identifier: MIT
// Feet on uneven ground: a thousand characters stand on slopes in mid-stride. Each sole lies on the ground where it
// stands, turned to its slope, and the pelvis comes down as far as the lower leg needs. One more character steps so far
// aside that no height will do. A leg is a limb like an arm: hip, knee, ankle.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <swivel/swivel.hpp>
#include <vector>

namespace {

using Vector = std::array<double, 3>;  // metres, y up
using Floats = std::array<float, 3>;
using Rotation = std::array<double, 4>;  // x, y, z, w

constexpr std::uint32_t kCharacterCount = 1'000;
constexpr double kThigh = 0.45, kShin = 0.42;
constexpr double kAnkleHeight = 0.08;               // of the ankle above the sole
constexpr double kHipSide = 0.09;                   // of the hips beside the pelvis' middle
constexpr double kStride = 0.16;                    // of a foot before or behind the pelvis
constexpr double kReach = 0.98 * (kThigh + kShin);  // knees are never quite straight
constexpr double kStanding = 0.93;                  // of the pelvis above the ground

double ground_height(double x, double z) { return 0.25 * std::sin(0.8 * x) + 0.15 * std::sin(1.1 * z + 0.5 * x); }

// The rotation that carries up to the ground's normal, along the shortest way: (up x n, 1 + up . n), made unit.
Rotation ground_slope(double x, double z)
{
    constexpr double kNear = 1e-4;
    const double along_x = (ground_height(x + kNear, z) - ground_height(x - kNear, z)) / (2 * kNear);
    const double along_z = (ground_height(x, z + kNear) - ground_height(x, z - kNear)) / (2 * kNear);
    const double length = std::sqrt(along_x * along_x + 1 + along_z * along_z);
    const Vector normal = {-along_x / length, 1 / length, -along_z / length};
    const double size = std::sqrt(2 * (1 + normal[1]));
    return {normal[2] / size, 0, -normal[0] / size, (1 + normal[1]) / size};
}

Rotation multiply(const Rotation& a, const Rotation& b)  // b first
{
    return {
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

Vector turned(const Rotation& q, const Vector& v)
{
    const Rotation r = multiply(multiply(q, {v[0], v[1], v[2], 0}), {-q[0], -q[1], -q[2], q[3]});
    return {r[0], r[1], r[2]};
}

Vector sum(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

template <class To, class From>
To to_floats(const From& from)
{
    To to;
    std::ranges::transform(from, to.begin(), [](double each) { return static_cast<float>(each); });
    return to;
}

// One leg as the game keeps it. What the solver reads, all in the world, and the local rotations it writes.
struct Leg {
    Floats hip, sole, knee_forward;
    std::array<float, 4> pelvis, foot;
    std::array<float, 4> hip_local, knee_local, ankle_local;
    std::uint32_t flags;
};

// The skeleton at rest: legs straight down, feet along +z, no rotations. A straight rest pose does not show how a knee
// bends, so it is given: the shin goes backwards.
swivel_binding bind_leg()
{
    swivel_chain chain = swivel_default_chain();
    chain.elbow_offset[1] = -static_cast<float>(kThigh);
    chain.wrist_offset[1] = -static_cast<float>(kShin);
    chain.bend[2] = -1;
    return swivel::bind(chain);
}

// How far the pelvis may go up (above 0) or down, so that all legs reach.
struct Shifts {
    double low = -HUGE_VAL, high = HUGE_VAL;

    // A hip reaches its ankle from heights of `room` around the ankle's own. A foot too far aside leaves no room; then
    // the hip is nearest where it is level with the ankle.
    void add_leg(const Vector& hip, const Vector& ankle)
    {
        const double level = ankle[1] - hip[1], across = std::hypot(hip[0] - ankle[0], hip[2] - ankle[2]);
        const double room = std::sqrt(std::max(kReach * kReach - across * across, 0.0));
        low = std::max(low, level - room);
        high = std::min(high, level + room);
    }
    // The least shift that will do. Where none does, as far from what one leg needs as from what the other does.
    double least() const { return low <= high ? std::clamp(0.0, low, high) : (low + high) / 2; }
};

// Where a character's feet go, and where its pelvis must be for both legs to reach. aside: of the left foot, more than
// of its hip. Returns how far the pelvis came down.
double place_character(Leg* legs, double x, double z, double heading, double aside = 0)
{
    const Rotation pelvis = {0, std::sin(heading / 2), 0, std::cos(heading / 2)};
    Shifts shifts;
    std::array<Vector, 2> hips;
    for (int side = 0; side < 2; ++side) {
        const double sign = side == 0 ? 1 : -1;
        hips[side] = sum({x, ground_height(x, z) + kStanding, z}, turned(pelvis, {sign * kHipSide, 0, 0}));
        const double step = side == 0 ? aside : 0;
        Vector sole = sum({x, 0, z}, turned(pelvis, {sign * kHipSide + step, 0, sign * kStride}));
        sole[1] = ground_height(sole[0], sole[2]);
        const Rotation foot = multiply(ground_slope(sole[0], sole[2]), pelvis);
        const Vector ankle = sum(sole, turned(foot, {0, kAnkleHeight, 0}));
        shifts.add_leg(hips[side], ankle);

        legs[side].sole = to_floats<Floats>(sole);
        legs[side].foot = to_floats<std::array<float, 4>>(foot);
        legs[side].pelvis = to_floats<std::array<float, 4>>(pelvis);
        legs[side].knee_forward = to_floats<Floats>(turned(pelvis, {0, 0, 1}));
    }
    for (int side = 0; side < 2; ++side) {
        hips[side][1] += shifts.least();
        legs[side].hip = to_floats<Floats>(hips[side]);
    }
    return -shifts.least();
}

swivel::Crowd make_legs(std::uint32_t count)
{
    const swivel_features features = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR;
    // Left and right legs are alike.
    return swivel::Crowd({swivel::group(count, bind_leg(), features | SWIVEL_POLE_DIRECTION)});
}

void solve_legs(swivel::Crowd& crowd, std::vector<Leg>& legs)
{
    const Floats ankle_to_sole = {0, -static_cast<float>(kAnkleHeight), 0};  // in the ankle joint's frame
    swivel::Frame frame;
    frame.in(SWIVEL_TARGET, swivel::stream(legs, &Leg::sole));
    frame.in(SWIVEL_EFFECTOR, {&ankle_to_sole, 0});  // so targets are for soles, not for ankles
    frame.in(SWIVEL_HAND, swivel::stream(legs, &Leg::foot));
    frame.in(SWIVEL_POLE, swivel::stream(legs, &Leg::knee_forward));
    frame.in(SWIVEL_SHOULDER_POSITION, swivel::stream(legs, &Leg::hip));
    frame.in(SWIVEL_PARENT_ROTATION, swivel::stream(legs, &Leg::pelvis));
    frame.out(SWIVEL_SHOULDER, swivel::stream(legs, &Leg::hip_local));
    frame.out(SWIVEL_ELBOW, swivel::stream(legs, &Leg::knee_local));
    frame.out(SWIVEL_WRIST, swivel::stream(legs, &Leg::ankle_local));
    frame.out(SWIVEL_FLAGS, swivel::stream(legs, &Leg::flags));
    crowd.solve({.frames = {frame}});
}

struct Gap {  // between points of a foot and the ground
    double above = 0, below = 0;
    void add(const Vector& point)
    {
        const double gap = point[1] - ground_height(point[0], point[2]);
        above = std::max(above, gap);
        below = std::max(below, -gap);
    }
};

// Where the feet really are, by forward kinematics of the rotations.
int report(const swivel::Crowd& crowd, const std::vector<Leg>& legs, double most_drop)
{
    std::vector<Vector> ankles(legs.size());
    std::vector<Rotation> feet(legs.size());
    crowd.wrists(0, ankles);
    crowd.hands(0, feet);
    Gap soles, ends;
    for (std::size_t n = 0; n < legs.size(); ++n) {
        soles.add(sum(ankles[n], turned(feet[n], {0, -kAnkleHeight, 0})));
        for (const double end : {-0.05, 0.14}) ends.add(sum(ankles[n], turned(feet[n], {0, -kAnkleHeight, end})));
    }
    const auto reached = std::ranges::count(legs, std::uint32_t{SWIVEL_REACHED}, &Leg::flags);
    std::printf("%td of %zu feet reached; pelvis down by up to %.0f mm\n", reached, legs.size(), most_drop * 1e3);
    std::printf("soles within %.4f mm of the ground\n", std::max(soles.above, soles.below) * 1e3);
    std::printf("heels and toes up to %.0f mm above and %.0f mm below it: the ground is curved, a foot is not\n",
                ends.above * 1e3, ends.below * 1e3);
    const bool stands = reached == std::ssize(legs) && std::max(soles.above, soles.below) < 1e-5;
    return stands && std::max(ends.above, ends.below) < 0.01 ? 0 : 1;
}

// A foot that no height of the pelvis lets the leg reach.
void step_aside()
{
    constexpr double kAside = 1.2;
    swivel::Crowd crowd = make_legs(2);
    std::vector<Leg> legs(2);
    const double drop = place_character(legs.data(), 0, 0, 0, kAside);
    solve_legs(crowd, legs);
    std::array<double, 2> off;  // in legs' lengths
    crowd.residuals(0, off);
    std::printf("a foot %.1f m aside: the pelvis is down by %.0f mm, level with its ankle; %.0f mm are missing\n",
                kAside, drop * 1e3, off[0] * (kThigh + kShin) * 1e3);
}

int stand()
{
    swivel::Crowd crowd = make_legs(2 * kCharacterCount);
    std::vector<Leg> legs(2 * kCharacterCount);
    double most_drop = 0;
    for (std::uint32_t n = 0; n < kCharacterCount; ++n) {
        const double x = 1.3 * (n % 32) - 20, z = 1.7 * (n / 32) - 25, heading = 0.37 * n;
        most_drop = std::max(most_drop, place_character(&legs[2 * n], x, z, heading));
    }
    solve_legs(crowd, legs);
    return report(crowd, legs, most_drop);
}

}  // namespace

int main()
{
    try {
        step_aside();
        return stand();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
