// SPDX-License-Identifier: MIT
//
// Frames of a job, made from bytes, one for each group; and what must be in them after a solve.
#pragma once

#include <vector>

#include "swivel/swivel.h"
#include "tests/fuzz/interface_session.h"
#include "tests/fuzz/strided.h"

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

}  // namespace swivel::fuzz
