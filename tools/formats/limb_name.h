#pragma once
// SPDX-License-Identifier: MIT
// Names a character's four limbs in tables and files.

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string_view>

namespace swivel::formats {

enum class LimbKind : std::uint8_t { arm, leg };
enum class Side : std::uint8_t { left, right };

struct LimbName {
    LimbKind kind = LimbKind::arm;
    Side side = Side::left;

    friend auto operator<=>(const LimbName&, const LimbName&) = default;
};

// In the order in which tables list them.
constexpr std::array<LimbName, 4> kLimbNames = {{{LimbKind::arm, Side::left},
                                                 {LimbKind::arm, Side::right},
                                                 {LimbKind::leg, Side::left},
                                                 {LimbKind::leg, Side::right}}};

// Where a limb is in kLimbNames.
constexpr std::size_t index_of(LimbName name)
{
    return 2 * static_cast<std::size_t>(name.kind) + static_cast<std::size_t>(name.side);
}

// "arm" or "leg".
constexpr std::string_view kind_name(LimbKind kind) { return kind == LimbKind::arm ? "arm" : "leg"; }
// "left" or "right".
constexpr std::string_view side_name(Side side) { return side == Side::left ? "left" : "right"; }

// The word that files use: left_arm, right_arm, left_leg or right_leg.
constexpr std::string_view limb_word(LimbName name)
{
    return std::array<std::string_view, 4>{"left_arm", "right_arm", "left_leg", "right_leg"}[index_of(name)];
}
// The limb of such a word; nothing for any other.
constexpr std::optional<LimbName> limb_of_word(std::string_view word)
{
    for (const LimbName name : kLimbNames)
        if (limb_word(name) == word) return name;
    return std::nullopt;
}

}  // namespace swivel::formats
