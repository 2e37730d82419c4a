#!/usr/bin/env python3
"""Reads a checkpoint of Octetra: the present mesh and its fields. The format is defined in
docs/formats.md.

Example: tools/read_checkpoint.py state.octetra As a module: points, cells, on_vertices, on_cells =
read_checkpoint.read("state.octetra")

Hashes are not checked, because numpy has no XXH3: `octetra info state.octetra` checks them.
Coordinates may have any scale, but not two scales that differ by a factor of 1e150.
"""
import math
import struct
import sys

import numpy

MAGIC = b"\x89OCT\r\n\x1a\n"
BLOCK = 4096
EDGES = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
FIELD_TYPES = ["<f8", "<f4", "<i4", "<i8"]


class File:
    def __init__(self, path):
        with open(path, "rb") as file:
            self.bytes = file.read()
        if len(self.bytes) < 48:
            raise ValueError(f"{path}: not a checkpoint, or truncated")
        magic, version, order = struct.unpack_from("<8sII", self.bytes)
        begin, size, _, end_magic = struct.unpack("<QQQ8s", self.bytes[-32:])
        if (magic, version, order, end_magic) != (MAGIC, 1, 0x01020304, MAGIC):
            raise ValueError(f"{path}: not a checkpoint of version 1, or truncated")
        self.table, self.next = memoryview(self.bytes)[begin:begin + size], 0
        self.counts = self.numbers(9)
        self.steps = [self.numbers(3) for _ in range(self.numbers(1)[0])]
        self.fields = [self.field() for _ in range(self.numbers(1)[0])]
        self.group_names = [self.group_name() for _ in range(self.numbers(1)[0] if self.counts[8] & 16 else 0)]
        self.features = self.numbers(6) if self.counts[8] & 32 else []
        self.state = self.saved_state() if self.counts[8] & 64 else None
        self.block_begin = 16

    def numbers(self, count):
        values = struct.unpack_from(f"<{count}Q", self.table, self.next)
        self.next += 8 * count
        return list(values)

    def field(self):
        on, kind, components, length = self.numbers(4)
        name = self.text(length)
        return name, on, FIELD_TYPES[kind], components

    def group_name(self):
        """Returns the dimension, tag and name of a physical group."""
        dimension, tag, length = self.numbers(3)
        return dimension, tag - (tag >> 63 << 64), self.text(length)

    def saved_state(self):
        """Returns the time, the step and the text of the program."""
        time, step, length = struct.unpack_from("<dqQ", self.table, self.next)
        self.next += 24
        return time, step, self.text(length)

    def text(self, length):
        self.next += length
        return bytes(self.table[self.next - length:self.next]).decode()

    def blocks(self, entities):
        for _ in range(-(-entities // BLOCK)):
            size, _ = self.numbers(2)
            self.block_begin += size
            yield self.bytes[self.block_begin - size:self.block_begin]

    def section(self, entities, kind, width):
        return numpy.frombuffer(b"".join(self.blocks(entities)), kind).reshape(-1, width)


def number(data, at):
    value = shift = 0
    while True:
        value |= (data[at] & 127) << shift
        shift, at = shift + 7, at + 1
        if data[at - 1] < 128:
            return value, at


def cuts_of(block, step_count):
    """For each step the runs of a block: pairs of a pattern and a number of cells; empty if there
    are none."""
    steps, at = [], 0
    for _ in range(step_count):
        size, at = number(block, at)
        end, runs = at + size, []
        while at < end:
            cut, count, at = block[at] & 127, 1, at + 1
            if block[at - 1] >= 128:
                count, at = number(block, at)
                count += 2
            runs.append((cut, count))
        steps.append(runs)
    return steps


def longest_first(points, cell, cut, scale):
    def key(edge):
        a, b = sorted(tuple(points[cell[i]]) for i in EDGES[edge])
        x, y, z = ((p - q) * scale for p, q in zip(a, b))
        return (x * x + y * y) + z * z, a, b  # each product and sum is rounded separately
    return sorted((e for e in range(6) if cut >> e & 1), key=key, reverse=True)


def divide(points, cells, cuts):
    """Applies one step: a set of bisected edges, as bits, for each cell."""
    edges = sorted({tuple(sorted((cell[EDGES[e][0]], cell[EDGES[e][1]])))
                    for cell, cut in zip(cells, cuts) for e in range(6) if cut >> e & 1})
    midpoint = {edge: len(points) + k for k, edge in enumerate(edges)}
    finer = []
    # A power of two for which no square overflows or underflows.
    largest = max((abs(c) for point in points for c in point), default=0)
    scale = 2.0 ** -max(min(math.frexp(largest)[1], 1000), -1000)
    for cell, cut in zip(cells, cuts):
        pieces = [cell]
        for e in longest_first(points, cell, cut, scale):
            (i, j), halves = EDGES[e], []
            middle = midpoint[tuple(sorted((cell[i], cell[j])))]
            for piece in pieces:
                if piece[i] != cell[i] or piece[j] != cell[j]:
                    halves.append(piece)
                    continue
                halves.append(tuple(middle if k == j else v for k, v in enumerate(piece)))
                halves.append(tuple(middle if k == i else v for k, v in enumerate(piece)))
            pieces = halves
        finer += pieces
    return points + [tuple((p + q) / 2 for p, q in zip(points[a], points[b])) for a, b in edges], finer


def read(path):
    """Returns points (n x 3), cells (m x 4), and the fields by name, on vertices and on cells."""
    file = File(path)
    vertices, cell_count, facets, edges, vertices_now, cells_now, attributes, _, flags = file.counts
    kind = "<u4" if vertices <= 1 << 32 else "<u8"
    points = [tuple(p) for p in file.section(vertices, "<f8", 3).tolist()]
    file.section(vertices if flags & 1 else 0, "<i4", 1)
    file.section(vertices if attributes else 0, "<f8", max(attributes, 1))
    cells = [tuple(c) for c in file.section(cell_count, kind, 4).tolist()]
    file.section(cell_count if flags & 2 else 0, "<i4", 1)
    for entities, flag, width in ((facets, 4, 3), (edges, 8, 2)):
        file.section(entities, kind, width)
        file.section(entities if flags & flag else 0, "<i4", 1)
    for count in file.features:
        file.section(count, "<u8", 1)
    blocks = [cuts_of(b, len(file.steps)) for b in file.blocks(cell_count if file.steps else 0)]
    counts = [min(BLOCK, cell_count - k * BLOCK) for k in range(len(blocks))]
    for step in range(len(file.steps)):
        cuts = []
        for k, block in enumerate(blocks):
            runs = block[step] or [(0, counts[k])]
            of_block = [cut for cut, count in runs for _ in range(count)]
            counts[k] = sum(1 + bin(cut & 63).count("1") + (cut >> 6) for cut in of_block)
            cuts += of_block
        points, cells = divide(points, cells, cuts)
    if (len(points), len(cells)) != (vertices_now, cells_now):
        raise ValueError(f"{path}: its steps produce a mesh of another size than its table states")
    fields = {}, {}  # a name may occur in both
    for name, on, kind, width in file.fields:
        fields[on][name] = file.section((vertices_now, cells_now)[on], kind, width)
    return numpy.array(points), numpy.array(cells), *fields


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    try:
        found = read(sys.argv[1])
    except (OSError, ValueError) as error:
        sys.exit(f"read_checkpoint: {error}")
    names = [f"{name} on {on}" for on, fields in zip(("vertices", "cells"), found[2:]) for name in fields]
    print(f"{len(found[0])} vertices, {len(found[1])} cells, fields: {', '.join(names) or 'none'}")
