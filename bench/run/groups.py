"""All cases, by group."""

import adaptive
import file_tools
import files
import growth
import peers
import refinement
from measuring import Group

NAMES = ["refinement", "growth", "files", "peers"]  # in the order of the tables

ABOUT = {
    "refinement": "The engine alone, from when all ranks have their parts to when all are done.",
    "growth": "With cells: uniform refinement on one rank, without what a program does but once; "
              "in memory that the process has yet to get, which takes as long as the system "
              "takes to hand it out, and in memory that it has written to before. "
              "With ranks: one mesh, a tenth of its cells marked at random; more ranks than cores "
              "take turns, so seconds are those of the processor, waiting included.",
    "files": "Files in the page cache, and `octetra refine` from its start to its end.",
    "peers": "DOLFINx and PETSc as Debian has them, the same mesh and the same cells chosen. Timed "
             "from barrier to barrier, DOLFINx's edges included. Into memory that the process has "
             "yet to get, as above. Cases that take minutes are run once.",
}


def group(name, cases):
    return Group(name, ABOUT[name], cases)


def standard(with_peers):
    made = [
        group("refinement", [refinement.uniform(55), refinement.uniform_at_hand(55, 44, 800),
                             refinement.sphere(32),
                             refinement.around_a_point(88, 10, 1000), refinement.random_cells(25500)]),
        group("growth", [growth.with_cells((6, 12, 24, 44, 55, 85)),
                         growth.with_cells_at_hand((6, 12, 24, 44, 55, 85)),
                         growth.with_ranks(40, (1, 2, 4, 8, 16, 32))]),
        group("files", [files.tetgen(), files.program(55), files.in_a_corner(30, 4)]),
    ]
    if with_peers:
        made.append(group("peers", [peers.uniform(55), peers.sphere(32), peers.bare(55),
                                    peers.valid(32, 2), adaptive.run_in_dolfinx(8, 10),
                                    adaptive.hand_over_to_dolfinx(40),
                                    adaptive.beside_dmplex(8, 10, 60),
                                    file_tools.beside_others("two-material --edge 0.045")]))
    return made


def quick(with_peers):
    made = [
        group("refinement", [refinement.uniform(24), refinement.uniform_at_hand(24, 19, 100),
                             refinement.sphere(12),
                             refinement.around_a_point(24, 4, 200), refinement.random_cells(2000)]),
        group("growth", [growth.with_cells((6, 12, 24)), growth.with_cells_at_hand((6, 12, 24)),
                         growth.with_ranks(10, (1, 2, 4))]),
        group("files", [files.tetgen(), files.program(16), files.in_a_corner(10, 2)]),
    ]
    if with_peers:
        made.append(group("peers", [peers.uniform(12), peers.sphere(8), peers.bare(12),
                                    peers.valid(8, 2), adaptive.run_in_dolfinx(4, 3),
                                    adaptive.hand_over_to_dolfinx(6),
                                    adaptive.beside_dmplex(2, 2, 60),
                                    file_tools.beside_others("two-material")]))
    return made
