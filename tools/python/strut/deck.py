"""A deck as a dictionary."""
import os
import re
from xml.sax.saxutils import quoteattr

import numpy as np

from . import _core

NO_TEXT = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff]")  # which XML does not have


class Deck(dict):
    """Sections are dictionaries, keys have numbers, truth values, texts, or lists of numbers or names; None leaves a key
    out. Or of a file, XML or YAML: `Deck("taylor.xml")`. `name` stands in messages, and for the deck's file: results
    are named relative to the working folder, the mesh and other files that are read relative to the folder of `name`."""

    def __init__(self, source, name="deck"):
        if isinstance(source, (str, os.PathLike)):
            name = os.fspath(source)
            try:
                with open(name, encoding="utf-8-sig") as file:
                    source = _core.parsed(file.read(), name)
            except (OSError, UnicodeDecodeError) as error:
                raise _core.Error(f"{name}: the deck cannot be read: {getattr(error, 'strerror', None) or error}") from None
        if not isinstance(source, dict):
            raise _core.Error(f"a deck of type {type(source).__name__}; expected a dictionary, or the name of a file")
        super().__init__(source)
        self.name = name

    def to_xml(self):
        """The deck as a file of it."""
        return "\n".join(["<ParameterList>", *lines_of(self, "  ", self.name), "</ParameterList>", ""])


def lines_of(section, indent, path):
    for name, value in section.items():
        if value is None:
            continue
        where = f"{path} > {name}"
        if isinstance(value, dict):
            if found := NO_TEXT.search(str(name)):
                raise _core.Error(f"{where!r}: the character {found[0]!r}; expected a name")
            yield f"{indent}<ParameterList name={attribute(name)}>"
            yield from lines_of(value, indent + "  ", where)
            yield f"{indent}</ParameterList>"
        else:
            kind, text = typed(value, where)
            if found := NO_TEXT.search(f"{name}{text}"):
                raise _core.Error(f"{where!r}: the character {found[0]!r}; expected a text")
            yield f'{indent}<Parameter name={attribute(name)} type="{kind}" value={attribute(text)}/>'


def attribute(text):
    return quoteattr(" ".join(str(text).split()) if "\n" in str(text) else str(text), {'"': "&quot;"})


def typed(value, where):
    """The type of a parameter and its text."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (bool, np.bool_)):
        return "bool", "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return "int", str(int(value))
    if isinstance(value, (float, np.floating)):
        return "double", repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return "string", os.fspath(value)
    if isinstance(value, (list, tuple)):
        if all(isinstance(one, str) for one in value):
            return "string", " ".join(value)
        if all(isinstance(one, (int, float, np.integer, np.floating)) for one in value):
            return "Array(double)", "{" + ", ".join(repr(float(one)) for one in value) + "}"
    raise _core.Error(f"{where}: {value!r} of type {type(value).__name__}; expected a section (dict), a number, a truth "
                      "value, a text, or a list of numbers or names")
