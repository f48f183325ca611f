#pragma once
// SPDX-License-Identifier: MIT
// Small DAE and FBX files as text, made of joints and keys: a figure with Mixamo's names, without a mesh.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

namespace swivel::test {

struct SampleJoint {
    std::string name;
    int parent;
    Eigen::Vector3d offset;
};

// Arms straight to both sides, centimetres, y up.
inline std::vector<SampleJoint> sample_figure()
{
    std::vector<SampleJoint> joints{{"Hips", -1, {0, 100, 0}}, {"Spine", 0, {0, 40, 0}}};
    for (const double side : {1.0, -1.0}) {
        const std::string name = side > 0 ? "Left" : "Right";
        const int first = static_cast<int>(joints.size());
        joints.push_back({name + "Shoulder", 1, {side * 5, 5, 0}});
        joints.push_back({name + "Arm", first, {side * 12, 0, 0}});
        joints.push_back({name + "ForeArm", first + 1, {side * 28, 0, 0}});
        joints.push_back({name + "Hand", first + 2, {side * 25, 0, 0}});
    }
    return joints;
}

// Degrees about x, y and z of a joint in a frame: elbows bend, everything else turns a little.
inline Eigen::Vector3d sample_angles(std::size_t joint, std::size_t frame)
{
    const auto n = static_cast<double>(joint), f = static_cast<double>(frame);
    const double bend = joint == 4 ? -40 - 8 * f : joint == 8 ? 40 + 8 * f : 10 * std::sin(n + 0.5 * f);
    return {12 * std::sin(2 * n + 0.3 * f), bend, 25 * std::sin(3 * n + 0.4 * f)};
}

// FBX's order XYZ: x first.
inline Eigen::Quaterniond turn_of(const Eigen::Vector3d& degrees)
{
    const Eigen::Vector3d angle = degrees * (EIGEN_PI / 180);
    return Eigen::AngleAxisd(angle.z(), Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(angle.y(), Eigen::Vector3d::UnitY()) *
           Eigen::AngleAxisd(angle.x(), Eigen::Vector3d::UnitX());
}

inline std::string dae_matrix(const Eigen::Vector3d& offset, const Eigen::Quaterniond& turn)
{
    const Eigen::Matrix3d m = turn.toRotationMatrix();
    std::string text;
    for (Eigen::Index row = 0; row < 3; ++row)
        text += fmt::format("{} {} {} {} ", m(row, 0), m(row, 1), m(row, 2), offset[row]);
    return text + "0 0 0 1";
}

inline std::string dae_joint(const std::vector<SampleJoint>& joints, std::size_t n)
{
    const SampleJoint& at = joints[n];
    std::string text = fmt::format(
        "<node id=\"rig-{}\" sid=\"j{}\" name=\"mixamorig:{}\" type=\"JOINT\"><matrix sid=\"transform\">{}</matrix>", n,
        n, at.name, dae_matrix(at.offset, Eigen::Quaterniond::Identity()));
    for (std::size_t child = n + 1; child < joints.size(); ++child)
        if (joints[child].parent == static_cast<int>(n)) text += dae_joint(joints, child);
    return text + "</node>\n";
}

inline std::string dae_source(const std::string& id, const char* kind, std::size_t count, std::size_t stride,
                              const std::string& values)
{
    const bool is_names = std::string_view(kind) == "Name_array";
    return fmt::format(
        "<source id=\"{0}\"><{1} id=\"{0}-a\" count=\"{2}\">{3}</{1}><technique_common><accessor source=\"#{0}-a\" "
        "count=\"{4}\" stride=\"{5}\"><param name=\"V\" type=\"{6}\"/></accessor></technique_common></source>\n",
        id, kind, count * stride, values, count, stride,
        is_names     ? "name"
        : stride > 1 ? "float4x4"
                     : "float");
}

// frame_count keys, 25 a second.
inline std::string sample_dae(std::size_t frame_count)
{
    const std::vector<SampleJoint> joints = sample_figure();
    std::string times, linear, animations;
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
        times += fmt::format("{} ", 0.04 * static_cast<double>(frame));
        linear += "LINEAR ";
    }
    for (std::size_t n = 0; n < joints.size(); ++n) {
        std::string matrices;
        for (std::size_t frame = 0; frame < frame_count; ++frame)
            matrices += dae_matrix(joints[n].offset, turn_of(sample_angles(n, frame))) + " ";
        const std::string id = fmt::format("a{}", n);
        animations += fmt::format("<animation id=\"{}\">\n", id) +
                      dae_source(id + "-t", "float_array", frame_count, 1, times) +
                      dae_source(id + "-m", "float_array", frame_count, 16, matrices) +
                      dae_source(id + "-i", "Name_array", frame_count, 1, linear) +
                      fmt::format(
                          "<sampler id=\"{0}-s\"><input semantic=\"INPUT\" source=\"#{0}-t\"/><input "
                          "semantic=\"OUTPUT\" source=\"#{0}-m\"/><input semantic=\"INTERPOLATION\" "
                          "source=\"#{0}-i\"/></sampler><channel source=\"#{0}-s\" "
                          "target=\"rig-{1}/transform\"/></animation>\n",
                          id, n);
    }
    return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
           "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
           "version=\"1.4.1\">\n<asset><unit meter=\"0.01\" name=\"centimeter\"/><up_axis>Y_UP</up_axis></asset>\n"
           "<library_animations>\n" +
           animations + "</library_animations>\n<library_visual_scenes><visual_scene id=\"Scene\" name=\"Scene\">\n" +
           dae_joint(joints, 0) +
           "</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene "
           "url=\"#Scene\"/></scene>\n</COLLADA>\n";
}

// ---- FBX 7.4 as text

// What each joint turns by before its own rotation, as Maya's joint orientations come out.
inline Eigen::Vector3d sample_orient(std::size_t joint)
{
    const auto n = static_cast<double>(joint);
    return {20 * std::sin(n), 35 * std::cos(2 * n), 50 * std::sin(3 * n)};
}

struct FbxText {
    std::string objects, connections;
    int next = 1000;
};

inline std::string fbx_vector(const char* name, const char* type, const Eigen::Vector3d& v)
{
    return fmt::format("P: \"{}\", \"{}\", \"\", \"A\",{},{},{}\n", name, type, v.x(), v.y(), v.z());
}

// A take that turns every joint: Euler angles, 25 keys a second, frames counted from `first`.
inline void add_fbx_take(FbxText& fbx, const std::string& name, const std::vector<int>& models, std::size_t first,
                         std::size_t frame_count)
{
    constexpr long long kSecond = 46186158000;  // FBX's ticks
    const int stack = fbx.next++, layer = fbx.next++;
    fbx.objects += fmt::format(
        "AnimationStack: {}, \"AnimStack::{}\", \"\" {{\nProperties70: {{\nP: \"LocalStop\", \"KTime\", \"Time\", "
        "\"\",{}\n}}\n}}\nAnimationLayer: {}, \"AnimLayer::Base\", \"\" {{\n}}\n",
        stack, name, kSecond * 10, layer);
    fbx.connections += fmt::format("C: \"OO\",{},{}\n", layer, stack);
    for (std::size_t n = 0; n < models.size(); ++n) {
        const int node = fbx.next++;
        fbx.objects += fmt::format(
            "AnimationCurveNode: {}, \"AnimCurveNode::R\", \"\" {{\nProperties70: {{\nP: \"d|X\", \"Number\", \"\", "
            "\"A\",0\nP: \"d|Y\", \"Number\", \"\", \"A\",0\nP: \"d|Z\", \"Number\", \"\", \"A\",0\n}}\n}}\n",
            node);
        fbx.connections +=
            fmt::format("C: \"OO\",{0},{1}\nC: \"OP\",{0},{2}, \"Lcl Rotation\"\n", node, layer, models[n]);
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            std::string times, values;
            for (std::size_t frame = 0; frame < frame_count; ++frame) {
                times += fmt::format("{}{}", frame ? "," : "", kSecond / 25 * static_cast<long long>(frame));
                values += fmt::format("{}{}", frame ? "," : "", sample_angles(n, first + frame)[axis]);
            }
            const int curve = fbx.next++;
            fbx.objects += fmt::format(
                "AnimationCurve: {}, \"AnimCurve::\", \"\" {{\nDefault: 0\nKeyVer: 4008\nKeyTime: *{} {{\na: {}\n}}\n"
                "KeyValueFloat: *{} {{\na: {}\n}}\nKeyAttrFlags: *1 {{\na: 24836\n}}\nKeyAttrDataFloat: *4 {{\na: "
                "0,0,0,0\n}}\nKeyAttrRefCount: *1 {{\na: {}\n}}\n}}\n",
                curve, frame_count, times, frame_count, values, frame_count);
            fbx.connections += fmt::format("C: \"OP\",{},{}, \"d|{}\"\n", curve, node, "XYZ"[axis]);
        }
    }
}

