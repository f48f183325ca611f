// SPDX-License-Identifier: MIT
//
// The promise: a cone with a twist, whose features are compiled as constants, gives the bits of the same features told
// at run time. An angle of no turn changes nothing, but no constant set has one.
#include <rapidcheck/catch.h>

#include "tests/test_isa_scope.h"
#include "tests/test_whole_limb.h"

using namespace swivel;
using namespace swivel::test;

namespace {

constexpr swivel_features kConeAndTwist = SWIVEL_WITH_SHOULDER_CONE | SWIVEL_WITH_HUMERAL_TWIST;

// One in three is hard: its plane is undefined, its target out of reach, or not a number.
Limb any_limb(Random& random)
{
    Limb limb = random_limb(random, kConeAndTwist, {1, static_cast<float>(random.spread(0.5, 2))});
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

void write_limb(Random& random, Crowd& crowd, std::uint32_t n)
{
    write_limb(crowd, 0, n, any_limb(random));
    Float4 cone;
    CHECK(swivel_cone(random.direction().data(), random.between(0.3, 2.5), cone.data()) == SWIVEL_OK);
    put(crowd, SWIVEL_SHOULDER_CONE, n, cone);
    put(crowd, SWIVEL_HUMERAL_TWIST, n, range_of({random.between(-kPi, kPi), random.between(0.2, 3)}));
}

Crowd solved_crowd(std::uint64_t seed, swivel_features features)
{
    Random random{seed};
    const std::uint32_t count = 1 + random.below(80);
    Crowd crowd = crowd_of(features, count);
    for (std::uint32_t n = 0; n < count; ++n) write_limb(random, crowd, n);
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

}  // namespace

TEST_CASE("a cone with a twist has the bits of the same features told at run time")
{
    const IsaScope scope;
    const std::vector<std::string> isas = runnable_isas();
    Seen seen;
    rc::prop("any limbs, on every instruction set", [&](std::uint64_t seed) {
        for (const std::string& isa : isas) {
            REQUIRE(swivel_use_isa(isa.c_str()) == SWIVEL_OK);
            const Crowd constant = solved_crowd(seed, kConeAndTwist);
            const Crowd told = solved_crowd(seed, kConeAndTwist | SWIVEL_WITH_ANGLE);
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
