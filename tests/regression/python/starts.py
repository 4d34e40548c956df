#!/usr/bin/python3
"""Runs that start from the checkpoint of another run (Start From): with the same deck they go on as if that run had not
ended, equilibria and then steps are those of one deck with two solvers, and what cannot be is refused by name."""
import os
import pathlib
import subprocess
import sys
import unittest
import warnings

import block
import netCDF4
import numpy as np
import strut
from block import SPACING, InFolder

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "checkpoint"))
import restarts  # noqa: E402  its scenes: no two points alike, contact, friction, substeps, viscosity, breaking bonds

FIELDS = ("Displacement", "Velocity", "Cauchy_Stress", "Deformation_Gradient")
# These columns count work, J, from the start of the run.
OF_WORK = ("Tool_Work", "Contact_Work", "External_Work", "Balance_Error")


def scene(name):
    """The deck of a scene, without files but its mesh."""
    restarts.points("points.txt", name)
    pathlib.Path("scene.xml").write_text(restarts.section(name, *restarts.SCENES[name]()).replace(f' name="{name}"', "", 1))
    deck = strut.Deck("scene.xml")
    del deck["Output"], deck["History"]["Filename"]
    deck["History"]["Frequency"] = 1
    return deck


def but(deck, **sections):
    """The deck with other sections, which stay as they were there, and with keys of sections."""
    return strut.Deck({**deck, **{name.replace("_", " "): value for name, value in sections.items()}}, deck.name)


def start(deck, checkpoint, time=0.0, keep_velocities=None, **sections):
    """The deck of a run that starts from there."""
    state = {"Checkpoint": checkpoint, "Keep Velocities": keep_velocities}
    return but(deck, **{"Solver": {**deck["Solver"], "Initial Time": time}, "Start From": state,
                        **{name.replace("_", " "): value for name, value in sections.items()}})


def expanding(temperature, **sections):
    """A deck of a metal, one of cells and one of an ordinary solid, whose points have this temperature; None: nothing heats them."""
    warmth = {"warmth": {"Type": "Prescribed Temperature", "Node Set": "all", "Value": temperature}} if temperature else {}
    metal = {**block.deck()["Materials"]["metal"], "Thermal Expansion Coefficient": 2e-5}
    decks = {}
    for name, more in {"metal": {}, "cells": {"Formulation": "Quadratic Correspondence"},
                       "ordinary": {"Material Model": "Elastic", "Yield Stress": None}}.items():
        deck = but(block.deck(Materials={"metal": {**metal, **more}}), **sections)
        decks[name] = but(deck, Boundary_Conditions={**deck["Boundary Conditions"], **warmth})
    return decks


def run_on(ranks, *words):
    """The program on this number of ranks. This process, a job of MPI by itself, has told its environment so."""
    outside = {k: v for k, v in os.environ.items() if not k.startswith(("PMI", "OMPI_")) or "ALLOW" in k}
    command = [*os.environ["STRUT_MPIRUN"].split(), "-n", str(ranks), os.environ["STRUT"], *words]
    return subprocess.run(command, capture_output=True, text=True, env=outside, timeout=100)


def ended(deck, steps, mesh=None, name="first.restart"):
    """A run that is ended early, with a checkpoint."""
    run = strut.Run(but(deck, Restart={"Filename": name}), mesh)
    run.advance(steps=steps)
    run.end()
    return run


