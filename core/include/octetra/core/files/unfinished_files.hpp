#pragma once

/// What a program that is ended has to clean up.
namespace octetra {

/// Removes the temporary files of everything that is being written at the moment. For a signal
/// handler that ends the program: it calls nothing but unlink().
void remove_unfinished_files() noexcept;

}  // namespace octetra
