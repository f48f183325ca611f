// SPDX-License-Identifier: MIT
//
// The reader of tables takes a window of 48 MiB each time, whose shadow the address sanitizer paints each time anew: a
// hundredth of the speed. Here such a block is kept, and given again to who asks next for as many bytes.
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

constexpr std::size_t kLarge = std::size_t{1} << 24;

struct Kept {
    void* memory;
    std::size_t bytes;
    bool is_taken;
} kept;

}  // namespace

void* operator new[](std::size_t bytes)
{
    const bool is_fitting = bytes >= kLarge && !kept.is_taken && (!kept.memory || kept.bytes == bytes);
    if (is_fitting && kept.memory) return kept.is_taken = true, kept.memory;
    void* const memory = std::malloc(bytes);
    if (!memory) throw std::bad_alloc();
    if (is_fitting) kept = {memory, bytes, true};
    return memory;
}

void operator delete[](void* memory) noexcept
{
    if (memory && memory == kept.memory)
        kept.is_taken = false;
    else
        std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept { operator delete[](memory); }
