"""The sample that is crushed: its block, area, height and density, from the recipe, the mesh or the result."""
import os
from dataclasses import dataclass, field

import numpy as np
from decks import box_of, value_in
from strut_tools import fail

from . import extent
from .source import FORCES


FULL = 0.9   # of a box: what an outline fills at least that is none of a round sample, π/4
ALIKE = 0.1  # of a size: how far the struts of a lattice may end within the box of its recipe, besides a cell


@dataclass
class Sample:
    area: float      # m²
    height: float    # m
    density: float | None  # kg/m³, mass over area and height
    found: dict = field(default_factory=dict)  # how each was found


def sample_of(deck, axis, block, words):
    found, across = {}, [a for a in range(3) if a != axis]
    size = size_of(deck, block, words, found) if words.area is None or words.height is None else None
    area = words.area if words.area is not None else area_of(deck, axis, block, size[across[0]] * size[across[1]], found)
    height = words.height if words.height is not None else size[axis]
    return Sample(area, height, density_of(deck, block, area * height, words, found), found)


def area_of(deck, axis, block, box, found):
    """The section of a cylinder along the axis, by its recipe, else that of the box around the sample (`box`, m²)."""
    recipe = deck and deck.recipe()
    if recipe and found["size"] == f"from {recipe.path}":
        return 0.25 * np.pi * box if axis == 2 and recipe.body(block)["shape"] == "cylinder" else box
    outline = extent.outline_of(deck and deck.file("Discretization", "Input Mesh File"), block, axis)
    if outline is not None and outline < FULL * box:
        found["area"] = (f"as that of the box; WARNING: the outline of the elements across the axis has {outline:.6g} m2, "
                         f"{100 * outline / box:.3g} % of it: expected --area, where the sample is no box")
    return box


def size_of(deck, block, words, found):
    recipe, mesh = deck and deck.recipe(), deck and deck.file("Discretization", "Input Mesh File")
    body, size = recipe and recipe.body(block), extent.size_of(mesh, block)
    wanted = box_of(body) if body and body.get("shape") in ("foam", "box", "lattice", "cylinder") else None
    if wanted and (size is None or np.allclose(size, wanted, rtol=ALIKE, atol=extent.edges_of(mesh, block).max())):
        found["size"] = f"from {recipe.path}"
        return wanted
    lengths = [deck and deck.get("Discretization", "TensorProduct3DMeshGenerator", f"{c} Length") for c in "XYZ"]
    if block is None and all(lengths):
        found["size"] = f"from the grid of {deck.path}"
        return [float(length) for length in lengths]
    if size is not None:
        found["size"] = f"the box around the elements of {mesh}"
        if wanted:
            found["size"] += f"; WARNING: the recipe beside it is of another mesh, of {' x '.join(f'{x:.5g}' for x in wanted)} m"
        return size
    result = result_of(deck, words)
    if result is None:
        fail("nothing says how large the sample is: name --area (m2) and --height (m)")
    nodes, volumes = points_of(result, block)
    places = result.reference[nodes]
    at_nodes = deck.get("Discretization", "Points") == "Nodes"
    found["size"] = f"from the points of {result.path}" + ("" if at_nodes else " and half a spacing around them")
    return np.ptp(places, axis=0) + (0 if at_nodes else edges_of_cells(places, volumes.max()))


def edges_of_cells(places, volume):
    """Edges (m) of the cells around points: the steps of their lattice, if its cells have this volume, else a cube's."""
    cube = np.cbrt(volume)
    ways = [np.diff(np.unique(places[:, a])) for a in range(3)]
    steps = [way[way > 1e-4 * cube] for way in ways]  # smaller ones are round-off
    edges = np.array([step.min() if len(step) else np.nan for step in steps])
    alone = np.isnan(edges)  # one layer
    if alone.any():
        edges[alone] = (volume / np.prod(edges[~alone]))**(1 / alone.sum())
    multiples = all(np.allclose(step / edge, np.round(step / edge), rtol=0, atol=1e-3) for step, edge in zip(steps, edges))
    return edges if multiples and np.isclose(np.prod(edges), volume, rtol=1e-3) else cube


def result_of(deck, words):
    """The result of the deck, opened; None if there is none (yet)."""
    from picture_parts.result import Result

    name = deck and deck.get("Output", "Output Filename")
    if not name:
        return None
    path = os.path.join(words.results, name if os.path.splitext(name)[1] else name + ".e")
    return Result(path) if os.path.isfile(path) else None


def points_of(result, block):
    """Nodes and volumes of a block, or of all."""
    blocks = result.blocks_of(block and [block])
    if any(b.volumes is None for b in blocks):
        fail(f"{result.path} does not say how large its points are: name --area (m2) and --height (m)")
    return np.concatenate([b.nodes for b in blocks]), np.concatenate([b.volumes for b in blocks])


def block_of(deck, names, words):
    """The crushed block: --block, that of a contact force, else the only foam or lattice of the recipe, or the one named foam; None: all."""
    if words.block:
        return words.block
    for name in names:
        match = FORCES.fullmatch(name)
        if match and match[1] == "Contact_Force":
            return match[3].split(":")[0]
    recipe = deck and deck.recipe()
    foams = [b.get("name", "body") for b in (recipe.bodies() if recipe else []) if b.get("shape") in ("foam", "lattice")]
    if len(foams) == 1:
        return foams[0]
    blocks = deck and [value_in(keys, "Block Names") for keys in deck.sections("Blocks").values()]
    return "foam" if blocks and len(blocks) > 1 and "foam" in blocks else None


def density_of(deck, block, volume, words, found):
    if words.density is not None or deck is None:
        return words.density
    result = result_of(deck, words)
    if result is not None and all(b.volumes is not None for b in result.blocks):
        return density_of_points(deck, result, block, volume, found)
    recipe = deck.recipe()
    body = recipe and recipe.body(block)
    material = body and "relative_density" in body and material_density(deck, block or body.get("name", "body"))
    if not material:
        return None
    found["density"] = f"from {recipe.path}"
    return material * float(body["relative_density"])


def density_of_points(deck, result, block, volume, found):
    """The mass of all blocks of the sample, each of its own material, over the volume."""
    volumes = {b.name: b.volumes.sum() for b in result.blocks_of(block and [block]) if len(b.nodes)}
    materials = {name: material_density(deck, name) for name in volumes}
    unknown = next((name for name, value in materials.items() if not value), None)
    found["density"] = f"from the points of {result.path}" if unknown is None else f"nowhere: {deck.path} has none for block '{unknown}'"
    return sum(materials[name] * volumes[name] for name in volumes) / volume if unknown is None else None


def material_density(deck, block):
    """Density of the material of a block, kg/m³."""
    sections = [(keys, (value_in(keys, "Block Names") or "").split()) for keys in deck.sections("Blocks").values()]
    named = any(block in names for _, names in sections)
    for keys, names in sections:
        if block in names or "all" in names or ("default" in names and not named):
            value = deck.get("Materials", value_in(keys, "Material") or "", "Density")
            return value and float(value)
    return None
