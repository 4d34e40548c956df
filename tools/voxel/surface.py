"""A closed surface (STL, by VTK) as an image: the signed distance of each voxel's middle, positive inside, in m."""
import itertools
from dataclasses import dataclass

import numpy as np
from scipy import ndimage
from scipy.optimize import brentq
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkImplicitPolyDataDistance, vtkPolyDataConnectivityFilter, vtkPolyDataNormals
from vtkmodules.vtkImagingStencil import vtkImageStencilToImage, vtkPolyDataToImageStencil
from vtkmodules.vtkIOGeometry import vtkSTLReader

from images import Image
from solid import fills_of
from strut_tools import captured, check_input, fail

BAND = 3  # voxels from the surface within which the distance is that of the triangles
TIE = 1e-6  # voxels from a triangle within which a middle is on it
ASIDE = 1e-3  # voxels from a middle to the places that tell whether there is solid on all sides
MOSTLY_OUT = 0.1  # largest volume fraction in bodies of a piece that counts as outside them


def read(path, edge, factor=1.0, in_part=False):
    """edge: of a voxel, m; factor: the unit of the file's lengths, m; in_part: distances are used, not their signs alone."""
    check_input(path)
    reader = vtkSTLReader()
    with captured() as said:
        reader.SetFileName(path)
        reader.Update()
        surface = reader.GetOutput()
    if said.error() or surface.GetNumberOfPolys() == 0:
        fail(f"{path} cannot be read as STL, or has no triangles")
    places = vtk_to_numpy(surface.GetPoints().GetData())
    places[:] = places.astype(float) * factor  # rounded once
    surface.GetPoints().Modified()
    check_closed(path, surface)
    low, high = np.reshape(surface.GetBounds(), (3, 2)).T
    shape = np.maximum(1, np.ceil((high - low) / edge - 1e-3)).astype(int)
    if np.prod(shape.astype(float)) > 4e9:
        fail(f"{path}: {' x '.join(map(str, shape))} voxels of {edge:g} m; expected a larger --voxel-size")
    low = 0.5 * (low + high - edge * shape)  # the box holds whole voxels, as much more at either side
    pieces = list(pieces_of(surface))
    signs, turned, bodies = signs_of(path, pieces, low, edge, shape)
    twice = np.count_nonzero(bodies > 1)
    if twice and in_part:
        fail(f"{path}: bodies overlap in {twice:,} voxels, so that not all triangles are surface, and --grey and --density have no meaning; "
             "expected the union of the bodies")
    values, ties = distances(surface, bodies > 0, low, edge)
    if ties.any() and len(pieces) > 1:
        values[ties & all_around(pieces, signs, low, edge, shape)] = np.float32(TIE * edge)
    volume = sum(sign * piece.volume for piece, sign in zip(pieces, signs))
    told = f"closed surface of {surface.GetNumberOfPolys():,} triangles in STL, volume {volume:.6g} m3"
    if twice:
        told += f", overlaps twice; bodies overlap in {twice:,} voxels, which are solid"
    elif not in_part and volume > 0:
        told += f" ({round(100 * (np.count_nonzero(values > 0) * edge**3 / volume - 1), 2) + 0:+.2f} % in voxels)"
    if turned:
        told += f"; {turned} wound the other way and outside the rest, taken as {'a body' if turned == 1 else 'bodies'}"
    return Image(values, (edge,) * 3, told)


def check_closed(path, surface):
    edges = vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.BoundaryEdgesOn(), edges.NonManifoldEdgesOn(), edges.FeatureEdgesOff(), edges.ManifoldEdgesOff()
    edges.Update()
    count = edges.GetOutput().GetNumberOfCells()
    if count:
        fail(f"{path}: the surface is not closed: {count} edges do not have two triangles; expected what bounds a body")


@dataclass
class Piece:
    surface: object  # vtkPolyData
    volume: float    # m³
    sign: int        # +1, or -1 if it is wound the other way than the largest piece


