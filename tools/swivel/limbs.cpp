// SPDX-License-Identifier: MIT
#include "tools/swivel/limbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>

#include "tools/formats/error.h"
#include "tools/swivel/limb_words.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;
using formats::Clip;
using formats::InputError;
using formats::LimbKind;
using formats::Side;

bool share_a_joint(const Limb& a, const Limb& b)
{
    return std::find_first_of(a.joints.begin(), a.joints.end(), b.joints.begin(), b.joints.end()) != a.joints.end();
}

// Reads what the user named for limbs of one kind.
struct NameReader {
    const Clip& clip;
    const std::filesystem::path& file;
    const LimbWords& words;
    std::string_view option;

    int joint(std::string_view name) const
    {
        const std::vector<int> found = formats::find_joints(clip, name);
        if (found.empty())
            throw InputError(file, fmt::format("no joint is called '{}' ({}); its joints are listed by its HIERARCHY",
                                               name, option));
        if (found.size() > 1)
            throw InputError(file, fmt::format("{} joints are called '{}' ({}); name one by its path, such as {}",
                                               found.size(), name, option, formats::joint_path(clip, found[0])));
        return found[0];
    }

    Limb limb(LimbKind kind, std::string_view text, Side otherwise) const
    {
        std::optional<Side> side;
        for (const Side each : {Side::left, Side::right}) {
            const std::string prefix = fmt::format("{}:", side_name(each));
            if (!text.starts_with(prefix)) continue;
            side = each;
            text.remove_prefix(prefix.size());
        }
        const std::size_t first = text.find(','), second = text.find(',', first + 1);
        if (first == std::string_view::npos || second == std::string_view::npos ||
            text.find(',', second + 1) != std::string_view::npos)
            throw InputError(file,
                             fmt::format("{} '{}' does not name three joints; write {}", option, text, words.joints));
        const std::string_view name = text.substr(0, first);
        Limb limb;
        limb.name = {kind, side ? *side : side_of(name, otherwise)};
        limb.joints = {joint(name), joint(text.substr(first + 1, second - first - 1)), joint(text.substr(second + 1))};
        if (!is_chain(clip, limb.joints))
            throw InputError(
                file, fmt::format("{} '{}' does not name a joint, its child and its child's child", option, text));
        return limb;
    }
};

// The limbs of one kind: those named, or those that habit gives.
std::vector<Limb> limbs_of(const Clip& clip, const std::filesystem::path& file, LimbKind kind,
                           std::span<const NamedLimb> names)
{
    const LimbWords& words = words_of(kind);
    std::vector<Limb> limbs;
    for (const NamedLimb& named : names) {
        const NameReader reader{clip, file, words, named.option};
        limbs.push_back(reader.limb(kind, named.joints, limbs.empty() ? Side::left : Side::right));
    }
    if (names.empty())
        for (const Side side : {Side::left, Side::right})
            if (const std::optional<LimbJoints> joints = joints_by_habit(clip, {kind, side})) {
                limbs.emplace_back().name = {kind, side};
                limbs.back().joints = *joints;
            }
    if (limbs.empty())
        throw InputError(file, fmt::format("no {} found by the usual joint names; name them with {} {}", words.limbs,
                                           words.option, words.joints));
    if (limbs.size() > 2)
        throw InputError(
            file, fmt::format("{} was given more than twice; a character has two {}", words.option, words.limbs));
    if (limbs.size() == 2 && limbs[0].name == limbs[1].name)
        throw InputError(file, fmt::format("both {} are taken as {}; write {} left:... and {} right:...", words.limbs,
                                           side_name(limbs[0].name.side), words.option, words.option));
    return limbs;
}

Vector3d offset(const Clip& clip, int joint) { return clip.joints[static_cast<std::size_t>(joint)].offset; }

