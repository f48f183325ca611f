// SPDX-License-Identifier: MIT
#include "tools/rig/figure_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "tools/rig/limb_words.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::JointPose;

bool speaks_of_toes(std::string name)
{
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    return name.find("toe") != std::string::npos || name.find("ball") != std::string::npos;
}

// Where a foot points: to the joints below it that are called toe or ball, else to the only one.
struct Toes {
    Vector3d direction = Vector3d::Zero();  // in the world: the sum of unit steps to them
    int count = 0;
    bool named = false;
};

// The joint that both hang on, or -1.
int fork_of(const Clip& clip, int a, int b)
{
    while (a != b) {
        int& later = a > b ? a : b;  // parents come before their children
        later = formats::joint_at(clip, later).parent;
    }
    return a;
}

// A figure's limbs at rest, in the world. Limbs are counted as in formats::kLimbNames: a pair starts at 0 or 2.
struct RestingFigure {
    const Clip& clip;
    const std::array<std::optional<LimbJoints>, 4>& joints;
    std::vector<JointPose> pose_w = formats::rest_pose(clip);

    bool has_pair(std::size_t left) const { return joints[left] && joints[left + 1]; }
    int joint(std::size_t limb, std::size_t part) const { return (*joints[limb])[part]; }
    const Vector3d& place(int joint) const { return pose_w[static_cast<std::size_t>(joint)].position; }
    const Vector3d& place(std::size_t limb, std::size_t part) const { return place(joint(limb, part)); }
    double upper_length(std::size_t limb) const { return (place(limb, 1) - place(limb, 0)).norm(); }

    // Of a pair.
    int fork(std::size_t left) const { return fork_of(clip, joint(left, 0), joint(left + 1, 0)); }
    Vector3d middle(std::size_t left, std::size_t part) const
    {
        return (place(left, part) + place(left + 1, part)) / 2;
    }
    double leg_length() const
    {
        return (upper_length(2) + upper_length(3) + (place(2, 2) - place(2, 1)).norm() +
                (place(3, 2) - place(3, 1)).norm()) /
               2;
    }

    // From the nearest joint above `below` that is farther than `far` from a place, to that place.
    Vector3d step_from_above(int below, const Vector3d& to, double far) const
    {
        for (int up = below; up >= 0; up = formats::joint_at(clip, up).parent)
            if ((to - place(up)).norm() > far) return to - place(up);
        return Vector3d::Zero();
    }

    Toes toes(std::size_t leg) const
    {
        const int foot = joint(leg, 2);
        const auto step = [&](int toe) -> Vector3d { return (place(toe) - place(foot)).normalized(); };
        const std::vector<int> below = formats::child_joints(clip, foot);
        Toes found;
        for (const int toe : below) {
            if (!speaks_of_toes(formats::joint_at(clip, toe).name)) continue;
            found.direction += step(toe);
            ++found.count;
            found.named = true;
        }
        if (!found.named && below.size() == 1) found = {step(below[0]), 1, false};
        return found;
    }
    bool has_named_toes() const  // on each foot that has any
    {
        const auto is_named = [](const Toes& toes) { return toes.named || toes.count == 0; };
        return is_named(toes(2)) && is_named(toes(3));
    }
};

bool are_apart(const Vector3d& a, const Vector3d& b) { return degrees_between(a, b) > 60; }

// ---- up: from hips to shoulders, else along the legs

// What speaks against the file's +Y, where nothing else is known.
std::string doubt_of_y(const RestingFigure& figure)
{
    const auto of = [](std::size_t limb) { return plain_name(formats::kLimbNames[limb]); };
    if (figure.has_pair(0)) {
        const Vector3d middle = figure.middle(0, 0);
        const double half = (figure.place(0, 0) - middle).norm();
        const Vector3d trunk = figure.step_from_above(figure.fork(0), middle, half);
        return are_apart(trunk, Vector3d::UnitY()) ? "the trunk does not stand along the file's +Y" : "";
    }
    for (const std::size_t arm : {0u, 1u}) {
        if (!figure.joints[arm]) continue;
        const Vector3d& shoulder = figure.place(arm, 0);
        const Vector3d step = figure.step_from_above(figure.joint(arm, 0), shoulder, figure.upper_length(arm));
        if (are_apart(step, Vector3d::UnitY()))
            return fmt::format("what the {} hangs on does not stand along the file's +Y", of(arm));
    }
    for (const std::size_t leg : {2u, 3u})
        if (figure.joints[leg] && are_apart(figure.place(leg, 0) - figure.place(leg, 2), Vector3d::UnitY()))
            return fmt::format("the {} does not stand along the file's +Y", of(leg));
    return "";
}

