#!/usr/bin/python3
"""tools/curve on curves and shocks whose numbers are known in closed form, and run as a user runs it."""
import csv
import os
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree as tree
from types import SimpleNamespace

from tool_test import InFolder

import numpy as np
import netCDF4
import exodus
from curve_parts import extent, measures, samples, shock, source
from decks import Deck, Recipe

E, YIELD, UNLOADING = 100e6, 2e6, 150e6  # Pa
DENSE, K = 0.5, 60e6                     # strain from which on the stress rises, Pa per strain
LAST = 0.6
STRAIN = np.unique(np.concatenate([np.linspace(0, LAST, 6001), [YIELD / E, DENSE]]))  # with both corners: no rounding


def stress_at(e):
    return np.minimum(E * e, YIELD) + K * np.maximum(e - DENSE, 0)


def measured(strain, stress):
    return {m.name: m.value for m in measures.of_curve(strain, stress)}


class Curves(unittest.TestCase):
    """Elastic, a plateau, then a straight rise: all is known in closed form. Trapezoids are exact on straight lines, so that
    only round-off of some thousand terms is left: 1e-10; the largest efficiency is on a row, 1e-4 apart."""

    def test_gradient_plateau_and_its_end(self):
        found = measured(STRAIN, stress_at(STRAIN))
        self.assertAlmostEqual(found["quasi_elastic_gradient"] / E, 1, 10)
        self.assertAlmostEqual(found["plateau_stress"] / YIELD, 1, 10)
        self.assertAlmostEqual(found["plateau_stress_20_40"] / YIELD, 1, 10)
        self.assertAlmostEqual(found["plateau_end"], DENSE + 0.3 * YIELD / K, 10)
        self.assertIsNone(found["elastic_gradient"])

    def test_a_hardening_plateau_has_the_mean_of_its_range(self):
        found = measured(STRAIN, stress_at(STRAIN) + 3e6 * STRAIN)
        self.assertAlmostEqual(found["plateau_stress"], YIELD + 3e6 * 0.25, 3)
        self.assertAlmostEqual(found["plateau_stress_20_40"], YIELD + 3e6 * 0.30, 3)

    def test_energy_to_the_end_of_the_plateau(self):
        found = measured(STRAIN, stress_at(STRAIN))
        W = YIELD * (0.5 - 0.5 * YIELD / E)  # to 50 %, where the plateau has not yet ended
        self.assertEqual(found["energy_strain"], 0.5)
        self.assertAlmostEqual(found["absorbed_energy"] / W, 1, 10)
        self.assertAlmostEqual(found["absorption_efficiency"], W / (YIELD * 0.5), 10)

    def test_energy_of_means_is_their_work_however_few_they_are(self):
        # Means over intervals times these are the work; the end of the loading and of the last interval are one.
        strain = np.unique(np.append(np.linspace(0, 0.45, 10), YIELD / E))
        W = np.where(strain < YIELD / E, 0.5 * E * strain**2, YIELD * (strain - 0.5 * YIELD / E))
        means = np.append(0, np.diff(W) / np.diff(strain))
        found = {m.name: m.value for m in measures.of_curve(measures.midway(strain), means, means, ends=strain)}
        self.assertEqual(found["energy_strain"], 0.45)
        self.assertAlmostEqual(found["absorbed_energy"] / W[-1], 1, 12)

    def test_densification_is_where_the_efficiency_is_largest(self):
        W = YIELD * (DENSE - 0.5 * YIELD / E)
        # A straight rise with K W > Y²: d/dx (W + Y x + K x²/2)/(Y + K x) is negative at once.
        found = measured(STRAIN, stress_at(STRAIN))
        self.assertAlmostEqual(found["densification_strain"], DENSE, 12)
        self.assertAlmostEqual(found["largest_efficiency"], W / YIELD, 10)
        self.assertAlmostEqual(found["densification_energy"] / W, 1, 10)
        # A rise by C x²: the efficiency is largest where C² x⁴/3 - 2 C W x + Y² = 0.
        C = 400e6
        x = min(r.real for r in np.roots([C * C / 3, 0, 0, -2 * C * W, YIELD**2]) if abs(r.imag) < 1e-12 and r.real > 0)
        found = measured(STRAIN, np.minimum(E * STRAIN, YIELD) + C * np.maximum(STRAIN - DENSE, 0)**2)
        self.assertGreater(x, 5e-3)
        self.assertAlmostEqual(found["densification_strain"], DENSE + x, delta=1e-4)  # a row
        # Around a maximum it is off by the square of the row's distance, and by trapezoids of 1e-4.
        self.assertAlmostEqual(found["largest_efficiency"], (W + YIELD * x + C * x**3 / 3) / (YIELD + C * x * x), 6)

    def test_a_loop_of_unloading_gives_the_elastic_gradient_and_changes_nothing_else(self):
        at = 0.15
        drop = np.linspace(0, 0.9 * YIELD / UNLOADING, 200)
        loop = np.concatenate([at - drop, (at - drop)[::-1]])
        back = YIELD - UNLOADING * (at - loop)
        before, after = STRAIN <= at, STRAIN > at
        strain = np.concatenate([STRAIN[before], loop, STRAIN[after]])
        stress = np.concatenate([stress_at(STRAIN[before]), back, stress_at(STRAIN[after])])
        found, plain = measured(strain, stress), measured(STRAIN, stress_at(STRAIN))
        self.assertAlmostEqual(found.pop("elastic_gradient") / UNLOADING, 1, 9)
        # U (e - 0.2 %) = E e; at 1 % the line meets the plateau.
        self.assertAlmostEqual(found.pop("proof_strength") / (E * UNLOADING * 0.002 / (UNLOADING - E)), 1, 8)
        self.assertAlmostEqual(found.pop("proof_strength_1") / YIELD, 1, 10)
        for name in ("elastic_gradient", "proof_strength", "proof_strength_1"):
            self.assertIsNone(plain.pop(name))
        for name, value in plain.items():
            self.assertEqual(found[name], value, name)

    def test_offset_stresses_of_a_hardening_plateau(self):
        slope = 3e6
        found = measured(STRAIN, stress_at(STRAIN) + slope * STRAIN)
        for name, offset in (("offset_stress", 0.002), ("offset_stress_1", 0.01)):
            e = (YIELD + (E + slope) * offset) / E  # (E + slope) (e - offset) = Y + slope e
            self.assertAlmostEqual(found[name] / (YIELD + slope * e), 1, 9)

    def test_what_is_missing_has_its_reason(self):
        for m in measures.of_curve(STRAIN[:1500], stress_at(STRAIN[:1500])):
            self.assertEqual(m.value is None, "none: " in m.said(), m)

    def test_a_curve_that_ends_early_has_what_it_has(self):
        found = measured(STRAIN[:1500], stress_at(STRAIN[:1500]))
        for name in ("plateau_stress", "plateau_stress_20_40", "plateau_end", "densification_strain"):
            self.assertIsNone(found[name], name)
        self.assertAlmostEqual(found["quasi_elastic_gradient"] / E, 1, 10)


