// SPDX-License-Identifier: MIT
//
// The promise: hard poses are data. Each gets its flags and a unit pose, with the wrist at the nearest reachable point.
// Bad input gets the rest pose and a flag, and no other limb changes by a bit.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "simd/fields.h"
#include "tests/test_whole_limb.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kReached = SWIVEL_REACHED, kFar = SWIVEL_CLAMPED_FAR, kNear = SWIVEL_CLAMPED_NEAR,
                        kUndefined = SWIVEL_SWIVEL_UNDEFINED, kBad = SWIVEL_BAD_INPUT;

struct HardPose {
    const char* name;
    Arm arm;
    std::uint32_t flags;
};

const Vector3d kBack = {0, -1, 0};

// clang-format off
const HardPose hard_poses[] = {
    {"exactly straight",                     {{0, 0, 2}, kBack, 1, 1}, kReached},
    {"exactly straight, other bones",        {{3, 0, 0}, kBack, 1, 2}, kReached},
    {"exactly folded",                       {{0, 0, 1}, kBack, 2, 1}, kReached},
    {"exactly folded, longer forearm",       {{0, 1, 0}, {1, 0, 0}, 1, 2}, kReached},
    {"equal bones, target on the shoulder",  {{0, 0, 0}, kBack, 1, 1}, kReached | kUndefined},
    {"unequal bones, target on the shoulder", {{0, 0, 0}, kBack, 1, 2}, kNear | kUndefined},
    {"target nearly on the shoulder",        {{0, 1e-7f, 0}, {1, 0, 0}, 1, 1}, kReached},
    {"target shorter than anything counts",  {{0, 1e-16f, 0}, {1, 0, 0}, 1, 1}, kReached | kUndefined},
    {"target a denormal",                    {{1e-40f, 0, 0}, kBack, 1, 1}, kReached | kUndefined},
    {"zero upper arm, reached",              {{0, 1, 0}, {1, 0, 0}, 0, 1}, kReached},
    {"zero upper arm, too far",              {{0, 2, 0}, {1, 0, 0}, 0, 1}, kFar},
    {"zero upper arm, too near",             {{0, 0.5f, 0}, {1, 0, 0}, 0, 1}, kNear},
    {"zero upper arm, on the shoulder",      {{0, 0, 0}, {1, 0, 0}, 0, 1}, kNear | kUndefined},
    {"zero forearm, reached",                {{0, 0, -1}, {1, 0, 0}, 1, 0}, kReached},
    {"zero forearm, too far",                {{3, 0, 0}, kBack, 1, 0}, kFar},
    {"zero forearm, too near",               {{0.5f, 0, 0}, kBack, 1, 0}, kNear},
    {"zero forearm, on the shoulder",        {{0, 0, 0}, kBack, 1, 0}, kNear | kUndefined},
    {"both bones zero",                      {{0, 1, 0}, {1, 0, 0}, 0, 0}, kFar},
    {"both bones zero, on the shoulder",     {{0, 0, 0}, kBack, 0, 0}, kReached | kUndefined},
    {"upper arm of 3e-12",                   {{0, 1, 0}, {1, 0, 0}, 3e-12f, 1}, kReached},
    {"forearm of 3e-12",                     {{0, 1, 0}, {1, 0, 0}, 1, 3e-12f}, kReached},
    {"both bones of 3e-12",                  {{0, 3e-12f, 0}, {1, 0, 0}, 3e-12f, 3e-12f}, kReached},
    {"both bones of 3e-12, target at 1",     {{0, 1, 0}, {1, 0, 0}, 3e-12f, 3e-12f}, kFar},
    {"upper arm of 1e-15",                   {{0, 1, 0}, {1, 0, 0}, 1e-15f, 1}, kReached},
    {"everything 1e15",                      {{0, 1e15f, 0}, {1e15f, 0, 0}, 1e15f, 1e15f}, kReached},
    {"everything 1e15, straight",            {{0, 1e15f, 0}, {1e15f, 0, 0}, 5e14f, 5e14f}, kReached},
    {"1e15 and 1",                           {{0, 1, 0}, {1e15f, 0, 0}, 1e15f, 1e15f}, kReached},
    {"1e15 and 1e-15",                       {{0, 1e15f, 0}, {1e-15f, 0, 0}, 1e-15f, 1e15f}, kReached},
    {"everything about 1e-15",               {{0, 2e-15f, 0}, {2e-15f, 0, 0}, 2e-15f, 2e-15f}, kReached},
    {"everything about 1e-15, too far",      {{0, 9e-15f, 0}, {2e-15f, 0, 0}, 2e-15f, 2e-15f}, kFar},
    {"1e15 away from bones of 1e-15",        {{0, 0, 1e15f}, kBack, 1e-15f, 1e-15f}, kFar},
    {"pole along the target",                {{0, 1, 1}, {0, 2, 2}, 1, 1}, kReached | kUndefined},
    {"pole opposite the target",             {{0, 1, 1}, {0, -2, -2}, 1, 1}, kReached | kUndefined},
    {"pole along a target along e1",         {{1, 0, 0}, {2, 0, 0}, 1, 1}, kReached | kUndefined},
    {"pole along a target along -e1",        {{-1, 0, 0}, {2, 0, 0}, 1, 1}, kReached | kUndefined},
    {"pole just inside sin 1e-3",            {{0, 0, 1}, {0, 0.999e-3f, 1}, 1, 1}, kReached | kUndefined},
    {"pole just outside sin 1e-3",           {{0, 0, 1}, {0, 1.001e-3f, 1}, 1, 1}, kReached},
    {"pole just inside, opposite",           {{1, 0, 0}, {-1, 0, 0.999e-3f}, 1, 1}, kReached | kUndefined},
    {"pole just outside, opposite",          {{1, 0, 0}, {-1, 0, 1.001e-3f}, 1, 1}, kReached},
    {"no pole",                              {{0, 1, 1}, {0, 0, 0}, 1, 1}, kReached | kUndefined},
    {"no pole, target along e1",             {{1, 0, 0}, {0, 0, 0}, 1, 1}, kReached | kUndefined},
    {"pole shorter than anything counts",    {{0, 0, 1}, {1e-19f, 0, 0}, 1, 1}, kReached | kUndefined},
    {"pole of 1e-14",                        {{0, 0, 1}, {0, 1e-14f, 0}, 1, 1}, kReached},
    {"pole of 1e15",                         {{0, 0, 1}, {0, 1e15f, 0}, 1, 1}, kReached},
    {"target along e3",                      {{0, 0, 1.5f}, kBack, 1, 1}, kReached},
    {"target along -e3",                     {{0, 0, -1.5f}, kBack, 1, 1}, kReached},
    {"target along -e3, other poles",        {{0, 0, -1.5f}, {1, 1, 0}, 1, 1}, kReached},
    {"upper arm exactly e3",                 {{0, 1, 1}, {0, 0, 1}, 1, 1}, kReached},
    {"upper arm exactly -e3",                {{0, 1, -1}, {0, 0, -1}, 1, 1}, kReached},
    {"upper arm exactly -e3, straight",      {{0, 0, -2}, kBack, 1, 1}, kReached},
    {"upper arm exactly -e3, hinge e2",      {{0, 0, -2}, {1, 0, 0}, 1, 1}, kReached},
    {"upper arm exactly -e3, folded",        {{0, 0, -1}, {1, 0, 0}, 2, 1}, kReached},
    {"upper arm a hair off -e3",             {{1e-7f, 0, -2}, {0, 1, 0}, 1, 1}, kFar | kReached},
    {"upper arm level",                      {{2, 0, 0}, {0, 0, -1}, 1, 1}, kReached},
    {"target beyond reach",                  {{0, 5, 0}, {1, 0, 0}, 1, 1}, kFar},
    {"target beyond reach, pole undefined",  {{0, 5, 0}, {0, 1, 0}, 1, 1}, kFar | kUndefined},
    {"target an ulp beyond reach",           {{0, 0, 2.0000002f}, kBack, 1, 1}, kFar},
    {"target too near",                      {{0, 0.5f, 0}, {1, 0, 0}, 2, 1}, kNear},
    {"target too near, longer forearm",      {{0, 0.5f, 0}, {1, 0, 0}, 1, 2}, kNear},
    {"target an ulp too near",               {{0, 0, 0.99999994f}, kBack, 2, 1}, kNear},
    {"minus zeros",                          {{-0.0f, -0.0f, 1.5f}, {-0.0f, -1, -0.0f}, 1, 1}, kReached},
    {"minus zeros everywhere",               {{-0.0f, -0.0f, -0.0f}, {-0.0f, -0.0f, -0.0f}, -0.0f, -0.0f}, kReached | kUndefined},
    {"minus zero lengths",                   {{0, 1, 0}, {1, 0, 0}, -0.0f, 1}, kReached},
    {"1000 : 1, in reach",                   {{0, 1, 0}, {1, 0, 0}, 1, 1e-3f}, kReached},
    {"1 : 1000, in reach",                   {{0, 1, 0}, {1, 0, 0}, 1e-3f, 1}, kReached},
};
// clang-format on

