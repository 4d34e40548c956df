"""The box of a sample, and the points of its faces: only the outermost layer."""
import numpy as np
from curve_parts import extent
from exodus import opened
from strut_tools import fail

FACES = [f"{axis}{side}" for axis in "xyz" for side in ("min", "max")]


class Sample:
    """Points of the elements: numbers, positions and half lengths (m), and the box that the material fills. Partly
    filled cells count as prisms, and the box ends where the material does: whole cells may extend beyond it."""

    def __init__(self, mesh):
        parts, box = extent.of_blocks(mesh, None, extent.cells_of), extent.box_in(mesh, None)
        if not parts:
            fail(f"{mesh}: expected hexahedra or tetrahedra, which tell the faces of a box; it has none, also others, or is damaged")
        edges, self.places, self.halves = (np.concatenate(found) for found in zip(*parts))
        self.edge, (self.low, self.high) = edges.min(axis=0), box
        try:
            with opened(mesh) as file:
                self.numbers = file["elem_num_map"][:] if "elem_num_map" in file.variables else 1 + np.arange(len(edges))
        except (OSError, IndexError, KeyError, AttributeError) as error:
            fail(f"{mesh} is damaged: {error}")

    def held(self, face, layers):
        """The numbers of the points in this many layers at a face. In the innermost layer, only points without another
        one of it between them and the face count, which excludes the second half of a flat cell."""
        axis = "xyz".index(face[0])
        depth = self.places[:, axis] - self.low[axis] if face.endswith("min") else self.high[axis] - self.places[:, axis]
        edge = self.edge[axis] * (1 + 1e-9)
        near = np.flatnonzero(depth < layers * edge)
        innermost = near[depth[near] > (layers - 1) * edge]
        return np.sort(self.numbers[np.setdiff1d(near, self.behind(innermost, axis, depth))])

    def behind(self, members, axis, depth):
        """Those of the members that have another one in front of more than their center."""
        across = [a for a in range(3) if a != axis]
        bins = np.floor(self.places[members][:, across] / self.edge[across]).astype(int)
        there = {}
        for place, member in zip(map(tuple, bins), members):
            there.setdefault(place, []).append(member)
        found = []
        for (i, j), member in zip(bins, members):
            others = np.array([other for a in (-1, 0, 1) for b in (-1, 0, 1) for other in there.get((i + a, j + b), ())])
            apart = np.abs(self.places[others][:, across] - self.places[member, across])
            beside = (apart > 0.5 * (self.halves[others] + self.halves[member])[:, across]).any(axis=1)
            reach = (self.halves[others] + self.halves[member])[:, axis]
            if (~beside & (depth[member] - depth[others] >= 0.75 * reach)).any():
                found.append(member)
        return np.array(found, int)
