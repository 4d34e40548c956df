#!/usr/bin/python3
"""tools/voxels and tools/tetrahedra, run as a user runs them: images with known answers, every format, damaged files.
STRUT_MESH names strut-mesh; STRUT_CT_FOAM the CT foam (default <repository>/../shared/data/ct-foam.pts.gz)."""
import bz2
import gzip
import importlib.util
import itertools
import os
import re
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

SKIPPED = 77  # ctest's SKIP_RETURN_CODE
MODULES = {"numpy": "python3-numpy", "scipy": "python3-scipy", "netCDF4": "python3-netcdf4",
           "tifffile": "python3-tifffile", "vtkmodules": "python3-vtk9", "meshio": "python3-meshio",
           "h5py": "python3-h5py"}
missing = [package for module, package in MODULES.items() if importlib.util.find_spec(module) is None]
if missing:
    print("skipped: these Debian packages are not installed (tools/prepare installs them):", *missing)
    sys.exit(SKIPPED)

import meshio  # noqa: E402
import netCDF4  # noqa: E402
import numpy as np  # noqa: E402
import scipy.ndimage  # noqa: E402
import tifffile  # noqa: E402

import script  # noqa: E402

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path[:0] = [os.path.join(ROOT, "tools", part) for part in ("shared", "voxel")]
import exodus  # noqa: E402
import images  # noqa: E402

CT_FOAM = os.environ.get("STRUT_CT_FOAM", os.path.join(ROOT, "..", "shared", "data", "ct-foam.pts.gz"))


class ToolTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
        return self.path(name)

    def run_tool(self, tool, *words):
        return script.run(os.path.join(ROOT, "tools", tool), *words)

    def works(self, tool, source, *words):
        """Its output by first words, and the mesh it writes."""
        done = self.run_tool(tool, source, self.path("out.g"), *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return dict(line.split(None, 1) for line in done.stdout.splitlines()), mesh_of(self.path("out.g"))

    def refused(self, tool, expected, source, *words):
        """One line on stderr, exit status 1, and an older mesh is left as it is."""
        self.write("old.g", "older")
        done = self.run_tool(tool, source, self.path("old.g"), *words)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertRegex(done.stderr, f"^tools/{tool}: .*{expected}")
        with open(self.path("old.g")) as file:
            self.assertEqual(file.read(), "older")

    def voxels(self, image, *words, edge=1e-3):
        """image: (z, y, x), written as a TIFF file."""
        tifffile.imwrite(self.path("image.tif"), np.asarray(image, image.dtype if image.dtype != bool else "u1"),
                         photometric="minisblack")
        scale = () if "--size" in words or "--voxel-size" in words else ("--voxel-size", edge)
        return self.works("voxels", self.path("image.tif"), *scale, *words)


class Mesh:
    pass


def names_of(file, variable):
    return [b"".join(row).split(b"\0")[0].decode() for row in file.variables[variable][:]]


def mesh_of(path):
    mesh = Mesh()
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        mesh.nodes = np.stack([file.variables["coord" + c][:] for c in "xyz"], axis=1)
        mesh.blocks = {name: file.variables[f"connect{i + 1}"][:] - 1
                       for i, name in enumerate(names_of(file, "eb_names"))}
        mesh.attributes = {name: file.variables[f"attrib{i + 1}"][:] for i, name in enumerate(mesh.blocks)
                           if f"attrib{i + 1}" in file.variables}
        sets = names_of(file, "ns_names") if "ns_names" in file.variables else []
        mesh.sets = {name: file.variables[f"node_ns{i + 1}"][:] - 1 for i, name in enumerate(sets)}
    return mesh


def hexahedra_volumes(mesh, block="foam"):
    """Signed; exact for boxes."""
    corners = mesh.nodes[mesh.blocks[block]]
    a, b, c = (corners[:, k] - corners[:, 0] for k in (1, 3, 4))
    return np.einsum("ij,ij->i", np.cross(a, b), c)


def first_number(text):
    return float(re.search(r"[-\d.,]+(e-?\d+)?", text).group().replace(",", ""))


def ball(n, radius):
    z, y, x = np.indices((n, n, n)) - (n - 1) / 2
    return x**2 + y**2 + z**2 < radius**2


def box(shape, *ranges):
    """ranges: of z, y, x"""
    image = np.zeros(shape, "u1")
    image[tuple(slice(*r) for r in ranges)] = 1
    return image


class Exodus(ToolTest):
    NODES = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), (1, 0, 4), (7, 8, 9)], float)

    def write_mesh(self, blocks, sets):
        exodus.write_mesh(self.path("own.g"), self.NODES, blocks, sets)
        with netCDF4.Dataset(self.path("own.g")) as file:
            return [file["eb_prop1"][:].tolist(), file["ns_prop1"][:].tolist()]

    @unittest.skipUnless("STRUT_MESH" in os.environ, "STRUT_MESH names no program")
    def test_the_program_reads_what_python_writes_and_writes_the_same(self):
        blocks = [("cube", "HEX8", np.arange(8).reshape(1, 8), None), ("tip", "TET4", np.array([[4, 5, 7, 8]]), None),
                  ("balls", "SPHERE", np.array([[9], [8]]), np.array([0.25, 0.5]))]
        self.write_mesh(blocks, {"top": np.array([8, 9]), "none": np.zeros(0, int)})
        subprocess.run([os.environ["STRUT_MESH"], self.write("copy.recipe", "shape = file\nfile = own.g\n"), self.path("copy.g")],
                       check=True, capture_output=True)
        with netCDF4.Dataset(self.path("own.g")) as own, netCDF4.Dataset(self.path("copy.g")) as copy:
            self.assertLessEqual(set(own.variables), set(copy.variables))
            for name in own.variables:
                if name == "attrib3":  # radii: cube roots that differ in the last bit
                    np.testing.assert_allclose(own[name][:], copy[name][:], rtol=4e-16)
                else:
                    self.assertEqual(own[name][:].tobytes(), copy[name][:].tobytes(), name)
                self.assertEqual(own[name].ncattrs(), copy[name].ncattrs(), name)
            self.assertEqual(set(copy.variables) - set(own.variables), {"qa_records", "info_records"})

    def test_numbers_are_those_in_the_names(self):
        blocks = [(name, "SPHERE", np.array([[n]]), np.ones(1)) for n, name in enumerate(("block_7", "block_2"))]
        self.assertEqual(self.write_mesh(blocks, {"nodelist_3": np.zeros(1, int)}), [[7, 2], [3]])
        self.assertEqual(self.write_mesh(blocks, {"nodelist_03": np.zeros(1, int)}), [[7, 2], [1]])
        blocks[0] = ("foam", *blocks[0][1:])
        self.assertEqual(self.write_mesh(blocks, {"top": np.zeros(1, int)}), [[1, 2], [1]])

    def test_what_a_mesh_cannot_be(self):
        self.refused("voxels", "is no mesh of strut-mesh", self.write("a.pts", "0 0 0\n0 0 1\n"), "--size", 1)
        balls = [("balls", "SPHERE", np.array([[0]]), np.ones(1))]
        for wrong, sets in (("65 node sets, at most 64", {f"s{n}": np.zeros(1, int) for n in range(65)}),
                            ("longer than 127 characters", {128 * "s": np.zeros(1, int)})):
            with self.assertRaisesRegex(SystemExit, wrong):
                exodus.write_mesh(self.path("none.g"), self.NODES, balls, sets)
            self.assertFalse(os.path.exists(self.path("none.g")))

    def test_a_device_and_a_mesh_that_is_write_protected_stay(self):
        balls = [("balls", "SPHERE", np.array([[0]]), np.ones(1))]
        exodus.write_mesh(self.path("kept.g"), self.NODES, balls, {})
        os.mkfifo(self.path("pipe.g"))
        os.symlink("pipe.g", self.path("link.g"))
        for name, told in (("pipe.g", "a pipe or a device"), ("link.g", "a pipe or a device"), ("kept.g", "may not be written")):
            before = os.stat(self.path(name))
            # Root may write what is protected: this test may be root's.
            with mock.patch("os.access", return_value=False), self.assertRaisesRegex(SystemExit, told):
                exodus.write_mesh(self.path(name), self.NODES, balls, {})
            self.assertEqual(os.stat(self.path(name)), before)
        self.assertEqual(sorted(os.listdir(self.folder)), ["kept.g", "link.g", "pipe.g"])

    def test_two_processes_that_write_one_mesh_do_not_meet(self):
        balls = [("balls", "SPHERE", np.array([[0]]), np.ones(1))]
        replace = os.replace

        def replaced_meanwhile(part, whole):
            with mock.patch("os.replace", replace), mock.patch("os.getpid", return_value=1):
                exodus.write_mesh(whole, self.NODES, balls, {})  # by the other one
            replace(part, whole)

        with mock.patch("os.replace", replaced_meanwhile):
            exodus.write_mesh(self.path("out.g"), self.NODES, balls, {})
        self.assertEqual(os.listdir(self.folder), ["out.g"])


