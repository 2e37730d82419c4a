"""The same steps as steps.cpp through Python: steps.py MESH uniform|medium|small STEPS [look]

With `look`, the program holds the arrays of the mesh during each step.
"""

import sys
import time

import numpy as np
from mpi4py import MPI

import octetra

mesh = octetra.read(sys.argv[1])
look = len(sys.argv) > 4
for _ in range(int(sys.argv[3])):
    points, cells = mesh.points, mesh.cells
    marks = np.full(len(cells), sys.argv[2] == "uniform")
    marks[7:1007 if sys.argv[2] == "medium" else 8] = True
    if not look:
        del points, cells
    marked = np.count_nonzero(marks)
    MPI.COMM_WORLD.Barrier()
    begin = time.perf_counter()
    mesh.refine(marks)
    seconds = time.perf_counter() - begin
    if mesh.rank == 0:
        print(f"{seconds:.9f} {marked}")
