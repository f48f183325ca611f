// SPDX-License-Identifier: MIT
// Rollback, as in games over a network. The client guesses inputs, and the server's arrive ten frames late. The client
// then loads the state of the first frame that it guessed wrong, plays on from there, and has the server's bits.
#include <array>
#include <cstddef>
#include <cstdio>
#include <swivel/swivel_bodies.hpp>
#include <vector>

using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;  // a rotation: x, y, z, w

constexpr int kBodies = 100, kChange = 90, kLate = 10;  // the last two in frames

// Bodies look with two joints, a chest and a head. These turn slowly, so each frame starts from the directions that the
// frame before has left. Where the bodies look is their state.
swivel::Crowd make_crowd()
{
    const std::int32_t parents[] = {-1, 0};
    const float places[][3] = {{0, 1.2f, 0}, {0, 0.3f, 0}};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(parents);
    skeleton.translations = swivel::stream(places);
    skeleton.joint_count = 2;
    swivel_look_def look = swivel::look({0, 1});
    look.rate = 1;  // radians a second
    return swivel::Crowd(skeleton, kBodies, {look});
}

// All bodies look at a thing that passes by. In frame kChange it rises, which the client does not know at first.
Float3 input(int frame, bool is_known)
{
    const bool is_up = is_known && frame >= kChange;
    return {0.2f * static_cast<float>(frame % 40 - 20), is_up ? 5.0f : 1.5f, 4};
}

using Poses = std::vector<std::array<Float4, 2>>;  // rotations of two joints

Poses play(swivel::Crowd& crowd, const Float3& target)
{
    Poses poses(kBodies, {{{0, 0, 0, 1}, {0, 0, 0, 1}}});  // your animation writes them
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {poses.data(), sizeof poses[0], sizeof(Float4), nullptr};
    const float time = 1.0f / 60;  // a tick's length, not a clock's
    pose.time = {&time, 0};
    swivel::Streams looks;
    looks.in(SWIVEL_LOOK_TARGET, {&target, 0});  // one value for all
    crowd.solve({.streams = {looks}, .pose = &pose});
    return poses;
}

int main()
{
    swivel::Crowd server = make_crowd(), client = make_crowd();
    std::vector<std::byte> states[kLate];  // a ring: the client's, before each of the last frames
    for (auto& each : states) each.resize(kBodies * swivel_state_bytes(client.get()));
    Poses served, seen;  // of the last frame
    for (int frame = 0; frame < kChange + kLate; ++frame) {
        client.save(states[frame % kLate]);
        served = play(server, input(frame, true));
        seen = play(client, input(frame, false));
    }
    const auto compare = [&](const char* name) {
        const bool is_equal = seen == served && client.state_digest() == server.state_digest();
        std::printf("%s: %s\n", name, is_equal ? "the server's bits" : "other bits");
    };
    compare("guessed");
    // [rollback]
    client.load(states[kChange % kLate]);
    for (int frame = kChange; frame < kChange + kLate; ++frame) {
        client.save(states[frame % kLate]);  // until now this was the state that followed a guess
        seen = play(client, input(frame, true));
    }
    // [end]
    compare("rolled back");
}
