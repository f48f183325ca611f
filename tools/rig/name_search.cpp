// SPDX-License-Identifier: MIT
#include "tools/rig/name_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <unordered_map>

#include "tools/formats/printable.h"
#include "tools/rig/joint_names.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/name_table.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::LimbName;

constexpr std::size_t kMaxCandidates = 4;  // that a message lists

// A skeleton's joints by their plain names, without those of repeated figures.
struct NamedJoints {
    const Clip& clip;
    std::vector<std::string> names{};  // of each joint
    std::unordered_map<std::string, std::vector<int>> bearers{};

    const std::string& name(int joint) const { return names[static_cast<std::size_t>(joint)]; }
    bool is_bone(int joint) const { return joint_at(clip, joint).is_bone; }
    // In the clip's order. Bones alone, where any has that name.
    std::vector<int> named(const std::string& plain_name) const
    {
        const auto found = bearers.find(plain_name);
        if (found == bearers.end()) return {};
        std::vector<int> bones = found->second;
        std::erase_if(bones, [&](int joint) { return !is_bone(joint); });
        return bones.empty() ? found->second : bones;
    }
};

// One row with one side: the joints with its three names.
struct Attempt {
    std::array<std::string, 3> names;
    std::array<std::vector<int>, 3> bearers;

    auto borne() const
    {
        return std::count_if(bearers.begin(), bearers.end(), [](const auto& joints) { return !joints.empty(); });
    }
};

// Whether one of `which` is above it, for each joint. `which` counts only where `also` holds, unless that is empty.
std::vector<bool> have_above(const Clip& clip, const std::vector<int>& which, const std::vector<bool>& also)
{
    std::vector<bool> counts(clip.joints.size()), has(clip.joints.size());
    for (const int joint : which) counts[static_cast<std::size_t>(joint)] = true;
    for (std::size_t joint = 0; joint < has.size(); ++joint) {  // parents come before their children
        if (clip.joints[joint].parent < 0) continue;
        const auto up = static_cast<std::size_t>(clip.joints[joint].parent);
        has[joint] = has[up] || (counts[up] && (also.empty() || also[up]));
    }
    return has;
}

// All chains of an upper, a lower and an end joint, up to kMaxCandidates. It walks up only from joints that have such
// chains above them.
std::vector<LimbJoints> chains(const Clip& clip, const std::array<std::vector<int>, 3>& bearers)
{
    std::vector<LimbJoints> found;
    const std::vector<bool> have_upper = have_above(clip, bearers[0], {});
    const std::vector<bool> have_both = have_above(clip, bearers[1], have_upper);
    const auto is_in = [](const std::vector<int>& joints, int joint) {
        return std::binary_search(joints.begin(), joints.end(), joint);
    };
    for (const int end : bearers[2]) {
        if (!have_both[static_cast<std::size_t>(end)]) continue;
        for (int lower = joint_at(clip, end).parent; lower >= 0; lower = joint_at(clip, lower).parent) {
            if (!is_in(bearers[1], lower) || !have_upper[static_cast<std::size_t>(lower)]) continue;
            for (int upper = joint_at(clip, lower).parent; upper >= 0; upper = joint_at(clip, upper).parent) {
                if (is_in(bearers[0], upper)) found.push_back({upper, lower, end});
                if (found.size() == kMaxCandidates) return found;
            }
        }
    }
    return found;
}

// The names of the limb's upper and lower joints, in every row.
std::vector<std::string> own_names(LimbName limb)
{
    std::vector<std::string> names;
    for (const NameRow& row : name_table())
        for (const std::string_view side : side_words(limb.side))
            for (std::size_t n = 0; n < 2 && !row.joints(limb.kind)[n].empty(); ++n)
                names.push_back(with_side(row.joints(limb.kind)[n], side));
    return names;
}

struct NameSearch {
    const NamedJoints& joints;
    LimbName limb;
    std::vector<std::string> known_names = own_names(limb);

    std::string shown(int joint) const { return printable_name(joint_at(joints.clip, joint)); }

