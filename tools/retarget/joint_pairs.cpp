// SPDX-License-Identifier: MIT
#include "tools/retarget/joint_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "tools/formats/csv_rows.h"
#include "tools/formats/error.h"
#include "tools/formats/output_file.h"
#include "tools/formats/printable.h"
#include "tools/formats/text.h"
#include "tools/rig/joint_names.h"
#include "tools/rig/name_table.h"

namespace swivel::tools {

namespace {

using formats::Clip;
using formats::InputError;

const std::vector<int>& list_of(const PairedPart& part, BodySide side)
{
    return side == BodySide::source ? part.source : part.target;
}

// The part of that name, which is made if it is missing.
PairedPart& part_called(JointPairs& pairs, const std::string& name)
{
    const auto found = std::ranges::find(pairs, name, &PairedPart::name);
    return found == pairs.end() ? pairs.emplace_back(PairedPart{name, {}, {}}) : *found;
}

std::set<int> joints_in(const JointPairs& pairs, BodySide side, bool paired_alone)
{
    std::set<int> joints;
    for (const PairedPart& part : pairs)
        if (!paired_alone || part.is_paired()) joints.insert(list_of(part, side).begin(), list_of(part, side).end());
    return joints;
}

std::vector<int> bones_outside(const std::set<int>& joints, const Clip& clip)
{
    std::vector<int> bones;
    for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint)
        if (joint_at(clip, joint).is_bone && !joints.contains(joint)) bones.push_back(joint);
    return bones;
}

using NamedBones = std::map<std::string, int>;

// The bones of a clip by name. Ambiguous names and the empty one are left out.
NamedBones bones_by(const Clip& clip, std::string (*name_of)(std::string_view))
{
    std::map<std::string, std::vector<int>> bearers;
    for (int joint = 0; joint < static_cast<int>(clip.joints.size()); ++joint)
        if (joint_at(clip, joint).is_bone) bearers[name_of(joint_at(clip, joint).name)].push_back(joint);
    NamedBones bones;
    for (const auto& [name, joints] : bearers)
        if (!name.empty() && joints.size() == 1) bones[name] = joints.front();
    return bones;
}

std::string finger_of(std::string_view joint_name) { return finger_bone(plain(joint_name)); }

// The bones of fingers. A hand's only finger is left out, because it stands for all five, like CMU's LeftHandIndex1.
NamedBones finger_bones(const Clip& clip)
{
    NamedBones bones = bones_by(clip, finger_of);
    std::map<std::string, std::set<std::string>> fingers;  // of each side
    const auto side_of_bone = [](const std::string& name) { return name.substr(0, name.find(' ')); };
    for (const auto& [name, joint] : bones) fingers[side_of_bone(name)].insert(name.substr(0, name.rfind(' ')));
    std::erase_if(bones, [&](const auto& each) { return fingers[side_of_bone(each.first)].size() < 2; });
    return bones;
}

// Pairs the bones of equal names that are no part, and in no pair yet.
void pair_by_name(const NamedBones& sources, const NamedBones& targets, JointPairs& pairs)
{
    const std::set<int> of_source = joints_in(pairs, BodySide::source, false);
    const std::set<int> of_target = joints_in(pairs, BodySide::target, false);
    JointPairs found;
    for (const auto& [name, to] : targets)
        if (const auto from = sources.find(name);
            from != sources.end() && !of_source.contains(from->second) && !of_target.contains(to))
            found.push_back({{}, {from->second}, {to}});
    std::ranges::sort(found, {}, &PairedPart::target);  // in the target's order
    pairs.insert(pairs.end(), found.begin(), found.end());
}

// The joint of a cell: none for an empty one.
std::vector<int> joint_of(const std::filesystem::path& path, std::size_t line, const Clip& clip, std::string_view cell,
                          std::set<int>& seen)
{
    if (cell.empty()) return {};
    const std::vector<int> found = formats::find_joints(clip, cell);
    const auto refuse = [&](const char* problem) {
        throw InputError(path, line, fmt::format("'{}' {}", formats::printable(cell), problem));
    };
    if (found.empty()) refuse("is no joint of its file; swivel rig FILE --joints lists them");
    if (found.size() > 1) refuse("is the name of several joints; give one by its path or number");
    if (!seen.insert(found.front()).second) refuse("is already in a line above; remove one");
    return found;
}

// The cells of a clip's joints. A cell has a joint's name if that is unique and a cell can hold it, else its number.
class Cells {
public:
    explicit Cells(const Clip& clip) : clip_(clip)
    {
        for (const formats::Joint& joint : clip.joints) ++bearers_[joint.name];
    }
    std::string cell_of(int joint) const
    {
        const std::string& name = joint_at(clip_, joint).name;
        // A name with a slash may be the path of another joint, and one that begins with # the number.
        const bool can_be_cell = formats::printable(name, name.size()) == name && !name.starts_with(' ') &&
                                 !name.ends_with(' ') && !name.starts_with('#') &&
                                 name.find_first_of(",\"/") == name.npos;
        return can_be_cell && bearers_.at(name) == 1 ? name : fmt::format("#{}", joint_at(clip_, joint).number);
    }

private:
    const Clip& clip_;
    std::map<std::string_view, std::size_t> bearers_;
};

}  // namespace

