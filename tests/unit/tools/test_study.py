#!/usr/bin/python3
"""tools/study: whole studies of bars in free flight, whose outcome is known, and of programs that fail or are stopped; orders of
convergence of power laws that are known."""
import csv
import json
import math
import os
import re
import signal
import subprocess
import time
import unittest
from types import SimpleNamespace

import matplotlib.pyplot

from tool_test import TOOLS, InFolder

from decks import Deck, Recipe
from strut_tools import history_of
from study_parts import bands, collect, convergence, grids, names, plan

DECK = """<ParameterList>
  <ParameterList name="Discretization"><Parameter name="Type" type="string" value="Exodus"/>
    <Parameter name="Input Mesh File" type="string" value="bar.g"/></ParameterList>
  <ParameterList name="Materials"><ParameterList name="copper">
    <Parameter name="Material Model" type="string" value="Elastic Correspondence"/>
    <Parameter name="Density" type="double" value="8930"/>
    <Parameter name="Young's Modulus" type="double" value="117e9"/>
    <Parameter name="Poisson's Ratio" type="double" value="0.35"/></ParameterList></ParameterList>
  <ParameterList name="Blocks"><ParameterList name="bar"><Parameter name="Block Names" type="string" value="all"/>
    <Parameter name="Material" type="string" value="copper"/>
    <Parameter name="Horizon Factor" type="double" value="1.75"/></ParameterList></ParameterList>
  <ParameterList name="Boundary Conditions"><ParameterList name="flight">
    <Parameter name="Type" type="string" value="Initial Velocity"/>
    <Parameter name="Coordinate" type="string" value="z"/>
    <Parameter name="Value" type="string" value="-1"/></ParameterList></ParameterList>
  <ParameterList name="Solver"><Parameter name="Final Time" type="double" value="1e-6"/></ParameterList>
  <ParameterList name="History"><Parameter name="Filename" type="string" value="bar.csv"/>
    <ParameterList name="Variables"><Parameter name="Mean_Displacement_Z" type="bool" value="true"/>
      <Parameter name="Mean_Velocity_Z" type="bool" value="true"/>
      <Parameter name="Mean_Velocity_X(cuts)" type="bool" value="Yes"/>
      <Parameter name="Mean_Velocity_Y(whole)" type="bool" value="1"/>
      <Parameter name="Mean_Velocity_Y" type="bool" value="no"/></ParameterList>
    <ParameterList name="Profiles"><ParameterList name="cuts"><Parameter name="Direction" type="string" value="0 0 1"/>
      <Parameter name="Layers" type="int" value="2"/></ParameterList>
      <ParameterList name="whole"><Parameter name="Direction" type="string" value="0 0 1"/>
      <Parameter name="Layers" type="int" value="1"/></ParameterList></ParameterList></ParameterList>
</ParameterList>
"""
IN_YAML = """# the same
Discretization: {Type: Exodus, Input Mesh File: bar.g}
Materials:
  copper: {Material Model: Elastic Correspondence, Density: 8930, Young's Modulus: 117e9, Poisson's Ratio: 0.35}
Blocks:
  bar: {Block Names: all, Material: copper, Horizon Factor: 1.75}
Boundary Conditions:
  flight: {Type: Initial Velocity, Coordinate: z, Value: "-1"}
Solver:
  Final Time: 1
History:
  Filename: bar.csv
  Variables: {Mean_Displacement_Z: true, Mean_Velocity_Z: yes}
"""
RECIPE = "name = bar\nshape = box\nsize = 4e-3 4e-3 8e-3\nspacing = 1e-3  # of a cube\n"
STUDY = """
deck = bar.xml     # beside this file
vary speed = 10 20
vary spacing = 1e-3 2e-3
set Boundary Conditions > flight > Value = -{speed}
set Solver > Final Time = {1e-5/speed}
set recipe spacing = {spacing}
collect = Mean_Displacement_Z Mean_Velocity_Z
plot = speed Mean_Velocity_Z by spacing beside -speed
"""
# Stands for strut: the first case waits for a signal, leaves a checkpoint, and ends when it is called once more.
SLOW = """#!/bin/sh
for deck in "$@"; do :; done
echo " 50 %  t = 1 s"
printf 'Time,Mean_Velocity_Z,strut\\n0,1,0\\n1,2,0\\n' > bar.csv
if [ "$1" = --continue ]; then echo went on >> ../went; exit 0; fi
if grep -q 'value="-20"' $deck; then printf 'strut: deck.xml: 1 problem\\n  Solver: it was expected\\nmpirun has ended\\n' >&2; exit 1; fi
trap 'touch bar.restart; exit 3' TERM
while :; do sleep 0.1; done
"""

