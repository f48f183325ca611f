// SPDX-License-Identifier: MIT
//
// The report of a solve as an HTML file: what --json says but for each character, as tables; flags and errors frame by
// frame; the worst limbs, with links into the page that shows them.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/crowd/clip_crowd.h"
#include "tools/crowd/statistics.h"
#include "tools/report/html.h"

namespace swivel::tools {

class SolveHtml {
public:
    // Opens the file. page: the one that shows the crowd; empty: none. title: for people.
    SolveHtml(const std::filesystem::path& path, const std::filesystem::path& page, const std::string& title);

    // Takes a frame that was just solved, whose statistics these are. Frames in order. Memory grows with frames.
    void add_frame(const Statistics& of_frame, const ClipCrowd& crowd);

    // Writes all and makes the file appear. run: what --json prints of the whole run. To be called once, last.
    void commit(const nlohmann::ordered_json& run);

private:
    struct Frame {
        double reached_worst = 0, reached_rms = 0, missed_worst = 0;
        std::uint64_t limb_count = 0;
        std::array<std::uint64_t, 32> flags{};
    };
    struct Why {
        std::uint32_t flags;
        std::string sentence;
    };
    void keep_worst(const WorstLimbs& of_frame, const ClipCrowd& crowd);
    Cell place_of(const PoseName& pose) const;
    void put_limbs(const nlohmann::ordered_json& run);
    void put_notes(const nlohmann::ordered_json& limb, const char* kind);
    void put_missing(const nlohmann::ordered_json& run);
    void put_errors(const nlohmann::ordered_json& run);
    void put_flags(const nlohmann::ordered_json& run);
    void put_worst();
    Plot flags_over_time() const;
    Plot errors_over_time() const;

    std::filesystem::path path_, page_;
    Report report_;
    std::vector<Frame> frames_;
    WorstLimbs worst_;
    std::map<PoseName, Why> why_;  // of these
};

}  // namespace swivel::tools
