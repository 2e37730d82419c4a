"""Marks of cells to refine or coarsen: arrays of booleans, one for each cell of this rank."""

from ._octetra.mark import (
    box as box,
    doerfler as doerfler,
    fraction as fraction,
    larger_than as larger_than,
    maximum as maximum,
    random as random,
    region as region,
    size as size,
    sphere as sphere,
    where as where,
)
