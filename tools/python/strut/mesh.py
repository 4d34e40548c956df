"""Meshes and voxels from arrays of NumPy, in memory; rank 0's count."""
import os

import numpy as np

from . import _core
from .places import part_of_the_tools

cells = part_of_the_tools("voxel", "cells")
TYPES = {8: "HEX8", 4: "TET4", 1: "SPHERE"}


def mesh(nodes, blocks=None, sets=None, volumes=None):
    """nodes: N x 3, in m; blocks: {name: nodes of each element, from 0}, 8 in a row (hexahedra, in the order of Exodus),
    4 (tetrahedra) or 1 (spheres, which need volumes: {name: m³}); sets: {name: nodes}. Or the name of an Exodus file."""
    if isinstance(nodes, (str, os.PathLike)):
        return _core.Mesh.of_file(os.fspath(nodes))
    nodes = numbers(nodes, "nodes")
    for what, given in (("blocks", blocks), ("sets", sets), ("volumes", volumes)):
        if not isinstance(given or {}, dict):
            raise _core.Error(f"{what}: {type(given).__name__}; expected a dictionary, {{name: …}}")
    if unknown := set(volumes or {}) - set(blocks or {}):
        raise _core.Error(f"volumes of '{sorted(map(str, unknown))[0]}', which is no block; expected {', '.join(map(str, blocks or ['none']))}")
    if nodes.ndim != 2 or nodes.shape[1] != 3 or not np.all(np.isfinite(nodes)):
        raise _core.Error(f"nodes: an array of shape {nodes.shape}; expected N x 3 finite numbers, in m")
    made = _core.Mesh()
    made.set_nodes(nodes)
    for name, elements in (blocks or {}).items():
        add_block(made, name, array(elements, f"block '{name}'"), (volumes or {}).get(name), len(nodes))
    for name, members in (sets or {}).items():
        made.add_set(checked(name), indices(members, f"set '{name}'", len(nodes)))
    return made


def add_block(made, name, elements, volumes, count):
    user = f"block '{checked(name)}'"
    if elements.ndim == 1:
        elements = elements.reshape(-1, 1)
    if elements.ndim != 2 or elements.shape[1] not in TYPES:
        raise _core.Error(f"{user}: an array of shape {elements.shape}; expected the nodes of one element in a row: 8, 4 or 1")
    kind = TYPES[elements.shape[1]]
    volumes = numbers([] if volumes is None else volumes, user)
    if volumes.size != (len(elements) if kind == "SPHERE" else 0) or not np.all((volumes > 0) & np.isfinite(volumes)):
        raise _core.Error(f"{user}: {volumes.size} volumes of {len(elements)} elements of type {kind}; expected one > 0, in m³, for each "
                          "sphere, and none of other elements")
    made.add_block(name, kind, indices(elements, user, count), volumes)


def array(values, user):
    try:
        return np.asarray(values)
    except ValueError:  # rows of unequal length
        raise _core.Error(f"{user}: not an array; expected rows of equal length") from None


def numbers(values, user):
    values = array(values, user)
    if values.size and values.dtype.kind not in "biuf":
        raise _core.Error(f"{user}: an array of type {values.dtype}; expected real numbers")
    return values.astype(float)


def checked(name):
    if not isinstance(name, str):
        raise _core.Error(f"{name!r} cannot be the name of a block or set; expected a text")
    if len(name.split()) != 1:
        raise _core.Error(f"'{name}' cannot be the name of a block or set: it is empty or has a blank")
    return name


def indices(nodes, user, count):
    nodes = array(nodes, user)
    if nodes.size and not np.issubdtype(nodes.dtype, np.integer):
        raise _core.Error(f"{user}: numbers of type {nodes.dtype}; expected whole ones, the nodes from 0")
    wrong = nodes[(nodes < 0) | (nodes >= count)]
    if wrong.size:
        raise _core.Error(f"{user} refers to node {wrong.flat[0]}; the nodes are 0 to {count - 1}")
    return nodes


def voxels(solid, spacing, origin=(0, 0, 0), name="foam", gather=None, smallest=0.3):
    """The voxels of an array [x, y, z] (of a stack of pages, [z, y, x], give stack.T) that are solid, one element
    each; sets NAME_xmin, … of the faces of the box that they touch. spacing: of voxels, m, one or three numbers; origin:
    the lower corner, m. gather=N: cells of N³ voxels, partly filled (tools/README.md); solid may then be the part of each
    voxel that is solid, 0 to 1, and cells that are less than `smallest` full join a neighbor."""
    solid = array(solid, "voxels")
    if solid.dtype.kind not in "biuf":
        raise _core.Error(f"voxels: an array of type {solid.dtype}; expected truth values, or numbers from 0 to 1")
    if solid.dtype.kind == "f" and not np.all((solid >= 0) & (solid <= 1)):
        wrong = solid[~((solid >= 0) & (solid <= 1))].flat[0]
        raise _core.Error(f"voxels: {wrong} in the array; expected truth values, or numbers from 0 to 1")
    if solid.ndim != 3 or not np.any(solid > 0):
        raise _core.Error(f"voxels: an array of shape {solid.shape}{'' if np.any(solid > 0) else ', none of them solid'}; expected x, y, z")
    edges, lower = numbers(spacing, "voxels: spacing"), numbers(origin, "voxels: origin")
    if edges.shape not in ((), (1,), (3,)) or not (np.all(edges > 0) and np.all(np.isfinite(edges))):
        raise _core.Error(f"voxels: a spacing of {spacing}; expected one or three numbers > 0, in m")
    if lower.shape != (3,) or not np.all(np.isfinite(lower)):
        raise _core.Error(f"voxels: an origin of {origin}; expected three numbers, in m")
    edges = np.broadcast_to(edges, 3)
    if solid.dtype.kind in "iu" and np.ptp(solid[solid > 0]):
        raise _core.Error("voxels: whole numbers of several values; expected truth values, as of image > threshold")
    if gather is not None and (not isinstance(gather, (int, np.integer)) or not 1 <= gather <= 16):
        raise _core.Error(f"voxels: gather={gather!r}; expected a whole number, 1 to 16")
    is_grey = np.issubdtype(solid.dtype, np.floating) and not np.all((solid == 0) | (solid == 1))
    if is_grey and not gather:
        raise _core.Error("voxels: parts of voxels that are solid need gather=N; expected truth values, or 0 and 1")
    checked(name)
    filled = solid.transpose()  # z, y, x, as the tools have it
    if gather:
        return _core.Mesh.of_voxels(b"".join(cells.stream_of(name, filled, edges, lower, gather, smallest, filled if is_grey else None)))
    try:
        nodes, ((_, _, elements, _),), sets = cells.mesh_of(filled > 0, edges, lower, "hex", name)
    except OverflowError as error:
        raise _core.Error(f"voxels: {error}") from None
    return mesh(nodes, {name: elements}, sets)


def recipe(file):
    """The mesh of a recipe (tools/README.md)."""
    return _core.Mesh.of_recipe(os.fspath(file))
