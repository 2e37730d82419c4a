#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <octetra/core/checkpoint_blocks.hpp>

/// The header, table and trailer of a checkpoint. See docs/formats.md.
namespace octetra {

static_assert(std::endian::native == std::endian::little,
              "checkpoints are written in native byte order, which must be little-endian");

/// Contains bytes that are damaged by a transfer in text mode.
inline constexpr std::array<char, 8> checkpoint_magic{'\x89', 'O',  'C',    'T',
                                                      '\r',   '\n', '\x1a', '\n'};

struct CheckpointHeader {
    std::array<char, 8> magic = checkpoint_magic;
    std::uint32_t version = 1;
    std::uint32_t byte_order = 0x01020304;
};
static_assert(sizeof(CheckpointHeader) == 16);

/// The last bytes of the file.
struct CheckpointTrailer {
    std::uint64_t table_begin = 0;
    std::uint64_t table_size = 0;
    std::uint64_t table_hash = 0;
    std::array<char, 8> magic = checkpoint_magic;
};
static_assert(sizeof(CheckpointTrailer) == 32);

struct BlockEntry {
    std::uint64_t size = 0;
    std::uint64_t hash = 0;
};

/// Computes the XXH3 hash, 64 bits.
[[nodiscard]] std::uint64_t hash_of(std::span<const std::byte> bytes);

/// Returns the number of entities of the input that can have the feature.
[[nodiscard]] std::uint64_t entities_with(Feature feature, const CheckpointFacts& facts);

[[nodiscard]] std::size_t section_count(const CheckpointFacts& facts);

/// Returns the offset in the table of the entry of a step.
[[nodiscard]] std::size_t byte_of_step(std::size_t step);

/// Returns the serialised table: the facts, and the blocks in file order.
[[nodiscard]] std::vector<std::byte> table_of(const CheckpointFacts& facts,
                                              const std::vector<BlockEntry>& blocks);

/// Parses the table. Throws InputError, which names the file, if it is invalid, or if blocks of
/// these sizes do not end where the table begins.
void read_table(const std::filesystem::path& path, std::span<const std::byte> table,
                std::uint64_t table_begin, CheckpointFacts& facts, std::vector<BlockEntry>& blocks);

}  // namespace octetra
