"""python3 -m octetra: the command line.

The program takes this process's place, rather than being called in it: so its signals, its exit status
and its streams are those of the program in a shell, and MPI, which a process can start once, starts in
it, also under mpirun.
"""

import os
import pathlib
import shutil
import sys

from ._program import PATH


def program() -> str:
    """That which was built or installed with the module, else one on the PATH."""
    beside = pathlib.Path(__file__).resolve().parent / PATH
    if beside.exists():
        return str(beside.resolve())
    found = shutil.which("octetra")
    if found is None:
        sys.exit(f"octetra: there is no program {beside}, nor one on the PATH")
    return found


def main() -> None:
    os.execv(program(), ["octetra", *sys.argv[1:]])


if __name__ == "__main__":
    main()
