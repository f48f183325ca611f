// SPDX-License-Identifier: MIT
#include "tools/crowd/demo_clip.h"

#include <array>
#include <cmath>
#include <numbers>

namespace swivel::tools {

namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kLeg = 0.43;  // each of thigh and shin

Quaterniond about(double angle_deg, const Vector3d& axis)
{
    return Quaterniond(AngleAxisd(angle_deg * std::numbers::pi / 180, axis));
}
Quaterniond about_x(double angle_deg) { return about(angle_deg, Vector3d::UnitX()); }
Quaterniond about_y(double angle_deg) { return about(angle_deg, Vector3d::UnitY()); }
Quaterniond about_z(double angle_deg) { return about(angle_deg, Vector3d::UnitZ()); }

// One frame. Turns are whole ones of the loop, so that its end meets its start.
struct Moment {
    double loop;  // 0 to 1

    double wave(double turns, double phase) const { return std::sin(2 * std::numbers::pi * (turns * loop + phase)); }
    double drop() const { return 0.035 + 0.025 * wave(4, 0); }  // of the hips, by bent knees

    // Keeps the feet in place below the hips.
    double knee_deg() const { return 360 / std::numbers::pi * std::acos(1 - drop() / (2 * kLeg)); }

    // Rotations of bones.
    Quaterniond rest() const { return Quaterniond::Identity(); }
    Quaterniond spine() const { return about_z(4 * wave(2, 0.25)) * about_y(7 * wave(1, 0)); }
    Quaterniond chest() const { return about_y(9 * wave(1, 0.05)) * about_x(3 + 3 * wave(4, 0.2)); }
    Quaterniond neck() const { return about_y(-10 * wave(1, 0.1)); }
    Quaterniond knee() const { return about_x(knee_deg()); }
    Quaterniond hip_or_ankle() const { return about_x(-knee_deg() / 2); }
    // side: +1 left, -1 right. The arm swings ahead, its elbow opens and closes twice as often: the hand draws an
    // eight.
    template <int side>
    Quaterniond upper_arm() const
    {
        const double phase = side > 0 ? 0 : 0.37;
        return about_y(-side * (42 + 34 * wave(2, phase))) * about_z(-side * (28 + 38 * wave(1, phase)));
    }
    template <int side>
    Quaterniond forearm() const
    {
        return about_y(-side * (62 + 48 * wave(2, side > 0 ? 0.3 : 0.55)));
    }
    template <int side>
    Quaterniond hand() const
    {
        return about_z(side * 20 * wave(3, 0.1));
    }
};

struct Bone {
    const char* name;
    int parent;
    Vector3d offset;
    Quaterniond (Moment::*turn)() const = &Moment::rest;
};

const std::array<Bone, 24> kBones{{{"Hips", -1, {0, 0.97, 0}},
                                   {"Spine", 0, {0, 0.12, 0}, &Moment::spine},
                                   {"Chest", 1, {0, 0.18, 0}, &Moment::chest},
                                   {"Neck", 2, {0, 0.21, 0}, &Moment::neck},
                                   {"Head", 3, {0, 0.12, 0}},
                                   {"LeftShoulder", 2, {0.04, 0.16, 0}},
                                   {"LeftArm", 5, {0.13, 0, 0}, &Moment::upper_arm<1>},
                                   {"LeftForeArm", 6, {0.29, 0, 0}, &Moment::forearm<1>},
                                   {"LeftHand", 7, {0.25, 0, 0}, &Moment::hand<1>},
                                   {"LeftFingers", 8, {0.10, 0, 0}},
                                   {"RightShoulder", 2, {-0.04, 0.16, 0}},
                                   {"RightArm", 10, {-0.13, 0, 0}, &Moment::upper_arm<-1>},
                                   {"RightForeArm", 11, {-0.29, 0, 0}, &Moment::forearm<-1>},
                                   {"RightHand", 12, {-0.25, 0, 0}, &Moment::hand<-1>},
                                   {"RightFingers", 13, {-0.10, 0, 0}},
                                   {"LeftUpLeg", 0, {0.10, -0.05, 0}, &Moment::hip_or_ankle},
                                   {"LeftLeg", 15, {0, -kLeg, 0}, &Moment::knee},
                                   {"LeftFoot", 16, {0, -kLeg, 0}, &Moment::hip_or_ankle},
                                   {"RightUpLeg", 0, {-0.10, -0.05, 0}, &Moment::hip_or_ankle},
                                   {"RightLeg", 18, {0, -kLeg, 0}, &Moment::knee},
                                   {"RightFoot", 19, {0, -kLeg, 0}, &Moment::hip_or_ankle},
                                   {"LeftToe", 17, {0, -0.06, 0.14}},
                                   {"RightToe", 20, {0, -0.06, 0.14}},
                                   {"Crown", 4, {0, 0.10, 0}}}};

}  // namespace

formats::Clip demo_clip(std::size_t frame_count)
{
    formats::Clip clip;
    for (const Bone& bone : kBones) {
        formats::Joint joint;
        joint.name = bone.name;
        joint.parent = bone.parent;
        joint.offset = bone.offset;
        clip.joints.push_back(joint);
    }
    clip.joints[0].track = 0;
    clip.track_count = 1;
    clip.frame_time = 1.0 / 60;
    clip.frame_count = frame_count;
    for (std::size_t frame = 0; frame < frame_count; ++frame) {
        const Moment moment{static_cast<double>(frame) / kDemoFrames};
        for (const Bone& bone : kBones) clip.rotation.push_back((moment.*bone.turn)());
        clip.translation.push_back(kBones[0].offset - Vector3d(0, moment.drop(), 0));
    }
    return clip;
}

}  // namespace swivel::tools
