// SPDX-License-Identifier: MIT
//
// The library on recorded motion, each frame of a clip as a body. Bodies whose targets are their own come back, elbows
// that follow hands are near the clip's, and planted feet hardly skate where legs do not fit the clip.
#include <catch2/catch.hpp>

#include <algorithm>
#include <numbers>

#include "tests/feet_motion.h"
#include "tests/gltf_rig.h"
#include "tests/posed_bodies.h"
#include "tests/run_command.h"
#include "tests/test_data.h"
#include "tools/formats/bvh.h"
#include "tools/rig/limbs.h"

using namespace swivel;
using namespace swivel::test;
using formats::Clip;

namespace {

// kinds: "arms", "legs" or "all".
std::vector<tools::Limb> limbs_of(const formats::Clip& clip, const Words& options, const char* kinds)
{
    tools::LimbChoice choice;
    choice.kinds = kinds;
    for (std::size_t n = 0; n < options.size(); n += 2)
        (options[n] == "--arm" ? choice.arms : choice.legs)
            .push_back(tools::limb_of_option(options[n + 1], options[n]));
    std::vector<tools::Limb> limbs;
    for (const tools::LimbFinding& found : bind_limbs(clip, choose_joints(clip, {}, choice), choice).findings)
        if (found.limb) limbs.push_back(*found.limb);
    return limbs;
}

// A clip's skeleton, and each of its frames.
struct ClipBodies {
    BodySkeleton skeleton;
    std::vector<Body> frames;

    ClipBodies(const formats::Clip& clip, const Words& options = {}, const char* kinds = "all")
        : frames(clip.frame_count)
    {
        for (const formats::Joint& joint : clip.joints) {
            skeleton.parents.push_back(joint.parent);
            skeleton.rotations.push_back(floats(joint.rest_rotation));
            skeleton.translations.push_back(floats(joint.offset));
        }
        for (const tools::Limb& limb : limbs_of(clip, options, kinds)) {
            const auto joint = [&](std::size_t n) { return static_cast<std::uint32_t>(limb.joints[n]); };
            skeleton.limbs.push_back({joint(0), joint(1), joint(2), floats(limb.bend), {}});
        }
        for (std::size_t frame = 0; frame < frames.size(); ++frame)
            for (std::size_t n = 0; n < clip.joints.size(); ++n) {
                const auto scale = static_cast<float>(local_pose(clip, frame, n).scale);
                frames[frame].rotations.push_back(floats(clip.rotation[frame * clip.joints.size() + n]));
                frames[frame].translations.push_back(floats(local_translation(clip, frame, n)));
                frames[frame].scales.push_back({scale, scale, scale});
            }
    }
};

// Calls judge(name, clip, number of limbs, options) for each clip and animation that people share, where this machine
// has it. Returns whether it has all.
template <class Judge>
bool for_each_shared_clip(const Judge& judge)
{
    bool all = true;
    const auto find = [&](const std::string& name) {
        const fs::path path = find_or_warn(name);
        all = all && !path.empty();
        return path;
    };
    for (const char* name : kSharedClips)
        if (const fs::path path = find(name); !path.empty())
            judge(std::string(name), formats::read_bvh(path).clip, std::size_t{4}, Words{});
    for (const SharedFigure& file : kSharedFigures) {
        const fs::path path = find(file.name);
        for (int n = 0; !path.empty() && n < std::max(file.animations, 1); ++n) {
            formats::GltfChoice choice;
            if (file.animations > 0) choice.animation = std::to_string(n);
            judge(file.name + ", animation " + std::to_string(n), read_clip(path, choice).clip, file.limbs,
                  file.options);
        }
    }
    return all;
}

// Two ways to leave elbows where they come: to give no pole, and to give one without weight.
constexpr swivel_features kOwnElbows[] = {SWIVEL_WITH_HAND | SWIVEL_POLE_INCOMING,
                                          SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS};

// A solve of all frames whose goals are their own wrists and hands.
struct SolvedClip {
    PosedBodies bodies;
    SolvedBodies solved;

