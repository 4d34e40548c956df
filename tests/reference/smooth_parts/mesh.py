"""Tetrahedra with curved sides that fill a foam's struts up to their surface: a lattice of tetrahedra whose corners
near the surface are moved onto it, and that is cut there (after Labelle & Shewchuk 2007, isosurface stuffing)."""
import itertools

import numpy
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

NEAR = 0.3  # of an edge: a corner so near to the surface is moved onto it
EDGES = list(itertools.combinations(range(4), 2))  # of a tetrahedron: 01 02 03 12 13 23


def lattice(size, cells):
    """Corners of a grid and six tetrahedra for each of its cubes, all about the diagonal (Kuhn 1960)."""
    counts = numpy.array([cells] * 3)
    places = numpy.stack(numpy.meshgrid(*[numpy.arange(cells + 1)] * 3, indexing="ij"), -1).reshape(-1, 3)
    strides = numpy.array([(cells + 1) ** 2, cells + 1, 1])
    cubes = places[(places < counts).all(1)] @ strides
    kinds = [numpy.cumsum([0, *strides[list(order)]]) for order in itertools.permutations(range(3))]
    return places * size / cells, (cubes[:, None, None] + numpy.array(kinds)).reshape(-1, 4)


def unique_edges(tets):
    pairs = numpy.sort(tets[:, EDGES].reshape(-1, 2), axis=1)
    edges, index = numpy.unique(pairs, axis=0, return_inverse=True)
    return edges, index.reshape(-1, 6)


def roots(struts, inside, outside):
    for _ in range(20):
        middle = (inside + outside) / 2
        is_in = (struts.distance(middle) < 0)[:, None]
        inside, outside = numpy.where(is_in, middle, inside), numpy.where(is_in, outside, middle)
    return (inside + outside) / 2


def on_faces(places, size):
    """For each axis whether a place lies in a face of the box across it."""
    return (numpy.abs(places) < 1e-9 * size) | (numpy.abs(places - size) < 1e-9 * size)


def crossings(struts, corners, signs, edges):
    """The edges with one end inside and one outside, inner end first, and where they cross the surface."""
    cut = edges[signs[edges[:, 0]] * signs[edges[:, 1]] < 0]
    cut = numpy.where((signs[cut[:, 0]] < 0)[:, None], cut, cut[:, ::-1])
    return cut, roots(struts, corners[cut[:, 0]], corners[cut[:, 1]])


def move_near_corners(struts, corners, signs, cut, places):
    """Each to its nearest crossing, unless that takes it out of a face of the box."""
    faces = on_faces(corners, struts.size)
    share = numpy.linalg.norm(places - corners[cut[:, 0]], axis=1) / numpy.linalg.norm(
        corners[cut[:, 1]] - corners[cut[:, 0]], axis=1)
    wishes = []
    for end, part in (0, share), (1, 1 - share):
        stays = (~faces[cut[:, end]] | on_faces(places, struts.size)).all(1)
        chosen = (part < NEAR) & stays
        length = numpy.linalg.norm(places - corners[cut[:, end]], axis=1)
        wishes += zip(length[chosen], cut[chosen, end], numpy.flatnonzero(chosen))
    for _, corner, which in sorted(wishes, reverse=True):  # the nearest last
        corners[corner], signs[corner] = places[which], 0


def prism(a, b, c, d, e, f):
    """Three tetrahedra of the prism abc-def, a above d: the diagonal of each side starts at its lowest number."""
    p = numpy.stack([a, b, c, d, e, f], 1)
    turns = numpy.array([[0, 1, 2, 3, 4, 5], [1, 2, 0, 4, 5, 3], [2, 0, 1, 5, 3, 4], [3, 5, 4, 0, 2, 1],
                         [4, 3, 5, 1, 0, 2], [5, 4, 3, 2, 1, 0]])
    p = numpy.take_along_axis(p, turns[p.argmin(1)], 1)
    by_15 = numpy.minimum(p[:, 1], p[:, 5]) < numpy.minimum(p[:, 2], p[:, 4])
    one, two = p[by_15], p[~by_15]
    return numpy.concatenate([one[:, [0, 1, 2, 5]], one[:, [0, 1, 5, 4]], one[:, [0, 4, 5, 3]],
                              two[:, [0, 1, 2, 4]], two[:, [0, 4, 2, 5]], two[:, [0, 4, 5, 3]]])


