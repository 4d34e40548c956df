#!/usr/bin/python3
"""tools/voxels of closed surfaces (STL) and of NumPy's arrays: known volumes, the wanted density, and what is refused."""
import importlib.util
import math
import re
import sys

from tool_test import InFolder

if importlib.util.find_spec("vtkmodules") is None or importlib.util.find_spec("scipy") is None:
    print("skipped: VTK or SciPy is not installed")
    sys.exit(77)

import unittest  # noqa: E402

import numpy as np  # noqa: E402
import scipy.ndimage  # noqa: E402, F401  with VTK: here rather than in each run of the tool
import vtkmodules.vtkFiltersCore  # noqa: E402, F401


def sphere(path, radius, open_cap=False):
    from vtkmodules.vtkFiltersSources import vtkSphereSource
    from vtkmodules.vtkIOGeometry import vtkSTLWriter

    source, writer = vtkSphereSource(), vtkSTLWriter()
    source.SetRadius(radius), source.SetCenter(3e-3, -1e-3, 7e-3)
    source.SetThetaResolution(120), source.SetPhiResolution(120)
    if open_cap:
        source.SetEndPhi(160)
    writer.SetInputConnection(source.GetOutputPort())
    writer.SetFileName(str(path)), writer.Write()


def bricks(path, *bounds, cavities=()):
    """Bricks from x0 x1 y0 y1 z0 z1 (m), those of these numbers turned inside out."""
    from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkReverseSense, vtkTriangleFilter
    from vtkmodules.vtkFiltersSources import vtkCubeSource
    from vtkmodules.vtkIOGeometry import vtkSTLWriter

    all_of_them, triangles, writer = vtkAppendPolyData(), vtkTriangleFilter(), vtkSTLWriter()
    for number, box in enumerate(bounds):
        brick, turned = vtkCubeSource(), vtkReverseSense()
        brick.SetBounds(*box)
        turned.SetInputConnection(brick.GetOutputPort())
        all_of_them.AddInputConnection((turned if number in cavities else brick).GetOutputPort())
    triangles.SetInputConnection(all_of_them.GetOutputPort())
    writer.SetInputConnection(triangles.GetOutputPort())
    writer.SetFileName(str(path)), writer.Write()


