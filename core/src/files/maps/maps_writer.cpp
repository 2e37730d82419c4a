#include <octetra/core/files/maps_files.hpp>

#include "files/output/output_file.hpp"
#include "files/output/text_row.hpp"
#include "files/output/text_slices.hpp"

namespace octetra {
namespace {

void put_heading(OutputFile& out, const ProcessGroup& group, std::string_view what,
                 std::uint64_t count) {
    if (!group.is_first()) return;
    out.put(what);
    put_line(out, count);
}

}  // namespace

void write_maps(MeshSource& mesh, const std::filesystem::path& path) {
    const MeshFacts& facts = mesh.facts();
    const ProcessGroup& group = mesh.group();
    const std::uint64_t base = facts.index_base;
    OutputFile out(path, group);
    put_heading(out, group, "cells ", facts.cells);
    put_list(out, facts.cells, group, [&](const Window& window, std::uint64_t cell) {
        for (const std::uint64_t parent : mesh.parents(window)) {
            put_line(out, base + cell++, base + parent);
        }
    });
    const std::uint64_t midpoints = facts.vertices - facts.first_midpoint;
    put_heading(out, group, "midpoints ", midpoints);
    put_list(out, midpoints, group, [&](const Window& window, std::uint64_t midpoint) {
        for (const auto& [a, b] : mesh.midpoint_ends(window)) {
            put_line(out, base + facts.first_midpoint + midpoint++, base + a, base + b);
        }
    });
    out.commit();
}

}  // namespace octetra