def pyramid(a, b, c, d, top):
    """Two tetrahedra over the quadrilateral abcd."""
    by_ac = numpy.minimum(a, c) < numpy.minimum(b, d)
    q = numpy.where(by_ac[:, None], numpy.stack([a, b, c, d], 1), numpy.stack([b, c, d, a], 1))
    return numpy.concatenate([numpy.column_stack([q[:, [0, 1, 2]], top]), numpy.column_stack([q[:, [0, 2, 3]], top])])


def inner_parts(tets, signs, cut, first):
    """The inner parts of the tetrahedra. Crossing k of `cut` is corner first + k."""
    order = numpy.argsort(signs[tets], axis=1, kind="stable")  # inner corners first, outer last
    tets = numpy.take_along_axis(tets, order, 1)
    inner, outer = (signs[tets] < 0).sum(1), (signs[tets] > 0).sum(1)
    numbers = coo_matrix((numpy.arange(len(cut)) + first, cut.T), shape=(first, first)).tocsr()

    def crossing(t, i, j):
        return numpy.asarray(numbers[t[:, i], t[:, j]]).ravel() if len(t) else t[:, 0]

    def of(inners, outers):
        return tets[(inner == inners) & (outer == outers)]

    parts = [tets[(inner > 0) & (outer == 0)]]
    for outers in 1, 2, 3:
        t = of(1, outers).copy()
        for j in range(4 - outers, 4):
            t[:, j] = crossing(of(1, outers), 0, j)
        parts.append(t)
    t = of(2, 1)
    parts.append(pyramid(t[:, 0], t[:, 1], crossing(t, 1, 3), crossing(t, 0, 3), t[:, 2]))
    t = of(2, 2)
    parts.append(prism(t[:, 0], crossing(t, 0, 2), crossing(t, 0, 3), t[:, 1], crossing(t, 1, 2), crossing(t, 1, 3)))
    t = of(3, 1)
    parts.append(prism(t[:, 0], t[:, 1], t[:, 2], *(crossing(t, i, 3) for i in range(3))))
    return numpy.concatenate(parts)


def volumes(corners, tets):
    a, b, c, d = (corners[tets[:, k]] for k in range(4))
    return numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6


def largest_piece(tets, corners):
    pairs = tets[:, EDGES].reshape(-1, 2)
    graph = coo_matrix((numpy.ones(len(pairs)), pairs.T), shape=(corners, corners))
    labels = connected_components(graph, directed=False)[1]
    return tets[labels[tets[:, 0]] == numpy.bincount(labels[tets[:, 0]]).argmax()]


def straight_mesh(struts, cells):
    corners, tets = lattice(struts.size, cells)
    tets = tets[(struts.distance(corners)[tets] < 0).any(1)]
    signs = numpy.sign(struts.distance(corners)).astype(int)
    cut, places = crossings(struts, corners, signs, unique_edges(tets)[0])
    move_near_corners(struts, corners, signs, cut, places)
    still = (signs[cut] != 0).all(1)
    cut, places = cut[still], places[still]
    tets = inner_parts(tets, signs, cut, len(corners))
    is_surface = numpy.concatenate([signs == 0, numpy.ones(len(places), bool)])
    corners = numpy.concatenate([corners, places])
    size = volumes(corners, tets)
    tets[size < 0] = tets[size < 0][:, [1, 0, 2, 3]]
    # Removes flat tetrahedra, whose corners were moved into one plane.
    tets = tets[numpy.abs(size) > 1e-6 * numpy.abs(size).max()]
    return corners, largest_piece(tets, len(corners)), is_surface


