// SPDX-License-Identifier: MIT
#include "tools/formats/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
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

// Names of files already open elsewhere. Behind them may be a plain file, and a rename would cut it off from its owner.
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
    if (reason == std::errc::file_exists) return "remove it, a killed run has left it behind";
    return "check the folder and its permissions";
}

}  // namespace

OutputFile::OutputFile(const fs::path& path) : named_(is_standard_stream(path) ? "standard output" : path)
{
    std::error_code ignored;
    if (path.empty()) throw InputError("(no name)", "an output file needs a name");
    buffer_.reserve(kBufferBytes);
    if (is_standard_stream(path)) {
        descriptor_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
        if (descriptor_ < 0) fail("cannot be opened for writing");
        return;
    }
    if (fs::is_directory(path, ignored)) throw InputError(path, "is a directory; name a file in it");
    if (is_written_straight(path)) {
        descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        if (descriptor_ < 0) fail("cannot be opened for writing");
        return;
    }
    target_ = follow_links(path);
    const bool is_there = fs::exists(target_, ignored);
    if (is_there && ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) fail("cannot be replaced");
    partial_ = target_;
    partial_ += fmt::format(".partial-{}", ::getpid());
    const std::string action = fmt::format("cannot create {}", printable(partial_.filename().string(), 300));
    descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
        partial_.clear();  // whoever's it is, it is not ours to remove
        fail(action);
    }
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
    if (!partial_.empty() && ::fsync(descriptor_) != 0) fail("cannot be written");
    const int status = ::close(descriptor_);
    descriptor_ = -1;
    if (status != 0) fail("cannot be written");
    if (!partial_.empty() && ::rename(partial_.c_str(), target_.c_str()) != 0) fail("cannot be renamed to");
    partial_.clear();
}

void OutputFile::flush(std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail("cannot be written");
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
}

void OutputFile::discard() noexcept
{
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    if (!partial_.empty()) ::unlink(partial_.c_str());
    partial_.clear();
}

void OutputFile::fail(std::string_view action)
{
    const std::error_code reason(errno, std::generic_category());
    discard();
    throw InputError(named_, fmt::format("{}: {}; {}", action, reason.message(), advice(reason)));
}

}  // namespace swivel::formats
