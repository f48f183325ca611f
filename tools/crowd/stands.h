// SPDX-License-Identifier: MIT
//
// The stands of a leg in a clip: the frames in which its foot is on the ground.
#pragma once

#include <cstddef>
#include <vector>

namespace swivel::tools {

// Frames from `first` on, up to `end`.
struct Contact {
    std::size_t first, end;
};
inline std::size_t middle_of(const Contact& contact) { return (contact.first + contact.end) / 2; }

// A leg's contacts, in order.
std::vector<Contact> contacts_of(const std::vector<bool>& frames);

// A leg's contacts, and stands of one frame where it is in the air for longer. Such a stand is at the clip's first
// frame, and at its last, if no contact is within a tenth of a second. Others divide swings evenly, so that none is
// longer than a second. There is one stand or more. frame_time: s. contact: of each frame, one or more.
std::vector<Contact> stands_of(const std::vector<bool>& contact, double frame_time);

}  // namespace swivel::tools
