"""The box of a sample, and the points of its faces: only the outermost layer."""
import numpy as np
from curve_parts import extent
from exodus import opened
from scipy.spatial import cKDTree
from strut_tools import fail

FACES = [f"{axis}{side}" for axis in "xyz" for side in ("min", "max")]


class Sample:
    """Points of the elements: numbers, positions and half lengths (m), and the box that the material fills. Partly
    filled cells count as prisms, and the box ends where the material does: whole cells may extend beyond it."""

    def __init__(self, mesh):
        parts, box = extent.elements_of(mesh), extent.box_in(mesh, None)
        if not parts:
            fail(f"{mesh}: expected hexahedra or tetrahedra, which tell the faces of a box; it has none, also others, or is damaged")
        self.edges, self.places, self.halves = (np.concatenate(found) for found in zip(*((p.high - p.low, p.middle, p.half) for p in parts)))
        self.low, self.high = box
        try:
            with opened(mesh) as file:
                self.numbers = file["elem_num_map"][:] if "elem_num_map" in file.variables else 1 + np.arange(len(self.edges))
        except (OSError, IndexError, KeyError, AttributeError) as error:
            fail(f"{mesh} is damaged: {error}")

    def held(self, face, layers):
        """The numbers of the points in this many layers at a face. In the innermost layer, only points without another
        one of it between them and the face count, which excludes the second half of a flat cell."""
        axis, depth, reach = self.measured(face)
        outer = (layers - 1) * self.thickness(face)
        near = np.flatnonzero(depth < outer + reach)
        innermost = near[depth[near] > outer]
        return np.sort(self.numbers[np.setdiff1d(near, self.behind(innermost, axis, depth))])

    def measured(self, face):
        """The axis of a face; for each element its depth, and that below which it is at the face: half its own edge, as meshes may
        be graded, and a tenth of that for faces that are not quite plane; the whole edge of cells that are partly filled."""
        axis = "xyz".index(face[0])
        depth = self.places[:, axis] - self.low[axis] if face.endswith("min") else self.high[axis] - self.places[:, axis]
        edge = self.edges[:, axis]
        return axis, depth, np.where(self.halves[:, axis] > 0.5 * edge * (1 - 1e-6), 0.55 * edge, edge)

    def thickness(self, face):
        """The thickness of the layer at a face, m: the median edge of the elements there, 0 without any."""
        axis, depth, reach = self.measured(face)
        there = self.edges[depth < reach, axis]
        return np.median(there) if len(there) else 0.0

    def behind(self, members, axis, depth):
        """The members whose center another member covers, seen from the face."""
        if not len(members):
            return members
        places, halves = np.delete(self.places[members], axis, 1), np.delete(self.halves[members], axis, 1)
        pairs = cKDTree(places).query_pairs(halves.max(), p=np.inf, output_type="ndarray")
        i, j = np.concatenate([pairs, pairs[:, ::-1]]).T
        beside = (np.abs(places[i] - places[j]) > 0.5 * (halves[i] + halves[j])).any(axis=1)
        i, j = members[i], members[j]
        in_front = depth[i] - depth[j] >= 0.75 * (self.halves[i] + self.halves[j])[:, axis]
        return np.unique(i[in_front & ~beside])
