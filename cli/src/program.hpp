#pragma once

namespace octetra::cli {

/// Exit statuses of every subcommand.
enum class Status {
    done = 0,           ///< done, or the answer is yes
    no = 1,             ///< the answer is no
    bad_input = 2,      ///< bad usage or bad input
    system_failed = 3,  ///< memory, disk, standard output
};

/// The program: reads the command line, runs the subcommand, prints what went wrong on stderr as
/// "octetra: ...". Returns the exit status.
int run(int argc, char** argv);

}  // namespace octetra::cli
