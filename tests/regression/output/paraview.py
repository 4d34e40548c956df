#!/usr/bin/python3
"""Results as ParaView opens them: its reader draws points where they have moved to, and joins vectors and tensors.

    paraview.py STRUT STRUT_MESH

The reader is VTK's vtkExodusIIReader with its defaults. Where pvbatch is installed, ParaView's own choice of a reader is asked
as well, off screen: Debian has no packages of both ParaView's and VTK's Python that can be installed side by side. Either
has VTK's modules, and so either will do here and for the tools.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import netCDF4
    import numpy as np
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-netcdf4, and python3-vtk9 or python3-paraview)")
    sys.exit(77)

STRUT, MESH = sys.argv[1:3]
RECIPE = "shape = box\nsize = 4e-3 4e-3 6e-3\nspacing = 1e-3\n"

# A script for pvbatch: prints the positions that it draws at the last time.
ASK_PARAVIEW = """
import sys
from paraview.simple import OpenDataFile, servermanager, MergeBlocks, PythonCalculator
reader = OpenDataFile(sys.argv[1])
merged = MergeBlocks(reader)
merged.UpdatePipeline(float(sys.argv[2]))
data = servermanager.Fetch(merged)
print("points", *[x for i in range(data.GetNumberOfPoints()) for x in data.GetPoint(i)])
stress = data.GetCellData().GetArray("Cauchy_Stress")
if stress:
    print("stress", *stress.GetTuple(7))
    rows = ", ".join("Deformation_Gradient" + c for c in "XYZ")
    joined = PythonCalculator(merged, ArrayAssociation="Cell Data", ArrayName="F", Expression="numpy.hstack([" + rows + "])")
    joined.UpdatePipeline(float(sys.argv[2]))
    print("gradient", *servermanager.Fetch(joined).GetCellData().GetArray("F").GetTuple(7))
