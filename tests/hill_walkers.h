// SPDX-License-Identifier: MIT
//
// A crowd that walks over hills: its own smooth ground, and an animation made for flat ground, whose legs are found
// here by the law of cosines. Roots are on the ground below them. Knows none of the library's formulas. Metres.
#pragma once

#include <numbers>

#include "tests/planted_bodies.h"
#include "tests/test_crowd.h"

namespace swivel::test {

inline constexpr double kWalkTime = 1.0 / 60;

// A height for each place, along y, and the plane that touches it there.
struct Terrain {
    struct Wave {
        double x, z, slope;  // radians a metre; the greatest slope that it makes
    };
    std::vector<Wave> waves = {};
    double step = 0, tread = 0.3;  // stairs along z, in place of waves, if step is not 0
    double crease = 0;             // the slope of triangles along z, 2 metres long, every other one level
    double end = HUGE_VAL;         // along z: nothing is known of the ground behind

    double height(double x, double z) const
    {
        if (step > 0) return step * std::floor(z / tread);
        double sum = crease * (2 * std::floor(z / 4) + std::clamp(z - 4 * std::floor(z / 4) - 2, 0.0, 2.0));
        for (const Wave& w : waves) sum += w.slope / std::hypot(w.x, w.z) * std::sin(w.x * x + w.z * z);
        return sum;
    }
    Vector3d normal(double x, double z) const
    {
        Vector3d n(0, 1, z - 4 * std::floor(z / 4) > 2 ? -crease : 0);
        for (const Wave& w : waves) {
            const double rise = w.slope / std::hypot(w.x, w.z) * std::cos(w.x * x + w.z * z);
            n -= rise * Vector3d(w.x, 0, w.z);
        }
        return step > 0 ? Vector3d(0, 1, 0) : n.normalized();
    }
    // Where roots go: on stairs along a ramp.
    double root_height(const Vector3d& at) const { return step > 0 ? step * at.z() / tread : height(at.x(), at.z()); }
    // How far a point is over the ground right below it.
    double over(const Vector3d& point) const { return point.y() - height(point.x(), point.z()); }
};
// Slopes of up to 25 degrees, with 3 to 5 metres from hill to hill.
inline Terrain bumpy_field() { return {{{0.71, 0.94, 0.16}, {-1.41, 1.12, 0.16}, {0.53, -2, 0.146}}}; }
inline Terrain stairs() { return {{}, 0.17}; }
// Ground of triangles, with creases of 20 degrees.
inline Terrain creased() { return {{}, 0, 0.3, std::tan(20 * std::numbers::pi / 180)}; }

struct GroundSample {
    Float3 place, normal;
    bool operator==(const GroundSample&) const = default;
};

// How one body walks.
struct Walk {
    Vector3d from;
    double heading, bend;  // radians; radians a metre
    double speed, period, start;

