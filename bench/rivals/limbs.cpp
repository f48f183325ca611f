// SPDX-License-Identifier: MIT
#include "bench/rivals/limbs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "bench/rivals/machine.h"

namespace bench {

namespace {

struct Random {  // xorshift64*
    std::uint64_t state = 0x9e3779b97f4a7c15u;
    double operator()(double from, double to)
    {
        state ^= state >> 12, state ^= state << 25, state ^= state >> 27;
        return from + (to - from) * static_cast<double>((state * 0x2545f4914f6cdd1du) >> 11) * 0x1p-53;
    }
};

// Of unit length, in any direction.
template <std::size_t N>
std::array<double, N> random_unit(Random& random)
{
    for (;;) {
        std::array<double, N> v;
        double length2 = 0;
        for (double& x : v) x = random(-1, 1), length2 += x * x;
        if (length2 > 1 || length2 < 0.01) continue;
        for (double& x : v) x /= std::sqrt(length2);
        return v;
    }
}

template <std::size_t N>
void store(const std::array<double, N>& v, double scale, float (&to)[N])
{
    for (std::size_t n = 0; n < N; ++n) to[n] = static_cast<float>(scale * v[n]);
}

Limb random_limb(Random& random)
{
    Limb limb{};
    const double upper = random(0.2, 0.4), fore = upper * random(0.7, 1.4);
    const double near = std::fabs(upper - fore), far = upper + fore;
    const int band = static_cast<int>(random(0, 10));
    const double share = band < 7    ? random(0.05, 0.98)
                         : band == 7 ? random(0.98, 1.0)
                         : band == 8 ? random(-0.05, 0.05)
                                     : random(1.0, 1.3);
    const double distance = std::fmax(near + share * (far - near), 0.01);
    const std::array u = random_unit<3>(random);
    std::array pole = random_unit<3>(random);
    while (std::fabs(pole[0] * u[0] + pole[1] * u[1] + pole[2] * u[2]) > 0.995) pole = random_unit<3>(random);
    store(u, distance, limb.target);
    store(pole, random(0.2, 2.0), limb.pole);
    store({upper, fore}, 1, limb.lengths);
    store({random(-50, 50), random(0, 2), random(-50, 50)}, 1, limb.position);
    store(random_unit<4>(random), 1, limb.rotation);
    store({random(0.9, 1.1)}, 1, limb.scale);
    store(random_unit<4>(random), 1, limb.hand);
    limb.ordinary = band < 7 && distance > 0.02;
    return limb;
}

}  // namespace

swivel_binding arm_along_x(float upper, float fore)
{
    const std::int32_t parents[] = {-1, 0, 1};
    const float translations[][3] = {{0, 0, 0}, {upper, 0, 0}, {fore, 0, 0}};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = 3;
    skeleton.parents = {parents, sizeof parents[0]};
    skeleton.translations = {translations, sizeof translations[0]};
    swivel_limb_joints joints = swivel_default_limb_joints(0, 1, 2);
    joints.bend[2] = 1;
    return swivel::bind(skeleton, joints);
}

std::vector<Limb> random_limbs(std::size_t count)
{
    Random random;
    std::vector<Limb> limbs(count);
    for (Limb& limb : limbs) limb = random_limb(random);
    return limbs;
}

// p + s (v + 2 q x (q x v + w v)).
void to_world(const Limb& limb, float (&v)[3])
{
    const float(&q)[4] = limb.rotation;
    const auto cross = [&](const float(&a)[3], std::size_t n) {
        return q[(n + 1) % 3] * a[(n + 2) % 3] - q[(n + 2) % 3] * a[(n + 1) % 3];
    };
    const float t[3] = {cross(v, 0) + q[3] * v[0], cross(v, 1) + q[3] * v[1], cross(v, 2) + q[3] * v[2]};
    for (std::size_t n = 0; n < 3; ++n) v[n] = limb.position[n] + limb.scale[0] * (v[n] + 2 * cross(t, n));
}

Arms arms_of(std::span<const Limb> limbs)
{
    Arms arms(limbs.size());
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            arms[axis][n] = limbs[n].target[axis];
            arms[3 + axis][n] = limbs[n].pole[axis];
        }
        for (std::size_t bone = 0; bone < 2; ++bone) arms[6 + bone][n] = limbs[n].lengths[bone];
    }
    return arms;
}

