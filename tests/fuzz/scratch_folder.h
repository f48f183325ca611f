#pragma once
// SPDX-License-Identifier: MIT
// Files for readers, which take paths: a folder of the fuzzer's own, in $TMPDIR or the system's folder for such.

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "tests/fuzz/require.h"

namespace swivel::fuzz {

// Lives as long as the object.
struct ScratchFolder {
    std::filesystem::path path;

    ScratchFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "swivel-fuzz-XXXXXX").string();
        SWIVEL_REQUIRE(::mkdtemp(name.data()) != nullptr);
        path = name;
    }
    ~ScratchFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    // Writes a file of this name; its path.
    std::filesystem::path spill(const char* name, std::string_view text) const
    {
        std::ofstream out(path / name, std::ios::binary);
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
        SWIVEL_REQUIRE(out.flush().good());
        return path / name;
    }
};

inline std::string slurp(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace swivel::fuzz
