"""A result (Exodus II) of material points: names, frames and columns, read on demand."""
import collections
import os

import exodus
import numpy as np
from exodus import names_in
from strut_tools import fail, nearest

UNITS = {"Displacement": "m", "Velocity": "m/s", "Stress": "Pa", "Energy": "J", "Work": "J", "Distance": "m"}


def unit_of(name):
    if name.startswith("Reaction_"):
        return "N"
    name = name.split("(")[0]
    return next((unit for ending, unit in UNITS.items() if name.rstrip("XYZ").endswith(ending)), "")


def title(name):
    """Von_Mises_Stress -> "Von Mises Stress, Pa"."""
    unit = unit_of(name)
    return name.replace("_", " ") + (f", {unit}" if unit else "")


def clock_of(longest):
    """Factor and unit for times up to `longest` (s): slow loading takes seconds or more."""
    return (1, "s") if longest >= 0.5 else (1e3, "ms") if longest >= 1e-4 else (1e6, "µs")


def stem(path):
    return os.path.splitext(os.path.basename(path))[0]


def without_components(names):
    """DisplacementX, -Y, -Z -> Displacement."""
    vectors = {n[:-1] for n in names if n[-1] == "X" and n[:-1] + "Y" in names and n[:-1] + "Z" in names}
    return list(dict.fromkeys(n[:-1] if n[-1] in "XYZ" and n[:-1] in vectors else n for n in names))


Block = collections.namedtuple("Block", "name number nodes volumes")


class Result:
    """Values are per node, and each node is a point; columns of a frame are read on demand."""

    def __init__(self, path):
        self.path, self.file = path, exodus.opened(path)
        if "num_nodes" not in self.file.dimensions or len(self.file.variables.get("time_whole", [])) == 0:
            fail(f"{path} is not a result: it has no nodes or no frames")
        self.times = times = np.array(self.file.variables["time_whole"][:])
        if not (np.diff(times) > 0).all():
            late = 1 + int(np.argmin(np.diff(times) > 0))
            fail(f"{path} is damaged: frame {late + 1} of {len(times)} is at t = {times[late]:g} s, the one before at {times[late - 1]:g} s")
        self.reference = np.stack([self.file.variables["coord" + c][:] for c in "xyz"], axis=1)
        self.nodal, self.elemental = names_in(self.file, "name_nod_var"), names_in(self.file, "name_elem_var")
        self.names = without_components(self.nodal + self.elemental)
        names = names_in(self.file, "eb_names") or [""] * len(self.file.dimensions["num_el_blk"])
        self.blocks = [self._block(number, name or f"block_{number}") for number, name in enumerate(names, 1)]

    def _block(self, number, name):
        if f"connect{number}" not in self.file.variables:
            return Block(name, number, np.zeros(0, int), np.zeros(0))
        nodes = self.file.variables[f"connect{number}"][:]
        if nodes.shape[1] != 1:
            fail(f"{self.path} is not a result of points: an element of block '{name}' has {nodes.shape[1]} nodes")
        attributes = self.file.variables.get(f"attrib{number}")
        known = attributes is not None and attributes.shape[1] > 1
        return Block(name, number, nodes[:, 0] - 1, np.array(attributes[:, 1]) if known else None)

    def blocks_of(self, names):
        """The blocks of these names; without names all."""
        known = [block.name for block in self.blocks]
        for name in names or ():
            if name not in known:
                fail(f"{self.path} has no block '{name}'{nearest(name, known)}; it has {', '.join(known)}")
        return [block for block in self.blocks if not names or block.name in names]

    def has(self, name):
        return name in self.names or name in self.nodal

    def values(self, name, frame):
        """A variable; for a vector its magnitude. NaN where the variable is not defined."""
        if name in self.nodal:
            return self._column(name, frame)
        if name + "X" in self.nodal and name + "Y" in self.nodal and name + "Z" in self.nodal:
            return np.sqrt(sum(self._column(name + c, frame)**2 for c in "XYZ"))
        if name not in self.elemental:
            near = nearest(name, self.names + self.nodal, 0.5)
            fail(f"{self.path} has no variable '{name}'{near}; it has {', '.join(self.names) or 'none'}")
        value = np.full(len(self.reference), np.nan)
        for block in self.blocks:
            column = f"vals_elem_var{self.elemental.index(name) + 1}eb{block.number}"
            if column in self.file.variables:
                value[block.nodes] = self.file.variables[column][frame]
        return value

    def _column(self, name, frame):
        return np.array(self.file.variables[f"vals_nod_var{self.nodal.index(name) + 1}"][frame])

    def displacement(self, frame):
        if any("Displacement" + c not in self.nodal for c in "XYZ"):
            fail(f"{self.path} has no variable Displacement: add it to Output Variables")
        return np.stack([self._column("Displacement" + c, frame) for c in "XYZ"], axis=1)
