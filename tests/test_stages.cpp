// SPDX-License-Identifier: MIT
//
// The promise: the stages of a kernel give the bits of the whole formula, core/limb.h, with each feature. The
// limbs are in their own frame, so nothing but the formula lies between inputs and results. The tests crowd_world and
// crowd_skeleton judge parents and joints.
#include "core/limb.h"
#include "tests/test_arm.h"
#include "tests/test_crowd.h"
#include "tools/corpus/corpus.h"

using namespace swivel;
using namespace swivel::test;

namespace {

// The inputs of one limb, by field.
struct Inputs {
    Crowd& crowd;
    std::uint32_t limb;

    float operator()(swivel_field field, std::uint32_t component) const
    {
        const swivel_rows rows =
            field < SWIVEL_INPUT_END ? swivel_input_rows(crowd.get(), 0) : swivel_result_rows(crowd.get(), 0);
        const std::uint32_t row = swivel_field_first_row(crowd.get(), 0, field) + component;
        return rows
            .base[(std::size_t{limb / SWIVEL_LANES} * rows.row_count + row) * SWIVEL_LANES + limb % SWIVEL_LANES];
    }
    Vector<float> vector_of(swivel_field field) const
    {
        return vector((*this)(field, 0), (*this)(field, 1), (*this)(field, 2));
    }
    Rotor<float> rotor_of(swivel_field field) const
    {
        return rotor((*this)(field, 0), (*this)(field, 1), (*this)(field, 2), (*this)(field, 3));
    }
    Turned<float> turned_of(swivel_field field, std::uint32_t first = 0) const
    {
        return {(*this)(field, first), (*this)(field, first + 1)};
    }
    Range<float> range_of(swivel_field field, std::uint32_t first = 0) const
    {
        return {turned_of(field, first), turned_of(field, first + 2)};
    }
};

SolvedLimb<float> solved(const Inputs& in, swivel_features features, const corpus::Recipe& recipe)
{
    const auto has = [&](swivel_features feature) { return (features & feature) != 0; };
    LimbUse use;
    LimbGoal<float> goal{};
    goal.arm = {in.vector_of(SWIVEL_TARGET), vector(0.0f, 0.0f, 0.0f), in(SWIVEL_LENGTHS, 0), in(SWIVEL_LENGTHS, 1)};
    bool good = true;
    use.wish = has(SWIVEL_POLE_INCOMING) ? Wish::incoming
               : has(SWIVEL_POLE_NORMAL) ? Wish::normal
               : has(SWIVEL_POLE_HAND)   ? Wish::hand
                                         : Wish::pole;
    if (use.wish == Wish::pole || use.wish == Wish::normal) goal.arm.pole = in.vector_of(SWIVEL_POLE);
    if ((use.hand = has(SWIVEL_WITH_HAND))) {
        goal.hand = in.rotor_of(SWIVEL_HAND);
        good = good && is_orientation(goal.hand);
    }
    use.yields = has(SWIVEL_HAND_YIELDS);
    if ((use.effector = has(SWIVEL_WITH_EFFECTOR))) goal.effector = in.vector_of(SWIVEL_EFFECTOR);
    if ((use.angle = has(SWIVEL_WITH_ANGLE))) goal.angle = in.turned_of(SWIVEL_ANGLE);
    const auto incoming = [&](swivel_field field) {
        const Rotor<float> given = in.rotor_of(field);
        good = good && is_orientation(given);
        return scaled(given);
    };
    if ((use.incoming = has(SWIVEL_WITH_INCOMING)))
        goal.incoming = {incoming(SWIVEL_INCOMING_SHOULDER), incoming(SWIVEL_INCOMING_ELBOW),
                         use.hand ? incoming(SWIVEL_INCOMING_WRIST) : one<float>()};
    if ((use.weights = has(SWIVEL_WITH_WEIGHTS)))
        goal.weights = {in(SWIVEL_WEIGHTS, 0), in(SWIVEL_WEIGHTS, 1), in(SWIVEL_WEIGHTS, 2)};
    if ((use.reach = has(SWIVEL_WITH_REACH)))
        goal.reach = {in(SWIVEL_REACH, 0), in(SWIVEL_REACH, 1), in(SWIVEL_REACH, 2), in(SWIVEL_REACH, 3)};
    if ((use.cap = has(SWIVEL_WITH_CAP))) {
        goal.cap = {in(SWIVEL_CAP, 0), in(SWIVEL_CAP, 1), in(SWIVEL_CAP, 2),
                    incoming_reach(normalise(goal.incoming.elbow), goal.arm)};
        good = good && is_valid(goal.cap);
    }
    if ((use.continuity = has(SWIVEL_WITH_MOST_SWIVEL)))
        goal.continuity = {in.vector_of(SWIVEL_NORMAL), in.turned_of(SWIVEL_MOST_SWIVEL)};
    use.step_wins = has(SWIVEL_STEP_WINS);
    if ((use.aim = has(SWIVEL_WITH_AIM))) {
        goal.aim = {in.vector_of(SWIVEL_AIM), in(SWIVEL_AIM, 3), in(SWIVEL_AIM, 4)};
        good = good && is_unit2(len2(goal.aim.axis));
    }
    LimitUse& limits = use.limits;
    const auto cone_of = [&](swivel_field field) { return Cone<float>{in.vector_of(field), in(field, 3)}; };
    if ((limits.flexion = has(SWIVEL_WITH_FLEXION_LIMIT)))
        goal.limits.flexion = {in(SWIVEL_FLEXION_LIMIT, 0), in(SWIVEL_FLEXION_LIMIT, 1)};
    if ((limits.shoulder_cone = has(SWIVEL_WITH_SHOULDER_CONE)))
        goal.limits.shoulder_cone = cone_of(SWIVEL_SHOULDER_CONE);
    if ((limits.hand_cone = has(SWIVEL_WITH_HAND_CONE))) goal.limits.hand_cone = cone_of(SWIVEL_HAND_CONE);
    if ((limits.humeral_twist = has(SWIVEL_WITH_HUMERAL_TWIST)))
        goal.limits.humeral_twist = in.range_of(SWIVEL_HUMERAL_TWIST);
    if ((limits.forearm_twist = has(SWIVEL_WITH_FOREARM_TWIST)))
        goal.limits.forearm_twist = in.range_of(SWIVEL_FOREARM_TWIST);
    if ((limits.hand_twist = has(SWIVEL_WITH_HAND_TWIST)))
        goal.limits.hand_twist = {in.vector_of(SWIVEL_HAND_TWIST), in.range_of(SWIVEL_HAND_TWIST, 3)};
    limits.shoulder_order = kEulerOrders[static_cast<int>(recipe.shoulder_order)];
    limits.wrist_order = kEulerOrders[static_cast<int>(recipe.wrist_order)];
    limits.shoulder_box = has(SWIVEL_WITH_SHOULDER_BOX);
    limits.wrist_box = has(SWIVEL_WITH_WRIST_BOX);
    for (std::uint32_t n = 0; n < 3; ++n) {
        if (limits.shoulder_box) goal.limits.shoulder_box[n] = in.range_of(SWIVEL_SHOULDER_BOX, 4 * n);
        if (limits.wrist_box) goal.limits.wrist_box[n] = in.range_of(SWIVEL_WRIST_BOX, 4 * n);
    }
    return use.aim ? solve_limb<true>(use, goal, good) : solve_limb<false>(use, goal, good);
}

bool are_equal(const Float2& a, const Float2& b)
{
    return bit_cast<std::array<std::uint32_t, 2>>(a) == bit_cast<std::array<std::uint32_t, 2>>(b);
}
// A rotation and its negative are the same.
bool is_either(const Rotor<float>& a, const Rotor<float>& b)
{
    const auto bits = [](const Rotor<float>& q) { return bit_cast<std::array<std::uint32_t, 4>>(q.c); };
    return bits(a) == bits(b) || bits(a) == bits(-b);
}

// Limbs that the corpus does not have.
constexpr corpus::Recipe kCapped[] = {
    {corpus::Part::limbs, "cap", 0x3b1f6f3a51c0d9e7u, corpus::kIncoming | corpus::kCap},
    {corpus::Part::limbs, "yields", 0x51d7c0a2e94b83f6u,
     corpus::kHand | corpus::kEffector | corpus::kReach | corpus::kYields},
    {corpus::Part::limbs, "cap-limits", 0x8e5c02d74fa9b316u,
     corpus::kIncoming | corpus::kHand | corpus::kWeights | corpus::kFlexion | corpus::kStep | corpus::kCap}};

}  // namespace

