// SPDX-License-Identifier: MIT
//
// `swivel rig --toml` prints a crowd file of the limbs as they were found: solved with it, poses have the bits that
// they have without it.
#include <catch2/catch.hpp>

#include <random>

#include "tests/plain_motion.h"
#include "tests/random_figure.h"
#include "tests/run_command.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;

namespace {

using Words = std::vector<std::string>;

// Solves `file` with the limbs of its rig's crowd file and, by options, without it; how many limbs that file has.
std::size_t require_same_poses(const fs::path& folder, const std::string& file, const std::string& kinds)
{
    const Outcome rig = run_command(folder, {"rig", file, "--toml", "--limbs", kinds});
    if (rig.exit_code != 0) return 0;
    spill(folder / "rig.toml", rig.out);
    std::size_t count = 0;
    for (std::size_t at = 0; (at = rig.out.find("[limb.", at)) != std::string::npos; ++at) ++count;
    const Outcome with = run_command(folder, {"solve", file, "--crowd", "rig.toml", "--out", "with.csv"});
    INFO(rig.out << with.err);
    REQUIRE(with.exit_code == 0);
    const Outcome without = run_command(folder, {"solve", file, "--limbs", kinds, "--out", "without.csv"});
    if (without.exit_code != 0) return 0;  // it wants all of a kind to bind
    CHECK((slurp(folder / "with.csv") == slurp(folder / "without.csv")));
    return count;
}

}  // namespace

TEST_CASE("rig --toml: real motion, arms and legs")
{
    const TempFolder folder;
    const PlainMotion jump = plain_motion_of(must_find_jump());
    spill(folder / "jump.bvh", cut(jump, 100, 50));
    CHECK(require_same_poses(folder.path, "jump.bvh", "all") == 4);
    CHECK(require_same_poses(folder.path, "jump.bvh", "legs") == 2);
}

TEST_CASE("rig --toml: figures of every habit, with any joint axes, scales and mirrors")
{
    const TempFolder folder;
    std::mt19937 random(3);
    std::size_t limbs = 0;
    for (const FigureNames& names : figure_names()) {
        const Figure figure = random_figure(random, {.twist_bones = 0.3, .scales = 0.3, .mirrors = 0.2}, names);
        figure.rig.write(folder / "f.glb");
        INFO(names.habit);
        limbs += require_same_poses(folder.path, "f.glb", "all");
    }
    CHECK(limbs > 2 * figure_names().size());
}

TEST_CASE("rig --toml: limbs that do not bind are comments, and nothing else is printed beside")
{
    const TempFolder folder;
    spill(folder / "clip.bvh", kTwoArms);
    const Outcome rig = run_command(folder.path, {"rig", "clip.bvh", "--toml"});
    CHECK(rig.exit_code == 0);
    CHECK_THAT(rig.out, Contains("[limb.left_arm]\njoints = [\"LeftArm\", \"LeftForeArm\", \"LeftHand\"]\nbend = ") &&
                            Contains("\n# left leg missing: no joints have names in use"));
    CHECK(require_same_poses(folder.path, "clip.bvh", "arms") == 2);
    // Names that are no UTF-8, in a file name that is none, too.
    const std::string odd = edited(kTwoArms, "LeftForeArm", "Left\xe9\"ForeArm");
    spill(folder / "caf\xe9.bvh", odd);
    const std::string arm = "LeftArm,Left\xe9\"ForeArm,LeftHand";
    spill(folder / "odd.toml", run_command(folder.path, {"rig", "caf\xe9.bvh", "--toml", "--arm", arm}).out);
    const Outcome solved = run_command(folder.path, {"solve", "caf\xe9.bvh", "--crowd", "odd.toml"});
    INFO(solved.err);
    CHECK(solved.exit_code == 0);
    for (const char* other : {"--json", "--joints"})
        CHECK(run_command(folder.path, {"rig", "clip.bvh", "--toml", other}).exit_code == 2);
}
