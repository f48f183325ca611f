// SPDX-License-Identifier: MIT
// Suffixes of file names may be in any case, as cameras and Windows write them. The tests also show what a build
// without assimp says of FBX and DAE. The source file of such a build is linked here.
#include <catch2/catch.hpp>

#include "tests/run_command.h"
#include "tests/test_data.h"
#include "tools/formats/error.h"
#include "tools/formats/scene_import.h"
#include "tools/formats/text.h"

using namespace swivel::test;
namespace formats = swivel::formats;

TEST_CASE("A suffix is what a name ends in, in lower case")
{
    CHECK(formats::lower_suffix("Walk.GLB") == ".glb");
    CHECK(formats::lower_suffix("a.b/Walk.Cycle.bVh") == ".bvh");
    CHECK(formats::lower_suffix("a.b/walk").empty());
    CHECK(formats::is_scene("X.FBX"));
    CHECK(formats::is_scene("x.dae"));
    CHECK_FALSE(formats::is_scene("x.dae.glb"));
    CHECK_FALSE(formats::is_scene("fbx"));
}

TEST_CASE("The command reads and writes suffixes of any case")
{
    const TempFolder folder;
    fs::copy_file(must_find_jump(), folder / "JUMP.BVH");
    for (const std::string out : {"NEW.BVH", "New.Csv"}) {
        const Outcome outcome = spawn_command(folder.path, {"solve", "JUMP.BVH", "--out", out});
        INFO(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        CHECK(slurp(folder / out).starts_with(out == "NEW.BVH" ? "HIERARCHY" : "frame,"));
    }
    spill(folder / "bad.GLTF", "[]");
    const Outcome glb = spawn_command(folder.path, {"rig", "bad.GLTF"});
    CHECK(glb.exit_code == 1);
    CHECK(glb.err.find("its JSON is no object") != std::string::npos);
}

TEST_CASE("A build without assimp says how to read FBX and DAE")
{
    CHECK(formats::scene_importer().empty());
    try {
        formats::import_scene("no/such.fbx");
        FAIL("nothing was thrown");
    } catch (const formats::InputError& error) {
        const std::string line = error.what();
        CHECK(line.starts_with("no/such.fbx: this build of swivel does not read FBX and DAE; "));
        CHECK(line.find("-DSWIVEL_ASSIMP=ON") != std::string::npos);
        CHECK(line.find('\n') == std::string::npos);
    }
}

TEST_CASE("The command says whether it reads FBX and DAE, and is right")
{
    const TempFolder folder;
    spill(folder / "no.FBX", "no FBX");
    const Outcome info = spawn_command(folder.path, {"info", "--json"}),
                  rig = spawn_command(folder.path, {"rig", "no.FBX"});
    const bool reads = info.out.find("\"fbx_dae\": \"read by assimp ") != std::string::npos;
    CHECK(reads != (info.out.find("\"fbx_dae\": \"not read by this build\"") != std::string::npos));
    CHECK(rig.exit_code == 1);
    CHECK(rig.err.find(reads ? "assimp cannot read it" : "-DSWIVEL_ASSIMP=ON") != std::string::npos);
}
