// SPDX-License-Identifier: MIT
//
// The promise: frames of several groups, whose limbs lie side by side in characters, give the bits of writing, solving
// and reading apart. This holds for groups of any number and size, any blocks, mask and list, on this thread and on
// several. Bytes beside the values of the chosen limbs stay.
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tests/test_random.h"

#include <rapidcheck/catch.h>
#include <algorithm>
#include <bit>

using namespace swivel;
using namespace swivel::test;

namespace {

using Bytes = std::vector<unsigned char>;
using Double3 = std::array<double, 3>;
constexpr double kFar = 1e6;  // where the characters are, if positions are doubles

// What a character has of each limb. The positions are floats or doubles.
struct InCharacter {
    Double3 origin, target, pole;
    Float4 shoulder, elbow;
    std::uint32_t flags;
};

struct Problem {
    std::vector<swivel_group_def> groups;
    bool in_doubles = false;
    std::size_t stride = 0;
    Bytes characters;
    swivel_blocks blocks = {};
    std::vector<std::uint32_t> mask;  // empty: none is given

    Crowd crowd() const { return crowd_with(SWIVEL_JOINTS, groups); }
    template <class Bytes>
    auto* member(Bytes& bytes, std::uint32_t group, std::uint32_t n, std::size_t offset) const
    {
        return bytes.data() + n * stride + group * sizeof(InCharacter) + offset;
    }
    bool is_chosen(const Crowd& crowd, std::uint32_t group, std::uint32_t n) const
    {
        const std::uint32_t limb = swivel_group_first_limb(crowd.get(), group) + n, block = limb / SWIVEL_LANES;
        return block >= blocks.first && block - blocks.first < blocks.count &&
               (mask.empty() || (mask[limb / 32] >> limb % 32 & 1));
    }
};

template <class T>
void store(unsigned char* at, const T& value)
{
    std::memcpy(at, &value, sizeof value);
}
template <class T>
T load(const unsigned char* at)
{
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

void fill_limb(Random& random, const Problem& problem, Bytes& bytes, std::uint32_t group, std::uint32_t n)
{
    const auto at = [&](std::size_t offset) { return problem.member(bytes, group, n, offset); };
    const Vector3d target = random.between(0.1, 2.2) * random.direction(), pole = random.direction();
    if (!problem.in_doubles) {
        store(at(offsetof(InCharacter, target)), floats(target));
        store(at(offsetof(InCharacter, pole)), floats(pole));
        return;
    }
    const Vector3d origin = kFar * random.direction(), far_target = origin + target, far_pole = origin + pole;
    store(at(offsetof(InCharacter, origin)), origin);
    store(at(offsetof(InCharacter, target)), far_target);
    store(at(offsetof(InCharacter, pole)), far_pole);
}

std::uint32_t most_limbs(const Problem& problem)
{
    return std::ranges::max(problem.groups, {}, &swivel_group_def::limb_count).limb_count;
}
// Gives each character all its bytes, and each limb its values.
void fill_characters(Random& random, Problem& problem)
{
    problem.characters.resize(most_limbs(problem) * problem.stride);
    for (unsigned char& byte : problem.characters) byte = static_cast<unsigned char>(random.word());
    for (std::uint32_t g = 0; g < problem.groups.size(); ++g)
        for (std::uint32_t n = 0; n < problem.groups[g].limb_count; ++n)
            fill_limb(random, problem, problem.characters, g, n);
}
void mask_one_in(Random& random, Problem& problem, std::uint32_t one_in)
{
    problem.mask.resize((swivel_block_count(problem.crowd().get()) + 1) / 2);
    for (std::uint32_t limb = 0; limb < 32 * problem.mask.size(); ++limb)
        if (random.below(one_in) == 0) problem.mask[limb / 32] |= 1u << limb % 32;
}

// Groups of very different sizes, up to several rounds of several together.
Problem random_problem(Random& random)
{
    Problem problem;
    problem.in_doubles = random.below(3) == 0;
    for (std::uint32_t g = 1 + random.below(9); g > 0; --g) {
        const std::uint32_t sizes[] = {1 + random.below(20), 16, 1 + random.below(200), 1 + random.below(1500)};
        const bool as_large = g % 2 == 0 && !problem.groups.empty();
        problem.groups.push_back(group_of(as_large ? most_limbs(problem) : sizes[random.below(4)]));
    }
    const std::size_t bytes = problem.groups.size() * sizeof(InCharacter), strides[] = {bytes, bytes + 1, 1024, 1536};
    do problem.stride = strides[random.below(4)];
    while (problem.stride < bytes);
    fill_characters(random, problem);

    const std::uint32_t block_count = swivel_block_count(problem.crowd().get());
    problem.blocks = {0, block_count};
    if (random.below(2) == 0) {
        problem.blocks.first = random.below(block_count);
        problem.blocks.count = random.below(block_count - problem.blocks.first + 1);
    }
    if (const std::uint32_t one_in = std::array{0u, 0u, 1u, 2u, 60u}[random.below(5)]; one_in > 0)
        mask_one_in(random, problem, one_in);
    return problem;
}

// A mask, and so many rounds that threads share them: three groups share a round of 64 blocks.
Problem problem_of_many_rounds(Random& random)
{
    Problem problem;
    for (const std::uint32_t limb_count : {5003u, 40u, 4999u}) problem.groups.push_back(group_of(limb_count));
    problem.stride = problem.groups.size() * sizeof(InCharacter);
    fill_characters(random, problem);
    const std::uint32_t first = random.below(40);
    problem.blocks = {first, swivel_block_count(problem.crowd().get()) - first};
    mask_one_in(random, problem, 3);
    return problem;
}

std::vector<Frame> frames_in(const Problem& problem, Bytes& bytes)
{
    std::vector<Frame> frames(problem.groups.size());
    for (std::uint32_t g = 0; g < problem.groups.size(); ++g) {
        Frame& frame = frames[g];
        const auto in = [&](std::size_t offset) {
            return swivel_in{problem.member(bytes, g, 0, offset), problem.stride};
        };
        const auto out = [&](std::size_t offset) {
            return swivel_out{problem.member(bytes, g, 0, offset), problem.stride};
        };
        if (problem.in_doubles) frame.origin(in(offsetof(InCharacter, origin)));
        frame.in(SWIVEL_TARGET, in(offsetof(InCharacter, target)));
        frame.in(SWIVEL_POLE, in(offsetof(InCharacter, pole)));
        frame.out(SWIVEL_SHOULDER, out(offsetof(InCharacter, shoulder)));
        frame.out(SWIVEL_ELBOW, out(offsetof(InCharacter, elbow)));
        frame.out(SWIVEL_FLAGS, out(offsetof(InCharacter, flags)));
    }
    return frames;
}

Float3 position(const Problem& problem, const unsigned char* value, const unsigned char* origin)
{
    if (!problem.in_doubles) return load<Float3>(value);
    const auto at = load<Double3>(value), from = load<Double3>(origin);
    return {static_cast<float>(at[0] - from[0]), static_cast<float>(at[1] - from[1]),
            static_cast<float>(at[2] - from[2])};
}

// One limb after the other into rows; the solve; one limb after the other out of rows.
void solve_by_limbs(const Problem& problem, Crowd& crowd, Bytes& bytes)
{
    const auto each_chosen = [&](auto take) {
        for (std::uint32_t g = 0; g < problem.groups.size(); ++g)
            for (std::uint32_t n = 0; n < problem.groups[g].limb_count; ++n)
                if (problem.is_chosen(crowd, g, n))
                    take(g, n, [&, g, n](std::size_t offset) { return problem.member(bytes, g, n, offset); });
    };
    each_chosen([&](std::uint32_t g, std::uint32_t n, auto at) {
        const unsigned char* const origin = at(offsetof(InCharacter, origin));
        const Float3 target = position(problem, at(offsetof(InCharacter, target)), origin),
                     pole = position(problem, at(offsetof(InCharacter, pole)), origin);
        crowd.write(SWIVEL_TARGET, g, std::span(&target, 1), n);
        crowd.write(SWIVEL_POLE, g, std::span(&pole, 1), n);
    });
    if (problem.mask.empty())
        crowd.solve({.blocks = problem.blocks, .on_this_thread = true});
    else
        crowd.solve({.blocks = problem.blocks, .mask = problem.mask, .on_this_thread = true});
    each_chosen([&](std::uint32_t g, std::uint32_t n, auto at) {
        const auto read = [&](swivel_field field, std::size_t offset) {
            check(swivel_read(crowd.get(), field, g, n, 1, {at(offset), problem.stride}));
        };
        read(SWIVEL_SHOULDER, offsetof(InCharacter, shoulder));
        read(SWIVEL_ELBOW, offsetof(InCharacter, elbow));
        read(SWIVEL_FLAGS, offsetof(InCharacter, flags));
    });
}

// The words of all limbs' rows. Lanes of padding may be solved or not.
std::vector<std::uint32_t> limb_words(const Problem& problem, const Crowd& crowd)
{
    std::vector<std::uint32_t> words;
    for (std::uint32_t group = 0; group < problem.groups.size(); ++group)
        for (const swivel_rows rows : {swivel_input_rows(crowd.get(), group), swivel_result_rows(crowd.get(), group)})
            for (std::size_t limb = 0; limb < swivel_group_limb_count(crowd.get(), group); ++limb)
                for (std::size_t row = 0; row < rows.row_count; ++row)
                    words.push_back(std::bit_cast<std::uint32_t>(
                        rows.base[(limb / SWIVEL_LANES * rows.row_count + row) * SWIVEL_LANES + limb % SWIVEL_LANES]));
    return words;
}

std::uint32_t solve_by_frames(const Problem& problem, Crowd& crowd, Bytes& bytes, bool on_this_thread)
{
    const std::vector<Frame> own = frames_in(problem, bytes);
    const std::vector<swivel_frame> frames(own.begin(), own.end());
    if (problem.mask.empty())
        return crowd.solve({.blocks = problem.blocks, .frames = frames, .on_this_thread = on_this_thread});
    return crowd.solve(
        {.blocks = problem.blocks, .mask = problem.mask, .frames = frames, .on_this_thread = on_this_thread});
}

// Whether frames, on this thread and on several, leave the rows and bytes of limbs written, solved and read apart.
bool gives_same_bits(const Problem& problem)
{
    Bytes by_limbs = problem.characters, here = problem.characters, on_threads = problem.characters;
    Crowd limbs = problem.crowd(), one = problem.crowd(), several = problem.crowd();
    solve_by_limbs(problem, limbs, by_limbs);
    const std::uint32_t count = solve_by_frames(problem, one, here, true);
    const bool same_count = solve_by_frames(problem, several, on_threads, false) == count;
    const std::vector<std::uint32_t> words = limb_words(problem, limbs);
    const bool same_rows = limb_words(problem, one) == words && limb_words(problem, several) == words;
    return same_count && same_rows && here == by_limbs && on_threads == by_limbs;
}

}  // namespace

TEST_CASE("frames of groups whose limbs share characters give the bits of limbs written, solved and read apart")
{
    rc::prop("random groups, blocks, masks, doubles, threads", [](std::uint64_t seed) {
        Random random{seed};
        const bool same = gives_same_bits(random_problem(random));
        RC_ASSERT(same);
    });
}

TEST_CASE("many rounds of chosen limbs give the same bits on several threads")
{
    Random random{18};
    for (int n = 0; n < 4; ++n) CHECK(gives_same_bits(problem_of_many_rounds(random)));
}

TEST_CASE("frames of a list of limbs give the bits of the same limbs in a mask")
{
    rc::prop("random groups and limbs", [](std::uint64_t seed) {
        Random random{seed};
        Problem problem = random_problem(random);
        Crowd masked = problem.crowd(), listed = problem.crowd();
        const std::uint32_t block_count = swivel_block_count(masked.get());
        problem.blocks = {0, block_count};
        problem.mask.assign((block_count + 1) / 2, 0);
        std::vector<std::uint32_t> list;
        for (std::uint32_t n = random.below(300); n > 0; --n) {
            const std::uint32_t g = random.below(static_cast<std::uint32_t>(problem.groups.size()));
            list.push_back(swivel_group_first_limb(masked.get(), g) + random.below(problem.groups[g].limb_count));
            problem.mask[list.back() / 32] |= 1u << list.back() % 32;
        }
        Bytes by_mask = problem.characters, by_list = problem.characters;
        solve_by_limbs(problem, masked, by_mask);
        const std::vector<Frame> own = frames_in(problem, by_list);
        listed.solve({.limbs = list, .frames = std::vector<swivel_frame>(own.begin(), own.end())});
        const bool same = by_list == by_mask && limb_words(problem, listed) == limb_words(problem, masked);
        RC_ASSERT(same);
    });
}
