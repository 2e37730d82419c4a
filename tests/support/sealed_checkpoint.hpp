#pragma once

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <octetra/core/error.hpp>

#include "files/checkpoint/table.hpp"

namespace octetra::test {

/// Corrects the hashes of a checkpoint that was modified, as far as its table is consistent.
inline void seal(std::string& file) {
    CheckpointTrailer trailer;
    if (file.size() < sizeof(CheckpointHeader) + sizeof trailer) return;
    std::memcpy(&trailer, file.data() + file.size() - sizeof trailer, sizeof trailer);
    const auto bytes = std::as_bytes(std::span(file.data(), file.size()));
    if (trailer.table_begin > file.size() ||
        trailer.table_size > file.size() - trailer.table_begin) {
        return;
    }
    CheckpointFacts facts;
    std::vector<BlockEntry> blocks;
    const auto table = bytes.subspan(trailer.table_begin, trailer.table_size);
    try {
        read_table("", table, trailer.table_begin, facts, blocks);
        std::uint64_t begin = sizeof(CheckpointHeader);
        for (BlockEntry& block : blocks) {
            if (block.size > trailer.table_begin - begin) return;
            block.hash = hash_of(bytes.subspan(begin, block.size));
            begin += block.size;
        }
        const std::size_t size = blocks.size() * sizeof(BlockEntry);
        std::memcpy(file.data() + trailer.table_begin + trailer.table_size - size, blocks.data(),
                    size);
    } catch (const InputError&) {
    }
    trailer.table_hash = hash_of(table);
    std::memcpy(file.data() + file.size() - sizeof trailer, &trailer, sizeof trailer);
}

}  // namespace octetra::test
