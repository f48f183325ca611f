// SPDX-License-Identifier: MIT
//
// The promise: what a fuzzer has found once stays fixed. Runs each fuzzer's function over the files of its folder of
// seeds, in a build without libFuzzer. A crash, a sanitizer's complaint or an abort names the file in the line before.
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

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

}  // namespace

int main(int argument_count, char** arguments)
{
    if (argument_count != 2) {
        std::fprintf(stderr, "usage: fuzz_replay FOLDER, one with a folder for each fuzzer\n");
        return 2;
    }
    for (const Fuzzer& fuzzer : kFuzzers)
        if (replay(fuzzer, arguments[1]) == 0) {
            std::fprintf(stderr, "no seeds for %s in %s\n", fuzzer.name, arguments[1]);
            return 1;
        }
}
