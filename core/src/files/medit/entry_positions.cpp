#include "files/medit/entry_positions.hpp"

#include <span>

#include <fmt/format.h>

#include <octetra/core/repeated_cells.hpp>

#include "files/checks/cell_check.hpp"
#include "files/checks/tagged_entities.hpp"

namespace octetra {
namespace {

/// Returns whether the vertices of an entity are less than `vertices` and distinct. Evaluated
/// without a branch for each vertex, because nearly all entities are valid.
template <std::size_t N>
bool is_sound(const std::array<VertexIndex, N>& entity, VertexIndex vertices) {
    bool sound = true;
    for (std::size_t k = 0; k < N; ++k) {
        sound &= entity[k] < vertices;
        for (std::size_t j = 0; j < k; ++j) sound &= entity[j] != entity[k];
    }
    return sound;
}

class MeshCheck {
public:
    MeshCheck(Mesh& mesh, const ReadOptions& options, const std::filesystem::path& path,
              const EntryPositions& places)
        : mesh_(&mesh), options_(&options), path_(&path), places_(&places) {}

    void check(bool are_in_range) {
        if (!are_in_range) check_vertices(mesh_->cells, Listed::cells);
        check_cells();
        check_vertices(mesh_->facets, Listed::facets);
        check_vertices(mesh_->edges, Listed::edges);
        if (options_->only_syntax) return;
        if (mesh_->cells.empty() && !mesh_->facets.empty()) {
            places_->fail_entry(Listed::facets, 0,
                                "there are triangles and no tetrahedra: the volume is not meshed");
        }
        const WrongFacets wrong = find_wrong_facets(*mesh_);
        if (const CellIndex cell = wrong.overlap.cell; !cell.is_none()) {
            places_->fail_entry(Listed::cells, cell.value(),
                                describe_overlap(wrong, *mesh_, places_->lines_of(Listed::cells)));
        }
        refuse_if_wrong(wrong.tagged, Listed::facets, mesh_->facet_markers);
        refuse_if_wrong(find_wrong_edge(*mesh_), Listed::edges, mesh_->edge_markers);
    }

private:
    template <class I, std::size_t N>
    void check_vertices(const IndexVector<I, std::array<VertexIndex, N>>& list, Listed which) {
        const VertexIndex vertices = mesh_->points.end_index();
        for (I i{0}; i < list.end_index(); ++i) {
            if (is_sound(list[i], vertices)) continue;
            for (std::size_t k = 0; k < N; ++k) {
                if (list[i][k] >= vertices) {
                    places_->fail_entry(
                        which, i.value(),
                        no_such_vertex(std::int64_t{list[i][k].value()} + 1, mesh_->points.size()));
                }
                for (std::size_t j = 0; j < k; ++j) {
                    if (list[i][j] != list[i][k] || options_->only_syntax) continue;
                    places_->fail_entry(
                        which, i.value(),
                        fmt::format("the {} has the same vertex twice", entry_name(which)));
                }
            }
        }
    }

    void check_cells() {
        CellCheck check(*mesh_, *options_);
        RepeatedCells repeated(options_->only_syntax ? 0 : mesh_->cells.size());
        const auto [cell, wrong] = check.check_entities(std::span(mesh_->cells));
        if (!wrong.empty()) places_->fail_entry(Listed::cells, cell, wrong);
        if (!options_->only_syntax) {
            for (const CellVertices& vertices : mesh_->cells) repeated.add(vertices);
        }
        if (check.fixed_count() > 0) {
            options_->note(fmt::format("{}: {} inverted cells were reversed", path_->native(),
                                       check.fixed_count()));
        }
        if (const CellPair pair = repeated.find(mesh_->cells, mesh_->points.size());
            !pair.cell.is_none()) {
            places_->fail_entry(Listed::cells, pair.cell.value(),
                                describe_repeated(pair, *mesh_, places_->lines_of(Listed::cells)));
        }
    }

    template <class I>
    void refuse_if_wrong(const WrongEntry<I>& wrong, Listed which,
                         const IndexVector<I, Marker>& markers) const {
        if (wrong.entry.is_none()) return;
        places_->fail_entry(
            which, wrong.entry.value(),
            describe_wrong(wrong, entry_name(which), markers, *mesh_, places_->lines_of(which)));
    }

    Mesh* mesh_;
    const ReadOptions* options_;
    const std::filesystem::path* path_;
    const EntryPositions* places_;
};

}  // namespace

std::string_view entry_name(Listed list) {
    switch (list) {
        case Listed::cells: return "cell";
        case Listed::facets: return "triangle";
        case Listed::edges: break;
    }
    return "edge";
}

Numbered numbered_by(Feature feature, const MeshFacts& counts) {
    switch (dimension_of(feature)) {
        case 0: return {counts.vertices, "vertex"};
        case 1: return {counts.edges, entry_name(Listed::edges)};
        case 2: return {counts.facets, entry_name(Listed::facets)};
        default: return {counts.cells, entry_name(Listed::cells)};
    }
}

std::string no_such_entity(const Numbered& numbered, std::int64_t number) {
    return fmt::format("there is no {} {}: the file has {}", numbered.name, number, numbered.count);
}

std::string no_such_vertex(std::int64_t number, std::uint64_t vertices) {
    return no_such_entity({vertices, "vertex"}, number);
}

void check_listed(Mesh& mesh, const ReadOptions& options, const std::filesystem::path& path,
                  const EntryPositions& places, bool are_in_range) {
    MeshCheck(mesh, options, path, places).check(are_in_range);
}

}  // namespace octetra
