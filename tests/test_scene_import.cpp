// SPDX-License-Identifier: MIT
// FBX and DAE files, read by assimp into glTF. Every node is where assimp's own scene has it, at every key. There are
// small files with poses known by hand, the command from end to end, Khronos' validator, and files cut short.
#include <assimp/scene.h>
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <set>

#include "tests/gltf_closure.h"
#include "tests/gltf_judges.h"
#include "tests/plain_gltf.h"
#include "tests/run_command.h"
#include "tests/scene_judge.h"
#include "tests/scene_samples.h"
#include "tests/test_data.h"
#include "tools/formats/error.h"
#include "tools/formats/gltf.h"
#include "tools/formats/scene_import.h"

using namespace swivel::test;
using swivel::formats::GltfFile;
using swivel::formats::import_scene;
using swivel::formats::InputError;
using swivel::formats::JointPose;

namespace {

GltfFile imported(const fs::path& path, const std::string& animation = "")
{
    return swivel::formats::read_gltf(path, import_scene(path), {animation, 0});
}

// A model of assimp's own collection; every machine must have it.
fs::path model(const std::string& name)
{
    const fs::path path = fs::path("/usr/share/assimp/models") / name;
    INFO("install assimp-testmodels");
    REQUIRE(fs::is_regular_file(path));
    return path;
}

std::vector<fs::path> all_models()
{
    std::vector<fs::path> files;
    for (const char* folder : {"/usr/share/assimp/models/FBX", "/usr/share/assimp/models/Collada"})
        if (fs::is_directory(folder))
            for (const auto& entry : fs::recursive_directory_iterator(folder))
                if (swivel::formats::is_scene(entry.path())) files.push_back(entry.path());
    return files;
}

// The larger error; one that is no number is the worst of all.
double worse(double worst, double error) { return std::isnan(worst) || error <= worst ? worst : error; }

// How far joints and nodes are off from assimp's scene, as a share of its size, in the worst of an animation's frames.
// metres: the file's own unit. For FBX files, assimp's scene does not have it.
double worst_against_judge(const fs::path& path, int animation, double metres)
{
    const TempFolder folder;
    const auto choice = animation < 0 ? std::string() : std::to_string(animation);
    const GltfFile file = imported(path, choice);
    REQUIRE(file.animation == animation);
    spill(folder / "whole.glb", glb_of(file.container));
    const PlainGltf plain = plain_gltf_of(folder / "whole.glb");
    const JudgedScene judge(path);
    const aiAnimation* moved = animation < 0 ? nullptr : judge.scene->mAnimations[animation];
    double worst = 0;
    for (std::size_t frame = 0; frame < file.clip.frame_count; ++frame) {
        const auto time = static_cast<double>(file.times[frame]);
        std::vector<Eigen::Affine3d> expected;
        judge_worlds(*judge.scene->mRootNode, Eigen::Affine3d(Eigen::Scaling(metres)), moved, time, expected);
        double size = 0;
        for (const Eigen::Affine3d& world : expected) size = std::max(size, world.translation().norm());
        const std::vector<JointPose> pose = world_pose(file.clip, frame);
        for (std::size_t n = 0; n < pose.size(); ++n) {
            const swivel::formats::Joint& joint = file.clip.joints[n];
            const auto node = static_cast<std::size_t>(joint.number);
            if (node >= expected.size()) continue;  // made for a mesh
            const Eigen::Affine3d& wanted = expected[node];
            const auto keep = [&](double error) { worst = worse(worst, error); };
            if (joint.parent < 0 || pose[static_cast<std::size_t>(joint.parent)].is_uniform)
                keep((pose[n].position - wanted.translation()).norm() / size);
            const Eigen::Affine3d whole = plain_world(plain, animation, joint.number, time);
            keep((whole.translation() - wanted.translation()).norm() / size);
            keep((whole.linear() - wanted.linear()).norm() / wanted.linear().norm());
        }
    }
    return worst;
}

std::string error_of(const fs::path& path)
{
    try {
        import_scene(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

int joint_named(const GltfFile& file, const std::string& name)
{
    const std::vector<int> found = find_joints(file.clip, name);
    INFO(name);
    REQUIRE(found.size() == 1);
    return found[0];
}

void require_valid(const fs::path& path)
{
    INFO(path);
    const auto errors = gltf_errors(path);
    for (const std::string& error : errors) UNSCOPED_INFO(error);
    CHECK(errors.empty());
}

}  // namespace

TEST_CASE("The judge lets no error pass that is no number")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(worse(1, 2) == 2);
    CHECK(worse(2, 1) == 2);
    CHECK(std::isnan(worse(worse(1, nan), 2)));
}

TEST_CASE("Nodes stand where assimp's own scene has them, at every key")
{
    const auto [name, animation, metres] = GENERATE(table<std::string, int, double>({
        {"FBX/animation_with_skeleton.fbx", 0, 0.01},
        {"FBX/huesitos.fbx", 0, 0.01},
        {"FBX/spider.fbx", -1, 0.01},
        {"FBX/cubes_with_mirroring_and_pivot.fbx", -1, 1},
        {"FBX/global_settings.fbx", -1, 5},
        {"Collada/box_nested_animation.dae", 0, 1},
        {"Collada/anims_with_full_rotations_between_keys.DAE", 0, 1},
        {"Collada/cameras.dae", -1, 1},
        {"Collada/COLLADA.dae", -1, 1},
    }));
    const double worst = worst_against_judge(model(name), animation, metres);
    INFO(name << ": " << worst);
    CHECK(worst <= 1e-6);
}

TEST_CASE("A DAE figure is read by its names, in metres")
{
    const TempFolder folder;
    spill(folder / "figure.dae", sample_dae(6));
    CHECK(worst_against_judge(folder / "figure.dae", 0, 1) <= 1e-6);
    const GltfFile file = imported(folder / "figure.dae");
    CHECK(file.clip.frame_count == 6);
    CHECK(file.clip.frame_time == Approx(0.04));
    const JointPose hips = rest_pose(file.clip)[static_cast<std::size_t>(joint_named(file, "mixamorig:Hips"))];
    CHECK((hips.position - Eigen::Vector3d(0, 1, 0)).norm() <= 1e-6);
}

TEST_CASE("DAE names that repeat give way to ids")
{
    const TempFolder folder;
    spill(folder / "twins.dae", edited(sample_dae(3), "name=\"mixamorig:RightHand\"", "name=\"mixamorig:LeftHand\""));
    const GltfFile file = imported(folder / "twins.dae");
    joint_named(file, "rig-5");
    CHECK(worst_against_judge(folder / "twins.dae", 0, 1) <= 1e-6);
}

TEST_CASE("A DAE file's names stay where its fault is another than names that repeat")
{
    const TempFolder folder;
    const std::string arm = "<float_array id=\"a3-m-a\" count=\"48\">";
    spill(folder / "bad.dae", edited(sample_dae(3), arm, arm + "nan "));
    CHECK(error_of(folder / "bad.dae").find("for 'mixamorig:LeftArm' is not finite") != std::string::npos);
}

TEST_CASE("An FBX skeleton without a mesh: joint orientations, takes, axes and unit")
{
    const auto [up, unit] = GENERATE(table<int, double>({{1, 1}, {2, 1}, {2, 2.54}}));
    const TempFolder folder;
    const fs::path path = folder / "figure.fbx";
    spill(path, sample_fbx(up, unit, 5));
    const auto [take, first] = GENERATE(table<std::string, std::size_t>({{"Reach", 0}, {"Wave", 3}}));
    const GltfFile file = imported(path, take);
    CHECK(file.animation_names == std::vector<std::string>{"Reach", "Wave"});
    REQUIRE(file.clip.frame_count == 5);
    CHECK(file.clip.frame_time == Approx(0.04));
    const std::vector<SampleJoint> joints = sample_figure();
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    if (up == 2) axes << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    for (std::size_t frame = 0; frame < 5; ++frame) {
        std::vector<Eigen::Affine3d> world;
        const std::vector<JointPose> pose = world_pose(file.clip, frame);
        for (std::size_t n = 0; n < joints.size(); ++n) {
            const Eigen::Affine3d above = joints[n].parent < 0 ? Eigen::Affine3d(Eigen::Scaling(unit / 100) * axes)
                                                               : world[static_cast<std::size_t>(joints[n].parent)];
            world.push_back(above * Eigen::Translation3d(joints[n].offset) * turn_of(sample_orient(n)) *
                            turn_of(sample_angles(n, first + frame)));
            const JointPose& at = pose[static_cast<std::size_t>(joint_named(file, "mixamorig:" + joints[n].name))];
            CHECK((at.position - world[n].translation()).norm() <= 2e-6);
            CHECK((at.rotation.toRotationMatrix() - world[n].linear() * (100 / unit)).norm() <= 1e-5);
        }
    }
}

TEST_CASE("An FBX file of a left hand's axes comes out mirrored, one without three axes not at all")
{
    const TempFolder folder;
    const std::string sign = "\"CoordAxisSign\", \"int\", \"Integer\", \"\",";
    spill(folder / "left.fbx", edited(sample_fbx(2, 100, 3), sign + "1", sign + "-1"));
    spill(folder / "right.fbx", sample_fbx(2, 100, 3));
    const GltfFile left = imported(folder / "left.fbx"), right = imported(folder / "right.fbx");
    for (std::size_t frame = 0; frame < 3; ++frame) {
        const std::vector<JointPose> mirrored = world_pose(left.clip, frame), pose = world_pose(right.clip, frame);
        for (std::size_t n = 0; n < pose.size(); ++n) {
            const Eigen::Vector3d& at = pose[n].position;
            CHECK((mirrored[n].position - Eigen::Vector3d(-at.x(), at.y(), at.z())).norm() <= 1e-5 * at.norm());
        }
    }
    const std::string up = "\"UpAxis\", \"int\", \"Integer\", \"\",";
    spill(folder / "flat.fbx", edited(sample_fbx(2, 100, 3), up + "2", up + "1"));
    CHECK(error_of(folder / "flat.fbx").find("its UpAxis, FrontAxis and CoordAxis are not three") != std::string::npos);
}

// The figure with a triangle that hangs on the left hand, with a property more, and moves or not.
std::string fbx_with_prop(const std::string& property, bool moves)
{
    FbxText fbx;
    fbx.next = 90000;
    const int prop = fbx.next++, shape = fbx.next++;
    fbx.objects = fmt::format("Model: {}, \"Model::Prop\", \"Mesh\" {{\nVersion: 232\nProperties70: {{\n", prop) +
                  property + "P: \"RotationActive\", \"bool\", \"\", \"\",1\n" +
                  fbx_vector("Lcl Translation", "Lcl Translation", {5, 6, 7}) + "}\n}\n" +
                  fmt::format(
                      "Geometry: {}, \"Geometry::Shape\", \"Mesh\" {{\nVertices: *9 {{\na: 0,0,0,1,0,0,0,1,0\n}}\n"
                      "PolygonVertexIndex: *3 {{\na: 0,1,-3\n}}\nGeometryVersion: 124\n}}\n",
                      shape);
    fbx.connections = fmt::format("C: \"OO\",{},1005\nC: \"OO\",{},{}\n", prop, shape, prop);
    if (moves) add_fbx_take(fbx, "Prop", {prop}, 0, 3);
    std::string text = sample_fbx(1, 100, 3);
    text = edited(text, "\nObjects: {\n", "\nObjects: {\n" + fbx.objects);
    return edited(text, "\nConnections: {\n", "\nConnections: {\n" + fbx.connections);
}

TEST_CASE("An FBX mesh that assimp puts in a wrong place is refused like a joint, others stand where FBX has them")
{
    const auto property = [](const char* name) {
        return fmt::format("P: \"{}\", \"Vector3D\", \"Vector\", \"\",30,40,50\n", name);
    };
    const auto [name, moves, is_refused] = GENERATE(table<const char*, bool, bool>({
        {"PostRotation", false, true},
        {"PostRotation", true, true},
        {"GeometricTranslation", true, true},
        {"GeometricRotation", true, true},
        {"RotationPivot", true, true},
        {"ScalingOffset", true, true},
        {"GeometricTranslation", false, false},
        {"GeometricRotation", false, false},
        {"RotationPivot", false, false},
        {"ScalingOffset", false, false},
        {"PreRotation", true, false},
    }));
    INFO(name << (moves ? " moves" : " stays"));
    const TempFolder folder;
    spill(folder / "prop.fbx", fbx_with_prop(property(name), moves));
    const std::string error = error_of(folder / "prop.fbx");
    CHECK((error.find(fmt::format("node 'Prop' has a {}", name)) != std::string::npos) == is_refused);
    if (is_refused) return;
    REQUIRE(error.empty());
    const GltfFile file = imported(folder / "prop.fbx", moves ? "Prop" : "Reach");
    const Eigen::Vector3d numbers(30, 40, 50), zero(0, 0, 0);
    const auto is = [&](const char* wanted) { return std::string(name) == wanted; };
    const Eigen::Vector3d shift = is("GeometricTranslation") || is("ScalingOffset") ? numbers : zero;
    const Eigen::Quaterniond turn = turn_of(is("GeometricRotation") || is("PreRotation") ? numbers : zero);
    for (std::size_t frame = 0; frame < file.clip.frame_count; ++frame) {
        const JointPose at = local_pose(file.clip, frame, static_cast<std::size_t>(joint_named(file, "Prop")));
        CHECK((at.position - Eigen::Vector3d(5, 6, 7) - shift).norm() <= 1e-4);
        const Eigen::Vector3d angles = moves ? sample_angles(0, frame) : zero;
        CHECK(at.rotation.angularDistance(turn * turn_of(angles)) <= 1e-5);
    }
}

TEST_CASE("FBX joints that assimp misreads are refused, others stand where FBX has them")
{
    // What is added to the left arm, and the part that the refusal names.
    const auto [property, part] = GENERATE(table<std::string, std::string>({
        {"P: \"PostRotation\", \"Vector3D\", \"Vector\", \"\",30,40,50\n", "PostRotation"},
        {"P: \"RotationPivot\", \"Vector3D\", \"Vector\", \"\",3,4,5\n", "RotationPivot"},
        {"P: \"RotationOffset\", \"Vector3D\", \"Vector\", \"\",3,4,5\n", "RotationOffset"},
        {"P: \"ScalingPivot\", \"Vector3D\", \"Vector\", \"\",3,4,5\n", "ScalingPivot"},
        {"P: \"GeometricRotation\", \"Vector3D\", \"Vector\", \"\",3,4,5\n", "GeometricRotation"},
        {"P: \"RotationOrder\", \"enum\", \"\", \"\",3\n", ""},  // y, then x, then z
    }));
    const TempFolder folder;
    const std::string arm = "Model::mixamorig:LeftArm\", \"LimbNode\" {\nVersion: 232\nProperties70: {\n";
    spill(folder / "arm.fbx", edited(sample_fbx(1, 100, 3), arm, arm + property));
    const std::string error = error_of(folder / "arm.fbx");
    INFO(error);
    CHECK(error.find('\n') == std::string::npos);
    if (!part.empty()) {
        CHECK(error.find("node 'mixamorig:LeftArm' has a " + part) != std::string::npos);
        return;
    }
    REQUIRE(error.empty());
    const GltfFile file = imported(folder / "arm.fbx");
    const std::vector<SampleJoint> joints = sample_figure();
    const int at = joint_named(file, "mixamorig:LeftArm");
    for (std::size_t frame = 0; frame < 3; ++frame) {
        const Eigen::Vector3d angle = sample_angles(3, frame);
        const Eigen::Quaterniond turned =
            turn_of({0, 0, angle.z()}) * turn_of({angle.x(), 0, 0}) * turn_of({0, angle.y(), 0});
        const Eigen::Quaterniond wanted = turn_of(sample_orient(3)) * turned;
        CHECK(local_pose(file.clip, frame, static_cast<std::size_t>(at)).rotation.angularDistance(wanted) <= 1e-5);
    }
}

TEST_CASE("The command solves FBX and DAE clips, and gives them back as glTF")
{
    const TempFolder folder;
    spill(folder / "figure.DAE", sample_dae(12));
    spill(folder / "figure.Fbx", sample_fbx(2, 1, 12));
    const auto [name, out] = GENERATE(table<std::string, std::string>(
        {{"figure.DAE", "new.glb"}, {"figure.DAE", "new.GLTF"}, {"figure.Fbx", "new.glb"}}));
    const std::string format = name == "figure.DAE" ? "DAE" : "FBX";
    const Outcome rig = run_command(folder.path, {"rig", name, "--limbs", "arms"});
    INFO(rig.out << rig.err);
    REQUIRE(rig.exit_code == 0);
    CHECK(rig.out.find(name + ": " + format + ", animation 0") != std::string::npos);
    CHECK(rig.out.find("left arm   mixamorig:LeftArm > mixamorig:LeftForeArm") != std::string::npos);
    CHECK(rig.out.find("right arm  mixamorig:RightArm > mixamorig:RightForeArm") != std::string::npos);
    const Outcome solve = run_command(folder.path, {"solve", name, "--targets", "clip", "--out", out});
    INFO(solve.out << solve.err);
    REQUIRE(solve.exit_code == 0);
    spill(folder / "before.glb", glb_of(import_scene(folder / name)));
    const PlainGltf before = plain_gltf_of(folder / "before.glb"), after = plain_gltf_of(folder / out);
    std::vector<LimbNodes> limbs;
    for (const std::string side : {"mixamorig:Left", "mixamorig:Right"})
        limbs.push_back(
            {before.node_named(side + "Arm"), before.node_named(side + "ForeArm"), before.node_named(side + "Hand")});
    require_closed(closure(before, after, 0, limbs));
    require_valid(folder / out);
    CHECK((slurp(folder / out)[0] == '{') == (out == "new.GLTF"));
}

TEST_CASE("What assimp does not write well is not written")
{
    const TempFolder folder;
    spill(folder / "figure.fbx", sample_fbx(1, 1, 3));
    const auto [out, says] = GENERATE(table<std::string, std::string>(
        {{"new.fbx", "--out new.fbx: FBX and DAE are read, not written; use .glb, .gltf or .csv\n"},
         {"new.DAE", "--out new.DAE: FBX and DAE are read, not written; use .glb, .gltf or .csv\n"},
         {"new.bvh", "--out new.bvh: this clip is an FBX file; its poses go to .glb, .gltf or .csv\n"}}));
    const Outcome solve = run_command(folder.path, {"solve", "figure.fbx", "--out", out});
    CHECK(solve.exit_code == 2);
    CHECK(solve.err.ends_with(says));
    CHECK(folder.file_count() == 1);
}

TEST_CASE("Every model becomes valid glTF, or is refused in one line")
{
    const TempFolder folder;
    const std::set<std::string> refused = {"cube_UTF16LE.dae", "library_animation_clips.dae", "transparentTest.fbx"};
    std::vector<std::string> words = {"validate"};
    std::set<std::string> expected, found;
    for (const fs::path& path : all_models()) {
        INFO(path);
        const std::string error = error_of(path);
        CHECK(error.find('\n') == std::string::npos);
        if (refused.contains(path.filename().string())) expected.insert(path.filename().string());
        if (!error.empty()) found.insert(path.filename().string());
        if (!error.empty()) continue;
        words.push_back((folder / (std::to_string(words.size()) + path.filename().string() + ".glb")).string());
        spill(words.back(), glb_of(import_scene(path)));
    }
    CHECK(words.size() >= 30);
    CHECK(found == expected);
    for (const auto& report : ask_check(words)) {
        INFO(report.dump());
        CHECK(report.at("errors") == 0);
    }
}

TEST_CASE("Wrong files are refused in one line")
{
    const TempFolder folder;
    const fs::path fbx = folder / "a.fbx", dae = folder / "a.dae";
    CHECK(error_of(fbx).starts_with(fbx.string() + ": "));
    spill(fbx, "not an FBX file");
    CHECK(error_of(fbx).starts_with(fbx.string() + ": assimp cannot read it: "));
    spill(dae, "<COLLADA>\n<broken");
    CHECK(error_of(dae).starts_with(dae.string() + ": assimp cannot read it: "));
    CHECK(error_of(dae).find('\n') == std::string::npos);
    // assimp reads PLY, too.
    spill(fbx,
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    CHECK(error_of(fbx).find("assimp cannot read it") != std::string::npos);
}

TEST_CASE("Files cut short or damaged are read or refused")
{
    const TempFolder folder;
    spill(folder / "a.dae", sample_dae(3));
    spill(folder / "a.fbx", sample_fbx(1, 1, 3));
    std::mt19937 random(1);
    for (const fs::path& from : {folder / "a.dae", folder / "a.fbx", model("FBX/huesitos.fbx")}) {
        const std::string whole = slurp(from);
        const fs::path path = folder / ("cut" + from.extension().string());
        for (std::size_t n = 1; n <= 24; ++n) {
            spill(path, n % 2 ? whole.substr(0, whole.size() * n / 25) : mutated(whole, random));
            CHECK(error_of(path).find('\n') == std::string::npos);
        }
    }
}
