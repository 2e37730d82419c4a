#include "checkpoint/load.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include <octetra/core/error.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/distributed/profile.hpp>

#include "checkpoint/fetch.hpp"
#include "comm/local_failure.hpp"
#include "history/cut_roots.hpp"
#include "partition/rcb.hpp"

namespace octetra::distributed {
namespace {

/// Cells of the input, with what became of them.
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

/// The runs of a step that a block tells of.
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

/// What this process reads of the cells and their cuts.
class Share {
public:
    Share(const Communicator& processes, const CheckpointReader& file)
        : file_(&file), homes_(file.facts().cells, block_length, processes.size()) {
        const int rank = processes.rank();
        begin_ = homes_.begin_of(rank);
        const std::uint64_t end = homes_.end_of(rank);
        const auto corners = file.read_vertices<4>(Section::cells, begin_, end);
        const auto regions = file.read<Marker>(Section::regions, begin_, end);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            roots.roots.push_back(
                {begin_ + i, corners[i], regions.empty() ? Marker{0} : regions[i], 0});
        }
        weights.assign(corners.size(), 1);
        if (file.facts().steps.empty()) return;
        for (std::uint64_t b = homes_.first_block_of(rank); b < homes_.first_block_of(rank + 1);
             ++b) {
            take_block(b);
        }
    }

    Roots roots;
    std::vector<std::uint64_t> weights;  ///< the cells that each root has become

private:
    void take_block(std::uint64_t block) {
        const auto steps = file_->read_cuts(block);
        RootsApart<RunList> apart({steps.begin(), steps.end()});
        const std::uint64_t first = block * block_length - begin_;
        const std::uint64_t length = shape_of(file_->facts(), Section::cuts).length_of(block);
        for (std::uint64_t i = first; i < first + length; ++i) {
            const std::size_t before = roots.cuts.size();
            weights[i] = apart.append_next(roots.cuts);
            roots.roots[i].cut_bytes = static_cast<std::uint32_t>(roots.cuts.size() - before);
        }
    }

    const CheckpointReader* file_;
    Homes homes_;
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

/// What this process reads of the vertices.
struct VertexShare {
    Homes homes;
    std::uint64_t begin = 0;
    std::vector<Point> points;
    std::vector<Marker> markers;
    std::vector<double> attributes;

