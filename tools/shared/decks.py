"""A deck (XML or YAML) and a mesh's recipe, read and changed key by key."""
import functools
import itertools
import math
import os
import re
import subprocess
import xml.etree.ElementTree as tree

import read_files
from strut_tools import fail, nearest, program

NUMBER = r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d{1,2})?\s*"


def text_of(path):
    try:
        with open(path, encoding="utf-8-sig") as file:
            return file.read()
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        fail(f"{path} is not in UTF-8: line {line} has the byte 0x{error.object[error.start]:02x}; expected UTF-8, as by iconv -f ISO-8859-1 -t UTF-8")
    except OSError as error:
        fail(f"{path} cannot be read: {error.strerror}")


def in_xml(path, text):
    """The text of a deck in XML; one in YAML is turned into it by strut-evaluate."""
    if not text.strip() or text.lstrip().startswith("<"):
        return text
    done = subprocess.run([program("strut-evaluate"), "--xml"], input=text, capture_output=True, text=True)
    if done.returncode != 0:
        fail(f"{path} is not a deck: {'; '.join(done.stderr.split(chr(10))).strip('; ')}")
    return done.stdout


class Deck:
    def __init__(self, path):
        self.path, self.text = path, in_xml(path, text_of(path))
        try:
            self.root = tree.fromstring(self.text)
        except tree.ParseError as error:
            fail(f"{path} is not a deck: {error}")
        here = os.path.dirname(os.path.abspath(path))  # value_at() is asked elsewhere
        read_files.rename_tables(self.root, lambda name: os.path.join(here, name))

    def section(self, *names):
        """The element of a section; None where there is none."""
        place = self.root
        for name in names:
            place = next((e for e in place.findall("ParameterList") if e.get("name") == name), None)
            if place is None:
                return None
        return place

    def sections(self, *names):
        """{name: element} of the sections within one."""
        place = self.section(*names)
        return {} if place is None else {e.get("name"): e for e in place.findall("ParameterList")}

    def get(self, *names, default=None):
        """The value of a key, as text; the last name is the key's."""
        place = self.section(*names[:-1])
        found = None if place is None else value_in(place, names[-1])
        return default if found is None else found

    def file(self, *names):
        """Path of a file beside the deck."""
        value = self.get(*names)
        return value and os.path.join(os.path.dirname(self.path), value)

    def recipe(self):
        """The recipe of its mesh; None where there is none."""
        mesh = self.file("Discretization", "Input Mesh File")
        recipe = mesh and os.path.splitext(mesh)[0] + ".recipe"
        return Recipe(recipe) if recipe and os.path.isfile(recipe) else None

    def changed_from(self, other, but):
        """The sections, besides some, in which keys differ from those of another deck; tables apart, which a run fills in."""
        ours, others = keys_in(self.root), keys_in(other.root)
        differ = [place for place in {**ours, **others} if ours.get(place) != others.get(place) and "table(" not in ours.get(place, "")]
        return list(dict.fromkeys(place[0] for place in differ if place[0] not in but))

    @classmethod
    def of(cls, path, text):
        """A deck from a text, as if it stood there."""
        deck = object.__new__(cls)
        deck.path, deck.text, deck.root = path, text, tree.fromstring(text)
        return deck

    def with_value(self, path, value):
        """The same, with another value of the key "Section > … > Key"."""
        deck = Deck.of(self.path, self.text)
        key = deck.key(path)
        key.set("value", value)
        if key.get("type") == "int":  # YAML has 1 where another value is 0.5
            key.set("type", "string")
        deck.text = tree.tostring(deck.root, "unicode")
        return deck

    def with_files(self, renamed):
        """The same, with other names of the files that it reads: renamed(name) for each."""
        deck = Deck.of(self.path, self.text)
        read_files.rename(deck.root, renamed)
        deck.text = tree.tostring(deck.root, "unicode")
        return deck

    def key(self, path):
        """The element of "Section > … > Key"; ends the tool with the nearest name where it is not there."""
        names = [name.strip() for name in path.split(">")]
        place = self.root
        for depth, name in enumerate(names):
            kind = "Parameter" if depth == len(names) - 1 else "ParameterList"
            inside = {e.get("name"): e for e in place.findall(kind)}
            if name not in inside:
                there = ", ".join(sorted(inside)) or "none"
                what = "key" if kind == "Parameter" else "section"
                fail(f"{self.path}: there is no {what} '{' > '.join(names[:depth + 1])}'{nearest(name, list(inside))}; "
                     f"there {'are' if len(inside) > 1 else 'is'} {there}")
            place = inside[name]
        return place


def section(name, content):
    """An element: {key: value, or the content of a section}."""
    found = tree.Element("ParameterList", name=name)
    for key, value in content.items():
        if isinstance(value, dict):
            found.append(section(key, value))
        else:
            tree.SubElement(found, "Parameter", name=key, type="string", value=str(value))
    return found


def keys_in(element, *place):
    """{(section, …, key): value}"""
    found = {(*place, e.get("name")): e.get("value", "") for e in element.findall("Parameter")}
    for e in element.findall("ParameterList"):
        found |= keys_in(e, *place, e.get("name")) or {(*place, e.get("name")): ""}
    return found


