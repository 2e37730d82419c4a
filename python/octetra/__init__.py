"""Octetra: refinement of tetrahedral meshes on the ranks of an MPI communicator.

    import octetra

    mesh = octetra.read("cube.mesh")
    step = mesh.refine(octetra.mark.sphere(mesh, (0, 0, 0), 0.3))
    mesh.save("state.octetra")

MPI is that of mpi4py if it is installed. `python3 -m octetra` runs the command line.
"""

from . import mark as mark
from . import quality as quality
from ._octetra import (
    Adaptation as Adaptation,
    Background as Background,
    Edges as Edges,
    Error as Error,
    Fit as Fit,
    Faces as Faces,
    Ghosts as Ghosts,
    IndexMap as IndexMap,
    InputError as InputError,
    Level as Level,
    Mesh as Mesh,
    MeshSeries as MeshSeries,
    Migration as Migration,
    ShapeCertificate as ShapeCertificate,
    Sharing as Sharing,
    EntityTransfer as EntityTransfer,
    SystemFailure as SystemFailure,
    Verdict as Verdict,
    __version__ as __version__,
    cell_edges as cell_edges,
    cell_faces as cell_faces,
    from_arrays as from_arrays,
    load as load,
    load_with_fields as load_with_fields,
    orientations as orientations,
    read as read,
    saved_state as saved_state,
)
