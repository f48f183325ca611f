#pragma once
// SPDX-License-Identifier: MIT
// What is not finished yet: a file or folder under a name of its own, ".swivel-PID-N", beside the place where it will
// appear. It has one owner, which renames it or removes it. Knows nothing of what is in it.

#include <fcntl.h>

#include <filesystem>
#include <functional>
#include <string>

namespace swivel::formats {

class Partial {
public:
    // Of nothing yet. Relative names begin in that open folder, which must stay open as long as the object; or, if none
    // is given, in the working folder.
    explicit Partial(int folder = AT_FDCWD);
    ~Partial();  // removes what was made and not renamed
    Partial(const Partial&) = delete;
    Partial& operator=(const Partial&) = delete;

    // Makes it in a folder; "" is the one where names begin. create(name) makes a new file or folder as open() and
    // mkdir() do. Below 0 it has failed, and errno says why; EEXIST asks for another name. Returns what create()
    // returned last. To be called once.
    int make(const std::filesystem::path& folder, const std::function<int(const char*)>& create);

    // Where it is; empty before it is made, and after it is renamed or removed.
    const std::string& name() const { return name_; }

    // Gives it its final name. False: errno says why, and it stays as it is.
    bool rename(const std::filesystem::path& target) noexcept;

    // Removes it, a folder with all in it. Takes no memory.
    void remove() noexcept;

    // Removes those of all objects of the process. For its last moments: from then on any use of an object, and another
    // call, waits for ever. Any thread may call it, a signal's handler, too, whatever others do.
    static void remove_all() noexcept;

private:
    void remove_locked() noexcept;

    int folder_;
    std::string name_;
    Partial* next_;  // of all that live
};

}  // namespace swivel::formats