// The reachable point nearest to the target; only its distance from the shoulder where the target says no direction.
double wrist_error(const Arm& arm, const Vector3d& wrist)
{
    const double distance = arm.wrist.norm(),
                 reachable = std::clamp(distance, std::fabs(arm.upper - arm.fore), arm.length());
    if (distance < 1e-15) return std::fabs(wrist.norm() - reachable);
    return (wrist - (reachable / distance) * arm.wrist).norm();
}
// A unit rotation of the half that is promised, and an elbow that bends one way.
bool is_proper(const LimbPose& pose)
{
    const auto [cosine, sine] = pose.elbow_result;
    return is_unit(pose.shoulder_result) && is_in_hemisphere(pose.shoulder_result) && cosine >= 0 && sine >= 0 &&
           std::fabs(std::hypot(double{cosine}, double{sine}) - 1) <= 1e-6;
}
void check_pose(const Arm& arm, const LimbPose& pose)
{
    CHECK(is_proper(pose));
    CHECK(wrist_error(arm, pose.wrist_place()) <= 1e-6 * arm.length());
    if (pose.flags & kUndefined) return;
    // The hinge is orthogonal to target and pole, and the elbow's side is the pole's.
    const Vector3d line = arm.wrist.normalized(), pole = arm.pole.normalized(), across = pole - pole.dot(line) * line;
    CHECK((pose.hinge() * line.cross(pole).norm() - line.cross(pole)).norm() <= 1e-6);
    CHECK(pose.elbow_place().dot(across) >= -1e-6 * across.norm() * arm.length());
}

}  // namespace

