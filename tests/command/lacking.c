/* SPDX-License-Identifier: MIT
 *
 * Preloaded, it is a machine that lacks something, as the environment says.
 * SWIVEL_LACKS=N: the N-th request for memory fails, counted from 1. SWIVEL_LACKS=N-: that one and all after it do. The
 * file SWIVEL_REQUESTS gets the number of requests, if the process ends by exit().
 * SWIVEL_DISK_BYTES=N: after N bytes, each write to a file fails with ENOSPC. The bytes that the disk still has room
 * for are written, as a real disk does it. SWIVEL_NO_THREADS: a process that starts a thread ends with exit code 99. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);
extern ssize_t __write(int, const void*, size_t);

static atomic_ulong requests;
static atomic_llong written;

/* The loader gets all that it asks for before there is an environment, and nobody counts it. */
static int is_refused(void)
{
    if (!environ) return 0;
    const char* const lacks = getenv("SWIVEL_LACKS");
    const unsigned long request = atomic_fetch_add(&requests, 1) + 1;
    if (!lacks) return 0;
    char* end;
    const unsigned long first = strtoul(lacks, &end, 10);
    const int fails = *end == '-' ? request >= first : request == first;
    if (fails) errno = ENOMEM;
    return fails;
}

void* malloc(size_t size) { return is_refused() ? NULL : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return is_refused() ? NULL : __libc_calloc(count, size); }
void* realloc(void* old, size_t size) { return is_refused() ? NULL : __libc_realloc(old, size); }
void* memalign(size_t alignment, size_t size) { return is_refused() ? NULL : __libc_memalign(alignment, size); }
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }

int posix_memalign(void** to, size_t alignment, size_t size)
{
    void* const memory = memalign(alignment, size);
    if (!memory) return ENOMEM;
    *to = memory;
    return 0;
}

__attribute__((destructor)) static void tell(void)
{
    const char* const name = getenv("SWIVEL_REQUESTS");
    const int file = name ? open(name, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1;
    if (file >= 0) dprintf(file, "%lu\n", atomic_load(&requests));
}

ssize_t write(int file, const void* bytes, size_t count)
{
    const char* const disk = getenv("SWIVEL_DISK_BYTES");
    struct stat status;
    if (!disk || fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return __write(file, bytes, count);
    const long long room = atoll(disk) - atomic_fetch_add(&written, (long long)count);
    if (room <= 0) {
        errno = ENOSPC;
        return -1;
    }
    return __write(file, bytes, room < (long long)count ? (size_t)room : count);
}

typedef int create_thread(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* argument)
{
    if (getenv("SWIVEL_NO_THREADS")) _exit(99);
    return ((create_thread*)dlsym(RTLD_NEXT, "pthread_create"))(thread, attributes, run, argument);
}
