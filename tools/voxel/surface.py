"""A closed surface (STL, by VTK) as an image: the signed distance of each voxel's middle, positive inside, in m."""
import numpy as np
from scipy import ndimage

from images import Image
from strut_tools import captured, check_input, fail

BAND = 3  # voxels from the surface within which the distance is that of the triangles


def read(path, edge, factor=1.0, in_part=False):
    """edge: of a voxel, m; factor: the unit of the file's lengths, m; in_part: distances are used, not their signs alone."""
    from vtkmodules.vtkIOGeometry import vtkSTLReader

    check_input(path)
    reader = vtkSTLReader()
    with captured() as said:
        reader.SetFileName(path)
        reader.Update()
        surface = reader.GetOutput()
    if said.error() or surface.GetNumberOfPolys() == 0:
        fail(f"{path} cannot be read as STL, or has no triangles")
    surface = scaled(surface, factor)
    check_closed(path, surface)
    low, high = np.reshape(surface.GetBounds(), (3, 2)).T
    shape = np.maximum(1, np.ceil((high - low) / edge - 1e-3)).astype(int)
    if np.prod(shape.astype(float)) > 4e9:
        fail(f"{path}: {' x '.join(map(str, shape))} voxels of {edge:g} m; expected a larger --voxel-size")
    low = 0.5 * (low + high - edge * shape)  # the box holds whole voxels, as much more at either side
    bodies = bodies_in(surface, low, edge, shape)
    twice = np.count_nonzero(bodies > 1)
    if twice and in_part:
        fail(f"{path}: bodies overlap in {twice:,} voxels, so that not all triangles are surface, and --grey and --density have no meaning; "
             "expected the union of the bodies")
    overlap = f"; bodies overlap in {twice:,} voxels, which are solid" if twice else ""
    return Image(distances(surface, bodies > 0, low, edge), (edge,) * 3,
                 f"closed surface of {surface.GetNumberOfPolys():,} triangles in STL, volume {volume_of(surface):.6g} m3{overlap}")


def scaled(surface, factor):
    from vtkmodules.vtkCommonTransforms import vtkTransform
    from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter

    scale, move = vtkTransform(), vtkTransformPolyDataFilter()
    scale.Scale(factor, factor, factor)
    move.SetTransform(scale)
    move.SetInputData(surface)
    move.Update()
    return move.GetOutput()


def check_closed(path, surface):
    from vtkmodules.vtkFiltersCore import vtkFeatureEdges

    edges = vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.BoundaryEdgesOn(), edges.NonManifoldEdgesOn(), edges.FeatureEdgesOff(), edges.ManifoldEdgesOff()
    edges.Update()
    count = edges.GetOutput().GetNumberOfCells()
    if count:
        fail(f"{path}: the surface is not closed: {count} edges do not have two triangles; expected what bounds a body")


def volume_of(surface):
    from vtkmodules.vtkFiltersCore import vtkMassProperties

    mass = vtkMassProperties()
    mass.SetInputData(surface)
    return mass.GetVolume()


def pieces_of(surface):
    """The connected pieces of a closed surface, and +1, or -1 for those that are turned round against the largest one: cavities."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkPolyDataConnectivityFilter, vtkPolyDataNormals

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
    order = np.argsort(region, kind="stable")
    for own, sign in zip(np.split(triangles[order], np.cumsum(np.bincount(region))[:-1]), signs):
        used, numbers = np.unique(own, return_inverse=True)
        piece, points, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
        points.SetData(numpy_to_vtk(places[used], deep=True))
        cells.SetData(3, numpy_to_vtk(numbers.reshape(-1).astype(np.int64), deep=True, array_type=16))
        piece.SetPoints(points), piece.SetPolys(cells)
        yield piece, int(sign)


def bodies_in(surface, low, edge, shape):
    """In how many bodies the middle of each voxel (z, y, x) is; the surface of a cavity takes one away."""
    count = np.zeros(shape[::-1], np.int32)
    for piece, sign in pieces_of(surface):
        least, most = np.reshape(piece.GetBounds(), (3, 2)).T
        first = np.clip(np.floor((least - low) / edge).astype(int) - 1, 0, shape - 1)
        last = np.clip(np.ceil((most - low) / edge).astype(int) + 1, 0, shape - 1)
        part = tuple(slice(a, b + 1) for a, b in zip(first[::-1], last[::-1]))
        count[part] += sign * inside_of(piece, low + first * edge, edge, last - first + 1)
    return count


def inside_of(surface, low, edge, shape):
    """True for each voxel (z, y, x) whose middle is inside."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkImagingStencil import vtkImageStencilToImage, vtkPolyDataToImageStencil

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
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkDoubleArray
    from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

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
    return values


def moved_to(values, edge, share, in_part):
    """The distances from a surface moved outward or inward, so that this share of the box is solid, by whole voxels or in part;
    and how far."""
    if not in_part:
        level = np.quantile(values, 1 - share, method="higher")
        return values - np.float32(level), -float(level)
    low, high = float(values.min()) - edge, float(values.max()) + edge
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if fills_of(values - np.float32(middle), edge).mean(dtype=float) > share else (low, middle)
    return values - np.float32(high), -high


def fills_of(values, edge):
    """The solid part of each voxel, by a plane across its middle."""
    return np.clip(0.5 + values / np.float32(edge), 0, 1)
