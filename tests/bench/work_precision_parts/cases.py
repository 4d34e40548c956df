"""The problems, and how wrong a run of each is."""
import dataclasses
import math

import numpy as np

from .runs import parameter, section


@dataclasses.dataclass(frozen=True)
class Method:
    points: str          # Elements or Nodes
    stabilisation: str   # "none", "Silling 0.02", "Mean Gradient 0.01", "ordinary"; "quadratic": needs none
    horizon: float       # in spacings
    influence: str = "One"

    def kind(self):
        if self.stabilisation == "none":
            return "None", ""
        name, coefficient = self.stabilisation.rsplit(" ", 1)
        return name, coefficient


@dataclasses.dataclass(frozen=True)
class Material:
    keys: str
    correspondence: str = "Elastic Correspondence"


def elastic(young, poisson, density):
    return Material(parameter("Density", density, "double") + parameter("Young's Modulus", young, "double") +
                    parameter("Poisson's Ratio", poisson, "double"))


def velocity(axis, value):
    return section(f"velocity {axis}", parameter("Type", "Initial Velocity"), parameter("Node Set", "all"),
                   parameter("Coordinate", axis), parameter("Value", value))


def plane(height):
    return section("wall", parameter("Type", "Rigid Plane"), parameter("Node Set", "all"),
                   parameter("Point", f"0 0 {height}"), parameter("Normal", "0 0 1"))


def recipe(**keys):
    return "".join(f"{key} = {value}\n" for key, value in keys.items())


PLAIN = [Method(points, kind, horizon) for points in ("Elements", "Nodes") for kind in
         ("none", "Silling 0.02", "Mean Gradient 0.01") for horizon in (1.75, 3.015)]
PLAIN += [Method(points, "quadratic", 1.75) for points in ("Elements", "Nodes")]


class Case:
    name = unit = title = ""
    methods, spacings, scale = PLAIN, (), 1.0

    def spacings_of(self, method):
        return self.spacings

    def rows(self, runner):
        """Each method at each spacing; what does not run is a row without an error."""
        rows = []
        for method in self.methods:
            for spacing in self.spacings_of(method):
                result = self.run(runner, method, spacing)
                row = {"points": method.points.lower(), "stabilisation": method.stabilisation, "horizon": method.horizon,
                       "spacing": round(spacing * self.scale, 6), "number": "", "seconds": None, "error": None,
                       "front": False, "note": ""}
                if result is None:
                    row["note"] = "does not run to the end"
                else:
                    row.update(seconds=result.seconds, number=result.number, error=self.error(result, method, spacing))
                rows.append(row)
                print(self.name, *row.values(), flush=True)
        return rows


class Wave(Case):
    """A pulse of velocity in a free bar with ν = 0 splits, and each half is reflected. d'Alembert with the images of the
    pulse behind the ends; the root mean square of what is wrong over that of the pulse, after 2.3 lengths of travel."""
    name, unit, title = "wave", "mm", "elastic wave in a bar"
    spacings, scale = (0.04, 0.02, 0.01), 1e3
    methods = PLAIN + [Method("Elements", "ordinary", 3.015, "Linear Decay")]
    length, speed, density, width, centre = 1.0, 1000.0, 1000.0, 0.3, 0.45

    def run(self, runner, method, spacing):
        mesh = runner.mesh("wave", recipe(shape="box", size="0.12 0.12 1", spacing=spacing, origin="-0.06 -0.06 0"))
        half = f"fabs(z-{self.centre})/{self.width}"
        pulse = f"({half} &lt; 1) * cos({math.pi / 2}*{half})^4"
        material = elastic(self.density * self.speed**2, 0, self.density)
        final_time = 2.3 * self.length / self.speed
        return runner.run("wave", mesh, method, material, [velocity("z", pulse)], final_time, final_time, ["Max_Velocity"])

    def pulse(self, z):
        """Even about both ends: period 2 L."""
        z = np.abs((z + self.length) % (2 * self.length) - self.length)
        x = np.abs(z - self.centre) / self.width
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
                          [velocity("x", f"-y*{spin}"), velocity("y", f"x*{spin}")], final_time, final_time / 200,
                          ["Max_Velocity"])

    def error(self, result, method, spacing):
        time, kinetic = result.history["Time"], result.history["Kinetic_Energy"]

        def misfit(ratio):
            shape = np.cos(ratio * self.frequency() * time) ** 2
            return np.sum((kinetic - shape * (kinetic @ shape) / (shape @ shape)) ** 2)

        return abs(minimum(misfit, 0.2, 1.8) - 1)


