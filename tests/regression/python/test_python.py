#!/usr/bin/python3
"""The module strut: a run has the bits of the program's, errors are the deck's own, and a run can be watched, stopped and
continued."""
import os
import pathlib
import subprocess
import sys
import threading
import time
import unittest
import warnings

import block
import numpy as np
import strut
from block import SPACING, InFolder
from strut.tools import environment, tool


class Runs(InFolder):
    def test_a_run_has_the_bits_of_the_programs(self):
        files = {"Output": block.output("module.e")}
        run = strut.run(block.deck(**files), block.mesh())
        block.mesh().write("block.g")
        history = {**block.deck()["History"], "Filename": "program.csv"}
        deck = block.deck(Output=block.output("program.e"), History=history,
                          Discretization={"Type": "Exodus", "Input Mesh File": "block.g"})
        pathlib.Path("program.xml").write_text(deck.to_xml())
        subprocess.run([os.environ["STRUT"], "program.xml"], check=True, capture_output=True)
        compared = subprocess.run([os.environ["STRUT_COMPARE"], "module.e", "program.e"], capture_output=True, text=True)
        self.assertEqual(compared.returncode, 0, compared.stdout + compared.stderr)
        rows = np.genfromtxt("program.csv", delimiter=",", skip_header=2)  # 17 digits: the same numbers
        np.testing.assert_array_equal(np.transpose(list(run.history.values())), rows)
        self.assertEqual(run.history.units["Reaction_Z(top)"], "N (mean)")
        self.assertTrue(run.is_over)

    def test_pauses_do_not_change_a_run_and_several_runs_do_not_meet(self):
        whole = strut.run(block.deck(), block.mesh())
        parts = strut.Run(block.deck(), block.mesh())
        self.assertEqual((parts.steps, len(parts.history["Time"])), (0, 1))
        self.assertTrue(parts.advance(steps=3))
        self.assertEqual(parts.steps, 3)
        self.assertTrue(parts.advance_to(2e-6))
        self.assertTrue(2e-6 <= parts.time < 2e-6 + 2 * parts.history["Step_Size"][-1])
        self.assertFalse(parts.advance())
        self.assertTrue(parts.is_over)
        for name, column in whole.history.items():
            np.testing.assert_array_equal(parts.history[name], column, err_msg=name)
        for name in ("Displacement", "Cauchy_Stress", "Equivalent_Plastic_Strain"):
            np.testing.assert_array_equal(parts.fields[name], whole.fields[name], err_msg=name)

    def test_a_callback_stops_a_run_which_then_goes_on(self):
        seen = []
        run = strut.run(block.deck(), block.mesh(), every=2, callback=lambda run: seen.append(run.steps) or run.steps < 6)
        self.assertEqual((seen, run.steps, run.has_ended), ([2, 4, 6], 6, False))
        self.assertFalse(run.advance())
        self.assertTrue(run.is_over)

    def test_an_ended_run_leaves_a_checkpoint_from_which_another_continues(self):
        """Its history is whole if it is in a file; else a curve tells when it begins."""
        for file in ("block.csv", None):
            deck = block.deck(Restart={"Filename": "block.restart"}, History={**block.deck()["History"], "Filename": file})
            whole = strut.run(deck, block.mesh())
            run = strut.Run(deck, block.mesh())
            run.advance(steps=5)
            run.end()
            self.assertEqual((run.has_ended, run.is_over, run.advance()), (True, False, False))
            self.assertIn("ended as it was asked to", run.log)
            again = strut.run(deck, block.mesh(), continued=True)
            np.testing.assert_array_equal(again.fields["Cauchy_Stress"], whole.fields["Cauchy_Stress"])
            rows = slice(None if file else len(run.history["Time"]) - 1, None)  # that of the checkpoint again
            for name, column in whole.history.items():
                np.testing.assert_array_equal(again.history[name], column[rows], err_msg=name)
            curve = strut.curve(again, area=19e-6, height=8e-3)
            self.assertEqual("later than the run" in curve.text, file is None)
            self.assertAlmostEqual(curve.strain[-1] * 8e-3 / (20 * np.mean(whole.history["Time"][-2:])), 1, 8)

    def test_a_continued_run_stops_at_a_limit_of_which_the_one_before_has_told(self):
        """Watch > Beyond Limits, which a run that continues may change."""
        deck = block.deck(Watch={"Smallest Step": 1.0, "Beyond Limits": "Continue"}, Restart={"Filename": "kept.restart"})
        self.assertIn("critical time step has fallen", strut.run(deck, block.mesh()).log)
        deck["Watch"]["Beyond Limits"], deck["Solver"]["Final Time"] = "Stop", 6e-6
        with self.assertRaisesRegex(strut.Error, "critical time step has fallen"):
            strut.run(deck, block.mesh(), continued=True)

    def test_files_of_a_run_that_has_ended_are_free_for_the_next(self):
        kept = []
        for speed in (10, 20):
            conditions = block.deck()["Boundary Conditions"]
            top = {**conditions["top"], "Value": -speed}
            kept.append(strut.run(block.deck(Output=block.output("block.e"), **{"Boundary Conditions": {**conditions, "top": top}}),
                                  block.mesh()))
        slow, fast = (np.abs(run.whole("Displacement")[:, 2]).max() for run in kept)
        self.assertAlmostEqual(fast / slow, 2, 12)  # of the plate: speed times time

    def test_a_table_in_a_file_is_that_in_the_deck(self):
        """For the run, the tools, and a continued run, which notices another file."""
        pathlib.Path("data").mkdir()
        pathlib.Path("data/pull.csv").write_text("# of a press\nTime,Velocity\n0,0\n2e-6,-20\n4e-6,-10\n")
        conditions = block.deck()["Boundary Conditions"]
        runs, curves = [], []
        for numbers in ("'pull.csv'", "0, 0, 2e-6, -20, 4e-6, -10"):
            top = {**conditions["top"], "Value": f"table(t, {numbers})"}
            deck = strut.Deck({**block.deck(**{"Boundary Conditions": {**conditions, "top": top}}), "Restart": {"Filename": "block.restart"}},
                              "data/deck.xml")
            runs.append(strut.run(deck, block.mesh()))
            curves.append(strut.curve(runs[-1], area=19e-6, height=8e-3))
            for name in ("Reaction_Z(top)", "Max_Displacement"):
                np.testing.assert_array_equal(runs[0].history[name], runs[-1].history[name])
            np.testing.assert_array_equal(curves[0].strain, curves[-1].strain)
            # The integral of the velocity in the deck, in the middle between the last rows.
            left = 4e-6 - runs[-1].history["Time"][-2:]
            self.assertAlmostEqual(curves[-1].strain[-1] / (np.mean(50e-6 - 10 * left - 2.5e6 * left**2) / 8e-3), 1, 8)
            run = strut.Run(deck, block.mesh())
            run.advance(steps=5)
            run.end()
            if numbers == "'pull.csv'":
                pathlib.Path("data/pull.csv").write_text("0,0\n2e-6,-20\n4e-6,-11\n")
                with self.assertWarnsRegex(UserWarning, r"top > Value: table.t,0,0,2e-06,-20,4e-06,-10. before, .*-11. now"):
                    strut.Run(deck, block.mesh(), continued=True)
                pathlib.Path("data/pull.csv").write_text("0,0\n2e-6,-20\n2e-6,-10\n")
                with self.assertRaisesRegex(strut.Error, "Conditions > top > Value: data/pull.csv, line 3: 2e-06 after 2e-06"):
                    strut.Run(deck, block.mesh())

    def test_the_history_is_a_table(self):
        history = strut.run(block.deck(), block.mesh()).history
        self.assertEqual(list(history), ["Time", "Step_Size", *list(history)[2:]])
        self.assertEqual({len(column) for column in history.values()}, {len(history["Time"])})
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("no pandas")
        table = history.to_pandas()
        self.assertEqual(list(table), list(history))
        np.testing.assert_array_equal(table.to_numpy(), np.transpose(list(history.values())))

    def test_a_probe_follows_the_nearest_point(self):
        place = np.array([2.4, 2.6, 4.4]) * SPACING
        history = {"Frequency": 1, "Variables": {"Displacement_Z(tip)": True, "Mean_Displacement_Z(tip)": True},
                   "Probes": {"tip": {"Point": place}}}
        run = strut.Run(block.deck(History=history), block.mesh())
        nearest = np.argmin(np.linalg.norm(run.positions - place, axis=1))
        self.assertRegex(run.log, r"the probe 'tip' is element \d+ of block 'block' at \(0.0025 0.0025 0.0045\) m")
        run.advance()
        # A mean over one point: its value times its volume, over its volume.
        np.testing.assert_allclose(run.history["Displacement_Z(tip)"][-1], run.fields["Displacement"][nearest, 2], rtol=1e-15)
        with self.assertRaisesRegex(strut.Error, "did you mean 'Mean_Displacement_Z'"):
            strut.Run(block.deck(History={**history, "Variables": {"Displacment_Z(tip)": True}}), block.mesh())

    def test_a_probe_where_a_point_has_been_dropped_follows_the_nearest_that_is_left(self):
        solid = np.ones((4, 5, 11), bool)
        solid[:, :, 8:] = False
        solid[1, 2, 10] = True  # alone
        place = np.array([1.5, 2.5, 10.5]) * SPACING
        history = {"Frequency": 1, "Variables": {"Displacement_Z(lost)": True}, "Probes": {"lost": {"Point": place}}}
        end = {"Type": "Prescribed Velocity", "Node Set": "end", "Coordinate": "z", "Value": "-20"}
        deck = block.deck(History=history, Discretization={"Degenerate Points": "Drop"},
                          **{"Node Sets": {"end": f"(z > {7 * SPACING}) * (z < {8 * SPACING})"}})
        deck["Boundary Conditions"]["top"] = end
        with self.assertWarnsRegex(UserWarning, r"the probe 'lost' is element \d+ of block 'block' at \(0.0015 0.0025 0.0075\) m, 0.003 m"):
            run = strut.run(deck, strut.voxels(solid, SPACING, name="block"))
        self.assertAlmostEqual(run.history["Displacement_Z(lost)"][-1], -20 * run.time, delta=1e-9)

    def test_whole_fields_are_as_long_as_the_mesh_whichever_point_was_dropped(self):
        for alone in ((0, 0, 10), (3, 4, 10)):
            solid = np.ones((4, 5, 11), bool)
            solid[:, :, 8:] = False
            solid[alone] = True
            deck = block.deck(Discretization={"Degenerate Points": "Drop"}, History={"Frequency": 1, "Variables": {"Max_Displacement": True}})
            deck["Boundary Conditions"]["top"]["Node Set"] = "block_zmin"
            del deck["Boundary Conditions"]["foot"]
            run = strut.Run(deck, strut.voxels(solid, SPACING, name="block"))
            for name in ("Displacement", "Equivalent_Plastic_Strain"):
                field = run.whole(name)
                self.assertEqual(len(field), solid.sum())
                self.assertEqual(np.isnan(field.reshape(len(field), -1)).all(axis=1).sum(), 1)
            self.assertTrue(np.isfinite(run.whole("Displacement")[run.ids]).all())

    def test_equilibria_pause_at_their_load_steps(self):
        conditions = block.deck()["Boundary Conditions"]
        top = {**conditions["top"], "Type": "Prescribed Displacement", "Value": "-1e-6*t"}
        deck = block.deck(Solver={"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 4}},
                          **{"Boundary Conditions": {**conditions, "top": top}})
        steps = []
        run = strut.run(deck, block.mesh(), every=1, callback=lambda run: steps.append(run.time))
        self.assertEqual(steps, [0.25, 0.5, 0.75])
        self.assertTrue(run.is_over)
        # Hooke's law of a block between plates: each layer moves in proportion; the ends are held sideways.
        moved = run.whole("Displacement").reshape(-1, 3)[:, 2]
        self.assertAlmostEqual(moved.min() / -1e-6, 1, 9)

    def test_an_array_of_a_field_is_that_of_the_present_step(self):
        def follow(deck, mesh):
            run = strut.Run(deck, mesh)
            run.advance(steps=1)
            array = run.fields["Force_Density"]
            for _ in range(3):
                run.advance(steps=1)
                self.assertTrue(np.shares_memory(array, run.fields["Force_Density"]))

        held = block.deck()["Boundary Conditions"]
        slow = {**held, "top": {**held["top"], "Type": "Prescribed Displacement", "Value": "-1e-6*t"}}
        follow(block.deck(Solver={"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 4}}, **{"Boundary Conditions": slow}),
               block.mesh())
        # A load that changes, with substeps at a stiff end.
        places = SPACING * np.argwhere(np.ones((4, 4, 8)))
        ends = {"block": np.flatnonzero(places[:, 2] > SPACING), "stiff": np.flatnonzero(places[:, 2] <= SPACING)}
        mesh = strut.mesh(places, ends, volumes={name: np.full(len(points), SPACING**3) for name, points in ends.items()})
        metal = block.deck()["Materials"]["metal"]
        horizon = {"Horizon Factor": 1.75}
        follow(block.deck(Materials={"metal": metal, "stiff": {**metal, "Young's Modulus": 8e11}},
                          Blocks={name: {"Block Names": name, "Material": material, **horizon}
                                  for name, material in (("block", "metal"), ("stiff", "stiff"))},
                          Solver={"Final Time": 4e-5, "Verlet": {"Subcycling": True}}, History=None,
                          **{"Boundary Conditions": {"pull": {"Type": "Body Force", "Coordinate": "z", "Value": "-1e9*sin(1e6*t)"}}}),
               mesh)

    def test_steps_go_on_from_equilibria(self):
        conditions = block.deck()["Boundary Conditions"]
        top = {**conditions["top"], "Type": "Prescribed Displacement", "Value": "-1e-6*t"}
        deck = block.deck(Solver={"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 2}},
                          **{"Solver 2": {"Final Time": 1.000002, "Verlet": {}}, "Boundary Conditions": {**conditions, "top": top}})
        whole, paused = strut.run(deck, block.mesh()), strut.Run(deck, block.mesh())
        while paused.advance(steps=1):
            pass
        self.assertGreater(len(whole.history["Time"]), 5)
        np.testing.assert_array_equal(paused.history["Max_Displacement"], whole.history["Max_Displacement"])

    def test_ctrl_c_ends_a_run_with_a_checkpoint_and_interrupts(self):
        deck = block.deck(Solver={"Final Time": 1.0}, Restart={"Filename": "block.restart"}, History=None)
        conditions = {name: {**condition, "Value": "0"} for name, condition in deck["Boundary Conditions"].items()}
        run = strut.Run({**deck, "Boundary Conditions": conditions}, block.mesh())  # at rest: some days of steps
        with subprocess.Popen(["sh", "-c", f"sleep 0.5; kill -INT {os.getpid()}"]), self.assertRaises(KeyboardInterrupt):
            run.advance()
        self.assertTrue(run.has_ended and not run.is_over)
        self.assertTrue(pathlib.Path("block.restart").exists())


class Errors(InFolder):
    def test_a_wrong_deck_is_told_with_all_that_is_wrong(self):
        wrong = block.deck(Blocks={"block": {"Block Names": "block", "Material": "metal", "Horizon": -1.0}})
        wrong["Materials"]["metal"]["Yeild Stress"] = 1.0
        for start in (strut.check, strut.run):
            with self.assertRaises(strut.Error) as caught:
                start(wrong, block.mesh())
            self.assertEqual(sorted(p.split(":")[0] for p in caught.exception.problems),
                             ["Blocks > block > Horizon", "Materials > metal > Yeild Stress"])
            self.assertIn("did you mean 'Yield Stress'?", str(caught.exception))
        strut.check(block.deck(), block.mesh())  # raises nothing
        sides = {"sides": {"Type": "Periodic Sides", "Coordinate": "x", "Lower": 0.0, "Upper": 3e-3}}
        for start in (strut.check, strut.run):  # what deck and mesh show together
            with self.assertRaisesRegex(strut.Error, "not all between the sides"):
                start(block.deck(**{"Boundary Conditions": sides}, History=None), block.mesh())

    def test_what_no_deck_can_hold_is_told_by_its_place(self):
        with self.assertRaisesRegex(strut.Error, "deck > Solver > Final Time: .* of type complex"):
            strut.run(block.deck(Solver={"Final Time": 1j}), block.mesh())

    def test_a_run_needs_one_mesh(self):
        with self.assertRaisesRegex(strut.Error, "no elements"):
            strut.run(block.deck())
        with self.assertRaisesRegex(strut.Error, "names a mesh, and one is given"):
            strut.run(block.deck(Discretization={"Type": "Exodus", "Input Mesh File": "block.g"}), block.mesh())

    def test_the_program_has_no_mesh_in_memory(self):
        pathlib.Path("block.xml").write_text(block.deck(Discretization={"Type": "Memory"}).to_xml())
        done = subprocess.run([os.environ["STRUT"], "block.xml"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("Discretization > Type: 'Memory' is the mesh of a script", done.stderr)
        self.assertIn("History > Filename: missing", done.stderr)

    def test_arrays_that_are_no_mesh_are_refused(self):
        corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], float)
        self.assertEqual(strut.mesh(corners, {"a": [range(8)]}).blocks["a"].tolist(), [list(range(8))])
        for wrong, words in ((lambda: strut.mesh(corners, {"a": [range(1, 9)]}), "block 'a' refers to node 8; the nodes are 0 to 7"),
                             (lambda: strut.mesh(corners[:, :2], {"a": [range(8)]}), "N x 3"),
                             (lambda: strut.mesh(corners, {"a": [range(6)]}), "8, 4 or 1"),
                             (lambda: strut.mesh(corners, {"a b": [range(8)]}), "has a blank"),
                             (lambda: strut.mesh(corners, {"a": np.ones((1, 8))}), "whole ones"),
                             (lambda: strut.voxels(np.zeros((2, 2, 2)), 1e-3), "none of them solid"),
                             (lambda: strut.voxels(-np.ones((2, 2, 2), int), 1e-3), "none of them solid"),
                             (lambda: strut.voxels(np.full((2, 2, 2), "1"), 1e-3), "an array of type"),
                             (lambda: strut.voxels(np.ones((2, 2, 2)), 0), "expected one or three numbers > 0"),
                             (lambda: strut.voxels(np.ones((2, 2, 2)), (1e-3, 2e-3)), "expected one or three numbers > 0"),
                             (lambda: strut.voxels(np.ones((2, 2, 2)), 1e-3, origin=(0, 0)), "expected three numbers"),
                             (lambda: strut.voxels(np.arange(8).reshape(2, 2, 2), 1e-3), "several values; expected truth values"),
                             (lambda: strut.voxels(np.ones((4, 4, 4)), 1e-3, gather=2.5), "expected a whole number, 1 to 16"),
                             (lambda: strut.voxels(np.array([[[1, np.nan]]]), 1e-3, gather=2), "nan in the array; expected truth"),
                             (lambda: strut.voxels(np.ones((4, 4, 4)), None), "spacing: an array of type object"),
                             (lambda: strut.voxels(np.ones((4, 4, 4)), 1e-3, name=3), "3 cannot be the name"),
                             (lambda: strut.voxels([[[1, 1], [1]]], 1e-3), "rows of equal length"),
                             (lambda: strut.mesh(corners + 1j, {"a": [range(8)]}), "nodes: an array of type complex128"),
                             (lambda: strut.mesh([[0, 0, 0], [1, 0]]), "nodes: not an array"),
                             (lambda: strut.mesh(corners, {"a": [[0, 1], [2]]}), "block 'a': not an array"),
                             (lambda: strut.mesh(corners, [range(8)]), "blocks: list; expected a dictionary"),
                             (lambda: strut.mesh(corners, {"a": [range(8)]}, volumes={"b": [1]}), "volumes of 'b', which is no block"),
                             (lambda: strut.mesh(corners, {"a": [range(8)]}, {1: [0]}), "1 cannot be the name")):
            with self.assertRaisesRegex(strut.Error, words):
                wrong()

    def test_what_is_of_another_kind_is_refused(self):
        run = strut.Run(block.deck(), block.mesh())
        for wrong, words in ((lambda: strut.run(["deck"]), "a deck of type list"),
                             (lambda: strut.check(block.deck(), block.solid()), "mesh: ndarray; expected what strut.voxels"),
                             (lambda: run.advance(steps=-1), "steps: -1; expected a whole number, 0 or more"),
                             (lambda: run.watch(print, every=0), "every: 0; expected a whole number, 1 or more"),
                             (lambda: run.advance(until=float("nan")), "until: nan; expected a time"),
                             (lambda: run.advance_to("1e-6"), "until: '1e-6'; expected a time"),
                             (lambda: run.watch(3, every=1), "callback: 3; expected a function"),
                             (lambda: run.fields[3], "3: no such variable"),
                             (lambda: strut.check(block.deck(**{"Node Sets": {"a\x01": "x"}})), r"'deck > Node Sets > a\\x01': the character"),
                             (lambda: strut.set_threads(0), "cannot be 0 threads a rank: expected 1 to 1024")):
            with self.assertRaisesRegex(strut.Error, words):
                wrong()

    def test_arrays_of_any_layout_are_read_by_their_indices(self):
        twice = np.zeros((8, 5, 16), bool)
        twice[::2, :, ::-2] = block.solid()
        for solid in (np.asfortranarray(block.solid()), twice[::2, :, ::-2], block.solid().astype(np.uint8) * 255, block.solid().astype(np.float32)):
            np.testing.assert_array_equal(strut.voxels(solid, SPACING).blocks["foam"], strut.voxels(block.solid(), SPACING).blocks["foam"])
        one = block.mesh()
        nodes, elements = np.asfortranarray(one.nodes), one.blocks["block"][::-1].astype(np.uint64)
        other = strut.mesh(np.repeat(nodes, 2, axis=0)[::2], {"block": np.asfortranarray(elements)})
        np.testing.assert_array_equal(other.nodes, one.nodes)
        np.testing.assert_array_equal(other.blocks["block"], one.blocks["block"][::-1])

    def test_a_deck_that_changes_is_that_of_the_next_run(self):
        deck = block.deck()
        run = strut.Run(deck, block.mesh())
        deck["Solver"]["Final Time"] = 1e-6
        run.advance()
        self.assertAlmostEqual(run.time, 4e-6, delta=1e-12)

    def test_the_deck_of_a_run_and_its_fields_cannot_be_changed(self):
        deck = block.deck()
        run = strut.Run(deck, block.mesh())
        run.deck["Boundary Conditions"]["top"]["Value"] = "0"
        with self.assertRaisesRegex(strut.Error, "run.deck has been changed; expected the deck that the run began with"):
            run.advance()
        self.assertEqual(deck["Boundary Conditions"]["top"]["Value"], "-20")
        for name in ("Velocity", "Displacement", "Cauchy_Stress"):
            with self.assertRaisesRegex(ValueError, "read-only"):
                run.fields[name][:] = 0

    def test_one_run_works_at_a_time(self):
        at_rest = {name: {**condition, "Value": "0"} for name, condition in block.deck()["Boundary Conditions"].items()}
        run = strut.Run(block.deck(Solver={"Final Time": 1.0}, History=None, **{"Boundary Conditions": at_rest}), block.mesh())
        other = strut.Run(block.deck(), block.mesh())
        busy = threading.Thread(target=run.advance, args=(10000,))
        busy.start()
        for _ in range(1000):  # until it works
            try:
                other.steps
            except strut.Error:
                break
            time.sleep(0.01)
        for action in (lambda: run.fields["Displacement"], lambda: run.advance(steps=1), lambda: run.history, other.advance,
                       lambda: run.steps, lambda: strut.run(block.deck(), block.mesh()), lambda: strut.check(block.deck(), block.mesh())):
            with self.assertRaisesRegex(strut.Error, "a run works in another thread of this process"):
                action()
        self.assertTrue(busy.is_alive())  # else it has shown nothing
        busy.join()
        self.assertEqual(run.steps, 10000)
        other.advance()
        self.assertTrue(other.is_over)

    def test_a_failed_callback_stops_a_run_which_then_goes_on(self):
        for error in (ValueError, KeyboardInterrupt):
            run = strut.Run(block.deck(), block.mesh())

            def fail(_, error=error):
                raise error

            self.assertRaises(error, run.watch, fail, 2)
            self.assertEqual((run.steps, run.has_ended), (2, False))
            run.advance()
            self.assertTrue(run.is_over)

    def test_an_unknown_field_has_the_nearest_name(self):
        run = strut.Run(block.deck(), block.mesh())
        with self.assertRaisesRegex(strut.Error, "did you mean 'Displacement'"):
            run.fields["Displacment"]
        self.assertIn("Displacement", run.fields)

    def test_warnings_are_those_of_python(self):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            strut.run(block.deck(Solver={"Final Time": 1e-7}, History=None, **{"Boundary Conditions": None}), block.mesh())
        self.assertIn("nothing moved", "\n".join(str(one.message) for one in told))


class Arrays(InFolder):
    def test_fields_lie_as_they_are_and_whole_ones_in_the_order_of_the_mesh(self):
        run = strut.Run(block.deck(), block.mesh())
        places = run.positions
        force = run.fields["Force_Density"]
        self.assertFalse(places.flags.writeable or places.flags.owndata or force.flags.owndata)
        before = places.copy()
        run.advance()
        self.assertGreater(np.abs(places - before).max(), 1e-6)  # seen without another call
        np.testing.assert_allclose(run.fields["Displacement"], places - before, atol=1e-18)  # ulps of 1e-2 m
        # In the order of the mesh x runs fastest, z slowest.
        k, j, i = np.nonzero(block.solid().transpose())
        middle = (np.stack([i, j, k], axis=1) + 0.5) * SPACING
        np.testing.assert_allclose(before[np.argsort(run.ids)], middle, atol=1e-17)
        np.testing.assert_array_equal(run.whole("Displacement"), run.fields["Displacement"][np.argsort(run.ids)])
        del run
        self.assertTrue(np.isfinite(places).all())  # the array keeps it

    def test_an_array_is_the_same_body_here_and_for_tools_voxels(self):
        np.save("solid.npy", block.solid())
        tool("voxels", "solid.npy", "solid.g", block="block", voxel_size=SPACING)
        one, other = block.mesh(), strut.mesh("solid.g")
        np.testing.assert_array_equal(one.nodes[one.blocks["block"]], other.nodes[other.blocks["block"]])
        self.assertEqual(one.nodes.max(axis=0).tolist(), [4 * SPACING, 5 * SPACING, 8 * SPACING])

    def test_gathered_voxels_keep_their_volume(self):
        rod = np.zeros((12, 12, 24))
        x, y = np.meshgrid(np.arange(12) + 0.5, np.arange(12) + 0.5, indexing="ij")
        rod[(x - 6)**2 + (y - 6)**2 < 25] = 1
        run = strut.Run(block.deck(Blocks={"b": {"Block Names": "rod", "Material": "metal", "Horizon Factor": 1.75}},
                                   History=None, **{"Boundary Conditions": None}), strut.voxels(rod, 1e-4, name="rod", gather=3))
        # Sums of 24 x 80 voxels in each run, by another order: some ulps.
        np.testing.assert_allclose(run.whole("Volume").sum(), rod.sum() * 1e-12, rtol=1e-13)

    def test_a_deck_of_a_file_is_its_dictionary(self):
        deck = block.deck()
        pathlib.Path("block.xml").write_text(deck.to_xml())
        self.assertEqual(dict(strut.Deck("block.xml")), dict(deck))
        pathlib.Path("block.yaml").write_text("deck:\n  Solver: {Final Time: 1.0e-3}\n  Blocks:\n    a: {Horizon: 2.0}\n")
        self.assertEqual(strut.Deck("block.yaml"), {"Solver": {"Final Time": 1e-3}, "Blocks": {"a": {"Horizon": 2.0}}})
        with self.assertRaisesRegex(strut.Error, "no.xml: the deck cannot be read"):
            strut.Deck("no.xml")


class Tools(InFolder):
    def test_the_curve_and_the_picture_are_of_the_run(self):
        run = strut.run(block.deck(Output=block.output("block.e")), block.mesh())
        curve = strut.curve(run, area=19e-6, height=8e-3)
        self.assertNotIn("WARNING", curve.text)  # as of a history that is older than its deck
        # Compression, N over m², written with 9 digits; the first row has no step before it.
        np.testing.assert_allclose(curve.stress["Reaction_Z(top)"][1:], -run.history["Reaction_Z(top)"][1:] / 19e-6, rtol=1e-8)
        self.assertAlmostEqual(curve.measures["largest_stress"] / max(curve.stress["Reaction_Z(top)"]), 1, 8)
        try:
            import vtkmodules  # noqa: F401
        except ImportError:
            self.skipTest("no VTK")
        strut.picture(run, "block.png")
        self.assertGreater(os.path.getsize("block.png"), 10000)

    def test_the_stiffness_of_a_full_cube_is_hooke_s(self):
        """Two layers at each face are held, and 4³ points are free: what is left are the forces that the search leaves, 3e-6."""
        E, nu = 70e9, 0.3
        cube = strut.voxels(np.ones((8, 8, 8), bool), SPACING, name="block")
        found = strut.stiffness({key: block.deck()[key] for key in ("Materials", "Blocks")}, cube, layers=2)
        shear, lame = E / (2 * (1 + nu)), E * nu / ((1 + nu) * (1 - 2 * nu))
        expected = np.diag([2 * shear] * 3 + [shear] * 3)
        expected[:3, :3] += lame
        np.testing.assert_allclose(found["kinematic"], expected, atol=1e-5 * E)

    def test_convergence_finds_order_and_limit(self):
        """The middles of the outer layer are half a spacing below the end of the bar: order 1, towards its length."""
        pathlib.Path("bar.recipe").write_text("shape = box\nsize = 4e-3 4e-3 8e-3\nspacing = 1e-3\n")
        history = {"Filename": "bar.csv", "Variables": {"Mean_Coordinate_Z(top)": True}}
        rest = block.deck(History=history, Discretization={"Type": "Exodus", "Input Mesh File": "bar.g"}, Solver={"Final Time": 1e-7},
                          Blocks={"bar": {"Block Names": "body", "Material": "metal", "Horizon Factor": 1.75}},
                          **{"Boundary Conditions": None})
        pathlib.Path("bar.xml").write_text(rest.to_xml())
        pathlib.Path("bar.study").write_text("deck = bar.xml\nvary spacing = 1e-3 0.8e-3 0.5e-3\nset recipe spacing = {spacing}\n"
                                             "collect = Mean_Coordinate_Z(top)\n")
        (row,) = strut.convergence("bar.study", "grids", "spacing")
        self.assertEqual((row["measure"], row["unit"], row["finding"]), ("Mean_Coordinate_Z(top)", "", "converging"))
        self.assertAlmostEqual(row["order"], 1, 6)  # of values with 9 digits
        self.assertAlmostEqual(row["limit"] / 8e-3, 1, 7)
        with self.assertRaisesRegex(strut.Error, "sapcing"):
            strut.convergence("bar.study", "grids", "sapcing")


class Ends(InFolder):
    @unittest.skipUnless("STRUT_MPIRUN" in os.environ, "no mpirun is named")
    def test_an_error_of_one_rank_ends_the_job(self):
        pathlib.Path("fails.py").write_text("import block, strut\nrun = strut.Run(block.deck(), block.mesh())\n"
                                            "if run.core.rank == 0:\n    raise ValueError('alone')\nrun.advance()\n")
        here = os.path.dirname(os.path.abspath(__file__))
        done = subprocess.run([*os.environ["STRUT_MPIRUN"].split(), "-n", "2", sys.executable, "fails.py"], capture_output=True, text=True,
                              timeout=60, env={**environment(), "PYTHONPATH": f"{here}:{os.environ['PYTHONPATH']}"})
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("ValueError: alone", done.stderr)

    def test_threads_may_be_the_first_that_a_script_sets(self):
        done = subprocess.run([sys.executable, "-c", "import strut; strut.set_threads(2)"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_a_script_ends_well_with_a_run_in_the_middle(self):
        pathlib.Path("cells.py").write_text("a module of the script, of the same name as a part of the tools\n")
        script = "import block, strut, sys\nassert 'cells' not in sys.modules\nrun = strut.Run(block.deck(), block.mesh())\nrun.advance(steps=2)\nkept = run.positions\n"
        here = os.path.dirname(os.path.abspath(__file__))
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": f"{here}:{os.environ['PYTHONPATH']}"})
        self.assertEqual((done.returncode, done.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
