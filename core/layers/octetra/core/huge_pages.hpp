#pragma once

#include <cstddef>

namespace octetra {

/// Asks the system to back this memory with huge pages where it leaves that to programs, before the
/// memory is first written to. A level writes to as much new memory as its result takes, and being
/// given it 4 KiB at a time takes as long as the refinement. Does nothing to small pieces; where
/// the wish is not granted nothing is lost.
void prefer_huge_pages(void* memory, std::size_t bytes);

/// reserve() for what is about to be filled.
template <class Vector>
void reserve_in_huge_pages(Vector& list, std::size_t count) {
    if (count <= list.capacity()) return;
    list.reserve(count);
    const std::size_t used = list.size();
    prefer_huge_pages(list.data() + used,
                      (list.capacity() - used) * sizeof(typename Vector::value_type));
}

/// The same for a list that is going to grow little by little: with room for half as many more,
/// which takes no memory before it is used.
template <class Vector>
void reserve_with_room(Vector& list, std::size_t count) {
    reserve_in_huge_pages(list, count + count / 2);
}

/// Room for so many entries, if there is not: from then on no failure keeps the list from having
/// them. May make room for more, so that a list that grows is not moved each time.
template <class Vector>
void make_room(Vector& list, std::size_t count) {
    if (count > list.capacity()) reserve_with_room(list, count);
}

}  // namespace octetra
