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

struct Bone {
    const char* name;
    int parent;
    Vector3d offset;
};

constexpr double kLeg = 0.43;  // each of thigh and shin

const std::array<Bone, 24> kBones{{{"Hips", -1, {0, 0.97, 0}},
                                   {"Spine", 0, {0, 0.12, 0}},
                                   {"Chest", 1, {0, 0.18, 0}},
                                   {"Neck", 2, {0, 0.21, 0}},
                                   {"Head", 3, {0, 0.12, 0}},
                                   {"LeftShoulder", 2, {0.04, 0.16, 0}},
                                   {"LeftArm", 5, {0.13, 0, 0}},
                                   {"LeftForeArm", 6, {0.29, 0, 0}},
                                   {"LeftHand", 7, {0.25, 0, 0}},
                                   {"LeftFingers", 8, {0.10, 0, 0}},
                                   {"RightShoulder", 2, {-0.04, 0.16, 0}},
                                   {"RightArm", 10, {-0.13, 0, 0}},
                                   {"RightForeArm", 11, {-0.29, 0, 0}},
                                   {"RightHand", 12, {-0.25, 0, 0}},
                                   {"RightFingers", 13, {-0.10, 0, 0}},
                                   {"LeftUpLeg", 0, {0.10, -0.05, 0}},
                                   {"LeftLeg", 15, {0, -kLeg, 0}},
                                   {"LeftFoot", 16, {0, -kLeg, 0}},
                                   {"RightUpLeg", 0, {-0.10, -0.05, 0}},
                                   {"RightLeg", 18, {0, -kLeg, 0}},
                                   {"RightFoot", 19, {0, -kLeg, 0}},
                                   {"LeftToe", 17, {0, -0.06, 0.14}},
                                   {"RightToe", 20, {0, -0.06, 0.14}},
                                   {"Crown", 4, {0, 0.10, 0}}}};

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

    // side: +1 left, -1 right. The arm swings ahead, its elbow opens and closes twice as often: the hand draws an
    // eight.
    Quaterniond upper_arm(double side) const
    {
        const double phase = side > 0 ? 0 : 0.37;
        return about_y(-side * (42 + 34 * wave(2, phase))) * about_z(-side * (28 + 38 * wave(1, phase)));
    }
    Quaterniond forearm(double side) const { return about_y(-side * (62 + 48 * wave(2, side > 0 ? 0.3 : 0.55))); }
    Quaterniond hand(double side) const { return about_z(side * 20 * wave(3, 0.1)); }
    // Hips over feet that stay where they are.
    double knee_deg() const { return 360 / std::numbers::pi * std::acos(1 - drop() / (2 * kLeg)); }

    Quaterniond turn(std::size_t bone) const
    {
        switch (bone) {
            case 1:
                return about_z(4 * wave(2, 0.25)) * about_y(7 * wave(1, 0));
            case 2:
                return about_y(9 * wave(1, 0.05)) * about_x(3 + 3 * wave(4, 0.2));
            case 3:
                return about_y(-10 * wave(1, 0.1));
            case 6:
                return upper_arm(1);
            case 7:
                return forearm(1);
            case 8:
                return hand(1);
            case 11:
                return upper_arm(-1);
            case 12:
                return forearm(-1);
            case 13:
                return hand(-1);
            case 15:
            case 17:
            case 18:
            case 20:
                return about_x(-knee_deg() / 2);
            case 16:
            case 19:
                return about_x(knee_deg());
            default:
                return Quaterniond::Identity();
        }
    }
};

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
        for (std::size_t bone = 0; bone < kBones.size(); ++bone) clip.rotation.push_back(moment.turn(bone));
        clip.translation.push_back(kBones[0].offset - Vector3d(0, moment.drop(), 0));
    }
    return clip;
}

}  // namespace swivel::tools
