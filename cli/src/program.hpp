#pragma once

namespace octetra::cli {

/// The exit statuses of all subcommands.
enum class Status {
    done = 0,           ///< done, or the answer is yes
    no = 1,             ///< the answer is no
    bad_input = 2,      ///< bad usage or bad input
    system_failed = 3,  ///< memory, disk, standard output
};

/// Runs the program: parses the command line, runs the subcommand, prints errors to stderr as
/// "octetra: ...". Returns the exit status.
int run(int argc, char** argv);

}  // namespace octetra::cli
