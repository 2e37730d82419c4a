#pragma once

#include <stdexcept>
#include <string>

/// The exceptions of the libraries. The program turns them into exit statuses.
namespace octetra {

/// The user's input is unusable (exit status 2). what() is "FILE:LINE: what is wrong" for an error
/// in a file, otherwise a sentence.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The system failed: a disk is full, a file cannot be written, memory ran out (exit status 3).
struct SystemError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace octetra
