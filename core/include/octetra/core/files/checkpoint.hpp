#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <octetra/core/field.hpp>
#include <octetra/core/mesh.hpp>

/// Checkpoints, `.octetra`: a mesh as its input and how each step cut the cells that there were,
/// with values of vertices and cells. docs/formats.md has the format.
namespace octetra {

struct StepFacts {
    std::uint64_t cells_before = 0;
    std::uint64_t cells_cut = 0;
    std::uint64_t bytes = 0;  ///< that it takes in the file

    friend bool operator==(const StepFacts&, const StepFacts&) = default;
};

/// The state of a program, saved with a mesh for a restart.
struct SavedState {
    double time = 0;  ///< finite
    std::int64_t step = 0;
    /// A text of the program's own, such as JSON: UTF-8, without control characters but line ends
    /// and tabs.
    std::string text;

    friend bool operator==(const SavedState&, const SavedState&) = default;
};

/// What a checkpoint says of itself.
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

    // The mesh as it is:
    std::uint64_t vertices_now = 0;
    std::uint64_t cells_now = 0;

    std::vector<StepFacts> steps;
    std::vector<FieldFacts> fields;
    std::vector<GroupName> group_names;
    std::optional<SavedState> state;  ///< none where the program has saved none

    friend bool operator==(const CheckpointFacts&, const CheckpointFacts&) = default;
};

/// Reads the table of a checkpoint, and nothing else. Throws InputError where it is damaged, or the
/// file is no checkpoint, and SystemError.
[[nodiscard]] CheckpointFacts read_checkpoint_facts(const std::filesystem::path& path);

/// What this process reads as a whole, but for the fields.
struct Checkpoint {
    CheckpointFacts facts;
    Mesh input;
    /// For each step the edges that it bisected of each cell before it: six bits, in the order of
    /// cell_edges.
    std::vector<std::vector<std::uint8_t>> steps;
};

/// Reads a checkpoint whose input has fewer than 2^32 - 1 entities of each kind. Every block is
/// checked against its hash, and numbers are in range. Not checked: what read_mesh() does beyond
/// the syntax, and whether the steps fit the cells. Throws InputError, which names the block, or
/// SystemError.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Has this file the extension of checkpoints?
[[nodiscard]] bool is_checkpoint(const std::filesystem::path& path);

}  // namespace octetra
