"""The decks of the six load cases: strains along the axes xx yy zz, then shear yz zx xy, imposed on the faces of the box."""
import xml.etree.ElementTree as tree

import numpy as np
from decks import Deck

from .faces import FACES

ORDER = ("xx", "yy", "zz", "yz", "zx", "xy")
PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1))
KEPT = ("Discretization", "Node Sets", "Materials", "Blocks")
HELD = """<ParameterList name="{name}">
  <Parameter name="Type" type="string" value="Prescribed Displacement"/>
  <Parameter name="Node Set" type="string" value="{face}"/>
  <Parameter name="Coordinate" type="string" value="{axis}"/>
  <Parameter name="Value" type="string" value="{value}"/>
</ParameterList>
"""


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
            terms.append(f"(t &gt; {n - 0.5})*(t &lt; {n + 0.5})*({linear})")
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
    parts = [tree.tostring(deck.section(name), "unicode") for name in KEPT if deck.section(name) is not None]
    text = tree.tostring(root, "unicode").replace(" />", ">") + "\n" + "\n".join(parts)
    by_place = {face: points for face, points in sets.items() if not points[0].isdigit()}
    if by_place and deck.section("Node Sets") is None:
        text += f'\n<ParameterList name="Node Sets">\n{set_lines(by_place)}</ParameterList>\n'
    elif by_place:
        at = text.index('<ParameterList name="Node Sets">') + len('<ParameterList name="Node Sets">')
        text = text[:at] + "\n" + set_lines(by_place) + text[at:]
    by_number = set_lines({face: points for face, points in sets.items() if face not in by_place})
    conditions = "".join(HELD.format(name=f"{face} {'xyz'[a]}", face=box_set(face), axis="xyz"[a],
                                            value=displacement(cases, a, strain, center))
                         for face in FACES for a in held(kind, cases, face))
    text += f"""<ParameterList name="Boundary Conditions">
{by_number}{conditions}</ParameterList>
<ParameterList name="Solver">
  <Parameter name="Final Time" type="double" value="{len(cases)}"/>
  <ParameterList name="QuasiStatic">
    <Parameter name="Number of Load Steps" type="int" value="{len(cases)}"/>
    <Parameter name="Tolerance" type="double" value="1e-5"/>
  </ParameterList>
</ParameterList>
<ParameterList name="Output">
  <Parameter name="Output Filename" type="string" value="sample.e"/>
  <Parameter name="Output Interval" type="double" value="1"/>
  <ParameterList name="Output Variables"><Parameter name="Displacement" type="bool" value="true"/></ParameterList>
</ParameterList>
<ParameterList name="History">
  <Parameter name="Filename" type="string" value="sample.csv"/>
  <Parameter name="Frequency" type="int" value="1"/>
  <ParameterList name="Variables">
{"".join(f'    <Parameter name="Mean_Cauchy_Stress_{c.upper()}" type="bool" value="true"/>{chr(10)}' for c in ORDER)}  </ParameterList>
</ParameterList>
</ParameterList>
"""
    return Deck.of(deck.path, text)


def set_lines(sets):
    return "".join(f'<Parameter name="{box_set(face)}" type="string" value="{points}"/>\n' for face, points in sets.items())


def box_set(face):
    return f"Node Set of the face {face} of the box"


def expression(face, low, high, depth):
    """An expression of the points at most this deep below a face."""
    axis = "xyz".index(face[0])
    if face.endswith("min"):
        return f"{face[0]} &lt; {low[axis] + depth:.17g}"
    return f"{face[0]} &gt; {high[axis] - depth:.17g}"


# The runs: one for kinematic conditions, because all cases hold the same points; for mixed ones axial cases together.
RUNS = {"kinematic": [(0, 1, 2, 3, 4, 5)], "mixed": [(0, 1, 2), (3,), (4,), (5,)]}
