// SPDX-License-Identifier: MIT
//
// The promise: a set of features that is compiled as constants gives the bits of the same features told at run time.
// An angle of no turn changes nothing, but there is no constant set that has one.
#include <rapidcheck/catch.h>

#include "tests/test_isa_scope.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr swivel_features kConeAndTwist = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST,
                          kWholeArm = SWIVEL_WORLD | SWIVEL_WITH_HAND | SWIVEL_WITH_INCOMING | SWIVEL_WITH_WEIGHTS |
                                      SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_SHOULDER_CONE;

// One in three is hard: its plane is undefined, its target out of reach, or not a number.
Limb any_limb(Random& random, swivel_features features)
{
    Limb limb = random_limb(random, features, {1, static_cast<float>(random.spread(0.5, 2))});
    const Vector3d from = vec(limb.position), arm = vec(limb.target) - from;
    switch (random.below(9)) {
        case 0:
            limb.pole = limb.target;
            break;
        case 1:
            limb.target = floats(Vector3d(from + random.between(3, 9) * arm));
            break;
        case 2:
            limb.target[random.below(3)] = kNan;
            break;
    }
    return limb;
}

// The values that a crowd does not have are drawn all the same.
void write_limb(Random& random, Crowd& crowd, swivel_features features, std::uint32_t n)
{
    const auto give = [&](swivel_field field, const auto& value) {
        if (swivel_field_row_count(crowd.get(), field)) put(crowd, field, n, value);
    };
    write_limb(crowd, 0, n, any_limb(random, features));
    for (const swivel_field field : {SWIVEL_INCOMING_SHOULDER, SWIVEL_INCOMING_ELBOW, SWIVEL_INCOMING_WRIST})
        give(field, floats(Quaterniond(random.spread(0.01, 100) * random.rotation().coeffs())));
    Float3 weights;
    for (float& weight : weights) weight = random.below(4) ? static_cast<float>(random.unit()) : 1.0f;
    give(SWIVEL_WEIGHTS, weights);
    Float2 flexion;
    CHECK(swivel_flexion(random.between(0, 1), random.between(1, 3), flexion.data()) == SWIVEL_OK);
    give(SWIVEL_FLEXION_LIMIT, flexion);
    Float4 cone;
    CHECK(swivel_cone(random.direction().data(), random.between(0.3, 2.5), cone.data()) == SWIVEL_OK);
    give(SWIVEL_SHOULDER_CONE, cone);
    give(SWIVEL_HUMERAL_TWIST, range_of({random.between(-kPi, kPi), random.between(0.2, 3)}));
}

Crowd solved_crowd(std::uint64_t seed, swivel_features features, swivel_features more)
{
    Random random{seed};
    const std::uint32_t count = 1 + random.below(80);
    Crowd crowd = crowd_of(features | more, count);
    for (std::uint32_t n = 0; n < count; ++n) write_limb(random, crowd, features, n);
    crowd.solve();
    return crowd;
}

// How many limbs broke a limit, had no swivel, or were bad input.
struct Seen {
    int limited = 0, infeasible = 0, bad = 0;

    void add(std::uint32_t flags)
    {
        limited += (flags & SWIVEL_LIMITED_SHOULDER_CONE) != 0;
        infeasible += (flags & SWIVEL_INFEASIBLE) != 0;
        bad += (flags & SWIVEL_BAD_INPUT) != 0;
    }
};

void compare_sets(swivel_features features)
{
    const IsaScope scope;
    const std::vector<std::string> isas = runnable_isas();
    Seen seen;
    rc::prop("any limbs, on every instruction set", [&](std::uint64_t seed) {
        for (const std::string& isa : isas) {
            REQUIRE(swivel_use_isa(isa.c_str()) == SWIVEL_OK);
            const Crowd constant = solved_crowd(seed, features, 0);
            const Crowd told = solved_crowd(seed, features, SWIVEL_WITH_ANGLE);
            const auto flags = read<std::uint32_t>(constant, SWIVEL_FLAGS);
            for (std::uint32_t n = 0; n < flags.size(); ++n) {
                const bool same = result_words(constant, n) == result_words(told, n);
                RC_ASSERT(same);
                seen.add(flags[n]);
            }
        }
    });
    CHECK(seen.limited > 100);
    CHECK(seen.infeasible > 100);
    CHECK(seen.bad > 100);
}

}  // namespace

TEST_CASE("a cone with a twist has the bits of the same features told at run time") { compare_sets(kConeAndTwist); }

TEST_CASE("a whole arm has the bits of the same features told at run time") { compare_sets(kWholeArm); }
