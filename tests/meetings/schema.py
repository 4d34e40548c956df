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


# "real > 0, m": kind, range, unit.
VALUE = re.compile(r"(3 reals|\w+)(?: (?:[<>≥≤] [^,]+|in [\[(].*?[\])]))?(?:, (.*))?")


def keys_of(row):
    """The keys of a row: one, or three along the axes."""
    names, value, default, meaning = cells_of(row)
    choices = re.findall(r"`([^`]*)`", value)
    kind, unit = ("choice", "") if choices else VALUE.fullmatch(value).groups()
    required = default == "required"
    given = None if required or default == "—" else default.strip("`")
    for name in names.split(", "):
        yield Key(name.strip("`"), kind, unit or "", choices, given, required, meaning)


def parse(page):
    """A section below another belongs to the case of that one which the page has named last, if it has cases."""
    whole = Section("")
    known = {"": whole}  # where a section below this path belongs: the section, or its last case
    now = [whole]  # those that the next rows belong to: keys that several cases share have a heading with all of them
    for line in page.splitlines():
        heading = re.fullmatch(r"## (.*?)( \(required\))?", line)
        case = re.fullmatch(r"### (.*), (.*?) = (\".*\")", line)
        if case:
            path, selector, quoted = case.groups()
            names = re.findall(r'"([^"]*)"', quoted)
            owner = known[path] if not known[path].case else known[path + "\n"]
            known[path + "\n"] = owner
            owner.selector = selector
            if len(names) == 1:
                owner.cases[names[0]] = known[path] = Section(path, case=names[0])
            now = [owner.cases[name] for name in names]
        elif heading and heading[1] != "The whole deck":
            path = heading[1]
            parent, _, name = path.rpartition(" > ")
            now = [Section(path, required=bool(heading[2]))]
            known[parent].sections[name] = known[path] = now[0]
            known.pop(path + "\n", None)
        elif (line.startswith("| `") or line.startswith(f"| {ANY} |")) and len(cells_of(line)) == 4:
            for key in keys_of(line):
                for section in now:
                    section.keys[key.name] = key
    return whole


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
