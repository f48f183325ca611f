// SPDX-License-Identifier: MIT
// One clip on many bodies: replay CLIP.bvh [BODIES]. Each body has its own size, bones and start, and its hands do what
// the clip's hands do, as far from its shoulders as its arms are long. Files are read by the reader of swivel's
// command, which is not part of the installed library; any other will do.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <string>
#include <swivel/swivel.hpp>
#include <vector>

#include "tools/formats/bvh.h"
#include "tools/formats/clip.h"

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using swivel::formats::Clip;
using swivel::formats::JointPose;

constexpr std::array<const char*, 2> kSides = {"Left", "Right"};

struct Arm {  // joints of the clip, each the parent of the next
    std::size_t shoulder, elbow, wrist;
};

std::size_t joint_named(const Clip& clip, const std::string& name)
{
    const std::vector<int> found = swivel::formats::find_joints(clip, name);
    if (found.size() != 1) throw std::runtime_error("the clip has no joint " + name + ", or several; try another clip");
    return static_cast<std::size_t>(found[0]);
}

// CMU's and Mixamo's names.
Arm find_arm(const Clip& clip, const std::string& side)
{
    return {joint_named(clip, side + "Arm"), joint_named(clip, side + "ForeArm"), joint_named(clip, side + "Hand")};
}

void store(const auto& from, auto& to) { std::ranges::copy(from.template cast<float>(), std::begin(to)); }
void store(const Quaterniond& from, std::array<float, 4>& to) { store(from.coeffs(), to); }  // both x, y, z, w

// A BVH rests with straight arms and no rotations, which does not show how an elbow bends: it bends to where
// the forearm points in the clip's mean.
swivel_binding bind_arm(const Clip& clip, const Arm& arm)
{
    const Vector3d fore = clip.joints[arm.wrist].offset;
    Vector3d bend = Vector3d::Zero();
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame)
        bend += clip.rotation[frame * clip.joints.size() + arm.elbow] * fore;
    std::vector<std::int32_t> parents;
    std::vector<std::array<float, 3>> translations;
    for (const swivel::formats::Joint& joint : clip.joints) {
        parents.push_back(joint.parent);
        store(joint.offset, translations.emplace_back());
    }
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.joint_count = static_cast<std::uint32_t>(parents.size());
    skeleton.parents = swivel::stream(parents);
    skeleton.translations = swivel::stream(translations);
    const auto number = [](std::size_t joint) { return static_cast<std::uint32_t>(joint); };
    swivel_limb_joints limb = swivel_default_limb_joints(number(arm.shoulder), number(arm.elbow), number(arm.wrist));
    store(bend.normalized(), limb.bend);
    return swivel::bind(skeleton, limb);
}

// Where one frame of the clip has one arm, in the world.
struct Source {
    Vector3d shoulder, elbow, wrist;
    Quaterniond parent, hand;
};

std::vector<Source> sources_of(const Clip& clip, const Arm& arm)
{
    std::vector<Source> sources;
    const auto parent = static_cast<std::size_t>(clip.joints[arm.shoulder].parent);
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const std::vector<JointPose> pose = swivel::formats::world_pose(clip, frame);
        sources.push_back({pose[arm.shoulder].position, pose[arm.elbow].position, pose[arm.wrist].position,
                           pose[parent].rotation, pose[arm.wrist].rotation});
    }
    return sources;
}

// One body's one arm: what the solver reads, in the world, and the joints' local rotations it writes.
struct BodyArm {
    std::array<float, 3> target, pole, shoulder_place;
    std::array<float, 4> parent, hand;
    std::array<float, 2> lengths;
    std::array<float, 4> shoulder, elbow, wrist;
};

struct Body {
    double size;            // beside the clip's own
    double share;           // of the upper arm in the arm, beside the clip's own
    std::size_t start = 0;  // frame of the clip
};

// The first is the clip's own.
std::vector<Body> make_bodies(std::size_t count, std::size_t frame_count)
{
    std::vector<Body> bodies;
    for (std::size_t n = 0; n < count; ++n)
        bodies.push_back({n == 0 ? 1 : 0.8 + 0.05 * static_cast<double>(n % 9),
                          n == 0 ? 1 : 0.94 + 0.02 * static_cast<double>(n % 7), n * 37 % frame_count});
    return bodies;
}

void set_frame(std::vector<BodyArm>& arms, const std::vector<Body>& bodies, const std::vector<Source>& sources,
               std::size_t frame)
{
    for (std::size_t n = 0; n < bodies.size(); ++n) {
        const Body& body = bodies[n];
        const Source& source = sources[(body.start + frame) % sources.size()];
        const Vector3d shoulder =
            body.size * source.shoulder;  // a smaller body is smaller all over, and so are its steps
        store(shoulder, arms[n].shoulder_place);
        store(shoulder + body.size * (source.wrist - source.shoulder), arms[n].target);
        store(shoulder + body.size * (source.elbow - source.shoulder), arms[n].pole);  // the elbow leans as in the clip
        store(source.parent, arms[n].parent);
        store(source.hand, arms[n].hand);
    }
}

