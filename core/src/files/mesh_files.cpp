#include <octetra/core/files/mesh_files.hpp>

#include <array>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/files/checkpoint.hpp>
#include <octetra/core/files/output_paths.hpp>
#include <octetra/core/files/sol_files.hpp>
#include <octetra/core/mesh_formats.hpp>
#include <octetra/core/mesh_share.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "files/gmsh/gmsh.hpp"
#include "files/input/growing_mesh.hpp"
#include "files/medit/medit.hpp"
#include "files/output/losses.hpp"
#include "files/output/places.hpp"
#include "files/tetgen/tetgen.hpp"
#include "files/vtk/vtu.hpp"
#include "files/xdmf/xdmf.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;

/// Returns a hint for error messages if the extension would be known in lower case.
std::string_view hint_at_case(const fs::path& path) {
    std::string extension = path.extension().native();
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return format_of("mesh" + extension) != Format::unknown ? ", in lower case" : "";
}

/// Throws InputError with the reason why no mesh can be read from this file.
[[noreturn]] void refuse_to_read(const fs::path& path) {
    if (is_checkpoint(path)) {
        throw InputError(
            fmt::format("{}: a checkpoint is loaded by AdaptiveMesh::load", path.native()));
    }
    if (format_of(path) != Format::unknown) {
        throw InputError(
            fmt::format("{}: {} files are written, not read; read .ele/.node, .mesh, .meshb, .msh "
                        "or .octetra",
                        path.native(), path.extension().native()));
    }
    throw InputError(fmt::format(
        "{}: the extension of a mesh to read must be .ele or .node (TetGen), .mesh or .meshb "
        "(Medit), .msh (Gmsh), or .octetra (with its history){}",
        path.native(), hint_at_case(path)));
}

/// Collective in the group of `growing`. Performs semantic checks unless the options have
/// only_syntax, which a sink and a share require.
void read_into(GrowingMesh& growing, const fs::path& path, const ReadOptions& options) {
    switch (format_of(path)) {
        case Format::tetgen: return read_tetgen(path, options, growing);
        case Format::medit: return read_medit(path, options, growing);
        case Format::meshb: return read_meshb(path, options, growing);
        case Format::gmsh: return read_gmsh(path, options, growing);
        default: refuse_to_read(path);
    }
}

/// The formats other than TetGen's have a marker for each entity, 0 for none.
bool zeros_are_none(const fs::path& path) { return format_of(path) != Format::tetgen; }

template <class I, std::size_t N>
void refuse_repeated_vertices(const IndexVector<I, std::array<VertexIndex, N>>& list) {
    for (const auto& vertices : list) {
        bool repeated = false;
        for (std::size_t k = 0; k < N; ++k) {
            for (std::size_t j = 0; j < k; ++j) repeated |= vertices[j] == vertices[k];
        }
        if (repeated) throw InputError("the same vertex twice");
    }
}

/// Collective. As read_mesh_share(), but throws.
MeshShare read_share(const fs::path& path, const ProcessGroup& group) {
    std::vector<std::string> notes;
    const auto note = [&](const std::string& text) { notes.push_back(text); };
    GrowingMesh growing(zeros_are_none(path), group);
    read_into(growing, path, {.only_syntax = true, .note = note});
    refuse_repeated_vertices(growing.mesh.cells);
    refuse_repeated_vertices(growing.mesh.facets);
    refuse_repeated_vertices(growing.mesh.edges);
    MeshShare share = growing.finish();
    share.notes = std::move(notes);
    return share;
}

}  // namespace

Mesh read_mesh(const fs::path& path, const ReadOptions& options) {
    const StandardArithmetic standard;
    GrowingMesh growing(zeros_are_none(path));
    read_into(growing, path, options);
    Mesh mesh = growing.finish().lists;
    for (const Feature feature : all_features) sort_unique(mesh.features[feature]);
    return mesh;
}

void stream_mesh(const fs::path& path, MeshSink& sink, const ReadOptions& options) {
    const StandardArithmetic standard;
    GrowingMesh growing(zeros_are_none(path), sink);
    read_into(growing, path, {.only_syntax = true, .note = options.note});
    growing.finish_sink();
}