class Starts(InFolder):
    def setUp(self):
        super().setUp()
        warnings.simplefilter("ignore")

    def assertGoesOn(self, whole, run, tolerance=0):
        """Fields at the end, and rows of the history, to a part of the largest value."""
        for name in FIELDS:
            if name not in whole.fields:
                continue
            one, other = (each.whole(name) for each in (whole, run))
            self.assertLessEqual(np.abs(one - other).max(), tolerance * np.abs(one).max(), name)
        times = whole.history["Time"]
        mine = np.isin(run.history["Time"], times)
        mine[0] = False  # reactions are means since the row before
        rows = np.searchsorted(times, run.history["Time"][mine])
        self.assertGreater(len(rows), 2)
        for name, column in whole.history.items():
            if name in OF_WORK:
                continue
            scale = max(np.abs(column).max(), 1e-300)
            self.assertLessEqual(np.abs(column[rows] - run.history[name][mine]).max() / scale, tolerance, name)

    def goes_on(self, deck, steps, mesh=None, tolerance=0, **sections):
        whole = strut.run(deck, mesh)
        first = ended(deck, steps, mesh)
        run = strut.run(start(deck, "first.restart", first.time, **sections), mesh)
        self.assertIn("goes on with its steps", run.log)
        for column in ("External_Work", "Tool_Work"):
            self.assertEqual(run.history[column][0], 0, column)
        self.assertGoesOn(whole, run, tolerance)
        return run

    def test_steps_go_on_with_the_same_bits(self):
        for name in ("impact", "cells", "breaking", "tearing", "cracking"):
            with self.subTest(name):
                self.goes_on(scene(name), 40)

    def test_load_steps_go_on_to_the_same_equilibria(self):
        """Of as many load steps: their lengths differ by round-off, which Newton's last iterations take up."""
        for name in ("press", "rubbing"):
            with self.subTest(name):
                deck = scene(name)
                load_steps = deck["Solver"]["QuasiStatic"]
                half = load_steps["Number of Load Steps"] // 2
                left = {**deck["Solver"], "QuasiStatic": {**load_steps, "Number of Load Steps": half}}
                whole = strut.run(deck)
                first = ended(deck, half)
                self.assertEqual(first.steps, half)
                run = strut.run(start(but(deck, Solver=left), "first.restart", first.time))
                self.assertGoesOn(whole, run, 1e-9)

    def test_other_steps_begin_with_the_velocities_there(self):
        """At the mid-step before; the change within half a step is a part of that of a whole step. Tools and ends held points."""
        top = {"Type": "Rigid Plane", "Point": [0, 0, 8 * SPACING], "Normal": [0, 0, -1]}
        push = {"Type": "Prescribed Velocity", "Node Set": "block_zmax", "Coordinate": "z", "Value": "-4e6*t"}
        end = {"Type": "Non-Reflecting End", "Node Set": "block_zmin", "Normal": [0, 0, -1]}
        fly = {"Type": "Initial Velocity", "Coordinate": "z", "Value": 20.0}
        for name, conditions in {"tool": {"top": {**top, "Travel Z": "-2e6*t*t"}}, "light tool": {"top": {**top, "Mass": 1e-4, "Speed Z": -20.0}},
                                 "end": {"push": push, "end": end}, "flight": {"fly": fly, "top": {**top, "Travel Z": "-20*t"}}}.items():
            with self.subTest(name):
                deck = but(block.deck(Solver={"Final Time": 1e-5}, History={"Frequency": 1}), Boundary_Conditions=conditions)
                first = ended(deck, 30, block.mesh())
                before = first.whole("Velocity")
                other = {**deck["Solver"], "Verlet": {"Safety Factor": 0.7}}
                run = strut.Run(start(but(deck, Solver=other), "first.restart", first.time), block.mesh())
                run.advance(steps=0)
                self.assertIn("with its velocities;", run.log)
                self.assertLess(np.abs(run.whole("Velocity") - before).max(), 1e-12 * np.abs(before).max())

    def test_sets_of_other_points_under_the_same_names_are_other_conditions(self):
        """Sets by numbers, of files beside the deck, which is the same; so are those of a mesh."""
        solid = {"Material Model": "Elastic", "Density": 2700.0, "Young's Modulus": 70e9, "Poisson's Ratio": 0.25}
        deck = block.deck(Materials={"metal": solid}, Solver={"Final Time": 2e-6}, History={"Frequency": 1})
        foot = deck["Boundary Conditions"]["foot"]
        pull = {"Type": "Prescribed Displacement", "Node Set": "Node Set P", "Coordinate": "x", "Value": "5*t"}
        push = {**pull, "Type": "Prescribed Velocity"}
        down = {"Type": "Initial Displacement", "Node Set": "all", "Coordinate": "z", "Value": 0.0}
        for name, moves, error in (("pull", {"pull": pull}, "pull > Value: .* displaced otherwise"), ("push", {"push": push}, ""),
                                   ("down", {"push": push, "down": down}, "'Initial Displacement' has no meaning")):
            with self.subTest(name):
                numbers = pathlib.Path("some.txt")
                numbers.write_text("150 151")
                deck = but(deck, Boundary_Conditions={"Node Set P": "some.txt", "foot": foot, **moves})
                first = ended(deck, 12, block.mesh())
                second = start(deck, "first.restart", first.time)
                self.assertNotIn("begin anew", strut.Run(second, block.mesh()).log)
                numbers.write_text("150 152")
                if error:
                    with self.assertRaisesRegex(strut.Error, error):
                        strut.Run(second, block.mesh())
                else:
                    log = strut.Run(second, block.mesh()).log
                    for told in ("goes on with its steps", "node sets hold other points than there; loads begin anew"):
                        self.assertIn(told, log)

    def test_a_motion_that_ends_is_in_the_velocities_that_a_checkpoint_keeps(self):
        push = {"Type": "Prescribed Displacement", "Node Set": "block_zmax", "Coordinate": "z", "Value": "table(t, 0, 0, 4e-6, -8e-5)"}
        deck = but(block.deck(History={"Frequency": 1}), Boundary_Conditions={"push": push}, Restart={"Filename": "first.restart"})
        run = strut.run(deck, block.mesh())
        with netCDF4.Dataset("first.restart") as file:
            kept = np.asarray(file[next(name for name in file.variables if name.endswith("_velocity_now"))][:])
        shown = run.whole("Velocity")
        self.assertLess(np.abs(np.sort(kept.ravel()) - np.sort(shown.ravel())).max(), 1e-9 * np.abs(shown).max())

    def test_every_body_goes_on_with_the_same_bits(self):
        """Formulations and laws, symmetry planes, periodic sides, mass scaling."""
        metal = block.deck()["Materials"]["metal"]
        rubber = {"Material Model": "Hyperelastic", "Density": 1100.0, "Bulk Modulus": 1e9, "Shear Modulus": 1e6, "C10": 0.4e6,
                  "C01": 0.1e6, "Relaxation": {"Fractions": [0.5], "Times": [1e-5]}}
        hot = {**metal, "Rate": {"Type": "Johnson-Cook", "Reference Rate": 1.0, "Coefficient": 0.02},
               "Hardening": {"Type": "Linear", "Hardening Modulus": 1e9}, "Heating": {"Specific Heat": 900.0},
               "Softening": {"Type": "Johnson-Cook", "Reference Temperature": 293.0, "Melting Temperature": 900.0, "Exponent": 1.0}}
        laws = {"metal": metal, "hot": hot, "rubber": rubber, "elastic": {**metal, "Material Model": "Elastic", "Yield Stress": None},
                "cells": {**hot, "Formulation": "Quadratic Correspondence"}}
        if "STRUT_USER_J2" in os.environ:
            laws["user"] = {**metal, "Material Model": "User Library", "Library": os.environ["STRUT_USER_J2"], "Interface": "UMAT",
                            "Constants": [70e9 / 1.2, 70e9 / 2.6, 200e6, 1e9], "State Variables": 1, "Yield Stress": None}
        plane = {"Type": "Symmetry Plane", "Node Set": "block_xmax", "Point": [4 * SPACING, 0, 0], "Normal": [-1, 0, 0]}
        sides = {"Type": "Periodic Sides", "Coordinate": "y", "Lower": 0.0, "Upper": 5 * SPACING, "Stretch": "1 + 100*t"}
        for name, material in laws.items():
            for images in ({}, {"images": plane}, {"images": sides}):
                with self.subTest(name, images=images):
                    deck = block.deck(Materials={"metal": material})
                    solver = {"rubber": {"Final Time": 2e-5}, "elastic": {"Final Time": 4e-6, "Verlet": {"Mass Scaling dt": 1.3e-7}}}
                    solver = solver.get("" if images and name == "elastic" else name, deck["Solver"])
                    conditions = {**deck["Boundary Conditions"], **images}
                    self.goes_on(but(deck, Boundary_Conditions=conditions, Solver=solver), 12, block.mesh())

    def test_points_that_a_tool_has_pushed_from_where_they_are_held_go_on_with_the_same_bits(self):
        deck = block.deck()
        held = {**deck["Boundary Conditions"]["foot"], "Node Set": "block_xmax", "Coordinate": "x"}
        push = {"Type": "Rigid Plane", "Point": [4 * SPACING, 0, 0], "Normal": [-1, 0, 0], "Travel X": "-10*t"}
        deck = but(deck, Boundary_Conditions={**deck["Boundary Conditions"], "held": held, "push": push})
        run = self.goes_on(deck, 12, block.mesh())
        self.assertLess(run.whole("Displacement")[:, 0].min(), -1e-5)  # 10 m/s in 4e-6 s, less the gap at the start
        other = start(deck, "first.restart", run.history["Time"][0], False)  # at rest: not the steps of the other run
        with self.assertRaisesRegex(strut.Error, "held > Value: 0 m at the initial time.*displaced otherwise"):
            strut.run(other, block.mesh())

    def test_warmed_bodies_go_on_with_the_same_bits(self):
        for name, deck in expanding("293 + 1e8*t*(1 + 100*x)").items():
            with self.subTest(name):
                self.goes_on(deck, 12, block.mesh())

    def test_a_warmed_body_keeps_its_size_where_nothing_heats_it_and_cools_to_its_first(self):
        """T₀ is that of the first run. A free body has no stress."""
        held = {axis: {"Type": "Prescribed Displacement", "Node Set": f"block_{axis}min", "Coordinate": axis, "Value": "0"}
                for axis in "xyz"}
        solver = {"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 2, "Tolerance": 1e-8}}
        here = dict(Boundary_Conditions=held, History={"Frequency": 1}, Solver=solver)
        warmed, left, cooled = (expanding(value, **here) for value in ("293 + 500*t", None, "793 - 500*t"))
        for name, deck in warmed.items():
            with self.subTest(name):
                grown = strut.run(but(deck, Restart={"Filename": "first.restart"}), block.mesh()).whole("Displacement")
                self.assertAlmostEqual(np.abs(grown).max(), 0.01 * 7 * SPACING, delta=1e-6 * SPACING)
                for second, expected in ((left[name], grown), (cooled[name], 0 * grown)):
                    run = strut.run(start(second, "first.restart"), block.mesh())
                    # The forces that are left, 1e-8 of those of a held body, act most on the softest motions.
                    self.assertLess(np.abs(run.whole("Displacement") - expected).max(), 1e-5 * 0.01 * 7 * SPACING)
                    self.assertLess(np.abs(run.whole("Cauchy_Stress")).max(), 1e-5 * 0.01 * 70e9)

    def test_temperatures_that_are_not_those_of_the_checkpoint_are_told(self):
        ended(expanding("293 + 1e8*t")["metal"], 12, block.mesh())
        for there, told in (("493 + 1e8*t", False), ("293", True)):
            second = start(expanding(there)["metal"], "first.restart", Solver={"Final Time": 1e-6, "Initial Time": 0.0})
            self.assertEqual("are not those of the checkpoint" in strut.run(second, block.mesh()).log, told, there)

    @unittest.skipUnless("STRUT_MPIRUN" in os.environ, "no mpirun is named")
    def test_on_two_ranks_that_share_the_work_anew_it_goes_on_with_the_same_numbers(self):
        """Bodies with substeps, also of rubber that relaxes, and whose bonds break. Sums over ranks are in another order: 1e-9
        of each column."""
        rubber = {"Material Model": "Hyperelastic", "Density": 1100.0, "Bulk Modulus": 20e9, "Shear Modulus": 4e9,
                  "Formulation": "Quadratic Correspondence", "Relaxation": {"Fractions": [0.5], "Times": [1e-5]}}
        for name, final in (("cells", 1.5e-4), ("rubber", 1.5e-4), ("breaking", 2e-5)):
            with self.subTest(name):
                verlet = {"Safety Factor": 0.1}  # steps so short that another partition pays
                deck = scene("cells" if name == "rubber" else name)
                if name == "rubber":
                    deck["Materials"]["copper"] = rubber
                    del deck["History"]["Variables"]["Max_Equivalent_Plastic_Strain"]
                deck = but(deck, Solver={**deck["Solver"], "Final Time": final, "Verlet": verlet})
                whole = strut.run(deck)
                first = ended(deck, 150)
                history = {**deck["History"], "Filename": "second.csv"}
                second = start(deck, "first.restart", first.time, History=history)
                second["Solver"]["Verlet"] = {**verlet, "Rebalance": 1.0001}
                pathlib.Path("second.xml").write_text(second.to_xml())
                told = run_on(2, "second.xml")
                self.assertEqual(told.returncode, 0, told.stderr)
                told = told.stdout
                self.assertIn("goes on with its steps", told)
                self.assertEqual("spread over the ranks anew" in told, name != "breaking")  # where substeps make work uneven
                last = np.genfromtxt("second.csv", delimiter=",", skip_header=2)[-1]
                for (column, values), there in zip(whole.history.items(), last):
                    if column not in OF_WORK:
                        self.assertLessEqual(abs(values[-1] - there), 1e-9 * np.abs(values).max(), column)

    def test_a_run_that_has_started_so_is_continued_with_the_same_bits(self):
        deck = scene("cells")
        first = ended(deck, 40)
        second = start(deck, "first.restart", first.time, Restart={"Filename": "second.restart"})
        whole = strut.run(second)
        ended(second, 20, name="second.restart")
        os.remove("first.restart")
        self.assertGoesOn(whole, strut.run(second, continued=True))

    def test_a_run_that_has_started_between_sides_that_moved_is_continued_with_the_same_bits(self):
        """The mesh does not fit between the sides at the initial time: they have come nearer by a tenth of forty spacings."""
        mesh = strut.voxels(np.ones((40, 3, 3), bool), SPACING, name="block")
        soft = {"Material Model": "Elastic Correspondence", "Density": 1000.0, "Young's Modulus": 1e9, "Poisson's Ratio": 0.3}
        sides = {"Type": "Periodic Sides", "Coordinate": "x", "Lower": 0.0, "Upper": 40 * SPACING, "Stretch": "1 - 2000*t"}
        flow = {"Type": "Initial Velocity", "Node Set": "all", "Coordinate": "x", "Value": "-2000*x"}
        deck = but(block.deck(Materials={"metal": soft}), Boundary_Conditions={"sides": sides, "flow": flow},
                   Solver={"Final Time": 5e-5}, History={"Frequency": 1})
        first = strut.run(but(deck, Restart={"Filename": "first.restart"}), mesh)
        second = start(but(deck, Solver={"Final Time": 6e-5}), "first.restart", first.time, Restart={"Filename": "second.restart"})
        whole = strut.run(second, mesh)
        ended(second, 3, mesh, "second.restart")
        self.assertGoesOn(whole, strut.run(second, mesh, continued=True))

    def test_tools_that_meet_after_a_run_goes_on_are_told(self):
        """Looked at in every second step: apart in step 100, in a checkpoint of step 101, and meeting before step 102."""
        box = lambda x, **more: {"Type": "Rigid Box", "Lower Corner": [x, 0, 0], "Upper Corner": [x + 1e-3, 1e-3, 1e-3], **more}
        step, speed = 3e-9, 1500
        tools = {"left": box(0.05), "right": box(0.051 + 101.5 * step * speed, **{"Mass": 1e-3, "Speed X": -speed})}
        deck = block.deck(History={"Frequency": 50}, Restart={"Filename": "first.restart"})
        deck = but(deck, Boundary_Conditions={**deck["Boundary Conditions"], **tools}, Solver={"Final Time": 1e-6, "Verlet": {"Fixed dt": step}})
        run = strut.Run(deck, block.mesh())
        run.advance(steps=99)  # it ends two steps later
        run.end()
        self.assertNotIn("'right' pass", run.log)
        self.assertIn("'right' pass through each other", strut.run(deck, block.mesh(), continued=True).log)

    def two_stiffnesses(self):
        """A free bar that vibrates, one end of which is so stiff that its points are subcycled."""
        places = [(x, y, z) for x in range(10) for y in range(4) for z in range(4)]
        rows = [[1e-3 * (n + 0.5) for n in place] + [1 + (place[0] > 7), 1e-9] for place in places]
        np.savetxt("bar.txt", rows, fmt=["%.17g"] * 3 + ["%d", "%.17g"])
        solid = lambda density, modulus: {"Material Model": "Elastic Correspondence", "Density": density,
                                          "Young's Modulus": modulus, "Poisson's Ratio": 0.3}
        of = lambda number, material: {"Block Names": f"block_{number}", "Material": material, "Horizon Factor": 1.75}
        return strut.Deck({
            "Discretization": {"Type": "Text File", "Input Mesh File": "bar.txt"},
            "Materials": {"soft": solid(1200.0, 3e9), "stiff": solid(7800.0, 210e9)},
            "Blocks": {"low": of(1, "soft"), "high": of(2, "stiff")},
            "Boundary Conditions": {"blow": {"Type": "Initial Velocity", "Coordinate": "x", "Value": "3*sin(800*x)"}},
            "Solver": {"Final Time": 2e-5, "Verlet": {"Subcycling": True}},
            "History": {"Frequency": 1, "Variables": {"Max_Displacement": True}},
            "Restart": {"Filename": "first.restart"},
            "Output": {"Output Filename": "bar.e", "Output Frequency": 1, "Output Variables": {"Time_Step_Level": True}}})

    def test_the_first_instant_reaction_has_the_impulses_of_substeps(self):
        foot = {"Type": "Prescribed Displacement", "Node Set": "end", "Coordinate": "xyz", "Value": "0"}
        deck = self.two_stiffnesses()
        deck = but(deck, Boundary_Conditions={**deck["Boundary Conditions"], "foot": foot}, Node_Sets={"end": "x > 9e-3"},
                   History={"Frequency": 1, "Variables": {"Instant_Reaction_X(foot)": True}}, Output=None, Restart=None)
        whole = strut.run(deck)
        first = ended(deck, 20)
        run = strut.run(start(deck, "first.restart", first.time))
        force = lambda run: run.history["Instant_Reaction_X(foot)"][run.history["Time"] == first.time][0]
        self.assertNotEqual(force(whole), 0)
        self.assertEqual(force(run), force(whole))

    def test_a_strained_body_starts_with_substeps(self):
        """Its momentum and its energy stay those of the checkpoint: nothing acts on it."""
        deck = self.two_stiffnesses()
        first = strut.run(deck)
        run = strut.run(start(deck, "first.restart", Boundary_Conditions={}, Restart=None, Output=None))
        self.assertGreater(first.fields["Time_Step_Level"].max(), 0)
        elastic = first.history["Elastic_Energy"][-1]
        self.assertGreater(elastic, 0)
        # The substeps of this coarse bar make an error of 0.07 in both runs; impulses of a step before the first made 0.58.
        worst = lambda run: np.abs(run.history["Balance_Error"]).max()
        self.assertLess(worst(run), worst(first))
        largest = np.sqrt(2 * 1e-9 * (128 * 1200 + 32 * 7800) * elastic)
        self.assertLess(np.ptp(run.history["Momentum_X"]), 1e-9 * largest)

    def test_a_run_goes_on_without_its_substeps(self):
        deck = self.two_stiffnesses()
        ended(deck, 20)
        changed = but(deck, Solver={**deck["Solver"], "Verlet": {"Subcycling": False}})
        run = strut.run(changed, continued=True)
        self.assertEqual(run.fields["Time_Step_Level"].max(), 0)
        without = strut.run(but(changed, Restart=None, Output=None))
        self.assertAlmostEqual(run.history["Step_Size"][-1] / without.history["Step_Size"][-1], 1, delta=0.02)

    def test_a_start_at_another_time_keeps_the_velocities_of_the_steps(self):
        """With a step as long: those at the time of the checkpoint, to which loads have their part, are the mean of both mid-steps."""
        load = {"Type": "Body Force", "Node Set": "all", "Coordinate": "z", "Value": "1e10"}
        blow = {"Type": "Initial Velocity", "Node Set": "block_zmax", "Coordinate": "xz", "Value": "-20"}
        deck = block.deck()
        foot = deck["Boundary Conditions"]["foot"]
        step, end = 1e-7, 4e-6
        deck = but(deck, Boundary_Conditions={"foot": foot, "load": load, "blow": blow}, History={"Frequency": 1},
                   Solver={"Final Time": end, "Verlet": {"Fixed dt": step}})
        whole = strut.run(deck, block.mesh())
        first = ended(deck, 20, block.mesh())
        second = but(deck, Boundary_Conditions={"foot": foot, "weight": load}, Solver={"Final Time": end - first.time, "Verlet": {"Fixed dt": step}})
        run = strut.run(start(second, "first.restart"), block.mesh())
        for field in FIELDS:
            if field in whole.fields:
                one, other = whole.whole(field), run.whole(field)
                self.assertLessEqual(np.abs(one - other).max(), 1e-9 * np.abs(one).max(), field)  # round-off of some steps

    def test_points_that_were_held_start_at_their_speed(self):
        """The forces against which they were held do not move them in the half step to the time of the checkpoint."""
        columns = {"block_zmax": -20, "block_zmin": 0}
        deck = but(block.deck(), History={"Frequency": 1, "Variables": {f"Mean_Velocity_Z({name})": True for name in columns}})
        ended(deck, 20, block.mesh())
        run = strut.run(start(deck, "first.restart", Boundary_Conditions={}), block.mesh())
        for name, speed in columns.items():
            self.assertAlmostEqual(run.history[f"Mean_Velocity_Z({name})"][0], speed, delta=1e-9)  # round-off

    def test_metal_that_was_put_back_is_let_go(self):
        """Where it was at first, but with residual stress: it is not taken for a body at rest."""
        way = {"sides": ("xy", "0"), "way": ("z", "2e-2*z*(t < 1 ? t : 2 - t)")}
        held = {name: {"Type": "Prescribed Displacement", "Node Set": "all", "Coordinate": axes, "Value": value}
                for name, (axes, value) in way.items()}
        for formulation in ("Correspondence", "Quadratic Correspondence"):
            with self.subTest(formulation):
                metal = {**block.deck()["Materials"]["metal"], "Formulation": formulation}
                deck = but(block.deck(Materials={"metal": metal}), History={"Frequency": 1})
                slow = {"Final Time": 2.0, "QuasiStatic": {"Number of Load Steps": 2}}
                first = strut.run(but(deck, Boundary_Conditions=held, Solver=slow, Restart={"Filename": "first.restart"}), block.mesh())
                self.assertEqual(np.abs(first.whole("Displacement")).max(), 0)
                run = strut.run(start(deck, "first.restart", Boundary_Conditions={}, Solver={"Final Time": 1e-6}), block.mesh())
                # A wave of the whole stress takes a half of the elastic energy that it passes; here it passes a part.
                self.assertGreater(run.history["Kinetic_Energy"].max(), 0.1 * first.history["Elastic_Energy"][-1])

    def test_equilibria_and_then_steps_are_those_of_two_solvers(self):
        """Of tools and of surfaces that rub, and with velocities kept: the same to round-off, as contact is searched anew."""
        for name, keep in (("press", False), ("rubbing", False), ("rubbing", True)):
            with self.subTest(name, keep=keep):
                deck = scene(name)
                slow = {**deck["Solver"], "QuasiStatic": {**deck["Solver"]["QuasiStatic"], "Number of Load Steps": 5}, "Final Time": 0.2}
                steps = {"Final Time": 0.2 + 4e-5}
                both = strut.run(but(deck, Solver=slow, **{"Solver 2": {**steps, "Keep Velocities": keep}}))
                strut.run(but(deck, Solver=slow, Restart={"Filename": "slow.restart"}))
                units = {unit for column, unit in both.history.units.items() if column.startswith("Reaction")}
                self.assertEqual(units, {"N (mean in explicit steps)"})
                run = strut.run(start(but(deck, Solver=steps), "slow.restart", 0.2, keep))
                for field in FIELDS:
                    if field in both.fields:
                        one, other = both.whole(field), run.whole(field)
                        self.assertLessEqual(np.abs(one - other).max(), 1e-12 * np.abs(one).max(), field)

    def test_new_conditions_contact_and_solver_begin_with_the_energy_that_is_there(self):
        """A block is crushed fast, let go, and found at rest; it is struck; its balance counts from the start."""
        deck = block.deck()
        first = ended(deck, 30, block.mesh())
        energy = first.history["Elastic_Energy"][-1] + first.history["Plastic_Work"][-1]
        foot = {"foot": deck["Boundary Conditions"]["foot"]}
        blow = {"blow": {"Type": "Initial Velocity", "Node Set": "block_zmax", "Coordinate": "z", "Value": "-10"}, **foot}
        surface = {"Models": {"touch": {"Contact Model": "Surface"}},
                   "Interactions": {"itself": {"First Block": "block", "Second Block": "block", "Contact Model": "touch"}}}
        deck = but(deck, History={"Frequency": 1})
        rest = {"QuasiStatic": {"Number of Load Steps": 2}, "Final Time": 1.0}
        for what, sections in {"let go": {"Boundary Conditions": foot}, "struck": {"Boundary Conditions": blow},
                               "with contact": {"Boundary Conditions": blow, "Contact": surface},
                               "at rest": {"Boundary Conditions": foot, "Solver": rest}}.items():
            for keep in (True, False):
                with self.subTest(what, keep=keep):
                    run = strut.run(but(start(deck, "first.restart", keep_velocities=keep), **sections), block.mesh())
                    row = {name: column[0] for name, column in run.history.items()}
                    held = row["Elastic_Energy"] + row["Plastic_Work"]
                    self.assertAlmostEqual(held / energy, 1, delta=0.02)  # a step later
                    self.assertEqual(row["Time"], 0)
                    self.assertLess(run.history["Balance_Error"][0], 1e-12)  # round-off
                    # Explicit steps: some 1e-3 where a wave of the whole stress runs through metal in flow. Equilibria:
                    # two steps take the whole load off, by the rule of the trapezoid.
                    self.assertLess(run.history["Balance_Error"][-1], 0.05 if what == "at rest" else 1e-3)

    def test_new_contact_of_bodies_that_are_inside_each_other_is_told(self):
        """The upper bar has gone down by its gap, and by a fifth of a spacing more."""
        deck = scene("impact")
        deck["Contact"]["Models"]["touch"] = {"Contact Model": "Surface"}
        for depth, told in ((-0.1, False), (0.2, True)):
            with self.subTest(depth):
                way = restarts.GAP + depth * restarts.SPACING
                fall = {"fall": {"Type": "Prescribed Displacement", "Node Set": "block_2", "Coordinate": "z", "Value": f"-{way}*t"},
                        "rest": {"Type": "Prescribed Displacement", "Node Set": "block_1", "Coordinate": "xyz", "Value": "0"}}
                first = but(deck, Boundary_Conditions=fall, Contact=None, History={"Frequency": 1},
                            Solver={"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 1}})
                strut.run(but(first, Restart={"Filename": "first.restart"}))
                second = start(first, "first.restart", Contact=deck["Contact"], Boundary_Conditions={}, Solver={"Final Time": 1e-6})
                self.assertEqual("stores" in strut.Run(second).log, told)

    def test_surfaces_touch_where_those_of_the_other_run_did(self):
        """Its upper bar began a fifth of a spacing inside the lower one, where it does not press; the mesh has them apart."""
        deck = scene("impact")
        deck["Contact"]["Models"]["touch"] = {"Contact Model": "Surface"}
        deck["Materials"] = {name: {"Material Model": "Elastic", "Density": 8930.0, "Young's Modulus": 117e9, "Poisson's Ratio": 0.25}
                             for name in deck["Materials"]}
        down = {"Type": "Initial Displacement", "Node Set": "block_2", "Coordinate": "z", "Value": f"-{restarts.GAP + 0.2 * restarts.SPACING}"}
        first = but(deck, Boundary_Conditions={"down": down}, History={"Frequency": 1}, Solver={"Final Time": 1e-7})
        rest = strut.run(but(first, Restart={"Filename": "first.restart"}))
        self.assertEqual(rest.history["Kinetic_Energy"].max(), 0)
        for time in (rest.time, 0.0):  # it goes on, or begins anew
            run = strut.run(start(first, "first.restart", time, Boundary_Conditions={}, Solver={"Initial Time": time, "Final Time": time + 1e-7}))
            self.assertEqual("goes on with its steps" in run.log, time > 0)
            self.assertEqual(run.history["Kinetic_Energy"].max(), 0)

    def test_the_criterion_of_points_that_may_fail_stays(self):
        """How far they are, the plastic strain over ε_f, would go on in parts of another one. A bond has no such memory."""
        deck = block.deck(Blocks={"block": {**block.deck()["Blocks"]["block"], "Damage Model": "one"}})
        for first, second, refused in (({"Damage Model": "Plastic Strain", "Failure Strain": 0.5}, {"Failure Strain": 0.05}, "Failure Strain: 0.5 there, 0.05 here"),
                                       ({"Damage Model": "Critical Stretch", "Critical Stretch": 0.5}, {"Critical Stretch": 0.4}, "")):
            ended(but(deck, Damage_Models={"one": first}), 3, block.mesh())
            again = start(but(deck, Damage_Models={"one": {**first, **second}}), "first.restart")
            if refused:
                with self.assertRaisesRegex(strut.Error, refused):
                    strut.Run(again, block.mesh())
            else:
                strut.Run(again, block.mesh())

    def test_a_damage_model_that_is_added_makes_springs_as_stiff_as_in_a_run_of_its_own(self):
        """0.3 instead of 0.01 of the default coefficient, at the same displacements."""
        deck = but(block.deck(), History={"Frequency": 1})
        first = ended(deck, 12, block.mesh())
        second = start(deck, "first.restart", first.time, Damage_Models={"breaks": {"Damage Model": "Critical Stretch", "Critical Stretch": 0.5}},
                       Blocks={"block": {**deck["Blocks"]["block"], "Damage Model": "breaks"}})
        run = strut.run(second, block.mesh())
        self.assertAlmostEqual(run.history["Stabilization_Energy"][0] / first.history["Stabilization_Energy"][-1], 30, delta=1e-9)

    def test_a_critical_stretch_is_that_of_the_initial_time(self):
        breaks = {"Damage Model": "Time Dependent Critical Stretch", "Time Dependent Critical Stretch": "10*t"}
        deck = but(block.deck(), Damage_Models={"breaks": breaks}, Blocks={"block": {**block.deck()["Blocks"]["block"], "Damage Model": "breaks"}})
        strut.Run(but(deck, Solver={"Initial Time": 1e-3, "Final Time": 1.001e-3}), block.mesh())
        with self.assertRaisesRegex(strut.Error, "is 0 at t = 0 s"):
            strut.Run(deck, block.mesh())

    def test_points_that_failed_in_steps_are_not_told_as_of_a_load_step(self):
        foam = {"Material Model": "Metal Foam Correspondence", "Density": 150.0, "Young's Modulus": 300e6, "Poisson's Ratio": 0.0,
                "Plastic Poisson's Ratio": 0.0, "Plateau Stress": 1e6, "Linear Hardening": 0.0, "Locking Stress": 2e6,
                "Locking Exponent": 8.0, "Densification Strain": 1.0, "Failure Strain": 0.005}
        deck = block.deck(Materials={"metal": foam}, History={"Frequency": 1})
        conditions = deck["Boundary Conditions"]
        deck = but(deck, Boundary_Conditions={**conditions, "top": {**conditions["top"], "Value": "100"}}, Solver={"Final Time": 6e-6})
        first = strut.run(but(deck, Restart={"Filename": "first.restart"}), block.mesh())
        self.assertGreater(first.whole("Failed").max(), 0)
        rest = {"all": {"Type": "Prescribed Velocity", "Node Set": "all", "Coordinate": "xyz", "Value": "0"}}
        slow = {"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 1}}
        self.assertNotIn("have failed", strut.run(start(deck, "first.restart", Boundary_Conditions=rest, Solver=slow), block.mesh()).log)

    def test_a_damaged_checkpoint_gives_way_to_the_one_before_as_a_whole(self):
        deck = but(block.deck(), History={"Frequency": 1})
        whole = strut.run(deck, block.mesh())
        kept = but(deck, Restart={"Filename": "first.restart", "Frequency": 10})
        run = strut.Run(kept, block.mesh())
        run.advance(steps=20)
        run.end()
        file = pathlib.Path("first.restart")
        damaged = bytearray(file.read_bytes())
        damaged[len(damaged) // 2] ^= 1
        file.write_bytes(damaged)
        before = whole.history["Time"][20]
        run = strut.run(start(deck, "first.restart", before), block.mesh())
        for told in ("going on from the one before, first.restart.old", "starts from first.restart.old", "goes on with its steps"):
            self.assertIn(told, run.log)
        self.assertGoesOn(whole, run)

    def test_a_tool_meets_the_body_where_it_is(self):
        """The uppermost points, half a spacing below the top, have gone down by 0.8 mm. A warning is of a tool that they are in."""
        def between(way):
            return {"floor": {"Type": "Rigid Plane", "Point": [0, 0, 0], "Normal": [0, 0, 1]},
                    "plate": {"Type": "Rigid Plane", "Point": [0, 0, 8 * SPACING], "Normal": [0, 0, -1], "Travel Z": way}}

        deck = but(block.deck(), History={"Frequency": 1})
        slow = {"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 4}}
        strut.run(but(deck, Boundary_Conditions=between("-0.8e-3*t"), Solver=slow, Restart={"Filename": "slow.restart"}), block.mesh())
        inside = "19 points are inside of the tool 'plate' at the start, up to 0.0005 m deep"
        short = {"Final Time": 1e-7, "Verlet": {"Fixed dt": 1e-8}}
        for way, solver, time, told in (("-0.8e-3 - 20*t", short, 0.0, ""), ("table(t, 0, 0, 1, -0.8e-3)", {**short, "Final Time": 1 + 1e-7}, 1.0, ""),
                                        ("-1.8e-3 - 20*t", short, 0.0, inside)):
            with self.subTest(way, time=time):
                second = start(but(deck, Boundary_Conditions=between(way), Solver=solver), "slow.restart", time)
                log = strut.Run(second, block.mesh()).log
                self.assertIn(told, log)
                self.assertEqual("inside of the tool" in log, told == inside, log)

    def test_a_tool_that_flies_is_looked_at_where_it_is(self):
        """The deck has it 1.2 mm above the cells, which it has reached: at its speed it would not in the time that is left."""
        hammer = {"Type": "Rigid Plane", "Point": [0, 0, 9.2 * SPACING], "Normal": [0, 0, -1], "Mass": 1e-6, "Speed Z": -500.0}
        deck = block.deck(History={"Frequency": 1, "Variables": {"Reaction_Z(hammer)": True}})
        deck = but(deck, Boundary_Conditions={"foot": deck["Boundary Conditions"]["foot"], "hammer": hammer})
        self.assertIn("the tool 'hammer' is 0.0012 m from all points", strut.Run(deck, block.mesh()).log)
        first = but(deck, Solver={"Final Time": 2.5e-6}, Restart={"Filename": "first.restart"})
        first = strut.run(first, block.mesh())
        run = strut.run(start(but(deck, Solver={"Final Time": 3e-6}), "first.restart", first.time), block.mesh())
        self.assertNotEqual(run.history["Reaction_Z(hammer)"][1], 0)
        self.assertNotIn("from all points", run.log)

    def test_a_broken_body_on_cubes_is_not_told_to_be_on_other_cells(self):
        """Its bonds along x have broken, so that its points no longer see the two faces across x that are near."""
        cubes = strut.voxels(np.ones((5, 5, 5), bool), SPACING, name="block")
        solid = {"Material Model": "Elastic", "Density": 2700.0, "Young's Modulus": 70e9, "Poisson's Ratio": 0.25}
        pull = {"Type": "Initial Velocity", "Node Set": "all", "Coordinate": "x", "Value": "15000*x"}
        deck = but(block.deck(Materials={"metal": solid}), Boundary_Conditions={"pull": pull}, Solver={"Final Time": 1e-7, "Verlet": {"Fixed dt": 1e-8}},
                   Damage_Models={"breaks": {"Damage Model": "Critical Stretch", "Critical Stretch": 1e-3}},
                   Blocks={"block": {"Block Names": "block", "Material": "metal", "Horizon Factor": 2.1, "Damage Model": "breaks"}},
                   History={"Frequency": 1, "Variables": {"Mean_Damage": True}})
        first = strut.run(but(deck, Restart={"Filename": "first.restart"}), cubes)
        self.assertGreater(first.history["Mean_Damage"][-1], 0.05)
        run = strut.Run(start(but(deck, Solver={"Final Time": 2e-7}), "first.restart", first.time), cubes)
        for log in (first.log, run.log):
            self.assertNotIn("cubic lattice", log)

    def test_what_cannot_start_is_refused_by_name(self):
        deck = block.deck(Output=block.output("first.e"))
        ended(deck, 5, block.mesh())
        os.mkdir("kept")
        ended(but(deck, Output=block.output("kept.e")), 5, block.mesh(), "kept/first.restart")
        metal, foam = deck["Materials"]["metal"], deck["Blocks"]["block"]
        other = strut.voxels(np.ones((4, 5, 8), bool), SPACING, name="block")
        plane = {"Type": "Symmetry Plane", "Node Set": "block_xmax", "Point": [4 * SPACING, 0, 0], "Normal": [-1, 0, 0]}
        top = {"Type": "Prescribed Displacement", "Node Set": "block_zmax", "Coordinate": "z", "Value": "-1*t"}
        conditions = deck["Boundary Conditions"]
        for sections, mesh, expected in (
            ({"Materials": {"metal": {**metal, "Yield Stress": 1e8}}}, block.mesh(), "Materials > metal > Yield Stress: 2"),
            ({"Blocks": {"block": {**foam, "Horizon Factor": 2.1}}}, block.mesh(), "Blocks > block > Horizon Factor: 1.75 there, 2.1"),
            ({"Materials": {"metal": {**metal, "Hardening": {"Type": "Linear", "Hardening Modulus": 1e9}}}}, block.mesh(),
             "1 problem\n  Materials > metal > Hardening: nothing there, a section here"),
            ({}, other, "of another mesh: block 0 (block): 152 points there, 160 here"),
            ({"Boundary Conditions": {**conditions, "side": plane}}, block.mesh(), "Boundary Conditions > side: not there"),
            ({"Boundary Conditions": {**conditions, "top": top}}, block.mesh(), "Boundary Conditions > top > Value"),
            ({"Output": block.output("first.e")}, block.mesh(), "Output > Output Filename: 'first.e' is of the run that first.restart comes"),
            ({"Output": block.output("./first")}, block.mesh(), "Output > Output Filename: './first.e' is of the run"),
            ({"Output": block.output("kept.e"), "Start From": {"Checkpoint": "kept/first.restart"}}, block.mesh(), "'kept.e' is of the run"),
            ({"Start From": {"Checkpoint": "first.e"}}, block.mesh(), "first.e is a result"),
            ({"Start From": {"Checkpoint": "none"}}, block.mesh(), "Start From > Checkpoint: none: there is no such file"),
            ({"Start From": {}}, block.mesh(), "Start From > Checkpoint: missing"),
            ({"Restart": {"Filename": "first.restart"}}, block.mesh(), "'first.restart' is the checkpoint of Start From"),
        ):
            with self.subTest(expected):
                with self.assertRaises(strut.Error) as raised:
                    strut.Run(but(start(but(deck, Output={"Output Filename": "second.e"}), "first.restart"), **sections), mesh)
                self.assertIn(expected, str(raised.exception))
                self.assertFalse(os.path.exists("second.e"))


if __name__ == "__main__":
    unittest.main()
