#pragma once
// SPDX-License-Identifier: MIT
// Parts of a job, made from bytes: a frame for each group, and the poses of bodies in all forms and at any distances.
// They know what must be in them after a solve.

#include <array>
#include <optional>
#include <vector>

#include "swivel/swivel.h"
#include "tests/fuzz/caller_arrays.h"
#include "tests/fuzz/interface_session.h"

namespace swivel::fuzz {

// How a job has the ground sampled.
enum class Sampling : std::uint8_t { none, asks, probes_only };

// One group's frame and the arrays that it points to.
struct Frame {
    swivel_in origin = {};
    const Strided* root;
    std::vector<swivel_frame_field> fields = {};
    std::vector<Strided> inputs = {}, outputs = {};
    std::vector<swivel_field> input_fields = {}, output_fields = {};
    bool is_valid = true;

    // root: where bodies' roots are, in doubles; null for others.
    Frame(Session& session, std::uint32_t group, const Strided* root);
    swivel_frame view() const;  // of this, which must outlive it

    // Inputs of chosen limbs are in the crowd's rows, and results are the crowd's. Values of others, and all of them if
    // nothing is chosen, are as they were.
    void check(const Session& session, std::uint32_t group, const std::vector<bool>& chosen,
               Sampling sampling = Sampling::none) const;

private:
    double from(const Session& session, std::uint32_t group, swivel_field field, std::uint32_t limb,
                std::size_t c) const;
    void check_inputs(const Session& session, std::uint32_t group, std::uint32_t limb, Sampling sampling) const;
    void take_origin(Session& session, std::uint32_t limb_count);
    void take_input(Session& session, std::uint32_t group, swivel_field field);
    void take_output(Session& session, std::uint32_t group, swivel_field field);
    void add(const Session& session, std::uint32_t group, swivel_field field, const Strided& values);
};

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
