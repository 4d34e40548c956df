"""Pairs of runs that must agree. A relation makes the other run of a scene, compares, and returns what is wrong, or None; NotHere tells why
it does not hold for a scene."""
import copy
import itertools
import re
from dataclasses import replace

import numpy as np

from compare import SMALL, fields_differ, histories_differ, longest_steps_differ, steps_differ
from frame import AXES, Frame
from laws import NotHere, signs, strain
from runs import PATIENCE
from scenes import MOTIONS, TOOLS, written
from values import Direction, Expr, Num, Place

# Two orders of the same sums differ by 1e-16 of places that are some ten spacings, and a strain of 1e-15 is 1e-11 of SMALL, the least that
# differences are parts of. Some ten thousand times that is left for growth over a hundred steps.
ROUND_OFF = 1e-7
# Beyond, a scene is asked itself: how far a change of all places by 1e-11 of a spacing takes it, which is 1e4 times round-off.
NUDGE = 1e-11
NUDGE_OF_EQUILIBRIA = 1e-6  # these are found to 1e-8 of the forces, which is more than round-off
# Two layers, one family thick, are 1e4 times as soft in one motion as in another: what the forces that are left make of it goes with them.
FINE = 1e-11
ENOUGH = 3.0  # times that
# Round-off goes on in each step, and a body that stands three of its sizes away has some ten times as much of it: no nudge does.
ROUND_OFF_ELSEWHERE = 0.03
NUDGES = 3  # a body that buckles goes to either side
# The estimate of the critical step starts from a noise that goes by element numbers and axes. It is right to 1 % where it has converged, and
# takes what is left off the step where it has not. Time-step levels follow from it, too.
STEP_NOISE = 0.1


