// SPDX-License-Identifier: MIT
#include "tools/rig/limbs.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/formats/error.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/rig/limb_words.h"
#include "tools/rig/name_search.h"
#include "tools/rig/name_table.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::InputError;
using formats::LimbKind;
using formats::LimbName;
using formats::Side;

constexpr std::size_t kShownName = 80;  // characters of a joint's name in a message

// An error about a user's setting, at its place.
[[noreturn]] void refuse(const Source& source, const std::filesystem::path& clip, std::string_view cause,
                         std::string_view advice)
{
    if (source.is_file())
        throw InputError(source.file, source.line,
                         fmt::format("{}: {} in {}{}", source.key, cause,
                                     formats::printable(clip.string(), std::string::npos), advice));
    throw InputError(clip, fmt::format("{} ({}){}", cause, source.key, advice));
}

int named_joint(const Clip& clip, const std::filesystem::path& file, const NamedJoint& named)
{
    const std::vector<int> found = formats::find_joints(clip, named.joint);
    const std::string shown = formats::printable(named.joint, kShownName);
    if (found.empty())
        refuse(named.source, file, fmt::format("no joint is called '{}'", shown), "; swivel rig --joints lists them");
    if (found.size() > 1)
        refuse(named.source, file, fmt::format("{} joints are called '{}'", found.size(), shown),
               fmt::format("; name one by its path or number, such as {} or #{}",
                           formats::printable(formats::joint_path(clip, found[0]), formats::kMaxQuoted),
                           formats::joint_at(clip, found[0]).number));
    return found[0];
}

LimbJoints named_joints(const Clip& clip, const std::filesystem::path& file, const LimbWords& words,
                        const NamedLimb& named)
{
    const std::string text = formats::printable(formats::joined(named.joints, ","), formats::kMaxQuoted);
    if (named.joints.size() != 3)
        refuse(named.source, file, fmt::format("'{}' does not name three joints", text),
               fmt::format("; write {}", words.joints));
    LimbJoints joints;
    for (std::size_t n = 0; n < 3; ++n) joints[n] = named_joint(clip, file, {named.joints[n], named.source});
    if (!is_chain(clip, joints))
        refuse(named.source, file, fmt::format("'{}' does not name a joint, one below it and one below that", text),
               fmt::format("; write {}, from the body outwards", words.joints));
    return joints;
}

// Puts the limbs that the user names of one kind in the place of those that were found.
void put_named(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice, LimbKind kind,
               FigureJoints& figure)
{
    const LimbWords& words = words_of(kind);
    Side otherwise = Side::left;
    for (const NamedLimb& named : choice.named(kind)) {
        if (named.source.is_file() && figure[formats::index_of({kind, *named.side})].named_by)
            continue;  // options override it
        const LimbJoints at = named_joints(clip, file, words, named);
        const Side side = named.side ? *named.side : side_of(joint_at(clip, at[0]).name, otherwise);
        LimbFound& limb = figure[formats::index_of({kind, side})];
        if (limb.named_by)
            throw InputError(file, fmt::format("two {} are taken as {}; write {} left:... and {} right:...",
                                               words.limbs, side_name(side), words.option, words.option));
        limb = {limb.name, {at, named.source.key, {}, {}}, true, &named};
        otherwise = Side::right;
    }
}

// Resolves joints in two limbs. A limb that the user named keeps the joint; two named limbs are refused, and two found
// ones are both dropped.
void keep_apart(const Clip& clip, const std::filesystem::path& file, FigureJoints& figure)
{
    const FigureJoints found = figure;
    for (const LimbFound& other : found)
        for (LimbFound& limb : figure) {
            if (limb.name == other.name || !limb.joints.joints || !other.joints.joints) continue;
            const int joint = shared_joint(*other.joints.joints, *limb.joints.joints);
            if (joint < 0 || (limb.named_by && !other.named_by)) continue;
            const std::string name = printable_name(joint_at(clip, joint));
            if (limb.named_by)
                refuse(limb.named_by->source, file,
                       fmt::format("the {} and the {} share the joint '{}'", plain_name(other.name),
                                   plain_name(limb.name), name),
                       "; each needs three of its own");
            limb.joints = no_joints(fmt::format("'{}' is {} for the {}{}", name, other.named_by ? "named" : "found",
                                                plain_name(other.name), other.named_by ? "" : ", too"));
        }
}

// The joints of a limb; throws CannotBind if there are none.
LimbJoints require_joints(const Clip& clip, const FoundJoints& found)
{
    if (found.joints) return *found.joints;
    if (!found.problem.empty()) throw CannotBind(found.problem, found.advice);
    std::vector<int> depth(clip.joints.size(), 0);
    int deepest = 0;
    for (std::size_t n = 0; n < depth.size(); ++n) {
        const int parent = clip.joints[n].parent;
        depth[n] = (parent < 0 ? 0 : depth[static_cast<std::size_t>(parent)]) + clip.joints[n].is_bone;
        deepest = std::max(deepest, depth[n]);
    }
    if (deepest >= 3) throw CannotBind("no joints have names in use for such a limb", "");
    throw CannotBind(
        fmt::format("a limb takes three bones below each other, and this skeleton has at most {}", deepest),
        "choose a figure's file");
}

