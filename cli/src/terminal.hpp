#pragma once

#include <cstdio>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

/// Output of the program: results on stdout, messages on stderr. Errors of a stream do not throw.
/// Those of stdout are detected at the end by stdout_was_written(); those of stderr cannot be
/// reported.
namespace octetra::cli {

/// Must be called before any file is opened. Reserves the descriptors of closed standard streams:
/// otherwise the first file opened would receive the descriptor of stdout, and results in it.
void reserve_closed_streams();

/// Prints the text unmodified.
void print_text(std::string_view text);

template <class... Values>
void print(fmt::format_string<const Values&...> format, const Values&... values) {
    print_text(fmt::format(format, values...));
}

/// Returns whether all output has been written. A pipe closed by its reader, as by head, counts as
/// written.
[[nodiscard]] bool stdout_was_written();

void print_error_text(std::string_view text);
void print_error_line(std::string_view message);

/// Prints a message to stderr in a single write and line: "octetra: ...". Control characters, which
/// file names may contain, are shown as \x0a. Short messages allocate no memory.
template <class... Values>
void print_message(fmt::format_string<const Values&...> format, const Values&... values) {
    fmt::memory_buffer message;
    fmt::format_to(std::back_inserter(message), format, values...);
    print_error_line({message.data(), message.size()});
}

}  // namespace octetra::cli
