#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/group_names.hpp>
#include <octetra/core/mesh.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/communicator.hpp>

namespace CLI {
class App;
}

namespace octetra::cli {

/// The options of a subcommand that mark cells, as they were typed.
struct SelectionOptions {
    bool all = false;
    std::string cells_file;
    std::vector<std::string> spheres;
    std::vector<std::string> boxes;
    std::vector<std::string> regions;
    std::optional<double> random;
    std::optional<std::uint64_t> seed;
    std::optional<double> max_volume;
};

/// Declares them, under the headline `group` of the help.
void add_selection_options(CLI::App& subcommand, SelectionOptions& options,
                           const std::string& group);

/// Was any cell asked for?
[[nodiscard]] bool has_criterion(const SelectionOptions& options);

/// What does not need the mesh: at least one criterion, numbers in range. Regions that are given by
/// name are left out. Throws InputError, which says what the criteria are for.
[[nodiscard]] Selection parse_selection(const SelectionOptions& options,
                                        std::string_view wanted = "which cells to refine");

/// What a selection asks of a mesh.
struct SelectableMesh {
    bool has_regions = false;
    std::uint32_t index_base = 0;
    std::uint64_t cells = 0;
    SharedGroupNames group_names;
};

/// Throws InputError if regions are asked for of a mesh that has none.
void check_regions(const SelectionOptions& options, bool mesh_has_regions);

/// The rest: the cell list, the tags of regions that are given by name, and whether the mesh has
/// what is asked for. Throws InputError.
void complete_selection(Selection& selection, const SelectionOptions& options,
                        const SelectableMesh& mesh);

/// Collective. The same on all processes; the first one reads the list, and knows the mesh.
void complete_selection(Selection& selection, const SelectionOptions& options,
                        const SelectableMesh& mesh, const distributed::Communicator& processes);

}  // namespace octetra::cli