LimbFinding finding_of(const Clip& clip, const LimbChoice& choice, const Facing& facing, const LimbFound& found)
{
    const auto is_of_limb = [&](const GivenBend& bend) { return bend.limb == found.name; };
    const bool is_named = found.named_by || std::any_of(choice.bends.begin(), choice.bends.end(), is_of_limb);
    LimbFinding finding{found.name, {}, {}, {}, found.joints.joints.has_value(), is_named};
    try {
        finding.limb = bind_limb(clip, found.name, require_joints(clip, found.joints), facing, choice.bends);
        finding.limb->from = found.joints.from;
    } catch (const CannotBind& fault) {
        finding.problem = fault.what();
        finding.advice = fault.advice;
    }
    return finding;
}

}  // namespace

NamedLimb limb_of_option(std::string_view text, std::string_view option)
{
    NamedLimb limb{{}, std::nullopt, {std::string(option)}};
    for (const formats::Side side : {formats::Side::left, formats::Side::right}) {
        const std::string prefix = fmt::format("{}:", side_name(side));
        if (!text.starts_with(prefix)) continue;
        limb.side = side;
        text.remove_prefix(prefix.size());
    }
    for (std::size_t comma; (comma = text.find(',')) != std::string_view::npos; text.remove_prefix(comma + 1))
        limb.joints.emplace_back(text.substr(0, comma));
    limb.joints.emplace_back(text);
    return limb;
}

bool LimbChoice::looks_for(formats::LimbKind kind) const
{
    if (!kinds.empty()) return kinds == "all" || kinds == words_of(kind).limbs;
    return kind == formats::LimbKind::arm && arms.empty() && legs.empty();
}

std::string kinds_words(const LimbChoice& choice)
{
    const Source& source = choice.kinds_source;
    if (!source.is_file()) return fmt::format("{} {}", source.key, choice.kinds);
    return fmt::format("{} = \"{}\" in line {} of {}", source.key, choice.kinds, source.line,
                       formats::printable(source.file.string(), std::string::npos));
}

std::string problem_text(const LimbFinding& finding)
{
    return finding.advice.empty() ? finding.problem : fmt::format("{}; {}", finding.problem, finding.advice);
}

FigureJoints choose_joints(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice)
{
    std::array<FoundJoints, 4> found = joints_by_file(clip);
    FigureJoints figure;
    for (std::size_t n = 0; n < figure.size(); ++n) {
        const LimbName name = formats::kLimbNames[n];
        figure[n] = {name, std::move(found[n]), choice.looks_for(name.kind), nullptr};
    }
    for (const LimbKind kind : {LimbKind::arm, LimbKind::leg}) put_named(clip, file, choice, kind, figure);
    keep_apart(clip, file, figure);
    return figure;
}

std::vector<int> joints_of(const FigureJoints& figure)
{
    std::vector<int> joints;
    for (const LimbFound& limb : figure)
        if (limb.is_chosen && limb.joints.joints)
            joints.insert(joints.end(), limb.joints.joints->begin(), limb.joints.joints->end());
    return joints;
}

KnownLimbs known_limbs(const FigureJoints& figure)
{
    KnownLimbs known;
    std::ranges::transform(figure, known.begin(), [](const LimbFound& limb) { return limb.joints.joints; });
    return known;
}

std::vector<BodyPart> body_of(const Clip& clip, const std::filesystem::path& file, const FigureJoints& figure,
                              const std::optional<NamedJoint>& head)
{
    const KnownLimbs known = known_limbs(figure);
    if (!head) return body_parts(clip, known);
    const int joint = named_joint(clip, file, *head);
    std::vector<BodyPart> body = body_parts(clip, known, joint);
    for (const BodyPart& part : body)
        if (part.name != "head" && std::ranges::count(part.joints, joint) > 0)
            refuse(head->source, file,
                   fmt::format("'{}' is the figure's {}", printable_name(joint_at(clip, joint)), part.name),
                   "; name its head");
    return body;
}

LimbSearch bind_limbs(const Clip& clip, const FigureJoints& joints, const LimbChoice& choice)
{
    const KnownLimbs known = known_limbs(joints);
    LimbSearch search{facing_of(clip, known), body_parts(clip, known), {}};
    for (const LimbFound& limb : joints)
        if (limb.is_chosen) search.findings.push_back(finding_of(clip, choice, search.facing, limb));
    return search;
}

std::vector<Limb> require_limbs(const LimbSearch& search, const std::filesystem::path& file)
{
    std::vector<Limb> limbs;
    for (const LimbFinding& finding : search.findings) {
        if (finding.limb) limbs.push_back(*finding.limb);
        if (finding.is_named && !finding.limb)
            throw InputError(
                file, fmt::format("the {} cannot be bound: {}", plain_name(finding.name), problem_text(finding)));
    }
    if (!limbs.empty()) return limbs;
    const LimbFinding& first = search.findings.front();
    const LimbWords& words = words_of(first.name.kind);
    throw InputError(
        file,
        fmt::format("no limb binds: the {}: {}{}", plain_name(first.name), problem_text(first),
                    first.advice.empty() ? fmt::format("; name joints with {} {}", words.option, words.joints) : ""));
}

}  // namespace swivel::tools
