#pragma once

#include <cstdio>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

/// What the program says: results on stdout, messages on stderr. Nothing here throws because a
/// stream cannot be written. Of stdout that is found in the end, by stdout_was_written(); of stderr
/// there is nobody left to tell.
namespace octetra::cli {

/// Call it before any file is opened. Keeps the numbers of standard streams that are closed from
/// files: the first file to be opened would have the number of stdout, and results in it.
void hold_closed_streams();

/// Takes the text as it is.
void print_text(std::string_view text);

template <class... Values>
void print(fmt::format_string<const Values&...> format, const Values&... values) {
    print_text(fmt::format(format, values...));
}

/// Has everything been written that was printed so far? A pipe whose reader has closed it, as head
/// does, counts as written: the reader has all that it asked for.
[[nodiscard]] bool stdout_was_written();

void print_error_text(std::string_view text);
void print_error_line(std::string_view message);

/// A message on stderr, in one piece and in one line: "octetra: ...". Line ends and the like, which
/// names of files may have, are shown as \x0a. For short messages no memory is needed.
template <class... Values>
void tell(fmt::format_string<const Values&...> format, const Values&... values) {
    fmt::memory_buffer message;
    fmt::format_to(std::back_inserter(message), format, values...);
    print_error_line({message.data(), message.size()});
}

}  // namespace octetra::cli
