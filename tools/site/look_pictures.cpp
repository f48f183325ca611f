// SPDX-License-Identifier: MIT
//
// Draws the picture of docs/howto/look.md: how far swivel turns each joint while a target goes round the head.
#include <array>

#include "swivel/swivel.hpp"
#include "tools/site/picture.h"

namespace {

using Float3 = std::array<float, 3>;
using Float4 = std::array<float, 4>;

constexpr double kDegrees = 57.29577951308232;
constexpr std::size_t kJoints = 4;
constexpr const char* kNames[kJoints] = {"spine", "chest", "neck", "head"};
constexpr const char* kColours[kJoints] = {kPale, kGreen, kRed, kOrange};
constexpr float kShares[kJoints] = {1, 1, 2, 4}, kMost[kJoints] = {0.99f, 0.98f, 0.85f, 0.5f};

// The joints' turns for a target that is so many degrees to the side, 2 m away.
std::array<double, kJoints> turned(const swivel_look& look, double degrees)
{
    constexpr std::array<std::int32_t, kJoints> parents = {-1, 0, 1, 2};
    constexpr std::array<Float3, kJoints> offsets = {{{0, 1, 0}, {0, 0.2f, 0}, {0, 0.25f, 0}, {0, 0.1f, 0}}};
    swivel_skeleton skeleton = swivel_default_skeleton();
    skeleton.parents = swivel::stream(parents);
    skeleton.translations = swivel::stream(offsets);
    skeleton.joint_count = kJoints;
    swivel::Crowd crowd(skeleton, 1, std::array{swivel::look_group({0, 1, 2, 3}, look)});
    const double angle = degrees / kDegrees;
    crowd.write_all(SWIVEL_LOOK_TARGET, 0,
                    Float3{static_cast<float>(2 * std::sin(angle)), 1.55f, static_cast<float>(2 * std::cos(angle))});
    std::array<Float4, kJoints> rotations;
    rotations.fill({0, 0, 0, 1});
    swivel_pose pose = swivel_default_pose();
    pose.rotations = {rotations.data(), sizeof rotations, sizeof(Float4), nullptr};
    crowd.solve({.pose = &pose});
    std::array<double, kJoints> made;
    for (std::size_t n = 0; n < kJoints; ++n)
        made[n] = 2 * std::atan2(double{rotations[n][1]}, double{rotations[n][3]}) * kDegrees;
    return made;
}

std::string round_the_head()
{
    constexpr double left = 70, right = 730, bottom = 310, top = 50, most = 120;
    const auto at = [&](double target, double turn) {
        return Point{left + (right - left) * target / 180, bottom - (bottom - top) * turn / most};
    };
    swivel_look look = swivel_default_look();
    std::ranges::copy(kShares, look.share);
    std::ranges::copy(kMost, look.cos_most);
    look.rate = 0;
    std::array<std::vector<Point>, kJoints + 1> edges;  // each joint's turn on top of those before
    for (int target = 0; target <= 180; ++target) {
        const std::array<double, kJoints> degrees = turned(look, target);
        double sum = 0;
        edges[0].push_back(at(target, 0));
        for (std::size_t n = 0; n < kJoints; ++n) edges[n + 1].push_back(at(target, sum += degrees[n]));
    }
    Picture picture("How far each joint turns while the target goes round the head", 370);
    const double full = std::acos(double{look.cos_full}) * kDegrees, none = std::acos(double{look.cos_none}) * kDegrees;
    picture.box(at(full, 0), at(none, most), kPale, 0.2);
    picture.text({at((full + none) / 2, 0).x, top - 8}, "fades", kGrey, "middle");
    picture.line({at(0, 0), at(most, most)}, kPale, 1, "3 4");
    picture.text({at(82, 0).x, at(0, 97).y}, "to the target", kGrey, "end");
    for (std::size_t n = 0; n < kJoints; ++n) {
        std::vector<Point> area = edges[n];
        area.insert(area.end(), edges[n + 1].rbegin(), edges[n + 1].rend());
        picture.area(area, kColours[n], 0.35);
        picture.line(edges[n + 1], kColours[n], 2.5);
        const std::size_t middle = 60;
        picture.text({edges[n][middle].x, (edges[n][middle].y + edges[n + 1][middle].y) / 2 + 5}, kNames[n], kInk,
                     "middle");
    }
    picture.line({{left, top - 10}, {left, bottom}, {right, bottom}}, kInk, 2);
    for (const int degrees : {0, 45, 90, 135, 180}) {
        picture.text({at(degrees, 0).x, bottom + 22}, std::to_string(degrees).c_str(), kInk, "middle");
        if (degrees > 0 && degrees < most)
            picture.text({left - 8, at(0, degrees).y + 5}, std::to_string(degrees).c_str(), kInk, "end");
    }
    picture.text({right, bottom + 46}, "degrees between the target and ahead", kInk, "end");
    picture.text({left + 8, top - 8}, "degrees turned", kInk);
    return picture.done();
}

}  // namespace

std::vector<NamedPicture> look_pictures() { return {{"look_round.svg", round_the_head()}}; }
