#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <octetra/core/mesh_source.hpp>

#include "commands/refine/options.hpp"

/// Progress output of octetra refine.
namespace octetra::cli {

/// Prints a line with the action, the current size of the mesh and the time taken.
void report(const RefineOptions& options, std::string_view doing, std::uint64_t vertices,
            std::uint64_t cells, double seconds);

/// Figures of the refined mesh.
struct RefinedFacts {
    int levels = 0;
    int ranks = 1;
    MeshFacts facts;
    std::uint64_t too_large = 0;  ///< number of cells
};

void report_refined(const RefineOptions& options, const RefinedFacts& refined, double seconds);

/// `lost` names the data that the output format cannot hold, or is empty.
void report_written(const RefineOptions& options, const std::string& lost, const MeshFacts& facts,
                    double seconds);

}  // namespace octetra::cli
