/// Compares terminal-edge bisection with 8T-LE: `bench_rivals MESH --method terminal|8t|4t|2t
/// --task once|volume|edge --halvings K [--sphere X,Y,Z,R]` refines the cells of the mesh whose
/// centroids are in the sphere, or all, and their descendants, until each was cut, or has at most
/// an 8^K-th of the largest volume, or no edge longer than a 2^K-th of the longest one. Prints a
/// line of JSON. Communication between parts, by rcb, is measured under mpirun for octetra's
/// methods, and modelled for terminal-edge bisection with --parts.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <octetra/core/edge_order.hpp>
#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/adaptive_mesh.hpp>
#include <octetra/quality/shape.hpp>

#include "measuring.hpp"
#include "pattern_tables.hpp"
#include "rivals/ranks/terminal_edges_on_ranks.hpp"
#include "rivals/sizes.hpp"
#include "rivals/terminal_edges.hpp"

namespace octetra::bench {
namespace {

using distributed::AdaptiveMesh;
using distributed::Communicator;
using nlohmann::ordered_json;
using rivals::Goal;

struct Options {
    std::string mesh;
    std::string method = "terminal";
    std::string task = "once";
    int halvings = 1;
    std::vector<double> sphere;
};

double longest_square(const Corners& corners) {
    double square = 0;
    for (const auto& [i, j] : cell_edges) {
        square = std::max(square, squared_length({corners[i], corners[j]}));
    }
    return square;
}

Corners corners_of(std::span<const Point> points, const CellVertices& cell) {
    return {points[cell[0].value()], points[cell[1].value()], points[cell[2].value()],
            points[cell[3].value()]};
}

/// Points and cells only: terminal-edge bisection does not transfer markers.
Mesh bare_mesh(const std::string& path) {
    Mesh mesh = read_mesh(path);
    Mesh bare;
    bare.points = std::move(mesh.points);
    bare.cells = std::move(mesh.cells);
    return bare;
}

Goal goal_of(const Mesh& mesh, const Options& options) {
    Goal goal;
    Selection chosen{.all = options.sphere.empty()};
    if (options.sphere.size() == 4) {
        const auto& s = options.sphere;
        chosen.spheres.push_back({{s[0], s[1], s[2]}, s[3]});
    }
    double largest = 0;
    double square = 0;
    for (const CellVertices& cell : mesh.cells) {
        const Corners corners = corners_of(mesh.points, cell);
        goal.targets.push_back(marks(chosen, corners, 0, GlobalCell{0}) ? 1 : 0);
        if (goal.targets.back() == 0) continue;
        largest = std::max(largest, volume(corners));
        square = std::max(square, longest_square(corners));
    }
    constexpr double more_than_rounding = 1 + 1e-12;  // so that exact halves satisfy the goal
    if (options.task == "volume") {
        goal.volume = std::ldexp(largest, -3 * options.halvings) * more_than_rounding;
    }
    if (options.task == "edge") {
        goal.longest_edge = std::ldexp(std::sqrt(square), -options.halvings) * more_than_rounding;
    }
    return goal;
}

/// Cells and the cells of the input from which they descend, for any method.
struct Result {
    std::span<const Point> points;
    std::span<const CellVertices> cells;
    std::vector<std::uint32_t> roots;
};

ordered_json quantiles(std::vector<double> values, std::initializer_list<double> shares) {
    ordered_json list = ordered_json::array();
    std::ranges::sort(values);
    for (const double share : shares) {
        if (values.empty()) break;
        const auto last = static_cast<double>(values.size() - 1);
        list.push_back(values[static_cast<std::size_t>(std::lround(share * last))]);
    }
    return list;
}

ordered_json shapes(const std::vector<Corners>& cells) {
    std::vector<double> least;
    std::vector<double> greatest;
    std::vector<double> ratios;
    for (const Corners& corners : cells) {
        const auto [low, high] = std::ranges::minmax(quality::dihedral_angles(corners));
        least.push_back(low);
        greatest.push_back(high);
        double shortest = longest_square(corners);
        for (const auto& [i, j] : cell_edges) {
            shortest = std::min(shortest, squared_length({corners[i], corners[j]}));
        }
        ratios.push_back(std::sqrt(longest_square(corners) / shortest));
    }
    return {{"least_dihedral", quantiles(least, {0, 0.01, 0.1, 0.5})},
            {"greatest_dihedral", quantiles(greatest, {0.5, 0.9, 0.99, 1})},
            {"edge_ratio", quantiles(ratios, {0.5, 0.9, 0.99, 1})}};
}

ordered_json shapes_of_targets(const Mesh& mesh, const Goal& goal) {
    std::vector<Corners> cells;
    for (std::size_t c = 0; c < goal.targets.size(); ++c) {
        if (goal.targets[c] != 0)
            cells.push_back(corners_of(mesh.points, mesh.cells[CellIndex{c}]));
    }
    return shapes(cells);
}

/// Counts of this process's part, and the shapes of the descendants of cut cells.
ordered_json counts(const Result& result, const Goal& goal) {
    std::vector<std::uint32_t> cells_of_root(goal.targets.size(), 0);
    for (const std::uint32_t root : result.roots) ++cells_of_root[root];
    std::uint64_t outside = 0;
    std::uint64_t outside_cut = 0;
    for (std::size_t root = 0; root < goal.targets.size(); ++root) {
        if (goal.targets[root] != 0 || cells_of_root[root] == 0) continue;
        outside += cells_of_root[root] - 1;
        if (cells_of_root[root] > 1) ++outside_cut;
    }
    std::vector<Corners> made;
    for (std::size_t c = 0; c < result.cells.size(); ++c) {
        if (cells_of_root[result.roots[c]] == 1) continue;
        made.push_back(corners_of(result.points, result.cells[c]));
    }
    return {{"cells", result.cells.size()},
            {"vertices", result.points.size()},
            {"cells_added_outside", outside},
            {"cells_cut_outside", outside_cut},
            {"shapes", shapes(made)}};
}

ordered_json by_terminal_edges(const Mesh& mesh, const Goal& goal) {
    const double begin = processor_seconds();
    rivals::TerminalEdgeBisection bisection(mesh);
    const double linked = processor_seconds();
    const rivals::Rounds rounds = bisection.refine(goal);
    const double refined = processor_seconds();
    const rivals::TerminalEdgeMesh made = bisection.result();
    const double end = processor_seconds();
    std::vector<std::uint32_t> roots;
    for (const CellIndex root : made.maps.cell_to_parent) roots.push_back(root.value());
    ordered_json line = counts({made.mesh.points, made.mesh.cells, roots}, goal);
    line.update({{"rounds", rounds.edges_bisected.size()},
                 {"setup_seconds", linked - begin},
                 {"marking_seconds", 0.0},
                 {"refining_seconds", refined - linked},
                 {"result_seconds", end - refined}});
    return line;
}

/// Each rank keeps the cells of its part and releases the mesh, like octetra's ranks.
ordered_json by_ranks(const Communicator& world, const Mesh& mesh, const Goal& goal) {
    const auto parts = distributed::partition_cells(mesh, world.size(), {});
    rivals::PartOfMesh part = rivals::part_of(mesh, parts, world.rank());
    Goal own = goal;
    own.targets.clear();
    for (const std::uint64_t root : part.roots) own.targets.push_back(goal.targets[root]);
    const double begin = processor_seconds();
    rivals::TerminalEdgesOnRanks bisection(world, std::move(part), mesh.points.size());
    const double linked = processor_seconds();
    const rivals::Traffic traffic = bisection.refine(own);
    const double refined = processor_seconds();
    const rivals::PartOfMesh made = bisection.result();
    return {{"ranks", world.size()},
            {"cells", world.sum(made.mesh.cells.size())},
            {"rounds", traffic.rounds},
            {"messages", world.sum(traffic.messages)},
            {"bytes", world.sum(traffic.bytes)},
            {"asked", world.sum(traffic.asked)},
            {"ready", world.sum(traffic.ready)},
            {"shared_edges_bisected", world.sum(traffic.shared_edges_bisected)},
            {"setup_seconds", linked - begin},
            {"refining_seconds", refined - linked}};
}

std::vector<std::uint8_t> marks_of(const AdaptiveMesh& mesh, const Goal& goal) {
    std::vector<std::uint8_t> marks;
    marks.reserve(mesh.cells().size());
    const std::vector<std::uint32_t> places = mesh.root_of_cells();
    const double square = goal.longest_edge.value_or(0) * goal.longest_edge.value_or(0);
    for (std::size_t c = 0; c < places.size(); ++c) {
        bool is_marked = goal.targets[mesh.roots()[places[c]]] != 0;
        if (is_marked && (goal.volume || goal.longest_edge)) {
            const Corners corners = corners_of(mesh.points(), mesh.cells()[c]);
            is_marked = goal.volume ? rivals::is_larger(corners, *goal.volume)
                                    : longest_square(corners) > square;
        }
        marks.push_back(is_marked ? 1 : 0);
    }
    return marks;
}

/// The same goal by levels of 8T-LE, each of which marks the cells that have not reached it.
ordered_json by_levels(const Communicator& world, const Mesh& mesh, const Goal& goal,
                       Scheme scheme) {
    const auto parts = distributed::partition_cells(mesh, world.size(), {});
    make_pattern_tables();
    const double begin = processor_seconds();
    AdaptiveMesh adapted = AdaptiveMesh::distribute(world, mesh, parts);
    double marking = 0;
    double refining = 0;
    const double setup = processor_seconds() - begin;
    distributed::SynchronisationCounts told;
    std::uint64_t levels = 0;
    for (bool continues = true; continues;) {
        const double at = processor_seconds();
        const auto marks = marks_of(adapted, goal);
        const double marked = processor_seconds();
        const distributed::Adaptation step = adapted.refine(marks, {.scheme = scheme});
        refining += processor_seconds() - marked;
        marking += marked - at;
        told += step.synchronisation;
        levels += step.changed ? 1 : 0;
        continues = step.changed && (goal.volume || goal.longest_edge);
    }
    std::vector<std::uint32_t> roots = adapted.root_of_cells();
    for (std::uint32_t& root : roots) root = static_cast<std::uint32_t>(adapted.roots()[root]);
    ordered_json line = counts({adapted.points(), adapted.cells(), roots}, goal);
    for (const char* name : {"cells", "cells_added_outside", "cells_cut_outside"}) {
        line[name] = world.sum(line[name].get<std::uint64_t>());
    }
    line["vertices"] = adapted.vertex_count();
    line.update({{"levels", levels},
                 {"rounds", told.rounds},
                 {"messages", world.sum(told.messages)},
                 {"bytes", world.sum(told.bytes)},
                 {"setup_seconds", setup},
                 {"marking_seconds", marking},
                 {"refining_seconds", refining},
                 {"result_seconds", 0.0}});
    return line;
}

void measure(const Communicator& world, const Options& options) {
    const Mesh mesh = bare_mesh(options.mesh);
    const Goal goal = goal_of(mesh, options);
    ordered_json line{{"method", options.method},
                      {"task", options.task},
                      {"halvings", options.halvings},
                      {"ranks", world.size()},
                      {"input_cells", mesh.cells.size()},
                      {"targets", std::ranges::count(goal.targets, 1)},
                      {"shapes_of_targets", shapes_of_targets(mesh, goal)}};
    if (options.method == "terminal") {
        line.update(world.size() > 1 ? by_ranks(world, mesh, goal) : by_terminal_edges(mesh, goal));
    } else {
        const Scheme scheme = options.method == "8t"   ? Scheme::eight
                              : options.method == "4t" ? Scheme::four
                                                       : Scheme::two;
        line.update(by_levels(world, mesh, goal, scheme));
    }
    line["peak_bytes"] = peak_bytes();
    if (world.is_first()) fmt::print("{}\n", line.dump());
}

int run(const Communicator& world, int argc, char** argv) {
    CLI::App app("Terminal-edge bisection beside 8T-LE");
    Options options;
    app.add_option("mesh", options.mesh)->required();
    app.add_option("--method", options.method)
        ->check(CLI::IsMember({"terminal", "8t", "4t", "2t"}));
    app.add_option("--task", options.task)->check(CLI::IsMember({"once", "volume", "edge"}));
    app.add_option("--halvings", options.halvings)->check(CLI::Range(0, 30));
    app.add_option("--sphere", options.sphere)->delimiter(',')->expected(4);
    CLI11_PARSE(app, argc, argv);
    measure(world, options);
    return 0;
}

}  // namespace
}  // namespace octetra::bench

// NOLINTNEXTLINE(bugprone-exception-escape): it ends this process, and mpirun then all others
int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    return octetra::bench::run(session.world(), argc, argv);
}
