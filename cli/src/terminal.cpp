#include "terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <iostream>

#include "program.hpp"

namespace octetra::cli {
namespace {

bool is_closed(int stream) { return ::fcntl(stream, F_GETFD) < 0 && errno == EBADF; }

/// Returns whether the reader of the pipe has closed it.
bool is_without_reader(int stream) {
    pollfd state{stream, POLLOUT, 0};
    return ::poll(&state, 1, 0) == 1 && (state.revents & POLLERR) != 0;
}

void print_to(std::FILE* stream, std::string_view text) {
    // Errors are recorded in the stream.
    (void)std::fwrite(text.data(), 1, text.size(), stream);
}

}  // namespace

void reserve_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (!is_closed(stream)) continue;
        // Opened in the wrong mode, so that reading or writing fails as with a closed stream.
        // open() returns the lowest free descriptor, which is this one.
        const int wrong_way = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
        if (::open("/dev/null", wrong_way) != stream) {
            std::_Exit(static_cast<int>(Status::system_failed));
        }
    }
}

void print_text(std::string_view text) { print_to(stdout, text); }

bool stdout_was_written() {
    std::cout.flush();  // CLI11 prints help and version there
    std::fflush(stdout);
    return (std::ferror(stdout) == 0 && std::cout.good()) || is_without_reader(STDOUT_FILENO);
}

void print_error_text(std::string_view text) {
    print_to(stderr, text);
    std::fflush(stderr);
}

void print_error_line(std::string_view message) {
    fmt::memory_buffer line;
    fmt::format_to(std::back_inserter(line), "octetra: ");
    for (std::size_t i = 0; i < message.size(); ++i) {
        const char c = message[i];
        const auto byte = static_cast<unsigned char>(c);
        // A message may show a text with a caret below it in indented lines.
        if (c == '\n' && message.substr(i + 1).starts_with("  ")) {
            line.push_back(c);
        } else if (byte < 0x20 || byte == 0x7f) {
            fmt::format_to(std::back_inserter(line), "\\x{:02x}", byte);
        } else {
            line.push_back(c);
        }
    }
    line.push_back('\n');
    print_error_text({line.data(), line.size()});
}

}  // namespace octetra::cli
