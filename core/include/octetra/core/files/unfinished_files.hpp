#pragma once

/// Removal of temporary files when the program is terminated.
namespace octetra {

/// Removes the temporary files of all output in progress. Async-signal-safe: intended for the
/// handler of a signal that terminates the program; calls only unlink().
///
/// Returns false while a set of files is being renamed to their final names, which must not be
/// interrupted: the handler then returns, and `signal` is raised again after all files have been
/// renamed.
[[nodiscard]] bool remove_unfinished_files(int signal) noexcept;

}  // namespace octetra
