#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

/// Progress output of commands that process a mesh; none if `quiet`.
namespace octetra::cli {

/// Prints a line to stdout: the action, the current size of the mesh, the time taken, and further
/// text.
void report_line(bool quiet, std::string_view doing, std::uint64_t vertices, std::uint64_t cells,
                 double seconds, std::string_view more = {});

/// Returns a function that shows each level on a line of stderr; empty if stderr is not a terminal.
[[nodiscard]] std::function<void(int level, std::uint64_t cells)> level_progress(bool quiet,
                                                                                 int levels);
void clear_level_progress();

}  // namespace octetra::cli
