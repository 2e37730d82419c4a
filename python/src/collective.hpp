#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include <octetra/distributed/communicator.hpp>

/// How collective functions are called from Python.
namespace octetra::python {

namespace py = pybind11;

/// The processes of an mpi4py communicator, or this one's: None. Collective.
[[nodiscard]] distributed::Communicator processes_of(const py::object& comm);

/// Does what waits for other processes, or takes long, without the GIL. The work must touch nothing
/// of Python.
auto without_gil(auto&& work) {
    const py::gil_scoped_release released;
    return work();
}

/// Converts what this rank has passed, with the GIL, which the caller has not. Whatever is thrown,
/// an exception of Python's too, comes as an InputError that names the rank, or as std::bad_alloc.
void convert_here(const distributed::Communicator& processes, const std::function<void()>& convert);

/// Collective. Converts what each rank has passed, with the GIL. Whatever is thrown on one rank, an
/// exception of Python's too, is thrown on all, as InputError or OutOfMemory, and names the rank.
void convert_on_each(const distributed::Communicator& processes,
                     const std::function<void()>& convert);

/// Collective. Throws InputError on all ranks where this is not the same on all, with `what` it is.
void check_same(const distributed::Communicator& processes, const std::string& own,
                const char* what);

/// Collective. What `path` says, a str or an os.PathLike, which must be the same on all ranks.
[[nodiscard]] std::filesystem::path common_path(const distributed::Communicator& processes,
                                                const py::object& given);

}  // namespace octetra::python
