#pragma once

#include <string_view>

#include <octetra/core/mesh.hpp>

namespace octetra {

/// Judges cells while they are read, by their corners' positions.
class CellCheck {
public:
    CellCheck(const Mesh& mesh, bool fix_orientation)
        : mesh_(&mesh), fix_orientation_(fix_orientation) {}

    /// Returns what is wrong with the cell, or nothing. Turns an inverted one round if asked to.
    /// Its vertex numbers must be in range.
    [[nodiscard]] std::string_view judge(CellVertices& cell);

    [[nodiscard]] std::size_t fixed_count() const { return fixed_count_; }

private:
    const Mesh* mesh_;
    bool fix_orientation_;
    std::size_t fixed_count_ = 0;
};

}  // namespace octetra
