"""The grids of a convergence study: the runs that belong together, the spacing of each, and their cost."""
import math
import re
from dataclasses import dataclass

from curve_parts import source
from decks import Deck, box_of
from strut_tools import fail, nearest, number

from . import collect, names, plan
from .cases import duration


@dataclass
class Kind:
    """Runs that differ only in their grid."""
    values: dict  # values of the other varied names
    sizes: list   # the finest first
    cases: list

    def said(self):
        return ", ".join(f"{k} = {v or 'none'}" for k, v in self.values.items())


# A deck or a study without grids


def study_of_deck(path):
    """All measures of tools/curve if the history has a force, else the columns of the deck's history."""
    columns = names.columns_of(Deck(path))[len(names.ALWAYS):]
    if any(source.FORCES.fullmatch(name) for name in columns):
        return plan.Study(path, path, curve="")
    if not columns:
        fail(f"{path}: expected a section History with Variables: nothing is read off the runs that could converge")
    return plan.Study(path, path, collect=columns)


def refine(study, ratio, count):
    """Varies the spacing of the recipe: as it is, and `count` - 1 times finer by `ratio`; of several bodies alike."""
    deck, recipe = plan.files_of(study, study.cases()[0])
    if recipe is None:
        fail(f"{deck.path}: its mesh has no recipe beside it whose spacing could be refined: expected one, or a study that varies "
             f"the spacing")
    file = next((body for body in recipe.bodies() if body.get("shape") == "file"), None)
    if file:
        fail(f"{recipe.path}: the body '{file.get('file')}' is a file, whose cells would stay as they are: expected a study that sets the "
             "file and the spacing for each grid")
    bodies = spaced(recipe)
    if not bodies:
        fail(f"{recipe.path} has no line 'spacing' to refine")
    graded = next((body for body in bodies if body.get("grading", "1") not in ("1", "1.0")), None)
    if graded:
        fail(f"{recipe.path}: the layers of '{graded.get('name', 'body')}' are graded: expected a study that sets spacing, grading, "
             "uniform and coarsest for each grid")
    first = float(main_body(recipe)["spacing"])
    study.vary.append((["spacing"], [[f"{first / ratio**n:.6g}"] for n in range(count)]))
    if len({float(body["spacing"]) for body in bodies}) == 1:
        study.sets.append((True, "spacing", "{spacing}"))
        return
    for body in bodies:
        study.sets.append((True, f"{body.get('name', 'body')}.spacing", f"{{{float(body['spacing']) / first:.9g}*spacing}}"))


def spaced(recipe):
    return [body for body in recipe.bodies() if "spacing" in body] if recipe else []


def main_body(recipe):
    """The (first) foam, else the first body, with a spacing; empty where there is none."""
    bodies = spaced(recipe) or [{}]
    return next((body for body in bodies if body.get("shape") == "foam"), bodies[0])


# Spacings


def whole(x):
    return max(1, math.floor(x + 0.5))


def spacing_of(recipe):
    """The spacing that strut-mesh uses for the (first) foam, else for the first body: an integer number of cells along
    each side; the cube root of the volume of a cell (tools/mesh). None if no line gives it."""
    body = main_body(recipe)
    try:
        h = float(body["spacing"])
        if body.get("shape") in ("box", "foam", "lattice"):
            return math.prod(length / whole(length / h) for length in box_of(body))**(1 / 3)
        layer = float(body["length"]) / whole(float(body["length"]) / h)
        if body.get("shape") == "cylinder" and body.get("method", "lattice") == "lattice":
            return layer
        radius = 0.5 * (float(body["radius"]) + float(body.get("top_radius", body["radius"])))
        return (math.pi * (radius / (2 * whole(radius * math.sqrt(math.pi) / h / 2)))**2 * layer)**(1 / 3)
    except (KeyError, ValueError, ZeroDivisionError):
        return None  # strut-mesh reports an error


def sizes_of(study, name, cases):
    """The spacings as meshed if the recipe's spacing varies, else the values themselves."""
    recipes = [plan.files_of(study, case.values)[1] for case in cases]
    sizes = [spacing_of(recipe) for recipe in recipes]
    if len({main_body(recipe).get("spacing") for recipe in recipes}) == 1 or None in sizes:
        sizes = [number(case.values[name]) for case in cases]
    for size, case in zip(sizes, cases):
        if size is None or not 0 < size < math.inf:
            fail(f"{study.path}: {name} = {case.values[name]}: expected a length > 0")
    return sizes


