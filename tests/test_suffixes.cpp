// SPDX-License-Identifier: MIT
// Suffixes of file names may be in any case, as cameras and Windows write them. What is written has its suffix's
// format.
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
}