class Case:
    """A scene with its run, and the means to make others of it."""

    def __init__(self, scene, runner, seed):
        self.scene, self.runner, self.seed = scene, runner, seed
        self.written = written(scene)
        self.base = runner.run(self.written, name="base", **({} if scene.explicit else {"limit": PATIENCE}))
        self.fixed = None

    def chance(self, name):
        return np.random.default_rng([self.seed, *map(ord, name)])

    def same(self, frame=Frame(), scene=None, order=None, noise=True, name="other", reactions=True, **compared):
        """Whether the other run is this one: with the steps that it takes itself, or, where the estimates of the step differ by their noise,
        with fixed ones. `noise`: whether they may."""
        scene = scene or self.scene
        other_written = written(scene, frame, order=order)
        other = self.runner.run(other_written, name=name)
        if self.ended_differently(other):
            return self.ended_differently(other)
        off = steps_differ(self.base, other, frame) if self.scene.explicit else 0.0
        if self.scene.explicit and (off is None or off > 1e-9 or substeps(self.base) != substeps(other)):
            apart = longest_steps_differ(self.base, other, frame)
            if not noise or apart > STEP_NOISE or abs(len_of(self.base) - len_of(other)) > 1 + STEP_NOISE * len_of(self.base):
                return f"steps: {len_of(self.base)} and {len_of(other)}, the longest ones off by {apart:.1e} at least"
            return self.with_fixed_steps(frame, scene, order, reactions, **compared)
        return self.differ(self.base, self.written, other, other_written, frame, reactions=reactions, **compared)

    def with_fixed_steps(self, frame, scene, order, reactions, **compared):
        dt = 0.9 * self.smallest_step()
        one = written(self.scene.fixed_step(dt))
        base = self.runner.run(one, name="base-fixed")
        two = written(scene.fixed_step(dt), frame, order=order)
        other = self.runner.run(two, name="other-fixed")
        if self.ended_differently(other, base):
            return self.ended_differently(other, base)
        return self.differ(base, one, other, two, frame, fixed=dt, reactions=reactions, **compared)

    def smallest_step(self):
        """The smallest step of any point: those that are subcycled take fractions of a step."""
        return self.base.history["Step_Size"].min() / substeps(self.base)

    def signs_in_shorter_steps(self):
        """The dissipation of a break is a difference from the work of the mean of the forces at both ends of its step, right to second order in
        the step, and to nothing above the critical one: it must be gone in steps of an eighth."""
        if not self.scene.explicit:
            raise NotHere("nothing breaks in equilibria")
        dt = min(self.smallest_step(), self.critical_step()) / 8
        files = written(self.scene.fixed_step(dt))
        fine = self.runner.run(files, name="fine")
        if fine.status == 1:
            raise NotHere("the run ends with an error in shorter steps")
        return signs(self.scene, fine, files)

    def critical_step(self):
        told = re.search(r"critical time step ([0-9.e+-]+) s", self.base.log)
        return float(told[1]) if told else np.inf

    def ended_differently(self, other, base=None):
        base = base or self.base
        if is_lost(other, base):
            return f"{other.status}"
        # One of several equilibria may be far enough to end with an error, where the others do not.
        if any(wanders(one) for one in (base, other)):
            raise NotHere("a load step takes many iterations: it may find one of several equilibria")
        if any("points have failed" in line for one in (base, other) for line in one.warnings):
            raise NotHere("what failed points have held is in equilibrium anywhere, and a warning says so")
        if other.status != base.status:
            return f"status: {base.status} and {other.status}: {(other.error or base.error)[:300]}"
        if other.kind_of_error.split(":")[0] != base.kind_of_error.split(":")[0]:
            return f"error: '{base.error[:200]}' and '{other.error[:200]}'"
        if base.status == 1:
            raise NotHere("the run ends with an error, the other one with the same")

    def differ(self, base, base_written, other, other_written, frame, fixed=None, by_blocks=True, tolerance=ROUND_OFF, only=None, energies=True, reactions=True, nudge=True):
        parts = fields_differ(base, other, self.scene, frame, only)
        parts |= histories_differ(base, other, self.scene, frame, names(base_written), names(other_written), energies, reactions)
        if not by_blocks:
            parts = {name: part for name, part in parts.items() if not name.startswith("Contact_Force")}
        if not self.scene.explicit:
            tolerance = max(tolerance, 1e-4)  # found to 1e-8 of the forces; what is left counts by the conditioning of the body
        wrong = {name: part for name, part in parts.items() if part > tolerance}
        if wrong and any("expect it to blow up" in line for line in base.warnings):
            raise NotHere("a fixed step above the critical one makes round-off grow without a bound, and a warning says so")
        if wrong and rests_anywhere(base):
            raise NotHere(ANYWHERE)
        if wrong and nudge and all(np.isfinite(part) for part in wrong.values()):
            wrong = self.beyond_own_scatter(wrong, self.scene.fixed_step(fixed) if fixed else self.scene, base)
        if wrong:
            name = max(wrong, key=wrong.get)
            return f"{name}: {wrong[name]:.2e}" + (f" ({len(wrong)} of {len(parts)} quantities)" if len(wrong) > 1 else "")

    def beyond_own_scatter(self, wrong, scene, base):
        for n in range(NUDGES):
            own = self.own_scatter(scene, base, n)
            wrong = {name: part for name, part in wrong.items() if part > ENOUGH * own.get(name, 0)}
        if wrong and scene.explicit:
            less = self.own_scatter(scene, base, 0, NUDGE / 100)
            if all(less.get(name, 0) > max(0.1 * own.get(name, 0), ROUND_OFF_ELSEWHERE * part) for name, part in wrong.items()):
                raise NotHere("what grows is the round-off of each step, which differs from run to run, not the nudge: one of a hundredth does as much")
        return wrong

    def own_scatter(self, scene, base, n, part=NUDGE):
        """By how much a run itself differs where its points are nudged, in one way or another."""
        nudged = scene.copy()
        rng = self.chance(f"nudge {n}")
        part = part if scene.explicit else NUDGE_OF_EQUILIBRIA
        if nudged.mesh.kind == "PdQuickGrid":
            stretch = 1 + part * rng.uniform(-1, 1, 3)
            nudged.mesh = nudged.mesh.mapped(lambda points: points * stretch, False, 1.0)
        else:
            amount = part * scene.h
            nudged.mesh = nudged.mesh.mapped(lambda points: points + amount * rng.uniform(-1, 1, points.shape), False, 1.0)
        files = written(nudged)
        other = self.runner.run(files, name="nudged")
        if other.status != base.status:
            return {}
        parts = fields_differ(base, other, scene, Frame())
        return parts | histories_differ(base, other, scene, Frame(), names(files), names(files))