    VertexShare(const Communicator& processes, const CheckpointReader& file)
        : homes(file.facts().vertices, block_length, processes.size()),
          begin(homes.begin_of(processes.rank())) {
        const std::uint64_t end = homes.end_of(processes.rank());
        points = file.read_points(begin, end);
        markers = file.read<Marker>(Section::point_markers, begin, end);
        attributes = file.read<double>(Section::point_attributes, begin, end);
    }
};

/// Collective. The parts of this process's share of the cells, by coordinates.
std::vector<int> parts_by_coordinates(const Communicator& processes, const Share& share,
                                      const VertexShare& vertices, LocalFailure& failure) {
    std::vector<std::uint64_t> numbers;
    failure.attempt([&] { numbers = vertices_of(share.roots); });
    failure.agree(processes);
    const Requests requests = request(processes, vertices.homes, numbers);
    const auto points = fetch(processes, requests, vertices.points, vertices.begin);
    std::vector<WeighedPoint> centroids;
    failure.attempt([&] {
        for (std::size_t i = 0; i < share.weights.size(); ++i) {
            const auto& root = share.roots.roots[i];
            Corners corners;
            for (std::size_t k = 0; k < 4; ++k) {
                const auto found = std::ranges::lower_bound(numbers, root.corners[k]);
                corners[k] = points[static_cast<std::size_t>(found - numbers.begin())];
            }
            centroids.push_back({centroid(corners), root.number, share.weights[i]});
        }
    });
    failure.agree(processes);
    auto parts = bisect_coordinates(processes, centroids, processes.size(), failure);
    failure.agree(processes);
    return parts;
}

/// Collective. The same, by a method that wants the whole input on the first process.
std::vector<int> parts_of_whole(const Communicator& processes, const Share& share,
                                const std::filesystem::path& path, const Partition& partition) {
    const auto weights = processes.gather(share.weights);
    std::vector<std::vector<int>> parts(weights.size());
    processes.on_first([&] {
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
    });
    return processes.scatter(parts);
}

/// Collective. Cells go to their parts; each process gets its own, in the order of their numbers.
Roots send(const Communicator& processes, const Roots& roots, const std::vector<int>& parts) {
    const auto process_count = static_cast<std::size_t>(processes.size());
    std::vector<std::vector<Roots::Root>> root_boxes(process_count);
    std::vector<std::vector<std::uint8_t>> cut_boxes(process_count);
    auto cuts = roots.cuts.begin();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto rank = static_cast<std::size_t>(parts[i]);
        const auto end = cuts + roots.roots[i].cut_bytes;
        root_boxes[rank].push_back(roots.roots[i]);
        cut_boxes[rank].insert(cut_boxes[rank].end(), cuts, end);
        cuts = end;
    }
    // Shares are in the order of the ranks, and in their own.
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

/// Takes cells with their tags, and steps.
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

/// Collective. The vertices of this process's cells, and those of its share that no cell has.
/// Returns who has asked for what.
Requests take_vertices(const Communicator& processes, const VertexShare& share, const Roots& roots,
                       MeshPart& part) {
    part.vertex_numbers = vertices_of(roots);
    Requests requests = request(processes, share.homes, part.vertex_numbers);
    part.points = fetch(processes, requests, share.points, share.begin);
    part.point_markers =
        fetch(processes, requests, share.markers, share.begin, share.markers.empty() ? 0 : 1);
    part.point_attributes =
        fetch(processes, requests, share.attributes, share.begin, part.attributes_per_point);
    std::vector<bool> is_wanted(share.points.size(), false);
    for (const auto& numbers : requests.received) {
        for (const std::uint64_t number : numbers) is_wanted[number - share.begin] = true;
    }
    for (std::size_t i = 0; i < is_wanted.size(); ++i) {
        if (is_wanted[i]) continue;
        part.vertex_numbers.push_back(share.begin + i);
        part.points.push_back(share.points[i]);
        if (!share.markers.empty()) part.point_markers.push_back(share.markers[i]);
        const std::size_t count = part.attributes_per_point;
        const auto first = share.attributes.begin() + static_cast<std::ptrdiff_t>(i * count);
        part.point_attributes.insert(part.point_attributes.end(), first,
                                     first + static_cast<std::ptrdiff_t>(count));
    }
    return requests;
}

/// A tagged facet or edge on its way to a process that has a cell at it.
template <std::size_t N>
struct Tagged {
    std::uint64_t number = 0;
    VertexNumbers<N> vertices{};
    Marker marker = 0;
};

/// Collective. The facets or edges that are sides of this process's cells. Each goes from who has
/// read it to the home of one of its vertices, and from there to all that have asked for that one.
template <std::size_t N, std::size_t Sides>
std::vector<Tagged<N>> bring_tagged(const Communicator& processes, const CheckpointReader& file,
                                    const VertexShare& vertices, const Requests& requests,
                                    const Roots& roots, Section section, Section markers,
                                    const std::array<std::array<std::uint8_t, N>, Sides>& sides,
                                    LocalFailure& failure) {
    const auto process_count = static_cast<std::size_t>(processes.size());
    const Homes homes(shape_of(file.facts(), section).count, block_length, processes.size());
    std::vector<std::vector<Tagged<N>>> to_homes;
    failure.attempt([&] {
        const std::uint64_t begin = homes.begin_of(processes.rank());
        const std::uint64_t end = homes.end_of(processes.rank());
        const auto lists = file.read_vertices<N>(section, begin, end);
        const auto tags = file.read<Marker>(markers, begin, end);
        to_homes.resize(process_count);
        for (std::size_t i = 0; i < lists.size(); ++i) {
            const auto home = static_cast<std::size_t>(vertices.homes.rank_of(lists[i][0]));
            to_homes[home].push_back({begin + i, lists[i], tags.empty() ? Marker{0} : tags[i]});
        }
    });
    failure.agree(processes);
    const auto at_home = processes.all_to_all(to_homes);

    using Keyed = std::pair<std::uint64_t, Tagged<N>>;
    std::vector<Keyed> by_vertex;
    for (const auto& box : at_home) {
        for (const Tagged<N>& tagged : box) by_vertex.emplace_back(tagged.vertices[0], tagged);
    }
    std::ranges::sort(by_vertex, {}, &Keyed::first);
    std::vector<std::vector<Tagged<N>>> to_parts(process_count);
    for (std::size_t rank = 0; rank < process_count; ++rank) {
        auto next = by_vertex.begin();
        for (const std::uint64_t number : requests.received[rank]) {  // ascending
            while (next != by_vertex.end() && next->first < number) ++next;
            for (auto k = next; k != by_vertex.end() && k->first == number; ++k) {
                to_parts[rank].push_back(k->second);
            }
        }
    }
    const auto come = processes.all_to_all(to_parts);

    std::vector<std::pair<VertexNumbers<N>, Tagged<N>>> candidates;
    for (const auto& box : come) {
        for (const Tagged<N>& tagged : box) {
            VertexNumbers<N> key = tagged.vertices;
            std::ranges::sort(key);
            candidates.emplace_back(key, tagged);
        }
    }
    const auto key_of = [](const auto& candidate) -> const VertexNumbers<N>& {
        return candidate.first;
    };
    std::ranges::sort(candidates, {}, key_of);
    std::vector<bool> is_side(candidates.size(), false);
    for (const auto& root : roots.roots) {
        if (candidates.empty()) break;
        for (const auto& side : sides) {
            VertexNumbers<N> key;
            for (std::size_t k = 0; k < N; ++k) key[k] = root.corners[side[k]];
            std::ranges::sort(key);
            auto found = std::ranges::lower_bound(candidates, key, {}, key_of);
            for (; found != candidates.end() && found->first == key; ++found) {
                is_side[static_cast<std::size_t>(found - candidates.begin())] = true;
            }
        }
    }
    std::vector<Tagged<N>> tagged;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (is_side[i]) tagged.push_back(candidates[i].second);
    }
    std::ranges::sort(tagged, {}, &Tagged<N>::number);
    return tagged;
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

}  // namespace

LoadedPart load_part(const Communicator& processes, const CheckpointReader& file,
                     const std::filesystem::path& path, const Partition& partition) {
    const Phase phase(processes, "load");
    LocalFailure failure;
    std::vector<Share> share;
    std::vector<VertexShare> vertices;
    failure.attempt([&] {
        share.emplace_back(processes, file);
        vertices.emplace_back(processes, file);
    });
    failure.agree(processes);
    const bool by_coordinates = partition.method == PartitionMethod::rcb || processes.size() == 1;
    const auto parts =
        by_coordinates ? parts_by_coordinates(processes, share.front(), vertices.front(), failure)
                       : parts_of_whole(processes, share.front(), path, partition);
    Roots roots = send(processes, share.front().roots, parts);
    share.clear();

    const CheckpointFacts& facts = file.facts();
    LoadedPart part;
    part.input.index_base = facts.index_base;
    part.input.attributes_per_point = facts.attributes_per_point;
    const Requests requests = take_vertices(processes, vertices.front(), roots, part.input);
    const auto facets =
        bring_tagged<3>(processes, file, vertices.front(), requests, roots, Section::facets,
                        Section::facet_markers, cell_faces, failure);
    const auto edges = bring_tagged<2>(processes, file, vertices.front(), requests, roots,
                                       Section::edges, Section::edge_markers, cell_edges, failure);
    failure.attempt([&] {
        take_tagged(facets, facts.has_facet_markers, part.input.facets, part.input.facet_markers,
                    part.input.facet_numbers);
        take_tagged(edges, facts.has_edge_markers, part.input.edges, part.input.edge_markers,
                    part.input.edge_numbers);
        take_roots(std::move(roots), facts, part);
    });
    failure.agree(processes);
    return part;
}

}  // namespace octetra::distributed
