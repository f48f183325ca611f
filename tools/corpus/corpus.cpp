// SPDX-License-Identifier: MIT
#include "tools/corpus/corpus.h"

#include <algorithm>
#include <cstring>

#include "tools/corpus/arms.h"
#include "tools/corpus/bodies.h"
#include "tools/corpus/golden.h"
#include "tools/corpus/hard_cases.h"
#include "tools/corpus/interface.h"

namespace swivel::corpus {

namespace {

// Limbs come in runs. Of the hard part: hard cases, ordinary arms, arms of which numbers are spoilt. Of whole limbs:
// spoilt ones, one in eight of them a hard pose, and ordinary ones. Of bodies: spoilt and ordinary ones.
enum class Run { cases, ordinary, spoilt };
Run run_of(const Recipe& recipe, std::uint32_t limb)
{
    constexpr Run hard[] = {Run::cases, Run::ordinary, Run::spoilt};
    if (recipe.part == Part::hard) return hard[limb / kRunLimbs % 3];
    if (recipe.part == Part::ordinary || !is_spoilt_run(limb)) return Run::ordinary;
    return limb % 8 == 3 && recipe.part == Part::limbs ? Run::cases : Run::spoilt;
}
// A limb's hard case. Each group of the hard part starts its own pass through the cases; whole limbs have some of the
// poses.
Arm case_of(const Recipe& recipe, std::uint32_t group, std::uint32_t limb, std::uint32_t frame)
{
    if (recipe.part == Part::hard)
        return hard_case(group * hard_case_count() + limb / (3 * kRunLimbs) * kRunLimbs + limb % kRunLimbs);
    const std::uint32_t start = static_cast<std::uint32_t>(recipe.seed % kLimbCaseCount);
    return hard_case((start + limb / 8 + 31 * group + 7 * frame) % kLimbCaseCount);
}

bool changes_with_frames(swivel_field field) { return field == SWIVEL_TARGET || field == SWIVEL_POLE; }

// Replaces one in sixteen numbers of spoilt arms.
void spoil_arms(const Recipe& recipe, std::uint32_t group, std::uint32_t frame, std::span<Arm> arms)
{
    for (const swivel_field field : kArmFields) {
        Random random = stream(recipe.seed, group, field, Use::spoil, changes_with_frames(field) ? frame : 0);
        for (std::uint32_t limb = 0; limb < arms.size(); ++limb)
            if (run_of(recipe, limb) == Run::spoilt) spoil(random, arms[limb].values(field), 16);
    }
}
void put_hard_cases(const Recipe& recipe, std::uint32_t group, std::uint32_t frame, std::span<Arm> arms)
{
    for (std::uint32_t limb = 0; limb < arms.size(); ++limb)
        if (run_of(recipe, limb) == Run::cases) arms[limb] = case_of(recipe, group, limb, frame);
}

// The arms to write: hard cases replace some ordinary ones, and some numbers are spoilt.
std::vector<Arm> arms_of(const Recipe& recipe, std::uint32_t group, std::span<const Arm> ordinary, std::uint32_t frame)
{
    std::vector<Arm> arms(ordinary.begin(), ordinary.end());
    put_hard_cases(recipe, group, frame, arms);
    spoil_arms(recipe, group, frame, arms);
    return arms;
}
// The arms from which arms_of() makes those.
std::vector<Arm> good_arms(const Recipe& recipe, std::uint32_t group, std::uint32_t limb_count, std::uint32_t frame)
{
    return is_of_bodies(recipe.part) ? body_arms(recipe, group, limb_count, frame)
                                     : ordinary_arms(recipe, group, limb_count, frame);
}

bool is_of_arms(swivel_field field)
{
    return std::find(std::begin(kArmFields), std::end(kArmFields), field) != std::end(kArmFields);
}
// Bodies that stand get their goals frame by frame. Other bodies' bones are as long as their poses say, and goals that
// are far away are given in double.
bool is_in_rows(const Recipe& recipe, swivel_field field)
{
    if (recipe.part == Part::standing) return !is_of_arms(field);
    if (recipe.part != Part::bodies) return true;
    return field == SWIVEL_LENGTHS ? recipe.pose & kLengths : !(recipe.pose & kFar) || !changes_with_frames(field);
}

std::vector<double> far_from(const std::vector<double>& roots, const std::vector<Arm>& arms,
                             std::array<float, 3> Arm::*place)
{
    std::vector<double> places;
    for (std::size_t n = 0; n < arms.size(); ++n)
        for (std::size_t c = 0; c < 3; ++c) places.push_back(roots[3 * n + c] + double{(arms[n].*place)[c]});
    return places;
}

void write_arms(Crowd& crowd, swivel_field field, std::uint32_t group, std::span<Arm> arms)
{
    std::vector<float> values;
    for (Arm& arm : arms) {
        const std::span<float> value = arm.values(field);
        values.insert(values.end(), value.begin(), value.end());
    }
    write_field(crowd, field, group, values);
}

// Adds a number's lowest bytes, the lowest first.
std::uint64_t add_bytes(std::uint64_t hash, std::uint64_t number, int count)
{
    for (int byte = 0; byte < count; ++byte) hash = add_byte(hash, number >> (8 * byte) & 0xffu);
    return hash;
}

// Writes the inputs that are wanted, of all groups.
template <class IsWanted>
void write_inputs(Crowd& crowd, const Recipe& recipe, const LimbCounts& counts, std::uint32_t frame, IsWanted is_wanted)
{
    for (std::uint32_t group = 0; group < counts.size(); ++group) {
        const std::vector<Arm> ordinary = good_arms(recipe, group, counts[group], frame);
        std::vector<Arm> arms = arms_of(recipe, group, ordinary, frame);
        for (const swivel_field field : inputs_of(crowd, group)) {
            if (!is_wanted(field) || !is_in_rows(recipe, field)) continue;
            if (is_of_arms(field))
                write_arms(crowd, field, group, arms);
            else
                write_field(
                    crowd, field, group,
                    limb_values(recipe, field, swivel_field_row_count(crowd.get(), group, field), group, ordinary));
        }
    }
}

}  // namespace

std::uint32_t own_limb_count(Part part)
{
    constexpr std::uint32_t counts[] = {1000, 1000, 600, 200, 16};
    return counts[static_cast<std::size_t>(part)];
}
std::uint32_t frame_count(Part part)
{
    constexpr std::uint32_t counts[] = {1, 1, 3, 3, 50};
    return counts[static_cast<std::size_t>(part)];
}

std::uint32_t share_of(const Recipe& recipe, std::uint32_t frames)
{
    return recipe.features & SWIVEL_WITH_GROUND || recipe.holds != Holds::nothing ? frames / kHoldingShare : frames;
}

Crowd make_crowd(const Recipe& recipe, std::uint32_t limb_count)
{
    const LimbCounts counts = is_of_bodies(recipe.part) ? LimbCounts{limb_count, limb_count, limb_count}
                                                        : LimbCounts{limb_count, limb_count / 2 + 1, 7};
    Crowd crowd = create_crowd(recipe, counts);
    write_inputs(crowd, recipe, counts, 0, [](swivel_field) { return true; });
    return crowd;
}
void write_goals(Crowd& crowd, const Recipe& recipe, std::uint32_t frame)
{
    write_inputs(crowd, recipe, limb_counts(crowd), frame, changes_with_frames);
}

Poses poses_of(Crowd& crowd, const Recipe& recipe, std::uint32_t frame)
{
    if (!is_of_bodies(recipe.part)) return {};
    const std::uint32_t body_count = limb_counts(crowd)[0];
    if (recipe.part == Part::standing) {
        Standing standing(recipe, body_count);
        standing.go_to(frame, crowd);
        return standing.poses();
    }
    Poses poses = make_poses(recipe, body_count, frame);
    for (std::uint32_t group = 0; (recipe.pose & kFar) && group < kGroupCount; ++group) {
        const std::vector<Arm> arms = arms_of(recipe, group, good_arms(recipe, group, body_count, frame), frame);
        poses.far_targets[group] = far_from(poses.far_roots, arms, &Arm::target);
        if (!(recipe.features & (SWIVEL_POLE_INCOMING | SWIVEL_POLE_HAND | SWIVEL_POLE_HALF_LINE)))
            poses.far_poles[group] = far_from(poses.far_roots, arms, &Arm::pole);
    }
    return poses;
}

std::uint64_t digest_results(const Crowd& crowd, const Recipe& recipe, std::uint64_t hash)
{
    for (const swivel_field field : results_of(crowd))
        for (std::uint32_t group = 0; group < kGroupCount; ++group)
            for (const std::uint32_t word : read_field(crowd, recipe, field, group)) hash = add_bytes(hash, word, 4);
    return hash;
}

std::uint64_t digest_poses(const Poses& poses, std::uint64_t hash)
{
    for (const std::vector<float>* const numbers : poses.solved())
        for (const float& number : *numbers) {
            std::uint32_t word;
            std::memcpy(&word, &number, sizeof word);
            hash = add_bytes(hash, word, 4);
        }
    return hash;
}

std::uint64_t fold(std::uint64_t hash, std::uint64_t digest) { return add_bytes(hash, digest, 8); }
std::uint64_t fold(const std::vector<std::uint64_t>& digests)
{
    std::uint64_t hash = kDigestStart;
    for (const std::uint64_t digest : digests) hash = fold(hash, digest);
    return hash;
}

std::vector<std::string> wrong_crowds(Part part, const std::vector<std::uint64_t>& digests)
{
    std::vector<std::string> names;
    const std::span<const Recipe> recipes = recipes_of(part);
    const std::span<const std::uint64_t> golden = kGoldenCrowds[static_cast<std::size_t>(part)];
    for (std::size_t n = 0; n < recipes.size(); ++n)
        if (n >= golden.size() || digests.at(n) != golden[n]) names.push_back(full_name(recipes[n]));
    for (std::size_t n = recipes.size(); n < golden.size(); ++n)
        names.push_back("golden.h's " + std::string(name_of(part)) + " digest " + std::to_string(n));
    return names;
}

}  // namespace swivel::corpus
