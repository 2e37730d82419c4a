#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>

#include "properties/case.hpp"
#include "properties/histories/adapt_together.hpp"

/// Laws are judged on the first rank alone. It sends each case to be refined to the other ranks,
/// which wait for requests. So draws, verdicts and shrinking need no agreement between ranks.
namespace octetra::properties {

/// A refined mesh, or the message of its refusal.
struct Outcome {
    Mesh mesh;
    RefinementMaps maps;
    std::string error;
};

/// Collective. The first rank performs the work; meanwhile the others serve its requests.
void run_on_first_rank(const std::function<void()>& work);

// To be called on the first rank, within run_on_first_rank():

/// Refines with the distributed engine, on all ranks.
[[nodiscard]] Outcome refined_by_all(const Case& c);

/// Refines on all ranks and writes the result to a file by all ranks. Returns the message of
/// refusal, or an empty string.
[[nodiscard]] std::string write_refined_by_all(const Case& c, const std::filesystem::path& file);

/// Makes all steps of a history with the distributed engine, on as many ranks as each step
/// requires.
[[nodiscard]] Adapted adapted_by_all(const Case& c);

/// Refines with the serial reference. For histories see adapted_by_reference().
[[nodiscard]] Outcome refined_by_reference(const Case& c);

}  // namespace octetra::properties
