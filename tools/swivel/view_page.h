// SPDX-License-Identifier: MIT
//
// The page that shows a solved crowd and solves it again (tools/view). Its program is a file beside the command; the
// crowd is written into it. Knows what the page holds; what it draws is the page's affair.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/cache/cached_crowd.h"
#include "tools/crowd/goal_crowd.h"
#include "tools/formats/output_file.h"
#include "tools/swivel/cached_clip.h"

namespace swivel::tools {

// A file that is installed with the command, which stands in bin: share/swivel/NAME beside that folder.
std::filesystem::path shared_file(const char* name);

class ViewPage {
public:
    // Opens the page to write. Throws CommandError where the page's program is missing or the name is another
    // file's, and InputError as OutputFile does.
    explicit ViewPage(const std::filesystem::path& path);

    // Takes a frame just solved: its digest, and the goals that were given. Frames in order, from the first.
    void add_frame(const GoalCrowd& crowd, std::span<const GivenPlace> given);

    // Writes the page and makes it appear; to be called once, last. cached: what the crowd performs. skin: of
    // the figure that performs it, if it has one.
    void commit(const CachedCrowd& cached, const GoalCrowd& crowd, const std::optional<PageSkin>& skin = {});

private:
    // The program: up to the digest's place, around the crowd's, and from the script's end on.
    std::string before_, script_begin_, script_end_, after_;
    formats::OutputFile out_;
    std::vector<std::uint64_t> digests_;  // by frame
    std::vector<goal_given> given_;
};

}  // namespace swivel::tools
