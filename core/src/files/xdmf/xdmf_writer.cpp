#include "files/xdmf/xdmf.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "files/hdf5/hdf5_writer.hpp"
#include "files/output/output_file.hpp"
#include "files/output/places.hpp"
#include "files/output/vtk_arrays.hpp"

namespace octetra {
namespace {

namespace fs = std::filesystem;

/// Reorders a symmetric tensor from xx, yy, zz, xy, yz, xz, as in VTK, to xx, xy, xz, yy, yz, zz;
/// returns other arrays unchanged.
VtuArray in_order_of_xdmf(VtuArray array) {
    static constexpr std::array<std::size_t, 6> component_at{0, 3, 5, 1, 4, 2};
    if (array.components != component_at.size()) return array;
    const auto in_order_of_vtk = std::move(array.bytes_of_slice);
    array.bytes_of_slice = [in_order_of_vtk, size = array.value_size](const Window& window,
                                                                      std::vector<char>& out) {
        std::vector<char> bytes;
        in_order_of_vtk(window, bytes);
        out.resize(bytes.size());
        for (std::size_t row = 0; row < bytes.size(); row += component_at.size() * size) {
            for (std::size_t k = 0; k < component_at.size(); ++k) {
                std::memcpy(out.data() + row + k * size,
                            bytes.data() + row + component_at[k] * size, size);
            }
        }
    };
    return array;
}

/// The contents of both files: the groups and datasets of the HDF5 file, and the text that refers
/// to them. DOLFINx finds grids by name, and expects a grid of tags to have a single attribute.
class XdmfFiles {
public:
    XdmfFiles(MeshSource& mesh, const fs::path& path)
        : mesh_(&mesh), h5_name_(xml_escaped(h5_beside(path).filename().native())) {}

    void describe() {
        const MeshFacts& facts = mesh_->facts();
        text_ = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n";
        add_mesh();
        if (facts.has_regions) {
            add_tags("cell_tags", "Tetrahedron", topology_,
                     vtu_markers(*mesh_, facts.cells, true, &MeshSource::regions));
        }
        if (facts.facets > 0) {
            add_tags("facet_tags", "Triangle",
                     add_topology("facet_tags", 3,
                                  vtu_connectivity(*mesh_, facts.facets, &MeshSource::facets)),
                     vtu_markers(*mesh_, facts.facets, facts.has_facet_markers,
                                 &MeshSource::facet_markers));
        }
        if (facts.edges > 0) {
            add_tags("edge_tags", "Polyline",
                     add_topology("edge_tags", 2,
                                  vtu_connectivity(*mesh_, facts.edges, &MeshSource::edges)),
                     vtu_markers(*mesh_, facts.edges, facts.has_edge_markers,
                                 &MeshSource::edge_markers));
        }
        text_ += "  </Domain>\n</Xdmf>\n";
    }

    [[nodiscard]] const std::string& text() const { return text_; }
    [[nodiscard]] const std::vector<Hdf5Group>& groups() const { return groups_; }
    [[nodiscard]] const std::vector<FilledDataset>& datasets() const { return datasets_; }

private:
    /// A dataset as referred to in XML.
    struct Item {
        std::uint64_t rows = 0;
        std::size_t columns = 1;
        std::string text;
    };

    void add_mesh() {
        groups_ = {{"/Mesh"}, {"/PointData"}, {"/CellData"}, {"/Tags"}};
        topology_ = add_topology(
            "mesh", 4, vtu_connectivity(*mesh_, mesh_->facts().cells, &MeshSource::cells));
        geometry_ = add("/Mesh/geometry", vtu_coordinates(*mesh_));
        begin_grid("mesh", "Tetrahedron", topology_);
        const VtuData data = vtu_data(*mesh_);
        add_attributes("/PointData", "Node", data.of_points);
        add_attributes("/CellData", "Cell", data.of_cells);
        end_grid();
    }

    void add_tags(const std::string& name, std::string_view type, const Item& topology,
                  VtuArray markers) {
        begin_grid(name, type, topology);
        put_attribute(name, "Cell", add("/Tags/" + name + "_values", std::move(markers)));
        end_grid();
    }

    /// Names are used only in the text, since some characters have a meaning in HDF5.
    void add_attributes(const std::string& group, std::string_view center,
                        const std::vector<VtuArray>& arrays) {
        for (std::size_t k = 0; k < arrays.size(); ++k) {
            put_attribute(arrays[k].name, center,
                          add(fmt::format("{}/{}", group, k + 1), in_order_of_xdmf(arrays[k])));
        }
    }

    Item add_topology(const std::string& name, std::size_t vertices, VtuArray array) {
        array.components = vertices;
        return add(name == "mesh" ? "/Mesh/topology" : "/Tags/" + name, std::move(array));
    }

    Item add(const std::string& path, VtuArray array) {
        const bool is_real = std::string_view(array.type).starts_with("Float");
        Item item{array.entities, array.components,
                  fmt::format("<DataItem Dimensions=\"{}{}\" NumberType=\"{}\" Precision=\"{}\" "
                              "Format=\"HDF\">{}:{}</DataItem>",
                              array.entities,
                              array.components > 1 ? fmt::format(" {}", array.components) : "",
                              is_real ? "Float" : "Int", array.value_size, h5_name_, path)};
        Hdf5Dataset dataset{path, array.type, {array.entities}};
        if (array.components > 1) dataset.extents.push_back(array.components);
        datasets_.push_back({std::move(dataset), std::move(array), {}});
        return item;
    }

    void begin_grid(const std::string& name, std::string_view type, const Item& topology) {
        text_ += fmt::format(
            "    <Grid Name=\"{}\" GridType=\"Uniform\">\n"
            "      <Topology TopologyType=\"{}\" NumberOfElements=\"{}\" NodesPerElement=\"{}\">\n"
            "        {}\n      </Topology>\n"
            "      <Geometry GeometryType=\"XYZ\">\n        {}\n      </Geometry>\n",
            name, type, topology.rows, topology.columns, topology.text, geometry_.text);
    }
    void end_grid() { text_ += "    </Grid>\n"; }

    void put_attribute(const std::string& name, std::string_view center, const Item& item) {
        const std::string_view type = item.columns == 1   ? "Scalar"
                                      : item.columns == 3 ? "Vector"
                                      : item.columns == 6 ? "Tensor6"
                                      : item.columns == 9 ? "Tensor"
                                                          : "Matrix";
        text_ += fmt::format(
            "      <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">\n        {}\n"
            "      </Attribute>\n",
            xml_escaped(name), type, center, item.text);
    }

    MeshSource* mesh_;
    std::string h5_name_;
    std::string text_;
    Item topology_;
    Item geometry_;
    std::vector<Hdf5Group> groups_;
    std::vector<FilledDataset> datasets_;
};

}  // namespace

std::string write_xdmf(MeshSource& mesh, const fs::path& path) {
    const ProcessGroup& group = mesh.group();
    XdmfFiles content(mesh, path);
    content.describe();
    std::vector<std::unique_ptr<OutputFile>> files;
    files.push_back(std::make_unique<OutputFile>(path, group));
    if (group.is_first()) files.front()->put(std::string_view(content.text()));
    files.front()->end_turn();
    const fs::path h5 = h5_beside(path);
    files.push_back(std::make_unique<OutputFile>(h5, group));
    put_hdf5(*files.back(), h5, content.groups(), content.datasets(), group);
    OutputFile::commit_all(files, group, [] {});
    return {};
}

}  // namespace octetra
