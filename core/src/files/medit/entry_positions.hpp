#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>

#include "files/checks/conflicts.hpp"

/// Checks of the entries of a Medit file, text or binary, and the messages for erroneous ones.
namespace octetra {

/// The sections of a mesh other than its vertices.
enum class Listed { cells, facets, edges };

/// Returns the name of an entry in messages.
[[nodiscard]] std::string_view entry_name(Listed list);

/// The positions of the entries in a file. Entries are counted from 0.
class EntryPositions {
public:
    EntryPositions() = default;
    virtual ~EntryPositions() = default;
    EntryPositions(const EntryPositions&) = delete;
    EntryPositions& operator=(const EntryPositions&) = delete;
    EntryPositions(EntryPositions&&) = delete;
    EntryPositions& operator=(EntryPositions&&) = delete;

    /// Throws InputError that names the entry, followed by `what`.
    [[noreturn]] virtual void fail_entry(Listed list, std::uint64_t entry,
                                         std::string_view what) const = 0;
    /// Returns the lines of entries, as far as they have any.
    [[nodiscard]] virtual LineOf lines_of(Listed list) const = 0;
};

/// Returns the number of entities of each kind, from the sections of a file, text or binary.
[[nodiscard]] MeshFacts counts_of(const auto& sections) {
    MeshFacts counts{.vertices = sections.vertices.count,
                     .cells = sections.tetrahedra.count,
                     .facets = sections.triangles.count,
                     .edges = sections.edges.count};
    for (const Feature f : all_features) counts.features[f] = sections.features[f].count;
    return counts;
}

/// The entities to which the numbers of a feature refer: their count and their name in messages.
struct Numbered {
    std::uint64_t count = 0;
    std::string_view name;
};
[[nodiscard]] Numbered numbered_by(Feature feature, const MeshFacts& counts);

/// Returns "there is no edge 5: the file has 4".
[[nodiscard]] std::string no_such_entity(const Numbered& numbered, std::int64_t number);
/// Returns "there is no vertex 5: the file has 4".
[[nodiscard]] std::string no_such_vertex(std::int64_t number, std::uint64_t vertices);

/// Performs the checks that the options request: vertex numbers, orientation, repeated entities,
/// facets and edges that belong to no cell. If requested, reverses inverted cells and notes their
/// number. `are_in_range`: vertex numbers have already been checked.
void check_listed(Mesh& mesh, const ReadOptions& options, const std::filesystem::path& path,
                  const EntryPositions& places, bool are_in_range);

}  // namespace octetra
