// SPDX-License-Identifier: MIT
//
// The crowds of the solver that hold the limbs of many characters. A crowd has one kind of pole, one order of Euler
// angles for each box, one number of twist bones, hands or none, and aims or none: limbs that agree share one, as
// groups. Knows the public interface; no clip.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "tools/crowd/limb_setup.h"

namespace swivel::tools {

class LimbCrowds {
public:
    // Writes what is fixed for all frames. budget_blocks: blocks of 16 limbs that a frame solves; 0: all. Throws
    // InputError, naming file, if there is a budget and the limbs do not share a crowd.
    LimbCrowds(std::span<const LimbSetup> limbs, std::uint32_t characters, std::uint32_t budget_blocks,
               const std::filesystem::path& file);

    bool has(std::size_t limb, swivel_field field) const;
    // Of all characters, as swivel_write() and swivel_read() do; of a field that the limb's crowd has.
    void write(std::size_t limb, swivel_field field, const float* first, std::size_t stride);
    // Inputs of all characters, to the fields that the limb has.
    void write_goals(std::size_t limb, std::span<const goal_input> inputs);
    void read(std::size_t limb, swivel_field field, std::uint32_t first, std::uint32_t count, swivel_out to) const;
    // Puts the normals back that read() gave, as bits: what the next solve starts from.
    void restore_normals(std::size_t limb, std::span<const std::uint32_t> numbers);
    void forward(std::size_t limb, std::uint32_t first, std::uint32_t count, swivel_out elbow, swivel_out wrist,
                 swivel_out hand) const;
    void residuals(std::size_t limb, std::uint32_t first, std::uint32_t count, swivel_out distance) const;
    // Forgets a limb's swivel, where it is carried.
    void reset(std::size_t limb, std::uint32_t character);

    // Solves all limbs; with a budget all in the first call, the most urgent blocks of 16 in each after that.
    void solve();
    // Whether the last solve() solved it.
    bool solved(std::size_t limb, std::uint32_t character) const;

    // Which crowd a limb is in, and as which of its groups.
    struct Place {
        std::size_t crowd = 0;
        std::uint32_t group = 0;
    };
    const Place& place(std::size_t limb) const { return places_[limb]; }
    // What a crowd was made with, beside its groups.
    struct Shape {
        swivel_features features;
        swivel_euler_order shoulder_order, wrist_order;
    };
    std::span<const Shape> shapes() const { return shapes_; }
    // Of each crowd's results; see swivel_digest().
    std::vector<std::uint64_t> digests() const;

private:
    const Crowd& crowd_of(std::size_t limb) const { return crowds_[places_[limb].crowd]; }

    std::vector<Crowd> crowds_;
    std::vector<Shape> shapes_;  // by crowd
    std::vector<Place> places_;  // by limb
    std::uint32_t budget_blocks_;
    std::vector<float> priorities_;      // of the only crowd's groups
    std::vector<float> urgency_;         // of its blocks
    std::vector<std::uint32_t> active_;  // bits of its limbs that were solved; empty: all
    bool began_ = false;
};

}  // namespace swivel::tools
