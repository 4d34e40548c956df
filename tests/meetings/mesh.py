"""The points of a scene: boxes of cells, as a list of points, as hexahedra in an Exodus file, or as Peridigm's grid."""
from dataclasses import dataclass, field, replace

import exodus
import numpy as np

CORNERS = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
MIRRORED = [4, 5, 6, 7, 0, 1, 2, 3]  # bottom and top exchanged: of positive volume in a mirror


@dataclass
class Box:
    low: np.ndarray
    counts: tuple
    cell: np.ndarray  # its edges

    @property
    def high(self):
        return self.low + np.array(self.counts) * self.cell

    def cells(self):
        """Their indices, x fastest."""
        i, j, k = (n.ravel(order="F") for n in np.meshgrid(*(np.arange(n) for n in self.counts), indexing="ij"))
        return np.stack([i, j, k], axis=1)

    def centers(self):
        return self.low + (self.cells() + 0.5) * self.cell


@dataclass
class Mesh:
    """`points` are those of a list; `nodes` and `hexahedra` those of an Exodus file; a grid has `box` besides its points."""
    kind: str
    blocks: np.ndarray  # of each point or hexahedron, from 1
    points: np.ndarray = None
    volumes: np.ndarray = None
    nodes: np.ndarray = None
    hexahedra: np.ndarray = None
    sets: dict = field(default_factory=dict)  # of nodes, by name
    box: Box = None
    at_nodes: bool = False  # where the program's points are

    def elements(self):
        return self.points if self.nodes is None else hexahedra_of(self.nodes[self.hexahedra])[1]

    def element_volumes(self):
        return self.volumes if self.nodes is None else hexahedra_of(self.nodes[self.hexahedra])[0]

    def site_volumes(self):
        """A node has its part of the elements around it, ∫N dV."""
        if not self.at_nodes:
            return self.element_volumes()
        volumes = np.zeros(len(self.nodes))
        for shape, volume in gauss_points(self.nodes[self.hexahedra]):
            np.add.at(volumes, self.hexahedra, volume[:, None] * shape)
        return volumes

    def sites(self):
        return self.nodes if self.at_nodes else self.elements()

    def owners(self):
        """The block of each site: of a node that blocks share the first one."""
        if not self.at_nodes:
            return self.blocks
        owners = np.zeros(len(self.nodes), int)
        for number in reversed(list(dict.fromkeys(self.blocks.tolist()))):
            owners[self.hexahedra[self.blocks == number].ravel()] = number
        return owners

    def mapped(self, of_points, mirror, scale):
        """With every place changed by a function; `scale` that of volumes."""
        turned = None if self.hexahedra is None else self.hexahedra[:, MIRRORED] if mirror else self.hexahedra
        change = lambda places: None if places is None else of_points(places)
        box = None
        if self.box:
            ends = np.sort([of_points(self.box.low[None])[0], of_points(self.box.high[None])[0]], axis=0)
            unit = np.eye(3)  # to which axis each goes
            axes = [int(np.argmax(np.abs(of_points(unit[i][None]) - of_points(np.zeros((1, 3)))))) for i in range(3)]
            counts = [0, 0, 0]
            for i in range(3):
                counts[axes[i]] = self.box.counts[i]
            box = Box(ends[0], tuple(counts), (ends[1] - ends[0]) / counts)
        volumes = None if self.volumes is None else self.volumes * scale
        return replace(self, points=change(self.points), nodes=change(self.nodes), hexahedra=turned, volumes=volumes, box=box)

    def only(self, keep):
        """Those elements alone; nodes that nothing uses go."""
        if self.nodes is None:
            return replace(self, blocks=self.blocks[keep], points=self.points[keep], volumes=self.volumes[keep])
        used, inverse = np.unique(self.hexahedra[keep], return_inverse=True)
        number = {old: new for new, old in enumerate(used)}
        sets = {name: np.array([number[n] for n in nodes if n in number], int) for name, nodes in self.sets.items()}
        return replace(self, blocks=self.blocks[keep], nodes=self.nodes[used], hexahedra=inverse.reshape(-1, 8), sets=sets)

    def with_image(self, axis=0):
        """And its mirror image across the plane through 0; nodes in that plane are common."""
        flip = np.ones(3)
        flip[axis] = -1
        blocks = np.concatenate([self.blocks, self.blocks])
        if self.nodes is None:
            return replace(self, blocks=blocks, points=np.concatenate([self.points, self.points * flip]), volumes=np.tile(self.volumes, 2))
        tolerance = 1e-9 * np.ptp(self.nodes, axis=0).max()
        own = np.abs(self.nodes[:, axis]) > tolerance
        image = np.arange(len(self.nodes))
        image[own] = len(self.nodes) + np.arange(own.sum())
        sets = {name: np.unique(np.concatenate([nodes, image[nodes]])) for name, nodes in self.sets.items()}
        return replace(self, blocks=blocks, nodes=np.concatenate([self.nodes, (self.nodes * flip)[own]]), sets=sets,
                       hexahedra=np.concatenate([self.hexahedra, image[self.hexahedra][:, MIRRORED]]))

    def shuffled(self, rng):
        """The same in another order. The blocks of an Exodus file are written one after the other, in the order of `blocks`."""
        order = rng.permutation(len(self.blocks))
        if self.kind == "PdQuickGrid":
            return self
        if self.nodes is None:
            return replace(self, blocks=self.blocks[order], points=self.points[order], volumes=self.volumes[order])
        if self.at_nodes:  # a node that blocks share belongs to the first of them in the file
            place = {block: n for n, block in enumerate(dict.fromkeys(self.blocks.tolist()))}
            order = order[np.argsort([place[self.blocks[i]] for i in order], kind="stable")]
        nodes = rng.permutation(len(self.nodes))
        number = np.argsort(nodes)
        sets = {name: rng.permutation(number[ids]) for name, ids in self.sets.items()}
        return replace(self, blocks=self.blocks[order], nodes=self.nodes[nodes], hexahedra=number[self.hexahedra[order]], sets=sets)

    def write(self, path):
        if self.kind == "Text File":
            rows = zip(self.points, self.blocks, self.volumes)
            path.write_text("".join(f"{x!r} {y!r} {z!r} {b} {v!r}\n" for (x, y, z), b, v in
                                    ((map(float, p), b, float(v)) for p, b, v in rows)))
        elif self.kind == "Exodus":
            write_exodus(path, self)


