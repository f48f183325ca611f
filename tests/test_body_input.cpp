// SPDX-License-Identifier: MIT
//
// The promise: bad input costs its own limb, and nothing else. Where no weight asks for more, the incoming bits stay.
// What a crowd of bodies cannot be made of, and what is no pose, gets one line.
#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>

#include "tests/body_crowd.h"
#include "tests/complaint.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN();

// A skeleton whose limbs all hang below joint 0.
BodySkeleton skeleton_of(Random& random) { return random_body_skeleton(random, {2, 3, 1, true}); }

std::uint32_t limb_flags(const Crowd& crowd, std::uint32_t group, std::uint32_t body)
{
    std::uint32_t flags = 0;
    check(swivel_read(crowd.get(), SWIVEL_FLAGS, group, body, 1, {&flags, sizeof flags}));
    return flags;
}

struct PosedStage {
    BodySkeleton skeleton;
    std::vector<Body> bodies;
    BodyGoals goals;
    Crowd crowd;
    PoseLayout layout;

    PosedStage(std::uint64_t seed, swivel_features features)
        : skeleton([&] {
              Random random{seed};
              return skeleton_of(random);
          }()),
          crowd(body_crowd(skeleton, features, 20))
    {
        Random random{seed + 1};
        layout.translates = layout.scales = layout.roots = true;
        for (int n = 0; n < 20; ++n) bodies.push_back(random_body(random, skeleton, {true, true, true}));
        for (std::size_t limb = 0; limb < skeleton.limbs.size(); ++limb) {
            goals.emplace_back();
            for (const Body& body : bodies) goals.back().push_back(random_goal(random, skeleton, body, limb));
        }
        write_goals(crowd, goals);
    }
};

}  // namespace

TEST_CASE("bad input of a joint is that of the limbs below it, which keep their pose")
{
    const auto number = GENERATE(0, 1, 2, 3, 4, 5, 6, 7, 8, 9);
    PosedStage stage(1, SWIVEL_WITH_HAND);
    PoseBuffer good(stage.layout, stage.bodies);
    solve_poses(stage.crowd, good.view());
    const std::uint64_t digest = swivel_digest(stage.crowd.get());

    constexpr std::size_t body = 17;
    Body& bad = stage.bodies[body];
    const BodyLimbJoints& limb = stage.skeleton.limbs[1];
    bool is_whole_body = false;
    switch (number) {
        case 0:
            bad.rotations[limb.shoulder][2] = kNotANumber;
            break;
        case 1:
            bad.rotations[limb.elbow] = {0, 0, 0, 0};
            break;
        case 2:
            bad.translations[limb.wrist][0] = kNotANumber;
            break;
        case 3:
            bad.translations[limb.elbow][1] = INFINITY;
            break;
        case 9:
            bad.rotations[limb.wrist][0] = kNotANumber;
            break;
        case 4:
            bad.scales[limb.elbow] = {1, 1, 1.01f};
            break;
        case 5:
            bad.scales[limb.shoulder] = {-1, -1, -1};
            break;
        case 6:
            bad.rotations[0] = {INFINITY, 0, 0, 1};
            is_whole_body = true;
            break;
        case 7:
            bad.root_position[1] = kNotANumber;
            is_whole_body = true;
            break;
        default:
            bad.root_scale = 0;
            is_whole_body = true;
            break;
    }
    PoseBuffer poses(stage.layout, stage.bodies);
    const std::vector<unsigned char> before = poses.bytes;
    Crowd crowd = body_crowd(stage.skeleton, SWIVEL_WITH_HAND, 20);
    write_goals(crowd, stage.goals);
    solve_poses(crowd, poses.view());
    REQUIRE(swivel_digest(crowd.get()) != digest);
    for (std::uint32_t n = 0; n < 20; ++n)
        for (std::uint32_t g = 0; g < 3; ++g) {
            const bool is_bad = n == body && (is_whole_body || g == 1);
            INFO("case " << number << ", body " << n << ", group " << g);
            REQUIRE((limb_flags(crowd, g, n) == SWIVEL_BAD_INPUT) == is_bad);
            const BodyLimbJoints& joints = stage.skeleton.limbs[g];
            for (const std::uint32_t joint : {joints.shoulder, joints.elbow, joints.wrist}) {
                const std::size_t at = n * poses.body_stride + joint * 16;
                REQUIRE(std::memcmp(&poses.bytes[at], is_bad ? &before[at] : &good.bytes[at], 16) == 0);
            }
        }
}

