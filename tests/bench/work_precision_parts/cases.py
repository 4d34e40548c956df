"""The problems, and how wrong a run of each is."""
import dataclasses
import math

import numpy as np

from .runs import ONE_EQUILIBRIUM


@dataclasses.dataclass(frozen=True)
class Method:
    points: str          # Elements or Nodes
    stabilization: str   # "none", "Silling 0.02", "Mean Gradient 0.01", "ordinary"; "quadratic": needs none
    horizon: float       # in spacings
    influence: str = "One"

    def kind(self):
        if self.stabilization == "none":
            return "None", ""
        name, coefficient = self.stabilization.rsplit(" ", 1)
        return name, coefficient


@dataclasses.dataclass(frozen=True)
class Material:
    keys: dict
    correspondence: str = "Elastic Correspondence"


def elastic(young, poisson, density):
    return Material({"Density": density, "Young's Modulus": young, "Poisson's Ratio": poisson})


def velocities(**values):
    return {f"velocity {axis}": {"Type": "Initial Velocity", "Node Set": "all", "Coordinate": axis, "Value": value}
            for axis, value in values.items()}


WALL = {"wall": {"Type": "Rigid Plane", "Node Set": "all", "Point": "0 0 0", "Normal": "0 0 1"}}


def recipe(**keys):
    return "".join(f"{key} = {value}\n" for key, value in keys.items())


PLAIN = [Method(points, kind, horizon) for points in ("Elements", "Nodes") for kind in
         ("none", "Silling 0.02", "Mean Gradient 0.01") for horizon in (1.75, 3.015)]
PLAIN += [Method(points, "quadratic", 1.75) for points in ("Elements", "Nodes")]


def row(points, stabilization, horizon, spacing, number="", seconds=None, error=None, note=""):
    return {"points": points, "stabilization": stabilization, "horizon": horizon, "spacing": round(spacing, 2),
            "number": number, "seconds": seconds, "error": error, "front": False, "note": note}


class Case:
    name = unit = title = ""
    signed = False  # errors
    aim = None      # an error: a second table says what each scheme costs at it
    methods, spacings, scale = PLAIN, (), 1.0

    def spacings_of(self, method):
        return self.spacings

    def note(self, result):
        return ""

    def rows(self, runner):
        """Each method at each spacing; what does not run is a row without an error."""
        rows = []
        for method in self.methods:
            for spacing in self.spacings_of(method):
                result = self.run(runner, method, spacing)
                keys = (method.points.lower(), method.stabilization, method.horizon, spacing * self.scale)
                if result is None:
                    rows.append(row(*keys, note="does not run to the end"))
                else:
                    rows.append(row(*keys, number=result.number, seconds=result.seconds,
                                    error=self.error(result, method, spacing), note=self.note(result)))
                print(self.name, *rows[-1].values(), flush=True)
        return rows


class Wave(Case):
    """A pulse of velocity in a free bar with ν = 0 splits, and each half is reflected. d'Alembert with the images of the
    pulse behind the ends; the root mean square of what is wrong over that of the pulse, after 2.3 lengths of travel."""
    name, unit, title = "wave", "mm", "elastic wave in a bar"
    spacings, scale = (0.04, 0.02, 0.01), 1e3
    methods = PLAIN + [Method("Elements", "ordinary", 3.015, "Linear Decay")]
    length, speed, density, width, center = 1.0, 1000.0, 1000.0, 0.3, 0.45

    def run(self, runner, method, spacing):
        mesh = runner.mesh("wave", recipe(shape="box", size="0.12 0.12 1", spacing=spacing, origin="-0.06 -0.06 0"))
        half = f"fabs(z-{self.center})/{self.width}"
        pulse = f"({half} < 1) * cos({math.pi / 2}*{half})^4"
        material = elastic(self.density * self.speed**2, 0, self.density)
        final_time = 2.3 * self.length / self.speed
        return runner.run("wave", mesh, method, material, velocities(z=pulse), final_time, final_time, ["Max_Velocity"])

    def pulse(self, z):
        """Even about both ends: period 2 L."""
        z = np.abs((z + self.length) % (2 * self.length) - self.length)
        x = np.abs(z - self.center) / self.width
        return np.where(x < 1, np.cos(np.pi / 2 * x) ** 4, 0)

    def error(self, result, method, spacing):
        places, velocity_z = result.last_field("VelocityZ")
        z, travel = places[:, 2], 2.3 * self.length
        exact = (self.pulse(z - travel) + self.pulse(z + travel)) / 2
        return np.sqrt(np.mean((velocity_z - exact) ** 2) / np.mean(exact**2))


