"""Predicts refinement on a cluster by a model, from measurements of ranks on one machine.

usage: scaling measure [--build FOLDER] [--ranks N...]    into bench/scaling/measured.json
       scaling page                                      from it, docs/scaling.md and docs/scaling.svg

For each rank the processor seconds outside MPI, messages, bytes, and collective calls are measured,
with many ranks on few cores; the model adds the cost of a network.
"""
import argparse
import json
import mmap
import pathlib
import subprocess
import sys
import tempfile

from model import HIGH, LOW, Stage, strong_efficiency, weak_efficiency
from plot import efficiency_plot

ROOT = pathlib.Path(__file__).resolve().parents[2]
MEASURED = pathlib.Path(__file__).parent / "measured.json"
CASES = {"uniform": "all cells, one level",
         "sphere": "cells at a sphere's surface, two levels",
         "moving": "the same, then three times coarsened behind and refined ahead as it moves"}
MOST_MOVING = 64  # more take minutes: ranks wait for each other a thousand times, on few cores
STAGES = ("reading", "adapting", "writing")
ALONE = {9: 256, 14: 64, 22: 16, 35: 4}  # lattices about as large as a part on this number of ranks
FASTER = 3  # than the machine of the measurement
WEAK_CELLS, STRONG_CELLS = 1e6, 1e9
RANKS = [16, 64, 256, 1024, 4096, 16384]


def use_all_memory_once():
    """The first use of a page takes several times as long in a virtual machine."""
    with open("/proc/meminfo", encoding="ascii") as file:
        free = next(int(line.split()[1]) * 1024 for line in file if line.startswith("MemAvailable"))
    size = free * 8 // 10
    print(f"using {size / 1e9:.0f} GB of memory once, for a minute or so", file=sys.stderr)
    with mmap.mmap(-1, size) as memory:
        for page in range(0, size, mmap.PAGESIZE):
            memory[page] = 1


def measure(build, ranks):
    use_all_memory_once()
    program, octetra = build / "bench/bench_scaling", build / "cli/octetra"
    runs = []
    with tempfile.TemporaryDirectory() as folder:
        mesh, out = f"{folder}/in.meshb", f"{folder}/out.meshb"
        subprocess.run([octetra, "generate", "kuhn", "55", "-o", mesh, "--quiet"], check=True)
        for case in CASES:
            for n in ranks:
                if case == "moving" and n > MOST_MOVING:
                    continue
                done = subprocess.run([ROOT / "tests/support/mpirun.sh", str(n), program, mesh, case, out],
                                      check=True, stdout=subprocess.PIPE, text=True)
                runs.append(json.loads(done.stdout))
                print(case, n, "ranks", file=sys.stderr)
        for size in ALONE:
            subprocess.run([octetra, "generate", "kuhn", str(size), "-o", mesh, "--quiet"], check=True)
            done = subprocess.run([program, mesh, "uniform", out], check=True, stdout=subprocess.PIPE, text=True)
            runs.append(json.loads(done.stdout) | {"case": "alone"})
    MEASURED.write_text("[" + ",\n ".join(json.dumps(most_of(run)) for run in runs) + "]\n")


def most_of(run):
    """The maximum over the ranks of each quantity, because all wait for the slowest."""
    short = {key: run[key] for key in ("case", "ranks", "cells_read", "cells", "most_cells")}
    short["peak_memory_bytes"] = max(run["peak_memory_bytes"])
    for stage in STAGES:
        short[stage] = {key: max(value) if isinstance(value, list) else value
                        for key, value in run[stage].items()}
    return short


def percent(low, high):
    return f"{round(100 * low)} to {round(100 * high)} %" if round(100 * low) != round(100 * high) \
        else f"{round(100 * low)} %"


def efficiency_table(stage_of, efficiency, name):
    rows = ["| | " + " | ".join(f"{n:,}" for n in RANKS) + " |", "|---|" + "---:|" * len(RANKS)]
    for case in CASES:
        cells = [percent(efficiency(stage_of(case), n, HIGH), efficiency(stage_of(case), n, LOW)) for n in RANKS]
        rows.append(f"| {name}{case} | " + " | ".join(cells) + " |")
    return "\n".join(rows)


