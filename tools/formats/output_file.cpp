// SPDX-License-Identifier: MIT
#include "tools/formats/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "tools/formats/error.h"
#include "tools/formats/text.h"

namespace swivel::formats {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kBufferBytes = 1 << 20;
constexpr const char* kStandardOutput = "standard output";
constexpr int kMaxLinks = 40;  // as many as Linux follows

// Links are read one by one, because canonical() refuses one whose target does not exist yet.
fs::path follow_links(const fs::path& path)
{
    fs::path target = path;
    std::error_code ignored;
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, ignored)); ++links) {
        if (links == kMaxLinks) throw InputError(path, "is a chain of links without an end; name another file");
        target = target.parent_path() / fs::read_symlink(target, ignored);
    }
    return target;
}

// Whether the name is of a file already open elsewhere. If that is a regular file, a rename would replace it under its
// owner.
bool is_open_descriptor(const fs::path& path)
{
    const std::string name = path.lexically_normal().string();
    return name == "/dev/stdout" || name == "/dev/stderr" || name.starts_with("/dev/fd/") || name.starts_with("/proc/");
}

bool is_written_straight(const fs::path& path)
{
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return is_open_descriptor(path) || (fs::exists(status) && !fs::is_regular_file(status));
}

std::string_view advice(const std::error_code& reason)
{
    if (reason == std::errc::no_space_on_device) return "free some space";
    if (reason == std::errc::file_too_large) return "raise the limit on the size of files, ulimit -f";
    if (reason == std::errc::filename_too_long) return "shorten it";
    if (reason == std::errc::broken_pipe) return "nobody reads it any more";
    return "check the folder and its permissions";
}

// Gives a new file the owner, group and permissions of the file that it replaces, as far as the process may. If the
// group cannot be kept, the group's permissions are reduced to those of others. Some file systems have no permissions
// at all.
void keep_rights(int descriptor, const struct stat& before)
{
    constexpr uid_t same = static_cast<uid_t>(-1);
    mode_t mode = before.st_mode & 0777;
    const bool has_group =
        ::fchown(descriptor, before.st_uid, before.st_gid) == 0 || ::fchown(descriptor, same, before.st_gid) == 0;
    if (!has_group) mode &= ~static_cast<mode_t>(0070) | (mode & 0007) << 3;
    static_cast<void>(::fchmod(descriptor, mode));
}

// Syncs an open folder and closes it. Below 0: the folder may be written, but not read, and nothing is synced.
void sync_and_close(int descriptor, const fs::path& path)
{
    if (descriptor < 0) return;
    const bool is_synced = ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS;
    const std::error_code reason(errno, std::generic_category());
    ::close(descriptor);
    if (!is_synced) throw InputError(path, fmt::format("cannot be written: {}; check the disk", reason.message()));
}

}  // namespace

OutputFile::OutputFile(const fs::path& path)
    : named_(is_standard_stream(path) ? kStandardOutput : path), folder_(AT_FDCWD)
{
    std::error_code ignored;
    if (path.empty()) throw InputError("(no name)", "an output file needs a name");
    buffer_.reserve(kBufferBytes);
    if (is_standard_stream(path)) {
        descriptor_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
        if (descriptor_ < 0) fail("cannot be opened for writing");
    } else if (fs::is_directory(path, ignored)) {
        throw InputError(path, "is a directory; name a file in it");
    } else if (is_written_straight(path)) {
        descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        if (descriptor_ < 0) fail("cannot be opened for writing");
    } else {
        target_ = follow_links(path);
        open_partial(0);
    }
}

OutputFile::OutputFile(int folder, const std::string& name, const fs::path& path)
    : named_(path), folder_(folder), target_(name), partial_(folder)
{
    buffer_.reserve(kBufferBytes);
    open_partial(AT_SYMLINK_NOFOLLOW);
}

// The partial file has a short name of its own, because the target's may be as long as a name can be.
// follows: 0, or AT_SYMLINK_NOFOLLOW to replace a symbolic link itself. Only a regular file passes on its permissions.
void OutputFile::open_partial(int follows)
{
    struct stat before;
    bool is_there = ::fstatat(folder_, target_.c_str(), &before, follows) == 0;
    if (!is_there && errno != ENOENT) fail("cannot be created");
    if (is_there && S_ISDIR(before.st_mode)) throw InputError(named_, "is a directory; name a file in it");
    is_there = is_there && S_ISREG(before.st_mode);
    if (is_there && ::faccessat(folder_, target_.c_str(), W_OK, AT_EACCESS) != 0) fail("cannot be replaced");
    // Nobody may read in the new file, at any moment, what they may not read in the old one.
    const mode_t mode = is_there ? 0600 : 0666;
    descriptor_ = partial_.make(target_.parent_path(), [this, mode](const char* name) {
        return ::openat(folder_, name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    });
    if (descriptor_ < 0) fail("cannot be created");
    if (is_there) keep_rights(descriptor_, before);
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::write(std::string_view bytes)
{
    if (descriptor_ < 0) throw std::invalid_argument("OutputFile: write after commit or after a failure");
    if (buffer_.size() + bytes.size() > kBufferBytes) {
        flush(buffer_);
        buffer_.clear();
    }
    if (bytes.size() > kBufferBytes) {
        flush(bytes);
    } else {
        buffer_ += bytes;
    }
}

void OutputFile::commit()
{
    if (descriptor_ < 0) throw std::invalid_argument("OutputFile: commit after commit or after a failure");
    flush(buffer_);
    const bool is_partial = !target_.empty();
    if (is_partial && ::fsync(descriptor_) != 0) fail("cannot be written");
    const int status = ::close(descriptor_);
    descriptor_ = -1;
    if (status != 0) fail("cannot be written");
    if (!is_partial) return;
    if (!partial_.rename(target_)) fail("cannot be renamed to");
    folder_ == AT_FDCWD ? sync_folder(target_.parent_path()) : sync_folder(folder_, named_.parent_path());
}

void OutputFile::flush(std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0) fail("cannot be written");
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
}

void OutputFile::discard() noexcept
{
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    partial_.remove();
}

void OutputFile::fail(std::string_view action)
{
    const std::error_code reason(errno, std::generic_category());
    discard();
    throw InputError(named_, fmt::format("{}: {}; {}", action, reason.message(), advice(reason)));
}

void sync_folder(int folder, const fs::path& path)
{
    sync_and_close(::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC), path);
}

void sync_folder(const fs::path& folder)
{
    const fs::path path = folder.empty() ? fs::path(".") : folder;
    sync_and_close(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC), path);
}

}  // namespace swivel::formats
