#include <octetra/distributed/partition.hpp>

#include <metis.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

#include <fmt/format.h>

#include <octetra/core/error.hpp>
#include <octetra/core/selection.hpp>
#include <octetra/core/standard_arithmetic.hpp>

#include "partition/cell_graph.hpp"
#include "partition/rcb.hpp"

namespace octetra::distributed {
namespace {

/// Returns whether there are enough cells for METIS, which rejects more parts than vertices; for
/// few cells it has no benefit.
bool is_worth_partitioning(const Mesh& mesh, int parts) {
    constexpr std::size_t cells_per_part = 8;
    return mesh.cells.size() >= cells_per_part * static_cast<std::size_t>(parts);
}

/// Returns the maximum weight of the cells with the same longest edge as one node of the graph: so
/// small that METIS can still balance the parts.
std::int64_t max_node_weight(std::int64_t all, int parts) {
    constexpr std::int64_t nodes_per_part = 20;
    return all / (nodes_per_part * parts);
}

/// Restores the handlers of SIGABRT and SIGTERM: METIS intercepts these signals while it works, and
/// leaves handlers that work only once.
class SignalHandlerGuard {
public:
    SignalHandlerGuard() {
        for (SavedHandler& saved : saved_) ::sigaction(saved.signal, nullptr, &saved.action);
    }
    ~SignalHandlerGuard() {
        for (const SavedHandler& saved : saved_) ::sigaction(saved.signal, &saved.action, nullptr);
    }
    SignalHandlerGuard(const SignalHandlerGuard&) = delete;
    SignalHandlerGuard& operator=(const SignalHandlerGuard&) = delete;
    SignalHandlerGuard(SignalHandlerGuard&&) = delete;
    SignalHandlerGuard& operator=(SignalHandlerGuard&&) = delete;

private:
    struct SavedHandler {
        int signal;
        struct sigaction action {};
    };
    std::array<SavedHandler, 2> saved_{{{SIGABRT}, {SIGTERM}}};
};

int run_metis(CellGraph& graph, idx_t parts, std::vector<int>& node_to_part) {
    const SignalHandlerGuard saved;
    auto node_count = static_cast<idx_t>(graph.node_weights.size());
    idx_t constraints = 1;
    idx_t cut = 0;
    std::array<idx_t, METIS_NOPTIONS> options{};
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_SEED] = 1;
    return METIS_PartGraphKway(&node_count, &constraints, graph.begin.data(),
                               graph.neighbours.data(), graph.node_weights.data(), nullptr,
                               graph.weights.data(), &parts, nullptr, nullptr, options.data(), &cut,
                               node_to_part.data());
}

std::vector<int> partition_graph(CellGraph graph, int parts) {
    static_assert(sizeof(idx_t) == sizeof(std::int32_t));
    std::vector<int> node_to_part(graph.node_weights.size());
    const int status = run_metis(graph, parts, node_to_part);
    // Invalid input and lack of memory have status codes of their own. METIS intercepts a SIGTERM
    // sent to the process, reports it as an error of its own, and does not pass it on.
    if (status == METIS_ERROR) {
        throw SystemError(
            "METIS could not partition the mesh: it reported an error, or received SIGTERM");
    }
    if (status != METIS_OK) throw SystemError("METIS could not partition the mesh");
    std::vector<int> cell_to_part(graph.cell_to_node.size());
    for (std::size_t c = 0; c < cell_to_part.size(); ++c) {
        cell_to_part[c] = node_to_part[static_cast<std::size_t>(graph.cell_to_node[c])];
    }
    return cell_to_part;
}

std::vector<int> equal_blocks(std::size_t cells, int parts) {
    std::vector<int> part(cells);
    for (std::size_t c = 0; c < cells; ++c) {
        part[c] = static_cast<int>(c * static_cast<std::size_t>(parts) / cells);
    }
    return part;
}

CellWeights weights_for_metis(std::size_t cells, const std::vector<float>& weights, int parts) {
    if (weights.empty()) return {};
    check_weights(cells, weights);
    return {weights, parts};
}

/// Partitions a graph of the cells with METIS.
std::vector<int> by_graph(const Mesh& mesh, int parts, PartitionMethod method,
                          const std::vector<float>& weights) {
    const std::size_t cells = mesh.cells.size();
    if (parts == 1 || !is_worth_partitioning(mesh, parts)) return equal_blocks(cells, parts);
    check_graph_size(cells);
    const CellWeights of_cells = weights_for_metis(cells, weights, parts);
    if (method == PartitionMethod::dual) {
        return partition_graph(face_dual_graph(mesh, of_cells), parts);
    }
    const std::int64_t most = max_node_weight(of_cells.sum(cells), parts);
    return partition_graph(lepp_graph(mesh, of_cells, most), parts);
}

std::vector<int> by_coordinates(const Mesh& mesh, int parts, const std::vector<float>& weights) {
    if (!weights.empty()) check_weights(mesh.cells.size(), weights);
    const float least = weights.empty() ? 1 : std::ranges::min(weights);
    const auto centroids = [&](std::size_t first, std::span<Point> points) {
        for (Point& point : points) {
            const auto& [a, b, c, d] = mesh.cells[CellIndex{first++}];
            point = centroid_of({mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]});
        }
    };
    WeighedPoints points{.count = mesh.cells.size(),
                         .points = centroids,
                         .number = [](std::size_t i) { return i; },
                         .weight = {}};
    if (!weights.empty()) {
        points.weight = [&](std::size_t i) { return integer_weight(weights[i], least); };
    }
    return bisect_coordinates(Communicator(), points, parts);
}

