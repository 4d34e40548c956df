"""Makes nodes, elements and the node sets of the box's faces from solid voxels, or the stream of those that strut-mesh gathers."""
import numpy as np

# Corners of a voxel in the order of Exodus' HEX8, as steps (z, y, x).
CORNERS = [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0), (1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)]
MOST_NODES = 2**31 - 1  # limit of the numbers in a mesh


def mesh_of(solid, cell, origin, elements, block):
    """Nodes (m), one block, and sets, in the form of exodus.write_mesh."""
    nodes, block_of, places, last = (hexahedra if elements == "hex" else spheres)(solid, cell, origin, block)
    sets = {}
    for axis, letter in ((2, "x"), (1, "y"), (0, "z")):
        for end, name in ((0, "min"), (last[axis], "max")):
            members = np.flatnonzero(places[axis] == end)
            if len(members):
                sets[f"{block}_{letter}{name}"] = members
    return nodes, [block_of], sets


def by_material(blocks, materials, names):
    """A block for each of the materials (1, 2, …, of the elements in their order); empty ones are left out."""
    (_, kind, elements, volumes), = blocks
    parts = [(name, materials == number) for number, name in enumerate(names, 1)]
    return [(name, kind, elements[there], None if volumes is None else volumes[there]) for name, there in parts if there.any()]


def coordinates(places, cell, origin, offset):
    return np.stack([origin[a] + (places[2 - a] + offset) * cell[a] for a in range(3)], axis=1)


def spheres(solid, cell, origin, block):
    places = np.nonzero(solid)
    count = len(places[0])
    one = np.arange(count, dtype=np.int32).reshape(-1, 1)
    volumes = np.full(count, cell[0] * cell[1] * cell[2])
    last = [n - 1 for n in solid.shape]
    return coordinates(places, cell, origin, 0.5), (block, "SPHERE", one, volumes), places, last


def hexahedra(solid, cell, origin, block):
    shape = tuple(n + 1 for n in solid.shape)
    taken = np.zeros(shape, bool)
    for corner in CORNERS:
        taken[tuple(slice(c, c + n) for c, n in zip(corner, solid.shape))] |= solid
    count = np.count_nonzero(taken)
    if count > MOST_NODES:
        raise OverflowError(f"{count:,} nodes are more than a mesh can have ({MOST_NODES:,}): --crop, --coarsen or --elements sphere")
    number = np.cumsum(taken, dtype=np.int32)  # the n-th used node, from 1
    first = np.ravel_multi_index(np.nonzero(solid), shape)
    elements = np.empty((len(first), 8), np.int32)
    for i, corner in enumerate(CORNERS):
        elements[:, i] = number[first + np.ravel_multi_index(corner, shape)] - 1
    places = np.nonzero(taken)
    return coordinates(places, cell, origin, 0), (block, "HEX8", elements, None), places, solid.shape


def stream_of(name, solid, cell, origin, factor, smallest, fills=None, thickness=None):
    """The parts of the stream that strut-mesh --arrays reads (tools/mesh/arrays.hpp): the solid voxels of an array (z, y, x), to be
    gathered in cells of factor^3. fills: the solid fraction of each; thickness: of struts and walls, in voxels."""
    places = np.nonzero(solid)
    words = [name, len(places[0]), *solid.shape[::-1], factor, smallest, "solid" if fills is None else "grey"]
    yield f"strut-mesh arrays 1\nnodes 0\nvoxels {' '.join(map(str, words))}{'' if thickness is None else f' {thickness:.6g}'}\n".encode()
    for array, form in (([*cell, *origin], "<f8"), (np.stack(places[::-1], axis=1), "<i4"), ([] if fills is None else fills[places], "<f8")):
        yield np.ascontiguousarray(array, form).reshape(-1).view(np.uint8)
    yield b"end\n"
