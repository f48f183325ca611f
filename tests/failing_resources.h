// SPDX-License-Identifier: MIT
//
// Makes a process run out of something on purpose. The program is linked with failing_resources.cpp, which replaces the
// functions that give memory and threads.
#pragma once

#include <cstdint>

namespace swivel::test {

enum class Resource { allocation, mapping, thread, allocation_elsewhere };

// From now on this fails, until stop_failing():
// - of allocations and mappings the nth request of the calling thread, counted from 1. With later_too, all later ones
//   fail as well.
// - every start of a thread, on any thread, while nth - 1 of those that were started from now on are still there.
// - of allocations elsewhere, on another thread, the first one, which waits until this word changes.
void let_fail(Resource resource, std::uint32_t nth, bool later_too, const volatile float* word);
// From now on oneTBB does not find Debian's library that gives it memory, and takes all from malloc and its relatives.
void hide_own_memory();
// Returns how many requests have failed.
std::uint32_t stop_failing();

}  // namespace swivel::test
