// SPDX-License-Identifier: MIT
//
// The promise: hard arms among ordinary ones have the bits of each arm alone in a crowd of one. This holds however many
// there are, wherever they stand, in any block range, for all eight sets of features that change the plain formula.
#include <rapidcheck/catch.h>
#include <algorithm>
#include <cstring>

#include "core/solve_arm.h"
#include "core/space.h"
#include "tests/test_isa_scope.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// The plain formula holds for none of these; see formula_holds().
void harden(Random& random, Limb& limb)
{
    switch (random.below(6)) {
        case 0:
            limb.pole = limb.target;
            break;
        case 1:
            limb.target = limb.position;
            break;
        case 2:
            limb.target[random.below(3)] = kNan;
            break;
        case 3:
            limb.pole = floats(Vector3d(1e14 * random.direction()));
            break;
        case 4:
            limb.lengths[random.below(2)] = 0;
            break;
        case 5:
            limb.lengths = {1e-13f, 1e-13f};
            break;
    }
}

// A limb for which the plain formula holds. The parent's rotation is of unit length.
Limb ordinary_limb(Random& random, swivel_features features)
{
    Limb limb = random_limb(random, features, {1, static_cast<float>(random.between(0.8, 1.25))});
    limb.rotation = floats(quat(limb.rotation).normalized());
    return limb;
}

// Whether the plain formula holds for the limb's arm, by the tests of solve_step() (simd/arm_kernels.cpp).
bool formula_holds(const Limb& limb, swivel_features features)
{
    const auto vector_of = [](const Float3& v) { return swivel::vector(v[0], v[1], v[2]); };
    const Vector<float> target = vector_of(limb.target), pole = vector_of(limb.pole);
    if (!(features & SWIVEL_WORLD))
        return solve_plain(ArmGoal<float>{target, pole, limb.lengths[0], limb.lengths[1]}).holds;
    const Float4& q = limb.rotation;
    const ParentFrame<float> parent{vector_of(limb.position), rotor(q[0], q[1], q[2], q[3]), limb.scale[0]};
    const SeenGoal<float> seen = seen_by(parent, target, pole, 1.0f);
    const ArmGoal<float> goal{seen.wrist, seen.pole, seen.size * limb.lengths[0], seen.size * limb.lengths[1]};
    return is_ordinary(parent, seen) && solve_plain(goal).holds;
}

// Which arms are hard: one in so many, by chance, or in runs of two and a half blocks.
bool is_hard(Random& random, std::uint32_t one_in, std::uint32_t n)
{
    return one_in > 0 ? random.below(one_in) == 0 : n / 40 % 2 == 1;
}

Crowd mixed_crowd(Random& random, swivel_features features, std::uint32_t count, const swivel_binding& binding)
{
    Crowd crowd = crowd_of(features, count, binding);
    const std::uint32_t one_in = std::array{0u, 1u, 2u, 3u, 64u}[random.below(5)];
    for (std::uint32_t n = 0; n < count; ++n) {
        Limb limb = ordinary_limb(random, features);
        const bool hard = is_hard(random, one_in, n);
        if (hard) harden(random, limb);
        CHECK(formula_holds(limb, features) == !hard);
        write_limb(crowd, 0, n, limb);
    }
    return crowd;
}

// Copies a limb's inputs to the first limb of another crowd.
void copy_inputs(const Crowd& crowd, std::uint32_t n, Crowd& to)
{
    const swivel_rows from = swivel_input_rows(crowd.get(), 0), alone = swivel_input_rows(to.get(), 0);
    for (std::uint32_t row = 0; row < from.row_count; ++row)
        std::memcpy(
            alone.base + row * SWIVEL_LANES,
            from.base + (std::size_t{n / SWIVEL_LANES} * from.row_count + row) * SWIVEL_LANES + n % SWIVEL_LANES,
            sizeof(float));
}

using Words = std::vector<std::vector<std::uint32_t>>;  // of each limb's results

Words solve_each_alone(const Crowd& crowd, swivel_features features, const swivel_binding& binding)
{
    REQUIRE(swivel_use_isa("scalar") == SWIVEL_OK);
    Crowd alone = crowd_of(features, 1, binding);
    Words words;
    for (std::uint32_t n = 0; n < swivel_group_limb_count(crowd.get(), 0); ++n) {
        copy_inputs(crowd, n, alone);
        alone.solve();
        words.push_back(result_words(alone, 0));
    }
    return words;
}

// Solves some blocks, and compares their limbs. Ranges end where they fall.
bool is_same_in(Crowd& crowd, const swivel_blocks& blocks, const Words& expected)
{
    crowd.solve({.blocks = blocks, .on_this_thread = true});
    const std::size_t end = std::min(std::size_t{blocks.first + blocks.count} * SWIVEL_LANES, expected.size());
    for (std::size_t n = std::size_t{blocks.first} * SWIVEL_LANES; n < end; ++n)
        if (result_words(crowd, static_cast<std::uint32_t>(n)) != expected[n]) return false;
    return true;
}

}  // namespace

TEST_CASE("hard arms among ordinary ones have the bits of each arm alone")
{
    const IsaScope scope;
    const std::vector<std::string> isas = runnable_isas();
    rc::prop("any features, counts, shares and block ranges, on every instruction set", [&](std::uint64_t seed) {
        Random random{seed};
        const swivel_features features = random.below(8);
        const swivel_binding binding = features & SWIVEL_JOINTS ? chained(random).bound : swivel_default_binding();
        Crowd crowd = mixed_crowd(random, features, 1 + random.below(400), binding);
        const Words alone = solve_each_alone(crowd, features, binding);
        const std::uint32_t block_count = swivel_block_count(crowd.get()), first = random.below(block_count);
        for (const std::string& isa : isas) {
            REQUIRE(swivel_use_isa(isa.c_str()) == SWIVEL_OK);
            const bool same_part = is_same_in(crowd, {first, 1 + random.below(block_count - first)}, alone);
            RC_ASSERT(same_part);
            const bool same = is_same_in(crowd, {0, block_count}, alone);
            RC_ASSERT(same);
        }
    });
}
