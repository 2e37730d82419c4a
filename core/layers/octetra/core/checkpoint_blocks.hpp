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

/// Checkpoints block by block: what a process writes or reads of one is its own business.
namespace octetra {

/// The parts of a checkpoint, in the order of the file; then come the fields, numbered from
/// first_field. Those that the input has nothing of have no blocks.
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

/// Every block but the last of a section has this many entities; one of the cuts, roots.
inline constexpr std::uint64_t block_length = 4096;

/// The entities of a section, and the bytes of each; 0 for the cuts, of which none is like another.
struct SectionShape {
    std::uint64_t count = 0;
    std::size_t entity_size = 0;

    [[nodiscard]] std::uint64_t blocks() const {
        return count / block_length + (count % block_length != 0 ? 1 : 0);
    }
    /// Entities of a block.
    [[nodiscard]] std::uint64_t length_of(std::uint64_t block) const {
        const std::uint64_t rest = count - block * block_length;
        return rest < block_length ? rest : block_length;
    }
};

[[nodiscard]] SectionShape shape_of(const CheckpointFacts& facts, Section section);
/// "points", "cuts", "field 'u'" ...: for messages.
[[nodiscard]] std::string name_of(const CheckpointFacts& facts, Section section);
/// Can this be the name of a field? That is UTF-8 without control characters, so that programs may
/// print it.
[[nodiscard]] bool is_name(std::string_view text);
/// The reason why a state cannot be saved; empty if it can.
[[nodiscard]] std::string wrong_in(const SavedState& state);
/// Bytes of a vertex number in lists of cells, facets and edges: 4 where that is enough, or 8.
[[nodiscard]] std::size_t vertex_number_size(const CheckpointFacts& facts);

/// Writes a checkpoint beside its place, and puts it there when it is complete and on the disk.
/// All but facts() is collective in the group; failures are thrown on all processes.
///
/// Sections come in their order. Of each one window after the other: the next block is the first
/// process's, then the second's, and so on, until the section has all of its blocks.
class CheckpointWriter {
public:
    /// Facts of the steps may still be unknown.
    CheckpointWriter(const std::filesystem::path& path, const ProcessGroup& group,
                     CheckpointFacts facts);
    ~CheckpointWriter();
    CheckpointWriter(const CheckpointWriter&) = delete;
    CheckpointWriter& operator=(const CheckpointWriter&) = delete;
    CheckpointWriter(CheckpointWriter&&) = delete;
    CheckpointWriter& operator=(CheckpointWriter&&) = delete;

    [[nodiscard]] CheckpointFacts& facts();

    /// All sections before the cuts.
    void put_input(MeshSource& input);

    /// Calls make(window) for each window of a section, which gives this process's slice as bytes;
    /// it is not called for where the section has no entities.
    void put_section(Section section, auto&& make) {
        const SectionShape shape = shape_of(facts(), section);
        for (std::uint64_t begin = 0; begin < shape.count; begin += window_length()) {
            const Window window{begin, block_length, shape.count};
            put_slice(window, make(window));
        }
    }

    /// After the last section.
    void commit();

private:
    [[nodiscard]] std::uint64_t window_length() const;
    /// A process without a slice of the window gives no bytes.
    void put_slice(const Window& window, std::span<const std::byte> bytes);

    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Reads a checkpoint. Nothing is collective. Every size was checked against the file's.
class CheckpointReader {
public:
    /// Reads the table. Throws InputError or SystemError, here and below.
    explicit CheckpointReader(const std::filesystem::path& path);
    ~CheckpointReader();
    CheckpointReader(const CheckpointReader&) = delete;
    CheckpointReader& operator=(const CheckpointReader&) = delete;
    CheckpointReader(CheckpointReader&&) = delete;
    CheckpointReader& operator=(CheckpointReader&&) = delete;

    [[nodiscard]] const CheckpointFacts& facts() const;

    /// A block, once it has the hash that it should have.
    [[nodiscard]] std::vector<std::byte> read_block(Section section, std::uint64_t block) const;

    /// Entities begin .. end-1 of a section, each as `T`s.
    template <class T>
    [[nodiscard]] std::vector<T> read(Section section, std::uint64_t begin,
                                      std::uint64_t end) const {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::vector<std::byte> bytes = read_bytes(section, begin, end);
        std::vector<T> values(bytes.size() / sizeof(T));
        if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
        return values;
    }
    /// Of cells, facets or edges: their vertices, which are in range.
    template <std::size_t N>
    [[nodiscard]] std::vector<VertexNumbers<N>> read_vertices(Section section, std::uint64_t begin,
                                                              std::uint64_t end) const {
        const std::vector<std::uint64_t> numbers = read_numbers(section, begin, end);
        std::vector<VertexNumbers<N>> lists(numbers.size() / N);
        for (std::size_t i = 0; i < numbers.size(); ++i) lists[i / N][i % N] = numbers[i];
        return lists;
    }
    /// Numbers begin .. end-1 of those with a feature, which are in range and ascend.
    [[nodiscard]] std::vector<std::uint64_t> read_features(Feature feature, std::uint64_t begin,
                                                           std::uint64_t end) const;
    /// Points, which are finite and not too large.
    [[nodiscard]] std::vector<Point> read_points(std::uint64_t begin, std::uint64_t end) const;

    /// How each step cuts what the roots of a block have become. For each step as many cells as the
    /// steps before it have made. Adds what the block has of each step to `found`.
    [[nodiscard]] std::vector<std::vector<CutRun>> read_cuts(std::uint64_t block,
                                                             std::vector<StepFacts>& found) const;
    /// Throws InputError where the table has other figures of a step than all blocks together.
    void check_steps(const std::vector<StepFacts>& found) const;

    /// Throws InputError: what is wrong with a block.
    [[noreturn]] void fail(Section section, std::uint64_t block, const std::string& what) const;

private:
    [[nodiscard]] std::vector<std::byte> read_bytes(Section section, std::uint64_t begin,
                                                    std::uint64_t end) const;
    [[nodiscard]] std::vector<std::uint64_t> read_numbers(Section section, std::uint64_t begin,
                                                          std::uint64_t end) const;

    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// The block of the cuts that `steps` make, each of as many cells as those before it have made.
/// Adds what they say to the facts of the steps.
[[nodiscard]] std::vector<std::byte> cuts_block(const std::vector<CutRuns>& steps,
                                                std::vector<StepFacts>& facts);

}  // namespace octetra
