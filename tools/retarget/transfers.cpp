// SPDX-License-Identifier: MIT
#include "tools/retarget/transfers.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tools/rig/limb_chain.h"

namespace swivel::tools {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using formats::Clip;

bool is_trunk(const std::string& part)
{
    return part == "hips" || part == "spine" || part == "neck" || part == "head" || part.ends_with("Shoulder");
}

// The nearest joint above that is in `joints`; -1 if there is none.
int nearest_above(const Clip& clip, int joint, const std::map<int, int>& joints)
{
    do {
        joint = joint_at(clip, joint).parent;
    } while (joint >= 0 && !joints.contains(joint));
    return joint;
}

// Brings one foot's way from ankle to toe over the other's, steeper by `more` radians.
Quaterniond foot_over(const Vector3d& from, const Vector3d& to, double more)
{
    const Vector3d level_from(from.x(), 0, from.z()), level_to(to.x(), 0, to.z());
    const Quaterniond turned = aim(level_from, level_to);
    const double slope = slope_of(to) + more;
    return aim(turned * from, std::cos(slope) * level_to.normalized() + std::sin(slope) * Vector3d::UnitY()) * turned;
}

struct Aligner {
    const StandingFigure& source;
    const StandingFigure& target;
    std::map<int, int> to_target{}, to_source{};  // joints that stand for one another

    // Where a pair's bones lead: to the pairs right below both, in the mean.
    std::pair<Vector3d, Vector3d> ways_below(int from, int to) const
    {
        Vector3d from_way = Vector3d::Zero(), to_way = Vector3d::Zero();
        for (const auto& [next_to, next_from] : to_source) {
            if (nearest_above(target.clip, next_to, to_source) != to ||
                nearest_above(source.clip, next_from, to_target) != from)
                continue;
            from_way += source.rest.own_way(from, next_from);
            to_way += target.rest.own_way(to, next_to);
        }
        return {from_way, to_way};
    }
    std::pair<Vector3d, Vector3d> ways(int from, int to) const
    {
        for (std::size_t n = 0; n < target.rest.limbs.size(); ++n) {
            if (!target.rest.limbs[n] || !source.rest.limbs[n]) continue;
            for (std::size_t joint = 0; joint < 2; ++joint)
                if ((*target.rest.limbs[n])[joint] == to)
                    return {source.rest.own_way(from, (*source.rest.limbs[n])[joint + 1]),
                            target.rest.own_way(to, (*target.rest.limbs[n])[joint + 1])};
        }
        return ways_below(from, to);
    }
    // How much steeper the target's flat foot is than the source's.
    double steeper(std::size_t side) const
    {
        const auto &from = source.stance.slope[side], &to = target.stance.slope[side];
        return from && to ? *to - *from : 0;
    }
    Quaterniond align(const std::string& part, int from, int to, const Quaterniond& above) const
    {
        if (is_trunk(part)) return Quaterniond::Identity();
        const auto [from_way, to_way] = ways(from, to);
        if (part.ends_with("Foot"))
            return foot_over(to_way, from_way, steeper(part.starts_with("left") ? std::size_t{0} : std::size_t{1}));
        return aim(above * to_way, from_way) * above;
    }
};

}  // namespace

std::vector<std::optional<Transfer>> transfers_of(const JointPairs& pairs, const StandingFigure& source,
                                                  const StandingFigure& target)
{
    std::vector<std::optional<Transfer>> transfers(target.clip.joints.size());
    std::vector<const std::string*> part_of(transfers.size());
    Aligner aligner{source, target};
    for (const PairedPart& part : pairs)
        for (std::size_t n = 0; part.is_paired() && n < part.target.size(); ++n) {
            const double place =
                static_cast<double>((n + 1) * part.source.size()) / static_cast<double>(part.target.size());
            const auto after = static_cast<std::size_t>(std::ceil(place)) - 1;
            const auto to = static_cast<std::size_t>(part.target[n]);
            transfers[to] = Transfer{after > 0 ? part.source[after - 1] : -1, part.source[after],
                                     place - static_cast<double>(after)};
            part_of[to] = &part.name;
            aligner.to_source[part.target[n]] = part.source[after];
            aligner.to_target[part.source[after]] = part.target[n];
        }
    for (std::size_t n = 0; n < transfers.size(); ++n) {  // parents come before their children
        if (!transfers[n]) continue;
        const auto to = static_cast<int>(n);
        Transfer& transfer = *transfers[n];
        if (transfer.before < 0) transfer.before = nearest_above(source.clip, transfer.after, aligner.to_target);
        const int above = nearest_above(target.clip, to, aligner.to_source);
        transfer.align =
            aligner.align(*part_of[n], transfer.after, to,
                          above < 0 ? Quaterniond::Identity() : transfers[static_cast<std::size_t>(above)]->align);
    }
    return transfers;
}

}  // namespace swivel::tools