TEST_CASE("hard poses")
{
    std::vector<Arm> arms;
    for (const HardPose& hard : hard_poses) arms.push_back(hard.arm);
    const std::vector<LimbPose> poses = solve_all(arms);
    for (std::size_t n = 0; n < arms.size(); ++n) {
        INFO(hard_poses[n].name);
        // "a hair off": its distance rounds to the arm's length, or to the float after it.
        if (hard_poses[n].flags == (kFar | kReached))
            CHECK((poses[n].flags == kFar || poses[n].flags == kReached));
        else
            CHECK(poses[n].flags == hard_poses[n].flags);
        check_pose(arms[n], poses[n]);
    }
}

TEST_CASE("hard poses of every size and in every direction")
{
    // Powers of two and signed permutations of axes are exact, so the flags must not change. Targets along e1 and
    // undefined planes are another matter only for the plane, which check_pose leaves out.
    const auto is_ordinary = [](const Arm& arm) {
        const double all[] = {arm.upper,     arm.fore,     arm.wrist.x(), arm.wrist.y(),
                              arm.wrist.z(), arm.pole.x(), arm.pole.y(),  arm.pole.z()};
        return std::ranges::all_of(all, [](double x) { return x == 0 || (std::fabs(x) > 1e-4 && std::fabs(x) < 1e4); });
    };
    std::vector<HardPose> ordinary;
    std::ranges::copy_if(hard_poses, std::back_inserter(ordinary), is_ordinary, &HardPose::arm);
    REQUIRE(ordinary.size() > 30);
    for (const double size : {0x1p-30, 0x1p-10, 1.0, 0x1p10, 0x1p30})
        for (int turn = 0; turn < 3; ++turn)
            for (const double sign : {1.0, -1.0}) {
                const auto moved = [&](const Vector3d& v) {
                    return Vector3d(sign * size * v[turn], size * v[(1 + turn) % 3], size * v[(2 + turn) % 3]);
                };
                std::vector<Arm> arms;
                for (const auto& [name, arm, flags] : ordinary)
                    arms.push_back({moved(arm.wrist), moved(arm.pole), size * arm.upper, size * arm.fore});
                const std::vector<LimbPose> poses = solve_all(arms);
                for (std::size_t n = 0; n < arms.size(); ++n) {
                    INFO(ordinary[n].name << ", times " << size << ", turned " << turn << ", sign " << sign);
                    CHECK(poses[n].flags == ordinary[n].flags);
                    check_pose(arms[n], poses[n]);
                }
            }
}

