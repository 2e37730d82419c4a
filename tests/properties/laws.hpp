#pragma once

#include <string>
#include <vector>

#include "properties/case.hpp"

/// What must hold of every refinement, and of every history. Each law looks at a case and says what
/// of it does not hold, or nothing. They are judged within lead(), on the first rank.
namespace octetra::properties {

/// Both engines: the same bits, or the same words of refusal. What they make, the exact verifier
/// finds valid and the one that was asked for.
[[nodiscard]] std::string fault_of_equality(const Case& c);

/// With vertices, cells and corners numbered otherwise: the same mesh; and where corners keep their
/// places, the same children in the same order.
[[nodiscard]] std::string fault_of_numbering(const Case& c);

/// Scaled by a power of two or moved by whole numbers: the same, scaled or moved, number by number.
/// Mirrored, where no two edges of a cell tie: the same, mirrored. For cases drawn `exact`.
[[nodiscard]] std::string fault_of_geometry(const Case& c);

/// The edges that are bisected are those that the marked cells mark and those that follow from
/// them: none too few, none that could be left out; closing them again adds nothing; more marked
/// cells never bisect fewer edges.
[[nodiscard]] std::string fault_of_closure(const Case& c);

/// Level by level, through files of either format that all ranks write and the first one reads: the
/// file that the reference's one run yields, byte by byte.
[[nodiscard]] std::string fault_of_files(const Case& c);

/// Counts of cells and vertices follow from the bisected edges, the Euler characteristic stays, and
/// every marked cell is bisected as its scheme says.
[[nodiscard]] std::string fault_of_counts(const Case& c);

// Of histories, which have steps:

/// After each step the ranks' mesh is the reference's, bit by bit, and so are the numbers that each
/// rank tells; or both refuse the step in the same words.
[[nodiscard]] std::string fault_of_steps(const Case& c);

/// After each step, what ranks say of who else has their vertices, edges and faces, who owns them
/// and which numbers they have is what all cells show.
[[nodiscard]] std::string fault_of_sharers(const Case& c);

/// Values on vertices and cells go along with every step: a midpoint has the mean of its ends, and
/// a cell the share of its root's value that it has of its volume; sums stay. For cases drawn
/// `exact`.
[[nodiscard]] std::string fault_of_values(const Case& c);

/// With cells moved before every step to ranks drawn at random, nothing is different, nor is the
/// checkpoint in the end, byte by byte.
[[nodiscard]] std::string fault_of_moving(const Case& c);

/// With vertices, cells and corners numbered otherwise, each step makes the same mesh.
[[nodiscard]] std::string fault_of_numbering_in_steps(const Case& c);

/// Coarsening all cells until nothing changes gives the input, each time by a step at least.
[[nodiscard]] std::string fault_of_the_way_back(const Case& c);

/// Cells that are not marked are still there after a coarsening: as meshes say, and Adaptations.
[[nodiscard]] std::string fault_of_survivors(const Case& c);

/// No coarsening takes a cell back by more than one generation, as meshes say, and Adaptations; and
/// the coarser mesh is refined by the one before, and is a valid refinement of the input. For cases
/// drawn `exact`.
[[nodiscard]] std::string fault_of_generations(const Case& c);

/// The volume stays as it is, exactly. For cases drawn `exact`.
[[nodiscard]] std::string fault_of_volumes(const Case& c);

/// Saving and loading on another number of ranks changes nothing: neither that mesh, nor what is
/// made of it later, nor what is saved in the end, byte by byte.
[[nodiscard]] std::string fault_of_checkpoints(const Case& c);

/// What a refinement made, coarsened: the mesh before, bit by bit; the same cells refined again:
/// the mesh after, bit by bit.
[[nodiscard]] std::string fault_of_refining_again(const Case& c);

struct Law {
    std::string name;
    std::string (*fault)(const Case&);
    bool exact = false;  ///< wants cases that are drawn so
};

/// Of one refinement.
[[nodiscard]] const std::vector<Law>& laws();
[[nodiscard]] const std::vector<Law>& history_laws();

/// Of either. Throws std::out_of_range.
[[nodiscard]] const Law& law_named(const std::string& name);

}  // namespace octetra::properties
