// SPDX-License-Identifier: MIT
//
// Random bodies whose hands hold a prop, and where that belongs, by Eigen in double.
#pragma once

#include "tests/posed_bodies.h"

namespace swivel::test {

// The place of a prop that does not move, as far as it is known.
struct UnmovedProp {
    Held frame;
    bool is_of_hands;  // the caller and the pose say nothing of it
    std::vector<Held> points, hands;
    std::vector<Ball> moves;                 // by which each arm reaches
    std::vector<double> nearest;             // how near to its shoulder each gets
    std::vector<bool> has_target, has_hand;  // what was written of each arm's goal
    double max, off;                         // off: what floats may be off

    bool is_posed(std::size_t arm) const { return !has_target[arm] && !has_hand[arm]; }
};

struct PropBodies : PosedBodies {
    std::vector<std::uint32_t> arms;  // groups
    std::uint32_t prop = 0, shift = kNoLimbHere;
    swivel_features bounds;

    // Arms are nearly straight in one crowd of four.
    explicit PropBodies(Random& random, std::size_t body_count)
        : PosedBodies(random, {3 + random.below(4), 3, random.below(2), false, random.below(2)}, body_count,
                      random_layout(random), random.below(4) ? 3.1 : 1e-4),
          bounds((random.below(3) ? 0 : SWIVEL_WITH_FLEXION_LIMIT) | (random.below(3) ? 0 : SWIVEL_WITH_CAP))
    {
        const std::uint32_t arm_count = random.below(5) ? 2 : 1, prop_at = random.below(arm_count + 1);
        const swivel_features holds = SWIVEL_WITH_HAND | SWIVEL_WITH_LINK | SWIVEL_POLE_INCOMING | bounds |
                                      (random.below(2) ? SWIVEL_WITH_EFFECTOR : 0) |
                                      (random.below(4) ? 0 : SWIVEL_WITH_ANGLE);
        prop = prop_at;
        for (std::uint32_t n = 0; n <= arm_count; ++n)
            if (n == prop_at)
                add(random_prop(random));
            else
                arms.push_back(add_limb(static_cast<std::uint32_t>(arms.size()), holds, prop));
        if (random.below(3) == 0) add_leg(random);
        for (const std::uint32_t arm : arms) give_arm(random, arm);
        give_prop(random);
    }
    Vector3d root(std::size_t n, const SolvedBodies& solved) const
    {
        const Body& body = bodies[n];
        Vector3d root = vec(body.root_position);
        if (shift != kNoLimbHere)
            root += double{solved.result<Float3>(SWIVEL_SHIFT, shift, n)[0]} *
                    (quat(body.root_rotation).normalized() * Vector3d::UnitY());
        return root;
    }
    UnmovedProp unmoved(const SolvedBody& body, const Vector3d& root) const
    {
        UnmovedProp is{};
        double size = 0;
        for (const std::uint32_t arm : arms) {
            add_animated(body, arm, root, is);
            is.hands.push_back(is.points.back() * body.grip(arm).inverse());
            size += body.length(arm) + body.rounding(arm) / 3e-7 + is.hands.back().place.norm();
        }
        const double share = arms.size() == 1 ? 0 : double{value(prop, SWIVEL_HAND_BLEND, body.n, Float1{})[0]};
        const Held hands = between(is.hands.front(), is.hands.back(), share);
        is.frame = hands;
        const Float3 place = value(prop, SWIVEL_PROP_POSITION, body.n, kNoPlace);
        const Float4 turn = value(prop, SWIVEL_PROP_ROTATION, body.n, kNoTurn);
        const bool has_place = !std::isnan(place[0]), has_turn = !std::isnan(turn[0]);
        const Quaterniond rotation = has_turn ? quat(turn).normalized() : Quaterniond::Identity();
        if (const std::int32_t joint = prop_def().joint; joint >= 0) {
            const JointAt& at = body.came[static_cast<std::size_t>(joint)];
            is.frame = Held{at.rotation, at.place} * Held{rotation, has_place ? vec(place) : Vector3d(0, 0, 0)};
        } else {
            if (has_place) is.frame.place = vec(place) - root;
            if (has_turn) is.frame.rotation = rotation;
            is.is_of_hands = !has_place && !has_turn;
        }
        const double weight = double{value(prop, SWIVEL_PROP_WEIGHT, body.n, Float1{1})[0]};
        if (weight == 0) is.is_of_hands = true;
        is.frame = between(hands, is.frame, weight);
        is.off = 1.2e-6 * (size + is.frame.place.norm()) + 3e-7 * root.norm();
        for (std::size_t n = 0; n < arms.size(); ++n) {
            is.moves.push_back(moves(body, arms[n], is.frame));
            is.nearest.push_back(nearest(body, arms[n]));
        }
        is.max = double{prop_def().max_move} * rest_length(limb_of[arms[0]]) * body.incoming.root_scale;
        return is;
    }
    // The same limbs with the same goals, that hold nothing.
    PosedBodies free() const
    {
        PosedBodies of = *this;
        of.groups.erase(of.groups.begin() + prop), of.limb_of.erase(of.limb_of.begin() + prop);
        std::erase_if(of.inputs,
                      [&](const BodyInput& input) { return input.group == prop || input.field == SWIVEL_GRIP; });
        for (BodyInput& input : of.inputs) input.group -= input.group > prop;
        for (std::uint32_t g = 0; g < of.groups.size(); ++g)
            if (of.is_limb(g)) of.limb_def(g).features &= ~SWIVEL_WITH_LINK;
        return of;
    }
    swivel_prop_def& prop_def() { return std::get<swivel_prop_def>(groups[prop]); }
    const swivel_prop_def& prop_def() const { return std::get<swivel_prop_def>(groups[prop]); }

private:
    static swivel_prop_def random_prop(Random& random)
    {
        constexpr float max[] = {0, 0.1f, 1, 5};
        swivel_prop_def made = swivel_default_prop_def();
        made.max_move = max[random.below(4)];
        if (random.below(4) == 0) made.joint = static_cast<std::int32_t>(random.below(3));  // of the trunk
        return made;
    }
    void add_leg(Random& random)
    {
        swivel_shift_def def = swivel_default_shift_def();
        def.drop = def.rise = 0.5f;
        shift = add(def);
        const std::uint32_t leg = add_limb(2, SWIVEL_WITH_PELVIS_FIT | SWIVEL_POLE_INCOMING | SWIVEL_WITH_HAND);
        give(leg, SWIVEL_TARGET, [&](std::size_t n) {
            const Float3 target = random_goal(random, skeleton, bodies[n], 2).target;
            return floats(Vector3d(vec(target) + Vector3d(0, -0.2 * double{bodies[n].root_scale}, 0)));
        });
    }
    void give_arm(Random& random, std::uint32_t arm)
    {
        give_limits(random, arm);
        const bool is_ever_written = random.below(2);
        std::vector<BodyGoal> goals;
        for (const Body& body : bodies) goals.push_back(random_goal(random, skeleton, body, limb_of[arm]));
        std::vector<std::uint32_t> writes;  // bits of target and hand
        for (std::size_t n = 0; n < bodies.size(); ++n) writes.push_back(is_ever_written ? random.below(4) : 0);
        give(arm, SWIVEL_TARGET, [&](std::size_t n) { return writes[n] & 1 ? goals[n].target : kNoPlace; });
        give(arm, SWIVEL_HAND, [&](std::size_t n) { return writes[n] & 2 ? goals[n].hand : kNoTurn; });
    }
    // Grips that fit, or from which the other arm must move the prop, or cannot.
    void give_prop(Random& random)
    {
        std::vector<Held> at;
        std::vector<std::vector<Float7>> grips(arms.size());
        for (std::size_t n = 0; n < bodies.size(); ++n) {
            const std::vector<JointAt> joints_are = joints_at(skeleton, bodies[n]);
            for (std::size_t a = 0; a < arms.size(); ++a) {
                const BodyLimbJoints& limb = skeleton.limbs[limb_of[arms[a]]];
                const JointAt &wrist = joints_are[limb.wrist], &shoulder = joints_are[limb.shoulder];
                Held hand{wrist.rotation, wrist.place};
                const double length = LimbAt(skeleton, bodies[n], joints_are, limb).length();
                if (a == 0)
                    at.push_back(hand * Held{random.rotation(), 0.5 * length * random.unit() * random.direction()});
                else if (random.below(3))
                    hand = {random.rotation(), shoulder.place + length * random.vector(0.3, 1.5)};
                grips[a].push_back(floats(at.back().inverse() * hand));
            }
        }
        for (std::size_t a = 0; a < arms.size(); ++a)
            give(arms[a], SWIVEL_GRIP, [&](std::size_t n) { return grips[a][n]; });
        give(prop, SWIVEL_HAND_BLEND, [&](std::size_t) {
            const std::uint32_t kind = random.below(3);
            return Float1{kind < 2 ? static_cast<float>(kind) : static_cast<float>(random.unit())};
        });
        give(prop, SWIVEL_PROP_WEIGHT, [&](std::size_t) {
            const std::uint32_t kind = random.below(4);
            return Float1{kind == 0 ? 0 : kind == 1 ? static_cast<float>(random.unit()) : 1};
        });
        const bool is_ever_written = random.below(2);
        const std::int32_t joint = prop_def().joint;
        std::vector<Held> written;
        for (std::size_t n = 0; n < bodies.size(); ++n) {
            Held wanted = at[n];
            wanted.place += 0.1 * double{bodies[n].root_scale} * random.direction();
            if (joint >= 0) {
                const JointAt is = joints_at(skeleton, bodies[n])[static_cast<std::size_t>(joint)];
                wanted = Held{is.rotation, is.place}.inverse() * wanted;
            } else {
                wanted.place += vec(bodies[n].root_position);
            }
            written.push_back(wanted);
        }
        give(prop, SWIVEL_PROP_POSITION,
             [&](std::size_t n) { return is_ever_written && random.below(2) ? floats(written[n].place) : kNoPlace; });
        give(prop, SWIVEL_PROP_ROTATION,
             [&](std::size_t n) { return is_ever_written && random.below(2) ? floats(written[n].rotation) : kNoTurn; });
    }
    void add_animated(const SolvedBody& body, std::uint32_t arm, const Vector3d& root, UnmovedProp& is) const
    {
        const JointAt& wrist = body.came[body.joints(arm).wrist];
        Held point = body.point(arm, {wrist.rotation, wrist.place});
        const Float3 target = value(arm, SWIVEL_TARGET, body.n, kNoPlace);
        const Float4 hand = value(arm, SWIVEL_HAND, body.n, kNoTurn);
        const bool has_target = !std::isnan(target[0]), has_hand = !std::isnan(hand[0]);
        if (has_target) point.place = vec(target) - root;
        if (has_hand) point.rotation = quat(hand).normalized();
        is.points.push_back(point);
        is.has_target.push_back(has_target), is.has_hand.push_back(has_hand);
    }
    static Held between(const Held& a, const Held& b, double share)
    {
        const double side = a.rotation.dot(b.rotation) < 0 ? -1 : 1;
        Quaterniond q;
        q.coeffs() = (1 - share) * a.rotation.coeffs() + side * share * b.rotation.coeffs();
        return {q.normalized(), (1 - share) * a.place + share * b.place};
    }
    // How far a wrist is from its shoulder where the elbow is bent by twice the angle of this cosine.
    static double reach(const LimbAt& limb, float cos_half)
    {
        const double bend = 2 * std::acos(double{cos_half});
        return std::sqrt(std::max(
            0.0, limb.upper * limb.upper + limb.fore * limb.fore + 2 * limb.upper * limb.fore * std::cos(bend)));
    }
    double nearest(const SolvedBody& body, std::uint32_t arm) const
    {
        const BodyInput* const limit = find(arm, SWIVEL_FLEXION_LIMIT);
        return reach(body.limb(arm), limit ? limit->of<Float2>(body.n)[1] : 0);  // the largest flexion
    }
    Ball moves(const SolvedBody& body, std::uint32_t arm, const Held& frame) const
    {
        const LimbAt limb = body.limb(arm);
        const Vector3d shoulder = body.came[body.joints(arm).shoulder].place,
                       wrist = body.came[body.joints(arm).wrist].place;
        const BodyInput* const limit = find(arm, SWIVEL_FLEXION_LIMIT);
        double far = limit ? reach(limb, limit->of<Float2>(body.n)[0]) : limb.length();  // of the least flexion
        if (const BodyInput* const cap = find(arm, SWIVEL_CAP))  // which eases from where the incoming limb is
            far =
                std::min(far, std::max((wrist - shoulder).norm(), double{cap->of<Float3>(body.n)[1]} * limb.length()));
        const Held hand = frame * body.grip(arm);
        const Float3 effector = value(arm, SWIVEL_EFFECTOR, body.n, Float3{});
        return {shoulder - (hand.place - body.scale(arm) * (hand.rotation * vec(effector))), far};
    }
    double rest_length(std::uint32_t limb) const
    {
        return LimbAt(skeleton, skeleton.rest(), joints_at(skeleton, skeleton.rest()), skeleton.limbs[limb]).length();
    }
};

}  // namespace swivel::test
