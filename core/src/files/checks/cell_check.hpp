#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/positive_filter.hpp>

namespace octetra {

/// Checks cells by the positions of their corners while they are read.
class CellCheck {
public:
    CellCheck(const Mesh& mesh, const ReadOptions& options)
        : mesh_(&mesh),
          fix_orientation_(options.fix_orientation),
          takes_all_(options.only_syntax) {}

    /// Returns a message on what is wrong with the cell, or an empty string. Reverses an inverted
    /// cell if the options say so. Vertex numbers must be in range. Accepts every cell if only
    /// syntax is checked.
    [[nodiscard]] std::string_view check_entities(CellVertices& cell) {
        if (takes_all_) return {};
        const auto& points = mesh_->points;
        if (filter_.point_count() < points.size()) add_new_points();
        const auto& [a, b, c, d] = cell;
        if (filter_.is_surely_positive(points[a], points[b], points[c], points[d])) return {};
        return check_exactly(cell);
    }

    /// Same for several cells: returns the first wrong one and the message.
    struct WrongCell {
        std::size_t cell = 0;
        std::string_view what;  ///< empty: there is none
    };
    [[nodiscard]] WrongCell check_entities(std::span<CellVertices> cells);

    [[nodiscard]] std::size_t fixed_count() const { return fixed_count_; }

private:
    void add_new_points();
    [[nodiscard]] std::size_t find_doubtful(std::span<const CellVertices> cells,
                                            std::size_t from) const;
    [[nodiscard]] std::string_view check_exactly(CellVertices& cell);

    const Mesh* mesh_;
    PositiveFilter filter_;  ///< for the points known at the last cell
    bool fix_orientation_;
    bool takes_all_;
    std::size_t fixed_count_ = 0;
};

}  // namespace octetra
