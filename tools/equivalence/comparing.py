"""Compares the files of two runs byte by byte."""

import hashlib
import os

BLOCK = 1 << 20


def first_difference(path_a, path_b):
    """The offset, from 0, of the first difference, or of the end of the shorter file; None if the
    files are equal."""
    offset = 0
    with open(path_a, "rb") as a, open(path_b, "rb") as b:
        while True:
            block_a, block_b = a.read(BLOCK), b.read(BLOCK)
            if block_a != block_b:
                same = [x == y for x, y in zip(block_a, block_b)]
                return offset + (same.index(False) if False in same else len(same))
            if not block_a:
                return None
            offset += len(block_a)


def differences(expected, found):
    """The differences between the files of two folders, one line for each file; [] if there are
    none."""
    names_expected, names_found = set(os.listdir(expected)), set(os.listdir(found))
    lines = [f"{name} is missing" for name in sorted(names_expected - names_found)]
    lines += [f"{name} is too many" for name in sorted(names_found - names_expected)]
    for name in sorted(names_expected & names_found):
        offset = first_difference(os.path.join(expected, name), os.path.join(found, name))
        if offset is not None:
            lines.append(f"{name} differs from byte {offset:,} on")
    return lines


def fingerprints(folder):
    """The size and SHA-256 of each file."""
    result = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), "rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
            result[name] = {"bytes": file.tell(), "sha256": digest}
    return result
