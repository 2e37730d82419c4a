#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/verify/mesh_slice.hpp>
#include <octetra/verify/verdict.hpp>

/// An independent judge of meshes and refinements. It shares with those who make them the mesh
/// model, the order of edges and the meaning of a selection, which are core's, and nothing else.
/// Functions that take no group are local to the process.
namespace octetra::verify {

/// What was asked for, if the fine mesh claims to be the 8T-LE refinement of the coarse one.
struct Request {
    Selection selection;
    Scheme scheme = Scheme::eight;
    int levels = 1;
};

using Progress = std::function<void(std::string_view check, double share)>;

struct VerifyOptions {
    /// Only what takes filtered predicates and no search in space: well-formed, orientation, faces;
    /// of refinements also descent, cover and tags.
    bool fast = false;
    /// No dihedral angle may be less, in degrees, 0 to 180; decided exactly.
    std::optional<double> min_dihedral;
    std::optional<Request> request;
    const RefinementMaps* maps =
        nullptr;  ///< checked if given; cells and vertices of the fine mesh
    /// Why a fine mesh without attributes could not have any (its file's format, say). Empty: it
    /// could, and it is a fault if the coarse mesh has some.
    std::string attributes_lost;
    /// The same of vertex markers.
    std::string vertex_markers_lost;
    /// Hears, now and then, which check is running and what share of it is done, from 0 to 1: of
    /// what this process does.
    Progress progress;
    /// So many violations of each code are described; all are counted.
    std::size_t kept_per_code = std::numeric_limits<std::size_t>::max();
};

/// Judges a mesh by itself. Nothing is asked of it: indices may be out of range.
///
/// A valid verdict (not `fast`) proves: the cells' interiors are disjoint, and any two cells meet
/// in a common face, edge or vertex, or not at all. docs/verify-proof.md has the proof.
[[nodiscard]] Verdict verify_mesh(const Mesh& mesh, const VerifyOptions& options = {});

/// Collective in the group. The same of a mesh that no process need have all of: each judges what
/// lies in a part of space. The verdict is the same but for `seconds` and `arithmetic`, as what
/// lies between two parts is looked at by both; whole on the first process, without violations on
/// the others. Takes the memory of about a part and what surrounds it, in every process. Throws
/// InputError on all processes where two pass different options.
[[nodiscard]] Verdict verify_mesh(MeshSlice mesh, const ProcessGroup& group,
                                  const VerifyOptions& options = {});

/// Judges `fine` as a refinement of `coarse` by midpoints: the cells of each coarse cell come of
/// halving it at midpoints of edges, over and over, or of cutting it into eight at all six.
///
/// A valid verdict proves: with midpoints not rounded, the fine cells would tile every coarse cell
/// exactly, face to face; rounded as they are, no vertex is farther off than facts.rounding_bound,
/// and every cell is positively oriented, exactly.
[[nodiscard]] Verdict verify_refinement(const Mesh& coarse, const Mesh& fine,
                                        const VerifyOptions& options = {});

/// Collective in the group. The same of meshes that no process need have all of; as verify_mesh().
/// Every process has the maps, if there are any, whole. Each judges the coarse cells of a part of
/// space with their descendants, and sees those around them: where coarse cells are few and large,
/// parts overlap, and memory does not fall.
[[nodiscard]] Verdict verify_refinement(MeshSlice coarse, MeshSlice fine, const ProcessGroup& group,
                                        const VerifyOptions& options = {});

}  // namespace octetra::verify
