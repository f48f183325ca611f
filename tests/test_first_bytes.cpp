// SPDX-License-Identifier: MIT
//
// The first bytes of a file say whether it is BVH or glTF, in every command that reads one. Its name says nothing.
#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>
#include <random>

#include "tests/plain_motion.h"
#include "tests/random_figure.h"
#include "tests/run_command.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using nlohmann::json;

namespace {

const std::string kMark = "\xEF\xBB\xBF";

// A figure as a GLB, and the same as text that holds its bytes.
struct TwoShapes {
    Figure figure;
    std::string glb, text;
};

TwoShapes two_shapes()
{
    const TempFolder folder;
    std::mt19937 random(3);
    TwoShapes shapes{random_figure(random, {}, figure_names()[0]), {}, {}};
    shapes.figure.rig.write(folder / "rig.glb");
    REQUIRE(run_command(folder.path, {"solve", "rig.glb", "--out", "rig.gltf"}).exit_code == 0);
    shapes.glb = slurp(folder / "rig.glb");
    shapes.text = slurp(folder / "rig.gltf");
    REQUIRE(shapes.glb.starts_with("glTF"));
    REQUIRE(shapes.text.starts_with("{"));
    return shapes;
}

json report_of(const TempFolder& folder, const std::string& name, const std::string& input = {})
{
    const Outcome outcome = run_command(folder.path, {"rig", name, "--json"}, input);
    INFO(name << ": " << outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return json::parse(outcome.out);
}

void require_figure(const json& report, const Figure& figure)
{
    CHECK_THAT(report.at("motion").get<std::string>(), StartsWith("glTF, animation 0"));
    for (std::size_t n = 0; n < 4; ++n) CHECK(report.at("limbs")[n].at("numbers") == json(figure.limbs[n]));
}

void require_two_arms(const json& report)
{
    CHECK(report.at("motion") == "BVH");
    CHECK(report.at("frames") == 2);
    CHECK(report.at("limbs")[0].at("lengths") == json({5, 3}));  // OFFSET of forearm and hand
}

void require_refused(const Outcome& outcome, const std::string& line)
{
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == line);
}

}  // namespace

TEST_CASE("first bytes: glTF of both shapes and BVH are read under any name, and as standard input")
{
    const TempFolder folder;
    const TwoShapes shapes = two_shapes();
    for (const std::string name : {"a.glb", "a.vrma", "a", "a.bvh", "a.fbx"}) {
        INFO(name);
        spill(folder / name, shapes.glb);
        require_figure(report_of(folder, name), shapes.figure);
        for (const std::string& before : {std::string(), kMark, std::string("\r\n \t"), kMark + " \n"}) {
            spill(folder / name, before + shapes.text);
            require_figure(report_of(folder, name), shapes.figure);
            spill(folder / name, before + kTwoArms);
            require_two_arms(report_of(folder, name));
        }
    }
    require_figure(report_of(folder, "-", shapes.glb), shapes.figure);
    require_figure(report_of(folder, "-", kMark + "\n" + shapes.text), shapes.figure);
    require_two_arms(report_of(folder, "-", kMark + "\n" + kTwoArms));
    spill(folder / "a.glb", edited(kTwoArms, "HIERARCHY", "hierarchy"));
    require_two_arms(report_of(folder, "a.glb"));
}

TEST_CASE("first bytes: blanks before a text count among the 4096 that are looked at")
{
    const TempFolder folder;
    spill(folder / "far", std::string(4000, '\n') + kTwoArms);
    require_two_arms(report_of(folder, "far"));
    spill(folder / "farther", std::string(4096, '\n') + kTwoArms);
    const Outcome outcome = run_command(folder.path, {"rig", "farther"});
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, StartsWith("swivel: farther: begins with '\\x0a\\x0a"));
}