void tell_up(const RestingFigure& figure, Front& front)
{
    Vector3d trunk = Vector3d::Zero(), legs = Vector3d::Zero();  // zero: too short to tell
    if (figure.has_pair(2)) {
        const double length = figure.leg_length();
        legs = figure.middle(2, 0) - figure.middle(2, 2);
        if (legs.norm() < 0.3 * length) legs.setZero();  // it kneels
        if (figure.has_pair(0)) trunk = figure.middle(0, 0) - figure.middle(2, 0);
        if (trunk.norm() < 0.1 * length) trunk.setZero();
        const int fork = figure.has_pair(0) ? fork_of(figure.clip, figure.fork(0), figure.fork(2)) : figure.fork(2);
        // 0.75: a root on the floor is a leg below, a pelvis and MikuMikuDance's centre a quarter.
        if (fork < 0)
            front.doubt = "the limbs do not hang on one trunk";
        else if ((figure.place(fork) - figure.middle(2, 0)).norm() > 0.75 * length)
            front.doubt = "the joint that all limbs hang on is far from the hips";
    }
    if (!trunk.isZero(0) && !legs.isZero(0) && are_apart(trunk, legs))
        front.doubt = "the trunk does not stand on the legs";
    if (trunk.isZero(0) && legs.isZero(0)) {
        if (front.doubt.empty()) front.doubt = doubt_of_y(figure);
        return;
    }
    front.up = (trunk.isZero(0) ? legs : trunk).normalized();
    front.up_source = trunk.isZero(0) ? "the legs" : "hips to shoulders";
}

// ---- forwards: across shoulders and hips, and where the toes point; all that tell must agree

// `v` without its part along up, unit; nothing where it is steeper than 60 degrees.
std::optional<Vector3d> level(const Vector3d& v, const Vector3d& up)
{
    const Vector3d rest = v - v.dot(up) * up;
    if (!(rest.norm() > 0.5 * v.norm())) return std::nullopt;
    return rest.normalized();
}

// From right to left and up, mirrors considered; nothing from joints too close to each other, or one above the other.
std::optional<Vector3d> across_pair(const RestingFigure& figure, std::size_t pair, const Vector3d& up)
{
    if (!figure.has_pair(pair)) return std::nullopt;
    const int fork = figure.fork(pair);
    const Vector3d left = figure.place(pair, 0) - figure.place(pair + 1, 0);
    const double least = 0.25 * (figure.upper_length(pair) + figure.upper_length(pair + 1)) / 2;
    const auto side = level(left, up);
    if (fork < 0 || !side || left.norm() < least) return std::nullopt;
    const bool mirrored = figure.pose_w[static_cast<std::size_t>(fork)].mirrored;
    return Vector3d((mirrored ? Vector3d(-*side) : *side).cross(up));
}

// Where both feet point. A foot's only joint, not called toe, may be its heel, or hold a shoe, so it must agree with
// `ahead`; a bird's toes point both ways and tell nothing.
std::optional<Vector3d> across_toes(const RestingFigure& figure, const Vector3d& up,
                                    const std::optional<Vector3d>& ahead)
{
    if (!figure.has_pair(2)) return std::nullopt;
    const Toes left = figure.toes(2), right = figure.toes(3);
    const Vector3d both = left.direction + right.direction;
    if (!(both.norm() > 0.25 * (left.count + right.count))) return std::nullopt;
    const auto way = level(both, up);
    if (!way || (!figure.has_named_toes() && (!ahead || are_apart(*way, *ahead)))) return std::nullopt;
    return way;
}

