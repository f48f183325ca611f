#pragma once
// SPDX-License-Identifier: MIT
// What swivel.h promises of results, whatever the inputs were.

#include "tests/fuzz/interface_session.h"

namespace swivel::fuzz {

// A copy of a group's result rows, of floats or words.
std::vector<char> result_bytes(swivel_crowd& crowd, std::uint32_t group);

// Of a solved limb: unit quaternions on their side, known flags, finite places.
void check_results(const Session& session, std::uint32_t group, std::uint32_t limb);

// Limbs whose lanes are not chosen have the bits of session.results_before.
void check_others(Session& session, const std::vector<bool>& chosen);

}  // namespace swivel::fuzz
