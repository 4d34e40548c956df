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
        file = opened(mesh)
        try:
            # In the order of the elements' numbers, whatever that of the file's variables.
            blocks = [n for n in range(1, len(file.dimensions["num_el_blk"]) + 1)
                      if f"connect{n}" in file.variables and len(file[f"connect{n}"])]
            parts = [extent.cells_of(file, number) for number in blocks]
            boxes = [extent.box_of(file, number) for number in blocks]
            count = sum(len(file[f"connect{n}"]) for n in blocks)
            self.numbers = file["elem_num_map"][:] if "elem_num_map" in file.variables else 1 + np.arange(count)
        except (OSError, IndexError, KeyError, AttributeError) as error:
            fail(f"{mesh} is not an Exodus mesh: {error}")
        if not parts or any(part is None for part in parts):
            fail(f"{mesh} has elements without an extent: spheres do not tell the faces of a box")
        edges, self.places, self.halves = (np.concatenate(found) for found in zip(*parts))
        self.edge = edges.min(axis=0)
        self.low = np.min([low for low, _ in boxes], axis=0)
        self.high = np.max([high for _, high in boxes], axis=0)

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
