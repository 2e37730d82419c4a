"""Compares the program's .meshb files with an independent reader and writer of the format.

usage: read_meshb_test.py OCTETRA
"""
import struct
import sys
import unittest

from program_case import ProgramCase

# Code of the keyword; its name in text files, and the number of vertex numbers or coordinates of an
# entry.
SECTIONS = {4: ("Vertices", 3), 8: ("Tetrahedra", 4), 6: ("Triangles", 3), 5: ("Edges", 2)}


def types_of(version):
    """The format characters of struct for positions, integers and reals."""
    return ("i" if version < 3 else "q", "i" if version < 4 else "q", "f" if version < 2 else "d")


def read_binary(data):
    """Returns {name: rows} and the version."""
    order = "<" if data[:4] == b"\1\0\0\0" else ">"
    one, version = struct.unpack_from(order + "ii", data)
    assert one == 1
    position, integer, real = types_of(version)
    sections, at = {}, 8
    while True:
        code, following = struct.unpack_from(order + "i" + position, data, at)
        body = at + struct.calcsize("=i" + position)
        if code == 54:
            assert following == 0 and body == len(data)
            return sections, version
        if code == 3:
            (dimension,) = struct.unpack_from(order + "i", data, body)
            assert dimension == 3 and following == body + 4
        else:
            name, columns = SECTIONS[code]
            (count,) = struct.unpack_from(order + integer, data, body)
            row = struct.Struct(order + (real if code == 4 else integer) * columns + integer)
            body += struct.calcsize("=" + integer)
            assert following == body + count * row.size
            sections[name] = list(row.iter_unpack(data[body:following]))
        at = following


def written(sections, version, order):
    position, integer, real = types_of(version)
    data = bytearray(struct.pack(order + "ii", 1, version))

    def put(code, body):
        following = len(data) + struct.calcsize("=i" + position) + len(body)
        data.extend(struct.pack(order + "i" + position, code, following if body else 0) + body)

    put(3, struct.pack(order + "i", 3))
    for code, (name, columns) in SECTIONS.items():
        row = struct.Struct(order + (real if code == 4 else integer) * columns + integer)
        rows = sections.get(name, [])
        put(code, struct.pack(order + integer, len(rows)) + b"".join(row.pack(*r) for r in rows))
    put(54, b"")
    return bytes(data)


def read_text(path):
    words = path.read_text().split()
    sections = {}
    for name, columns in SECTIONS.values():
        if name not in words:
            continue
        at = words.index(name) + 1
        kind = float if name == "Vertices" else int
        rows = words[at + 1:at + 1 + int(words[at]) * (columns + 1)]
        sections[name] = [tuple(kind(w) for w in rows[k:k + columns]) + (int(rows[k + columns]),)
                          for k in range(0, len(rows), columns + 1)]
    return sections


class Meshb(ProgramCase):
    def test_written_has_the_contents_of_the_text_format(self):
        for shape in (["gear"], ["two-material"], ["kuhn", "3"]):
            self.run_octetra("generate", *shape, "-o", "a.mesh")
            self.run_octetra("convert", "a.mesh", "a.meshb")
            sections, version = read_binary((self.path / "a.meshb").read_bytes())
            self.assertEqual(sections, read_text(self.path / "a.mesh"))
            self.assertEqual(version, 2)

    def test_of_every_version_and_byte_order_is_read(self):
        self.run_octetra("generate", "gear", "-o", "a.mesh")
        sections = read_text(self.path / "a.mesh")
        # Rounded to 32 bits, so that version 1 has the same values.
        sections["Vertices"] = [tuple(struct.unpack("f", struct.pack("f", x))[0] for x in row[:3]) + row[3:]
                                for row in sections["Vertices"]]
        for version in (1, 2, 3, 4):
            for order in "<>":
                (self.path / "b.meshb").write_bytes(written(sections, version, order))
                self.run_octetra("convert", "b.meshb", "b.mesh")
                self.assertEqual(read_text(self.path / "b.mesh"), sections, (version, order))


unittest.main(argv=sys.argv[:1])
