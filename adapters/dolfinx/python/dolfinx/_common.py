"""Definitions that all parts of the adapter use."""

from typing import Any

import numpy as np
from mpi4py import MPI

from .. import _octetra

#: The entry in Handover.vertices of a node that belongs only to ghost cells.
NONE = np.int32(-1)


def check(comm: Any, fault: str) -> None:
    """Collective. Raises the fault of the lowest rank with one on all ranks."""
    first = comm.allreduce(comm.size if fault == "" else comm.rank, MPI.MIN)
    if first < comm.size:
        raise _octetra.InputError(f"rank {first}: " + comm.bcast(fault, root=first))
