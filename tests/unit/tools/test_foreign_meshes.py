#!/usr/bin/python3
"""The commands of inputs/from-abaqus.md, as they stand there: meshes of hexahedra from Abaqus and LS-DYNA, and its example."""
import os
import re
import subprocess
import unittest

from tool_test import TOOLS, InFolder

import netCDF4
import numpy as np

try:
    import meshio  # noqa: F401
except ImportError as error:
    print(f"skipped: {error}")
    raise SystemExit(77)


PAGE = (TOOLS.parent / "inputs/from-abaqus.md").read_text()
SIZE = (4, 4, 8)  # bricks of 1 mm


def commands():
    """The indented blocks of the page: for .inp and for .k."""
    blocks = re.findall(r"((?:^    .*\n)+)", PAGE, re.M)
    return [re.sub(r"^    ", "", block, flags=re.M) for block in blocks]


def node(i, j, k):
    return 1 + i + (SIZE[0] + 1) * (j + (SIZE[1] + 1) * k)


def nodes():
    return [(node(i, j, k), i, j, k) for k in range(SIZE[2] + 1) for j in range(SIZE[1] + 1) for i in range(SIZE[0] + 1)]


def bricks():
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    return [[node(i + a, j + b, k + c) for a, b, c in corners]
            for k in range(SIZE[2]) for j in range(SIZE[1]) for i in range(SIZE[0])]


class Meshes(InFolder):
    def begun(self, text):
        return subprocess.run(["bash", "-c", text.replace("tools/", f"{TOOLS}/")], capture_output=True, text=True, cwd=self.folder)

    def run_block(self, text):
        done = self.begun(text)
        self.assertEqual(done.returncode, 0, done.stderr)

    def write_inp(self):
        lines = ["*NODE"] + [f"{n}, {x}., {y}., {z}." for n, x, y, z in nodes()]
        lines += ["*ELEMENT, TYPE=C3D8"] + [", ".join(map(str, [e, *c])) for e, c in enumerate(bricks(), 1)]
        foot = [n for n, _, _, z in nodes() if z == 0]
        lines += ["*NSET, NSET=FOOT"] + [", ".join(map(str, foot[n:n + 8])) for n in range(0, len(foot), 8)]
        (self.folder / "bar.inp").write_text("\n".join(lines) + "\n")

    def volumes(self, file, block):
        """Volumes of the bricks of a block: the triple product of their edges, m³."""
        with netCDF4.Dataset(self.folder / file) as data:
            axes = [data["coord" + a][:] for a in "xyz"] if "coordx" in data.variables else data["coord"][:]
            places, corners = np.stack(list(axes), -1), data[f"connect{block}"][:] - 1
            edges = [places[corners[:, n]] - places[corners[:, 0]] for n in (1, 3, 4)]
            return np.einsum("ij,ij->i", np.cross(edges[0], edges[1]), edges[2])

    def test_bricks_of_abaqus_and_the_example_of_the_page(self):
        self.write_inp()
        self.run_block(commands()[0])
        self.assertEqual(len(self.volumes("bar.e", 1)), 128)
        np.testing.assert_allclose(self.volumes("bar.e", 1), 1e-9, rtol=1e-12)  # round-off of coordinates
        deck = re.search(r"```yaml\n(.*?)```", PAGE, re.S).group(1)
        (self.folder / "bar.yaml").write_text(deck)
        run = subprocess.run([os.environ["STRUT"], "bar.yaml"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        plastic = float(re.search(r"plastic ([\d.e+-]+)", run.stdout).group(1))
        self.assertAlmostEqual(plastic, 4.14, delta=0.005)  # as the page prints it
        kinetic = 0.5 * 7800 * 128e-9 * 100 ** 2
        self.assertAlmostEqual(kinetic, 4.99, delta=0.005)

    def test_bricks_of_two_parts_are_refused(self):
        self.write_inp()
        with open(self.folder / "bar.inp", "a") as file:
            file.write("*Node\n1, 0., 0., 0.\n")
        self.assertIn("a second *NODE, the first is in line 1", self.begun(commands()[0]).stderr)
        self.assertFalse((self.folder / "bar.e").exists())

    def test_bricks_of_ls_dyna_become_a_block_for_each_part(self):
        lines = ["*KEYWORD", "$ bricks of 1 mm", "*NODE"]
        lines += [f"{n:8d}{x:16.4f}{y:16.4f}{z:16.4f}" for n, x, y, z in nodes()] + ["*ELEMENT_SOLID"]
        for e, corners in enumerate(bricks(), 1):
            lines.append(f"{e:8d}{1 if e <= 64 else 2:8d}" + "".join(f"{n:8d}" for n in corners))
        (self.folder / "bar.k").write_text("\n".join(lines + ["*END"]) + "\n")
        for block in reversed(commands()[:2]):
            self.run_block(block)
        for block in (1, 2):
            np.testing.assert_allclose(self.volumes("bar.e", block), 1e-9, rtol=1e-12)
            self.assertEqual(len(self.volumes("bar.e", block)), 64)


if __name__ == "__main__":
    unittest.main()
