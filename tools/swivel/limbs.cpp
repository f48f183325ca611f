// SPDX-License-Identifier: MIT
#include "tools/swivel/limbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "tools/formats/error.h"
#include "tools/formats/text.h"
#include "tools/swivel/limb_words.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::InputError;
using formats::LimbKind;
using formats::LimbName;
using formats::Side;

constexpr std::size_t kShownName = 80;  // bytes of a joint's name in a message

// A limb's joints on their way to be bound.
struct Candidate {
    LimbName name;
    LimbByName found;
    bool beside_named = false;  // looked for by names, the other side was named by the user
};

// Reads one limb that the user named.
struct NameReader {
    const Clip& clip;
    const std::filesystem::path& file;  // the clip's
    const LimbWords& words;
    const NamedLimb& from;

    [[noreturn]] void refuse(std::string_view cause, std::string_view advice) const
    {
        if (from.line == 0) throw InputError(file, fmt::format("{} ({}){}", cause, from.option, advice));
        throw InputError(
            from.file, from.line,
            fmt::format("{}: {} in {}{}", from.option, cause, formats::printable(file.string(), 400), advice));
    }

    int joint(const std::string& name) const
    {
        const std::vector<int> found = formats::find_joints(clip, name);
        const std::string shown = formats::printable(name, kShownName);
        if (found.empty()) refuse(fmt::format("no joint is called '{}'", shown), "; swivel rig --joints lists them");
        if (found.size() > 1)
            refuse(fmt::format("{} joints are called '{}'", found.size(), shown),
                   fmt::format("; name one by its path or number, such as {} or #{}",
                               formats::printable(formats::joint_path(clip, found[0]), 400),
                               formats::joint_at(clip, found[0]).number));
        return found[0];
    }

    Candidate limb(LimbKind kind, Side otherwise) const
    {
        const std::string text = formats::printable(fmt::format("{}", fmt::join(from.joints, ",")), 400);
        if (from.joints.size() != 3)
            refuse(fmt::format("'{}' does not name three joints", text), fmt::format("; write {}", words.joints));
        const LimbJoints joints{joint(from.joints[0]), joint(from.joints[1]), joint(from.joints[2])};
        if (!is_chain(clip, joints))
            refuse(fmt::format("'{}' does not name a joint, one below it and one below that", text), "");
        const std::string_view speaks = formats::joint_at(clip, joints[0]).name;
        return {{kind, from.side ? *from.side : side_of(speaks, otherwise)}, {joints, from.option, {}}, false};
    }
};

const std::vector<NamedLimb>& names_of(const LimbChoice& choice, LimbKind kind)
{
    return kind == LimbKind::arm ? choice.arms : choice.legs;
}

bool is_chosen(const LimbChoice& choice, LimbKind kind)
{
    if (!choice.kinds.empty()) return choice.kinds == "all" || choice.kinds == words_of(kind).limbs;
    if (choice.arms.empty() && choice.legs.empty()) return kind == LimbKind::arm;
    return !names_of(choice, kind).empty();
}

// The limbs of one kind: those named; a side that is not, by habit, where the kind was asked for or none is named.
std::vector<Candidate> candidates(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice,
                                  LimbKind kind)
{
    const LimbWords& words = words_of(kind);
    const std::vector<NamedLimb>& names = names_of(choice, kind);
    std::vector<Candidate> limbs;
    for (const NamedLimb& named : names)
        limbs.push_back(NameReader{clip, file, words, named}.limb(kind, limbs.empty() ? Side::left : Side::right));
    if (limbs.size() > 2)
        throw InputError(
            file, fmt::format("{} was given more than twice; a character has two {}", words.option, words.limbs));
    if (limbs.size() == 2 && limbs[0].name == limbs[1].name)
        throw InputError(file, fmt::format("both {} are taken as {}; write {} left:... and {} right:...", words.limbs,
                                           side_name(limbs[0].name.side), words.option, words.option));
    if (!names.empty() && choice.kinds.empty()) return limbs;
    for (const LimbName name : {LimbName{kind, Side::left}, LimbName{kind, Side::right}}) {
        const auto is_this = [&](const Candidate& limb) { return limb.name == name; };
        if (std::none_of(limbs.begin(), limbs.end(), is_this))
            limbs.insert(name.side == Side::left ? limbs.begin() : limbs.end(),
                         {name, limb_by_name(clip, name), !names.empty()});
    }
    return limbs;
}

bool share_a_joint(const LimbJoints& a, const LimbJoints& b)
{
    return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
}

