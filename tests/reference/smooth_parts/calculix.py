"""A mesh of quadratic tetrahedra between clamped ends, by CalculiX."""
import pathlib
import re
import subprocess
import tempfile

import numpy

MM = 1e3  # CalculiX has no units: mm, N and N/mm² leave no very small numbers in its files


def deck(nodes, tets, height, young, poisson, solver):
    def rows(table, form):
        return "\n".join(form(k + 1, row) for k, row in enumerate(table))

    def node_set(name, chosen):
        return f"*NSET, NSET={name}\n" + ",\n".join(str(k + 1) for k in numpy.flatnonzero(chosen))

    return "\n".join([
        "*NODE, NSET=ALL", rows(nodes * MM, lambda k, x: f"{k}, {x[0]:.12g}, {x[1]:.12g}, {x[2]:.12g}"),
        "*ELEMENT, TYPE=C3D10, ELSET=FOAM", rows(tets + 1, lambda k, t: ", ".join(map(str, (k, *t)))),
        node_set("FOOT", nodes[:, 2] < 1e-9 * height), node_set("TOP", nodes[:, 2] > (1 - 1e-9) * height),
        "*MATERIAL, NAME=METAL", "*ELASTIC", f"{young * 1e-6:.12g}, {poisson:.12g}",
        "*SOLID SECTION, ELSET=FOAM, MATERIAL=METAL", "*STEP", f"*STATIC, SOLVER={solver}", "*BOUNDARY",
        "FOOT, 1, 3, 0", "TOP, 1, 2, 0", "TOP, 3, 3, 1e-3", "*NODE PRINT, NSET=TOP, TOTALS=ONLY", "RF", "*END STEP",
        ""])


def stiffness(nodes, tets, height, young, poisson, solver="SPOOLES"):
    """N/m."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "foam.inp").write_text(deck(nodes, tets, height, young, poisson, solver))
        done = subprocess.run(["ccx", "foam"], cwd=folder, capture_output=True, text=True)
        results = pathlib.Path(folder) / "foam.dat"
        if done.returncode != 0 or not results.exists():
            raise SystemExit(done.stdout[-2000:] + done.stderr[-2000:])
        number = r"(-?\d\.\d+E[+-]\d+)"
        forces = re.findall(rf"^\s*{number}\s+{number}\s+{number}\s*$", results.read_text(), re.M)
    return abs(float(forces[-1][2])) / (1e-3 / MM)
