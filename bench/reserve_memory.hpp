#pragma once

#include <malloc.h>
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace octetra::bench {

/// Allocates this amount of memory from the system, writes to all of it, and keeps it in the heap
/// for later allocations of this process, as in a program that refines repeatedly. Otherwise the
/// time of a single level is dominated by page faults. Not collective.
inline void reserve_memory(std::size_t bytes) {
    ::mallopt(M_MMAP_MAX, 0);         // everything from the heap ...
    ::mallopt(M_TRIM_THRESHOLD, -1);  // ... which never shrinks
    void* const memory = std::malloc(bytes);
    if (memory == nullptr) return;
    constexpr std::uintptr_t huge_page = std::uintptr_t{1} << 21U;
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::size_t to_boundary = (huge_page - begin % huge_page) % huge_page;
    if (bytes > to_boundary) {
        (void)::madvise(static_cast<char*>(memory) + to_boundary, bytes - to_boundary,
                        MADV_HUGEPAGE);
    }
    std::memset(memory, 1, bytes);
    asm volatile("" : : "r"(memory) : "memory");  // so that it is not optimised away
    std::free(memory);
}

}  // namespace octetra::bench
