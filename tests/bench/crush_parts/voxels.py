"""Explicit hexahedra on whole voxels (tests/reference/hexahedra.hpp)."""
import subprocess

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from .bodies import DENSITY, POISSON, YIELD, YOUNG

CORNERS = np.array([[c & 1, c >> 1 & 1, c >> 2] for c in range(8)])


def whole(body, spacing, placement, layers):
    """Indices of the voxels whose middle is inside, of so many layers about the middle of the height, in the largest piece that
    hangs together by faces; and the corner of voxel 0 0 0."""
    half = int(np.ceil(body.reach() / spacing))
    counts = np.array([2 * half, 2 * half, layers])
    low = spacing * np.array([placement.offset[0] - half, placement.offset[1] - half, -layers / 2])
    voxels = np.stack(np.meshgrid(*map(np.arange, counts), indexing="ij"), -1).reshape(-1, 3)
    voxels = voxels[body.solid(low + spacing * (voxels + 0.5), placement.turn)]
    number = np.full(counts + 1, -1)
    number[tuple(voxels.T)] = np.arange(len(voxels))
    ends = [(np.arange(len(voxels)), number[tuple((voxels + step).T)]) for step in np.eye(3, dtype=int)]
    pairs = np.concatenate([np.stack(pair, 1)[pair[1] >= 0] for pair in ends])
    graph = coo_matrix((np.ones(len(pairs)), tuple(pairs.T)), shape=(len(voxels),) * 2)
    _, piece = connected_components(graph, directed=False)
    return voxels[piece == np.argmax(np.bincount(piece))], low


def mesh(body, spacing, placement, layers):
    """Nodes, m, and elements, corners along x first, then y, then z."""
    voxels, low = whole(body, spacing, placement, layers)
    grid, elements = np.unique((voxels[:, None] + CORNERS).reshape(-1, 3), axis=0, return_inverse=True)
    return low + spacing * grid, elements.reshape(-1, 8)


def held(body, nodes, turn):
    """{node: velocity}"""
    plate, end = body.plate_velocity(turn), body.height / 2 * (1 - 1e-6)
    moves = {n: np.zeros(3) for n in np.flatnonzero((nodes ** 2).sum(1) < body.core ** 2)}
    moves |= {n: plate for n in np.flatnonzero(nodes[:, 2] > end)}
    return moves | {n: -plate for n in np.flatnonzero(nodes[:, 2] < -end)}


def text(body, spacing, placement):
    nodes, elements = mesh(body, spacing, placement, round(body.height / spacing))
    start = 2 * nodes[:, 2:] / body.height * body.plate_velocity(placement.turn)
    moves = held(body, nodes, placement.turn)
    lines = [f"{spacing:.17g} {YOUNG} {POISSON} {DENSITY} {YIELD} {body.duration():.17g}", f"{len(nodes)} {len(elements)} {len(moves)}"]
    lines += [" ".join(f"{x:.17g}" for x in row) for row in np.hstack([nodes, start])]
    lines += [" ".join(map(str, row)) for row in elements]
    lines += [f"{n} " + " ".join(f"{v:.17g}" for v in velocity) for n, velocity in moves.items()]
    return "\n".join(lines), len(elements)


def crush(program, body, spacing, placement, hourglass):
    """Elements, J, core-seconds of the steps, steps, ns an element and step; None where an element turned inside out."""
    words, number = text(body, spacing, placement)
    done = subprocess.run([program, str(hourglass)], input=words, capture_output=True, text=True)
    if done.returncode != 0:
        return None
    work, steps, each, seconds = map(float, done.stdout.split())
    return number, work, seconds, steps, each
