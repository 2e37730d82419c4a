#define TETLIBRARY
#include <tetgen.h>

#include <csignal>
#include <cstring>
#include <new>
#include <string>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/orientation.hpp>
#include <octetra/generator/tetgen.hpp>

#include "child_process.hpp"
#include "tetrahedralise.hpp"

namespace octetra::generator {
namespace {

/// The exception that TetGen throws if memory is exhausted. Not used as an exit status, because 1
/// is the usual one for any failure.
constexpr int tetgen_without_memory = 1;

/// Exit statuses of the child in addition to 2 to 10, which TetGen throws.
constexpr int no_result = 11;
constexpr int other_failure = 12;
constexpr int out_of_memory = 13;

/// TetGen assigns the marker 1 to all segments that are not listed, so markers of listed ones are
/// shifted by one.
constexpr int unlisted_ridge = 1;

int as_int(std::size_t number) { return static_cast<int>(number); }

double* new_coordinates(const std::vector<Point>& points) {
    auto* const coordinates = new double[3 * points.size()];
    double* next = coordinates;
    for (const Point& p : points) {
        *next++ = p.x;
        *next++ = p.y;
        *next++ = p.z;
    }
    return coordinates;
}

void fill_facet(tetgenio::facet& facet, const PlaneFacet& from) {
    tetgenio::init(&facet);
    facet.polygonlist = new tetgenio::polygon[from.polygons.size()];
    facet.numberofpolygons = as_int(from.polygons.size());
    for (std::size_t i = 0; i < from.polygons.size(); ++i) {
        const Polygon& ring = from.polygons[i];
        tetgenio::polygon& polygon = facet.polygonlist[i];
        polygon.vertexlist = new int[ring.size()];
        polygon.numberofvertices = as_int(ring.size());
        for (std::size_t k = 0; k < ring.size(); ++k) polygon.vertexlist[k] = as_int(ring[k]);
    }
    if (from.holes.empty()) return;
    facet.holelist = new_coordinates(from.holes);
    facet.numberofholes = as_int(from.holes.size());
}

// TetGen's structure owns its arrays and frees them with delete[].

void fill_facets(tetgenio& in, const std::vector<PlaneFacet>& facets) {
    if (facets.empty()) return;
    in.facetlist = new tetgenio::facet[facets.size()];
    in.facetmarkerlist = new int[facets.size()];
    in.numberoffacets = as_int(facets.size());
    for (std::size_t i = 0; i < facets.size(); ++i) {
        fill_facet(in.facetlist[i], facets[i]);
        in.facetmarkerlist[i] = facets[i].marker;
    }
}

void fill_ridges(tetgenio& in, const std::vector<Ridge>& ridges) {
    if (ridges.empty()) return;
    in.edgelist = new int[2 * ridges.size()];
    in.edgemarkerlist = new int[ridges.size()];
    in.numberofedges = as_int(ridges.size());
    for (std::size_t i = 0; i < ridges.size(); ++i) {
        in.edgelist[2 * i] = as_int(ridges[i].from);
        in.edgelist[2 * i + 1] = as_int(ridges[i].to);
        in.edgemarkerlist[i] = ridges[i].marker + unlisted_ridge;
    }
}

void fill_regions(tetgenio& in, const std::vector<Region>& regions) {
    if (regions.empty()) return;
    in.regionlist = new double[5 * regions.size()];
    in.numberofregions = as_int(regions.size());
    double* next = in.regionlist;
    for (const Region& region : regions) {
        *next++ = region.seed.x;
        *next++ = region.seed.y;
        *next++ = region.seed.z;
        *next++ = region.tag;
        *next++ = -1;  // no separate volume bound
    }
}

/// The numbers of items, in the order in which the child sends them.
struct Counts {
    std::size_t points = 0;
    std::size_t cells = 0;
    std::size_t facets = 0;
    std::size_t ridges = 0;
    std::size_t regions = 0;  ///< equal to cells, or 0
};

int send_result(const tetgenio& out, ToParent& parent) {
    if (out.numberoftetrahedra <= 0 || out.pointlist == nullptr) return no_result;
    const bool has_facet_markers = out.trifacemarkerlist != nullptr;
    const bool has_regions = out.numberoftetrahedronattributes == 1;
    const Counts counts{
        .points = static_cast<std::size_t>(out.numberofpoints),
        .cells = static_cast<std::size_t>(out.numberoftetrahedra),
        .facets = static_cast<std::size_t>(out.numberoftrifaces),
        .ridges = static_cast<std::size_t>(out.numberofedges),
        .regions = has_regions ? static_cast<std::size_t>(out.numberoftetrahedra) : 0};
    const std::vector<int> ones(has_facet_markers ? 0 : counts.facets, 1);
    parent.send(&counts, 1);
    parent.send(out.pointlist, 3 * counts.points);
    parent.send(out.tetrahedronlist, 4 * counts.cells);
    parent.send(out.trifacelist, 3 * counts.facets);
    parent.send(has_facet_markers ? out.trifacemarkerlist : ones.data(), counts.facets);
    parent.send(out.edgelist, 2 * counts.ridges);
    parent.send(out.edgemarkerlist, counts.ridges);
    parent.send(out.tetrahedronattributelist, counts.regions);
    return 0;
}

int run_tetgen(const Complex& complex, std::string switches, ToParent& parent) {
    try {
        tetgenio in;
        in.firstnumber = 0;
        in.pointlist = new_coordinates(complex.points);
        in.numberofpoints = as_int(complex.points.size());
        fill_facets(in, complex.facets);
        fill_ridges(in, complex.ridges);
        fill_regions(in, complex.regions);
        tetgenio out;
        tetrahedralize(switches.data(), &in, &out);
        return send_result(out, parent);
    } catch (const int code) {
        return code == tetgen_without_memory ? out_of_memory : code;
    } catch (const std::bad_alloc&) {
        return out_of_memory;
    } catch (...) {
        return other_failure;
    }
}

void refuse_failure(const ChildResult& result) {
    if (result.signal == SIGKILL || result.exit_status == out_of_memory) {
        throw SystemError("memory ran out while TetGen made the mesh");
    }
    const auto refuse = [](const char* why) {
        throw InputError(
            fmt::format("TetGen cannot make this mesh ({}); lengths that differ less "
                        "may help",
                        why));
    };
    if (result.signal != 0) refuse("it gave up");
    switch (result.exit_status) {
        case 0: return;
        case 3: return refuse("the surface meets itself");
        case 4: return refuse("a part of the surface is too small");
        case 5: return refuse("two pieces of the surface are too close");
        case 10: return refuse("the surface is not a closed one");
        case no_result: return refuse("it made no cells");
        default: return refuse("it failed inside");
    }
}

/// Deserialises the child's data in the order in which they were sent.
class Received {
public:
    explicit Received(const std::vector<std::byte>& bytes) : next_(bytes.data()) {}