TEST_CASE("a matrix that is slanted or uneven is bad input")
{
    PosedStage stage(2, 0);
    stage.layout.form = SWIVEL_MATRIX_COLUMNS;
    PoseBuffer poses(stage.layout, stage.bodies);
    const BodyLimbJoints& limb = stage.skeleton.limbs[0];
    const std::uint32_t elbow = limb.elbow, bad = GENERATE(true, false) ? elbow : limb.wrist;
    const bool is_slanted = GENERATE(true, false);
    float* const column = reinterpret_cast<float*>(&poses.bytes[5 * poses.body_stride + bad * 64]);
    for (int n = 0; n < 3; ++n) column[n] = is_slanted ? column[n] + 0.01f * column[4 + n] : 1.01f * column[n];
    const std::vector<unsigned char> before = poses.bytes;
    solve_poses(stage.crowd, poses.view());
    for (std::uint32_t n = 0; n < 20; ++n)
        for (std::uint32_t g = 0; g < 3; ++g)
            REQUIRE((limb_flags(stage.crowd, g, n) == SWIVEL_BAD_INPUT) == (n == 5 && g == 0));
    for (const std::uint32_t joint : {stage.skeleton.limbs[0].shoulder, elbow}) {
        const std::size_t at = 5 * poses.body_stride + joint * 64;
        REQUIRE(std::memcmp(&poses.bytes[at], &before[at], 64) == 0);
    }
}

TEST_CASE("without any weight the incoming bits stay, in every form")
{
    const int form = GENERATE(0, 1, 2, 3);
    PosedStage stage(3, SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS | SWIVEL_POLE_INCOMING);
    for (std::uint32_t g = 0; g < 3; ++g) stage.crowd.write_all(SWIVEL_WEIGHTS, g, Float3{0, 0, 0});
    stage.layout.form = static_cast<swivel_pose_form>(form);
    for (Body& body : stage.bodies)
        for (Float4& q : body.rotations)
            for (float& x : q) x *= 3;  // of any length, and of either sign
    PoseBuffer poses(stage.layout, stage.bodies);
    const std::vector<unsigned char> before = poses.bytes;
    solve_poses(stage.crowd, poses.view());
    REQUIRE(poses.bytes == before);
    for (std::uint32_t n = 0; n < 20; ++n) REQUIRE(limb_flags(stage.crowd, 0, n) == SWIVEL_REACHED);
}

TEST_CASE("lengths that are written count instead of the pose's")
{
    PosedStage stage(4, 0);
    for (std::uint32_t g = 0; g < 3; ++g) stage.crowd.write_all(SWIVEL_LENGTHS, g, Float2{1e-3f, 1e-3f});
    PoseBuffer poses(stage.layout, stage.bodies);
    solve_poses(stage.crowd, poses.view());
    for (std::uint32_t n = 0; n < 20; ++n) REQUIRE(limb_flags(stage.crowd, 0, n) == SWIVEL_CLAMPED_FAR);
}

TEST_CASE("limbs rest where they are told to, and a body that kept its pose keeps it")
{
    PosedStage stage(5, SWIVEL_WITH_HAND);
    const swivel_limb_joints joints = stage.skeleton.joints(0);
    swivel_group_def group = swivel_default_body_group_def(&joints);
    group.on_bad_input = SWIVEL_REST_POSE;
    const swivel_skeleton view = stage.skeleton.view();
    swivel_crowd_def def = swivel_default_crowd_def();
    def.skeleton = &view, def.body_count = 20, def.groups = &group, def.group_count = 1;
    Crowd crowd(def);  // no target is written
    const int form = GENERATE(0, 1, 2, 3);
    stage.layout.form = static_cast<swivel_pose_form>(form);
    PoseBuffer poses(stage.layout, stage.bodies);
    solve_poses(crowd, poses.view());
    for (std::size_t n = 0; n < 20; ++n) {
        const Body body = poses.read(n, stage.bodies[n]);
        for (const std::uint32_t joint : {joints.shoulder, joints.elbow})
            REQUIRE(distance(quat(body.rotations[joint]), quat(stage.skeleton.rotations[joint]).normalized()) < 1e-6);
    }
}