    SolvedClip(const ClipBodies& clip, swivel_features features)
        : bodies(clip.skeleton, clip.frames, {.translates = true, .scales = true}), solved(with_own_goals(features))
    {
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g)
            for (const std::uint32_t flags : read<std::uint32_t>(solved.crowd, SWIVEL_FLAGS, g))
                CHECK(!(flags & SWIVEL_BAD_INPUT));
    }

private:
    const PosedBodies& with_own_goals(swivel_features features)
    {
        bodies.add_limbs(features);
        for (std::uint32_t g = 0; g < bodies.groups.size(); ++g) {
            bodies.give_goals(g, [&](std::size_t n) { return own_goal(bodies.skeleton, bodies.bodies[n], g); });
            if (features & SWIVEL_WITH_WEIGHTS)
                bodies.give(g, SWIVEL_WEIGHTS, [](std::size_t) { return Float3{1, 1, 0}; });
        }
        return bodies;
    }
};

// A joint's turn from the frame before, in degrees, relative to its parent.
double turn_to(const std::vector<Body>& frames, std::size_t n, std::uint32_t joint)
{
    const auto rotation = [&](std::size_t frame) { return quat(frames[frame].rotations[joint]).normalized(); };
    return rotation(n).angularDistance(rotation(n - 1)) * 180 / std::numbers::pi;
}

}  // namespace

TEST_CASE("untouched goals give back every frame of the shared clips and figures' animations")
{
    for_each_shared_clip([](const std::string& name, const Clip& clip, std::size_t limb_count, const Words& options) {
        INFO(name);
        const ClipBodies bodies(clip, options);
        REQUIRE(bodies.skeleton.limbs.size() == limb_count);
        for (const swivel_features features : kOwnElbows) {
            const SolvedClip own(bodies, features);
            for (std::size_t n = 0; n < bodies.frames.size(); ++n) {
                const SolvedBody body(own.solved, n);
                for (std::uint32_t g = 0; g < limb_count; ++g) REQUIRE(body.strayed(g) <= 1);
            }
        }
    });
}

TEST_CASE("a clip's own wrists turn no joint of a limb between two frames as the clip does not")
{
    // Its knees are bent by some degrees, to either side. Measured: 0.003 degrees more than the clip.
    const fs::path path = find_or_warn("m2m_human_ymca.glb");
    if (path.empty()) return;
    const ClipBodies clip(read_clip(path).clip);
    for (const swivel_features features : kOwnElbows) {
        const SolvedClip own(clip, features);
        std::vector<Body> bodies;
        for (std::size_t n = 0; n < clip.frames.size(); ++n) bodies.push_back(own.solved.poses.read(n, clip.frames[n]));
        for (std::size_t n = 1; n < bodies.size(); ++n)
            for (const BodyLimbJoints& limb : clip.skeleton.limbs)
                for (const std::uint32_t joint : {limb.shoulder, limb.elbow, limb.wrist})
                    REQUIRE(turn_to(bodies, n, joint) <= turn_to(clip.frames, n, joint) + 1);
    }
}

namespace {

// A clip's arm: places from the shoulder, in its parent's frame, for each frame.
struct ClipArm {
    std::vector<Vector3d> elbow, wrist, solved;
    double upper = 0, fore = 0;