TEST_CASE("poses that are known")
{
    const float h = std::sqrt(0.5f);
    const struct {
        const char* name;
        Arm arm;
        Float4 shoulder;
        Float2 elbow;
    } known[] = {
        {"rest", {{0, 0, 2}, kBack, 1, 1}, {0, 0, 0, 1}, {1, 0}},
        {"bent by 90 degrees", {{0, 1, 1}, {0, 0, 1}, 1, 1}, {0, 0, 0, 1}, {h, h}},
        {"folded", {{0, 0, 1}, kBack, 2, 1}, {0, 0, 0, 1}, {0, 1}},
        {"down", {{0, 0, -2}, {0, 1, 0}, 1, 1}, {1, 0, 0, 0}, {1, 0}},
        {"down, hinge -e1", {{0, 0, -2}, kBack, 1, 1}, {0, 1, 0, 0}, {1, 0}},
        {"undefined plane: hinge e1", {{0, 0, 2}, {0, 0, 0}, 1, 1}, {0, 0, 0, 1}, {1, 0}},
        {"on the shoulder: towards e3", {{0, 0, 0}, {0, 0, 0}, 1, 0}, {0, 0, 0, 1}, {1, 0}},
        {"straight along e1, undefined plane: hinge e2",
         {{2, 0, 0}, {0, 0, 0}, 1, 1},
         {0.5f, 0.5f, 0.5f, 0.5f},
         {1, 0}},
    };
    for (const auto& [name, arm, shoulder, elbow] : known) {
        INFO(name);
        const LimbPose pose = solve_all({arm})[0];
        CHECK(distance(pose.shoulder, quat(shoulder)) <= 1e-6);
        CHECK(std::fabs(pose.elbow_result[0] - elbow[0]) <= 1e-6);
        CHECK(std::fabs(pose.elbow_result[1] - elbow[1]) <= 1e-6);
    }
}

