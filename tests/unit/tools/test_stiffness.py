#!/usr/bin/python3
"""tools/stiffness, run as a user runs it: on a homogeneous block, on a laminate and on a cubic lattice of struts, which are
known in closed form."""
import csv
import os
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as tree

from tool_test import TOOLS, InFolder

import netCDF4
import numpy as np
from decks import Deck, section
from exodus import write_mesh
from stiffness_parts import faces, loads, show, tensors


def isotropic(young_modulus, ratio):
    la = young_modulus * ratio / ((1 + ratio) * (1 - 2 * ratio))
    mu = young_modulus / (2 * (1 + ratio))
    C = np.diag([2 * mu] * 3 + [mu] * 3)
    C[:3, :3] += la
    return C


def deck(mesh, materials, formulation="Correspondence"):
    """materials: block -> E, nu."""
    laws = {block: {"Material Model": "Elastic Correspondence", "Density": 1000, "Formulation": formulation, "Young's Modulus": E,
                    "Poisson's Ratio": nu} for block, (E, nu) in materials.items()}
    blocks = {block: {"Block Names": block, "Material": block, "Horizon Factor": 1.75} for block in materials}
    return tree.tostring(section("deck", {"Discretization": {"Type": "Exodus", "Input Mesh File": mesh}, "Materials": laws,
                                          "Blocks": blocks}), "unicode")


