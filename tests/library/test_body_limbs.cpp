// SPDX-License-Identifier: MIT
//
// The promise: a body's limb is a free limb that is told where the body has it. For any features, both have the same
// rows of results. Where a pose has a time, a step of the swivel is as far a second at any frame rate. Eigen finds by
// forward kinematics where a limb is and which incoming rotations the arm's own formulas see. Floats know that so well,
// and where a solve branches little decides much. So each limb is compared with several free ones that are off by
// rounding.
#include <catch2/catch.hpp>

#include <rapidcheck/catch.h>

#include <map>

#include "simd/fields.h"
#include "tests/limit_oracle.h"
#include "tests/posed_bodies.h"
#include "tests/test_whole_limb.h"

namespace {

using namespace swivel;
using namespace swivel::test;

constexpr std::uint32_t kPosedBodies = 16, kTwins = 8;
// What bodies' limbs have without asking, and what bodies do in another way, or alone.
constexpr swivel_features kPosed = SWIVEL_WORLD | SWIVEL_WITH_INCOMING;
constexpr swivel_features kOtherwise = SWIVEL_JOINTS | SWIVEL_WITH_CLAVICLE | SWIVEL_WITH_RECORD | SWIVEL_WITH_PLANT |
                                       SWIVEL_WITH_PELVIS_FIT | SWIVEL_WITH_LINK | SWIVEL_WITH_HAND_TRANSFORM;
// Nearly straight bones and narrow ranges have few floats, so rounding makes steps of up to about 1e-4.
constexpr double kSame = 3e-4;
using Values = std::map<swivel_field, std::vector<float>>;  // of a limb's inputs

swivel_features random_features(Random& random)
{
    swivel_feature_info info;
    std::uint32_t count = 0;
    while (swivel_describe_feature(count, &info)) ++count;
    swivel_features features = kPosed;
    for (std::uint32_t tries = random.below(2 * count); tries > 0; --tries) {
        swivel_describe_feature(random.below(count), &info);
        const swivel_features more = features | info.feature | info.needs;
        if (!(more & kOtherwise) && is_whole(more)) features = more;
    }
    return features;
}

// A body without a wanted hand aims with the one that comes; a free limb must be told.
swivel_features free_features(swivel_features features)
{
    return features | (features & SWIVEL_WITH_AIM ? SWIVEL_WITH_HAND : 0);
}

template <class Value>
std::vector<float> list(const Value& value)
{
    return {value.begin(), value.end()};
}
// A good value of a field, by its parts. length: of the limb.
std::vector<float> random_value(Random& random, const FieldRow& row, double length)
{
    std::vector<float> value;
    const auto add = [&](const auto& numbers) { value.insert(value.end(), std::begin(numbers), std::end(numbers)); };
    const auto number = [&](double min, double max) { value.push_back(static_cast<float>(random.between(min, max))); };
    for (const ValuePart part : row.value.parts) {
        if (part == ValuePart::position || part == ValuePart::point)
            add(floats(Vector3d(length * random.vector(0, 0.3))));
        else if (part == ValuePart::direction || part == ValuePart::axis)
            add(floats(random.direction()));
        else if (part == ValuePart::quaternion)
            add(floats(random.rotation()));
        else if (part == ValuePart::turn)
            add(cos_sin(random.between(-3, 3)));
        else if (part == ValuePart::half_turn)
            add(cos_sin(random.below(6) ? random.between(0, 1) : kPi));
        else if (part == ValuePart::right_turn)
            add(cos_sin(random.between(0.1, 1.25)));
        else if (part == ValuePart::flexion)  // rounding decides whether a least flexion near 0 shortens the reach
            add(flexion(random.between(0.05, 1), random.between(1.5, 3)));
        else if (part == ValuePart::length)
            number(0.05, 0.3);
        else if (part == ValuePart::stretch)
            number(1, 1.3);
        else if (part == ValuePart::share)
            number(0, 1);
        else
            add(std::span(row_of(part).start, row_of(part).count));  // which changes nothing
    }
    return value;
}
// Goals and limits, in the terms of a body.
Values random_values(Random& random, const BodyGoal& goal, swivel_features features, double length)
{
    const auto number = [&](double min, double max) { return static_cast<float>(random.between(min, max)); };
    Values values;
    for (const FieldRow& row : kFields)
        if (row.kind == kInput && (kinds_of(row) & kBodyLimbs) && !(row.needs & kOtherwise))
            values[row.field] = random_value(random, row, length);
    values[SWIVEL_TARGET] = list(goal.target);
    const bool is_point = !(features & (SWIVEL_POLE_DIRECTION | SWIVEL_POLE_NORMAL));
    values[SWIVEL_POLE] = list(is_point ? goal.pole : floats(random.direction()));
    values[SWIVEL_HAND] = list(goal.hand);
    const bool is_written = features & SWIVEL_WITH_AIM || random.below(4) > 0;
    if (!is_written) values[SWIVEL_HAND][random.below(4)] = kNan;  // the incoming hand
    if (random.below(6)) values[SWIVEL_LENGTHS] = {kNan, kNan};    // as the pose has them
    values[SWIVEL_WEIGHTS] = {number(0, 1), number(0, 1), random.below(2) ? number(0.1, 1) : 0};
    values[SWIVEL_REACH] = {number(0, 0.2), number(0, 0.2), number(1, 1.3), number(0, 0.2)};
    values[SWIVEL_CAP] = {number(0, 0.2), number(0, 0.9), number(0, 0.2)};
    LimbLimits limits(random);
    limits.draw([&](const Limit&) { return random.between(1, 3); },
                [&](const Limit&) {
                    return AngleRange{random.between(-1, 1), random.between(1.5, 3)};
                });
    each_limit(limits, [&](swivel_field field, const auto& value) { values[field] = list(value); });
    return values;
}

// A step of the swivel is so far in a 60th of a second. The tangent of half of its angle goes with time; half a turn,
// no limit, is one in any time but 0.
Float2 timed_step(const std::vector<float>& step, double seconds)
{
    const double half = 0.5 * std::atan2(double{step[1]}, double{step[0]});
    return cos_sin(seconds == 0 ? 0 : 2 * std::atan(60 * seconds * std::tan(half)));
}

// Joints as they are, with the rounding of floats.
std::vector<JointAt> rounded(Random& random, std::vector<JointAt> at, double way)
{
    for (JointAt& joint : at) {
        joint.place += 1e-6 * way * random.direction();
        joint.rotation = Eigen::AngleAxisd(1e-6, random.direction()) * joint.rotation;
    }
    return at;
}

// A bone's frame: z along it, x the normal.
Quaterniond frame_of(const Vector3d& bone, const Vector3d& normal)
{
    Eigen::Matrix3d axes;
    axes.col(2) = bone.normalized();
    axes.col(0) = (normal - normal.dot(axes.col(2)) * axes.col(2)).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return Quaterniond(axes);
}

// One limb of a body, and the values of a free limb in its place.
struct LimbInBody {
    const BodySkeleton& skeleton;
    const BodyLimbJoints& limb;
    const swivel_binding bound;
    const swivel_features features;