def minimum(function, low, high):
    """Of a function that has one near the best of a hundred samples."""
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
    methods = [m for m in PLAIN if m.horizon < 3 or (m.points == "Elements" and m.stabilisation != "none")]
    times = (5, 10, 20, 30, 40, 50, 60, 70, 78, 80)
    radii = (4.522, 5.233, 6.205, 6.820, 7.147, 7.237, 7.234, 7.234, 7.233, 7.233)
    lengths = (31.264, 30.139, 28.065, 26.189, 24.562, 23.221, 22.213, 21.593, 21.420, 21.430)
    copper = Material("".join(parameter(*p) for p in (
        ("Density", 8930, "double"), ("Young's Modulus", 117e9, "double"), ("Poisson's Ratio", 0.35, "double"),
        ("Yield Stress", 400e6, "double"))) + section("Hardening", parameter("Type", "Linear"),
                                                      parameter("Hardening Modulus", 100e6, "double")),
        "Elastic Plastic Correspondence")

    def spacings_of(self, method):
        """The finest takes minutes: for the best ones."""
        return self.spacings if method.points == "Nodes" and method.stabilisation != "none" else self.spacings[:2]

    def run(self, runner, method, spacing):
        """A point at an element stands for what reaches half a spacing farther: so far is the wall from the lowest."""
        mesh = runner.mesh("body", recipe(shape="cylinder", method="fitted", length=0.0324, radius=0.0032,
                                          spacing=spacing))
        rim = 0 if method.points == "Nodes" else 0.0324 / round(0.0324 / spacing) / 2
        return runner.run("bar", mesh, method, self.copper, [velocity("z", -227), plane(rim)], 80e-6, 1e-6,
                          ["Max_Coordinate_Z", "Max_Radial_Distance(body_zmin)"])

    def error(self, result, method, spacing):
        history = result.history
        rim = 0 if method.points == "Nodes" else spacing / 2
        at = [np.argmin(np.abs(history["Time"] - 1e-6 * t)) for t in self.times]
        length = (history["Max_Coordinate_Z"][at] + rim) * 1e3 / self.lengths - 1
        radius = (history["Max_Radial_Distance(body_zmin)"][at] + rim) * 1e3 / self.radii - 1
        return math.sqrt(np.mean(length**2 + radius**2))


class Struts(Case):
    """Struts of an open-cell foam crushed between plates that stick, against the same at the smallest spacing by nodes and
    mean gradient: the work that the plates have done."""
    name, unit, title = "struts", "µm", "strut network in compression"
    spacings, scale = (20e-6, 14e-6, 10e-6), 1e6
    methods = [m for m in PLAIN if m.horizon < 3 or m.points == "Elements"]
    size, speed, strain, finest = 0.5e-3, 20.0, 0.06, 7e-6

    def run(self, runner, method, spacing):
        mesh = runner.mesh("struts", recipe(shape="foam", size=f"{self.size} {self.size} {self.size}", cell=0.35e-3,
                                            relative_density=0.15, seed=3, spacing=spacing))
        final_time = self.strain * self.size / self.speed

        def held(side, value):
            return section(f"{side}", parameter("Type", "Prescribed Velocity"), parameter("Node Set", f"body_{side}"),
                           parameter("Coordinate", "z"), parameter("Value", value))
        return runner.run("struts", mesh, method, Bar.copper, [held("zmin", 0), held("zmax", -self.speed)], final_time,
                          final_time, ["Max_Equivalent_Plastic_Strain"])

    def rows(self, runner):
        reference = self.run(runner, Method("Nodes", "Mean Gradient 0.01", 1.75), self.finest)
        self.work = reference.history["External_Work"][-1]
        return super().rows(runner)

    def error(self, result, method, spacing):
        return abs(result.history["External_Work"][-1] / self.work - 1)


CASES = {case.name: case for case in (Wave(), Torsion(), Bar(), Struts())}
