// SPDX-License-Identifier: MIT
// A crowd walks over hills, and each character carries a rifle in both hands. One call a frame solves whole bodies:
// feet stand where they touch and lie on the slope, the pelvis comes down as far as a leg needs, the rifle comes as
// near as both arms must have it. The part between the two lines of dots is all that a game adds. Before it comes an
// animation, as a clip would give it, and after it comes a check by the solved bodies' own joints.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <swivel/swivel_bodies.hpp>
#include <vector>

namespace {

constexpr double kFramesASecond = 60;
constexpr int kFrames = 600;
constexpr std::size_t kCount = 500;

enum Joint {
    PELVIS,
    SPINE,
    HEAD,
    RIGHT_ARM,
    RIGHT_FOREARM,
    RIGHT_HAND,
    LEFT_ARM,
    LEFT_FOREARM,
    LEFT_HAND,
    RIGHT_THIGH,
    RIGHT_SHIN,
    RIGHT_FOOT,
    LEFT_THIGH,
    LEFT_SHIN,
    LEFT_FOOT,
    JOINTS
};
constexpr std::int32_t kParents[JOINTS] = {-1,     PELVIS,     SPINE,        SPINE,  RIGHT_ARM,   RIGHT_FOREARM,
                                           SPINE,  LEFT_ARM,   LEFT_FOREARM, PELVIS, RIGHT_THIGH, RIGHT_SHIN,
                                           PELVIS, LEFT_THIGH, LEFT_SHIN};
constexpr float kOffsets[JOINTS][3] = {{0, 0.89f, 0},  {0, 0.15f, 0},  {0, 0.5f, 0},      {-0.18f, 0.35f, 0},
                                       {0, -0.3f, 0},  {0, -0.26f, 0}, {0.18f, 0.35f, 0}, {0, -0.3f, 0},
                                       {0, -0.26f, 0}, {-0.09f, 0, 0}, {0, -0.45f, 0},    {0, -0.42f, 0},
                                       {0.09f, 0, 0},  {0, -0.45f, 0}, {0, -0.42f, 0}};

// A character as the game has it: its animation writes rotations, and the call below a corrected copy, to draw.
struct Character {
    float place[3] = {}, turn[4] = {0, 0, 0, 1};  // metres, y up; x, y, z, w
    float rotations[JOINTS][4] = {}, solved[JOINTS][4] = {};
    float contact[2] = {};  // of the right foot and the left one
    float ground[2][3] = {}, normal[2][3] = {};
    float foot[2][7] = {}, rifle[7] = {};  // where they are after the call: place, rotation
    std::uint32_t flags[5] = {};           // of feet, pelvis, rifle, left hand
    double heading = 0, phase = 0;
};

double height(double x, double z) { return 0.5 * std::sin(0.5 * x) + 0.3 * std::sin(0.7 * z + 0.3 * x); }

void set(float (&q)[4], double pitch, double yaw = 0)  // about x, after that about y
{
    const double px = std::sin(pitch / 2), pw = std::cos(pitch / 2), yy = std::sin(yaw / 2), yw = std::cos(yaw / 2);
    const double xyzw[] = {px * yw, pw * yy, -px * yy, pw * yw};
    std::copy(std::begin(xyzw), std::end(xyzw), q);
}

// A walk on flat ground. Nothing here knows of hills.
void animate(Character& of, double seconds)
{
    constexpr double kTurn = 6.283185307179586, kSpeed = 1.2, kStride = 1.15;
    of.phase += kTurn * seconds * kSpeed / kStride;
    of.place[0] += static_cast<float>(kSpeed * seconds * std::sin(of.heading));
    of.place[2] += static_cast<float>(kSpeed * seconds * std::cos(of.heading));
    of.place[1] = static_cast<float>(height(double{of.place[0]}, double{of.place[2]}));
    set(of.turn, 0, of.heading);
    for (auto& joint : of.rotations) set(joint, 0);
    for (int side = 0; side < 2; ++side) {
        const double at = of.phase + side * kTurn / 2, swing = 0.35 * std::sin(at), up = std::max(std::cos(at), 0.0);
        const double length = (0.81 - 0.12 * up) / std::cos(swing);  // from hip to ankle
        const double knee = std::acos((length * length - 0.3789) / 0.378);
        const double hip = -swing - std::atan2(0.42 * std::sin(knee), 0.45 + 0.42 * std::cos(knee));
        set(of.rotations[RIGHT_THIGH + 3 * side], hip);
        set(of.rotations[RIGHT_SHIN + 3 * side], knee);
        set(of.rotations[RIGHT_FOOT + 3 * side], -hip - knee);
        of.contact[side] = up == 0;
        set(of.rotations[RIGHT_ARM + 3 * side], -0.6 - 0.1 * swing, side == 0 ? 0.4 : -0.2);
        set(of.rotations[RIGHT_FOREARM + 3 * side], -1.2);
    }
}

// ........................................................................................................ the game's

constexpr float kToe[3] = {0, -0.08f, 0.15f};  // a point of the sole, in the foot's frame
constexpr float kGrip[2][7] = {{0, 0, 0, 0, 0, 0, 1}, {0.1f, 0.02f, 0.45f, 0, 0, 0, 1}};  // of the hands, on the rifle
enum Group { RIGHT_LEG, LEFT_LEG, SHIFT, RIFLE, RIGHT, LEFT };

swivel::Crowd make_crowd(std::size_t count)
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = JOINTS;
    skeleton.parents = {kParents, sizeof kParents[0]};
    skeleton.translations = {kOffsets, sizeof kOffsets[0]};
    std::array<swivel_limb_joints, 4> limbs;
    for (std::uint32_t side = 0; side < 2; ++side) {
        limbs[side] = swivel_default_limb_joints(RIGHT_THIGH + 3 * side, RIGHT_SHIN + 3 * side, RIGHT_FOOT + 3 * side);
        limbs[side].bend[2] = -1;  // shins go backwards
        limbs[2 + side] =
            swivel_default_limb_joints(RIGHT_ARM + 3 * side, RIGHT_FOREARM + 3 * side, RIGHT_HAND + 3 * side);
        limbs[2 + side].bend[2] = 1;
    }
    const swivel_features all = SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND;
    std::vector<swivel::Definition> groups;
    for (const swivel_limb_joints& joints : std::span(limbs).first(2)) {
        swivel_body_limb_def leg = swivel::body_limb(
            joints, all | SWIVEL_WITH_PLANT | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_GROUND | SWIVEL_WITH_CAP |
                        SWIVEL_WITH_PELVIS_FIT | SWIVEL_HAND_YIELDS | SWIVEL_WITH_HAND_TRANSFORM);
        leg.ground.heel[1] = kToe[1];
        leg.ground.heel[2] = -0.06f;
        groups.push_back(leg);
    }
    groups.push_back(swivel_default_shift_def());
    groups.push_back(swivel_default_prop_def());
    for (const swivel_limb_joints& joints : std::span(limbs).last(2)) {
        swivel_body_limb_def arm = swivel::body_limb(joints, all | SWIVEL_WITH_LINK);
        arm.link = RIFLE;
        groups.push_back(arm);
    }
    swivel::Crowd crowd(skeleton, static_cast<std::uint32_t>(count), groups);
    for (std::uint32_t side = 0; side < 2; ++side) {
        crowd.write_all(SWIVEL_EFFECTOR, RIGHT_LEG + side, kToe);
        crowd.write_all(SWIVEL_GRIP, RIGHT + side, kGrip[side]);
    }
    return crowd;
}