def pieces_of(surface):
    """The connected pieces of a closed surface, the largest first."""
    alike, regions = vtkPolyDataNormals(), vtkPolyDataConnectivityFilter()
    alike.SetInputData(surface)
    alike.ConsistencyOn(), alike.SplittingOff()
    regions.SetInputConnection(alike.GetOutputPort())
    regions.SetExtractionModeToAllRegions(), regions.ColorRegionsOn()
    regions.Update()
    whole = regions.GetOutput()
    places = vtk_to_numpy(whole.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(whole.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    region = vtk_to_numpy(whole.GetPointData().GetArray("RegionId"))[triangles[:, 0]]
    a, b, c = np.moveaxis((places - places.mean(axis=0))[triangles], 1, 0)
    volumes = np.bincount(region, np.einsum("ij,ij->i", a, np.cross(b, c)) / 6)
    signs = np.sign(volumes * volumes[np.argmax(np.abs(volumes))])
    by_region = np.split(triangles[np.argsort(region, kind="stable")], np.cumsum(np.bincount(region))[:-1])
    for number in np.argsort(-np.abs(volumes), kind="stable"):
        own = by_region[number]
        used, numbers = np.unique(own, return_inverse=True)
        piece, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
        points.SetData(numpy_to_vtk(places[used], deep=True))
        cells.SetData(3, numpy_to_vtk(numbers.reshape(-1).astype(np.int64), deep=True, array_type=16))
        piece.SetPoints(points), piece.SetPolys(cells)
        yield Piece(piece, abs(float(volumes[number])), int(signs[number]))


def signs_of(path, pieces, low, edge, shape):
    """+1 for each piece that bounds a body, -1 for a cavity; the number of turned pieces; and the number of bodies that
    contain the middle of each voxel (z, y, x). A piece wound the other way is a cavity if it is in a body, else a body,
    which turns the pieces within it, too."""
    count, turn, signs, turned = np.zeros(shape[::-1], np.int32), np.ones(shape[::-1], np.int8), [], 0
    for piece in pieces:
        part, inside = part_inside(piece, low, edge, shape)
        sign = piece.sign * (-1 if np.any(inside) and turn[part][inside].mean() < 0 else 1)
        within = (count[part][inside] > 0).mean() if sign < 0 and np.any(inside) else 1.0
        if MOSTLY_OUT < within < 1 - MOSTLY_OUT:
            fail(f"{path}: a piece of {piece.volume:.4g} m3 is wound the other way, as a cavity, but only {100 * within:.0f} % of it is "
                 "in a body; expected a cavity inside, or a body wound as the others")
        if sign < 0 and within <= MOSTLY_OUT:
            sign, turned = 1, turned + 1
            turn[part][inside] *= -1
        count[part] += sign * inside
        signs.append(sign)
    return signs, turned, count


def all_around(pieces, signs, low, edge, shape):
    """True for each voxel whose middle has solid on all sides, though it may be on a triangle: inside a second body, or where
    two bodies touch."""
    found = np.ones(shape[::-1], bool)
    for corner in itertools.product((-ASIDE, ASIDE), repeat=3):
        count = np.zeros(shape[::-1], np.int32)
        for piece, sign in zip(pieces, signs):
            part, inside = part_inside(piece, low + edge * np.array(corner), edge, shape)
            count[part] += sign * inside
        found &= count > 0
    return found


def part_inside(piece, low, edge, shape):
    """The part of the box around a piece, as slices (z, y, x), and which middles in it are inside."""
    least, most = np.reshape(piece.surface.GetBounds(), (3, 2)).T
    first = np.clip(np.floor((least - low) / edge).astype(int) - 1, 0, shape - 1)
    last = np.clip(np.ceil((most - low) / edge).astype(int) + 1, 0, shape - 1)
    part = tuple(slice(a, b + 1) for a, b in zip(first[::-1], last[::-1]))
    return part, inside_of(piece.surface, low + first * edge, edge, last - first + 1)


def inside_of(surface, low, edge, shape):
    """True for each voxel (z, y, x) whose middle is inside."""
    stencil, image = vtkPolyDataToImageStencil(), vtkImageStencilToImage()
    stencil.SetInputData(surface)
    stencil.SetOutputSpacing(edge, edge, edge)
    stencil.SetOutputOrigin(*(low + 0.5 * edge))
    stencil.SetOutputWholeExtent(0, int(shape[0]) - 1, 0, int(shape[1]) - 1, 0, int(shape[2]) - 1)
    stencil.SetTolerance(1e-9)
    image.SetInputConnection(stencil.GetOutputPort())
    image.SetInsideValue(1), image.SetOutsideValue(0), image.SetOutputScalarTypeToUnsignedChar()
    image.Update()
    return vtk_to_numpy(image.GetOutput().GetPointData().GetScalars()).reshape(shape[::-1]).astype(bool)


def distances(surface, inside, low, edge):
    """The signed distances, and True for each voxel whose middle is on a triangle."""
    padded = np.pad(inside, 1)
    far = (ndimage.distance_transform_edt(padded) + ndimage.distance_transform_edt(~padded))[1:-1, 1:-1, 1:-1] - 0.5
    values = np.where(inside, far, -far).astype(np.float32) * np.float32(edge)
    near = np.argwhere(far < BAND)
    middles = low + (near[:, ::-1] + 0.5) * edge
    implicit, found = vtkImplicitPolyDataDistance(), vtkDoubleArray()
    implicit.SetInput(surface)
    implicit.EvaluateFunction(numpy_to_vtk(np.ascontiguousarray(middles), deep=True), found)
    exact = np.abs(vtk_to_numpy(found))
    there = tuple(near.T)
    values[there] = np.where(inside[there], exact, -exact)
    ties = np.zeros(inside.shape, bool)
    ties[there] = exact <= TIE * edge
    return values, ties


def moved_to(values, edge, share, in_part):
    """The distances from a surface moved outward or inward until this fraction of the box is solid (by whole voxels or
    in part), and the displacement."""
    if not in_part:
        level = np.quantile(values, 1 - share, method="higher")
        return values - np.float32(level), -float(level)
    level = brentq(lambda level: fills_of(values, level - 0.5 * edge, level + 0.5 * edge).mean(dtype=float) - share,
                   float(values.min()) - edge, float(values.max()) + edge, xtol=1e-9 * edge)
    return values - np.float32(level), -level
