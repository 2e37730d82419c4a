"""Are the files that two runs wrote the same, byte by byte?"""

import hashlib
import os

BLOCK = 1 << 20


def first_difference(path_a, path_b):
    """The offset, from 0, of the first byte that differs, or where one file ends and the other does
    not; None if the files are the same."""
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
    """What differs between the files of two folders, a line for each that does; [] if nothing."""
    names_expected, names_found = set(os.listdir(expected)), set(os.listdir(found))
    lines = [f"{name} is missing" for name in sorted(names_expected - names_found)]
    lines += [f"{name} is too many" for name in sorted(names_found - names_expected)]
    for name in sorted(names_expected & names_found):
        offset = first_difference(os.path.join(expected, name), os.path.join(found, name))
        if offset is not None:
            lines.append(f"{name} differs from byte {offset:,} on")
    return lines


def fingerprints(folder):
    """Of each file its size and SHA-256."""
    result = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), "rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
            result[name] = {"bytes": file.tell(), "sha256": digest}
    return result