class KnownAnswers(ToolTest):
    def test_a_ball_has_the_volume_of_a_ball_and_its_diameter(self):
        said, mesh = self.voxels(ball(48, 20))
        # Lattice points in a ball of radius r miss 4/3 pi r^3 by about r (the error of Gauss' problem, far below r^2).
        points = len(mesh.blocks["foam"])
        self.assertLess(abs(points - 4 / 3 * np.pi * 20**3), 20 * 4)
        self.assertAlmostEqual(first_number(said["density"]), 100 * points / 48**3, places=3)
        np.testing.assert_allclose(hexahedra_volumes(mesh), 1e-9, rtol=1e-9)  # coordinates to 1e-16 of 0.05, edges 1e-3
        # One ridge, in the middle: the distance to the first void voxel, within a voxel of the radius on each side.
        self.assertLess(abs(first_number(said["thickness"].split("largest")[1]) - 40), 2)
        self.assertEqual(said["faces"], "touched: none")
        self.assertEqual(mesh.sets, {})

    def test_a_bar_has_its_thickness_and_touches_two_faces(self):
        for thick in (4, 6, 10):  # an even number is exact, by the definition
            said, mesh = self.voxels(box((12, 20, 30), (0, 12), (5, 5 + thick), (7, 7 + thick)))
            self.assertEqual(first_number(said["thickness"].split("mean")[1]), thick)
            self.assertEqual(said["faces"], "touched: zmin zmax")
            self.assertEqual(set(mesh.sets), {"foam_zmin", "foam_zmax"})
            self.assertEqual(len(mesh.sets["foam_zmin"]), (thick + 1)**2)
            np.testing.assert_array_equal(mesh.nodes[mesh.sets["foam_zmin"], 2], 0)
            np.testing.assert_allclose(mesh.nodes[mesh.sets["foam_zmax"], 2], 0.012)
            self.assertEqual(len(mesh.blocks["foam"]), 12 * thick**2)
            self.assertEqual(len(mesh.nodes), 13 * (thick + 1)**2)  # shared

    def test_the_mean_thickness_of_slanted_cylinders_is_theirs(self):
        place = np.indices((40, 40, 40)) - 19.7
        for diameter, axis in itertools.product((5, 8), ((0.3, 0.5, 0.8), (0.7, 0.7, 0.1))):
            axis = np.array(axis) / np.linalg.norm(axis)
            radial = (place**2).sum(0) - np.tensordot(axis, place, 1)**2
            said, _ = self.voxels(radial < (diameter / 2)**2)
            # A distance between centers of voxels is known to a voxel, here at both sides of the ridge.
            self.assertLess(abs(first_number(said["thickness"].split("mean")[1]) - diameter), 1)

    def test_the_largest_of_two_pieces_is_kept_or_both(self):
        image = box((8, 8, 20), (1, 5), (1, 5), (1, 9)) | box((8, 8, 20), (5, 7), (5, 7), (9, 12))  # meet at an edge
        said, mesh = self.voxels(image)
        self.assertEqual(len(mesh.blocks["foam"]), 4 * 4 * 8)
        self.assertIn("2, the largest kept: 128 of 140", said["pieces"])
        for pieces in (0, 2, 5):
            _, mesh = self.voxels(image, "--pieces", pieces)
            self.assertEqual(len(mesh.blocks["foam"]), 140)

    def test_a_spur_is_reported_or_dropped_from_its_end(self):
        image = box((9, 9, 20), (2, 7), (2, 7), (2, 7)) | box((9, 9, 20), (4, 5), (4, 5), (7, 15))
        said, mesh = self.voxels(image)
        self.assertEqual(len(mesh.blocks["foam"]), 125 + 8)
        # The last has one neighbor, those before it two; the first stands on nine of the cube.
        self.assertIn("7 voxels have fewer than 4", said["spurs"])
        said, mesh = self.voxels(image, "--spurs", "drop")
        self.assertEqual(len(mesh.blocks["foam"]), 125 + 1)
        _, mesh = self.voxels(image, "--spurs", "drop", "--min-neighbors", 2)
        self.assertEqual(len(mesh.blocks["foam"]), 125 + 1)  # one after the other, while the end has one neighbor
        _, mesh = self.voxels(image, "--spurs", "drop", "--min-neighbors", 1)
        self.assertEqual(len(mesh.blocks["foam"]), 125 + 8)

    def test_pieces_that_hung_on_a_spur_are_dropped_with_it(self):
        image = box((9, 9, 30), (2, 7), (2, 7), (2, 7)) | box((9, 9, 30), (4, 5), (4, 5), (7, 20))
        image |= box((9, 9, 30), (3, 6), (3, 6), (20, 23))
        said, mesh = self.voxels(image, "--spurs", "drop")
        self.assertEqual(len(mesh.blocks["foam"]), 125 + 1)  # the small cube is a piece of its own now
        self.assertIn("more with what they held", said["spurs"])
        _, mesh = self.voxels(image, "--spurs", "drop", "--min-neighbors", 2)
        self.assertEqual(len(mesh.blocks["foam"]), 125 + 13 + 27)  # both its ends are held: none has fewer than two

    def test_otsu_parts_two_gaussians_between_them(self):
        rng = np.random.default_rng(1)
        solid = ball(40, 12)
        levels = {"u1": (60, 180, 12), "u2": (9000, 30000, 2000), "f4": (-0.2, 1.0, 0.1)}
        for kind, (low, high, width) in levels.items():
            image = (rng.normal(0, width, solid.shape) + np.where(solid, high, low)).astype(kind)
            said, mesh = self.voxels(image)
            threshold = first_number(said["threshold"])
            # Five standard deviations from both: of 64,000 voxels less than one is expected on the wrong side.
            self.assertLess(low + 4.5 * width, threshold)
            self.assertLess(threshold, high - 4.5 * width)
            self.assertEqual(len(mesh.blocks["foam"]), solid.sum())
            _, mesh = self.voxels(image, "--invert", "--pieces", 0)
            self.assertEqual(len(mesh.blocks["foam"]), (~solid).sum())

    def test_a_field_of_view_whose_outside_misleads_otsu_is_told(self):
        rng, solid = np.random.default_rng(1), ball(40, 8)
        y, x = np.indices(solid.shape[1:]) - 19.5
        image = (rng.normal(0, 300, solid.shape) + np.where(solid, 6000, 0)).astype("i2")
        outside = np.broadcast_to(np.hypot(x, y) > 18, solid.shape)
        for value, misleads in ((-3000, True), (-32768, True), (0, False)):
            image[outside] = value
            said = self.voxels(image)[0]["threshold"]
            self.assertEqual("WARNING" in said, misleads, said)
            if misleads:
                self.assertIn(f"have the value {value}, and few others", said)
                better = re.search(r"--threshold (\d+)", said)[1]
                self.assertEqual(len(self.voxels(image, "--threshold", better)[1].blocks["foam"]), solid.sum())
        image = np.where(solid, 100 + image // 1000, 0).astype("u1")  # what was cut out of air that is 0
        self.assertNotIn("WARNING", self.voxels(image)[0]["threshold"])

    def test_a_threshold_is_what_solid_is_larger_than(self):
        image = np.arange(64, dtype="u1").reshape(4, 4, 4)
        self.assertEqual(len(self.voxels(image, "--threshold", 31)[1].blocks["foam"]), 32)
        self.assertEqual(len(self.voxels(image, "--threshold", 31.5)[1].blocks["foam"]), 32)
        self.assertEqual(len(self.voxels(image, "--threshold", 31, "--invert")[1].blocks["foam"]), 32)

    def test_crop_coarsen_and_refine_keep_counts(self):
        image = box((20, 20, 20), (4, 16), (4, 16), (4, 16))
        _, mesh = self.voxels(image, "--crop", 0.5, 1, 0, 1, 0, 0.25)
        self.assertEqual(len(mesh.blocks["foam"]), 6 * 12 * 1)
        self.assertEqual(set(mesh.sets), {"foam_xmin", "foam_zmax"})
        _, mesh = self.voxels(image, "--coarsen", 2)
        self.assertEqual(len(mesh.blocks["foam"]), 6**3)
        np.testing.assert_allclose(hexahedra_volumes(mesh).sum(), 12**3 * 1e-9, rtol=1e-9)
        said, mesh = self.voxels(image, "--refine", 3)
        self.assertEqual(len(mesh.blocks["foam"]), 36**3)
        np.testing.assert_allclose(hexahedra_volumes(mesh).sum(), 12**3 * 1e-9, rtol=1e-9)
        # 20 = 2 * 7 + 6: the lower two cells of 7 hold layers 0-6 and 7-13, the solid 3/7 and all of them.
        said, mesh = self.voxels(image, "--coarsen", 7)
        self.assertEqual(said["cut"].split()[1:4], ["6", "x", "6"])
        self.assertEqual(len(mesh.blocks["foam"]), 1)

    def test_coarsening_counts_half_as_solid(self):
        image = box((4, 4, 4), (0, 1), (0, 4), (0, 4))
        self.assertEqual(len(self.voxels(image, "--coarsen", 2)[1].blocks["foam"]), 4)
        image[0, 0, 0] = 0  # one of eight less than half
        self.assertEqual(len(self.voxels(image, "--coarsen", 2)[1].blocks["foam"]), 3)

    def test_spacing_makes_cubes_of_anisotropic_voxels(self):
        image = box((10, 20, 40), (2, 8), (4, 16), (8, 32))
        _, mesh = self.voxels(image, "--voxel-size", 1e-3, 2e-3, 4e-3, "--spacing", 1e-3)
        self.assertEqual(len(mesh.blocks["foam"]), 24 * 24 * 24)
        np.testing.assert_allclose(hexahedra_volumes(mesh), 1e-9, rtol=1e-9)
        np.testing.assert_allclose(np.ptp(mesh.nodes, axis=0), 0.024)

    def test_sizes_and_origin_place_the_box(self):
        image = box((10, 20, 40), (0, 10), (0, 20), (0, 39))
        _, mesh = self.voxels(image, "--size", 0.4)
        np.testing.assert_allclose(np.ptp(mesh.nodes, axis=0), (0.39, 0.2, 0.1))
        _, mesh = self.voxels(image, "--size", 0.4, 0.4, 0.4, "--origin", "-1e-1", 2, "-3")
        np.testing.assert_allclose(mesh.nodes.min(axis=0), (-0.1, 2, -3))
        np.testing.assert_allclose(np.ptp(mesh.nodes, axis=0), (0.39, 0.4, 0.4))

    def test_spheres_have_the_volumes_of_hexahedra_and_stand_in_their_middles(self):
        image = box((6, 7, 9), (0, 3), (1, 5), (2, 9))
        size = ("--voxel-size", 1e-3, 2e-3, 3e-3)
        _, hexes = self.voxels(image, *size)
        _, spheres = self.voxels(image, *size, "--elements", "sphere", "--block", "strut")
        np.testing.assert_allclose(spheres.attributes["strut"][:, 1], 6e-9)
        np.testing.assert_allclose(hexahedra_volumes(hexes), 6e-9, rtol=1e-9)
        middles = hexes.nodes[hexes.blocks["foam"]].mean(axis=1)
        np.testing.assert_allclose(spheres.nodes[spheres.blocks["strut"][:, 0]], middles, atol=1e-15)
        self.assertEqual(set(spheres.sets), {"strut_xmax", "strut_zmin"})
        self.assertEqual(len(spheres.sets["strut_zmin"]), 4 * 7)
        np.testing.assert_allclose(spheres.nodes[spheres.sets["strut_xmax"], 0], 8.5e-3)

    def test_points_are_found_on_their_lattice(self):
        z, y, x = np.nonzero(ball(12, 5))
        lines = "".join(f"{1 + 0.1 * a:.6g} {0.2 * b:.6g} {-1 / 3 * c:.6g}\n" for a, b, c in zip(x, y, z))
        for name, content in {"a.pts": lines, "a.pts.gz": gzip.compress(lines.encode())}.items():
            said, mesh = self.works("voxels", self.write(name, content))
            self.assertEqual(len(mesh.blocks["foam"]), len(x))
            # Six digits of numbers up to 4 on ten places: 1e-6 of a spacing and less.
            np.testing.assert_allclose(hexahedra_volumes(mesh), 0.1 * 0.2 / 3, rtol=1e-5)
            self.assertEqual(said["faces"], "touched: xmin xmax ymin ymax zmin zmax")


class Cells(ToolTest):
    """--cells: columns of the attributes are volume, centroid, moments (xx yy zz xy yz zx), surface."""

    def cells(self, image, *words):
        said, mesh = self.voxels(image, *words)
        return said, mesh, mesh.attributes["foam"]

    def test_a_cube_that_is_off_the_cells_keeps_its_moments(self):
        image = box((9, 9, 9), (1, 6), (2, 6), (3, 8))
        edge = np.array([1e-3, 2e-3, 3e-3])
        said, mesh, cells = self.cells(image, "--cells", 3, "--voxel-size", *edge, "--origin", 1, 2, 3)
        places = (np.stack(np.nonzero(image)[::-1], axis=1) + 0.5) * edge + (1, 2, 3)
        volume, center = cells[:, 0], cells[:, 1:4]
        self.assertGreaterEqual(volume.min(), 0.3 * 27 * 6e-9)
        np.testing.assert_allclose(volume.sum(), 100 * 6e-9, rtol=1e-12)
        np.testing.assert_allclose(volume @ center / volume.sum(), places.mean(axis=0), rtol=1e-12)
        second = volume @ (cells[:, 4:7] + (center - places.mean(axis=0))**2) / volume.sum()
        np.testing.assert_allclose(second, (np.array([5, 4, 5]) * edge)**2 / 12, rtol=1e-9)  # of a box
        np.testing.assert_allclose(cells[:, 10:13].sum(axis=0), 0, atol=1e-15)
        np.testing.assert_allclose(hexahedra_volumes(mesh), 27 * 6e-9, rtol=1e-9)
        self.assertEqual(set(mesh.sets), {"foam_xmax", "foam_ymin", "foam_zmin"})

    def test_a_bar_is_told_its_thickness_in_cells_and_the_error_to_expect(self):
        said, _, _ = self.cells(box((12, 20, 30), (0, 12), (5, 11), (7, 13)), "--cells", 3)
        self.assertRegex(said["members"], r"^on the average 2 cells thick: .* expect up to ±\d+ % in the stiffness and \+")
        said, _, _ = self.cells(box((12, 20, 20), (0, 12), (5, 10), (10, 15)), "--cells", 3, "--crop", 0.5, 0.75, 0.25, 0.5, 0, 1)
        self.assertEqual(said["thickness"], "the box is all solid")
        self.assertNotIn("members", said)

    def test_small_cells_are_kept_where_none_is_too_small(self):
        image = box((8, 12, 8), (0, 8), (0, 9), (0, 8))
        self.assertEqual(len(self.cells(image, "--cells", 4)[2]), 8)  # a quarter of a cell is merged
        self.assertEqual(len(self.cells(image, "--cells", 4, "--smallest-cell", 0.2)[2]), 12)

    def test_a_plate_one_cell_thick_gets_two_layers(self):
        said, mesh, cells = self.cells(box((8, 8, 8), (0, 8), (0, 4), (0, 8)), "--cells", 4)
        self.assertIn("4 cut in two layers", said["cells"])
        self.assertEqual(len(cells), 8)
        np.testing.assert_allclose(np.unique(cells[:, 2] / np.ptp(cells[:, 2])), (0.5, 1.5))

    def test_grey_voxels_are_solid_in_part(self):
        image = np.full((12, 12, 12), 50, "u1")
        image[3:9, 3:9, 3:9] = 250
        image[9, 3:9, 3:9] = 100  # a quarter
        image[0, 0, 0] = 240  # apart, and dropped
        for words in (("--grey", 50, 250), ("--grey", 50, 250, "--threshold", 180)):
            said, mesh, cells = self.cells(image, "--cells", 1, *words)
            np.testing.assert_allclose(cells[:, 0].sum(), (216 + 9) * 1e-9, rtol=1e-6)  # parts in single precision
            self.assertEqual(len(cells), 216)  # the quarters are less than 0.3
            np.testing.assert_allclose(cells[:, 3].max(), (0.5 * 1 + 0.25 * 1.5) / 1.25 * 1e-3 + 8e-3, rtol=1e-6)
            np.testing.assert_allclose(cells[:, 10:13].sum(axis=0), 0, atol=1e-12)
        said, mesh, cells = self.cells(image, "--cells", 3, "--grey")
        self.assertIn("void 50, solid 250", said["levels"])
        self.assertIn("12.500 % of the box", said["density"])
        self.assertIn("13.02 % of the box by grey values, +4.17 % beside the 12.5 % of the threshold alone", said["grey"])
        self.assertEqual(len(cells), 8)

    def test_grey_levels_make_no_mass_and_a_density_is_met(self):
        fine = struts_that_cross(4 * 32)
        true = fine.mean()
        part = 8000 * fine.reshape(32, 4, 32, 4, 32, 4).mean(axis=(1, 3, 5))
        noise = np.random.default_rng(1).normal(0, 180, part.shape)
        much = 1.5 * scipy.ndimage.gaussian_filter(np.random.default_rng(1).normal(0, 2000, part.shape), 0.6)
        for blur, noise in ((0.5, noise), (1.5, noise), (1.0, much)):  # voxels; the struts are 7 thick
            image = (scipy.ndimage.gaussian_filter(part, blur) + noise).astype("i2")
            # The middle of a strut has 1 - exp(-R²/2σ²) of the level, 0.93 for the largest blur, and rims end a voxel beyond
            # the threshold: -2 to +5 %. Means of both sides of the threshold would give 4 to 40 % too much.
            _, _, cells = self.cells(image, "--cells", 2, "--grey", "--smallest-cell", 0)
            self.assertLess(abs(cells[:, 0].sum() / (true * 32**3 * 1e-9) - 1), 0.05, blur)
        said, _, cells = self.cells(image, "--cells", 2, "--grey", "--smallest-cell", 0, "--density", 0.1)
        self.assertLess(abs(cells[:, 0].sum() / (0.1 * 32**3 * 1e-9) - 1), 1e-3, said["grey"])
        # With the threshold alone: whole voxels.
        said, mesh = self.voxels(image, "--density", 0.1)
        self.assertLess(abs(len(mesh.blocks["foam"]) / (0.1 * 32**3) - 1), 1e-3, said["density"])
        said, mesh = self.voxels((8000 - image).astype("i2"), "--density", 0.1, "--invert", "--spurs", "drop")
        self.assertLess(abs(len(mesh.blocks["foam"]) / (0.1 * 32**3) - 1), 1e-3, said["density"])

    def test_noise_takes_no_mass_from_the_inside(self):
        image = np.full((24, 24, 24), 60.0)
        image[4:20, 4:20, :] = 180
        noisy = (image + np.random.default_rng(2).normal(0, 15, image.shape)).astype("i2")
        # 16 x 16 of 24 x 24 voxels, sharp. The clip takes 0.05 of a voxel from each of 60 at the surface of a layer and gives as
        # much to each of 68 in the rim: +0.16 %; as much again for cells that are dropped. From all voxels it would take 4.9 %.
        for words in (("--grey", 60, 180), ("--grey", "--density", 4 / 9)):
            with self.subTest(words):
                _, _, cells = self.cells(noisy, "--cells", 2, "--smallest-cell", 0, *words)
                self.assertLess(abs(cells[:, 0].sum() / (16 * 16 * 24e-9) - 1), 5e-3)

    def test_materials_are_blocks_that_share_nodes(self):
        image = box((6, 8, 10), (1, 5), (1, 7), (0, 4)) * 90 + box((6, 8, 10), (1, 5), (1, 7), (4, 10)) * 200
        image[2, 3, 2] = 100  # belongs to the first: not larger than 100
        words = ("--material", "foam", 50, 100, "--material", "skin", 100, "inf")
        said, mesh = self.voxels(image, *words, "--slices", self.path("slices.png"))
        self.assertEqual({name: len(elements) for name, elements in mesh.blocks.items()}, {"foam": 4 * 24, "skin": 6 * 24})
        self.assertEqual(said["materials"], "foam 96, skin 144")
        self.assertEqual(len(mesh.nodes), 5 * 7 * 11)  # of one box
        places = mesh.nodes[mesh.blocks["foam"]].mean(axis=1)
        self.assertLess(places[:, 0].max(), 4e-3)
        self.assertIn("foam_xmin", mesh.sets)
        self.assertGreater(os.path.getsize(self.path("slices.png")), 20000)
        _, mesh = self.voxels(image, *words, "--refine", 2)
        self.assertEqual({name: len(elements) for name, elements in mesh.blocks.items()}, {"foam": 8 * 96, "skin": 8 * 144})
        # A coarse voxel of 2 x 2 x 2 has the material of most, where half of it is solid: along z and y the first and
        # the last cell are half filled, and those at the edges a quarter: 4 + 2 + 2 of the 3 x 4 are left.
        _, mesh = self.voxels(image, *words, "--coarsen", 2)
        self.assertEqual({name: len(elements) for name, elements in mesh.blocks.items()}, {"foam": 2 * 8, "skin": 3 * 8})

    def test_slices_show_the_scan_and_what_is_kept(self):
        sys.path[:0] = [os.path.join(ROOT, "tools")]
        from picture_parts import slices

        image = np.arange(2 * 4 * 6).reshape(2, 4, 6)
        self.assertEqual(slices.slice_of(image, "z").tolist(), image[1].tolist())
        self.assertEqual(slices.slice_of(image, "y").tolist(), image[:, 2].tolist())
        self.assertEqual(slices.slice_of(image, "x").tolist(), image[:, :, 3].tolist())
        tifffile.imwrite(self.path("a.tif"), np.asarray(image, "u1"), photometric="minisblack")
        done = self.run_tool("picture", "--scan", self.path("a.tif"), self.path("a.png"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertGreater(os.path.getsize(self.path("a.png")), 10000)

    def test_wrong_cells(self):
        tifffile.imwrite(self.path("a.tif"), box((4, 4, 4), (0, 2), (0, 4), (0, 4)), photometric="minisblack")
        for words, expected in ((("--cells", 1), "from 2 to 16"), (("--cells", 17), "from 1 to 16"),
                                (("--cells", 2.5), "1 whole number"),
                                (("--smallest-cell", 0.2), "needs --cells"), (("--grey",), "--grey needs --cells"),
                                (("--cells", 2, "--smallest-cell", 1), "from 0 to 0.9"),
                                (("--cells", 2, "--elements", "sphere"), "leave out --elements"),
                                (("--cells", 2, "--grey", 1), "no or 2 numbers"),
                                (("--cells", 2, "--grey", 1, 1), "two different values"),
                                (("--cells", 2, "--grey", "--coarsen", 2), "leave out --coarsen"),
                                (("--cells", 2, "--grey"), "has two values"), (("--density", 0.1), "--density needs an image in grey"),
                                (("--density", 10), "--density: expected a part of the box, from 0 to 1"),
                                (("--density", 0.1, "--threshold", 1), "--density chooses threshold and levels"),
                                (("--density", 0.1, "--coarsen", 2), "--density takes the voxels as they are")):
            self.refused("voxels", expected, self.path("a.tif"), "--voxel-size", 1e-3, *words)

    def test_levels_in_the_wrong_order_are_refused(self):
        tifffile.imwrite(self.path("a.tif"), np.linspace(0, 100, 512).reshape(8, 8, 8).astype("u1"), photometric="minisblack")
        self.refused("voxels", "expected the level of void first", self.path("a.tif"), "--voxel-size", 1e-3, "--cells", 2, "--grey", 100, 0)

    def test_what_coarsening_does_to_the_volume_is_told(self):
        """A wall of two voxels that is off the grid of pairs is half of two pairs, and becomes both: twice the volume."""
        said, _ = self.voxels(box((8, 8, 8), (0, 8), (0, 8), (3, 5)), "--coarsen", 2)
        self.assertIn("+100.00 % of the volume that it had before --coarsen", said["sampled"])


class CtFoam(ToolTest):
    @unittest.skipUnless(os.path.exists(CT_FOAM), f"the CT foam is not there: {CT_FOAM}")
    def test_the_ct_foam_is_what_is_known_of_it(self):
        said, mesh = self.works("voxels", CT_FOAM, "--size", 2.5e-3)
        self.assertIn("204 x 204 x 160 voxels", said["image"])
        self.assertIn("0.00098039 x 0.00098039 x 0.00125", said["image"])
        self.assertIn("3, the largest kept: 379,485 of 380,892", said["pieces"])
        self.assertEqual(said["faces"], "touched: xmin xmax ymin ymax zmin zmax")
        self.assertEqual(len(mesh.blocks["foam"]), 379485)
        np.testing.assert_allclose(np.ptp(mesh.nodes, axis=0), 2.5e-3, rtol=1e-5)  # text of six digits
        said, mesh = self.works("voxels", CT_FOAM, "--pieces", 0, "--elements", "sphere")
        self.assertEqual(said["density"], "5.720 % of the box")
        self.assertEqual(len(mesh.sets), 6)


# Formats


def struts_that_cross(n):
    """Along each axis one, of 7/32 of the edge thick."""
    x = (np.arange(n) + 0.5) / n - 0.5
    z, y, x = np.meshgrid(x, x, x, indexing="ij")
    return np.minimum(np.minimum(x**2 + y**2, y**2 + z**2), z**2 + x**2) < (3.5 / 32)**2


def image_in_grey():
    values = np.zeros((4, 5, 6), np.uint8)
    values[1:3, 1:4, 1:5] = np.arange(24).reshape(2, 3, 4) + 100
    return values


def vtk_image(values, spacing):
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData

    image = vtkImageData()
    image.SetDimensions(*values.shape[::-1])
    image.SetSpacing(*spacing)
    array = numpy_to_vtk(np.ascontiguousarray(values).ravel(), deep=True)
    array.SetName("grey")
    image.GetPointData().SetScalars(array)
    return image


def written(writer, path, image, **words):
    writer.SetFileName(path)
    for name, value in words.items():
        getattr(writer, name)(value)
    writer.SetInputData(image)
    writer.Write()
    return path


def nrrd(values, encoding="raw", order="little"):
    kinds = {"uint8": "uint8", "int16": "short", "uint16": "uint16", "float32": "float"}
    sizes = " ".join(map(str, values.shape[::-1]))
    header = (f"NRRD0004\ntype: {kinds[values.dtype.name]}\ndimension: 3\nsizes: {sizes}\nspacings: 0.001 0.002 0.003\n"
              f"endian: {order}\nencoding: {encoding}\n\n")
    data = values.astype(values.dtype.newbyteorder("<" if order == "little" else ">")).tobytes()
    as_text = {"ascii": lambda: " ".join(map(str, values.ravel().tolist())).encode(), "hex": lambda: data.hex().encode()}
    packed = {"raw": lambda: data, "gzip": lambda: gzip.compress(data), "bzip2": lambda: bz2.compress(data), **as_text}
    return header.encode() + packed[encoding]()


def vax(x):
    """The bytes of a float as a VAX has them."""
    bits = int(np.float32(4 * x).view(np.uint32))
    return np.array([bits >> 16, bits & 0xffff], "<u2").tobytes()


def scanco(kind, data, shape, spacing, new):
    whole = "<i8" if new else "<i4"
    numbers = np.zeros(21, whole)
    numbers[3:6] = shape[::-1]
    head = (bytes(20) + np.array([kind], "<i4").tobytes() + numbers.tobytes() + b"".join(vax(1e3 * s) for s in spacing))
    head = head.ljust(280 if new else 140, b"\0")
    if kind in (0x00150001, 0x00080002):
        data = np.array([len(data) + np.dtype(whole).itemsize], whole).tobytes() + data
    log = b"! Processing Log\nTime   now\n"
    before = np.array([40 if new else 20, len(head), len(log), len(data), 0], whole).tobytes()
    return (b"AIMDATA_V030   \0" if new else b"") + before + head + log + data


def packed_bits(bits):
    even = np.pad(bits, [(0, n % 2) for n in bits.shape])
    out = np.zeros([n // 2 for n in even.shape], np.uint8)
    for z, y, x in np.ndindex(2, 2, 2):
        out |= even[z::2, y::2, x::2].astype(np.uint8) << (x + 2 * y + 4 * z)
    return out.tobytes()


def runs_of_bits(values, one):
    out, now, run = bytearray([0, one]), 0, 0
    for v in [*values, None]:
        if v is not None and (v != 0) == (now != 0):
            run += 1
            continue
        while run >= 255:
            out.append(255)  # 254 of them, and it goes on
            run -= 254
        out.append(run)
        now, run = one - now, 1
    return bytes(out)


def isq(values, spacing):
    head = bytearray(512)
    head[:16] = b"CTDATA-HEADER_V1"
    sizes = values.shape[::-1]
    head[44:68] = np.array([*sizes, *(round(1e6 * s * n) for s, n in zip(spacing, sizes))], "<i4").tobytes()
    head[508:512] = np.array([1], "<i4").tobytes()
    return bytes(head) + bytes(512) + values.astype("<i2").tobytes()


class Formats(ToolTest):
    spacing = (1e-3, 2e-3, 3e-3)

    def setUp(self):
        super().setUp()
        # No symmetry: an axis that is exchanged or turned round is seen.
        self.image = np.zeros((8, 10, 12), "u1")
        self.image[1:4, 2:5, 0:9] = 200
        self.image[1:2, 2:9, 3:5] = 180
        self.image[5, 5, 5] = 7

    def middles(self, spacing):
        return (np.stack(np.nonzero(self.image > 100)[::-1], axis=1) + 0.5) * spacing

    def check(self, path, *words, spacing=None):
        _, mesh = self.works("voxels", path, "--elements", "sphere", *words)
        expected = self.middles(spacing or self.spacing)
        np.testing.assert_allclose(mesh.nodes, expected, rtol=1e-6)  # spacings are written with six digits or more

    def test_nrrd(self):
        for kind, encoding in itertools.product(("u1", "u2", "f4"), ("raw", "gzip")):
            self.check(self.write("a.nrrd", nrrd(self.image.astype(kind), encoding)))

    def test_nrrd_in_all_encodings_and_orders_of_bytes(self):
        values = np.arange(-60, 60).reshape(3, 8, 5)  # an axis of five is no color
        for kind, encoding, order in itertools.product(("i2", "f4"), ("raw", "gzip", "bzip2", "ascii", "hex"), ("little", "big")):
            found = images.read(self.write("a.nrrd", nrrd(values.astype(kind), encoding, order)))
            np.testing.assert_array_equal(found.values, values, err_msg=f"{kind} {encoding} {order}")
            self.assertEqual(found.spacing, (0.001, 0.002, 0.003))

    def test_nrrd_of_other_writers(self):
        head, data = nrrd(self.image).split(b"\n\n", 1)
        titled = b"\n".join(line.title() if b": " in line else line for line in head.split(b"\n"))
        self.check(self.write("a.nrrd", titled + b"\n\n" + data))
        millimeters = titled.replace(b"0.001 0.002 0.003", b'1 2 3\nSpace Units: "mm" "mm" "mm"')
        self.check(self.write("a.nrrd", millimeters + b"\n\n" + data))
        streams = b"".join(gzip.compress(data[n:n + 100]) for n in range(0, len(data), 100))
        self.check(self.write("a.nrrd", head.replace(b"raw", b"gzip") + b"\n\n" + streams))
        large = nrrd(self.image, "ascii").replace(b" 200 ", b" 456 ")
        self.refused("voxels", "456 is no number of type uint8", self.write("a.nrrd", large))

    def test_nrrd_with_directions(self):
        def file(directions):
            head = nrrd(self.turned()).replace(b"spacings: 0.001 0.002 0.003", b"space directions: " + directions)
            return self.write("a.nrrd", head)

        self.check(file(b"(0,2e-3,0) (1e-3,0,0) (0,0,-3e-3)"))
        # Voxels would have the volume of boxes.
        self.refused("voxels", "not at right angles", file(b"(2e-4,2e-3,0) (1e-3,0,0) (0,0,-3e-3)"))
        self.refused("voxels", "would stand askew", file(b"(-1e-4,2e-3,0) (1e-3,5e-5,0) (0,0,-3e-3)"))

    def turned(self):
        """The image with y as its fastest axis, and z downward."""
        return self.image.transpose(0, 2, 1)[::-1]

    def test_meta_image_and_vtk_with_directions(self):
        head = ("ObjectType = Image\nNDims = 3\nTransformMatrix = 0 1 0 1 0 0 0 0 -1\nElementSpacing = 0.002 0.001 0.003\n"
                "DimSize = 10 12 8\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n")
        self.check(self.write("a.mha", head.encode() + self.turned().tobytes()), "--units", "m")
        vti = ('<?xml version="1.0"?><VTKFile type="ImageData" version="0.1" byte_order="LittleEndian"><ImageData '
               'WholeExtent="0 10 0 12 0 8" Origin="0 0 0" Spacing="0.002 0.001 0.003" Direction="0 1 0 1 0 0 0 0 -1">'
               '<Piece Extent="0 10 0 12 0 8"><CellData Scalars="s"><DataArray type="UInt8" Name="s" format="ascii">'
               f'{" ".join(map(str, self.turned().ravel()))}</DataArray></CellData></Piece></ImageData></VTKFile>')
        self.check(self.write("a.vti", vti.encode()), "--units", "m")

    def test_nrrd_with_several_data_files(self):
        head, data = nrrd(self.image).split(b"\n\n", 1)
        for z in range(8):
            self.write(f"{z:02d}.raw", data[120 * z:120 * (z + 1)])
        self.check(self.write("a.nhdr", head + b"\ndata file: %02d.raw 0 7 1\n"))
        self.check(self.write("a.nhdr", head + b"\ndata file: LIST\n" + b"".join(b"%02d.raw\n" % z for z in range(8))))

    def test_bytes_in_the_other_order(self):
        noise = np.random.default_rng(1).normal(0, 20, self.image.shape)
        for kind, (code, values) in {"int16": ("i2", 300 + 10.0 * self.image + noise), "int32": ("i4", self.image),
                                     "float32": ("f4", self.image + 0.01 * noise)}.items():
            path = self.write("a.raw", values.astype(">" + code).tobytes())
            words = ("--shape", 12, 10, 8, "--type", kind, "--voxel-size", *self.spacing)
            self.refused("voxels", "expected --byte-order big", path, *words)
            words += ("--threshold", 1000 if code == "i2" else 100)
            self.works("voxels", path, *words, "--byte-order", "big")
            self.works("voxels", self.write("a.raw", values.astype("<" + code).tobytes()), *words)
        head = "ObjectType = Image\nNDims = 3\nDimSize = 12 10 8\nElementType = MET_SHORT\nElementDataFile = LOCAL\n"
        self.refused("voxels", "BinaryDataByteOrderMSB = True", self.write("a.mha", head.encode() + self.image.astype(">i2").tobytes()),
                     "--size", 1)

    def test_nrrd_with_detached_data(self):
        head, data = nrrd(self.image, "gzip").split(b"\n\n", 1)
        self.write("a.raw.gz", data)
        self.check(self.write("a.nhdr", head + b"\ndata file: a.raw.gz\n"))

    def test_raw(self):
        kinds = {"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4", "float32": "f4",
                 "float64": "f8"}
        for (kind, code), (order, sign), header in itertools.product(kinds.items(), (("little", "<"), ("big", ">")), (0, 37)):
            expected = self.image.astype(int) - (100 if not kind.startswith("u") else 0)
            path = self.write("a.raw", bytes(header) + expected.astype(sign + code).tobytes())
            found = images.read(path, images.Raw([12, 10, 8], kind, order, header)).values
            np.testing.assert_array_equal(found, expected, err_msg=f"{kind} {order} {header}")
        path = self.write("a.raw", bytes(37) + self.image.astype(">i2").tobytes())
        self.check(path, "--shape", 12, 10, 8, "--type", "int16", "--byte-order", "big", "--header", 37,
                   "--voxel-size", *self.spacing, "--threshold", 100)

    def test_scanco(self):
        bits = self.image > 100
        plain = {0x00010001: (bits * 100, "i1"), 0x00170002: (self.image * 255.0, "<u2"), 0x00020002: (self.image - 100.0, "<i2"),
                 0x00030004: (self.image * 1e6, "<i4"), 0x001a0004: (self.image * 0.25, "<f4")}
        kinds = {kind: (values, values.astype(code).tobytes()) for kind, (values, code) in plain.items()}
        ones = bits * 127
        kinds.update({0x00060001: (ones, packed_bits(bits) + b"\x7f"), 0x00150001: (ones, runs_of_bits(ones.ravel(), 127)),
                      0x00080002: (ones, b"".join(bytes([1, v]) for v in ones.ravel().tolist()))})
        for (kind, (values, data)), new in itertools.product(kinds.items(), (False, True)):
            found = images.read(self.write("a.aim", scanco(kind, data, self.image.shape, self.spacing, new)))
            np.testing.assert_array_equal(found.values, values, err_msg=f"{kind:#x} {new}")
            np.testing.assert_allclose(found.spacing, self.spacing, rtol=1e-6)  # floats
        self.check(self.write("a.aim", scanco(0x00060001, kinds[0x00060001][1], self.image.shape, self.spacing, True)))
        found = images.read(self.write("a.isq", isq(self.image, self.spacing)))
        np.testing.assert_array_equal(found.values, self.image)
        np.testing.assert_allclose(found.spacing, self.spacing, rtol=1e-12)

    def test_units_of_the_file_and_in_place_of_them(self):
        mm = [1e3 * s for s in self.spacing]
        for field in ('space units: "mm" "mm" "mm"', 'units: "mm" "mm" "mm"', 'units: "millimeters"'):
            text = nrrd(self.image).replace(b"spacings: 0.001 0.002 0.003", b"spacings: 1 2 3\n" + field.encode())
            self.check(self.write("a.nrrd", text))
        plain = nrrd(self.image).replace(b"0.001 0.002 0.003", b"1 2 3")
        self.check(self.write("a.nrrd", plain), "--units", "mm")
        for unit, factor in (("mm", 1), ("um", 1e3), ("cm", 0.1)):
            head = ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nDistanceUnits = "
                    f"{unit}\nElementSpacing = {' '.join(f'{factor * s:g}' for s in mm)}\nDimSize = 12 10 8\n"
                    "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n")
            self.check(self.write("a.mha", head.encode() + self.image.tobytes()))
        # A spacing of 1 is one, where its unit is said.
        text = nrrd(self.image).replace(b"spacings: 0.001 0.002 0.003", b'spacings: 1 1 1\nunits: "um" "um" "um"')
        self.check(self.write("a.nrrd", text), spacing=(1e-6, 1e-6, 1e-6))

    def test_tiff_of_many_pages(self):
        for kind, words in itertools.product(("u1", "u2", "f4"), ({}, {"compression": "zlib"}, {"imagej": True})):
            tifffile.imwrite(self.path("a.tif"), self.image.astype(kind), **words)
            self.check(self.path("a.tif"), "--voxel-size", *self.spacing)

    def test_tiff_of_which_0_is_white(self):
        tifffile.imwrite(self.path("a.tif"), 255 - self.image, photometric="miniswhite")
        said, _ = self.works("voxels", self.path("a.tif"), "--voxel-size", *self.spacing)
        self.assertIn("of which 0 is white", said["image"])
        self.check(self.path("a.tif"), "--voxel-size", *self.spacing)
        tifffile.imwrite(self.path("a.tif"), self.image.astype("f4"), photometric="miniswhite")
        self.refused("voxels", "PhotometricInterpretation 0", self.path("a.tif"), "--voxel-size", *self.spacing)

    @unittest.skipUnless(importlib.util.find_spec("PIL"), "python3-pil is not there, which writes LZW")
    def test_tiff_with_lzw(self):
        from PIL import Image

        pages = [Image.fromarray(page) for page in self.image]
        pages[0].save(self.path("a.tif"), save_all=True, append_images=pages[1:], compression="tiff_lzw")
        self.check(self.path("a.tif"), "--voxel-size", *self.spacing)
        os.mkdir(self.path("slices"))
        for z, page in enumerate(pages):
            page.save(self.path(f"slices/{z}.tif"), compression="tiff_lzw")
        self.check(self.path("slices"), "--voxel-size", *self.spacing)

    def test_tiff_slices_in_a_folder_and_by_pattern(self):
        os.mkdir(self.path("slices"))
        for z, page in enumerate(np.concatenate([self.image, np.zeros((4, 10, 12), "u1")])):
            tifffile.imwrite(self.path(f"slices/s{z}.tif"), page)  # s10 comes after s9
        self.check(self.path("slices"), "--voxel-size", *self.spacing)
        self.check(self.path("slices/s*.tif"), "--voxel-size", *self.spacing)
        self.assertNotIn("WARNING", self.works("voxels", self.path("slices/s*[02468].tif"), "--size", 1)[0]["image"])
        os.remove(self.path("slices/s2.tif"))
        self.assertIn("none is numbered from 2 to 2, between s1.tif and s3.tif", self.works("voxels", self.path("slices"), "--size", 1)[0]["image"])

    def test_slices_are_in_the_order_of_their_signed_numbers_and_alone(self):
        os.mkdir(self.path("slices"))
        for z, page in enumerate(self.image):
            tifffile.imwrite(self.path(f"slices/a-1_s{z - 3 if z < 4 else f'+{z - 3}'}.tif"), page)  # s-3 s-2 s-1 s0 s+1 …
        self.check(self.path("slices"), "--voxel-size", *self.spacing)
        self.assertEqual(images.sorted_naturally(["s-10", "s-9", "s-1"]), ["s-1", "s-9", "s-10"])  # a hyphen
        self.assertIn("numbered from 0 to 0", images.gap_in(["s-2", "s-1", "s1", "s2"]))
        tifffile.imwrite(self.path("slices/preview.tif"), self.image[0])
        self.refused("voxels", "preview.tif has no number in its name", self.path("slices"), "--size", 1)

    def test_slices_that_are_numbered_downwards_may_leave_some_out_too(self):
        self.assertIn("none is numbered from 7 to 6, between b8.tif and c5.tif", images.gap_in(["a9.tif", "b8.tif", "c5.tif", "d4.tif"]))
        for whole in (["a9.tif", "b8.tif", "c7.tif"], ["a3.tif", "b2.tif", "c1.tif", "d4.tif", "e3.tif"]):  # the second begins anew
            self.assertEqual(images.gap_in(whole), "")

    def test_vtk(self):
        from vtkmodules.vtkIOImage import vtkMetaImageWriter
        from vtkmodules.vtkIOLegacy import vtkStructuredPointsWriter
        from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

        for kind in ("u1", "u2", "f4"):
            image = vtk_image(self.image.astype(kind), self.spacing)
            for mode in ("SetDataModeToAscii", "SetDataModeToBinary", "SetDataModeToAppended"):
                writer = vtkXMLImageDataWriter()
                getattr(writer, mode)()
                self.check(written(writer, self.path("a.vti"), image))
            self.check(written(vtkStructuredPointsWriter(), self.path("a.vtk"), image, SetFileType=1))
            self.check(written(vtkStructuredPointsWriter(), self.path("b.vtk"), image, SetFileType=2))
            self.check(written(vtkMetaImageWriter(), self.path("a.mha"), image))
            self.check(written(vtkMetaImageWriter(), self.path("a.mhd"), image, SetRAWFileName=self.path("a.raw")))

    def test_voxels_as_cells_of_a_vtk_image(self):
        from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

        image = vtk_image(self.image, self.spacing)
        array = image.GetPointData().GetScalars()
        image.GetPointData().Initialize()
        image.SetDimensions(13, 11, 9)
        image.GetCellData().SetScalars(array)
        self.check(written(vtkXMLImageDataWriter(), self.path("a.vti"), image))
        # Numbers at the corners, which the file does not name as those to be shown, are not taken in place of them.
        array.SetName("solid")
        corners = vtk_image(np.arange(13 * 11 * 9, dtype="f4").reshape(9, 11, 13), self.spacing).GetPointData().GetScalars()
        corners.SetName("corners")
        image.GetPointData().AddArray(corners)
        both = written(vtkXMLImageDataWriter(), self.path("a.vti"), image)
        self.check(both)
        self.check(both, "--array", "solid")


class Damaged(ToolTest):
    def setUp(self):
        super().setUp()
        self.image = box((10, 12, 14), (2, 8), (3, 9), (0, 9))

    def cut_off(self, path):
        with open(path, "rb") as file:
            whole = file.read()
        for part in (0.02, 0.3, 0.6, 0.95):
            with open(path, "wb") as file:
                file.write(whole[:int(part * len(whole))])
            self.refused("voxels", "damaged|cannot be read|not a TIFF", path, "--size", 1)

    def test_files_that_are_cut_off(self):
        from vtkmodules.vtkIOLegacy import vtkStructuredPointsWriter
        from vtkmodules.vtkIOXML import vtkXMLImageDataWriter

        tifffile.imwrite(self.path("a.tif"), self.image)
        tifffile.imwrite(self.path("z.tif"), self.image, compression="zlib")
        self.write("a.nrrd", nrrd(self.image))
        self.write("z.nrrd", nrrd(np.random.default_rng(1).integers(0, 255, self.image.shape, "u1"), "gzip"))
        image = vtk_image(self.image, (1, 1, 1))
        written(vtkStructuredPointsWriter(), self.path("a.vtk"), image, SetFileType=2)
        written(vtkXMLImageDataWriter(), self.path("a.vti"), image)
        for name in ("a.tif", "z.tif", "a.nrrd", "z.nrrd", "a.vtk", "a.vti"):
            with self.subTest(name):
                self.cut_off(self.path(name))

    def test_files_of_something_else(self):
        for ending in ("nrrd", "tif", "vti", "vtk", "mhd", "pts", "pts.gz"):
            with self.subTest(ending):
                self.refused("voxels", "empty", self.write(f"empty.{ending}", ""), "--size", 1)
                self.refused("voxels", "", self.write(f"text.{ending}", "this is no image\n"), "--size", 1)
                self.refused("voxels", "", self.write(f"bytes.{ending}", bytes(range(256)) * 9), "--size", 1)
        self.refused("voxels", "did you mean '.nrrd'", self.write("a.nrd", "x"))
        self.refused("voxels", "does not exist", self.path("none.tif"))
        self.refused("voxels", "no TIFF images", self.path("none*.tif"))
        os.mkdir(self.path("folder.pts"))
        self.refused("voxels", "no TIFF images", self.path("folder.pts"))

    def test_raw_files_of_another_size(self):
        path = self.write("a.raw", bytes(999))
        self.refused("voxels", "999 bytes, expected 1000", path, "--shape", 10, 10, 10, "--type", "uint8", "--size", 1)
        self.refused("voxels", "both --shape and --type", path, "--shape", 10, 10, 10)
        raw = ("--shape", 9, 9, 9, "--type", "uint8", "--size", 1)
        self.refused("voxels", "is there a header. --header 270", path, *raw)
        self.refused("voxels", "999 bytes, expected 739: 9 x 9 x 9 numbers of type uint8 after 10 bytes", path, *raw, "--header", 10)
        self.refused("voxels", "--header: expected bytes", path, "--header", 3, "--size", 1)

    def test_units_and_materials_that_are_none(self):
        tifffile.imwrite(self.path("a.tif"), self.image)
        path = self.path("a.tif")
        grey = self.write("a.nrrd", nrrd(self.image.astype("u1")).replace(b"endian", b'units: "mm" "parsec" "mm"\nendian'))
        self.refused("voxels", "'parsec' is not a unit of length", grey)
        self.refused("voxels", "--units: 'milimeter' is not .* .did you mean 'millimeter'", grey, "--units", "milimeter")
        for words in (("--voxel-size", 1e-3), ("--size", 1)):
            self.refused("voxels", "--units mm: no length of .*a.tif is used; --voxel-size and --size are in m", path, "--units", "mm", *words)
        self.refused("voxels", "have values in common", path, "--size", 1, "--material", "a", 0, 5, "--material", "b", 4, 9)
        self.refused("voxels", "the lower and the higher limit", path, "--size", 1, "--material", "a", 5, 1)
        self.refused("voxels", "no voxel is of the material 'a', from 5 to 9", path, "--size", 1, "--material", "a", 5, 9)
        self.refused("voxels", "does without --cells", path, "--size", 1, "--material", "a", 0, 5, "--cells", 2)

    def test_scanco_that_is_cut_off(self):
        self.write("a.aim", scanco(0x00020002, self.image.astype("<i2").tobytes(), self.image.shape, (1e-3,) * 3, False))
        self.cut_off(self.path("a.aim"))
        self.write("a.isq", isq(self.image, (1e-3,) * 3))
        self.cut_off(self.path("a.isq"))
        whole = scanco(0x00990002, self.image.astype("<i2").tobytes(), self.image.shape, (1e-3,) * 3, True)
        self.refused("voxels", "Scanco's type 0x00990002, which is not known", self.write("b.aim", whole))

    def test_slices_that_do_not_match(self):
        os.mkdir(self.path("s"))
        tifffile.imwrite(self.path("s/1.tif"), self.image[0])
        tifffile.imwrite(self.path("s/2.tif"), self.image[0][:5])
        self.refused("voxels", "2.tif has 14 x 5 x 1", self.path("s"), "--size", 1)
        tifffile.imwrite(self.path("c.tif"), np.zeros((5, 6, 3), "u1"), photometric="rgb")
        self.refused("voxels", "colors", self.path("c.tif"), "--size", 1)

    def test_points_that_are_none(self):
        for expected, text in {"not a list": "0 0 0\n1 1 x\n", "not finite": "0 0 0\n0 nan 1\n",
                               "2 numbers a line": "0 0\n1 1\n", "no points": "# nothing\n",
                               "same place": "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0\n", "one point": "1 2 3\n",
                               "changed|not a list": "0 0 0\n1 1\n"}.items():
            self.refused("voxels", expected, self.write("a.pts", text))
        grid = list(itertools.product(range(5), repeat=3))
        off = "".join(f"{x} {y + 0.3 * (i == 31)} {z}\n" for i, (x, y, z) in enumerate(grid))
        self.refused("voxels", "point 32 .*off", self.write("a.pts", off))
        scattered = "".join("{} {} {}\n".format(*p) for p in np.random.default_rng(1).random((200, 3)))
        self.refused("voxels", "not on a lattice", self.write("a.pts", scattered))
        self.refused("voxels", "", self.write("a.pts.gz", gzip.compress(b"0 0 0\n1 1 1\n" * 99)[:-12]))

    def test_images_without_solid_or_void(self):
        for value in (0, 1):
            tifffile.imwrite(self.path("a.tif"), np.full((5, 6, 7), value, "u1"))
            self.refused("voxels", f"all voxels have the value {value}", self.path("a.tif"), "--size", 1)
        tifffile.imwrite(self.path("a.tif"), np.arange(125, dtype="u1").reshape(5, 5, 5) + 5)
        self.refused("voxels", "every voxel is solid", self.path("a.tif"), "--size", 1, "--threshold", 4)
        self.refused("voxels", "every voxel is void", self.path("a.tif"), "--size", 1, "--threshold", 200)
        tifffile.imwrite(self.path("a.tif"), np.where(self.image, np.nan, 0).astype("f4"))
        self.refused("voxels", "not finite", self.path("a.tif"), "--size", 1)

    def test_what_is_read_is_never_written(self):
        def kept(tool, source, *outs, words=()):
            with open(source, "rb") as file:
                before = file.read()
            for out in (source, *outs):
                done = self.run_tool(tool, source, out, *words)
                self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
                self.assertRegex(done.stderr, "is read: expected another file to write")
                with open(source, "rb") as file:
                    self.assertEqual(file.read(), before)

        raw = self.write("a.raw", image_in_grey().tobytes())
        os.symlink("a.raw", self.path("link.g"))
        os.link(raw, self.path("hard.g"))
        shape = ("--shape", 6, 5, 4, "--type", "uint8", "--size", 1)
        kept("voxels", raw, self.path("link.g"), self.path("hard.g"), os.path.join(self.folder, ".", "a.raw"), words=shape)
        os.symlink("a.raw", self.path("slices.png"))
        self.refused("voxels", "slices.png is .*a.raw, which is read", raw, *shape, "--slices", self.path("slices.png"))
        done = self.run_tool("voxels", raw, self.path("one.png"), *shape, "--slices", self.path("one.png"))
        self.assertIn("one.png is to be both the mesh and the picture of --slices", done.stderr)
        header = self.write("a.mhd", "ObjectType = Image\nNDims = 3\nDimSize = 6 5 4\nElementType = MET_UCHAR\nElementDataFile = a.raw\n")
        kept("voxels", header, raw, words=("--size", 1))
        os.mkdir(self.path("slices"))
        tifffile.imwrite(self.path("slices/a.tif"), image_in_grey(), photometric="minisblack")
        for source in (self.path("slices"), self.path("slices/*.tif")):
            done = self.run_tool("voxels", source, self.path("slices/a.tif"), "--size", 1)
            self.assertIn("a.tif is read: expected another file", done.stderr)
        mesh = self.write("a.msh", GMSH_4)
        os.link(mesh, self.path("mesh.g"))
        kept("tetrahedra", mesh, self.path("mesh.g"))

    def test_options_that_are_wrong(self):
        tifffile.imwrite(self.path("a.tif"), self.image)
        path = self.path("a.tif")
        self.refused("voxels", "no spacing", path)
        self.refused("voxels", "did you mean '--coarsen'", path, "--coarse", 2)
        self.refused("voxels", "exclude", path, "--size", 1, "--coarsen", 2, "--refine", 2)
        self.refused("voxels", "exclude", path, "--size", 1, "--otsu", "--threshold", 2)
        self.refused("voxels", "expected 1 or 3 numbers", path, "--size", 1, 2)
        self.refused("voxels", "> 0", path, "--size", 0)
        self.refused("voxels", "both say how large", path, "--size", 1, "--voxel-size", 1e-3)
        self.refused("voxels", "both say how large", path, "--size", 1, 2, 3, "--voxel-size", 1, 2, 3)
        self.refused("voxels", "whole number", path, "--size", 1, "--coarsen", 1.5)
        self.refused("voxels", "no voxel in x", path, "--size", 1, "--crop", 0.5, 0.5, 0, 1, 0, 1)
        self.refused("voxels", "no solid voxel", path, "--size", 1, "--crop", 0.9, 1, 0, 1, 0, 1)
        self.refused("voxels", "leaves nothing", path, "--size", 1, "--spurs", "drop", "--min-neighbors", 26)
        done = self.run_tool("voxels", path, self.path("none/out.g"), "--size", 1)
        self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1))
        self.assertIn("no folder", done.stderr)


# Tetrahedra


def cube_of_tetrahedra(n):
    """The unit cube, six tetrahedra a cell, every second one inverted; and triangles of the face x = 0."""
    points = np.array(list(itertools.product(range(n + 1), repeat=3)), float) / n
    place = lambda cell: np.ravel_multi_index(cell, (n + 1,) * 3)
    tetrahedra, triangles = [], []
    for cell in itertools.product(range(n), repeat=3):
        for order in itertools.permutations(range(3)):
            corner = list(cell)
            nodes = [place(corner)]
            for axis in order:
                corner[axis] += 1
                nodes.append(place(corner))
            tetrahedra.append(nodes)
    for y, z in itertools.product(range(n), repeat=2):
        triangles.append([place((0, y, z)), place((0, y + 1, z)), place((0, y + 1, z + 1))])
        triangles.append([place((0, y, z)), place((0, y, z + 1)), place((0, y + 1, z + 1))])
    return points, np.array(tetrahedra), np.array(triangles)


# Two tetrahedra as gmsh 4 writes them: volumes 1 and 2, of the groups "strut" and "rest", and a surface "foot".
GMSH_4 = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
2 5 "foot"
3 1 "strut one"
3 2 "rest"
$EndPhysicalNames
$Entities
0 0 1 2
1 0 0 0 1 1 0 1 5 0
1 0 0 0 1 1 1 1 1 0
2 0 0 0 2 2 2 1 2 0
$EndEntities
$Nodes
1 5 1 5
3 1 0 5
1
2
3
4
5
0 0 0
1 0 0
0 1 0
0 0 1
1 1 1
$EndNodes
$Elements
3 3 1 3
2 1 2 1
1 1 2 3
3 1 4 1
2 1 2 3 4
3 2 4 1
3 2 3 4 5
$EndElements
"""


# Five nodes and a tetrahedron; line 9 is the next.
ABAQUS = """*Node
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
5, 1, 1, 1
*Element, type=C3D4
1, 1, 2, 3, 4
"""


class Tetrahedra(ToolTest):
    def setUp(self):
        super().setUp()
        self.points, self.nodes, self.triangles = cube_of_tetrahedra(3)
        self.left = self.points[self.nodes][:, :, 0].mean(axis=1) < 1 / 3
        # A node that no tetrahedron has.
        self.points = np.concatenate([self.points, [[7, 7, 7]]])

    def mesh(self, **words):
        return meshio.Mesh(self.points, [("tetra", self.nodes[self.left]), ("tetra", self.nodes[~self.left]),
                                         ("triangle", self.triangles)], **words)

    def groups(self, name):
        return {name: [np.full(self.left.sum(), 1), np.full((~self.left).sum(), 2), np.full(len(self.triangles), 7)]}

    def check(self, path, blocks, foot, scale=1e-3):
        said, mesh = self.works("tetrahedra", path, "--scale", scale)
        self.assertEqual([len(b) for b in mesh.blocks.values()], [54, 108])
        self.assertEqual(list(mesh.blocks), blocks)
        self.assertEqual(len(mesh.nodes), 64)
        volumes = [volume for nodes in mesh.blocks.values() for volume in tetrahedra_volumes(mesh.nodes, nodes)]
        np.testing.assert_allclose(volumes, scale**3 / 27 / 6, rtol=1e-9)  # none inverted; text of 16 digits
        self.assertIn("81 tetrahedra", said["turned"])
        self.assertEqual(list(mesh.sets), [foot])
        self.assertEqual(len(mesh.sets[foot]), 16)
        np.testing.assert_array_equal(mesh.nodes[mesh.sets[foot], 0], 0)

    def test_gmsh_2(self):
        mesh = self.mesh(cell_data={**self.groups("gmsh:physical"), **self.groups("gmsh:geometrical")},
                         field_data={"left part": np.array([1, 3]), "foot": np.array([7, 2])})
        mesh.write(self.path("a.msh"), file_format="gmsh22")
        self.check(self.path("a.msh"), ["left_part", "block_2"], "foot")

    def test_gmsh_4(self):
        _, mesh = self.works("tetrahedra", self.write("a.msh", GMSH_4))
        self.assertEqual(list(mesh.blocks), ["strut_one", "rest"])
        np.testing.assert_array_equal(mesh.sets["foot"], [0, 1, 2])
        np.testing.assert_allclose(tetrahedra_volumes(mesh.nodes, mesh.blocks["rest"]), 1 / 3)

    def test_elements_in_two_groups_of_gmsh(self):
        """"foot" is two surfaces, of which one is also "side"; the second volume is also in "all"."""
        text = GMSH_4.replace("3\n2 5", "5\n2 4 \"side\"\n3 3 \"all\"\n2 5").replace("0 0 1 2\n", "0 0 2 2\n9 0 0 0 1 1 0 2 4 5 0\n")
        text = text.replace("1 1 1 1 1 0", "1 1 1 2 3 1 0").replace("2 2 2 1 2 0", "2 2 2 2 3 2 0")
        text = text.replace("3 3 1 3\n", "4 4 1 4\n2 9 2 1\n4 1 2 4\n")
        said, mesh = self.works("tetrahedra", self.write("a.msh", text))
        self.assertEqual({name: len(nodes) for name, nodes in mesh.blocks.items()}, {"strut_one": 1, "rest": 1})
        self.assertIn("block   all: all its tetrahedra are in other groups", said["no"])
        np.testing.assert_array_equal(mesh.sets["side"], [0, 1, 3])
        np.testing.assert_array_equal(mesh.sets["foot"], [0, 1, 2, 3])

    def test_groups_of_gmsh_that_meshio_passes_over(self):
        for old, new, told in (("2 2 2 1 2 0", "2 2 2 2 2 9 0", "volume 2 is also in the physical group 9"),
                               ("1 1 0 1 5 0", "1 1 0 2 5 8 0", "surface 1 is also in the physical group 8")):
            self.refused("tetrahedra", told + ".*expected format 4.1", self.write("a.msh", GMSH_4.replace(old, new)))
        old = GMSH_4.replace("4.1 0 8", "4.0 0 8").replace("1 1 1 1 1 0", "1 1 1 2 1 2 0")
        self.refused("tetrahedra", "volume 1 is also in the physical group 2", self.write("a.msh", old))

    def test_numbers_of_other_names_are_told_and_may_be_chosen(self):
        self.mesh(cell_data=self.groups("material")).write(self.path("a.vtu"))
        said, mesh = self.works("tetrahedra", self.path("a.vtu"))
        self.assertEqual(list(mesh.blocks), ["body"])
        self.assertIn("cell data 'material' (3 values); --groups material", said["not"])
        _, mesh = self.works("tetrahedra", self.path("a.vtu"), "--groups", "material")
        self.assertEqual(list(mesh.blocks), ["block_1", "block_2"])
        self.refused("tetrahedra", "no cell data 'materials' .did you mean 'material'", self.path("a.vtu"), "--groups", "materials")

    def test_formats_with_numbers(self):
        for name, key in {"a.vtu": "CellEntityIds", "a.vtk": "CellEntityIds", "a.mesh": "medit:ref"}.items():
            with self.subTest(name):
                self.mesh(cell_data=self.groups(key)).write(self.path(name))
                self.check(self.path(name), ["block_1", "block_2"], "set_7")

    def test_groups_that_would_get_one_name_are_refused(self):
        def refused(told, numbers, **field_data):
            data = [np.full(54, numbers[0]), np.full(108, numbers[1]), np.full(18, 7)]
            self.mesh(cell_data={"gmsh:physical": data, "gmsh:geometrical": data}, field_data={
                name: np.array(group) for name, group in field_data.items()}).write(self.path("a.msh"), file_format="gmsh22")
            self.refused("tetrahedra", told, self.path("a.msh"))

        refused("group 'größe' and group 'grüße' would both be 'gr_e'", (1, 2), **{"größe": (1, 3), "grüße": (2, 3)})
        refused("group 'block_2' and group 2 would both be 'block_2'", (1, 2), **{"block_2": (1, 3)})
        refused("group 'body' and what has no group would both be 'body'", (1, 0), body=(1, 3))
        self.works("tetrahedra", self.path("a.msh"), "--block-names", "one", "other")
        self.mesh(point_sets={"steel 1": np.arange(3), "steel_1": np.arange(4)}).write(self.path("a.inp"))
        self.refused("tetrahedra", "group 'steel 1' and group 'steel_1' would both be 'steel_1'", self.path("a.inp"))

    def test_a_mesh_that_cannot_be_written_costs_no_other(self):
        self.mesh().write(self.path("a.vtu"))
        self.works("tetrahedra", self.path("a.vtu"))
        with open(self.path("out.g"), "rb") as file:
            kept = file.read()
        done = subprocess.run(["bash", "-c", 'ulimit -f 4; "$0" "$@"', os.path.join(ROOT, "tools/tetrahedra"), self.path("a.vtu"),
                               self.path("out.g")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("out.g cannot be written", done.stderr)
        with open(self.path("out.g"), "rb") as file:
            self.assertEqual(file.read(), kept)
        self.assertEqual([name for name in os.listdir(self.folder) if name.endswith(".part")], [])
        self.write("out.g.part", "of the user")
        self.works("tetrahedra", self.path("a.vtu"))
        with open(self.path("out.g.part")) as file:
            self.assertEqual(file.read(), "of the user")

    def test_med(self):
        tags = np.where(self.left, -1, -2)
        mesh = meshio.Mesh(self.points, [("tetra", self.nodes), ("triangle", self.triangles)],
                           cell_data={"cell_tags": [tags, np.full(len(self.triangles), -7)]})
        mesh.cell_tags = {-1: ["left"], -2: ["right"], -7: ["foot"]}
        mesh.write(self.path("a.med"))
        self.check(self.path("a.med"), ["left", "right"], "foot")

    def test_abaqus(self):
        none = np.array([], int)
        self.mesh(cell_sets={"LEFT": [np.arange(54), none, none], "ALL": [np.arange(54), np.arange(108), none]},
                  point_sets={"FOOT": np.unique(self.triangles)}).write(self.path("a.inp"))
        with open(self.path("a.inp")) as file:  # meshio writes a set once for each of its blocks, and reads the last
            head, *parts = file.read().split("*ELSET, ELSET=ALL\n")
        self.write("a.inp", head + "*ELSET, ELSET=ALL\n" + "".join(parts))
        self.check(self.path("a.inp"), ["LEFT", "ALL"], "FOOT")

    def test_sets_of_abaqus_before_later_elements(self):
        _, mesh = self.works("tetrahedra", self.write("a.inp", f"{ABAQUS}*Elset, elset=A\n1\n*Element, type=C3D4\n2, 2, 5, 3, 4\n"
                                                      "*Elset, elset=B\n2\n*Nset, nset=TOP, generate\n1, 3, 1\n"))
        self.assertEqual([(name, len(nodes)) for name, nodes in mesh.blocks.items()], [("A", 1), ("B", 1)])
        np.testing.assert_array_equal(mesh.sets["TOP"], [0, 1, 2])

    def test_what_meshio_reads_otherwise_than_abaqus_is_refused(self):
        def refused(told, text):
            self.refused("tetrahedra", told, self.write("a.inp", text))

        refused("line 9: a second .NODE, the first is in line 1: .*flat input", ABAQUS + "*node\n1, 0, 0, 0\n")
        refused("line 10: a second .PART, the first is in line 1", f"*Part, name=A\n{ABAQUS}*Part, name=B\n")
        refused("INSTANCE moves its part by '0., 0., 5.'", f"{ABAQUS}*Instance, name=A-1, part=A\n0., 0., 5.\n")
        refused("line 1: .INCLUDE", "*Include, input=nodes.inp\n" + ABAQUS)
        refused("SYSTEM=C; expected Cartesian", ABAQUS.replace("*Node", "*Node, system=C"))
        refused("line 11: .NSET BOT is also in line 9", ABAQUS + "*Nset, nset=bot\n1\n*Nset, nset=BOT\n2\n")
        refused("NSET GRIP is not made of numbers", ABAQUS + "*Nset, nset=A\n1\n*Nset, nset=GRIP\nA\n")
        refused("NSET ALL is not made of numbers", ABAQUS + "*Nset, nset=ALL, elset=A\n")
        refused("ELSET GLUED is not made of numbers", ABAQUS + "*Elset, elset=GLUED\nA, B\n")
        more = "*Element, type=C3D4, elset=A\n2, 2, 5, 3, 4\n"
        refused("line 9: .ELEMENT with ELSET=A, and in line 7 one without", ABAQUS + more)
        refused("ELSET=a, which is also in line 7", ABAQUS.replace("C3D4", "C3D4, elset=A") + more.replace("=A", "=a"))
        refused("ends .ELEMENT at the comment in line 9, and line 10 would", f"{ABAQUS}** the second\n2, 2, 5, 3, 4\n")

    def test_what_meshio_reads_otherwise_than_nastran_is_refused(self):
        def lines(kind, *last):
            return "BEGIN BULK\n" + "".join(kind.format(n, *node) for n, node in enumerate(
                [(0, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (*last, 0, 0, 1)], 1)) + "CTETRA,1,1,1,2,3,4\nENDDATA\n"

        wide = "GRID*   {:<16}{:<16}{:<16.1f}{:<16.1f}*A\n*A      {:<16.1f}\n"
        for kind in ("GRID,{},{},{}.,{}.,{}.\n", "GRID    {:<8}{:<8}{:<8.1f}{:<8.1f}{:<8.1f}\n"):
            _, mesh = self.works("tetrahedra", self.write("a.bdf", lines(kind, 0)))
            self.assertEqual(len(mesh.nodes), 4)
            self.refused("tetrahedra", "line 5: GRID in the coordinate system 5, .*; expected the basic one",
                         self.write("a.bdf", lines(kind, 5)))
        self.refused("tetrahedra", "GRID. in the coordinate system 5", self.write("a.nas", lines(wide, 5)))
        self.refused("tetrahedra", "line 1: GRDSET in the coordinate system 3", self.write("a.fem", "GRDSET,,3\n" + lines(kind, 0)))
        self.refused("tetrahedra", "line 1: INCLUDE", self.write("a.bdf", "include 'nodes.bdf'\n" + lines(kind, 0)))

    def test_names_of_blocks_are_given(self):
        self.mesh(cell_data=self.groups("medit:ref")).write(self.path("a.mesh"))
        _, mesh = self.works("tetrahedra", self.path("a.mesh"), "--block-names", "strut", "rest")
        self.assertEqual(list(mesh.blocks), ["strut", "rest"])
        self.refused("tetrahedra", "expected 2 different names", self.path("a.mesh"), "--block-names", "one")

    def test_wrong_meshes(self):
        meshio.Mesh(self.points, [("triangle", self.triangles)]).write(self.path("a.vtu"))
        self.refused("tetrahedra", "no tetrahedra; it has 18 triangle", self.path("a.vtu"))
        flat = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]])
        meshio.Mesh(flat, [("tetra", [[0, 1, 2, 3]])]).write(self.path("a.vtk"))
        self.refused("tetrahedra", "1 tetrahedra have no volume", self.path("a.vtk"))
        twice = np.concatenate([self.nodes, self.nodes[5:6, [1, 2, 0, 3]]])  # as gmsh writes what is in two groups
        meshio.Mesh(self.points, [("tetra", twice)]).write(self.path("a.vtu"))
        self.refused("tetrahedra", "number 6 and 163 are at one place", self.path("a.vtu"))
        self.refused("tetrahedra", "does not exist", self.path("none.msh"))
        self.refused("tetrahedra", "folder", self.folder)
        self.refused("tetrahedra", "did you mean", self.write("a.vtux", "x"))
        for ending in ("msh", "vtu", "inp", "vtk", "mesh"):
            with self.subTest(ending):
                self.refused("tetrahedra", "empty", self.write(f"e.{ending}", ""))
                self.refused("tetrahedra", "", self.write(f"t.{ending}", "this is no mesh\n"))
                self.refused("tetrahedra", "", self.write(f"b.{ending}", bytes(range(256)) * 9))
        self.refused("tetrahedra", "", self.write("cut.msh", GMSH_4[:len(GMSH_4) * 2 // 3]))


def tetrahedra_volumes(points, nodes):
    a, b, c = (points[nodes[:, k]] - points[nodes[:, 0]] for k in (1, 2, 3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)) / 6


if __name__ == "__main__":
    unittest.main(verbosity=2)
