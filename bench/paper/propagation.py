"""Closure of marked cells by sweeps, computed independently of octetra for comparison.

In a sweep every face with a newly marked edge marks its longest edge; sweeps are repeated until one
marks nothing. Edges are compared in octetra's order (docs/algorithm.md).
"""
import itertools


def read_medit(path):
    """Returns points and cells of a Medit file; cells are sorted tuples of indices."""
    with open(path, encoding="ascii") as file:
        words = iter(file.read().split())
    points, cells = [], []
    for word in words:
        if word == "Vertices":
            for _ in range(int(next(words))):
                points.append((float(next(words)), float(next(words)), float(next(words))))
                next(words)
        elif word == "Tetrahedra":
            for _ in range(int(next(words))):
                cells.append(tuple(sorted(int(next(words)) - 1 for _ in range(4))))
                next(words)
    return points, cells


def squared_length(a, b):
    x, y, z = a[0] - b[0], a[1] - b[1], a[2] - b[2]
    return (x * x + y * y) + z * z


class Edges:
    """The edges of a mesh, numbered from the shortest to the longest."""

    def __init__(self, points, cells):
        def order(edge):
            ends = sorted((points[edge[0]], points[edge[1]]))
            return squared_length(*ends), ends
        ends = {edge for cell in cells for edge in itertools.combinations(cell, 2)}
        self.number = {edge: n for n, edge in enumerate(sorted(ends, key=order))}
        self.of_cells = [tuple(self.number[edge] for edge in itertools.combinations(cell, 2)) for cell in cells]
        self.longest_at_edges = [set() for _ in self.number]  # for each edge, in its faces
        faces = {face for cell in cells for face in itertools.combinations(cell, 3)}
        for face in faces:
            of_face = sorted(self.number[edge] for edge in itertools.combinations(face, 2))
            for edge in of_face[:2]:
                self.longest_at_edges[edge].add(of_face[2])


def closure(edges, marked):
    """Returns all marked edges, and the number of sweeps that marked any."""
    new, sweeps = set(marked), 0
    closed = set(new)
    while new := {e for edge in new for e in edges.longest_at_edges[edge]} - closed:
        closed |= new
        sweeps += 1
    return closed, sweeps


def predicted(points, cells, chosen):
    """Returns the number of cells of a level with all six edges of the chosen cells marked, by the
    law of counts: a cell is cut into one more than its marked edges, and one more again if its
    longest edge and the opposite one are marked."""
    edges = Edges(points, cells)
    marked = {edge for c in chosen for edge in edges.of_cells[c]}
    closed, sweeps = closure(edges, marked)
    made, cut = len(cells), 0
    for of_cell in edges.of_cells:
        flags = [edge in closed for edge in of_cell]
        longest = max(range(6), key=of_cell.__getitem__)
        made += sum(flags) + (flags[longest] and flags[5 - longest])
        cut += any(flags)
    return {"sweeps": sweeps, "edges_marked": len(marked), "edges_closed": len(closed), "cells_cut": cut,
            "cells": made, "vertices": len(points) + len(closed)}