// What is below these feet. Solving threads call it.
void sample(const swivel_probes& probes)
{
    for (std::size_t n = 0; n < probes.count; ++n) {
        const double x = double{probes.places[n][0]}, z = double{probes.places[n][2]}, near = 1e-3;
        const float ground[] = {probes.places[n][0], static_cast<float>(height(x, z)), probes.places[n][2]};
        const float normal[] = {static_cast<float>((height(x - near, z) - height(x + near, z)) / (2 * near)), 1,
                                static_cast<float>((height(x, z - near) - height(x, z + near)) / (2 * near))};
        std::copy(std::begin(ground), std::end(ground), probes.grounds[n]);
        std::copy(std::begin(normal), std::end(normal), probes.normals[n]);
    }
}

void solve(swivel::Crowd& crowd, std::vector<Character>& crew, const float& seconds)
{
    constexpr std::size_t step = sizeof(Character);
    Character& first = crew[0];
    // A solve writes the joints that it turns. Spine and head are drawn as they are animated.
    for (Character& each : crew) std::memcpy(each.solved, each.rotations, sizeof each.solved);
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {first.rotations, step, sizeof first.rotations[0], nullptr};
    pose.results = {first.solved, step, sizeof first.solved[0], nullptr};
    pose.root_position = {first.place, step};
    pose.root_rotation = {first.turn, step};
    pose.time = {&seconds, 0};
    std::array<swivel::Streams, 6> streams;
    for (std::size_t side = 0; side < 2; ++side) {
        streams[RIGHT_LEG + side].in(SWIVEL_CONTACT, {&first.contact[side], step});
        streams[RIGHT_LEG + side].out(SWIVEL_HAND_TRANSFORM, {&first.foot[side], step});
        streams[RIGHT_LEG + side].out(SWIVEL_FLAGS, {&first.flags[side], step});
    }
    streams[RIFLE].out(SWIVEL_PROP_TRANSFORM, {&first.rifle, step}).out(SWIVEL_FLAGS, {&first.flags[3], step});
    streams[LEFT].out(SWIVEL_FLAGS, {&first.flags[4], step});
    crowd.solve({.streams = {streams.begin(), streams.end()}, .pose = &pose, .sample = sample});
}