// The file's +Z, where there is no pair: a left limb is to the left.
std::string doubt_of_z(const RestingFigure& figure)
{
    bool is_told = false;
    for (std::size_t limb = 0; limb < 4; ++limb) {
        if (!figure.joints[limb]) continue;
        const std::string name = plain_name(formats::kLimbNames[limb]);
        const int parent = formats::joint_at(figure.clip, figure.joint(limb, 0)).parent;
        if (parent >= 0 && figure.pose_w[static_cast<std::size_t>(parent)].mirrored)
            return fmt::format("the mirror above the {} leaves open whether left and right are exchanged", name);
        const double far = 0.1 * figure.upper_length(limb);
        const Vector3d own_side = limb % 2 == 0 ? Vector3d::UnitX() : Vector3d(-Vector3d::UnitX());
        const Vector3d to = figure.step_from_above(figure.joint(limb, 0), figure.place(limb, 0), far);
        const Vector3d along = figure.place(limb, 2) - figure.place(limb, 0);
        for (const Vector3d& step : {to, along}) {
            if (std::hypot(step.x(), step.z()) <= far) continue;
            if (are_apart({step.x(), 0, step.z()}, own_side))
                return fmt::format("the {} is not on its side of a figure that faces the file's +Z", name);
            is_told = true;
            break;
        }
    }
    return is_told ? "" : "nothing tells that the figure faces the file's +Z";
}

// A limb that is turned where its joint turns it about its own bone, too: no way to face says how it bends.
std::string doubt_of_turns(const RestingFigure& figure, const Front& front)
{
    for (std::size_t limb = 0; limb < 4; ++limb) {
        const std::size_t other = limb ^ 1;
        if (!figure.joints[limb] || !figure.joints[other]) continue;
        const std::string name = plain_name(formats::kLimbNames[limb]);
        const Vector3d along = figure.place(limb, 2) - figure.place(limb, 0);
        if (limb < 2) {
            const Vector3d out = figure.place(limb, 0) - figure.place(other, 0);
            if (out.norm() > 0.25 * figure.upper_length(limb) && degrees_between(along, out) > 120)
                return fmt::format("the {} crosses the body", name);
            continue;
        }
        if (figure.has_pair(0) && along.norm() > 0.3 * figure.leg_length() && are_apart(-along, front.up))
            return fmt::format("the {} stands off the trunk", name);
        const Toes toes = figure.toes(limb);
        const auto way = level(toes.direction, front.up);
        if (toes.named && toes.direction.norm() > 0.25 * toes.count && way &&
            degrees_between(*way, front.forwards) > 45)
            return fmt::format("the {}'s foot points aside", name);
    }
    return "";
}

void tell_forwards(const RestingFigure& figure, Front& front)
{
    const auto doubt = [&](const char* why) {
        if (front.doubt.empty()) front.doubt = why;
    };
    const auto shoulders = across_pair(figure, 0, front.up), hips = across_pair(figure, 2, front.up);
    const auto ahead = shoulders ? shoulders : hips;
    const auto toes = across_toes(figure, front.up, ahead);
    if (ahead) {
        front.forwards = *ahead;
        front.source = shoulders ? "left and right shoulder" : "left and right hip";
        front.is_told = true;
    }
    if (shoulders && hips && are_apart(*shoulders, *hips)) doubt("shoulders and hips face apart");
    const bool mirrored = ahead && figure.pose_w[static_cast<std::size_t>(figure.fork(shoulders ? 0 : 2))].mirrored;
    if (toes) {
        // Below a mirror left and right may be exchanged or not: the toes know.
        if (ahead && are_apart(*toes, *ahead) && !(mirrored && !are_apart(*toes, -*ahead)))
            doubt("the toes point otherwise than shoulders and hips face");
        front.forwards = *toes;
        front.source = "the toes";
        front.is_told = true;
        front.is_by_named_toes = figure.has_named_toes();
    } else if (!ahead) {
        front.forwards = level(front.forwards, front.up).value_or(front.up.unitOrthogonal());
        doubt("neither shoulders nor hips tell left from right");
    } else if (mirrored) {
        doubt("without toes the mirror above the figure leaves open whether left and right are exchanged");
    }
    if (front.doubt.empty()) front.doubt = doubt_of_turns(figure, front);
}

}  // namespace

Front figure_front(const Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints)
{
    Front front;
    if (std::none_of(joints.begin(), joints.end(), [](const auto& limb) { return limb.has_value(); })) return front;
    const RestingFigure figure{clip, joints};
    tell_up(figure, front);
    if (figure.has_pair(0) || figure.has_pair(2))
        tell_forwards(figure, front);
    else if (front.doubt.empty())
        front.doubt = doubt_of_z(figure);
    return front;
}

}  // namespace swivel::tools
