"""Voxels that look like struts, for points that are partly filled cells: their positions are centers of mass on no
lattice, so cubes would look separate. Points near each other are joined by rods whose section keeps their volume."""
import itertools

import numpy as np

FINE = 3        # voxels along a cell
JOINED = 1.45   # cells: nearer points are joined, which includes those of cells that share an edge
RAGGED = 0.1    # of the mean volume: least difference of neighbors if cells are partly filled
MOST = 2 * 10**8  # voxels of the box

# Half of the 26 neighbors, and the position itself.
OFFSETS = [o for o in itertools.product((-1, 0, 1), repeat=3) if o >= (0, 0, 0)]


def near_pairs(places, reach):
    """Indices of the pairs nearer than `reach`, each once, and their distances."""
    bins = np.floor((places - places.min(axis=0)) / reach).astype(np.int64) + 1
    size = bins.max(axis=0) + 2
    weights = np.array([size[1] * size[2], size[2], 1])
    keys = bins @ weights
    order = np.argsort(keys, kind="stable")
    found = []
    for offset in OFFSETS:
        first, last = (np.searchsorted(keys[order], keys + offset @ weights, side) for side in ("left", "right"))
        count = last - first
        i = np.repeat(np.arange(len(places)), count)
        j = order[np.arange(len(i)) - np.repeat(np.cumsum(count) - count, count) + np.repeat(first, count)]
        apart = np.linalg.norm(places[i] - places[j], axis=1)
        keep = (apart < reach) & ((i < j) | (np.array(offset) != 0).any())
        found.append((i[keep], j[keep], apart[keep]))
    return tuple(np.concatenate(part) for part in zip(*found))


def cell_of(places, volumes):
    """The edge of a cell and the pairs to join; None if the points are no partly filled cells."""
    i, j, apart = near_pairs(places, JOINED * np.cbrt(volumes.max()))
    if 2 * len(i) < len(places) or np.median(np.abs(volumes[i] - volumes[j])) < RAGGED * volumes.mean():
        return None
    nearest = np.full(len(places), np.inf)
    np.minimum.at(nearest, i, apart)
    np.minimum.at(nearest, j, apart)
    edge = max(np.median(nearest[np.isfinite(nearest)]), np.cbrt(np.quantile(volumes, 0.98)))
    keep = apart < JOINED * edge
    return edge, i[keep], j[keep]


def voxels_of(places, volumes):
    """Integer positions of voxels, their edge, the corner of the first and the point of each; None as in cell_of."""
    found = cell_of(places, volumes) if volumes is not None and len(places) > 1 else None
    if found is None:
        return None
    cell, i, j = found
    edge = cell / FINE
    origin = places.min(axis=0) - 2 * cell
    size = np.ceil((places.max(axis=0) + 2 * cell - origin) / edge).astype(np.int64)
    if size.prod() > MOST:
        return None
    radii = np.clip(np.sqrt(volumes / (np.pi * cell)), 0.9 * edge, cell)
    best, owner = np.full(size, np.inf, np.float32), np.full(size, -1, np.int32)
    for part in np.linspace(0, 1, 2 * FINE):
        at = (places[i] * (1 - part) + places[j] * part - origin) / edge
        paint(best, owner, at, (radii[i] * (1 - part) + radii[j] * part) / edge, i if part < 0.5 else j)
    paint(best, owner, (places - origin) / edge, radii / edge, np.arange(len(places)))
    cells = np.argwhere(owner >= 0)
    return cells, edge, origin, owner[tuple(cells.T)]


def paint(best, owner, at, radii, points):
    """Paints balls (in voxels); each voxel gets the point of the nearest ball."""
    base = np.floor(at).astype(np.int64)
    reach = int(np.ceil(radii.max()))
    for offset in itertools.product(range(-reach, reach + 1), repeat=3):
        places = base + offset
        apart = np.linalg.norm(places + 0.5 - at, axis=1)
        voxels = tuple(places.T)
        keep = np.flatnonzero((apart <= radii) & (apart < best[voxels]))
        keep = keep[np.argsort(-apart[keep], kind="stable")]  # of several for one voxel the last, nearest one stays
        voxels = tuple(places[keep].T)
        best[voxels], owner[voxels] = apart[keep], points[keep]