class Extents(InFolder):
    """Meshes of cubes of edge 1: of whole ones, and of cells that hold a part of them."""

    def write(self, middles, radii=None, scale=1, element="HEX8"):
        corners = np.array([(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float)
        nodes = (np.floor(middles)[:, None] + corners).reshape(-1, 3)
        with netCDF4.Dataset(self.folder / "m.g", "w", format="NETCDF3_CLASSIC") as file:
            for name, size in (("nodes", len(nodes)), ("cells", len(middles)), ("corners", 8), ("numbers", 6), ("len", 16), ("one", 1)):
                file.createDimension(name, size)
            for c, x in zip("xyz", nodes.T):
                file.createVariable("coord" + c, "f8", ("nodes",))[:] = scale * x
            self.put_names(file, "eb_names", "one", ["foam"])
            elements = file.createVariable("connect1", "i4", ("cells", "corners"))
            if element:
                elements.elem_type = element
            elements[:] = 1 + np.arange(len(nodes)).reshape(-1, 8)
            if radii is not None:
                self.put_names(file, "attrib_name1", "numbers", extent.NUMBERS)
                file.createVariable("attrib1", "f8", ("cells", "numbers"))[:] = np.hstack([scale * middles, (scale * radii)**2])
        return str(self.folder / "m.g")

    @staticmethod
    def put_names(file, variable, dimension, names):
        rows = file.createVariable(variable, "S1", (dimension, "len"))
        for n, name in enumerate(names):
            rows[n] = netCDF4.stringtochar(np.array([name], "S16"))[0]

    def test_a_body_is_as_large_as_its_elements_and_not_half_a_spacing_more(self):
        mesh = self.write(np.array([[0.5, 0.5, 0.5], [3.5, 0.5, 1.5]]))
        np.testing.assert_array_equal(extent.size_of(mesh, "foam"), [4, 1, 2])
        self.assertIsNone(extent.size_of(mesh, "plate"))
        self.assertIsNone(extent.size_of(str(self.folder / "none.g"), "foam"))
        self.assertIsNone(extent.size_of(self.write(np.full((1, 3), 0.5), element=None), "foam"))

    def test_a_lattice_is_as_large_as_its_recipe_says_and_not_as_its_struts_reach(self):
        deck = self.folder / "a.yaml"
        deck.write_text("A: {Discretization: {Input Mesh File: m.g}}\n")
        for lines, expected in (("size = 2 3 4", [2, 3, 4]), ("count = 2 3 4\ncell = 0.5", [1, 1.5, 2]), ("count = 4\ncell = 0.5", [2, 2, 2])):
            (self.folder / "m.recipe").write_text(f"shape = lattice\nlattice = bcc\n{lines}\n")
            self.write(np.array([[0.5] * 3, np.array(expected) * 10 - 1]), scale=0.1)
            self.assertEqual(samples.size_of(Deck(str(deck)), None, None, {}), expected)
            self.write(np.array([[0.5] * 3, np.array(expected) * 5]), scale=0.1)  # the recipe has been changed since
            found = {}
            np.testing.assert_allclose(samples.size_of(Deck(str(deck)), None, None, found), np.array(expected) / 2 + 0.05, atol=0.06)
            self.assertIn("WARNING: the recipe beside it is of another mesh", found["size"])

    def test_the_section_of_a_cylinder_is_a_circle_and_an_outline_that_is_no_box_is_told(self):
        middles = np.stack(np.meshgrid(*[np.arange(20) + 0.5] * 2, [0.5], indexing="ij"), -1).reshape(-1, 3)
        mesh = self.write(middles[np.hypot(*(middles[:, :2] - 10).T) < 10])
        self.assertAlmostEqual(extent.outline_of(mesh, None, 2) / (100 * np.pi), 1, delta=0.1)  # corners of cells stand out
        deck = self.folder / "a.yaml"
        deck.write_text("A: {Discretization: {Input Mesh File: m.g}}\n")
        words = SimpleNamespace(area=None, height=None, density=1)
        for axis, told in ((2, "of it: expected --area"), (0, None)):
            sample = samples.sample_of(Deck(str(deck)), axis, None, words)
            self.assertAlmostEqual(sample.area, 400 if axis == 2 else 20, 9)
            self.assertIn(told, sample.found["area"]) if told else self.assertNotIn("area", sample.found)
        (self.folder / "m.recipe").write_text("shape = cylinder\nradius = 10.1\nlength = 1\n")
        for axis, expected in ((2, np.pi * 10.1**2), (0, 20.2)):
            self.assertAlmostEqual(samples.sample_of(Deck(str(deck)), axis, None, words).area, expected, 9)

    def test_a_grid_of_the_deck_is_as_large_as_its_lengths(self):
        deck = self.folder / "a.yaml"
        deck.write_text("A: {Discretization: {Type: PdQuickGrid, TensorProduct3DMeshGenerator: {X Length: 2, Y Length: 3.0, Z Length: 4e-3}}}\n")
        self.assertEqual(samples.size_of(Deck(str(deck)), None, None, {}), [2, 3, 4e-3])

    def test_what_moves_outer_points_leaves_half_a_spacing_at_each_end(self):
        self.write(np.array([[0.5, 0.5, z + 0.5] for z in range(5)]))
        deck = self.folder / "a.xml"
        for points, how, expected in (("Elements", "Mean_Displacement_Z(top)", "half a spacing at each end, 20 % of the height"),
                                      ("Elements", "the motion of `top`", "half a spacing at each end, 20 % of the height"),
                                      ("Elements", "the distance of the outer layers", None), ("Nodes", "the motion of `top`", None)):
            deck.write_text(f'<a><ParameterList name="Discretization"><Parameter name="Points" value="{points}"/>'
                            '<Parameter name="Input Mesh File" value="m.g"/></ParameterList></a>')
            found = source.unstrained(Deck(str(deck)), "foam", 2, 5, how)
            self.assertEqual(found and found[:len(expected)], expected)
            if found:
                self.assertIn("strain is too small by that, and stress too large", found)
        plane = ('<ParameterList name="Boundary Conditions"><ParameterList name="foot"><Parameter name="Type" value="Symmetry Plane"/>'
                 '<Parameter name="Normal" value="%s"/></ParameterList></ParameterList></a>')
        for normal, how, part in (("0 0 2", "the motion of `top`", "10"), ("1 0 0", "the motion of `top`", "20"),
                                  ("0 0 2", "Mean_Displacement_Z(top) less Mean_Displacement_Z(foot)", "20")):
            deck.write_text('<a><ParameterList name="Discretization"><Parameter name="Input Mesh File" value="m.g"/></ParameterList>' + plane % normal)
            self.assertIn(f", {part} % of the height", source.unstrained(Deck(str(deck)), "foam", 2, 5, how))
        self.assertIn("half a spacing at each end: ", source.unstrained(None, None, 2, 5, "Mean_Displacement_Z(top)"))  # unknown

    def test_a_lattice_of_points_ends_half_a_step_of_each_axis_beyond_them(self):
        def grid(*counts):
            return np.stack(np.meshgrid(*(np.arange(n) + 0.5 for n in counts), indexing="ij"), -1).reshape(-1, 3)
        edges = np.array([1e-3, 1e-3, 2e-3])
        irregular = np.random.default_rng(1).random((50, 3)) * 1e-2
        for places, volume, expected in ((grid(4, 4, 4) * edges, 2e-9, edges), (grid(4, 1, 4) * edges, 2e-9, edges),
                                         (grid(4, 4, 4)[::3] * edges, 2e-9, edges), (grid(2, 1, 1) * 1e-3, 1e-9, [1e-3] * 3),
                                         (irregular, 8e-9, 2e-3), (np.zeros((1, 3)), 8e-9, 2e-3)):
            np.testing.assert_allclose(samples.edges_of_cells(places, volume), expected, rtol=1e-9)

    def test_cells_that_reach_beyond_the_image_do_not_count_as_full(self):
        # Along x the image ends in the middle of the last cells, which hold a half each; one strut there ends before.
        middles = np.array([[x, y + 0.5, 0.5] for x in (0.5, 1.5, 2.25) for y in range(5)])
        radii = np.full((15, 3), 0.5 / np.sqrt(3))  # of a prism of edge 1
        radii[10:, 0] = 0.25 / np.sqrt(3)
        middles[12, 0], radii[12, 0] = 2.1, 0.1 / np.sqrt(3)
        for scale in (1, 1e-9):  # a body of nanometers is a body, too
            size = extent.size_of(self.write(middles, radii, scale), None)
            np.testing.assert_allclose(size / scale, [2.5, 5, 1], rtol=1e-14)
        np.testing.assert_array_equal(extent.box_in(self.write(middles, radii), None, whole=True), [[0, 0, 0], [3, 5, 1]])


V, U, RHO, H = 80.0, 100.0, 400.0, 0.02  # m/s, m/s, kg/m³, m
TIMES = np.linspace(0, 0.95 * H / U, 400)
LAYERS = (np.arange(20) + 0.5) / 20 * H


def shocked(times=TIMES):
    """Places and velocities of layers of a foam at rest whose face is pushed at V: a shock of speed U runs through it."""
    passed = np.maximum(times[:, None] - LAYERS / U, 0)
    return LAYERS + V * passed, np.where(passed > 0, V, 0.0)


def crushed_at_both_ends(plug, far, since=0.0, times=np.linspace(0, 0.95 * H / U, 4000)):
    """Times, places and velocities of layers between that shock and another one, from the far end on since a time: ahead of
    the first the foam moves at `plug`, and the second one, of the speed `far`, stops it. Velocities are means over layers."""
    thick = H / len(LAYERS)
    on = np.maximum(times - since, 0)[:, None]
    first = np.clip((U * times[:, None] - LAYERS) / thick + 0.5, 0, 1)
    second = np.clip((far * on - (H - LAYERS)) / thick + 0.5, 0, 1)
    v = V * first + plug * (on > 0) * (1 - first) * (1 - second)
    moved = np.concatenate([[0 * LAYERS], np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(times)[:, None], axis=0)])
    return times, LAYERS + moved, v


class Shocks(unittest.TestCase):
    def test_a_shock_has_its_speed_strain_and_jump(self):
        front = shock.front(TIMES, *shocked())
        row = TIMES[1]  # an arrival is known to half a row
        self.assertAlmostEqual(front.speed, U, delta=U * row / (0.7 * H / U))
        self.assertLess(front.scatter, U * row)
        self.assertEqual(front.jump_of_velocity, V)
        self.assertAlmostEqual(front.strain, V / U, 9)
        self.assertAlmostEqual(front.strain_by_speed, V / U, delta=0.01)
        self.assertAlmostEqual(front.jump_of_stress(TIMES, np.full(len(TIMES), RHO * U * V), RHO) / (RHO * U * V), 1, 2)

    def test_a_foam_that_moves_ahead_of_a_shock_is_no_part_of_its_jump(self):
        # Both ends differ by the gain of momentum, rho (U V - plug (U + far)), the shock by rho U (V - plug).
        plug, far = 0.1 * V, 0.1 * U
        times, places, v = crushed_at_both_ends(plug, far)
        front = shock.front(times, places, v)
        self.assertAlmostEqual(front.speed / U, 1, 3)
        self.assertAlmostEqual(front.jump_of_velocity, V - plug, delta=plug / 14)  # at the last arrival few are still ahead
        ends = np.full(len(times), RHO * (U * V - plug * (U + far)))
        for sign in 1, -1:  # whichever end comes first in the history
            found = front.jump_of_stress(times, sign * ends, RHO) / (RHO * U * (V - plug))
            self.assertAlmostEqual(found, 1, delta=plug / V / 14)

    def test_layers_that_the_far_end_sets_in_motion_are_not_reached_by_the_shock(self):
        # From the middle on they move faster than the mean of both ends: all at once.
        times, places, v = crushed_at_both_ends(0.6 * V, 0.5 * U, since=0.5 * H / U)
        front = shock.front(times, places, v)
        self.assertAlmostEqual(front.speed / U, 1, 3)
        self.assertEqual(front.jump_of_velocity, V)
        self.assertLess(front.ahead.places[-1], 0.5 * H)

    def test_a_bar_that_is_crushed_evenly_has_no_front(self):
        even = np.outer(np.ones(len(TIMES)), V * (1 - LAYERS / H))
        self.assertIsNone(shock.front(TIMES, LAYERS + even * TIMES[:, None], even))


DECK = """<ParameterList>
  <!-- <Parameter name="Input Mesh File" value="no.g"/> -->
  <ParameterList name="Discretization"><Parameter name="Type" type="string" value="Exodus"/>
    <Parameter name="Input Mesh File" type="string" value="block.g"/></ParameterList>
  <ParameterList name="Materials"><ParameterList name="stuff">
    <Parameter name="Density" type="double" value="4000"/></ParameterList></ParameterList>
  <ParameterList name="Blocks"><ParameterList name="one"><Parameter name="Block Names" type="string" value="all"/>
    <Parameter name="Material" type="string" value="stuff"/></ParameterList></ParameterList>
  <ParameterList name="Boundary Conditions"><ParameterList name="top">
    <Parameter name="Type" type="string" value="Prescribed Displacement"/>
    <Parameter name="Coordinate" type="string" value="z"/>
    <Parameter name="Value" type="string" value="-1e-2*t"/></ParameterList></ParameterList>
  <ParameterList name="History"><Parameter name="Filename" type="string" value="block.csv"/></ParameterList>
</ParameterList>
"""
RECIPE = "shape = foam   # a comment\nsize = 5e-3 8e-3 20e-3\nrelative_density = 0.1\nspacing=1e-3\n"


class Runs(InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "block.xml").write_text(DECK)
        (self.folder / "block.recipe").write_text(RECIPE)

    def curve(self, *words):
        return self.run_tool("curve", *words)

    def history(self, columns, cut="", units=()):
        rows = [list(columns), *np.array(list(columns.values())).T.tolist()]
        lines = ["# strut 0.1" + ("; units: " + ",".join(units) if units else ""), *(",".join(map(str, row)) for row in rows)]
        (self.folder / "block.csv").write_text("\n".join(lines) + "\n" + cut)

    def table(self, name):
        with open(self.folder / name, newline="") as file:
            return list(csv.reader(file))

    def made(self, *words):
        done = self.curve(*words)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return {row[0]: float(row[1]) for row in self.table("block-measures.csv")[1:] if row[1]}

    def error(self, *words):
        """One line, and no trace of Python."""
        done = self.curve(*words)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_a_slow_crush_by_its_deck_while_it_is_running(self):
        force = 4e-5 * stress_at(STRAIN)
        self.history({"Time": STRAIN * 20e-3 / 1e-2, "Reaction_Z(top)": -force, "Reaction_Z(bottom)": force}, "1.25,-3")
        found = self.made("block.xml")
        # Nine digits in the file.
        self.assertAlmostEqual(found["plateau_stress"] / YIELD, 1, 8)
        self.assertAlmostEqual(found["plateau_end"], DENSE + 0.3 * YIELD / K, 8)
        rows = self.table("block-curve.csv")
        self.assertEqual(rows[0], ["Time (s)", "Strain (1)", "Stress (Pa) of Reaction_Z(top)",
                                   "Stress (Pa) of Reaction_Z(bottom)", "Energy (J/m3)"])
        self.assertEqual(len(rows), 1 + len(STRAIN))
        self.assertGreater((self.folder / "block-curve.png").stat().st_size, 10000)

    def test_a_plate_that_returns_shortens_over_the_foot_that_is_held(self):
        fixed = """<Parameter name="Type" type="string" value="Prescribed Displacement"/>
          <Parameter name="Coordinate" type="string" value="z"/><Parameter name="Value" type="string" value="%s"/></ParameterList>"""
        top = '<ParameterList name="top">'
        held = f'<ParameterList name="foot">{fixed % 0}<ParameterList name="rim">{fixed % "1e-9*t"}'
        returns = DECK.replace("-1e-2*t", "-1e-2*t*(1-t)").replace(top, held + top)
        (self.folder / "block.xml").write_text(returns.replace('value="all"', 'value="default"'))  # the density, too
        times = np.linspace(0, 1, 11)
        self.history({"Time": times, "Reaction_Z(top)": -times, "Reaction_Z(foot)": times})
        self.made("block.xml")
        strain = [float(row[1]) for row in self.table("block-curve.csv")[1:]]
        np.testing.assert_allclose(strain, 0.5 * times * (1 - times), atol=1e-7)  # of 20 mm; the rim moves by 1e-9 m
        self.assertEqual(samples.material_density(Deck(str(self.folder / "block.xml")), "foam"), 4000)

    def test_the_density_of_several_blocks_is_their_mass_over_the_volume(self):
        volumes = {"low": np.full(27, 1e-9), "high": np.full(9, 1e-9), "empty": np.zeros(0)}
        blocks = [SimpleNamespace(name=n, nodes=np.arange(len(v)), volumes=v) for n, v in volumes.items()]
        result = SimpleNamespace(path="o.e", blocks=blocks, blocks_of=lambda names: [b for b in blocks if not names or b.name in names])
        section = '<ParameterList name="one"><Parameter name="Block Names" type="string" value="%s"/>'
        material = '<ParameterList name="stuff">\n    <Parameter name="Density" type="double" value="%s"/></ParameterList>'
        other = section.replace("one", "two") % "high" + '<Parameter name="Material" type="string" value="heavy"/></ParameterList>'
        deck = DECK.replace(section % "all", other + section % "low").replace(
            material % 4000, material % 1000 + (material % 3000).replace("stuff", "heavy"))
        (self.folder / "block.xml").write_text(deck)
        for block, expected in ((None, (27 * 1000 + 9 * 3000) / 36), ("low", 27 / 36 * 1000), ("high", 9 / 36 * 3000)):
            found = samples.density_of_points(Deck(str(self.folder / "block.xml")), result, block, 36e-9, {})
            self.assertAlmostEqual(found, expected, 9, msg=block)
        (self.folder / "block.xml").write_text(deck.replace('"high"', '"top"'))
        how = {}
        self.assertIsNone(samples.density_of_points(Deck(str(self.folder / "block.xml")), result, None, 36e-9, how))
        self.assertEqual(how, {"density": f"nowhere: {self.folder}/block.xml has none for block 'high'"})

    def test_a_prescribed_velocity_shortens_by_its_integral_since_the_start_of_the_run(self):
        deck = DECK.replace("Prescribed Displacement", "Prescribed Velocity").replace("-1e-2*t", "-1e-2*(t &lt; 0.51)")
        side = ('<ParameterList name="side"><Parameter name="Type" type="string" value="Prescribed Velocity"/><Parameter name="Coordinate" '
                'type="string" value="z"/><Parameter name="Value" type="string" value="x"/></ParameterList><ParameterList name="top">')
        (self.folder / "block.xml").write_text(deck.replace('<ParameterList name="top">', side))
        for times in np.linspace(0, 1, 11), np.linspace(0.2, 1, 5):  # the second history lacks the run's beginning
            self.history({"Time": times, "Reaction_Z(top)": -times, "Reaction_Z(bottom)": times})
            done = self.curve("block.xml")
            self.assertIn("`top`; left out: `side`, not a number of the time alone\n", done.stdout)
            self.assertEqual("begins at t = 0.2 s, later than the run, at 0 s" in done.stdout, times[0] > 0)
            np.testing.assert_allclose([float(row[1]) for row in self.table("block-curve.csv")[1:]], 0.5 * np.minimum(times, 0.51), atol=1e-9)

    def test_where_a_tool_stands_at_the_start_is_no_strain(self):
        tool = DECK.replace("Prescribed Displacement", "Rigid Plane").replace('"Value"', '"Travel Z"')
        times = np.linspace(0, 1, 11)
        self.history({"Time": times, "Reaction_Z(top)": -times, "Reaction_Z(bottom)": times})
        # A run from the state of another one goes on with its strain.
        for begin, expected in (("", 0.5 * times), ('<ParameterList name="Start From"/>', 0.1 + 0.5 * times)):
            deck = tool.replace("-1e-2*t", "-2e-3-1e-2*t").replace('<ParameterList name="History">', f'{begin}<ParameterList name="History">')
            (self.folder / "block.xml").write_text(deck)
            self.assertEqual("by Start From, is not counted" in self.curve("block.xml").stdout, bool(begin))
            np.testing.assert_allclose([float(row[1]) for row in self.table("block-curve.csv")[1:]], expected, atol=1e-9)

    def test_a_history_of_another_deck_is_told_by_its_checkpoint_else_by_its_age(self):
        self.history({"Time": STRAIN, "Reaction_Z(top)": stress_at(STRAIN)})
        history = (self.folder / "block.csv").stat().st_mtime

        def told(later, deck=DECK, checkpoint=None):
            (self.folder / "block.xml").write_text(deck)
            os.utime(self.folder / "block.xml", (history, history + later))
            if checkpoint is not None:
                netCDF4.Dataset(self.folder / "block.restart", "w").deck = DECK
                os.utime(self.folder / "block.restart", (history, history + checkpoint))
            return "".join(line for line in self.curve("block.xml").stdout.splitlines() if line.startswith("history"))
        self.assertEqual(told(-1), "")
        self.assertIn("WARNING: older than block.xml, if changed since: ", told(1))
        self.assertEqual(told(1, checkpoint=0), "")
        for later in (-1, 1):
            self.assertIn("WARNING: block.xml has been changed since the run, in Boundary Conditions: ", told(later, DECK.replace("-1e-2", "-2e-2")))
        self.assertEqual(told(-1, DECK.replace('name="History">', 'name="History"><Parameter name="Interval" type="double" value="1"/>')), "")
        self.assertIn("older than", told(1, checkpoint=-10))  # the checkpoint is of a run before
        netCDF4.Dataset(self.folder / "other.restart", "w").deck = DECK.replace("-1e-2", "-3e-2")  # ran later, with the same history
        self.assertIn("WARNING: of the run that left ./other.restart, whose deck differs in Boundary Conditions: ", told(-1))
        netCDF4.Dataset(self.folder / "other.restart", "w").deck = DECK.replace("-1e-2", "-3e-2").replace("block.csv", "other.csv")
        self.assertEqual(told(-1), "")

    def test_a_table_of_ones_own_needs_no_comment(self):
        for comments in ("", "# mine\n", "# mine\n# of today\n"):
            (self.folder / "own.csv").write_text(comments + "Time,F\n0,0\n1,10\n2,20\n")
            done = self.curve("own.csv", "--force", "F", "--shortening", "1e-2*t", "--area", 1, "--height", 1)
            self.assertEqual((done.returncode, done.stderr), (0, ""), comments)

    def test_the_first_value_of_a_displacement_of_peridigm_is_no_strain(self):
        times = np.linspace(0, 1, 11)
        self.history({"Time": times, "Reaction_Z(top)": -times, "Reaction_Z(bottom)": times})
        deck = DECK.replace("-1e-2*t", "-2e-3-1e-2*t")
        for root, begin, first in (("", "", 0.1), (' name="Peridigm"', "", 0), (' name="Peridigm"', '<ParameterList name="Start From"/>', 0.1)):
            (self.folder / "block.xml").write_text(deck.replace("<ParameterList>", f"<ParameterList{root}>{begin}", 1))
            self.made("block.xml")
            np.testing.assert_allclose([float(row[1]) for row in self.table("block-curve.csv")[1:]], first + 0.5 * times, atol=1e-9)

    def test_the_way_of_a_tool_to_the_body_is_no_strain(self):
        corners = np.array([(x, y, z) for z in (0, 8e-3) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float)
        exodus.write_mesh(str(self.folder / "block.g"), corners, [("bar", "HEX8", np.arange(8)[None], None)], {})
        times = np.linspace(0, 1, 11)
        self.history({"Time": times, "Reaction_Z(top)": -times, "Reaction_Z(bottom)": times})
        key = '<Parameter name="%s" type="string" value="%s"/>'
        deck = DECK.replace('"Value"', '"Travel Z"')

        def curve(kind, travel, *places, form="0 0 %s"):
            keys = "".join(key % (name, form % number) for name, number in places)
            text = deck.replace("Prescribed Displacement", kind).replace("-1e-2*t", travel).replace(key % ("Coordinate", "z"), keys)
            (self.folder / "block.xml").write_text(text)
            done = self.curve("block.xml", "--height", "8e-3", "--area", "1")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            return done.stdout, [8 * float(row[1]) for row in self.table("block-curve.csv")[1:]]

        plane = "Rigid Plane"
        for words in ((plane, "-2e-3*t", ("Point", 9e-3), ("Normal", -1)), (plane, "1e-3-2e-3*t", ("Point", 8e-3), ("Normal", -2)),
                      (plane, "2e-3*t", ("Point", -1e-3), ("Normal", 1)),
                      ("Rigid Box", "-2e-3*t", ("Lower Corner", 9e-3), ("Upper Corner", 1))):
            said, way = curve(*words)
            np.testing.assert_allclose(way, np.maximum(2 * times - 1, 0), atol=1e-8)  # nine digits in the file
            self.assertIn("`top` less 0.001 m, by which it stands apart", said)
        for form in ("{0, 0, %s}", "0, 0, %s"):  # lists of YAML and Python, and with commas
            self.assertIn("less 0.001 m", curve(plane, "-2e-3*t", ("Point", 9e-3), ("Normal", -1), form=form)[0])
        for place in (8e-3, 7e-3):  # where bodies are taken as cut off
            said, way = curve(plane, "-2e-3*t", ("Point", place), ("Normal", -1))
            np.testing.assert_allclose(way, 2 * times, atol=1e-8)
            self.assertNotIn("stands apart", said)
        self.assertIn("(a gap there counts as strain)", curve("Rigid Cylinder", "-2e-3*t")[0])

    def test_the_blow_of_the_first_step_does_not_count(self):
        force = 4e-5 * stress_at(STRAIN)
        columns = {"Time": STRAIN * 20e-3 / 1e-2, "Reaction_Z(top)": -force, "Reaction_Z(bottom)": force}
        self.history(columns)
        expected = self.made("block.xml")
        blow = -force
        blow[0] = -300 * force.max()
        self.history({**columns, "Reaction_Z(top)": blow})
        self.assertEqual(self.made("block.xml"), expected)
        self.assertIn("first force        left out", self.curve("block.xml").stdout)
        # In means since the row before it is in the first of them.
        means, blow = np.concatenate([[0], 0.5 * (force[1:] + force[:-1])]), np.zeros(len(force))
        units = ("s", "N (mean)", "N (mean)")
        columns = {"Time": columns["Time"], "Reaction_Z(top)": -means, "Reaction_Z(bottom)": means}
        self.history(columns, units=units)
        expected = self.made("block.xml")
        blow[1] = -2 * force.max()
        self.history({**columns, "Reaction_Z(top)": blow - means}, units=units)
        found = self.made("block.xml")
        for name in ("largest_stress", "plateau_stress", "plateau_end"):
            self.assertEqual(found[name], expected[name], name)

    def test_means_since_the_row_before_belong_to_the_middle_between(self):
        times = np.linspace(0, 1.2, 13)  # s; at 1e-2 m/s of 20 mm to 60 %, with a stress of 1 Pa a second
        columns = {"Time": times, "Reaction_Z(top)": 4e-5 * 1e6 * np.maximum(times - 0.05, 0)}
        self.history(columns, units=("s", "N (mean)"))
        self.made("block.xml")
        t, strain, stress = np.array(self.table("block-curve.csv")[1:], float).T[:3]
        np.testing.assert_allclose(stress, 1e6 * t, atol=1e-2)
        np.testing.assert_allclose(strain, 0.5 * t, atol=1e-9)
        self.history(columns, units=("s", "N"))
        self.made("block.xml")
        np.testing.assert_allclose(np.array(self.table("block-curve.csv")[1:], float)[:, 0], times, atol=1e-9)

    def test_periodic_sides_shorten_by_their_stretch(self):
        """By 60 % in 1.2 s; the mean over all points, which stand between the sides, is half of that."""
        sides = {"Type": "Periodic Sides", "Coordinate": "z", "Lower": "0", "Upper": "20e-3", "Stretch": "1 - 0.5*t"}
        keys = "".join(f'<Parameter name="{name}" type="string" value="{value}"/>' for name, value in sides.items())
        begin, end = DECK.index('<ParameterList name="top">'), DECK.index('<ParameterList name="History">')
        (self.folder / "block.xml").write_text(f'{DECK[:begin]}<ParameterList name="sides">{keys}</ParameterList></ParameterList>{DECK[end:]}')
        times = np.linspace(0, 1.2, 13)
        self.history({"Time": times, "Reaction_Z(sides)": -4e-5 * 1e6 * times, "Mean_Displacement_Z(foam)": -5e-3 * times})
        self.made("block.xml")
        t, strain, stress = np.array(self.table("block-curve.csv")[1:], float).T[:3]
        np.testing.assert_allclose(strain, 0.5 * t, atol=1e-9)  # nine digits are written
        np.testing.assert_allclose(stress, 1e6 * t, rtol=1e-8)

    def test_numbers_of_a_material_need_both_ends(self):
        force = 4e-5 * stress_at(STRAIN)
        columns = {"Time": STRAIN * 20e-3 / 1e-2, "Reaction_Z(top)": -force}
        self.history({**columns, "Reaction_Z(bottom)": 0.97 * force})
        found = self.made("block.xml")
        self.assertAlmostEqual(found["mean_stress_other_end"] / found["plateau_stress"], 0.97, 8)
        self.assertAlmostEqual(found["ends_apart"], 0.03 / 0.985, 8)  # nine digits in the file
        # In an impact the far end bears two thirds of the force.
        self.history({**columns, "Reaction_Z(bottom)": 2 / 3 * force})
        done = self.curve("block.xml")
        found = {row[0]: row[1] for row in self.table("block-measures.csv")[1:]}
        for name in ("quasi_elastic_gradient", "offset_stress", "plateau_stress", "plateau_stress_20_40", "plateau_end",
                     "absorbed_energy", "densification_strain"):
            self.assertEqual(found[name], "", name)
        self.assertEqual(done.stdout.count("both ends differ by 40 % there, more than 5 %: no equilibrium"), done.stdout.count("no equilibrium"))
        self.assertAlmostEqual(float(found["mean_stress"]) / YIELD, 1, 8)
        self.assertAlmostEqual(float(found["mean_stress_other_end"]) / YIELD, 2 / 3, 8)
        self.assertAlmostEqual(float(found["ends_apart"]), 0.4, 8)
        self.assertAlmostEqual(float(found["densification_of_ends"]), DENSE, 8)  # of a curve of the same form
        self.history(columns)
        done = self.curve("block.xml")
        self.assertIn("both ends          not known: the history has the force at one end only", done.stdout)
        self.assertAlmostEqual(self.made("block.xml")["plateau_stress"] / YIELD, 1, 8)

    def test_the_other_end_counts_whichever_force_is_named(self):
        force = 4e-5 * stress_at(STRAIN)
        columns = {"Time": STRAIN * 20e-3 / 1e-2, "Reaction_Z(top)": -force, "Reaction_X(side)": 9 * force}
        self.history({**columns, "Instant_Reaction_Z(top)": -force, "Reaction_Z(bottom)": 2 / 3 * force})
        top, bottom = ("--force", "Reaction_Z(top)"), ("--other", "Reaction_Z(bottom)")
        for words in ((), top, bottom, (*top, *bottom)):
            done = self.curve("block.xml", *words)
            self.assertRegex(done.stdout, r"(?m)^force +Reaction_Z\(top\)\nother end +Reaction_Z\(bottom\)\n")
            self.assertRegex(done.stdout, r"plateau_stress +- Pa .* both ends differ by 40 %")
        self.history({**columns, "Reaction_Z(wall)": force, "Reaction_Z(bottom)": 2 / 3 * force})
        self.assertIn("Reaction_Z(wall) (the next of the history; --other names another one: Reaction_Z(bottom))", self.curve("block.xml").stdout)
        self.history({**columns, "Instant_Reaction_Z(top)": -force, "Reaction_Z(bottom)": 2 / 3 * force})
        done = self.curve("block.xml", "--force", "Reaction_Z(bottom)")
        self.assertRegex(done.stdout, r"(?m)^force +Reaction_Z\(bottom\)\nother end +Reaction_Z\(top\)\n")
        self.history({**columns, "Instant_Reaction_Z(top)": -force})
        for words in ((), top):
            self.assertIn("the history has the force at one end only", self.curve("block.xml", *words).stdout)

    def test_an_impact_by_its_layers(self):
        places, velocities = shocked(TIMES)
        columns = {"Time": TIMES}
        for k in range(20):
            columns[f"Mean_Velocity_Z(cuts {k + 1})"] = velocities[:, k]
            columns[f"Mean_Coordinate_Z(cuts {k + 1})"] = places[:, k]
        columns["Reaction_Z(piston)"] = np.full(len(TIMES), 4e-5 * (1e6 + RHO * U * V))
        columns["Reaction_Z(rear)"] = np.full(len(TIMES), -4e-5 * 1e6)
        self.history(columns)
        found = self.made("block.xml", "--shortening", f"{V}*t")
        self.assertLessEqual(set(shock.MEASURES), set(found))  # that a study can ask for
        self.assertAlmostEqual(found["shock_stress"] / (RHO * U * V), 1, 2)  # by the speed, to half a row in 400
        self.assertAlmostEqual(found["stress_jump"] / (RHO * U * V), 1, 8)
        self.assertAlmostEqual(found["strain_behind"], V / U, 8)
        self.assertGreater(len(self.table("block-front.csv")), 15)
        given = ("--area", 4e-5, "--height", H, "--density", RHO)
        other = self.made("block.csv", *given)  # by the distance of the outer layers, which a shock shortens to the same
        self.assertAlmostEqual(other["largest_strain"], 0.95 * V / U, delta=0.06)  # half a layer at each end

    def test_files_that_are_not_its_own_stay(self):
        self.history({"Time": STRAIN, "Reaction_Z(top)": stress_at(STRAIN)})
        for name in ("block-curve.csv", "block-measures.csv", "block-curve.png"):
            mine = self.folder / name
            mine.write_text("strain,measured by me\n")
            self.assertIn(f"{name} is there and was not written by this tool", self.error("block.xml"))
            self.assertEqual(mine.read_text(), "strain,measured by me\n")
            mine.unlink()
        for _ in range(2):  # its own are replaced
            self.made("block.xml")

    def test_a_history_that_ends_early_is_told(self):
        columns = {"Time": STRAIN, "Reaction_Z(top)": stress_at(STRAIN)}
        solver = '<ParameterList name="Solver"><Parameter name="Final Time" type="double" value="{}"/></ParameterList></ParameterList>\n'
        for end, cut, said in ((2 * STRAIN[-1], "", f"ends at t = {STRAIN[-1]:g} s, 50 % of the run to {2 * STRAIN[-1]:g} s"),
                               (STRAIN[-1], "0.9,1", "its last row is not whole, and left out"), (STRAIN[-1], "", "")):
            (self.folder / "block.xml").write_text(DECK.rpartition("</ParameterList>")[0] + solver.format(end))
            self.history(columns, cut)
            told = [line for line in self.curve("block.xml").stdout.splitlines() if line.startswith("history")]
            self.assertEqual([said in line for line in told], [True] if said else [])

    def test_errors_are_one_line_that_helps(self):
        columns = {"Time": STRAIN, "Reaction_Z(top)": stress_at(STRAIN)}
        self.assertIn("block.csv does not exist: --results names", self.error("block.xml"))
        self.history({"Time": STRAIN, "Max_Displacement": STRAIN})
        self.assertIn("has no force along z: add e.g. Reaction_Z(top)", self.error("block.xml"))
        self.history(columns)
        self.assertIn("the folder block.csv cannot be made: a file has its name", self.error("block.xml", "block.csv"))
        self.assertIn("no column 'Reaction_Z(tp)' in the history (did you mean 'Reaction_Z(top)'?)",
                      self.error("block.xml", "--force", "Reaction_Z(tp)"))
        self.assertIn("name --area (m2) and --height (m)", self.error("block.csv"))
        self.assertIn("nothing says how far the sample is shortened", self.error("block.csv", "--area", 1, "--height", 1))
        (self.folder / "block.xml").write_text(DECK.replace("-1e-2*t", "0"))  # a rim that is held is no motion of the sample
        self.assertIn("of a body that flies onto another one layers", self.error("block.xml"))
        (self.folder / "block.xml").write_text(DECK)
        self.assertIn("--area: expected 1 number > 0, found '0'", self.error("block.xml", "--area", 0))
        self.assertIn("unknown option '--heigt' (did you mean '--height'?)", self.error("block.xml", "--heigt", 1))
        whole = ("block.csv", "--area", 1, "--height", 1, "--shortening")
        self.assertIn("is shortened by 2.4 times its height of 1 m", self.error(*whole, "4*t"))
        self.assertIn("are one column, 'Reaction_Z(top)'", self.error(*whole, "t", "--force", "Reaction_Z(top)", "--other", "Reaction_Z(top)"))
        self.history({"Time": STRAIN, "Reaction_Z(top)": np.where(STRAIN > 0.3, np.nan, 1)})
        self.assertIn("the column 'Reaction_Z(top)' of the history is no number at t = 0.3001 s", self.error(*whole, "t"))
        self.history({"Time": np.minimum(STRAIN, 0.2), "Reaction_Z(top)": STRAIN})
        self.assertIn("its times do not rise from row to row, from 0.2 to 0.2 s", self.error(*whole, "t"))
        for text, words in (("Time,A,A\n0,1,2\n1,2,3\n", "has two columns 'A'"), ("Time,A\n0,1\n1,2,3\n2,3\n", "line 3 has 3 values, expected 2")):
            (self.folder / "block.csv").write_text(text)
            self.assertIn(words, self.error(*whole, "t"))
        (self.folder / "block.xml").write_text(DECK.replace("History", "Histry"))
        self.assertIn("has no history", self.error("block.xml"))
        (self.folder / "block.xml").write_bytes(DECK.replace("no.g", "é.g").encode("latin-1"))
        self.assertIn("block.xml is not in UTF-8: line 2 has the byte 0xe9", self.error("block.xml"))


class Decks(unittest.TestCase):
    def test_keys_are_changed_where_they_stand(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.xml"
            path.write_text(DECK)
            changed = Deck(str(path)).with_value("Boundary Conditions > top > Value", "-2*t")
            self.assertEqual(tree.canonicalize(changed.text), tree.canonicalize(DECK.replace("-1e-2*t", "-2*t")))
            (pathlib.Path(folder) / "a.recipe").write_text("spacing = 1\n[body]\nname = a\nsize = 1 2 3 # m\n[body]\nname = b\nsize = 4 5 6\n")
            recipe = Recipe(str(pathlib.Path(folder) / "a.recipe"))
            self.assertEqual(recipe.changed("a.size", "7 8 9"), recipe.text.replace("1 2 3", "7 8 9"))
            self.assertEqual(recipe.changed("spacing", "2"), recipe.text.replace("spacing = 1", "spacing = 2"))


if __name__ == "__main__":
    unittest.main()
