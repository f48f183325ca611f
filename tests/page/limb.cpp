// SPDX-License-Identifier: MIT
//
// Solves one limb with the native library: reads its features, its binding behind the size and its goal_input as bytes,
// and prints the bits of its rotations and of its elbow and wrist. The page's must be the same.
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <vector>

#include "tools/crowd/limb_setup.h"

namespace {

template <class Value>
Value read()
{
    Value value;
    if (std::fread(&value, sizeof value, 1, stdin) != 1) std::exit(2);
    return value;
}

template <class Word, class Value, std::size_t count>
void print(const Value (&values)[count])
{
    for (const Value& value : values) {
        Word word;
        std::memcpy(&word, &value, sizeof word);
        std::printf("%0*" PRIx64 " ", static_cast<int>(2 * sizeof word), std::uint64_t{word});
    }
}

}  // namespace

int main()
{
    const auto features = read<std::uint64_t>();
    auto binding = swivel_default_binding();
    const std::span<char> numbers = swivel::tools::bytes_behind_size(binding);
    if (std::fread(numbers.data(), numbers.size(), 1, stdin) != 1) std::exit(2);
    const auto input = read<goal_input>();
    swivel::Crowd crowd({swivel::group(1, binding, features)});
    swivel::check(swivel_goals_write(crowd.get(), 0, 1, &input));
    crowd.solve();
    float shoulder[1][4], elbow[1][4];
    double elbow_place[3], wrist_place[3];
    crowd.read(SWIVEL_SHOULDER, 0, shoulder);
    crowd.read(SWIVEL_ELBOW, 0, elbow);
    swivel::check(swivel_forward(crowd.get(), 0, 0, 1, {elbow_place, 24}, {wrist_place, 24}, {nullptr, 0}));
    print<std::uint32_t>(shoulder[0]);
    print<std::uint32_t>(elbow[0]);
    print<std::uint64_t>(elbow_place);
    print<std::uint64_t>(wrist_place);
}
