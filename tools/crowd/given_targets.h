// SPDX-License-Identifier: MIT
//
// The targets of a table, frame by frame. Checks the table against a clip, its limbs and a crowd's size.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/crowd/crowd_plan.h"
#include "tools/formats/targets_csv.h"

namespace swivel::tools {

// A limb's goal in frames without a row, if it has other rows. `hold` and `linear` use the first row before it, and the
// last one after it.
enum class Between {
    clip,    // follow the clip
    hold,    // keep the row before
    linear,  // go straight to the next row, and turn the shortest way; parts that one of the two rows lacks are as in
             // the row before
};

class GivenTargets {
public:
    // source: "clip" for none, or a file of targets. Rows of arms are left out where no arm is solved, and so are those
    // of legs. Throws InputError as read_targets_csv() does, and for a table of which no row is left. It also does,
    // naming the line, for frames and characters that do not exist, and for limbs that are not solved or hold a hand.
    GivenTargets(const std::string& source, Between between, std::size_t frame_count, std::span<const Limb> limbs,
                 const CrowdPlan& plan);

    // The number of rows left out.
    std::size_t left_out() const { return left_out_; }

    // The number of targets in the first frames together.
    std::uint64_t count(std::size_t frame_count) const;

    // The targets of a frame, valid until the next call. Ask for frames in order.
    std::span<const formats::Target> of_frame(std::size_t frame);

private:
    // The rows of one limb of one character.
    struct Track {
        std::size_t now, end;  // now: the last row up to the frame, or the first row
    };
    void find_tracks();

    Between between_;
    std::size_t left_out_ = 0;
    std::vector<formats::Target> rows_;  // by track, then frame
    std::vector<Track> tracks_;
    std::vector<formats::Target> targets_;  // of the frame
};

}  // namespace swivel::tools
