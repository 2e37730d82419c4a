#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <octetra/core/cut_runs.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/mesh_source.hpp>

/// Reads and writes checkpoints block by block; every process chooses the blocks it reads or
/// writes.
namespace octetra {

/// The sections of a checkpoint, in the order of the file, followed by one for each field, numbered
/// from first_field. Sections of data that the input does not have contain no blocks.
enum class Section : std::size_t {
    points,
    point_markers,
    point_attributes,
    cells,
    regions,
    facets,
    facet_markers,
    edges,
    edge_markers,
    features,  // one for each feature, see feature_section()
    cuts = features + feature_count,
};
inline constexpr std::size_t first_field = static_cast<std::size_t>(Section::cuts) + 1;
[[nodiscard]] constexpr Section feature_section(Feature feature) {
    return static_cast<Section>(static_cast<std::size_t>(Section::features) +
                                static_cast<std::size_t>(feature));
}
[[nodiscard]] constexpr Section field_section(std::size_t field) {
    return static_cast<Section>(first_field + field);
}

/// The number of entities in every block of a section but the last; roots in the section of cuts.
inline constexpr std::uint64_t block_length = 4096;

/// The number of entities of a section, and the bytes of each; 0 bytes for the cuts, whose size
/// varies.
struct SectionShape {
    std::uint64_t count = 0;
    std::size_t entity_size = 0;

    [[nodiscard]] std::uint64_t blocks() const {
        return count / block_length + (count % block_length != 0 ? 1 : 0);
    }
    /// Returns the number of entities of a block.
    [[nodiscard]] std::uint64_t length_of(std::uint64_t block) const {
        const std::uint64_t rest = count - block * block_length;
        return rest < block_length ? rest : block_length;
    }
};

[[nodiscard]] SectionShape shape_of(const CheckpointFacts& facts, Section section);
/// Returns the name of a section for messages: "points", "cuts", "field 'u'" ...
[[nodiscard]] std::string name_of(const CheckpointFacts& facts, Section section);
/// Returns whether `text` is a valid name of a field: UTF-8 without control characters, so that
/// programs may print it.
[[nodiscard]] bool is_name(std::string_view text);
/// Returns the reason why a state cannot be saved, or an empty string.
[[nodiscard]] std::string wrong_in(const SavedState& state);
/// Returns the bytes of a vertex number in lists of cells, facets and edges: 4 if that suffices, or
/// 8.
[[nodiscard]] std::size_t vertex_number_size(const CheckpointFacts& facts);

/// Writes a checkpoint to a temporary file, and renames it when it is complete and synchronised to
/// disk. All functions but facts() are collective in the group; failures are thrown on all
/// processes.
///
/// Sections must be written in order, each one window at a time: consecutive blocks of a window
/// belong to consecutive processes, from the first one on, until the section is complete.
class CheckpointWriter {
public:
    /// The facts of the steps may be set later.
    CheckpointWriter(const std::filesystem::path& path, const ProcessGroup& group,
                     CheckpointFacts facts);
    ~CheckpointWriter();
    CheckpointWriter(const CheckpointWriter&) = delete;
    CheckpointWriter& operator=(const CheckpointWriter&) = delete;
    CheckpointWriter(CheckpointWriter&&) = delete;
    CheckpointWriter& operator=(CheckpointWriter&&) = delete;

    [[nodiscard]] CheckpointFacts& facts();

    /// Writes all sections before the cuts.
    void put_input(MeshSource& input);

    /// Calls make(window), which returns this process's slice as bytes, for each window of a
    /// section. make() is not called if the section has no entities.
    void put_section(Section section, auto&& make) {
        const SectionShape shape = shape_of(facts(), section);
        for (std::uint64_t begin = 0; begin < shape.count; begin += window_length()) {
            const Window window{begin, block_length, shape.count};
            put_slice(window, make(window));
        }
    }

    /// To be called after the last section.
    void commit();

private:
    [[nodiscard]] std::uint64_t window_length() const;
    /// A process without a slice of the window passes no bytes.
    void put_slice(const Window& window, std::span<const std::byte> bytes);

    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Reads a checkpoint. No function is collective. Every size has been checked against the file
/// size.
class CheckpointReader {
public:
    /// Reads the table. Throws InputError or SystemError, as the functions below.
    explicit CheckpointReader(const std::filesystem::path& path);
    ~CheckpointReader();
    CheckpointReader(const CheckpointReader&) = delete;
    CheckpointReader& operator=(const CheckpointReader&) = delete;
    CheckpointReader(CheckpointReader&&) = delete;
    CheckpointReader& operator=(CheckpointReader&&) = delete;

    [[nodiscard]] const CheckpointFacts& facts() const;

    /// Returns a block after verifying its hash.
    [[nodiscard]] std::vector<std::byte> read_block(Section section, std::uint64_t block) const;

    /// Returns entities begin .. end - 1 of a section, each as one or more `T`.
    template <class T>
    [[nodiscard]] std::vector<T> read(Section section, std::uint64_t begin,
                                      std::uint64_t end) const {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::vector<std::byte> bytes = read_bytes(section, begin, end);
        std::vector<T> values(bytes.size() / sizeof(T));
        if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
        return values;
    }
    /// Returns the vertices of cells, facets or edges begin .. end - 1, which are in range.
    template <std::size_t N>
    [[nodiscard]] std::vector<VertexNumbers<N>> read_vertices(Section section, std::uint64_t begin,
                                                              std::uint64_t end) const {
        const std::vector<std::uint64_t> numbers = read_numbers(section, begin, end);
        std::vector<VertexNumbers<N>> lists(numbers.size() / N);
        for (std::size_t i = 0; i < numbers.size(); ++i) lists[i / N][i % N] = numbers[i];
        return lists;
    }
    /// Returns entries begin .. end - 1 of the list of entities with a feature. They are numbers
    /// that are in range and ascend.
    [[nodiscard]] std::vector<std::uint64_t> read_features(Feature feature, std::uint64_t begin,
                                                           std::uint64_t end) const;
    /// Returns points, whose coordinates are finite and within the limit.
    [[nodiscard]] std::vector<Point> read_points(std::uint64_t begin, std::uint64_t end) const;

    /// Returns for each step the cuts of the descendants of a block's roots, as many as the steps
    /// before it have made. Adds the totals of the block for each step to `found`.
    [[nodiscard]] std::vector<std::vector<CutRun>> read_cuts(std::uint64_t block,
                                                             std::vector<StepFacts>& found) const;
    /// Throws InputError if the table's facts about a step differ from the totals over all blocks.
    void check_steps(const std::vector<StepFacts>& found) const;

    /// Throws InputError with a message on a block.
    [[noreturn]] void fail(Section section, std::uint64_t block, const std::string& what) const;

private:
    [[nodiscard]] std::vector<std::byte> read_bytes(Section section, std::uint64_t begin,
                                                    std::uint64_t end) const;
    [[nodiscard]] std::vector<std::uint64_t> read_numbers(Section section, std::uint64_t begin,
                                                          std::uint64_t end) const;

    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Returns the block of cuts for `steps`, each of which has as many cells as the steps before it
/// have made. Adds its totals to the facts of the steps.
[[nodiscard]] std::vector<std::byte> cuts_block(const std::vector<CutRuns>& steps,
                                                std::vector<StepFacts>& facts);

}  // namespace octetra
