"""One run: mesh from a recipe, deck from what differs, core-seconds and history out."""
import dataclasses
import pathlib
import re
import subprocess

import numpy as np
from strut_tools import history_of, seconds_of_phase, with_core_seconds
from picture_parts import result as picture_result

STEPPING = ("Deformation and stress", "Stabilization", "Force", "Halo exchange", "Agreement of ranks", "Critical time step",
            "Motion and conditions", "Contact search", "Contact forces")


def build(root):
    subprocess.run([root / "tools/prepare", "release", "--target", "strut", "strut-mesh", "bench_voxel_elements"], check=True,
                   stdout=subprocess.DEVNULL)


def parameter(name, value, kind="string"):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>\n'


def section(name, *content):
    return f'<ParameterList name="{name}">\n{"".join(content)}</ParameterList>\n'


VERLET = section("Verlet", parameter("Safety Factor", 0.8, "double"))
ONE_EQUILIBRIUM = section("QuasiStatic", parameter("Number of Load Steps", 1, "int"))


def method_keys(method):
    if method.stabilization == "ordinary":
        return parameter("Material Model", "Elastic")
    if method.stabilization == "quadratic":
        return parameter("Formulation", "Quadratic Correspondence")
    kind, coefficient = method.kind()
    return parameter("Stabilization", kind) + (parameter("Stabilization Coefficient", coefficient) if coefficient else "")


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
            model = parameter("Material Model", material.correspondence) + model
        deck = section(
            "deck",
            section("Discretization", parameter("Type", "Exodus"), parameter("Input Mesh File", mesh),
                    parameter("Points", method.points), parameter("Influence Function", method.influence),
                    parameter("Degenerate Points", "Drop Any")),
            section("Materials", section("solid", model, material.keys)),
            section("Blocks", section("all", parameter("Block Names", "all"), parameter("Material", "solid"),
                                      parameter("Horizon Factor", method.horizon, "double"))),
            section("Boundary Conditions", *conditions),
            section("Solver", parameter("Final Time", final_time, "double"), solver),
            section("Output", parameter("Output Filename", f"{name}.e"),
                    parameter("Output Interval", final_time, "double"),
                    section("Output Variables", parameter("Velocity", "true", "bool"))),
            section("History", parameter("Filename", f"{name}.csv"), parameter("Interval", interval, "double"),
                    section("Variables", *(parameter(v, "true", "bool") for v in variables))))
        (self.work / f"{name}.xml").write_text(deck)
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