TEST_CASE("every combination of awkward numbers gives a unit pose and no NaN")
{
    const double places[] = {-2, -1, -1e-7f, 0, 1e-15f, 0.5f, 1e15f},
                 bones[] = {0, 1e-15f, 3e-12f, 1, 1.0000001f, 1e15f};
    std::vector<Arm> arms;
    for (const double x : places)
        for (const double y : places)
            for (const double z : places)
                for (const double upper : bones)
                    for (const double fore : bones)
                        arms.push_back({0.5 * Vector3d(x, y, z), Vector3d(0.5 * y, 0.5 * x, 0.25 * z), upper, fore});
    const std::vector<LimbPose> poses = solve_all(arms);
    std::size_t wrong = 0, far_off = 0, flags = 0;
    for (std::size_t n = 0; n < arms.size(); ++n) {
        wrong += !is_proper(poses[n]);
        // 1e-15: a shorter target counts as on the shoulder, and bones of one length fold no further.
        far_off += !(wrist_error(arms[n], poses[n].wrist_place()) <= 1e-6 * arms[n].length() + 1.001e-15);
        const std::uint32_t reach = poses[n].flags & ~kUndefined;  // exactly one of the three
        flags += reach != kReached && reach != kFar && reach != kNear;
    }
    CHECK(wrong == 0);
    CHECK(far_off == 0);
    CHECK(flags == 0);
}

// ---- bad input

namespace {

constexpr std::uint32_t kCount = 37, kSecond = 6;  // limbs of the two groups: a part of a block at the end of each

// Of the two groups.
std::array<swivel_binding, 2> bindings(swivel_features features)
{
    Random random{features + 1};
    const swivel_binding first = bound_limb(random).bound;
    return {first, bound_limb(random).bound};
}
// The first group's limbs rest after bad input, the second group's keep their pose.
Crowd good_crowd(swivel_features features, std::uint32_t twist_bone_count)
{
    Random random{features + 2};
    const std::array<swivel_binding, 2> bound = bindings(features);
    std::array groups = {limbs(kCount, features), limbs(kSecond, features)};
    for (std::size_t group = 0; group < 2; ++group)
        groups[group].binding = bound[group], groups[group].twist_bone_count = twist_bone_count;
    groups[1].on_bad_input = SWIVEL_KEEP_POSE;
    Crowd crowd({groups[0], groups[1]});
    for (std::uint32_t group = 0; group < 2; ++group)
        for (std::uint32_t n = 0; n < groups[group].limb_count; ++n)
            write_limb(crowd, group, n,
                       random_limb(random, features, {bound[group].lengths[0], bound[group].lengths[1]}));
    return crowd;
}

// The results of every limb, padding left out.
std::vector<std::vector<std::uint32_t>> all_results(const Crowd& crowd)
{
    std::vector<std::vector<std::uint32_t>> words;
    for (std::uint32_t group = 0; group < 2; ++group) {
        const swivel_rows rows = swivel_result_rows(crowd.get(), group);
        for (std::size_t n = 0; n < swivel_group_limb_count(crowd.get(), group); ++n) {
            std::vector<std::uint32_t>& limb = words.emplace_back(rows.row_count);
            for (std::size_t row = 0; row < rows.row_count; ++row)
                std::memcpy(&limb[row], rows.base + (n / 16 * rows.row_count + row) * 16 + n % 16, sizeof(float));
        }
    }
    return words;
}

// Limbs that were never solved rest as their bindings say, unstretched, and have no flags.
void check_rest(const Crowd& crowd, swivel_features features)
{
    for (std::uint32_t group = 0; group < 2; ++group) {
        const swivel_binding bound = bindings(features)[group];
        const bool joints = features & SWIVEL_JOINTS;
        const Quaterniond rest = joints ? quat(bound.shoulder_rest) : Quaterniond::Identity();
        CHECK(distance(quat(read<Float4>(crowd, SWIVEL_SHOULDER, group)[1]), rest) <= 1e-6);
        CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS, group)[1] == 0);
        if (features & SWIVEL_WITH_REACH) CHECK(read<Float1>(crowd, SWIVEL_STRETCH, group)[1] == Float1{1});
    }
}

std::uint32_t& flags_of(const Crowd& crowd, std::vector<std::uint32_t>& results)
{
    return results[swivel_field_first_row(crowd.get(), 0, SWIVEL_FLAGS)];
}

