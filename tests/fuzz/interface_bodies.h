// SPDX-License-Identifier: MIT
//
// The poses of a job's bodies, made from bytes in all forms and at any distances; and what must be in them after a
// solve.
#pragma once

#include <array>
#include <optional>

#include "tests/fuzz/interface_session.h"
#include "tests/fuzz/joint_array.h"
#include "tests/fuzz/strided.h"

namespace swivel::fuzz {

struct Pose {
    swivel_pose given = swivel_default_pose();
    // In the order of kArrays; some are not given.
    std::array<std::optional<JointArray>, 7> arrays = {};
    // In the order of kRoots; some are not given.
    std::array<std::optional<Strided>, 6> roots = {};

    explicit Pose(Session& session);
    Pose(const Pose&) = delete;  // its view points to its arrays

    // As the library sees it: members beyond its size are left out.
    swivel_pose seen() const;
    // named: the groups that are solved.
    bool is_valid(const Session& session, const std::vector<bool>& named) const;
    const std::optional<Strided>& root_position() const { return roots[0]; }
    // Chosen limbs have the pose and the results of their body alone, with the ground that the job sampled, if it did.
    // All other bytes are as they were.
    void check(Session& session, const SomeLimbs& chosen, const swivel_job& like);
    // The same where it is not known which limbs were chosen: those that might be may have changed.
    void check_others(const Session& session);

private:
    // One body's, in memory of its own.
    swivel_pose of_body(std::uint32_t body, std::array<std::vector<char>, 7>& memory) const;
    // Calls take(array, joint) for each value of a body that a solve of a group may write.
    template <class Take>
    void for_each_written(const Session& session, std::uint32_t group, const Take& take);
    void check_body(Session& session, const SomeLimbs& chosen, std::uint32_t body, const swivel_job& like);
    void check_all() const;
};

}  // namespace swivel::fuzz
