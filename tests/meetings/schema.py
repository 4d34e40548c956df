"""The deck's schema as `strut --keys` prints it: sections with their keys, and the cases that a key decides on."""
import re
import subprocess
from dataclasses import dataclass, field, replace

ANY = "(any name)"
WITHOUT_EFFECT = "Peridigm's, without effect"


@dataclass
class Key:
    name: str
    kind: str
    unit: str
    choices: list
    default: str  # None where there is none
    required: bool
    meaning: str

    @property
    def without_effect(self):
        return self.meaning == WITHOUT_EFFECT


@dataclass
class Section:
    path: str
    required: bool = False
    keys: dict = field(default_factory=dict)
    sections: dict = field(default_factory=dict)
    selector: str = ""
    cases: dict = field(default_factory=dict)  # by the selector's value: sections, too
    case: str = ""

    @property
    def name(self):
        return self.path.split(" > ")[-1]

    def within(self):
        """All sections and cases below, and this."""
        yield self
        for part in [*self.sections.values(), *self.cases.values()]:
            yield from part.within()

    def at(self, path):
        section = self
        for name in path.split(" > "):
            section = section.sections[name]
        return section


# "- `Name_X`, `Name_Y` (real > 0, m; required): meaning", "- (any name) (expression): meaning"; without a meaning, that of
# the key of this name above.
ROW = re.compile(r"( *)- (`[^`]+`(?:, `[^`]+`)*|\(any name\))(?: \((.*?)\))?(?:: (.*))?")
CASE = re.compile(r"(?:- |### )([^`\"]+?) = (\"[^\"]*\"(?:, \"[^\"]*\")*)(?::.*)?")
# "reals > 0, m": kind, range, unit; a real number has no kind.
VALUE = re.compile(r"(?:(3 reals|bool|integer|reals|real|text|axes|names|expression)\b ?)?([<>≥≤] [^,]+|in [\[(].*?[\])])?(?:, )?(.*)")


def keys_of(names, value, meaning):
    """The keys of a row: one, or three along the axes."""
    value, _, default = re.fullmatch(r"(.*?)(; |^|$)(required|default `[^`]*`|)", value or "").groups()
    choices = re.findall(r"`([^`]*)`", value)
    kind, _, unit = ("choice", "", "") if choices else VALUE.fullmatch(value).groups()
    given = default[len("default `"):-1] if default.startswith("default") else None
    for name in names.split(", "):
        yield Key(name.strip("`"), kind or "real", unit, choices, given, default == "required", meaning)


def moved(section, path):
    """The same keys and cases below another path."""
    cases = {name: moved(case, path) for name, case in section.cases.items()}
    return replace(section, path=path, keys=dict(section.keys), cases=cases, sections={})


class Page:
    """A section below another belongs to the case of that one which the page has named last, if it has cases."""

    def __init__(self):
        self.whole = self.owner = Section("")
        self.known = {"": self.whole}  # where a section below this path belongs: the section, or its last case
        self.sections = [self.whole]
        self.now = [self.whole]  # those that the next rows belong to

    def open(self, path, required=False):
        parent, _, name = path.rpartition(" > ")
        self.owner = self.known[parent].sections[name] = self.known[path] = Section(path, required)
        self.sections.append(self.owner)
        self.now = [self.owner]

    def open_cases(self, selector, names, headed):
        if headed:
            self.owner = next(one for one in reversed(self.sections) if selector in one.keys)
        self.owner.selector = selector
        for name in names:
            self.owner.cases.setdefault(name, Section(self.owner.path, case=name))
        self.now = [self.owner.cases[name] for name in names]
        if headed and len(names) == 1:
            self.known[self.owner.path] = self.now[0]

    def copy(self, source):
        """The section has the keys of another one, or the sections of any name of that one have."""
        like = next(one for one in self.sections if one.path == source)
        same = moved(like, self.owner.path)
        self.owner.keys, self.owner.selector, self.owner.cases = same.keys, same.selector, same.cases
        if ANY in like.sections and not like.keys:
            named = like.sections[ANY]
            self.open(f"{self.owner.path} > {ANY}", required=True)
            self.copy(named.path)

    def add(self, line):
        if heading := re.fullmatch(r"## (.*?)( \(required\))?", line):
            if heading[1] != "The whole deck":
                self.open(heading[1], bool(heading[2]))
        elif line.startswith("In sections of any name: "):  # at least one
            self.open(f"{self.owner.path} > {ANY}", required=True)
        elif source := re.fullmatch(r"The keys of (.*)\.", line):
            self.copy(source[1])
        elif idle := re.fullmatch(rf" *- {WITHOUT_EFFECT}: (.*)\.", line):
            self.keep(idle[1], "bool", WITHOUT_EFFECT)
        elif row := ROW.fullmatch(line):
            self.keep(row[2], row[3], row[4] or "")
        elif case := CASE.fullmatch(line):
            self.open_cases(case[1], re.findall(r'"([^"]*)"', case[2]), line.startswith("### "))

    def keep(self, names, value, meaning):
        for key in keys_of(names, value, meaning):
            for section in self.now:
                section.keys[key.name] = replace(key)


def parse(page):
    read = Page()
    for line in page[page.index("\n## "):].splitlines():
        read.add(line)
    for section in read.whole.within():
        if section.cases:
            key = section.keys[section.selector]
            key.kind, key.choices = "choice", list(section.cases)
    return read.whole


def pruned(whole, not_drawn):
    """Without these choices: {path of the key: choices}."""
    for section in whole.within():
        for name, choices in ((path.rpartition(" > ")[2], choices) for path, choices in not_drawn.items()
                              if path.rpartition(" > ")[0] == section.path):
            if name in section.keys:
                section.keys[name].choices = [one for one in section.keys[name].choices if one not in choices]
            if name == section.selector:
                section.cases = {one: case for one, case in section.cases.items() if one not in choices}
    return whole


def schema_of(strut):
    from values import CHOICES_NOT_DRAWN
    page = subprocess.run([strut, "--keys"], check=True, capture_output=True, text=True).stdout
    return pruned(parse(page), CHOICES_NOT_DRAWN)
