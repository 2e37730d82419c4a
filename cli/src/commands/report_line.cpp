#include "commands/report_line.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "grouped.hpp"
#include "terminal.hpp"

namespace octetra::cli {

void report_line(bool quiet, std::string_view doing, std::uint64_t vertices, std::uint64_t cells,
                 double seconds, std::string_view more) {
    if (quiet) return;
    print("{:<30} {:>13} vertices {:>13} cells {:>8.2f} s{}\n", doing, grouped(vertices),
          grouped(cells), seconds, more);
    std::fflush(stdout);
}

std::function<void(int, std::uint64_t)> level_progress(bool quiet, int levels) {
    if (quiet || ::isatty(STDERR_FILENO) == 0) return {};
    return [levels](int level, std::uint64_t cells) {
        const std::string of = levels == 0 ? "" : fmt::format(" of {}", levels);
        print_error_text(fmt::format("\rlevel {}{}: {} cells ", level, of, grouped(cells)));
    };
}

void clear_level_progress() { print_error_text(fmt::format("\r{:60}\r", "")); }

}  // namespace octetra::cli
