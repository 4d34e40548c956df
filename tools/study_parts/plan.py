"""A study: a deck, its varied values and settings. The file has lines `key = value`; `#` starts a comment."""
import itertools
import os
import re
from dataclasses import dataclass, field

from decks import Deck, text_of, value_of
from strut_tools import check_input, fail, nearest, number

KEYS = ("deck", "vary NAME", "set KEY", "set recipe LINE", "curve", "collect", "plot", "band")


@dataclass
class Plot:
    x: str
    y: str
    by: str | None = None      # a line for each of its values
    beside: str | None = None  # an expression of the varied values, drawn for comparison


@dataclass
class Study:
    path: str
    deck: str = ""
    vary: list = field(default_factory=list)  # (names, [values of each]) per line
    sets: list = field(default_factory=list)  # (True for the recipe, key, value with {…})
    curve: str | None = None                  # options of tools/curve; None: there is no curve
    collect: list = field(default_factory=list)
    plots: list = field(default_factory=list)
    band: str | None = None                   # varied name with a mean curve and a band for each of its values

    def cases(self):
        """A {name: value} for each case: all combinations of the lines `vary`."""
        lines = [[dict(zip(names, values)) for values in all_values] for names, all_values in self.vary]
        return [{k: v for part in parts for k, v in part.items()} for parts in itertools.product(*lines)]

    def expect(self, name, known, what):
        if name not in known:
            fail(f"{self.path}: there is no '{name}' {what}{nearest(name, known)}; there are {', '.join(known)}")


def read(path, converge=None):
    """Reads a study from a file. With `converge` it need not vary or collect anything: the recipe's spacing varies."""
    study = Study(path)
    check_input(path)
    for n, line in enumerate(text_of(path).split("\n"), 1):
        line = line.split("#")[0].strip()
        if line:
            take(study, f"{path}, line {n}", *(part.strip() for part in line.partition("=")[::2]))
    if not study.deck or not (study.vary or converge):
        fail(f"{path}: expected a line 'deck = …' and at least one 'vary NAME = …'")
    for names, _ in study.vary:
        if not any(re.search(rf"{{[^}}]*\b{name}\b", value) for name in names for _, _, value in study.sets):
            fail(f"{path}: '{', '.join(names)}' varies, and no line 'set' has {{{names[0]}}}: all runs would be the same")
    if converge and study.curve is None and not study.collect:
        fail(f"{path}: expected a line 'curve =' or 'collect = …': nothing is read off the runs that could converge")
    if study.band:
        study.expect(study.band, [name for names, _ in study.vary for name in names], "that varies")
        if study.curve is None:
            fail(f"{path}: 'band = {study.band}' needs a line 'curve ='")
    study.deck = os.path.join(os.path.dirname(path), study.deck)
    return study


def take(study, where, key, value):
    kind, _, rest = key.partition(" ")
    rest = rest.strip()
    if kind == "vary" and rest:
        take_vary(study, where, [name.strip() for name in rest.split(",")], value)
    elif kind == "set" and rest:
        recipe, _, line = rest.partition(" ")
        in_recipe = recipe == "recipe" and bool(line)
        name = line.strip() if in_recipe else " > ".join(part.strip() for part in rest.split(">"))
        if any((in_recipe, name) == (a, b) for a, b, _ in study.sets):
            fail(f"{where}: '{key}' again: expected one value")
        study.sets.append((in_recipe, name, value))
    elif key == "plot":
        match = re.fullmatch(r"(\S+) (\S+)(?: by (\S+))?(?: beside (.+))?", value)
        if not match:
            fail(f"{where}: expected 'plot = X Y [by NAME] [beside EXPRESSION]', found '{value}'")
        study.plots.append(Plot(*match.groups()))
    elif key in ("deck", "curve", "band"):
        if getattr(study, key):
            fail(f"{where}: '{key}' again: expected one value")
        setattr(study, key, value)
    elif key == "collect":
        study.collect += value.split()
    else:
        fail(f"{where}: there is no key '{key}'{nearest(kind, [k.split()[0] for k in KEYS])}; there are {', '.join(KEYS)}")


def take_vary(study, where, names, value):
    values = [part.strip() for part in value.split("|")] if "|" in value or len(names) > 1 else value.split()
    rows = [[x.strip() for x in v.split(",")] if len(names) > 1 else [v] for v in values]
    bad = next((r for r in rows if len(r) != len(names)), None)
    if bad is not None or not rows:
        fail(f"{where}: expected values of {', '.join(names)}, one set after the other with | between, found '{value}'")
    if twice := doubles(rows):
        fail(f"{where}: '{', '.join(twice[0])}' and '{', '.join(twice[1])}' are one value: expected each run once")
    if any(name in known for name in names for known, _ in study.vary) or not all(re.fullmatch(r"[A-Za-z]\w*", n) for n in names):
        fail(f"{where}: '{', '.join(names)}': expected names of letters, digits and _, each once")
    study.vary.append((names, rows))


def doubles(rows):
    """Two rows of the same values; numbers are compared by value: 1 and 1.0."""
    seen = {}
    for row in rows:
        values = tuple(number(word) if number(word) is not None else word for word in row)
        if values in seen:
            return seen[values], row
        seen[values] = row
    return None


def filled(text, case, where):
    """Replaces {name} by the value, {expression} by its number."""
    numbers = {name: number(value) for name, value in case.items() if number(value) is not None}

    def one(match):
        inside = match[1].strip()
        if inside in case:
            return case[inside]
        found = value_of(inside, numbers)
        if found is None:
            fail(f"{where}: '{{{inside}}}' is no number of what varies{nearest(inside, list(case))}: {', '.join(case)}")
        return f"{found:.9g}"
    return re.sub(r"\{([^}]*)\}", one, text)


def files_of(study, case):
    """The texts of a case: its deck, and its recipe (None if it has none)."""
    deck = Deck(study.deck)
    recipe = deck.recipe()
    for in_recipe, key, value in study.sets:
        value = filled(value, case, f"{study.path}, set {key}")
        if not in_recipe:
            deck = deck.with_value(key, value)
        elif recipe is None:
            fail(f"{study.path}: the mesh of {study.deck} has no recipe beside it to change {key} in")
        else:
            recipe.text = recipe.changed(key, value)
    return deck, recipe


def check_names(study):
    """Checks that each run has a folder of its own."""
    found = {}
    for case in study.cases():
        said = ", ".join(f"{k} = {v}" for k, v in case.items())
        other = found.setdefault(name_of(case), said)
        if other is not said:
            fail(f"{study.path}: the runs '{other}' and '{said}' would both be in the folder {name_of(case)}: expected values "
                 "that differ in letters, digits, '.', '+' or '-'")


def name_of(case):
    """The name of the case's folder."""
    return ",".join(f"{k}={re.sub(r'[^A-Za-z0-9.+-]+', '-', v) or 'none'}" for k, v in case.items())