std::vector<int> at_random(std::size_t cells, int parts, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<int> part(cells);
    for (int& p : part) p = static_cast<int>(random() % static_cast<std::uint64_t>(parts));
    return part;
}

std::vector<int> from_file(const std::filesystem::path& path, std::size_t cells, int parts) {
    std::error_code ignored;
    const auto there = std::filesystem::status(path, ignored);
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there)) {
        // Opening a pipe would block until another process writes to it.
        throw InputError(fmt::format("{}: is not a file", path.native()));
    }
    std::ifstream in(path);
    if (!in) {
        throw InputError(
            fmt::format("{}: cannot be opened: {}", path.native(), std::strerror(errno)));
    }
    std::vector<int> part;
    std::size_t line_number = 0;
    for (std::string line; std::getline(in, line);) {
        ++line_number;
        if (line_number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // UTF-8
        if (line.ends_with('\r')) line.pop_back();
        if (line.empty() || line.front() == '#') continue;
        unsigned number = 0;
        const char* const end = line.data() + line.size();
        const auto [stop, error] = std::from_chars(line.data(), end, number);
        if (error != std::errc{} || stop != end || number >= static_cast<unsigned>(parts)) {
            throw InputError(
                fmt::format("{}:{}: a part number from 0 to {} expected, as there are {} parts "
                            "(octetra partition -n {} makes such a file)",
                            path.native(), line_number, parts - 1, parts, parts));
        }
        part.push_back(static_cast<int>(number));
    }
    if (part.size() != cells) {
        throw InputError(fmt::format("{}: {} part numbers found for a mesh of {} cells",
                                     path.native(), part.size(), cells));
    }
    return part;
}

}  // namespace

Partition parse_partition(const std::string& text) {
    if (text == "lepp") return {.method = PartitionMethod::lepp};
    if (text == "dual") return {.method = PartitionMethod::dual};
    if (text == "rcb") return {.method = PartitionMethod::rcb};
    if (text == "block") return {.method = PartitionMethod::block};
    if (text.starts_with("file:") && text.size() > 5) {
        return {.method = PartitionMethod::file, .path = text.substr(5)};
    }
    if (text.starts_with("random:")) {
        Partition partition{.method = PartitionMethod::random};
        const char* const end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data() + 7, end, partition.seed);
        if (error == std::errc{} && stop == end) return partition;
    }
    throw InputError(fmt::format(
        "partition takes lepp, dual, rcb, block, random:SEED or file:PATH, not '{}'", text));
}

std::string text_of(const Partition& partition) {
    switch (partition.method) {
        case PartitionMethod::rcb: return "rcb";
        case PartitionMethod::lepp: return "lepp";
        case PartitionMethod::dual: return "dual";
        case PartitionMethod::block: return "block";
        case PartitionMethod::random: return fmt::format("random:{}", partition.seed);
        case PartitionMethod::file: return fmt::format("file:{}", partition.path.native());
    }
    return {};
}

std::vector<int> partition_cells(const Mesh& mesh, int parts, const Partition& partition,
                                 const std::vector<float>& weights) {
    const StandardArithmetic standard;
    const std::size_t cells = mesh.cells.size();
    switch (partition.method) {
        case PartitionMethod::lepp:
        case PartitionMethod::dual: return by_graph(mesh, parts, partition.method, weights);
        case PartitionMethod::rcb: return by_coordinates(mesh, parts, weights);
        case PartitionMethod::block: return equal_blocks(cells, parts);
        case PartitionMethod::random: return at_random(cells, parts, partition.seed);
        case PartitionMethod::file: return from_file(partition.path, cells, parts);
    }
    return {};
}

}  // namespace octetra::distributed