// A limb's input, as it must not be.
struct Spoilt {
    swivel_field field;
    std::uint32_t first, count;  // the numbers that are changed
    float bad;
};
// Numbers of a part that are out of the range that swivel.h gives.
struct BadPart {
    ValuePart part;
    std::uint32_t first, count;  // the numbers that are changed
    std::vector<float> all;
};
const BadPart kBadParts[] = {
    {ValuePart::position, 0, 3, {0.6e15f}},  // no component is too long, the vector is
    {ValuePart::point, 0, 3, {0.6e15f}},
    {ValuePart::quaternion, 0, 4, {0.0f, 0.45e-9f, 1e-30f, 0.55e9f}},  // half of its length
    {ValuePart::turn, 0, 2, {0, 0.7e-9f, 0.8e9f}},
    {ValuePart::axis, 0, 3, {0, 0.5f, 1}},
    {ValuePart::half_turn, 1, 1, {-1}},
    {ValuePart::right_turn, 0, 1, {-1}},
    {ValuePart::range, 0, 2, {0, 0.5f, 1}},
    {ValuePart::range, 2, 2, {0, 0.5f, 1}},
    {ValuePart::cosine, 0, 1, {-1.1f, 1.1f}},
    {ValuePart::flexion, 0, 1, {-0.1f, 1.1f}},
    {ValuePart::flexion, 1, 1, {-0.1f, 1.1f}},
    {ValuePart::length, 0, 1, {-1, 0.9e-15f, -1e-15f, 1e-40f, 1.001e15f}},
    {ValuePart::scale, 0, 1, {0.0f, -0.0f, -1, 0.9e-15f, 1.001e15f}},
    {ValuePart::stretch, 0, 1, {0.9f, 1001}},
    {ValuePart::share, 0, 1, {-0.1f, 1.1f}},
};
// Every way to spoil a limb: a number that is none, and a bad part.
std::vector<Spoilt> every_spoilt(const Crowd& crowd)
{
    std::vector<Spoilt> ways;
    for (const FieldRow& row : kFields) {
        if (row.kind != kInput) continue;
        const std::uint32_t row_count = swivel_field_row_count(crowd.get(), 0, row.field);
        for (std::uint32_t c = 0; c < row_count; ++c)
            for (const float bad : {kNan, -kNan, kInf, -kInf, 2e15f, -2e15f, 3e38f})
                ways.push_back({row.field, c, 1, bad});
        for_each_part(row, row_count, [&](ValuePart part, std::uint32_t number) {
            for (const BadPart& each : kBadParts)
                for (const float bad : each.all)
                    if (each.part == part) ways.push_back({row.field, number + each.first, each.count, bad});
        });
    }
    return ways;
}

}  // namespace

TEST_CASE("a bad number spoils its limb and no other")
{
    struct LimbKind {
        swivel_features features;
        std::uint32_t twist_bone_count = 0;
    };
    std::vector<LimbKind> kinds = {{SWIVEL_WITH_AIM | SWIVEL_WITH_ANGLE},
                                   {all_beside(kWorldJointsHand, kPoleFeatures | SWIVEL_WITH_REGION), 3}};
    for (const swivel_features features : every_plain_set()) kinds.push_back({features});
    for (const auto& [features, twist_bone_count] : kinds) {
        const std::vector<Spoilt> ways = every_spoilt(good_crowd(features, twist_bone_count));
        for (std::size_t next = 0; next < ways.size();) {
            Crowd crowd = good_crowd(features, twist_bone_count);
            check_rest(crowd, features);
            auto expected = all_results(crowd);  // of limbs that were never solved: the rest pose
            crowd.solve();
            auto good = all_results(crowd);
            for (std::size_t at = 0; at < good.size(); ++at) {
                CHECK((flags_of(crowd, good[at]) & kBad) == 0);
                const std::uint32_t group = at >= kCount, limb = static_cast<std::uint32_t>(at - (group ? kCount : 0));
                const bool is_spoilt = at % 3 == 1 && next < ways.size();
                if (!is_spoilt || group == 1) expected[at] = good[at];
                if (!is_spoilt) continue;
                const Spoilt& way = ways[next++];
                Float12 value{};
                check(swivel_read(crowd.get(), way.field, group, limb, 1, {value.data(), sizeof value}));
                for (std::uint32_t c = way.first; c < way.first + way.count; ++c) value[c] = way.bad;
                check(swivel_write(crowd.get(), way.field, group, limb, 1, {value.data(), sizeof value}));
                flags_of(crowd, expected[at]) = kBad;
            }
            crowd.solve();
            INFO("features " << features << ", ways to " << next);
            const auto got = all_results(crowd);
            for (std::size_t at = 0; at < got.size(); ++at) {
                INFO("limb " << at);
                CHECK((got[at] == expected[at]));
            }
        }
    }
}

