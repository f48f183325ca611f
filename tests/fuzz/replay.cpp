// SPDX-License-Identifier: MIT
//
// The promise: what a fuzzer has found once stays fixed. Runs each fuzzer's function over the files of its folder of
// seeds, or one over inputs of random bytes, in a build without libFuzzer. A crash, a sanitizer's complaint or an abort
// names the file, or the number of the input, in the line before.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/scratch_folder.h"

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

int replay(const Fuzzer& fuzzer, const std::filesystem::path& folder)
{
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / fuzzer.name)) {
        std::printf("%s\n", entry.path().c_str());
        std::fflush(stdout);
        const std::string bytes = swivel::fuzz::slurp(entry.path());
        fuzzer.run(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
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