    Vector3d place(double t) const
    {
        const double s = speed * t, a = heading + bend * s;
        if (std::fabs(bend) < 1e-6) return from + s * Vector3d(std::sin(a), 0, std::cos(a));
        return from + Vector3d(std::cos(heading) - std::cos(a), 0, std::sin(a) - std::sin(heading)) / bend;
    }
    double facing(double t) const { return heading + bend * speed * t; }
};

inline double smooth(double u)
{
    u = std::clamp(u, 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

struct HillWalkers {
    static constexpr double kThigh = 0.45, kShin = 0.43, kPelvis = 0.89;
    static constexpr double kStance = 0.56;  // of a stride, in which the toe is in contact
    static constexpr Float3 kToe{0, -0.07f, 0.13f}, kHeel{0, -0.07f, -0.05f};  // in the foot's frame
    static constexpr swivel_features kFeatures = SWIVEL_WITH_PLANT | SWIVEL_WITH_EFFECTOR | SWIVEL_WITH_HAND |
                                                 SWIVEL_WITH_GROUND | SWIVEL_WITH_CAP | SWIVEL_WITH_PELVIS_FIT |
                                                 SWIVEL_HAND_YIELDS | SWIVEL_POLE_INCOMING | SWIVEL_WITH_RECORD;

    Terrain terrain;
    BodySkeleton skeleton = legs();
    std::vector<Walk> walks;
    swivel_plant plant = swivel_default_plant();
    swivel_ground ground = sole();
    swivel_shift_def shift_def = swivel_default_shift_def();
    // The present frame:
    std::vector<Body> bodies;
    std::vector<Vector3d> roots;
    std::vector<float> times;
    std::array<std::vector<float>, 2> labels;
    std::vector<Double3> root_doubles;
    Vector3d origin = Vector3d::Zero();  // with roots in doubles, where all of it is; and what they stand on
    Double3 support{};
    bool has_doubles = false;
    std::vector<Float3> supports;  // of each body, if any
    std::vector<Float4> support_turns;

    HillWalkers(std::uint64_t seed, std::uint32_t count, Terrain on) : terrain(std::move(on))
    {
        shift_def.drop = 0.2f;  // on a slope of 25 degrees the feet of a step are 0.3 m apart in height
        Random random{seed};
        for (std::uint32_t n = 0; n < count; ++n) {
            const double speed = random.between(0.5, 1.15);
            walks.push_back({Vector3d{random.between(-4, 4), 0, random.between(-4, 4)}, random.between(-3.1, 3.1),
                             random.between(-0.15, 0.15), speed, random.between(1, 1.15), random.unit()});
        }
        go_to(0);
    }
    std::uint32_t count() const { return static_cast<std::uint32_t>(walks.size()); }
    void go_to(int frame)
    {
        const double t = frame * kWalkTime;
        bodies.clear(), roots.clear(), root_doubles.clear();
        times.assign(walks.size(), static_cast<float>(kWalkTime));
        for (std::size_t leg = 0; leg < 2; ++leg) labels[leg].assign(walks.size(), 0);
        for (std::size_t n = 0; n < walks.size(); ++n) {
            const Walk& walk = walks[n];
            Vector3d place = walk.place(t);
            place.y() = terrain.root_height(place);
            Body body;
            body.rotations.assign(skeleton.size(), {0, 0, 0, 1});
            body.translations = skeleton.translations;
            body.scales.assign(skeleton.size(), {1, 1, 1});
            body.root_rotation = floats(Quaterniond(Eigen::AngleAxisd(walk.facing(t), Vector3d::UnitY())));
            for (std::size_t leg = 0; leg < 2; ++leg) labels[leg][n] = pose(walk, t, leg, body);
            const Vector3d world = place + origin;
            root_doubles.push_back({world.x(), world.y(), world.z()});
            body.root_position = floats(place);
            roots.push_back(has_doubles ? place : vec(body.root_position));
            bodies.push_back(body);
        }
        support = {origin.x(), origin.y(), origin.z()};
    }
    PoseBuffer poses() const { return PoseBuffer({.roots = true}, bodies); }
    Crowd crowd(swivel_features features = kFeatures, swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE) const
    {
        const std::vector<Definition> shifts(features & SWIVEL_WITH_PELVIS_FIT ? 1 : 0, shift_def);
        const auto edit = [&](swivel_body_limb_def& limb) {
            limb.plant = plant, limb.ground = ground, limb.on_bad_input = on_bad_input;
        };
        Crowd made = body_crowd(skeleton, features, count(), edit, shifts);
        for (std::uint32_t leg = 0; leg < 2; ++leg) {
            made.write_all(SWIVEL_EFFECTOR, leg, kToe);
            // Straighter than it starts: where ground is low, legs that swing stretch further than they are animated.
            if (features & SWIVEL_WITH_CAP) made.write_all(SWIVEL_CAP, leg, Float3{0.01f, 0.95f, 0});
        }
        return made;
    }
    // The pose in a buffer, with the present frame's roots, times and support.
    swivel_pose view(PoseBuffer& buffer) const
    {
        swivel_pose pose = buffer.view();
        pose.time = {times.data(), sizeof(float)};
        if (!supports.empty()) {
            pose.support_position = {supports.data(), sizeof(Float3)};
            pose.support_rotation = {support_turns.data(), sizeof(Float4)};
        }
        if (!has_doubles) return pose;
        pose.root_is_double = 1;
        pose.root_position = {root_doubles.data(), sizeof(Double3)};
        pose.support_position = {support.data(), 0};
        return pose;
    }
    void write_labels(Crowd& crowd) const
    {
        for (std::uint32_t leg = 0; leg < 2; ++leg)
            if (!(swivel_group_features(crowd.get(), leg) & SWIVEL_PLANT_BY_MOTION))
                crowd.write(SWIVEL_CONTACT, leg, labels[leg]);
    }
    // The ground below a place, in the space of a limb's targets.
    GroundSample sample(std::uint32_t body, const Float3& probe) const
    {
        const Vector3d root = has_doubles ? roots[body] : Vector3d(Vector3d::Zero()), at = vec(probe) + root;
        Vector3d below(at.x(), terrain.height(at.x(), at.z()), at.z());
        if (at.z() > terrain.end) below.setConstant(std::nan(""));
        return {floats(Vector3d(below - root)), floats(terrain.normal(at.x(), at.z()))};
    }
    std::vector<GroundSample> samples(const Crowd& crowd, std::uint32_t leg) const
    {
        std::vector<Float3> probes(count());
        crowd.read(SWIVEL_PROBE, leg, std::span(probes));
        std::vector<GroundSample> of;
        for (std::uint32_t n = 0; n < count(); ++n) of.push_back(sample(n, probes[n]));
        return of;
    }
    static void write(Crowd& crowd, std::uint32_t leg, const std::vector<GroundSample>& of)
    {
        const auto size = static_cast<std::uint32_t>(of.size());
        check(swivel_write(crowd.get(), SWIVEL_GROUND, leg, 0, size, {&of[0].place, sizeof of[0]}));
        check(swivel_write(crowd.get(), SWIVEL_GROUND_NORMAL, leg, 0, size, {&of[0].normal, sizeof of[0]}));
    }
    static void store(const swivel_probes& probes, std::uint32_t n, const GroundSample& of)
    {
        std::copy(of.place.begin(), of.place.end(), probes.grounds[n]);
        std::copy(of.normal.begin(), of.normal.end(), probes.normals[n]);
    }
    // A sample function; user: these walkers.
    static void answer(const swivel_probes* probes, void* user)
    {
        const auto& walkers = *static_cast<const HillWalkers*>(user);
        for (std::uint32_t n = 0; n < probes->count; ++n)
            store(
                *probes, n,
                walkers.sample(probes->bodies[n], {probes->places[n][0], probes->places[n][1], probes->places[n][2]}));
    }
    // With the ground that is written.
    void solve(Crowd& crowd, PoseBuffer& buffer) const
    {
        write_labels(crowd);
        solve_poses(crowd, view(buffer));
    }
    // With the ground that the solve asks for.
    void ask_and_solve(Crowd& crowd, PoseBuffer& buffer) const
    {
        write_labels(crowd);
        const swivel_pose pose = view(buffer);
        swivel_job job = swivel_default_job();
        job.pose = &pose;
        job.sample = answer;
        job.sample_user = const_cast<HillWalkers*>(this);
        check(swivel_solve(crowd.get(), &job));
    }

    // Where a body's legs are by forward kinematics: in the world, and shifted.
    struct Leg {
        Vector3d toe, heel;
        Quaterniond thigh, shin, foot;
    };
    Leg leg(const PoseBuffer& buffer, std::uint32_t body, std::size_t leg, double shift) const
    {
        const std::vector<JointAt> at = joints_at(skeleton, buffer.read(body, bodies[body]));
        const BodyLimbJoints& joints = skeleton.limbs[leg];
        const JointAt& foot = at[joints.wrist];
        const Vector3d ankle = roots[body] + shift * Vector3d::UnitY() + foot.place;
        return {ankle + foot.rotation * vec(kToe), ankle + foot.rotation * vec(kHeel), at[joints.shoulder].rotation,
                at[joints.elbow].rotation, foot.rotation};
    }

private:
    static BodySkeleton legs()
    {
        BodySkeleton of;
        of.parents = {-1, 0, 1, 2, 0, 4, 5};  // pelvis; thigh, shin and foot
        of.rotations.assign(7, {0, 0, 0, 1});
        of.translations.push_back({0, static_cast<float>(kPelvis), 0});
        for (const float side : {0.1f, -0.1f}) {
            of.translations.push_back({side, 0, 0});
            of.translations.push_back({0, static_cast<float>(-kThigh), 0});
            of.translations.push_back({0, static_cast<float>(-kShin), 0});
        }
        of.limbs = {{1, 2, 3, {0, 0, -1}, {}}, {4, 5, 6, {0, 0, -1}, {}}};
        return of;
    }
    static swivel_ground sole()
    {
        swivel_ground of = swivel_default_ground();
        std::copy(kHeel.begin(), kHeel.end(), of.heel);
        return of;
    }
    // Poses a leg and says whether its toe is in contact: 1 or 0.
    static float pose(const Walk& walk, double t, std::size_t leg, Body& body)
    {
        const double whole = t / walk.period + walk.start + 0.5 * static_cast<double>(leg),
                     phase = whole - std::floor(whole);
        const double stance = walk.speed * walk.period * kStance, front = 0.5 * stance + 0.03;
        double ahead = front - walk.speed * walk.period * phase, height = 0,
               pitch = 0.75 * smooth((phase - 0.34) / 0.26);
        if (phase > kStance) {
            // A cubic whose ends go as fast as the ground.
            const double u = (phase - kStance) / (1 - kStance), back = front - stance;
            const double way = -walk.speed * walk.period * (1 - kStance);
            ahead = back + (front - back) * smooth(u) + way * u * (1 - u) * (1 - 2 * u);
            height = 0.05 * std::pow(std::sin(std::numbers::pi * u), 2);
            pitch = 0.75 * smooth((phase - 0.34) / 0.26) - 1.0 * smooth((phase - 0.62) / 0.25) +
                    0.25 * smooth((phase - 0.87) / 0.13);
        }
        // The foot's pitch is about its toe, with toes down.
        const Quaterniond foot(Eigen::AngleAxisd(pitch, Vector3d::UnitX()));
        const Vector3d ankle = Vector3d(0, height, ahead) - foot * vec(kToe), line = ankle - Vector3d(0, kPelvis, 0);
        const double distance = std::min(line.norm(), 0.999 * (kThigh + kShin));
        const double at_hip =
                         std::acos((kThigh * kThigh + distance * distance - kShin * kShin) / (2 * kThigh * distance)),
                     at_knee =
                         std::acos((kThigh * kThigh + kShin * kShin - distance * distance) / (2 * kThigh * kShin));
        const double thigh = std::atan2(-line.z(), -line.y()) - at_hip, knee = std::numbers::pi - at_knee;
        const std::size_t first = 1 + 3 * leg;
        const auto about_x = [](double angle) {
            return floats(Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitX())));
        };
        body.rotations[first] = about_x(thigh);
        body.rotations[first + 1] = about_x(knee);
        body.rotations[first + 2] = about_x(pitch - thigh - knee);
        return phase <= kStance ? 1.0f : 0.0f;
    }
};

}  // namespace swivel::test
