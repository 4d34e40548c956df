"""A scene made smaller, part by part, as long as it fails in the same way."""
import re
from dataclasses import replace

from values import Expr, Num

MOST = 120  # scenes that are tried


def smaller(scene):
    """Scenes with a part less, the largest parts first."""
    deck = scene.deck
    for name in ("Contact", "Damage Models"):
        if name in deck:
            one = scene.copy()
            del one.deck[name]
            if name == "Damage Models":
                for section in one.deck["Blocks"].values():
                    section.pop("Damage Model", None)
            yield one
    for name in deck["Boundary Conditions"]:
        one = scene.copy()
        del one.deck["Boundary Conditions"][name]
        yield one
    yield from fewer_points(scene)
    for part in ("Blocks", "Materials", "Boundary Conditions", "Damage Models"):
        for name, section in deck.get(part, {}).items():
            for key in section:
                if key == "Node Set":  # without it, all points: no smaller scene, and no use of an end
                    continue
                one = scene.copy()
                del one.deck[part][name][key]
                yield one
    for name, material in deck["Materials"].items():
        if material["Material Model"] != "Elastic Correspondence":
            one = scene.copy()
            kept = ("Density", "Bulk Modulus", "Shear Modulus", "Young's Modulus", "Poisson's Ratio")
            one.deck["Materials"][name] = {"Material Model": "Elastic Correspondence"} | {k: v for k, v in material.items() if k in kept}
            yield one
    for name, condition in deck["Boundary Conditions"].items():
        if isinstance(condition.get("Value"), Expr) and condition["Value"].text != "1":
            one = scene.copy()
            one.deck["Boundary Conditions"][name]["Value"] = replace(condition["Value"], text="1")
            yield one
        if len(condition.get("Coordinate", "")) > 1:
            for axis in condition["Coordinate"]:
                one = scene.copy()
                one.deck["Boundary Conditions"][name]["Coordinate"] = axis
                yield one
    for section, key in (("Discretization", "Influence Function"), ("Discretization", "Bond Filters")):
        if key in deck[section]:
            one = scene.copy()
            del one.deck[section][key]
            yield one
    verlet = deck["Solver"].get("Verlet", {})
    for key in verlet:
        one = scene.copy()
        del one.deck["Solver"]["Verlet"][key]
        yield one
    one = scene.copy()
    one.deck["Solver"]["Final Time"] = Num(scene.begin + (scene.end - scene.begin) / 2, "s")
    yield one


def fewer_points(scene):
    """Without a block, or one half of all along an axis."""
    blocks = sorted(set(scene.mesh.blocks))
    if scene.mesh.kind == "PdQuickGrid":
        return
    for block in blocks if len(blocks) > 1 else ():
        one = scene.copy()
        one.mesh = scene.mesh.only(scene.mesh.blocks != block)
        word = f"block_{block}"
        one.deck["Blocks"] = {k: v for k, v in one.deck["Blocks"].items() if v["Block Names"].split() != [word]}
        for section in one.deck["Blocks"].values():
            section["Block Names"] = " ".join(w for w in section["Block Names"].split() if w != word)
        one.deck["Boundary Conditions"] = {k: v for k, v in one.deck["Boundary Conditions"].items() if v.get("Node Set") != word}
        used = {section["Material"] for section in one.deck["Blocks"].values()}
        one.deck["Materials"] = {k: v for k, v in one.deck["Materials"].items() if k in used}
        yield one
    at = scene.mesh.elements()
    for axis in range(3):
        low, high = at[:, axis].min(), at[:, axis].max()
        for part in (0.5, 0.75):
            for keep in (at[:, axis] < low + part * (high - low), at[:, axis] > high - part * (high - low)):
                if 0 < keep.sum() < len(at) and set(scene.mesh.blocks[keep]) == set(blocks):
                    one = scene.copy()
                    one.mesh = scene.mesh.only(keep)
                    yield one


def kind_of(problem):
    """Without its numbers: "signs: Kinetic_Energy falls to"."""
    return re.split(r" ?-?\d", problem)[0]


def alike(one, other):
    """Compares without regard to the field that differs most."""
    of_field = lambda text: re.match(r"\w+: [\d.]", text) is not None
    return kind_of(one) == kind_of(other) or (of_field(one) and of_field(other))


def tidied(scene):
    """Without sets that nothing uses."""
    used = {c.get("Node Set") for c in scene.deck["Boundary Conditions"].values()}
    scene.deck["Node Sets"] = {name: value for name, value in scene.deck["Node Sets"].items() if name in used}
    return scene


def shrunk(case, name, problem, case_of, failure_of):
    scene, tried, again = case.scene, 0, True
    while again and tried < MOST:
        again = False
        for one in smaller(scene):
            tried += 1
            if tried > MOST:
                break
            try:
                smaller_case = case_of(tidied(one))
                found, _ = (None, None) if smaller_case.base.refused or smaller_case.base.status in ("crash", "hang") else failure_of(smaller_case, name)
            except Exception:  # a scene that lacks what a relation looks for is no smaller one
                continue
            if found and alike(found, problem):
                scene, problem, again = one, found, True
                break
    return scene, problem
