#pragma once

#include "adapt/adaptation.hpp"
#include "script/read_script.hpp"

namespace octetra::cli {

/// Reads the mesh, runs the steps by the serial reference and writes the result, the same bytes as
/// adapt(). Not collective: of several processes the first one does it, and the others wait. Throws
/// InputError as adapt(), and for options and files that ask for more than a mesh.
void adapt_by_reference(const AdaptationOptions& options, const Script& script);

}  // namespace octetra::cli
