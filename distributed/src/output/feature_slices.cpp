#include "output/feature_slices.hpp"

#include <algorithm>
#include <functional>

#include "output/slices.hpp"

namespace octetra::distributed {
namespace {

/// Distributes the numbers of input entities of one kind to rendezvous processes in blocks of equal
/// size, in the order of ranks.
struct NumberBlocks {
    std::uint64_t size = 1;
    std::size_t processes = 1;

    NumberBlocks(const Communicator& group, std::uint64_t count)
        : size(count / static_cast<std::uint64_t>(group.size()) + 1),
          processes(static_cast<std::size_t>(group.size())) {}

    /// Returns the elements to send to each process.
    template <class T>
    [[nodiscard]] std::vector<std::vector<T>> outboxes(const std::vector<T>& all,
                                                       auto&& number_of) const {
        std::vector<std::vector<T>> boxes(processes);
        for (const T& one : all) boxes[number_of(one) / size].push_back(one);
        return boxes;
    }
};

/// A root, and the range of its descendants in the canonical order.
struct RootRange {
    std::uint64_t root;
    std::uint64_t begin;
    std::uint64_t count;
};

/// Collective. Returns the roots in this process's block, sorted by number.
std::vector<RootRange> roots_in_block(const Communicator& processes,
                                      const FeatureSlices::Kind& kind, const NumberBlocks& blocks) {
    const auto& [roots, first, markers] = *kind.ancestors;
    std::vector<RootRange> own;
    own.reserve(roots.size());
    for (std::size_t r = 0; r < roots.size(); ++r) {
        own.push_back({roots[r], kind.runs->begin[r], std::uint64_t{first[r + 1] - first[r]}});
    }
    const auto number_of = [](const RootRange& root_ranges) { return root_ranges.root; };
    std::vector<RootRange> met;
    for (const auto& inbox : processes.all_to_all(blocks.outboxes(own, number_of))) {
        met.insert(met.end(), inbox.begin(), inbox.end());
    }
    std::ranges::sort(met, {}, number_of);
    return met;
}

/// Collective. Returns the numbers with a feature that are in this process's block, ascending.
std::vector<std::uint64_t> numbers_in_block(const Communicator& processes,
                                            const std::vector<std::uint64_t>& numbers,
                                            const NumberBlocks& blocks) {
    std::vector<std::uint64_t> met;
    for (const auto& inbox : processes.all_to_all(blocks.outboxes(numbers, std::identity{}))) {
        met.insert(met.end(), inbox.begin(), inbox.end());
    }
    sort_unique(met);
    return met;
}

/// Collective. Returns the number of input entities of a dimension.
std::uint64_t input_count(const DistributedMesh& mesh, std::size_t dimension,
                          const AncestorMap* ancestors) {
    if (dimension == 0) return mesh.input_vertex_count;
    return mesh.processes.max(ancestors->roots.empty() ? 0 : ancestors->roots.back() + 1);
}

}  // namespace

FeatureSlices::FeatureSlices(const DistributedMesh& mesh, const std::array<Kind, 3>& kinds)
    : processes_(mesh.processes) {
    if (!mesh.features) return;
    for (std::size_t dimension = 0; dimension <= kinds.size(); ++dimension) {
        const Kind* const kind = dimension == 0 ? nullptr : &kinds.at(dimension - 1);
        std::uint64_t listed = 0;
        for (const Feature f : all_features) {
            if (dimension_of(f) == dimension) listed += (*mesh.features)[f].size();
        }
        if (processes_.sum(listed) == 0) continue;
        const NumberBlocks blocks(
            processes_, input_count(mesh, dimension, kind == nullptr ? nullptr : kind->ancestors));
        std::vector<RootRange> root_ranges;
        if (kind != nullptr) root_ranges = roots_in_block(processes_, *kind, blocks);
        for (const Feature f : all_features) {
            if (dimension_of(f) != dimension) continue;
            std::uint64_t own = 0;
            for (const std::uint64_t number :
                 numbers_in_block(processes_, (*mesh.features)[f], blocks)) {
                Run run{own, number, 1};  // vertices keep their numbers
                if (kind != nullptr) {
                    const auto found =
                        std::ranges::lower_bound(root_ranges, number, {}, &RootRange::root);
                    run.begin = found->begin;
                    run.count = found->count;
                }
                own += run.count;
                runs_[f].push_back(run);
            }
            const std::uint64_t before = processes_.sum_before(own);
            for (Run& run : runs_[f]) run.first_entry += before;
            counts_[f] = processes_.sum(own);
        }
    }
}

std::span<const std::uint64_t> FeatureSlices::slice(Feature feature, const Window& window) {
    const std::vector<Run>& runs = runs_[feature];
    send_to_slices<std::uint64_t>(
        processes_, window,
        [&](std::uint64_t begin, std::uint64_t end, auto&& emit) {
            // The first run that ends after `begin`.
            auto run = std::ranges::partition_point(
                runs, [&](const Run& r) { return r.first_entry + r.count <= begin; });
            for (; run != runs.end() && run->first_entry < end; ++run) {
                const std::uint64_t from = std::max(begin, run->first_entry);
                const std::uint64_t to = std::min(end, run->first_entry + run->count);
                for (std::uint64_t p = from; p < to; ++p)
                    emit(p, run->begin + (p - run->first_entry));
            }
        },
        slice_);
    return slice_;
}

}  // namespace octetra::distributed
