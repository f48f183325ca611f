// SPDX-License-Identifier: MIT
#include "tests/test_data.h"

#include <unistd.h>
#include <cstdlib>

namespace swivel::test {

namespace {

std::vector<fs::path> data_folders()
{
    std::vector<fs::path> folders;
    if (const char* own = std::getenv("SWIVEL_TEST_DATA"))
        folders = {own, fs::path(own) / "bvh", fs::path(own) / "gltf"};
    folders.insert(folders.end(), {"/usr/share/assimp/models/BVH", "/usr/share/assimp/models/glTF2"});
    const fs::path shared = fs::path(SWIVEL_SOURCE_DIR) / ".." / "shared" / "data";
    folders.insert(folders.end(), {shared, shared / "bvh", shared / "gltf"});
    return folders;
}

}  // namespace

fs::path find_data(const std::string& name)
{
    const std::string debian_name = name == "cmu_01_01_forward_jump.bvh" ? "01_01.bvh" : name;
    for (const fs::path& folder : data_folders()) {
        for (const std::string& candidate : {name, debian_name}) {
            if (fs::is_regular_file(folder / candidate)) return folder / candidate;
        }
    }
    return {};
}

fs::path must_find_jump()
{
    const fs::path path = find_data("cmu_01_01_forward_jump.bvh");
    INFO("install assimp-testmodels or set SWIVEL_TEST_DATA");
    REQUIRE_FALSE(path.empty());
    return path;
}

std::vector<fs::path> all_bvh_files()
{
    std::vector<fs::path> files;
    for (const fs::path& folder : data_folders()) {
        if (!fs::is_directory(folder)) continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
            if (entry.path().extension() == ".bvh") files.push_back(entry.path());
        }
    }
    return files;
}

std::map<std::string, std::string> contents(const fs::path& folder)
{
    std::map<std::string, std::string> all;
    std::error_code dangling;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        all[entry.path().lexically_relative(folder)] = entry.is_regular_file(dangling) ? slurp(entry.path()) : "";
    return all;
}

std::string slurp(const fs::path& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string edited(std::string text, std::string_view from, std::string_view to)
{
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

TempFolder::TempFolder()
{
    std::string name = (fs::temp_directory_path() / "swivel-test-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path = name;
}

}  // namespace swivel::test