class Surfaces(InFolder):
    def works(self, *words):
        done = self.run_tool("voxels", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def volume_of(self, printed):
        return float(re.search(r"volume ([0-9.e+-]+) m\^3", printed)[1])

    def test_a_sphere_has_its_volume(self):
        sphere(self.folder / "sphere.stl", 1e-3)
        printed = self.works("sphere.stl", "out.g", "--voxel-size", 1e-4, "--cells", 2, "--grey")
        # The polyhedron of 120 x 120 lacks 0.12 %; planes across voxels of a tenth of the radius are off by the square of half a
        # voxel over the radius, 0.25 %.
        self.assertAlmostEqual(self.volume_of(printed) / (4 / 3 * math.pi * 1e-9), 1, delta=4e-3)
        self.assertIn("closed surface of", printed)

    def test_the_surface_moves_for_the_wanted_density(self):
        sphere(self.folder / "sphere.stl", 1e-3)
        printed = self.works("sphere.stl", "out.g", "--voxel-size", 1e-4, "--cells", 2, "--grey", "--density", 0.3)
        self.assertAlmostEqual(self.volume_of(printed) / (0.3 * 8e-9), 1, delta=1e-3)
        moved = float(re.search(r"moved outward by ([0-9.e+-]+) m", printed)[1])
        self.assertAlmostEqual(1e-3 + moved, (0.3 * 8e-9 * 3 / 4 / math.pi) ** (1 / 3), delta=5e-6)  # a 20th of a voxel
        printed = self.works("sphere.stl", "whole.g", "--voxel-size", 1e-4, "--density", 0.3)
        self.assertAlmostEqual(float(re.search(r"density +([0-9.]+) %", printed)[1]), 30, delta=0.03)

    def test_bodies_that_overlap_are_their_union_and_cavities_are_void(self):
        across, along = (0, 8e-3, 2e-3, 4e-3, 2e-3, 4e-3), (3e-3, 5e-3, 0, 8e-3, 2e-3, 4e-3)
        bricks(self.folder / "cross.stl", across, along)
        printed = self.works("cross.stl", "out.g", "--voxel-size", 5e-4)
        self.assertIn(f"{4 * 4 * (16 + 16 - 4)}, each", printed)  # voxels of edges that divide all lengths
        self.assertIn(f"bodies overlap in {4 * 4 * 4} voxels, which are solid", printed)
        self.assertIn("expected the union", self.run_tool("voxels", "cross.stl", "out.g", "--voxel-size", 5e-4, "--density", 0.3).stderr)
        whole, hole, core = ((a, b) * 3 for a, b in ((0, 8e-3), (1e-3, 7e-3), (3e-3, 5e-3)))
        bricks(self.folder / "core.stl", whole, hole, core, cavities=[1])
        printed = self.works("core.stl", "out.g", "--voxel-size", 1e-3, "--pieces", 0)
        self.assertIn(f"{8**3 - 6**3 + 2**3}, each", printed)

    def test_middles_on_a_triangle_inside_are_solid(self):
        """Voxels of 1 m, whose middles lie on faces of the second body: a float has such numbers exactly."""
        whole, inner = (0, 8) * 3, (2, 6, 2.5, 5.5, 2.5, 5.5)
        bricks(self.folder / "inner.stl", whole, inner)
        self.assertIn(f"{8**3}, each", self.works("inner.stl", "out.g", "--voxel-size", 1))
        # Two that touch at the middles of a layer: its voxels are no gap between them.
        bricks(self.folder / "touch.stl", (0, 4.5, 0, 8, 0, 8), (4.5, 8, 1, 7, 1, 7))
        self.assertIn(f"{4 * 8 * 8 + 4 * 6 * 6}, each", self.works("touch.stl", "out.g", "--voxel-size", 1))

    def test_a_separate_body_may_be_wound_the_other_way(self):
        whole, apart, hole = (0, 8e-3) * 3, (10e-3, 14e-3) * 3, (11e-3, 13e-3) * 3
        bricks(self.folder / "apart.stl", whole, apart, cavities=[1])
        words = ("out.g", "--voxel-size", 1e-3, "--pieces", 0)
        printed = self.works("apart.stl", *words)
        self.assertIn(f"{8**3 + 4**3}, each", printed)
        self.assertIn("volume 5.76e-07 m3 (+0.00 % in voxels); 1 wound the other way and outside the rest, taken as a body", printed)
        bricks(self.folder / "hollow.stl", whole, apart, hole, cavities=[1])  # its cavity is wound the other way, too
        self.assertIn(f"{8**3 + 4**3 - 2**3}, each", self.works("hollow.stl", *words))
        bricks(self.folder / "out.stl", whole, (6e-3, 10e-3, 2e-3, 6e-3, 2e-3, 6e-3), cavities=[1])
        self.assertIn("only 50 % of it is in a body; expected a cavity inside", self.run_tool("voxels", "out.stl", *words).stderr)

    def test_the_volume_does_not_depend_on_how_triangles_are_wound(self):
        corners = np.array([(x, y, z) for z in (0, 2e-3) for y in (0, 3e-3) for x in (0, 4e-3)])
        faces = ((0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5))
        text = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex {:g} {:g} {:g}\n".format(*corners[c]) for c in
                       (face if number < 6 else face[::-1])) + "endloop\nendfacet\n" for number, face in enumerate(faces))
        (self.folder / "mixed.stl").write_text(f"solid x\n{text}endsolid x\n")
        self.assertIn("volume 2.4e-08 m3 (+0.00 % in voxels)", self.works("mixed.stl", "out.g", "--voxel-size", 1e-3))
        # Of 4 x 3 x 2 voxels of 1.3 mm all have their middles inside.
        self.assertIn(f"({100 * (4 * 3 * 2 * 1.3**3 / 24 - 1):+.2f} % in voxels)", self.works("mixed.stl", "out.g", "--voxel-size", 1.3e-3))

    def test_a_block_may_fill_its_box(self):
        bricks(self.folder / "block.stl", (0, 4e-3, 0, 3e-3, 0, 2e-3))
        self.assertIn(f"{8 * 6 * 4}, each", self.works("block.stl", "out.g", "--voxel-size", 5e-4))

    def test_a_block_that_fills_its_box_is_whole_in_grey(self):
        bricks(self.folder / "block.stl", (0, 4e-3, 0, 3e-3, 0, 2e-3))
        done = self.run_tool("voxels", "block.stl", "out.g", "--voxel-size", 5e-4, "--cells", 2, "--grey")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertAlmostEqual(self.volume_of(done.stdout) / 24e-9, 1, 5)

    def test_lengths_of_the_file_have_a_unit(self):
        sphere(self.folder / "sphere.stl", 1.0)
        printed = self.works("sphere.stl", "out.g", "--voxel-size", 1e-4, "--units", "mm")
        self.assertIn("20 x 20 x 20 voxels of 0.0001 x 0.0001 x 0.0001 m", printed)

    def test_open_surfaces_and_missing_sizes_are_refused(self):
        sphere(self.folder / "open.stl", 1e-3, open_cap=True)
        done = self.run_tool("voxels", "open.stl", "out.g", "--voxel-size", 1e-4)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("not closed: 120 edges", done.stderr)
        sphere(self.folder / "sphere.stl", 1e-3)
        self.assertIn("needs --voxel-size", self.run_tool("voxels", "sphere.stl", "out.g").stderr)
        (self.folder / "text.stl").write_text("nothing of the kind\n")
        self.assertNotEqual(self.run_tool("voxels", "text.stl", "out.g", "--voxel-size", 1).returncode, 0)


