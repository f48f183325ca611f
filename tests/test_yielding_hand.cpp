// SPDX-License-Identifier: MIT
//
// The promise of hands that yield: where the wrist is at its place they are as wanted, to the last bit. Elsewhere the
// least turn brings the effector onto the line from the wrist to its target. Eigen judges, in double.
#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include "tests/test_arm.h"
#include "tests/test_random.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kYieldingLimbs = 64;
constexpr swivel_features kHand = SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR;

struct Goals {
    std::vector<Float3> targets, poles, effectors;
    std::vector<Float4> hands;
    Float4 reach;  // soft zones far and near, most stretch, least distance
};
Goals random_goals(Random& random)
{
    Goals goals;
    for (std::uint32_t n = 0; n < kYieldingLimbs; ++n) {
        goals.targets.push_back(floats(random.vector(0.05, 4)));
        goals.poles.push_back(floats(random.direction()));
        goals.effectors.push_back(floats(random.vector(0.05, 0.6)));
        goals.hands.push_back(floats(random.rotation()));
    }
    goals.reach = {0.1f, 0.1f, static_cast<float>(random.between(1, 1.3)), 0.2f};
    return goals;
}

struct Results {
    std::vector<Float4> shoulders, wrists;
    std::vector<Float2> elbows;
    std::vector<float> stretches;
    std::vector<std::uint32_t> flags;

    Quaterniond elbow(std::size_t n) const { return {elbows[n][0], -double{elbows[n][1]}, 0, 0}; }
    Quaterniond fore(std::size_t n) const { return (quat(shoulders[n]) * elbow(n)).normalized(); }
    Quaterniond hand(std::size_t n) const { return fore(n) * quat(wrists[n]).normalized(); }
    Vector3d wrist(std::size_t n) const  // of bones of length 1
    {
        return stretches[n] * (quat(shoulders[n]).normalized() * Vector3d::UnitZ() + fore(n) * Vector3d::UnitZ());
    }
};
Results solved(const Goals& goals, swivel_features features)
{
    Crowd crowd = crowd_of(kHand | SWIVEL_WITH_REACH | features, kYieldingLimbs);
    crowd.write(SWIVEL_TARGET, 0, goals.targets);
    crowd.write(SWIVEL_POLE, 0, goals.poles);
    crowd.write(SWIVEL_EFFECTOR, 0, goals.effectors);
    crowd.write(SWIVEL_HAND, 0, goals.hands);
    crowd.write_all(SWIVEL_REACH, 0, goals.reach);
    crowd.solve();
    return {read<Float4>(crowd, SWIVEL_SHOULDER), read<Float4>(crowd, SWIVEL_WRIST), read<Float2>(crowd, SWIVEL_ELBOW),
            read<float>(crowd, SWIVEL_STRETCH), read<std::uint32_t>(crowd, SWIVEL_FLAGS)};
}

double angle(const Vector3d& a, const Vector3d& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

}  // namespace

TEST_CASE("a hand yields where its wrist does not get to its place, and there alone")
{
    rc::prop("", [] {
        Random random{*rc::gen::arbitrary<std::uint64_t>()};
        const Goals goals = random_goals(random);
        const Results stiff = solved(goals, 0), yielding = solved(goals, SWIVEL_HAND_YIELDS);
        RC_ASSERT(stiff.shoulders == yielding.shoulders);
        RC_ASSERT(stiff.elbows == yielding.elbows);
        RC_ASSERT(stiff.flags == yielding.flags);
        for (std::size_t n = 0; n < kYieldingLimbs; ++n) {
            if (yielding.flags[n] & SWIVEL_REACHED) {
                RC_ASSERT(stiff.wrists[n] == yielding.wrists[n]);
                continue;
            }
            const Vector3d effector = vec(goals.effectors[n]), was = stiff.hand(n) * effector,
                           is = yielding.hand(n) * effector, wanted = vec(goals.targets[n]) - yielding.wrist(n);
            if (wanted.norm() < 0.05 || angle(was, wanted) > 3.1) continue;  // floats do not know the line, or the turn
            RC_ASSERT(angle(is, wanted) < 1e-4);
            RC_ASSERT(std::abs(yielding.hand(n).angularDistance(stiff.hand(n)) - angle(was, wanted)) < 1e-4);
        }
    });
}
