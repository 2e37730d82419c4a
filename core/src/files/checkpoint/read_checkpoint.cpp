#include <algorithm>

#include <fmt/format.h>

#include <octetra/core/checkpoint_blocks.hpp>
#include <octetra/core/error.hpp>
#include <octetra/core/huge_pages.hpp>
#include <octetra/core/standard_arithmetic.hpp>

namespace octetra {
namespace {

template <class I, std::size_t N>
IndexVector<I, std::array<VertexIndex, N>> read_lists(const CheckpointReader& file,
                                                      Section section) {
    IndexVector<I, std::array<VertexIndex, N>> lists;
    const std::uint64_t count = shape_of(file.facts(), section).count;
    reserve_in_huge_pages(lists, count);
    for (const auto& numbers : file.read_vertices<N>(section, 0, count)) {
        lists.push_back(indices_of(numbers));
    }
    return lists;
}

template <class I>
IndexVector<I, Marker> read_markers(const CheckpointReader& file, Section section) {
    const auto markers = file.read<Marker>(section, 0, shape_of(file.facts(), section).count);
    return {markers.begin(), markers.end()};
}

Mesh read_input(const CheckpointReader& file) {
    const CheckpointFacts& facts = file.facts();
    Mesh mesh;
    const auto points = file.read_points(0, facts.vertices);
    mesh.points.assign(points.begin(), points.end());
    mesh.point_markers = read_markers<VertexIndex>(file, Section::point_markers);
    mesh.attributes_per_point = facts.attributes_per_point;
    mesh.point_attributes = file.read<double>(Section::point_attributes, 0,
                                              shape_of(facts, Section::point_attributes).count);
    mesh.cells = read_lists<CellIndex, 4>(file, Section::cells);
    mesh.regions = read_markers<CellIndex>(file, Section::regions);
    mesh.facets = read_lists<FacetIndex, 3>(file, Section::facets);
    mesh.facet_markers = read_markers<FacetIndex>(file, Section::facet_markers);
    mesh.edges = read_lists<EdgeIndex, 2>(file, Section::edges);
    mesh.edge_markers = read_markers<EdgeIndex>(file, Section::edge_markers);
    for (const Feature f : all_features) {
        mesh.features[f] = file.read_features(f, 0, facts.features[f]);
    }
    mesh.index_base = facts.index_base;
    mesh.group_names = facts.group_names;
    return mesh;
}

void append_cuts(const CheckpointReader& file, std::vector<std::vector<std::uint8_t>>& steps) {
    const std::uint64_t blocks = shape_of(file.facts(), Section::cuts).blocks();
    std::vector<StepFacts> found(steps.size());
    for (std::uint64_t b = 0; b < blocks; ++b) {
        const auto cuts = file.read_cuts(b, found);
        for (std::size_t t = 0; t < steps.size(); ++t) {
            for (const CutRun& run : cuts[t]) {
                if (run.count >= VertexIndex::limit - steps[t].size()) {
                    file.fail(Section::cuts, b, "more cells than one process can number");
                }
                steps[t].insert(steps[t].end(), run.count,
                                static_cast<std::uint8_t>(run.cut & cut_edges));
            }
        }
    }
    file.check_steps(found);
}

}  // namespace

Checkpoint read_checkpoint(const std::filesystem::path& path) {
    const StandardArithmetic standard;
    const CheckpointReader file(path);
    const CheckpointFacts& facts = file.facts();
    if (std::max({facts.vertices, facts.cells, facts.facets, facts.edges}) >= VertexIndex::limit) {
        throw InputError(fmt::format("{}: its input is too large for one process", path.native()));
    }
    Checkpoint checkpoint{.facts = facts, .input = read_input(file), .steps = {}};
    checkpoint.steps.resize(facts.steps.size());
    append_cuts(file, checkpoint.steps);
    return checkpoint;
}

}  // namespace octetra
