// SPDX-License-Identifier: MIT
#include "tools/rig/limbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "tools/formats/error.h"
#include "tools/formats/text.h"
#include "tools/rig/joint_names.h"
#include "tools/rig/limb_hinge.h"
#include "tools/rig/limb_words.h"

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
    const Source* source = nullptr;  // where the user named it; null: found by the names in use
};

// A fault of what the user said of a clip, where it was said.
[[noreturn]] void refuse(const Source& source, const std::filesystem::path& clip, std::string_view cause,
                         std::string_view advice)
{
    if (source.is_file())
        throw InputError(
            source.file, source.line,
            fmt::format("{}: {} in {}{}", source.key, cause, formats::printable(clip.string(), 400), advice));
    const std::string said_by = source.key.empty() ? "" : fmt::format(" ({})", source.key);
    throw InputError(clip, fmt::format("{}{}{}", cause, said_by, advice));
}

// Reads one limb that the user named.
struct NameReader {
    const Clip& clip;
    const std::filesystem::path& file;  // the clip's
    const LimbWords& words;
    const NamedLimb& from;

    [[noreturn]] void refuse(std::string_view cause, std::string_view advice) const
    {
        tools::refuse(from.source, file, cause, advice);
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
            refuse(fmt::format("'{}' does not name a joint, one below it and one below that", text),
                   fmt::format("; write {}, from the body outwards", words.joints));
        const std::string_view speaks = formats::joint_at(clip, joints[0]).name;
        return {
            {kind, from.side ? *from.side : side_of(speaks, otherwise)}, {joints, from.source.key, {}}, &from.source};
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

bool has(std::span<const Candidate> limbs, LimbName name)
{
    return std::any_of(limbs.begin(), limbs.end(), [&](const Candidate& limb) { return limb.name == name; });
}

// What options name of one kind.
std::vector<Candidate> named_by_options(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice,
                                        LimbKind kind)
{
    const LimbWords& words = words_of(kind);
    std::vector<Candidate> limbs;
    for (const NamedLimb& named : names_of(choice, kind))
        if (!named.source.is_file())
            limbs.push_back(NameReader{clip, file, words, named}.limb(kind, limbs.empty() ? Side::left : Side::right));
    if (limbs.size() > 2)
        throw InputError(
            file, fmt::format("{} was given more than twice; a character has two {}", words.option, words.limbs));
    if (limbs.size() == 2 && limbs[0].name == limbs[1].name)
        throw InputError(file, fmt::format("both {} are taken as {}; write {} left:... and {} right:...", words.limbs,
                                           side_name(limbs[0].name.side), words.option, words.option));
    return limbs;
}

// The limbs of one kind: those that options name; of the sides left those that a file names; and of the sides then
// left those by habit, where the kind was asked for or none is named.
std::vector<Candidate> candidates(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice,
                                  LimbKind kind)
{
    const std::vector<NamedLimb>& names = names_of(choice, kind);
    std::vector<Candidate> limbs = named_by_options(clip, file, choice, kind);
    const auto add = [&](Candidate limb) {
        limbs.insert(limb.name.side == Side::left ? limbs.begin() : limbs.end(), std::move(limb));
    };
    for (const NamedLimb& named : names)
        if (named.source.is_file() && !has(limbs, {kind, *named.side}))
            add(NameReader{clip, file, words_of(kind), named}.limb(kind, *named.side));
    if (!names.empty() && choice.kinds.empty()) return limbs;
    for (const LimbName name : {LimbName{kind, Side::left}, LimbName{kind, Side::right}})
        if (!has(limbs, name)) add({name, limb_by_name(clip, name)});
    return limbs;
}

// No joint is in two limbs: one that the user named takes it from one found by habit; two named are refused. (No name
// is in use for two limbs, so that two found by habit share none.)
void keep_apart(const Clip& clip, const std::filesystem::path& file, std::span<Candidate> limbs)
{
    for (const Candidate& named : limbs) {
        if (!named.source) continue;
        for (Candidate& other : limbs) {
            if (&other == &named) continue;
            if (!named.found.joints || !other.found.joints) continue;
            const int joint = shared_joint(*named.found.joints, *other.found.joints);
            if (joint < 0) continue;
            if (other.source)
                refuse(*other.source, file,
                       fmt::format("the {} and the {} share the joint '{}'", plain_name(named.name),
                                   plain_name(other.name), printable_name(joint_at(clip, joint))),
                       "; each needs three of its own");
            other.found = {std::nullopt, {}, fmt::format("its joints were named for the {}", plain_name(named.name))};
        }
    }
}

std::optional<std::array<int, 2>> trunks_apart(const Clip& clip, const Candidate& a, const Candidate& b)
{
    if (!a.found.joints || !b.found.joints) return std::nullopt;
    return tools::trunks_apart(clip, (*a.found.joints)[0], (*b.found.joints)[0]);
}

// All limbs are one figure's: of two whose trunks are not, those found by habit are refused.
void keep_together(const Clip& clip, std::span<Candidate> limbs)
{
    const auto shown = [&](int joint) {
        return fmt::format("'{}' (#{})", printable_name(joint_at(clip, joint)), joint_at(clip, joint).number);
    };
    std::vector<std::string> problems(limbs.size());
    for (std::size_t n = 0; n < limbs.size(); ++n)
        for (const Candidate& other : limbs) {
            if (limbs[n].source) break;
            const auto trunks = trunks_apart(clip, limbs[n], other);
            if (!trunks) continue;
            problems[n] = fmt::format("it hangs on {}, the {} on {}: two figures", shown((*trunks)[0]),
                                      plain_name(other.name), shown((*trunks)[1]));
            break;
        }
    for (std::size_t n = 0; n < limbs.size(); ++n)
        if (!problems[n].empty()) limbs[n].found = {std::nullopt, {}, problems[n]};
}

// Of every limb that is known, solved or not.
Front front_of(const Clip& clip, const std::filesystem::path& file, std::span<const Candidate> limbs)
{
    std::vector<Candidate> all(limbs.begin(), limbs.end());
    for (const LimbName name : formats::kLimbNames) {
        if (has(all, name)) continue;
        const Candidate other{name, limb_by_name(clip, name)};
        const auto is_anothers = [&](const Candidate& limb) { return trunks_apart(clip, limb, other).has_value(); };
        if (std::none_of(limbs.begin(), limbs.end(), is_anothers)) all.push_back(other);
    }
    keep_apart(clip, file, all);
    std::array<std::optional<LimbJoints>, 4> joints;
    for (std::size_t n = 0; n < joints.size(); ++n)
        for (const Candidate& limb : all)
            if (limb.name == formats::kLimbNames[n]) joints[n] = limb.found.joints;
    Front front = figure_front(clip, joints);
    if (front.doubt.empty()) front.doubt = doubt_by_bends(clip, joints, front);
    return front;
}

// Why no joint's name is known.
void explain_missing(const Clip& clip, LimbFinding& finding)
{
    std::vector<int> depth(clip.joints.size(), 0);
    int deepest = 0;
    for (std::size_t n = 0; n < depth.size(); ++n) {
        const int parent = clip.joints[n].parent;
        depth[n] = (parent < 0 ? 0 : depth[static_cast<std::size_t>(parent)]) + clip.joints[n].is_bone;
        deepest = std::max(deepest, depth[n]);
    }
    finding.problem = "no joints have names in use for such a limb";
    if (deepest >= 3) return;
    finding.problem =
        fmt::format("a limb takes three bones below each other, and this skeleton has at most {}", deepest);
    finding.advice = "choose a figure's file";
}

LimbFinding finding_of(const Clip& clip, const LimbChoice& choice, const Front& front, const Candidate& candidate)
{
    LimbFinding finding{candidate.name, std::nullopt, candidate.found.problem, {}, candidate.found.joints.has_value()};
    if (!finding.has_names) {
        finding.is_half = !finding.problem.empty();
        if (finding.problem.empty()) explain_missing(clip, finding);
        return finding;
    }
    try {
        Limb limb = bind_limb(clip, candidate.name, *candidate.found.joints, front, choice.bends);
        limb.habit = candidate.found.habit;
        if (!candidate.source) require_parts_between(clip, limb);
        finding.limb = std::move(limb);
    } catch (const CannotBind& fault) {
        finding.problem = fault.what();
        finding.advice = fault.advice;
    }
    return finding;
}

// How to name a limb: as the kinds were given, by options or in a file.
std::string naming(const LimbChoice& choice, LimbName name)
{
    if (choice.kinds_source.is_file()) return fmt::format("limb.{}.joints", limb_word(name));
    const LimbWords& words = words_of(name.kind);
    return fmt::format("{} {}", words.option, words.joints);
}

// Of a limb that is found by habit: the kinds' line, where a file has it.
[[noreturn]] void refuse_found(const std::filesystem::path& file, const LimbChoice& choice, std::string_view cause,
                               std::string_view advice)
{
    refuse(choice.kinds_source.is_file() ? choice.kinds_source : Source{}, file, cause, advice);
}

// No limb of the finding's kind has names in use.
[[noreturn]] void refuse_kind(const std::filesystem::path& file, const LimbChoice& choice, const LimbFinding& finding)
{
    refuse_found(
        file, choice,
        fmt::format("no {} found by the usual joint names ({})", words_of(finding.name.kind).limbs, finding.problem),
        finding.advice.empty() ? fmt::format("; name them with {}", naming(choice, finding.name))
                               : fmt::format("; {}", finding.advice));
}

// The other limb of its kind binds.
[[noreturn]] void refuse_half(const std::filesystem::path& file, const LimbChoice& choice, const LimbFinding& finding,
                              LimbName other)
{
    const std::string cause = fmt::format("the {} cannot be bound: {}", plain_name(finding.name), finding.problem);
    const std::string how = naming(choice, finding.name);
    if (choice.kinds.empty())
        refuse_found(
            file, choice, cause,
            fmt::format("; name both {} with {}, or the {} alone", words_of(other.kind).limbs, how, plain_name(other)));
    refuse_found(file, choice, cause,
                 fmt::format("; name it with {}, or the {} alone and leave out {}", how, plain_name(other),
                             choice.kinds_source.key));
}

}  // namespace

std::string problem_text(const LimbFinding& finding)
{
    return finding.advice.empty() ? finding.problem : fmt::format("{}; {}", finding.problem, finding.advice);
}

std::string kinds_words(const LimbChoice& choice)
{
    const Source& source = choice.kinds_source;
    if (!source.is_file()) return fmt::format("{} {}", source.key, choice.kinds);
    return fmt::format("{} = \"{}\" in line {} of {}", source.key, choice.kinds, source.line,
                       formats::printable(source.file.string(), 400));
}

NamedLimb limb_of_option(std::string_view text, std::string_view option)
{
    NamedLimb limb{{}, std::nullopt, {std::string(option)}};
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
    keep_apart(clip, file, limbs);
    keep_together(clip, limbs);
    LimbSearch search{front_of(clip, file, limbs), {}};
    for (const Candidate& limb : limbs) search.findings.push_back(finding_of(clip, choice, search.front, limb));
    return search;
}

FoundLimbs find_limbs(const Clip& clip, const std::filesystem::path& file, const LimbChoice& choice)
{
    FoundLimbs found;
    LimbSearch search = look_for_limbs(clip, file, choice);
    found.doubt = search.front.doubt;
    for (LimbFinding& finding : search.findings) {
        if (finding.has_names && !finding.limb)
            throw InputError(
                file, fmt::format("the {} cannot be bound: {}", plain_name(finding.name), problem_text(finding)));
        if (finding.limb)
            found.limbs.push_back(*finding.limb);
        else
            found.missing.push_back(std::move(finding));
    }
    for (const LimbFinding& finding : found.missing) {
        const auto is_same_kind = [&](const Limb& limb) { return limb.name.kind == finding.name.kind; };
        const auto other = std::find_if(found.limbs.begin(), found.limbs.end(), is_same_kind);
        if (other == found.limbs.end()) refuse_kind(file, choice, finding);
        if (finding.is_half) refuse_half(file, choice, finding, other->name);
    }
    return found;
}

}  // namespace swivel::tools
