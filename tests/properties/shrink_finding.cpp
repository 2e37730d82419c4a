#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "properties/replay.hpp"
#include "properties/report.hpp"
#include "properties/simpler.hpp"

/// Makes a finding smaller that ends or blocks the process that tries it, so that each step takes
/// an mpirun of its own:
///
///     shrink_finding FILE.json RANKS SECONDS [PROGRAM]
///
/// RANKS 0: as many as it was found on. It is tried on fewer, too, before all else and at the end,
/// when the case may need fewer than it did. A step is kept if its replay ends as that of the
/// finding does: without a verdict, whether by a signal, an abort or time that is up; or with a
/// broken law. The smallest so far is on disk at any time, in place of the one before, so Ctrl-C
/// loses nothing. Exit status: 0 it is as small as it gets, or time is up; 1 its law holds; 2 it
/// cannot be tried; 130 interrupted.
namespace octetra::properties {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t interrupted = 0;

extern "C" void interrupt(int /*signal*/) { interrupted = 1; }

/// A small case takes milliseconds of it. One that waits is given up after that.
constexpr const char* cpu_seconds_of_a_step = "3";

struct Search {
    Finding smallest;
    fs::path file;  ///< where it is
    std::string program;
    Clock::time_point end;
    int tried = 0;
};

/// Puts a smaller one in the place of what is on disk.
void keep(Search& search, Finding smaller) {
    search.smallest = std::move(smaller);
    const fs::path before = search.file;
    const fs::path folder = before.parent_path();
    search.file = write_finding(search.smallest, folder, name_of(search.smallest));
    if (search.file != before) remove_finding(folder, before.stem());
}

bool is_over(const Search& search) { return interrupted != 0 || Clock::now() >= search.end; }

/// How a replay of the finding ends; nothing, if it was cut short, for then nobody knows.
std::optional<Ending> ending_of(const Search& search, const Finding& candidate) {
    const std::chrono::duration<double> left = search.end - Clock::now();
    if (is_over(search)) return {};
    try {
        const Ending ending = replay(candidate, search.program, left.count());
        if (!is_over(search)) return ending;
    } catch (const std::runtime_error&) {
        if (!is_over(search)) throw;
    }
    return {};
}

void print_size(const Case& c) {
    fmt::print("{}\n", size_of(c));
    std::fflush(stdout);
}

/// Keeps the candidate if it ends as it should.
Trial attempt(Search& search, Ending wanted, Finding candidate) {
    const auto ending = ending_of(search, candidate);
    if (!ending) return Trial::not_made;
    ++search.tried;
    if (*ending != wanted) return Trial::holds;
    keep(search, std::move(candidate));
    return Trial::fails;
}

/// To the least number of ranks that will do. What the case gives to others they divide.
void take_fewer_ranks(Search& search, Ending wanted) {
    for (int ranks = 1; ranks < search.smallest.ranks; ++ranks) {
        Finding candidate = search.smallest;
        candidate.ranks = ranks;
        if (attempt(search, wanted, std::move(candidate)) != Trial::fails) continue;
        fmt::print("on {}, too\n", counted(static_cast<std::size_t>(ranks), "rank"));
        std::fflush(stdout);
    }
}

void take_simpler_cases(Search& search, Ending wanted) {
    (void)simplest(search.smallest.refinement, [&](const Case& c) {
        Finding candidate = search.smallest;
        candidate.refinement = c;
        const std::size_t cells = search.smallest.refinement.mesh.cells.size();
        const Trial trial = attempt(search, wanted, std::move(candidate));
        if (trial == Trial::fails && c.mesh.cells.size() < cells) print_size(c);
        return trial;
    });
}

/// As small as it gets, or as time allows.
void shrink(Search& search, Ending wanted) {
    take_fewer_ranks(search, wanted);
    take_simpler_cases(search, wanted);
    take_fewer_ranks(search, wanted);
    fmt::print("{} smaller cases tried: {}\n", search.tried,
               interrupted != 0  ? "interrupted"
               : is_over(search) ? "time is up"
                                 : "it is as small as it gets");
}

int run(Search search) {
    if (search.smallest.ranks < 1) {
        throw std::invalid_argument(
            "the file does not say on how many ranks it was found: give --ranks N");
    }
    print_size(search.smallest.refinement);
    const std::string ranks = counted(static_cast<std::size_t>(search.smallest.ranks), "rank");
    // What tried it is gone, and so it is in nobody's hands but ours.
    if (is_running_name(search.file.stem())) keep(search, search.smallest);
    const auto ending = ending_of(search, search.smallest);
    if (!ending) {
        fmt::print("{} before it was tried once\n",
                   interrupted != 0 ? "interrupted" : "time was up");
    } else if (*ending == Ending::held) {
        fmt::print(
            "on {} its law holds: what broke it is mended, or depends on chance.\n"
            "{} stays as it is.\n",
            ranks, search.file.string());
        return 1;
    } else {
        fmt::print("on {} {}\n", ranks,
                   *ending == Ending::died ? "it dies or waits for ever" : "it breaks its law");
        shrink(search, *ending);
    }
    fmt::print("{}\n", description(search.smallest, search.file));
    return interrupted != 0 ? 130 : 0;
}

Search search_of(std::span<char*> arguments) {
    if (arguments.size() < 4 || arguments.size() > 5) {
        throw std::invalid_argument("shrink_finding FILE.json RANKS SECONDS [PROGRAM]");
    }
    const fs::path file = fs::absolute(arguments[1]);
    const std::chrono::duration<double> seconds(std::stod(arguments[3]));
    Search search{.smallest = read_finding(file),
                  .file = file,
                  .program = arguments.size() == 5 ? arguments[4] : OCTETRA_TEST_PROGRAM,
                  .end = Clock::now() + std::chrono::duration_cast<Clock::duration>(seconds)};
    if (const int ranks = std::stoi(arguments[2]); ranks > 0) search.smallest.ranks = ranks;
    return search;
}

}  // namespace
}  // namespace octetra::properties

int main(int argc, char** argv) {
    using namespace octetra::properties;
    ::setenv("OCTETRA_CPU_SECONDS", cpu_seconds_of_a_step, 0);
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, interrupt);
    try {
        return run(search_of({argv, static_cast<std::size_t>(argc)}));
    } catch (const std::exception& error) {
        fmt::print(stderr, "shrink_finding: {}\n", error.what());
        return 2;
    }
}