TEST_CASE("first bytes: solve and store take a clip of any name, and a suffix of any case says what is written")
{
    const TempFolder folder;
    spill(folder / "walk.vrma", two_shapes().glb);
    spill(folder / "WALK.TXT", kTwoArms);
    const auto exit_code = [&](const Words& words) { return run_command(folder.path, words).exit_code; };
    for (const std::string name : {"walk.vrma", "WALK.TXT"}) {
        INFO(name);
        CHECK(exit_code({"solve", name, "--out", "New.Csv"}) == 0);
        CHECK(slurp(folder / "New.Csv").starts_with("frame,"));
        CHECK(exit_code({"store", name, name + ".cache", "--characters", "3"}) == 0);
        CHECK(fs::is_directory(folder / (name + ".cache")));
    }
    CHECK(exit_code({"solve", "WALK.TXT", "--out", "NEW.BVH"}) == 0);
    CHECK(slurp(folder / "NEW.BVH").starts_with("HIERARCHY"));
    CHECK(exit_code({"solve", "walk.vrma", "--out", "new.glb"}) == 0);
    CHECK(exit_code({"solve", "WALK.TXT", "--out", "new.glb"}) == 2);
}

TEST_CASE("first bytes: a file of another kind is refused in a line that shows what it begins with")
{
    const TempFolder folder;
    const std::string rest =
        "; swivel reads BVH, which begins with HIERARCHY, and glTF, which begins with glTF or {; export the file as "
        "glTF, for example from Blender\n";
    const std::vector<std::pair<std::string, std::string>> kinds = {
        {std::string("Kaydara FBX Binary  \0\x1a\0\xe8\x1c", 25), "Kaydara FBX Binary  ..."},
        {"<?xml version=\"1.0\"?>\n<COLLADA", "<?xml version=\"1.0\"?..."},
        {"# box\nv 0 0 0\n", "# box\\x0av 0 0 0\\x0a"},
        {" glTF", " glTF"},
        {" \n", " \\x0a"},
        {"[]", "[]"},
        {"HIERARCHYROOT", "HIERARCHYROOT"},
    };
    for (const auto& [bytes, shown] : kinds) {
        const std::string line = ": begins with '" + shown + "'" + rest;
        spill(folder / "clip.glb", bytes);
        for (const std::string command : {"rig", "solve", "view"})
            require_refused(run_command(folder.path, {command, "clip.glb"}), "swivel: clip.glb" + line);
        require_refused(run_command(folder.path, {"rig", "-"}, bytes), "swivel: standard input" + line);
    }
    spill(folder / "clip.glb", "");
    require_refused(run_command(folder.path, {"rig", "clip.glb"}),
                    "swivel: clip.glb: is empty; check how it was written\n");
    CHECK(folder.file_count() == 1);
}

TEST_CASE("first bytes: rows of a BVH beyond those announced are noted, and read are those announced")
{
    const TempFolder folder;
    const std::string row = kTwoArms.substr(kTwoArms.find("1 2 4"));
    spill(folder / "plain.bvh", kTwoArms);
    CHECK(!report_of(folder, "plain.bvh").contains("notes"));
    REQUIRE(run_command(folder.path, {"solve", "plain.bvh", "--out", "plain.csv"}).exit_code == 0);
    const std::string note = "the file has 4 rows of values, and Frames: in line 46 says 2; the last 2 are left out";
    spill(folder / "clip.bvh", kTwoArms + row + row);
    const json noted = report_of(folder, "clip.bvh");
    CHECK(noted.at("notes") == json({note}));
    CHECK(noted.at("frames") == 2);
    CHECK_THAT(run_command(folder.path, {"rig", "clip.bvh"}).out, Contains("\nnote: " + note + "\n"));
    const Outcome solve = run_command(folder.path, {"solve", "clip.bvh", "--out", "noted.csv"});
    REQUIRE(solve.exit_code == 0);
    CHECK_THAT(solve.out, Contains("\nnote     " + note + "\n"));
    CHECK(slurp(folder / "noted.csv") == slurp(folder / "plain.csv"));
    // A row that is left out stays in the text of a BVH that is written.
    REQUIRE(run_command(folder.path, {"solve", "clip.bvh", "--out", "same.bvh"}).exit_code == 0);
    CHECK(slurp(folder / "same.bvh").ends_with(row + row));
}
