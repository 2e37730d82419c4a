#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <pybind11/pybind11.h>

#include <octetra/distributed/communicator.hpp>

/// Support for collective functions that Python calls.
namespace octetra::python {

namespace py = pybind11;

/// Collective. The communicator of an mpi4py communicator, or that of all ranks for None. Throws
/// on this rank alone if `comm` is neither: there is no communicator to agree on.
[[nodiscard]] distributed::Communicator processes_of(const py::object& comm);

/// Runs work that waits for other ranks, or takes long, without the GIL. The work must not use
/// objects of Python.
auto without_gil(auto&& work) {
    const py::gil_scoped_release released;
    return work();
}

/// Acquires the GIL, which the caller does not hold, and converts the arguments of this rank.
/// Throws std::bad_alloc, or an InputError that names the rank instead of any other exception,
/// those of Python included.
void convert_here(const distributed::Communicator& processes, const std::function<void()>& convert);

/// Collective. Calls `convert` with the GIL. An exception on one rank, of Python or C++, is thrown
/// on all ranks, as InputError or OutOfMemory; the message names the rank.
void convert_on_each(const distributed::Communicator& processes,
                     const std::function<void()>& convert);

/// Collective. Throws InputError on all ranks if `own` differs between ranks; `name` says in the
/// message which argument it is.
void check_same(const distributed::Communicator& processes, const std::string& own,
                const char* name);

/// Collective. The path that `convert`, called with the GIL, returns. Throws InputError on all
/// ranks if it fails on one, or if the paths differ.
[[nodiscard]] std::filesystem::path common_path(
    const distributed::Communicator& processes,
    const std::function<std::filesystem::path()>& convert);

}  // namespace octetra::python