def substeps(result):
    """The most of a step."""
    told = re.search(r"subcycled, up to (\d+) times a step", result.log)
    return int(told[1]) if told else 1


ANYWHERE = "a body that nothing but contact holds rests anywhere short of a force, and a warning says so"


def rests_anywhere(result):
    return any("only contact and friction hold" in line for line in result.warnings)


def wanders(result):
    """Whether an equilibrium was far to find: beyond a limit point, or where a body buckles, there are several."""
    return any(int(count) > 10 for count in re.findall(r"^step .* (\d+) iterations", result.log, re.M))


def is_lost(other, base):
    """Equilibria of thousands of iterations take minutes where cores are busy: that is no hang."""
    return other.status == "crash" or other.status == "hang" and not wanders(base)


def names(files):
    return [name for made in files.parts.values() for name in made]


def len_of(result):
    return len(result.history.get("Time", []))


# ---- where a scene is seen from


def moved(case):
    size = np.ptp(case.scene.mesh.sites(), axis=0).max()
    return case.same(Frame(shift=case.chance("moved").uniform(-3, 3, 3) * size), noise=False)


def later(case):
    length = case.scene.end - case.scene.begin
    return case.same(Frame(later=float(case.chance("later").uniform(-2, 2) * length)), noise=False)


def signed_permutations(determinant):
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            turn = np.zeros((3, 3), int)
            turn[range(3), order] = signs
            if round(np.linalg.det(turn)) == determinant and not (turn == np.eye(3)).all():
                yield turn


def turns_of(scene, determinant):
    """By quadratic correspondence those that take the law points of cells to each other; the rest gives another discretization, at finite
    strain another result (docs/theory.md, Symmetry planes). These points are a tetrahedron times Cholesky's factor of the cell's moments."""
    turns = list(signed_permutations(determinant))
    if scene.is_quadratic:
        turns = [turn for turn in turns if turn.sum(axis=0).prod() == 1]
    if scene.is_quadratic and scene.about.get("askew"):  # Cholesky's factor goes by the order of the axes
        turns = [turn for turn in turns if (np.abs(turn) == np.eye(3)).all()]
    if not turns:
        raise NotHere("the law points of cells are no mirror images of each other")
    return turns


def quarter_turned(case):
    return case.same(Frame(turn=case.chance("turned").choice(turns_of(case.scene, 1))))


def mirrored(case):
    return case.same(Frame(turn=case.chance("mirrored").choice(turns_of(case.scene, -1))))


def in_other_units(case):
    """By powers of two, so that a number keeps its digits."""
    mass, length, time = (int(n) for n in case.chance("units").integers(-8, 9, 3))
    flows = [m.get("Flow Stress", {}).get("Type") for m in case.scene.deck["Materials"].values()]
    if "Zerilli-Armstrong" in flows or "Mechanical Threshold" in flows:
        time = 0  # they have the logarithm of a rate in 1/s
    if "Mechanical Threshold" in flows:
        mass = -2 * length  # and Boltzmann's constant in J/K
    return case.same(Frame(mass=2.0**mass, length=2.0**length, time=2.0**time), noise=False)


