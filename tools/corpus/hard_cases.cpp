// SPDX-License-Identifier: MIT
#include "tools/corpus/hard_cases.h"

#include <iterator>

#include "tools/corpus/hard_poses.h"

namespace swivel::corpus {

namespace {

constexpr float kBad[] = {kNan, kInf, -kInf, -0.0f, 1e-45f, -1e-38f, 1e-20f, 3e38f};
// Numbers that spoil values: some of them good.
constexpr float kSpoiling[] = {0.0f,  -0.0f,  1e-15f, -3e-12f, 1e-38f, 1e-45f, 1.0f,  -1.0f,
                               1e15f, -1e15f, 2e15f,  3e38f,   kNan,   kInf,   -kInf, 0.5f};

constexpr std::uint32_t kPoseCount = std::size(kPoses), kFrameCount = std::size(kFrames), kBadCount = std::size(kBad),
                        kArmNumbers = 20;
static_assert(kLimbCaseCount <= kPoseCount);

// Number c of a good arm replaced.
Arm with_number(std::uint32_t c, float bad)
{
    Arm arm;
    for (const Field field : kArmFields) {
        const std::span<float> values = arm.values(field);
        if (c < values.size()) values[c] = bad;
        c -= static_cast<std::uint32_t>(values.size());
        if (c >= kArmNumbers) break;  // it has wrapped around
    }
    return arm;
}

// Powers of two and signed permutations of axes are exact.
Arm moved(const Arm& arm, std::uint32_t pass)
{
    constexpr float sizes[] = {1, 0x1p10f, 0x1p-10f, 0x1p30f, 0x1p-30f};
    const float size = sizes[pass % 5], sign = pass % 2 == 0 ? 1.0f : -1.0f;
    Arm to = arm;
    for (std::uint32_t c = 0; c < 3; ++c) {
        const std::uint32_t from = (c + pass) % 3;
        to.target[c] = size * (c == 0 ? sign : 1.0f) * arm.target[from];
        to.pole[c] = size * (c == 0 ? sign : 1.0f) * arm.pole[from];
    }
    for (float& length : to.lengths) length *= size;
    return to;
}

}  // namespace

std::uint32_t hard_case_count() { return kPoseCount + kFrameCount + kArmNumbers * kBadCount; }

Arm hard_case(std::uint32_t n)
{
    const std::uint32_t pass = n / hard_case_count();
    n %= hard_case_count();
    if (n < kPoseCount) return moved(kPoses[n].arm, pass);
    n -= kPoseCount;
    if (n < kFrameCount) return kFrames[n].arm;
    n -= kFrameCount;
    return with_number(n / kBadCount, kBad[n % kBadCount]);
}

void spoil(Random& random, std::span<float> values, std::uint32_t one_in)
{
    for (float& x : values)
        if (random.below(one_in) == 0) x = kSpoiling[random.below(std::size(kSpoiling))];
}
void spoil(Random& random, std::span<double> values, std::uint32_t one_in)
{
    for (double& x : values)
        if (random.below(one_in) == 0) x = double{kSpoiling[random.below(std::size(kSpoiling))]};
}

}  // namespace swivel::corpus