void set_lengths(std::vector<BodyArm>& arms, const std::vector<Body>& bodies, const float (&clip_lengths)[2])
{
    const double upper = clip_lengths[0], fore = clip_lengths[1];
    for (std::size_t n = 0; n < bodies.size(); ++n) {
        const double own_upper = bodies[n].size * bodies[n].share * upper;
        arms[n].lengths = {static_cast<float>(own_upper),
                           static_cast<float>(bodies[n].size * (upper + fore) - own_upper)};
    }
}

swivel::Streams streams_of(std::vector<BodyArm>& arms)
{
    swivel::Streams streams;
    streams.in(SWIVEL_TARGET, swivel::stream(arms, &BodyArm::target));
    streams.in(SWIVEL_POLE, swivel::stream(arms, &BodyArm::pole));
    streams.in(SWIVEL_SHOULDER_POSITION, swivel::stream(arms, &BodyArm::shoulder_place));
    streams.in(SWIVEL_PARENT_ROTATION, swivel::stream(arms, &BodyArm::parent));
    streams.in(SWIVEL_HAND, swivel::stream(arms, &BodyArm::hand));
    streams.in(SWIVEL_LENGTHS, swivel::stream(arms, &BodyArm::lengths));
    streams.out(SWIVEL_SHOULDER, swivel::stream(arms, &BodyArm::shoulder));
    streams.out(SWIVEL_ELBOW, swivel::stream(arms, &BodyArm::elbow));
    streams.out(SWIVEL_WRIST, swivel::stream(arms, &BodyArm::wrist));
    return streams;
}

struct Errors {
    double wrist = 0, hand = 0;  // in arm lengths; between quaternions, half the angle in radians
};

// By forward kinematics of the rotations, as whoever plays them has it.
void measure(const swivel::Crowd& crowd, const std::array<std::vector<BodyArm>, 2>& arms, Errors& errors)
{
    for (std::uint32_t side = 0; side < 2; ++side) {
        std::vector<double> off(arms[side].size());
        std::vector<std::array<double, 4>> hands(arms[side].size());
        crowd.residuals(side, off);
        crowd.hands(side, hands);
        errors.wrist = std::max(errors.wrist, *std::ranges::max_element(off));
        for (std::size_t n = 0; n < hands.size(); ++n) {
            const Quaterniond hand(hands[n].data()),
                wanted = Eigen::Quaternionf(arms[side][n].hand.data()).cast<double>();
            errors.hand = std::max(errors.hand, (hand.conjugate() * wanted.normalized()).vec().norm());
        }
    }
}

int replay(const char* path, std::size_t body_count)
{
    const Clip clip = swivel::formats::read_bvh(path).clip;
    const std::vector<Body> bodies = make_bodies(body_count, clip.frame_count);
    std::array<std::vector<Source>, 2> sources;
    std::array<std::vector<BodyArm>, 2> arms;
    std::array<swivel_limb_def, 2> groups;  // left arms, right arms: a group shares how its joints lie at rest
    for (std::size_t side = 0; side < 2; ++side) {
        const Arm arm = find_arm(clip, kSides[side]);
        sources[side] = sources_of(clip, arm);
        groups[side] =
            swivel::limbs(static_cast<std::uint32_t>(body_count), SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND);
        groups[side].binding = bind_arm(clip, arm);
        arms[side].resize(body_count);
        set_lengths(arms[side], bodies, groups[side].binding.lengths);
    }
    swivel::Crowd crowd({groups[0], groups[1]});
    const swivel::Streams left = streams_of(arms[0]), right = streams_of(arms[1]);

    const auto step = static_cast<std::size_t>(std::max(1.0, std::round(1 / (30 * clip.frame_time))));  // 30 a second
    std::size_t played = 0;
    double seconds = 0;
    Errors errors;
    for (std::size_t frame = 0; frame < clip.frame_count; frame += step, ++played) {
        for (std::size_t side = 0; side < 2; ++side) set_frame(arms[side], bodies, sources[side], frame);
        const auto start = std::chrono::steady_clock::now();
        crowd.solve({.streams = {left, right}});
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        measure(crowd, arms, errors);
    }
    std::printf("%zu frames on %zu bodies, %.3f ms a frame\n", played, body_count,
                seconds / static_cast<double>(played) * 1e3);
    std::printf("wrists within %.7f of the arm's length, hands within %.7f rad\n", errors.wrist, 2 * errors.hand);
    return errors.wrist < 1e-5 && errors.hand < 1e-5 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv)
{
    const long body_count = argc > 2 ? std::strtol(argv[2], nullptr, 10) : 1'000;
    if (argc < 2 || argc > 3 || body_count < 1 || body_count > 1'000'000) {
        std::fprintf(stderr, "usage: replay CLIP.bvh [BODIES], 1 to 1000000\n");
        return 2;
    }
    try {
        return replay(argv[1], static_cast<std::size_t>(body_count));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