def surface_edges(tets, edges, numbers, is_surface, corners, size):
    """Edges of the triangles that belong to one tetrahedron only, not in a face of the box."""
    sides = [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)]
    triangles = numpy.sort(tets[:, sides].reshape(-1, 3), axis=1)
    unique, counts = numpy.unique(triangles, axis=0, return_counts=True)
    unique = unique[(counts == 1) & is_surface[unique].all(1)]
    unique = unique[~on_faces(corners, size)[unique].all(1).any(1)]
    wanted = numpy.unique(numpy.sort(unique[:, [(0, 1), (0, 2), (1, 2)]].reshape(-1, 2), axis=1), axis=0)
    big = len(corners)
    return numpy.isin(edges[:, 0] * big + edges[:, 1], wanted[:, 0] * big + wanted[:, 1])


def onto_surface(struts, places):
    faces = on_faces(places, struts.size)
    for _ in range(5):
        distance, normal = struts.distance_and_normal(places)
        normal[faces] = 0
        steep = numpy.maximum((normal ** 2).sum(1), 0.1)
        places = places - (distance / steep)[:, None] * normal
    return places


def is_valid(nodes, tets):
    """Whether the volume of a curved tetrahedron is positive at its corners and inside."""
    a, b = 0.58541020, 0.13819660
    valid = numpy.ones(len(tets), bool)
    for L in [*numpy.eye(4), [a, b, b, b], [b, a, b, b], [b, b, a, b], [b, b, b, a]]:
        J = numpy.einsum("enk,nl->ekl", nodes[tets], gradients(numpy.array(L)))
        valid &= numpy.linalg.det(J) > 1e-3 * 6 * volumes(nodes, tets)
    return valid


def gradients(L):
    """∂N/∂L_1, L_2, L_3 of ten nodes: corners, then edges 01 12 02 03 13 23, as other programs number them."""
    by_L = numpy.zeros((10, 4))
    for k in range(4):
        by_L[k, k] = 4 * L[k] - 1
    for n, (i, j) in enumerate([(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]):
        by_L[4 + n, i], by_L[4 + n, j] = 4 * L[j], 4 * L[i]
    return by_L[:, 1:] - by_L[:, :1]


def curved_mesh(struts, cells):
    """Nodes and tetrahedra of ten nodes; how many tetrahedra had to stay straight."""
    corners, tets, is_surface = straight_mesh(struts, cells)
    edges, numbers = unique_edges(tets)
    middles = corners[edges].mean(1)
    straight = middles.copy()
    bent = surface_edges(tets, edges, numbers, is_surface, corners, struts.size)
    moved = onto_surface(struts, middles[bent])
    length = numpy.linalg.norm(corners[edges[bent, 0]] - corners[edges[bent, 1]], axis=1)
    near = numpy.linalg.norm(moved - middles[bent], axis=1) < 0.3 * length
    middles[numpy.flatnonzero(bent)[near]] = moved[near]
    tens = numpy.concatenate([tets, len(corners) + numbers[:, [0, 3, 1, 2, 4, 5]]], axis=1)
    stiff = 0
    for _ in range(10):
        nodes = numpy.concatenate([corners, middles])
        wrong = ~is_valid(nodes, tens)
        if not wrong.any():
            break
        stiff += wrong.sum()
        middles[numbers[wrong].ravel()] = straight[numbers[wrong].ravel()]
    used, tens = numpy.unique(tens, return_inverse=True)
    return nodes[used], tens.reshape(-1, 10), stiff


def volume(nodes, tets):
    a, b = 0.58541020, 0.13819660
    return sum(numpy.linalg.det(numpy.einsum("enk,nl->ekl", nodes[tets], gradients(numpy.array(L)))).sum() / 24
               for L in [[a, b, b, b], [b, a, b, b], [b, b, a, b], [b, b, b, a]])
