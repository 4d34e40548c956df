"""The decks of the six load cases: strains along the axes xx yy zz, then shear yz zx xy, imposed on the faces of the box."""
import xml.etree.ElementTree as tree

import numpy as np
from decks import Deck, section, value_in

from .faces import FACES

ORDER = ("xx", "yy", "zz", "yz", "zx", "xy")
PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1))
UNMIRRORED = ("gyroid", "diamond")  # lattices, of struts or sheets, without mirror planes across the axes
RELAXATION = "ParameterList[@name='Relaxation']"
KEPT = ("Discretization", "Node Sets", "Materials", "Blocks")


def strain_tensor(case):
    """A unit strain; engineering strain for shear."""
    i, j = PAIRS[case]
    e = np.zeros((3, 3))
    e[i, j] += 0.5
    e[j, i] += 0.5
    return e


def displacement(cases, axis, strain, center):
    """One component as an expression; at the time n it is that of the n-th case."""
    terms = []
    for n, case in enumerate(cases, 1):
        row = strain * strain_tensor(case)[axis]
        linear = " + ".join(f"{row[b]:.17g}*({'xyz'[b]} - {center[b]:.17g})" for b in range(3) if row[b])
        if linear:
            terms.append(f"(t >= {n - 0.5})*(t < {n + 0.5})*({linear})")
    return " + ".join(terms) or "0"


def held(kind, cases, face):
    """The prescribed components of a face: all, or by mixed conditions (Pahr & Zysset, Influence of boundary conditions
    on computed apparent elastic properties of cancellous bone, Biomech. Model. Mechanobiol. 7 (2008) 463) the normal
    one; for shear ij, the tangential ones on faces of i and j."""
    if kind == "kinematic":
        return (0, 1, 2)
    normal = "xyz".index(face[0])
    i, j = PAIRS[cases[0]]
    sheared = i != j and normal in (i, j)
    return tuple(a for a in range(3) if (a != normal) == sheared)


def deck_of(deck, kind, cases, center, strain, sets):
    """The deck of some cases as successive load steps. `sets`: {face: its points, by number or expression}."""
    root = tree.Element("ParameterList")
    root.extend(deck.section(name) for name in KEPT if deck.section(name) is not None)
    found = Deck.of(deck.path, tree.tostring(root, "unicode"))
    # Bonds of a stiffness do not break; the elastic constants are those of fast loading, as a load case would last 1 s.
    for name, part in (("Blocks", "Parameter[@name='Damage Model']"), ("Materials", RELAXATION)):
        for owner in found.sections(name).values():
            for one in owner.findall(part):
                owner.remove(one)
    points = {box_set(face): text for face, text in sets.items()}
    by_place = {name: text for name, text in points.items() if not text[0].isdigit()}
    if by_place and found.section("Node Sets") is None:
        found.root.append(section("Node Sets", {}))
    if by_place:
        found.section("Node Sets").extend(section("", by_place))
    held_faces = {f"{face} {'xyz'[a]}": {"Type": "Prescribed Displacement", "Node Set": box_set(face), "Coordinate": "xyz"[a],
                                         "Value": displacement(cases, a, strain, center)}
                  for face in FACES for a in held(kind, cases, face)}
    found.root.extend(section("", {
        "Boundary Conditions": {**{name: text for name, text in points.items() if name not in by_place}, **held_faces},
        "Solver": {"Final Time": len(cases), "QuasiStatic": {"Number of Load Steps": len(cases), "Tolerance": 1e-5}},
        "Output": {"Output Filename": "sample.e", "Output Interval": 1, "Output Variables": {"Displacement": "true"}},
        "History": {"Filename": "sample.csv", "Frequency": 1,
                    "Variables": {f"Mean_Cauchy_Stress_{c.upper()}": "true" for c in ORDER}}}))
    return Deck.of(deck.path, tree.tostring(found.root, "unicode"))


def has_library(deck):
    return any(value_in(m, "Material Model") == "User Library" for m in deck.sections("Materials").values())


def meanings(deck, kinds):
    """Lines that say which stiffness it is, where stress changes with time, or a lattice is no mirror image of itself."""
    relaxes = any(m.find(RELAXATION) is not None for m in deck.sections("Materials").values())
    told = ["stiffness of fast loading: Relaxation is left out"] if relaxes else []
    recipe = deck.recipe()
    turned = [body["lattice"] for body in (recipe.bodies() if recipe else []) if body.get("lattice", "").startswith(UNMIRRORED)]
    if turned and "mixed" in kinds:
        told.append(f"WARNING: mixed boundaries do not give the periodic stiffness of a {turned[0]}, whose cells have no mirror planes: that "
                    "needs runs with Periodic Sides and their Stretch")
    return told + (["User Library: stiffness after 1 s of load, should its stress relax"] if has_library(deck) else [])


def box_set(face):
    return f"Node Set of the face {face} of the box"


def is_of_edges(warning):
    """True for strut's warning that points belong to two faces, whose motions there are equal."""
    return warning.endswith("which stands later and alone counts there, as in Peridigm")


def expression(face, low, high, depth):
    """An expression of the points at most this deep below a face."""
    axis = "xyz".index(face[0])
    if face.endswith("min"):
        return f"{face[0]} < {low[axis] + depth:.17g}"
    return f"{face[0]} > {high[axis] - depth:.17g}"


# The runs: one for kinematic conditions, because all cases hold the same points; for mixed ones axial cases together.
RUNS = {"kinematic": [(0, 1, 2, 3, 4, 5)], "mixed": [(0, 1, 2), (3,), (4,), (5,)]}
