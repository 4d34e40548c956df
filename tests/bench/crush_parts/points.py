"""The same bodies by strut, explicit steps."""
import re
import subprocess

import numpy as np
from exodus import gather_voxels, write_mesh
from strut_tools import history_of, with_core_seconds
from voxel.cells import stream_of
from work_precision_parts.runs import method_keys, parameter, section, share_of_steps

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
    held = []
    for end, sign in (("upper", 1), ("lower", -1)):
        held += [prescribed(f"{end} {axis}", end, axis, sign * speed) for axis, speed in zip("xyz", plate)]
    held += [prescribed("core", "core", "xyz", 0)] if body.core else []
    return held + [section(f"start {axis}", parameter("Type", "Initial Velocity"), parameter("Node Set", "everything"),
                           parameter("Coordinate", axis), parameter("Value", f"{2 * speed / body.height:.17g}*z"))
                   for axis, speed in zip("xyz", plate)]


def prescribed(name, nodes, axes, value):
    return section(name, parameter("Type", "Prescribed Velocity"), parameter("Node Set", nodes),
                   parameter("Coordinate", axes), parameter("Value", f"{value:.17g}"))


def deck(name, body, method, spacing, placement):
    end = body.height / 2 - 0.45 * spacing
    sets = {"upper": f"z &gt; {end:.12g}", "lower": f"z &lt; {-end:.12g}", "everything": "1 &gt; 0"}
    if body.core:
        sets["core"] = f"x*x+y*y+z*z &lt; {body.core ** 2:.12g}"
    metal = "".join(parameter(key, value, "double") for key, value in (
        ("Density", DENSITY), ("Young's Modulus", YOUNG), ("Poisson's Ratio", POISSON), ("Yield Stress", YIELD)))
    reactions = [f"Reaction_{axis}({end} {axis.lower()})" for end in ("upper", "lower") for axis in "XYZ"]
    return section(
        "deck",
        section("Discretization", parameter("Type", "Exodus"), parameter("Input Mesh File", f"{name}.g"),
                parameter("Points", method.points), parameter("Degenerate Points", "Drop")),
        section("Node Sets", *(parameter(key, value) for key, value in sets.items())),
        section("Materials", section("metal", parameter("Material Model", "Elastic Plastic Correspondence"), method_keys(method), metal)),
        section("Blocks", section("all", parameter("Block Names", "all"), parameter("Material", "metal"),
                                  parameter("Horizon Factor", method.horizon, "double"))),
        section("Boundary Conditions", *conditions(body, placement)),
        section("Solver", parameter("Final Time", body.duration(), "double"), section("Verlet")),
        section("History", parameter("Filename", f"{name}.csv"), parameter("Interval", body.duration() / 200, "double"),
                section("Variables", *(parameter(one, "true", "bool") for one in reactions))))


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