std::optional<MeshShare> read_mesh_share(const fs::path& path, const ProcessGroup& group) {
    const StandardArithmetic standard;
    try {
        return group.transaction([&] { return read_share(path, group); });
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {  // is reported by the process that reads the file alone
    }
    return std::nullopt;
}

namespace {

/// Returns "field 'a' is", or "fields 'a', 'b' are".
std::string fields_are(const std::vector<FieldFacts>& fields) {
    std::string names;
    for (const FieldFacts& field : fields) {
        names += fmt::format("{}'{}'", names.empty() ? "" : ", ", field.name);
    }
    return fields.size() == 1 ? fmt::format("field {} is", names)
                              : fmt::format("fields {} are", names);
}

/// Returns the fields for which a reader will find another name.
std::vector<FieldFacts> losing_their_names(const std::vector<FieldFacts>& held) {
    std::vector<FieldFacts> losing;
    std::array<std::size_t, 2> count{};
    for (const FieldFacts& field : held) {
        const std::size_t number = ++count.at(static_cast<std::size_t>(field.on));
        if (field.name != sol_field_name(number)) losing.push_back(field);
    }
    return losing;
}

void add_lost_fields(std::string& lost, const MeshSource& mesh, const fs::path& path) {
    if (mesh.fields().empty() || can_hold_fields(path)) return;
    const std::optional<fs::path> beside = sol_path_for(path);
    std::vector<FieldFacts> held;
    std::vector<FieldFacts> left_out;
    for (const FieldFacts& field : mesh.fields()) {
        (beside && sol_can_hold(field) ? held : left_out).push_back(field);
    }
    if (!left_out.empty() && !beside) {
        add_loss(lost, fmt::format("{} not in {}: .vtu, .pvtu, .vtkhdf, .xdmf and .octetra files "
                                   "hold fields, and a .sol or .solb beside a Medit mesh",
                                   fields_are(left_out), path.native()));
    } else if (!left_out.empty()) {
        add_loss(lost, fmt::format("{} not in {}, which holds reals, and whole numbers of 32 bits, "
                                   "of 1, 3, 6 or 9 components",
                                   fields_are(left_out), beside->native()));
    }
    if (const auto losing = losing_their_names(held); !losing.empty()) {
        add_loss(lost, fmt::format("{} stored in {} in order, without a name", fields_are(losing),
                                   beside->native()));
    }
}

/// Returns the message on all data that a format cannot represent. `lost` is the message without
/// group names, features and fields.
std::string all_lost(std::string lost, const MeshSource& mesh, const fs::path& path) {
    const MeshFormat format = mesh_format_of(path);
    if (!mesh.facts().group_names.empty() && !format.group_names) {
        add_loss(lost, group_names_are_lost);
    }
    if (has_any(mesh.facts().features) && !format.features) add_loss(lost, features_are_lost);
    add_lost_fields(lost, mesh, path);
    return lost;
}

/// Returns the message on lost data, except for group names, features and fields.
std::string write_lists(MeshSource& mesh, const fs::path& path, const WriteOptions& options) {
    mesh.group().on_first([&] { check_writable(path); });
    switch (format_of(path)) {
        case Format::tetgen: write_tetgen(mesh, path); return {};
        case Format::medit: return write_medit(mesh, path);
        case Format::meshb: return write_meshb(mesh, path);
        case Format::gmsh: return write_gmsh(mesh, path, options.msh);
        case Format::vtu: return write_vtu(mesh, path);
        case Format::vtkhdf: return write_vtkhdf(mesh, path);
        case Format::xdmf: return write_xdmf(mesh, path);
        case Format::pvtu: return write_pvtu(mesh, ProcessGroup::alone(), path);
        case Format::checkpoint:
        case Format::unknown: break;
    }
    return {};
}

}  // namespace

std::string write_mesh(MeshSource& mesh, const fs::path& path, const WriteOptions& options) {
    const StandardArithmetic standard;
    return all_lost(write_lists(mesh, path, options), mesh, path);
}

std::string write_mesh(const Mesh& mesh, const fs::path& path, const WriteOptions& options) {
    const StandardArithmetic standard;
    WholeMesh source(mesh);
    return write_mesh(source, path, options);
}

bool can_hold_attributes(const fs::path& path) { return mesh_format_of(path).attributes; }

bool can_hold_vertex_markers(const fs::path& path) { return mesh_format_of(path).vertex_markers; }

bool can_hold_fields(const fs::path& path) { return mesh_format_of(path).fields; }

bool is_in_pieces(const fs::path& path) { return format_of(path) == Format::pvtu; }

std::string write_pieces(MeshSource& piece, const ProcessGroup& group, const fs::path& path) {
    const StandardArithmetic standard;
    group.on_first([&] { check_writable(path, group.size()); });
    return all_lost(write_pvtu(piece, group, path), piece, path);
}

void check_writable(const fs::path& path, int pieces) {
    if (is_checkpoint(path)) {
        throw InputError(
            fmt::format("{}: a checkpoint is written by AdaptiveMesh::save", path.native()));
    }
    if (format_of(path) == Format::unknown) {
        throw InputError(
            fmt::format("{}: the extension of a mesh to write must be .ele or .node "
                        "(TetGen), .mesh or .meshb (Medit), .msh (Gmsh), .vtu, .pvtu or .vtkhdf "
                        "(VTK), .xdmf (XDMF and HDF5), or .octetra (with its history){}",
                        path.native(), hint_at_case(path)));
    }
    check_places(path, pieces);
}

}  // namespace octetra
