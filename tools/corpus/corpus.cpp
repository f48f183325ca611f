// SPDX-License-Identifier: MIT
#include "tools/corpus/corpus.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

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
// A limb's hard case. Groups of the hard part start with a pass of their own; whole limbs have some of the poses.
Arm case_of(const Recipe& recipe, std::uint32_t group, std::uint32_t limb, std::uint32_t frame)
{
    if (recipe.part == Part::hard)
        return hard_case(group * hard_case_count() + limb / (3 * kRunLimbs) * kRunLimbs + limb % kRunLimbs);
    const std::uint32_t start = static_cast<std::uint32_t>(recipe.seed % kLimbCaseCount);
    return hard_case((start + limb / 8 + 31 * group + 7 * frame) % kLimbCaseCount);
}

bool changes_with_frames(Field field) { return field == Field::target || field == Field::pole; }

// Numbers of arms replaced, one in sixteen.
void spoil_arms(const Recipe& recipe, std::uint32_t group, std::uint32_t frame, std::span<Arm> arms)
{
    for (const Field field : kArmFields) {
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

// Arms as they are written: hard cases in place of ordinary ones, and numbers spoilt.
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
    return recipe.part == Part::bodies ? body_arms(recipe, group, limb_count, frame)
                                       : ordinary_arms(recipe, group, limb_count, frame);
}
// Bodies' bones are as long as their poses say, and goals that are far away are given in double.
bool is_in_rows(const Recipe& recipe, Field field)
{
    if (recipe.part != Part::bodies) return true;
    return field == Field::lengths ? recipe.pose & kLengths : !(recipe.pose & kFar) || !changes_with_frames(field);
}

std::vector<double> far_from(const std::vector<double>& roots, const std::vector<Arm>& arms,
                             std::array<float, 3> Arm::*place)
{
    std::vector<double> places;
    for (std::size_t n = 0; n < arms.size(); ++n)
        for (std::size_t c = 0; c < 3; ++c) places.push_back(roots[3 * n + c] + double{(arms[n].*place)[c]});
    return places;
}

bool is_of_arms(Field field)
{
    return std::find(std::begin(kArmFields), std::end(kArmFields), field) != std::end(kArmFields);
}

void write_arms(Crowd& crowd, Field field, std::uint32_t group, std::span<Arm> arms)
{
    std::vector<float> values;
    for (Arm& arm : arms) {
        const std::span<float> value = arm.values(field);
        values.insert(values.end(), value.begin(), value.end());
    }
    write_field(crowd, field, group, values);
}

// FNV-1a over a number's lowest bytes, the lowest first.
std::uint64_t add_bytes(std::uint64_t hash, std::uint64_t number, int count)
{
    for (int byte = 0; byte < count; ++byte) hash = (hash ^ (number >> (8 * byte) & 0xffu)) * 0x100000001b3u;
    return hash;
}

// Writes the inputs that are wanted, of all groups.
template <class IsWanted>
void write_inputs(Crowd& crowd, const Recipe& recipe, const LimbCounts& counts, std::uint32_t frame, IsWanted is_wanted)
{
    for (std::uint32_t group = 0; group < counts.size(); ++group) {
        const std::vector<Arm> ordinary = good_arms(recipe, group, counts[group], frame);
        std::vector<Arm> arms = arms_of(recipe, group, ordinary, frame);
        for (const Field field : inputs_of(crowd)) {
            if (!is_wanted(field) || !is_in_rows(recipe, field)) continue;
            if (is_of_arms(field))
                write_arms(crowd, field, group, arms);
            else
                write_field(crowd, field, group,
                            limb_values(recipe, field, component_count(crowd, field, group), group, ordinary));
        }
    }
}

// The rows of the fields that the corpus knows must be all that the crowd has.
void check_rows(const Recipe& recipe, const Crowd& crowd)
{
    const auto require = [&](std::uint32_t listed, std::uint32_t has, const char* what) {
        if (listed != has)
            throw std::logic_error("corpus: crowd " + full_name(recipe) + " lists " + std::to_string(listed) +
                                   " rows of " + what + ", the library has " + std::to_string(has));
    };
    for (std::uint32_t group = 0; group < kGroupCount; ++group) {
        std::uint32_t inputs = 0, results = 0;
        for (const Field field : inputs_of(crowd, group)) inputs += component_count(crowd, field, group);
        for (const Field field : results_of(crowd, group)) results += component_count(crowd, field, group);
        require(inputs, input_row_count(crowd, group), "inputs");
        require(results, result_row_count(crowd, group), "results");
    }
}

}  // namespace

const char* name_of(Part part)
{
    constexpr const char* names[] = {"ordinary", "hard", "limbs", "bodies", "standing"};
    return names[static_cast<std::size_t>(part)];
}
std::string full_name(const Recipe& recipe) { return std::string(name_of(recipe.part)) + " " + recipe.name; }

std::span<const Recipe> recipes_of(Part part)
{
    switch (part) {
        case Part::ordinary:
            return ordinary_recipes();
        case Part::hard:
            return hard_recipes();
        case Part::limbs:
            return limb_recipes();
        case Part::bodies:
            return body_recipes();
        case Part::standing:
            return standing_recipes();
    }
    return {};
}
const Recipe& recipe_of(Part part, std::string_view name)
{
    for (const Recipe& recipe : recipes_of(part))
        if (recipe.name == name) return recipe;
    throw std::out_of_range("corpus: part " + std::string(name_of(part)) + " has no crowd " + std::string(name));
}

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
    return recipe.features & kGround || recipe.holds != Holds::nothing ? frames / kHoldingShare : frames;
}

Crowd make_crowd(const Recipe& recipe, std::uint32_t limb_count)
{
    const LimbCounts counts = is_of_bodies(recipe.part) ? LimbCounts{limb_count, limb_count, limb_count}
                                                        : LimbCounts{limb_count, limb_count / 2 + 1, 7};
    Crowd crowd = create_crowd(recipe, counts);
    check_rows(recipe, crowd);
    if (recipe.part == Part::standing)
        Standing(recipe, limb_count).write_constants(crowd);
    else
        write_inputs(crowd, recipe, counts, 0, [](Field) { return true; });
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
        if (!(recipe.features & (kPoleIncoming | kPoleHand)))
            poses.far_poles[group] = far_from(poses.far_roots, arms, &Arm::pole);
    }
    return poses;
}

std::uint64_t digest_results(const Crowd& crowd, const Recipe& recipe, std::uint64_t hash)
{
    for (const Field field : results_of(crowd))
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
    for (std::size_t n = 0; n < recipes.size(); ++n)
        if (digests.at(n) != kGoldenCrowds[static_cast<std::size_t>(part)][n]) names.push_back(full_name(recipes[n]));
    return names;
}
std::string shortened(const std::vector<std::string>& names)
{
    std::string text;
    for (std::size_t n = 0; n < names.size() && n < 3; ++n) text += (n == 0 ? "" : ", ") + names[n];
    return names.size() <= 3 ? text : text + " and " + std::to_string(names.size() - 3) + " more";
}

}  // namespace swivel::corpus
