#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <octetra/core/files/mesh_sink.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra {

/// A kind of listed entity: where a mesh has it, and how a sink is told of it.
template <class I, std::size_t N>
struct ListedKind {
    IndexVector<I, std::array<VertexIndex, N>> Mesh::*list;
    IndexVector<I, Marker> Mesh::*markers;
    std::uint64_t MeshFacts::*count;
    bool MeshFacts::*has_markers;
    void (MeshSink::*expect)(std::uint64_t, bool);
    void (MeshSink::*take)(std::span<const std::array<VertexIndex, N>>, std::span<const Marker>);
};

inline constexpr ListedKind<CellIndex, 4> cell_kind{&Mesh::cells,
                                                    &Mesh::regions,
                                                    &MeshFacts::cells,
                                                    &MeshFacts::has_regions,
                                                    &MeshSink::expect_cells,
                                                    &MeshSink::take_cells};
inline constexpr ListedKind<FacetIndex, 3> facet_kind{&Mesh::facets,
                                                      &Mesh::facet_markers,
                                                      &MeshFacts::facets,
                                                      &MeshFacts::has_facet_markers,
                                                      &MeshSink::expect_facets,
                                                      &MeshSink::take_facets};
inline constexpr ListedKind<EdgeIndex, 2> edge_kind{&Mesh::edges,
                                                    &Mesh::edge_markers,
                                                    &MeshFacts::edges,
                                                    &MeshFacts::has_edge_markers,
                                                    &MeshSink::expect_edges,
                                                    &MeshSink::take_edges};

/// Which entities are told to the sink. The others are counted, and forgotten.
enum class Told { everything, points, all_but_points, nothing };

/// What a parser fills, entity by entity: a whole mesh or, where there is a sink, one stretch of it
/// after the other, each told to the sink as soon as it is full, and then forgotten.
class GrowingMesh {
public:
    /// `zeros_are_none`: markers that are all 0 say that the file has none.
    GrowingMesh(MeshSink* sink, bool zeros_are_none, Told told = Told::everything)
        : sink_(sink), zeros_are_none_(zeros_are_none), told_(told) {}

    /// The parser appends here; calls of ..._complete() tell that it has done so.
    Mesh mesh;

    void expect_points(std::uint64_t count, std::size_t attributes, bool has_markers);
    void point_complete() {
        if (mesh.points.size() == points_stretch_) tell_points();
    }
    /// No more points.
    void points_complete() { tell_points(); }

    template <class I, std::size_t N>
    void expect(const ListedKind<I, N>& kind, std::uint64_t count, bool has_markers);
    template <class I, std::size_t N>
    void entity_complete(const ListedKind<I, N>& kind) {
        if ((mesh.*kind.list).size() == listed_stretch_) tell(kind);
    }
    /// No more of this kind.
    template <class I, std::size_t N>
    void all_complete(const ListedKind<I, N>& kind) {
        tell(kind);
    }

    /// What the sink is told from now on.
    void tell_only(Told told) { told_ = told; }
    [[nodiscard]] Told told() const { return told_; }

    /// The file is good: drops markers that are none, or tells the sink of the end.
    void finish();

    [[nodiscard]] MeshSink* sink() const { return sink_; }
    [[nodiscard]] bool is_streaming() const { return sink_ != nullptr; }
    /// What was announced up to now.
    [[nodiscard]] const MeshFacts& facts() const { return facts_; }

private:
    static constexpr std::size_t no_end = std::numeric_limits<std::size_t>::max();

    [[nodiscard]] bool tells_points() const {
        return told_ == Told::everything || told_ == Told::points;
    }
    [[nodiscard]] bool tells_others() const {
        return told_ == Told::everything || told_ == Told::all_but_points;
    }
    /// Whether the file has markers, after all that came.
    [[nodiscard]] bool means_something(const std::vector<Marker>& markers) const;
    void tell_points();
    template <class I, std::size_t N>
    void tell(const ListedKind<I, N>& kind);

    MeshSink* sink_;
    bool zeros_are_none_;
    Told told_;
    std::size_t points_stretch_ = no_end;
    std::size_t listed_stretch_ = no_end;
    MeshFacts facts_;
};

}  // namespace octetra
