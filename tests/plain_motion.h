#pragma once
// SPDX-License-Identifier: MIT
// Reads BVH files without tools/formats, by words of the text and by rotation matrices multiplied in double. So a
// mistake of the reader, the writer or the solver cannot hide in its own check. This knows files as exporters write
// them, with names of one word and line ends of either kind. Anything else fails the test.

#include <Eigen/Geometry>
#include <array>
#include <cmath>
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

PlainMotion plain_motion(const std::string& text);

inline PlainMotion plain_motion_of(const fs::path& path) { return plain_motion(slurp(path)); }

// The joint of that name; fails the test if there is none.
int joint_named(const PlainMotion& motion, std::string_view name);

std::vector<PlainPose> pose_of(const PlainMotion& motion, std::size_t frame);

// One arm's joints in a motion.
struct PlainArm {
    std::string side;
    int shoulder, elbow, wrist;
    double upper, fore;  // lengths of the bones

    double length() const { return upper + fore; }
};

// Of both sides. parts: what the joints are called after Left and Right.
std::vector<PlainArm> limbs_of(const PlainMotion& motion, const std::array<std::string, 3>& parts);
inline std::vector<PlainArm> arms_of(const PlainMotion& motion) { return limbs_of(motion, {"Arm", "ForeArm", "Hand"}); }
// The legs, in the same words: hip, knee and ankle.
inline std::vector<PlainArm> legs_of(const PlainMotion& motion) { return limbs_of(motion, {"UpLeg", "Leg", "Foot"}); }

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

PlainArmPose arm_pose(const PlainMotion& motion, const PlainArm& arm, std::size_t frame);

// The angle of the turn from one to the other, in radians; exact near 0.
inline double turn_between(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b)
{
    const Eigen::Matrix3d turn = a.transpose() * b;
    const Eigen::Vector3d axis(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    return std::atan2(axis.norm(), turn.trace() - 1);
}

// A frame's line with its words at some channels taken out: blanks, line end and all other words.
std::string rest_of(const std::string& line, const std::vector<std::size_t>& channels);

// The text of a motion's frames first, first + step, ... and as often as wanted.
std::string cut(const PlainMotion& motion, std::size_t first, std::size_t step, std::size_t repeats = 1);

// A small file with two arms, one line of frames each; its line numbers are known to tests/transcripts.
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