    LimbInBody(const BodySkeleton& of, std::size_t n, swivel_features has)
        : skeleton(of), limb(of.limbs[n]), bound(bind(of.view(), of.joints(n))), features(has)
    {
    }
    Vector3d hinge(const std::vector<JointAt>& at) const
    {
        return at[limb.shoulder].rotation * (quat(bound.upper_from_arm) * Vector3d::UnitX());
    }
    // The sine of the bend, and the cosine from the bones' own normal to the hinge.
    std::pair<double, double> bend(const std::vector<JointAt>& at) const
    {
        const Vector3d normal = own_normal(at);
        const double lengths = (at[limb.elbow].place - at[limb.shoulder].place).norm() *
                               (at[limb.wrist].place - at[limb.elbow].place).norm();
        return {normal.norm() / lengths, normal.normalized().dot(hinge(at))};
    }
    Values seen(const Values& values, const Float3& root, const std::vector<JointAt>& at) const
    {
        const JointAt none{Quaterniond::Identity(), Vector3d::Zero(), 1};
        const auto above = [&](std::uint32_t joint) {
            return skeleton.parents[joint] < 0 ? none : at[static_cast<std::size_t>(skeleton.parents[joint])];
        };
        const JointAt parent = above(limb.shoulder), &shoulder = at[limb.shoulder], &wrist = at[limb.wrist];
        const Vector3d upper = at[limb.elbow].place - shoulder.place, fore = wrist.place - at[limb.elbow].place;
        const Vector3d normal = incoming_normal(at, values.at(SWIVEL_WEIGHTS)[2]);
        const Quaterniond arm = parent.rotation * quat(bound.parent_from_arm), upper_frame = frame_of(upper, normal),
                          fore_frame = frame_of(fore, normal),
                          hand_rest = quat(bound.wrist_parent_from_arm).conjugate() * quat(bound.wrist_rest);
        Values free = values;
        free[SWIVEL_SHOULDER_POSITION] = list(floats(Vector3d(vec(root) + shoulder.place)));
        free[SWIVEL_PARENT_ROTATION] = list(floats(arm));
        free[SWIVEL_PARENT_SCALE] = {static_cast<float>(parent.scale)};
        if (std::isnan(values.at(SWIVEL_LENGTHS)[0]))
            free[SWIVEL_LENGTHS] = {static_cast<float>(upper.norm() / parent.scale),
                                    static_cast<float>(fore.norm() / parent.scale)};
        free[SWIVEL_INCOMING_SHOULDER] = list(floats(Quaterniond(arm.conjugate() * upper_frame)));
        free[SWIVEL_INCOMING_ELBOW] = list(floats(Quaterniond(upper_frame.conjugate() * fore_frame)));
        free[SWIVEL_INCOMING_WRIST] =
            list(floats(Quaterniond(fore_frame.conjugate() * wrist.rotation * hand_rest.conjugate())));
        // The hand's axes are the arm frame's at rest.
        Float4 written;
        std::ranges::copy(values.at(SWIVEL_HAND), written.begin());
        const bool is_written = std::ranges::none_of(written, [](float x) { return std::isnan(x); });
        Quaterniond hand = (is_written ? quat(written) : wrist.rotation) * hand_rest.conjugate();
        if (features & SWIVEL_WITH_AIM) hand = fore_frame.conjugate() * above(limb.wrist).rotation * hand;
        free[SWIVEL_HAND] = features & SWIVEL_WITH_HAND ? list(floats(hand)) : free[SWIVEL_INCOMING_WRIST];
        for (const swivel_field field : {SWIVEL_EFFECTOR, SWIVEL_AIM}) {
            const Float3 v = floats(Vector3d(hand_rest * vec({free[field][0], free[field][1], free[field][2]})));
            std::ranges::copy(v, free[field].begin());
        }
        return free;
    }

private:
    Vector3d own_normal(const std::vector<JointAt>& at) const
    {
        return (at[limb.wrist].place - at[limb.elbow].place).cross(at[limb.elbow].place - at[limb.shoulder].place);
    }
    // Where the elbow is left where it comes, the bones' own. Otherwise the one that is on the hinge's side.
    Vector3d incoming_normal(const std::vector<JointAt>& at, float pole_weight) const
    {
        if ((features & SWIVEL_POLE_INCOMING) || ((features & SWIVEL_WITH_WEIGHTS) && pole_weight == 0))
            return own_normal(at);
        const auto [sine, side] = bend(at);
        return sine < 0.1 ? hinge(at) : Vector3d(std::copysign(1, side) * own_normal(at));
    }
};

void write_values(Crowd& crowd, std::uint32_t group, std::uint32_t n, const Values& values)
{
    for (const auto& [field, value] : values)
        if (swivel_field_row_count(crowd.get(), group, field))
            check(swivel_write(crowd.get(), field, group, n, 1, {value.data(), value.size() * sizeof(float)}));
}

using Numbers = std::array<float, 4>;
// Rotations are the same with either sign. Flags are the same or not.
double apart(const Numbers& a, const Numbers& b, swivel_field field, std::uint32_t count)
{
    if (field == SWIVEL_FLAGS) return std::memcmp(&a, &b, sizeof(std::uint32_t)) ? 1 : 0;
    const Eigen::Vector4d p(a[0], a[1], a[2], a[3]), q(b[0], b[1], b[2], b[3]);
    return count == 4 ? std::min((p - q).norm(), (p + q).norm()) : (p - q).norm();
}

// A crowd of bodies, and one of free limbs, of which kTwins are in the place of each. Only bodies have a time, if any.
struct Twins : PosedBodies {
    Random& random;
    const swivel_features features = random_features(random);
    const RandomRegion region = random_region(random);
    const Float3 behind = features & SWIVEL_POLE_HALF_LINE ? floats(random.direction()) : Float3{};
    const bool has_time = random.below(4);
    std::vector<float> times = std::vector<float>(kPosedBodies);
    Crowd posed = posed_crowd(), free = Crowd({free_group(0), free_group(1)});
    std::vector<bool> is_between;  // limbs that are neither straight nor bent, or against nothing

