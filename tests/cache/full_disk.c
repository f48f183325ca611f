/* SPDX-License-Identifier: MIT
 *
 * Preloaded, it is a disk that gets full: after SWIVEL_DISK_BYTES bytes, each write to a file fails with ENOSPC. What
 * was still on the disk is written, as a real disk does it. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static atomic_llong written;

ssize_t write(int file, const void* bytes, size_t count)
{
    ssize_t (*const real)(int, const void*, size_t) = (ssize_t(*)(int, const void*, size_t))dlsym(RTLD_NEXT, "write");
    struct stat status;
    if (fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return real(file, bytes, count);
    const long long room = atoll(getenv("SWIVEL_DISK_BYTES")) - atomic_fetch_add(&written, (long long)count);
    if (room <= 0) {
        errno = ENOSPC;
        return -1;
    }
    return real(file, bytes, room < (long long)count ? (size_t)room : count);
}