TEST_CASE("the stages give the bits of the whole formula")
{
    constexpr swivel_features elsewhere = SWIVEL_WORLD | SWIVEL_JOINTS | SWIVEL_WITH_REGION;  // crowd_region has these
    constexpr std::uint32_t limbs = 500;
    int checked = 0;
    const std::span<const corpus::Recipe> frozen = corpus::limb_recipes();
    std::vector<corpus::Recipe> recipes(frozen.begin(), frozen.end());
    recipes.insert(recipes.end(), std::begin(kCapped), std::end(kCapped));
    for (const corpus::Recipe& recipe : recipes) {
        Crowd crowd = corpus::make_crowd(recipe, limbs);
        const swivel_features features = swivel_group_features(crowd.get(), 0);
        if (features & elsewhere) continue;
        ++checked;
        for (std::uint32_t frame = 0; frame < corpus::frame_count(recipe.part); ++frame) {
            if (frame > 0) corpus::write_goals(crowd, recipe, frame);
            std::vector<SolvedLimb<float>> wanted;
            for (std::uint32_t n = 0; n < limbs; ++n) wanted.push_back(solved({crowd, n}, features, recipe));
            crowd.solve();
            for (std::uint32_t n = 0; n < limbs; ++n) {
                INFO(corpus::full_name(recipe) << ", frame " << frame << ", limb " << n);
                const Inputs got{crowd, n};
                const SolvedLimb<float>& limb = wanted[n];
                REQUIRE(bit_cast<std::uint32_t>(got(SWIVEL_FLAGS, 0)) == limb.arm.flags);
                REQUIRE(is_either(got.rotor_of(SWIVEL_SHOULDER), limb.arm.shoulder));
                REQUIRE(
                    are_equal({got(SWIVEL_ELBOW, 0), got(SWIVEL_ELBOW, 1)}, {limb.arm.cos_half, limb.arm.sin_half}));
                if (features & SWIVEL_WITH_HAND) REQUIRE(is_either(got.rotor_of(SWIVEL_WRIST), limb.wrist));
                if (features & SWIVEL_WITH_REACH) REQUIRE(are_equal({got(SWIVEL_STRETCH, 0), 0}, {limb.stretch, 0}));
                if (features & SWIVEL_WITH_MOST_SWIVEL)
                    REQUIRE(bit_cast<std::array<std::uint32_t, 3>>(got.vector_of(SWIVEL_NORMAL).c) ==
                            bit_cast<std::array<std::uint32_t, 3>>(limb.normal.c));
            }
        }
    }
    CHECK(checked > 30);
}
