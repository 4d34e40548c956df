"""The values of each key of the deck in a scene: a table by key, with ranges that keep small scenes lively (some percent of strain,
some tens of steps). A key or choice of the schema that is neither here nor in NOT_DRAWN fails the test.

Units are those of the schema; a `c` is what a scene has drawn so far (scenes.Draft): c.h spacing, c.E, c.nu, c.rho, c.flow a flow
stress, c.speed, c.time the length of the run."""
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Num:
    """A number, or several, with a unit of the schema."""
    value: object
    unit: str = ""


@dataclass(frozen=True)
class Expr:
    """An expression of the deck in {x}, {y}, {z}, {t}, right in Python, too; `factor` in `unit`."""
    text: str
    factor: float = 1.0
    unit: str = ""

    def times(self, number):
        return replace(self, factor=self.factor * number)


@dataclass(frozen=True)
class Place:
    at: tuple


@dataclass(frozen=True)
class Direction:
    along: tuple


class Not:
    """A key that is not drawn, or seldom is another thing than what a scene needs, with the reason."""
    def __init__(self, reason):
        self.reason = reason


FILES = Not("names a file; scenes name theirs themselves")
OTHER = Not("without effect, or of another program's dialect: regression/deck/test_peridigm")
WRITTEN = Not("what is written, not what is computed: test_schedule, test_means, test_crack_tip")
WATCHED = Not("when a run ends that has gone wrong: test_monitor")
COMPOSED = Not("drawn by scenes.py, which knows the bodies")


def uniform(low, high, unit=""):
    return lambda c: Num(c.uniform(low, high), unit)


def moduli(c):
    """Consistent ones, of which two are given."""
    E, nu = c.E, c.nu
    return {"Bulk Modulus": E / (3 * (1 - 2 * nu)), "Shear Modulus": E / (2 * (1 + nu)), "Young's Modulus": E, "Poisson's Ratio": nu}


def modulus(name):
    return lambda c: Num(moduli(c)[name], "" if name.startswith("P") else "Pa")


def of(name, low, high, unit=""):
    """In parts of what the scene has by that name."""
    return lambda c: Num(getattr(c, name) * c.uniform(low, high), unit)


def speed(c):
    return Num(c.speed * c.uniform(-1, 1), "m/s")


def travel(c):
    """Begins slowly: it goes as t² first."""
    return Expr("(1 - cos(3*({t} - BEGIN)/TIME))", c.speed * c.time / 3 * c.uniform(-1, 1), "m")


def force(c):
    return Expr("1", c.E * c.h**2 * c.uniform(-1e-2, 1e-2), "N")


