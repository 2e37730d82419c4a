#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

/// What a command says while it works on a mesh; nothing if `quiet`.
namespace octetra::cli {

/// A line on stdout: what was done, how large the mesh is now, how long it took, and more.
void report_line(bool quiet, std::string_view doing, std::uint64_t vertices, std::uint64_t cells,
                 double seconds, std::string_view more = {});

/// Where people watch, a line on stderr that each level writes over; empty elsewhere.
[[nodiscard]] std::function<void(int level, std::uint64_t cells)> level_progress(bool quiet,
                                                                                 int levels);
void clear_level_progress();

}  // namespace octetra::cli