def flying(case):
    """From a frame of reference that flies along (Galilei)."""
    if not case.scene.explicit:
        raise NotHere("equilibria have no velocities")
    if case.scene.has("Non-Reflecting End"):
        raise NotHere("what is behind a non-reflecting end rests")
    if any("above the critical time step" in line for line in case.base.warnings):
        raise NotHere("what a step that is too long makes of round-off, and when it is told of: in parts of all energies, the flight's among them")
    scene = case.scene.copy()
    speed = case.scene.speed * 0.02 * case.chance("flying").uniform(-1, 1, 3)
    for one in scene.conditions.values():
        if one["Type"] == "Symmetry Plane":
            speed = speed * (np.array(one["Normal"].along) == 0)
    at_rest = [(block, axis) for block in sorted(set(scene.mesh.blocks)) for axis in AXES
               if not any(c["Type"] == "Initial Velocity" and axis in c["Coordinate"] and c["Node Set"] in ("all", f"block_{block}")
                          for c in scene.conditions.values())]
    for block, axis in at_rest:
        scene.conditions[f"rest {block} {axis}"] = {"Type": "Initial Velocity", "Node Set": f"block_{block}", "Coordinate": axis, "Value": Expr("0", 1.0, "m/s")}
    other = written(scene, Frame(speed=speed, begin=scene.begin))
    result = case.runner.run(other, name="other")
    if case.ended_differently(result):
        return case.ended_differently(result)
    frame = Frame(speed=speed, begin=scene.begin)
    off = steps_differ(case.base, result, frame)
    if off is None or off > 1e-6:
        # Skin distances and bounds of contact may see the speed; the estimate's noise does not.
        return case.with_fixed_steps(frame, scene, None, True, energies=False)
    return case.differ(case.base, case.written, result, other, frame, energies=False)


# ---- how a deck and a mesh are written


def reordered(case):
    return case.same(order=case.chance("order"))


def cut_in_blocks(case):
    """A block cut into two of the same material, bonded as before."""
    scene = case.scene.copy()
    if scene.mesh.kind == "PdQuickGrid":
        raise NotHere("Peridigm's grid has one block")
    if any("Damage Model" in section for section in scene.deck["Blocks"].values()):
        raise NotHere("points fail, and bonds break, by what is least in their block (docs/theory.md, Fracture)")
    if any(name != "touch" and "Surface" in scene.deck["Contact"]["Models"]["touch"]["Contact Model"] for name in scene.deck.get("Contact", {}).get("Interactions", {})):
        raise NotHere("surfaces have the largest spacing of a block")
    rng = case.chance("cut")
    block, new = int(rng.choice(scene.mesh.blocks)), int(scene.mesh.blocks.max()) + 1
    axis = int(rng.integers(3))
    own = scene.mesh.blocks == block
    along = scene.mesh.elements()[:, axis]
    upper = own & (along > np.median(along[own]))
    if not upper.any() or upper.sum() == own.sum():
        raise NotHere("the block is one layer thick")
    scene.mesh = replace(scene.mesh, blocks=np.where(upper, new, scene.mesh.blocks))
    one, two = f"block_{block}", f"block_{new}"
    for section in scene.deck["Blocks"].values():
        if one in section["Block Names"].split():
            section["Block Names"] += f" {two}"
    for name, condition in list(scene.conditions.items()):
        if condition.get("Node Set") == one:
            scene.conditions[f"{name} cut"] = condition | {"Node Set": two}
    interactions = scene.deck.get("Contact", {}).get("Interactions", {})
    for name, pair in list(interactions.items()):
        first, second = ([b, two] if b == one else [b] for b in (pair.get("First Block"), pair.get("Second Block")))
        for n, (a, b) in enumerate(itertools.product(first, second)):
            if a and n > 0 and not (pair["First Block"] == pair["Second Block"] and (a, b) == (two, one)):
                interactions[f"{name} cut {n}"] = pair | {"First Block": a, "Second Block": b}
    problem = case.same(scene=scene, by_blocks=False)
    if problem and "would have no point" in problem:
        raise NotHere("all nodes of a part belong to blocks before it, and an error says so")
    return problem


# ---- how it is computed


def bits(case, other, files, history):
    if case.ended_differently(other):
        return case.ended_differently(other)
    parts = {name: part for name, part in fields_differ(case.base, other, case.scene, Frame()).items() if part > (0 if case.scene.explicit else 1e-4)}
    parts |= {name: part for name, part in histories_differ(case.base, other, case.scene, Frame(), names(files), names(files)).items()
              if part > (history if case.scene.explicit or history == 0 else 1e-4)}
    if history == 0 and not parts:
        parts = {name: 1.0 for name, column in case.base.history.items() if not np.array_equal(column, other.history[name], equal_nan=True)}
    if parts and rests_anywhere(case.base):
        raise NotHere(ANYWHERE)
    if parts:
        name = max(parts, key=parts.get)
        return f"{name}: {parts[name]:.2e}"