TEST_CASE("crowds and poses that cannot be get a line")
{
    Random random{6};
    const BodySkeleton skeleton = skeleton_of(random);
    const swivel_skeleton view = skeleton.view();
    swivel_limb_joints joints[2] = {skeleton.joints(0), skeleton.joints(1)};
    swivel_group_def groups[2] = {swivel_default_body_group_def(&joints[0]), swivel_default_body_group_def(&joints[1])};
    swivel_crowd_def def = swivel_default_crowd_def();
    def.skeleton = &view, def.body_count = 3, def.groups = groups, def.group_count = 2;
    const auto refused = [&](const char* line) {
        swivel_crowd* crowd = nullptr;
        REQUIRE(swivel_crowd_create(&def, &crowd) == SWIVEL_INVALID_ARGUMENT);
        REQUIRE(std::string(swivel_last_error()).find(line) != std::string::npos);
        REQUIRE(swivel_crowd_bytes(&def) == 0);
    };
    SECTION("no bodies") { def.body_count = 0, refused("no bodies"); }
    SECTION("no skeleton") { def.skeleton = nullptr, refused("no skeleton"); }
    SECTION("no joints") { groups[1].joints = nullptr, refused("group 1 names no joints"); }
    SECTION("other counts") { groups[1].limb_count = 2, refused("group 1 has 2 limbs, but there are 3 bodies"); }
    SECTION("a joint twice") { joints[1] = joints[0], refused("group 0 turns joint"); }
    SECTION("no limb") { joints[1].elbow = 0, refused("group 1: the elbow, joint 0, is not below"); }
    SECTION("joints of a binding") { groups[0].features = SWIVEL_JOINTS, refused("excludes SWIVEL_JOINTS"); }
    SECTION("a limb below another")
    {
        constexpr std::array<std::int32_t, 7> parents = {-1, 0, 1, 2, 3, 4, 5};
        constexpr std::array<Float3, 7> offsets = {
            {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}}};
        swivel_skeleton chain = swivel_default_skeleton();
        chain.parents = {parents.data(), 4}, chain.translations = {offsets.data(), 12}, chain.joint_count = 7;
        joints[0] = swivel_default_limb_joints(1, 2, 3), joints[1] = swivel_default_limb_joints(4, 5, 6);
        joints[0].bend[1] = joints[1].bend[1] = 1;
        def.skeleton = &chain;
        refused("group 0 turns joint 1, which is above joint 4 of group 1");
    }
    SECTION("twist bones that no joint is")
    {
        groups[0].features = SWIVEL_WITH_HAND | 2 * SWIVEL_WITH_TWIST_BONES;
        refused("group 0: its features have 2 twist bones, its joints 0");
    }
    SECTION("a clavicle that no joint is")
    {
        constexpr std::array<std::int32_t, 3> parents = {-1, 0, 1};
        constexpr std::array<Float3, 3> offsets = {{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}};
        swivel_skeleton arm = swivel_default_skeleton();
        arm.parents = {parents.data(), 4}, arm.translations = {offsets.data(), 12}, arm.joint_count = 3;
        joints[0] = swivel_default_limb_joints(0, 1, 2);
        joints[0].bend[1] = 1;
        groups[0].features = SWIVEL_WITH_CLAVICLE;
        def.skeleton = &arm, def.group_count = 1;
        refused("group 0: the shoulder, joint 0, has no parent");
    }
    SECTION("a joint below nothing")
    {
        std::vector<std::int32_t> parents = skeleton.parents;
        parents.push_back(900);  // of a joint that no limb needs
        swivel_skeleton longer = view;
        longer.parents = {parents.data(), 4}, longer.joint_count = static_cast<std::uint32_t>(parents.size());
        def.skeleton = &longer;
        refused("'s parent is 900; give -1 for a root");
    }
    SECTION("calls that need a record")
    {
        Crowd crowd(def);
        char text[100];
        std::uint32_t count = 0;
        double number = 0;
        REQUIRE(swivel_explain(crowd.get(), 0, 0, text, sizeof text) == SWIVEL_INVALID_ARGUMENT);
        REQUIRE(swivel_allowed_arcs(crowd.get(), 0, 0, nullptr, 0, &count) == SWIVEL_INVALID_ARGUMENT);
        REQUIRE(swivel_residuals(crowd.get(), 0, 0, 1, {&number, 8}) == SWIVEL_INVALID_ARGUMENT);
        REQUIRE(swivel_forward(crowd.get(), 0, 0, 0, {}, {}, {}) == SWIVEL_INVALID_ARGUMENT);
        REQUIRE(std::string(swivel_last_error()).find("create it with SWIVEL_WITH_RECORD") != std::string::npos);
        Crowd free({group(1)});
        const swivel_pose pose = swivel_default_pose();
        REQUIRE_THROWS_WITH(free.solve({.pose = &pose}), Catch::Contains("no bodies"));
    }
    SECTION("poses")
    {
        Crowd crowd(def);
        const auto no_pose = [&](const swivel_pose* pose, const char* line) {
            swivel_job job = swivel_default_job();
            job.pose = pose;
            REQUIRE(swivel_solve(crowd.get(), &job) == SWIVEL_INVALID_ARGUMENT);
            INFO(swivel_last_error());
            REQUIRE(std::string(swivel_last_error()).find(line) != std::string::npos);
        };
        std::vector<Float4> rotations(3 * skeleton.size(), Float4{0, 0, 0, 1});
        swivel_pose pose = swivel_default_pose();
        no_pose(nullptr, "give the job their pose");
        no_pose(&pose, "no rotations");
        pose.rotations = {rotations.data(), skeleton.size() * 16, 16, nullptr};
        pose.rotations.body_stride = 0;
        no_pose(&pose, "body_stride 0 is smaller");
        pose.rotations.body_stride = skeleton.size() * 16, pose.rotations.joint_stride = 12;
        no_pose(&pose, "joint_stride 12 is smaller than a value, 16");
        pose.rotations.joint_stride = 16, pose.root_is_double = 1;
        no_pose(&pose, "has no position");
        pose.root_is_double = 0, pose.root_rotation = {rotations.data(), 8};
        no_pose(&pose, "root_rotation: stride 8");
        pose.root_rotation = {}, pose.form = SWIVEL_MATRIX_ROWS, pose.scales = pose.rotations;
        no_pose(&pose, "matrices and scales");
        std::uint32_t form = 77;
        std::memcpy(&pose.form, &form, sizeof form);
        no_pose(&pose, "form is 77");
        pose = swivel_default_pose();
        pose.rotations = {rotations.data(), skeleton.size() * 16, 16, nullptr};
        pose.translation_results = pose.rotations;
        no_pose(&pose, "only translations in the body's space change");
        pose.space = SWIVEL_IN_BODY, pose.translations = pose.results = pose.rotations, pose.translation_results = {};
        no_pose(&pose, "no translation_results");
        pose.translation_results = pose.rotations, pose.joint_places = {rotations.data(), 8, 16, nullptr};
        no_pose(&pose, "joint_places: body_stride 8");
        std::memcpy(&pose.space, &form, sizeof form);
        no_pose(&pose, "space is 77");
    }
    SECTION("what a pose gives")
    {
        Crowd crowd(def);
        REQUIRE_THROWS_WITH(crowd.write_all(SWIVEL_PARENT_SCALE, 0, std::array{1.0f}),
                            Catch::Contains("the pose of a body gives it"));
    }
}

TEST_CASE("a pose of an older header is read as far as it goes")
{
    PosedStage stage(9, SWIVEL_WITH_HAND);
    PoseBuffer whole(stage.layout, stage.bodies), older(stage.layout, stage.bodies);
    solve_poses(stage.crowd, whole.view());
    swivel_pose pose = older.view();
    pose.size = offsetof(swivel_pose, space);
    pose.reserved = 1;  // beyond its end
    solve_poses(stage.crowd, pose);
    REQUIRE(whole.bytes == older.bytes);
}
