"""A closed surface (STL, by VTK) as an image: the signed distance of each voxel's middle, positive inside, in m."""
import numpy as np
from scipy import ndimage

from images import Image
from strut_tools import captured, check_input, fail

BAND = 3  # voxels from the surface within which the distance is that of the triangles


def read(path, edge, factor=1.0):
    """edge: of a voxel, m; factor: the unit of the file's lengths, m."""
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
    inside = inside_of(surface, low, edge, shape)
    return Image(distances(surface, inside, low, edge), (edge,) * 3,
                 f"closed surface of {surface.GetNumberOfPolys():,} triangles in STL, volume {volume_of(surface):.6g} m3")


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


def inside_of(surface, low, edge, shape):
    """Whether the middle of each voxel (z, y, x) is inside."""
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