def on_three_ranks(case):
    """Fields to the last bit (tests/parallel), totals to their round-off; equilibria by preconditioners that differ with the ranks."""
    return bits(case, case.runner.run(case.written, ranks=3, name="other"), case.written, 1e-9)


def on_two_threads(case):
    return bits(case, case.runner.run(case.written, "--threads", "2", name="other"), case.written, 0)


def broken_off(case):
    """In the middle, by a signal, then continued: on as many ranks to the last bit."""
    rng = case.chance("broken off")
    scene, word = case.scene, "dt"
    if not scene.explicit:
        scene, word = scene.copy(), "iteration"
        scene.deck["Solver"]["Verbose"] = True
    files = written(scene)
    broken = case.runner.run(files, "--break", int(rng.integers(1, 9)), word, name="other")
    if is_lost(broken, case.base):
        return broken.status
    if broken.status != 3:
        raise NotHere("it was over before")
    ranks = int(rng.choice([1, 1, 3]))
    other = case.runner.run(files, "--continue", ranks=ranks, name="other", keep=True)
    return bits(case, other, files, 0 if ranks == 1 else 1e-9)


def steps_afterwards(case):
    """Explicit steps after the equilibria, by one deck of two solvers and by a run that starts from the checkpoint of the other."""
    if case.scene.explicit:
        raise NotHere("there are no equilibria")
    dt = 0.15 * case.scene.h / case.scene.speed
    steps = {"Initial Time": case.scene.end, "Final Time": case.scene.end + 12 * dt, "Verlet": {"Fixed dt": dt}}
    both, first, second = written(case.scene), written(case.scene, restart={"Frequency": 1000}), written(case.scene)
    both.deck["Solver 2"] = second.deck["Solver"] = steps
    second.deck["Start From"] = {"Checkpoint": "../first/deck.restart"}
    one = case.runner.run(both, name="both", limit=PATIENCE)
    case.runner.run(first, name="first")
    other = case.runner.run(second, ranks=int(case.chance("afterwards").choice([1, 3])), name="other")
    return last_differ(replace_base(case, one), other, second, ROUND_OFF)


def started_from(case):
    """In the middle, by a signal; another run starts from that checkpoint at its time (Start From): fields to the last bit on any ranks."""
    rng = case.chance("started from")
    scene, word = case.scene.copy(), "dt"
    if not scene.explicit:
        word = "iteration"
        scene.deck["Solver"]["Verbose"] = True
    files = written(scene)
    first = int(rng.choice([1, 1, 3]))
    broken = case.runner.run(files, "--break", int(rng.integers(1, 9)), word, ranks=first, name="first")
    if is_lost(broken, case.base):
        return broken.status
    if broken.status != 3 or len_of(broken) < 2:
        raise NotHere("it was over before, or had not begun")
    if not scene.explicit:
        steps = scene.deck["Solver"]["QuasiStatic"]["Number of Load Steps"]
        done = (broken.history["Time"][-1] - scene.begin) / (scene.end - scene.begin) * steps
        if abs(done - round(done)) > 1e-6 or not 0 < round(done) < steps:
            raise NotHere("a load step was cut, or it was over before")
        scene.deck["Solver"]["QuasiStatic"]["Number of Load Steps"] = steps - round(done)
    files = written(scene)
    files.deck["Solver"]["Initial Time"] = float(broken.history["Time"][-1])
    files.deck["Start From"] = {"Checkpoint": "../first/deck.restart"}
    ranks = int(rng.choice([1, 1, 3]))
    other = case.runner.run(files, ranks=ranks, name="other")
    if is_lost(other, case.base):
        return other.status
    if "goes on with its steps" not in other.log and other.status != 1:
        return "it does not go on with the steps"
    return last_differ(case, other, files, 1e-4 if not scene.explicit else 0 if ranks == first == 1 else 1e-9)


# These columns count work, J, from the start of the run.
OF_WORK = ("Tool_Work", "Contact_Work", "External_Work", "Balance_Error")