"""


def key(name, value):
    return f'<Parameter name="{name}" type="string" value="{value}"/>\n'


def section(name, *content):
    return f'<ParameterList name="{name}">\n{"".join(content)}</ParameterList>\n'


def along(name, kind, axis, value, node_set="all"):
    return section(name, key("Type", kind), key("Node Set", node_set), key("Coordinate", axis), key("Value", value))


def deck(points="Elements", conditions=along("stretch", "Initial Velocity", "z", "2e4*z"), solver="", final="2e-6",
         variables=("Displacement", "Coordinate_X", "Coordinate_Y", "Coordinate_Z", "Cauchy_Stress", "Deformation_Gradient")):
    return section(
        "deck", section("Discretization", key("Type", "Exodus"), key("Input Mesh File", "bar.g"), key("Points", points)),
        section("Materials", section("copper", key("Material Model", "Elastic Correspondence"), key("Density", "8930"),
                                     key("Young's Modulus", "117e9"), key("Poisson's Ratio", "0.35"))),
        section("Blocks", section("bar", key("Block Names", "all"), key("Material", "copper"), key("Horizon Factor", "2.01"))),
        section("Node Sets", key("low", "z &lt; 1e-3"), key("high", "z &gt; 5e-3")),
        section("Boundary Conditions", conditions), section("Solver", key("Final Time", final), solver),
        section("Output", key("Output Filename", "result.e"), key("Output Interval", final),
                section("Output Variables", *[key(name, "true") for name in variables])))


class ParaView(unittest.TestCase):
    def setUp(self):
        self.keep = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.keep.name)
        (self.folder / "bar.recipe").write_text(RECIPE)
        subprocess.run([MESH, "bar.recipe", "bar.g"], cwd=self.folder, check=True, capture_output=True)

    def tearDown(self):
        self.keep.cleanup()

    def run_deck(self, text):
        (self.folder / "deck.xml").write_text(text)
        done = subprocess.run([STRUT, "deck.xml"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.file = netCDF4.Dataset(self.folder / "result.e")
        self.file.set_auto_mask(False)
        self.names = [row.tobytes().split(b"\0")[0].decode() for row in self.file["name_nod_var"][:]] \
            if "name_nod_var" in self.file.variables else []

    def reference(self):
        return np.stack([self.file["coord" + c][:] for c in "xyz"], axis=1)

    def moved(self):
        """The current places at the last time, which strut writes besides."""
        return np.stack([self.file[f"vals_nod_var{self.names.index('Coordinate_' + c) + 1}"][-1] for c in "XYZ"], axis=1)

    def opened(self):
        """The grid that VTK's reader makes by default, at the last time, all variables loaded."""
        reader = vtk.vtkExodusIIReader()
        reader.SetFileName(str(self.folder / "result.e"))
        reader.UpdateInformation()
        for kind in (reader.NODAL, reader.ELEM_BLOCK):
            for i in range(reader.GetNumberOfObjectArrays(kind)):
                reader.SetObjectArrayStatus(kind, reader.GetObjectArrayName(kind, i), 1)
        reader.UpdateTimeStep(self.file["time_whole"][-1])
        return reader.GetOutput().GetBlock(0).GetBlock(0)

    def check_drawn(self, expected):
        # Readers hand places on in single or double precision: 6e-8 of 6 mm; displacements are 2 % of that and more.
        near = {"rtol": 0, "atol": 1e-9}
        np.testing.assert_allclose(vtk_to_numpy(self.opened().GetPoints().GetData()), expected, **near)
        pvbatch = os.environ.get("STRUT_PVBATCH") or shutil.which("pvbatch")
        if not pvbatch:
            return
        script = self.folder / "ask.py"
        script.write_text(ASK_PARAVIEW)
        told = subprocess.run([pvbatch, script, self.folder / "result.e", str(self.file["time_whole"][-1])],
                              capture_output=True, text=True)
        arrays = {words[0]: np.array(words[1:], float) for words in map(str.split, told.stdout.splitlines())
                  if words and words[0] in ("points", "stress", "gradient")}
        if "No module named 'paraview'" in told.stderr:
            self.skipTest("pvbatch has no Python of its own (Debian: python3-paraview), so ParaView is not asked")
        self.assertIn("points", arrays, told.stdout + told.stderr)
        drawn = arrays["points"].reshape(-1, 3)
        # Sorted by place: ParaView may number points anew.
        order = [np.lexsort(np.rint(places / 1e-7).T) for places in (drawn, expected)]
        np.testing.assert_allclose(drawn[order[0]], expected[order[1]], **near)
        if "stress" in arrays:  # of the eighth point, in the order of VTK's tensors; single precision is enough
            np.testing.assert_allclose(arrays["stress"], self.eighth("Cauchy_Stress", "XX YY ZZ XY YZ ZX"), rtol=1e-6)
            np.testing.assert_allclose(arrays["gradient"], self.eighth("Deformation_Gradient", "XX XY XZ YX YY YZ ZX ZY ZZ"),
                                       rtol=1e-6)

    def eighth(self, name, components):
        """The value of the eighth element at the last time, as in the file."""
        names = [row.tobytes().split(b"\0")[0].decode() for row in self.file["name_elem_var"][:]]
        return [self.file[f"vals_elem_var{names.index(name + c) + 1}eb1"][-1][7] for c in components.split()]

    def test_points_at_elements_are_drawn_where_they_have_moved_to(self):
        self.run_deck(deck())
        self.assertGreater(np.abs(self.moved() - self.reference()).max(), 1e-4)
        self.check_drawn(self.moved())

    def test_points_at_nodes_are_drawn_where_they_have_moved_to(self):
        self.run_deck(deck("Nodes"))
        self.check_drawn(self.moved())

    def test_equilibria_are_drawn_where_they_have_moved_to(self):
        pulled = along("low", "Prescribed Displacement", "xyz", "0", "low") + \
            along("high", "Prescribed Displacement", "z", "1e-4*t", "high")
        self.run_deck(deck("Elements", pulled, section("QuasiStatic", key("Number of Load Steps", "1")), "1"))
        self.check_drawn(self.moved())

    def test_rows_of_the_deformation_gradient_are_vectors(self):
        self.run_deck(deck())
        for row in "XYZ":
            drawn = self.opened().GetCellData().GetArray("Deformation_Gradient" + row)
            self.assertEqual(drawn.GetNumberOfComponents(), 3)
            np.testing.assert_allclose(drawn.GetTuple(7), self.eighth("Deformation_Gradient" + row, "X Y Z"), rtol=1e-6)

    def test_without_displacements_points_are_drawn_where_they_were(self):
        self.run_deck(deck(variables=["Velocity"]))
        self.check_drawn(self.reference())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
