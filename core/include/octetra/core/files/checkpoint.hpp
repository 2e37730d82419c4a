#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <octetra/core/closure.hpp>
#include <octetra/core/field.hpp>
#include <octetra/core/mesh.hpp>

/// Checkpoints, `.octetra`: the input of a mesh, the cells that each step bisected and how, and
/// fields on vertices and cells. docs/formats.md describes the format.
namespace octetra {

struct StepFacts {
    std::uint64_t cells_before = 0;
    std::uint64_t cells_cut = 0;
    std::uint64_t bytes = 0;  ///< size of the step in the file

    friend bool operator==(const StepFacts&, const StepFacts&) = default;
};

/// The state of a program, saved with a mesh for a restart.
struct SavedState {
    double time = 0;  ///< finite
    std::int64_t step = 0;
    /// Application-defined text, such as JSON: UTF-8 without control characters other than line
    /// ends and tabs.
    std::string text;

    friend bool operator==(const SavedState&, const SavedState&) = default;
};

/// The contents of a checkpoint's table.
struct CheckpointFacts {
    // The input:
    std::uint64_t vertices = 0;
    std::uint64_t cells = 0;
    std::uint64_t facets = 0;
    std::uint64_t edges = 0;  ///< tagged ones
    std::size_t attributes_per_point = 0;
    std::uint32_t index_base = 0;
    bool has_point_markers = false;
    bool has_regions = false;
    bool has_facet_markers = false;
    bool has_edge_markers = false;
    FeatureCounts features;

    // The current mesh:
    std::uint64_t vertices_now = 0;
    std::uint64_t cells_now = 0;

    Closure closure = Closure::longest_edge;  ///< of all steps
    std::vector<StepFacts> steps;
    std::vector<FieldFacts> fields;
    std::vector<GroupName> group_names;
    std::optional<SavedState> state;  ///< empty if the program saved no state

    friend bool operator==(const CheckpointFacts&, const CheckpointFacts&) = default;
};

/// Reads only the table of a checkpoint. Throws InputError if it is damaged or the file is not a
/// checkpoint, SystemError if it cannot be read.
[[nodiscard]] CheckpointFacts read_checkpoint_facts(const std::filesystem::path& path);

/// A checkpoint read as a whole into this process, without the fields.
struct Checkpoint {
    CheckpointFacts facts;
    Mesh input;
    /// For each step and each cell before it, the edges that the step bisected: six bits, in the
    /// order of cell_edges.
    std::vector<std::vector<std::uint8_t>> steps;
};

/// Reads a checkpoint whose input has fewer than 2^32 - 1 entities of each kind. Verifies the hash
/// of every block and that all indices are in range. Does not verify the semantic invariants that
/// read_mesh() checks, nor that the steps fit the cells. Throws InputError, which names the block,
/// or SystemError.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Returns whether the path has the extension of checkpoints.
[[nodiscard]] bool is_checkpoint(const std::filesystem::path& path);

}  // namespace octetra
