// SPDX-License-Identifier: MIT
#include "tools/crowd/given_targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "tools/formats/error.h"
#include "tools/rig/limb_words.h"

namespace swivel::tools {

namespace {

using formats::Target;

// In a frame between those of two rows of one limb.
Target on_the_way(const Target& before, const Target& after, std::size_t frame)
{
    const double share = static_cast<double>(frame - before.frame) / static_cast<double>(after.frame - before.frame);
    const auto mixed = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return Eigen::Vector3d((1 - share) * a + share * b);
    };
    Target target = before;
    target.position = mixed(before.position, after.position);
    if (before.has_pole && after.has_pole) target.pole = mixed(before.pole, after.pole);
    if (before.has_orientation && after.has_orientation)
        target.orientation = before.orientation.slerp(share, after.orientation);
    return target;
}

}  // namespace

GivenTargets::GivenTargets(const std::string& source, Between between, std::size_t frame_count,
                           std::span<const Limb> limbs, const CrowdPlan& plan)
    : between_(between)
{
    if (source == "clip") return;
    rows_ = formats::read_targets_csv(source);
    const auto is_of_kind = [&](const Target& target) {
        return std::ranges::any_of(limbs, [&](const Limb& limb) { return limb.name.kind == target.limb.kind; });
    };
    for (const Target& target : rows_) {
        const auto refuse = [&](const std::string& cause) { throw formats::InputError(source, target.line, cause); };
        if (target.frame >= frame_count)
            refuse(fmt::format("frame {} does not exist; there are frames 0 to {}", target.frame, frame_count - 1));
        if (target.character >= plan.characters)
            refuse(fmt::format("character {} does not exist; there are {} (--characters), counted from 0",
                               target.character, plan.characters));
        const auto limb = std::ranges::find(limbs, target.limb, &Limb::name);
        if (is_of_kind(target) && limb == limbs.end())
            refuse(fmt::format("the {} is not solved; name it with {} {}", plain_name(target.limb),
                               words_of(target.limb.kind).option, words_of(target.limb.kind).joints));
        if (limb == limbs.end()) continue;
        if (const auto holds = plan.limbs[static_cast<std::size_t>(limb - limbs.begin())].goals.holds)
            refuse(fmt::format("the {} holds the {}, so its target means nothing; leave its rows out",
                               plain_name(target.limb), plain_name(limbs[holds - 1].name)));
    }
    const std::uint32_t line = rows_.front().line;
    const std::string_view limbs_of_row = words_of(rows_.front().limb.kind).limbs;
    left_out_ = std::erase_if(rows_, [&](const Target& row) { return !is_of_kind(row); });
    if (rows_.empty())
        throw formats::InputError(
            source, line,
            fmt::format("all rows are of {}, which are not solved; take them in with --limbs", limbs_of_row));
    find_tracks();
}

void GivenTargets::find_tracks()
{
    const auto limb_of = [](const Target& row) { return std::tuple(row.character, row.limb); };
    std::ranges::sort(rows_, {}, [](const Target& row) { return std::tuple(row.character, row.limb, row.frame); });
    for (std::size_t n = 0; n < rows_.size(); ++n) {
        if (n == 0 || limb_of(rows_[n]) != limb_of(rows_[n - 1])) tracks_.push_back({n, n});
        tracks_.back().end = n + 1;
    }
}

std::uint64_t GivenTargets::count(std::size_t frame_count) const
{
    if (between_ != Between::clip) return std::uint64_t{frame_count} * tracks_.size();
    return static_cast<std::uint64_t>(
        std::ranges::count_if(rows_, [&](const Target& row) { return row.frame < frame_count; }));
}

std::span<const Target> GivenTargets::of_frame(std::size_t frame)
{
    targets_.clear();
    for (Track& track : tracks_) {
        while (track.now + 1 < track.end && rows_[track.now + 1].frame <= frame) ++track.now;
        const Target& row = rows_[track.now];
        if (row.frame == frame)
            targets_.push_back(row);
        else if (between_ == Between::linear && row.frame < frame && track.now + 1 < track.end)
            targets_.push_back(on_the_way(row, rows_[track.now + 1], frame));
        else if (between_ != Between::clip)
            targets_.push_back(row);
    }
    return targets_;
}

}  // namespace swivel::tools
