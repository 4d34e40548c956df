"""The same bodies by strut, explicit steps."""
import re
import subprocess

import numpy as np
from exodus import gather_voxels, write_mesh
from strut_tools import history_of, with_core_seconds
from voxel.cells import stream_of
from work_precision_parts.runs import deck_of, method_keys, share_of_steps

from . import voxels
from .bodies import DENSITY, POISSON, YIELD, YOUNG

PARTS = 6        # voxels along the edge of a cell
SMALLEST = 0.3   # of a cell, else it is merged with a neighbor
EXODUS_CORNERS = [0, 1, 3, 2, 4, 5, 7, 6]


def cells(path, body, spacing, placement):
    """Cells that know what is in them; the middles of the end layers lie in the ends."""
    voxel, half = spacing / PARTS, int(np.ceil(body.reach() / spacing))
    counts = np.array([2 * half, 2 * half, round(body.height / spacing) + 1])
    low = spacing * np.array([placement.offset[0] - half, placement.offset[1] - half, -counts[2] / 2])
    fine = counts * PARTS
    j, i = np.meshgrid(np.arange(fine[1]), np.arange(fine[0]), indexing="ij")
    solid = [body.solid(low + voxel * (np.stack([i.ravel(), j.ravel(), np.full(i.size, k)], 1) + 0.5), placement.turn).reshape(i.shape)
             for k in range(fine[2])]
    gather_voxels(path, stream_of("body", np.array(solid), [voxel] * 3, low, PARTS, SMALLEST))


def mesh(path, body, method, spacing, placement):
    layers = round(body.height / spacing) + (method.points == "Elements")
    if method.stabilization == "quadratic" and method.points == "Elements":
        cells(path, body, spacing, placement)
    else:
        nodes, elements = voxels.mesh(body, spacing, placement, layers)
        write_mesh(path, nodes, [("body", "HEX8", elements[:, EXODUS_CORNERS], None)], {})


def conditions(body, placement):
    """Both ends and the core move as they must; at the start all in between does."""
    plate = body.plate_velocity(placement.turn)
    found = {f"{end} {axis}": velocity("Prescribed", end, axis, f"{sign * speed:.17g}")
             for end, sign in (("upper", 1), ("lower", -1)) for axis, speed in zip("xyz", plate)}
    found |= {"core": velocity("Prescribed", "core", "xyz", "0")} if body.core else {}
    return found | {f"start {axis}": velocity("Initial", "everything", axis, f"{2 * speed / body.height:.17g}*z")
                    for axis, speed in zip("xyz", plate)}


def velocity(kind, nodes, axes, value):
    return {"Type": f"{kind} Velocity", "Node Set": nodes, "Coordinate": axes, "Value": value}


def deck(name, body, method, spacing, placement):
    end = body.height / 2 - 0.45 * spacing
    sets = {"upper": f"z > {end:.12g}", "lower": f"z < {-end:.12g}", "everything": "1 > 0"}
    if body.core:
        sets["core"] = f"x*x+y*y+z*z < {body.core ** 2:.12g}"
    metal = {"Material Model": "Elastic Plastic Correspondence", "Density": DENSITY, "Young's Modulus": YOUNG,
             "Poisson's Ratio": POISSON, "Yield Stress": YIELD}
    reactions = [f"Reaction_{axis}({end} {axis.lower()})" for end in ("upper", "lower") for axis in "XYZ"]
    return deck_of({
        "Discretization": {"Type": "Exodus", "Input Mesh File": f"{name}.g", "Points": method.points, "Degenerate Points": "Drop"},
        "Node Sets": sets,
        "Materials": {"metal": {**metal, **method_keys(method)}},
        "Blocks": {"all": {"Block Names": "all", "Material": "metal", "Horizon Factor": method.horizon}},
        "Boundary Conditions": conditions(body, placement),
        "Solver": {"Final Time": body.duration(), "Verlet": {}},
        "History": {"Filename": f"{name}.csv", "Interval": body.duration() / 200, "Variables": dict.fromkeys(reactions, "true")}})


def work(rows, body, turn):
    """J; reactions are means over the interval that ends with a row."""
    done, before = 0.0, 0.0
    for row in rows:
        power = sum(sign * speed * row[f"Reaction_{axis}({end} {axis.lower()})"]
                    for end, sign in (("upper", 1), ("lower", -1)) for axis, speed in zip("XYZ", body.plate_velocity(turn)))
        done += power * (row["Time"] - before)
        before = row["Time"]
    return done


def crush(program, folder, body, method, spacing, placement):
    """Points, J, core-seconds of the steps; None where the run ends early."""
    name = "crush"
    mesh(str(folder / f"{name}.g"), body, method, spacing, placement)
    (folder / f"{name}.xml").write_text(deck(name, body, method, spacing, placement))
    command = [program, f"{name}.xml"]
    run, taken = with_core_seconds(lambda: subprocess.run(command, cwd=folder, capture_output=True, text=True))
    if run.returncode != 0:
        print(run.stderr.strip().splitlines()[-1:], flush=True)
        return None
    number = int(re.search(r"(\d+) points,", run.stdout).group(1))
    rows = history_of(folder / f"{name}.csv")
    return number, work(rows, body, placement.turn), taken * share_of_steps(run.stdout)
