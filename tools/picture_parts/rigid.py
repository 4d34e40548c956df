"""The rigid tools of a deck: their surfaces near the bodies, and their positions over time."""
import numpy as np
from decks import Deck, value_at, value_in
from strut_tools import fail

from . import history
from .surface import FACES, Surface, joined

ARC = 48       # quads around a cylinder
MARGIN = 0.15  # of the bodies' size: margin around them in which tools are drawn
NO_POINT = -1  # point number of the quads of a tool


class Tool:
    def __init__(self, name, keys, deck):
        self.name, self.keys, self.deck = name, keys, deck
        self.kind = value_in(keys, "Type")
        self.mass = self.number("Mass", None)
        self.flight = None if self.mass is None else self._flight()

    def number(self, key, default):
        text = value_in(self.keys, key)
        return default if text is None else self._at(key, text, 0)

    def _at(self, key, text, t):
        found = value_at(text, t)
        if found is None:
            fail(f"{self.deck.path}: Boundary Conditions > {self.name} > {key}: '{text}' is no number at t = {t:g} s, or not one of the time alone")
        return found

    def vector(self, key):
        return np.array([self._at(key, word, 0) for word in value_in(self.keys, key).split()])

    def offset(self, t):
        """Displacement at the time t (s), m."""
        if self.flight is not None:
            times, way = self.flight
            return np.array([np.interp(t, times, w) for w in way])
        travel = [(f"Travel {c}", value_in(self.keys, f"Travel {c}")) for c in "XYZ"]
        return np.array([0.0 if text is None else self._at(key, text, t) for key, text in travel])

    def _flight(self):
        """Motion of a tool with a mass, from the forces in the deck's history: times, and displacement by axis."""
        table = history.history(self.deck.get("History", "Filename", default="a History, which this tool needs,"))
        times = table["Time"]
        return times, [self._way(c, times, table) for c in "XYZ"]

    def _way(self, c, times, table):
        force = value_in(self.keys, f"Force {c}")
        speed = self.number(f"Speed {c}", 0.0)
        column = f"Reaction_{c}({self.name})"
        if column not in table and (speed or force):
            fail(f"where the tool '{self.name}' is drawn follows from {column}: add it to the deck's History")
        # The column is the force on the bodies, as means between rows.
        impulse = -np.cumsum(table.get(column, np.zeros(len(times))) * np.diff(times, prepend=times[0]))
        if force:
            impulse = impulse + integral(times, np.array([self._at(f"Force {c}", force, t) for t in times]))
        return integral(times, speed + impulse / self.mass)

    def surface(self, low, high):
        """The part of its surface near the box of the bodies (corners, m), before it travels."""
        if self.kind == "Rigid Plane":
            return slab(self.vector("Point"), self.vector("Normal"), low, high)
        if self.kind == "Rigid Cylinder":
            return roll(self.vector("Point"), self.vector("Axis"), self.number("Radius", 0), low, high)
        return block(self.vector("Lower Corner"), self.vector("Upper Corner"))


def tools_of(path):
    deck = Deck(path)
    found = [Tool(name, keys, deck) for name, keys in deck.sections("Boundary Conditions").items()
             if value_in(keys, "Type") in ("Rigid Plane", "Rigid Cylinder", "Rigid Box")]
    if not found:
        fail(f"{path} has no rigid tools")
    return found


def integral(times, values):
    """Integral from the first time on, by the trapezoidal rule."""
    return np.concatenate([[0], np.cumsum(0.5 * np.diff(times) * (values[1:] + values[:-1]))])


def flat(quads):
    """Quads (array of m x 4 x 3) with separate corners, so that shading does not round their edges."""
    quads = np.asarray(quads, float)
    return Surface(quads.reshape(-1, 3), np.arange(4 * len(quads)).reshape(-1, 4), np.full(len(quads), NO_POINT))


def block(lower, upper, origin=np.zeros(3), axes=np.eye(3)):
    """A box along axes (rows, right-handed) through the origin."""
    corners = np.array([face for _, face in FACES]) * (upper - lower) + lower
    return flat(origin + corners @ axes)


def axes_along(direction):
    """Three right-handed unit vectors, the last one along the direction."""
    w = direction / np.linalg.norm(direction)
    u = np.cross(w, np.eye(3)[np.abs(w).argmin()])
    u /= np.linalg.norm(u)
    return np.stack([u, np.cross(w, u), w])


def box_along(axes, origin, low, high):
    """The extent of the bodies' box, with a margin, along the axes from the origin."""
    margin = MARGIN * np.max(high - low)
    corners = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    along = (corners - origin) @ axes.T
    return along.min(axis=0) - margin, along.max(axis=0) + margin


def slab(point, normal, low, high):
    """The front of a half-space: a thin plate behind its plane."""
    axes = axes_along(normal)
    lower, upper = box_along(axes, point, low, high)
    lower[2], upper[2] = -0.2 * MARGIN * np.max(high - low), 0
    return block(lower, upper, point, axes)


def roll(point, axis, radius, low, high):
    axes = axes_along(axis)
    lower, upper = box_along(axes, point, low, high)
    angles = 2 * np.pi * np.arange(ARC) / ARC
    ring = radius * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    ends = [point + (ring + [0, 0, z]) @ axes for z in (lower[2], upper[2])]
    after = np.roll(np.arange(ARC), -1)
    sides = Surface(np.concatenate(ends), np.stack([np.arange(ARC), after, after + ARC, np.arange(ARC) + ARC], axis=1),
                    np.full(ARC, NO_POINT))
    caps = []
    for end, z, turned in zip(ends, (lower[2], upper[2]), (True, False)):
        middle = np.broadcast_to(point + z * axes[2], end.shape)
        caps.append(flat(np.stack([middle, end[after], end, middle] if turned else [middle, end, end[after], middle], axis=1)))
    return joined([sides, *caps])
