#pragma once
// SPDX-License-Identifier: MIT
// An unfinished file or folder under a temporary name, ".swivel-PID-N", beside its final place. It has one owner, which
// renames it or removes it. Knows no contents.

#include <fcntl.h>

#include <filesystem>
#include <functional>
#include <string>

namespace swivel::formats {

class Partial {
public:
    // Creates no file yet. folder: where relative names begin, an open folder that must outlive this; AT_FDCWD: the
    // working folder.
    explicit Partial(int folder = AT_FDCWD);
    ~Partial();  // removes what was made and not renamed
    Partial(const Partial&) = delete;
    Partial& operator=(const Partial&) = delete;

    // Makes the file or folder in a folder; "" is the one where names begin. create(name) makes it as open() and
    // mkdir() do, and fails with a result below 0 and errno; EEXIST asks for another name. Returns create()'s last
    // result. Call it once.
    int make(const std::filesystem::path& folder, const std::function<int(const char*)>& create);

    // Its present name; empty before it is made, and after it is renamed or removed.
    const std::string& name() const { return name_; }

    // Gives it its final name. Returns false, with errno, if that fails; it then stays as it is.
    bool rename(const std::filesystem::path& target) noexcept;

    // Removes it, a folder with its contents. Allocates nothing.
    void remove() noexcept;

    // Removes all unfinished files of the process. Call it only while the process exits: every later use of any object,
    // or another call, blocks forever. Any thread and signal handlers may call it.
    static void remove_all() noexcept;

private:
    void remove_locked() noexcept;

    int folder_;
    std::string name_;
    Partial* next_;  // in the list of all objects
};

}  // namespace swivel::formats
