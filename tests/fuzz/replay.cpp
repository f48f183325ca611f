// SPDX-License-Identifier: MIT
//
// The promise: what a fuzzer has found once stays fixed, and damaged input is read or refused as it promises. Runs each
// fuzzer's function over the files of its folder of seeds, and over each of them damaged at random, or one over inputs
// of random bytes, in a build without libFuzzer. A crash, a sanitizer's complaint or an abort names the file and the
// round, or the number of the input, in the line before.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#define FUZZER(name) extern "C" int fuzz_##name(const std::uint8_t* data, std::size_t size);
#include "fuzzers.inc"
#undef FUZZER

namespace {

struct Fuzzer {
    const char* name;
    int (*run)(const std::uint8_t* data, std::size_t size);
};
constexpr Fuzzer kFuzzers[] = {
#define FUZZER(name) {#name, fuzz_##name},
#include "fuzzers.inc"
#undef FUZZER
};

constexpr int kRounds = 40;  // of each seed, the first of them undamaged

// After one to four accidents: bytes changed, cut, doubled or inserted.
std::string mutated(std::string text, std::mt19937& random)
{
    static constexpr std::array<std::string_view, 12> kScraps = {
        "nan", "-", "1e999", "{", "}", "\n", ",", "99999999999999999999", "\r", "-1", "#", "JOINT"};
    const auto below = [&](std::size_t limit) { return limit == 0 ? 0 : random() % limit; };
    for (std::size_t accidents = 1 + below(4); accidents > 0; --accidents) {
        const std::size_t at = below(text.size());
        const std::size_t length = 1 + below(20);
        switch (below(5)) {
            case 0:
                if (!text.empty()) text[at] = static_cast<char>(random() & 0xff);
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(at, length));
                break;
            case 3:
                text.insert(at, kScraps[below(kScraps.size())]);
                break;
            default:
                if (below(10) == 0) text.resize(at);
                break;
        }
    }
    return text;
}

int replay(const Fuzzer& fuzzer, const std::filesystem::path& folder)
{
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / fuzzer.name)) {
        std::mt19937 random(7);
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string seed{std::istreambuf_iterator<char>(in), {}};
        for (int round = 0; round < kRounds; ++round) {
            std::printf("%s, round %d\n", entry.path().c_str(), round);
            std::fflush(stdout);
            const std::string bytes = round == 0 ? seed : mutated(seed, random);
            fuzzer.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
        }
        ++count;
    }
    return count;
}

int run_random(const std::string& name, int count)
{
    std::mt19937_64 random(7);
    for (const Fuzzer& fuzzer : kFuzzers) {
        if (fuzzer.name != name) continue;
        for (int n = 0; n < count; ++n) {
            std::printf("%d\n", n);
            std::fflush(stdout);
            // Zeros are mostly what is right and usual. Without them, hardly a call succeeds.
            const std::uint64_t zeros = random() % 4;
            std::vector<std::uint8_t> bytes(random() % 3000);
            for (std::uint8_t& byte : bytes) byte = random() % 5 < zeros ? 0 : static_cast<std::uint8_t>(random());
            fuzzer.run(bytes.data(), bytes.size());
        }
        return 0;
    }
    return 2;
}

}  // namespace

int main(int argument_count, char** arguments)
{
    if (argument_count == 3) return run_random(arguments[1], std::atoi(arguments[2]));
    if (argument_count != 2) {
        std::fprintf(stderr,
                     "usage: fuzz_replay FOLDER, one with a folder for each fuzzer; or fuzz_replay NAME COUNT\n");
        return 2;
    }
    for (const Fuzzer& fuzzer : kFuzzers)
        if (replay(fuzzer, arguments[1]) == 0) {
            std::fprintf(stderr, "no seeds for %s in %s\n", fuzzer.name, arguments[1]);
            return 1;
        }
}
