"""Checks the SHA-256 of the files of a list of refinements, coarsenings and checkpoints, which are
the same on every processor, operating system, compiler and MPI.

results_test.py PROGRAM RANKS             run the list, on RANKS ranks if that is not 0, and compare
results_test.py PROGRAM RANKS --record    run the list and write recorded.txt

Inputs are lattices and meshes of the corpus, because Delaunay meshes depend on the version of
TetGen. Formats are those written without a compressor or HDF5, whose output depends on the version.
"""

import hashlib
import pathlib
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
source = here.parent.parent
recorded = here / "recorded.txt"

SCRIPT = """\
refine --sphere 0.3,0.4,0.5,0.3 --levels 2
coarsen --outside --sphere 0.3,0.4,0.5,0.2
refine --random 0.03 --scheme 4t
rebalance
save middle.octetra
refine --box 0,0,0,0.4,0.3,0.2 --scheme 2t --levels 3
coarsen --random 0.5
"""

# Each command, with the files that it writes.
COMMANDS = [
    ("generate kuhn 5 -o kuhn.mesh", ["kuhn.mesh"]),
    ("generate bcc 3 -o bcc.ele", ["bcc.node", "bcc.ele"]),
    ("refine kuhn.mesh --all --levels 2 -o uniform.meshb", ["uniform.meshb"]),
    ("refine kuhn.mesh --sphere 0.3,0.4,0.5,0.2 --levels 5 -o sphere.msh --maps sphere.txt",
     ["sphere.msh", "sphere.txt"]),
    ("refine bcc.ele --random 0.05 --levels 3 --scheme 4t -o random.ele", ["random.node", "random.ele"]),
    ("refine bcc.ele --random 0.05 --seed 7 --levels 4 --scheme 2t -o random.mesh", ["random.mesh"]),
    ("refine {corpus}/gmsh-box-41b.msh --max-volume 0.002 --levels 6 -o volume.mesh", ["volume.mesh"]),
    ("refine {corpus}/far-from-the-origin.ele --all --levels 2 -o far.mesh", ["far.mesh"]),
    ("refine {corpus}/huge.ele --all --levels 3 -o huge.mesh", ["huge.mesh"]),
    ("refine {corpus}/attributes-and-markers.ele --all --levels 2 -o markers.ele",
     ["markers.node", "markers.ele", "markers.face", "markers.edge"]),
    ("refine {corpus}/crack.ele --all --levels 2 -o crack.octetra", ["crack.octetra"]),
    ("coarsen crack.octetra --all -o once.octetra", ["once.octetra"]),
    ("adapt kuhn.mesh --script script.txt -o end.octetra", ["middle.octetra", "end.octetra"]),
    ("convert end.octetra end.mesh", ["end.mesh"]),
]


def results(program, ranks):
    """Returns [(name, SHA-256), ...] of all files that the commands write."""
    launcher = [source / "tests/support/mpirun.sh", str(ranks)] if ranks else []
    found = []
    with tempfile.TemporaryDirectory(prefix="octetra-results-") as folder:
        folder = pathlib.Path(folder)
        (folder / "script.txt").write_text(SCRIPT)
        for command, files in COMMANDS:
            words = command.format(corpus=source / "corpus/meshes").split()
            in_parallel = launcher if words[0] in ("refine", "adapt", "coarsen") else []
            done = subprocess.run([*in_parallel, program, *words, "--quiet"], cwd=folder, capture_output=True,
                                  text=True, check=False)
            if done.returncode != 0:
                sys.exit(f"{command}: status {done.returncode}\n{done.stdout}{done.stderr}")
            found += [(name, hashlib.sha256((folder / name).read_bytes()).hexdigest()) for name in files]
    return found


def main():
    program, ranks = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2])
    lines = [f"{digest}  {name}" for name, digest in results(program, ranks)]
    if sys.argv[3:] == ["--record"]:
        recorded.write_text("\n".join(lines) + "\n")
        return
    expected = recorded.read_text().splitlines()
    differing = [line.split()[1] for line in lines if line not in expected]
    if differing or len(lines) != len(expected):
        sys.exit(f"{len(lines)} files where {len(expected)} are recorded; these differ: {', '.join(differing)}")
    print(f"{len(lines)} files as recorded")


main()
