"""A mesh of tetrahedra (quadratic, or of four nodes) between clamped ends, by CalculiX."""
import pathlib
import re
import subprocess
import tempfile

import numpy

MM = 1e3  # CalculiX has no units: mm, N and N/mm² leave no very small numbers in its files


def node_set(name, chosen):
    return [f"*NSET, NSET={name}", ",\n".join(str(k + 1) for k in numpy.flatnonzero(chosen))]


def body(nodes, tets):
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{k + 1}, {x[0]:.12g}, {x[1]:.12g}, {x[2]:.12g}" for k, x in enumerate(nodes * MM)]
    lines += [f"*ELEMENT, TYPE=C3D{tets.shape[1]}, ELSET=FOAM"]
    return lines + [", ".join(map(str, (k + 1, *t))) for k, t in enumerate(tets + 1)]


def metal(young, poisson):
    return ["*MATERIAL, NAME=METAL", "*ELASTIC", f"{young * 1e-6:.12g}, {poisson:.12g}"]


def boundary(motions):
    """Nodes (a mask), direction and displacement of each motion; of contradicting ones the last one holds."""
    placed = {(node + 1, axis): value for chosen, axis, value in motions for node in numpy.flatnonzero(chosen)}
    return ["*BOUNDARY", *[f"{node}, {axis}, {axis}, {value:.12g}" for (node, axis), value in placed.items()]]


def deck(nodes, tets, height, young, poisson, solver):
    return "\n".join([
        *body(nodes, tets), *node_set("FOOT", nodes[:, 2] < 1e-9 * height),
        *node_set("TOP", nodes[:, 2] > (1 - 1e-9) * height), *metal(young, poisson),
        "*SOLID SECTION, ELSET=FOAM, MATERIAL=METAL", "*STEP", f"*STATIC, SOLVER={solver}", "*BOUNDARY",
        "FOOT, 1, 3, 0", "TOP, 1, 2, 0", "TOP, 3, 3, 1e-3", "*NODE PRINT, NSET=TOP, TOTALS=ONLY", "RF", "*END STEP",
        ""])


NUMBER = r"(-?\d\.\d+E[+-]\d+)"
THREE = rf"^\s*{NUMBER}\s+{NUMBER}\s+{NUMBER}\s*$"


def printed(deck):
    """Runs a deck; what it prints on sets of nodes."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "deck.inp").write_text(deck)
        done = subprocess.run(["ccx", "deck"], cwd=folder, capture_output=True, text=True)
        results = pathlib.Path(folder) / "deck.dat"
        if done.returncode != 0 or not results.exists():
            raise SystemExit(done.stdout[-2000:] + done.stderr[-2000:])
        return results.read_text()


def reactions(deck):
    """The sums of forces, one row for each time and set."""
    return [[float(force) for force in row] for row in re.findall(THREE, printed(deck), re.M)]


def timed_reactions(deck):
    """The same of one set, behind the time."""
    rows = re.findall(rf"and time\s+(\S+)\s*$\s*{THREE}", printed(deck), re.M)
    return [[float(word) for word in row] for row in rows]


def stiffness(nodes, tets, height, young, poisson, solver="SPOOLES"):
    """N/m."""
    return abs(reactions(deck(nodes, tets, height, young, poisson, solver))[-1][2]) / (1e-3 / MM)