void require_apart(const std::filesystem::path& file, std::span<const Candidate> limbs)
{
    for (std::size_t a = 0; a < limbs.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (limbs[a].found.joints && limbs[b].found.joints &&
                share_a_joint(*limbs[a].found.joints, *limbs[b].found.joints))
                throw InputError(file, fmt::format("the {} and the {} share a joint; each needs three of its own ({})",
                                                   plain_name(limbs[b].name), plain_name(limbs[a].name),
                                                   words_of(limbs[a].name.kind).option));
}

// Of every limb that is known, solved or not.
Front front_of(const Clip& clip, std::span<const Candidate> limbs)
{
    std::array<std::optional<LimbJoints>, 4> joints;
    for (std::size_t n = 0; n < joints.size(); ++n) {
        joints[n] = limb_by_name(clip, formats::kLimbNames[n]).joints;
        for (const Candidate& limb : limbs)
            if (limb.name == formats::kLimbNames[n]) joints[n] = limb.found.joints;
    }
    return figure_front(clip, joints);
}

// Why no joint's name is known.
std::string why_none_fits(const Clip& clip)
{
    std::vector<int> depth(clip.joints.size(), 0);
    int deepest = 0;
    for (std::size_t n = 0; n < depth.size(); ++n) {
        const int parent = clip.joints[n].parent;
        depth[n] = (parent < 0 ? 0 : depth[static_cast<std::size_t>(parent)]) + clip.joints[n].is_bone;
        deepest = std::max(deepest, depth[n]);
    }
    if (deepest < 3)
        return fmt::format("a limb takes three bones below each other, and this skeleton has at most {}", deepest);
    return "no joints have names in use for it";
}

LimbFinding finding_of(const Clip& clip, const LimbChoice& choice, const Front& front, const Candidate& candidate)
{
    LimbFinding finding{candidate.name, std::nullopt, candidate.found.problem, candidate.found.joints.has_value()};
    if (!finding.has_names) {
        finding.is_half = !finding.problem.empty() && !candidate.beside_named;
        if (finding.problem.empty()) finding.problem = why_none_fits(clip);
        return finding;
    }
    try {
        finding.limb = bind_limb(clip, candidate.name, *candidate.found.joints, front, choice.hinges);
        finding.limb->habit = candidate.found.habit;
    } catch (const CannotBind& fault) {
        finding.problem = fault.what();
    }
    return finding;
}

// No limb of the finding's kind has names in use.
[[noreturn]] void refuse_kind(const std::filesystem::path& file, const LimbChoice& choice, const LimbFinding& finding)
{
    const LimbWords& words = words_of(finding.name.kind);
    const std::string advice =
        fmt::format("by the usual joint names ({}); name them with {} {}", finding.problem, words.option, words.joints);
    if (choice.kinds_line == 0) throw InputError(file, fmt::format("no {} found {}", words.limbs, advice));
    throw InputError(choice.kinds_file, choice.kinds_line,
                     fmt::format("{}: no {} found in {} {}", choice.kinds_key, words.limbs,
                                 formats::printable(file.string(), 400), advice));
}

}  // namespace

NamedLimb limb_of_option(std::string_view text, std::string_view option)
{
    NamedLimb limb{{}, std::nullopt, std::string(option)};
    for (const Side side : {Side::left, Side::right}) {
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

LimbSearch look_for_limbs(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice)
{
    std::vector<Candidate> limbs;
    for (const LimbKind kind : {LimbKind::arm, LimbKind::leg})
        if (is_chosen(choice, kind))
            for (Candidate& limb : candidates(clip, file, choice, kind)) limbs.push_back(std::move(limb));
    require_apart(file, limbs);
    LimbSearch search{front_of(clip, limbs), {}};
    for (const Candidate& limb : limbs) search.findings.push_back(finding_of(clip, choice, search.front, limb));
    return search;
}

FoundLimbs find_limbs(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice)
{
    FoundLimbs found;
    for (LimbFinding& finding : look_for_limbs(clip, file, choice).findings) {
        if (finding.has_names && !finding.limb)
            throw InputError(file,
                             fmt::format("the {} cannot be bound: {}", plain_name(finding.name), finding.problem));
        if (finding.limb)
            found.limbs.push_back(*finding.limb);
        else
            found.missing.push_back(std::move(finding));
    }
    for (const LimbFinding& finding : found.missing) {
        const LimbWords& words = words_of(finding.name.kind);
        const auto is_same_kind = [&](const Limb& limb) { return limb.name.kind == finding.name.kind; };
        const auto other = std::find_if(found.limbs.begin(), found.limbs.end(), is_same_kind);
        if (other == found.limbs.end()) refuse_kind(file, choice, finding);
        if (finding.is_half)
            throw InputError(file, fmt::format("the {} cannot be bound: {}; name both {} with {} {}, or the {} alone",
                                               plain_name(finding.name), finding.problem, words.limbs, words.option,
                                               words.joints, plain_name(other->name)));
    }
    return found;
}

}  // namespace swivel::tools
