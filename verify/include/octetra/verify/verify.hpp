#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <octetra/core/closure.hpp>
#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/verify/mesh_slice.hpp>
#include <octetra/verify/verdict.hpp>

/// An independent verifier of meshes and refinements. It shares with the code that creates them
/// only definitions of core: the mesh model, the order of edges and the meaning of a selection.
/// Functions without a group argument are local to the process.
namespace octetra::verify {

/// The refinement requested, if the fine mesh claims to be the 8T-LE refinement of the coarse one,
/// with the closure of VerifyOptions.
struct Request {
    Selection selection;
    Scheme scheme = Scheme::eight;
    int levels = 1;
};

using Progress = std::function<void(std::string_view check, double share)>;

struct VerifyOptions {
    /// Run only checks that need filtered predicates and no spatial search: well-formed,
    /// orientation, faces; for refinements also descent, cover and tags.
    bool fast = false;
    /// Lower bound of all dihedral angles, in degrees, 0 to 180; decided exactly.
    std::optional<double> min_dihedral;
    std::optional<Request> request;
    /// Closure::regular: the fine mesh must be the result of regular refinement, whatever cells
    /// were marked if there is no request. The scheme of a request must be Scheme::eight then.
    Closure closure = Closure::longest_edge;
    const RefinementMaps* maps = nullptr;  ///< checked if not null; of the fine mesh
    /// The reason why a fine mesh has no attributes (its file format, for example). If empty,
    /// missing attributes are a violation if the coarse mesh has some.
    std::string attributes_lost;
    /// As above, for vertex markers.
    std::string vertex_markers_lost;
    /// Called from time to time with the name of the running check and the fraction completed, from
    /// 0 to 1, on this process.
    Progress progress;
    /// The maximum number of violations of each code that are described; all are counted.
    std::size_t kept_per_code = std::numeric_limits<std::size_t>::max();
};

/// Verifies a single mesh. No preconditions: indices may be out of range.
///
/// A valid verdict (without `fast`) proves that the interiors of the cells are disjoint, and that
/// any two cells meet in a common face, edge or vertex, or not at all. docs/verify-proof.md
/// contains the proof.
[[nodiscard]] Verdict verify_mesh(const Mesh& mesh, const VerifyOptions& options = {});

/// Collective in the group. As above, for a distributed mesh: each process verifies a part of
/// space. The verdict is the same except for `seconds` and `arithmetic`, because pairs across two
/// parts are tested by both; it is complete on the first process, without violations on the others.
/// Each process needs memory for about its part and the surroundings. Throws InputError on all
/// processes if two pass different options.
[[nodiscard]] Verdict verify_mesh(MeshSlice mesh, const ProcessGroup& group,
                                  const VerifyOptions& options = {});

/// Verifies `fine` as a refinement of `coarse` by midpoints: the cells of each coarse cell result
/// from repeated bisection at midpoints of edges, or from division into eight cells at the
/// midpoints of all six.
///
/// A valid verdict proves that, with exact midpoints, the fine cells would tile every coarse cell
/// exactly and conformingly; that no vertex deviates from its exact position by more than
/// facts.rounding_bound; and that every cell is positively oriented, exactly.
[[nodiscard]] Verdict verify_refinement(const Mesh& coarse, const Mesh& fine,
                                        const VerifyOptions& options = {});

/// Collective in the group. As above, for distributed meshes; see verify_mesh(). If maps are given,
/// every process has them completely. Each process verifies the coarse cells of a part of space
/// with their descendants, and holds the surrounding cells: if coarse cells are few and large,
/// parts overlap and memory does not decrease with the number of processes.
[[nodiscard]] Verdict verify_refinement(MeshSlice coarse, MeshSlice fine, const ProcessGroup& group,
                                        const VerifyOptions& options = {});

}  // namespace octetra::verify
