#pragma once

#include <vector>

#include <octetra/core/mesh_source.hpp>

#include "commands/files_apart.hpp"
#include "commands/mesh_options.hpp"
#include "script/read_script.hpp"

/// What can be known of a script before its first step is run. All throw InputError, which names
/// the line.
namespace octetra::cli {

/// The lists that its steps read.
[[nodiscard]] std::vector<NamedFiles> files_read_by(const Script& script);

/// Refuses a step that writes what cannot be written so by so many ranks, or in the place of what
/// is read or what another line writes. `read` and `written` are those of the command line, which
/// are apart; `input` says whether fields go along.
void check_outputs_of(const Script& script, const InputOptions& input,
                      const std::vector<NamedFiles>& read, const std::vector<NamedFiles>& written,
                      int ranks);

/// Refuses a list of cells that cannot be read as numbers.
void check_lists_of(const Script& script);

/// Refuses regions where the mesh has none.
void check_regions_of(const Script& script, const MeshFacts& input);

}  // namespace octetra::cli
