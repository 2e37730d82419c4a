#pragma once

#include <cstdint>
#include <string>

#include "commands/mesh_options.hpp"
#include "script/read_script.hpp"

namespace octetra::cli {

/// What the reference can do with a script.
struct ReferenceAdaptation {
    InputOptions input;  ///< a mesh without fields, no checkpoint
    std::string output;
    std::uint64_t max_cells = 0;
    bool quiet = false;
};

/// Reads the mesh, runs the steps by the serial reference and writes the result, the same bytes as
/// adapt(). Not collective: of several processes the first one does it, and the others wait. Throws
/// InputError as adapt(), and where a step or a file wants a history, which the reference does not
/// save.
void adapt_by_reference(const ReferenceAdaptation& options, const Script& script);

}  // namespace octetra::cli
