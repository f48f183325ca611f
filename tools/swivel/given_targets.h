// SPDX-License-Identifier: MIT
//
// The targets of a table, handed out frame by frame. Knows what the table must fit: a clip, its limbs, a crowd's size.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tools/formats/targets_csv.h"
#include "tools/swivel/limbs.h"

namespace swivel::tools {

class GivenTargets {
public:
    // source: "clip" for none, or a file of targets. Throws InputError, naming the line, for frames, characters and
    // limbs that do not exist or are not solved, and as read_targets_csv() does.
    GivenTargets(const std::string& source, const formats::Clip& clip, std::span<const Limb> limbs,
                 std::uint32_t characters);

    // Those of a frame; frames must be asked for in order.
    std::span<const formats::Target> of_frame(std::size_t frame);

private:
    std::vector<formats::Target> targets_;  // sorted by frame
    std::size_t next_ = 0;
};

}  // namespace swivel::tools
