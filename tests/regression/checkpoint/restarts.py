#!/usr/bin/python3
"""Runs that are ended in every way go on to the same end.

  restarts.py [--kills N] [--seed S] [--scene NAME] strut strut-compare mpirun [its options]

Scenes: in explicit steps a plastic bar that strikes a plane with an ordinary elastic one behind it (points that are
subcycled, contact, friction, viscosity, reactions), the same by quadratic correspondence, and with bonds that break,
and between periodic sides, while bodies are warmed; equilibria between tools, also while periodic sides come nearer and
bodies are warmed, of surfaces that rub on each other, and of a bar that is torn. Each is run once without a break. Then
it is ended by SIGTERM, by its wall time again and again, by N SIGKILLs at random times (a checkpoint is written every third step, so
that many of them come in the middle of that, of a frame or of a line), by the loss of a rank, by a full disk; and goes
on. Histories must be the same to the last byte and fields to the last bit on as many ranks; 1e-12 on others.
"""
import argparse
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tools/shared"))
from strut_tools import is_open_mpi  # noqa: E402

SPACING = 0.004
GAP = 0.0005  # between the two bars
PERIOD = 7  # points from one periodic side to the other


def points(path, scene):
    """Two bars, one above the other, with a gap between: no two points alike, so that a mistake has nowhere to hide. The flap is one layer,
    nearly flat, at a side of the lower one: its points are subcycled."""
    width = PERIOD if scene in ("periodic", "stretched") else 5
    between = 0 if scene == "rubbing" else GAP
    rng = random.Random(1)
    with open(path, "w") as file:
        for k in range(14):
            for j in range(5):
                for i in range(width):
                    x, y, z = (SPACING * (n + 0.1 * rng.random()) for n in (i - width // 2, j - 2, k + 0.5))
                    block, gap = (1, 0) if k < 8 else (2, between)
                    file.write(f"{x:.17g} {y:.17g} {z + gap:.17g} {block} {SPACING**3:.17g}\n")
        for j in (-1, 0, 1) if scene == "cells" else ():
            z = 4 + 0.2 * (1 if j else -1)
            file.write(f"{3 * SPACING:.17g} {j * SPACING:.17g} {z * SPACING:.17g} 1 {SPACING**3:.17g}\n")


def section(name, *content):
    return f'<ParameterList name="{name}">' + "\n".join(content) + "</ParameterList>"


def keys(**values):
    kinds = {bool: "bool", int: "int", float: "double", str: "string"}
    text = lambda value: str(value).lower() if isinstance(value, bool) else str(value)
    return "\n".join(
        f'<Parameter name="{name.replace("_", " ")}" type="{kinds[type(value)]}" value="{text(value)}"/>'
        for name, value in values.items()
    )


COMMON = [
    section("Node Sets", keys(foot=f"z < {1.2 * SPACING}", head=f"z > {13 * SPACING}").replace("<", "&lt;").replace("&lt;Param", "<Param")),
    section("Discretization", keys(Type="Text File", Input_Mesh_File="points.txt")),
    section(
        "Materials",
        section(
            "copper",
            keys(Material_Model="Elastic Plastic Correspondence", Density=8960.0, Yield_Stress=5e7),
            '<Parameter name="Young\'s Modulus" type="double" value="110e9"/>'
            '<Parameter name="Poisson\'s Ratio" type="double" value="0.3"/>',
            keys(Linear_Viscosity=0.06, Quadratic_Viscosity=1.2),
            section("Hardening", keys(Type="Power Law", Reference_Strain=0.00218, Exponent=0.1)),
        ),
        section(
            "steel",
            keys(Material_Model="Elastic", Density=7800.0),
            '<Parameter name="Young\'s Modulus" type="double" value="200e9"/>'
            '<Parameter name="Poisson\'s Ratio" type="double" value="0.3"/>',
        ),
    ),
]


def block(name, number, material):
    return section(name, keys(Block_Names=f"block_{number}", Material=material, Horizon=2.1 * SPACING, Separate_Body=True))


def plane(name, z, normal, friction=0.2, **more):
    place = f'<Parameter name="Point" type="Array(double)" value="{{0, 0, {z}}}"/>'
    direction = f'<Parameter name="Normal" type="Array(double)" value="{{0, 0, {normal}}}"/>'
    return section(name, keys(Type="Rigid Plane", Node_Set="all", Friction_Coefficient=friction, **more), place, direction)


def sinks(name, frame_every, line_every, *reactions, more=(), profiles=""):
    fields = ("Displacement", "Velocity", "Cauchy_Stress", "Equivalent_Plastic_Strain", "Dilatation", "Force")
    variables = [f"Reaction_Z({reaction})" for reaction in reactions] + ["Max_Equivalent_Plastic_Strain", *more]
    flags = lambda names: "\n".join(f'<Parameter name="{n}" type="bool" value="true"/>' for n in names)
    return [
        section(
            "Output",
            keys(Output_Filename=f"{name}.e", Output_Frequency=frame_every),
            section("Output Variables", flags(fields)),
        ),
        section("History", keys(Filename=f"{name}.csv", Frequency=line_every), section("Variables", flags(variables)),
                *([section("Profiles", profiles)] if profiles else [])),
    ]


def impact():
    return COMMON + [
        section("Blocks", block("lower", 1, "copper"), block("upper", 2, "steel")),
        section(
            "Contact",
            section(
                "Models",
                section(
                    "touch",
                    keys(Contact_Model="Short Range Force", Contact_Radius=1.1 * SPACING, Spring_Constant=1e12),
                    keys(Friction_Coefficient=0.3),
                ),
            ),
            section("Interactions", section("General Contact", keys(Contact_Model="touch"))),
        ),
        section(
            "Boundary Conditions",
            *(
                section(f"flight {axis}", keys(Type="Initial Velocity", Coordinate=axis, Node_Set="all", Value=speed))
                for axis, speed in (("x", "300*z"), ("z", "-150"))
            ),
            plane("wall", 0.0, 1, friction=0.0),  # a foot that it rubs has one level, here without substeps
            plane("punch", 13.62 * SPACING + 2 * GAP, -1, Mass=1e5 * SPACING**3, Speed_Z=-160.0),
        ),
        section("Solver", keys(Final_Time=1.5e-4)),
        *sinks("impact", 7, 2, "wall", "punch", more=("Contact_Force_X(block_1:block_2)", "Contact_Force_Z(block_2:block_1)",
                                             "Mean_Velocity_Z(cuts)"), profiles=section("cuts", keys(Layers=3))),
    ]


PRESSING = plane("plate", 13.62 * SPACING + GAP, -1, Travel_Z="-0.0015*t")


def press(end=0.4):
    """Load steps of 0.05 s, from the first on with plastic flow."""
    fields = COMMON + [
        section("Blocks", block("lower", 1, "copper"), block("upper", 2, "copper").replace("true", "false")),
        section(
            "Boundary Conditions",
            section("foot", keys(Type="Prescribed Displacement", Coordinate="xyz", Node_Set="foot", Value=0.0)),
            PRESSING,
        ),
        section("Solver", keys(Final_Time=end), section("QuasiStatic", keys(Number_of_Load_Steps=round(20 * end), Tolerance=1e-7))),
        *sinks("press", 3, 1, "foot", "plate"),
    ]
    text = "\n".join(fields)
    return [text.replace('name="Separate Body" type="bool" value="true"', 'name="Separate Body" type="bool" value="false"')]


def rubbing():
    """The upper bar is pressed on the lower one, then dragged along it: surfaces that touch, stick and slide."""
    text = "\n".join(press(0.7)).replace("press.", "rubbing.").replace("(plate)", "(drag)")
    held = lambda name, axis, value: section(
        name, keys(Type="Prescribed Displacement", Coordinate=axis, Node_Set="head", Value=value))
    assert PRESSING in text
    text = text.replace(PRESSING, held("down", "z", "-0.0002*t") + held("drag", "x", "(t &gt; 0.4)*(t - 0.4)*0.0015") + held("y", "y", "0"))
    text = text.replace('name="Separate Body" type="bool" value="false"', 'name="Separate Body" type="bool" value="true"')
    model = section("touch", keys(Contact_Model="Surface", Friction_Coefficient=0.3))
    contact = section("Models", model), section("Interactions", section("General Contact", keys(Contact_Model="touch")))
    return [text, section("Contact", *contact)]


def cells():
    """The impact, its copper by quadratic correspondence: law points of their own. Contact of surfaces."""
    text = "\n".join(impact()).replace("impact.", "cells.")
    model = 'value="Elastic Plastic Correspondence"/>'
    assert model in text
    of_points = keys(Contact_Model="Short Range Force", Contact_Radius=1.1 * SPACING, Spring_Constant=1e12)
    assert of_points in text
    text = text.replace(of_points, keys(Contact_Model="Surface"))
    return [text.replace(model, model + '<Parameter name="Formulation" type="string" value="Quadratic Correspondence"/>')]


def sides(**more):
    """The bars go on behind both sides across x, PERIOD points apart."""
    half = 0.5 * PERIOD * SPACING
    return section("sides", keys(Type="Periodic Sides", Coordinate="x", Lower=-half, Upper=half, **more))


def with_condition(text, condition):
    conditions = '<ParameterList name="Boundary Conditions">'
    assert conditions in text
    return text.replace(conditions, conditions + condition)


def warmed(text, temperature):
    """All bodies expand."""
    density = '<Parameter name="Density"'
    assert density in text
    text = text.replace(density, keys(Thermal_Expansion_Coefficient=2e-5) + density)
    return with_condition(text, section("warmth", keys(Type="Prescribed Temperature", Node_Set="all", Value=temperature)))


def periodic():
    """The same between periodic sides, through which bonds and contact go, while bodies are warmed."""
    text = warmed(cells()[0].replace("cells.", "periodic."), "293 + 1e6*t*(1 + 10*z)")
    return [with_condition(text, sides()).replace('"Reaction_Z(wall)"', '"Reaction_X(sides)" type="bool" value="true"/><Parameter name="Reaction_Z(wall)"')]


def stretched():
    """The equilibria between tools, while the periodic sides come nearer and bodies are warmed."""
    text = warmed(press()[0].replace("press.", "stretched."), "293 + 100*t*(1 + 10*z)")
    return [with_condition(text, sides(Stretch="1 - 0.01*t"))]


def apart():
    """The same, with bonds that break: those of the copper by their stretch, of the steel by their energy, which the history follows."""
    text = "\n".join(cells()).replace("cells.", "breaking.")
    material, steel = '<Parameter name="Material" ', '<Parameter name="Material" type="string" value="steel"'
    text = text.replace(material, keys(Damage_Model="brittle") + material)
    text = text.replace(keys(Damage_Model="brittle") + steel, keys(Damage_Model="by energy") + steel)
    models = [section("brittle", keys(Damage_Model="Critical Stretch", Critical_Stretch=0.02)),
              section("by energy", keys(Damage_Model="Bond Energy", Fracture_Energy=200.0))]
    crack = section("Cracks", section("up", keys(Direction="0 0 1", Damage=0.1)))
    columns = '<ParameterList name="Variables">'
    text = text.replace(columns, crack + columns + "".join(
        f'<Parameter name="{name}(up)" type="bool" value="true"/>' for name in ("Crack_Tip", "Crack_Speed")))
    return [text, section("Damage Models", *models)]


def breaking():
    """The same, while bodies are warmed."""
    text, models = apart()
    return [warmed(text, "293 + 1e6*t*(1 + 10*z)"), models]


def tearing():
    """As apart() with points that fail, by correspondence, of a metal that heats."""
    text = apart()[0]
    heating = section("Heating", keys(Specific_Heat=383.0))
    yields = '<Parameter name="Yield Stress"'
    assert yields in text
    text = text.replace(yields, heating + yields)
    text = text.replace('"Quadratic Correspondence"/>', '"Correspondence"/>' + keys(Stabilization="Silling"))
    strain = keys(Damage_Model="Plastic Strain", Failure_Strain=0.02, Fracture_Energy=10e3, Averaging_Radius=2.5 * SPACING)
    text = text.replace(keys(Damage_Model="by energy"), "").replace("breaking.", "tearing.")
    return [text, section("Damage Models", section("brittle", strain))]


def cracking():
    """The impact with bonds that break, by correspondence with the springs of the mean gradient."""
    text = "\n".join(impact()).replace("impact.", "cracking.")
    material = '<Parameter name="Material" '
    text = text.replace(material, keys(Damage_Model="brittle") + material)
    model = keys(Damage_Model="Critical Stretch", Critical_Stretch=0.02)
    return [text, section("Damage Models", section("brittle", model))]


def parting():
    """A bar, elastic by correspondence below and ordinary above, is torn in equilibria from one side to the other."""
    text = "\n".join(press(0.45)).replace("press.", "parting.").replace("(plate)", "(head)").replace("Equivalent_Plastic_Strain", "Damage")
    flows = keys(Yield_Stress=5e7)
    hardens = section("Hardening", keys(Type="Power Law", Reference_Strain=0.00218, Exponent=0.1))
    for part in (PRESSING, flows, hardens):
        assert part in text
    head = section("head", keys(Type="Prescribed Displacement", Coordinate="z", Node_Set="head", Value="0.001*t*(1 + 60*x)"))
    text = text.replace(PRESSING, head).replace(flows, "").replace(hardens, "").replace("Elastic Plastic", "Elastic")
    upper = keys(Block_Names="block_2", Material="copper")
    assert upper in text
    text = text.replace(upper, keys(Block_Names="block_2", Material="steel"))
    # Velocities are differences of equilibria over steps that are cut to a sixteenth.
    loose, strict = keys(Tolerance=1e-7), keys(Tolerance=1e-8)
    assert loose in text
    text = text.replace(loose, strict)
    material = '<Parameter name="Material" '
    text = text.replace(material, keys(Damage_Model="brittle") + material)
    return [text, section("Damage Models", section("brittle", keys(Damage_Model="Critical Stretch", Critical_Stretch=0.02)))]


SCENES = {"impact": impact, "press": press, "rubbing": rubbing, "cells": cells, "periodic": periodic, "stretched": stretched,
          "breaking": breaking, "tearing": tearing, "cracking": cracking, "parting": parting}


class Test:
    def __init__(self, strut, compare, mpirun, seed):
        self.strut, self.compare, self.mpirun = strut, compare, mpirun
        # The status of its ranks; MPICH's mpiexec loses it now and then where it hands a signal on.
        self.handed_on = (3,) if is_open_mpi(mpirun[0]) else (3, 0)
        self.random = random.Random(seed)
        self.failures = 0

    def fail(self, text, log=None):
        self.failures += 1
        print(f"FAILED: {text}")
        if log and Path(log).exists():
            print(Path(log).read_text()[-3000:])

    def folder(self, name, scene, frequency=3, frames=True):
        """A new folder with the deck of a scene."""
        path = Path(name)
        path.mkdir()
        points(path / "points.txt", scene)
        keep = section("Restart", keys(Frequency=frequency))
        text = section(scene, *SCENES[scene](), keep).replace(f' name="{scene}"', "", 1)
        if not frames:  # but the first
            text = text.replace('"Output Frequency" type="int" value="7"', '"Output Frequency" type="int" value="1000000"')
        (path / "deck.xml").write_text(text)
        return path

    def start(self, folder, *options, ranks=1):
        command = [self.strut, *options, "deck.xml"]
        if ranks > 1:
            command = [*self.mpirun, "-n", str(ranks), *command]
        with open(folder / "log", "w") as log:
            return subprocess.Popen(command, cwd=folder, stdout=log, stderr=subprocess.STDOUT)

    def run(self, folder, *options, ranks=1, expect=0):
        status = self.start(folder, *options, ranks=ranks).wait(timeout=300)
        if expect is not None and status != expect:
            self.fail(f"{folder}: exit status {status}, expected {expect}", folder / "log")
        return (folder / "log").read_text()

    def same(self, one, other, scene, fields=0.0, history=0.0):
        """To relative tolerances; 0: the same bits, and the same bytes of the history."""
        result = subprocess.run(
            [self.compare, f"{one}/{scene}.e", f"{other}/{scene}.e", "--relative", str(fields)], capture_output=True, text=True
        )
        if result.returncode != 0:
            self.fail(f"{other}: the fields are not those of {one}\n{result.stdout}{result.stderr}")
        first, second = (Path(f"{folder}/{scene}.csv").read_bytes() for folder in (one, other))
        if history == 0 and first != second:
            self.fail(f"{other}: the history is not that of {one}")
        command = [self.compare, f"{one}/{scene}.csv", f"{other}/{scene}.csv", "--relative", str(history)]
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode != 0:
            self.fail(f"{other}: the history is not that of {one}\n{result.stdout}")

    def wait_for(self, path, process, log):
        limit = time.monotonic() + 30
        while not path.exists():
            if process.poll() is not None or time.monotonic() > limit:
                return self.fail(f"{path} was not written", log)
            time.sleep(0.01)

    # ---- ways to end a run

    def terminated(self, scene, whole):
        """SIGTERM, then on as many ranks and on another number of them."""
        folder = self.folder(f"{scene}-terminated", scene, 10**6)  # nothing is kept but at the end
        process = self.start(folder)
        history = folder / f"{scene}.csv"
        self.wait_for(history, process, folder / "log")
        enough = self.random.uniform(0.1, 0.6) * Path(whole, f"{scene}.csv").stat().st_size
        while process.poll() is None and history.stat().st_size < enough:
            time.sleep(0.001)
        process.send_signal(signal.SIGTERM)
        if process.wait(timeout=30) != 3:
            self.fail(f"{folder}: SIGTERM: exit status {process.returncode}", folder / "log")
        elsewhere = f"{scene}-on-two-ranks"
        shutil.copytree(folder, elsewhere)
        self.run(folder, "--continue")
        self.same(whole, folder, scene)
        self.run(Path(elsewhere), "--continue", ranks=2)
        # Equilibria are found to 1e-7 of the forces, by preconditioners that differ with the ranks.
        tolerances = {"impact": (1e-12, 1e-9), "press": (1e-5, 1e-4), "parting": (1e-5, 1e-4), "rubbing": (1e-5, 1e-4), "cells": (1e-12, 1e-9),
                      "periodic": (1e-12, 1e-9), "stretched": (1e-5, 1e-4),
                      "breaking": (1e-12, 1e-9), "tearing": (1e-12, 1e-9), "cracking": (1e-12, 1e-9)}
        self.same(whole, elsewhere, scene, *tolerances[scene])

    def out_of_time(self, scene, whole):
        """A chain of jobs, each with a wall time that ends it after some steps, or after one."""
        folder = self.folder(f"{scene}-out-of-time", scene, 10**6)
        deck = folder / "deck.xml"
        text = deck.read_text()
        part = self.setup[scene] + 0.25 * self.seconds[scene]
        ended = 0
        for seconds in (1e-9, part, part, 1e9):
            deck.write_text(text.replace('name="Solver">', 'name="Solver">' + keys(Wall_Time=seconds)))
            log = self.run(folder, "--continue", expect=None)
            if "ended by its Wall Time" not in log:
                break
            ended += 1
        if not 1 <= ended <= 3:
            self.fail(f"{folder}: {ended} jobs ended by their wall time", folder / "log")
        self.same(whole, folder, scene)

    def killed(self, scene, whole, kills):
        folder = self.folder(f"{scene}-killed", scene)
        alive = 0
        for _ in range(kills):
            process = self.start(folder, "--continue")
            # Most kills should come where the run writes, not where it reads.
            time.sleep(self.setup[scene] + self.random.random() * 0.3 * self.seconds[scene])
            alive += process.poll() is None
            process.kill()
            process.wait()
        for begun in (bytes(48), Path(whole, "deck.restart").read_bytes()[:8192]):  # as the library for netCDF writes it
            (folder / "deck.restart.part").write_bytes(begun)
            self.run(folder, "--check")
        self.run(folder, "--continue")
        self.same(whole, folder, scene)
        print(f"{scene}: {alive} of {kills} kills before the end")
        if (folder / "deck.restart.part").exists():
            self.fail(f"{folder}: a part of a file is left")

    def rank_lost(self, scene):
        whole = self.folder(f"{scene}-two-ranks", scene, 10**6)
        self.run(whole, ranks=2)
        folder = self.folder(f"{scene}-rank-lost", scene)
        process = self.start(folder, ranks=2)
        self.wait_for(folder / "deck.restart", process, folder / "log")
        victims = subprocess.run(["pgrep", "-f", self.strut], capture_output=True, text=True).stdout.split()
        mine = [int(v) for v in victims if self.is_rank_in(int(v), folder)]
        if not mine:
            return self.fail("no rank to kill was found")
        os.kill(mine[-1], signal.SIGKILL)
        if process.wait(timeout=60) == 0:
            self.fail(f"{folder}: a rank was killed, and mpirun reports success")
        self.run(folder, "--continue", ranks=2)
        self.same(whole, folder, scene)

    def rebalanced(self, scene):
        """Ended after the partition has been made anew: on as many ranks it goes on with that partition, and any is as good."""
        def folder(name, most):
            path = self.folder(f"{scene}-{name}", scene, 10**6)
            deck = path / "deck.xml"
            # Steps so short that another partition pays.
            verlet = section("Verlet", keys(Rebalance=most, Safety_Factor=0.1))
            deck.write_text(deck.read_text().replace('name="Solver">', 'name="Solver">' + verlet))
            return path

        told = "spread over the ranks anew"
        whole, balanced, ended = folder("not-rebalanced", 1e9), folder("rebalanced", 1.0001), folder("rebalanced-ended", 1.0001)
        self.run(whole)
        if told not in self.run(balanced, ranks=2):
            self.fail(f"{balanced}: the partition stays as it is", balanced / "log")
        self.same(whole, balanced, scene, 0, 1e-9)  # totals are sums over ranks
        process = self.start(ended, ranks=2)
        while process.poll() is None and told not in (ended / "log").read_text():
            time.sleep(0.001)
        process.send_signal(signal.SIGUSR1)
        if process.wait(timeout=30) not in self.handed_on:
            self.fail(f"{ended}: SIGUSR1: exit status {process.returncode}", ended / "log")
        self.run(ended, "--continue", ranks=2)
        self.same(balanced, ended, scene)

    @staticmethod
    def is_rank_in(process, folder):
        try:
            here = os.readlink(f"/proc/{process}/cwd") == str(folder.resolve())
            return here and "deck.xml" in Path(f"/proc/{process}/cmdline").read_text() and \
                Path(f"/proc/{process}/comm").read_text().strip() == "strut"
        except OSError:
            return False

    def disk_full(self, scene, whole):
        """No file may grow any more, by a limit whose signal (SIGXFSZ) would kill: first a frame, then what is kept finds no room."""
        result, kept = (Path(whole, name).stat().st_size for name in (f"{scene}.e", "deck.restart"))
        for limit, frequency, frames, expected in (
            (0.6 * result, 40, True, f"{scene}.e: cannot"),
            (0.9 * kept, 3, False, "deck.restart.part: cannot"),
        ):
            folder = self.folder(f"{scene}-full-{frequency}", scene, frequency, frames)
            process = self.start(folder)
            self.wait_for(folder / "deck.restart", process, folder / "log")
            resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (int(limit), int(limit)))
            status = process.wait(timeout=60)
            log = (folder / "log").read_text()
            if status != 1 or expected not in log or "--continue" not in log:
                self.fail(f"{folder}: status {status}; expected '{expected}' and how to go on", folder / "log")
            for rest in ("part", "lock"):
                if (folder / f"deck.restart.{rest}").exists():
                    self.fail(f"{folder}: deck.restart.{rest} is left")
            self.run(folder, "--continue")
            if frames:
                self.same(whole, folder, scene)

    def two_in_a_folder(self, scene, whole):
        folder = self.folder(f"{scene}-two-runs", scene)
        first = self.start(folder)
        self.wait_for(folder / f"{scene}.csv", first, folder / "log")
        first.send_signal(signal.SIGSTOP)  # or it may be over before the second begins
        second = subprocess.run([self.strut, "deck.xml"], cwd=folder, capture_output=True, text=True, timeout=60)
        if second.returncode != 1 or "another run is writing to it" not in second.stderr:
            self.fail(f"{folder}: a second run was not refused: {second.returncode} {second.stderr}")
        first.send_signal(signal.SIGCONT)
        if first.wait(timeout=60) != 0:
            self.fail(f"{folder}: the first run was disturbed", folder / "log")
        self.same(whole, folder, scene)

    def refused(self, scene, whole):
        """A checkpoint that cannot be continued stays unchanged, and a message gives the reason."""
        folder = self.folder(f"{scene}-refused", scene)
        deck, kept = folder / "deck.xml", folder / "deck.restart"
        good = Path(whole, "deck.restart").read_bytes()
        text = deck.read_text()
        middle = len(good) // 2
        cases = {
            "is damaged": (good[:middle] + bytes([good[middle] ^ 1]) + good[middle + 1 :], text),
            "truncated": (good[:middle], text),
            "not an Exodus (netCDF) file": (b"hello", text),
            "Materials > copper > Linear Viscosity: 0.06 before, 0 now": (good, text.replace('value="0.06"', 'value="0"').replace('value="1.2"', 'value="0"')),
            "Materials > copper > Density: 8960 before, 7000 now": (good, text.replace('"8960.0"', '"7000.0"')),
            "'0.0001' has passed: the checkpoint is of t = 0.00015 s": (good, text.replace('value="0.00015"', 'value="0.0001"')),
        }
        for expected, (content, deck_text) in cases.items():
            kept.write_bytes(content)
            deck.write_text(deck_text)
            log = self.run(folder, "--continue", expect=1)
            if expected not in log or "deck.restart" not in log:
                self.fail(f"{folder}: expected '{expected}' in the message", folder / "log")
            if kept.read_bytes() != content:
                self.fail(f"{folder}: {expected}: the file has been touched")

        # A deck that asks to resume, as Peridigm's do, does not replace the checkpoint by one of a run that begins anew.
        kept.write_bytes(good)
        deck.write_text(text.replace('<ParameterList name="Restart">', '<ParameterList name="Restart"><Parameter name="Restart" type="bool" value="true"/>'))
        if "asks to go on from a checkpoint, and there is one" not in self.run(folder, expect=1):
            self.fail(f"{folder}: a deck that asks to resume began anew", folder / "log")
        if kept.read_bytes() != good:
            self.fail(f"{folder}: the checkpoint of a deck that asks to resume has been touched")

        deck.write_text(text)
        kept.write_bytes(good)
        other = self.folder(f"{scene}-other", scene, 10**6)
        (other / "deck.xml").write_text(text.replace('value="50000000.0"', 'value="50000001.0"'))
        self.run(other)
        for name in (f"{scene}.csv", f"{scene}.e"):  # of another run, with as many rows and frames
            shutil.copy(Path(whole, f"{scene}.csv"), folder)
            shutil.copy(Path(whole, f"{scene}.e"), folder)
            shutil.copy(other / name, folder)
            if f"{name}: is not the " not in self.run(folder, "--continue", expect=1):
                self.fail(f"{folder}: {name} of another run is gone on with", folder / "log")
            if (folder / name).read_bytes() != (other / name).read_bytes():
                self.fail(f"{folder}: {name} of another run has been touched")
        mesh = folder / "points.txt"
        lines = mesh.read_text().splitlines()
        x, rest = lines[0].split(" ", 1)
        mesh.write_text("\n".join([f"{float(x) * 1.0001:.17g} {rest}", *lines[1:]]) + "\n")
        if "the mesh is not the one with which the run began" not in self.run(folder, "--continue", expect=1):
            self.fail(f"{folder}: a mesh of as many points is taken for the same", folder / "log")

    def damaged(self, scene, whole):
        """The newest checkpoint is damaged: the one before is as good."""
        folder = self.folder(f"{scene}-damaged", scene)
        process = self.start(folder)
        self.wait_for(folder / "deck.restart.old", process, folder / "log")
        process.kill()
        process.wait()
        kept = folder / "deck.restart"
        content = bytearray(kept.read_bytes())
        content[len(content) // 2] ^= 1
        kept.unlink()  # it may still be one file with the one before, where the kill came between
        kept.write_bytes(content)
        if "going on from the one before, deck.restart.old" not in self.run(folder, "--continue"):
            self.fail(f"{folder}: it is not told that the checkpoint before is read", folder / "log")
        self.same(whole, folder, scene)

    def over(self, scene, whole):
        """A job that comes after the end, and finds only the result, leaves it alone."""
        folder = Path(f"{scene}-over")
        shutil.copytree(whole, folder)
        (folder / "deck.restart").unlink()
        if "is of a run that is over" not in self.run(folder, "--continue"):
            self.fail(f"{folder}: a run that is over is not known", folder / "log")
        self.same(whole, folder, scene)

    def extended(self, scene, whole):
        """A run that is over goes on when its final time is put off: as far as what a step does not know of the end."""
        folder = self.folder(f"{scene}-extended", scene, 10**6)
        deck = folder / "deck.xml"
        text = deck.read_text()
        deck.write_text(text.replace('name="Final Time" type="double" value="0.00015"', 'name="Final Time" type="double" value="0.0001"'))
        self.run(folder)
        deck.write_text(text)
        log = self.run(folder, "--continue")
        if "is not as it was" not in log:
            self.fail(f"{folder}: the changed deck is not told of", folder / "log")
        lines = Path(folder, f"{scene}.csv").read_text().splitlines()
        if abs(float(lines[-1].split(",")[0]) - 1.5e-4) > 1e-12:
            self.fail(f"{folder}: the run does not come to its new end")

    def scene(self, name, kills):
        whole = self.folder(name, name, 10**6)
        began = time.monotonic()
        log = self.run(whole)
        if self.failures:
            return
        self.seconds[name] = time.monotonic() - began
        if name in ("impact", "cells") and "subcycled" not in log:
            self.fail("no point of the impact is subcycled", whole / "log")
        if name in ("breaking", "tearing", "cracking") and "bonds are broken" not in log:
            self.fail("no bond broke", whole / "log")
        self.setup[name] = 0.1
        self.terminated(name, whole)
        self.out_of_time(name, whole)
        self.killed(name, whole, kills)
        if name == "cells":  # where levels of time steps make the work uneven
            self.rebalanced(name)
        if name == "impact":  # files and signals are the same for all
            self.rank_lost(name)
            self.disk_full(name, whole)
            self.two_in_a_folder(name, whole)
            self.refused(name, whole)
            self.damaged(name, whole)
            self.extended(name, whole)
            self.over(name, whole)

    seconds, setup = {}, {}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=5)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scene", choices=SCENES, help="this one alone")
    parser.add_argument("strut")
    parser.add_argument("compare")
    parser.add_argument("mpirun", nargs=argparse.REMAINDER)
    words = parser.parse_args()
    strut, compare = (str(Path(program).resolve()) for program in (words.strut, words.compare))
    folder = tempfile.mkdtemp(prefix="strut-restarts-")
    os.chdir(folder)
    test = Test(strut, compare, words.mpirun, words.seed)
    try:
        for name in [words.scene] if words.scene else SCENES:
            test.scene(name, words.kills)
    finally:
        if test.failures == 0:
            shutil.rmtree(folder)
        else:
            print(f"{test.failures} failures; the runs are in {folder}")
    print("passed" if test.failures == 0 else "failed")
    sys.exit(test.failures > 0)


if __name__ == "__main__":
    main()
