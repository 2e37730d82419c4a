#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <octetra/core/mesh.hpp>

#include "files/input/byte_reader.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/medit/entry_positions.hpp"
#include "files/medit/meshb_layout.hpp"

namespace octetra {

/// Reads rows of `.meshb` sections, and performs the checks that need only the row: coordinates are
/// within limits, vertices exist, references fit into 32 bits. Throws InputError that names the
/// byte offset of the row.
class MeshbRows {
public:
    /// Both arguments must outlive the object.
    MeshbRows(ByteReader& reader, const MeshbLists& lists) : reader_(&reader), lists_(&lists) {
        reader.swap_bytes(lists.format.swapped);
    }

    /// Appends rows first .. first+count-1 of the section, with their references.
    void append_points(std::uint64_t first, std::uint64_t count, Mesh& mesh);
    template <class I, std::size_t N>
    void append(const EntityKind<I, N>& kind, std::uint64_t first, std::uint64_t count, Mesh& mesh);

    /// Appends rows of a feature's section, as numbers counted from 0.
    void append_numbers(Feature feature, std::uint64_t first, std::uint64_t count,
                        std::vector<std::uint64_t>& numbers);

    [[nodiscard]] const MeshbSection& section(Listed list) const;
    /// Throws InputError that names an entry of a section.
    [[noreturn]] void fail_entry(Listed list, std::uint64_t entry, std::string_view what) const;

private:
    template <class Numbers>
    void append_points_of(std::uint64_t first, std::uint64_t count, Mesh& mesh);
    template <class Numbers>
    [[noreturn]] void refuse_point(const std::byte* rows, std::uint64_t first) const;
    template <class Numbers, class I, std::size_t N>
    void append_of(const EntityKind<I, N>& kind, std::uint64_t first, std::uint64_t count,
                   Mesh& mesh);
    template <class Numbers>
    void append_numbers_of(Feature feature, std::uint64_t first, std::uint64_t count,
                           std::vector<std::uint64_t>& numbers);
    template <class Numbers, std::size_t N>
    [[noreturn]] void refuse_entity(const std::byte* rows, std::uint64_t first) const;

    ByteReader* reader_;
    const MeshbLists* lists_;
};

}  // namespace octetra
