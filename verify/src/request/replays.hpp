#pragma once

#include <string>

#include "request/requested_refinement.hpp"

namespace octetra::verify {

// Collective. Check that the fine mesh is the result of a request with this closure. They add their
// violations to the findings, and return a note.
std::string replay_longest_edge_closure(const RequestedRefinement& asked);
/// Precondition: check_regular_closure() has found no violations, so that the bisected edges of
/// regular cells determine the fine mesh.
std::string replay_regular_closure(const RequestedRefinement& asked);

}  // namespace octetra::verify