// The axis that elbow or knee turn about in this clip, in the upper joint's frame. A bent limb shows it; BVH rests are
// straight, so it is the mean over the frames, each counting by the sine of its bend. A clip that never bends the limb
// gets the axis that carries a forearm forwards, a shin backwards, on a figure facing +Z.
void choose_hinge(const Clip& clip, Limb& limb)
{
    const Vector3d upper = limb.upper_bone, lower = offset(clip, limb.end()).normalized();
    Vector3d sum = Vector3d::Zero();
    double weight = 0;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const Eigen::Quaterniond& turn =
            clip.rotation[frame * clip.joints.size() + static_cast<std::size_t>(limb.lower())];
        const Vector3d bend = (turn * lower).cross(upper);
        sum += bend;
        weight += bend.norm();
    }
    // 0.02: a mean bend of one degree; half: the bends must agree on an axis, not cancel.
    if (weight > 0.02 * static_cast<double>(clip.frame_count) && sum.norm() > 0.5 * weight) {
        limb.hinge = sum.normalized();
        limb.hinge_source = "mean bend of the clip";
        return;
    }
    const Vector3d forwards = Vector3d::UnitZ();
    limb.hinge = (limb.name.kind == LimbKind::arm ? forwards : Vector3d(-forwards)).cross(upper);
    if (limb.hinge.norm() < 0.1) limb.hinge = Vector3d::UnitX();
    limb.hinge.normalize();
    limb.hinge_source = "facing +Z, as the clip shows no bend";
}

void store(const Vector3d& v, float (&to)[3])
{
    for (int n = 0; n < 3; ++n) to[n] = static_cast<float>(v[n]);
}

void bind_limb(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice, Limb& limb)
{
    limb.upper_bone = offset(clip, limb.lower()).normalized();
    choose_hinge(clip, limb);
    for (const GivenHinge& given : choice.hinges)
        if (given.limb == limb.name) {
            const Vector3d& upper = limb.upper_bone;
            if (given.axis.cross(upper).norm() < 0.1)  // about 6 degrees: no one means that
                throw InputError(file,
                                 fmt::format("the {}'s hinge, {}, is along its upper bone ({:.3f} {:.3f} {:.3f}), "
                                             "which does not bend that way",
                                             plain_name(limb.name), given.where, upper.x(), upper.y(), upper.z()));
            limb.hinge = given.axis;
            limb.hinge_source = given.where;
        }
    swivel_chain chain{};
    chain.shoulder_rotation[3] = chain.elbow_rotation[3] = chain.wrist_rotation[3] = 1;  // a BVH rests without rotation
    store(offset(clip, limb.lower()), chain.elbow_offset);
    store(offset(clip, limb.end()), chain.wrist_offset);
    store(limb.hinge, chain.hinge);
    try {
        limb.bound = bind(chain);
    } catch (const Error& error) {
        throw InputError(file, fmt::format("the {} cannot be bound: {}", plain_name(limb.name), error.what()));
    }
}

bool is_chosen(const LimbChoice& choice, LimbKind kind)
{
    if (!choice.kinds.empty()) return choice.kinds == "all" || choice.kinds == words_of(kind).limbs;
    if (choice.arms.empty() && choice.legs.empty()) return kind == LimbKind::arm;
    return !(kind == LimbKind::arm ? choice.arms : choice.legs).empty();
}

}  // namespace

std::vector<Limb> find_limbs(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice)
{
    std::vector<Limb> limbs;
    for (const LimbKind kind : {LimbKind::arm, LimbKind::leg})
        if (is_chosen(choice, kind))
            for (Limb& limb : limbs_of(clip, file, kind, kind == LimbKind::arm ? choice.arms : choice.legs))
                limbs.push_back(std::move(limb));
    for (std::size_t a = 0; a < limbs.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (share_a_joint(limbs[a], limbs[b]))
                throw InputError(file, fmt::format("the {} and the {} share a joint; each needs three of its own ({})",
                                                   plain_name(limbs[b].name), plain_name(limbs[a].name),
                                                   words_of(limbs[a].name.kind).option));
    for (Limb& limb : limbs) bind_limb(clip, file, choice, limb);
    return limbs;
}

}  // namespace swivel::tools
