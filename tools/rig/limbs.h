// SPDX-License-Identifier: MIT
//
// The limbs of a clip's skeleton: found by joint names or named by the user, and bound for the solver. Knows clips and
// the public interface; no file format.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/rig/limb_bind.h"

namespace swivel::tools {

// Where the user said something.
struct Source {
    std::string key;               // the option or a file's key, for messages: "--arm", "limb.left_arm.joints"
    std::filesystem::path file{};  // that has this key; empty for the command line
    std::size_t line = 0;          // of it

    bool is_file() const { return line > 0; }
};

// A limb named by the user.
struct NamedLimb {
    std::vector<std::string> joints;    // shoulder, elbow and wrist, or hip, knee and ankle, by name, path or number
    std::optional<formats::Side> side;  // nothing: the names tell it, else the first is left; a file always says it
    Source source;
};

// What an option says: "SHOULDER,ELBOW,WRIST", with "left:" or "right:" in front or without. Any number of joints is
// taken here; look_for_limbs() wants three.
NamedLimb limb_of_option(std::string_view text, std::string_view option);

// Which limbs to solve. Options name at most two of each kind.
struct LimbChoice {
    std::string kinds;    // arms, legs or all: of these a side that is not named is looked for by the names in use;
                          // empty: those named alone, or the arms by the names in use if none is
    Source kinds_source;  // where kinds was given
    std::vector<NamedLimb> arms, legs;  // a file's after the options', and each only for a side that no option names
    std::vector<GivenBend> bends;
};

// Where the kinds were chosen, within a sentence: "--limbs legs", "crowd.limbs = "legs" in line 2 of crowd.toml".
std::string kinds_words(const LimbChoice& choice);

// What became of one limb: bound, or why not.
struct LimbFinding {
    formats::LimbName name;
    std::optional<Limb> limb;
    std::string problem;     // one line; also without any joint that fits
    std::string advice;      // what to do about it, to follow after a semicolon; empty: name joints
    bool has_names = false;  // joints fit, by habit or by the user, though they do not bind
    bool is_half = false;  // some joints have a limb's names, and are no limb of this figure: one is missing, its name
                           // repeats, the user named it for another limb, or it is another figure's
};

// The whole line.
std::string problem_text(const LimbFinding& finding);

struct LimbSearch {
    Front front;  // of the figure
    std::vector<LimbFinding> findings;
};

// All limbs of the kinds chosen, arms first, each bound or with its reason. Throws InputError, naming the file (and the
// line, where a file named the joints), for what the user named wrongly: an unknown or ambiguous joint, joints that are
// not above each other, two limbs of a kind on one side, a joint in two limbs that are named. choice: names of no kind
// that kinds leaves out.
LimbSearch look_for_limbs(const formats::Clip& clip, const std::filesystem::path& file, const LimbChoice& choice);

// The limbs to solve, and those of the same kinds that the skeleton has no names of.
struct FoundLimbs {
    std::vector<Limb> limbs;           // arms first
    std::vector<LimbFinding> missing;  // each with its reason
    std::string doubt;                 // Front::doubt; those that are bound do not hang on it
};

// The limbs that bind. Throws as look_for_limbs() does, for a kind of which no limb has names in use, and for a limb
// that has names, some or all, and cannot be bound: it is never left out in silence.
FoundLimbs find_limbs(const formats::Clip& clip, const std::filesystem::path& file, const LimbChoice& choice);

}  // namespace swivel::tools
