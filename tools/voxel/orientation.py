"""Which axis of space an axis of an image runs along, as its header says; images are turned and mirrored accordingly."""
import re

import numpy as np
from strut_tools import fail

ALONG = 1e-3  # of a direction's length across its axis of space; headers have four digits or more


def of_meta_image(path, head):
    """Directions of the axes, three rows; None if the header has none."""
    found = re.search(r"^(?:TransformMatrix|Orientation|Rotation)\s*=(.*)$", head, re.M)
    try:
        numbers = [float(word) for word in found[1].split()] if found else []
    except ValueError:
        fail(f"{path} is damaged: its directions (TransformMatrix) are '{found[1].strip()}'")
    return np.reshape(numbers, (3, 3)) if len(numbers) == 9 else None


def oriented(path, values, spacing, directions):
    """The array (z, y, x) and the spacing (x, y, z) in space. `directions`: a vector for each axis of the image, the
    fastest first; None: they are those of space."""
    if directions is None or np.shape(directions) != (3, 3):
        return values, spacing
    unit = np.array([d / np.linalg.norm(d) for d in directions])
    axes = np.abs(unit).argmax(axis=1)
    across = np.sqrt(np.maximum(0, 1 - np.abs(unit).max(axis=1)**2))
    if not (across <= ALONG).all() or sorted(axes) != [0, 1, 2]:
        fail(f"{path}: its axes do not run along x, y and z ({'; '.join(' '.join(f'{c:.4g}' for c in d) for d in unit)}), so "
             "the body would stand askew: expected an image along them: resample it, or remove the directions from its header")
    order = [int(np.where(axes == axis)[0][0]) for axis in range(3)]  # the axis of the image along x, y, z
    values = values.transpose([2 - a for a in reversed(order)])
    for axis, a in enumerate(order):
        if unit[a][axis] < 0:
            values = np.flip(values, 2 - axis)
    return values, spacing and tuple(spacing[a] for a in order)
