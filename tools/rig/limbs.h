// SPDX-License-Identifier: MIT
//
// Finds and binds the limbs of a clip's skeleton that the user asks for. Finding joints needs the skeleton alone;
// binding them needs the clip's frames. Knows clips and the public interface; no file format.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/rig/body_parts.h"
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

// The joints of one limb, or why there are none.
struct LimbFound {
    formats::LimbName name;
    FoundJoints joints;
    bool is_chosen = false;               // to be solved; other limbs only show the figure's front
    const NamedLimb* named_by = nullptr;  // the user, in the choice; null: the file's names
};

// In the order of formats::kLimbNames.
using FigureJoints = std::array<LimbFound, 4>;

// Takes the joints that the user names, else those of joints_by_file(). A joint named for one limb belongs to no other.
// file: of the clip, for messages; clip: its frames are not needed; choice: must outlive the result. Throws InputError
// with the option, or the file and line, for joints that the user named wrongly. Wrong are an unknown or ambiguous
// joint, joints that are not above each other, two limbs of a kind on one side, and a joint in two limbs.
FigureJoints choose_joints(const formats::Clip& clip, const std::filesystem::path& file, const LimbChoice& choice);

// The joints of the limbs that are to be solved, as far as they are known.
std::vector<int> joints_of(const FigureJoints& figure);

// All that are known, chosen or not.
KnownLimbs known_limbs(const FigureJoints& figure);

// The result for one limb: bound, or a problem.
struct LimbFinding {
    formats::LimbName name;
    std::optional<Limb> limb;
    std::string problem, advice;  // see FoundJoints
    bool has_joints = false;      // though they may not bind
    bool is_named = false;        // the user named its joints or gave its bend
};

// The whole line.
std::string problem_text(const LimbFinding& finding);

struct LimbSearch {
    Facing facing;                      // of the figure
    std::vector<BodyPart> body;         // its parts
    std::vector<LimbFinding> findings;  // of the limbs that were chosen, arms first
};

// The parts of the figure's body, with the head that the user names, if any. Throws InputError as choose_joints() does,
// and for a head that is another part.
std::vector<BodyPart> body_of(const formats::Clip& clip, const std::filesystem::path& file, const FigureJoints& figure,
                              const std::optional<NamedJoint>& head);

// The limbs bound, each or with its reason.
LimbSearch bind_limbs(const formats::Clip& clip, const FigureJoints& joints, const LimbChoice& choice);

// The limbs that bind, arms first. Throws InputError if a limb that the user named does not bind, or if none does.
// Other limbs that do not bind are left out.
std::vector<Limb> require_limbs(const LimbSearch& search, const std::filesystem::path& file);

}  // namespace swivel::tools