std::vector<SingleArm> single_arms_of(std::span<const Limb> limbs)
{
    std::vector<SingleArm> arms;
    for (const Limb& limb : limbs)
        arms.push_back({{limb.target[0], limb.target[1], limb.target[2]},
                        {limb.pole[0], limb.pole[1], limb.pole[2]},
                        limb.lengths[0],
                        limb.lengths[1]});
    return arms;
}

swivel::Crowd make_crowd(swivel_features features, std::size_t arm_count, std::span<const Limb> limbs,
                         const swivel_region* region)
{
    swivel_limb_def arms = swivel::limbs(static_cast<std::uint32_t>(arm_count), features);
    arms.binding = arm_along_x(1, 1);
    arms.region = region;
    swivel::Crowd crowd({arms});

    std::vector<Limb> given(limbs.begin(),
                            limbs.begin() + static_cast<std::ptrdiff_t>(std::min(limbs.size(), arm_count)));
    if (features & SWIVEL_WORLD)
        for (Limb& limb : given) to_world(limb, limb.target), to_world(limb, limb.pole);
    const auto write = [&](swivel_field field, const float* first) {
        if (swivel_field_row_count(crowd.get(), 0, field) == 0) return;
        swivel::check(
            swivel_write(crowd.get(), field, 0, 0, static_cast<std::uint32_t>(given.size()), {first, sizeof(Limb)}));
    };
    write(SWIVEL_TARGET, given[0].target);
    write(SWIVEL_POLE, given[0].pole);
    write(SWIVEL_LENGTHS, given[0].lengths);
    write(SWIVEL_SHOULDER_POSITION, given[0].position);
    write(SWIVEL_PARENT_ROTATION, given[0].rotation);
    write(SWIVEL_PARENT_SCALE, given[0].scale);
    write(SWIVEL_HAND, given[0].hand);
    write_limb_inputs(crowd, static_cast<std::uint32_t>(given.size()));

    // The rest of a large crowd: whole blocks of the limbs just written, again and again.
    const swivel_rows rows = swivel_input_rows(crowd.get(), 0);
    const std::size_t block = std::size_t{rows.row_count} * SWIVEL_LANES, written = given.size() / SWIVEL_LANES;
    for (std::size_t n = written; written > 0 && n < rows.block_count; ++n)
        std::memcpy(rows.base + n * block, rows.base + n % written * block, block * sizeof(float));
    return crowd;
}

std::size_t arms_within(std::size_t memory_level, swivel_features features)
{
    swivel_limb_def arm = swivel::limbs(1, features);
    arm.binding = arm_along_x(1, 1);
    const swivel::Crowd crowd({arm});
    const std::size_t row_count =
        swivel_input_rows(crowd.get(), 0).row_count + swivel_result_rows(crowd.get(), 0).row_count;
    const std::size_t blocks = working_sets()[memory_level] / (row_count * sizeof(float)) / SWIVEL_LANES;
    return std::max(blocks, std::size_t{1}) * SWIVEL_LANES;
}

Poses poses_of(const swivel::Crowd& crowd)
{
    const swivel_rows rows = swivel_result_rows(crowd.get(), 0);
    Poses poses(swivel_group_limb_count(crowd.get(), 0));
    for (std::size_t n = 0; n < poses.count(); ++n)
        for (std::size_t row = 0; row < 7; ++row)
            poses[row][n] = rows.base[(n / SWIVEL_LANES * rows.row_count + row) * SWIVEL_LANES + n % SWIVEL_LANES];
    return poses;
}

void solve_all(swivel::Crowd& crowd, const std::string& isa)
{
    swivel::check(swivel_use_isa(isa.c_str()));
    crowd.solve({.blocks = swivel_blocks{0, swivel_block_count(crowd.get())}, .on_this_thread = true});
}

std::vector<std::string> runnable_isas()
{
    std::vector<std::string> names;
    for (std::uint32_t n = 0; const char* name = swivel_isa_at(n); ++n)
        if (swivel_isa_runs(name)) names.emplace_back(name);
    return names;
}

}  // namespace bench
