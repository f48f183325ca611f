// SPDX-License-Identifier: MIT
#include "tools/cache/plain_folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <new>
#include <system_error>
#include <utility>

#include "tools/formats/error.h"
#include "tools/formats/output_file.h"
#include "tools/formats/text.h"

namespace swivel::tools {

namespace {

namespace fs = std::filesystem;
using formats::InputError;

constexpr int kToPassThrough = O_PATH;  // a folder that may be searched, and need not be read
constexpr const char* kNoLinks =
    "is a link, a pipe or a device, and a cache has plain files and folders alone; take it from a copy, or make the "
    "cache anew";

// The name after the last slash.
std::string last_of(const std::string& name) { return name.substr(name.rfind('/') + 1); }

bool is_number(std::string_view text)
{
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

Descriptor::~Descriptor()
{
    if (number_ >= 0) ::close(number_);
}
Descriptor::Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
Descriptor& Descriptor::operator=(Descriptor&& other) noexcept
{
    std::swap(number_, other.number_);
    return *this;
}
int Descriptor::release() { return std::exchange(number_, -1); }

PlainFolder::PlainFolder(const fs::path& path, const char* is_missing)
    : path_(path), root_(::open(path.c_str(), kToPassThrough | O_DIRECTORY | O_CLOEXEC))
{
    if (root_.is_open()) return;
    if (errno == ENOENT || errno == ENOTDIR) throw InputError(path_, is_missing);
    refuse("", "cannot be opened", errno);
}

void PlainFolder::refuse(const std::string& name, const char* action, int reason) const
{
    const fs::path path = name.empty() ? path_ : path_ / name;
    if (reason == ENOMEM) throw std::bad_alloc();
    if (reason == ELOOP || reason == ENOTDIR || reason == ENXIO) throw InputError(path, kNoLinks);
    const std::string text = std::generic_category().message(reason);
    throw InputError(path, fmt::format("{}: {}; check its permissions and those of its folder", action, text));
}

// Closed where there is none.
Descriptor PlainFolder::open_folder(const std::string& name) const
{
    Descriptor folder(::openat(root_.get(), ".", kToPassThrough | O_DIRECTORY | O_CLOEXEC));
    if (!folder.is_open()) refuse("", "cannot be opened", errno);
    for (std::size_t begin = 0, end = 0; begin < name.size(); begin = end + 1) {
        end = std::min(name.find('/', begin), name.size());
        const std::string part = name.substr(begin, end - begin);
        Descriptor next(::openat(folder.get(), part.c_str(), kToPassThrough | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
        if (!next.is_open() && errno == ENOENT) return Descriptor();
        if (!next.is_open()) refuse(name.substr(0, end), "cannot be opened", errno);
        folder = std::move(next);
    }
    return folder;
}

// The one that a name is in.
Descriptor PlainFolder::folder_of(const std::string& name) const
{
    const std::size_t slash = name.rfind('/');
    return open_folder(slash == std::string::npos ? "" : name.substr(0, slash));
}

bool PlainFolder::has(const std::string& name) const
{
    const Descriptor folder = folder_of(name);
    struct stat status;
    if (!folder.is_open()) return false;
    if (::fstatat(folder.get(), last_of(name).c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0) return true;
    if (errno != ENOENT) refuse(name, "cannot be reached", errno);
    return false;
}

std::optional<std::string> PlainFolder::read(const std::string& name, std::size_t max) const
{
    const Descriptor folder = folder_of(name);
    if (!folder.is_open()) return std::nullopt;
    // Without O_NONBLOCK, a pipe that nobody writes to would keep the call waiting.
    Descriptor file(
        ::openat(folder.get(), last_of(name).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    if (!file.is_open() && errno == ENOENT) return std::nullopt;
    struct stat status;
    if (!file.is_open() || ::fstat(file.get(), &status) != 0) refuse(name, "cannot be opened", errno);
    if (!S_ISREG(status.st_mode)) throw InputError(path_ / name, kNoLinks);
    const formats::TextFile stream(::fdopen(file.get(), "rb"));
    if (!stream) refuse(name, "cannot be opened", errno);
    file.release();
    std::string bytes;
    formats::append_bytes(path_ / name, stream.get(), max + 1, bytes);
    return bytes;
}

void PlainFolder::write(const std::string& name, std::string_view bytes) const
{
    const Descriptor folder = folder_of(name);
    if (!folder.is_open()) refuse(name, "cannot be created", ENOENT);
    formats::OutputFile file(folder.get(), last_of(name), path_ / name);
    file.write(bytes);
    file.commit();
}

void PlainFolder::make(const std::string& name) const
{
    const Descriptor folder = folder_of(name);
    if (!folder.is_open()) refuse(name, "cannot be created", ENOENT);
    const bool is_new = ::mkdirat(folder.get(), last_of(name).c_str(), 0777) == 0;
    if (!is_new && errno != EEXIST) refuse(name, "cannot be created", errno);
    open_folder(name);  // throws if it is none
    if (is_new) formats::sync_folder(folder.get(), path_);
}

void PlainFolder::for_names(const std::string& name, const std::function<void(const std::string&)>& each) const
{
    const Descriptor folder = open_folder(name);
    if (!folder.is_open()) return;
    Descriptor readable(::openat(folder.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (!readable.is_open()) refuse(name, "cannot be read", errno);
    const std::unique_ptr<DIR, int (*)(DIR*)> list(::fdopendir(readable.get()), ::closedir);
    if (!list) refuse(name, "cannot be read", errno);
    readable.release();
    const auto next = [&] {
        errno = 0;  // the end and an error are both null
        return ::readdir(list.get());
    };
    while (const dirent* const entry = next())
        if (const std::string found = entry->d_name; found != "." && found != "..") each(found);
    if (errno != 0) refuse(name, "cannot be read", errno);
}

void PlainFolder::remove_file(const std::string& name) const
{
    const Descriptor folder = folder_of(name);
    if (folder.is_open() && ::unlinkat(folder.get(), last_of(name).c_str(), 0) != 0 && errno != ENOENT)
        refuse(name, "cannot be removed", errno);
}

bool is_unfinished(std::string_view name)
{
    constexpr std::string_view kBefore = ".swivel-";
    if (!name.starts_with(kBefore)) return false;
    name.remove_prefix(kBefore.size());
    const std::size_t dash = name.find('-');
    return dash != std::string_view::npos && is_number(name.substr(0, dash)) && is_number(name.substr(dash + 1));
}

}  // namespace swivel::tools
