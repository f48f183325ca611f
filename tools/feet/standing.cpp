// SPDX-License-Identifier: MIT
#include "tools/feet/standing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "tools/feet/contacts.h"
#include "tools/formats/error.h"
#include "tools/formats/height_picture.h"
#include "tools/formats/text.h"
#include "tools/rig/vectors.h"

namespace swivel::tools {

namespace {

using Eigen::Vector3d;

// How much lower the body hangs than in the clip, in leg lengths, so that an almost straight leg of the clip reaches
// down a slope; and how straight legs may get: swivel.h, SWIVEL_CAP.
constexpr double kLower = 0.03;
constexpr FixedField kCap{SWIVEL_CAP, {0.01f, 0.99f, 0}};

Ground read_ground(const formats::CrowdFile& file, double floor)
{
    const formats::GroundSettings& from = *file.ground;
    const Vector3d middle = from.middle ? from.middle->value : Vector3d(0, 0, 0);
    Ground ground{{{1, 1, 1}, {middle.x(), middle.y() + floor, middle.z()}, 0, 0}, {}};
    if (!from.heights) return ground;
    try {
        formats::HeightPicture picture = formats::read_height_picture(beside(file, *from.heights));
        std::ranges::copy(from.size->value, ground.grid.size);
        ground.grid.columns = picture.columns, ground.grid.rows = picture.rows;
        ground.heights = std::move(picture.heights);
    } catch (const formats::InputError& error) {
        throw formats::InputError(file.path, from.heights->line,
                                  fmt::format("{}: {}", from.heights->key, error.what()));
    }
    return ground;
}

// The frame of its file that a part shows, or the nearest one.
std::size_t frame_of(const ClipPart& part, std::size_t frame)
{
    return static_cast<std::size_t>(std::lround(static_cast<double>(frame % part.starts) * part.pace));
}

// The contacts of one clip from the file's own table.
Contacts read_contacts(const formats::CrowdFile& file, std::span<const LegPath> legs, const ClipPart& part,
                       const FramesInFile& frames)
{
    const formats::Given<std::string>& named = *file.ground->contacts;
    const std::filesystem::path path = beside(file, named);
    Contacts contacts(legs.size());
    try {
        if (formats::is_standard_stream(named.value))
            throw formats::InputError(path, "standard input is no file; name one");
        const Contacts in_file = contacts_of_rows(legs, frames.count, formats::read_contacts_csv(path), path);
        for (std::size_t leg = 0; leg < legs.size(); ++leg)
            for (std::size_t frame = 0; frame < part.count; ++frame)
                contacts[leg].push_back(in_file[leg][frames.first + frame_of(part, frame)]);
    } catch (const formats::InputError& error) {
        throw formats::InputError(file.path, named.line, fmt::format("{}: {}", named.key, error.what()));
    }
    return contacts;
}

// The quantile `share` of a point's heights while the foot is down; nothing if it never is. point: in the ankle's axes.
std::optional<double> height_down(const formats::Clip& clip, int ankle, const Vector3d& point,
                                  const std::vector<bool>& contact, double share)
{
    std::vector<double> heights;
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        if (!contact[frame]) continue;
        formats::world_pose(clip, frame, pose_w);
        const formats::JointPose& at = pose_w[static_cast<std::size_t>(ankle)];
        heights.push_back((at.position + at.rotation * point).y());
    }
    if (heights.empty()) return std::nullopt;
    return quantile(std::move(heights), share);
}

// The toe in the ankle's axes; zeros for a foot that stands on its ankle.
Vector3d toe_in_ankle(const formats::Clip& clip, const Limb& leg, const LegPath& path)
{
    std::vector<formats::JointPose> pose_w(clip.joints.size());
    formats::world_pose(clip, 0, pose_w);
    return pose_w[static_cast<std::size_t>(leg.end())].rotation.conjugate() * (path.toe_w[0] - path.ankle_w[0]);
}

[[noreturn]] void refuse(const formats::CrowdFile& file, std::string_view cause)
{
    throw formats::InputError(file.path, file.ground->line, fmt::format("ground: {}", cause));
}

// The solved legs. Refuses a crowd that cannot stand.
std::vector<Limb> legs_that_stand(const formats::CrowdFile& file, const formats::Clip& clip,
                                  std::span<const Limb> limbs, const FigureAxes& figure, const CrowdPlan& plan)
{
    std::vector<Limb> legs;
    for (const Limb& limb : limbs)
        if (limb.name.kind == formats::LimbKind::leg) legs.push_back(limb);
    if (legs.empty()) refuse(file, "no leg is solved; write crowd.limbs = \"all\", or give --limbs all");
    if (plan.budget_blocks > 0) refuse(file, "feet that stand are solved in every frame; take this or [budget] out");
    if (clip.frame_time == 0) refuse(file, "the clip's keys lie at uneven times; give --fps");
    if (nearest_axis(figure.up_w) != Vector3d::UnitY())
        refuse(file, "the figure does not stand along Y; turn the clip, or take this out");
    return legs;
}

// The legs in the first clip, and their contacts in all clips.
struct LegsInClips {
    LegMotion motion;
    Contacts contacts;
};
// Clips are treated one by one, because there is no motion from one's end to another's start.
LegsInClips legs_in_clips(const formats::CrowdFile& file, const formats::Clip& clip, std::span<const Limb> legs,
                          std::span<const ClipPart> parts, const FigureAxes& figure, const FramesInFile& frames)
{
    const auto& own = file.ground->contacts;
    if (own && !file.clips.empty())
        throw formats::InputError(file.path, own->line,
                                  fmt::format("{}: is of one clip; take this or crowd.clips out", own->key));
    LegsInClips in_clips{{}, Contacts(legs.size())};
    for (const ClipPart& part : parts) {
        std::optional<formats::Clip> alone;
        if (parts.size() > 1) alone = frames_of(clip, part);
        LegMotion motion = leg_motion(alone ? *alone : clip, legs, std::max(figure.carrier, 0), Vector3d::UnitY());
        const ContactBars bars;
        if (const auto slide = slide_of(motion, bars); slide && !slide->with_body)
            refuse(file,
                   fmt::format("the clip{} walks in place, so its feet slide; swivel feet --travel moves its root",
                               part.first > 0 ? fmt::format(" from frame {} of all on", part.first) : ""));
        const Contacts found = own ? read_contacts(file, motion.legs, part, frames) : find_contacts(motion, bars);
        for (std::size_t n = 0; n < legs.size(); ++n)
            in_clips.contacts[n].insert(in_clips.contacts[n].end(), found[n].begin(), found[n].end());
        if (part.first == 0) in_clips.motion = std::move(motion);
    }
    const auto is_ever = [](const std::vector<bool>& down) { return std::ranges::find(down, true) != down.end(); };
    if (std::ranges::none_of(in_clips.contacts, is_ever))
        refuse(file, fmt::format("the clip never has a foot on the ground, by {}; take another clip, or take this out",
                                 own ? own->key : "the rule of swivel feet"));
    return in_clips;
}

// Makes a leg stand on its toe, unless the file gives it an effector, at the heights that the clip has over its floor.
void plan_leg(const formats::Clip& clip, const Limb& leg, const LegPath& path, const std::vector<bool>& contact,
              double floor, LimbSetup& setup)
{
    Vector3d toe(setup.goals.effector);
    if (!setup.has(SWIVEL_WITH_EFFECTOR)) {
        toe = toe_in_ankle(clip, leg, path);
        put(toe, setup.goals.effector);
        FixedField effector{SWIVEL_EFFECTOR, {}};
        std::ranges::copy(toe.cast<float>(), effector.value.begin());
        setup.fields.push_back(effector);
    }
    setup.features |= SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_PLANT | SWIVEL_WITH_GROUND | SWIVEL_WITH_CAP |
                      SWIVEL_WITH_PELVIS_FIT | SWIVEL_HAND_YIELDS;
    setup.fields.push_back(kCap);
    const auto clearance = [&](const Vector3d& point, double share) {
        const std::optional<double> height = height_down(clip, leg.end(), point, contact, share);
        return height ? static_cast<float>(std::max(0.0, *height - floor)) : 0;
    };
    setup.ground.toe_clearance = clearance(toe, 0.5);
    setup.ground.heel_clearance = clearance(Vector3d::Zero(), 0.02);
}

}  // namespace

void stand_on_ground(const formats::CrowdFile& file, const formats::Clip& clip, std::span<const Limb> limbs,
                     const FigureAxes& figure, const FramesInFile& frames, CrowdPlan& plan)
{
    const std::vector<Limb> legs = legs_that_stand(file, clip, limbs, figure, plan);
    std::vector<ClipPart> parts = plan.clips;
    if (parts.empty()) parts = {{0, clip.frame_count, clip.frame_count}};
    plan.foot.y() = floor_of(clip, parts[0].count);  // all others are put on the same floor
    const LegsInClips in_clips = legs_in_clips(file, clip, legs, parts, figure, frames);
    std::size_t leg = 0;
    plan.contacts.resize(limbs.size());
    for (std::size_t n = 0; n < limbs.size(); ++n) {
        if (limbs[n].name.kind != formats::LimbKind::leg) continue;
        plan.contacts[n] = in_clips.contacts[leg];
        plan_leg(clip, limbs[n], in_clips.motion.legs[leg], plan.contacts[n], plan.foot.y(), plan.limbs[n]);
        ++leg;
    }
    plan.shift_wish = -kLower * in_clips.motion.leg_length();
    plan.ground = read_ground(file, plan.foot.y());
}

}  // namespace swivel::tools
