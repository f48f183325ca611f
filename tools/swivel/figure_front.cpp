// SPDX-License-Identifier: MIT
#include "tools/swivel/figure_front.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <vector>

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
Toes toes_of(const Clip& clip, std::span<const JointPose> pose_w, int foot)
{
    const auto step = [&](int joint) -> Vector3d {
        return pose_w[static_cast<std::size_t>(joint)].position - pose_w[static_cast<std::size_t>(foot)].position;
    };
    const std::vector<int> below = formats::child_joints(clip, foot);
    Toes toes;
    for (const int joint : below) {
        if (!speaks_of_toes(formats::joint_at(clip, joint).name)) continue;
        toes.direction += step(joint).normalized();
        ++toes.count;
        toes.named = true;
    }
    if (!toes.named && below.size() == 1) toes = {step(below[0]).normalized(), 1, false};
    return toes;
}

// The joint that both hang on, or -1.
int fork_of(const Clip& clip, int a, int b)
{
    while (a != b) {
        int& later = a > b ? a : b;  // parents come before their children
        later = formats::joint_at(clip, later).parent;
    }
    return a;
}

// `v` without its part along `axis`, unit; nothing where little is left.
std::optional<Vector3d> across(const Vector3d& v, const Vector3d& axis)
{
    const Vector3d rest = v - v.dot(axis) * axis;
    if (!(rest.norm() > 0.1 * v.norm())) return std::nullopt;
    return rest.normalized();
}

// A figure's limbs at rest, in the world.
struct RestingFigure {
    const Clip& clip;
    const std::array<std::optional<LimbJoints>, 4>& joints;
    std::vector<JointPose> pose_w = formats::rest_pose(clip);

    bool has_pair(std::size_t left) const { return joints[left] && joints[left + 1]; }
    int joint(std::size_t limb, std::size_t part) const { return (*joints[limb])[part]; }
    const Vector3d& place(int joint) const { return pose_w[static_cast<std::size_t>(joint)].position; }
    const Vector3d& place(std::size_t limb, std::size_t part) const { return place(joint(limb, part)); }
    double upper_length(std::size_t limb) const { return (place(limb, 1) - place(limb, 0)).norm(); }

    // From the nearest joint above `below` that is farther than `far` from a place, to that place.
    Vector3d step_from_above(int below, const Vector3d& to, double far) const
    {
        for (int up = below; up >= 0; up = formats::joint_at(clip, up).parent)
            if ((to - place(up)).norm() > far) return to - place(up);
        return Vector3d::Zero();
    }

    // Whether a step that should point up points more than 60 degrees elsewhere; one of no length says nothing.
    static bool is_off_up(const Vector3d& step) { return step.y() < 0.5 * step.norm(); }

    // What speaks against the file's +Y as up, where no pair of legs tells it.
    std::string doubt_up() const
    {
        const char* doubt = "what it hangs on does not stand along the file's +Y";
        if (has_pair(0)) {
            const Vector3d middle = (place(0, 0) + place(1, 0)) / 2;
            const double half = (place(0, 0) - middle).norm();
            const int fork = fork_of(clip, joint(0, 0), joint(1, 0));
            return is_off_up(step_from_above(fork, middle, half)) ? doubt : "";
        }
        for (const std::size_t arm : {0u, 1u})
            if (joints[arm] && is_off_up(step_from_above(joint(arm, 0), place(arm, 0), upper_length(arm))))
                return doubt;
        for (const std::size_t leg : {2u, 3u})
            if (joints[leg] && is_off_up(place(leg, 0) - place(leg, 2))) return "it does not stand along the file's +Y";
        return "";
    }

    // What speaks against the file's +Z as the front, where no pair tells it: a left limb is to the left.
    std::string doubt_front() const
    {
        for (std::size_t limb = 0; limb < 4; ++limb) {
            if (!joints[limb]) continue;
            const Vector3d step = step_from_above(joint(limb, 0), place(limb, 0), 0.1 * upper_length(limb));
            const double out = std::hypot(step.x(), step.z()), to_its_side = limb % 2 == 0 ? step.x() : -step.x();
            if (out > 0.1 * step.norm() && to_its_side < 0.5 * out)
                return "it is not on its side of a figure that faces the file's +Z";
        }
        return "";
    }
};

}  // namespace

Front figure_front(const Clip& clip, const std::array<std::optional<LimbJoints>, 4>& joints)
{
    const RestingFigure figure{clip, joints};
    const bool arms = figure.has_pair(0), legs = figure.has_pair(2);
    const auto place = [&](std::size_t limb, std::size_t part) { return figure.place(limb, part); };
    Front front;
    Vector3d up = Vector3d::Zero();
    if (arms && legs) up = place(0, 0) + place(1, 0) - place(2, 0) - place(3, 0);
    front.up_source = "hips to shoulders";
    if (legs && !(up.norm() > 0)) {
        up = place(2, 0) + place(3, 0) - place(2, 2) - place(3, 2);
        front.up_source = "the legs";
    }
    if (up.norm() > 0) {
        front.up = up.normalized();
    } else {
        front.up_source = Front().up_source;
        front.doubt = figure.doubt_up();
    }
    if (!arms && !legs) {
        if (front.doubt.empty()) front.doubt = figure.doubt_front();
        return front;
    }

    const std::size_t pair = arms ? 0 : 2;
    const Vector3d left = place(pair, 0) - place(pair + 1, 0);
    const int fork = fork_of(clip, figure.joint(pair, 0), figure.joint(pair + 1, 0));
    const bool mirrored = fork >= 0 && figure.pose_w[static_cast<std::size_t>(fork)].mirrored;
    const auto level = across(mirrored ? Vector3d(-left) : left, front.up);
    const Vector3d by_pair = level ? Vector3d(level->cross(front.up)) : Vector3d(Vector3d::Zero());
    if (legs) {
        Toes both;
        for (const std::size_t leg : {2u, 3u}) {
            const Toes toes = toes_of(clip, figure.pose_w, figure.joint(leg, 2));
            both.direction += toes.direction;
            both.count += toes.count;
            both.named = both.named || toes.named;
        }
        // A foot's only joint without a name may be its heel, or hold a shoe; a bird's toes point both ways. They tell
        // within 60 degrees of the pair, or, by name, of its back: a figure whose mirror is baked into its joints.
        const bool agree_on_one = both.direction.norm() > 0.25 * both.count;
        const auto ahead = agree_on_one ? across(both.direction, front.up) : std::nullopt;
        const double agree = ahead && level ? ahead->dot(by_pair) : 1;
        if (ahead && (agree > 0.5 || (both.named && agree < -0.5))) {
            front.forwards = *ahead;
            front.source = "the toes";
            return front;
        }
    }
    if (!level) {
        front.doubt = fmt::format("its {} lie above each other", arms ? "shoulders" : "hips");
        return front;
    }
    front.forwards = by_pair;
    front.source = arms ? "left and right shoulder" : "left and right hip";
    if (mirrored && front.doubt.empty())
        front.doubt = "without toes the mirror above it leaves open whether left and right are exchanged";
    return front;
}

}  // namespace swivel::tools
