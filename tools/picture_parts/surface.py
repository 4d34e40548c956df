"""The surface of a cloud of material points, which moves with them: where a sum of round bumps, one a point, falls below the level
that encloses the volume of the points. Points of very different distances, as of tetrahedra, are cubes by themselves.
"""
import numpy as np
from scipy.ndimage import gaussian_filter
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D, vtkWindowedSincPolyDataFilter

TORN = 1.5        # spacings: points that have moved apart by more are not joined
NEAR = 4          # number of points that a corner of the surface moves with
BUMP = 0.7        # spacings: a bump falls as exp(-(distance/BUMP)^2)
MANY, MOST = 2.4e7, 1e8  # places at which the sum is taken: usually, and at the most
LEVELS = 0.8, 1.25  # limits of the level; the surface of a row of points that touch has the level 1
INSIDE = 1.7      # value of the sum above which bumps are lowered; in a row it is at most this, inside a body 2.7
EVEN = 1.7        # distance to the nearest point, in spacings, above which bumps do not join
LONG = 1.5        # spacings over the usual distance to the nearest point: of cells that are longer elsewhere, whose bumps do not join


class Surface:
    """Corners (c x 3, in the reference), quads (m x 4 corners; of triangles the last comes twice), the point that each quad
    belongs to, and of each corner the points that it moves with (c x NEAR), their weights, and their spacing."""

    def __init__(self, corners, quads, point, near, weights, spacing):
        self.corners, self.quads, self.point, self.near, self.weights = corners, quads, point, near, weights
        self.spacing = np.broadcast_to(spacing, len(corners))

    def moved(self, displacement):
        """Corners and quads by the displacement of the points. Where points have moved apart, faces between them, which would be
        drawn out to sheets, go with their own point."""
        u = displacement[self.near]
        apart = np.linalg.norm(u - u[:, :1], axis=2) > TORN * self.spacing[:, None]
        weights = np.where(apart, 0, self.weights)
        corners = self.corners + np.einsum("ck,ckx->cx", weights / weights.sum(axis=1, keepdims=True), u)
        across = np.linalg.norm(u[self.quads, 0] - displacement[self.point, None], axis=2)
        torn = (across > TORN * self.spacing[self.quads]).any(axis=1)
        own = (self.corners[self.quads[torn]] + displacement[self.point[torn], None]).reshape(-1, 3)
        quads = self.quads.copy()
        quads[torn] = len(corners) + np.arange(len(own)).reshape(-1, 4)
        return np.concatenate([corners, own]), quads


def joined(surfaces):
    start = np.cumsum([0] + [len(s.corners) for s in surfaces])
    quads = np.concatenate([s.quads + n for s, n in zip(surfaces, start)])
    parts = ([getattr(s, name) for s in surfaces] for name in ("point", "near", "weights", "spacing"))
    return Surface(np.concatenate([s.corners for s in surfaces]), quads, *map(np.concatenate, parts))


def polydata(corners, quads):
    """VTK's polydata of a surface."""
    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(corners), deep=True))
    cells.SetData(*(numpy_to_vtkIdTypeArray(ids.astype(np.int64), deep=True) for ids in (np.arange(0, quads.size + 1, 4), quads.ravel())))
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def places_of(data):
    """Positions of VTK's points."""
    return vtk_to_numpy(data.GetPoints().GetData())


def edge_of(places, volumes):
    """Edge of the mean point as a cube."""
    if volumes is not None:
        return np.cbrt(volumes.mean())
    sides = np.ptp(places, axis=0)
    sides = sides[sides > 0]  # a single layer has no thickness
    return (np.prod(sides) / len(places))**(1 / len(sides)) if len(sides) else 1.0


def spacing_of(places, volumes):
    """Spacing of points along each axis, and the volume of each; None where bumps of one width do not join them."""
    edge = edge_of(places, volumes)
    gaps = [np.diff(np.sort(x)) / edge for x in places.T]
    least = np.array([np.min(between[between > 0.02], initial=np.inf) for between in gaps])
    least[np.isinf(least)] = np.nan
    least[np.isnan(least)] = np.nanprod(least)**(-1 / max(1, np.isnan(least).sum()))  # a single layer is as thick as the volume is
    steps = (places - places.min(axis=0)) / (least * edge)
    if abs(least.prod() - 1) < 0.2 and np.abs(steps - np.rint(steps)).max() < 0.1:  # a lattice
        return least * edge
    apart = cKDTree(places).query(places, 2)[0][:, 1] if len(places) > 1 else np.array([edge])
    cell = max(np.median(apart), np.cbrt(np.quantile(volumes, 0.98))) if volumes is not None else np.median(apart)
    return np.full(3, cell) if np.quantile(apart, 0.95) < EVEN * cell < EVEN * LONG * np.median(apart) else None


