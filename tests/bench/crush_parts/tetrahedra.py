"""The same bodies with smooth surfaces, as tetrahedra by CalculiX: an eighth of those that are crushed, a half of the sheared one.
What explicit steps of such a mesh would cost follows from its highest frequency."""
import pathlib
import subprocess
import tempfile

import numpy as np
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import eigsh
from smooth_parts import calculix

from .bodies import MM, POISSON, WAVE, YIELD, YOUNG

STEP = 0.9            # of the stable one
LINEAR, QUADRATIC = 4, 10  # nodes


def drawing(body, size, enlarged):
    """For gmsh, in mm."""
    radius, far, high = enlarged * body.diameter / 2 / MM, 0.8 * body.height / MM, body.height / 2 / MM
    ends = body.directions(0) * far * np.sqrt(2 if body.shear else 3)
    lines = ['SetFactory("OpenCASCADE");']
    lines += [f"Cylinder({k}) = {{0, 0, 0, {x}, {y}, {z}, {radius}, 2*Pi}};" for k, (x, y, z) in enumerate(ends, 1)]
    if body.ball:
        lines += [f"Sphere({len(ends) + 1}) = {{0, 0, 0, {enlarged * body.ball / MM}}};"]
    last = len(ends) + bool(body.ball)
    low = (-10 * high, 0, -high) if body.shear else (0, 0, 0)
    size_of = (20 * high, 10 * high, 2 * high) if body.shear else (10 * high, 10 * high, high)
    box = ", ".join(map(str, (*low, *size_of)))
    return "\n".join([*lines, f"BooleanUnion(20) = {{Volume{{1}}; Delete;}}{{Volume{{2:{last}}}; Delete;}};", f"Box(21) = {{{box}}};",
                      "v() = BooleanIntersection{Volume{20}; Delete;}{Volume{21}; Delete;};", "Physical Volume(1) = {v()};",
                      f"Mesh.MeshSizeMax = {size / MM}; Mesh.MeshSizeMin = {size / MM / 2};", "Mesh.Optimize = 1; Mesh.HighOrderOptimize = 1;", ""])


def meshed(body, size, nodes_each, enlarged):
    """Nodes, m, and tetrahedra."""
    with tempfile.TemporaryDirectory() as folder:
        place = pathlib.Path(folder)
        (place / "body.geo").write_text(drawing(body, size, enlarged))
        order = 2 if nodes_each == QUADRATIC else 1
        done = subprocess.run(["gmsh", "-3", "-order", str(order), "-nt", "1", "-format", "inp", "-o", "body.inp", "body.geo"],
                              cwd=folder, capture_output=True, text=True)
        if not (place / "body.inp").exists():
            raise SystemExit(f"gmsh made no mesh: {done.stdout[-500:]}")
        return read(place / "body.inp", nodes_each)


def read(path, nodes_each):
    nodes, numbers, mode = {}, [], ""
    for line in path.read_text().splitlines():
        if line.startswith("*"):
            mode = line.upper()
        elif mode.startswith("*NODE"):
            number, *place = line.split(",")
            nodes[int(number)] = [float(x) for x in place]
        elif mode.startswith("*ELEMENT") and f"C3D{nodes_each}" in mode:
            numbers += [int(word) for word in line.split(",") if word.strip()]
    tets = np.array(numbers).reshape(-1, nodes_each + 1)[:, 1:]
    used, tets = np.unique(tets, return_inverse=True)
    return MM * np.array([nodes[n] for n in used]), tets.reshape(-1, nodes_each)


