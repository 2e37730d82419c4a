#include <utility>

#include <octetra/core/checkpoint_blocks.hpp>

#include "files/checkpoint/table.hpp"
#include "files/output/output_file.hpp"

namespace octetra {
namespace {

using Bytes = ProcessGroup::Bytes;

template <class T>
std::span<const std::byte> bytes_of(std::span<const T> values) {
    return std::as_bytes(values);
}

/// Returns vertex numbers serialised with the width used in the file.
template <std::size_t N>
std::vector<std::byte> numbers_in(std::span<const VertexNumbers<N>> lists, std::size_t size) {
    if (size == sizeof(std::uint64_t)) {
        const auto bytes = std::as_bytes(lists);
        return {bytes.begin(), bytes.end()};
    }
    std::vector<std::byte> bytes(lists.size() * N * size);
    std::byte* place = bytes.data();
    for (const VertexNumbers<N>& list : lists) {
        for (const std::uint64_t number : list) {
            const auto narrow = static_cast<std::uint32_t>(number);
            std::memcpy(place, &narrow, sizeof narrow);
            place += sizeof narrow;
        }
    }
    return bytes;
}

}  // namespace

struct CheckpointWriter::Parts {
    const ProcessGroup* group;
    CheckpointFacts facts;
    OutputFile file;
    std::vector<BlockEntry> own;  ///< the blocks written by this process

    Parts(const std::filesystem::path& path, const ProcessGroup& processes,
          CheckpointFacts initial_facts)
        : group(&processes), facts(std::move(initial_facts)), file(path, processes) {
        const CheckpointHeader header;
        if (group->is_first()) file.put_bytes(&header, sizeof header);
        file.end_turn();
    }

    /// Collective. Returns all blocks in file order on the first process, an empty list on others.
    [[nodiscard]] std::vector<BlockEntry> gathered() const {
        std::vector<Bytes> outboxes(static_cast<std::size_t>(group->size()));
        const auto bytes = std::as_bytes(std::span(own));
        outboxes.front().assign(bytes.begin(), bytes.end());
        const auto inboxes = group->exchange(std::move(outboxes));
        std::vector<BlockEntry> blocks;
        if (!group->is_first()) return blocks;
        std::vector<std::size_t> taken(inboxes.size(), 0);
        for (std::size_t s = 0; s < section_count(facts); ++s) {
            const std::uint64_t count = shape_of(facts, static_cast<Section>(s)).blocks();
            for (std::uint64_t b = 0; b < count; ++b) {
                const std::size_t rank = b % inboxes.size();
                BlockEntry& entry = blocks.emplace_back();
                std::memcpy(&entry, inboxes[rank].data() + sizeof entry * taken[rank]++,
                            sizeof entry);
            }
        }
        return blocks;
    }
};

CheckpointWriter::CheckpointWriter(const std::filesystem::path& path, const ProcessGroup& group,
                                   CheckpointFacts facts)
    : parts_(std::make_unique<Parts>(path, group, std::move(facts))) {}
CheckpointWriter::~CheckpointWriter() = default;

CheckpointFacts& CheckpointWriter::facts() { return parts_->facts; }

std::uint64_t CheckpointWriter::window_length() const {
    return block_length * static_cast<std::uint64_t>(parts_->group->size());
}

void CheckpointWriter::put_slice(const Window& window, std::span<const std::byte> bytes) {
    const int rank = parts_->group->rank();
    if (window.begin_of(rank) < window.end_of(rank)) {
        parts_->file.put_bytes(bytes.data(), bytes.size());
        parts_->own.push_back({bytes.size(), hash_of(bytes)});
    }
    parts_->file.end_turn();
}

void CheckpointWriter::put_input(MeshSource& input) {
    const std::size_t size = vertex_number_size(facts());
    std::vector<std::byte> narrow;
    const auto numbers = [&](const auto& lists) {
        narrow = numbers_in(lists, size);
        return std::span<const std::byte>(narrow);
    };
    put_section(Section::points, [&](const Window& w) { return bytes_of(input.points(w)); });
    put_section(Section::point_markers,
                [&](const Window& w) { return bytes_of(input.point_markers(w)); });
    put_section(Section::point_attributes,
                [&](const Window& w) { return bytes_of(input.point_attributes(w)); });
    put_section(Section::cells, [&](const Window& w) { return numbers(input.cells(w)); });
    put_section(Section::regions, [&](const Window& w) { return bytes_of(input.regions(w)); });
    put_section(Section::facets, [&](const Window& w) { return numbers(input.facets(w)); });
    put_section(Section::facet_markers,
                [&](const Window& w) { return bytes_of(input.facet_markers(w)); });
    put_section(Section::edges, [&](const Window& w) { return numbers(input.edges(w)); });
    put_section(Section::edge_markers,
                [&](const Window& w) { return bytes_of(input.edge_markers(w)); });
    for (const Feature f : all_features) {
        put_section(feature_section(f),
                    [&](const Window& w) { return bytes_of(input.features(f, w)); });
    }
}

void CheckpointWriter::commit() {
    const std::vector<BlockEntry> blocks = parts_->gathered();
    if (parts_->group->is_first()) {
        CheckpointTrailer trailer{.table_begin = parts_->file.position()};
        const std::vector<std::byte> table = table_of(parts_->facts, blocks);
        trailer.table_size = table.size();
        trailer.table_hash = hash_of(table);
        parts_->file.put_bytes(table.data(), table.size());
        parts_->file.put_bytes(&trailer, sizeof trailer);
    }
    parts_->file.end_turn();
    parts_->file.sync();
    parts_->file.commit();
}

std::vector<std::byte> cuts_block(const std::vector<CutRuns>& steps,
                                  std::vector<StepFacts>& facts) {
    std::vector<std::uint8_t> block;
    for (std::size_t t = 0; t < steps.size(); ++t) {
        std::uint64_t cells = 0;
        std::uint64_t cut_cells = 0;
        for_each_run(steps[t], [&](Cut cut, std::uint64_t count) {
            cells += count;
            if (cut != 0) cut_cells += count;
        });
        const auto runs = cut_cells > 0 ? steps[t].bytes() : std::span<const std::uint8_t>{};
        append_number(runs.size(), block);
        block.insert(block.end(), runs.begin(), runs.end());
        facts[t].cells_before += cells;
        facts[t].cells_cut += cut_cells;
        facts[t].bytes += runs.size();
    }
    const auto bytes = std::as_bytes(std::span(block));
    return {bytes.begin(), bytes.end()};
}

}  // namespace octetra
