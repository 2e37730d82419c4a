#include <fmt/format.h>

#include <octetra/core/files/maps_files.hpp>
#include <octetra/core/maps.hpp>

#include "files/input/fields.hpp"
#include "files/input/line_reader.hpp"

namespace octetra {
namespace {

/// Reads "WORD COUNT", followed by entries of `fields_per_entry` numbers. Returns the count.
std::uint64_t read_heading(LineReader& reader, std::string_view word,
                           std::size_t fields_per_entry) {
    if (!reader.next()) reader.fail(fmt::format("the file ends where '{}' should be", word));
    Fields fields(reader);
    if (const std::string_view found = fields.text(); found != word) {
        reader.fail(fmt::format("'{}' expected, {} found", word, shown(found)));
    }
    const std::uint64_t count = fields.unsigned_integer("the number of entries");
    fields.expect_end(2);
    reader.check_count(count, fields_per_entry, "entries");
    return count;
}

/// Reads an index counted from `index_base`.
template <class I>
I read_index(Fields& fields, LineReader& reader, std::uint32_t index_base) {
    const std::uint64_t number = fields.unsigned_integer("a number");
    const std::uint64_t index = number - index_base;  // wraps around below index_base
    if (index >= I::limit) {
        reader.fail(fmt::format("a number from {} expected, {} found", index_base, number));
    }
    return I{index};
}

}  // namespace

RefinementMaps read_maps(const std::filesystem::path& path, std::uint32_t index_base) {
    LineReader reader(path);
    RefinementMaps maps;
    const auto next_entry = [&](std::uint64_t i, std::uint64_t count) {
        if (!reader.next()) {
            reader.fail(fmt::format("the file ends after {} of {} entries", i, count));
        }
        return Fields(reader);
    };
    const std::uint64_t cells = read_heading(reader, "cells", 2);
    maps.cell_to_parent.reserve(cells);
    for (std::uint64_t i = 0; i < cells; ++i) {
        Fields fields = next_entry(i, cells);
        if (read_index<CellIndex>(fields, reader, index_base) != CellIndex{i}) {
            reader.fail(fmt::format("cell number {} expected", i + index_base));
        }
        maps.cell_to_parent.push_back(read_index<CellIndex>(fields, reader, index_base));
        fields.expect_end(2);
    }
    const std::uint64_t midpoints = read_heading(reader, "midpoints", 3);
    maps.midpoint_to_edge.reserve(midpoints);
    for (std::uint64_t i = 0; i < midpoints; ++i) {
        Fields fields = next_entry(i, midpoints);
        const auto vertex = read_index<VertexIndex>(fields, reader, index_base);
        if (i == 0) maps.first_midpoint = vertex;
        if (vertex.value() != maps.first_midpoint.value() + i) {
            reader.fail("the midpoints' numbers do not follow one another");
        }
        const auto a = read_index<VertexIndex>(fields, reader, index_base);
        const auto b = read_index<VertexIndex>(fields, reader, index_base);
        fields.expect_end(3);
        maps.midpoint_to_edge.push_back({a, b});
    }
    if (reader.next()) reader.fail("text after the last midpoint");
    return maps;
}

}  // namespace octetra
