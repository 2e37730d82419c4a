#include "files/output/vtk_arrays.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace octetra {
namespace {

template <class T>
constexpr const char* vtk_type = "UInt8";
template <>
constexpr const char* vtk_type<double> = "Float64";
template <>
constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
constexpr const char* vtk_type<std::int32_t> = "Int32";

using BytesOfSlice = std::function<void(const Window&, std::vector<char>&)>;

template <class T>
VtuArray described(std::string name, std::size_t components, std::uint64_t entities,
                   BytesOfSlice bytes_of_slice) {
    return {.name = std::move(name),
            .type = vtk_type<T>,
            .value_size = sizeof(T),
            .components = components,
            .values_per_entity = components,
            .entities = entities,
            .bytes_of_slice = std::move(bytes_of_slice)};
}

/// Returns an array whose values, for a slice of entities, are value(slice, i) for each i.
template <class T>
VtuArray array(std::string name, std::size_t components, std::uint64_t entities, auto get_slice,
               auto value) {
    return described<T>(std::move(name), components, entities,
                        [=](const Window& window, std::vector<char>& out) {
                            const auto slice = get_slice(window);
                            const std::size_t count = slice.size();
                            out.resize(count * sizeof(T));
                            for (std::size_t i = 0; i < count; ++i) {
                                const T v = value(slice, i);
                                std::memcpy(out.data() + i * sizeof(T), &v, sizeof(T));
                            }
                        });
}

/// Returns an array of values in the format in which the mesh stores them.
template <class T>
VtuArray plain_array(std::string name, std::size_t components, std::uint64_t entities,
                     auto get_slice) {
    return described<T>(std::move(name), components, entities,
                        [=](const Window& window, std::vector<char>& out) {
                            const auto bytes = std::as_bytes(get_slice(window));
                            out.resize(bytes.size());
                            if (!bytes.empty()) {
                                std::memcpy(out.data(), bytes.data(), bytes.size());
                            }
                        });
}

/// The numbers of the entities of a slice, for values computed from the number.
struct Numbers {
    std::uint64_t first = 0;
    std::uint64_t end = 0;
    [[nodiscard]] std::size_t size() const { return end - first; }
};

auto numbers_of(const ProcessGroup& group) {
    return [rank = group.rank()](const Window& window) {
        return Numbers{window.begin_of(rank), window.end_of(rank)};
    };
}

const char* vtk_type_of(FieldType type) {
    switch (type) {
        case FieldType::float64: return "Float64";
        case FieldType::float32: return "Float32";
        case FieldType::int32: return "Int32";
        case FieldType::int64: break;
    }
    return "Int64";
}

VtuArray array_of_field(MeshSource& mesh, std::size_t number) {
    const FieldFacts& field = mesh.fields()[number];
    const MeshFacts& facts = mesh.facts();
    return {.name = field.name,
            .type = vtk_type_of(field.type),
            .value_size = size_of(field.type),
            .components = field.components,
            .values_per_entity = field.components,
            .entities = field.on == FieldOn::vertices ? facts.vertices : facts.cells,
            .bytes_of_slice = [&mesh, number](const Window& window, std::vector<char>& out) {
                const auto bytes = mesh.field_values(number, window);
                out.resize(bytes.size());
                if (!bytes.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
            }};
}

/// Appends the array under a name that is not in use.
void add_field(VtuArray array, std::vector<VtuArray>& arrays) {
    while (std::ranges::find(arrays, array.name, &VtuArray::name) != arrays.end()) {
        array.name += "_field";
    }
    arrays.push_back(std::move(array));
}

void add_fields(MeshSource& mesh, VtuData& data) {
    for (std::size_t f = 0; f < mesh.fields().size(); ++f) {
        const FieldFacts& field = mesh.fields()[f];
        if (field.components == 0) continue;
        add_field(array_of_field(mesh, f),
                  field.on == FieldOn::vertices ? data.of_points : data.of_cells);
    }
}

VtuArray vertex_numbers(MeshSource& piece) {
    const MeshFacts& facts = piece.facts();
    const auto first = std::int64_t{facts.index_base};
    if (!facts.has_vertex_numbers) {
        return array<std::int64_t>("vertex", 1, facts.vertices, numbers_of(piece.group()),
                                   [first](const Numbers& numbers, std::size_t i) {
                                       return static_cast<std::int64_t>(numbers.first + i) + first;
                                   });
    }
    return array<std::int64_t>(
        "vertex", 1, facts.vertices,
        [&piece](const Window& window) { return piece.vertex_numbers(window); },
        [first](std::span<const std::uint64_t> numbers, std::size_t i) {
            return static_cast<std::int64_t>(numbers[i]) + first;
        });
}

VtuArray rank_of_cells(MeshSource& piece, int rank) {
    return array<std::int32_t>("rank", 1, piece.facts().cells, numbers_of(piece.group()),
                               [rank](const Numbers&, std::size_t) { return rank; });
}

}  // namespace

VtuArray vtu_coordinates(MeshSource& mesh) {
    static_assert(sizeof(Point) == 3 * sizeof(double));
    return plain_array<double>("Points", 3, mesh.facts().vertices,
                               [&mesh](const Window& window) { return mesh.points(window); });
}

template <std::size_t N>
VtuArray vtu_connectivity(MeshSource& mesh, std::uint64_t count,
                          std::span<const VertexNumbers<N>> (MeshSource::*list)(const Window&)) {
    const auto vertices = [&mesh, list](const Window& window, std::vector<char>& out) {
        const auto entities = (mesh.*list)(window);
        out.resize(entities.size() * N * sizeof(std::int64_t));
        char* place = out.data();
        for (const VertexNumbers<N>& entity : entities) {
            for (const std::uint64_t vertex : entity) {
                const auto number = static_cast<std::int64_t>(vertex);
                std::memcpy(place, &number, sizeof number);
                place += sizeof number;
            }
        }
    };
    // A flat list: N values of one component for each entity.
    VtuArray connectivity = described<std::int64_t>("connectivity", 1, count, vertices);
    connectivity.values_per_entity = N;
    return connectivity;
}

template VtuArray vtu_connectivity<2>(
    MeshSource&, std::uint64_t, std::span<const VertexNumbers<2>> (MeshSource::*)(const Window&));
template VtuArray vtu_connectivity<3>(
    MeshSource&, std::uint64_t, std::span<const VertexNumbers<3>> (MeshSource::*)(const Window&));
template VtuArray vtu_connectivity<4>(
    MeshSource&, std::uint64_t, std::span<const VertexNumbers<4>> (MeshSource::*)(const Window&));

VtuArray vtu_markers(MeshSource& mesh, std::uint64_t count, bool has_markers,
                     std::span<const Marker> (MeshSource::*markers)(const Window&)) {
    if (has_markers) {
        return plain_array<Marker>("markers", 1, count, [&mesh, markers](const Window& window) {
            return (mesh.*markers)(window);
        });
    }
    return array<Marker>("markers", 1, count, numbers_of(mesh.group()),
                         [](const Numbers&, std::size_t) { return Marker{0}; });
}

std::vector<VtuArray> vtu_cells(MeshSource& mesh) {
    constexpr std::uint8_t vtk_tetra = 10;
    const std::uint64_t count = mesh.facts().cells;
    return {vtu_connectivity(mesh, count, &MeshSource::cells),
            array<std::int64_t>("offsets", 1, count, numbers_of(mesh.group()),
                                [](const Numbers& numbers, std::size_t i) {
                                    return static_cast<std::int64_t>(4 * (numbers.first + i + 1));
                                }),
            array<std::uint8_t>("types", 1, count, numbers_of(mesh.group()),
                                [](const Numbers&, std::size_t) { return vtk_tetra; })};
}

namespace {

/// Returns the data of the mesh itself, without fields.
VtuData data_of_mesh(MeshSource& mesh) {
    const MeshFacts& facts = mesh.facts();
    VtuData data;
    if (facts.has_point_markers) {
        data.of_points.push_back(plain_array<Marker>(
            "marker", 1, facts.vertices,
            [&mesh](const Window& window) { return mesh.point_markers(window); }));
    }
    if (facts.attributes_per_point > 0) {
        data.of_points.push_back(plain_array<double>(
            "attributes", facts.attributes_per_point, facts.vertices,
            [&mesh](const Window& window) { return mesh.point_attributes(window); }));
    }
    if (facts.has_regions) {
        data.of_cells.push_back(
            plain_array<Marker>("region", 1, facts.cells,
                                [&mesh](const Window& window) { return mesh.regions(window); }));
    }
    if (facts.has_parents) {
        data.of_cells.push_back(array<std::int64_t>(
            "parent", 1, facts.cells,
            [&mesh](const Window& window) { return mesh.parents(window); },
            [first = facts.index_base](std::span<const std::uint64_t> parents, std::size_t i) {
                return static_cast<std::int64_t>(parents[i]) + first;
            }));
    }
    return data;
}

}  // namespace

VtuData vtu_data(MeshSource& mesh) {
    VtuData data = data_of_mesh(mesh);
    add_fields(mesh, data);
    return data;
}

VtuData vtu_data_of_piece(MeshSource& piece, int rank) {
    VtuData data = data_of_mesh(piece);
    data.of_points.push_back(vertex_numbers(piece));
    data.point_attributes = " GlobalIds=\"vertex\"";
    data.of_cells.push_back(rank_of_cells(piece, rank));
    add_fields(piece, data);
    return data;
}

std::string xml_escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += c;
        }
    }
    return result;
}

std::string vtu_attributes(const VtuArray& array) {
    return fmt::format(R"(type="{}" Name="{}" NumberOfComponents="{}")", array.type,
                       xml_escaped(array.name), array.components);
}

}  // namespace octetra
