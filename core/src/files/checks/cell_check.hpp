#pragma once

#include <string_view>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/core/mesh.hpp>

namespace octetra {

/// Judges cells while they are read, by their corners' positions.
class CellCheck {
public:
    CellCheck(const Mesh& mesh, const ReadOptions& options)
        : mesh_(&mesh),
          fix_orientation_(options.fix_orientation),
          takes_all_(options.only_syntax) {}

    /// Returns what is wrong with the cell, or nothing. Turns an inverted one round if asked to.
    /// Its vertex numbers must be in range. Finds nothing wrong if only syntax is asked for.
    [[nodiscard]] std::string_view judge(CellVertices& cell);

    [[nodiscard]] std::size_t fixed_count() const { return fixed_count_; }

private:
    const Mesh* mesh_;
    bool fix_orientation_;
    bool takes_all_;
    std::size_t fixed_count_ = 0;
};

}  // namespace octetra
