// SPDX-License-Identifier: MIT
//
// Draws the pictures of the pages that show what swivel does. With --check it compares them with the files that are
// there, and writes none.
#include <exception>
#include <fstream>
#include <iterator>

#include "tools/site/picture.h"

namespace {

// Writes a picture, or compares it.
bool take(const std::string& folder, const NamedPicture& picture, bool is_check)
{
    const std::string path = folder + "/" + picture.name;
    if (!is_check) return static_cast<bool>(std::ofstream(path) << picture.text);
    std::ifstream file(path);
    if (std::string(std::istreambuf_iterator<char>(file), {}) == picture.text) return true;
    std::fprintf(stderr, "%s is not what swivel does; run docs_pictures docs/pictures\n", path.c_str());
    return false;
}

}  // namespace

int main(int argc, char** argv)
{
    const bool is_check = argc == 3 && std::string(argv[1]) == "--check";
    if (argc != 2 && !is_check) {
        std::fputs("usage: docs_pictures [--check] FOLDER\n", stderr);
        return 2;
    }
    try {
        bool is_good = true;
        for (const auto& pictures : {feet_pictures(), look_pictures(), region_pictures()})
            for (const NamedPicture& picture : pictures) is_good = take(argv[argc - 1], picture, is_check) && is_good;
        return is_good ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
