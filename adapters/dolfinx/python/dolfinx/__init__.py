"""Conversions between meshes of Octetra and DOLFINx.

    mesh, _ = octetra.dolfinx.from_mesh(domain)          # once
    now = octetra.dolfinx.to_mesh(mesh)                  # now.mesh is a dolfinx.mesh.Mesh
    step = mesh.refine(marks)                            # one for each cell of now.mesh
    finer = octetra.dolfinx.to_mesh(mesh)
    u = octetra.dolfinx.carry(u, step, now, finer)

Every rank converts its own part. Functions are collective if their docstring says so.

DOLFINx 0.9 to 0.11 is used from Python alone. DOLFINx 0.5 requires the compiled part octetra._dolfinx, which exists
if Octetra was built with that version.
"""

from ._versions import check_version

check_version()

from ._functions import carry, function, parents, vertex_values  # noqa: E402
from ._handover import NONE, Handover, from_mesh, to_mesh  # noqa: E402
from ._levels import interpolations  # noqa: E402

__all__ = ["NONE", "Handover", "carry", "from_mesh", "function", "interpolations", "parents", "to_mesh", "vertex_values"]
