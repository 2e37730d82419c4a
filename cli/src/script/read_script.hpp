#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <octetra/core/error.hpp>
#include <octetra/distributed/communicator.hpp>

#include "adapt/steps.hpp"

/// Scripts of octetra adapt: a step a line, in the words of the command line.
namespace octetra::cli {

struct ScriptStep {
    std::uint64_t line = 0;
    std::string word;  ///< the first of the line
    Step step;
};

struct Script {
    std::filesystem::path path;  ///< its name for people; empty for a step of the command line
    bool is_piped = false;       ///< standard input, which is no file
    std::vector<ScriptStep> steps;
};

/// Collective. The first process reads the file, a pipe, or for "-" standard input. Throws
/// InputError, "FILE:LINE: what is wrong", for the first line that is no step, or if there is none
/// at all.
[[nodiscard]] Script read_script(const std::filesystem::path& path,
                                 const distributed::Communicator& world);

/// For the message about a wrong line: a hint, if its comment begins within a word; else nothing.
[[nodiscard]] std::string hint_of_comment(const std::filesystem::path& script, std::uint64_t line);

/// The same InputError, of a line that is wrong for reasons that are not in it.
[[nodiscard]] InputError wrong_line(const Script& script, const ScriptStep& step,
                                    std::string_view what);

}  // namespace octetra::cli