def measured_table(runs):
    rows = ["| case | ranks | cells of a rank, most | outside MPI, ms | messages | kB sent | calls of all | "
            "reading: ms, messages | writing: ms, messages | memory, MB |", "|---|" + "---:|" * 9]
    for run in runs:
        if run["case"] == "alone":
            continue
        adapting = run["adapting"]
        other = [f"{1000 * run[s]['computing_seconds']:.0f}, {run[s]['messages']:,}" for s in ("reading", "writing")]
        rows.append(f"| {run['case']} | {run['ranks']} | {run['most_cells']:,} | "
                    f"{1000 * adapting['computing_seconds']:.0f} | {adapting['messages']:,} | "
                    f"{adapting['bytes'] / 1000:,.0f} | {adapting['collectives']:,} | {other[0]} | {other[1]} | "
                    f"{run['peak_memory_bytes'] / 1e6:.0f} |")
    return "\n".join(rows)


def alone_table(runs):
    rows = ["| cells | alone, ms | cells of a rank, most | ranks | on so many, ms |", "|---:|---:|---:|---:|---:|"]
    by_ranks = {run["ranks"]: run for run in runs if run["case"] == "uniform"}
    for part, ranks in zip((run for run in runs if run["case"] == "alone"), ALONE.values()):
        many = by_ranks[ranks]
        rows.append(f"| {part['cells']:,} | {1000 * part['adapting']['computing_seconds']:.1f} | "
                    f"{many['most_cells']:,} | {ranks} | {1000 * many['adapting']['computing_seconds']:.1f} |")
    return "\n".join(rows)


def check_table(runs):
    rows = ["| case | ranks | measured, ms | model, ms |", "|---|---:|---:|---:|"]
    for run in runs:
        if run["ranks"] <= 2 and run["case"] != "alone":
            rows.append(f"| {run['case']} | {run['ranks']} | {1000 * run['adapting']['wall_seconds']:.0f} | "
                        f"{1000 * run['adapting']['computing_seconds']:.0f} |")
    return "\n".join(rows)


def page():
    runs = json.loads(MEASURED.read_text())

    def stage_of(case, stage="adapting"):
        alone = [run for run in runs if run["case"] == "alone"] if (case, stage) == ("uniform", "adapting") else []
        return Stage([run for run in runs if run["case"] == case], stage, alone)

    def weak(stage, n, network):
        return weak_efficiency(stage, WEAK_CELLS, n, network)

    def weak_faster(stage, n, network):
        return weak_efficiency(stage, WEAK_CELLS, n, network, FASTER)

    def strong(stage, n, network):
        return strong_efficiency(stage, STRONG_CELLS, n, network)

    text = (pathlib.Path(__file__).parent / "page.md").read_text()
    for word, table in {
            "@weak@": efficiency_table(stage_of, weak, ""),
            "@faster@": efficiency_table(stage_of, weak_faster, ""),
            "@alone@": alone_table(runs),
            "@strong@": efficiency_table(stage_of, strong, ""),
            "@files@": "\n".join(
                efficiency_table(lambda case, s=s: stage_of("uniform", s), weak, f"{s} ").split("\n")[2]
                .replace(" uniform", "") for s in ("reading", "writing")),
            "@heads@": "\n".join(efficiency_table(stage_of, weak, "").split("\n")[:2]),
            "@check@": check_table(runs), "@measured@": measured_table(runs)}.items():
        text = text.replace(word, table)
    (ROOT / "docs/scaling.md").write_text(text)
    (ROOT / "docs/scaling.svg").write_text(efficiency_plot(
        [("weak: a million cells a rank", weak), ("strong: a thousand million cells", strong)],
        {case: stage_of(case) for case in CASES}, (LOW, HIGH)))


def main():
    parser = argparse.ArgumentParser(prog="scaling", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["measure", "page"])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4, 8, 16, 64, 256])
    chosen = parser.parse_args()
    if chosen.what == "measure":
        measure(chosen.build, chosen.ranks)
    page()


main()
