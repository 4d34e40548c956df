"""Lists of points that are the centers of voxels: the lattice is recovered from the coordinates."""
import gzip
import warnings

import numpy as np

from strut_tools import fail

# Tolerance of a coordinate, in spacings: text often has six digits, which on a lattice of a thousand positions leaves
# an error of a thousandth of the spacing.
TOLERANCE = 0.05
# Distinct coordinates closer than this fraction of the extent are one, rounded: more than 5000 positions in a row
# are not possible in a text with six digits anyway.
SAME = 1e-4
MOST_PLACES = 2**31


def read(path):
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # an empty file is reported below
            points = np.loadtxt(path, ndmin=2)
    except (EOFError, gzip.BadGzipFile, OSError, ValueError, UnicodeDecodeError) as error:
        fail(f"{path} is not a list of points 'x y z', one a line: {str(error).splitlines()[0]}")
    except Exception as error:  # zlib.error is not among the above
        fail(f"{path} cannot be unpacked: {error}")
    if points.size == 0:
        fail(f"{path} holds no points; expected 'x y z', one point a line")
    if points.shape[1] != 3:
        fail(f"{path}: {points.shape[1]} numbers a line, expected 3: 'x y z'")
    bad = ~np.isfinite(points).all(axis=1)
    if bad.any():
        fail(f"{path}: point {bad.argmax() + 1} is not finite: {shown(points[bad.argmax()])}")
    return points


def shown(point):
    return " ".join(f"{x:g}" for x in point)


def distinct(values):
    """Sorted values, with those merged that differ only by rounding; and the index of each value among them."""
    ordered, inverse = np.unique(values, return_inverse=True)
    new = np.diff(ordered) > SAME * (ordered[-1] - ordered[0])
    group = np.concatenate([[0], np.cumsum(new)])
    return np.bincount(group, ordered) / np.bincount(group), group[inverse]


def fitted(places, guess):
    """Lattice numbers of the positions, spacing and first position by least squares; largest error in spacings."""
    steps = np.concatenate([[0], np.cumsum(np.rint(np.diff(places) / guess).astype(np.int64))])
    if steps[-1] == 0:
        return steps, guess, places[0], np.inf
    spacing, first = np.polyfit(steps, places, 1)
    return steps, spacing, first, np.abs(places - first - steps * spacing).max() / spacing


def axis_of(path, values, name):
    """Lattice number of each value, spacing and first position; spacing None if all values are equal."""
    if np.ptp(values) == 0:
        return np.zeros(len(values), np.int64), None
    places, member = distinct(values)
    gaps = np.diff(places)
    # Most layers of an image contain points: the median is the spacing. If only few do, the least gap may be.
    steps, spacing, first, _ = min((fitted(places, guess) for guess in (np.median(gaps), gaps.min())),
                                   key=lambda found: found[3])
    off = np.abs(values - first - steps[member] * spacing) / spacing
    if off.max() > TOLERANCE:
        i = off.argmax()
        fail(f"{path}: the points are not on a lattice: in {name} the spacing is about {spacing:.6g}, and point "
             f"{i + 1} ({name} = {values[i]:.6g}) is {off[i]:.2g} of it off")
    return steps[member], spacing


def lattice(path):
    """The solid voxels of the box around the points (z, y, x), and the spacing (x, y, z)."""
    points = read(path)
    axes = [axis_of(path, points[:, a], "xyz"[a]) for a in range(3)]
    known = [spacing for _, spacing in axes if spacing]
    if not known:
        fail(f"{path}: one point has no spacing; expected a lattice of points")
    x, y, z = (steps for steps, _ in axes)
    shape = tuple(int(steps.max()) + 1 for steps in (z, y, x))
    if np.prod(shape, dtype=float) > MOST_PLACES:
        fail(f"{path}: the points span a lattice of {shape[2]} x {shape[1]} x {shape[0]} places, which is too large: "
             "are there points far away?")
    place = np.ravel_multi_index((z, y, x), shape)
    order = np.argsort(place, kind="stable")
    twice = np.flatnonzero(np.diff(place[order]) == 0)
    if len(twice):
        i, j = order[twice[0]], order[twice[0] + 1]
        fail(f"{path}: points {i + 1} and {j + 1} take the same place: {shown(points[i])}")
    solid = np.zeros(shape, bool)
    solid.reshape(-1)[place] = True
    # A single layer has no spacing of its own: it gets that of the finest axis.
    return solid, tuple(spacing or min(known) for _, spacing in axes)