    ClipArm(const ClipBodies& clip, std::size_t limb)
    {
        const BodyLimbJoints& joints = clip.skeleton.limbs[limb];
        const auto parent = static_cast<std::uint32_t>(clip.skeleton.parents[joints.shoulder]);
        swivel_limb_def def = limbs(static_cast<std::uint32_t>(clip.frames.size()),
                                    SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_HAND | SWIVEL_POLE_HAND);
        def.binding = swivel::bind(clip.skeleton.view(), clip.skeleton.joints(limb));
        Crowd crowd(def);
        std::vector<Vector3d> shoulders;
        std::vector<Quaterniond> parents;
        for (std::uint32_t n = 0; n < clip.frames.size(); ++n) {
            const std::vector<JointAt> at = joints_at(clip.skeleton, clip.frames[n]);
            const Vector3d shoulder = at[joints.shoulder].place;
            const auto put = [&](swivel_field field, const auto& value) {
                crowd.write(field, 0, std::span(&value, 1), n);
            };
            upper = (at[joints.elbow].place - shoulder).norm();
            fore = (at[joints.wrist].place - at[joints.elbow].place).norm();
            put(SWIVEL_TARGET, floats(at[joints.wrist].place));
            put(SWIVEL_HAND, floats(at[joints.wrist].rotation));
            put(SWIVEL_SHOULDER_POSITION, floats(shoulder));
            put(SWIVEL_PARENT_ROTATION, floats(at[parent].rotation));
            put(SWIVEL_LENGTHS, Float2{static_cast<float>(upper), static_cast<float>(fore)});
            shoulders.push_back(shoulder);
            parents.push_back(at[parent].rotation.conjugate());
            elbow.push_back(parents[n] * (at[joints.elbow].place - shoulder));
            wrist.push_back(parents[n] * (at[joints.wrist].place - shoulder));
        }
        crowd.solve();
        std::vector<std::array<double, 3>> elbows(clip.frames.size());
        crowd.elbows(0, elbows);
        for (std::size_t n = 0; n < elbows.size(); ++n)
            solved.push_back(parents[n] * (Vector3d(elbows[n].data()) - shoulders[n]));
    }
    double length() const { return upper + fore; }
    double mean_miss(const std::vector<Vector3d>& elbows) const
    {
        double sum = 0;
        for (std::size_t n = 0; n < elbows.size(); ++n) sum += (elbows[n] - elbow[n]).norm();
        return sum / static_cast<double>(elbows.size());
    }
    // The elbows with a pole that stays in this direction.
    std::vector<Vector3d> with_pole(const Vector3d& pole) const
    {
        std::vector<Vector3d> made;
        for (std::size_t n = 0; n < wrist.size(); ++n) {
            const double d = wrist[n].norm(), along = (upper * upper + d * d - fore * fore) / (2 * d);
            const Vector3d line = wrist[n] / d, side = (pole - pole.dot(line) * line).normalized();
            made.push_back(along * line + std::sqrt(std::max(upper * upper - along * along, 0.0)) * side);
        }
        return made;
    }
    double best_miss() const
    {
        constexpr int kPoles = 1000;
        double best = 1e9;
        for (int n = 0; n < kPoles; ++n) {
            const double z = 1 - (2 * n + 1.0) / kPoles, turn = n * std::numbers::pi * (3 - std::sqrt(5.0)),
                         r = std::sqrt(1 - z * z);
            best = std::min(best, mean_miss(with_pole({r * std::cos(turn), r * std::sin(turn), z})));
        }
        return best;
    }
};
double largest_step(const std::vector<Vector3d>& places)
{
    double max = 0;
    for (std::size_t n = 1; n < places.size(); ++n) max = std::max(max, (places[n] - places[n - 1]).norm());
    return max;
}

TEST_CASE("on shared clips, elbows that follow hands are nearer than with the best fixed pole, and move smoothly")
{
    // Where a fixed pole is within this share of the arm, the elbow hardly moves. A hand whose wrist bends does not
    // tell it better then.
    constexpr double kStill = 0.015;
    int judged = 0;
    const bool all = for_each_shared_clip(
        [&](const std::string& name, const formats::Clip& clip, std::size_t, const Words& options) {
            const ClipBodies bodies(clip, options, "arms");
            for (std::size_t limb = 0; limb < bodies.skeleton.limbs.size(); ++limb) {
                const ClipArm arm(bodies, limb);
                const double miss = arm.mean_miss(arm.solved), best = arm.best_miss();
                INFO(name << ", arm " << limb << ": " << miss / arm.length() << " of the arm, the best fixed pole "
                          << best / arm.length() << ", step " << largest_step(arm.solved) / arm.length()
                          << ", the clip's " << largest_step(arm.elbow) / arm.length());
                CHECK(largest_step(arm.solved) <= 3 * largest_step(arm.elbow) + 1e-3 * arm.length());
                if (best < kStill * arm.length()) {
                    CHECK(miss <= 0.1 * arm.length());
                } else {
                    CHECK(miss <= 0.7 * best);
                    ++judged;
                }
            }
        });
    if (all) CHECK(judged >= 6);
}

// What the library makes of each of kSkatingClips at most, by the formulas' prototype: a cap 8 mm beyond the clip, a
// pelvis that goes up or down by 30 mm.
constexpr Skates kAfter[] = {
    {.037, .489, 21, 11.8}, {.028, .527, 12, 13.0}, {.008, .474, 10, 21.9}, {.057, .640, 33, 11.0}};
// A spring that makes up half of 30 mm in 0.1 s moves by so many in a frame at most.
constexpr double kMaxShift = 3.1;

constexpr swivel_features kPlantedLeg = SWIVEL_WITH_HAND | SWIVEL_WITH_EFFECTOR | SWIVEL_POLE_INCOMING |
                                        SWIVEL_WITH_PLANT | SWIVEL_WITH_CAP | SWIVEL_WITH_FLEXION_LIMIT |
                                        SWIVEL_WITH_PELVIS_FIT | SWIVEL_HAND_YIELDS;

// A clip's left leg and right one, which are planted frame after frame.
struct PlantedLegs {
    ClipBodies clip;
    std::array<std::uint32_t, 2> toes;
    PlainLegs legs{kCarriedTime, {}, {}};  // where they are then
    std::vector<double> shifts = {};       // of the root, along y

