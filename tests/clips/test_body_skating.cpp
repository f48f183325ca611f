// SPDX-License-Identifier: MIT
//
// The promise on recorded motion. Feet skate where legs do not fit a clip. Planted, capped and fitted by the library,
// they hardly do. feet_motion.h measures.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/clip_bodies.h"
#include "tests/feet_motion.h"

namespace {

using namespace swivel;
using namespace swivel::test;

// What the library makes of each of kSkatingClips at most, by the formulas' prototype: a cap 8 mm beyond the clip, a
// pelvis that goes up or down by 30 mm.
constexpr Skates kAfter[] = {
    {.037, .489, 21, 11.8}, {.028, .527, 12, 13.0}, {.008, .474, 10, 21.9}, {.057, .640, 33, 11.0}};
// A spring that makes up half of 30 mm in 0.1 s moves by so many in a frame at most.
constexpr double kMostShift = 3.1;
constexpr double kStop = 0.10;  // seconds in which a foot stops

// A clip as bodies, whose two limbs are the left leg and the right one.
struct LegBodies {
    ClipBodies clip;
    std::array<std::uint32_t, 2> toes;

    explicit LegBodies(const formats::Clip& from) : clip(from, {}, "legs")
    {
        for (const std::size_t side : {0u, 1u})
            toes[side] = static_cast<std::uint32_t>(find_joints(from, side ? "RightToeBase" : "LeftToeBase").at(0));
        for (Body& body : clip.frames) std::swap(body.root_position, body.translations[0]);  // the root joint's place
    }
    double leg_metres(std::size_t side) const
    {
        const BodyLimbJoints& of = clip.skeleton.limbs[side];
        return kMetre *
               (vec(clip.skeleton.translations[of.elbow]).norm() + vec(clip.skeleton.translations[of.wrist]).norm());
    }
    // Where the legs are. shifts: of the root, along y, in each frame.
    PlainLegs legs(const std::vector<double>& shifts) const
    {
        PlainLegs path{kCarriedTime, {}, {}};
        for (std::size_t frame = 0; frame < clip.frames.size(); ++frame) {
            const std::vector<JointAt> at = joints_at(clip.skeleton, clip.frames[frame]);
            const Vector3d root = vec(clip.frames[frame].root_position) + shifts[frame] * Vector3d::UnitY();
            path.body.push_back(root);
            for (std::size_t side = 0; side < 2; ++side) {
                const BodyLimbJoints& of = clip.skeleton.limbs[side];
                PlainLegPath& leg = path.legs[side];
                leg.hip.push_back(root + at[of.shoulder].place);
                leg.knee.push_back(root + at[of.elbow].place);
                leg.ankle.push_back(root + at[of.wrist].place);
                leg.toe.push_back(root + at[toes[side]].place);
            }
        }
        return path;
    }
};

constexpr swivel_features kPlantedLeg = SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_INCOMING |
                                        SWIVEL_POLE_INCOMING | SWIVEL_WITH_PLANT | SWIVEL_WITH_CAP |
                                        SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_FIT | SWIVEL_HAND_YIELDS;
constexpr std::uint32_t kShift = 2;  // the group after both legs

Crowd planting_crowd(const LegBodies& bodies)
{
    const BodySkeleton& skeleton = bodies.clip.skeleton;
    const swivel_limb_joints joints[] = {skeleton.joints(0), skeleton.joints(1)};
    std::vector<swivel_group_def> groups;
    const auto share = [&](double metres, std::size_t leg) {
        return static_cast<float>(metres / bodies.leg_metres(leg));
    };
    for (std::size_t leg = 0; leg < 2; ++leg) {
        groups.push_back(body_group(joints[leg], kPlantedLeg));
        swivel_plant& plant = groups.back().plant;
        plant.lock = share(0.10, leg), plant.unlock = share(0.20, leg), plant.again = share(0.05, leg);
        plant.stop = static_cast<float>(kStop), plant.blend = 0.2f;
    }
    groups.push_back(swivel_default_fit_group_def());
    groups[kShift].fit = {share(0.03, 0), share(0.03, 0), 0.1f, 0};
    Crowd crowd(skeleton.view(), 1, groups);
    for (std::uint32_t leg = 0; leg < 2; ++leg) {
        crowd.write_all(SWIVEL_EFFECTOR, leg, skeleton.translations[bodies.toes[leg]]);
        crowd.write_all(SWIVEL_FLEXION_LIMIT, leg, flexion(degrees(1.62), std::numbers::pi));
        crowd.write_all(SWIVEL_CAP, leg, Float3{share(0.008, leg), 0, share(0.002, leg)});
    }
    return crowd;
}

struct Planted {
    LegBodies bodies;
    std::vector<double> shifts = {};
    std::array<std::vector<std::uint32_t>, 2> flags = {};  // of the legs, in each frame

