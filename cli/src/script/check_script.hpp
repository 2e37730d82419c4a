#pragma once

#include <span>
#include <vector>

#include <octetra/core/mesh.hpp>
#include <octetra/core/process_group.hpp>

#include "commands/distinct_files.hpp"
#include "commands/mesh_options.hpp"
#include "script/read_script.hpp"

/// Checks of a script before its first step is run. All throw InputError, which names the line.
namespace octetra::cli {

/// Returns the criteria of a step, or null.
[[nodiscard]] const SelectionOptions* criteria_of(const Step& step);

/// Returns the lists and sizes that its steps read.
[[nodiscard]] std::vector<NamedFiles> files_read_by(const Script& script);

/// Throws for a step whose output cannot be written by this many ranks, or would overwrite an input
/// or the output of another line. `read` and `written` are the files of the command line, which
/// have been checked against each other; `input` determines whether there are fields.
void check_outputs_of(const Script& script, const InputOptions& input,
                      const std::vector<NamedFiles>& read, const std::vector<NamedFiles>& written,
                      int ranks);

/// Throws for a list of cells that cannot be parsed.
void check_lists_of(const Script& script);

/// Collective. Throws for a region tag that no cell of MESH has. `of_cells`: the tags of this
/// process's cells, in any order.
void check_regions_of(const Script& script, std::span<const Marker> of_cells,
                      const ProcessGroup& processes);

}  // namespace octetra::cli