def kinds_of(study, name, cases):
    """The runs by the other varied names, in separate lines `vary`; a name in one line with `name` is of the grid."""
    others = [n for together, _ in study.vary if name not in together for n in together]
    found = {}
    for size, case in sorted(zip(sizes_of(study, name, cases), cases), key=lambda pair: pair[0]):
        values = {n: case.values[n] for n in others}
        kind = found.setdefault(tuple(values.values()), Kind(values, [], []))
        kind.sizes.append(size)
        kind.cases.append(case)
    for kind in found.values():
        check_sizes(study, name, kind)
    return sorted(found.values(), key=lambda kind: min(map(cases.index, kind.cases)))


def check_sizes(study, name, kind):
    if len(kind.sizes) < 2:
        fail(f"{study.path}: {name} has one value: expected two or three, the finest by far the dearest")
    for finer, coarser, one, other in zip(kind.sizes, kind.sizes[1:], kind.cases, kind.cases[1:]):
        if coarser < finer * (1 + 1e-6):
            fail(f"{study.path}: {name} = {other.values[name]} and {one.values[name]} are one grid, of whole numbers of cells of "
                 f"{finer:.6g} m: expected values further apart")


def expect(study, name):
    """Ends the tool if the study does not vary `name`."""
    varied = [n for together, _ in study.vary for n in together]
    if name not in varied and name != "spacing":
        fail(f"--converge: the study does not vary '{name}'{nearest(name, varied + ['spacing'])}; expected "
             f"{', '.join(varied + ['spacing'] * ('spacing' not in varied))}")
    return name in varied


# Cost


def cost_of(kind, ranks):
    """Spacing, (points, steps, seconds) and name of the finest completed run, else of the coarsest by strut --check."""
    for size, case in zip(kind.sizes, kind.cases):
        state = case.state()
        if state.get("over") and not state.get("error") and state.get("seconds"):
            facts = collect.facts_of(case)
            return size, (facts.get("points"), facts.get("steps"), state["seconds"]), f"{plan.name_of(case.values)}, which is done"
    said = kind.cases[-1].check(ranks)
    steps = re.search(r"about (\S+) steps of|^(\S+) load steps", said, re.M)
    time = re.search(r"^estimated time .*?(?:to|more than) ([^(\n]+)", said, re.M)
    if not time:
        return kind.sizes[-1], (None, None, None), "nothing, as strut --check of the coarsest grid tells no time"
    seconds = sum(float(x) * {"h": 3600, "min": 60, "s": 1}[unit] for x, unit in re.findall(r"([\d.]+) (h|min|s)\b", time[1]))
    numbers = collect.last_of("points", said), steps and float(steps[1] or steps[2]), seconds
    return kind.sizes[-1], numbers, "strut --check of the coarsest grid (its longer time)"


def plan_of(name, kinds, ranks):
    """The planned runs and their cost, for reading; sets the cost fraction of each run, for the progress."""
    lines = [f"| run | {name} as meshed | cells | steps | time |", "|---|---|---|---|---|"]
    left, bases = [], []
    largest = max(size for kind in kinds for size in kind.sizes)
    for kind in kinds:
        known_size, known, basis = cost_of(kind, ranks)
        bases.append(basis)
        for size, case in reversed(list(zip(kind.sizes, kind.cases))):
            case.cost = (largest / size)**4
            powers = 3, 0 if source.is_equilibrium(case.source) else 1, 4  # iterations grow, not load steps
            points, steps, seconds = (value and value * (known_size / size)**power for value, power in zip(known, powers))
            time = duration(seconds)
            if case.done():
                facts = collect.facts_of(case)
                points, steps, time = facts.get("points"), facts.get("steps"), f"done in {duration(case.state().get('seconds'))}"
            else:
                left.append(seconds)
            counts = " | ".join("unknown" if n is None else f"{n:,.0f}" for n in (points, steps))
            lines.append(f"| {plan.name_of(case.values)} | {size:.6g} | {counts} | {time} |")
    lines.append(f"Predicted from {' and '.join(dict.fromkeys(bases))}; cells grow as h^-3, steps as h^-1, time as h^-4.")
    if None in left:
        ratio = max((kind.sizes[-1] / kind.sizes[0])**4 for kind in kinds)
        time = f"time unknown, the finest {ratio:.3g} times that of the coarsest"
    elif left:
        time = f"{duration(sum(left))} one after the other, the dearest {duration(max(left))}"
    if left:
        lines.append(f"{len(left)} of {sum(len(kind.cases) for kind in kinds)} left: {time}")
    return "\n".join(lines)
