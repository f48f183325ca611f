// SPDX-License-Identifier: MIT
//
// The targets of a table, handed out frame by frame. Knows what the table must fit: a clip, its limbs, a crowd's size.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/crowd/crowd_plan.h"
#include "tools/formats/targets_csv.h"

namespace swivel::tools {

// What a limb that has rows does in frames without one. Before its first row `hold` and `linear` keep that one, after
// its last one that.
enum class Between {
    clip,    // follows the clip
    hold,    // is as in the row before
    linear,  // goes straight on to the next row, and turns the shortest way; what one of the two rows leaves out is as
             // in the row before
};

class GivenTargets {
public:
    // source: "clip" for none, or a file of targets. Rows of arms are left out where no arm is solved, and so are those
    // of legs. Throws InputError as read_targets_csv() does, and for a table of which no row is left. It also does,
    // naming the line, for frames and characters that do not exist, and for limbs that are not solved or hold a hand.
    GivenTargets(const std::string& source, Between between, std::size_t frame_count, std::span<const Limb> limbs,
                 const CrowdPlan& plan);

    // How many rows were left out.
    std::size_t left_out() const { return left_out_; }

    // How many there are in the first frames together.
    std::uint64_t count(std::size_t frame_count) const;

    // Those of a frame; frames must be asked for in order. They last until the next call.
    std::span<const formats::Target> of_frame(std::size_t frame);

private:
    // The rows of one limb of one character.
    struct Track {
        std::size_t now, end;  // now: the last one that is not after the frame, or the first
    };
    void find_tracks();

    Between between_;
    std::size_t left_out_ = 0;
    std::vector<formats::Target> rows_;  // by track, then frame
    std::vector<Track> tracks_;
    std::vector<formats::Target> targets_;  // of the frame
};

}  // namespace swivel::tools
