#pragma once
// SPDX-License-Identifier: MIT
// A file that appears whole or not at all: bytes go to ".swivel-PID-N" in the same folder, commit() renames it to NAME.
// An interrupted run leaves the old NAME untouched. Standard output ("-"), devices and pipes cannot be renamed onto and
// are written straight. Knows no contents.
//
// The new file gets the permissions of the one that it replaces, and its owner and group where the process may set
// them. A file of a new name gets permissions by the umask. A write-protected file is not replaced, though its folder
// would allow it: cp and editors refuse that, too.

#include <filesystem>
#include <string>
#include <string_view>

#include "tools/formats/partial.h"

namespace swivel::formats {

class OutputFile {
public:
    // Opens the partial file. A symbolic link is followed first, so the link stays and its target is replaced.
    // Throws InputError when the folder is missing or not writable, when the name is too long, or when `path` is a
    // directory or write-protected.
    // One object belongs to one thread. Allocates its buffer of 1 MiB here, nothing later.
    explicit OutputFile(const std::filesystem::path& path);

    // The same for a name in an open folder, which must stay open as long as the object. A symbolic link of that name
    // is replaced itself. Throws InputError, naming `path`, if it is a folder, or as above.
    OutputFile(int folder, const std::string& name, const std::filesystem::path& path);

    // Without a commit the partial file is removed.
    ~OutputFile();

    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    // Appends `bytes`. They may stay in the buffer, so a full disk can show here or at commit(): InputError.
    void write(std::string_view bytes);

    // Writes out the buffer, waits until the disk has it all, closes and renames. Throws InputError when any of it
    // fails; the file of that name is then what it was before. To be called once, last.
    void commit();

private:
    void open_partial(int follows);
    void flush(std::string_view bytes);
    void discard() noexcept;
    [[noreturn]] void fail(std::string_view action);

    std::filesystem::path named_;   // as the caller wrote it: for messages
    int folder_;                    // where relative names begin
    std::filesystem::path target_;  // links followed; empty: written straight
    Partial partial_;
    std::string buffer_;
    int descriptor_ = -1;
};

// Waits until the disk has the names in a folder; "" is the working folder. Does nothing on file systems that cannot do
// it. Throws InputError if the disk fails.
void sync_folder(const std::filesystem::path& folder);
// The same for an open folder; `path` is for messages.
void sync_folder(int folder, const std::filesystem::path& path);

}  // namespace swivel::formats
