#pragma once

#include <cstddef>

namespace octetra {

/// Advises the system to back this memory with huge pages, before it is first written to. A level
/// writes as much new memory as its result takes; faulting it in by pages of 4 KiB takes as long as
/// the refinement. Has no effect on ranges without a whole huge page, or if the system does not
/// support it.
void prefer_huge_pages(void* memory, std::size_t bytes);

/// Calls reserve() for a list that is about to be filled.
template <class Vector>
void reserve_in_huge_pages(Vector& list, std::size_t count) {
    if (count <= list.capacity()) return;
    list.reserve(count);
    const std::size_t used = list.size();
    prefer_huge_pages(list.data() + used,
                      (list.capacity() - used) * sizeof(typename Vector::value_type));
}

/// Same for a list that grows gradually: reserves half as much again, which occupies no memory
/// until it is used.
template <class Vector>
void reserve_with_room(Vector& list, std::size_t count) {
    reserve_in_huge_pages(list, count + count / 2);
}

/// Ensures capacity for `count` entries, so that appending them cannot fail. May reserve more, so
/// that a growing list is not moved each time.
template <class Vector>
void make_room(Vector& list, std::size_t count) {
    if (count > list.capacity()) reserve_with_room(list, count);
}

}  // namespace octetra
