"""Meshes and voxels from arrays of NumPy, in memory; rank 0's count."""
import os
import sys

import numpy as np

from . import _core
from .places import TOOLS

sys.path.append(os.path.join(TOOLS, "shared"))
sys.path.append(os.path.join(TOOLS, "voxel"))
import cells  # noqa: E402
from strut_tools import parts_of  # noqa: E402

TYPES = {8: "HEX8", 4: "TET4", 1: "SPHERE"}


def mesh(nodes, blocks=None, sets=None, volumes=None):
    """nodes: N x 3, in m; blocks: {name: nodes of each element, from 0}, 8 in a row (hexahedra, in the order of Exodus),
    4 (tetrahedra) or 1 (spheres, which need volumes: {name: m³}); sets: {name: nodes}. Or the name of an Exodus file."""
    if isinstance(nodes, (str, os.PathLike)):
        return _core.Mesh.of_file(os.fspath(nodes))
    nodes = np.asarray(nodes, float)
    if nodes.ndim != 2 or nodes.shape[1] != 3:
        raise _core.Error(f"nodes: an array of shape {nodes.shape}; expected N x 3, in m")
    listed = [block(name, np.asarray(elements), (volumes or {}).get(name)) for name, elements in (blocks or {}).items()]
    return of_parts(parts_of(nodes, listed, {checked(name): whole(members, f"set '{name}'") for name, members in (sets or {}).items()}))


def block(name, elements, volumes):
    if elements.ndim == 1:
        elements = elements.reshape(-1, 1)
    if elements.ndim != 2 or elements.shape[1] not in TYPES:
        raise _core.Error(f"block '{name}': an array of shape {elements.shape}; expected the nodes of one element in a row: 8, 4 or 1")
    kind = TYPES[elements.shape[1]]
    if (kind == "SPHERE") != (volumes is not None) or np.size(volumes) not in (1, len(elements)):
        raise _core.Error(f"block '{name}': spheres, and only these, have volumes, one for each of them")
    return checked(name), kind, whole(elements, f"block '{name}'"), None if volumes is None else np.asarray(volumes, float)


def checked(name):
    if not name or len(name.split()) != 1:
        raise _core.Error(f"'{name}' cannot be the name of a block or set: it is empty or has a blank")
    return name


def whole(numbers, user):
    numbers = np.asarray(numbers)
    if numbers.size and not np.issubdtype(numbers.dtype, np.integer):
        raise _core.Error(f"{user}: numbers of type {numbers.dtype}; expected whole ones, the nodes from 0")
    if numbers.size and (numbers.min() < 0 or numbers.max() >= 2**31):
        raise _core.Error(f"{user} refers to node {numbers.min() if numbers.min() < 0 else numbers.max()}; expected 0 or more")
    return numbers


def voxels(solid, spacing, origin=(0, 0, 0), name="foam", gather=None, smallest=0.3):
    """The voxels of an array [x, y, z] that are solid, one element each; sets NAME_xmin, … of the faces of the box that
    they touch. spacing: of voxels, m, one or three numbers; origin: the lower corner, m. gather=N: cells of N³ voxels,
    partly filled (tools/README.md); solid may then be the part of each voxel that is solid, 0 to 1, and cells that are
    less than `smallest` full join a neighbor."""
    solid = np.asarray(solid)
    if solid.ndim != 3 or not np.any(solid):
        raise _core.Error(f"voxels: an array of shape {solid.shape}{'' if np.any(solid) else ', none of them solid'}; expected x, y, z")
    edges = np.broadcast_to(np.asarray(spacing, float), 3)
    if not (np.all(edges > 0) and np.all(np.isfinite(edges))):
        raise _core.Error(f"voxels: a spacing of {spacing}; expected one or three numbers > 0, in m")
    filled = solid.transpose()  # z, y, x, as the tools have it
    is_grey = np.issubdtype(solid.dtype, np.floating) and not np.all((solid == 0) | (solid == 1))
    if is_grey and not gather:
        raise _core.Error("voxels: parts of voxels that are solid need gather=N; expected truth values, or 0 and 1")
    checked(name)
    if gather:
        return of_parts(cells.gathered(filled > 0, edges, origin, gather, smallest, name, filled if is_grey else None))
    nodes, blocks, sets = cells.mesh_of(filled > 0, edges, origin, "hex", name)
    return of_parts(parts_of(nodes, blocks, sets))


def recipe(file):
    """The mesh of a recipe (tools/README.md)."""
    return _core.Mesh.of_recipe(os.fspath(file))


def of_parts(parts):
    """parts: bytes, or (array, type), as strut-mesh --arrays reads them."""
    return _core.Mesh.of_arrays(b"".join(
        np.ascontiguousarray(part[0], part[1]).tobytes() if isinstance(part, tuple) else part for part in parts))
