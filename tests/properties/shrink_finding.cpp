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

/// Shrinks a finding that ends or blocks the process that judges it, so that each step needs a
/// separate mpirun:
///
///     shrink_finding FILE.json RANKS SECONDS [PROGRAM]
///
/// RANKS 0: the number of ranks on which it was found. Fewer ranks are tried first, and again at
/// the end, when the smaller case may need fewer. A step is kept if its replay ends like that of
/// the finding: without a verdict (signal, abort or time limit), or with a broken law. The smallest
/// case so far replaces the previous one on disk, so Ctrl-C loses nothing. Exit status: 0 it cannot
/// be shrunk further, or the time is up; 1 its law holds; 2 it cannot be replayed; 130 interrupted.
namespace octetra::properties {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t interrupted = 0;

extern "C" void interrupt(int /*signal*/) { interrupted = 1; }

/// A small case takes milliseconds. A case that takes longer than this is taken for blocked.
constexpr const char* cpu_seconds_of_a_step = "3";

struct Search {
    Finding smallest;
    fs::path file;  ///< its present file
    std::string program;
    Clock::time_point end;
    int tried = 0;
};

/// Replaces the finding on disk by a smaller one.
void keep(Search& search, Finding smaller) {
    search.smallest = std::move(smaller);
    const fs::path before = search.file;
    const fs::path folder = before.parent_path();
    search.file = write_finding(search.smallest, folder, name_of(search.smallest));
    if (search.file != before) remove_finding(folder, before.stem());
}

bool is_over(const Search& search) { return interrupted != 0 || Clock::now() >= search.end; }

/// The result of replaying the finding; nothing if the time limit cut the replay short.
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

/// Keeps the candidate if its replay ends as wanted.
Trial attempt(Search& search, Ending wanted, Finding candidate) {
    const auto ending = ending_of(search, candidate);
    if (!ending) return Trial::not_made;
    ++search.tried;
    if (*ending != wanted) return Trial::holds;
    keep(search, std::move(candidate));
    return Trial::fails;
}

/// Reduces to the least number of ranks that reproduces the fault. Cells of removed ranks are
/// divided among the others.
void take_fewer_ranks(Search& search, Ending wanted) {
    for (int ranks = 1; ranks < search.smallest.ranks; ++ranks) {
        Finding candidate = search.smallest;
        candidate.ranks = ranks;
        if (attempt(search, wanted, std::move(candidate)) != Trial::fails) continue;
        fmt::print("also on {}\n", counted(static_cast<std::size_t>(ranks), "rank"));
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

/// Shrinks until no step succeeds or the time is up.
void shrink(Search& search, Ending wanted) {
    take_fewer_ranks(search, wanted);
    take_simpler_cases(search, wanted);
    take_fewer_ranks(search, wanted);
    fmt::print("{} smaller cases tried: {}\n", search.tried,
               interrupted != 0  ? "interrupted"
               : is_over(search) ? "time is up"
                                 : "it cannot be shrunk further");
}

int run(Search search) {
    if (search.smallest.ranks < 1) {
        throw std::invalid_argument("the file has no number of ranks: pass --ranks N");
    }
    print_size(search.smallest.refinement);
    const std::string ranks = counted(static_cast<std::size_t>(search.smallest.ranks), "rank");
    // A running name may be replaced, because the process that wrote it has ended.
    if (is_running_name(search.file.stem())) keep(search, search.smallest);
    const auto ending = ending_of(search, search.smallest);
    if (!ending) {
        fmt::print("{} before the first replay\n",
                   interrupted != 0 ? "interrupted" : "time was up");
    } else if (*ending == Ending::held) {
        fmt::print(
            "on {} its law holds: the fault is fixed, or depends on timing.\n"
            "{} stays as it is.\n",
            ranks, search.file.string());
        return 1;
    } else {
        fmt::print("on {} {}\n", ranks,
                   *ending == Ending::died ? "the replay crashes or blocks" : "the law is broken");
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
