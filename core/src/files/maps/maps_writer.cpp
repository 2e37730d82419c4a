#include <octetra/core/files/maps_files.hpp>

#include "files/output/output_file.hpp"
#include "files/output/text_slices.hpp"

namespace octetra {
namespace {

void put_heading(OutputFile& out, const ProcessGroup& group, std::string_view what,
                 std::uint64_t count) {
    if (!group.is_first()) return;
    out.put(what);
    out.put(count);
    out.put('\n');
}

}  // namespace

void write_maps(MeshSource& mesh, const std::filesystem::path& path) {
    const MeshFacts& facts = mesh.facts();
    const ProcessGroup& group = mesh.group();
    const auto put_number = [first = facts.index_base](OutputFile& out, std::uint64_t number) {
        out.put(number + first);
    };
    OutputFile out(path, group);
    put_heading(out, group, "cells ", facts.cells);
    put_list(out, facts.cells, group, [&](const Window& window, std::uint64_t cell) {
        for (const std::uint64_t parent : mesh.parents(window)) {
            put_number(out, cell++);
            out.put(' ');
            put_number(out, parent);
            out.put('\n');
        }
    });
    const std::uint64_t midpoints = facts.vertices - facts.first_midpoint;
    put_heading(out, group, "midpoints ", midpoints);
    put_list(out, midpoints, group, [&](const Window& window, std::uint64_t midpoint) {
        for (const auto& [a, b] : mesh.midpoint_ends(window)) {
            put_number(out, facts.first_midpoint + midpoint++);
            out.put(' ');
            put_number(out, a);
            out.put(' ');
            put_number(out, b);
            out.put('\n');
        }
    });
    out.commit();
}

}  // namespace octetra
