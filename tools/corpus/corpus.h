// SPDX-License-Identifier: MIT
//
// The crowds that the promise of equal bits is checked on, in five parts, and their digests. A crowd draws its numbers
// by its own name and those of its fields. So a new feature or field adds crowds and changes the digests of parts, but
// of no other crowd. golden.h has what the digests must be.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/corpus/interface.h"
#include "tools/corpus/recipe.h"
#include "tools/corpus/standing.h"

namespace swivel::corpus {

// The number of limbs in a crowd's first group, or of bodies, at the crowd's own size, the size of golden.h.
std::uint32_t own_limb_count(Part part);
// The crowd with every input written: limb_count limbs in the first group, half as many and one in the second, seven
// in the third; of bodies as many in each. A limb's numbers do not depend on how many there are. Goals of bodies that
// stand come with their frames.
Crowd make_crowd(const Recipe& recipe, std::uint32_t limb_count);

// The number of solves of a crowd, each with other goals and poses. Some crowds carry state on. Standing bodies always
// do, and are solved more often at their own size.
std::uint32_t frame_count(Part part);
inline constexpr std::uint32_t kStandingFrames = 10000;
// The number of first frames for emulators. In these every body swings to and fro, and every flag occurs.
inline constexpr std::uint32_t kStandingStart = 1000;
// Crowds on uneven ground, and those that hold something, take this part of either number.
inline constexpr std::uint32_t kHoldingShare = 5;
std::uint32_t share_of(const Recipe& recipe, std::uint32_t frames);
// Rows are digested in every frame. Poses, which carry nothing, are digested in one frame of this many, because that
// takes longer than a solve.
inline constexpr std::uint32_t kStandingPoses = 16;
// Writes the goals of frame 1, 2...; make_crowd() wrote those of frame 0.
void write_goals(Crowd& crowd, const Recipe& recipe, std::uint32_t frame);
// The poses of a frame; those of free limbs are empty. Bodies that stand get their other inputs here, too.
Poses poses_of(Crowd& crowd, const Recipe& recipe, std::uint32_t frame);

// FNV-1a (64 bits) of the words of all limbs' results, field by field in the order of enum swivel_field, group by
// group.
std::uint64_t digest_results(const Crowd& crowd, const Recipe& recipe, std::uint64_t hash = kDigestStart);
// The same for solved poses, body by body.
std::uint64_t digest_poses(const Poses& poses, std::uint64_t hash);
// Folds a digest into a hash.
std::uint64_t fold(std::uint64_t hash, std::uint64_t digest);

// The digest of bodies that stand, in the first frames.
template <class Solve>
std::uint64_t standing_digest(const Recipe& recipe, Solve&& solve, std::uint32_t body_count, std::uint32_t frame_count)
{
    Crowd crowd = make_crowd(recipe, body_count);
    Standing standing(recipe, body_count);
    std::uint64_t hash = kDigestStart;
    for (std::uint32_t frame = 0; frame < frame_count; ++frame) {
        standing.go_to(frame, crowd);
        with_job(standing.poses(), [&](const Job& job) { solve(crowd, job); });
        hash = fold(hash, crowd.digest());
        if (frame % kStandingPoses == 0) hash = digest_poses(standing.poses(), hash);
    }
    return hash;
}

// The digest of one crowd, each frame solved by solve(crowd, job). The job solves all limbs. limb_count 0: the crowd's
// own.
template <class Solve>
std::uint64_t digest_of(const Recipe& recipe, Solve&& solve, std::uint32_t limb_count = 0)
{
    const std::uint32_t count = limb_count == 0 ? own_limb_count(recipe.part) : limb_count;
    if (recipe.part == Part::standing)
        return standing_digest(recipe, solve, count,
                               limb_count == 0 ? share_of(recipe, kStandingFrames) : frame_count(recipe.part));
    Crowd crowd = make_crowd(recipe, count);
    std::uint64_t hash = kDigestStart;
    for (std::uint32_t frame = 0; frame < frame_count(recipe.part); ++frame) {
        if (frame > 0) write_goals(crowd, recipe, frame);
        Poses poses = poses_of(crowd, recipe, frame);
        with_job(poses, [&](const Job& job) { solve(crowd, job); });
        hash = digest_poses(poses, digest_results(crowd, recipe, hash));
    }
    return hash;
}

// The digest of every crowd of a part, in the order of recipes_of().
template <class Solve>
std::vector<std::uint64_t> digests_of(Part part, Solve&& solve, std::uint32_t limb_count = 0)
{
    std::vector<std::uint64_t> digests;
    for (const Recipe& recipe : recipes_of(part)) digests.push_back(digest_of(recipe, solve, limb_count));
    return digests;
}

// The digest of a part: its crowds' digests folded.
std::uint64_t fold(const std::vector<std::uint64_t>& digests);
template <class Solve>
std::uint64_t digest_of(Part part, Solve&& solve, std::uint32_t limb_count = 0)
{
    return fold(digests_of(part, solve, limb_count));
}
// The digest of the standing part's start.
template <class Solve>
std::uint64_t digest_of_start(Solve&& solve)
{
    std::vector<std::uint64_t> digests;
    for (const Recipe& recipe : recipes_of(Part::standing))
        digests.push_back(
            standing_digest(recipe, solve, own_limb_count(Part::standing), share_of(recipe, kStandingStart)));
    return fold(digests);
}

// The names of a part's crowds whose digests, at their own sizes, are not the golden ones, or are not in golden.h yet.
// Digests of golden.h that are no crowd's are named by their numbers.
std::vector<std::string> wrong_crowds(Part part, const std::vector<std::uint64_t>& digests);

}  // namespace swivel::corpus
