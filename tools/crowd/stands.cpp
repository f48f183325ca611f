// SPDX-License-Identifier: MIT
#include "tools/crowd/stands.h"

#include <algorithm>

namespace swivel::tools {

std::vector<Contact> contacts_of(const std::vector<bool>& frames)
{
    std::vector<Contact> contacts;
    const auto index = [&](auto at) { return static_cast<std::size_t>(at - frames.begin()); };
    for (auto end = frames.begin(); end != frames.end();) {
        const auto down = std::find(end, frames.end(), true);
        end = std::find(down, frames.end(), false);
        if (down != end) contacts.push_back({index(down), index(end)});
    }
    return contacts;
}

std::vector<Contact> stands_of(const std::vector<bool>& contact, double frame_time)
{
    constexpr double kShortest = 0.1, kLongest = 1;  // s, of a swing
    const std::vector<Contact> contacts = contacts_of(contact);
    std::vector<Contact> stands;
    const auto add = [&](const Contact& next) {
        const std::size_t end = stands.empty() ? next.first : stands.back().end;
        const auto frames = static_cast<double>(next.first - end);
        const auto parts = 1 + static_cast<std::size_t>(std::min(frames, frames * frame_time / kLongest));
        for (std::size_t part = 1; part < parts; ++part) {
            const std::size_t at = end + (next.first - end) * part / parts;
            stands.push_back({at, at + 1});
        }
        stands.push_back(next);
    };
    const auto is_long = [&](std::size_t frames) { return static_cast<double>(frames) * frame_time > kShortest; };
    if (contacts.empty() || is_long(contacts.front().first)) add({0, 1});
    for (const Contact& each : contacts) add(each);
    if (is_long(contact.size() - stands.back().end)) add({contact.size() - 1, contact.size()});
    return stands;
}

}  // namespace swivel::tools
