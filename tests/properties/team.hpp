#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <octetra/core/maps.hpp>
#include <octetra/core/mesh.hpp>

#include "properties/case.hpp"
#include "properties/histories/adapt_together.hpp"

/// Laws are judged on the first rank alone. When it wants a case refined by all ranks, it tells the
/// others, who wait for that. So draws, verdicts and shrinking need no agreement: there is one
/// mind.
namespace octetra::properties {

/// A refinement, or the words in which it was refused.
struct Outcome {
    Mesh mesh;
    RefinementMaps maps;
    std::string error;
};

/// Collective. The first rank does the work; meanwhile the others refine whatever it asks for.
void lead(const std::function<void()>& work);

// Of the first rank, within lead():

/// By the distributed engine, on all ranks.
[[nodiscard]] Outcome refined_by_all(const Case& c);

/// The same, written to a file by all ranks. The words in which that was refused, or nothing.
[[nodiscard]] std::string write_refined_by_all(const Case& c, const std::filesystem::path& file);

/// All steps of a history, by the distributed engine, on as many ranks as each step says.
[[nodiscard]] Adapted adapted_by_all(const Case& c);

/// By the serial reference. Of histories, see adapted_by_reference().
[[nodiscard]] Outcome refined_by_reference(const Case& c);

}  // namespace octetra::properties