# By "case or section > key", or the key alone.
VALUES = {
    "Relaxation > Fractions": lambda c: Num([c.uniform(0.1, 0.4), c.uniform(0.1, 0.4)], ""),
    "Relaxation > Times": lambda c: Num([c.time * c.uniform(0.05, 0.5), c.time * c.uniform(0.5, 5)], "s"),
    # Materials
    "Density": lambda c: Num(c.rho, "kg/m³"),
    **{name: modulus(name) for name in ("Bulk Modulus", "Shear Modulus", "Young's Modulus", "Poisson's Ratio")},
    "Thermal Expansion Coefficient": uniform(1e-6, 3e-5, "1/K"),
    "Stabilization Coefficient": uniform(0.005, 0.4),
    "Linear Viscosity": uniform(0.02, 0.1),
    "Quadratic Viscosity": uniform(0.5, 1.5),
    "Yield Stress": lambda c: Num(c.flow, "Pa"),
    "Shear Modulus Slope": uniform(1e-5, 5e-4, "1/K"),
    "Elastic Plastic Correspondence > Shear Modulus Temperature": uniform(250, 300, "K"),
    "Hardening Modulus": of("E", 0.0, 0.1, "Pa"),
    "Reference Strain": uniform(1e-3, 1e-2),
    "Power Law > Exponent": uniform(0.05, 0.4),
    "Needleman > Exponent": uniform(0.05, 0.2),
    "Softening Strain": uniform(0.05, 0.5),
    "Modulus": of("flow", 0.2, 3, "Pa"),
    "Exponent": uniform(0.3, 1),
    "Saturation Stress": of("flow", 0.2, 2, "Pa"),
    "Voce > Saturation Rate": uniform(5, 50),
    "Table > Strains": lambda c: Num([0.0, 2e-3, 1e-2], ""),
    "Table > Stresses": lambda c: Num([c.flow, 1.2 * c.flow, 1.6 * c.flow], "Pa"),
    "Reference Rate": uniform(100, 2000, "1/s"),
    "Coefficient": uniform(0.01, 0.1),
    "Athermal Stress": of("flow", 0.2, 0.6, "Pa"),
    "Thermal Stress": of("flow", 1, 3, "Pa"),
    "Thermal Exponent": uniform(0, 0.5),
    "Softening": uniform(5e-4, 3e-3, "1/K"),
    "Rate Softening": uniform(1e-5, 1e-4, "1/K"),
    "Initial Threshold": of("flow", 0.5, 1, "Pa"),
    "Cold Shear Modulus": of("E", 0.4, 0.45, "Pa"),
    "Shear Modulus Drop": of("E", 0.01, 0.03, "Pa"),
    "Shear Modulus Temperature": uniform(150, 250, "K"),
    "Burgers Vector": lambda c: Num((4e-21 / (c.uniform(0.02, 0.05) * 0.4 * c.E)) ** (1 / 3), "m"),
    "Activation Energy": uniform(0.5, 1.5),
    "Mechanical Threshold > Reference Rate": uniform(1e7, 1e8, "1/s"),
    "P": uniform(0.5, 1),
    "Q": uniform(1, 1.5),
    "Mechanical Threshold > Hardening Modulus": of("E", 0.01, 0.05, "Pa"),
    "Hardening Modulus of Log Rate": of("E", 0, 1e-3, "Pa"),
    "Hardening Modulus of Root Rate": of("E", 0, 1e-5, "Pa √s"),
    "Curvature": uniform(1, 3),
    "Saturation Threshold": of("flow", 1.5, 4, "Pa"),
    "Saturation Energy": uniform(0.2, 0.6),
    "Mechanical Threshold > Saturation Rate": uniform(1e7, 1e8, "1/s"),
    "Johnson-Cook > Reference Temperature": uniform(280, 300, "K"),
    "Johnson-Cook > Melting Temperature": uniform(900, 1300, "K"),
    "Specific Heat": uniform(0.05, 0.4, "J/(kg K)"),  # warm within percents of strain
    "Taylor-Quinney Coefficient": uniform(0.5, 1),
    "Sound Speed": lambda c: Num((moduli(c)["Bulk Modulus"] / c.rho) ** 0.5 * c.uniform(0.8, 1.2), "m/s"),
    "Hugoniot Slope": uniform(1, 2),
    "Gruneisen Parameter": uniform(1, 2),
    "Tait > Exponent": uniform(2, 7),
    "Alpha": uniform(0.1, 2.1),
    "Plastic Poisson's Ratio": uniform(0, 0.4),
    "Plateau Stress": lambda c: Num(c.flow, "Pa"),
    "Linear Hardening": of("flow", 0, 3, "Pa"),
    "Locking Stress": of("flow", 0, 3, "Pa"),
    "Locking Exponent": uniform(2, 5),
    "Densification Strain": uniform(1, 2),
    "Solid Density": of("rho", 4, 9, "kg/m³"),
    "Metal Foam Correspondence > Failure Strain": uniform(2e-3, 2e-2),
    "Compacted Young's Modulus": of("E", 1.5, 3, "Pa"),
    "Compacted Poisson's Ratio": uniform(0.2, 0.4),
    "Relative Density": uniform(0.1, 0.6),
    "Density Exponent": uniform(0.5, 2),
    "Tension Ratio": uniform(0.5, 2),
    "Uniaxial Yield Stress": of("flow", 0.3, 0.5, "Pa"),
    "Hydrostatic Yield Stress": of("flow", 0.3, 0.6, "Pa"),
    "Uniaxial Hardening > Strains": lambda c: Num([0.0, 0.05, 0.2], ""),
    "Uniaxial Hardening > Stresses": lambda c: Num([0.0, 0.1 * c.flow, 0.3 * c.flow], "Pa"),
    "Hydrostatic Hardening > Strains": lambda c: Num([0.0, 0.05, 0.2], ""),
    "Hydrostatic Hardening > Stresses": lambda c: Num([0.0, 0.2 * c.flow, 0.5 * c.flow], "Pa"),
    # Damage models: strains of some percent break some bonds.
    "Critical Stretch": uniform(3e-3, 3e-2),
    "Critical Stretch > Fracture Energy": lambda c: Num(c.E * c.h * c.uniform(3e-3, 3e-2) ** 2, "J/m²"),
    "Time Dependent Critical Stretch": lambda c: Expr("(1 + sin(7*({t} - BEGIN)/TIME)/3)", c.uniform(5e-3, 3e-2), ""),
    "Critical Bond Energy": lambda c: Num(c.E / c.h**3 * c.uniform(3e-3, 3e-2) ** 2 * 0.1, "J/m⁶"),
    "Bond Energy > Fracture Energy": lambda c: Num(c.E * c.h * c.uniform(3e-3, 3e-2) ** 2, "J/m²"),
    "Plastic Strain > Failure Strain": uniform(3e-3, 3e-2),
    "Fracture Energy": lambda c: Num(c.flow * c.h * c.uniform(0, 0.03), "J/m²"),
    "Averaging Radius": lambda c: Num(c.h * c.uniform(0.5, 3), "m"),
    "D1": uniform(1e-3, 2e-2),
    "D2": uniform(1e-3, 2e-2),
    "D3": uniform(-3, -0.5),
    "D4": uniform(0.001, 0.02),
    "D5": uniform(0.1, 1),
    "Reference Strain Rate": uniform(1, 1000, "1/s"),
    "Critical Work": of("flow", 3e-3, 3e-2, "Pa"),
    # Blocks
    "Horizon": lambda c: Num(c.h * c.reach, "m"),
    "Horizon Factor": lambda c: Num(c.reach, ""),
    "Initial Temperature": uniform(290, 600, "K"),
    # Contact
    "Friction Coefficient": uniform(0.05, 0.6),
    "Stiffness Factor": uniform(0.1, 0.5),
    "Largest Overlap": uniform(0.3, 0.9),
    "Contact Radius": of("h", 0.93, 1.23, "m"),
    "Spring Constant": of("E", 0.5, 2, "Pa"),
    "Effective Modulus": of("E", 0.5, 2, "Pa"),
    # Rigid tools
    **{f"Travel {axis}": travel for axis in "XYZ"},
    **{f"Speed {axis}": speed for axis in "XYZ"},
    **{f"Force {axis}": force for axis in "XYZ"},
    "Mass": lambda c: Num(c.rho * c.h**3 * c.uniform(5, 100), "kg"),
    # Solver
    "Safety Factor": uniform(0.4, 0.9),
    "Rebalance": uniform(1.01, 1.3),
}

