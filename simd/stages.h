// SPDX-License-Identifier: MIT
//
// The stages of the whole limb: what each knows, and which of them a group needs. A stage takes a strip of blocks
// (strip.h) one step further. It is compiled once for each set of the features that it knows, so these are constants in
// it. The number of functions grows with the sum over the stages, not with the sets of all features.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "simd/fields.h"

namespace swivel {

// In the order in which they run. place is bones and wish in one, for limbs that ask nothing special of either.
enum class Stage : std::uint8_t {
    probe,           // where a foot is about to be, whatever the ground there is
    plant,           // where a body's planted point goes
    ground,          // the same on ground as it lies
    span,            // how a body's limb asks it to shift
    fit,             // the shift
    look,            // how a chain of joints turns to a target
    grasp,           // where a hand has the prop that it holds
    prop,            // where the prop goes
    link,            // the goal on a prop or on another limb's hand
    goal_to_parent,  // the goal, as the parent sees it
    posed,           // the same of a body's limb, with the incoming pose, its bones and how its joints lie to them
    clavicle,        // turned by its share, and the goal turned back
    incoming,        // the incoming pose, in the arm frame
    record,          // what of it free limbs are given
    goal,            // the hand's orientation and the wrist's place
    place,
    bones,   // the line to the wrist, the flexion and the lift
    capped,  // the same, of limbs that a cap keeps from reaching farther
    aim,     // the same, for a line of the hand that goes through the target
    wish,    // the swivel plane's normal
    yield,   // the hand, turned to where the wrist does not get
    line,    // the limit of the swivel that is the first of kLineLimits; its others follow
    shoulder_box = line + kLineLimitCount,
    wrist_box,
    region,         // where the upper arm points while it swivels
    choose,         // the swivel that the lines allow
    choose_in_box,  // the same, with boxes
    choose_in_region,
    store,  // lifts the arm, and stores the results
    wrist,  // the hand's rotation from the forearm
    twist_bones,
    correct,         // a body's joints
    hand_transform,  // where the hand is then
    commit,          // stores what waited until all input is known to be good
    count
};

// The first may move a limb whose weights ask for nothing, the others also one whose goal is its incoming pose.
inline constexpr swivel_features kBoundingFeatures = kSwivelLimits | features_with(kBounds),
                                 kMovingFeatures = kBoundingFeatures | features_with(kTurnsWish);

// All groups of a body go through a pass before the first goes through the next one.
enum class Pass : std::uint8_t {
    probe,   // of jobs that sample the ground
    gather,  // what limbs ask of the body
    shift,   // the body's answer
    look,    // what turns before limbs that hang below it
    grasp,   // what hands ask of props
    hold,    // where these go
    solve,
    count
};
inline constexpr std::size_t kPassCount = static_cast<std::size_t>(Pass::count);

struct StageRow {
    Stage stage;
    swivel_features knows;
    swivel_features needed_by;      // groups with any of these need it; 0: all groups
    swivel_features not_needed_by;  // but not those with any of these
    Pass pass = Pass::solve;
};
inline constexpr swivel_features kSpecial = features_with(kIsSpecial);
// All stages but those of lines.
inline constexpr StageRow kOtherStages[] = {
    {Stage::probe, 0, SWIVEL_WITH_GROUND, 0, Pass::probe},
    {Stage::plant, 0, SWIVEL_WITH_PLANT, 0, Pass::gather},
    {Stage::ground, 0, SWIVEL_WITH_GROUND, 0, Pass::gather},
    {Stage::span, 0, SWIVEL_WITH_PELVIS_FIT, 0, Pass::gather},
    {Stage::fit, 0, kShift, 0, Pass::shift},
    {Stage::look, 0, kLook, 0, Pass::look},
    {Stage::grasp, 0, SWIVEL_WITH_LINK, 0, Pass::grasp},
    {Stage::prop, 0, kProp, 0, Pass::hold},
    {Stage::link, 0, SWIVEL_WITH_LINK, 0},
    {Stage::goal_to_parent, SWIVEL_JOINTS | SWIVEL_WITH_HAND, SWIVEL_WORLD, kBody},
    {Stage::posed, SWIVEL_POLE_INCOMING, kBody, 0},
    {Stage::clavicle, 0, SWIVEL_WITH_CLAVICLE, 0},
    {Stage::incoming, SWIVEL_JOINTS, SWIVEL_WITH_INCOMING, kBody},
    {Stage::record, 0, SWIVEL_WITH_RECORD, 0},
    {Stage::goal, SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS, SWIVEL_WITH_HAND | SWIVEL_WITH_WEIGHTS, 0},
    {Stage::place, SWIVEL_POLE_NORMAL | SWIVEL_WITH_ANGLE, 0, kSpecial},
    {Stage::bones, SWIVEL_WITH_FLEXION_LIMIT | SWIVEL_WITH_REACH, kSpecial, SWIVEL_WITH_AIM | SWIVEL_WITH_CAP},
    {Stage::capped, 0, SWIVEL_WITH_CAP, 0},
    {Stage::aim, 0, SWIVEL_WITH_AIM, 0},
    {Stage::wish, SWIVEL_WITH_INCOMING | SWIVEL_WITH_MAX_SWIVEL, kSpecial, 0},
    {Stage::yield, 0, SWIVEL_HAND_YIELDS, 0},
    {Stage::shoulder_box, SWIVEL_WITH_AIM, SWIVEL_WITH_SHOULDER_BOX, 0},
    {Stage::wrist_box, 0, SWIVEL_WITH_WRIST_BOX, SWIVEL_WITH_AIM},
    {Stage::region, SWIVEL_WITH_AIM, SWIVEL_WITH_REGION, 0},
    {Stage::choose, 0, kLineFeatures, kBoxFeatures | SWIVEL_WITH_REGION},
    {Stage::choose_in_box, 0, kBoxFeatures, SWIVEL_WITH_REGION},
    {Stage::choose_in_region, 0, SWIVEL_WITH_REGION, 0},
    {Stage::store, SWIVEL_JOINTS | SWIVEL_WITH_AIM, 0, 0},
    {Stage::wrist, SWIVEL_JOINTS, SWIVEL_WITH_HAND, 0},
    {Stage::twist_bones, 0, kTwistBones, 0},
    {Stage::correct, 0, kBody, 0},
    {Stage::hand_transform, 0, SWIVEL_WITH_HAND_TRANSFORM, 0},
    {Stage::commit, 0, kLibraryGoal, 0},
};
constexpr bool is_line(Stage stage) { return stage >= Stage::line && stage < Stage::shoulder_box; }
constexpr swivel_field line_limit_of(Stage stage)
{
    return kLineLimits[static_cast<std::size_t>(stage) - static_cast<std::size_t>(Stage::line)];
}
// In the order of the stages. Groups that aim have no limits of the hand.
inline constexpr auto kStages = [] {
    std::array<StageRow, static_cast<std::size_t>(Stage::count)> rows{};
    const StageRow* other = kOtherStages;
    for (std::size_t n = 0; n < rows.size(); ++n) {
        const Stage stage = static_cast<Stage>(n);
        if (is_line(stage)) {
            const swivel_features feature = row_of(line_limit_of(stage)).needs;
            const bool may_aim = !(feature & kHandLimits);
            rows[n] = {stage, may_aim ? SWIVEL_WITH_AIM : 0, feature, may_aim ? 0 : SWIVEL_WITH_AIM};
        } else {
            rows[n] = *other++;
        }
    }
    return rows;
}();
static_assert([] {
    std::size_t n = 0;
    for (const StageRow& row : kStages)
        if (static_cast<std::size_t>(row.stage) != n++) return false;
    return std::size(kOtherStages) + kLineLimitCount == n;
}());
constexpr const StageRow& row_of(Stage stage) { return kStages[static_cast<std::size_t>(stage)]; }
constexpr bool needs(swivel_features features, const StageRow& row)
{
    return (row.needed_by == 0 || features & row.needed_by) && !(features & row.not_needed_by);
}
// The feature that makes groups need a stage, if it is a single one: then every group with the stage has it.
constexpr swivel_features implied_by(const StageRow& row)
{
    return std::has_single_bit(row.needed_by) ? row.needed_by : swivel_features{0};
}
// The features that are constants of a stage: those that it knows, those that exclude it, and the one that it is needed
// by. Only those that it knows multiply its functions.
constexpr swivel_features constants_of(const StageRow& row) { return row.knows | row.not_needed_by | implied_by(row); }

constexpr std::uint32_t line_count(swivel_features features)
{
    return static_cast<std::uint32_t>(std::popcount(features & kLineFeatures));
}

// A stage's functions: one for each subset of what it knows, the nth for subset n. `choose` has one for one line, one
// for two, and one for more.
inline constexpr std::size_t kLineCounts = 3;
constexpr std::size_t function_count(Stage stage)
{
    return stage == Stage::choose ? kLineCounts : std::size_t{1} << std::popcount(row_of(stage).knows);
}
constexpr swivel_features subset(swivel_features knows, std::size_t n)
{
    swivel_features has = 0;
    for (; knows != 0; knows &= knows - 1, n /= 2)
        if (n % 2 == 1) has |= knows & -knows;
    return has;
}
constexpr std::size_t function_of(Stage stage, swivel_features features)
{
    if (stage == Stage::choose) return line_count(features) < kLineCounts ? line_count(features) - 1 : kLineCounts - 1;
    std::size_t n = 0;
    while (subset(row_of(stage).knows, n) != (features & row_of(stage).knows)) ++n;
    return n;
}
// The functions of all stages have numbers, stage after stage. The first one of each stage is looked up, because clang
// ends a constant expression that takes a million steps.
inline constexpr auto kFirstFunctions = [] {
    std::array<std::size_t, kStages.size() + 1> first{};
    for (std::size_t n = 0; n < kStages.size(); ++n) first[n + 1] = first[n] + function_count(kStages[n].stage);
    return first;
}();
constexpr std::size_t first_function(Stage stage) { return kFirstFunctions[static_cast<std::size_t>(stage)]; }
inline constexpr std::size_t kStageFunctions = first_function(Stage::count);
static_assert(kStageFunctions <= 256);

// The functions that the limbs of a group go through, by their numbers.
struct StageList {
    std::uint8_t function[std::size(kStages)] = {};
    std::uint32_t count = 0;

    constexpr StageList() = default;
    constexpr StageList(swivel_features features, Pass pass)
    {
        for (const StageRow& row : kStages)
            if (row.pass == pass && needs(features, row) && (row.needed_by & kNoLimb || !(features & kNoLimb)))
                function[count++] =
                    static_cast<std::uint8_t>(first_function(row.stage) + function_of(row.stage, features));
    }
};

}  // namespace swivel