def value_in(element, key):
    return next((e.get("value") for e in element.findall("Parameter") if e.get("name") == key), None)


def list_in(element, key):
    """The words of a list of numbers: 0 0 1, or {0, 0, 1}, which lists of YAML and Python become."""
    return (value_in(element, key) or "").strip(" {}").replace(",", " ").split()


def is_true(value):
    """As the program reads it (src/deck/numbers.cpp)."""
    return value is not None and value.strip().lower() in ("true", "yes", "1")


# Recipes


class Recipe:
    """Lines `key = value` in bodies; those before the first `[body]` hold for all."""

    def __init__(self, path):
        self.path, self.text = path, text_of(path)

    def bodies(self):
        """{key: value} of each body."""
        common, bodies = {}, []
        for line in self.text.splitlines():
            line = line.split("#")[0].strip()
            if line == "[body]":
                bodies.append(dict(common))
            elif "=" in line:
                key, value = (part.strip() for part in line.split("=", 1))
                (bodies[-1] if bodies else common)[key] = value
        return bodies or [common]

    def files(self):
        """The paths of the meshes that its bodies are made of, those that are there."""
        named = [os.path.join(os.path.dirname(self.path), body["file"]) for body in self.bodies() if body.get("file")]
        return [path for path in named if os.path.exists(path)]

    def changed(self, key, value):
        """The text with another value of a key, `key` or `body.key`; without the line where the value is empty."""
        body, _, name = key.rpartition(".")
        lines, number, found, named = self.text.splitlines(), -1, [], []
        names = [keys.get("name", "body") for keys in self.bodies()]
        if body and body not in names:
            fail(f"{self.path}: there is no body '{body}'{nearest(body, names)}; there are {', '.join(names)}")
        for i, line in enumerate(lines):
            bare = line.split("#")[0].strip()
            number += bare == "[body]"
            if "=" in bare and (not body or names[max(number, 0)] == body):
                named.append(bare.split("=")[0].strip())
                if named[-1] == name:
                    found.append(i)
        if not found:
            fail(f"{self.path}: there is no line '{key}'{nearest(name, named)}; there are {', '.join(dict.fromkeys(named))}")
        for i in reversed(found):
            if not value:
                del lines[i]
                continue
            lines[i] = re.sub(r"=(\s*)[^#]*?(\s*)(#.*)?$", lambda m: f"={m[1]}{value}{m[2]}{m[3] or ''}", lines[i])
        return "\n".join(lines) + "\n"

    def body(self, name=None):
        """The keys of the body of this name, else of the only one; None where there are several."""
        bodies = self.bodies()
        named = [keys for keys in bodies if keys.get("name", "body") == name]
        return named[0] if named else bodies[0] if len(bodies) == 1 else None


def box_of(body):
    """Edges of the box around a body of a recipe, m; a lattice may have the count of its cells instead (KeyError: neither)."""
    if body.get("shape") == "cylinder":
        return [2 * float(body["radius"])] * 2 + [float(body["length"])]
    if "size" in body:
        return [float(length) for length in body["size"].split()]
    counts = [float(count) for count in body["count"].split()]
    return [float(body["cell"]) * count for count in (counts if len(counts) > 1 else counts * 3)]


# Expressions: the language of decks (inputs/KEYS.md), as the program reads it: strut-evaluate is asked


class NoExpression(Exception):
    """Its text says where and why an expression is wrong."""


@functools.cache
def asked():
    """The running strut-evaluate (STRUT_EVALUATE, or the one that belongs to this tool); it ends with the tool."""
    name = program("strut-evaluate")
    try:
        return subprocess.Popen([name], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    except OSError as error:
        fail(f"{name} cannot be started: {error.strerror}")


def evaluated(text, names):
    """The value of an expression of these {name: number}, possibly nan or infinite; throws NoExpression."""
    for name in set(names) - set("xyzt"):  # the language does not know these names
        text = re.sub(rf"(?<![\w.]){re.escape(name)}(?!\w|\s*\()", f"({float(names[name])!r})", text)
    return answer(" ".join(repr(float(names.get(c, math.nan))) for c in "xyzt"), text)


def answer(numbers, text):
    program = asked()
    program.stdin.write(f"{numbers} {' '.join(text.split())}\n")
    program.stdin.flush()
    answer = program.stdout.readline().strip()
    if answer.startswith("error") or not answer:
        raise NoExpression(answer[len("error "):] or "the program that reads expressions has ended")
    return float(answer)


def value_at(expression, t):
    """A deck's expression of the time alone; None where it needs a place, or is no number."""
    return value_of(expression, {"t": t})


def integrals(expression, begin, times):
    """The integral over time of a deck's expression of t alone from `begin` to each of `times` (s, in order); None if it needs a place,
    or one is not finite."""
    try:
        parts = [answer(f"integral {float(a)!r} {float(b)!r}", expression) for a, b in zip([begin, *times], times)]
    except NoExpression:
        return None
    return list(itertools.accumulate(parts)) if all(map(math.isfinite, parts)) else None


def value_of(expression, names):
    """The number that an expression of these names is; None where it is none."""
    if re.fullmatch(NUMBER, expression):
        return float(expression)
    try:
        found = evaluated(expression, names)
    except NoExpression:
        return None
    return found if math.isfinite(found) else None
