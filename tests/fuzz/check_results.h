#pragma once
// SPDX-License-Identifier: MIT
// What swivel.h promises of results, whatever the inputs were.

#include "tests/fuzz/interface_session.h"

namespace swivel::fuzz {

// Of a solved limb: unit quaternions on their side, known flags, finite places.
void check_results(const Session& session, std::uint32_t group, std::uint32_t limb);

// A solved limb has the bits of the same limb alone in a crowd, without a job, on the scalar build.
void check_alone(Session& session, std::uint32_t group, std::uint32_t limb);
// Its parts: the limb as it was before the call becomes limb 0 of a group there, which is solved, and is equal.
void copy_limb(const Session& session, std::uint32_t group, std::uint32_t limb, swivel_crowd* alone, std::uint32_t to);
void solve_scalar(swivel_crowd* alone, const swivel_job* job);
void check_equal(const Session& session, std::uint32_t group, std::uint32_t limb, swivel_crowd* alone, std::uint32_t to,
                 swivel_field except = SWIVEL_RESULT_END);

// A job for probes alone changed no other result.
void check_probes(const Session& session, const SomeLimbs& chosen);
// Inputs and results of limbs that are not chosen, and whole blocks without such a limb, have the bits that they
// had before the call.
void check_others(const Session& session, const SomeLimbs& chosen);

}  // namespace swivel::fuzz
