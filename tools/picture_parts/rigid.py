"""The rigid tools of a deck: their surfaces near the bodies, and where they are at a time."""
import itertools

import numpy as np
from decks import Deck, integrals, list_in, value_at, value_in
from scipy.integrate import cumulative_trapezoid
from strut_tools import fail, history
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkCylinderSource

from .surface import places_of

ARC = 48       # sides of a cylinder
MARGIN = 0.15  # of the bodies' size: how far beyond them the picture reaches for tools


class Tool:
    def __init__(self, name, keys, deck):
        self.name, self.keys, self.deck = name, keys, deck
        self.kind = value_in(keys, "Type")
        self.mass = self.number("Mass", None)
        self.flight = None
        if self.mass is not None:  # its path follows from the forces on it in the deck's history
            if self.deck.section("Start From") is not None:
                print(f"the tool '{name}' is drawn as if it began where the deck has it; it is elsewhere if the steps of the run before go on (Start From with "
                      "the same conditions)")
            table = history(self.deck.get("History", "Filename", default="a History, which this tool needs,"))
            self.flight = table["Time"], [self._way(c, table["Time"], table) for c in "XYZ"]

    def number(self, key, default):
        text = value_in(self.keys, key)
        return default if text is None else self._at(key, text, 0)

    def _at(self, key, text, t):
        found = value_at(text, t)
        if found is None:
            fail(f"{self.deck.path}: Boundary Conditions > {self.name} > {key}: '{text}' is no number at t = {t:g} s, or not one of the time alone")
        return found

    def vector(self, key):
        return np.array([self._at(key, word, 0) for word in list_in(self.keys, key)])

    def offset(self, t):
        """How far it has gone at the time t (s), m."""
        if self.flight is not None:
            times, way = self.flight
            return np.array([np.interp(t, times, w) for w in way])
        travel = [(f"Travel {c}", value_in(self.keys, f"Travel {c}")) for c in "XYZ"]
        return np.array([0.0 if text is None else self._at(key, text, t) for key, text in travel])

    def _way(self, c, times, table):
        """Its displacement along an axis at these times."""
        force = value_in(self.keys, f"Force {c}")
        speed = self.number(f"Speed {c}", 0.0)
        column = f"Reaction_{c}({self.name})"
        if column not in table and (speed or force):
            fail(f"where the tool '{self.name}' is drawn follows from {column}: add it to the deck's History")
        # The column has the forces on the bodies, as means from row to row. The tool rests in equilibria.
        flown = np.maximum(times, self._start())
        impulse = -np.cumsum(table.get(column, np.zeros(len(times))) * np.diff(flown, prepend=flown[0]))
        if force:
            of_force = integrals(force, flown[0], flown)
            if of_force is None:
                fail(f"{self.deck.path}: Boundary Conditions > {self.name} > Force {c}: '{force}' has no integral over the time alone, or no finite one")
            impulse = impulse + of_force
        return cumulative_trapezoid(speed + impulse / self.mass, flown, initial=0)

    def _start(self):
        """When explicit steps begin that follow equilibria (Solver 2), s."""
        if self.deck.section("Solver 2") is None:
            return -np.inf
        return self._at("Final Time", self.deck.get("Solver", "Final Time", default=""), 0)

    def surface(self, low, high):
        """The part of it near the box of the bodies (corners, m), before it travels."""
        if self.kind == "Rigid Box":
            return block(self.vector("Lower Corner"), self.vector("Upper Corner"))
        point, axes = self.vector("Point"), axes_along(self.vector("Axis" if self.kind == "Rigid Cylinder" else "Normal"))
        margin = MARGIN * np.max(high - low)
        along = np.array(list(itertools.product(*zip(low, high))) - point) @ axes.T  # the corners of the box
        lower, upper = along.min(axis=0) - margin, along.max(axis=0) + margin
        if self.kind == "Rigid Cylinder":
            return roll(point + 0.5 * (lower[2] + upper[2]) * axes[2], axes, upper[2] - lower[2], self.number("Radius", 0))
        lower[2], upper[2] = -0.2 * margin, 0  # the front of a half space: a thin plate behind its plane
        return block(lower, upper, point, axes)


def tools_of(path):
    deck = Deck(path)
    found = [Tool(name, keys, deck) for name, keys in deck.sections("Boundary Conditions").items()
             if value_in(keys, "Type") in ("Rigid Plane", "Rigid Cylinder", "Rigid Box")]
    if not found:
        fail(f"{path} has no rigid tools")
    return found


def axes_along(direction):
    """Three unit vectors, right-handed, of which the last is along the direction."""
    w = direction / np.linalg.norm(direction)
    u = np.cross(w, np.eye(3)[np.abs(w).argmin()])
    u /= np.linalg.norm(u)
    return np.stack([u, np.cross(w, u), w])


def placed(source, origin, axes):
    """The surface of a source of VTK whose own axes are these (rows), through the origin."""
    source.SetOutputPointsPrecision(vtkAlgorithm.DOUBLE_PRECISION)
    source.Update()
    places = places_of(source.GetOutput())
    places[:] = origin + places @ axes
    return source.GetOutput()


def block(lower, upper, origin=np.zeros(3), axes=np.eye(3)):
    """A box along axes (rows) through the origin."""
    cube = vtkCubeSource()
    cube.SetBounds(*np.stack([lower, upper], axis=1).ravel())
    return placed(cube, origin, axes)


def roll(middle, axes, length, radius):
    """A cylinder along the last of the axes."""
    cylinder = vtkCylinderSource()  # along its own y
    cylinder.SetHeight(length)
    cylinder.SetRadius(radius)
    cylinder.SetResolution(ARC)
    return placed(cylinder, middle, np.roll(axes, -1, axis=0))
