#pragma once

/// What a program that is ended has to clean up.
namespace octetra {

/// Removes the temporary files of everything that is being written at the moment. For the handler
/// of a signal that ends the program: it calls nothing but unlink().
///
/// False while a set of files is being put in place, which must not stop halfway: the handler then
/// returns, and `signal` is raised again when all of them are there.
[[nodiscard]] bool remove_unfinished_files(int signal) noexcept;

}  // namespace octetra
