#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include <octetra/core/error.hpp>

#include "files/output_file.hpp"
#include "files/vtu.hpp"

namespace octetra {
namespace {

/// How many bytes are compressed at a time: what is held in memory, and what a reader can skip to.
constexpr std::size_t block_size = std::size_t{1} << 17U;

/// One array of the file: what the XML says of it, and where its values come from.
struct DataArray {
    std::string attributes;  ///< type, name and number of components
    std::size_t value_count = 0;
    std::size_t value_size = 0;
    /// Writes values first .. first+count-1 to `out`.
    std::function<void(std::size_t first, std::size_t count, char* out)> copy;
};

template <class T>
constexpr const char* vtk_type = "UInt8";
template <>
constexpr const char* vtk_type<double> = "Float64";
template <>
constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
constexpr const char* vtk_type<std::int32_t> = "Int32";

/// An array whose value number i is value(i).
template <class T>
DataArray array(std::string_view name, std::size_t components, std::size_t value_count,
                auto value) {
    return {fmt::format(R"(type="{}" Name="{}" NumberOfComponents="{}")", vtk_type<T>, name,
                        components),
            value_count, sizeof(T), [value](std::size_t first, std::size_t count, char* out) {
                for (std::size_t i = 0; i < count; ++i) {
                    const T v = value(first + i);
                    std::memcpy(out + i * sizeof(T), &v, sizeof(T));
                }
            }};
}

class VtuWriter {
public:
    VtuWriter(const std::filesystem::path& path, const Mesh& mesh) : out_(path), mesh_(&mesh) {}

    void write(const std::vector<DataArray>& point_data, const std::vector<DataArray>& cell_data) {
        static_assert(std::endian::native == std::endian::little);
        put("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" header_type=\"UInt64\" "
            "compressor=\"vtkZLibDataCompressor\">\n  <UnstructuredGrid>\n");
        put(fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                        mesh_->points.size(), mesh_->cells.size()));
        declare("Points", {coordinates()});
        declare("Cells", {connectivity(), offsets(), types()});
        declare("PointData", point_data);
        declare("CellData", cell_data);
        put("    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n   _");
        const std::uint64_t data_begin = out_.position();
        for (const Declared& declared : declared_) {
            const std::string offset = fmt::format("{}\"", out_.position() - data_begin);
            out_.overwrite(declared.offset_position, offset.data(), offset.size());
            append(declared.array);
        }
        put("\n  </AppendedData>\n</VTKFile>\n");
        out_.commit();
    }

private:
    struct Declared {
        DataArray array;
        std::uint64_t offset_position;
    };

    void put(std::string_view text) { out_.put(text); }

    void declare(std::string_view element, const std::vector<DataArray>& arrays) {
        put(fmt::format("      <{}>\n", element));
        for (const DataArray& array : arrays) {
            put(fmt::format("        <DataArray {} format=\"appended\" offset=\"",
                            array.attributes));
            // The offset is known only when the arrays before it are compressed: leave room.
            constexpr std::string_view room = "                     ";
            declared_.push_back({array, out_.position()});
            put(room);
            put("/>\n");
        }
        put(fmt::format("      </{}>\n", element));
    }

    /// The compressed blocks, and before them their number, size, last one's size and lengths.
    void append(const DataArray& array) {
        const std::size_t size = array.value_count * array.value_size;
        const std::size_t values_per_block = block_size / array.value_size;
        const std::size_t blocks = (size + block_size - 1) / block_size;
        std::vector<std::uint64_t> header{blocks, block_size, size % block_size};
        header.resize(3 + blocks, 0);
        const std::uint64_t header_position = out_.position();
        put_header(header);

        std::vector<char> plain(block_size);
        std::vector<Bytef> packed(compressBound(block_size));
        for (std::size_t b = 0; b < blocks; ++b) {
            const std::size_t first = b * values_per_block;
            const std::size_t count = std::min(values_per_block, array.value_count - first);
            array.copy(first, count, plain.data());
            uLongf packed_size = packed.size();
            const int status =
                compress2(packed.data(), &packed_size, reinterpret_cast<const Bytef*>(plain.data()),
                          count * array.value_size, Z_BEST_SPEED);
            if (status != Z_OK) throw SystemError("zlib failed to compress a block");
            out_.put_bytes(packed.data(), packed_size);
            header[3 + b] = packed_size;
        }
        out_.overwrite(header_position, header.data(), header.size() * sizeof(header[0]));
    }

    void put_header(const std::vector<std::uint64_t>& header) {
        out_.put_bytes(header.data(), header.size() * sizeof(header[0]));
    }

    [[nodiscard]] DataArray coordinates() const {
        return array<double>("Points", 3, 3 * mesh_->points.size(), [mesh = mesh_](std::size_t i) {
            const Point& p = mesh->points[VertexIndex{i / 3}];
            return i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : p.z;
        });
    }

    [[nodiscard]] DataArray connectivity() const {
        return array<std::int64_t>(
            "connectivity", 1, 4 * mesh_->cells.size(), [mesh = mesh_](std::size_t i) {
                return std::int64_t{mesh->cells[CellIndex{i / 4}][i % 4].value()};
            });
    }

    [[nodiscard]] DataArray offsets() const {
        return array<std::int64_t>("offsets", 1, mesh_->cells.size(), [](std::size_t i) {
            return static_cast<std::int64_t>(4 * (i + 1));
        });
    }

    [[nodiscard]] DataArray types() const {
        constexpr std::uint8_t vtk_tetra = 10;
        return array<std::uint8_t>("types", 1, mesh_->cells.size(),
                                   [](std::size_t) { return vtk_tetra; });
    }

    OutputFile out_;
    const Mesh* mesh_;
    std::vector<Declared> declared_;
};

}  // namespace

std::string write_vtu(const Mesh& mesh, const std::filesystem::path& path,
                      const WriteExtras& extras) {
    std::vector<DataArray> point_data;
    if (!mesh.point_markers.empty()) {
        point_data.push_back(array<Marker>("marker", 1, mesh.points.size(), [&](std::size_t i) {
            return mesh.point_markers[VertexIndex{i}];
        }));
    }
    if (mesh.attributes_per_point > 0) {
        point_data.push_back(
            array<double>("attributes", mesh.attributes_per_point, mesh.point_attributes.size(),
                          [&](std::size_t i) { return mesh.point_attributes[i]; }));
    }
    std::vector<DataArray> cell_data;
    if (!mesh.regions.empty()) {
        cell_data.push_back(array<Marker>("region", 1, mesh.cells.size(), [&](std::size_t i) {
            return mesh.regions[CellIndex{i}];
        }));
    }
    if (extras.cell_to_parent != nullptr) {
        cell_data.push_back(array<std::int64_t>(
            "parent", 1, mesh.cells.size(),
            [parents = extras.cell_to_parent, first = mesh.first_number](std::size_t i) {
                return std::int64_t{(*parents)[CellIndex{i}].value()} + first;
            }));
    }
    VtuWriter(path, mesh).write(point_data, cell_data);

    if (mesh.facets.empty() && mesh.edges.empty()) return {};
    return fmt::format(
        "the .vtu file holds cells only, not the {} listed faces and {} listed "
        "edges with their markers; .mesh and .ele hold them",
        mesh.facets.size(), mesh.edges.size());
}

}  // namespace octetra
