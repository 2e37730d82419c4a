"""Measures of the shape of cells."""

from ._octetra.quality import (
    dihedral_angles as dihedral_angles,
    mean_ratio as mean_ratio,
    statistics as statistics,
    volume as volume,
)
