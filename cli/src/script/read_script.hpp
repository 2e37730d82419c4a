#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/distributed/communicator.hpp>

#include "adapt/steps.hpp"

/// Scripts of octetra adapt: a step per line, in the syntax of the command line.
namespace octetra::cli {

struct ScriptStep {
    std::uint64_t line = 0;
    std::string word;  ///< the first word of the line
    Step step;
};

struct Script {
    std::filesystem::path path;  ///< its name in messages; empty for a step of the command line
    bool is_piped = false;       ///< whether it is standard input
    std::vector<ScriptStep> steps;
};

/// Collective. The first process reads the file, a pipe, or for "-" standard input. Throws
/// InputError, "FILE:LINE: what is wrong", for the first line that is not a step, or if there are
/// no steps.
[[nodiscard]] Script read_script(const std::filesystem::path& path,
                                 const distributed::Communicator& world);

/// Returns a hint for the message about an invalid line whose comment begins within a word;
/// otherwise an empty string.
[[nodiscard]] std::string hint_of_comment(const std::filesystem::path& script, std::uint64_t line);

/// As above, for a line that is invalid for reasons outside the line.
[[nodiscard]] InputError wrong_line(const Script& script, const ScriptStep& step,
                                    std::string_view what);

}  // namespace octetra::cli
