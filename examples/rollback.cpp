// SPDX-License-Identifier: MIT
// Rollback, as in games over a network. A client plays on with inputs that it guesses. The server's inputs come ten
// frames late: some heads have turned to something else. The client loads the state of that frame and plays ten frames
// again, so its bodies are the server's to the bit. A late visitor loads the state into a new crowd.
#include <array>
#include <cstddef>
#include <cstdio>
#include <swivel/swivel_bodies.hpp>
#include <vector>

namespace {

constexpr std::uint32_t kBodies = 100;
constexpr int kTurn = 90, kLate = 10;  // frames
enum Joint : std::uint32_t { PELVIS, CHEST, HEAD, THIGH, SHIN, FOOT, JOINTS };
constexpr std::int32_t kParents[JOINTS] = {-1, PELVIS, CHEST, PELVIS, THIGH, SHIN};
constexpr float kOffsets[JOINTS][3] = {{0, 0.9f, 0}, {0, 0.3f, 0},       {0, 0.3f, 0},
                                       {0.1f, 0, 0}, {0, -0.45f, 0.05f}, {0, -0.42f, -0.05f}};

struct Input {  // of a body in a frame: all that a solve takes, beside its pose
    std::array<float, 3> root, target;
    float contact;
};
using Frame = std::vector<Input>;
using Poses = std::vector<std::array<std::array<float, 4>, JOINTS>>;  // x, y, z, w of each joint

swivel::Crowd make_crowd()
{
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = {kParents, sizeof kParents[0]};
    skeleton.translations = {kOffsets, sizeof kOffsets[0]};
    skeleton.joint_count = JOINTS;
    swivel_limb_joints leg = swivel_default_limb_joints(THIGH, SHIN, FOOT);
    leg.bend[2] = -1;
    return swivel::Crowd(
        skeleton, kBodies,
        {swivel::body_limb(leg, SWIVEL_WITH_PLANT | SWIVEL_POLE_INCOMING), swivel::look({CHEST, HEAD})});
}

// Everyone glides, stands with the foot now and then, and looks ahead. From kTurn on, if that is known, to the side.
Frame inputs(int frame, bool is_known)
{
    Frame made(kBodies);
    for (std::uint32_t n = 0; n < kBodies; ++n) {
        const float x = static_cast<float>(n), z = 0.01f * static_cast<float>(frame);
        const bool turns = is_known && frame >= kTurn && n % 3 == 0;
        made[n] = {{x, 0, z}, {turns ? x + 5 : x, 1.5f, turns ? z : z + 5}, (frame + 7 * n) % 60 < 40 ? 1.0f : 0.0f};
    }
    return made;
}

Poses play(swivel::Crowd& crowd, const Frame& frame)
{
    Poses poses(kBodies);  // a game's animation writes them
    for (auto& body : poses) body.fill({0, 0, 0, 1});
    const float time = 1.0f / 60;
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {poses.data(), sizeof poses[0], sizeof poses[0][0], nullptr};
    pose.root_position = swivel::stream(frame, &Input::root);
    pose.time = {&time, 0};
    swivel::Streams legs, looks;
    legs.in(SWIVEL_CONTACT, swivel::stream(frame, &Input::contact));
    looks.in(SWIVEL_LOOK_TARGET, swivel::stream(frame, &Input::target));
    crowd.solve({.streams = {legs, looks}, .pose = &pose});
    return poses;
}

const char* text(bool are_equal) { return are_equal ? "the server's bits" : "other bits"; }

}  // namespace

int main()
{
    swivel::Crowd server = make_crowd(), client = make_crowd(), visitor = make_crowd();
    const std::size_t body_bytes = swivel_state_bytes(server.get());
    std::vector<std::vector<std::byte>> states(kLate, std::vector<std::byte>(kBodies * body_bytes));  // a ring
    Poses truth, guess;
    for (int frame = 0; frame < kTurn + kLate; ++frame) {
        client.save(states[frame % kLate]);  // as it is before the frame
        truth = play(server, inputs(frame, true));
        guess = play(client, inputs(frame, false));
    }
    std::printf("guessed: %s\n", text(guess == truth));
    // [rollback]
    client.load(states[kTurn % kLate]);
    for (int frame = kTurn; frame < kTurn + kLate; ++frame) guess = play(client, inputs(frame, true));
    // [end]
    std::printf("rolled back: %s\n", text(guess == truth && client.state_digest() == server.state_digest()));
    server.save(states[0]);
    visitor.load(states[0]);
    const Frame next = inputs(kTurn + kLate, true);
    std::printf("a late visitor: %s, by %zu bytes a body\n", text(play(visitor, next) == play(server, next)),
                body_bytes);
}
