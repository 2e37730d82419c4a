#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <octetra/core/error.hpp>

#include "files/gmsh/intake/mesh_intake.hpp"
#include "files/input/growing_mesh.hpp"

namespace octetra::gmsh {

/// A buffer of elements between an Input and a MeshIntake, which takes several elements at once:
/// elements of one kind, with one marker, at equal distances in the file.
template <class Input>
class RowBatch {
public:
    RowBatch(Input& in, MeshIntake& intake) : in_(&in), intake_(&intake) {}

    /// Calls read(), which adds rows, and passes them on. An error in a buffered row is reported
    /// before an error that ended the reading.
    void fill(auto&& read) {
        try {
            read();
        } catch (const InputError&) {
            pass_on();
            throw;
        }
        pass_on();
    }

    /// Returns whether the buffered rows are of this kind. If not, the next row of this kind
    /// overwrites them after they have been passed on.
    template <class I, std::size_t N>
    [[nodiscard]] bool is_of(const EntityKind<I, N>& /*kind*/) const {
        return N == nodes_;
    }
    /// Returns the slot for the node tags of the next row, which is then either added or discarded.
    template <class I, std::size_t N>
    std::array<std::uint64_t, N>& next_row(const EntityKind<I, N>& /*kind*/) {
        if (N != nodes_ || count_ == MeshIntake::most_at_once) pass_on();
        if (N != nodes_) begin(N, 0, 0, 0);
        return rows_of<N>()[count_];
    }
    /// Adds the row in that slot. `place`, `step`: see MeshIntake::take(). Returns its nodes; the
    /// reference stays valid until the next row but one of this kind is written, while the kind
    /// stays the same.
    template <class I, std::size_t N>
    const std::array<std::uint64_t, N>& add(const EntityKind<I, N>& /*kind*/, Marker marker,
                                            std::uint64_t place, std::uint64_t step) {
        const bool continues = marker == marker_ && step == step_ && place == next_place_;
        if (!continues) {
            const auto row = rows_of<N>()[count_];
            pass_on();
            begin(N, marker, place, step);
            rows_of<N>()[0] = row;
        }
        next_place_ = place + step;
        return rows_of<N>()[count_++];
    }

    /// Returns slots for further rows that continue the last one: at `place`, with the same marker
    /// and step. Returns at least one slot, or none if the rows do not continue the last one.
    template <class I, std::size_t N>
    [[nodiscard]] std::span<std::array<std::uint64_t, N>> next_rows(
        const EntityKind<I, N>& /*kind*/, Marker marker, std::uint64_t place, std::uint64_t step) {
        const bool continues =
            N == nodes_ && marker == marker_ && step == step_ && place == next_place_;
        if (!continues) return {};
        if (count_ == MeshIntake::most_at_once) pass_on();
        return std::span(rows_of<N>()).subspan(count_);
    }
    /// Adds `count` >= 1 rows written to these slots. Returns the nodes of the last one; see add().
    template <class I, std::size_t N>
    const std::array<std::uint64_t, N>& add_rows(const EntityKind<I, N>& /*kind*/,
                                                 std::size_t count) {
        count_ += count;
        next_place_ += count * step_;
        return rows_of<N>()[count_ - 1];
    }

private:
    template <std::size_t N>
    using Rows = std::array<std::array<std::uint64_t, N>, MeshIntake::most_at_once>;

    template <std::size_t N>
    Rows<N>& rows_of() {
        if constexpr (N == 4) return cells_;
        if constexpr (N == 3) return facets_;
        if constexpr (N == 2) return edges_;
    }
    void begin(std::size_t nodes, Marker marker, std::uint64_t place, std::uint64_t step) {
        nodes_ = nodes;
        marker_ = marker;
        first_place_ = place;
        step_ = step;
    }
    void pass_on() {
        if (count_ == 0) return;
        if (nodes_ == 4) return pass_on(cell_kind);
        if (nodes_ == 3) return pass_on(facet_kind);
        if (nodes_ == 2) return pass_on(edge_kind);
    }
    template <class I, std::size_t N>
    void pass_on(const EntityKind<I, N>& kind) {
        using Row = std::array<std::uint64_t, N>;
        const std::uint64_t place = first_place_;
        const auto rows = std::span<const Row>(rows_of<N>()).first(std::exchange(count_, 0));
        const RowError wrong = intake_->take(kind, rows, marker_, place, step_);
        first_place_ = next_place_;
        if (!wrong.what.empty()) in_->fail_at(wrong.what, place + wrong.row * step_);
    }

    Input* in_;
    MeshIntake* intake_;
    std::size_t nodes_ = 0;  ///< nodes per row; 0: no row yet
    Marker marker_ = 0;
    std::uint64_t first_place_ = 0;
    std::uint64_t step_ = 0;
    // These change with each row and are kept apart from the members above: a wide load that covers
    // both would stall on the recent store.
    std::size_t count_ = 0;
    Rows<4> cells_;
    Rows<3> facets_;
    Rows<2> edges_;
    std::uint64_t next_place_ = 0;
};

}  // namespace octetra::gmsh
