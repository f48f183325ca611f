// SPDX-License-Identifier: MIT
//
// The promise: a glTF file of a crowd shows each character where the solver has it, in its size, with one mesh and one
// animation for all, and shows the first frame without it. three.js plays it, and Khronos' validator reads it.
#include <catch2/catch.hpp>

#include "tests/plain_gltf.h"
#include "tests/run_command.h"
#include "tests/solve_tables.h"
#include "tests/test_data.h"

using namespace swivel::test;
using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace {

struct Crowd200 {
    TempFolder folder;
    fs::path source;

    Outcome solve(const std::string& toml, const std::string& out, const Words& more = {}) const
    {
        spill(folder / "c.toml", toml);
        Words words{"solve", source.string(), "--crowd", "c.toml", "--fps", "30", "--out", out};
        words.insert(words.end(), more.begin(), more.end());
        return done(run_command(folder.path, words));
    }
};

// Height of the nodes at rest.
double height_of(const PlainGltf& gltf)
{
    double low = 1e9, high = -1e9;
    for (int n = 0; n < static_cast<int>(gltf.nodes().size()); ++n) {
        const double y = plain_world(gltf, -1, n, 0).translation().y();
        low = std::min(low, y), high = std::max(high, y);
    }
    return high - low;
}

}  // namespace

TEST_CASE("a glTF file of a crowd has each character where it is solved, and all of its other joints as the clip")
{
    Crowd200 crowd;
    crowd.source = find_or_warn("m2m_human_ymca.glb");
    if (crowd.source.empty()) return;
    const std::string toml =
        "[crowd]\ncharacters = 4\nsize = [0.6, 1.5]\nlimbs = \"all\"\n[limb.left_arm.target]\npoint = [0.3, 1.2, "
        "0.4]\n";
    crowd.solve(toml, "out.glb", {"--export-targets", "targets.csv"});
    crowd.solve(toml, "out.csv");
    CHECK(gltf_errors(crowd.folder / "out.glb").empty());
    for (const std::string& said : new_gltf_messages(crowd.source, crowd.folder / "out.glb"))
        CHECK_THAT(said, Catch::Matchers::StartsWith("NODE_SKINNED_MESH_NON_ROOT"));  // as the source's own node
    const PlainGltf source = plain_gltf_of(crowd.source), written = plain_gltf_of(crowd.folder / "out.glb");
    const std::size_t nodes = source.nodes().size();
    REQUIRE(written.nodes().size() == 4 * (nodes + 1));
    REQUIRE(written.json.at("animations").size() == 1);
    REQUIRE(written.json.value("meshes", nlohmann::json()) == source.json.value("meshes", nlohmann::json()));
    REQUIRE(written.json.at("skins").size() == 4 * source.json.at("skins").size());
    const std::vector<PoseLine> rows = pose_lines(slurp(crowd.folder / "out.csv"));
    const TargetTable targets(slurp(crowd.folder / "targets.csv"));
    REQUIRE(targets.rows.size() == rows.size());
    const std::size_t frames = rows.size() / 16;
    const double height = height_of(source);
    const auto times_of = [](const PlainGltf& gltf) {
        return plain_numbers(gltf, gltf.json.at("animations").at(0).at("samplers").at(0).at("input").get<int>());
    };
    const std::vector<double> times = times_of(written), keys = times_of(source);
    REQUIRE(times.size() == frames);
    CHECK(times.front() == 0);
    CHECK(times.back() == Approx(keys.back() - keys.front()));
    const auto poses = three_poses(crowd.folder / "out.glb", 0, times);
    for (std::size_t n = 0; n < written.nodes().size(); ++n)
        CHECK((plain_world(written, -1, static_cast<int>(n), 0).matrix() - poses[0][n]).norm() <= 1e-5);
    const char* const ends[] = {"DEF-hand.L", "DEF-hand.R", "DEF-foot.L", "DEF-foot.R"};
    for (std::size_t c = 0; c < 4; ++c) {
        const PoseLine& row = rows[4 * c];
        const Vector3d place(row.number("place_x"), row.number("place_y"), row.number("place_z"));
        const double size = row.number("size");
        const auto start = static_cast<std::size_t>(row.number("start"));
        for (std::size_t frame = 0; frame < frames; ++frame) {
            const auto at = [&](int node) {
                return Vector3d(poses[frame][c * nodes + static_cast<std::size_t>(node)].block<3, 1>(0, 3));
            };
            for (std::size_t n = 0; n < 4; ++n) {
                const Vector3d target = point(targets.rows[16 * frame + 4 * c + n], "");
                if (rows[16 * frame + 4 * c + n].flags & 1)
                    CHECK((at(source.node_named(ends[n])) - target).norm() <= 1e-5 * size * height);
            }
            const double time = keys.front() + times[(frame + start) % frames];
            for (const char* const name : {"DEF-hips", "DEF-spine.003", "DEF-head", "DEF-upper_arm.L", "DEF-thigh.R"}) {
                const int node = source.node_named(name);
                const Vector3d clip = plain_world(source, 0, node, time).translation();
                CHECK((at(node) - (place + size * clip)).norm() <= 1e-5 * size * height);
            }
        }
    }
    // One character with fewer frames.
    crowd.solve("[crowd]\n", "few.glb", {"--frames", "9"});
    CHECK(plain_gltf_of(crowd.folder / "few.glb").json.at("animations").size() == 1);
    CHECK(gltf_errors(crowd.folder / "few.glb").empty());
}

TEST_CASE("a glTF file of a crowd is read again: its first character is solved as it walks")
{
    Crowd200 crowd;
    crowd.source = find_or_warn("m2m_human_ymca.glb");
    if (crowd.source.empty()) return;
    crowd.solve("[crowd]\ncharacters = 3\nlimbs = \"all\"\nstagger = false\n", "crowd.glb");
    crowd.solve("[crowd]\nlimbs = \"all\"\n", "once.csv");
    crowd.source = crowd.folder / "crowd.glb";
    crowd.solve("[crowd]\nlimbs = \"all\"\n", "again.csv");
    CHECK_THAT(crowd.solve("[crowd]\n", "out.csv").out,
               Contains("note     the file has 3 figures alike; the first of"));
    const std::vector<PoseLine> once = pose_lines(slurp(crowd.folder / "once.csv")),
                                again = pose_lines(slurp(crowd.folder / "again.csv"));
    REQUIRE(once.size() == again.size());
    for (std::size_t n = 0; n < once.size(); ++n)
        for (std::size_t j = 0; j < 3; ++j) CHECK(once[n].joint[j].angularDistance(again[n].joint[j]) < 1e-4);
}
