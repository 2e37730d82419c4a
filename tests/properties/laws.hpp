#pragma once

#include <string>
#include <vector>

#include "properties/case.hpp"

/// Laws of every refinement and every history. Each judges a case and returns a description of the
/// fault, or an empty string. Laws are judged within run_on_first_rank(), on the first rank.
namespace octetra::properties {

/// Both engines produce the same bits or the same refusal. The exact verifier finds their mesh
/// valid, and the requested one.
[[nodiscard]] std::string fault_of_equality(const Case& c);

/// Renumbering vertices, cells and corners yields the same mesh, and, if corners keep their
/// positions, the same children in the same order.
[[nodiscard]] std::string fault_of_numbering(const Case& c);

/// A case scaled by a power of two or translated by whole numbers yields the mesh scaled or
/// translated, number by number; a mirrored case, if no two edges of a cell tie, the mirrored mesh.
/// For `exact` cases.
[[nodiscard]] std::string fault_of_geometry(const Case& c);

/// The bisected edges are exactly those that the marked cells mark and those that follow by
/// closure; closing them again adds nothing; more marked cells never bisect fewer edges.
[[nodiscard]] std::string fault_of_closure(const Case& c);

/// Refining level by level, through files of either format that all ranks write and the first one
/// reads, yields the file of one run of the reference, byte by byte. One level with
/// Closure::regular, because files have no history.
[[nodiscard]] std::string fault_of_files(const Case& c);

/// The numbers of cells and vertices follow from the bisected edges, the Euler characteristic is
/// preserved, and every marked cell is bisected as its scheme requires.
[[nodiscard]] std::string fault_of_counts(const Case& c);

// Laws of histories, which have steps:

/// After each step the mesh of the ranks equals that of the reference, bit by bit, and so do the
/// numbers that each rank reports; or both refuse the step with the same message.
[[nodiscard]] std::string fault_of_steps(const Case& c);

/// After each step the sharers, owners and numbers of vertices, edges and faces that ranks report
/// agree with those computed from all cells.
[[nodiscard]] std::string fault_of_sharers(const Case& c);

/// Values on vertices and cells are transferred by every step: a midpoint has the mean of its ends,
/// and a cell a fraction of its root's value in proportion to its volume; sums are preserved. For
/// `exact` cases.
[[nodiscard]] std::string fault_of_values(const Case& c);

/// Migrating cells to random ranks before every step changes neither the meshes nor the final
/// checkpoint, byte by byte.
[[nodiscard]] std::string fault_of_moving(const Case& c);

/// Renumbering vertices, cells and corners yields the same mesh at each step.
[[nodiscard]] std::string fault_of_numbering_in_steps(const Case& c);

/// Repeatedly coarsening all cells yields the input, and each call takes back at least one step.
[[nodiscard]] std::string fault_of_full_coarsening(const Case& c);

/// Cells that are not marked survive a coarsening, according to meshes and to Adaptations.
[[nodiscard]] std::string fault_of_survivors(const Case& c);

/// No coarsening takes a cell back by more than one generation, according to meshes and to
/// Adaptations; the previous mesh refines the coarser one, which is a valid refinement of the
/// input. For `exact` cases.
[[nodiscard]] std::string fault_of_generations(const Case& c);

/// The volume is preserved exactly. For `exact` cases.
[[nodiscard]] std::string fault_of_volumes(const Case& c);

/// Saving, and loading on another number of ranks, changes neither the mesh nor later meshes nor
/// the final checkpoint, byte by byte.
[[nodiscard]] std::string fault_of_checkpoints(const Case& c);

/// With Closure::regular, marking cells one after the other yields the mesh and the checkpoint of
/// marking them together, byte by byte. For `exact` cases.
[[nodiscard]] std::string fault_of_order_of_marks(const Case& c);

/// With Closure::regular, coarsening leaves regular cells and whole families of transition cells,
/// according to the verifier. For `exact` cases.
[[nodiscard]] std::string fault_of_regular_families(const Case& c);

/// Coarsening what a refinement made yields the previous mesh, bit by bit; refining the same cells
/// again yields the refined mesh, bit by bit. With Closure::longest_edge.
[[nodiscard]] std::string fault_of_refining_again(const Case& c);

struct Law {
    std::string name;
    std::string (*fault)(const Case&);
    bool exact = false;  ///< whether cases must be drawn `exact`
};

/// The laws of single refinements.
[[nodiscard]] const std::vector<Law>& laws();
[[nodiscard]] const std::vector<Law>& history_laws();

/// The law of either list with this name. Throws std::out_of_range.
[[nodiscard]] const Law& law_named(const std::string& name);

}  // namespace octetra::properties
