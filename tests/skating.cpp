// SPDX-License-Identifier: MIT
#include "tests/skating.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/pose_buffer.h"

namespace swivel::test {

namespace {

constexpr double kUnit = 0.0254 / 0.45;  // of the CMU library's skeletons, in metres

std::uint32_t joint_named(const formats::Clip& clip, const std::string& name)
{
    return static_cast<std::uint32_t>(formats::find_joints(clip, name).at(0));
}

// A frame of the clip, as it is in the file.
Body body_at(const formats::Clip& clip, std::size_t frame, const Retarget& retarget, const BodySkeleton& skeleton)
{
    Body body;
    for (std::size_t n = 0; n < skeleton.size(); ++n)
        body.rotations.push_back(floats(clip.rotation[frame * skeleton.size() + n]));
    body.translations = skeleton.translations;
    body.scales.assign(skeleton.size(), Float3{1, 1, 1});
    const Vector3d way(retarget.way, 1, retarget.way);
    body.root_position = floats(Vector3d(kUnit * way.cwiseProduct(formats::local_translation(clip, frame, 0))));
    return body;
}

double over_ground(const Vector3d& way) { return std::hypot(way.x(), way.z()); }

}  // namespace

double LegMotion::leg_length(std::size_t leg) const
{
    const BodyLimbJoints& of = skeleton.limbs[leg];
    return vec(skeleton.translations[of.elbow]).norm() + vec(skeleton.translations[of.wrist]).norm();
}

LegMotion leg_motion(const formats::Clip& clip, const Retarget& retarget)
{
    LegMotion motion;
    for (const formats::Joint& joint : clip.joints) {
        motion.skeleton.parents.push_back(joint.parent);
        motion.skeleton.rotations.push_back({0, 0, 0, 1});
        // The root joint's place is the body's.
        motion.skeleton.translations.push_back(floats(Vector3d((joint.parent < 0 ? 0 : kUnit) * joint.offset)));
    }
    for (const std::string side : {"Left", "Right"}) {
        const std::uint32_t hip = joint_named(clip, side + "UpLeg"), knee = joint_named(clip, side + "Leg"),
                            ankle = joint_named(clip, side + "Foot");
        motion.skeleton.limbs.push_back({hip, knee, ankle, {0, 0, -1}, {}});  // figures look along z
        motion.toes[side == "Left" ? 0 : 1] = joint_named(clip, side + "ToeBase");
        for (const std::uint32_t joint : {knee, ankle})
            for (float& each : motion.skeleton.translations[joint]) each = static_cast<float>(each * retarget.legs);
    }
    for (std::size_t frame = 0; frame < clip.frame_count; frame += 2)
        motion.frames.push_back(body_at(clip, frame, retarget, motion.skeleton));
    motion.shifts.assign(motion.frames.size(), 0);
    return motion;
}

LegPlaces leg_places(const LegMotion& motion)
{
    LegPlaces places;
    for (std::size_t frame = 0; frame < motion.frames.size(); ++frame) {
        const Body& body = motion.frames[frame];
        const std::vector<JointAt> at = joints_at(motion.skeleton, body);
        const Vector3d root = vec(body.root_position) + motion.shifts[frame] * Vector3d::UnitY();
        for (std::size_t leg = 0; leg < 2; ++leg) {
            const BodyLimbJoints& of = motion.skeleton.limbs[leg];
            const Vector3d thigh = at[of.elbow].place - at[of.shoulder].place,
                           shin = at[of.wrist].place - at[of.elbow].place;
            places.toes[leg].push_back(root + at[motion.toes[leg]].place);
            places.bends[leg].push_back(std::atan2(thigh.cross(shin).norm(), thigh.dot(shin)) * 180 / std::numbers::pi);
        }
    }
    return places;
}

Contacts contacts_of(const LegMotion& source)
{
    const LegPlaces places = leg_places(source);
    Contacts contacts;
    for (std::size_t leg = 0; leg < 2; ++leg) {
        const std::vector<Vector3d>& toe = places.toes[leg];
        const std::size_t last = toe.size() - 1;
        std::vector<double> heights;
        for (const Vector3d& place : toe) heights.push_back(place.y());
        std::ranges::sort(heights);
        const double floor = heights[last / 50];
        const auto stands = [&](std::size_t frame) {
            const std::size_t before = frame == 0 ? 0 : frame - 1, after = std::min(frame + 1, last);
            const double time = static_cast<double>(after - before) * kFrameTime;
            return (toe[after] - toe[before]).norm() < 0.5 * time && toe[frame].y() < floor + 0.06;
        };
        for (std::size_t frame = 0; frame <= last; ++frame) {
            int standing = 0;
            for (std::size_t n = 0; n < 5; ++n)
                standing += stands(std::min(frame + n < 2 ? 0 : frame + n - 2, last)) ? 1 : 0;
            contacts[leg].push_back(standing > 2);
        }
    }
    return contacts;
}

Skating skating_of(const LegMotion& motion, const Contacts& contacts)
{
    const LegPlaces places = leg_places(motion);
    Skating skating{};
    double way = 0, steps = 0, frames = 0;
    for (std::size_t leg = 0; leg < 2; ++leg)
        for (std::size_t frame = 1; frame < motion.frames.size(); ++frame) {
            skating.knee = std::max(skating.knee, std::abs(places.bends[leg][frame] - places.bends[leg][frame - 1]));
            skating.shift = std::max(skating.shift, 1e3 * std::abs(motion.shifts[frame] - motion.shifts[frame - 1]));
            if (!contacts[leg][frame]) continue;
            if (!contacts[leg][frame - 1]) {
                ++steps;
                continue;
            }
            const double slide = over_ground(places.toes[leg][frame] - places.toes[leg][frame - 1]);
            skating.most = std::max(skating.most, slide / kFrameTime);
            way += slide;
            ++frames;
        }
    skating.mean = way / (frames * kFrameTime);
    skating.way = 1e3 * way / steps;
    return skating;
}

namespace {

constexpr swivel_features kPlantedLeg = SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_INCOMING |
                                        SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT | SWIVEL_WITH_CAP |
                                        SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_FIT | SWIVEL_HAND_YIELDS;
constexpr std::uint32_t kShift = 2;  // the group after both legs

Crowd planting_crowd(const LegMotion& motion, const Planting& planting)
{
    const swivel_limb_joints joints[] = {motion.skeleton.joints(0), motion.skeleton.joints(1)};
    std::vector<swivel_group_def> groups;
    const auto share = [&](double length, std::size_t leg) {
        return static_cast<float>(length / motion.leg_length(leg));
    };
    for (std::size_t leg = 0; leg < 2; ++leg) {
        groups.push_back(body_group(joints[leg], kPlantedLeg));
        swivel_plant& plant = groups.back().plant;
        plant.lock = share(planting.lock, leg);
        plant.unlock = share(planting.unlock, leg);
        plant.again = share(planting.again, leg);
        plant.stop = static_cast<float>(planting.stop);
        plant.blend = static_cast<float>(planting.blend);
    }
    groups.push_back(swivel_default_fit_group_def());
    groups[kShift].fit = {share(planting.drop, 0), share(planting.rise, 0), static_cast<float>(planting.half), 0};
    Crowd crowd(motion.skeleton.view(), 1, groups);
    for (std::uint32_t leg = 0; leg < 2; ++leg) {
        crowd.write_all(SWIVEL_EFFECTOR, leg, motion.skeleton.translations[motion.toes[leg]]);
        crowd.write_all(SWIVEL_FLEXION_LIMIT, leg, flexion(degrees(planting.straightest), std::numbers::pi));
        crowd.write_all(SWIVEL_CAP, leg, Float3{share(planting.margin, leg), 0, share(planting.zone, leg)});
    }
    return crowd;
}

}  // namespace

PlantedMotion planted(const LegMotion& motion, const Contacts& contacts, const Planting& planting)
{
    Crowd crowd = planting_crowd(motion, planting);
    PlantedMotion planted{motion, {}};
    PoseLayout layout;
    layout.roots = true;
    const auto time = static_cast<float>(kFrameTime);
    for (std::size_t frame = 0; frame < motion.frames.size(); ++frame) {
        for (std::uint32_t leg = 0; leg < 2; ++leg)
            crowd.write_all(SWIVEL_CONTACT, leg, contacts[leg][frame] ? 1.f : 0.f);
        PoseBuffer buffer(layout, {motion.frames[frame]});
        swivel_pose pose = buffer.view();
        pose.time = {&time, 0};
        crowd.solve({.pose = &pose});
        planted.motion.frames[frame] = buffer.read(0, motion.frames[frame]);
        planted.motion.shifts[frame] = read<Float3>(crowd, SWIVEL_SHIFT, kShift)[0][0];
        for (std::uint32_t leg = 0; leg < 2; ++leg)
            planted.flags[leg].push_back(read<std::uint32_t>(crowd, SWIVEL_FLAGS, leg)[0]);
    }
    return planted;
}

}  // namespace swivel::test
