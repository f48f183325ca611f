// SPDX-License-Identifier: MIT
//
// A crowd as Python holds it: the library's, what is asked of it often, and who is using it at the moment.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <optional>

#include "swivel/swivel.hpp"
#include "tools/python/arrays.h"

namespace swivel::python {

// How a call uses a crowd. Readers go together, and so do solvers of blocks (of ranges that do not overlap, which is
// for the caller to see to); everything else is alone.
enum class Way { kAlone, kReading, kSolvingBlocks };

struct HeldCrowd {
    Crowd crowd;
    Memory rows;                           // of all groups, which arrays must not share with the library
    std::uint32_t joint_count = 0;         // of its bodies' skeleton; 0: free limbs
    std::array<std::uint32_t, 3> users{};  // by Way; changed with the GIL held
};

// Limbs of one group, as arguments name them: count None is to the end of the group. Checked.
struct Limbs {
    std::uint32_t group, first, count;
};
Limbs limbs_of(const HeldCrowd& held, std::int64_t group, std::int64_t first, std::optional<std::int64_t> count);

// The shape that an array of a field of these limbs must have, and its numbers' type. Refuses fields that their group
// does not have, in the library's words.
Values values_of(const HeldCrowd& held, swivel_field field, const Limbs& limbs);
pybind11::dtype type_of(swivel_field field);

// A number that came from Python as an unsigned one; ValueError that names it if it does not fit.
std::uint32_t count_of(const char* name, std::int64_t number);

// The crowd is in use for as long as this lives; RuntimeError if another thread's use does not allow it. Made and
// destroyed with the GIL held.
class Use {
public:
    Use(HeldCrowd& held, Way way);
    ~Use();
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

private:
    std::uint32_t& count_;
};

// Calls the library with the GIL released.
template <class Call>
auto run(HeldCrowd& held, Way way, Call call)
{
    const Use use(held, way);
    const pybind11::gil_scoped_release released;
    return call();
}

// The methods of the class Crowd, by what they are for.
using CrowdClass = pybind11::class_<HeldCrowd>;
void add_creation(CrowdClass& crowd);
void add_shape(CrowdClass& crowd);    // counts, rows
void add_copies(CrowdClass& crowd);   // write, read
void add_solving(CrowdClass& crowd);  // solve, choose, reset, save
void add_answers(CrowdClass& crowd);  // positions, residuals, angles, arcs

}  // namespace swivel::python