    template <class T>
    T take() {
        T item;
        std::memcpy(&item, next_, sizeof item);
        next_ += sizeof item;
        return item;
    }
    Point take_point() {
        const auto x = take<double>();
        const auto y = take<double>();
        const auto z = take<double>();
        return {x, y, z};
    }
    template <std::size_t N>
    std::array<VertexIndex, N> take_vertices() {
        std::array<VertexIndex, N> vertices;
        for (VertexIndex& v : vertices) v = VertexIndex{static_cast<std::size_t>(take<int>())};
        return vertices;
    }

private:
    const std::byte* next_;
};

void drop_unlisted_ridges(Mesh& mesh) {
    EdgeIndex kept{0};
    for (EdgeIndex e{0}; e < mesh.edges.end_index(); ++e) {
        if (mesh.edge_markers[e] <= unlisted_ridge) continue;
        mesh.edges[kept] = mesh.edges[e];
        mesh.edge_markers[kept] = mesh.edge_markers[e] - unlisted_ridge;
        ++kept;
    }
    mesh.edges.resize(kept.value());
    mesh.edge_markers.resize(kept.value());
}

Mesh mesh_from(const std::vector<std::byte>& bytes) {
    Received received(bytes);
    const auto counts = received.take<Counts>();
    Mesh mesh;
    mesh.points.resize(counts.points);
    for (Point& p : mesh.points) p = received.take_point();
    mesh.cells.resize(counts.cells);
    for (CellVertices& cell : mesh.cells) cell = received.take_vertices<4>();
    mesh.facets.resize(counts.facets);
    for (FacetVertices& facet : mesh.facets) facet = received.take_vertices<3>();
    mesh.facet_markers.resize(counts.facets);
    for (Marker& marker : mesh.facet_markers) marker = received.take<int>();
    mesh.edges.resize(counts.ridges);
    for (EdgeVertices& edge : mesh.edges) edge = received.take_vertices<2>();
    mesh.edge_markers.resize(counts.ridges);
    for (Marker& marker : mesh.edge_markers) marker = received.take<int>();
    mesh.regions.resize(counts.regions);
    for (Marker& tag : mesh.regions) tag = static_cast<Marker>(received.take<double>());
    drop_unlisted_ridges(mesh);
    return mesh;
}

void check_cells(const Mesh& mesh) {
    for (CellIndex c{0}; c < mesh.cells.end_index(); ++c) {
        const auto& [i, j, k, l] = mesh.cells[c];
        const auto& p = mesh.points;
        const int sign = orientation(p[i], p[j], p[k], p[l]);
        if (sign > 0) continue;
        throw InputError(fmt::format("TetGen made cell {} (vertices {} {} {} {}) {}", c.value(),
                                     i.value(), j.value(), k.value(), l.value(),
                                     sign == 0 ? "flat" : "inverted"));
    }
}

}  // namespace

bool has_tetgen() { return true; }

Mesh tetrahedralise(const Complex& complex, std::string_view switches) {
    const std::string quiet = std::string(switches) + "Q";
    const ChildResult result =
        run_in_child([&](ToParent& parent) { return run_tetgen(complex, quiet, parent); });
    refuse_failure(result);
    const Mesh mesh = mesh_from(result.sent);
    check_cells(mesh);
    return mesh;
}

}  // namespace octetra::generator
