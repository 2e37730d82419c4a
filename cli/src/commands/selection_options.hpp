#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/group_names.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/communicator.hpp>

namespace CLI {
class App;
}

namespace octetra::cli {

/// The options of a subcommand that mark cells, as given: the criteria before the first --and, once
/// group_criteria() was called.
struct SelectionOptions {
    bool all = false;
    std::string cells_file;
    std::vector<std::string> spheres;
    std::vector<std::string> boxes;
    std::vector<std::string> regions;
    std::optional<double> random;
    std::optional<std::uint64_t> seed;
    std::optional<double> max_volume;
    std::vector<std::string> where;  ///< group_criteria() adds the expressions of the abbreviations
    std::map<std::string, std::vector<std::string>> abbreviated;  ///< the values of each option
    std::optional<double> gradation;                              ///< of all `sizes`
    std::vector<std::string> sizes;             ///< group_criteria() adds an expression for each
    std::vector<SelectionOptions> narrowed_by;  ///< the criteria after each --and
};

/// Declares them under the heading `group` of the help.
void add_selection_options(CLI::App& subcommand, SelectionOptions& options,
                           const std::string& group);

/// Assigns the criteria to the groups that --and separates, in the order of the command line.
/// `subcommand` has parsed the options. Throws InputError if a group is empty, or --cells was given
/// with --and.
void group_criteria(const CLI::App& subcommand, SelectionOptions& options);

/// Returns whether any criterion was given.
[[nodiscard]] bool has_criterion(const SelectionOptions& options);

/// Parses the parts that do not need the mesh: at least one criterion, numbers in range. Regions
/// given by name are omitted. Throws InputError, which states the purpose of the criteria.
[[nodiscard]] Selection parse_selection(const SelectionOptions& options,
                                        std::string_view wanted = "which cells to refine");

/// Returns whether the verifier can evaluate the selection: its expressions use only the corners
/// and the region tag of a cell.
[[nodiscard]] bool can_verify(const Selection& selection);
/// Throws InputError if it cannot.
void check_verifiable(const Selection& selection);

/// The facts of a mesh that a selection refers to.
struct SelectableMesh {
    std::uint32_t index_base = 0;
    std::uint64_t cells = 0;
    SharedGroupNames group_names;
};

/// Collective. Throws InputError, the same on all processes, if a region is selected by a tag that
/// no cell of the mesh has. `of_cells`: the tags of this process's cells or of their roots, in any
/// order.
void check_regions(const SelectionOptions& options, std::span<const Marker> of_cells,
                   const ProcessGroup& processes);

/// Adds the remaining parts: the cell list and the tags of regions given by name; checks them
/// against the mesh. Throws InputError.
void complete_selection(Selection& selection, const SelectionOptions& options,
                        const SelectableMesh& mesh);

/// Collective. Completes the selection on all processes; the first one reads the list and provides
/// the facts of the mesh.
void complete_selection(Selection& selection, const SelectionOptions& options,
                        const SelectableMesh& mesh, const distributed::Communicator& processes);

}  // namespace octetra::cli