def last_differ(case, other, files, tolerance):
    """In the last frame, and in the rows since the second one of the other run: work counts from its start, and so do means."""
    if case.ended_differently(other):
        return case.ended_differently(other)
    rows = np.abs(case.base.history["Time"] - other.history["Time"][1:, None]).argmin(axis=1)
    if len(rows) == 0 or not np.allclose(case.base.history["Time"][rows], other.history["Time"][1:], rtol=1e-9, atol=0):
        return "rows: at other times"
    ends = lambda result, rows: replace(result, frames=result.frames[:1] + result.frames[-1:], times=result.times[[0, -1]], history={
        name: column[rows] * (name not in OF_WORK) for name, column in result.history.items()})
    one, two = ends(case.base, rows), ends(other, slice(1, None))
    two.frames[0] = one.frames[0]
    parts = fields_differ(one, two, case.scene, Frame()) | histories_differ(one, two, case.scene, Frame(), names(files), names(files))
    wrong = {name: part for name, part in parts.items() if part > tolerance}
    if wrong and rests_anywhere(case.base):
        raise NotHere(ANYWHERE)
    if wrong:
        name = max(wrong, key=wrong.get)
        return f"{name}: {wrong[name]:.2e}"


def replace_base(case, base):
    made = copy.copy(case)
    made.base = base
    return made


def checked(case):
    """The output of `--check`."""
    checked = case.runner.run(case.written, "--check", name="other")
    if checked.status in ("crash", "hang"):
        return checked.status
    if checked.status == 1 and checked.error == case.base.error:
        return None  # it makes the first steps, in which the run fails, too
    if checked.status != 0:
        return f"--check finds '{checked.error[:200]}', and the run does not"
    if checked.frames or checked.history:
        return "--check writes"


def without_subcycling(case):
    """To the order of the scheme: impulses differ by (ω Δt)² of what is subcycled."""
    verlet = case.scene.deck["Solver"].get("Verlet")
    if verlet is None or "subcycled" not in case.base.log:
        raise NotHere("nothing is subcycled")
    if len_of(case.base) < 12:
        raise NotHere("a load or a touch is hardly seen in so few steps")
    if any("Damage Model" in section for section in case.scene.deck["Blocks"].values()):
        raise NotHere("thresholds")
    scene = case.scene.copy()
    scene.deck["Solver"]["Verlet"] = {k: v for k, v in verlet.items() if k != "Subcycling"} | {"Subcycling": False}
    other = case.runner.run(written(scene), name="other")
    if case.ended_differently(other):
        return case.ended_differently(other)
    off = last_displacements_differ(scene, case.base, other)
    if off > 0.1:
        return f"Displacement: {off:.2e} in the root mean square of the last frame"


def last_displacements_differ(scene, one, two):
    """In parts of what they are, but of no less than SMALL of a spacing: a tool that just touches leaves 1e-13 of it, and that is round-off."""
    a, b = one.frames[-1]["Displacement"], two.frames[-1]["Displacement"]
    return float(np.sqrt(((a - b)**2).sum() / max((a**2).sum(), len(a) * (SMALL * scene.h)**2)))