    Planted(const LegBodies& from, const PlainContacts& contacts) : bodies(from)
    {
        Crowd crowd = planting_crowd(bodies);
        PoseLayout layout;
        layout.roots = true;
        const auto time = static_cast<float>(kCarriedTime);
        for (std::size_t frame = 0; frame < bodies.clip.frames.size(); ++frame) {
            for (std::uint32_t leg = 0; leg < 2; ++leg)
                crowd.write_all(SWIVEL_CONTACT, leg, contacts[leg][frame] ? 1.f : 0.f);
            Body& body = bodies.clip.frames[frame];
            PoseBuffer buffer(layout, {body});
            swivel_pose pose = buffer.view();
            pose.time = {&time, 0};
            crowd.solve({.pose = &pose});
            body = buffer.read(0, body);
            shifts.push_back(read<Float3>(crowd, SWIVEL_SHIFT, kShift)[0][0]);
            for (std::uint32_t leg = 0; leg < 2; ++leg)
                flags[leg].push_back(read<std::uint32_t>(crowd, SWIVEL_FLAGS, leg)[0]);
        }
    }
    // How far a toe moves from frame to frame at most, mm, where it has been locked for longer than it takes to stop,
    // and its leg reaches.
    double slide_locked(const PlainLegs& legs) const
    {
        double most = 0;
        int held = 0;
        for (std::size_t leg = 0; leg < 2; ++leg) {
            double locked = 0;  // s
            bool stood = false;
            for (std::size_t frame = 0; frame < flags[leg].size(); ++frame) {
                locked = flags[leg][frame] & SWIVEL_PLANTED ? locked + kCarriedTime : 0;
                const bool stands = flags[leg][frame] & SWIVEL_REACHED && locked > kStop + kCarriedTime;
                const std::vector<Vector3d>& toe = legs.legs[leg].toe;
                if (stands && stood) most = std::max(most, 1e3 * kMetre * (toe[frame] - toe[frame - 1]).norm()), ++held;
                stood = stands;
            }
        }
        REQUIRE(held > 20);
        return most;
    }
};

void require_at_most(const Skates& is, const Skates& wanted, double share)
{
    INFO(is.mean << " and " << is.most << " m/s, " << is.step << " mm a step, a knee " << is.knee
                 << " degrees a frame");
    CHECK(is.mean <= share * wanted.mean);
    CHECK(is.most <= share * wanted.most);
    CHECK(is.step <= share * wanted.step);
    CHECK(is.knee <= share * wanted.knee);
}

}  // namespace

TEST_CASE("planted, capped and fitted legs hardly skate on the shared clips")
{
    for (std::size_t n = 0; n < std::size(kSkatingClips); ++n) {
        const SkatingClip& each = kSkatingClips[n];
        const fs::path path = find_or_warn(each.file);
        if (path.empty()) continue;
        INFO(each.words);
        const TempFolder folder;
        const PlainMotion recorded = plain_motion_of(path);
        spill(folder / "skates.bvh", carried(recorded, each.to));
        const PlainContacts contacts =
            prototypes_contacts(legs_path(plain_motion(carried(recorded, {})), kCarriedTime));
        const LegBodies bodies(formats::read_bvh(folder / "skates.bvh").clip);
        const Planted planted(bodies, contacts);
        const PlainLegs before = bodies.legs(std::vector<double>(bodies.clip.frames.size())),
                        after = planted.bodies.legs(planted.shifts);
        // Before, it skates as the prototype says, within half of the last digit that its figures have.
        const Skates was = in_metres(plain_skating(before, contacts));
        CHECK(std::abs(was.mean - each.before.mean) <= 5e-4);
        CHECK(std::abs(was.most - each.before.most) <= 5e-4);
        CHECK(std::abs(was.step - each.before.step) <= 0.5);
        CHECK(std::abs(was.knee - each.before.knee) <= 0.05);
        require_at_most(in_metres(plain_skating(after, contacts)), kAfter[n], 1.05);
        CHECK(planted.slide_locked(after) < 0.1);
        for (std::size_t frame = 1; frame < planted.shifts.size(); ++frame)
            CHECK(1e3 * kMetre * std::abs(planted.shifts[frame] - planted.shifts[frame - 1]) <= kMostShift);
    }
}
