// SPDX-License-Identifier: MIT
// getdents64() and strerrordesc_np() take no memory; they need glibc 2.32.
#include "tools/formats/partial.h"

#include <dirent.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <utility>

namespace swivel::formats {
namespace {

std::mutex list_mutex;  // nothing takes memory while it is held
Partial* all_partials = nullptr;
constexpr int kMostRounds = 100;
std::array<char, 512> unremoved_buffer;
std::atomic<const char*> unremoved_text{""};  // set once, so any thread may read it at any time

bool remove_at(int folder, const char* name) noexcept;

// Removes what is in a folder, as far as it can be. std::filesystem::remove_all() asks for memory.
void empty_folder(int folder) noexcept
{
    alignas(dirent64) std::array<char, 4096> entries;
    bool is_going_on = true;
    // Removing may move entries past the place of reading. A listing that lags behind must not keep the process.
    for (int round = 0; is_going_on && round < kMostRounds; ++round) {
        is_going_on = false;
        ::lseek(folder, 0, SEEK_SET);
        for (ssize_t size; (size = ::getdents64(folder, entries.data(), entries.size())) > 0;)
            for (ssize_t at = 0; at < size;) {
                const auto* const entry = reinterpret_cast<const dirent64*>(entries.data() + at);
                at += entry->d_reclen;
                const std::string_view name = entry->d_name;
                if (name != "." && name != ".." && remove_at(folder, entry->d_name)) is_going_on = true;
            }
    }
}

// False: errno says why.
bool remove_at(int folder, const char* name) noexcept
{
    if (::unlinkat(folder, name, 0) == 0 || errno == ENOENT) return true;
    const int reason = errno;
    if (reason != EISDIR && reason != EPERM) return false;
    const int inner = ::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (inner < 0) {
        errno = reason;  // of a plain file that may not be removed
        return false;
    }
    empty_folder(inner);
    ::close(inner);
    return ::unlinkat(folder, name, AT_REMOVEDIR) == 0;
}

}  // namespace

Partial::Partial(int folder) : folder_(folder)
{
    const std::lock_guard lock(list_mutex);
    next_ = std::exchange(all_partials, this);
}

Partial::~Partial()
{
    const std::lock_guard lock(list_mutex);
    remove_locked();
    Partial** place = &all_partials;
    while (*place != this) place = &(*place)->next_;
    *place = next_;
}

int Partial::make(const std::filesystem::path& folder, const std::function<int(const char*)>& create)
{
    for (int n = 0;; ++n) {
        std::string name = (folder / fmt::format(".swivel-{}-{}", ::getpid(), n)).string();
        const std::lock_guard lock(list_mutex);  // so that whatever is there has an owner that remove_all() sees
        const int made = create(name.c_str());
        if (made < 0 && errno == EEXIST) continue;
        if (made >= 0) name_ = std::move(name);
        return made;
    }
}

bool Partial::rename(const std::filesystem::path& target) noexcept
{
    const std::lock_guard lock(list_mutex);
    if (::renameat(folder_, name_.c_str(), folder_, target.c_str()) != 0) return false;
    name_.clear();
    return true;
}

void Partial::remove() noexcept
{
    const std::lock_guard lock(list_mutex);
    remove_locked();
}

void Partial::remove_locked() noexcept
{
    if (!name_.empty() && !remove_at(folder_, name_.c_str()) && unremoved().empty()) {
        std::snprintf(unremoved_buffer.data(), unremoved_buffer.size(), "%s cannot be removed: %s", name_.c_str(),
                      ::strerrordesc_np(errno));
        unremoved_text = unremoved_buffer.data();
    }
    name_.clear();
}

void Partial::remove_all() noexcept
{
    const std::lock_guard lock(list_mutex);
    for (Partial* each = all_partials; each; each = each->next_) each->remove_locked();
}

std::string_view Partial::unremoved() noexcept { return unremoved_text.load(); }

}  // namespace swivel::formats