class Samples(InFolder):
    def stiffness(self, *words):
        return self.run_tool("stiffness", *words)

    def tensors_of(self, name, *words):
        done = self.stiffness(f"{name}.xml", name, *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        with open(self.folder / name / "stiffness.csv", newline="") as file:
            rows = list(csv.reader(file))[1:]
        self.assertGreater((self.folder / name / "stiffness.png").stat().st_size, 20000)
        return {kind: np.array([[float(x) for x in row[2:]] for row in rows if row[0] == kind])
                for kind in dict.fromkeys(row[0] for row in rows)}

    def test_numbers_of_the_table_stand_apart(self):
        C = isotropic(2e9, 0.3)
        C[0, 3:] = -0.1435e9, -0.7019e6, -7.019e4
        row = show.text_of("mixed", C, 0).splitlines()[2]
        self.assertEqual(row.split()[4:], ["-0.1435", "-0.0007019", "-7.019e-05"])

    @unittest.skipUnless("STRUT" in os.environ, "STRUT names no program")
    def test_a_homogeneous_block_has_the_stiffness_of_its_material(self):
        (self.folder / "block.recipe").write_text("name = block\nshape = box\nsize = 3e-3 4e-3 4e-3\nspacing = 0.5e-3\n")
        (self.folder / "block.xml").write_text(deck("block.g", {"block": (117e9, 0.35)}))
        # All points whose neighbors' families are cut by a face are held. Strains are 1e-5, and so are terms of second order.
        for kind, C in self.tensors_of("block", "--layers", 2).items():
            np.testing.assert_allclose(C, isotropic(117e9, 0.35), rtol=2e-5, atol=2e-5 * 117e9, err_msg=kind)

    @unittest.skipUnless("STRUT" in os.environ, "STRUT names no program")
    def test_an_elastomer_has_the_stiffness_of_fast_loading_however_fast_it_relaxes(self):
        (self.folder / "rubber.recipe").write_text("name = rubber\nshape = box\nsize = 5e-3 5e-3 5e-3\nspacing = 1e-3\n")
        elastic = '<Parameter name="Poisson\'s Ratio" type="string" value="0.4" />'
        plain = deck("rubber.g", {"rubber": (2.8e6, 0.4)}, "Correspondence")
        relaxing = tree.tostring(section("Relaxation", {"Fractions": 0.5, "Times": 1e-6}), "unicode")
        self.assertIn(elastic, plain)
        (self.folder / "rubber.xml").write_text(plain.replace("Elastic Correspondence", "Hyperelastic").replace(elastic, elastic + relaxing))
        done = self.stiffness("rubber.xml", "out", "--layers", 2, "--boundaries", "kinematic")
        self.assertIn("stiffness of fast loading: Relaxation is left out\n", done.stdout)
        with open(self.folder / "out/stiffness.csv", newline="") as file:
            C = np.array([[float(x) for x in row[2:]] for row in list(csv.reader(file))[1:]])
        np.testing.assert_allclose(C, isotropic(2.8e6, 0.4), rtol=2e-4, atol=2e-4 * 2.8e6)  # strains are 1e-5

    @unittest.skipUnless("STRUT" in os.environ, "STRUT names no program")
    def test_a_laminate_has_backus_averages_as_the_spacing_falls(self):
        stuff = {"a": (120e9, 0.35), "b": (30e9, 0.2)}
        (self.folder / "laminate.xml").write_text(deck("laminate.g", stuff))
        found = []
        for n in (8, 16):  # cells in a layer
            h = 2e-3 / n
            (self.folder / "laminate.recipe").write_text(f"shape = box\nspacing = {h}\nsize = {8 * h} {8 * h} 2e-3\n"
                                                         "[body]\nname = a\n[body]\nname = b\norigin = 0 0 2e-3\n")
            (self.folder / "laminate.g").unlink(missing_ok=True)
            # The width of a layer does not matter: sideways it strains evenly, and all points are held there.
            found.append(self.tensors_of("laminate", "--layers", 4, 4, 1, "--boundaries", "mixed")["mixed"])
        expected = backus([isotropic(*law) for law in stuff.values()])
        errors = [np.abs(C / 1e9 - expected / 1e9).max() for C in found]
        # Faces and the interface take a share of the order of the spacing: of twice the finer less the coarser the square
        # is left, (1/16)² of the largest jump of moduli, 40 GPa, and a few times that; measured 0.08 GPa.
        self.assertLess(errors[1], 0.6 * errors[0])
        self.assertLess(errors[0], 0.03 * 55)
        np.testing.assert_allclose(2 * found[1] - found[0], expected, atol=0.16e9)

    @unittest.skipUnless("STRUT" in os.environ, "STRUT names no program")
    def test_a_cubic_lattice_of_struts_bears_by_the_struts_along_the_load(self):
        n, thick = 24, 4
        inside = np.abs(np.arange(n) + 0.5 - n / 2) < thick / 2  # one strut of 4 x 4 cells along each axis
        x, y, z = np.meshgrid(inside, inside, inside, indexing="ij")
        cells = np.argwhere((x & y) | (y & z) | (z & x))
        corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
        ids, elements = np.unique((cells[:, None] + corners).reshape(-1, 3), axis=0, return_inverse=True)
        write_mesh(self.folder / "lattice.g", 1e-3 / n * ids, [("lattice", "HEX8", elements.reshape(-1, 8), None)], {})
        (self.folder / "lattice.xml").write_text(deck("lattice.g", {"lattice": (70e9, 0.0)}, "Quadratic Correspondence"))
        C = self.tensors_of("lattice", "--boundaries", "mixed")["mixed"]
        cube = C.diagonal()
        np.testing.assert_allclose(cube[:3], cube[0], rtol=1e-4)  # the solver's tolerance of forces is 1e-5
        np.testing.assert_allclose(cube[3:], cube[3], rtol=1e-4)
        # Along the load a bar of the section (t/L)²: at most with a rigid node; held by points half a cell within the ends,
        # beyond which nothing is strained, and taken as a mean over all, it may be less by that cell of 24.
        bar = 70e9 * (thick / n)**2
        self.assertGreater(cube[0], bar * (1 - 1 / n))
        self.assertLess(cube[0], bar / (1 - thick / n))
        self.assertLess(np.abs(C[:3, :3] - np.diag(cube[:3])).max(), 0.05 * bar)  # ν = 0: only the node ties them
        # Shear bends the struts, E (t/L)⁴/2 of slender ones that are clamped where they cross: less for their own shear, by
        # 12 E I/(κ G A L²) = 2.4 (t/L)², more for a rigid node by (1 - t/L)^-3 at the most.
        slender = 0.5 * 70e9 * (thick / n)**4
        self.assertGreater(cube[3], slender / (1 + 2.4 * (thick / n)**2))
        self.assertLess(cube[3], slender / (1 - thick / n)**3)

    @unittest.skipUnless("STRUT" in os.environ, "STRUT names no program")
    def test_struts_in_the_faces_of_the_box_bear_as_struts(self):
        """Two halves of a strut along the middle of each face, gathered in cells that need not fill the box: flat ones, which
        are cut in two layers. Held both, these would be strained through their thickness, and double the stiffness."""
        n, half, wide = 40, 2, 6  # voxels: the box, half a strut, its width; 3 to a cell, and one left over
        E, solid = 70e9, np.zeros((n, n, n), bool)
        middle = slice((n - wide) // 2, (n + wide) // 2)
        for normal in range(3):
            for along in {0, 1, 2} - {normal}:
                across = ({0, 1, 2} - {normal, along}).pop()
                for layer in (slice(half), slice(n - half, n)):
                    place = [slice(None)] * 3
                    place[normal], place[across] = layer, middle
                    solid[tuple(place)] = True
        places = np.argwhere(solid.T)[:, ::-1]  # ascending, x fastest
        mesh = (f"strut-mesh arrays 1\nnodes 0\nvoxels lattice {len(places)} {n} {n} {n} 3 0.3 solid\n".encode() +
                np.array([1e-3 / n] * 3 + [0] * 3, "<f8").tobytes() + places.astype("<i4").tobytes() + b"end\n")
        made = subprocess.run([os.environ["STRUT_MESH"], "--arrays", self.folder / "lattice.g"], input=mesh, check=True,
                              capture_output=True).stdout.decode()
        self.assertRegex(made, "[1-9][0-9]* cut in two layers")
        (self.folder / "lattice.xml").write_text(deck("lattice.g", {"lattice": (E, 0.0)}, "Quadratic Correspondence"))
        done = self.stiffness("lattice.xml", "out", "--boundaries", "mixed")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        self.assertIn("box 0.001 x 0.001 x 0.001 m", done.stdout)
        with open(self.folder / "out/stiffness.csv", newline="") as file:
            cube = [float(row[2 + i]) for i, row in enumerate(list(csv.reader(file))[1:4])]
        bar = E * 4 * half * wide / n**2
        # A bar of the section of the struts along the load; a rigid node where others cross it, 6 of 40 voxels, makes it
        # stiffer at the most, and the outer halves of the cells at both ends, which are not strained, softer by 3 of 40.
        self.assertGreater(min(cube), bar * (1 - 3 / n))
        self.assertLess(max(cube), bar / (1 - wide / n))

    @unittest.skipUnless("STRUT" in os.environ, "STRUT names no program")
    def test_a_sample_of_two_pieces_is_told_and_has_no_stiffness(self):
        """Two blocks that touch, whose nodes are not merged: quadratic cells connect points through nodes alone."""
        (self.folder / "two.recipe").write_text("shape = box\nspacing = 1e-3\nsize = 3e-3 3e-3 3e-3\n[body]\nname = a\n[body]\nname = b\n"
                                                "origin = 3e-3 0 0\n")
        (self.folder / "two.xml").write_text(deck("two.g", {"a": (70e9, 0.3), "b": (20e9, 0.3)}, "Quadratic Correspondence"))
        done = self.stiffness("two.xml", "out", "--boundaries", "mixed")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("mixed boundaries: the stiffness is not positive definite: its eigenvalues are ", done.stderr)
        told = [line for line in done.stdout.splitlines() if "WARNING" in line]
        self.assertEqual(len(told), 1, told)  # not that edges are of two faces, which is meant
        self.assertRegex(told[0], "WARNING in 4 of 4 runs, here mixed-xx: .* nothing connects the two")
        self.assertFalse((self.folder / "out/stiffness.csv").exists())

    def test_elements_are_numbered_by_blocks_in_whatever_order_the_file_holds_them(self):
        corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)
        nodes = np.concatenate([corners, corners + (0, 0, 1), corners + (0, 0, 2)])
        bricks = np.arange(24).reshape(-1, 8)
        write_mesh(self.folder / "a.g", nodes, [("low", "HEX8", bricks[:1], None), ("high", "HEX8", bricks[1:], None)], {})
        with netCDF4.Dataset(self.folder / "a.g") as file, \
                netCDF4.Dataset(self.folder / "b.g", "w", format="NETCDF3_64BIT_OFFSET") as turned:
            for name, dimension in file.dimensions.items():
                turned.createDimension(name, None if dimension.isunlimited() else len(dimension))
            for name, variable in reversed(file.variables.items()):
                copy = turned.createVariable(name, variable.dtype, variable.dimensions)
                copy.setncatts(variable.__dict__)
                copy[:] = variable[:]
        for name in ("a.g", "b.g"):
            sample = faces.Sample(str(self.folder / name))
            np.testing.assert_array_equal(sample.numbers, [1, 2, 3])
            np.testing.assert_array_equal(sample.places[:, 2], [0.5, 1.5, 2.5], err_msg=name)

    def test_faces_of_a_graded_mesh_hold_their_layers(self):
        heights = np.cumsum([0, 1, 1.5, 2.25, 3.4])
        places = np.array([(x, y, z) for z in heights for y in (0, 3) for x in (0, 3, 6)])
        brick = np.array([0, 1, 4, 3, 6, 7, 10, 9])
        bricks = np.array([brick + i + 6 * k for k in range(4) for i in range(2)])
        write_mesh(self.folder / "a.g", places, [("a", "HEX8", bricks, None)], {})
        sample = faces.Sample(str(self.folder / "a.g"))
        for face, layers, held in (("zmin", 1, [1, 2]), ("zmax", 1, [7, 8]), ("zmin", 2, [1, 2, 3, 4]), ("zmax", 2, [5, 6, 7, 8]),
                                   ("xmin", 1, [1, 3, 5, 7]), ("ymax", 1, range(1, 9))):
            np.testing.assert_array_equal(sample.held(face, layers), held, err_msg=face)

    def test_faces_of_uneven_tetrahedra_are_held(self):
        """Of five in a brick of 4 x 4 x 4 at each end of a long one, whose middle has a thin one: all that have a side at a face."""
        corners = np.array([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (0, 0, 4), (4, 0, 4), (4, 4, 4), (0, 4, 4)], float)
        five = np.array([(0, 1, 3, 4), (2, 3, 1, 6), (5, 4, 6, 1), (7, 6, 4, 3), (1, 3, 4, 6)])
        thin = np.array([(1, 1, 5), (1.1, 1, 5), (1, 1.1, 5), (1, 1, 5.1)])
        write_mesh(self.folder / "a.g", np.concatenate([corners, corners + (0, 0, 8), thin]),
                   [("a", "TET4", np.concatenate([five, five + 8, [[16, 17, 18, 19]]]), None)], {})
        sample = faces.Sample(str(self.folder / "a.g"))
        self.assertLessEqual({1, 2}, set(sample.held("zmin", 1)))
        self.assertLessEqual({8, 9}, set(sample.held("zmax", 1)))
        self.assertNotIn(11, np.concatenate([sample.held(face, 1) for face in faces.FACES]))

    def test_a_mesh_older_than_one_it_is_made_of_is_made_anew(self):
        """By a strut-mesh that says so; tools/run stands in an installed tree, whose runs end at once."""
        for name, text in {"tree/bin/strut-mesh": "echo made anew >&2; exit 1", "tree/bin/mpirun": "exit 0"}.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_text(f"#!/bin/sh\n{text}\n")
            (self.folder / name).chmod(0o755)
        tools = self.folder / "tree/share/strut/tools"
        tools.mkdir(parents=True)
        shutil.copy(TOOLS / "run", tools)
        (self.folder / "decks/parts").mkdir(parents=True)
        (self.folder / "decks/a.xml").write_text(deck("a.g", {"block": (117e9, 0.35)}))
        (self.folder / "decks/a.recipe").write_text("shape = file\n[body]\nfile = parts/one.g\n[body]\n"
                                                    "  file=parts/two b.g  # the plate")
        names = ("a.g", "parts/one.g", "parts/two b.g")
        for newest in names:
            for name in ("a.recipe", *names):
                (self.folder / "decks" / name).touch()
                os.utime(self.folder / "decks" / name, (2e9, 2e9 + (name == newest) + 0.5 * (name == "a.g")))
            bin = self.folder / "tree/bin"
            run = subprocess.run([tools / "run", "decks/a.xml"], capture_output=True, text=True, cwd=self.folder,
                                 env={**os.environ, "PATH": f"{bin}:{os.environ['PATH']}"})
            measured = self.run_tool("stiffness", "decks/a.xml", "out", STRUT_MESH=str(bin / "strut-mesh"))
            for done in (run, measured):
                self.assertEqual("made anew" in done.stderr, newest != "a.g", (newest, done.stderr))

    def test_mixed_boundaries_of_a_lattice_without_mirror_planes_are_told(self):
        (self.folder / "a.xml").write_text(deck("a.g", {"foam": (70e9, 0.3)}))
        for lattice in ("gyroid", "diamond-sheet", "octet"):
            (self.folder / "a.recipe").write_text(f"shape = lattice\nlattice = {lattice}\n")
            for kinds in ({"mixed": 0, "kinematic": 0}, {"kinematic": 0}):
                told = loads.meanings(Deck(str(self.folder / "a.xml")), kinds)
                self.assertEqual([f"do not give the periodic stiffness of a {lattice}," in line for line in told],
                                 [True] if "mixed" in kinds and lattice != "octet" else [])

    def test_errors_are_one_line_that_helps(self):
        (self.folder / "a.xml").write_text(deck("a.g", {"block": (117e9, 0.35)}))

        def error(*words):
            done = self.stiffness(*words)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            return done.stderr
        self.assertIn("a.g does not exist", error("a.xml", "out"))
        (self.folder / "a.g").write_text("no mesh")
        self.assertIn("a.g is not an Exodus file", error("a.xml", "out"))
        self.assertIn("unknown option '--strin' (did you mean '--strain'?)", error("a.xml", "out", "--strin", 1))
        self.assertIn("--strain: expected 1 number from 1e-12 to 0.01", error("a.xml", "out", "--strain", 1))


def backus(layers):
    """Layers of one thickness, isotropic, across z (Backus, J. Geophys. Res. 67 (1962) 4427)."""
    la, mu = (np.array([C[i] for C in layers]) for i in ((0, 1), (3, 3)))
    M = la + 2 * mu
    c33, q = 1 / np.mean(1 / M), np.mean(la / M)
    C = np.zeros((6, 6))
    C[0, 0] = C[1, 1] = np.mean(4 * mu * (la + mu) / M) + c33 * q**2
    C[0, 1] = C[1, 0] = np.mean(2 * mu * la / M) + c33 * q**2
    C[0, 2] = C[2, 0] = C[1, 2] = C[2, 1] = c33 * q
    C[2, 2] = c33
    C[3, 3] = C[4, 4] = 1 / np.mean(1 / mu)
    C[5, 5] = np.mean(mu)
    return C


class Loads(unittest.TestCase):
    def test_one_load_case_follows_another_without_a_gap(self):
        text = loads.displacement([0, 0, 0], 0, 1e-5, (0, 0, 0))
        for t in (0.5, 1, 1.5, 2, 2.5, 3):
            self.assertEqual(eval(text, {"t": t, "x": 1.0}), 1e-5)


class Tensors(unittest.TestCase):
    def test_numbers_of_an_isotropic_and_of_a_cubic_body(self):
        C = isotropic(200.0, 0.3)
        e = tensors.engineering(C)
        for name, value in {"E_x": 200, "G_yz": 200 / 2.6, "nu_zx": 0.3}.items():
            self.assertAlmostEqual(e[name], value, 10)
        np.testing.assert_allclose(tensors.bounds(C), [200 / 1.2, 200 / 2.6] * 2)
        self.assertAlmostEqual(tensors.anisotropy(C), 0, 12)
        # Copper (Simmons & Wang 1971): E of [100], [110], [111] 66.7, 130.3, 191.1 GPa (Meyers & Chawla), Zener 3.2.
        C = np.diag([168.4] * 3 + [75.4] * 3)
        C[:3, :3] += 121.4 * (1 - np.eye(3))
        directions = np.array([(1, 0, 0), (2**-0.5, 2**-0.5, 0), (3**-0.5,) * 3])
        np.testing.assert_allclose(tensors.young(C, directions), [66.7, 130.3, 191.1], rtol=2e-3)  # printed digits
        self.assertAlmostEqual(tensors.zener(C), 3.21, 2)
        # A cubic body has A^U = 6/5 (√A − 1/√A)² (Ranganathan & Ostoja-Starzewski 2008).
        A = tensors.zener(C)
        self.assertAlmostEqual(tensors.anisotropy(C), 1.2 * (A**0.5 - A**-0.5)**2, 10)


if __name__ == "__main__":
    unittest.main()
