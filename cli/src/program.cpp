#include "program.hpp"

#include <csignal>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>
#include <octetra/core/files/unfinished_files.hpp>
#include <octetra/distributed/communicator.hpp>
#include <octetra/distributed/out_of_memory.hpp>

#include "commands/commands.hpp"
#include "negative_answer.hpp"
#include "terminal.hpp"
#include "usage_errors.hpp"

#ifdef __GLIBC__  // defined by the library's headers
#include <malloc.h>
#endif

namespace octetra::cli {
namespace {

extern "C" void remove_files_and_end(int signal) {
    if (!remove_unfinished_files(signal)) return;  // the signal will be raised again
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void handle_signals() {
    // If a file exceeds the size limit, the write fails, as on a full disk, and is cleaned up,
    // instead of the signal terminating the program.
    std::signal(SIGXFSZ, SIG_IGN);
    // Output to a pipe without a reader is lost, but the run continues and files are written.
    std::signal(SIGPIPE, SIG_IGN);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        // A signal that was ignored at program start, as by nohup, remains ignored.
        if (std::signal(signal, remove_files_and_end) == SIG_IGN) std::signal(signal, SIG_IGN);
    }
}

/// Returns the memory of large freed arrays to the system immediately, because the peak matters if
/// ranks share a machine. Small blocks are kept for reuse: page faults and clearing of pages would
/// otherwise take as long as a step of a loop.
void configure_allocator() {
#ifdef __GLIBC__
    constexpr int large = 32 << 20;
    mallopt(M_MMAP_THRESHOLD, large);
    mallopt(M_TRIM_THRESHOLD, 2 * large);
#endif
}

int fail(Status status, std::string_view what, const distributed::Communicator& world) {
    if (world.is_first()) print_message("{}", what);
    return static_cast<int>(status);
}

/// Reports an error of this process alone, for which other processes may be waiting.
int fail_on_one_rank(std::string_view what, const distributed::MpiSession& session) {
    constexpr auto status = static_cast<int>(Status::system_failed);
    const distributed::Communicator& world = session.world();
    if (world.size() == 1) return fail(Status::system_failed, what, world);
    if (session.is_first_to_fail()) print_message("rank {}: {}", world.rank(), what);
    distributed::MpiSession::abort(status);
}

void declare_all(CLI::App& program, const distributed::Communicator& world) {
    program.description(
        "Refines tetrahedral meshes by longest-edge bisection (8T-LE).\n"
        "Files by extension: .ele/.node (TetGen), .mesh/.meshb (Medit), .msh (Gmsh), .octetra "
        "(with its history),\n.vtu, .pvtu and .vtkhdf (VTK) and .xdmf with .h5 (XDMF), written "
        "only.");
    program.set_version_flag("--version", "octetra " OCTETRA_VERSION);
    program.require_subcommand(1);
    program.option_defaults()->disable_flag_override();  // --all=3
    program.get_formatter()->column_width(34);
    program.footer(
        "Exit status: 0 done; 1 the answer is no; 2 bad usage or input; 3 the system failed;\n"
        "128 + its number: a signal ended octetra or, under mpirun, one of its ranks.\n"
        "Example:\n"
        "  octetra generate kuhn 8 -o cube.mesh\n"
        "  octetra refine cube.mesh --sphere 0,0,0,0.3 --levels 2 -o fine.mesh\n"
        "  octetra verify cube.mesh fine.mesh\n"
        "  mpirun -n 4 octetra refine cube.mesh --sphere 0,0,0,0.3 --levels 2 -o fine.vtu");
    add_refine(program, world);
    add_adapt(program, world);
    add_coarsen(program, world);
    add_fit(program, world);
    add_info(program, world);
    add_generate(program, world);
    add_convert(program, world);
    add_partition(program, world);
    add_verify(program, world);
    add_certify(program, world);
    add_compare(program, world);
}

int parse_and_run(int argc, char** argv, const distributed::Communicator& world) {
    CLI::App program("", "octetra");
    declare_all(program, world);
    auto status = Status::done;
    try {
        program.parse(argc, argv);
    } catch (const NegativeAnswer&) {
        status = Status::no;
    } catch (const CLI::Success& help_or_version) {
        if (world.is_first()) program.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        return fail(Status::bad_input, usage_error(program, error), world);
    }
    world.on_first([] {
        if (!stdout_was_written()) throw SystemError("standard output cannot be written");
    });
    return static_cast<int>(status);
}

}  // namespace

int run(int argc, char** argv) {
    reserve_closed_streams();
    handle_signals();
    configure_allocator();
    const distributed::MpiSession session(&argc, &argv);
    const distributed::Communicator& world = session.world();
    try {
        return parse_and_run(argc, argv, world);
    } catch (const InputError& error) {
        return fail(Status::bad_input, error.what(), world);
    } catch (const SystemError& error) {
        return fail(Status::system_failed, error.what(), world);
    } catch (const distributed::OutOfMemory& error) {
        return fail(Status::system_failed, world.size() == 1 ? "out of memory" : error.what(),
                    world);
    } catch (const std::bad_alloc&) {
        return fail_on_one_rank("out of memory", session);
    } catch (const std::exception& error) {  // filesystem_error ...
        return fail_on_one_rank(error.what(), session);
    }
}

}  // namespace octetra::cli
