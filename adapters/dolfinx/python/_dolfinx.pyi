# Types of the compiled part of octetra.dolfinx.
from typing import Any, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

from . import Mesh

_Tags = Optional[Tuple[NDArray[np.int32], NDArray[np.int32]]]
_Tagged = Optional[Tuple[int, NDArray[np.int32], NDArray[np.int32]]]
_Numbers = NDArray[np.int32]

def to_mesh(mesh: Mesh, ghosts: Optional[str],
            tags: bool) -> Tuple[Any, _Tags, _Tags, _Numbers, _Numbers]: ...
def from_mesh(mesh: Any, cell_tags: _Tagged,
              facet_tags: _Tagged) -> Tuple[Mesh, _Numbers, _Numbers]: ...
