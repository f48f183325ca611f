#pragma once
// SPDX-License-Identifier: MIT
// BVH files by means other than tools/formats: words of the text, and rotation matrices multiplied up in double, so
// that a mistake of the reader, the writer or the solver cannot hide in its own check. Knows files as exporters write
// them, with names of one word and line ends of either kind; anything else fails the test.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/test_data.h"

namespace swivel::test {

struct PlainJoint {
    std::string name;
    int parent = -1;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
    std::vector<std::string> channels{};
    std::size_t first_channel = 0;
};

struct PlainMotion {
    std::string header;  // everything before the first frame
    std::vector<PlainJoint> joints;
    std::vector<std::string> lines;  // one a frame, each with its line end
    std::vector<std::vector<double>> values;

    const PlainJoint& joint(int index) const { return joints[static_cast<std::size_t>(index)]; }
};

struct PlainPose {  // in the world: x_w = position + rotation * x_joint
    Eigen::Vector3d position;
    Eigen::Matrix3d rotation;
};

inline std::vector<std::string> words_of(const std::string& text)
{
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

inline void read_plain_joints(PlainMotion& motion)
{
    std::istringstream in(motion.header);
    std::vector<int> open;  // joints inside each other; -1 for an end site
    int next = -1;
    std::size_t channel_count = 0;
    for (std::string word; in >> word && word != "MOTION";) {
        if (word == "ROOT" || word == "JOINT") {
            in >> word;
            next = static_cast<int>(motion.joints.size());
            motion.joints.push_back({word, open.empty() ? -1 : open.back()});
        } else if (word == "End") {
            next = -1;
        } else if (word == "{") {
            open.push_back(next);
        } else if (word == "}") {
            open.pop_back();
        } else if (word == "OFFSET") {
            Eigen::Vector3d offset;
            in >> offset.x() >> offset.y() >> offset.z();
            if (open.back() >= 0) motion.joints[static_cast<std::size_t>(open.back())].offset = offset;
        } else if (word == "CHANNELS") {
            PlainJoint& joint = motion.joints[static_cast<std::size_t>(open.back())];
            std::size_t count = 0;
            in >> count;
            for (joint.channels.resize(count); std::string & channel : joint.channels) in >> channel;
            joint.first_channel = channel_count;
            channel_count += count;
        }
    }
}

inline PlainMotion plain_motion(const std::string& text)
{
    PlainMotion motion;
    std::size_t at = text.find('\n', text.find("Frame Time")) + 1;
    motion.header = text.substr(0, at);
    read_plain_joints(motion);
    for (std::size_t end; at < text.size(); at = end) {
        end = std::min(text.find('\n', at), text.size() - 1) + 1;
        motion.lines.push_back(text.substr(at, end - at));
        std::vector<double>& values = motion.values.emplace_back();
        for (const std::string& word : words_of(motion.lines.back())) {
            values.push_back(std::strtod(word.c_str(), nullptr));
        }
    }
    return motion;
}

inline PlainMotion plain_motion_of(const fs::path& path) { return plain_motion(slurp(path)); }

// The joint of that name; fails the test if there is none.
inline int joint_named(const PlainMotion& motion, std::string_view name)
{
    const auto found =
        std::find_if(motion.joints.begin(), motion.joints.end(), [&](const PlainJoint& j) { return j.name == name; });
    REQUIRE(found != motion.joints.end());
    return static_cast<int>(found - motion.joints.begin());
}

inline Eigen::Matrix3d axis_matrix(char axis, double angle_deg)
{
    const double angle = angle_deg * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    Eigen::Matrix3d m;
    if (axis == 'X')
        m << 1, 0, 0, 0, c, -s, 0, s, c;
    else if (axis == 'Y')
        m << c, 0, s, 0, 1, 0, -s, 0, c;
    else
        m << c, -s, 0, s, c, 0, 0, 0, 1;
    return m;
}

inline std::vector<PlainPose> pose_of(const PlainMotion& motion, std::size_t frame)
{
    std::vector<PlainPose> pose;
    for (const PlainJoint& joint : motion.joints) {
        Eigen::Vector3d translation = joint.offset;
        Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
        for (std::size_t c = 0; c < joint.channels.size(); ++c) {
            const std::string& channel = joint.channels[c];
            const double value = motion.values.at(frame).at(joint.first_channel + c);
            if (channel.ends_with("rotation"))
                rotation = rotation * axis_matrix(channel[0], value);
            else
                translation[channel[0] - 'X'] = value;
        }
        const PlainPose from = joint.parent < 0 ? PlainPose{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()}
                                                : pose[static_cast<std::size_t>(joint.parent)];
        pose.push_back({from.position + from.rotation * translation, from.rotation * rotation});
    }
    return pose;
}

// One arm's joints in a motion.
struct PlainArm {
    std::string side;
    int shoulder, elbow, wrist;
    double upper, fore;  // lengths of the bones

    double length() const { return upper + fore; }
};

inline std::vector<PlainArm> arms_of(const PlainMotion& motion)
{
    std::vector<PlainArm> arms;
    for (const std::string side : {"Left", "Right"}) {
        const int elbow = joint_named(motion, side + "ForeArm"), wrist = joint_named(motion, side + "Hand");
        arms.push_back({side == "Left" ? "left" : "right", joint_named(motion, side + "Arm"), elbow, wrist,
                        motion.joint(elbow).offset.norm(), motion.joint(wrist).offset.norm()});
    }
    return arms;
}

// The legs, in the same words: hip, knee and ankle.
inline std::vector<PlainArm> legs_of(const PlainMotion& motion)
{
    std::vector<PlainArm> legs;
    for (const std::string side : {"Left", "Right"}) {
        const int knee = joint_named(motion, side + "Leg"), ankle = joint_named(motion, side + "Foot");
        legs.push_back({side == "Left" ? "left" : "right", joint_named(motion, side + "UpLeg"), knee, ankle,
                        motion.joint(knee).offset.norm(), motion.joint(ankle).offset.norm()});
    }
    return legs;
}

// Where one arm is in one frame.
struct PlainArmPose {
    Eigen::Vector3d shoulder, elbow, wrist;
    Eigen::Matrix3d parent, hand;

    // Between the bones: 0 for a straight arm.
    double bend() const
    {
        const Eigen::Vector3d upper = elbow - shoulder, fore = wrist - elbow;
        return std::atan2(upper.cross(fore).norm(), upper.dot(fore));
    }
};

inline PlainArmPose arm_pose(const PlainMotion& motion, const PlainArm& arm, std::size_t frame)
{
    const std::vector<PlainPose> pose = pose_of(motion, frame);
    const auto at = [&](int joint) -> const PlainPose& { return pose[static_cast<std::size_t>(joint)]; };
    return {at(arm.shoulder).position, at(arm.elbow).position, at(arm.wrist).position,
            at(motion.joint(arm.shoulder).parent).rotation, at(arm.wrist).rotation};
}

// The text of a motion's frames first, first + step, ... and as often as wanted.
inline std::string cut(const PlainMotion& motion, std::size_t first, std::size_t step, std::size_t repeats = 1)
{
    std::string frames;
    std::size_t count = 0;
    for (std::size_t n = 0; n < repeats; ++n)
        for (std::size_t frame = first; frame < motion.lines.size(); frame += step, ++count)
            frames += motion.lines[frame];
    const std::size_t at = motion.header.find("Frames:") + 7, end = motion.header.find_first_of("\r\n", at);
    return std::string(motion.header).replace(at, end - at, " " + std::to_string(count)) + frames;
}

// A small file with two arms, one line of frames each; its line numbers are known to test_command_input.cpp.
inline const std::string kTwoArms = [] {
    const auto arm = [](const std::string& side, const std::string& sign) {
        const std::string three = "CHANNELS 3 Zrotation Yrotation Xrotation\n";
        return "JOINT " + side + "Arm\n{\nOFFSET " + sign + "2 5 0\n" + three + "JOINT " + side +
               "ForeArm\n{\nOFFSET " + sign + "5 0 0\n" + three + "JOINT " + side + "Hand\n{\nOFFSET " + sign +
               "3 0 0\n" + three + "End Site\n{\nOFFSET 1 0 0\n}\n}\n}\n}\n";
    };
    return "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation "
           "Xrotation\n" +
           arm("Left", "") + arm("Right", "-") +
           "}\nMOTION\nFrames: 2\nFrame Time: .01\n"
           "1 2 3 0 10 0 0 20 0 0 -30 0 5 0 0 0 20 0 0 30 0 5 0 0\n"
           "1 2 4 0 11 0 0 21 0 0 -31 0 6 0 0 0 21 0 0 31 0 6 0 0\n";
}();

}  // namespace swivel::test
