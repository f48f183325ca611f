// SPDX-License-Identifier: MIT
//
// The limbs that the user asks for by options and crowd files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/limb_name.h"
#include "tools/rig/limb_bind.h"

namespace swivel::tools {

// The place of a user's setting.
struct Source {
    std::string key;               // the option or a file's key, for messages: "--arm", "limb.left_arm.joints"
    std::filesystem::path file{};  // the file with this key; empty for the command line
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

// Reads an option's text: "SHOULDER,ELBOW,WRIST", with or without "left:" or "right:" in front. Accepts any number of
// joints; choose_joints() requires three.
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
    // Whether unnamed limbs are searched for, too.
    bool looks_for(formats::LimbKind kind) const;
};

// The source of the kinds, for a sentence: "--limbs legs", "crowd.limbs = "legs" in line 2 of crowd.toml".
std::string kinds_words(const LimbChoice& choice);

}  // namespace swivel::tools
