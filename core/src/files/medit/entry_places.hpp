#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_source.hpp>

#include "files/checks/conflicts.hpp"

/// What holds of the entries of a Medit file, text or binary, and how one that is wrong is named.
namespace octetra {

/// The sections that a mesh is made of beside its vertices.
enum class Listed { cells, facets, edges };

/// What messages call an entry.
[[nodiscard]] std::string_view entry_name(Listed list);

/// Where the entries of a file stand. Entries are counted from 0.
class EntryPlaces {
public:
    EntryPlaces() = default;
    virtual ~EntryPlaces() = default;
    EntryPlaces(const EntryPlaces&) = delete;
    EntryPlaces& operator=(const EntryPlaces&) = delete;
    EntryPlaces(EntryPlaces&&) = delete;
    EntryPlaces& operator=(EntryPlaces&&) = delete;

    /// Throws InputError that names the entry and says `what`.
    [[noreturn]] virtual void fail_entry(Listed list, std::uint64_t entry,
                                         std::string_view what) const = 0;
    /// The lines of entries, as far as they have some.
    [[nodiscard]] virtual LineOf lines_of(Listed list) const = 0;
};

/// How many entities there are of each kind, by the sections of a file, text or binary.
[[nodiscard]] MeshFacts counts_of(const auto& sections) {
    MeshFacts counts{.vertices = sections.vertices.count,
                     .cells = sections.tetrahedra.count,
                     .facets = sections.triangles.count,
                     .edges = sections.edges.count};
    for (const Feature f : all_features) counts.features[f] = sections.features[f].count;
    return counts;
}

/// Of how many entities the numbers of a feature are, and what messages call one.
struct Numbered {
    std::uint64_t count = 0;
    std::string_view name;
};
[[nodiscard]] Numbered numbered_by(Feature feature, const MeshFacts& counts);

/// "there is no edge 5: the file has 4"
[[nodiscard]] std::string no_such_entity(const Numbered& numbered, std::int64_t number);
/// "there is no vertex 5: the file has 4"
[[nodiscard]] std::string no_such_vertex(std::int64_t number, std::uint64_t vertices);

/// Checks a mesh that was read, as far as the options ask for it: vertex numbers, orientation, what
/// is listed twice, facets and edges of no cell. Turns inverted cells round if asked to, and notes
/// how many. `are_in_range`: numbers of vertices have been checked.
void check_listed(Mesh& mesh, const ReadOptions& options, const std::filesystem::path& path,
                  const EntryPlaces& places, bool are_in_range);

}  // namespace octetra
