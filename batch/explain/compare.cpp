// SPDX-License-Identifier: MIT
//
// Reads the pose as a solve does, then with one mistake after the other. The mistake that makes the places agree is the
// cause.
#include "batch/explain/compare.h"

namespace swivel {

Text& Causes::add(const LimbPlaces& ours)
{
    if (count++ > 0) text.add(" Or: ");
    off = limb.in_lengths(limb.worst(ours));
    return text;
}

Text& Causes::add_unsure()
{
    if (count++ > 0) text.add(" Or: ");
    is_sure = false;
    return text;
}

bool Causes::guess(const LimbPlaces& ours, const char* sentence)
{
    if (!limb.agrees(ours)) return false;
    add(ours).add("%s", sentence);
    return true;
}

bool Causes::guess(bool is_possible, const Mistake& mistake)
{
    if (!is_possible) return false;
    Reading how = limb.as_given;
    mistake.make(how);
    return guess(limb.places(limb.joints, how), mistake.sentence);
}

namespace {

// Another handedness, or another axis that points up.
void guess_axes(Causes& causes)
{
    struct Axes {
        int from[3], sign[3];
        const char* sentence;
    };
    constexpr const char* left =
        "The places are mirrored: one side of the two is left-handed. Give both in right-handed axes.";
    constexpr const char* up =
        "The places have y and z exchanged: one side has y up, the other z. Give both in the same axes.";
    constexpr Axes all[] = {{{0, 1, 2}, {-1, 1, 1}, left}, {{0, 1, 2}, {1, -1, 1}, left}, {{0, 1, 2}, {1, 1, -1}, left},
                            {{0, 2, 1}, {1, 1, 1}, up},    {{0, 2, 1}, {1, -1, 1}, up},   {{0, 2, 1}, {1, 1, -1}, up}};
    for (const Axes& axes : all) {
        const auto turn = [&](const Vector<double>& v) {
            return vector(axes.sign[0] * v.c[axes.from[0]], axes.sign[1] * v.c[axes.from[1]],
                          axes.sign[2] * v.c[axes.from[2]]);
        };
        if (causes.guess(moved(causes.limb.posed, turn), axes.sentence)) return;
    }
}

// Names mistakes that exist though the places agree. Returns whether there are none.
bool confirm(Causes& causes)
{
    if (guess_turns_in_body(causes) || doubt(causes)) return false;
    const double off = causes.limb.worst(causes.limb.posed);
    causes.text.add(
        "The pose agrees: it has shoulder, elbow and wrist within %.2g of your places, %.2g of the limb's length.", off,
        causes.limb.in_lengths(off));
    return true;
}

void explain_difference(Causes& causes)
{
    guess_rotations(causes);
    guess_joints(causes);
    guess_lengths(causes);
    guess_root(causes);
    if (causes.count == 0) guess_root_numbers(causes);
    guess_axes(causes);
    if (causes.count == 0) guess_no_root(causes);
    if (causes.count == 0) {
        if (!guess_strides(causes)) describe_difference(causes.limb, causes.text);
    } else if (causes.is_sure && causes.count == 1) {
        causes.text.add(" With that the three places agree, within %.2g of the limb's length.", causes.off);
    } else if (causes.is_sure) {
        causes.text.add(" With each of these the three places agree.");
    }
}

}  // namespace

bool compare(const swivel_crowd& crowd, std::uint32_t group, std::uint32_t body, const swivel_pose& pose,
             const LimbPlaces& places, std::span<char> room)
{
    Text text(room);
    const ComparedLimb limb{crowd, group, pose, places, {crowd, pose, body}};
    Causes causes{limb, text};
    if (limb.agrees(limb.posed)) return confirm(causes);
    explain_difference(causes);
    return false;
}

}  // namespace swivel