    explicit Twins(Random& from)
        : PosedBodies(from, {1 + from.below(8), 2, from.below(3), false}, kPosedBodies,
                      {.translates = true, .scales = true, .roots = true}),
          random(from)
    {
    }
    Crowd posed_crowd()
    {
        add_limbs(features & ~kPosed);
        for (std::uint32_t g = 0; g < groups.size(); ++g) {
            if (has(g, SWIVEL_WITH_REGION)) limb_def(g).region = &region.region;
            std::ranges::copy(behind, limb_def(g).pole_behind);
        }
        return crowd();
    }
    // Free limbs have their arm frame as the parent's.
    swivel_limb_def free_group(std::uint32_t g) const
    {
        swivel_limb_def made = limbs(kPosedBodies * kTwins, free_features(features));
        if (features & SWIVEL_WITH_REGION) made.region = &region.region;
        const swivel_binding bound = bind(skeleton.view(), joints[g]);
        std::ranges::copy(floats(Vector3d(quat(bound.parent_from_arm).conjugate() * vec(behind))), made.pole_behind);
        return made;
    }
    void write(int frame)
    {
        is_between.clear();
        for (float& each : times) each = random.below(6) ? static_cast<float>(random.spread(1e-3, 1)) : 0;
        for (std::uint32_t g = 0; g < 2; ++g)
            for (std::uint32_t n = 0; n < kPosedBodies; ++n) {
                const std::vector<JointAt> at = joints_at(skeleton, bodies[n]);
                const LimbInBody in_body(skeleton, g, features);
                const LimbAt limb(skeleton, bodies[n], at, skeleton.limbs[g]);
                Values values = random_values(random, goal(random, g, n), features, limb.length());
                if (frame == 0 && random.below(4) == 0) values.erase(SWIVEL_MAX_SWIVEL);
                write_values(posed, g, n, values);
                if (has_time && values.count(SWIVEL_MAX_SWIVEL))
                    values[SWIVEL_MAX_SWIVEL] = list(timed_step(values[SWIVEL_MAX_SWIVEL], double{times[n]}));
                for (std::uint32_t twin = 0; twin < kTwins; ++twin)
                    write_values(free, g, n * kTwins + twin,
                                 in_body.seen(values, bodies[n].root_position, rounded(random, at, limb.way)));
                const auto [sine, side] = in_body.bend(at);
                is_between.push_back((sine > 0.04 && sine < 0.18) || std::fabs(side) < 0.01);
            }
    }
    void solve()
    {
        PoseBuffer poses = incoming();
        swivel_pose pose = poses.view();
        if (has_time) pose.time = stream(times);
        solve_poses(posed, pose);
        free.solve();
    }
    // Where no swivel keeps the limits, many violate them about as little, and rounding chooses.
    bool is_infeasible(std::uint32_t g, std::uint32_t n) const { return flags_of(posed, g, n) & SWIVEL_INFEASIBLE; }
    void forget(std::uint32_t g, std::uint32_t n)
    {
        check(swivel_reset(posed.get(), g, n, 1));
        check(swivel_reset(free.get(), g, n * kTwins, kTwins));
    }
    // Calls take(field, how far it is from the nearest twin, how far twins are from each other) for each limb's
    // results.
    template <class Take>
    void compare(const Take& take) const
    {
        swivel_field_info info;
        for (std::uint32_t f = 0; swivel_describe_field(f, &info); ++f)
            for (std::uint32_t limb = 0; limb < 2 * kPosedBodies; ++limb) {
                const std::uint32_t g = limb / kPosedBodies, n = limb % kPosedBodies,
                                    count = swivel_field_row_count(posed.get(), g, info.field);
                if (info.kind == SWIVEL_FIELD_INPUT || count == 0 || is_between[limb]) continue;
                if (info.field != SWIVEL_FLAGS && is_infeasible(g, n)) continue;
                Numbers mine{}, twins[kTwins] = {};
                check(swivel_read(posed.get(), info.field, g, n, 1, {&mine, sizeof mine}));
                check(swivel_read(free.get(), info.field, g, n * kTwins, kTwins, {&twins, sizeof mine}));
                double nearest = 1e9, spread = 0;
                for (const Numbers& twin : twins) {
                    nearest = std::min(nearest, apart(twin, mine, info.field, count));
                    spread = std::max(spread, apart(twin, twins[0], info.field, count));
                }
                take(nearest, spread);
            }
    }
};

}  // namespace

TEST_CASE("a body's limb is a free limb in its place")
{
    std::size_t count = 0, sure = 0;
    rc::prop("with any features", [&](std::uint64_t seed) {
        Random random{seed};
        Twins twins(random);
        for (int frame = 0; frame < 3; ++frame) {
            twins.write(frame);
            for (std::uint32_t n = 0; n < kPosedBodies; ++n)
                for (std::uint32_t g = 0; g < 2; ++g)
                    if (twins.is_infeasible(g, n) || (frame == 2 && n % 3 == 0)) twins.forget(g, n);
            twins.solve();
            twins.compare([&](double nearest, double spread) {
                ++count, sure += spread <= kSame;
                RC_ASSERT(nearest <= kSame + 3 * spread);
            });
        }
    });
    CHECK(static_cast<double>(sure) >= 0.9 * static_cast<double>(count));
}
