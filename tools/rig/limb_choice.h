// SPDX-License-Identifier: MIT
//
// Which limbs the user asks for, and what is said of them by options and crowd files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/limb_name.h"
#include "tools/rig/limb_bind.h"

namespace swivel::tools {

// Where the user said something.
struct Source {
    std::string key;               // the option or a file's key, for messages: "--arm", "limb.left_arm.joints"
    std::filesystem::path file{};  // that has this key; empty for the command line
    std::size_t line = 0;          // of it

    bool is_file() const { return line > 0; }
};

// A joint named by the user.
struct NamedJoint {
    std::string joint;  // by name, path or number
    Source source;
};

// A limb named by the user.
struct NamedLimb {
    std::vector<std::string> joints;    // shoulder, elbow and wrist, or hip, knee and ankle, by name, path or number
    std::optional<formats::Side> side;  // nothing: the names tell it, else the first is left; a file always says it
    Source source;
};

// Reads an option's text: "SHOULDER,ELBOW,WRIST", with "left:" or "right:" in front or without. Any number of joints is
// taken here; choose_joints() wants three.
NamedLimb limb_of_option(std::string_view text, std::string_view option);

// Which limbs to solve.
struct LimbChoice {
    std::string kinds;  // arms, legs or all: of these a side that is not named is looked for; empty: those named alone,
                        // or the arms if none is
    Source kinds_source;                // where kinds was given
    std::vector<NamedLimb> arms, legs;  // a file's after the options', and each only for a side that no option names
    std::vector<GivenBend> bends;

    const std::vector<NamedLimb>& named(formats::LimbKind kind) const
    {
        return kind == formats::LimbKind::arm ? arms : legs;
    }
    // Whether limbs that are not named are looked for, too.
    bool looks_for(formats::LimbKind kind) const;
};

// Where the kinds were chosen, within a sentence: "--limbs legs", "crowd.limbs = "legs" in line 2 of crowd.toml".
std::string kinds_words(const LimbChoice& choice);

}  // namespace swivel::tools