class Torsion(Case):
    """A free round bar swings in its first mode of torsion, each end through 69 degrees. Closed form: sqrt(G/rho)/(2 L). The
    frequency is that of the cos² that fits the kinetic energy best; the shear of 4 % shifts the true one by its square."""
    name, unit, title = "torsion", "mm", "torsion vibration through large rotation"
    spacings, scale = (0.01, 0.00667, 0.005), 1e3
    methods = PLAIN
    length, radius, young, poisson, density, swing = 1.0, 0.02, 1e9, 0.3, 1000.0, 0.6

    def frequency(self):
        """rad/s"""
        return math.pi / self.length * math.sqrt(self.young / (2 * (1 + self.poisson)) / self.density)

    def run(self, runner, method, spacing):
        mesh = runner.mesh("torsion", recipe(shape="cylinder", method="fitted", length=self.length, radius=self.radius,
                                             spacing=spacing))
        spin = f"{self.swing * self.frequency()}*cos({math.pi / self.length}*z)"
        final_time = 1.25 * 2 * math.pi / self.frequency()
        return runner.run("torsion", mesh, method, elastic(self.young, self.poisson, self.density),
                          velocities(x=f"-y*{spin}", y=f"x*{spin}"), final_time, final_time / 200,
                          ["Max_Velocity"])

    def error(self, result, method, spacing):
        time, kinetic = result.history["Time"], result.history["Kinetic_Energy"]

        def misfit(ratio):
            shape = np.cos(ratio * self.frequency() * time) ** 2
            return np.sum((kinetic - shape * (kinetic @ shape) / (shape @ shape)) ** 2)

        return abs(minimum(misfit, 0.2, 1.8) - 1)


def minimum(function, low, high):
    """The minimum of a function that has one near the best of a hundred samples."""
    for _ in range(6):
        samples = np.linspace(low, high, 101)
        best, width = samples[np.argmin([function(x) for x in samples])], (high - low) / 100
        low, high = best - width, best + width
    return best


class Bar(Case):
    """The copper bar of 32.4 mm at 227 m/s. Converged finite elements: length and radius of the foot at ten times; the
    error is the root mean square of both."""
    name, unit, title = "bar", "mm", "Taylor bar at 227 m/s"
    spacings, scale = (0.8e-3, 0.5e-3, 0.35e-3), 1e3
    methods = [m for m in PLAIN if m.horizon < 3 or (m.points == "Elements" and m.stabilization != "none")]
    times = (5, 10, 20, 30, 40, 50, 60, 70, 78, 80)
    radii = (4.522, 5.233, 6.205, 6.820, 7.147, 7.237, 7.234, 7.234, 7.233, 7.233)
    lengths = (31.264, 30.139, 28.065, 26.189, 24.562, 23.221, 22.213, 21.593, 21.420, 21.430)
    copper = Material({"Density": 8930, "Young's Modulus": 117e9, "Poisson's Ratio": 0.35, "Yield Stress": 400e6,
                       "Hardening": {"Type": "Linear", "Hardening Modulus": 100e6}}, "Elastic Plastic Correspondence")

    def spacings_of(self, method):
        """The finest takes minutes: for the best ones."""
        return self.spacings if method.points == "Nodes" and method.stabilization != "none" else self.spacings[:2]

    def run(self, runner, method, spacing):
        mesh = runner.mesh("body", recipe(shape="cylinder", method="fitted", length=0.0324, radius=0.0032,
                                          spacing=spacing))
        return runner.run("bar", mesh, method, self.copper, velocities(z=-227) | WALL, 80e-6, 1e-6,
                          ["Max_Coordinate_Z", "Max_Radial_Distance(body_zmin)"])

    def error(self, result, method, spacing):
        history = result.history
        rim = 0 if method.points == "Nodes" else spacing / 2
        at = [np.argmin(np.abs(history["Time"] - 1e-6 * t)) for t in self.times]
        length = (history["Max_Coordinate_Z"][at] + rim) * 1e3 / self.lengths - 1
        radius = (history["Max_Radial_Distance(body_zmin)"][at] + rim) * 1e3 / self.radii - 1
        return math.sqrt(np.mean(length**2 + radius**2))


