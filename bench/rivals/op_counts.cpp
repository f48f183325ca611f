// SPDX-License-Identifier: MIT
//
// It looks inside the library: it runs the formulas themselves, on numbers that count.
#include "bench/rivals/op_counts.h"

#include <array>
#include <stdexcept>

#include "bench/rivals/character.h"
#include "bench/rivals/counted.h"
#include "bench/rivals/rifle.h"
#include "core/fit.h"
#include "core/ground.h"
#include "core/limb_bones.h"
#include "core/look.h"
#include "core/plant.h"
#include "core/posed_limb.h"
#include "core/prop.h"
#include "core/region.h"
#include "core/space.h"
#include "core/spring.h"
#include "core/wish.h"
#include "core/wrist_goal.h"

namespace bench {

namespace {

using swivel::Rotor;
using Frame = swivel::JointFrame<Counted>;
using Frames = std::array<Frame, kBodyJoints>;

swivel::Vector<Counted> vector(double x, double y, double z)
{
    return swivel::vector(Counted(x), Counted(y), Counted(z));
}
Rotor<Counted> rotor(double x, double y, double z, double w)
{
    return swivel::rotor(Counted(x), Counted(y), Counted(z), Counted(w));
}
// A joint's rotation as it is stored: on the incoming one's side.
void store(const Rotor<Counted>& local, const Rotor<Counted>& incoming)
{
    swivel::flip_sign(local, swivel::scalar_product(~incoming, local));
}

// Forward kinematics of all joints, which have no scales of their own.
Frames counted_frames(const Frame& root)
{
    Frames frames;
    for (std::size_t n = 0; n < kBodyJoints; ++n) {
        const std::int32_t parent = kBodyParents[n];
        const float(&offset)[3] = kBodyOffsets[n];
        frames[n] =
            swivel::joint_frame(parent < 0 ? root : frames[static_cast<std::size_t>(parent)],
                                rotor(0.1, 0.05, -0.1, 0.98867), vector(offset[0], offset[1], offset[2]), Counted(1.0));
    }
    return frames;
}

// A target in the world that the limb reaches, as it is given: not counted.
swivel::Vector<Counted> target_of(const Frames& frames, const BodyChain& chain, const swivel::Vector<Counted>& root)
{
    const OpCounts before = tally;
    const swivel::Vector<Counted>&first = frames[chain.first].place, &last = frames[chain.last].place;
    const swivel::Vector<Counted> target = root + last + Counted(0.2) * (first - last);
    tally = before;
    return target;
}

// The rifle's region, with half-spaces so wide that all is allowed.
const swivel_region& allowing_region()
{
    static const swivel_region allowing = [] {
        swivel_region region = rifle_region();
        for (swivel_half_space& half : region.half_space) half.cosine = -1;
        return region;
    }();
    return allowing;
}

// The stages of a limb with a hand and an incoming pose, from `goal` to `wrist` (simd/stages.h). region: null if it has
// none.
struct SolvedLimb {
    swivel::ArmPose<Counted> arm;
    Rotor<Counted> wrist;
};
SolvedLimb solve_limb(swivel_features features, const swivel::LimbGoal<Counted>& goal, const swivel_region* region)
{
    const swivel::Mask<Counted> valid =
        swivel::is_valid(goal.arm) & swivel::is_product(goal.hand) & swivel::is_valid(goal.incoming);
    const auto wrist = swivel::wrist_goal(features, goal);
    const auto to = swivel::wrist_line(wrist.place);
    const auto bones = swivel::place_bones(features, goal, to.wanted);
    swivel::WishGoal<Counted> wish_goal;
    wish_goal.incoming = goal.incoming.shoulder;
    wish_goal.weight = goal.weights.pole;
    const auto wish = swivel::limb_normal(features, wish_goal, to.line);
    const swivel::Hinge<Counted> elbow = swivel::hinge(bones.cos_half, -bones.sin_half);
    swivel::Vector<Counted> normal = wish.normal;
    if (region) {
        const swivel::SwivellingArm<Counted, decltype(bones.lift)> arm{to.line, normal, bones.lift, elbow, wrist.hand};
        const auto allowed = swivel::region_limit(arm, region);
        const swivel::Turned<Counted> wished{Counted(1.0), Counted(0.0)};
        if (swivel::room(allowed, wished).value < swivel::kNoRoom)
            throw std::logic_error("the region that is counted forbids the swivel that is wished for");
        normal = swivel::swivelled(normal, to.line, wished);
    }
    const Rotor<Counted> shoulder = swivel::lifted(to.line, normal, bones.lift);
    return {{shoulder, bones.cos_half, bones.sin_half, bones.flags | wish.flags, valid},
            ~(shoulder * elbow) * wrist.hand};
}

// Its stages, from `posed` to `correct` (simd/stages.h). The arm of a rifle has weights, too, a flexion limit and a
// region, which allows what is wished for.
enum class Arm { plain, rifle };
void count_body_limb(const Frames& frames, const BodyChain& chain, Arm arm = Arm::plain)
{
    const Rotor<Counted> of_binding = rotor(0.1, 0.2, 0.3, 0.92736), local = rotor(0.1, 0.05, -0.1, 0.98867);
    const swivel::Vector<Counted> root = vector(1, 2, 3), target = target_of(frames, chain, root);
    const Frame &parent = frames[static_cast<std::size_t>(kBodyParents[chain.first])], &shoulder = frames[chain.first],
                &elbow = frames[chain.middle], &wrist = frames[chain.last];
    const Counted per_scale = Counted(1.0) / parent.scale;
    const swivel::SeenLimb<Counted> seen = swivel::seen_limb<swivel::BendNormal::own>(
        swivel::PosedLimb<Counted>{parent.rotation, shoulder.rotation, shoulder.place, elbow.place, wrist.place},
        of_binding, vector(1, 0, 0), Counted(0.0) < Counted(0.0));
    const Rotor<Counted> upper_from_arm = ~shoulder.rotation * seen.frames.upper,
                         fore_from_arm = ~elbow.rotation * seen.frames.fore;
    swivel_features features = SWIVEL_WITH_HAND | SWIVEL_WITH_INCOMING | SWIVEL_POLE_INCOMING;
    const swivel_region* region = nullptr;
    swivel::LimbGoal<Counted> goal;
    goal.arm = {per_scale * seen.back(target - root - shoulder.place), vector(0, 0, 0),
                per_scale * seen.bones.upper_length, per_scale * seen.bones.fore_length};
    goal.hand = ~seen.arm * rotor(0.3, 0.2, 0.1, 0.9) * ~of_binding;
    goal.incoming = {seen.model.upper, seen.model.upper, seen.model.upper};  // of which the first is used
    if (arm == Arm::rifle) {
        features |= SWIVEL_WITH_WEIGHTS | SWIVEL_WITH_FLEXION_LIMIT;
        region = &allowing_region();
        goal.incoming = {seen.model.upper, ~seen.model.upper * seen.model.fore,
                         ~seen.frames.fore * wrist.rotation * ~of_binding};
        goal.weights = {Counted(0.9), Counted(0.8), Counted(0.0)};
        goal.flexion = {Counted(0.9997), Counted(0.3)};
    }
    const SolvedLimb solved = solve_limb(features, goal, region);

    store(of_binding * solved.arm.shoulder * ~upper_from_arm, local);
    store(upper_from_arm * swivel::elbow_rotor(solved.arm) * ~fore_from_arm, local);
    store(fore_from_arm * solved.wrist * of_binding, local);
    if (solved.arm.flags.value != SWIVEL_REACHED)
        throw std::logic_error("the body's limb that is counted is not an ordinary one");
}

// A foot on its ground: what its heights add to a plant, and its turn, eased. Its heel is high enough.
void count_ground()
{
    const Rotor<Counted> foot = rotor(0.1, 0.05, -0.1, 0.98867);
    const swivel::Vector<Counted> up = swivel::turned(foot, vector(0, 1, 0)), toe = vector(0.1, 0.1, 0.3),
                                  level = toe - swivel::scalar_product(up, toe) * up;
    const auto ground = swivel::ground_plane(vector(1, 2, 3) - vector(1.1, 1.9, 3), vector(0.1, 1, 0.2), up);
    const auto lift = swivel::sprung(swivel::Spring<Counted>{Counted(0.01), Counted(0.1)},
                                     ground.way_up(level, Counted(0.0)), Counted(1.0 / 60), swivel::spring_rule(0.05f));
    const swivel::GroundRules rules{};
    toe + lift.at* up;
    const auto normal =
        swivel::sprung(swivel::Spring<swivel::Vector<Counted>>{vector(0.1, 1, 0.1), vector(0.2, 0, -0.1)},
                       ground.slope(up), Counted(1.0 / 60), swivel::spring_rule(0.05f));
    swivel::foot_on_ground(ground, swivel::ground_plane(ground.place, normal.at, up), up, {toe, foot},
                           Counted(1.1) * vector(0, 0, -0.15), Counted(1.1), Counted(1.0), rules);
}

// Spine, chest, neck and head turn to a target, eased, and the joints of both arms come along.
void count_look()
{
    constexpr int kTurned = 4, kFollowing = 8;
    const auto place = [](int n) { return vector(0, 1.2 + 0.15 * n, 0.02); };
    const Rotor<Counted> was = rotor(0.1, 0.05, -0.1, 0.98867);
    const Counted scale(1.1);
    const swivel::LookJoint joint{0.4f, 0.9f, 0.43589f};
    // The line of sight, the target from it, and how much it counts.
    swivel::LineOfSight<Counted> sight{place(3) + swivel::turned(was, scale * vector(0, 0.1, 0.1)),
                                       swivel::turned(was, vector(0, 0, 1))};
    const swivel::Vector<Counted> given = vector(3, 2.5, 7), target = given - vector(1, 0.5, 2);
    const Counted weight =
        Counted(0.9) * swivel::look_weight(sight, target, swivel::LookFade{-0.9f, 1.6f, 0.15f}, scale);
    // The chain, the turns that are carried, and the joints' local rotations.
    Rotor<Counted> sum = swivel::one<Counted>();
    Counted tangents(0.0);
    for (int n = 0; n < kTurned; ++n) {
        const swivel::Vector<Counted> at = n == 0 ? place(0) : place(n - 1) + swivel::turned(sum, place(n) - place(0));
        const swivel::LookTurn<Counted> turn = n + 1 < kTurned ? swivel::share_of_look(sight, target, weight, joint)
                                                               : swivel::rest_of_look(sight, at, target, weight, joint);
        sight = {at + swivel::turned(turn.turn, sight.eye - at), swivel::turned(turn.turn, sight.axis)};
        swivel::turned(~(sum * was), vector(0.1, 0.05, -0.1));
        tangents = tangents + swivel::look_way(swivel::from_quarter_tangent(vector(0.1, 0, 0)), turn.turn).tangent;
        swivel::quarter_tangent(turn.turn);
        sum = n == 0 ? turn.turn : swivel::unit_rotation(turn.turn * sum);
        const Rotor<Counted> rotation = sum * was;
        store(swivel::unit_rotation(~was * rotation), was);
    }
    for (int n = 0; n < kFollowing; ++n) {
        sum* was;
        place(0) + swivel::turned(sum, place(n) - place(0));
    }
    swivel::sees(sight, given);
}

// A foot that stands on a support that is not turned, between two changes.
void count_plant()
{
    const auto no = [] { return Counted(0.0) < Counted(0.0); };
    const swivel::PlantRules rules = swivel::plant_rules(swivel_default_plant());
    const Rotor<Counted> foot = rotor(0.1, 0.05, -0.1, 0.98867);
    swivel::PlantState<Counted> state{
        vector(0.1, 0, 0.2), vector(0.01, 0, 0.02), vector(0.1, 0, 0.1), Counted(0.15), no(), no(), no(), no()};
    const swivel::Vector<Counted> place = vector(0.1, 0.9, 0.1) +
                                          Counted(1.1) * swivel::turned(foot, vector(0, -0.05, 0.1)),
                                  from = vector(1, 0, 2);
    const swivel::PlantInput<Counted> in{
        .point = place + from, .label = no(), .time = Counted(1.0 / 60), .length = Counted(0.85) * Counted(1.1)};
    const swivel::Planted<Counted> planted = swivel::plant(state, in, rules);
    swivel::len2(planted.target - from);
}

// The body's shift for two capped legs.
void count_fit()
{
    const Rotor<Counted> foot = rotor(0.1, 0.05, -0.1, 0.98867);
    swivel::ShiftSpan<Counted> span{Counted(-1.0), Counted(1.0), Counted(0.0) <= Counted(0.0)};
    const swivel::Vector<Counted> up = swivel::turned(foot, vector(0, 1, 0));
    for (int leg = 0; leg < 2; ++leg) {
        const swivel::Vector<Counted> upper = vector(0.1, -0.4, 0.1), fore = vector(0, -0.4, -0.1),
                                      from_wrist = Counted(1.1) * swivel::turned(foot, vector(0, -0.05, 0.1));
        const Counted bones = sqrt(swivel::len2(upper)) + sqrt(swivel::len2(fore));
        const swivel::Cap<Counted> cap{Counted(0.01), Counted(0.0), Counted(0.0), sqrt(swivel::len2(upper + fore))};
        const Counted reach = swivel::capped_reach(cap, bones, bones).far;
        span = span & swivel::shift_span(from_wrist + vector(0.1, 0.8, 0.1) - vector(0, 0.1, 0), up, reach);
    }
    const auto fitted = swivel::fitted_shift(span, Counted(0.0), Counted(0.08), Counted(0.04));
    const auto spring = swivel::sprung(swivel::Spring<Counted>{Counted(0.01), Counted(0.1)}, fitted.shift,
                                       Counted(1.0 / 60), swivel::spring_rule(0.1f));
    const swivel::Vector<Counted> shift = spring.at * up;
    swivel::len2(shift);
}

}  // namespace

OpCounts count_character_ops()
{
    tally = {};
    const Frame root{swivel::unit_rotation(rotor(0.1, -0.2, 0.05, 0.97340)), vector(0, 0, 0), Counted(1.1)};
    const Frames frames = counted_frames(root);
    for (std::size_t leg = 2; leg < kBodyLimbs; ++leg) {
        count_plant();
        count_ground();
        count_body_limb(frames, kBodyChains[leg]);
    }
    count_fit();
    count_look();
    count_body_limb(frames, kBodyChains[kRightArm], Arm::rifle);
    const swivel::HeldFrame<Counted> hand{rotor(0.1, 0.05, -0.1, 0.98867), vector(0.1, 0.2, 0.3)},
        grip{rotor(0.1, 0.1, 0.1, 0.98489), vector(0.1, 0.05, 0.15)};
    swivel::gripped(hand, grip, Counted(1.1));
    count_body_limb(frames, kBodyChains[0]);
    return tally;
}

}  // namespace bench
