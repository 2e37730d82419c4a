"""An adaptive run in DOLFINx, refined by DOLFINx or by Octetra: adaptive_run.py octetra|dolfinx
[--steps N] [--seconds S] [--json], under mpirun for several ranks.

Each step solves Poisson's equation, marks cells, and refines the mesh. Cells around a line are
marked, closer to it at each step, so that both programs make the same numbers of cells. The mesh
part is DOLFINx's creation of edges and refine(), with redistribution on several ranks; or Octetra's
refine(), refine_evenly() on several ranks, and to_mesh() with ghosts. No further step begins once
the mesh part has taken S seconds. Seconds are from barrier to barrier.
"""

import argparse
import json
import resource

import dolfinx.fem.petsc
import dolfinx.mesh
import numpy as np
import ufl
from lattice import IS_0_5, VERSION, created, lattice, say, seconds, world
from mpi4py import MPI

import octetra.dolfinx
from octetra.dolfinx._versions import linear_space, nodes_of_cells


def around_a_line(points, cells, step):
    middles = points[cells].mean(axis=1)
    return np.linalg.norm(middles[:, :2] - [0.4, 0.5], axis=1) < 0.3 * 0.5**step


class ByDolfinx:
    def __init__(self, mesh):
        self.domain = created(mesh)()

    def marks(self, step):
        own = self.domain.topology.index_map(3).size_local
        return around_a_line(self.domain.geometry.x, nodes_of_cells(self.domain)[:own], step)

    def refine(self, marks):
        """Returns the seconds of refinement and of making a DOLFINx mesh; here the latter is part
        of the former."""
        def work():
            topology = self.domain.topology
            topology.create_entities(1)
            if not IS_0_5:
                topology.create_connectivity(3, 1)
            cells = np.flatnonzero(marks).astype(np.int32)
            edges = dolfinx.mesh.compute_incident_entities(self.domain if IS_0_5 else topology, cells, 3, 1)
            if IS_0_5:
                return dolfinx.mesh.refine(self.domain, edges, redistribute=world.size > 1)
            return dolfinx.mesh.refine(self.domain, edges)[0]  # redistributes

        spent, self.domain = seconds(work)
        return spent, 0.0


class ByOctetra:
    def __init__(self, mesh):
        self.mesh = mesh
        self.domain = octetra.dolfinx.to_mesh(mesh).mesh

    def marks(self, step):
        return around_a_line(self.mesh.points, self.mesh.cells, step)

    def refine(self, marks):
        refine = self.mesh.refine if world.size == 1 else self.mesh.refine_evenly
        refined, _ = seconds(lambda: refine(marks))
        handed, self.domain = seconds(lambda: octetra.dolfinx.to_mesh(self.mesh).mesh)
        return refined, handed


def solve(domain):
    """Solves -div grad u = 1 with u = 0 on the boundary, by linear elements."""
    space = linear_space(domain, None)
    on_boundary = dolfinx.fem.locate_dofs_geometrical(
        space, lambda x: np.isclose(x, 0).any(axis=0) | np.isclose(x, 1).any(axis=0))
    fixed = dolfinx.fem.dirichletbc(dolfinx.fem.Constant(domain, 0.0), on_boundary, space)
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    one = dolfinx.fem.Constant(domain, 1.0)
    options = {"ksp_type": "cg", "pc_type": "jacobi", "ksp_rtol": 1e-5}
    prefix = {"petsc_options_prefix": "adaptive_run_"} if VERSION >= (0, 10) else {}
    return dolfinx.fem.petsc.LinearProblem(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, one * v * ufl.dx, bcs=[fixed],
                                           petsc_options=options, **prefix).solve()


def run(refined, steps, patience):
    solve(refined.domain)  # compiles the forms
    levels, spent = [], 0.0
    for step in range(1, steps + 1):
        solving, _ = seconds(lambda: solve(refined.domain))
        marking, marks = seconds(lambda: refined.marks(step))
        refining, handing = refined.refine(marks)
        spent = world.allreduce(spent + refining + handing, MPI.MAX)
        levels.append({"cells": refined.domain.topology.index_map(3).size_global, "seconds": refining + handing,
                       "refine_seconds": refining, "hand_over_seconds": handing, "other_seconds": solving + marking})
        if spent > patience:
            break
    return levels


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("by", choices=("octetra", "dolfinx"))
    parser.add_argument("--cubes", type=int, default=8)
    parser.add_argument("--steps", type=int, default=10)
    parser.add_argument("--seconds", type=float, default=120)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    mesh = lattice(options.cubes)
    levels = run(ByOctetra(mesh) if options.by == "octetra" else ByDolfinx(mesh), options.steps, options.seconds)
    peak = world.allreduce(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024, MPI.MAX)
    if options.json:
        say(json.dumps({"program": options.by, "ranks": world.size, "levels": levels, "peak_bytes": peak}))
        return
    say("| step | cells | refine, s | hand over, s | solve and mark, s |\n|---|---|---|---|---|")
    for step, of in enumerate(levels, 1):
        say(f"| {step} | {of['cells']:,} | {of['refine_seconds']:.4f} | {of['hand_over_seconds']:.4f} "
            f"| {of['other_seconds']:.3f} |")
    sums = [sum(of[key] for of in levels) for key in ("refine_seconds", "hand_over_seconds", "other_seconds")]
    say(f"| all | | {sums[0]:.3f} | {sums[1]:.3f} | {sums[2]:.2f} |")


main()
