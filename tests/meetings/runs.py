"""Runs of the program, by processes that make one after the other (run_many.cpp), and what they leave."""
import csv
import os
import re
import selectors
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import netCDF4
import numpy as np

LIMIT = 300  # s, of a run: a hang is a failure, slowness is not
PATIENCE = 10  # s, with an equilibrium that is hard to find
VECTORS = ("Displacement", "Velocity", "Force")


@dataclass
class Result:
    status: object  # exit status, or "crash", "hang"
    log: str
    at: np.ndarray = None  # reference positions
    times: np.ndarray = None
    frames: list = field(default_factory=list)  # {field: array}
    history: dict = field(default_factory=dict)

    @property
    def error(self):
        """The error without what changes with numbers and names: "no equilibrium after t = # s"."""
        lines = [line for line in self.log.splitlines() if line.startswith(("strut: ", "  "))]
        start = next((i for i, line in enumerate(lines) if line.startswith("strut: ")), None)
        return "" if start is None else lines[start]

    @property
    def kind_of_error(self):
        return re.sub(r"[-+]?\d[\d.e+-]*", "#", self.error)[:60]

    @property
    def warnings(self):
        return [line for line in self.log.splitlines() if "WARNING" in line]

    @property
    def refused(self):
        """At the start: nothing was written."""
        return self.status == 1 and not self.frames


class Server:
    """Ranks that run what they are told, one after the other. Started anew after a crash."""

    def __init__(self, program, launcher=()):
        self.command, self.process = [*launcher, str(program)], None

    def start(self):
        environment = dict(os.environ, OMPI_MCA_mpi_yield_when_idle="1", OMP_WAIT_POLICY="passive")
        self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment, bufsize=0)

    def ask(self, words, limit=LIMIT):
        if self.process is None or self.process.poll() is not None:
            self.start()
        self.process.stdin.write((" ".join(map(str, words)) + "\n").encode())
        with selectors.DefaultSelector() as selector:
            selector.register(self.process.stdout, selectors.EVENT_READ)
            if not selector.select(limit):
                self.process.kill()
                self.process.wait()
                return "hang"
        answer = self.process.stdout.readline().strip()
        if not answer:
            self.process.wait()
            self.process = None
            return "crash"
        return int(answer)

    def close(self):
        if self.process and self.process.poll() is None:
            self.process.stdin.close()
            self.process.wait(timeout=20)


class Runner:
    def __init__(self, program, mpirun, folder):
        self.servers = {1: Server(program), 3: Server(program, [*mpirun, "-n", "3"])}
        self.folder, self.count = Path(folder), 0

    def run(self, written, *options, ranks=1, name="run", keep=False, limit=LIMIT):
        """Runs a written scene in a folder of its own; `keep`: keeps existing files, to continue the run."""
        folder = self.folder / name
        if not keep:
            shutil.rmtree(folder, ignore_errors=True)
        written.write(folder)
        self.count += 1
        status = self.servers[ranks].ask([folder, *options, "deck.xml"], limit)
        log = "".join(path.read_text(errors="replace") for path in sorted(folder.glob("log*")))
        return read(folder, status, log, written)

    def close(self):
        for server in self.servers.values():
            server.close()


def read(folder, status, log, written):
    result = Result(status, log)
    table = folder / "out.csv"
    if table.exists():
        rows = [row for row in csv.reader(open(table)) if row and not row[0].startswith("#")]
        if len(rows) > 1:
            values = np.array([[float(v) for v in row] for row in rows[1:]])
            result.history = {name.strip(): values[:, i] for i, name in enumerate(rows[0])}
    if (folder / "out.e").exists():
        read_frames(folder / "out.e", result, list(written.deck["Output"]["Output Variables"]))
    return result



def read_frames(path, result, wanted):
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        # Behind the zero that ends a name the Exodus library leaves what was in its memory.
        decoded = lambda name: [row.tobytes().split(b"\0")[0].decode() for row in file[name][:]] if name in file.variables else []
        nodal, element = decoded("name_nod_var"), decoded("name_elem_var")
        blocks = range(1, len(file.dimensions["num_el_blk"]) + 1)
        order = np.concatenate([file[f"connect{b}"][:].ravel() - 1 for b in blocks])  # the node of each element
        result.times = np.array(file["time_whole"][:])
        result.at = np.stack([file[f"coord{a}"][:] for a in "xyz"], axis=1)[order]

        def column(name, frame):
            if name in nodal:
                return file[f"vals_nod_var{nodal.index(name) + 1}"][frame][order]
            n = element.index(name) + 1
            return np.concatenate([file[f"vals_elem_var{n}eb{b}"][frame] for b in blocks])

        for frame in range(len(result.times)):
            fields = {}
            for name in wanted:
                if name in VECTORS:
                    fields[name] = np.stack([column(name + a, frame) for a in suffixes(nodal, name)], axis=1)
                elif name == "Cauchy_Stress":
                    fields[name] = np.stack([column(f"{name}_{a}" if f"{name}_XX" in element else name + a, frame) for a in ("XX", "YY", "ZZ", "XY", "YZ", "ZX")], axis=1)
                else:
                    fields[name] = column(name, frame)
            result.frames.append(fields)


def suffixes(names, name):
    return "XYZ" if name + "X" in names else ("_X", "_Y", "_Z")
