#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <octetra/core/error.hpp>

#include "files/gmsh/wrong_row.hpp"
#include "files/input/growing_mesh.hpp"

namespace octetra::gmsh {

/// Elements of the kinds of a mesh on their way from an Input to an Intake, which takes several at
/// once: of one kind, with one marker, at equal distances in the file.
template <class Input, class Intake>
class RowBatch {
public:
    RowBatch(Input& in, Intake& intake) : in_(&in), intake_(&intake) {}

    /// Calls read(), which adds rows, and passes them on. What is wrong with a row comes before
    /// what then stopped the reading.
    void fill(auto&& read) {
        try {
            read();
        } catch (const InputError&) {
            pass_on();
            throw;
        }
        pass_on();
    }

    /// Are the rows of this kind? If not, the next one of it is put where its first ones were.
    template <class I, std::size_t N>
    [[nodiscard]] bool is_of(const EntityKind<I, N>& /*kind*/) const {
        return N == nodes_;
    }
    /// Where the next row's nodes are put, by their tags, before it is added, or left out.
    template <class I, std::size_t N>
    std::array<std::uint64_t, N>& next_row(const EntityKind<I, N>& /*kind*/) {
        if (N != nodes_ || count_ == Intake::most_at_once) pass_on();
        if (N != nodes_) begin(N, 0, 0, 0);
        return rows_of<N>()[count_];
    }
    /// The row that was put there. `place`, `step`: see Intake::take(). Returns its nodes, which
    /// stay there until the next but one of its kind is put somewhere, while the kind stays the
    /// same.
    template <class I, std::size_t N>
    const std::array<std::uint64_t, N>& add(const EntityKind<I, N>& /*kind*/, Marker marker,
                                            std::uint64_t place, std::uint64_t step) {
        const bool goes_on = marker == marker_ && step == step_ && place == next_place_;
        if (!goes_on) {
            const auto row = rows_of<N>()[count_];
            pass_on();
            begin(N, marker, place, step);
            rows_of<N>()[0] = row;
        }
        next_place_ = place + step;
        return rows_of<N>()[count_++];
    }

    /// Where further rows can be put that go on with the last one: at `place`, with its marker and
    /// step. There is room for one at least, or none where they do not go on.
    template <class I, std::size_t N>
    [[nodiscard]] std::span<std::array<std::uint64_t, N>> next_rows(
        const EntityKind<I, N>& /*kind*/, Marker marker, std::uint64_t place, std::uint64_t step) {
        const bool goes_on =
            N == nodes_ && marker == marker_ && step == step_ && place == next_place_;
        if (!goes_on) return {};
        if (count_ == Intake::most_at_once) pass_on();
        return std::span(rows_of<N>()).subspan(count_);
    }
    /// So many rows, one at least, that were put there. Returns the last one's nodes; see add().
    template <class I, std::size_t N>
    const std::array<std::uint64_t, N>& add_rows(const EntityKind<I, N>& /*kind*/,
                                                 std::size_t count) {
        count_ += count;
        next_place_ += count * step_;
        return rows_of<N>()[count_ - 1];
    }

private:
    template <std::size_t N>
    using Rows = std::array<std::array<std::uint64_t, N>, Intake::most_at_once>;

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
        const WrongRow wrong = intake_->take(kind, rows, marker_, place, step_);
        first_place_ = next_place_;
        if (!wrong.what.empty()) in_->fail_at(wrong.what, place + wrong.row * step_);
    }

    Input* in_;
    Intake* intake_;
    std::size_t nodes_ = 0;  ///< of each row; 0: there was none yet
    Marker marker_ = 0;
    std::uint64_t first_place_ = 0;
    std::uint64_t step_ = 0;
    // What changes with each row stands apart: it would be waited for where it is read together
    // with what stands beside it.
    std::size_t count_ = 0;
    Rows<4> cells_;
    Rows<3> facets_;
    Rows<2> edges_;
    std::uint64_t next_place_ = 0;
};

}  // namespace octetra::gmsh
