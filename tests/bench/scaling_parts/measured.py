"""Short runs of copper cubes on 1 to 8 ranks, each with frames and a checkpoint: what they take."""
import os
import pathlib
import re
import subprocess

from work_precision_parts.runs import COPPER, Runner, build, cube, deck_of

EDGES = (27, 46, 67)  # points
RANKS = (1, 2, 4, 8)
STEPS, FRAMES = 20, 2
START = ("Mesh in", "Partition", "Families", "Critical time step")
REPEATS = 3  # where times count: the least of them
FIXED_DT = 8e-8  # s, stable; so that all make the same steps

# Each rank is a child of this, which tells the most memory that it had.
WRAPPER = """import os, subprocess, sys
child = subprocess.Popen(sys.argv[1:])
_, status, usage = os.wait4(child.pid, 0)
os.write(1, f"rank {os.environ['OMPI_COMM_WORLD_RANK']} peak {usage.ru_maxrss}\\n".encode())  # in one piece
sys.exit(os.waitstatus_to_exitcode(status))
"""

# Counts reductions over all ranks.
COUNTER = """#include <mpi.h>
#include <stdio.h>
static long reductions = 0;
int MPI_Allreduce(const void* in, void* out, int n, MPI_Datatype t, MPI_Op op, MPI_Comm c) {
  ++reductions;
  return PMPI_Allreduce(in, out, n, t, op, c);
}
int MPI_Finalize(void) {
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) printf("%ld reductions\\n", reductions), fflush(stdout);
  return PMPI_Finalize();
}
"""


def deck(edge, steps, frames):
    swing = f"20*sin({6.28 / (edge * 1e-3)}*x)"
    variables = ("Displacement", "Velocity", "Von_Mises_Stress", "Equivalent_Plastic_Strain")
    return deck_of({
        "Discretization": {"Type": "Exodus", "Input Mesh File": f"cube{edge}.g"}, "Materials": {"copper": COPPER},
        "Blocks": {"all": {"Block Names": "all", "Material": "copper", "Horizon Factor": 1.75}},
        "Boundary Conditions": {"swing": {"Type": "Initial Velocity", "Node Set": "all", "Coordinate": "z", "Value": swing}},
        "Solver": {"Final Time": steps * FIXED_DT, "Verlet": {"Fixed dt": FIXED_DT}},
        "Output": {"Output Filename": "run.e", "Output Frequency": steps // (frames - 1),
                   "Output Variables": dict.fromkeys(variables, "true")},
        "Restart": {"Frequency": 10**6}})


class Bench:
    def __init__(self, root):
        self.root, self.work = root, root / "build" / "scaling"
        self.work.mkdir(parents=True, exist_ok=True)
        os.environ |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        (self.work / "wrapper.py").write_text(WRAPPER)
        (self.work / "counter.c").write_text(COUNTER)
        subprocess.run(["mpicc", "-shared", "-fPIC", "-o", "counter.so", "counter.c"], cwd=self.work, check=True)

    def log(self, edge, ranks, steps, *options):
        (self.work / "run.xml").write_text(deck(edge, steps, FRAMES))
        for name in ("run.restart", "run.restart.old", "run.e"):
            (self.work / name).unlink(missing_ok=True)
        command = ["mpirun", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", *options, "-np", str(ranks),
                   "python3", "wrapper.py", self.root / "build/release/strut", "run.xml"]
        return subprocess.run(command, cwd=self.work, stdout=subprocess.PIPE, text=True, check=True).stdout

    def reductions_a_step(self):
        """By two runs of different length."""
        counts = [int(re.search(r"(\d+) reductions", self.log(EDGES[0], 2, steps, "-x", f"LD_PRELOAD={self.work}/counter.so")).group(1))
                  for steps in (STEPS, 3 * STEPS)]
        return (counts[1] - counts[0]) / (2 * STEPS)

    def run(self, edge, ranks):
        log = self.log(edge, ranks, STEPS)
        seconds = {name.strip(): float(longest) for name, longest in re.findall(r"^(\S.{25}) +[0-9.]+ +([0-9.]+) +[0-9.]+%", log, re.M)}
        peaks = {int(rank): 1024 * int(peak) for rank, peak in re.findall(r"rank (\d+) peak (\d+)", log)}
        ghosts = re.search(r"^ghosts .* (\d+)$", log, re.M)
        return {"points": edge**3, "ranks": ranks, "root": peaks[0], "others": max([peak for rank, peak in peaks.items() if rank > 0], default=None),
                "ghosts": int(ghosts.group(1)) if ghosts else 0,
                **{name: seconds[name] for name in START}, "frame": seconds["Output"] / FRAMES, "checkpoint": seconds["Checkpoint"],
                "frame bytes": 8 * edge**3 * 8, "checkpoint bytes": (self.work / "run.restart").stat().st_size}


def least(rows):
    """The least times of repeated runs."""
    return rows[0] | {name: min(row[name] for row in rows) for name in (*START, "frame", "checkpoint")}


def runs(root):
    build(root)
    bench = Bench(root)
    for edge in EDGES:
        Runner(root, bench.work).mesh(f"cube{edge}", cube(edge))
    rows = []
    for edge in EDGES:
        for ranks in RANKS:
            rows.append(least([bench.run(edge, ranks) for _ in range(REPEATS if ranks <= os.cpu_count() else 1)]))
            print({name: value if value is None else float(f"{value:.4g}") for name, value in rows[-1].items()}, flush=True)
    return rows, bench.reductions_a_step()
