#include "checkpoint/load.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/profile.hpp>

#include "checkpoint/load_tagged.hpp"
#include "history/cut_roots.hpp"
#include "partition/rcb.hpp"
#include "setup/owners.hpp"

namespace octetra::distributed {
namespace {

/// Input cells with the patterns of their descendants.
struct Roots {
    struct Root {
        std::uint64_t number = 0;
        VertexNumbers<4> corners{};
        Marker region = 0;
        std::uint32_t cut_bytes = 0;
    };
    std::vector<Root> roots;
    std::vector<std::uint8_t> cuts;  ///< see RootBytes
};

/// The runs of one step in a block.
class RunList {
public:
    explicit RunList(std::span<const CutRun> runs) : rest_(runs) {}
    [[nodiscard]] CutRun next() {
        const CutRun run = rest_.front();
        rest_ = rest_.subspan(1);
        return run;
    }

private:
    std::span<const CutRun> rest_;
};

/// The share of cells and patterns that this process reads.
class ShareOfFile {
public:
    ShareOfFile(const Communicator& processes, const CheckpointReader& file) : file_(&file) {
        const int rank = processes.rank();
        const OwnerMap owners =
            owners_of_blocks(file.facts().cells, block_length, processes.size());
        begin_ = owners.begin_of(rank);
        const std::uint64_t end = owners.end_of(rank);
        const auto corners = file.read_vertices<4>(Section::cells, begin_, end);
        const auto regions = file.read<Marker>(Section::regions, begin_, end);
        roots.roots.reserve(corners.size());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            roots.roots.push_back(
                {begin_ + i, corners[i], regions.empty() ? Marker{0} : regions[i], 0});
        }
        weights.assign(corners.size(), 1);
        if (file.facts().steps.empty()) return;
        const std::uint64_t blocks = shape_of(file.facts(), Section::cells).blocks();
        const std::uint64_t end_block = first_block_of(rank + 1, blocks, processes.size());
        for (auto b = first_block_of(rank, blocks, processes.size()); b < end_block; ++b) {
            take_block(b);
        }
    }

    Roots roots;
    std::vector<std::uint64_t> weights;  ///< the number of descendants of each root
    std::vector<StepFacts> found;        ///< totals of the patterns read, for each step

private:
    void take_block(std::uint64_t block) {
        const auto steps = file_->read_cuts(block, found);
        RootSplitter<RunList> splitter({steps.begin(), steps.end()});
        const std::uint64_t first = block * block_length - begin_;
        const std::uint64_t length = shape_of(file_->facts(), Section::cuts).length_of(block);
        for (std::uint64_t i = first; i < first + length; ++i) {
            const std::size_t before = roots.cuts.size();
            weights[i] = splitter.append_next(roots.cuts);
            roots.roots[i].cut_bytes = static_cast<std::uint32_t>(roots.cuts.size() - before);
        }
    }

