#include "distributed/failing_allocations.hpp"

#include <cstddef>
#include <cstdlib>
#include <new>

using octetra::test::allocations_left;
using octetra::test::never;
using octetra::test::refuses_only_one;

namespace {

void* allocate(std::size_t size) {
    if (allocations_left == 0) {
        if (refuses_only_one) allocations_left = never;
        throw std::bad_alloc();
    }
    if (allocations_left > 0) --allocations_left;
    void* const memory = std::malloc(size == 0 ? 1 : size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