JointPairs pair_joints(const PartedBody& source, const PartedBody& target)
{
    JointPairs pairs;
    for (const BodyPart& part : source.parts) pairs.push_back({part.name, part.joints, {}});
    for (const BodyPart& part : target.parts) part_called(pairs, part.name).target = part.joints;
    pair_by_name(bones_by(source.clip, plain), bones_by(target.clip, plain), pairs);
    pair_by_name(finger_bones(source.clip), finger_bones(target.clip), pairs);
    return pairs;
}

JointPairs read_joint_map(const std::filesystem::path& path, const Clip& source, const Clip& target)
{
    JointPairs pairs;
    std::set<int> in_source, in_target;
    bool has_columns = false;
    const std::vector<std::string> words = part_names();
    formats::for_each_row(path, [&](std::size_t line, const std::vector<std::string_view>& cells) {
        if (!has_columns) {
            has_columns = cells == std::vector<std::string_view>{"part", "source", "target"};
            if (!has_columns) throw InputError(path, line, "the first line must be part,source,target");
            return;
        }
        if (cells.size() != 3)
            throw InputError(path, line, fmt::format("{} values; a row has 3: part,source,target", cells.size()));
        if (!cells[0].empty() && std::ranges::find(words, cells[0]) == words.end())
            throw InputError(path, line,
                             fmt::format("'{}' is no part of a body; take one of {}, or leave it empty",
                                         formats::printable(cells[0]), formats::joined(words, ", ")));
        PairedPart& part = cells[0].empty() ? pairs.emplace_back() : part_called(pairs, std::string(cells[0]));
        for (const int joint : joint_of(path, line, source, cells[1], in_source)) part.source.push_back(joint);
        for (const int joint : joint_of(path, line, target, cells[2], in_target)) part.target.push_back(joint);
    });
    if (!has_columns) throw InputError(path, "is empty; its first line must be part,source,target");
    return pairs;
}

void write_joint_map(const std::filesystem::path& path, const JointPairs& pairs, const Clip& source, const Clip& target,
                     const std::function<bool(int)>& can_key)
{
    const Cells from_cells(source), to_cells(target);
    formats::OutputFile out(path);
    out.write("part,source,target\n");
    const auto write = [&](const std::string& part, const std::string& from, const std::string& to) {
        out.write(fmt::format("{},{},{}\n", part, from, to));
    };
    for (const PairedPart& part : pairs)
        for (std::size_t n = 0; n < std::max(part.source.size(), part.target.size()); ++n)
            write(part.name, n < part.source.size() ? from_cells.cell_of(part.source[n]) : "",
                  n < part.target.size() ? to_cells.cell_of(part.target[n]) : "");
    for (const int joint : bones_outside(joints_in(pairs, BodySide::source, false), source))
        write("", from_cells.cell_of(joint), "");
    for (const int joint : bones_outside(joints_in(pairs, BodySide::target, false), target))
        if (can_key(joint)) write("", "", to_cells.cell_of(joint));
    out.commit();
}

std::vector<BodyPart> parts_of(const JointPairs& pairs, BodySide side)
{
    std::vector<BodyPart> parts;
    for (const PairedPart& part : pairs)
        if (!part.name.empty() && !list_of(part, side).empty()) parts.push_back({part.name, list_of(part, side)});
    return parts;
}

std::vector<int> unpaired_bones(const JointPairs& pairs, const Clip& clip, BodySide side)
{
    return bones_outside(joints_in(pairs, side, true), clip);
}

}  // namespace swivel::tools
