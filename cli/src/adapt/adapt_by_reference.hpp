#pragma once

#include "adapt/adaptation.hpp"
#include "script/read_script.hpp"

namespace octetra::cli {

/// Reads the mesh, runs the steps with the serial reference and writes the result, bitwise the same
/// as adapt(). Not collective: runs on the first process while others wait. Throws InputError as
/// adapt(), and for options and files that involve more than a mesh.
void adapt_by_reference(const AdaptationOptions& options, const Script& script);

}  // namespace octetra::cli