def half_the_step(case):
    """Steps of 1, ½ and ¼: the second difference is a quarter of the first one where the motion is smooth; a half is asked for, or 2 %. Where
    steps are too long for what happens, as for touches and friction that begins to slide, that is seen with shorter ones: the last two
    differences count, as far as steps are not too many."""
    scene = case.scene
    if not scene.explicit:
        raise NotHere("load steps are of first order in what flows")
    if any("Damage Model" in section for section in scene.deck["Blocks"].values()):
        raise NotHere("thresholds")
    if case.base.status == 1:
        raise NotHere("the run ends with an error")
    dt, most = 0.7 * case.smallest_step(), 1500
    if (scene.end - scene.begin) / dt > most:
        raise NotHere("too many steps")
    results, differences, parts = [], [], 1
    while parts <= 4 or (scene.end - scene.begin) / dt * parts <= 4 * most:
        one = case.runner.run(written(scene.fixed_step(dt / parts)), name=f"step-{parts}")
        if one.status == 1:
            raise NotHere("the run ends with an error")
        if case.ended_differently(one):
            return case.ended_differently(one)
        differences += [last_displacements_differ(scene, results[-1], one)] if results else []
        results.append(one)
        converges = parts > 2 and differences[-1] <= max(0.02, 0.6 * differences[-2])
        if converges:
            break
        parts *= 2
    if not converges:
        return f"Displacement: {', then '.join(format(d, '.2e') for d in differences)} in the root mean square of the last frame"
    errors = [r.history["Balance_Error"][-1] for r in results]
    # Hypoelastic laws, and foams whose moduli follow their density, have no stored energy: what they take differs from ½ σ : C⁻¹ : σ by a part
    # of the order of the strain.
    if errors[-1] > max(1e-3, 0.8 * errors[0], strain(scene, results[-1])) and not any("WARNING" in line for line in results[-1].warnings):
        return f"balance: {', '.join(format(e, '.2e') for e in errors)} with smaller steps"


# ---- symmetry


def half_of_it(case):
    """A body with a symmetry plane, and the whole that it is a half of."""
    scene = case.scene.copy()
    if scene.mesh.kind == "PdQuickGrid":
        raise NotHere("Peridigm's grid has one block, and its own place")
    if "Bond Filters" in scene.deck["Discretization"]:
        raise NotHere("cracks are not mirrored")
    if scene.has("Periodic Sides"):
        raise NotHere("symmetry planes and periodic sides are refused together")
    if scene.is_quadratic:
        raise NotHere("the law points of a cell are no mirror images of each other (docs/theory.md, Symmetry planes)")
    axis = 0
    name, key = AXES[axis], AXES[axis].upper()
    at = min(box.low[axis] for box in scene.bodies)
    if any(abs(box.low[axis] - at) > 1e-9 * scene.h for box in scene.bodies):
        raise NotHere("a body beside the plane")
    shift = np.zeros(3)
    shift[axis] = -at
    scene.mesh = scene.mesh.mapped(lambda points: points + shift, False, 1.0)
    kept = {}
    for label, one in scene.conditions.items():
        one = dict(one)
        vector = one.get("Normal") or one.get("Axis")
        if one["Type"] in ("Symmetry Plane", "Non-Reflecting End") and vector.along[axis]:
            continue
        if one["Type"] in TOOLS:
            if vector and vector.along[axis]:
                continue
            if "Axis" in one:  # a cylinder's is in the plane
                one["Point"] = Place(tuple(0.0 if i == axis else v for i, v in enumerate(one["Point"].at)))
                if stands_in_the_body(one, scene):  # it stood beside the plane
                    continue
            for k in list(one):
                if k.endswith(f" {key}"):
                    del one[k]
            if "Lower Corner" in one:
                reach = 20 * scene.h
                one["Lower Corner"] = Place(tuple(-reach if i == axis else v for i, v in enumerate(one["Lower Corner"].at)))
                one["Upper Corner"] = Place(tuple(reach if i == axis else v for i, v in enumerate(one["Upper Corner"].at)))
        if "Coordinate" in one:
            one["Coordinate"] = one["Coordinate"].replace(name, "")
            if not one["Coordinate"]:
                continue
        if "Value" in one:
            one["Value"] = replace(one["Value"], text=folded(one["Value"].text, name, at))
        kept[label] = one
    sets = {label: replace(value, text=folded(value.text, name, at)) for label, value in scene.deck["Node Sets"].items()}
    scene.deck["Boundary Conditions"], scene.deck["Node Sets"] = kept, sets
    scene.bodies = [replace(box, low=box.low + shift) for box in scene.bodies]
    if scene.explicit:
        scene = scene.fixed_step(0.1 * scene.h / scene.speed)
    whole = scene.copy()
    whole.mesh = whole.mesh.with_image(axis)
    for label, one in whole.conditions.items():
        for k in one:
            if k == "Mass" or k.startswith("Force "):
                one[k] = replace(one[k], value=2 * one[k].value) if isinstance(one[k], Num) else one[k].times(2)
    half = scene.copy()
    cells = [box.cell[axis] for box in scene.bodies]
    first, second = (0.0, min(cells)) if scene.mesh.at_nodes else (0.5 * max(cells), 1.5 * min(cells))
    if first + 0.2 * max(cells) > second:
        raise NotHere("the first layer of one body is the second one of another")
    half.deck["Node Sets"]["mirror"] = Expr(f"({{{name}}} < {float((first + second) / 2)!r})")
    half.conditions["mirror"] = {"Type": "Symmetry Plane", "Node Set": "mirror", "Point": Place((0.0, 0.0, 0.0)),
                                 "Normal": Direction(tuple(float(i == axis) for i in range(3)))}
    problem, one, wrong = halves_differ(case, half, whole, axis)
    if wrong and not scene.explicit:
        half, whole = with_tolerance(half, FINE), with_tolerance(whole, FINE)
        problem, one, wrong = halves_differ(case, half, whole, axis)
    if problem:
        return problem
    if wrong and rests_anywhere(one):
        raise NotHere(ANYWHERE)
    if wrong and all(np.isfinite(part) for part in wrong.values()):
        wrong = case.beyond_own_scatter(wrong, half, one)
    if wrong:
        worst = max(wrong, key=wrong.get)
        return f"{worst}: {wrong[worst]:.2e}"