class Measured(Case):
    """The bar of OFHC copper at 190 m/s that was recovered, by the law and constants of Zerilli and Armstrong
    (inputs/taylor/taylor-190-zerilli.xml): length and diameter of the foot; the error is the root mean square of both. What the
    law misses is part of it: errors do not go to zero."""
    name, unit, title = "measured", "mm", "measured Taylor bar at 190 m/s"
    spacings, scale = (0.8e-3, 0.5e-3, 0.35e-3), 1e3
    methods = [m for m in PLAIN if m.horizon < 3 and m.stabilization in ("Mean Gradient 0.01", "quadratic")]
    length, diameter = 16.21e-3, 13.56e-3
    copper = Material({"Density": 8960, "Young's Modulus": 124e9, "Poisson's Ratio": 0.34,
                       "Flow Stress": {"Type": "Zerilli-Armstrong", "Athermal Stress": 65e6, "Thermal Stress": 890e6,
                                       "Thermal Exponent": 0.5, "Softening": 0.0028, "Rate Softening": 0.000115},
                       "Heating": {"Specific Heat": 383, "Taylor-Quinney Coefficient": 0.9}}, "Elastic Plastic Correspondence")

    def spacings_of(self, method):
        """The finest takes minutes: for the mean gradient at nodes."""
        return self.spacings if method.points == "Nodes" and method.stabilization != "quadratic" else self.spacings[:2]

    def run(self, runner, method, spacing):
        mesh = runner.mesh("body", recipe(shape="cylinder", method="fitted", length=0.0254, radius=0.00381,
                                          spacing=spacing))
        return runner.run("measured", mesh, method, self.copper, velocities(z=-190) | WALL,
                          80e-6, 8e-6, ["Max_Coordinate_Z", "Min_Coordinate_Z", "Max_Radial_Distance(body_zmin)"])

    def rim(self, method, spacing):
        """By how much the body reaches beyond its outermost points."""
        return 0 if method.points == "Nodes" else 0.0254 / round(0.0254 / spacing) / 2

    def error(self, result, method, spacing):
        last = {name: column[-1] for name, column in result.history.items()}
        rim = self.rim(method, spacing)
        length = (last["Max_Coordinate_Z"] - last["Min_Coordinate_Z"] + 2 * rim) / self.length - 1
        foot = 2 * (last["Max_Radial_Distance(body_zmin)"] + rim) / self.diameter - 1
        return math.sqrt((length**2 + foot**2) / 2)


def gathered(spacing, voxel):
    """Line of a recipe: cells that know what is in them, of so many voxels along each edge."""
    return {"cells": round(spacing / voxel)}


def between_plates(kind, value):
    """Both ends stick to plates; the upper one moves."""
    motions = {(end, axis): ("Displacement", "0") for end in ("foot", "top") for axis in "xyz"} | {("top", "z"): (kind, value)}
    return {f"{end} {axis}": {"Type": f"Prescribed {what}", "Node Set": end, "Coordinate": axis, "Value": motion}
            for (end, axis), (what, motion) in motions.items()}