// ..................................................................................................................

using Place = std::array<double, 3>;

// A point of a frame, place and rotation.
Place point_of(const float (&frame)[7], const float (&at)[3])
{
    const double x = frame[3], y = frame[4], z = frame[5], w = frame[6], v[3] = {at[0], at[1], at[2]};
    const double u[3] = {2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])};
    return {frame[0] + v[0] + w * u[0] + y * u[2] - z * u[1], frame[1] + v[1] + w * u[1] + z * u[0] - x * u[2],
            frame[2] + v[2] + w * u[2] + x * u[1] - y * u[0]};
}

// What the feet did, in millimetres.
struct Soles {
    double slide = 0, gap = 0, below = 0;  // of a standing toe: in a frame; from the ground. Of any: below it
    std::size_t standing = 0;

    // frames: since when it stands.
    void see(const Place& toe, const Place& was, int frames)
    {
        const double over = 1000 * (toe[1] - height(toe[0], toe[2]));
        below = std::max(below, -over);
        if (frames < 12) return;  // it comes to rest
        ++standing;
        gap = std::max(gap, std::fabs(over));
        slide = std::max(slide, 1000 * std::hypot(toe[0] - was[0], toe[1] - was[1], toe[2] - was[2]));
    }
};

int walk()
{
    std::vector<Character> crew(kCount);
    for (std::size_t n = 0; n < kCount; ++n) {
        crew[n].heading = 0.37 * static_cast<double>(n);
        crew[n].phase = 0.61 * static_cast<double>(n);
        crew[n].place[0] = static_cast<float>(2 * (n % 25));
        crew[n].place[2] = static_cast<float>(2 * (n / 25));
    }
    swivel::Crowd crowd = make_crowd(kCount);
    const float seconds = static_cast<float>(1 / kFramesASecond);
    std::vector<std::array<Place, 2>> toes(kCount);
    std::vector<std::array<int, 2>> standing(kCount);
    Soles soles;
    std::size_t held = 0, reached = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
        for (Character& each : crew) animate(each, 1 / kFramesASecond);
        solve(crowd, crew, seconds);
        for (std::size_t n = 0; n < kCount; ++n) {
            held += crew[n].flags[4] & SWIVEL_REACHED;
            for (std::size_t side = 0; side < 2; ++side) {
                const Place toe = point_of(crew[n].foot[side], kToe);
                const bool stands = crew[n].flags[side] & SWIVEL_PLANTED && crew[n].flags[side] & SWIVEL_REACHED;
                reached += crew[n].flags[side] & SWIVEL_REACHED;
                standing[n][side] = stands ? standing[n][side] + 1 : 0;
                soles.see(toe, toes[n][side], standing[n][side]);
                toes[n][side] = toe;
            }
        }
    }
    const double all = kCount * kFrames;
    std::printf(
        "%zu characters walked for %.0f s: feet reached in %.1f %% of frames, left hands on the rifle in %.1f %%\n",
        kCount, kFrames / kFramesASecond, 50 * static_cast<double>(reached) / all,
        100 * static_cast<double>(held) / all);
    std::printf(
        "standing soles slid %.3f mm a frame at most, and were %.3f mm from the ground; none was %.3f mm below it\n",
        soles.slide, soles.gap, soles.below);
    return soles.standing > 0 && soles.slide < 0.1 && soles.gap < 0.1 && soles.below < 1 ? 0 : 1;
}

}  // namespace

int main()
{
    try {
        return walk();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
