/// The cost of a partition: `bench_partition [MESH [PARTS]]`, by default of a lattice of 55^3 cubes
/// into 4 parts.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include <octetra/core/files/mesh_files.hpp>
#include <octetra/distributed/partition.hpp>

#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace octetra {
namespace {

double processor_seconds() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double peak_megabytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

void measure(const std::filesystem::path& file, int parts, const std::string& method) {
    const Mesh mesh = read_mesh(file);
    const double before = peak_megabytes();
    const double begin = processor_seconds();
    const auto cell_to_part =
        distributed::partition_cells(mesh, parts, distributed::parse_partition(method));
    const double seconds = processor_seconds() - begin;
    const double peak = peak_megabytes();
    const auto statistics = distributed::measure_partition(mesh, cell_to_part, parts);
    fmt::print(
        "{:<6} {:9} cells in {} parts: {:5.2f} s, peak {:4.0f} MB (with the mesh alone {:.0f} MB), "
        "{} faces and {} links cut\n",
        method, mesh.cells.size(), parts, seconds, peak, before, statistics.cut_faces,
        statistics.cut_longest_edge_links);
    std::fflush(stdout);
}

/// Runs the work in a separate process, so that its figures contain nothing else.
void apart(auto&& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        work();
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (status != 0) std::exit(1);
}

}  // namespace
}  // namespace octetra

int main(int argc, char** argv) {
    using namespace octetra;
    const bool is_given = argc > 1 && argv[1][0] != '-';
    const int parts = is_given && argc > 2 ? std::atoi(argv[2]) : 4;
    const test::TemporaryFolder folder;
    const std::filesystem::path file = is_given ? argv[1] : folder / "lattice.ele";
    if (!is_given) apart([&] { (void)write_mesh(test::kuhn(55, 55, 55), file); });
    for (const std::string method : {"lepp", "dual", "block"}) {
        apart([&] { measure(file, parts, method); });
    }
}
