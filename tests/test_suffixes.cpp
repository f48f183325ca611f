// SPDX-License-Identifier: MIT
// Suffixes of file names may be in any case, as cameras and Windows write them.
#include <catch2/catch.hpp>

#include "tests/run_command.h"
#include "tests/test_data.h"
#include "tools/formats/text.h"

using namespace swivel::test;
namespace formats = swivel::formats;

TEST_CASE("A suffix is what a name ends in, in lower case")
{
    CHECK(formats::lower_suffix("Walk.GLB") == ".glb");
    CHECK(formats::lower_suffix("a.b/Walk.Cycle.bVh") == ".bvh");
    CHECK(formats::lower_suffix("a.b/walk").empty());
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
    CHECK(glb.err.find("it starts neither with 'glTF' nor with '{'") != std::string::npos);
}

TEST_CASE("FBX and DAE are refused by their suffix, with what to do")
{
    const TempFolder folder;
    for (const std::string name : {"figure.FBX", "figure.dae"}) {
        spill(folder / name, "no FBX");
        const Outcome rig = spawn_command(folder.path, {"rig", name});
        CHECK(rig.exit_code == 1);
        CHECK(rig.err ==
              "swivel: " + name + ": swivel reads no FBX and DAE; export the file as glTF, for example from Blender\n");
    }
}