class Arrays(InFolder):
    def test_an_array_is_the_image_that_its_numbers_are(self):
        values = np.random.default_rng(1).integers(0, 255, (6, 5, 4)).astype(np.uint8)
        np.save(self.folder / "a.npy", values.transpose())
        values.tofile(self.folder / "a.raw")
        words = ["--voxel-size", 1e-3, "--threshold", 50]
        by_numpy = self.run_tool("voxels", "a.npy", "a.g", *words)
        self.assertEqual(by_numpy.returncode, 0, by_numpy.stderr)
        raw = self.run_tool("voxels", "a.raw", "b.g", *words, "--shape", 4, 5, 6, "--type", "uint8")
        self.assertEqual(by_numpy.stdout.splitlines()[1:-1], raw.stdout.splitlines()[1:-1])
        np.save(self.folder / "bool.npy", values.transpose() > 50)
        done = self.run_tool("voxels", "bool.npy", "c.g", "--voxel-size", 1e-3)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_grey_needs_void_or_its_level(self):
        values = np.random.default_rng(1).integers(100, 255, (6, 5, 4)).astype(np.uint8)
        values[:3] = 0
        np.save(self.folder / "a.npy", values)
        words = ("a.npy", "a.g", "--voxel-size", 1e-3, "--threshold", 50, "--crop", 0.5, 1, 0, 1, 0, 1, "--cells", 2, "--grey")
        done = self.run_tool("voxels", *words)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("nothing tells the level of void; expected --grey VOID SOLID, or a larger --crop", done.stderr)
        done = self.run_tool("voxels", *words, 0, 100)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_other_arrays_are_refused(self):
        np.save(self.folder / "flat.npy", np.ones((3, 4)))
        done = self.run_tool("voxels", "flat.npy", "out.g", "--voxel-size", 1)
        self.assertIn("expected three axes: x, y, z", done.stderr)
        (self.folder / "broken.npy").write_bytes(b"\x93NUMPY\x01\x00")
        self.assertIn("cannot be read as NumPy's", self.run_tool("voxels", "broken.npy", "out.g", "--voxel-size", 1).stderr)


if __name__ == "__main__":
    unittest.main()