TEST_CASE("a target or pole that is too long in the arm frame is bad")
{
    for (const swivel_features more : {swivel_features{0}, SWIVEL_POLE_DIRECTION}) {
        const swivel_features features = SWIVEL_WORLD | more;
        Crowd crowd = crowd_of(features, 4);
        crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{0, 0, 0});
        crowd.write(SWIVEL_PARENT_SCALE, 0, std::vector<Float1>{{0.01f}, {0.01f}, {1}, {0.01f}});
        crowd.write(SWIVEL_TARGET, 0, std::vector<Float3>{{1e14f, 0, 0}, {1, 0, 0}, {1e14f, 0, 0}, {1e12f, 0, 0}});
        crowd.write(SWIVEL_POLE, 0, std::vector<Float3>{{0, 1, 0}, {0, 1e14f, 0}, {0, 1e14f, 0}, {0, 1e12f, 0}});
        crowd.solve();
        const auto flags = read<std::uint32_t>(crowd, SWIVEL_FLAGS);
        CHECK(flags[0] == kBad);
        CHECK(flags[1] == kBad);
        CHECK(flags[2] == kFar);
        CHECK(flags[3] == kFar);
    }
}

TEST_CASE("a bad parent is bad, though its arm is ordinary in the arm frame")
{
    // Arms that are as long as the parent's numbers make them ordinary, and the parent's numbers on either side of
    // their ends.
    const struct {
        double position, turn, scale, length;
        bool bad;
    } parents[] = {
        {0, 1.5e9, 1, 1.2e-15, true}, {0, 0.5e9, 1, 1.2e-15, false}, {0, 0.5e-9, 1, 4e14, true},
        {0, 2e-9, 1, 4e14, false},    {0, 1, 2e15, 1.2e-15, true},   {0, 1, 0.5e15, 1.2e-15, false},
        {0, 1, 0.5e-15, 4e14, true},  {0, 1, 2e-15, 4e14, false},    {2e15, 1, 1, 1, true},
        {0.5e15, 1, 1, 1, false},
    };
    for (const auto& [position, turn, scale, length, bad] : parents) {
        Crowd crowd = crowd_of(SWIVEL_WORLD, 1);
        const float bone = static_cast<float>(length), at = static_cast<float>(position),
                    reach = static_cast<float>(scale * length);
        crowd.write_all(SWIVEL_SHOULDER_POSITION, 0, Float3{at, 0, 0});
        crowd.write_all(SWIVEL_PARENT_ROTATION, 0, Float4{0, 0, 0, static_cast<float>(turn)});
        crowd.write_all(SWIVEL_PARENT_SCALE, 0, Float1{static_cast<float>(scale)});
        crowd.write_all(SWIVEL_LENGTHS, 0, Float2{bone, bone});
        crowd.write_all(SWIVEL_TARGET, 0, Float3{at, reach, 0});
        crowd.write_all(SWIVEL_POLE, 0, Float3{at, 0, reach});
        crowd.solve();
        INFO("position " << position << ", rotation of length " << turn << ", scale " << scale);
        CHECK(read<std::uint32_t>(crowd, SWIVEL_FLAGS)[0] == (bad ? kBad : kReached));
    }
}
