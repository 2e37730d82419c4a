#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <octetra/core/mesh_source.hpp>

#include "commands/refine/options.hpp"

/// What octetra refine says while it works.
namespace octetra::cli {

/// A line of what was done, how large the mesh is now, and how long it took.
void report(const RefineOptions& options, std::string_view doing, std::uint64_t vertices,
            std::uint64_t cells, double seconds);

/// What the engine has made, in numbers.
struct RefinedFacts {
    int levels = 0;
    int ranks = 1;
    MeshFacts facts;
    std::uint64_t too_large = 0;  ///< cells
};

void report_refined(const RefineOptions& options, const RefinedFacts& refined, double seconds);

/// `lost`: what the format of the output cannot hold, or nothing.
void report_written(const RefineOptions& options, const std::string& lost, const MeshFacts& facts,
                    double seconds);

}  // namespace octetra::cli
