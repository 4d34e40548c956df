"""One run: mesh from a recipe, deck from what differs, core-seconds and history out."""
import dataclasses
import pathlib
import re
import subprocess
import xml.etree.ElementTree as tree

import numpy as np
from decks import section
from strut_tools import history_of, seconds_of_phase, with_core_seconds
from picture_parts import result as picture_result

STEPPING = ("Deformation and stress", "Stabilization", "Force", "Halo exchange", "Agreement of ranks", "Critical time step",
            "Motion and conditions", "Contact search", "Contact forces")


def build(root):
    subprocess.run([root / "tools/prepare", "release", "--target", "strut", "strut-mesh", "bench_voxel_elements"], check=True,
                   stdout=subprocess.DEVNULL)


def deck_of(sections):
    """The text of a deck: {key: value, or the content of a section}."""
    return tree.tostring(section("deck", sections), "unicode")


def cube(cells):
    """The recipe of a cube of cells of 1 mm."""
    edge = cells * 1e-3
    return f"[body]\nname = all\nshape = box\nsize = {edge} {edge} {edge}\nspacing = 1e-3\n"


COPPER = {"Material Model": "Elastic Plastic Correspondence", "Density": 8960, "Young's Modulus": 110e9, "Poisson's Ratio": 0.3,
          "Yield Stress": 5e7}
VERLET = {"Verlet": {"Safety Factor": 0.8}}
ONE_EQUILIBRIUM = {"QuasiStatic": {"Number of Load Steps": 1}}


def method_keys(method):
    if method.stabilization == "ordinary":
        return {"Material Model": "Elastic"}
    if method.stabilization == "quadratic":
        return {"Formulation": "Quadratic Correspondence"}
    kind, coefficient = method.kind()
    return {"Stabilization": kind, **({"Stabilization Coefficient": coefficient} if coefficient else {})}


@dataclasses.dataclass
class Result:
    seconds: float  # of the steps, on one core: what the processor gave, not the clock
    number: int     # of points
    history: dict   # columns
    path: pathlib.Path

    def last_field(self, name):
        """Reference positions, a row a point, and a component at the last output."""
        result = picture_result.Result(str(self.path))
        return result.reference, result.values(name, -1)


class Runner:
    def __init__(self, root, work):
        programs = root / "build/release"
        self.program, self.mesh_program, self.work = programs / "strut", programs / "tools/strut-mesh", work
        self.voxel_program = programs / "tests/reference/bench_voxel_elements"

    def mesh(self, name, recipe):
        """The mesh of a recipe, made anew."""
        (self.work / f"{name}.recipe").write_text(recipe)
        path = self.work / f"{name}.g"
        path.unlink(missing_ok=True)
        subprocess.run([self.mesh_program, f"{name}.recipe", path.name], cwd=self.work, check=True,
                       stdout=subprocess.DEVNULL)
        return path.name

    def voxel_elements(self, mesh, young, poisson):
        """Linear finite elements between clamped ends: elements, stiffness in N/m, s an element and explicit step."""
        report = subprocess.run([self.voxel_program, mesh, str(young), str(poisson)], cwd=self.work, check=True,
                                capture_output=True, text=True).stdout
        found = re.search(r"(\d+) elements.* stiffness (\S+) N/m.*: (\S+) ns an element and step", report, re.S)
        return int(found[1]), float(found[2]), 1e-9 * float(found[3])

    def run(self, name, mesh, method, material, conditions, final_time, interval, variables, solver=VERLET):
        """None where the run fails."""
        model = method_keys(method)
        if method.stabilization != "ordinary":
            model = {"Material Model": material.correspondence, **model}
        (self.work / f"{name}.xml").write_text(deck_of({
            "Discretization": {"Type": "Exodus", "Input Mesh File": mesh, "Points": method.points,
                               "Influence Function": method.influence, "Degenerate Points": "Drop Any"},
            "Materials": {"solid": {**model, **material.keys}},
            "Blocks": {"all": {"Block Names": "all", "Material": "solid", "Horizon Factor": method.horizon}},
            "Boundary Conditions": conditions,
            "Solver": {"Final Time": final_time, **solver},
            "Output": {"Output Filename": f"{name}.e", "Output Interval": final_time, "Output Variables": {"Velocity": "true"}},
            "History": {"Filename": f"{name}.csv", "Interval": interval, "Variables": dict.fromkeys(variables, "true")}}))
        command = [self.program, f"{name}.xml"]
        done, taken = with_core_seconds(lambda: subprocess.run(command, cwd=self.work, capture_output=True, text=True))
        if done.returncode != 0:
            return None
        rows = history_of(self.work / f"{name}.csv")
        history = {key: np.array([row[key] for row in rows]) for key in rows[0]}
        number = int(re.search(r"(\d+) points,", done.stdout).group(1))
        return Result(taken * share_of_steps(done.stdout), number, history, self.work / f"{name}.e")


def seconds(report):
    """Wall time of the steps."""
    return sum(seconds_of_phase(report, phase) for phase in STEPPING)


def share_of_steps(report):
    """Fraction of the wall time; start-up and output are not the method's."""
    return seconds(report) / max(seconds_of_phase(report, "whole run"), 1e-9)
