"""The size of the body in a mesh (Exodus II), from its elements: points are inside of it, and gathered cells extend
beyond it."""
import os

import numpy as np
from exodus import names_in, opened

SOLIDS = ("HEX", "TET")
NUMBERS = ["centroid_x", "centroid_y", "centroid_z", "moment_xx", "moment_yy", "moment_zz"]


def of_blocks(path, block, what):
    """`what` of each block of this name that has elements, or of all, in the order of their numbers; None if the mesh does not
    contain it."""
    if not path or not os.path.isfile(path):
        return None
    try:
        with opened(path) as file:
            names = names_in(file, "eb_names") or [""] * len(file.dimensions["num_el_blk"])
            found = [what(file, n) for n, name in enumerate(names, 1)
                     if block in (None, name) and f"connect{n}" in file.variables and len(file[f"connect{n}"])]
    except (OSError, IndexError, KeyError, AttributeError):
        return None
    return None if not found or any(one is None for one in found) else found


def edge_of(path, block, axis):
    """The median edge (m) of the elements of a block, or of all, along an axis; None if the mesh does not contain it."""
    found = of_blocks(path, block, cells_of)
    return found and np.median(np.concatenate([edges for edges, *_ in found])[:, axis])


def box_in(path, block, whole=False):
    """Both corners (m) of the box around the elements of a block, or of all; None if the mesh does not contain it. `whole`: with
    what partly filled cells leave empty."""
    boxes = of_blocks(path, block, lambda file, number: box_of(file, number, whole))
    if boxes is None:
        return None
    return np.min([low for low, _ in boxes], axis=0), np.max([high for _, high in boxes], axis=0)


def size_of(path, block):
    """The edges of this box, m."""
    box = box_in(path, block)
    return None if box is None else box[1] - box[0]


def nodes_of(file, number):
    """The node positions of each element of a block; None if it has only points."""
    elements = file.variables[f"connect{number}"]
    if not elements.elem_type.upper().startswith(SOLIDS):
        return None
    return np.stack([file.variables["coord" + c][:] for c in "xyz"], axis=1)[elements[:] - 1]


def prisms_of(file, number):
    """Partly filled cells as prisms: centers and half edges (√3 times their radii of gyration); None for other
    elements."""
    names = names_in(file, f"attrib_name{number}")
    if not all(name in names for name in NUMBERS):
        return None
    held = file.variables[f"attrib{number}"][:][:, [names.index(name) for name in NUMBERS]]
    return held[:, :3], np.sqrt(3 * held[:, 3:])


def cells_of(file, number):
    """For the elements of a block: edges of their boxes, centers and half edges, m; None if it has only points."""
    places = nodes_of(file, number)
    if places is None:
        return None
    edges = np.ptp(places, axis=1)
    return edges, *(prisms_of(file, number) or (places.mean(axis=1), 0.5 * edges))


def box_of(file, number, whole=False):
    """Both corners of the box around the nodes of a block; None if it has only points."""
    places = nodes_of(file, number)
    if places is None:
        return None
    low, high = places.min(axis=(0, 1)), places.max(axis=(0, 1))
    prisms = None if whole else prisms_of(file, number)
    return (low, high) if prisms is None else box_of_cells(places, *prisms, low, high)


def box_of_cells(places, middle, half, low, high):
    """The box of partly filled cells: each face is at the median of the ends of the material in the cells adjacent to
    it."""
    box = [low.copy(), high.copy()]
    for c in range(3):
        least, most = places[:, :, c].min(axis=1), places[:, :, c].max(axis=1)
        for side, edge, ends in ((0, least, middle - half), (1, most, middle + half)):
            beside = np.abs(edge - box[side][c]) <= 1e-5 * (most - least)  # round-off of the nodes, whatever the size
            box[side][c] = np.clip(np.median(ends[beside, c]), low[c], high[c])
    return box
