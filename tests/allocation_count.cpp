// SPDX-License-Identifier: MIT
//
// Replaces malloc and its relatives in the program it is linked into, or hooks the sanitizer's.
#include "tests/allocation_count.h"

#include <atomic>
#include <cerrno>
#include <cstdlib>

#if defined(__SANITIZE_THREAD__)
#include <malloc.h>
#endif

#if defined(__x86_64__)
#include <mm_malloc.h>  // clang's declares posix_memalign without noexcept, which it allows before a definition only
#endif

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// As in <sanitizer/allocator_interface.h>, which g++'s package leaves out.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                                         void (*on_free)(const volatile void*));
#endif

namespace swivel::test {
namespace {
std::atomic<std::size_t> allocations{0};
}
}  // namespace swivel::test

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)

namespace swivel::test {
std::size_t allocation_count()
{
    static const int hooked = __sanitizer_install_malloc_and_free_hooks(
        [](const volatile void*, std::size_t) { ++allocations; }, [](const volatile void*) {});
    (void)hooked;
    return allocations;
}
}  // namespace swivel::test

#if defined(__SANITIZE_THREAD__)
// The thread sanitizer's hook sees no aligned allocation.
#pragma GCC visibility push(default)
extern "C" void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept
{
    ++swivel::test::allocations;
    return memalign(alignment, bytes);
}
#pragma GCC visibility pop
#endif

#else

namespace swivel::test {
std::size_t allocation_count() { return allocations; }
bool (*allocation_fails)() = nullptr;

namespace {
bool is_given()
{
    ++allocations;
    return !allocation_fails || !allocation_fails();
}
}  // namespace
}  // namespace swivel::test

// glibc's own, under the names it keeps for those who replace malloc. Visible, so that libraries take these, too.
#pragma GCC visibility push(default)
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t bytes) noexcept { return swivel::test::is_given() ? __libc_malloc(bytes) : nullptr; }
void* calloc(std::size_t count, std::size_t bytes) noexcept
{
    return swivel::test::is_given() ? __libc_calloc(count, bytes) : nullptr;
}
void* realloc(void* memory, std::size_t bytes) noexcept
{
    return swivel::test::is_given() ? __libc_realloc(memory, bytes) : nullptr;
}
void* memalign(std::size_t alignment, std::size_t bytes) noexcept
{
    return swivel::test::is_given() ? __libc_memalign(alignment, bytes) : nullptr;
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept
{
    return swivel::test::is_given() ? __libc_memalign(alignment, bytes) : nullptr;
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) noexcept
{
    if (!swivel::test::is_given()) return ENOMEM;
    *memory = __libc_memalign(alignment, bytes);
    return *memory ? 0 : ENOMEM;
}
}
#pragma GCC visibility pop

#endif