def surface_of(places, volumes, points):
    """The surface of a block; points are their numbers in the result."""
    spacing = spacing_of(places, volumes)
    size = None if spacing is None else np.ptp(places / spacing, axis=0) + 4
    if size is None or size.prod() > MOST:
        return separate_cubes(places, volumes, points)
    fine = int(np.clip(np.cbrt(MANY / size.prod()), 1, 3))  # places of the sum along a spacing
    origin, edge = places.min(axis=0) - 2 * spacing, spacing / fine
    fills = np.ones(len(places)) if volumes is None else np.minimum(volumes / spacing.prod(), 1)
    # A row of points, a spacing apart, has the volume of its points within the level 1.
    height, at = np.exp(fills / (np.pi * BUMP**2)) / (np.sqrt(np.pi) * BUMP), (places - origin) / edge
    size = np.ceil(size * fine).astype(int)
    here = sum_of_bumps(at, height, size, fine)[tuple(at.astype(int).T)]
    total = sum_of_bumps(at, height / np.maximum(1, here / INSIDE), size, fine)
    inside = total.size - int(np.clip(fills.sum() * fine**3, 1, total.size))
    level = np.clip(np.partition(total, inside, axis=None)[inside], *LEVELS)
    corners, quads = contour(total, min(level, 0.9 * total.max()))  # a small piece alone is drawn, too
    corners = origin + (corners + 0.5) * edge
    tree = cKDTree(places / spacing)
    apart, near = (found.reshape(len(corners), -1) for found in tree.query(corners / spacing, min(NEAR, len(places))))
    near = np.pad(near, [(0, 0), (0, NEAR - near.shape[1])], mode="edge")
    weights = np.pad(np.exp(-(apart**2 - apart[:, :1]**2) / BUMP**2), [(0, 0), (0, NEAR - apart.shape[1])])
    point = tree.query(corners[quads].mean(axis=1) / spacing)[1]
    return Surface(corners, quads, points[point], points[near], weights, np.max(spacing))


def sum_of_bumps(at, height, size, fine):
    """At places 0.5, 1.5, ... along each axis."""
    width = fine * BUMP / np.sqrt(2)  # standard deviation
    total, lower = np.zeros(np.prod(size)), np.floor(at - 0.5).astype(int)
    part = at - 0.5 - lower
    for corner in np.ndindex(2, 2, 2):  # each is shared out to the eight places around it
        share = np.prod(np.where(corner, part, 1 - part), axis=1)
        total += np.bincount(np.ravel_multi_index((lower + corner).T, size), height * share, len(total))
    total = total.astype(np.float32).reshape(size)
    return gaussian_filter(total, np.sqrt(width**2 - 1 / 6), mode="constant", truncate=3) * (2 * np.pi * width**2)**1.5


def contour(values, level):
    """Corners and quads of the surface, outwards."""
    image, data = vtkImageData(), numpy_to_vtk(values.ravel(order="F"), deep=True)
    image.SetDimensions(values.shape)
    image.GetPointData().SetScalars(data)
    edges, smooth = vtkFlyingEdges3D(), vtkWindowedSincPolyDataFilter()
    edges.SetInputData(image)
    edges.SetValue(0, level)
    edges.ComputeNormalsOff()
    edges.ComputeScalarsOff()
    smooth.SetInputConnection(edges.GetOutputPort())  # takes off what the places of the sum leave
    smooth.SetPassBand(0.1)
    smooth.Update()
    found = smooth.GetOutput()
    triangles = vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return places_of(found).astype(float), triangles[:, [0, 1, 2, 2]]


def separate_cubes(places, volumes, points):
    edges = np.cbrt(volumes) if volumes is not None else np.full(len(places), edge_of(places, volumes))
    corners = np.array(list(np.ndindex(2, 2, 2)))[[4, 6, 7, 5, 0, 1, 3, 2, 2, 3, 7, 6, 0, 4, 5, 1, 1, 5, 7, 3, 0, 2, 6, 4]] - 0.5
    placed = places[:, None, :] + edges[:, None, None] * corners
    near = np.repeat(points, 24)[:, None].repeat(NEAR, axis=1)
    return Surface(placed.reshape(-1, 3), np.arange(len(near)).reshape(-1, 4), np.repeat(points, 6), near, np.ones(near.shape), np.inf)