def slopes(nodes_each):
    """Integration points: shape functions, ∂N/∂ξ, weight."""
    corners = np.array([[-1, -1, -1], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    if nodes_each == LINEAR:
        return [(np.full(4, 0.25), corners, 1 / 6)]
    points = []
    for k in range(4):
        share = np.full(4, 0.1381966011250105)
        share[k] = 0.5854101966249685
        pairs = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
        values = [*(share * (2 * share - 1)), *(4 * share[i] * share[j] for i, j in pairs)]
        change = [(4 * share[i] - 1) * corners[i] for i in range(4)]
        change += [4 * (share[i] * corners[j] + share[j] * corners[i]) for i, j in pairs]
        points.append((np.array(values), np.array(change), 1 / 24))
    return points


def volume(nodes, tets):
    return sum(weight * np.abs(np.linalg.det(np.einsum("ka,eki->eai", change, nodes[tets]))).sum()
               for _, change, weight in slopes(tets.shape[1]))


def matched(body, size, nodes_each, true):
    """The mesh of struts a little thicker, so that it has the true volume."""
    enlarged = 1.0
    for _ in range(4):
        nodes, tets = meshed(body, size, nodes_each, enlarged)
        found = volume(nodes, tets)
        if abs(found / true - 1) < 4e-3:
            break
        enlarged *= np.sqrt(true / found)
    return nodes, tets


def stable_step(nodes, tets):
    """s: 2/ω_max of the assembled mesh; masses as the consistent ones' diagonal has them, scaled to the element's."""
    bulk, shear = 1 + 4 / 3 * rigidity(), rigidity()
    number, width = len(tets), 3 * tets.shape[1]
    stiffness, mass, whole = np.zeros((number, width, width)), np.zeros(tets.shape), np.zeros(number)
    for values, change, weight in slopes(tets.shape[1]):
        jacobian = np.einsum("ka,eki->eai", change, nodes[tets])
        part = weight * np.abs(np.linalg.det(jacobian))
        b = np.einsum("eia,ka->eki", np.linalg.inv(jacobian), change)
        pairs = np.einsum("eci,edj->ecidj", b, b)
        dots = np.einsum("eck,edk->ecd", b, b)
        K = (bulk - 2 * shear) * pairs + shear * pairs.transpose(0, 1, 4, 3, 2) + shear * np.einsum("ecd,ij->ecidj", dots, np.eye(3))
        stiffness += part[:, None, None] * K.reshape(number, width, width)
        mass += np.outer(part, values ** 2)
        whole += part
    mass *= (whole / mass.sum(1))[:, None]
    rows = (3 * tets[:, :, None] + np.arange(3)).reshape(number, width)
    size = 3 * len(nodes)
    total = np.bincount(rows.ravel(), np.repeat(mass, 3, 1).ravel(), size)
    entries = (stiffness.ravel(), (np.repeat(rows, width, 1).ravel(), np.tile(rows, (1, width)).ravel()))
    scale = diags(1 / np.sqrt(total))
    highest = eigsh(scale @ coo_matrix(entries, shape=(size, size)).tocsr() @ scale, k=1, which="LA", return_eigenvectors=False, tol=1e-3)
    return 2 / np.sqrt(highest[0] / bulk) / WAVE


def rigidity():
    """G over the bulk modulus."""
    return 3 * (1 - 2 * POISSON) / (2 * (1 + POISSON))


def motions(body, nodes):
    """Nodes, axis and displacement in mm; where two speak of a node, the last one holds."""
    near, end, way = 1e-6 * body.height, body.height / 2 * (1 - 1e-6), body.strain * body.height * calculix.MM
    top, bottom = nodes[:, 2] > end, nodes[:, 2] < -end
    if body.shear:
        return [(nodes[:, 1] < near, 2, 0)] + [(bottom, axis, 0) for axis in (1, 2, 3)] + [(top, 1, way), (top, 2, 0), (top, 3, 0)]
    return [(nodes[:, axis] < near, axis + 1, 0) for axis in range(3)] + [(top, 1, 0), (top, 2, 0), (top, 3, -way / 2)]


def deck(body, nodes, tets, increment):
    lines = calculix.body(nodes, tets) + calculix.node_set("TOP", nodes[:, 2] > body.height / 2 * (1 - 1e-6)) + calculix.metal(YOUNG, POISSON)
    lines += ["*PLASTIC", *(f"{YIELD * 1e-6:.12g}, {strain}" for strain in (0, 3))]
    lines += ["*SOLID SECTION, ELSET=FOAM, MATERIAL=METAL", "*STEP, NLGEOM, INC=10000", "*STATIC", f"{increment / 4}, 1., 1e-7, {increment}"]
    return "\n".join([*lines, *calculix.boundary(motions(body, nodes)), "*NODE PRINT, NSET=TOP, TOTALS=ONLY", "RF", "*END STEP", ""])


def work(body, nodes, tets, increment):
    """J of the whole body."""
    rows = np.array([[0, 0, 0, 0], *calculix.timed_reactions(deck(body, nodes, tets, increment))])
    if rows[-1, 0] < 1:
        raise SystemExit("CalculiX did not come to the end")
    along, parts = (rows[:, 1], 2) if body.shear else (-rows[:, 3], 8)
    # An eighth has one end and half of the way: twice a quarter of the force.
    return parts * (1 if body.shear else 0.5) * np.trapz(along, rows[:, 0]) * body.strain * body.height


def crush(body, cells, nodes_each, increment=0.025):
    """Elements of the whole body, J, steps."""
    parts = 2 if body.shear else 8
    nodes, tets = matched(body, body.diameter / cells, nodes_each, body.volume() / parts)
    return parts * len(tets), work(body, nodes, tets, increment), body.duration() / (STEP * stable_step(nodes, tets))
