#!/usr/bin/python3
"""Equilibria that start from the checkpoint of another run (Start From): bodies that rested, tools, friction, heat and loads do from the
first load step on what they do in one run."""
import os
import pathlib
import unittest
import warnings

import block
import numpy as np
import strut
from block import SPACING
from starts import InFolder, but, ended, run_on, scene, start

SLOW = {"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 4, "Tolerance": 1e-8}}
STEPS = {"Final Time": 1e-6}


def held(nodes, axes, value="0"):
    return {"Type": "Prescribed Displacement", "Node Set": nodes, "Coordinate": axes, "Value": value}


class StartsOfEquilibria(InFolder):
    def setUp(self):
        super().setUp()
        warnings.simplefilter("ignore")

    def elastic(self, **sections):
        """Elastic metal, without anything that holds it."""
        metal = {**block.deck()["Materials"]["metal"], "Material Model": "Elastic Correspondence", "Yield Stress": None}
        variables = dict.fromkeys(("Max_Displacement", "Sum_Force_Z(block_zmin)", "Sum_Force_Z(block_zmax)"), True)
        deck = block.deck(Materials={"metal": metal}, History={"Frequency": 1, "Variables": variables})
        return but(deck, **{"Boundary_Conditions": {}, "Solver": SLOW, **sections})

    def test_the_first_row_of_equilibria_has_the_reactions_of_the_body(self):
        """Held points with loads on them, a symmetry plane or periodic sides: the last row of the run it starts from, at another time."""
        metal = {**block.deck()["Materials"]["metal"], "Yield Stress": 2e9}  # cells have other forces where they begin to flow
        conditions = {"foot": {"Type": "Prescribed Displacement", "Node Set": "block_zmin", "Coordinate": "z", "Value": "0"},
                      "weight": {"Type": "Body Force", "Node Set": "all", "Coordinate": "z", "Value": "-1e9"}}
        plane = {"Type": "Symmetry Plane", "Node Set": "block_xmax", "Point": [4 * SPACING, 0, 0], "Normal": [-1, 0, 0]}
        sides = {"Type": "Periodic Sides", "Coordinate": "y", "Lower": 0.0, "Upper": 5 * SPACING}
        columns = ("Reaction_Z(top)", "Reaction_Z(foot)", "Reaction_X(side)", "Reaction_Y(side)")
        for what, law, side in (("plane", metal, plane), ("sides", metal, sides),
                                ("cells", {**metal, "Formulation": "Quadratic Correspondence"}, plane)):
            with self.subTest(what):
                deck = but(block.deck(), Materials={"metal": law}, History={"Frequency": 1, "Variables": dict.fromkeys(columns, True)},
                           Solver={"Final Time": 1.0, "QuasiStatic": {"Number of Load Steps": 2}})

                def pressed(way):
                    top = {"Type": "Prescribed Displacement", "Node Set": "block_zmax", "Coordinate": "z", "Value": way}
                    return {"Boundary_Conditions": {**conditions, "side": side, "top": top}}

                first = strut.run(but(deck, Restart={"Filename": "first.restart"}, **pressed("-2e-5*t")), block.mesh())
                run = strut.run(start(deck, "first.restart", **pressed("-2e-5*(1 + t)")), block.mesh())
                for column in columns:
                    last = first.history[column][-1]
                    self.assertAlmostEqual(run.history[column][0], last, delta=1e-9 * max(abs(last), 1), msg=column)

    def test_a_body_that_rested_in_steps_is_pressed(self):
        pressed = {"foot": held("block_zmin", "xyz"), "top": held("block_zmax", "z", "-2e-5*t")}
        strut.run(self.elastic(Solver=STEPS, Restart={"Filename": "first.restart"}), block.mesh())
        deck = self.elastic(Boundary_Conditions=pressed)
        fresh, run = strut.run(deck, block.mesh()), strut.run(start(deck, "first.restart"), block.mesh())
        energy = fresh.history["Elastic_Energy"][-1]
        self.assertGreater(energy, 0)
        self.assertAlmostEqual(run.history["Elastic_Energy"][-1] / energy, 1, delta=1e-6)

    def test_a_tool_holds_on_in_steps_after_equilibria(self):
        deck = scene("press")
        load_steps = deck["Solver"]["QuasiStatic"]
        end = 4 / load_steps["Number of Load Steps"] * deck["Solver"]["Final Time"]
        for at in (end, 0.0):
            with self.subTest(at):
                solver = lambda **times: {**times, "QuasiStatic": {**load_steps, "Number of Load Steps": 2}}
                held_there = {**deck["Boundary Conditions"]}
                held_there["plate"] = {**held_there["plate"], "Travel Z": f"{-0.003 * end}"}
                strut.run(but(deck, Solver=solver(**{"Final Time": end}), Restart={"Filename": "first.restart"}))
                second = but(deck, Boundary_Conditions=held_there, Solver=solver(**{"Final Time": at + 1}), **{"Solver 2": {"Final Time": at + 1 + 1e-5}})
                run = strut.run(start(second, "first.restart", at))
                reaction = run.history["Reaction_Z(plate)"]
                last = np.searchsorted(run.history["Time"], at + 1)
                self.assertGreater(abs(reaction[last]), 0)
                self.assertAlmostEqual(reaction[-1] / reaction[last], 1, delta=0.02)

    def test_bodies_that_are_first_heated_here_expand(self):
        metal = {**self.elastic()["Materials"]["metal"], "Thermal Expansion Coefficient": 1e-5}
        deck = self.elastic(Materials={"metal": metal}, Solver={"Final Time": 1e-6, "Verlet": {"Fixed dt": 1e-7}})
        first = ended(deck, 5, block.mesh())
        heated = {"warmth": {"Type": "Prescribed Temperature", "Node Set": "all", "Value": f"300 + 1e9*(t - {first.time!r})"}}
        run = strut.run(start(but(deck, Boundary_Conditions=heated), "first.restart", first.time), block.mesh())
        self.assertIn("goes on with its steps", run.log)
        self.assertGreater(run.history["Max_Displacement"][-1], 1e-7)

    def test_the_first_heat_of_a_pressed_body_does_its_whole_work(self):
        metal = {**self.elastic()["Materials"]["metal"], "Thermal Expansion Coefficient": 1e-5}
        pressed = {"foot": held("block_zmin", "xyz"), "top": held("block_zmax", "xyz", "-2e-5*t")}
        deck = self.elastic(Materials={"metal": metal}, Boundary_Conditions=pressed)
        strut.run(but(deck, Restart={"Filename": "first.restart"}), block.mesh())
        warmth = {"Type": "Prescribed Temperature", "Node Set": "all", "Value": "300 + 100*t"}
        here = {"foot": pressed["foot"], "top": held("block_zmax", "xyz", "-2e-5"), "warmth": warmth}
        run = strut.run(start(but(deck, Boundary_Conditions=here), "first.restart"), block.mesh())
        self.assertLess(run.history["Balance_Error"][-1], 0.01)  # the rule of the trapezoid; 0.06 without the stress that is there

    def test_friction_of_steps_does_work_from_the_first_load_step_on(self):
        places = [(x, y, z) for z in range(6) for y in range(4) for x in range(4)]
        np.savetxt("two.txt", [[SPACING * (n + 0.5) for n in one] + [1 + (one[2] > 2), SPACING**3] for one in places],
                   fmt=["%.17g"] * 3 + ["%d", "%.17g"])
        of = lambda number: {"Block Names": f"block_{number}", "Material": "metal", "Horizon Factor": 1.75, "Separate Body": True}
        contact = {"Models": {"touch": {"Contact Model": "Surface", "Friction Coefficient": 0.5}},
                   "Interactions": {"General Contact": {"Contact Model": "touch"}}}
        moved = lambda x, z: {"foot": held("bottom", "xyz"), "aside": held("top", "x", x), "y": held("top", "y"), "down": held("top", "z", z)}
        ramp = "t < 1e-4 ? {0}*t/1e-4 : {0}".format
        deck = self.elastic(Discretization={"Type": "Text File", "Input Mesh File": "two.txt"}, Blocks={"low": of(1), "high": of(2)},
                            Node_Sets={"bottom": "z < 1e-3", "top": "z > 5e-3"}, Contact=contact, History={"Frequency": 1})
        strut.run(but(deck, Boundary_Conditions=moved(ramp("8e-6"), ramp("-2e-5")), Solver={"Final Time": 2e-4}, Restart={"Filename": "first.restart"}))
        run = strut.run(start(but(deck, Boundary_Conditions=moved("8e-6*(1 - t)", "-2e-5")), "first.restart", keep_velocities=False))
        self.assertLess(np.ptp(run.history["Balance_Error"]), 1e-4)  # 0.012 without the friction of the steps

    def test_other_tools_begin_anew(self):
        pressed = lambda travel: {"foot": held("block_zmin", "xyz"), "plate": {"Type": "Rigid Plane", "Point": [0, 0, 8 * SPACING],
                                                                              "Normal": [0, 0, -1], "Travel Z": travel}}
        deck = self.elastic(Boundary_Conditions=pressed("-2e-5*t"))
        strut.run(but(deck, Restart={"Filename": "first.restart"}), block.mesh())
        unloaded = but(deck, Boundary_Conditions=pressed("-2e-5*(2 - t)"), Solver={**SLOW, "Final Time": 2.0})
        run = strut.run(start(unloaded, "first.restart", 1.0), block.mesh())
        self.assertLess(run.history["Balance_Error"][-1], 0.01)  # 0.25 where half of the plate's first work was lost

    def test_loads_are_in_the_forces_of_every_row(self):
        weight = {"Type": "Body Force", "Node Set": "all", "Coordinate": "z", "Value": "-1e8*t"}
        damage = {"Damage Models": {"brittle": {"Damage Model": "Critical Stretch", "Critical Stretch": 0.5}},
                  "Blocks": {"block": {**block.deck()["Blocks"]["block"], "Damage Model": "brittle"}}}
        for more in ({}, damage):
            with self.subTest(more=bool(more)):
                deck = but(self.elastic(Boundary_Conditions={"foot": held("block_zmin", "xyz"), "weight": weight}), **more)
                first = ended(deck, 2, block.mesh())
                run = strut.run(start(deck, "first.restart", first.time), block.mesh())
                self.assertIn("goes on with its steps", run.log)
                for name, scale in (("block_zmax", 1e-4), ("block_zmin", None)):
                    force = run.history[f"Sum_Force_Z({name})"]
                    load = 1e8 * run.history["Time"] * SPACING**3 * (len(block.solid()) * 5 - 1) * 8
                    if scale:  # free points are in equilibrium, held ones bear all of the load
                        self.assertLess(np.abs(force).max(), scale * load[-1], name)
                    else:
                        self.assertLess(np.abs(force + load).max(), 1e-3 * load[-1], name)

    def test_steps_of_bodies_that_may_break_only_here_do_not_go_on(self):
        """No bond's force is known at the checkpoint: the first that break would dissipate too little."""
        deck = self.elastic(Solver={"Final Time": 1e-6, "Verlet": {"Fixed dt": 1e-7}})
        first = ended(deck, 5, block.mesh())
        blocks = {"block": {**deck["Blocks"]["block"], "Damage Model": "brittle"}}
        damage = {"brittle": {"Damage Model": "Critical Stretch", "Critical Stretch": 0.5}}
        second = but(deck, Blocks=blocks, Damage_Models=damage)
        self.assertNotIn("goes on with its steps", strut.Run(start(second, "first.restart", first.time), block.mesh()).log)

    @unittest.skipUnless("STRUT_MPIRUN" in os.environ, "no mpirun is named")
    def test_a_rank_without_points_starts_too(self):
        """Heated points, and a later deck that heats nothing and is continued."""
        np.savetxt("two.txt", [[0.5e-3, 0, 0, 1, 1e-9], [1.5e-3, 0, 0, 1, 1e-9]], fmt=["%.17g"] * 3 + ["%d", "%.17g"])
        solid = {"Material Model": "Elastic", "Density": 2700.0, "Young's Modulus": 70e9, "Poisson's Ratio": 0.25,
                 "Thermal Expansion Coefficient": 1e-5}
        warmth = {"warmth": {"Type": "Prescribed Temperature", "Node Set": "all", "Value": "300 + 1e8*t"}}
        deck = self.elastic(Discretization={"Type": "Text File", "Input Mesh File": "two.txt"}, Materials={"metal": solid},
                            Blocks={"block": {"Block Names": "block_1", "Material": "metal", "Horizon": 1.75e-3}},
                            Boundary_Conditions=warmth, Solver={"Final Time": 1e-7, "Verlet": {"Fixed dt": 1e-8}}, History=None)
        strut.run(but(deck, Restart={"Filename": "first.restart"}))
        for conditions in (warmth, {}):
            for name, more in (("second", []), ("longer", ["--continue"])):
                second = but(deck, Boundary_Conditions=conditions, Restart={"Filename": "second.restart"})
                second = start(second, "first.restart", 1e-7)
                second["Solver"]["Final Time"] = 2e-7 if name == "second" else 3e-7
                pathlib.Path("second.xml").write_text(second.to_xml())
                told = run_on(3, *more, "second.xml")
                self.assertEqual(told.returncode, 0, told.stdout + told.stderr)


if __name__ == "__main__":
    unittest.main()
