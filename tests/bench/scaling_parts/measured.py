"""Short runs of copper cubes on 1 to 8 ranks, each with frames and a checkpoint: what they take."""
import os
import pathlib
import re
import subprocess

from work_precision_parts.runs import Runner, build, parameter, section

EDGES = (27, 46, 67)  # points
RANKS = (1, 2, 4, 8)
STEPS, FRAMES = 20, 2
START = ("Mesh in", "Partition", "Families", "Critical time step")
REPEATS = 3  # where times count: the least of them
FIXED_DT = 8e-8  # s, stable; so that all make the same steps
SPACING = 1e-3   # m

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
    copper = section("copper", parameter("Material Model", "Elastic Plastic Correspondence"),
                     parameter("Density", 8960, "double"), parameter("Young's Modulus", 110e9, "double"),
                     parameter("Poisson's Ratio", 0.3, "double"), parameter("Yield Stress", 5e7, "double"))
    body = section("all", parameter("Block Names", "all"), parameter("Material", "copper"),
                   parameter("Horizon Factor", 1.75, "double"))
    swing = section("swing", parameter("Type", "Initial Velocity"), parameter("Node Set", "all"),
                    parameter("Coordinate", "z"), parameter("Value", f"20*sin({6.28 / (edge * SPACING)}*x)"))
    variables = ("Displacement", "Velocity", "Von_Mises_Stress", "Equivalent_Plastic_Strain")
    output = section("Output", parameter("Output Filename", "run.e"), parameter("Output Frequency", steps // (frames - 1), "int"),
                     section("Output Variables", *(parameter(name, "true", "bool") for name in variables)))
    return section("deck", section("Discretization", parameter("Type", "Exodus"), parameter("Input Mesh File", f"cube{edge}.g")),
                   section("Materials", copper), section("Blocks", body), section("Boundary Conditions", swing),
                   section("Solver", parameter("Final Time", steps * FIXED_DT, "double"),
                           section("Verlet", parameter("Fixed dt", FIXED_DT, "double"))),
                   output, section("Restart", parameter("Frequency", 10**6, "int")))


def recipe(edge):
    length = edge * SPACING
    return f"[body]\nname = all\nshape = box\nsize = {length} {length} {length}\nspacing = {SPACING}\n"


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
        Runner(root, bench.work).mesh(f"cube{edge}", recipe(edge))
    rows = []
    for edge in EDGES:
        for ranks in RANKS:
            rows.append(least([bench.run(edge, ranks) for _ in range(REPEATS if ranks <= os.cpu_count() else 1)]))
            print({name: value if value is None else float(f"{value:.4g}") for name, value in rows[-1].items()}, flush=True)
    return rows, bench.reductions_a_step()
