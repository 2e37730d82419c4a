#include "collective.hpp"

#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include <fmt/format.h>
#include <mpi.h>

#include <octetra/core/error.hpp>
#include <octetra/distributed/mpi.hpp>

#include "arguments.hpp"

namespace octetra::python {
namespace {

/// All ranks, by MPI that this module starts because there is no mpi4py, and finalises when the
/// interpreter exits.
const distributed::Communicator& own_world() {
    static std::unique_ptr<distributed::MpiSession> session;
    if (!session) {
        session = std::make_unique<distributed::MpiSession>(nullptr, nullptr);
        py::module_::import("atexit").attr("register")(py::cpp_function([] { session.reset(); }));
    }
    return session->world();
}

/// The message without the traceback that pybind11 appends.
std::string first_line(const char* text) {
    const std::string lines = text;
    return lines.substr(0, lines.find('\n'));
}

/// The MPI handle of an mpi4py communicator.
MPI_Comm handle_of(const py::object& mpi, const py::object& comm) {
    if (!py::isinstance(comm, mpi.attr("Comm"))) {
        refuse("comm", "a communicator of mpi4py or None", comm);
    }
    char text[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    MPI_Get_library_version(text, &length);
    const auto theirs = mpi.attr("Get_library_version")().cast<std::string>();
    if (std::strcmp(theirs.c_str(), text) != 0 ||  // some versions include the terminating zero
        mpi.attr("_sizeof")(mpi.attr("Comm")).cast<std::size_t>() != sizeof(MPI_Comm)) {
        throw SystemError("mpi4py and octetra were built with different MPI libraries");
    }
    MPI_Comm handle = MPI_COMM_NULL;
    const auto address = mpi.attr("_addressof")(comm).cast<std::uintptr_t>();
    std::memcpy(&handle, reinterpret_cast<const void*>(address), sizeof handle);
    if (handle == MPI_COMM_NULL)
        throw InputError("comm is COMM_NULL, a communicator without this process");
    return handle;
}

}  // namespace

distributed::Communicator processes_of(const py::object& comm) {
    py::object mpi;
    try {
        mpi = py::module_::import("mpi4py.MPI");
    } catch (py::error_already_set& error) {
        if (!error.matches(PyExc_ImportError)) throw;
        if (!comm.is_none()) refuse("comm", "None, as mpi4py is not installed", comm);
        return own_world();
    }
    const py::object given = comm.is_none() ? py::object(mpi.attr("COMM_WORLD")) : comm;
    const MPI_Comm handle = handle_of(mpi, given);
    return without_gil([&] { return distributed::communicator_of(handle); });
}

void convert_here(const distributed::Communicator& processes,
                  const std::function<void()>& convert) {
    const py::gil_scoped_acquire acquired;
    try {
        convert();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (py::error_already_set& error) {
        if (error.matches(PyExc_MemoryError)) throw std::bad_alloc();
        throw InputError(fmt::format("rank {}: {}", processes.rank(), first_line(error.what())));
    } catch (const std::exception& error) {
        throw InputError(fmt::format("rank {}: {}", processes.rank(), error.what()));
    }
}

void convert_on_each(const distributed::Communicator& processes,
                     const std::function<void()>& convert) {
    without_gil([&] { processes.transaction([&] { convert_here(processes, convert); }); });
}

std::filesystem::path common_path(const distributed::Communicator& processes,
                                  const std::function<std::filesystem::path()>& convert) {
    std::filesystem::path path;
    convert_on_each(processes, [&] { path = convert(); });
    check_same(processes, path.native(), "path");
    return path;
}

void check_same(const distributed::Communicator& processes, const std::string& own,
                const char* name) {
    without_gil([&] { processes.check_same(name, own); });
}

}  // namespace octetra::python