def joined(meshes):
    """Meshes of one kind, their blocks unchanged."""
    first = meshes[0]
    blocks = np.concatenate([m.blocks for m in meshes])
    if first.nodes is None:
        return replace(first, blocks=blocks, points=np.concatenate([m.points for m in meshes]), volumes=np.concatenate([m.volumes for m in meshes]))
    shifts = np.cumsum([0] + [len(m.nodes) for m in meshes])
    sets = {name: nodes + shift for m, shift in zip(meshes, shifts) for name, nodes in m.sets.items()}
    return replace(first, blocks=blocks, nodes=np.concatenate([m.nodes for m in meshes]), sets=sets,
                   hexahedra=np.concatenate([m.hexahedra + shift for m, shift in zip(meshes, shifts)]))


def of_box(kind, box, block_of_cell, jitter, rng, at_nodes=False, name=""):
    """`jitter`: by how much points or nodes are moved at random, in cells."""
    cells = box.cells()
    blocks = np.array([block_of_cell(cell) for cell in cells])
    if kind != "Exodus":
        points = box.centers() + jitter * box.cell * rng.uniform(-1, 1, (len(cells), 3))
        return Mesh(kind, blocks, points=points, volumes=np.full(len(cells), np.prod(box.cell)), box=box if kind == "PdQuickGrid" else None)
    lattice = Box(box.low, tuple(n + 1 for n in box.counts), box.cell)
    nodes = box.low + lattice.cells() * box.cell
    inside = ((lattice.cells() > 0) & (lattice.cells() < np.array(box.counts))).astype(float)  # faces stay flat
    nodes = nodes + jitter * box.cell * inside * rng.uniform(-1, 1, nodes.shape)
    number = lambda ijk: ijk[..., 0] + (box.counts[0] + 1) * (ijk[..., 1] + (box.counts[1] + 1) * ijk[..., 2])
    top = np.flatnonzero(lattice.cells()[:, 2] == box.counts[2])
    return Mesh(kind, blocks, nodes=nodes, hexahedra=number(cells[:, None, :] + CORNERS), sets={f"{name}mesh_top": top}, at_nodes=at_nodes)


def gauss_points(corners):
    """Gauss points of each hexahedron, exact to degree 3 in each local coordinate: shape functions, and the volume of each point."""
    gauss = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3)
    for at in np.array(np.meshgrid(gauss, gauss, gauss)).reshape(3, -1).T:
        parts = np.where(CORNERS == 1, at, 1 - at)
        signs = np.where(CORNERS == 1, 1, -1)
        slopes = np.stack([signs[:, a] * np.prod(np.delete(parts, a, axis=1), axis=1) for a in range(3)], axis=1)
        yield np.prod(parts, axis=1), np.linalg.det(np.einsum("na,enb->eab", slopes, corners)) / 8


def hexahedra_of(corners):
    """Volumes and centroids, exact: x det J is of degree 3."""
    volumes, moments = np.zeros(len(corners)), np.zeros((len(corners), 3))
    for shape, volume in gauss_points(corners):
        volumes += volume
        moments += volume[:, None] * np.einsum("n,enb->eb", shape, corners)
    return volumes, moments / volumes[:, None]


def write_exodus(path, mesh):
    numbers = list(dict.fromkeys(mesh.blocks.tolist()))  # in the order in which they come
    blocks = [(f"block_{n}", "HEX8", mesh.hexahedra[mesh.blocks == n], None) for n in numbers]
    exodus.write_mesh(path, mesh.nodes, blocks, {name: nodes for name, nodes in mesh.sets.items() if len(nodes)})