    PlantedLegs(const formats::Clip& from, const PlainContacts& contacts) : clip(from, {}, "legs")
    {
        for (const std::size_t side : {0u, 1u})
            toes[side] = static_cast<std::uint32_t>(find_joints(from, side ? "RightToeBase" : "LeftToeBase").at(0));
        for (Body& body : clip.frames) std::swap(body.root_position, body.translations[0]);  // the root joint's place
        PosedBodies one = planting_body(contacts);
        SolvedBodies solved(one);
        for (std::size_t frame = 0; frame < clip.frames.size(); ++frame) {
            one.bodies[0] = clip.frames[frame];
            for (std::uint32_t leg = 0; leg < 2; ++leg)
                solved.crowd.write_all(SWIVEL_CONTACT, leg, contacts[leg][frame] ? 1.f : 0.f);
            if (frame > 0) solved.solve_next();
            shifts.push_back(double{solved.result<Float3>(SWIVEL_SHIFT, 2, 0)[0]});
            const SolvedBody body(solved, 0);
            const Vector3d root = body.root() + shifts.back() * Vector3d::UnitY();
            legs.add(root, [&](std::size_t joint, std::size_t side) {
                const BodyLimbJoints& of = clip.skeleton.limbs[side];
                return Vector3d(root +
                                body.solved[std::array{of.shoulder, of.elbow, of.wrist, toes[side]}[joint]].place);
            });
        }
    }

private:
    PosedBodies planting_body(const PlainContacts& contacts) const
    {
        PosedBodies made(clip.skeleton, {clip.frames[0]}, {.roots = true});
        made.time = static_cast<float>(kCarriedTime);
        made.add_limbs(kPlantedLeg);
        const auto share = [&](double metres, std::size_t leg) {
            const BodyLimbJoints& of = clip.skeleton.limbs[leg];
            return static_cast<float>(
                metres / kMetre /
                (vec(clip.skeleton.translations[of.elbow]).norm() + vec(clip.skeleton.translations[of.wrist]).norm()));
        };
        for (std::uint32_t leg = 0; leg < 2; ++leg) {
            swivel_plant& plant = made.limb_def(leg).plant;
            plant.lock_radius = share(0.10, leg), plant.unlock_radius = share(0.20, leg),
            plant.relock_speed = share(0.05, leg);
            plant.stop_time = 0.1f, plant.release_time = 0.2f;
            made.give(leg, SWIVEL_EFFECTOR, [&](std::size_t) { return clip.skeleton.translations[toes[leg]]; });
            made.give(leg, SWIVEL_FLEXION_LIMIT, [](std::size_t) { return flexion(degrees(1.62), std::numbers::pi); });
            made.give(leg, SWIVEL_CAP, [&](std::size_t) { return Float3{share(0.008, leg), 0, share(0.002, leg)}; });
            made.give(leg, SWIVEL_CONTACT, [&](std::size_t) { return Float1{contacts[leg][0] ? 1.f : 0.f}; });
        }
        swivel_shift_def shift = swivel_default_shift_def();
        shift.drop = shift.rise = share(0.03, 0);
        shift.lookahead = 0;
        made.add(shift);
        return made;
    }
};

void require_at_most(const Skates& is, const Skates& wanted, double share)
{
    INFO(is.mean << " and " << is.max << " m/s, " << is.step << " mm a step, a knee " << is.knee << " degrees a frame");
    CHECK(is.mean <= share * wanted.mean);
    CHECK(is.max <= share * wanted.max);
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
        const PlantedLegs planted(formats::read_bvh(folder / "skates.bvh").clip, contacts);
        require_at_most(in_metres(plain_skating(planted.legs, contacts)), kAfter[n], 1.05);
        for (std::size_t frame = 1; frame < planted.shifts.size(); ++frame)
            CHECK(1e3 * kMetre * std::abs(planted.shifts[frame] - planted.shifts[frame - 1]) <= kMaxShift);
    }
}
