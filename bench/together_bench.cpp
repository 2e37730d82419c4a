/// Rates of collective writing and reading of one file: `bench_together MESH FOLDER [TURNS
/// [.EXTENSION...]]` reads and distributes MESH, writes it in all formats, or in these, to FOLDER,
/// and reads again each file that can be read, with a share of the bytes for each rank. Prints for
/// each the median of the turns, from barrier to barrier, in MB (10^6 bytes) of the file per
/// second. For comparison it prints `slices`, the redistribution of points and cells to the ranks
/// that write them, and the rates for the bytes of the largest file alone, in blocks. Files are in
/// the page cache. Also under mpirun.

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <octetra/core/mesh_share.hpp>
#include <octetra/distributed/canonical_mesh.hpp>
#include <octetra/distributed/read_parts.hpp>

#include "measuring.hpp"

namespace octetra::bench {
namespace {

using distributed::Communicator;
namespace fs = std::filesystem;

constexpr std::uint64_t block = std::uint64_t{1} << 20U;

double seconds_of(const Communicator& world, const std::function<void()>& work) {
    (void)world.max(0);
    const double start = wall_seconds();
    work();
    (void)world.max(0);
    return wall_seconds() - start;
}

/// All blocks of a file of this size, each by one rank.
void pass_bytes(const Communicator& world, const fs::path& path, std::uint64_t size, bool writes) {
    std::vector<char> buffer(block, 'x');
    const int file = ::open(path.c_str(), writes ? O_RDWR | O_CREAT : O_RDONLY, 0600);
    const auto stride = block * static_cast<std::uint64_t>(world.size());
    for (auto at = block * static_cast<std::uint64_t>(world.rank()); at < size; at += stride) {
        const std::uint64_t length = std::min(block, size - at);
        const auto offset = static_cast<off_t>(at);
        const ssize_t passed = writes ? ::pwrite(file, buffer.data(), length, offset)
                                      : ::pread(file, buffer.data(), length, offset);
        if (passed != static_cast<ssize_t>(length)) throw std::runtime_error("bytes alone");
    }
    ::close(file);
}

/// In windows of the same length as those of the writers of binary files.
void redistribute_slices(MeshSource& mesh) {
    constexpr std::uint64_t length = std::uint64_t{1} << 15U;
    const auto ranks = static_cast<std::uint64_t>(mesh.group().size());
    const auto bring = [&](std::uint64_t count, const auto& slice_of) {
        const std::uint64_t stretch = (count + ranks - 1) / ranks;
        for (std::uint64_t begin = 0; begin < stretch; begin += length) {
            slice_of(Window{begin, std::min(length, stretch - begin), count, stretch});
        }
    };
    bring(mesh.facts().vertices, [&](const Window& window) { (void)mesh.points(window); });
    bring(mesh.facts().cells, [&](const Window& window) { (void)mesh.cells(window); });
}

class Table {
public:
    Table(const Communicator& world, fs::path folder)
        : world_(&world), folder_(std::move(folder)) {}

    /// Writes to a new file: replacing an existing one takes twice as long.
    void write(const std::string& name, const std::function<void(const fs::path&)>& work) {
        const fs::path path = folder_ / name;
        if (world_->is_first()) {
            for (const char* extension : {"", ".node", ".face", ".edge"}) {
                fs::path one = path;
                if (*extension != '\0') one.replace_extension(extension);
                fs::remove(one);
            }
        }
        note_file("write " + name, path, [&] { work(path); });
    }
    void read(const std::string& name, const std::function<void(const fs::path&)>& work) {
        const fs::path path = folder_ / name;
        note_file("read " + name, path, [&] { work(path); });
    }
    void note(const std::string& what, std::uint64_t bytes, const std::function<void()>& work) {
        seconds_[what].push_back(seconds_of(*world_, work));
        bytes_[what] = bytes;
    }
    [[nodiscard]] std::uint64_t largest() const { return largest_; }

    void print() {
        if (!world_->is_first()) return;
        for (auto& [what, taken] : seconds_) {
            std::ranges::sort(taken);
            const double median = taken[taken.size() / 2];
            const auto megabytes = static_cast<double>(bytes_[what]) * 1e-6;
            fmt::print("{:<14} {:7.1f} MB {:7.1f} ms {:7.0f} MB/s\n", what, megabytes, median * 1e3,
                       megabytes / median);
        }
    }

private:
    void note_file(const std::string& what, const fs::path& path,
                   const std::function<void()>& work) {
        note(what, 0, work);
        std::uint64_t bytes = fs::file_size(path);
        if (path.extension() == ".ele") {
            for (const char* extension : {".node", ".face", ".edge"}) {
                fs::path beside = path;
                beside.replace_extension(extension);
                if (fs::exists(beside)) bytes += fs::file_size(beside);
            }
        }
        bytes_[what] = bytes;
        largest_ = std::max(largest_, bytes);
    }

    const Communicator* world_;
    fs::path folder_;
    std::map<std::string, std::vector<double>> seconds_;
    std::map<std::string, std::uint64_t> bytes_;
    std::uint64_t largest_ = 0;
};

void measure(const Communicator& world, const fs::path& mesh, const fs::path& folder, int turns,
             const std::vector<std::string>& extensions) {
    auto part = distributed::read_parts(world, mesh, {});
    distributed::CanonicalMesh fine(std::move(part));
    Table table(world, folder);
    for (int turn = 0; turn < turns; ++turn) {
        for (const std::string& extension : extensions) {
            table.write("a" + extension,
                        [&](const fs::path& path) { (void)write_mesh(fine, path); });
            if (extension.starts_with(".v")) continue;  // VTK's files are not read
            table.read("a" + extension, [&](const fs::path& path) {
                if (!read_mesh_share(path, world)) throw std::runtime_error("not read together");
            });
        }
        const std::uint64_t size = table.largest();
        table.note("slices", size, [&] { redistribute_slices(fine.whole()); });
        table.write("bytes", [&](const fs::path& path) { pass_bytes(world, path, size, true); });
        table.read("bytes", [&](const fs::path& path) { pass_bytes(world, path, size, false); });
    }
    if (world.is_first()) {
        fmt::print("{} cells, {} ranks, medians of {}\n", fine.facts().cells, world.size(), turns);
    }
    table.print();
}

}  // namespace
}  // namespace octetra::bench

int main(int argc, char** argv) {
    const octetra::distributed::MpiSession session(&argc, &argv);
    if (argc < 3) return 2;
    std::vector<std::string> extensions(argv + std::min(argc, 4), argv + argc);
    if (extensions.empty()) extensions = {".ele", ".mesh", ".meshb", ".vtu", ".vtkhdf"};
    octetra::bench::measure(session.world(), argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 5,
                            extensions);
}
