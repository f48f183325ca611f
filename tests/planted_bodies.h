// SPDX-License-Identifier: MIT
//
// A crowd of bodies that move, with limbs that are planted, frame after frame; on the ground, on supports that move and
// turn, and far away in doubles.
#pragma once

#include "tests/body_crowd.h"
#include "tests/test_crowd.h"

namespace swivel::test {

using Double3 = std::array<double, 3>;
using PlantBits = std::array<std::uint32_t, 11>;

inline constexpr swivel_features kPlanted =
    SWIVEL_WITH_PLANT | SWIVEL_WITH_RECORD | SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND;

enum class Ground { still, moving, far };

// The same frames whenever they are asked for.
struct PlantedBodies {
    BodySkeleton skeleton;
    std::uint32_t body_count;
    Ground ground;
    std::vector<Body> start;
    std::vector<std::vector<Vector3d>> axes;  // of each body's joints
    PoseLayout layout;
    // The present frame:
    int frame = 0;
    std::vector<Body> bodies;
    std::vector<Vector3d> roots;  // where they really are
    std::vector<float> times;
    std::vector<Double3> root_doubles, support_doubles;
    std::vector<Float3> supports;
    std::vector<Float4> support_turns;
    std::vector<std::vector<float>> labels;  // of each group
    PoseBuffer poses;

    PlantedBodies(std::uint64_t seed, Ground on, std::uint32_t count = 40, std::uint32_t limbs = 3)
        : body_count(count), ground(on), poses({}, 0, 0)
    {
        Random random{seed};
        skeleton = random_body_skeleton(random, {3, limbs, 1, false});
        for (std::uint32_t n = 0; n < count; ++n) {
            start.push_back(random_body(random, skeleton, {.roots = true, .max_bend = 2}));
            start.back().root_scale = static_cast<float>(random.spread(0.5, 2));
            axes.emplace_back();
            for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint) axes.back().push_back(random.direction());
        }
        layout.roots = true;
        labels.assign(limbs, std::vector<float>(count));
        go_to(0);
    }
    // Every value of a frame: bodies sway, and walk on.
    void go_to(int n)
    {
        frame = n;
        Random random{static_cast<std::uint64_t>(1000 + n)};
        bodies = start;
        roots.assign(body_count, Vector3d::Zero());
        times.assign(body_count, 0);
        supports.assign(body_count, {}), support_turns.assign(body_count, {0, 0, 0, 1});
        root_doubles.assign(body_count, {}), support_doubles.assign(body_count, {});
        for (std::uint32_t b = 0; b < body_count; ++b) {
            const double t = n / 60.0 + b;
            Body& body = bodies[b];
            for (std::uint32_t joint = 0; joint < skeleton.size(); ++joint)
                body.rotations[joint] = floats(Quaterniond(
                    quat(body.rotations[joint]) * Eigen::AngleAxisd(0.04 * std::sin(3 * t + joint), axes[b][joint])));
            times[b] = n == 0 ? 0 : static_cast<float>(random.between(0.7, 1.3) / 60);
            place(b, t, 0.02 * body.root_scale * Vector3d(std::sin(2 * t), 0.5 * std::cos(3 * t), std::sin(t)));
            for (std::size_t g = 0; g < labels.size(); ++g)
                labels[g][b] = (n + 11 * static_cast<int>(b) + 17 * static_cast<int>(g)) % 60 < 40;
        }
        poses = PoseBuffer(layout, bodies);
    }
    Crowd crowd(swivel_features features, const swivel_plant& plant = swivel_default_plant(),
                swivel_on_bad_input on_bad_input = SWIVEL_KEEP_POSE) const
    {
        return body_crowd(skeleton, features, body_count,
                          [&](swivel_body_limb_def& limb) { limb.plant = plant, limb.on_bad_input = on_bad_input; });
    }
    swivel_pose view()
    {
        swivel_pose pose = poses.view();
        pose.time = {times.data(), sizeof(float)};
        pose.support_rotation = {support_turns.data(), sizeof(Float4)};
        pose.support_position = {supports.data(), sizeof(Float3)};
        if (ground == Ground::far) {
            pose.root_is_double = 1;
            pose.root_position = {root_doubles.data(), sizeof(Double3)};
            pose.support_position = {support_doubles.data(), sizeof(Double3)};
        }
        return pose;
    }
    void write_labels(Crowd& crowd) const
    {
        for (std::uint32_t g = 0; g < labels.size(); ++g)
            if (!(swivel_group_features(crowd.get(), g) & SWIVEL_PLANT_BY_MOTION))
                crowd.write(SWIVEL_CONTACT, g, labels[g]);
    }
    void solve(Crowd& crowd)
    {
        write_labels(crowd);
        solve_poses(crowd, view());
    }
    Vector3d support_place(std::uint32_t b) const
    {
        return ground == Ground::far ? Vector3d(support_doubles[b].data()) : vec(supports[b]);
    }
    // Where a place in the support's frame is in the world.
    Vector3d on_support(std::uint32_t b, const Vector3d& place) const
    {
        return support_place(b) + quat(support_turns[b]).normalized() * place;
    }

private:
    void place(std::uint32_t b, double t, const Vector3d& way)
    {
        Body& body = bodies[b];
        const Vector3d root = vec(body.root_position) + way;
        body.root_position = floats(root), roots[b] = vec(body.root_position);
        if (ground == Ground::moving) {
            const Quaterniond turn(Eigen::AngleAxisd(0.3 * std::sin(t), Vector3d(1, 2, 2) / 3));
            const Vector3d shift(std::sin(t), 2 * std::sin(0.5 * t), t);
            supports[b] = floats(shift), support_turns[b] = floats(turn);
            body.root_position = floats(Vector3d(shift + turn * root)), roots[b] = vec(body.root_position);
            body.root_rotation = floats(Quaterniond(turn * quat(body.root_rotation).normalized()));
        } else if (ground == Ground::far) {
            const Vector3d tile(1e6 + 0.3, -2e6 - 0.7, 0.5e6);
            support_doubles[b] = {tile.x(), tile.y(), tile.z()};
            roots[b] = tile + root;
            root_doubles[b] = {roots[b].x(), roots[b].y(), roots[b].z()};
        }
    }
};

// Where a limb's point stands in its support's frame, and the bits of that.
inline Vector3d mark_of(const Crowd& crowd, std::uint32_t group, std::uint32_t body)
{
    const auto plant = value_of<std::array<float, 11>>(crowd, SWIVEL_PLANT, group, body);
    return {plant[0], plant[1], plant[2]};
}
inline PlantBits plant_bits(const Crowd& crowd, std::uint32_t group, std::uint32_t body)
{
    return value_of<PlantBits>(crowd, SWIVEL_PLANT, group, body);
}
inline bool is_same_mark(const PlantBits& a, const PlantBits& b) { return std::equal(&a[0], &a[3], &b[0]); }

}  // namespace swivel::test
