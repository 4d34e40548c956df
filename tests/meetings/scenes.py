"""Scenes drawn at random from the deck's schema: bodies of some cells, what they are made of, what acts on them."""
import copy
import random
from dataclasses import dataclass, field
from xml.sax.saxutils import escape, quoteattr

import numpy as np

import mesh
from frame import AXES, Frame, dimension
from schema import ANY
from values import GROUPS, NOT_DRAWN, VALUES, Direction, Expr, Num, Place

MOTIONS = ("Prescribed Displacement", "Prescribed Velocity")
TOOLS = ("Rigid Plane", "Rigid Cylinder", "Rigid Box")
REACTING = (*MOTIONS, *TOOLS, "Symmetry Plane")
STEPS_A_FRAME = 4  # frames a run has, besides the first one


@dataclass
class Scene:
    deck: dict  # sections of numbers with units (values.py)
    mesh: mesh.Mesh
    h: float  # m, the smallest spacing
    modulus: float  # Pa, of the stiffest material
    speed: float  # m/s, of waves
    bodies: list  # boxes
    about: dict = field(default_factory=dict)  # what else relations want to know

    def copy(self):
        return copy.deepcopy(self)

    @property
    def conditions(self):
        return self.deck["Boundary Conditions"]

    @property
    def explicit(self):
        return "QuasiStatic" not in self.deck["Solver"]

    @property
    def begin(self):
        return self.deck["Solver"]["Initial Time"].value

    @property
    def end(self):
        return self.deck["Solver"]["Final Time"].value

    def has(self, *types):
        return any(c["Type"] in types for c in self.conditions.values())

    def fixed_step(self, dt):
        made = self.copy()
        made.deck["Solver"]["Verlet"] = {"Fixed dt": Num(dt, "s")}
        return made

    def density_of_block(self, number):
        for section in self.deck["Blocks"].values():
            if f"block_{number}" in section["Block Names"].split():
                return self.deck["Materials"][section["Material"]]["Density"].value

    @property
    def is_long(self):
        return self.about.get("long", False)

    @property
    def is_quadratic(self):
        return any(m.get("Formulation", "").startswith("Quadratic") for m in self.deck["Materials"].values())

    def summary(self):
        """In some words, for whoever reads of a failure."""
        materials = {f"{m['Material Model'].removesuffix(' Correspondence')}{' quadratic' if m.get('Formulation', '').startswith('Quadratic') else ''}"
                     for m in self.deck["Materials"].values()}
        words = [self.mesh.kind + (" nodes" if self.mesh.at_nodes else ""), *sorted(materials)]
        words += [f"breaks by {m['Damage Model']}" for m in self.deck.get("Damage Models", {}).values()]
        words += [m["Contact Model"] + (" with friction" if "Friction Coefficient" in m else "") for m in self.deck.get("Contact", {}).get("Models", {}).values()]
        words += sorted({c["Type"] for c in self.conditions.values()})
        words.append("equilibria" if not self.explicit else "fixed steps" if "Fixed dt" in self.deck["Solver"].get("Verlet", {}) else "steps")
        return "; ".join(words)

    def masses(self):
        """Masses of the sites. A node that blocks share belongs to the first of them in the file (src/io/README.md)."""
        density = {b: self.density_of_block(b) for b in set(self.mesh.blocks)}
        return np.array([density[b] for b in self.mesh.owners()]) * self.mesh.site_volumes()

    def probed(self):
        """The place of a site."""
        return self.mesh.sites()[len(self.mesh.sites()) // 3]

    def members(self, name):
        """Which sites a set or block has: a function of place."""
        at = self.mesh.sites()
        if name == "all":
            return np.ones(len(at), bool)
        if name.startswith("block_"):
            return self.mesh.owners() == int(name[6:])
        if name in self.deck["Node Sets"]:
            return np.broadcast_to(evaluated(self.deck["Node Sets"][name], at, 0) != 0, len(at)).copy()
        nodes = np.zeros(len(self.mesh.nodes), bool)
        nodes[self.mesh.sets[name]] = True
        return nodes if self.mesh.at_nodes else nodes[self.mesh.hexahedra].any(axis=1)


def evaluated(expression, at, t):
    names = {"x": at[:, 0], "y": at[:, 1], "z": at[:, 2], "t": t, "sin": np.sin, "cos": np.cos, "fabs": np.fabs, "exp": np.exp}
    return expression.factor * eval(expression.text.format(x="x", y="y", z="z", t="t"), {"__builtins__": {}}, names) * np.ones(len(at))


# ---- what a schema has that the table does not


def without_a_range(schema):
    """Keys of the schema for which values.py has neither a range nor a reason."""
    missing = []
    for section in schema.within():
        where = f"{section.path} > " if section.path else ""
        if any((section.path + " >").startswith(path + " >") for path in NOT_DRAWN if path):
            continue
        for key in section.keys.values():
            known = (key.without_effect or key.kind in ("choice", "bool") or key.name == owner_selector(schema, section)
                     or where + key.name in NOT_DRAWN or key.name in VALUES or f"{section.case or section.name} > {key.name}" in VALUES
                     or refers(key))
            if not known:
                missing.append(f"{where}{key.name}" + (f" ({section.case})" if section.case else ""))
    return missing


def owner_selector(schema, section):
    return section.selector


def refers(key):
    return key.kind == "text" and key.name in ("Contact Model", "Material", "Damage Model")


# ---- drawing


def default_with_a_unit(key):
    """A default such as 1 1/s is written out: in other units it is another number. None of others."""
    if key.kind == "real" and key.default not in (None, "0") and key.unit not in ("", "spacings") and dimension(key.unit).any():
        return Num(float(key.default), key.unit)


def part_of_solid(material):
    """The moduli of a foam that is given by its solid's, as a part of these."""
    if "Relative Density" not in material:
        return 1.0
    return material["Relative Density"].value ** material["Density Exponent"].value


class Draft:
    """The scene so far, and the random numbers."""

    def __init__(self, schema, seed):
        self.schema, self.seed = schema, seed
        self.random, self.numbers = random.Random(seed), np.random.default_rng(seed)
        self.h, self.reach = 1e-3, 1.75
        self.E, self.nu, self.rho = 1e9, 0.3, 1000.0
        self.flow, self.speed, self.time, self.begin = 2e6, 10.0, 1e-5, 0.0

    def chance(self, probability):
        return self.random.random() < probability

    def uniform(self, low, high):
        return self.random.uniform(low, high)

    def pick(self, things):
        return self.random.choice(list(things))

    # ---- sections from the schema

    def value(self, section, key):
        """None where it is not for this table to say."""
        path = f"{section.path} > {key.name}" if section.path else key.name
        if path in NOT_DRAWN or key.without_effect:
            return None
        made = VALUES.get(f"{section.case or section.name} > {key.name}") or VALUES.get(key.name)
        if made:
            return self.timed(made(self))
        if key.kind == "bool":
            return self.chance(0.5)
        return self.pick(key.choices) if key.kind == "choice" else None

    def timed(self, value):
        if isinstance(value, Expr):
            text = value.text.replace("BEGIN", repr(self.begin)).replace("TIME", repr(self.time))
            return Expr(text, value.factor, value.unit)
        return value

    def keys(self, section, often):
        made = {}
        groups = GROUPS.get(section.case or section.path, [])
        grouped = [name for _, names in groups for name in names]
        for count, names in groups:
            made |= {name: self.value(section, section.keys[name]) for name in self.random.sample(names, count)}
        for name, key in section.keys.items():
            if name == section.selector or name in grouped:
                continue
            value = self.value(section, key) if key.required or self.chance(often) else default_with_a_unit(key)
            if value is not None:
                made[name] = value
        return made

    def section(self, section, often=0.4, case=None):
        """Its keys, each that is not required with a probability, a case, and its sections in the same way."""
        made = {}
        parts = [section]
        if section.cases:
            case = case or self.pick(section.cases)
            made[section.selector] = case
            parts.append(section.cases[case])
        for part in parts:
            made |= self.keys(part, often)
            for name, inner in part.sections.items():
                if inner.required or self.chance(often):
                    made[name] = self.section(inner, often)
        return made

    # ---- bodies

    def bodies(self):
        kinds = self.schema.sections["Discretization"].keys["Type"].choices
        self.kind = "Text File" if self.long else self.random.choices(kinds, [4 if kind == "Exodus" else 3 if kind == "Text File" else 1 for kind in kinds])[0]
        count = 1 if self.kind == "PdQuickGrid" or self.long else self.random.choices((1, 2, 3), (6, 5, 1))[0]
        self.at_nodes = self.kind == "Exodus" and self.chance(0.3)
        self.reach = self.pick((1.75, 1.75, 2.1, 2.6))
        low, self.boxes, self.block_of, meshes, number = np.array([0.0, 0.0, 0.0]), [], [], [], 1
        jitter = 0.0 if self.kind == "PdQuickGrid" or self.chance(0.6) else 0.08
        # A small stiff body beside a large one takes smaller steps than that: it is subcycled.
        self.fast_body = self.explicit and count > 1 and self.chance(0.5)
        for body in range(count):
            cell = 1e-3 * self.pick((1, 1, 1, 0.75)) * np.array([self.pick((1, 1, 1, 1.2)) for _ in range(3)])
            # Equilibria take a hundred times as long.
            counts = tuple(self.random.randint(2, (4 if count > 1 else 5) if self.explicit else 3) for _ in range(3))
            if self.long:
                counts = (3, 3, 3)
            if self.fast_body:
                counts = (5, 5, 4) if body == 0 else tuple(self.random.randint(2, 3) for _ in range(3))
                cell = cell * (1 if body == 0 else 0.5)
            split = self.random.randint(1, counts[2] - 1) if self.kind != "PdQuickGrid" and body == 0 and self.chance(0.4) else counts[2]
            box = mesh.Box(low.copy(), counts, cell)
            own = number
            meshes.append(mesh.of_box(self.kind, box, lambda ijk: own if ijk[2] < split else own + 1, jitter, self.numbers, self.at_nodes, f"b{body}_"))
            blocks = [own] if split == counts[2] else [own, own + 1]
            number += len(blocks)
            self.block_of.append(blocks)
            self.boxes.append(box)
            gap = self.pick((0.05 if self.at_nodes else 0.0, 0.05, 0.1, 0.2)) * 1e-3
            low = np.array([self.pick((0.0, 0.0, 0.4e-3)), self.pick((0.0, 0.0, -0.3e-3)), box.high[2] + gap])
        self.mesh = mesh.joined(meshes)
        self.askew = self.kind == "Exodus" and jitter > 0  # cells, that is
        self.h = min(box.cell.min() for box in self.boxes)

    def discretization(self):
        section = {"Type": self.kind} | self.keys(self.schema.sections["Discretization"], 0.5)
        section.pop("Points", None)
        if self.kind == "Exodus" and (self.at_nodes or self.chance(0.5)):
            section["Points"] = "Nodes" if self.at_nodes else "Elements"
        if self.kind == "PdQuickGrid":
            section["NeighborhoodType"] = "Spherical"
        else:
            section["Input Mesh File"] = {"Exodus": "mesh.g", "Text File": "mesh.txt"}[self.kind]
        if self.chance(0.12):
            section["Bond Filters"] = {"crack": self.cut()}
        return section

    def cut(self):
        """Across the first body, beside its middle, from one side to somewhere inside; off the lines of the lattice."""
        box = self.boxes[0]
        across, along = self.random.sample(range(3), 2)
        side = 3 - across - along
        at = box.low.copy()
        at[across] += box.cell[across] * (box.counts[across] // 2 + (0.03 if self.mesh.kind == "Exodus" else 0.07))
        size = (box.high - box.low)
        triple = lambda prefix, vector: {f"{prefix}_{a}": Num(float(v), "m" if prefix in ("Center", "Lower_Left_Corner") else "") for a, v in zip("XYZ", vector)}
        normal, bottom = np.eye(3)[across], np.eye(3)[along]
        reach = size[along] * self.uniform(0.3, 0.7)
        if self.chance(0.4):
            return {"Type": "Disk", **triple("Normal", normal), **triple("Center", at), "Radius": Num(float(reach), "m")}
        other = np.cross(bottom, normal)
        corner = at - 0.1 * self.h * bottom
        corner[side] = box.low[side] - 0.1 * self.h if other[side] > 0 else box.high[side] + 0.1 * self.h
        return {"Type": "Rectangular_Plane", **triple("Normal", normal), **triple("Lower_Left_Corner", corner),
                **triple("Bottom_Unit_Vector", bottom), "Bottom_Length": Num(float(reach), "m"),
                "Side_Length": Num(float(size[side] + 0.2 * self.h), "m")}

    # ---- materials and blocks

    def materials(self):
        count = 2 if self.fast_body else self.pick((1, 1, 2))
        any_material = self.schema.at(f"Materials > {ANY}")
        self.of_material, self.waves = {}, {}
        self.fastest, self.stiffest, self.softest = 0.0, 0.0, np.inf
        for n in range(count):
            stiff = n == 1 and (self.fast_body or self.chance(0.5))
            self.E, self.rho = 1e9 * self.uniform(0.5, 2) * (20 if stiff else 1), 1000 * self.uniform(0.5, 3)
            self.nu, self.flow = self.uniform(0.1, 0.4), 0.0
            self.flow = self.E * self.uniform(1e-3, 6e-3)
            material = self.section(any_material)
            self.reconciled(material)
            self.of_material[f"m{n + 1}"] = material
            modulus = self.E * (1 - self.nu) / ((1 + self.nu) * (1 - 2 * self.nu)) * 1.5
            self.waves[f"m{n + 1}"] = (modulus / self.rho) ** 0.5
            self.fastest = max(self.waves.values())
            self.stiffest, self.softest = max(self.stiffest, modulus), min(self.softest, self.E * part_of_solid(material))

    def reconciled(self, material):
        """Removes keys that others forbid (the deck's reader refuses them)."""
        flow = material.get("Flow Stress", {}).get("Type", "Hardening and Rate")
        if flow != "Hardening and Rate":
            for name in ("Yield Stress", "Hardening", "Rate", "Softening"):
                material.pop(name, None)
        elif material["Material Model"] == "Elastic Plastic Correspondence":
            material["Yield Stress"] = Num(self.flow, "Pa")
            if material.get("Hardening", {}).get("Type") == "Table":
                del material["Yield Stress"]
        if material.get("Formulation", "").startswith("Quadratic"):
            material.pop("Stabilization", None)
            material.pop("Stabilization Coefficient", None)
        if self.knows_temperature(material):
            material.pop("Thermal Expansion Coefficient", None)
        for pair in (("Compacted Young's Modulus", "Compacted Poisson's Ratio"),):
            if any(name in material for name in pair) and not all(name in material for name in pair):
                for name in pair:
                    material.pop(name, None)

    def knows_temperature(self, material):
        return (any(material.get(name, {}).get("Type", "None") not in ("None", "Hardening and Rate") for name in ("Softening", "Flow Stress", "Equation of State"))
                or "Heating" in material or "Shear Modulus Slope" in material)

    def blocks(self):
        any_block = self.schema.at(f"Blocks > {ANY}")
        sections, several = {}, len(self.boxes) > 1
        self.damage = {}
        for body, numbers in enumerate(self.block_of):
            for number in numbers:
                name, self.h = self.pick(self.of_material), float(np.prod(self.boxes[body].cell)) ** (1 / 3)
                if self.fast_body:
                    name = "m2" if body == len(self.boxes) - 1 else "m1"
                section = self.keys(any_block, 0.3)
                section.pop("Initial Temperature", None)
                section |= {"Block Names": f"block_{number}", "Material": name}
                if several and len(numbers) == 1:
                    section["Separate Body"] = not self.chance(0.1)
                else:
                    section.pop("Separate Body", None)
                if self.kind != "Exodus":
                    section.pop("Bonds Across Voids", None)
                if self.knows_temperature(self.of_material[name]) and self.chance(0.5):
                    section["Initial Temperature"] = VALUES["Initial Temperature"](self)
                # Bodies whose bonds may break are not subcycled.
                model = self.damage_model(self.of_material[name]) if self.explicit and self.chance(0.05 if self.fast_body else 0.3) else None
                if model:
                    section["Damage Model"] = model
                sections[f"part {number}"] = section
        self.h = min(box.cell.min() for box in self.boxes)
        return sections

    def may_fail(self, model, material):
        """False where the deck's reader would refuse failure; for a new model always true."""
        if material.get("Equation of State", {}).get("Type", "None") != "None" or material["Material Model"] == "Hyperelastic":
            return False
        if model == "Bond Energy":
            return all(m["Material Model"] == "Elastic" for m in self.of_material.values())
        if model == "Cohesive Crack":
            points = material.get("Stabilization", "Mean Gradient") == "Mean Gradient"
            return material["Material Model"] == "Elastic Correspondence" and (points or material.get("Formulation", "").startswith("Quadratic"))
        metal = material["Material Model"] == "Elastic Plastic Correspondence"
        return metal or model not in ("Plastic Strain", "Johnson-Cook", "Cockcroft-Latham")

    def damage_model(self, material):
        any_model = self.schema.at(f"Damage Models > {ANY}")
        models = [name for name in any_model.cases if self.may_fail(name, material)]
        if not models:
            return None
        each = models[(self.seed + len(self.damage)) % len(models)]  # in turn
        seldom = "Bond Energy" in models and self.chance(0.5)  # which few scenes may have
        model = self.section(any_model, case="Bond Energy" if seldom else each)
        if "D5" in model and not self.knows_temperature(material):
            del model["D5"]
        if "D5" in model:
            model["Melting Temperature"] = VALUES["Johnson-Cook > Melting Temperature"](self)
        name = f"d{len(self.damage) + 1}"
        self.damage[name] = model
        return name

    # ---- contact

    def contact(self):
        any_model = self.schema.at(f"Contact > Models > {ANY}")
        model = self.section(any_model)
        if not self.explicit and model["Contact Model"] != "Surface":
            model.pop("Friction Coefficient", None)
        interactions = {}
        if self.chance(0.5):
            interactions[self.pick(("General Contact", "any"))] = {"Contact Model": "touch"}
        else:
            first = [blocks[-1] for blocks in self.block_of]
            for one, other in zip(first, first[1:]):
                lower = self.block_of[first.index(one)][-1]
                interactions[f"{one} on {other}"] = {"First Block": f"block_{lower}", "Second Block": f"block_{other}", "Contact Model": "touch"}
            if not interactions:
                interactions["itself"] = {"First Block": "block_1", "Second Block": "block_1", "Contact Model": "touch"}
        return {"Models": {"touch": model}, "Interactions": interactions}

    # ---- conditions

    def face(self, body, axis, high):
        """The set of points in the outermost layer of a body, made where it is new."""
        box = self.boxes[body]
        name = f"b{body}_{AXES[axis]}_{'high' if high else 'low'}"
        # A layer of element centers is half a cell off the face, a layer of nodes in it.
        depth = (0.5 if self.at_nodes else 0.85) * box.cell[axis]
        limit = box.high[axis] - depth if high else box.low[axis] + depth
        terms = [f"({{{AXES[axis]}}} {'>' if high else '<'} {float(limit)!r})"]
        for a in range(3):
            if a != axis:
                terms.append(f"({{{AXES[a]}}} > {float(box.low[a] - 0.01 * box.cell[a])!r})*({{{AXES[a]}}} < {float(box.high[a] + 0.01 * box.cell[a])!r})")
        beyond = box.high[axis] + 0.01 * box.cell[axis] if high else box.low[axis] - 0.01 * box.cell[axis]
        terms.append(f"({{{AXES[axis]}}} {'<' if high else '>'} {float(beyond)!r})")
        self.sets[name] = Expr("*".join(terms))
        return name

    def somewhere(self):
        """A set for loads and velocities: all, a block, one of the mesh, or what is on a side of a skew plane."""
        words = ["all", "all", f"block_{self.pick(range(1, 1 + max(self.mesh.blocks)))}", "skew"]
        word = self.pick(words + list(self.mesh.sets))
        if word != "skew":
            return word
        name = f"skew {len(self.sets)}"
        middle = (self.boxes[0].low + self.boxes[0].high) / 2
        slopes = [self.uniform(-1, 1) for _ in range(3)]
        where = " + ".join(f"{s!r}*({{{a}}} - {float(m)!r})" for s, a, m in zip(slopes, AXES, middle))
        self.sets[name] = Expr(f"({where} > {0.013e-3!r})")
        return name

    def field(self, amplitude, unit):
        """The same everywhere, or linear or wavy in a coordinate."""
        box = self.boxes[0]
        axis = self.random.randrange(3)
        part = f"({{{AXES[axis]}}} - {float(box.low[axis])!r})/{float(box.high[axis] - box.low[axis])!r}"
        return Expr(self.pick(("1", "1", part, f"(1 - 2*{part})", f"sin(3*{part})")), amplitude * self.pick((-1, 1)) * self.uniform(0.3, 1), unit)

    def condition(self, kind):
        case = self.schema.at(f"Boundary Conditions > {ANY}").cases[kind]
        made = {"Type": kind} | self.keys(case, 0.4)
        if kind == "Prescribed Temperature":
            return made | {"Node Set": self.somewhere(), "Value": self.over_time(self.field(300.0, "K"))}
        if "Coordinate" in case.keys:
            return self.along_axes(made, case)
        if "Friction Coefficient" in case.keys:
            return self.tool(made, case)
        if "Normal" not in case.keys:
            raise KeyError(f"Boundary Conditions, Type = \"{kind}\": scenes.py does not know how to place it")
        body, axis, high = self.random.randrange(len(self.boxes)), self.random.randrange(3), self.chance(0.5)
        if kind == "Non-Reflecting End" and self.chance(0.7):  # they meet at edges
            body = 0
        if "Point" in case.keys:  # a plane in the face of a body, which it holds
            high = False
            at = self.boxes[body].low.copy()
            made["Point"] = Place(tuple(map(float, at)))
        made["Normal"] = Direction(tuple(float(v) for v in np.eye(3)[axis] * (1 if high else (1 if "Point" in case.keys else -1))))
        made["Node Set"] = self.face(body, axis, high)
        return made

    def along_axes(self, made, case):
        kind, unit = made["Type"], case.keys["Value"].unit
        made["Coordinate"] = "".join(self.random.sample(AXES, self.pick((1, 1, 1, 2, 3))))
        if kind in ("Initial Velocity", "Initial Displacement"):
            made["Node Set"] = self.pick(("all", f"block_{self.pick(range(1, 1 + max(self.mesh.blocks)))}"))
            made["Value"] = self.field(self.speed if unit == "m/s" else 0.01 * self.h, unit)
            return made
        if kind in MOTIONS:
            body, axis, high = self.random.randrange(len(self.boxes)), self.random.randrange(3), self.chance(0.5)
            made["Node Set"] = self.face(body, axis, high)
            amplitude = self.speed * self.time / 3 if unit == "m" else self.speed
            made["Value"] = self.over_time(self.field(amplitude, unit)).times(self.pick((0.0, 1.0, 1.0)))
            return made
        made["Node Set"] = self.somewhere()
        amplitude = {"N/m³": self.rho * self.speed / self.time}.get(unit, 1.0)
        value = self.field(amplitude, unit)
        made["Value"] = value if self.chance(0.5) else self.over_time(value)
        return made

    def over_time(self, value):
        """From 0, smoothly."""
        return Expr(f"({value.text})*(1 - cos(3*({{t}} - {self.begin!r})/{self.time!r}))", value.factor, value.unit)

    def tool(self, made, case):
        """Beside a face of the lowest or the uppermost body, at a small distance."""
        axis, high = self.pick((2, 2, 2, 0, 1)), self.chance(0.5)
        body = len(self.boxes) - 1 if high and axis == 2 else 0
        box = self.boxes[body]
        low, top = (np.min([b.low for b in self.boxes], axis=0), np.max([b.high for b in self.boxes], axis=0))
        gap = self.pick((0.0, 0.05, 0.2)) * self.h
        out = np.eye(3)[axis] * (1 if high else -1)  # from the bodies to the tool
        face = top[axis] + gap if high else low[axis] - gap
        middle = (box.low + box.high) / 2
        middle[axis] = face
        if "Lower Corner" in case.keys:
            reach = (top - low) * self.pick((0.3, 1.0))
            ends = np.sort([middle - reach, middle + reach], axis=0)
            ends[:, axis] = sorted((face, face + out[axis] * 3e-3))
            made["Lower Corner"], made["Upper Corner"] = (Place(tuple(map(float, end))) for end in ends)
        elif "Axis" in case.keys:
            radius = self.h * self.uniform(1.5, 5)
            along = np.eye(3)[self.pick([a for a in range(3) if a != axis])]
            made |= {"Radius": Num(radius, "m"), "Axis": Direction(tuple(map(float, along))), "Point": Place(tuple(map(float, middle + radius * out)))}
        else:
            normal = -out
            if self.chance(0.3):  # tilted about a corner, so that all bodies stay on its side
                normal = normal + 0.1 * self.numbers.uniform(-1, 1, 3) * (np.arange(3) != axis)
                corners = np.array([[(low, top)[n][a] for a, n in enumerate(c)] for c in np.ndindex(2, 2, 2)])
                middle = corners[np.argmin(corners @ normal)] - gap * normal
            made |= {"Normal": Direction(tuple(map(float, normal))), "Point": Place(tuple(map(float, middle)))}
        if "Mass" not in made or not self.explicit:
            made = {k: v for k, v in made.items() if not k.startswith(("Speed", "Force", "Mass"))}
        else:
            made = {k: v for k, v in made.items() if not k.startswith("Travel")}
        return made

    def conditions(self):
        kinds = [kind for kind in self.schema.at(f"Boundary Conditions > {ANY}").cases if kind != "Periodic Sides"]
        inertial = ("Initial Velocity", "Initial Displacement", "Non-Reflecting End")
        kinds = [kind for kind in kinds if self.explicit or kind not in inertial]
        if any(material["Material Model"] != "Elastic" for material in self.of_material.values()):
            kinds = [kind for kind in kinds if kind != "Initial Displacement"]  # forces that follow from positions alone
        if not self.may_be_warmed():
            kinds = [kind for kind in kinds if kind != "Prescribed Temperature"]
        made, held, thrown = {}, [], set()
        if not self.explicit:  # held first, or there is no equilibrium
            made |= self.motion(held, thrown)
        free = self.explicit and self.chance(0.25)  # bodies that fly, turn and meet
        some = [self.pick(kinds) for _ in range(self.random.randint(1, 4))]
        if free:
            some = ["Initial Velocity"] * len(some)
        elif self.fast_body and self.chance(0.4):  # loads and substeps
            some = ["Body Force", *some[:self.pick((0, 0, 1, 3))]]
        if "Non-Reflecting End" in some and self.chance(0.5):
            some += ["Non-Reflecting End"] * 2
        for kind in some:
            one = self.condition(kind)
            if self.free(one, held, thrown):
                made[f"c{len(made) + 1}"] = one
        return made | self.motion(held, thrown) if self.explicit else made

    def may_be_warmed(self):
        """Whether something expands, and no law has another temperature, no bond an energy that counts from cold."""
        expands = any("Thermal Expansion Coefficient" in m for m in self.of_material.values())
        bonds = any(model["Damage Model"] == "Bond Energy" for model in self.damage.values())
        return expands and not bonds and not any(map(self.knows_temperature, self.of_material.values()))

    def sides(self, conditions, contact):
        """Sides at both ends of the bodies along an axis, that nothing stands across; {} where they do not fit."""
        if self.at_nodes or any(one["Type"] == "Symmetry Plane" for one in conditions.values()):
            return {}
        axis = self.random.randrange(3 if len(self.boxes) == 1 else 2)
        across = [one for one in conditions.values() if "Normal" in one and one["Normal"].along[axis]]
        lower, upper = (float(f([getattr(box, end)[axis] for box in self.boxes])) for f, end in ((min, "low"), (max, "high")))
        horizon = 1.01 * self.reach * max(np.prod(box.cell) ** (1 / 3) for box in self.boxes)
        if across or contact and upper - lower < 3 * horizon:
            return {}
        made = {"Type": "Periodic Sides", "Coordinate": AXES[axis], "Lower": Num(lower, "m"), "Upper": Num(upper, "m")}
        if not contact and self.chance(0.6):
            strain = self.pick((-1, 1)) * self.uniform(0.1, 0.5) * self.speed * self.time / (upper - lower)
            made["Stretch"] = Expr(f"(1 + {strain!r}*(1 - cos(3*({{t}} - {self.begin!r})/{self.time!r})))")
        return {"sides": made}

    def motion(self, held, thrown):
        """So that something happens: a slow press on a held foot, or a velocity of the last body towards the others."""
        made = {}
        if self.explicit:
            blocks = [f"block_{n}" for n in self.block_of[-1]]
            if self.chance(0.8) and not any((block, "z", "Initial Velocity") in thrown for block in [*blocks, "all"]):
                for n, block in enumerate(blocks):
                    made[f"flight {n}"] = {"Type": "Initial Velocity", "Node Set": block, "Coordinate": "z",
                                           "Value": Expr("1", -self.speed * self.uniform(0.3, 1.5), "m/s")}
            return made
        later = f"(1 - cos(3*({{t}} - {self.begin!r})/{self.time!r}))"  # to 1.99
        fixed = Expr("0", 1.0, "m")
        pull = lambda: Expr(later, self.speed * self.time / 3 * self.uniform(0.3, 1), "m")
        parts = [("foot", "xyz", 0, 0, False, fixed), ("head", self.pick("xyz"), 0, 0, True, pull())]
        if len(self.boxes) > 1:  # the last one is pressed on the others, and dragged
            way = sum(top.low[2] - one.high[2] for one, top in zip(self.boxes, self.boxes[1:])) + self.h * self.uniform(0.02, 0.1)
            last = len(self.boxes) - 1
            parts = [("foot", "xyz", 0, 2, False, fixed), ("press", "z", last, 2, True, Expr(later, -0.5 * way, "m")),
                     ("drag", "x", last, 2, True, pull()), ("aside", "y", last, 2, True, fixed)]
            parts += [("side", "xy", body, 0, False, fixed) for body in range(1, last)]
        for name, axes, body, axis, high, value in parts:
            one = {"Type": "Prescribed Displacement", "Coordinate": axes, "Node Set": self.face(body, axis, high), "Value": value}
            if self.free(one, held, thrown):
                made[f"{name} {body}"] = one
        return made

    def free(self, one, held, thrown):
        """Whether it says no other thing of the same points along the same axis than another one does. Takes note of it."""
        if one["Type"] in ("Initial Velocity", "Initial Displacement"):
            keys = {(one["Node Set"], axis, one["Type"]) for axis in one["Coordinate"]}
            overlap = any((axis, kind) == (a, k) and ("all" in (one["Node Set"], s) or s == one["Node Set"])
                          for s, axis, kind in thrown for _, a, k in keys)
            thrown |= set() if overlap else keys
            return not overlap
        if one["Type"] == "Prescribed Temperature":  # one: where several overlap, the last one of the deck counts
            key = ("all", "", one["Type"])
            alone = key not in thrown
            thrown.add(key)
            return alone
        if one["Type"] not in (*MOTIONS, "Symmetry Plane", "Non-Reflecting End"):
            return True
        scene = Scene({"Node Sets": self.sets}, self.mesh, self.h, 0, 0, self.boxes)
        axes = one.get("Coordinate") or "".join(a for a, n in zip(AXES, one["Normal"].along) if n)
        points = scene.members(one["Node Set"])
        if one["Type"] == "Non-Reflecting End":
            axes = "w"  # may meet others of its kind
        if any((points & other).any() and set(axes) & set(taken) for other, taken in held):
            return False
        held.append((points, axes))
        return True

    # ---- all

    def solver(self):
        solver = {"Initial Time": Num(self.begin, "s"), "Final Time": Num(self.begin + self.time, "s")}
        if not self.explicit:
            method = self.keys(self.schema.at("Solver > QuasiStatic"), 0.3)
            return solver | {"QuasiStatic": method | {"Number of Load Steps": self.load_steps, "Tolerance": Num(1e-8, "")}}
        if self.chance(0.1 if self.fast_body else 0.4):
            return solver | {"Verlet": {"Fixed dt": Num(self.time / self.steps, "s")}}
        return solver | {"Verlet": self.keys(self.schema.at("Solver > Verlet"), 0.5)}

    def draw(self):
        self.long = self.chance(0.05)
        self.explicit = self.long or self.chance(0.88)
        self.bodies()
        self.materials()
        self.steps = self.random.randint(24, 80)
        self.load_steps = self.random.randint(2, 4)
        self.time = self.steps * 0.12 * self.h / self.fastest if self.explicit else 1e-3
        if self.fast_body and self.explicit:  # some steps of the others
            self.time = max(self.time, self.random.randint(16, 32) * 0.3 * self.boxes[0].cell.min() / self.waves["m1"])
        self.begin = self.pick((0.0, 0.0, 0.5 * self.time, -self.time))
        slowest = min(self.waves.values())  # the strains are speeds over this
        self.speed = slowest * self.uniform(0.002, 0.02) if self.explicit else 0.03 * 3 * self.h / self.time
        self.sets = {}
        if self.long:
            return self.free_vibration()
        deck = {"Discretization": self.discretization(), "Materials": self.of_material}
        deck["Blocks"] = self.blocks()
        if self.damage:
            deck["Damage Models"] = self.damage
        if len(self.boxes) > 1 and self.chance(0.85) or self.chance(0.15):
            deck["Contact"] = self.contact()
        deck["Boundary Conditions"] = self.conditions()
        if self.chance(0.2):
            deck["Boundary Conditions"] |= self.sides(deck["Boundary Conditions"], "Contact" in deck)
        deck["Node Sets"] = {name: self.sets[name] for name in self.sets
                             if any(c.get("Node Set") == name for c in deck["Boundary Conditions"].values())}
        deck["Solver"] = self.solver()
        used = {section["Material"] for section in deck["Blocks"].values()}
        deck["Materials"] = {name: m for name, m in deck["Materials"].items() if name in used}
        return Scene(deck, self.mesh, self.h, self.stiffest, self.fastest, self.boxes, {"seed": self.seed, "askew": self.askew, "softest": self.softest})


    def free_vibration(self):
        """A body that vibrates for some thousand default steps, elastic as strains are small."""
        self.time, self.begin = self.time / self.steps * 12000, 0.0
        self.damage = {}
        deck = {"Discretization": self.discretization(), "Materials": self.of_material, "Blocks": self.blocks(), "Node Sets": {}}
        self.damage.clear()
        for section in deck["Blocks"].values():
            section.pop("Damage Model", None)
        box = self.boxes[0]
        bulge = f"(({{x}} - {float(box.low[0])!r})/{float(box.high[0] - box.low[0])!r} - 0.5)"
        weak = self.fastest * self.uniform(1e-4, 5e-4)  # strains below yield
        deck["Boundary Conditions"] = {"stretch": {"Type": "Initial Velocity", "Node Set": "all", "Coordinate": "x", "Value": Expr(bulge, weak, "m/s")}}
        deck["Solver"] = {"Initial Time": Num(0.0, "s"), "Final Time": Num(self.time, "s")}
        used = {section["Material"] for section in deck["Blocks"].values()}
        deck["Materials"] = {name: m for name, m in deck["Materials"].items() if name in used}
        return Scene(deck, self.mesh, self.h, self.stiffest, self.fastest, self.boxes, {"seed": self.seed, "askew": self.askew, "softest": self.softest, "long": True})


def drawn(schema, seed):
    return Draft(schema, seed).draw()


# ---- writing


def fields_of(scene):
    """Output variables: those of all bodies, and of the laws that are there."""
    fields = ["Displacement", "Velocity", "Force", "Cauchy_Stress", "Jacobian", "Damage", "Volume", "Density"]
    draft = Draft.__new__(Draft)
    metals = [m for m in scene.deck["Materials"].values() if m["Material Model"] == "Elastic Plastic Correspondence"]
    if metals:
        fields.append("Equivalent_Plastic_Strain")
    if any(Draft.knows_temperature(draft, m) for m in metals):
        fields.append("Temperature")
    return fields


def parameter(name, value):
    if isinstance(value, bool):
        kind, text = "bool", str(value).lower()
    elif isinstance(value, int):
        kind, text = "int", str(value)
    elif isinstance(value, float):
        kind, text = "double", repr(value)
    elif isinstance(value, (tuple, list)):
        kind, text = "string", " ".join(repr(float(v)) for v in value)
    else:
        kind, text = "string", str(value)
    return f'<Parameter name={quoteattr(name)} type="{kind}" value={quoteattr(text)}/>'


def xml(section, name=None, indent=""):
    lines = [f"{indent}<ParameterList{'' if name is None else f' name={quoteattr(name)}'}>"]
    for key, value in section.items():
        lines.append(xml(value, key, indent + "  ") if isinstance(value, dict) else f"{indent}  {parameter(key, value)}")
    return "\n".join([*lines, f"{indent}</ParameterList>"])


@dataclass
class Written:
    """A scene in a frame, as files; which conditions of the deck each condition of the scene has become."""
    deck: dict
    mesh: mesh.Mesh
    parts: dict

    def write(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "deck.xml").write_text(xml(self.deck) + "\n")
        if self.mesh.kind != "PdQuickGrid":
            self.mesh.write(folder / self.deck["Discretization"]["Input Mesh File"])


def touching_blocks(scene):
    """Pairs of them that the deck says may touch, of different numbers."""
    blocks = sorted(set(scene.mesh.owners()))
    pairs = set()
    for one in scene.deck.get("Contact", {}).get("Interactions", {}).values():
        if "First Block" in one:
            pairs.add((int(one["First Block"][6:]), int(one["Second Block"][6:])))
        else:
            pairs |= {(a, b) for a in blocks for b in blocks if a < b}
    return sorted((a, b) for a, b in pairs if a != b)


def written(scene, frame=Frame(), restart=None, order=None):
    deck = {name: frame.section(section) for name, section in scene.deck.items() if name not in ("Boundary Conditions", "Discretization")}
    grid = scene.mesh.mapped(frame.places, frame.mirrors, frame.length**3)
    source = scene.deck["Discretization"]
    deck["Discretization"] = {k: v for k, v in source.items() if k != "Bond Filters"}
    if "Bond Filters" in source:
        deck["Discretization"]["Bond Filters"] = {name: frame.cut(cut) for name, cut in source["Bond Filters"].items()}
    if grid.kind == "PdQuickGrid":
        made = {"Type": "PdQuickGrid"}
        for axis in range(3):
            size = float(grid.box.high[axis] - grid.box.low[axis])
            made |= {f"{'XYZ'[axis]} Origin": float(grid.box.low[axis]), f"{'XYZ'[axis]} Length": size, f"Number Points {'XYZ'[axis]}": int(grid.box.counts[axis])}
        deck["Discretization"]["TensorProduct3DMeshGenerator"] = made
    parts = {name: frame.condition(name, condition) for name, condition in scene.conditions.items()}
    deck["Boundary Conditions"] = {name: part for made in parts.values() for name, part in made.items()}
    reactions = [f"Reaction_{a}({name})" for name, c in deck["Boundary Conditions"].items() if c["Type"] in REACTING for a in "XYZ"]
    touching = [f"Contact_Force_{a}(block_{one}:block_{other})" for one, other in touching_blocks(scene) for a in "XYZ"]
    interval = (scene.end - scene.begin) * frame.time / STEPS_A_FRAME
    deck["Output"] = {"Output Filename": "out.e", "Output Interval": interval, "Output Variables": {name: True for name in fields_of(scene)}}
    probe = [f"Displacement_{a}(probe)" for a in "XYZ"]
    deck["History"] = {"Filename": "out.csv", "Frequency": 25 if scene.is_long else 1, "Variables": {name: True for name in reactions + touching + probe},
                       "Probes": {"probe": {"Point": tuple(map(float, frame.places(scene.probed()[None])[0]))}}}
    if restart:
        deck["Restart"] = restart
    if order is not None:
        deck, grid = reordered(deck, order), grid.shuffled(order)
    return Written(deck, grid, {name: list(made) for name, made in parts.items()})


def reordered(deck, rng):
    """Its sections in another order, but for rigid tools, of which the last one of the deck has the last word."""
    def shuffled(section):
        names = list(section)
        return {names[i]: section[names[i]] for i in rng.permutation(len(names))}
    made = shuffled({name: dict(section) for name, section in deck.items()})
    for name in ("Materials", "Blocks", "Node Sets", "Damage Models", "Boundary Conditions"):
        if name in made:
            made[name] = shuffled(made[name])
    conditions = made["Boundary Conditions"]
    tools = iter([item for item in deck["Boundary Conditions"].items() if item[1]["Type"] in TOOLS])
    made["Boundary Conditions"] = dict(next(tools) if value["Type"] in TOOLS else (name, value) for name, value in conditions.items())
    return made
