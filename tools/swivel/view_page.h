// SPDX-License-Identifier: MIT
//
// The page that shows a solved crowd and solves it again (tools/view). Its program is a file beside the command, into
// which the crowd is written. Knows the page's data, but no drawing.
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

// A file that is installed with the command: share/swivel/NAME beside the command's folder, bin.
std::filesystem::path shared_file(const char* name);

class ViewPage {
public:
    // Opens the page to write. Throws CommandError where the page's program is missing or the name is another
    // file's, and InputError as OutputFile does.
    explicit ViewPage(const std::filesystem::path& path);

    // Takes the digest and the given goals of the frame just solved. Frames come in order, from the first.
    void add_frame(const GoalCrowd& crowd, std::span<const GivenPlace> given);

    // Writes the page and makes it appear. Call it once, last. cached: the crowd's motion. skin: its figure's, if any.
    void commit(const CachedCrowd& cached, const GoalCrowd& crowd, const std::optional<PageSkin>& skin = {});

private:
    formats::OutputFile out_;
    std::string program_;
    std::vector<std::uint64_t> digests_;  // by frame
    std::vector<goal_given> given_;
};

}  // namespace swivel::tools