class Struts(Case):
    """Stiffness of an open-cell foam between plates that stick, against finite elements from outside (tests/reference/README.md,
    "A foam by finite elements"), and what 2 µs of explicit steps cost, some seven ways of a wave through the foam."""
    name, unit, title = "struts", "µm", "stiffness of a foam"
    signed, aim = True, 0.05
    methods = [Method("Elements", "none", 1.75), Method("Elements", "Silling 0.02", 3.015),
               Method("Elements", "Mean Gradient 0.01", 1.75), Method("Nodes", "Mean Gradient 0.01", 1.75),
               Method("Elements", "quadratic", 1.75)]
    size, scale, voxels = 1e-3, 1e6, (33, 44, 66, 88, 132)
    young, poisson, density, exact = 110e9, 0.296, 8960.0, 925e3  # Pa, –, kg/m³, N/m
    duration, timed, shift = 2e-6, 0.4e-6, 1e-8                   # s, s of it that are run, m
    highest = 2.75                                                # largest ω_max h/c of voxels in tests/reference

    def spacings_of(self, method):
        """The finest takes minutes: for the best ones."""
        best = method.stabilization in ("quadratic", "Mean Gradient 0.01")
        return [self.size / n for n in (self.voxels if best else self.voxels[:-1])]

    def mesh(self, runner, spacing, **keys):
        return runner.mesh("struts", recipe(shape="foam", size=f"{self.size} {self.size} {self.size}", cell=0.46e-3,
                                            relative_density=0.10, seed=2, spacing=spacing, **keys))

    def run(self, runner, method, spacing):
        cells = gathered(spacing, self.size / 264) if method.stabilization == "quadratic" else {}
        mesh = self.mesh(runner, spacing, **cells)
        material = elastic(self.young, self.poisson, self.density)
        rest = runner.run("struts-slow", mesh, method, material, between_plates("Displacement", f"-{self.shift}*t"), 1, 1,
                          ["Reaction_Z(top z)"], ONE_EQUILIBRIUM)
        steps = runner.run("struts", mesh, method, material, between_plates("Velocity", "-20"), self.timed, self.timed,
                           ["Max_Velocity"])
        if rest is None or steps is None:
            return None
        rest.seconds = steps.seconds * self.duration / self.timed
        return rest

    def error(self, result, method, spacing):
        """Points at elements are held half a spacing inside of the ends."""
        shortened = spacing / self.size if method.points == "Elements" else 0
        return abs(result.history["Reaction_Z(top z)"][-1]) / self.shift * (1 - shortened) / self.exact - 1

    def rows(self, runner):
        rows = super().rows(runner)
        for n in self.voxels:
            number, stiffness, each = runner.voxel_elements(self.mesh(runner, self.size / n), self.young, self.poisson)
            step = 0.8 * 2 / self.highest * self.size / n / math.sqrt(self.young / self.density)
            rows.append(row("nodes", "finite elements", "–", self.size / n * self.scale, number=number,
                            seconds=self.duration / step * number * each, error=stiffness / self.exact - 1))
            print(self.name, *rows[-1].values(), flush=True)
        return rows


class Kelvin(Case):
    """A column of Kelvin's foam of aluminium, crushed by 15 % at 30 m/s between plates that stick, struts 3, 4, 5, 7 and 10
    spacings thick: mean force over area at the moved plate from 5 to 15 %, against the refined one."""
    name, unit, title = "kelvin", "µm", "crushing a Kelvin foam"
    signed = True
    mean_gradient = [Method(points, "Mean Gradient 0.01", 1.75) for points in ("Elements", "Nodes")]
    methods = [Method("Elements", "Silling 0.0005", 3.015), *mean_gradient, Method("Elements", "quadratic", 1.75)]
    spacings, scale = (78e-6, 58.5e-6, 46.8e-6, 33.4e-6, 23.4e-6), 1e6
    width, length, speed, strain = 3e-3, 5e-3, 30.0, 0.15
    refined = 2.84e6  # Pa: the mean gradient at elements has 2.877 and 2.834 MPa with 7 and 10 points a strut
    aluminium = Material({"Density": 2700, "Young's Modulus": 70e9, "Poisson's Ratio": 0.33, "Yield Stress": 200e6,
                          "Hardening": {"Type": "Linear", "Hardening Modulus": 500e6}}, "Elastic Plastic Correspondence")

    def run(self, runner, method, spacing):
        cells = gathered(spacing, 12e-6) if method.stabilization == "quadratic" else {}
        mesh = runner.mesh("kelvin", recipe(shape="foam", size=f"{self.width} {self.width} {self.length}", cell=1.96949e-3,
                                            relative_density=0.08, irregularity=0, spacing=spacing, **cells))
        final_time = self.strain * self.length / self.speed
        return runner.run("kelvin", mesh, method, self.aluminium, between_plates("Velocity", f"-{self.speed}"), final_time,
                          final_time / 300, ["Reaction_Z(top z)"])

    def plateau(self, result):
        """Pa"""
        strain = self.speed * result.history["Time"] / self.length
        return abs(np.mean(result.history["Reaction_Z(top z)"][strain >= 0.05])) / self.width**2

    def error(self, result, method, spacing):
        return self.plateau(result) / self.refined - 1

    def note(self, result):
        return f"{self.plateau(result) / 1e6:.3f} MPa"


CASES = {case.name: case for case in (Wave(), Torsion(), Bar(), Measured(), Struts(), Kelvin())}
