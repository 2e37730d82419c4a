#include "refinement/cell_divider.hpp"

#include <algorithm>

#include <octetra/core/edge_order.hpp>

namespace octetra::verify {
namespace {

constexpr std::uint8_t most_depth = 240;

std::array<Piece, 2> halves(const Piece& piece, std::size_t i, std::size_t j, VertexIndex m) {
    Piece first = piece;  // retains corner i
    first.vertices[j] = m;
    first.face_of_parent[i] = -1;
    Piece second = piece;
    second.vertices[i] = m;
    second.face_of_parent[j] = -1;
    first.depth = second.depth = static_cast<std::uint8_t>(piece.depth + 1);
    return {first, second};
}

/// Returns the index in cell_edges of the edge between two corners.
constexpr std::size_t edge_of(std::size_t i, std::size_t j) {
    constexpr std::array<std::array<std::size_t, 4>, 4> numbers{
        {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}}};
    return numbers[i][j];
}

/// Returns the pieces at the four corners, and four around a diagonal of the octahedron between
/// them.
std::array<Piece, 8> eight_pieces(const Piece& piece, const std::array<VertexIndex, 6>& m,
                                  std::size_t diagonal) {
    const auto depth = static_cast<std::uint8_t>(piece.depth + 3);
    std::array<Piece, 8> pieces;
    for (std::size_t corner = 0; corner < 4; ++corner) {
        Piece& p = pieces[corner] = piece;
        p.depth = depth;
        for (std::size_t k = 0; k < 4; ++k) {
            if (k != corner) p.vertices[k] = m[edge_of(corner, k)];
        }
        p.face_of_parent[corner] = -1;
    }
    // Diagonal k joins the midpoints of edge a b and of the opposite edge, c d. Around it are the
    // midpoints of a c, b c, b d, a d, in this order. Two consecutive ones share a corner of the
    // cell, and lie on a face together with this corner and one end of the diagonal.
    const auto [a, b] = cell_edges[diagonal];
    const auto [c, d] = cell_edges[5 - diagonal];
    const std::array<std::array<std::size_t, 2>, 4> round{{{a, c}, {b, c}, {b, d}, {a, d}}};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& near = round[k];
        const auto& far = round[(k + 1) % 4];
        const VertexIndex p = m[edge_of(near[0], near[1])];
        const VertexIndex q = m[edge_of(far[0], far[1])];
        // If they share c, the midpoints of ac and bc, with that of ab, lie on face abc, without d;
        // if they share b, the midpoints of bc and bd, with that of cd, lie on face bcd, without a.
        const bool share_end_of_second = near[1] == far[1];
        const std::size_t shared = share_end_of_second ? near[1] : near[0];
        const std::size_t missing =
            share_end_of_second ? (shared == c ? d : c) : (shared == a ? b : a);
        Piece& piece_k = pieces[4 + k];
        piece_k.depth = depth;
        piece_k.vertices = {m[diagonal], m[5 - diagonal], p, q};
        piece_k.face_of_parent = {-1, -1, -1, -1};
        // The face contains the end of the diagonal on ab (or cd), so the other end is opposite.
        piece_k.face_of_parent[share_end_of_second ? 1 : 0] = piece.face_of_parent[missing];
        // Their orientation is reversed if a, b, c, d is an even order.
        if (diagonal != 1) std::swap(piece_k.vertices[2], piece_k.vertices[3]);
    }
    return pieces;
}

}  // namespace

CellDivider::CellDivider(const JudgedMesh& coarse, const JudgedMesh& fine, Lines& lines)
    : fine_(&fine), cells_(fine), lines_(&lines) {
    // A correct mesh needs two pieces for each fine cell, and some that are discarded.
    const std::size_t cells = coarse.mesh.cells.size() + fine.mesh.cells.size();
    budget_ = 100'000 + 20 * static_cast<std::int64_t>(cells);
}

bool CellDivider::divide_cell(const CellVertices& vertices) {
    leaves_.clear();
    splits_.clear();
    undivided_ = {};
    undivided_leaves_ = 0;
    return divide({vertices});
}

bool CellDivider::attempt(const auto& pieces) {
    const std::size_t leaves = leaves_.size();
    const std::size_t splits = splits_.size();
    if (std::all_of(pieces.begin(), pieces.end(), [&](const Piece& p) { return divide(p); })) {
        return true;
    }
    leaves_.resize(leaves);
    splits_.resize(splits);
    return false;
}

bool CellDivider::divide(const Piece& piece) {
    if (const CellIndex found = cells_.find(piece.vertices); !found.is_none()) {
        leaves_.push_back({found, piece});
        return true;
    }
    CellVertices ascending = piece.vertices;
    std::sort(ascending.begin(), ascending.end());
    if (piece.depth < most_depth && budget_-- > 0 && indivisible_.count(ascending) == 0) {
        if (bisect(piece) || cut_into_eight(piece)) return true;
        indivisible_.insert(ascending);
    }
    if (undivided_leaves_ == 0 || leaves_.size() + 1 > undivided_leaves_) {
        undivided_ = piece.vertices;
        undivided_leaves_ = leaves_.size() + 1;
    }
    return false;
}

void CellDivider::take_longest_first(const Piece& piece, std::array<Choice, 6>& choices,
                                     std::size_t n, std::size_t count) const {
    const auto segment = [&](const Choice& choice) {
        const auto [i, j] = cell_edges[choice.edge];
        return Segment{fine_->mesh.points[piece.vertices[i]],
                       fine_->mesh.points[piece.vertices[j]]};
    };
    for (std::size_t k = n + 1; k < count; ++k) {
        if (longer(segment(choices[k]), segment(choices[n]))) {
            std::swap(choices[k], choices[n]);
        }
    }
}

bool CellDivider::bisect(const Piece& piece) {
    const CellVertices& v = piece.vertices;
    std::array<Choice, 6> choices;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = cell_edges[k];
        const VertexIndex m = lines_->midpoint(v[i], v[j]);
        if (m.is_none()) continue;
        const auto [c, d] = cell_edges[5 - k];  // the opposite edge
        if (lines_->is_line(m, v[c]) && lines_->is_line(m, v[d])) choices[count++] = {k, m};
    }
    for (std::size_t n = 0; n < count; ++n) {
        take_longest_first(piece, choices, n, count);
        const auto [i, j] = cell_edges[choices[n].edge];
        splits_.push_back({{v[i], v[j]}, choices[n].midpoint});
        if (attempt(halves(piece, i, j, choices[n].midpoint))) return true;
        splits_.pop_back();
    }
    return false;
}

bool CellDivider::cut_into_eight(const Piece& piece) {
    const CellVertices& v = piece.vertices;
    std::array<VertexIndex, 6> m;
    for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = cell_edges[k];
        m[k] = lines_->midpoint(v[i], v[j]);
        if (m[k].is_none()) return false;
    }
    const std::size_t splits = splits_.size();
    for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = cell_edges[k];
        splits_.push_back({{v[i], v[j]}, m[k]});
    }
    for (std::size_t diagonal = 0; diagonal < 3; ++diagonal) {
        if (!lines_->is_line(m[diagonal], m[5 - diagonal])) continue;
        if (attempt(eight_pieces(piece, m, diagonal))) return true;
    }
    splits_.resize(splits);
    return false;
}

}  // namespace octetra::verify
