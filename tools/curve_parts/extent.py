"""The size of the body in a mesh (Exodus II), from its elements: points are inside of it, and gathered cells extend
beyond it."""
import os
from collections import namedtuple

import numpy as np
from exodus import names_in, opened
from scipy.spatial import ConvexHull

SOLIDS = ("HEX", "TET")
NUMBERS = ["centroid_x", "centroid_y", "centroid_z", "moment_xx", "moment_yy", "moment_zz"]

# A row for each element, in m: `low` and `high` are the corners of its box, `middle` is the center of its material and `half` are the
# half edges of it. A partly filled cell counts as a prism, whose half edges are √3 times its radii of gyration.
Elements = namedtuple("Elements", "low high middle half are_partly_filled")


def elements_of(path, block=None):
    """Elements of each block of this name that has some, or of all, in the order of their numbers; None if the mesh does not contain
    it, or has others than SOLIDS in it."""
    if not path or not os.path.isfile(path):
        return None
    try:
        with opened(path) as file:
            names = names_in(file, "eb_names") or [""] * len(file.dimensions["num_el_blk"])
            nodes = np.stack([file["coord" + c][:] for c in "xyz"], axis=1)
            found = [elements_in(file, n, nodes) for n, name in enumerate(names, 1)
                     if block in (None, name) and f"connect{n}" in file.variables and len(file[f"connect{n}"])]
    except (OSError, IndexError, KeyError, AttributeError):
        return None
    return None if not found or any(one is None for one in found) else found


def elements_in(file, number, nodes):
    connect, names = file[f"connect{number}"], names_in(file, f"attrib_name{number}")
    if not connect.elem_type.upper().startswith(SOLIDS):
        return None
    places = nodes[connect[:] - 1]
    low, high = places.min(axis=1), places.max(axis=1)
    if not all(name in names for name in NUMBERS):
        return Elements(low, high, places.mean(axis=1), 0.5 * (high - low), False)
    held = file[f"attrib{number}"][:][:, [names.index(name) for name in NUMBERS]]
    return Elements(low, high, held[:, :3], np.sqrt(3 * held[:, 3:]), True)


def edges_of(path, block):
    """The median edges (m) of the elements of a block, or of all, along the axes; None if the mesh does not contain it."""
    found = elements_of(path, block)
    return found and np.median(np.concatenate([one.high - one.low for one in found]), axis=0)


def outline_of(path, block, axis):
    """The area (m²) within the convex outline of the elements, seen along an axis; None if the mesh does not contain them."""
    found, (a, b) = elements_of(path, block), [c for c in range(3) if c != axis]
    corners = [np.stack([u[:, a], v[:, b]], axis=1) for one in found or () for u in (one.low, one.high) for v in (one.low, one.high)]
    return float(ConvexHull(np.concatenate(corners)).volume) if corners else None


def box_in(path, block, whole=False):
    """Both corners (m) of the box around the elements of a block, or of all; None if the mesh does not contain it. `whole`: with
    what partly filled cells leave empty."""
    found = elements_of(path, block)
    if found is None:
        return None
    boxes = [box_of(one, whole) for one in found]
    return np.min([low for low, _ in boxes], axis=0), np.max([high for _, high in boxes], axis=0)


def size_of(path, block):
    """The edges of this box, m."""
    box = box_in(path, block)
    return None if box is None else box[1] - box[0]


def box_of(cells, whole):
    """Both corners of the box around some cells, m. If they are partly filled, each face is at the median of the ends of the material
    in the cells adjacent to it."""
    low, high = cells.low.min(axis=0), cells.high.max(axis=0)
    box = [low.copy(), high.copy()]
    for c in range(3 if cells.are_partly_filled and not whole else 0):
        for face, edge, ends in ((box[0], cells.low, cells.middle - cells.half), (box[1], cells.high, cells.middle + cells.half)):
            # Round-off of the nodes, whatever the size.
            beside = np.abs(edge[:, c] - face[c]) <= 1e-5 * (cells.high - cells.low)[:, c]
            face[c] = np.clip(np.median(ends[beside, c]), low[c], high[c])
    return box