# Choices and switches: with the schema's own list, each with the same chance, unless scenes.py has a say.
NOT_DRAWN = {
    "Discretization > Input Mesh File": FILES,
    "Discretization > Degenerate Points": Not("points that are left out: unit tests of set-up"),
    "Discretization > Bond Filters > (any name)": COMPOSED,
    "Discretization > TensorProduct3DMeshGenerator": COMPOSED,
    "Discretization > Type": COMPOSED,
    "Start From": Not("the end of another run: a relation, regression/python/starts.py"),
    "Solver 2": Not("steps after equilibria: a relation, regression/run/test_two_solvers"),
    **{f"Materials > (any name) > {key}": Not("fits two elastic constants only: contract/test_hyperelastic")
       for key in ("C10", "C01", "Ogden Moduli", "Ogden Exponents")},
    "Node Sets > (any name)": COMPOSED,
    "Blocks > (any name) > Block Names": COMPOSED,
    "Blocks > (any name) > Material": COMPOSED,
    "Blocks > (any name) > Damage Model": COMPOSED,
    "Contact > Interactions > (any name)": COMPOSED,
    "Boundary Conditions > (any name)": COMPOSED,  # sets of points by number are Peridigm's dialect
    "Boundary Conditions > (any name) > Node Set": COMPOSED,
    "Boundary Conditions > (any name) > Coordinate": COMPOSED,
    "Boundary Conditions > (any name) > Value": COMPOSED,
    "Boundary Conditions > (any name) > Point": COMPOSED,
    "Boundary Conditions > (any name) > Normal": COMPOSED,
    "Boundary Conditions > (any name) > Axis": COMPOSED,
    "Boundary Conditions > (any name) > Radius": COMPOSED,
    "Boundary Conditions > (any name) > Lower": COMPOSED,
    "Boundary Conditions > (any name) > Upper": COMPOSED,
    "Boundary Conditions > (any name) > Stretch": COMPOSED,
    "Boundary Conditions > (any name) > Lower Corner": COMPOSED,
    "Boundary Conditions > (any name) > Upper Corner": COMPOSED,
    "Solver > Initial Time": COMPOSED,
    "Solver > Final Time": COMPOSED,
    "Solver > Wall Time": Not("when a run ends: regression/checkpoint"),
    "Solver > Verbose": Not("what is told"),
    "Solver > Verlet > Fixed dt": COMPOSED,
    "Solver > Verlet > Mass Scaling dt": Not("the added mass follows from an estimate within 1 %, which a pair may not share: regression/integrators/test_mass_scaling"),
    "Solver > Verlet > Most Added Mass": Not("the same"),
    "Solver > QuasiStatic > Number of Load Steps": COMPOSED,
    "Solver > QuasiStatic > Tolerance": COMPOSED,
    "Solver > QuasiStatic > Maximum Solver Iterations": Not("when a load step is cut: test_quasi_static"),
    "Output": WRITTEN,
    "History": WRITTEN,
    "Restart": Not("scenes are broken off and continued by a relation"),
    "Watch": WATCHED,
    "Verbose": OTHER,
    "Discretization > NeighborhoodType": OTHER,
    "Discretization > Verbose": OTHER,
}

# So many of these are given, of the case or section named.
GROUPS = {
    "Materials > (any name)": [(2, ("Bulk Modulus", "Shear Modulus", "Young's Modulus", "Poisson's Ratio"))],
    "Metal Foam Correspondence": [(1, ("Alpha", "Plastic Poisson's Ratio")), (1, ("Densification Strain", "Solid Density"))],
    "Critical Stretch": [(1, ("Critical Stretch", "Fracture Energy"))],
    "Bond Energy": [(1, ("Critical Bond Energy", "Fracture Energy"))],
    "Blocks > (any name)": [(1, ("Horizon", "Horizon Factor"))],
}

# Choices that no scene has, with what tests them.
CHOICES_NOT_DRAWN = {
    "Discretization > Type": {"Memory": "regression/python"},
    "Materials > (any name) > Material Model": {"User Library": "regression/materials/test_user_library"},
}
