// SPDX-License-Identifier: MIT
//
// A folder that holds plain files and plain folders and nothing else. No link in it is followed, and no pipe or device
// in it is opened to be used. So what others put there cannot lead a call to anything outside. Knows no array.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace swivel::tools {

// An open file or folder, which is closed with the object.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    ~Descriptor();
    Descriptor(Descriptor&& other) noexcept;
    Descriptor& operator=(Descriptor&& other) noexcept;

    int get() const { return number_; }
    int release();
    bool is_open() const { return number_ >= 0; }

private:
    int number_;
};

// Names are those of files and folders within it, such as "clip/wrist/0.0.0". Calls that read, or go
// through folders, throw InputError, naming the path, for what is a link, a pipe or a device. All throw it for what the
// process may not reach, read or write. Objects
// may be used by several threads at once.
class PlainFolder {
public:
    // path is the user's own: links in it are followed. `is_missing`: the text of the error if there is no such folder.
    PlainFolder(const std::filesystem::path& path, const char* is_missing);

    const std::filesystem::path& path() const { return path_; }

    // Whether there is anything of that name, a link included.
    bool has(const std::string& name) const;
    // What a file holds, up to `most` bytes and one more: a longer result says that the file is longer than that.
    // Nothing: there is no such file, or no folder for it. Allocates as bytes come, not as `most` says.
    std::optional<std::string> read(const std::string& name, std::size_t max) const;
    // Writes a file whole, under a name of its own, synced, renamed. A file of that name is replaced.
    void write(const std::string& name, std::string_view bytes) const;
    // Makes a folder, unless it is there. Its own folder must be there.
    void make(const std::string& name) const;

    // Calls `each` with what a folder holds, in any order; with nothing where there is no such folder. "": this one.
    // Its own files may be removed meanwhile.
    void for_names(const std::string& folder, const std::function<void(const std::string&)>& each) const;
    // Removes a file; of a link, the link itself. What is gone already is no error.
    void remove_file(const std::string& name) const;

private:
    Descriptor open_folder(const std::string& name) const;
    Descriptor folder_of(const std::string& name) const;
    [[noreturn]] void refuse(const std::string& name, const char* action, int reason) const;

    std::filesystem::path path_;
    Descriptor root_;
};

// Whether a name is that of a file which a writer left when it was killed: .swivel-PID-N, two decimal numbers.
bool is_unfinished(std::string_view name);

}  // namespace swivel::tools
