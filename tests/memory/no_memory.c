/* SPDX-License-Identifier: MIT
 *
 * Preloaded, it is a machine that lacks memory. With SWIVEL_LACKS=N the N-th request for memory fails, counted from 1;
 * with SWIVEL_LACKS=N- that one and all after it do. The file SWIVEL_REQUESTS gets the number of requests, if the
 * process ends by exit(). */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

static atomic_ulong requests;

/* What the loader asks for before there is an environment is given and not counted. */
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