    // The first joint between the three that another row knows as one of them; -1 if there is none.
    int rival_between(const Attempt& made, const LimbJoints& at) const
    {
        const auto has = [&](const auto& names, int joint) {
            return std::find(names.begin(), names.end(), joints.name(joint)) != names.end();
        };
        for (int up = joint_at(joints.clip, at[2]).parent; up != at[0]; up = joint_at(joints.clip, up).parent)
            if (has(known_names, up) && !has(made.names, up)) return up;
        return -1;
    }
    std::vector<LimbJoints> limbs_of(const Attempt& made) const
    {
        std::vector<LimbJoints> limbs;
        if (made.borne() == 3) limbs = chains(joints.clip, made.bearers);
        std::erase_if(limbs, [&](const LimbJoints& at) {
            return std::none_of(at.begin(), at.end(), [&](int joint) { return joints.is_bone(joint); }) ||
                   rival_between(made, at) >= 0;
        });
        return limbs;
    }

    // "#5,#7,#9", and the option that names them.
    std::string numbers(const LimbJoints& at) const
    {
        const auto number = [&](int joint) { return joint_at(joints.clip, joint).number; };
        return fmt::format("#{},#{},#{}", number(at[0]), number(at[1]), number(at[2]));
    }
    std::string option(const LimbJoints& at) const
    {
        return fmt::format("{} {}:{}", words_of(limb.kind).option, side_name(limb.side), numbers(at));
    }
    // A joint below `lower` that rests where `end` does, within a thousandth of the way there; -1 if there is none.
    int twin_below(int lower, int end) const
    {
        const std::vector<formats::JointPose> rest_w = formats::rest_pose(joints.clip);
        const auto place = [&](int joint) { return rest_w[static_cast<std::size_t>(joint)].position; };
        const double max = 1e-3 * (place(end) - place(lower)).norm();
        for (int joint = lower + 1; joint < static_cast<int>(joints.clip.joints.size()); ++joint)
            if (is_above(joints.clip, lower, joint) && (place(joint) - place(end)).norm() <= max) return joint;
        return -1;
    }
    // n: of the joint that is not below the one before.
    FoundJoints not_below(LimbJoints at, std::size_t n) const
    {
        const int parent = joint_at(joints.clip, at[n]).parent;
        const std::string on = parent < 0 ? "is a root" : fmt::format("hangs on '{}'", shown(parent));
        FoundJoints made = no_joints(fmt::format("'{}' {}, not below '{}'", shown(at[n]), on, shown(at[n - 1])));
        at[n] = twin_below(at[n - 1], at[n]);
        if (at[n] >= 0 && is_chain(joints.clip, at))
            made.advice = fmt::format("at rest '{}' lies in the same place: {}", shown(at[n]), option(at));
        return made;
    }
    // Why joints with these names make no limb.
    FoundJoints problem_of(const Attempt& made) const
    {
        const LimbWords& words = words_of(limb.kind);
        const std::string_view parts[] = {words.upper_joint, words.lower_joint, words.end_joint};
        for (std::size_t n = 0; n < 3; ++n)
            if (made.bearers[n].empty())
                return no_joints(fmt::format("no joint is called '{}' or alike for its {}", made.names[n], parts[n]));
        const LimbJoints first = {made.bearers[0][0], made.bearers[1][0], made.bearers[2][0]};
        for (std::size_t n = 0; n < 2; ++n)
            if (!is_above(joints.clip, first[n], first[n + 1])) return not_below(first, n + 1);
        if (const int rival = rival_between(made, first); rival >= 0)
            return no_joints(fmt::format("'{}' lies between '{}' and '{}', and may be one of its joints", shown(rival),
                                         shown(first[0]), shown(first[2])));
        return no_joints(fmt::format("'{}' and what is below it are no bones of the file's skin", shown(first[0])));
    }

