// SPDX-License-Identifier: MIT
#include "tools/formats/partial.h"

#include <dirent.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <utility>

namespace swivel::formats {
namespace {

std::mutex list_mutex;
Partial* all_partials = nullptr;
constexpr int kMaxRounds = 100;

// While the lock is held, nothing allocates and signals are blocked, so a handler never waits for its own thread.
sigset_t lock_list() noexcept
{
    sigset_t all, before;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    list_mutex.lock();
    return before;
}

struct ListLock {
    sigset_t before = lock_list();
    ~ListLock()
    {
        list_mutex.unlock();
        ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    }
};

bool remove_at(int folder, const char* name) noexcept;

// Removes a folder's contents as far as possible, without std::filesystem::remove_all(), which allocates.
void empty_folder(int folder) noexcept
{
    alignas(dirent64) std::array<char, 4096> entries;
    bool is_going_on = true;
    // Removing may move entries past the place of reading, so the folder is listed again. The number of rounds is
    // bounded, so that the process ends.
    for (int round = 0; is_going_on && round < kMaxRounds; ++round) {
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

// Returns false if it could not be removed.
bool remove_at(int folder, const char* name) noexcept
{
    if (::unlinkat(folder, name, 0) == 0 || errno == ENOENT) return true;
    if (errno != EISDIR && errno != EPERM) return false;
    const int inner = ::openat(folder, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (inner < 0) return false;
    empty_folder(inner);
    ::close(inner);
    return ::unlinkat(folder, name, AT_REMOVEDIR) == 0;
}

}  // namespace

Partial::Partial(int folder) : folder_(folder)
{
    const ListLock lock;
    next_ = std::exchange(all_partials, this);
}

Partial::~Partial()
{
    const ListLock lock;
    remove_locked();
    Partial** place = &all_partials;
    while (*place != this) place = &(*place)->next_;
    *place = next_;
}

int Partial::make(const std::filesystem::path& folder, const std::function<int(const char*)>& create)
{
    for (int n = 0;; ++n) {
        std::string name = (folder / fmt::format(".swivel-{}-{}", ::getpid(), n)).string();
        const ListLock lock;  // so that whatever is there has an owner that remove_all() sees
        const int made = create(name.c_str());
        if (made < 0 && errno == EEXIST) continue;
        if (made >= 0) name_ = std::move(name);
        return made;
    }
}

bool Partial::rename(const std::filesystem::path& target) noexcept
{
    const ListLock lock;
    if (::renameat(folder_, name_.c_str(), folder_, target.c_str()) != 0) return false;
    name_.clear();
    return true;
}

void Partial::remove() noexcept
{
    const ListLock lock;
    remove_locked();
}

void Partial::remove_locked() noexcept
{
    if (!name_.empty()) remove_at(folder_, name_.c_str());
    name_.clear();
}

void Partial::remove_all() noexcept
{
    lock_list();
    for (Partial* each = all_partials; each; each = each->next_) each->remove_locked();
}

}  // namespace swivel::formats
