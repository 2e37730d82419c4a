#include "files/tetgen/lines.hpp"

#include <system_error>

namespace octetra::tetgen {
namespace {

namespace fs = std::filesystem;

/// Reads the numbers of a header line; omitted ones have TetGen's defaults.
template <std::size_t N>
std::array<std::uint64_t, N> read_header(LineReader& reader,
                                         const std::array<std::string_view, N>& names,
                                         const std::array<std::uint64_t, N>& defaults) {
    if (!reader.next()) reader.fail("the file ends before its header line");
    Fields fields(reader);
    std::array<std::uint64_t, N> values = defaults;
    for (std::size_t k = 0; k < N && (k == 0 || !fields.at_end()); ++k) {
        values[k] = fields.unsigned_integer(names[k]);
    }
    fields.expect_end(N);
    return values;
}

void check_markers_flag(std::uint64_t markers, const LineReader& reader) {
    if (markers > 1) reader.fail(fmt::format("the markers flag is 0 or 1, not {}", markers));
}

}  // namespace

NodeHead read_node_head(LineReader& reader) {
    const auto [count, dimension, attributes, markers] =
        read_header<4>(reader,
                       {"the number of vertices", "the dimension",
                        "the number of attributes per vertex", "the markers flag"},
                       {0, 3, 0, 0});
    if (dimension != 3) reader.fail(fmt::format("dimension 3 expected, {} found", dimension));
    check_markers_flag(markers, reader);
    constexpr std::uint64_t most_attributes = 1000;
    if (attributes > most_attributes) {
        reader.fail(fmt::format("{} attributes per vertex; at most {} are supported", attributes,
                                most_attributes));
    }
    const NodeHead head{count, attributes, markers};
    reader.check_count(count, head.field_count(), "vertices");
    return head;
}

EleHead read_ele_head(LineReader& reader) {
    const auto [count, corners, attributes] =
        read_header<3>(reader,
                       {"the number of cells", "the number of vertices per cell",
                        "the number of attributes per cell"},
                       {0, 4, 0});
    if (corners == 10) {
        reader.fail(
            "these are second-order cells (10 vertices each); only those with 4 are supported, "
            "which tetgen makes without -o2");
    }
    if (corners != 4) reader.fail(fmt::format("4 vertices per cell expected, {} found", corners));
    if (attributes > 1) {
        reader.fail(fmt::format("{} attributes per cell; only one, the region tag, is supported",
                                attributes));
    }
    const EleHead head{count, attributes};
    reader.check_count(count, head.field_count(), "cells");
    return head;
}

ListHead read_list_head(LineReader& reader, std::size_t vertices) {
    const auto [count, markers] =
        read_header<2>(reader, {"the number of entries", "the markers flag"}, {0, 0});
    check_markers_flag(markers, reader);
    reader.check_count(count, 1 + vertices + markers, "entries");
    return {count, markers};
}

void refuse_vertex(std::uint64_t number, const LineReader& reader, NumberedVertices numbers) {
    reader.fail(fmt::format("there is no vertex {}: the {} vertices are numbered from {}", number,
                            numbers.count, numbers.first));
}

fs::path companion(fs::path path, std::string_view extension) {
    return path.replace_extension(extension);
}

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::symlink_status(path, ignored).type() != fs::file_type::not_found;
}

}  // namespace octetra::tetgen
