"""python3 -m octetra: the command line.

The program replaces this process. Signals, exit status and streams are therefore those of the program,
and MPI, which a process can start only once, starts in it, also under mpirun.
"""

import os
import pathlib
import shutil
import sys

from ._program import PATH


def program() -> str:
    """The path of the program that was built or installed with the module, or of one on the PATH."""
    beside = pathlib.Path(__file__).resolve().parent / PATH
    if beside.exists():
        return str(beside.resolve())
    found = shutil.which("octetra")
    if found is None:
        sys.exit(f"octetra: there is no program {beside}, and none on the PATH")
    return found


def main() -> None:
    os.execv(program(), ["octetra", *sys.argv[1:]])


if __name__ == "__main__":
    main()
