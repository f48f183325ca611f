#pragma once
// SPDX-License-Identifier: MIT
// One crowd and what the fuzzer of the C interface knows of it. Each call here takes its arguments from the bytes,
// sound or not, knows whether it must succeed, and checks what it did. A job's frames and poses know what must be in
// them after a solve.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "swivel/swivel_bodies.h"
#include "tests/fuzz/caller_arrays.h"
#include "tests/fuzz/crowd_of_bytes.h"

namespace swivel::fuzz {

// Limbs of each group.
using SomeLimbs = std::vector<std::vector<bool>>;

struct Session {
    Bytes& bytes;
    swivel_crowd* crowd = nullptr;
    std::uint32_t group_count = 0;
    std::span<const char> arena = {};     // all of the crowd's memory
    std::vector<char> arena_before = {};  // as it was before the call at hand
    SomeLimbs is_solved = {};
    SomeLimbs is_overwritten = {};  // with any bits in what they carry, so nothing is said of their results
    std::span<const swivel_limb_def> limb_defs = {};  // of groups of free limbs
    std::vector<swivel_crowd*> alone = {};            // for one limb of each group; of bodies the first is for one body
    bool has_workspace = true;
    BodyDef* bodies = nullptr;  // null: free limbs

    // The lanes that jobs choose; those of bodies are bodies.
    std::uint32_t lane_count() const { return swivel_block_count(crowd) * SWIVEL_LANES; }
    SomeLimbs limbs_that(bool are) const;  // all limbs or none
    // The bytes that were there before the call at hand.
    const char* before(const float* now) const
    {
        return arena_before.data() + (reinterpret_cast<const char*>(now) - arena.data());
    }
};

// Some limbs of one group, there or not.
struct Limbs {
    std::uint32_t group = 0, first = 0, count = 0;
    bool is_valid = true;
};
Limbs take_limbs(Session& session);

// Floats, or the one word, of a field's value as callers have it; 0: the group has no such field, or does not exist.
std::uint32_t component_count(const Session& session, std::uint32_t group, swivel_field field);
// Whether a group is of a kind, and whether it was asked for any of these features.
bool is_of(const Session& session, std::uint32_t group, swivel_kind kind);
bool has_features(const Session& session, std::uint32_t group, swivel_features features);
// Whether it has limbs, of either kind.
bool has_limbs(const Session& session, std::uint32_t group);
// Whether it is known where limbs are: of free ones, and of bodies that keep it.
bool is_known(const Session& session, std::uint32_t group);
// Whether a limb has bad input, and whether it then keeps its results.
bool is_bad(const Session& session, std::uint32_t group, std::uint32_t limb);
bool is_kept(const Session& session, std::uint32_t group, std::uint32_t limb);

// Whether a limb carries any bits; of bodies any limb of its body.
bool is_overwritten(const Session& session, std::uint32_t group, std::uint32_t limb);
// Whether a field may be given in doubles, and what becomes of it.
bool is_position(swivel_field field);
bool is_carried(swivel_field field);
// Whether a group has a direction in the field, so that no origin is subtracted from it.
bool is_direction(const Session& session, std::uint32_t group, swivel_field field);

// A call was to succeed or not, and did so; if not, it has changed nothing.
void check_status(const Session& session, swivel_status status, bool expected);
// Chosen limbs were solved, results of all others are the bits they were.
void check_solved(Session& session, const SomeLimbs& chosen);

// ---- what the headers promise of results, whatever the inputs were: check_results.cpp

// A solved limb has unit quaternions on their side, known flags, finite places.
void check_results(const Session& session, std::uint32_t group, std::uint32_t limb);

// A solved limb has the bits of the same limb alone in a crowd, without a job, on the scalar build.
void check_alone(Session& session, std::uint32_t group, std::uint32_t limb);
// The same in steps: the limb as it was before the call becomes limb 0 of a group there, which is solved, and is equal.
void copy_limb(const Session& session, std::uint32_t group, std::uint32_t limb, swivel_crowd* alone, std::uint32_t to);
void solve_scalar(swivel_crowd* alone, const swivel_job* job);
void check_equal(const Session& session, std::uint32_t group, std::uint32_t limb, swivel_crowd* alone, std::uint32_t to,
                 swivel_field except = SWIVEL_RESULT_END);

// Inputs and results of limbs that are not chosen, and whole blocks without such a limb, have the bits that they
// had before the call.
void check_others(const Session& session, const SomeLimbs& chosen);

// ---- parts of a job: a frame for each group, and the poses of bodies in all forms and at any distances:
// interface_frame.cpp, interface_bodies.cpp

// One group's frame and the arrays that it points to.
struct JobStreams {
    swivel_in origin = {};
    const Strided* root;
    std::vector<swivel_stream> fields = {};
    std::vector<Strided> inputs = {}, outputs = {};
    std::vector<swivel_field> input_fields = {}, output_fields = {};
    bool is_valid = true;

    // root: where bodies' roots are, in doubles; null for others.
    JobStreams(Session& session, std::uint32_t group, const Strided* root);
    swivel_streams view() const;  // of this, which must outlive it

    // Inputs of chosen limbs are in the crowd's rows, and results are the crowd's. Values of others, and all of them if
    // nothing is chosen, are as they were. asks: the job asks for ground, so that in the rows may be another.
    void check(const Session& session, std::uint32_t group, const std::vector<bool>& chosen, bool asks) const;

private:
    double from(const Session& session, std::uint32_t group, swivel_field field, std::uint32_t limb,
                std::size_t c) const;
    void check_inputs(const Session& session, std::uint32_t group, std::uint32_t limb, bool asks) const;
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
    std::array<std::optional<Strided>, 7> roots = {};

    explicit Pose(Session& session);
    Pose(const Pose&) = delete;  // its view points to its arrays

    // As the library sees it: members beyond its size are left out.
    swivel_pose seen() const;
    // named: the groups that are solved.
    bool is_valid(const Session& session, const std::vector<bool>& named) const;
    const std::optional<Strided>& root_position() const { return roots[0]; }
    // Chosen limbs have the pose and the results of their body alone, with the ground that the job asked for, if it
    // did. All other bytes are as they were.
    void check(Session& session, const SomeLimbs& chosen, bool asks);

private:
    // One body's, in memory of its own.
    swivel_pose of_body(std::uint32_t body, std::array<std::vector<char>, 7>& memory) const;
    // Calls take(array, joint) for each value of a body that a solve of a group may write.
    template <class Take>
    void for_each_written(const Session& session, std::uint32_t group, const Take& take);
    void check_body(Session& session, const SomeLimbs& chosen, std::uint32_t body, bool asks);
    void check_all() const;
};

// ---- the calls: interface_solves.cpp, interface_calls.cpp
void call_write(Session& session);
void call_write_doubles(Session& session);
void call_read(Session& session);
void call_solve(Session& session);
void call_choose(Session& session);
void call_reset(Session& session);
void call_change_support(Session& session);  // by call_reset(), of bodies
void call_allowed_arcs(Session& session);
void call_joint_angles(Session& session);
void call_forward(Session& session);
void call_residuals(Session& session);
void call_pack(Session& session);
// Those that need no crowd.
void call_helper(Session& session);

}  // namespace swivel::fuzz
