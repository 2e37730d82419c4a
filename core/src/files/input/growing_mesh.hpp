#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <octetra/core/files/mesh_sink.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/mesh_share.hpp>
#include <octetra/core/process_group.hpp>

namespace octetra {

/// A kind of entity (cells, tagged facets or edges): its members in a mesh, and its functions of a
/// sink.
template <class I, std::size_t N>
struct EntityKind {
    IndexVector<I, std::array<VertexIndex, N>> Mesh::*list;
    IndexVector<I, Marker> Mesh::*markers;
    std::uint64_t MeshFacts::*count;
    bool MeshFacts::*has_markers;
    void (MeshSink::*expect)(std::uint64_t, bool);
    void (MeshSink::*take)(std::span<const std::array<VertexIndex, N>>, std::span<const Marker>);
};

inline constexpr EntityKind<CellIndex, 4> cell_kind{&Mesh::cells,
                                                    &Mesh::regions,
                                                    &MeshFacts::cells,
                                                    &MeshFacts::has_regions,
                                                    &MeshSink::expect_cells,
                                                    &MeshSink::take_cells};
inline constexpr EntityKind<FacetIndex, 3> facet_kind{&Mesh::facets,
                                                      &Mesh::facet_markers,
                                                      &MeshFacts::facets,
                                                      &MeshFacts::has_facet_markers,
                                                      &MeshSink::expect_facets,
                                                      &MeshSink::take_facets};
inline constexpr EntityKind<EdgeIndex, 2> edge_kind{&Mesh::edges,
                                                    &Mesh::edge_markers,
                                                    &MeshFacts::edges,
                                                    &MeshFacts::has_edge_markers,
                                                    &MeshSink::expect_edges,
                                                    &MeshSink::take_edges};

/// The entities that are passed to the sink. Others are counted and dropped.
enum class Streamed { everything, points, all_but_points, nothing };

/// The target of a parser, filled entity by entity: a whole mesh; the share of one process of a
/// group; or, with a sink, one block at a time, which is passed to the sink when it is full, and
/// then dropped.
class GrowingMesh {
public:
    /// `zeros_are_none`: if all markers are 0, the file has no markers.
    explicit GrowingMesh(bool zeros_are_none, const ProcessGroup& group = ProcessGroup::alone())
        : zeros_are_none_(zeros_are_none), group_(&group) {}
    GrowingMesh(bool zeros_are_none, MeshSink& sink)
        : sink_(&sink), zeros_are_none_(zeros_are_none) {}

    /// The parser appends here, and calls the ..._complete() functions afterwards.
    Mesh mesh;

    /// The group that reads the mesh. If it has several processes, each reads a share of the
    /// entities; counts are those of the whole mesh.
    [[nodiscard]] const ProcessGroup& group() const { return *group_; }
    [[nodiscard]] bool is_share() const { return group_->size() > 1; }

    /// `room`: the number of points for which memory is reserved, if fewer than `count`.
    void expect_points(std::uint64_t count, std::size_t attributes, bool has_markers,
                       std::uint64_t room = no_end);
    void point_complete() {
        if (mesh.points.size() == points_per_block_) flush_points();
    }
    /// Returns how many points may be appended before point_complete() must be called.
    [[nodiscard]] std::size_t room_for_points() const {
        return points_per_block_ - mesh.points.size();
    }
    /// To be called after the last point.
    void points_complete() { flush_points(); }

    template <class I, std::size_t N>
    void expect(const EntityKind<I, N>& kind, std::uint64_t count, bool has_markers,
                std::uint64_t room = no_end);
    template <class I, std::size_t N>
    void entity_complete(const EntityKind<I, N>& kind) {
        if ((mesh.*kind.list).size() == entities_per_block_) flush(kind);
    }
    template <class I, std::size_t N>
    [[nodiscard]] std::size_t room_for(const EntityKind<I, N>& kind) const {
        return entities_per_block_ - (mesh.*kind.list).size();
    }
    /// To be called after the last entity of this kind.
    template <class I, std::size_t N>
    void all_complete(const EntityKind<I, N>& kind) {
        flush(kind);
    }
    /// Collective. To be called after the last entity of a kind whose count was not announced;
    /// without effect if a sink takes the mesh.
    template <class I, std::size_t N>
    void count_complete(const EntityKind<I, N>& kind) {
        if (!is_streaming()) facts_.*kind.count = group_->sum((mesh.*kind.list).size());
    }

    /// Sets the entities that are passed to the sink from now on.
    void stream_only(Streamed streamed) { streamed_ = streamed; }
    [[nodiscard]] Streamed streamed() const { return streamed_; }

    /// Announces the entities with a feature, whose numbers are not passed to a sink.
    void expect_numbers(Feature feature, std::uint64_t count, std::uint64_t room = no_end);

    /// To be called after successful parsing if a sink takes the mesh.
    void finish_sink();
    /// Collective. To be called after successful parsing otherwise: returns what this process has
    /// read, without markers that do not count.
    [[nodiscard]] MeshShare finish();

    [[nodiscard]] MeshSink* sink() const { return sink_; }
    [[nodiscard]] bool is_streaming() const { return sink_ != nullptr; }
    /// The counts announced so far.
    [[nodiscard]] const MeshFacts& facts() const { return facts_; }

private:
    static constexpr std::size_t no_end = std::numeric_limits<std::size_t>::max();

    [[nodiscard]] bool streams_points() const {
        return streamed_ == Streamed::everything || streamed_ == Streamed::points;
    }
    [[nodiscard]] bool streams_others() const {
        return streamed_ == Streamed::everything || streamed_ == Streamed::all_but_points;
    }
    void flush_points();
    template <class I, std::size_t N>
    void flush(const EntityKind<I, N>& kind);

    MeshSink* sink_ = nullptr;
    bool zeros_are_none_;
    const ProcessGroup* group_ = &ProcessGroup::alone();
    Streamed streamed_ = Streamed::everything;
    std::size_t points_per_block_ = no_end;
    std::size_t entities_per_block_ = no_end;
    MeshFacts facts_;
};

}  // namespace octetra
