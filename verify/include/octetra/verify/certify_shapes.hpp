#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>
#include <octetra/verify/mesh_slice.hpp>

/// Certificates of the shapes that regular refinement makes of a mesh. docs/shapes.md defines what
/// is proved, and proves it.
namespace octetra::verify {

struct CertifyOptions {
    /// The maximum number of shapes of a cell; a set that needs more remains open.
    std::size_t limit = 10'000;
    /// The number of worst cells to list.
    std::size_t worst = 10;
    /// Called from time to time with a word for the work and the fraction completed on this
    /// process.
    std::function<void(std::string_view work, double share)> progress;
};

/// Bounds of all cells of a set, rounded outward: the relative error of each is less than
/// `relative_error_of_bounds`, except that of a solid angle, whose vertex may be badly conditioned.
struct ShapeBounds {
    double min_dihedral = 180;  ///< degrees
    double max_dihedral = 0;
    double min_eta = 1;
    double min_solid = 12.566370614359172;  ///< steradians

    friend bool operator==(const ShapeBounds&, const ShapeBounds&) = default;
};

inline constexpr double relative_error_of_bounds = 1e-10;

/// The certificate of one cell of the input.
struct CellCertificate {
    std::uint64_t shapes = 0;      ///< up to similarity, including mirror images
    std::uint64_t placements = 0;  ///< members of the closed set: more than shapes if lengths tie
    /// If the set is closed: the first generation without a new member. Otherwise the last
    /// generation for which the bounds hold.
    std::uint32_t generations = 0;
    bool is_closed = false;
    bool has_ties = false;  ///< whether equal lengths were ordered by coordinates
    /// States whether unequal lengths differed by less than one part in 2^30. Rounding may then
    /// decide which is longer, and the set has the shapes of both decisions.
    bool has_near_ties = false;
    ShapeBounds bounds;

    friend bool operator==(const CellCertificate&, const CellCertificate&) = default;
};

struct CertifiedCell {
    std::uint64_t cell = 0;  ///< counted from 0
    Point centroid;
    CellCertificate certificate;

    friend bool operator==(const CertifiedCell&, const CertifiedCell&) = default;
};

/// The certificate of a mesh. The histogram counts cells by their least dihedral angle, in bins of
/// five degrees from 0 to 75.
struct ShapeCertificate {
    std::uint64_t cells = 0;
    std::uint64_t closed_cells = 0;
    std::uint64_t cells_with_ties = 0;
    std::uint64_t cells_with_near_ties = 0;
    std::uint64_t min_shapes = 0;
    std::uint64_t max_shapes = 0;
    std::uint64_t sum_of_shapes = 0;
    std::uint32_t max_generations = 0;  ///< of the closed sets
    /// If a set is open: the last generation for which `bounds` hold.
    std::optional<std::uint32_t> holds_to_generation{};
    ShapeBounds bounds{};                ///< of all cells
    std::vector<CertifiedCell> worst{};  ///< least dihedral angle first, then by number
    static constexpr double bin_width = 5;
    std::array<std::uint64_t, 15> dihedral_histogram{};

    [[nodiscard]] bool is_closed() const { return closed_cells == cells; }
    friend bool operator==(const ShapeCertificate&, const ShapeCertificate&) = default;
};

/// Certifies one cell, in exact arithmetic. Throws InputError if the cell is not positively
/// oriented, or too thin for its angles to be bounded.
[[nodiscard]] CellCertificate certify_cell(const std::array<Point, 4>& corners,
                                           std::size_t limit = CertifyOptions{}.limit);

/// Certifies the cells of a mesh, which satisfies the first invariant of struct Mesh. Throws
/// InputError that names the first cell that is flat or inverted; if there is none, the first one
/// that is too thin.
[[nodiscard]] ShapeCertificate certify_shapes(const Mesh& mesh, const CertifyOptions& options = {});

/// Collective in the group. As above, for a distributed mesh: each process certifies its slice of
/// the cells. The result is the same on all processes, for any number of them.
[[nodiscard]] ShapeCertificate certify_shapes(const MeshSlice& mesh, const ProcessGroup& group,
                                              const CertifyOptions& options = {});

}  // namespace octetra::verify
