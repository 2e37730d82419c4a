from typing import Any, Tuple

from numpy.typing import NDArray

from . import Mesh

def to_plex(mesh: Mesh, comm_address: int, cells: str, faces: str, edges: str,
            boundary: str) -> Any: ...
def from_plex(plex: Any, cells: str, faces: str, edges: str) -> Tuple[Mesh, NDArray[Any], NDArray[Any]]: ...