    const CheckpointReader* file_;
    std::uint64_t begin_ = 0;
};

std::vector<std::uint64_t> vertices_of(const Roots& roots) {
    std::vector<std::uint64_t> numbers;
    numbers.reserve(4 * roots.roots.size());
    for (const auto& root : roots.roots) {
        numbers.insert(numbers.end(), root.corners.begin(), root.corners.end());
    }
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

/// Collective. Throws unless the table's facts about each step equal the sums over all processes.
void check_steps(const Communicator& processes, const CheckpointReader& file,
                 const ShareOfFile& share) {
    if (file.facts().steps.empty()) return;
    std::vector<std::uint64_t> numbers(3 * file.facts().steps.size());
    for (std::size_t t = 0; t < share.found.size(); ++t) {
        const StepFacts& step = share.found[t];
        std::ranges::copy(std::array{step.cells_before, step.cells_cut, step.bytes},
                          numbers.begin() + static_cast<std::ptrdiff_t>(3 * t));
    }
    processes.sum(std::span(numbers));
    std::vector<StepFacts> found;
    for (std::size_t k = 0; k < numbers.size(); k += 3) {
        found.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
    }
    file.check_steps(found);
}

/// The share of vertices that this process reads.
struct VertexShare {
    OwnerMap owners;
    std::uint64_t begin = 0;
    std::vector<Point> points;
    std::vector<Marker> markers;
    std::vector<double> attributes;

    VertexShare(const Communicator& processes, const CheckpointReader& file)
        : owners(owners_of_blocks(file.facts().vertices, block_length, processes.size())),
          begin(owners.begin_of(processes.rank())) {
        const std::uint64_t end = owners.end_of(processes.rank());
        points = file.read_points(begin, end);
        markers = file.read<Marker>(Section::point_markers, begin, end);
        attributes = file.read<double>(Section::point_attributes, begin, end);
    }
};

/// Collective. Returns the parts of this process's share of the cells, by coordinates.
std::vector<int> parts_by_coordinates(const Communicator& processes, const ShareOfFile& share,
                                      const VertexShare& vertices) {
    const std::vector<std::uint64_t> numbers = vertices_of(share.roots);
    const Requests requests = request(processes, vertices.owners, numbers);
    const auto points = fetch(processes, requests, vertices.points, vertices.begin);
    const auto& roots = share.roots.roots;
    const auto centroid_of_root = [&](std::size_t i) {
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto found = std::ranges::lower_bound(numbers, roots[i].corners[k]);
            corners[k] = points[static_cast<std::size_t>(found - numbers.begin())];
        }
        return centroid_of(corners);
    };
    std::vector<Point> centroids;
    centroids.reserve(roots.size());
    for (std::size_t i = 0; i < roots.size(); ++i) centroids.push_back(centroid_of_root(i));
    const auto some = [&](std::size_t first, std::span<Point> places) {
        std::ranges::copy(std::span(centroids).subspan(first, places.size()), places.begin());
    };
    return bisect_coordinates(processes,
                              {.count = roots.size(),
                               .points = some,
                               .number = [&](std::size_t i) { return roots[i].number; },
                               .weight = [&](std::size_t i) { return share.weights[i]; }},
                              processes.size());
}

/// Collective. Same, by a method that requires the whole input on the first process.
std::vector<int> parts_of_whole(const Communicator& processes, const ShareOfFile& share,
                                const std::filesystem::path& path, const Partition& partition) {
    const auto weights = processes.gather(share.weights);
    std::vector<std::vector<int>> parts(weights.size());
    if (!processes.is_first()) return processes.scatter(parts);
    std::vector<float> weight_of;
    if (takes_weights(partition)) {
        for (const auto& of_one : weights) {
            for (const std::uint64_t w : of_one) weight_of.push_back(static_cast<float>(w));
        }
    }
    const Mesh input = read_checkpoint(path).input;
    const auto all = partition_cells(input, processes.size(), partition, weight_of);
    auto next = all.begin();
    for (std::size_t rank = 0; rank < parts.size(); ++rank) {
        const auto end = next + static_cast<std::ptrdiff_t>(weights[rank].size());
        parts[rank].assign(next, end);
        next = end;
    }
    return processes.scatter(parts);
}

/// Collective. Sends cells to their parts; each process receives its own in ascending order.
Roots send(const Communicator& processes, const Roots& roots, const std::vector<int>& parts) {
    std::vector<std::vector<Roots::Root>> root_boxes(static_cast<std::size_t>(processes.size()));
    std::vector<std::vector<std::uint8_t>> cut_boxes(root_boxes.size());
    auto cuts = roots.cuts.begin();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto rank = static_cast<std::size_t>(parts[i]);
        const auto end = cuts + roots.roots[i].cut_bytes;
        root_boxes[rank].push_back(roots.roots[i]);
        cut_boxes[rank].insert(cut_boxes[rank].end(), cuts, end);
        cuts = end;
    }
    // Shares are in the order of ranks, so the received cells ascend.
    Roots received;
    for (const auto& box : processes.all_to_all(root_boxes)) {
        received.roots.insert(received.roots.end(), box.begin(), box.end());
    }
    root_boxes.clear();
    for (const auto& box : processes.all_to_all(cut_boxes)) {
        received.cuts.insert(received.cuts.end(), box.begin(), box.end());
    }
    return received;
}

/// Adds cells with their tags and patterns to the part.
void take_roots(Roots roots, const CheckpointFacts& facts, LoadedPart& part) {
    for (const auto& root : roots.roots) {
        if (root.cut_bytes > 0) {
            part.cuts.roots.push_back(
                {static_cast<std::uint32_t>(part.input.cells.size()), root.cut_bytes});
        }
        part.input.cells.push_back(root.corners);
        part.input.cell_numbers.push_back(root.number);
        if (facts.has_regions) part.input.regions.push_back(root.region);
    }
    part.cuts.bytes = std::move(roots.cuts);
}

