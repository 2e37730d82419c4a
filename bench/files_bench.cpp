/// Rates of reading and writing mesh files, in bytes of the files per second. Files are in the page
/// cache.

#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>

#include <octetra/core/files/mesh_files.hpp>

#include "support/discarding_sink.hpp"
#include "support/meshes.hpp"
#include "support/temporary_folder.hpp"

namespace octetra {
namespace {

/// 1.03 million cells with coordinates of full length and all lists.
const Mesh& large_mesh() {
    static const Mesh mesh = [] {
        Mesh m = test::kuhn(56, 56, 55, 1.0 / 3);
        for (Point& p : m.points) p = {p.x / 7, p.y / 11, p.z / 13};
        test::list_boundary(m);
        m.regions.assign(m.cells.size(), 3);
        return m;
    }();
    return mesh;
}

std::uint64_t bytes_in(const std::filesystem::path& folder) {
    std::uint64_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        bytes += entry.file_size();
    }
    return bytes;
}

void set_rate(benchmark::State& state, const std::filesystem::path& folder) {
    const auto bytes = static_cast<std::int64_t>(bytes_in(folder));
    state.SetBytesProcessed(state.iterations() * bytes);
    state.counters["file MB"] = static_cast<double>(bytes) * 1e-6;
    state.counters["cells/s"] = benchmark::Counter(
        static_cast<double>(state.iterations()) * static_cast<double>(large_mesh().cells.size()),
        benchmark::Counter::kIsRate);
}

void write_file(benchmark::State& state, const std::string& name,
                const WriteOptions& options = {}) {
    const test::TemporaryFolder folder;
    const Mesh& mesh = large_mesh();  // made before timing starts
    for ([[maybe_unused]] auto _ : state) {
        (void)write_mesh(mesh, folder / name, options);
        // If a file replaces another one, ext4 flushes it to the disk at once.
        state.PauseTiming();
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            std::filesystem::remove(entry.path());
        }
        state.ResumeTiming();
    }
    (void)write_mesh(mesh, folder / name, options);
    set_rate(state, folder.path());
}

void read_file(benchmark::State& state, const std::string& name, const WriteOptions& options = {}) {
    const test::TemporaryFolder folder;
    (void)write_mesh(large_mesh(), folder / name, options);
    for ([[maybe_unused]] auto _ : state) {
        const Mesh mesh = read_mesh(folder / name);
        benchmark::DoNotOptimize(mesh.points.data());
    }
    set_rate(state, folder.path());
}

/// Without the checks, and the memory, that require the whole mesh.
void stream_file(benchmark::State& state, const std::string& name,
                 const WriteOptions& options = {}) {
    const test::TemporaryFolder folder;
    (void)write_mesh(large_mesh(), folder / name, options);
    for ([[maybe_unused]] auto _ : state) {
        test::DiscardingSink sink;
        stream_mesh(folder / name, sink);
    }
    set_rate(state, folder.path());
}

constexpr WriteOptions gmsh_2{.msh = {.is_2 = true}};
constexpr WriteOptions gmsh_text{.msh = {.is_text = true}};
constexpr WriteOptions gmsh_2_text{.msh = {.is_2 = true, .is_text = true}};

BENCHMARK_CAPTURE(write_file, tetgen, "a.ele")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(write_file, medit, "a.mesh")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(write_file, meshb, "a.meshb")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(write_file, gmsh, "a.msh")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(write_file, gmsh_2, "a.msh", gmsh_2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(write_file, gmsh_text, "a.msh", gmsh_text)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(write_file, gmsh_2_text, "a.msh", gmsh_2_text)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(write_file, vtu, "a.vtu")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(write_file, vtkhdf, "a.vtkhdf")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read_file, tetgen, "a.ele")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read_file, medit, "a.mesh")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read_file, meshb, "a.meshb")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read_file, gmsh, "a.msh")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read_file, gmsh_2, "a.msh", gmsh_2)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(read_file, gmsh_text, "a.msh", gmsh_text)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(read_file, gmsh_2_text, "a.msh", gmsh_2_text)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(stream_file, tetgen, "a.ele")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(stream_file, medit, "a.mesh")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(stream_file, meshb, "a.meshb")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(stream_file, gmsh, "a.msh")->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace octetra

BENCHMARK_MAIN();