def halves_differ(case, half, whole, axis):
    """The difference, the run of the half, and the fields that differ."""
    one, two = case.runner.run(written(half), name="half"), case.runner.run(written(whole), name="whole")
    if any("contact does not see mirror images" in line for line in one.warnings):
        raise NotHere("contact does not see mirror images, and a warning says so")
    if case.ended_differently(two, one):
        return case.ended_differently(two, one), one, {}
    if not half.explicit:
        stand_in_the_middle(whole, two, axis)
    kept = two.at[:, axis] > -1e-6 * half.h
    two.at = two.at[kept]
    two.frames = [{field: values[kept] for field, values in frame.items()} for frame in two.frames]
    fields = ["Displacement", "Velocity", "Cauchy_Stress", "Jacobian", "Equivalent_Plastic_Strain", "Temperature", "Damage"]
    parts = fields_differ(one, two, half, Frame(), fields)
    # ROUND_OFF, of sums over two halves in place of one
    return None, one, {name: part for name, part in parts.items() if part > (1e-6 if half.explicit else 1e-4)}


def stand_in_the_middle(whole, result, axis):
    """Nothing holds the whole across the plane, on which the middle of each block stays by symmetry: where an equilibrium stands is round-off."""
    apart = np.linalg.norm(result.at[:, None] - whole.mesh.sites()[None], axis=2)
    blocks = np.asarray(whole.mesh.owners())[np.argmin(apart, axis=1)]
    for frame in result.frames:
        for name in ("Displacement", "Velocity"):
            for block in set(blocks):
                frame[name][blocks == block, axis] -= frame[name][blocks == block, axis].mean()


def with_tolerance(scene, tolerance):
    other = scene.copy()
    other.deck["Solver"]["QuasiStatic"]["Tolerance"] = Num(tolerance, "")
    return other


def stands_in_the_body(cylinder, scene):
    away = scene.mesh.sites() - np.array(cylinder["Point"].at)
    along = np.array(cylinder["Axis"].along)
    return np.linalg.norm(np.cross(away, along / np.linalg.norm(along)), axis=1).min() < cylinder["Radius"].value - 0.5 * scene.h


def folded(text, name, at):
    """|x| instead of x, seen from the plane."""
    return text.replace(f"{{{name}}}", f"(fabs({{{name}}}) + {float(at)!r})")


RELATIONS = {"moved": moved, "later": later, "quarter turned": quarter_turned, "mirrored": mirrored, "in other units": in_other_units,
             "flying": flying, "reordered": reordered, "cut in blocks": cut_in_blocks, "on three ranks": on_three_ranks,
             "on two threads": on_two_threads, "broken off": broken_off, "started from": started_from, "steps afterwards": steps_afterwards, "checked": checked, "without subcycling": without_subcycling,
             "half the step": half_the_step, "half of it": half_of_it}
