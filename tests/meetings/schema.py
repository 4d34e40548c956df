"""The deck's schema as `strut --keys` prints it: sections with their keys, and the cases that a key decides on."""
import re
import subprocess
from dataclasses import dataclass, field

ANY = "(any name)"


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
        return self.meaning.startswith("Accepted for Peridigm's decks; no effect")


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


def cells_of(row):
    return [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", row)[1:-1]]


def key_of(row):
    name, kind, unit, values, default, meaning = cells_of(row)
    choices = re.findall(r"`([^`]*)`", values) if kind == "choice" else []
    required = default == "required"
    given = None if required or default == "—" else default.strip("`")
    return Key(name.strip("`"), kind, "" if unit == "—" else unit, choices, given, required, meaning)


def parse(page):
    """A section below another belongs to the case of that one which the page has named last, if it has cases."""
    whole = Section("")
    known = {"": whole}  # where a section below this path belongs: the section, or its last case
    now = whole
    for line in page.splitlines():
        heading = re.fullmatch(r"## (.*?)( \(required\))?", line)
        case = re.fullmatch(r'### (.*), (.*) = "(.*)"', line)
        if case:
            path, selector, name = case.groups()
            owner = known[path] if not known[path].case else known[path + "\n"]
            known[path + "\n"] = owner
            owner.selector = selector
            now = owner.cases[name] = known[path] = Section(path, case=name)
        elif heading and heading[1] != "The whole deck":
            path = heading[1]
            parent, _, name = path.rpartition(" > ")
            now = Section(path, required=bool(heading[2]))
            known[parent].sections[name] = known[path] = now
            known.pop(path + "\n", None)
        elif line.startswith("| `") or line.startswith(f"| {ANY} |"):
            key = key_of(line) if len(cells_of(line)) == 6 else None
            if key:
                now.keys[key.name] = key
    return whole


def schema_of(strut):
    return parse(subprocess.run([strut, "--keys"], check=True, capture_output=True, text=True).stdout)
