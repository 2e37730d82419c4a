#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <new>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "files/output/output_file.hpp"
#include "files/output/vtk_arrays.hpp"
#include "files/vtk/vtu.hpp"

namespace octetra {
namespace {

/// The lengths of consecutive compressed blocks of an array.
struct PackedLengths {
    std::uint64_t first_block = 0;
    std::vector<std::uint64_t> bytes;
};

/// Returns the length of slices, in entities: a multiple of whole blocks, so that each block
/// belongs to one process; at most a buffer's length; for a small array about an equal share.
std::uint64_t slice_length(const VtuArray& array, const ProcessGroup& group) {
    constexpr std::uint64_t most_bytes = 8 * vtu_block_size;
    const std::uint64_t unit = vtu_block_size / std::gcd(vtu_block_size, array.entity_size());
    const std::uint64_t share = array.entities / static_cast<std::uint64_t>(group.size());
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): an entity has some bytes.
    const std::uint64_t most = most_bytes / (unit * array.entity_size());
    return unit * std::clamp(share / unit, std::uint64_t{1}, std::max(most, std::uint64_t{1}));
}

class VtuFile {
public:
    VtuFile(OutputFile& out, const ProcessGroup& group) : out_(&out), group_(&group) {}

    void write(MeshSource& mesh, const VtuData& data) {
        static_assert(std::endian::native == std::endian::little);
        put("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" header_type=\"UInt64\" "
            "compressor=\"vtkZLibDataCompressor\">\n  <UnstructuredGrid>\n");
        put(fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                        mesh.facts().vertices, mesh.facts().cells));
        declare("Points", {vtu_coordinates(mesh)});
        declare("Cells", vtu_cells(mesh));
        declare("PointData", data.of_points, data.point_attributes);
        declare("CellData", data.of_cells);
        put("    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n   _");
        out_->end_turn();
        const std::uint64_t data_begin = out_->position();
        for (const Declared& declared : declared_) {
            if (group_->is_first()) {
                const std::string offset = fmt::format("{}\"", out_->position() - data_begin);
                out_->overwrite(declared.offset_position, offset.data(), offset.size());
            }
            append(declared.array);
        }
        put("\n  </AppendedData>\n</VTKFile>\n");
        out_->end_turn();
    }

private:
    struct Declared {
        VtuArray array;
        std::uint64_t offset_position;  // on the first process
    };

    /// Writes on the first process only: text that occurs once in the file.
    void put(std::string_view text) {
        if (group_->is_first()) out_->put(text);
    }

    void declare(std::string_view element, const std::vector<VtuArray>& arrays,
                 std::string_view attributes = "") {
        put(fmt::format("      <{}{}>\n", element, attributes));
        for (const VtuArray& array : arrays) {
            put(fmt::format("        <DataArray {} format=\"appended\" offset=\"",
                            vtu_attributes(array)));
            // The offset is known only after the preceding arrays have been compressed: reserve
            // space for it.
            constexpr std::string_view room = "                     ";
            declared_.push_back({array, out_->position()});
            put(room);
            put("/>\n");
        }
        put(fmt::format("      </{}>\n", element));
    }

    /// Writes the compressed blocks after a header: their number, size, size of the last one, and
    /// compressed lengths.
    void append(const VtuArray& array) {
        const std::uint64_t size = array.entities * array.entity_size();
        std::vector<std::uint64_t> header{(size + vtu_block_size - 1) / vtu_block_size,
                                          vtu_block_size, size % vtu_block_size};
        const std::uint64_t lengths_position = out_->position() + header.size() * sizeof(header[0]);
        header.resize(header.size() + header[0], 0);
        if (group_->is_first()) {
            out_->put_bytes(header.data(), header.size() * sizeof(header[0]));
        }
        out_->end_turn();
        for (const PackedLengths& packed : put_slices(array)) {
            const std::uint64_t place = packed.first_block * sizeof(packed.bytes[0]);
            out_->overwrite(lengths_position + place, packed.bytes.data(),
                            packed.bytes.size() * sizeof(packed.bytes[0]));
        }
    }

    std::vector<PackedLengths> put_slices(const VtuArray& array) {
        std::vector<PackedLengths> lengths;
        const std::uint64_t length = slice_length(array, *group_);
        const std::uint64_t stride = length * static_cast<std::uint64_t>(group_->size());
        for (Window w{0, length, array.entities}; w.begin < w.count; w.begin += stride) {
            array.bytes_of_slice(w, slice_);
            PackedLengths& packed = lengths.emplace_back();
            packed.first_block = w.begin_of(group_->rank()) * array.entity_size() / vtu_block_size;
            for (std::size_t begin = 0; begin < slice_.size(); begin += vtu_block_size) {
                const std::size_t count = std::min(vtu_block_size, slice_.size() - begin);
                packed.bytes.push_back(put_compressed(slice_.data() + begin, count));
            }
            if (group_->size() > 1) out_->end_turn();
        }
        return lengths;
    }

    std::uint64_t put_compressed(const char* bytes, std::size_t count) {
        uLongf packed_size = packed_.size();
        const int status = compress2(packed_.data(), &packed_size,
                                     reinterpret_cast<const Bytef*>(bytes), count, Z_BEST_SPEED);
        if (status != Z_OK) throw std::bad_alloc();  // the buffer suffices for the worst case
        out_->put_bytes(packed_.data(), packed_size);
        return packed_size;
    }

    OutputFile* out_;
    const ProcessGroup* group_;
    std::vector<Declared> declared_;
    std::vector<char> slice_;
    std::vector<Bytef> packed_ = std::vector<Bytef>(compressBound(vtu_block_size));
};

}  // namespace

void put_vtu(OutputFile& out, MeshSource& mesh, const VtuData& data) {
    VtuFile(out, mesh.group()).write(mesh, data);
}

std::string write_vtu(MeshSource& mesh, const std::filesystem::path& path) {
    OutputFile out(path, mesh.group());
    put_vtu(out, mesh, vtu_data(mesh));
    out.commit();
    return lists_left_out(path, mesh.facts().facets, mesh.facts().edges);
}

std::string lists_left_out(const std::filesystem::path& path, std::uint64_t facets,
                           std::uint64_t edges) {
    if (facets == 0 && edges == 0) return {};
    const std::string what =
        edges == 0    ? fmt::format("{} tagged facets", facets)
        : facets == 0 ? fmt::format("{} tagged edges", edges)
                      : fmt::format("{} tagged facets and {} tagged edges", facets, edges);
    return fmt::format(
        "the {} file holds cells only, not the {} with their markers; files of TetGen, Medit and "
        "Gmsh, .xdmf and .octetra hold them",
        path.extension().native(), what);
}

}  // namespace octetra
