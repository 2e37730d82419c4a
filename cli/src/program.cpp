#include "program.hpp"

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <octetra/core/error.hpp>

#include "commands/commands.hpp"

namespace octetra::cli {
namespace {

int fail(Status status, std::string_view what) {
    fmt::print(stderr, "octetra: {}\n", what);
    return static_cast<int>(status);
}

int parse_and_run(CLI::App& program, int argc, char** argv) {
    try {
        program.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        return program.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        fmt::print(stderr, "octetra: {}\nTry octetra --help, or octetra SUBCOMMAND --help.\n",
                   error.what());
        return static_cast<int>(Status::bad_input);
    }
    std::fflush(stdout);
    // Whoever reads the results from a pipe or a full disk must hear of it.
    if (std::ferror(stdout) != 0) throw SystemError("standard output cannot be written");
    return static_cast<int>(Status::done);
}

}  // namespace

int run(int argc, char** argv) {
    // Beyond a limit on file sizes a write then fails like one to a full disk, and is cleaned up
    // after, rather than that the signal ends the program.
    std::signal(SIGXFSZ, SIG_IGN);

    CLI::App program(
        "Refines tetrahedral meshes by longest-edge bisection (8T-LE).\n"
        "Files by extension: .ele/.node (TetGen), .mesh (Medit), .vtu (VTK, written only).",
        "octetra");
    program.set_version_flag("--version", "octetra 0.1.0");
    program.require_subcommand(1);
    program.get_formatter()->column_width(34);
    program.footer(
        "Example:\n"
        "  octetra generate gear -o gear.1.ele\n"
        "  octetra refine gear.1.ele --sphere 1,0,0.1,0.3 --levels 2 -o fine.vtu\n"
        "Exit status: 0 done; 1 the answer is no; 2 bad usage or input; 3 the system failed.");
    add_refine(program);
    add_info(program);
    add_generate(program);
    add_convert(program);

    try {
        return parse_and_run(program, argc, argv);
    } catch (const InputError& error) {
        return fail(Status::bad_input, error.what());
    } catch (const std::bad_alloc&) {
        return fail(Status::system_failed, "out of memory");
    } catch (const std::exception& error) {  // SystemError, filesystem_error ...
        return fail(Status::system_failed, error.what());
    }
}

}  // namespace octetra::cli
