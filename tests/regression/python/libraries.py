#!/usr/bin/python3
"""Laws of one's own in Fortran, compiled by the command of docs/howto/law.md: a UMAT gives the built-in law's results in
steps and equilibria, and what it does wrong is told as its own, by file and point, on several threads and ranks."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import block
import numpy as np
import strut
from block import InFolder
from strut.tools import environment

SOURCES = pathlib.Path(__file__).resolve().parents[3]
HERE = SOURCES / "tests/regression/python"
if not shutil.which("gfortran"):
    print("skipped: no gfortran")
    sys.exit(77)
KEPT = tempfile.TemporaryDirectory()
LIBRARY = f"{KEPT.name}/umat_j2.so"
E, NU, YIELD, HARDENING = 70e9, 0.3, 200e6, 1e9  # Pa


def compile_by_the_page():
    page = (SOURCES / "docs/howto/law.md").read_text()
    command = re.search(r"^    (gfortran .*)$", page, re.M)[1]
    command = command.replace("my_umat.so", LIBRARY).replace("my_umat.f", str(HERE / "umat_j2.f"))
    subprocess.run(command, shell=True, check=True, cwd=SOURCES)


compile_by_the_page()


def built_in():
    metal = block.deck()["Materials"]["metal"]
    return {**metal, "Hardening": {"Type": "Linear", "Hardening Modulus": HARDENING}}


def umat(wrong=0, states=7):
    return {**block.deck()["Materials"]["metal"], "Yield Stress": None, "Material Model": "User Library", "Library": LIBRARY,
            "Interface": "UMAT", "Constants": [E, NU, YIELD, HARDENING, wrong], "State Variables": states}


class Libraries(InFolder):
    def assertSame(self, one, other, tolerance):
        for name in ("Displacement", "Cauchy_Stress"):
            first, second = (run.whole(name) for run in (one, other))
            self.assertLessEqual(np.abs(first - second).max(), tolerance * np.abs(first).max(), name)
        plastic = one.whole("Equivalent_Plastic_Strain")
        self.assertGreater(plastic.max(), 1e-3)
        self.assertLessEqual(np.abs(plastic - other.whole("User_State_7")).max(), tolerance * plastic.max())
        # This law counts by the flow stress, the built-in one by the mean stress of a step: 1.2 % apart where five load
        # steps go from rest into flow.
        for name in ("Elastic_Energy", "Plastic_Work"):
            self.assertAlmostEqual(one.history[name][-1] / other.history[name][-1], 1, delta=0.02)

    def test_steps_are_those_of_the_built_in_law(self):
        """Round-off of some hundred steps: 1e-9."""
        for formulation in ("Correspondence", "Quadratic Correspondence"):
            with self.subTest(formulation):
                runs = [strut.run(block.deck(Materials={"metal": {**law, "Formulation": formulation}}), block.mesh())
                        for law in (built_in(), umat())]
                self.assertSame(*runs, 1e-9)

    def test_equilibria_are_those_of_the_built_in_law_in_as_many_iterations(self):
        """Newton's method with tangents by differences: a tangent that were not the law's would take more. Both are
        balanced to 1e-6 of the load, the default."""
        conditions = block.deck()["Boundary Conditions"]
        top = {**conditions["top"], "Type": "Prescribed Displacement", "Value": "-8e-5*t"}  # 1 %, yield at 0.3 %
        for formulation in ("Correspondence", "Quadratic Correspondence"):
            with self.subTest(formulation):
                runs = [strut.run(block.deck(Materials={"metal": {**law, "Formulation": formulation}},
                                             Solver={"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 5}},
                                             **{"Boundary Conditions": {**conditions, "top": top}}), block.mesh())
                        for law in (built_in(), umat())]
                self.assertSame(*runs, 1e-5)
                one, other = ([int(n) for n in re.findall(r"(\d+) iterations,", run.log)] for run in runs)
                self.assertEqual(len(one), 6)  # five load steps and their sum
                self.assertLessEqual(abs(other[-1] - one[-1]), 1, (one, other))

    def test_with_substeps_it_has_the_same_bits_when_continued_and_on_two_ranks(self):
        """The foot is 16 times as stiff and takes steps of its own."""
        one = block.mesh()
        elements = one.blocks["block"]
        foot = one.nodes[elements].mean(axis=1)[:, 2] < block.SPACING
        mesh = strut.mesh(one.nodes, {"soft": elements[~foot], "hard": elements[foot]}, one.sets)
        mesh.write("block.g")
        stiff = {**umat(), "Young's Modulus": 16 * E, "Constants": [16 * E, NU, YIELD, HARDENING, 0]}
        blocks = {name: {"Block Names": name, "Material": name, "Horizon Factor": 1.75} for name in ("soft", "hard")}
        deck = block.deck(Materials={"soft": umat(), "hard": stiff}, Blocks=blocks, Restart={"Filename": "block.restart"})
        output = {"Output Interval": 1e-6, "Output Variables": {"Displacement": True, "Cauchy_Stress": True, "User_State_7": True}}
        whole = strut.run(strut.Deck({**deck, "Output": {**output, "Output Filename": "one.e"}}), mesh)
        self.assertIn("the stiffest points were subcycled", whole.log)
        self.assertGreater(whole.whole("User_State_7").max(), 1e-3)
        run = strut.Run(deck, mesh)
        run.advance(steps=8)
        run.end()
        again = strut.run(deck, mesh, continued=True)
        self.assertGreater(whole.steps, 12)
        for name in ("Cauchy_Stress", "User_State_1", "User_State_7"):
            np.testing.assert_array_equal(again.fields[name], whole.fields[name], err_msg=name)
        if "STRUT_MPIRUN" in os.environ:
            two = strut.Deck({**deck, "Output": {**output, "Output Filename": "two.e"}, "History": None,
                              "Discretization": {"Type": "Exodus", "Input Mesh File": "block.g"}})
            pathlib.Path("deck.xml").write_text(two.to_xml())
            for command in ([*os.environ["STRUT_MPIRUN"].split(), "-n", "2", os.environ["STRUT"], "deck.xml"],
                            [os.environ["STRUT_COMPARE"], "one.e", "two.e", "--relative", "0"]):
                done = subprocess.run(command, capture_output=True, text=True, env=environment())
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def fault_of(self, wrong, words=(), before=()):
        block.mesh().write("block.g")
        deck = block.deck(Materials={"metal": umat(wrong)}, Discretization={"Type": "Exodus", "Input Mesh File": "block.g"},
                          History=None)
        pathlib.Path("deck.xml").write_text(deck.to_xml())
        done = subprocess.run([*before, os.environ["STRUT"], *words, "deck.xml"], capture_output=True, text=True,
                              env=environment(), timeout=120)
        self.assertNotEqual(done.returncode, 0, done.stdout)
        return done.stdout + done.stderr

    def test_what_it_does_wrong_once_it_has_flowed_is_told_with_its_file_and_the_point(self):
        ended, crashed = "ended the program (STOP, XIT, exit) at the point with", "crashed at the point with"
        for wrong, expected in {1: ended, 2: ended, 3: "changed a state variable beyond its State Variables",
                                4: "gave a stress, a state variable or an energy that is no number", 5: "found no stress (PNEWDT",
                                6: crashed, 7: crashed, 8: crashed}.items():
            for threads in (1, 2):
                with self.subTest(wrong, threads=threads):
                    said = self.fault_of(wrong, ["--threads", str(threads)])
                    self.assertIn(expected, said)
                    self.assertEqual(said.count(f"strut: the library {LIBRARY} "), 1 if wrong in (1, 2, 6, 7, 8) else 0, said)
                    self.assertIn(LIBRARY, said)
                    place = re.search(r"reference position \(([-\d.e]+), ([-\d.e]+), ([-\d.e]+)\)", said)
                    self.assertIsNotNone(place, said)
                    # A point of the outer layers, which flow first: their middle is half a spacing from the end.
                    self.assertLess(abs(abs(float(place[3]) - 4e-3) - 3.5e-3), 1.1e-3, said)

    @unittest.skipUnless("STRUT_MPIRUN" in os.environ, "no mpirun is named")
    def test_a_fault_of_one_rank_ends_all(self):
        for wrong in (1, 4, 7):
            with self.subTest(wrong):
                self.assertIn(LIBRARY, self.fault_of(wrong, before=[*os.environ["STRUT_MPIRUN"].split(), "-n", "2"]))

    def test_a_constant_or_a_state_variable_too_few_is_told(self):
        with self.assertRaisesRegex(strut.Error, "position .*changed a state variable beyond its State Variables"):  # in flow
            strut.run(block.deck(Materials={"metal": umat(states=6)}), block.mesh())
        with self.assertRaisesRegex(strut.Error, "for a strain of 1e-7 changed a state variable beyond"):  # at the start
            strut.check(block.deck(Materials={"metal": umat(states=5)}), block.mesh())
        with self.assertRaisesRegex(strut.Error, "no number; does it have all its Constants"):
            strut.check(block.deck(Materials={"metal": {**umat(), "Constants": [E]}}), block.mesh())


if __name__ == "__main__":
    unittest.main()
