"""Another view of a scene: moved, turned, mirrored, later, in other units, or from a frame of reference that flies along. What a value
becomes follows from its type and its unit in the deck's schema."""
import re
from dataclasses import dataclass, field

import numpy as np

from values import Direction, Expr, Num, Place

AXES = "xyz"
UNITS = {"kg": (1, 0, 0), "m": (0, 1, 0), "s": (0, 0, 1), "Pa": (1, -1, -2), "N": (1, 1, -2), "J": (1, 2, -2), "K": (0, 0, 0)}
POWERS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")


def dimension(unit):
    """Powers of mass, length and time: kg/m³ has (1, -3, 0)."""
    total = np.zeros(3)
    for place, part in enumerate(re.sub(r"[()]", "", unit).split("/")):
        for word in part.split():
            root, name, power = re.fullmatch(r"(√?)([A-Za-z]+|1)([⁰¹²³⁴⁵⁶⁷⁸⁹]*)", word).groups()
            if name != "1":
                total += np.array(UNITS[name]) * int(power.translate(POWERS) or 1) * (0.5 if root else 1) * (1 if place == 0 else -1)
    return total


@dataclass
class Frame:
    turn: np.ndarray = field(default_factory=lambda: np.eye(3, dtype=int))  # a signed permutation
    shift: np.ndarray = field(default_factory=lambda: np.zeros(3))  # m, after the turn
    later: float = 0.0  # s
    mass: float = 1.0  # of the old unit in new ones
    length: float = 1.0
    time: float = 1.0
    speed: np.ndarray = field(default_factory=lambda: np.zeros(3))  # m/s, of all there is; not with a turn
    begin: float = 0.0  # s, when that motion has gone no way

    @property
    def mirrors(self):
        return round(np.linalg.det(self.turn)) < 0

    def scale(self, unit):
        powers = dimension(unit)
        return self.mass**powers[0] * self.length**powers[1] * self.time**powers[2]

    def places(self, points):
        return self.length * (np.asarray(points) @ self.turn.T + self.shift)

    def vectors(self, vectors):
        return np.asarray(vectors) @ self.turn.T

    def tensors(self, tensors):
        """xx, yy, zz, xy, yz, zx."""
        index = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])
        full = np.asarray(tensors)[:, index]
        turned = np.einsum("ia,nab,jb->nij", self.turn, full, self.turn)
        return turned[:, [0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]

    def axis(self, name):
        """Where an axis points now, and the sign."""
        row = int(np.flatnonzero(self.turn[:, AXES.index(name)])[0])
        return AXES[row], int(self.turn[row, AXES.index(name)])

    def old(self, name):
        """An old coordinate, or the old time, as an expression in the new ones."""
        if name == "t":
            return "t" if self.later == 0 and self.time == 1 else f"(t*{1 / self.time!r} - {self.later!r})"
        column = AXES.index(name)
        row = int(np.flatnonzero(self.turn[:, column])[0])
        sign = int(self.turn[row, column])
        if sign == 1 and row == column and self.length == 1 and self.shift[row] == 0:
            return name
        return f"({float(sign / self.length)!r}*{AXES[row]} - {float(sign * self.shift[row])!r})"

    def expression(self, value, sign=1, more=""):
        text = value.text.format(**{name: self.old(name) for name in "xyzt"})
        factor = value.factor * sign * self.scale(value.unit)
        return (f"{factor!r}*({text})" if value.unit or factor != 1 else text) + more

    def way(self, axis):
        """The displacement by the flight."""
        return f" + {float(self.speed[AXES.index(axis)])!r}*(t - {self.begin!r})" if self.speed.any() else ""

    def value(self, value):
        if isinstance(value, Num):
            scale = self.scale(value.unit)
            return [v * scale for v in value.value] if isinstance(value.value, list) else value.value * scale
        if isinstance(value, Expr):
            return self.expression(value)
        if isinstance(value, Place):
            return tuple(self.places([value.at])[0])
        if isinstance(value, Direction):
            return tuple(float(v) for v in self.vectors([value.along])[0])
        return value

    def section(self, section):
        """A tree of sections without conditions and cracks."""
        made = {name: self.section(value) if isinstance(value, dict) else self.value(value) for name, value in section.items()}
        for name in ("Initial Time", "Final Time"):
            if name in made:
                made[name] = self.time * (section[name].value + self.later)
        return made

    def condition(self, name, condition):
        """As one or several conditions by name: one along several axes may need two signs, or as many values."""
        if condition["Type"] == "Periodic Sides":
            return {name: self.sides(condition)}
        if "Coordinate" in condition:
            return self.along_axes(name, condition)
        turned = {}
        for key, value in condition.items():
            if re.fullmatch(r"(Travel|Speed|Force) [XYZ]", key):
                axis, sign = self.axis(key[-1].lower())
                if isinstance(value, Expr):
                    turned[f"{key[:-1]}{axis.upper()}"] = self.expression(value, sign)
                else:
                    turned[f"{key[:-1]}{axis.upper()}"] = sign * self.value(value)
            else:
                turned[key] = self.value(value)
        if "Lower Corner" in turned:
            ends = np.sort([turned["Lower Corner"], turned["Upper Corner"]], axis=0)
            turned["Lower Corner"], turned["Upper Corner"] = (tuple(float(v) for v in end) for end in ends)
        if turned["Type"].startswith("Rigid") and self.speed.any():
            for axis in AXES:
                key = f"Speed {axis.upper()}" if "Mass" in turned else f"Travel {axis.upper()}"
                rest = turned.get(key, 0.0)
                turned[key] = rest + float(self.speed[AXES.index(axis)]) if "Mass" in turned else f"{rest}{self.way(axis)}"
        return {name: turned}

    def sides(self, condition):
        axis, sign = self.axis(condition["Coordinate"])
        at = lambda key: float(self.length * (sign * condition[key].value + self.shift[AXES.index(axis)]))
        lower, upper = sorted((at("Lower"), at("Upper")))
        made = {key: self.value(value) for key, value in condition.items()}
        return made | {"Coordinate": axis, "Lower": lower, "Upper": upper}

    def along_axes(self, name, condition):
        made = {}
        for old in condition["Coordinate"]:
            axis, sign = self.axis(old)
            more = ""
            if self.speed.any():
                flight = f" + {float(self.speed[AXES.index(axis)])!r}"
                more = {"Prescribed Displacement": self.way(axis), "Prescribed Velocity": flight, "Initial Velocity": flight}.get(condition["Type"], "")
            made.setdefault((sign, more), []).append(axis)
        parts = {}
        for n, ((sign, more), axes) in enumerate(made.items()):
            part = {key: self.value(value) for key, value in condition.items()}
            part["Coordinate"] = "".join(axes)
            part["Value"] = self.expression(condition["Value"], sign, more)
            parts[name if n == 0 else f"{name} {n + 1}"] = part
        return parts

    def cut(self, cut):
        """A crack that is there from the start."""
        triple = lambda prefix: np.array([cut[f"{prefix}_{a}"].value for a in "XYZ"], float)
        put = lambda prefix, vector: {f"{prefix}_{a}": float(v) for a, v in zip("XYZ", vector)}
        normal = self.vectors([triple("Normal")])[0]
        made = {"Type": cut["Type"]}
        if cut["Type"] == "Disk":
            made |= put("Normal", normal) | put("Center", self.places([triple("Center")])[0])
        else:  # its other edge is along this one × normal, which a mirror would turn round
            made |= put("Normal", -normal if self.mirrors else normal)
            made |= put("Lower_Left_Corner", self.places([triple("Lower_Left_Corner")])[0])
            made |= put("Bottom_Unit_Vector", self.vectors([triple("Bottom_Unit_Vector")])[0])
        return made | {key: self.value(v) for key, v in cut.items() if key.endswith(("Length", "Radius"))}
