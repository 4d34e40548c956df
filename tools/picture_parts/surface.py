"""The surface of a cloud of material points: the free faces of their cubes, which move with the points.

On a lattice, cubes that are neighbors share corners, and a corner moves by the mean of the points around it: the surface
stays closed while the body deforms, and faces between two cubes are not drawn. Partly filled cells are joined by rods of such
cubes. Elsewhere each point is a cube by itself.
"""
import numpy as np

from . import struts

# The six faces of a cube: the step to the neighbor, and the corners, counter-clockwise as seen from outside.
FACES = [((1, 0, 0), ((1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1))), ((-1, 0, 0), ((0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0))),
         ((0, 1, 0), ((0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0))), ((0, -1, 0), ((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1))),
         ((0, 0, 1), ((0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))), ((0, 0, -1), ((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)))]


TORN = 0.75  # spacings by which an edge of a face may grow; half of the gap is on either side


class Surface:
    """Corners (c x 3, in the reference), quads (m x 4 corners), the point that each quad belongs to, and the spacing of
    points there."""

    def __init__(self, corners, quads, point, spacing=np.inf):
        self.corners, self.quads, self.point = corners, quads, point
        self.spacing = np.broadcast_to(spacing, len(quads))

    def moved(self, displacement):
        """The corners, moved by the mean displacement of the points whose faces meet there."""
        ids = self.quads.ravel()
        count = np.bincount(ids, minlength=len(self.corners))
        u = displacement[np.repeat(self.point, 4)]
        return self.corners + np.stack([np.bincount(ids, u[:, c], len(self.corners)) / count for c in range(3)], axis=1)

    def torn(self, displacement):
        """The same for points that have moved apart: faces between them, which would be stretched to sheets, get
        separate corners."""
        def edges(corners):
            around = corners[self.quads]
            return np.linalg.norm(around - np.roll(around, 1, axis=1), axis=2)
        apart = (edges(self.moved(displacement)) - edges(self.corners) > TORN * self.spacing[:, None]).any(axis=1)
        if not apart.any():
            return self
        own = self.corners[self.quads[apart]].reshape(-1, 3)
        quads = self.quads.copy()
        quads[apart] = len(self.corners) + np.arange(len(own)).reshape(-1, 4)
        used, quads = np.unique(quads, return_inverse=True)
        return Surface(np.concatenate([self.corners, own])[used], quads.reshape(-1, 4), self.point, self.spacing)


def joined(surfaces):
    start = np.cumsum([0] + [len(s.corners) for s in surfaces])
    return Surface(np.concatenate([s.corners for s in surfaces]),
                   np.concatenate([s.quads + n for s, n in zip(surfaces, start)]),
                   np.concatenate([s.point for s in surfaces]), np.concatenate([s.spacing for s in surfaces]))


def edge_of(places, volumes):
    """The mean edge of a cube: from the volumes if they are known, else from the box around all points."""
    if volumes is not None:
        return np.cbrt(volumes.mean())
    sides = np.ptp(places, axis=0)
    sides = sides[sides > 0]  # a single layer has no thickness
    return (np.prod(sides) / len(places))**(1 / len(sides)) if len(sides) else 1.0


def spacing_of(places, edge):
    """For each axis the least distance of two layers; an axis with one layer gets the rest of the volume."""
    least = []
    for x in places.T:
        gaps = np.diff(np.sort(x))
        gaps = gaps[gaps > 0.02 * edge]
        # The span is known more accurately than one gap if the file has few digits.
        least.append(np.ptp(x) / np.rint(np.ptp(x) / gaps.min()) if len(gaps) else np.nan)
    least = np.array(least)
    single = np.isnan(least)
    if single.any():
        least[single] = (edge**3 / np.prod(least[~single]))**(1 / single.sum())
    return least


def lattice_of(places, volumes):
    """Integer coordinates and the spacing, or None if the points are not on a lattice of cells of their volume."""
    edge = edge_of(places, volumes)
    spacing = spacing_of(places, edge)
    steps = (places - places.min(axis=0)) / spacing
    cells = np.rint(steps).astype(np.int64)
    off = np.abs(steps - cells).max() > 0.1
    # Without volumes the edge is an estimate, too large for a foam.
    odd = volumes is not None and abs(np.prod(spacing) / edge**3 - 1) > 0.2
    return None if off or odd else (cells, spacing)


def surface_of(places, volumes, points):
    """The surface of one block; points are their numbers in the result."""
    found = lattice_of(places, volumes)
    if found is not None:
        cells, spacing = found
        return surface_of_cells(cells, spacing, places.min(axis=0), points, np.max(spacing))
    found = struts.voxels_of(places, volumes)
    if found is None:
        return separate_cubes(places, volumes, points)
    cells, edge, origin, owners = found
    return surface_of_cells(cells, edge, origin + 0.5 * edge, points[owners], struts.FINE * edge)


def surface_of_cells(cells, spacing, first, points, apart):
    """The surface of cubes at integer positions; first: center of the one at 0 0 0; apart: the spacing of points."""
    size = cells.max(axis=0) + 3
    weights = np.array([size[1] * size[2], size[2], 1])
    key = (cells + 1) @ weights
    free = [np.flatnonzero(~np.isin(key + step @ weights, key)) for step in np.array([f[0] for f in FACES])]
    ids = np.concatenate([key[f, None] + np.array(corners) @ weights for f, (_, corners) in zip(free, FACES)])
    used, quads = np.unique(ids, return_inverse=True)
    lower = np.stack(np.unravel_index(used, size), axis=1) - 1.5
    quads = quads.reshape(-1, 4)
    return Surface(first + smoothed(lower, quads) * spacing, quads, points[np.concatenate(free)], apart)


def smoothed(corners, quads, rounds=5):
    """Smooths the stairs of a surface of unit cubes, as a relaxing net whose corners stay within half a cube of their
    initial positions (Gibson 1998); every second step outward, to keep the thickness of thin struts (Taubin 1995)."""
    sides = quads.T
    ids = sides.ravel()
    count = np.bincount(ids, minlength=len(corners))
    now = corners
    for step in (0.6, -0.62) * rounds:
        middles = now[sides].mean(axis=0)
        around = np.stack([np.bincount(ids, np.tile(m, 4), len(corners)) / count for m in middles.T], axis=1)
        now = now + step * (around - now)
    return corners + np.clip(now - corners, -0.5, 0.5)


def separate_cubes(places, volumes, points):
    edges = np.cbrt(volumes) if volumes is not None else np.full(len(places), edge_of(places, volumes))
    corners = np.array([c for _, face in FACES for c in face]) - 0.5
    placed = places[:, None, :] + edges[:, None, None] * corners
    return Surface(placed.reshape(-1, 3), np.arange(placed.size // 3).reshape(-1, 4), np.repeat(points, 6))