# Stands for strut: what it writes is 2 + 3 h^1.5 with the spacing of the box of 4 x 4 x 8 mm in mm, and goes up and down with h.
GRIDS = """#!/usr/bin/python3
import re, sys
h = float(re.search(r"spacing *= *([^ #\\n]+)", open("bar.recipe").read())[1])
if "--check" in sys.argv:
    print("1,000 points, 5 bonds\\ncritical time step 1 s at the start; about 200 steps of 1 s (more)")
    print("estimated time 1 min 1.5 s to 2 min 3 s (0.1 s a step)")
else:
    n, m = int(4e-3 / h + 0.5), int(8e-3 / h + 0.5)
    h = (128 / (n * n * m)) ** (1 / 3)
    with open("bar.csv", "w") as file:
        print("Time,Mean_Displacement_Z,Mean_Velocity_Z", file=file)
        print(f"0,{2 + 3 * h**1.5!r},{(-1) ** n}", file=file)
"""


class Studies(InFolder):
    def setUp(self):
        super().setUp()
        for name, text in (("bar.xml", DECK), ("bar.recipe", RECIPE), ("bar.study", STUDY)):
            (self.folder / name).write_text(text)

    def start(self, *words, **environment):
        return subprocess.Popen([TOOLS / "study", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                cwd=self.folder, env={**os.environ, **environment})

    def study(self, *words, **environment):
        done = self.run_tool("study", *words, **environment)
        return done.returncode, done.stdout, done.stderr

    def rows(self):
        with open(self.folder / "out/study.csv", newline="") as file:
            return list(csv.DictReader(file))

    @unittest.skipUnless("STRUT" in os.environ, "STRUT names no program")
    def test_bars_fly_as_far_as_they_must_and_only_once(self):
        status, out, errors = self.study("bar.study", "out")
        self.assertEqual((status, errors), (0, ""), out)
        rows = self.rows()
        self.assertEqual([(r["speed"], r["spacing"]) for r in rows],
                         [("10", "1e-3"), ("10", "2e-3"), ("20", "1e-3"), ("20", "2e-3")])
        self.assertEqual([float(r["points"]) for r in rows], [128, 16, 128, 16])
        for row in rows:  # nine digits in the table
            self.assertAlmostEqual(float(row["Mean_Displacement_Z"]), -1e-5, delta=1e-13)
            self.assertAlmostEqual(float(row["Mean_Velocity_Z"]), -float(row["speed"]), delta=1e-6)
        self.assertGreater((self.folder / "out/study.png").stat().st_size, 10000)
        header = history_of(self.folder / "out/speed=10,spacing=1e-3/bar.csv")[0]
        self.assertEqual(list(header), names.columns_of(Deck(str(self.folder / "bar.xml"))))
        logs = [path.stat().st_mtime_ns for path in sorted(self.folder.glob("out/*/log"))]
        again = self.study("bar.study", "out")
        self.assertEqual(again[0], 0)
        self.assertEqual(logs, [path.stat().st_mtime_ns for path in sorted(self.folder.glob("out/*/log"))])
        # A value that has changed is a run of its own; the others stay.
        (self.folder / "bar.study").write_text(STUDY.replace("10 20", "10 40"))
        self.assertIn("speed=40,spacing=1e-3\n", self.study("bar.study", "out", "--list")[1])
        self.assertIn("speed=10,spacing=1e-3: done\n", self.study("bar.study", "out", "--list")[1])

    @unittest.skipUnless("STRUT" in os.environ, "STRUT names no program")
    def test_a_deck_in_yaml(self):
        (self.folder / "bar.yaml").write_text(IN_YAML)
        (self.folder / "bar.study").write_text(STUDY.replace("bar.xml ", "bar.yaml").replace("10 20", "10").replace("1e-3 2e-3", "2e-3"))
        status, out, errors = self.study("bar.study", "out")
        self.assertEqual((status, errors), (0, ""), out)
        self.assertAlmostEqual(float(self.rows()[0]["Mean_Displacement_Z"]), -1e-5, delta=1e-13)
        deck = Deck(str(self.folder / "bar.yaml"))
        self.assertEqual([float(deck.get("Blocks", "bar", "Horizon Factor")), float(deck.get("Materials", "copper", "Young's Modulus"))],
                         [1.75, 117e9])
        self.assertIn("spacing=0.0005", self.study("--converge", "spacing", "--ratio", "2", "bar.yaml", "grids", "--list")[1])
        (self.folder / "bar.yaml").write_text(IN_YAML.replace("bar.g}", "bar.g"))
        status, _, errors = self.study("bar.study", "other")
        self.assertEqual(status, 1)
        self.assertIn("bar.yaml is not a deck: ", errors)

    def test_the_band_of_curves(self):
        cases = []
        for speed, factor, last in (("10", 1, 0.3), ("10", 3, 0.4), ("20", 5, 0.4)):
            folder = self.folder / f"run{factor}"
            folder.mkdir()
            rows = "".join(f"0,{last * n / 4},{factor * 1e6 * last * n / 4},0\n" for n in range(5))
            (folder / "bar-curve.csv").write_text(f"Time (s),Strain (1),Stress (Pa) of F,Energy (J/m3)\n{rows}")
            cases.append(SimpleNamespace(folder=str(folder), deck="bar.xml", values={"speed": speed}))
        curves = bands.curves_of(cases, 3 * [{"error": ""}], "speed")
        self.assertEqual({c: {v: len(runs) for v, runs in of.items()} for c, of in curves.items()},
                         {"Stress (Pa) of F": {"10": 2, "20": 1}})
        drawing, axes = matplotlib.pyplot.subplots()
        bands.draw(axes, "Stress (Pa) of F", curves["Stress (Pa) of F"], "speed")
        strain, stress = axes.lines[0].get_data()
        self.assertAlmostEqual(strain[-1], 0.3)  # as far as both runs go
        self.assertAlmostEqual(stress[-1], 2 * 0.3)
        self.assertAlmostEqual(axes.collections[0].get_paths()[0].get_extents().ymax, 3 * 0.3)
        self.assertEqual(axes.lines[1].get_label(), "speed 20, 1 run")
        matplotlib.pyplot.close(drawing)
        (self.folder / "bar.study").write_text(STUDY + "band = speeed\ncurve =\n")
        self.assertIn("there is no 'speeed' that varies (did you mean 'speed'?)", self.study("bar.study", "out")[2])

    def test_a_study_that_was_stopped_goes_on_and_a_run_that_fails_does_not_stop_it(self):
        program = self.folder / "slow"
        program.write_text(SLOW)
        program.chmod(0o755)
        true = self.folder / "mesh"
        true.write_text("#!/bin/sh\nexit 0\n")
        true.chmod(0o755)
        (self.folder / "bar.study").write_text(STUDY.replace("1e-3 2e-3", "1e-3").split("collect")[0] + "collect = Mean_Velocity_Z\n")
        programs = {"STRUT": str(program), "STRUT_MESH": str(true)}
        first = self.start("bar.study", "out", "--jobs", "2", **programs)
        waited = self.folder / "out/speed=10,spacing=1e-3/bar.csv"
        for _ in range(200):
            if waited.exists():
                break
            time.sleep(0.1)
        time.sleep(0.5)
        first.send_signal(signal.SIGTERM)
        _, errors = first.communicate(timeout=60)
        self.assertEqual((first.returncode, errors), (1, "tools/study: stopped by a signal; the same command goes on with it\n"))
        state = self.folder / "out/speed=10,spacing=1e-3/state.json"
        before = json.loads(state.read_text())["seconds"]
        self.assertGreater(before, 0.5)  # it was let run so long
        status, out, errors = self.study("bar.study", "out", "--jobs", "2", **programs)
        self.assertGreater(json.loads(state.read_text())["seconds"], before)  # of both parts
        self.assertEqual((self.folder / "out/went").read_text(), "went on\n")
        self.assertEqual((status, errors), (1, "tools/study: 1 of 2 runs have no result: see the table\n"))
        self.assertEqual([(r["Mean_Velocity_Z"], r["error"]) for r in self.rows()],
                         [("2", ""), ("", "strut: deck.xml: 1 problem; Solver: it was expected")])

    def test_a_run_that_its_wall_time_stopped_is_no_result_and_an_error_that_passes_is_tried_again(self):
        programs = self.programs("""#!/bin/sh
printf 'Time,Mean_Displacement_Z,Mean_Velocity_Z\\n0,2,1\\n' > bar.csv
[ -e ../again ] && exit 0
grep -q 'value="-20"' bar.xml && { echo 'MPI_Init has failed'; exit 1; }
echo ' 68 %  t = 1 s'; exit 3
""")
        (self.folder / "bar.study").write_text(STUDY.replace("1e-3 2e-3", "1e-3").split("plot")[0])
        status, out, errors = self.study("bar.study", "out", **programs)
        self.assertEqual((status, errors), (1, "tools/study: 2 of 2 runs have no result: see the table\n"), out)
        self.assertEqual([(r["Mean_Velocity_Z"], r["error"]) for r in self.rows()],
                         [("", "stopped at 68 %; the same command goes on with it"), ("", "MPI_Init has failed")])
        (self.folder / "out/again").touch()
        self.assertEqual(self.study("bar.study", "out", **programs)[0], 0)
        self.assertEqual([(r["Mean_Velocity_Z"], r["error"]) for r in self.rows()], [("1", ""), ("1", "")])

    def test_ctrl_c_while_a_mesh_is_made_ends_it_and_leaves_the_run_to_be_made(self):
        programs = self.programs()
        (self.folder / "mesh").write_text('#!/bin/sh\ntouch ../begun; [ -e ../again ] || sleep 100\necho made > "$2"\n')
        (self.folder / "bar.study").write_text(STUDY.replace("10 20", "10").replace("1e-3 2e-3", "1e-3").split("plot")[0])
        words = [TOOLS / "study", "bar.study", "out"]
        first = subprocess.Popen(words, stderr=subprocess.PIPE, text=True, cwd=self.folder, env={**os.environ, **programs},
                                 start_new_session=True)
        while not (self.folder / "out/begun").exists():
            time.sleep(0.01)
        os.killpg(first.pid, signal.SIGINT)  # as a terminal does, to all that it shows
        self.assertIn("stopped by a signal", first.communicate(timeout=20)[1])
        self.assertFalse(json.loads((self.folder / "out/speed=10,spacing=1e-3/state.json").read_text())["over"])
        (self.folder / "out/again").touch()
        self.assertEqual(self.study("bar.study", "out", **programs)[0], 0)
        self.assertEqual([(r["Mean_Velocity_Z"], r["error"]) for r in self.rows()], [("1", "")])

    def programs(self, strut="#!/bin/sh\nprintf 'Time,Mean_Displacement_Z,Mean_Velocity_Z\\n0,2,1\\n' > bar.csv\n"):
        """Stand for strut, here one that writes a history, and for strut-mesh."""
        found = {}
        for name, variable, text in (("strut", "STRUT", strut), ("mesh", "STRUT_MESH", '#!/bin/sh\necho made > "$2"\n')):
            (self.folder / name).write_text(text)
            (self.folder / name).chmod(0o755)
            found[variable] = str(self.folder / name)
        return found

    def test_warnings_of_the_runs_are_told_once_each_and_counted(self):
        (self.folder / "bar.study").write_text(STUDY.replace("1e-3 2e-3", "1e-3").replace("plot = speed Mean_Velocity_Z", "plot = speed warnings"))
        status, out, errors = self.study("bar.study", "out", **self.programs("""#!/bin/sh
printf 'Time,Mean_Displacement_Z,Mean_Velocity_Z\\n0,2,1\\n' > bar.csv
grep -q 'value="-20"' bar.xml && echo 'WARNING: nothing moved' && t=2.5e-05 || t=5e-05
echo "WARNING: blocks a and b meet at about t = $t s"; echo "WARNING: blocks a and b meet at about t = 1 s"
"""))
        self.assertEqual((status, errors), (0, ""), out)
        self.assertEqual([row["warnings"] for row in self.rows()], ["1", "2"])
        self.assertEqual([line for line in out.splitlines() if "WARNING" in line],
                         ["WARNING in 2 of 2 runs, here speed=10,spacing=1e-3: blocks a and b meet at about t = 5e-05 s",
                          "WARNING in 1 of 2 runs, here speed=20,spacing=1e-3: nothing moved"])

    def test_steps_and_seconds_are_those_of_all_parts_of_a_run_that_went_on(self):
        size = "54 points, 900 bonds (24.3 a point)\n"
        loads, steps = ("whole run {}\n{} load steps, 9 iterations\n", "whole run {}\n{} steps, 2e+05 points*steps/s\n")
        last = steps + "balance error 2e-3 of the largest energy\n"

        def facts(*parts):
            (self.folder / "log").write_text("bar.g: 54 points, 90 nodes\n" + "".join(size + part for part in parts))
            found = collect.facts_of(SimpleNamespace(log=self.folder / "log"))
            return found.get("steps"), found.get("seconds")
        self.assertEqual(facts(last.format(4.75, 255)), (255, 4.75))
        self.assertEqual(facts(steps.format(4.75, 255), last.format(10.5, 496)), (751, 15.25))
        # Equilibria, then steps: the seconds of the second report have those of the first one in them.
        both = loads.format(2, 10) + last.format(5, 300)
        self.assertEqual(facts(both), (300, 5))
        self.assertEqual(facts(loads.format(1.5, 6), loads.format(2, 10) + steps.format(5, 300), last.format(4, 200)), (500, 10.5))
        self.assertEqual(facts("", last.format(4, 200)), (None, None))  # killed: how far it came, it does not say
        self.assertEqual(facts(""), (None, None))

    def convergence(self, folder="out"):
        with open(self.folder / folder / "convergence.csv", newline="") as file:
            return {row["measure"]: row for row in csv.DictReader(file)}

    def test_grids_of_a_study_give_the_order_the_limit_and_the_error_bar_by_the_spacings_that_were_meshed(self):
        (self.folder / "bar.study").write_text(STUDY.replace("10 20", "10").replace("1e-3 2e-3", "1e-3 0.7e-3 1.3e-3 0.45e-3"))
        programs = self.programs(GRIDS)
        words = ["--converge", "spacing", "bar.study", "out"]
        status, out, errors = self.study(*words, "--list", **programs)
        self.assertEqual((status, errors), (0, ""), out)
        self.assertFalse((self.folder / "out").exists())  # nothing has begun
        # From the 123 s of the coarsest grid, of 3 x 3 x 6 cells: 9 x 9 x 18 take 3^4 times as long, 27 times the cells.
        self.assertIn("| speed=10,spacing=0.45e-3 | 0.000444444 | 27,000 | 600 | 2.8 h |", out)
        self.assertIn("Predicted from strut --check of the coarsest grid", out)
        self.assertIn("4 of 4 left: ", out)
        status, out, errors = self.study(*words, **programs)
        self.assertEqual((status, errors), (0, ""), out)
        row = self.convergence()["Mean_Displacement_Z"]
        h = [(128e-9 / cells) ** (1 / 3) for cells in (9 * 9 * 18, 6 * 6 * 11, 4 * 4 * 8)]
        for n in range(3):  # nine digits in the table
            self.assertAlmostEqual(float(row[f"spacing_{n + 1}"]), h[n], delta=1e-12)
        self.assertAlmostEqual(float(row["order"]), 1.5, delta=1e-8)
        self.assertAlmostEqual(float(row["limit"]), 2, delta=1e-8)
        self.assertAlmostEqual(float(row["error_bar"]), 1.25 * 3 * (1e3 * h[0])**1.5, delta=1e-8)
        self.assertEqual((row["safety_factor"], row["finding"]), ("1.25", "converging"))
        row = self.convergence()["Mean_Velocity_Z"]  # -1, 1, 1: of 9, 6 and 4 cells
        self.assertEqual((row["order"], row["limit"], row["error_bar"], row["spread_percent"]), ("", "", "", "200"))
        self.assertEqual(row["finding"], "none: diverging (no difference between the two coarsest grids)")
        self.assertIn((self.folder / "out/convergence.txt").read_text(), out)
        self.assertIn("| Mean_Displacement_Z | 5, 3.7056, 2.8889 | 73 % | 1.50 | 2 | ± 1.1 (38 %) |", out)
        # Once they are done, the finest one is what is predicted from.
        out = self.study(*words, "--list", **programs)[1]
        self.assertIn("Predicted from speed=10,spacing=0.45e-3, which is done", out)
        self.assertIn("| speed=10,spacing=1e-3 | 0.001 | unknown | unknown | done in 0 s |", out)  # this one's log says nothing of them
        self.assertNotIn("left", out)

    def test_the_recipe_of_a_deck_is_refined_by_a_ratio(self):
        programs = self.programs(GRIDS)
        (self.folder / "bar.xml").write_text(re.sub(r'<Parameter name="Mean_Velocity_[XY].*/>', "", DECK))
        status, out, errors = self.study("--converge", "spacing", "--ratio", "2", "--grids", "2", "--order", "1.5", "bar.xml", "out", **programs)
        self.assertEqual((status, errors), (0, ""), out)
        self.assertEqual([path.name for path in sorted(self.folder.glob("out/spacing*"))], ["spacing=0.0005", "spacing=0.001"])
        row = self.convergence()["Mean_Displacement_Z"]
        self.assertAlmostEqual(float(row["error_bar"]), 3 * 3 * 0.5**1.5, delta=1e-8)  # nine digits
        self.assertEqual((row["order"], row["limit"], row["finding"]), ("", "", "two grids, order 1.5 assumed"))
        self.assertEqual(self.study("--converge", "spacing", "--ratio", "2", "bar.xml", "out", **programs)[0], 0)  # a third one
        self.assertAlmostEqual(float(self.convergence()["Mean_Displacement_Z"]["order"]), 1.5, delta=1e-7)

    def test_bodies_are_refined_in_proportion_and_graded_ones_and_files_are_refused(self):
        (self.folder / "bar.recipe").write_text("[body]\nname = foam\nshape = foam\nspacing = 1e-3\n[body]\nname = plate\nspacing = 2e-3\n")
        study = grids.study_of_deck(str(self.folder / "bar.xml"))
        grids.refine(study, 2, 3)
        bodies = [plan.files_of(study, case)[1].bodies() for case in study.cases()]
        self.assertEqual([[float(body["spacing"]) for body in both] for both in bodies],
                         [[1e-3, 2e-3], [0.5e-3, 1e-3], [0.25e-3, 0.5e-3]])
        (self.folder / "bar.recipe").write_text(RECIPE + "grading = 1.1\n")
        status, _, errors = self.study("--converge", "spacing", "bar.xml", "out")
        self.assertEqual((status, errors.count("\n")), (1, 1), errors)
        self.assertIn("the layers of 'bar' are graded", errors)
        (self.folder / "bar.recipe").write_text("[body]\nshape = file\nfile = skins.g\n[body]\nname = core\nspacing = 1e-3\n")
        status, _, errors = self.study("--converge", "spacing", "bar.xml", "out")
        self.assertEqual((status, errors.count("\n")), (1, 1), errors)
        self.assertIn("the body 'skins.g' is a file, whose cells would stay", errors)

    @unittest.skipUnless("STRUT_MESH" in os.environ, "STRUT_MESH names no program")
    def test_the_spacing_as_meshed_is_that_of_the_volume_of_a_cell(self):
        for lines, volume in (("shape = box\nsize = 4e-3 4.4e-3 8e-3\nspacing = 0.9e-3", 4e-3 * 4.4e-3 * 8e-3),
                              ("shape = cylinder\nmethod = fitted\nlength = 10e-3\nradius = 2e-3\nspacing = 0.57e-3", math.pi * 4e-6 * 10e-3)):
            path = self.folder / "one.recipe"
            path.write_text(lines + "\n")
            out = subprocess.run([os.environ["STRUT_MESH"], path, self.folder / "one.g"], capture_output=True, text=True, check=True).stdout
            points = int(re.search(r"([\d,]+) points", out)[1].replace(",", ""))
            self.assertAlmostEqual(grids.spacing_of(Recipe(str(path))), (volume / points) ** (1 / 3), delta=1e-15)  # round-off

    def test_a_lattice_may_have_the_count_of_its_cells(self):
        path = self.folder / "one.recipe"
        for count, edges in (("2 2 1", (4e-3 / 13, 4e-3 / 13, 2e-3 / 7)), ("2", (4e-3 / 13,) * 3)):
            path.write_text(f"shape = lattice\nlattice = bcc\ncount = {count}\ncell = 2e-3\nspacing = 0.3e-3\n")
            self.assertAlmostEqual(grids.spacing_of(Recipe(str(path))), math.prod(edges) ** (1 / 3), delta=1e-15)

    def test_results_that_lie_beside_the_deck_stay_as_they_are(self):
        mine = {"bar.csv": "Time,Mean_Velocity_Z\n0,7\n", "bar.e": "mine", "bar.restart": "mine", "bar.g": "mine"}
        for name, text in mine.items():
            (self.folder / name).write_text(text)
        status, out, errors = self.study("bar.study", "out", **self.programs())
        self.assertEqual((status, errors), (0, ""), out)
        self.assertEqual(mine, {name: (self.folder / name).read_text() for name in mine})
        self.assertEqual([path for path in self.folder.glob("out/*/*") if path.is_symlink()], [])
        self.assertEqual([float(row["Mean_Velocity_Z"]) for row in self.rows()], [1] * 4)

    def test_a_run_reads_the_files_that_its_deck_and_recipe_name_wherever_they_are(self):
        deck = DECK.replace('value="bar.g"', 'value="../meshes/bar.g"').replace(
            '<ParameterList name="Boundary Conditions">', '<ParameterList name="Boundary Conditions">\n'
            '<Parameter name="Node Set Foot" type="string" value="sets/foot"/>').replace(
            '<ParameterList name="Materials">', '<ParameterList name="Materials">\n<ParameterList name="mine">'
            '<Parameter name="Library" type="string" value="../laws/mine.so"/></ParameterList>').replace(
            '<ParameterList name="Boundary Conditions">', '<ParameterList name="Start From">'
            '<Parameter name="Checkpoint" type="string" value="../laws/one.restart"/></ParameterList>\n'
            '<ParameterList name="Boundary Conditions">\n<ParameterList name="pull">'
            '<Parameter name="Value" type="string" value="2*table(t, \'../laws/pull.csv\')"/></ParameterList>')
        (self.folder / "bar.recipe").unlink()
        for folder in ("meshes", "laws", "decks/sets"):
            (self.folder / folder).mkdir(parents=True)
        for name, text in (("decks/bar.xml", deck), ("decks/sets/foot", "1 2"), ("meshes/bar.g", "a mesh"),
                           ("laws/mine.so", "a law"), ("laws/one.restart", "a checkpoint"), ("laws/pull.csv", "0 1"),
                           ("decks/bar.study", "deck = bar.xml\nvary v = 1 2\nset Boundary Conditions > flight > Value = {v}\n")):
            (self.folder / name).write_text(text)
        programs = self.programs("#!/bin/sh\ncat bar.g sets/foot mine.so one.restart pull.csv && grep -q \"t, 'pull.csv')\" bar.xml && grep -q 'value=\"bar.g\"' bar.xml && grep -q 'value=\"mine.so\"' bar.xml || exit 1\n")
        status, out, errors = self.study("decks/bar.study", "out", **programs)
        self.assertEqual((status, errors), (0, ""), out)
        self.assertEqual(sorted(path.name for path in (self.folder / "out").iterdir()),
                         ["runs-of.json", "study.csv", "v=1", "v=2"])
        (self.folder / "meshes/bar.g").write_text("another mesh")  # is another run
        self.assertNotIn("done", self.study("decks/bar.study", "out", "--list")[1])
        # With a recipe each run makes its own mesh, and the one that is there stays.
        (self.folder / "meshes/bar.recipe").write_text(RECIPE + "shape = file\nfile = ../decks/sets/foot\n")
        status, out, errors = self.study("decks/bar.study", "out", **self.programs("#!/bin/sh\ngrep -q made bar.g && cat foot\n"))
        self.assertEqual((status, errors), (0, ""), out)
        self.assertEqual((self.folder / "meshes/bar.g").read_text(), "another mesh")

    def test_runs_never_write_into_one_file_or_over_what_they_read(self):
        def error(old, new, study=STUDY):
            (self.folder / "bar.xml").write_text(DECK.replace(old, new))
            (self.folder / "bar.study").write_text(study)
            status, _, errors = self.study("bar.study", "out", **self.programs())
            self.assertEqual((status, errors.count("\n")), (1, 1), errors)
            return errors
        self.assertIn("History > Filename '../bar.csv' leads out of the folder of a run", error("bar.csv", "../bar.csv"))
        self.assertIn(f"'{self.folder}/bar.csv' leads out", error("bar.csv", f"{self.folder}/bar.csv"))
        self.assertIn("History > Filename 'bar.g' is also the name of a file that a run needs", error("bar.csv", "bar.g"))
        self.assertIn("History > Filename './log' is also the name", error("bar.csv", "./log"))
        self.assertIn("the runs 'speed = 1, spacing = a b' and 'speed = 1, spacing = a/b' would both be in the folder speed=1,spacing=a-b",
                      error("", "", STUDY.replace("10 20", "1").replace("1e-3 2e-3", "a b | a/b")))
        self.assertFalse((self.folder / "out").exists())

    def test_two_studies_have_two_folders(self):
        programs = self.programs()
        (self.folder / "other.study").write_text(STUDY.replace("1e-3 2e-3", "1e-3").replace("{1e-5/speed}", "{2e-5/speed}"))
        self.assertEqual(self.study("bar.study", "out", **programs)[0], 0)
        before = {path: path.read_bytes() for path in self.folder.glob("out/**/*") if path.is_file()}
        status, _, errors = self.study("other.study", "out", **programs)
        self.assertEqual((status, errors.count("\n")), (1, 1), errors)
        self.assertIn(f"out has the runs of {self.folder.resolve()}/bar.study: name another folder", errors)
        self.assertEqual(before, {path: path.read_bytes() for path in self.folder.glob("out/**/*") if path.is_file()})
        (self.folder / "mine").mkdir()
        (self.folder / "mine/study.csv").write_text("mine")
        self.assertIn("mine/study.csv is there, and not of runs in this folder", self.study("bar.study", "mine", **programs)[2])
        # A table that is a link is made anew; what it was linked to stays.
        (self.folder / "out/study.csv").unlink()
        (self.folder / "kept").write_text("mine")
        (self.folder / "out/study.csv").symlink_to("../kept")
        self.assertEqual(self.study("bar.study", "out", **programs)[0], 0)
        self.assertEqual((self.folder / "kept").read_text(), "mine")

    def test_errors_are_one_line_that_helps(self):
        def error(old, new):
            (self.folder / "bar.study").write_text(STUDY.replace(old, new))
            status, _, errors = self.study("bar.study", "out", "--list")
            self.assertEqual((status, errors.count("\n")), (1, 1), errors)
            return errors
        self.assertIn("line 3: '1' and '1e0' are one value: expected each run once", error("vary speed = 10 20", "vary speed = 1 2 1e0"))
        os.mkfifo(self.folder / "pipe.study")
        self.assertIn("pipe.study is a pipe or a device", self.study("pipe.study", "out", "--list")[2])
        self.assertIn("line 3: there is no key 'very speed' (did you mean", error("vary speed", "very speed"))
        self.assertIn("no key 'Boundary Conditions > flight > Valu' (did you mean 'Value'?)", error("> Value", "> Valu"))
        self.assertIn("no section 'Solvr' (did you mean 'Solver'?)", error("Solver", "Solvr"))
        self.assertIn("'{sped}' is no number of what varies (did you mean 'speed'?)", error("{speed}", "{sped}"))
        self.assertIn("no line 'spacng' (did you mean 'spacing'?)", error("recipe spacing", "recipe spacng"))
        self.assertIn("'flow' varies, and no line 'set' has {flow}: all runs would be the same", error("vary spacing", "vary flow = 1 2\nvary spacing"))
        self.assertIn("line 7: 'set Solver>Final Time' again: expected one value", error("set recipe", "set Solver>Final Time = 1\nset recipe"))
        self.assertIn("line 4: 'deck' again: expected one value", error("vary speed = 10 20", "vary speed = 10 20\ndeck = other.xml"))
        self.assertIn("expected 'plot = X Y", error("plot = speed", "plot ="))
        self.assertIn("no 'Mean_Velocity_Y' to collect (did you mean 'Mean_Velocity_Z'?)",
                      error("collect = Mean_Displacement_Z Mean_Velocity_Z", "collect = Mean_Velocity_Y"))
        self.assertIn("no 'plateau_stress' to collect", error("collect =", "collect = plateau_stress"))  # without curve
        self.assertIn("no 'sped' to plot (did you mean 'speed'?)", error("plot = speed", "plot = sped"))
        self.assertIn("no 'plateau_stres' to plot (did you mean 'plateau_stress'?)",
                      error("collect = Mean_Displacement_Z Mean_Velocity_Z\nplot = speed Mean_Velocity_Z", "curve =\nplot = speed plateau_stres"))
        self.assertIn("no 'spacin' to plot (did you mean 'spacing'?)", error("by spacing", "by spacin"))
        self.assertIn("'beside -sped': 'sped' is not a variable (did you mean 'speed'?)", error("beside -speed", "beside -sped"))
        self.assertIn("curve: unknown option '--smoth' (did you mean '--smooth'?)", error("collect", "curve = --smoth 3\ncollect"))
        self.assertIn("curve: --force: there is no column 'Reaction_Z(top)'", error("collect", "curve = --force Reaction_Z(top)\ncollect"))
        self.assertIn("nobar.xml cannot be read", error("bar.xml", "nobar.xml"))

    def test_errors_of_converge_are_one_line_that_helps(self):
        def error(*words):
            status, _, errors = self.study(*words, "out", "--list", **self.programs(GRIDS))
            self.assertEqual((status, errors.count("\n")), (1, 1), errors)
            return errors
        self.assertIn("the study does not vary 'spacin' (did you mean 'spacing'?)", error("--converge", "spacin", "bar.study"))
        self.assertIn("bar.study varies spacing itself: leave out --ratio", error("--converge", "spacing", "--ratio", "2", "bar.study"))
        self.assertIn("--order needs --converge", error("--order", "2", "bar.study"))
        self.assertIn("--grids: invalid choice: 4 (choose from 2, 3)", error("--converge", "spacing", "--grids", "4", "bar.xml"))
        (self.folder / "bar.study").write_text(STUDY.replace("1e-3 2e-3", "1e-3 0.99e-3"))
        self.assertIn("spacing = 0.99e-3 and 1e-3 are one grid, of whole numbers of cells of 0.001 m", error("--converge", "spacing", "bar.study"))
        (self.folder / "bar.study").write_text(STUDY.replace("1e-3 2e-3", "1e-3"))
        self.assertIn("spacing has one value: expected two or three", error("--converge", "spacing", "bar.study"))
        (self.folder / "bar.study").write_text(STUDY.split("collect")[0])
        self.assertIn("nothing is read off the runs that could converge", error("--converge", "spacing", "bar.study"))
        (self.folder / "bar.study").write_text(STUDY)
        (self.folder / "bar.recipe").unlink()
        self.assertIn("its mesh has no recipe beside it whose spacing could be refined", error("--converge", "spacing", "bar.xml"))

    def test_values_go_together_or_in_all_combinations(self):
        study = plan.Study("here")
        plan.take_vary(study, "here", ["a", "b"], "one word, | two words, 6")
        plan.take_vary(study, "here", ["c"], "1 2")
        self.assertEqual(study.cases(), [{"a": "one word", "b": "", "c": "1"}, {"a": "one word", "b": "", "c": "2"},
                                         {"a": "two words", "b": "6", "c": "1"}, {"a": "two words", "b": "6", "c": "2"}])
        self.assertEqual(plan.filled("{a} {c} {2^3*c}", study.cases()[3], "here"), "two words 2 16")


class Convergence(unittest.TestCase):
    """Grids, the finest first; the power law is f = 7 - 2 h^p."""

    def test_power_laws_give_their_order_limit_and_error_bar_by_any_ratios(self):
        for sizes in ((1, 2, 4), (1, 1.3, 1.7), (1, 1.17, 1.4), (0.5, 0.6, 1.5), (1, 3, 3.5)):
            for order in (0.5 + 1e-6, 0.8, 1, 1.5, 2, 2.4):
                values = [7 - 2 * h**order for h in sizes]
                # Round-off of values of up to 40 in differences of 0.1 and more: 40/0.1 times 2e-16, over ln of the ratio, 0.15.
                self.assertAlmostEqual(convergence.observed_order(sizes, values), order, delta=1e-12)
                found = convergence.of_grids(sizes, values, 1)
                self.assertEqual((found.grids, found.finding, found.safety), (3, "converging", 1.25))
                self.assertAlmostEqual(found.limit, 7, delta=1e-10)  # the order's, over the same differences
                self.assertAlmostEqual(found.bar, 1.25 * 2 * sizes[0]**order, delta=1e-10)
                self.assertAlmostEqual(found.percent(values[0]), 100 * found.bar / abs(values[0]), delta=1e-12)

    def test_the_finest_three_of_more_grids_count(self):
        values = [7 - 2 * h for h in (1, 2, 3)]
        self.assertAlmostEqual(convergence.of_grids((1, 2, 3, 4), [*values, 1e9], 1).limit, 7, delta=1e-12)

    def test_where_there_is_no_order_no_number_is_told(self):
        for values, finding in (((1, 2, 1.5), "none: oscillating"),
                                ((1, 2, 2.9), "none: diverging"),  # coarser grids differ less
                                ((1, 2, 3), "none: diverging"),  # of h in equal ratios: the logarithm, order 0
                                ((1, 2, 3.1), "none: out of the asymptotic range (an order of 0.14, expected 0.5 to 2.5)"),
                                ((1, 2, 10), "none: out of the asymptotic range (an order of 3, expected 0.5 to 2.5)"),
                                ((1, 1, 2), "none: out of the asymptotic range (no difference between the two finest grids)"),
                                ((1, 2, 2), "none: diverging (no difference between the two coarsest grids)"),
                                ((3, 3, 3), "none: no difference between the grids")):
            self.assertEqual(convergence.of_grids((1, 2, 4), values, 1), convergence.Found(3, finding))
        self.assertEqual(convergence.of_grids((1,), (5,), 1), convergence.Found(1, "none: no value on two grids"))
        # A scheme of the third order, told so, may show it.
        self.assertAlmostEqual(convergence.of_grids((1, 2, 4), (1, 2, 10), 3).order, 3, delta=1e-12)

    def test_two_grids_have_the_theoretical_order_and_a_factor_of_three(self):
        found = convergence.of_grids((1, 1.5), (10, 11), 2)
        self.assertEqual((found.order, found.limit, found.safety, found.finding), (None, None, 3, "two grids, order 2 assumed"))
        self.assertAlmostEqual(found.bar, 3 / (1.5**2 - 1), delta=1e-14)


if __name__ == "__main__":
    unittest.main()