// The figure with joint orientations and two takes, "Reach" of frames 0 on and "Wave" of frames 3 on. up: 1 for y, 2
// for z; unit: centimetres.
inline std::string sample_fbx(int up, double unit, std::size_t frame_count)
{
    FbxText fbx;
    const std::vector<SampleJoint> joints = sample_figure();
    std::vector<int> models;
    for (std::size_t n = 0; n < joints.size(); ++n) {
        models.push_back(fbx.next++);
        fbx.objects +=
            fmt::format("Model: {}, \"Model::mixamorig:{}\", \"LimbNode\" {{\nVersion: 232\nProperties70: {{\n",
                        models[n], joints[n].name) +
            "P: \"RotationActive\", \"bool\", \"\", \"\",1\n" +
            fbx_vector("PreRotation", "Vector3D", sample_orient(n)) +
            fbx_vector("Lcl Translation", "Lcl Translation", joints[n].offset) +
            fbx_vector("Lcl Rotation", "Lcl Rotation", {0, 0, 0}) + "}\n}\n";
        fbx.connections += fmt::format("C: \"OO\",{},{}\n", models[n],
                                       joints[n].parent < 0 ? 0 : models[static_cast<std::size_t>(joints[n].parent)]);
    }
    add_fbx_take(fbx, "Reach", models, 0, frame_count);
    add_fbx_take(fbx, "Wave", models, 3, frame_count);
    const auto setting = [](const char* name, int value) {
        return fmt::format("P: \"{}\", \"int\", \"Integer\", \"\",{}\n", name, value);
    };
    return "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}\n"
           "GlobalSettings: {\nVersion: 1000\nProperties70: {\n" +
           setting("UpAxis", up) + setting("UpAxisSign", 1) + setting("FrontAxis", up == 1 ? 2 : 1) +
           setting("FrontAxisSign", up == 1 ? 1 : -1) + setting("CoordAxis", 0) + setting("CoordAxisSign", 1) +
           fmt::format("P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",{}\n", unit) +
           "P: \"TimeMode\", \"enum\", \"\", \"\",10\n}\n}\nObjects: {\n" + fbx.objects + "}\nConnections: {\n" +
           fbx.connections + "}\n";
}

}  // namespace swivel::test