/// Adds the vertices of this process's share that no process has requested.
void add_unrequested(const VertexShare& share, const Requests<>& requests, MeshPart& part) {
    std::vector<bool> is_requested(share.points.size(), false);
    for (const auto& numbers : requests.received) {
        for (const std::uint64_t number : numbers) is_requested[number - share.begin] = true;
    }
    for (std::size_t i = 0; i < is_requested.size(); ++i) {
        if (is_requested[i]) continue;
        part.vertex_numbers.push_back(share.begin + i);
        part.points.push_back(share.points[i]);
        if (!share.markers.empty()) part.point_markers.push_back(share.markers[i]);
        const std::size_t count = part.attributes_per_point;
        const auto first = share.attributes.begin() + static_cast<std::ptrdiff_t>(i * count);
        part.point_attributes.insert(part.point_attributes.end(), first,
                                     first + static_cast<std::ptrdiff_t>(count));
    }
}

/// Collective. Fetches the vertices of this process's cells, and adds those of its share that no
/// cell has. Returns the requests of all processes.
Requests<> take_vertices(const Communicator& processes, const VertexShare& share,
                         const CheckpointFacts& facts, const Roots& roots, MeshPart& part) {
    part.vertex_numbers = vertices_of(roots);
    Requests requests = request(processes, share.owners, part.vertex_numbers);
    const auto fetch_owned = [&](const auto& owned, std::size_t components) {
        return fetch(processes, requests, owned, share.begin, components);
    };
    part.points = fetch_owned(share.points, 1);
    if (facts.has_point_markers) part.point_markers = fetch_owned(share.markers, 1);
    part.point_attributes = fetch_owned(share.attributes, part.attributes_per_point);
    add_unrequested(share, requests, part);
    return requests;
}

template <std::size_t N>
void take_tagged(const std::vector<Tagged<N>>& tagged, bool has_markers,
                 std::vector<VertexNumbers<N>>& lists, std::vector<Marker>& markers,
                 std::vector<std::uint64_t>& numbers) {
    for (const Tagged<N>& one : tagged) {
        lists.push_back(one.vertices);
        numbers.push_back(one.number);
        if (has_markers) markers.push_back(one.marker);
    }
}

/// Reads this process's share of the features, in whole blocks.
SharedFeatures share_of_features(const Communicator& processes, const CheckpointReader& file) {
    const FeatureCounts& counts = file.facts().features;
    if (!has_any(counts)) return {};
    FeatureLists lists;
    for (const Feature f : all_features) {
        const OwnerMap owners = owners_of_blocks(counts[f], block_length, processes.size());
        lists[f] = file.read_features(f, owners.begin_of(processes.rank()),
                                      owners.end_of(processes.rank()));
    }
    return std::make_shared<const FeatureLists>(std::move(lists));
}

/// Collective, within a transaction.
LoadedPart load(const Communicator& processes, const CheckpointReader& file,
                const std::filesystem::path& path, const Partition& partition) {
    const Phase phase(processes, "load");
    std::optional<ShareOfFile> share(std::in_place, processes, file);
    const VertexShare vertices(processes, file);
    check_steps(processes, file, *share);
    const bool by_coordinates = partition.method == PartitionMethod::rcb || processes.size() == 1;
    const auto parts = by_coordinates ? parts_by_coordinates(processes, *share, vertices)
                                      : parts_of_whole(processes, *share, path, partition);
    Roots roots = send(processes, share->roots, parts);
    share.reset();

    const CheckpointFacts& facts = file.facts();
    LoadedPart part;
    part.input.index_base = facts.index_base;
    part.input.attributes_per_point = facts.attributes_per_point;
    const Requests requests = take_vertices(processes, vertices, facts, roots, part.input);
    take_tagged(load_tagged<3>(processes, file, vertices.owners, requests, roots.roots,
                               Section::facets, Section::facet_markers, cell_faces),
                facts.has_facet_markers, part.input.facets, part.input.facet_markers,
                part.input.facet_numbers);
    take_tagged(load_tagged<2>(processes, file, vertices.owners, requests, roots.roots,
                               Section::edges, Section::edge_markers, cell_edges),
                facts.has_edge_markers, part.input.edges, part.input.edge_markers,
                part.input.edge_numbers);
    take_roots(std::move(roots), facts, part);
    part.input.group_names = facts.group_names;
    part.features = share_of_features(processes, file);
    return part;
}

}  // namespace

LoadedPart load_part(const Communicator& processes, const CheckpointReader& file,
                     const std::filesystem::path& path, const Partition& partition) {
    return processes.transaction([&] { return load(processes, file, path, partition); });
}

}  // namespace octetra::distributed