    FoundJoints several(const std::vector<LimbJoints>& limbs) const
    {
        std::string list;
        for (const LimbJoints& at : limbs)
            list += fmt::format("{}{} > {} > {} ({})", list.empty() ? "" : " and ", shown(at[0]), shown(at[1]),
                                shown(at[2]), numbers(at));
        return no_joints("more than one fits: " + formats::printable(list, formats::kMaxQuoted),
                         "name one, such as " + option(limbs[0]));
    }
};

FoundJoints joints_by_name(const NamedJoints& joints, LimbName limb)
{
    const NameSearch search{joints, limb};
    std::vector<LimbJoints> limbs;
    std::string_view from;  // the row that the first limb is of
    Attempt nearest;
    for (const NameRow& row : name_table())
        for (const std::string_view side : side_words(limb.side)) {
            if (row.joints(limb.kind)[0].empty()) continue;
            Attempt made;
            for (std::size_t n = 0; n < 3; ++n) {
                made.names[n] = with_side(row.joints(limb.kind)[n], side);
                made.bearers[n] = joints.named(made.names[n]);
            }
            const std::vector<LimbJoints> earlier = limbs;
            if (earlier.empty()) from = row.from;
            for (const LimbJoints& each : search.limbs_of(made))
                if (std::none_of(earlier.begin(), earlier.end(),
                                 [&](const LimbJoints& other) { return shared_joint(each, other) >= 0; }))
                    limbs.push_back(each);
            if (made.borne() > nearest.borne()) nearest = std::move(made);
        }
    if (limbs.size() > 1) return search.several(limbs);
    if (limbs.size() == 1) return {limbs[0], std::string(from), {}, {}};
    // One name alone proves nothing: half the world has a "LeftHand".
    return nearest.borne() > 1 ? search.problem_of(nearest) : FoundJoints();
}

// The joints that VRM calls so, if it knows any of the three.
std::optional<FoundJoints> said_joints(const Clip& clip, LimbName limb)
{
    const std::array<std::string, 3> words = vrm_words(limb);
    LimbJoints joints;
    std::string problem;
    for (std::size_t n = 0; n < joints.size(); ++n) {
        joints[n] = vrm_joint(clip, words[n]);
        if (joints[n] < 0) problem = fmt::format("the file's humanoid has no {}", words[n]);
    }
    if (std::ranges::max(joints) < 0) return std::nullopt;
    if (!problem.empty()) return no_joints(problem);
    if (!is_chain(clip, joints))
        return no_joints("the joints of the file's humanoid for it do not lie above one another");
    return FoundJoints{joints, "the file's humanoid", {}, {}};
}

}  // namespace

std::vector<bool> repeated_joints(const Clip& clip)
{
    std::vector<std::size_t> roots;            // of each joint
    std::map<std::size_t, std::string> below;  // all names of bones below a root
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        const int parent = clip.joints[n].parent;
        roots.push_back(parent < 0 ? n : roots[static_cast<std::size_t>(parent)]);
        if (parent >= 0 && clip.joints[n].is_bone) below[roots[n]] += clip.joints[n].name + '\n';
    }
    std::set<std::string> seen;
    std::vector<bool> is_repeated(clip.joints.size());
    for (const auto& [root, names] : below) is_repeated[root] = !seen.insert(names).second;
    for (std::size_t n = 0; n < roots.size(); ++n) is_repeated[n] = is_repeated[roots[n]];
    return is_repeated;
}

std::array<FoundJoints, 4> joints_by_file(const Clip& clip)
{
    NamedJoints named{clip};
    const std::vector<bool> is_repeated = repeated_joints(clip);
    for (std::size_t n = 0; n < clip.joints.size(); ++n) {
        named.names.push_back(plain(clip.joints[n].name));
        if (!is_repeated[n]) named.bearers[named.names.back()].push_back(static_cast<int>(n));
    }
    std::array<FoundJoints, 4> found;
    for (std::size_t n = 0; n < found.size(); ++n) {
        const LimbName limb = formats::kLimbNames[n];
        std::optional<FoundJoints> said = said_joints(clip, limb);
        found[n] = said ? std::move(*said) : joints_by_name(named, limb);
    }
    return found;
}

}  // namespace swivel::tools
