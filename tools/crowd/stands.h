// SPDX-License-Identifier: MIT
//
// The stands of a leg in a clip: where its foot is on the ground, and the frames between which it is not.
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

// The same and, where the leg is in the air for longer, stands of one frame: at the clip's first and last frame, if a
// contact is further away than a tenth of a second, and evenly so often that no swing is longer than a second. There is
// one stand or more.
// frame_time: s. contact: of each frame, one or more.
std::vector<Contact> stands_of(const std::vector<bool>& contact, double frame_time);

}  // namespace swivel::tools
