#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>

#include "files/output/output_file.hpp"
#include "files/output/places.hpp"
#include "files/output/vtk_arrays.hpp"
#include "files/vtk/vtu.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;

void put_declarations(OutputFile& out, std::string_view element,
                      const std::vector<VtuArray>& arrays, std::string_view attributes = "") {
    out.put(fmt::format("    <{}{}>\n", element, attributes));
    for (const VtuArray& array : arrays) {
        out.put(fmt::format("      <PDataArray {}/>\n", vtu_attributes(array)));
    }
    out.put(fmt::format("    </{}>\n", element));
}

void write_index(const fs::path& path, MeshSource& piece, const VtuData& data, int pieces) {
    OutputFile out(path);
    out.put(
        std::string_view{"<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" "
                         "version=\"1.0\" byte_order=\"LittleEndian\" "
                         "header_type=\"UInt64\">\n  <PUnstructuredGrid GhostLevel=\"0\">\n"});
    put_declarations(out, "PPoints", {vtu_coordinates(piece)});
    put_declarations(out, "PPointData", data.of_points, data.point_attributes);
    put_declarations(out, "PCellData", data.of_cells);
    for (int rank = 0; rank < pieces; ++rank) {
        out.put(fmt::format("    <Piece Source=\"{}\"/>\n",
                            xml_escaped(piece_path(path, rank).filename().native())));
    }
    out.put(std::string_view{"  </PUnstructuredGrid>\n</VTKFile>\n"});
    out.commit();
}

/// Removes pieces of a previous `.pvtu` of this name beyond those of the new one, which would
/// appear to be part of it.
void remove_stale_pieces(const fs::path& path, int pieces) {
    for (int rank = pieces; fs::is_regular_file(piece_path(path, rank)); ++rank) {
        fs::remove(piece_path(path, rank));
    }
}

/// Collective. Runs `work` on all processes; a SystemError on any of them is thrown on all.
void run_collectively(const ProcessGroup& group, auto&& work) {
    std::string failure;
    try {
        work();
    } catch (const SystemError& error) {
        failure = error.what();
    }
    group.agree(failure);
}

}  // namespace

std::string write_pvtu(MeshSource& piece, const ProcessGroup& group, const fs::path& path) {
    const VtuData data = vtu_data_of_piece(piece, group.rank());
    std::unique_ptr<OutputFile> out;
    run_collectively(group, [&] {
        out = std::make_unique<OutputFile>(piece_path(path, group.rank()));
        put_vtu(*out, piece, data);
        out->close();
    });
    run_collectively(group, [&] { out->commit(); });
    group.on_first([&] {
        const bool replaces = fs::exists(path);
        write_index(path, piece, data, group.size());
        if (replaces) remove_stale_pieces(path, group.size());
    });

    return lists_left_out(path, group.sum(piece.facts().facets), group.sum(piece.facts().edges));
}

}  // namespace octetra
