"""The files of a run: those that its deck and its recipe read are linked into its folder, those that it writes stay
there. No other file beside the deck belongs to it, in particular no results of other runs."""
import os
import re

from decks import value_in
from strut_tools import fail

WRITTEN = (("Output", "Output Filename"), ("History", "Filename"), ("Restart", "Filename"))
OWN = ("log", "curve.log", "state.json")  # written by a study into the folder of each run


def of(deck, recipe):
    """The deck and the text of its recipe (None if it has none), both as in the folder of a run; the name of the mesh
    made there (None if none is); and {name in the folder: file} for the files that they read."""
    links, here = {}, os.path.dirname(os.path.abspath(deck.path))
    mesh, made = deck.get("Discretization", "Input Mesh File"), None
    if mesh and recipe is not None:
        made = name_within(mesh)
        deck = deck.with_value("Discretization > Input Mesh File", made)
    deck = deck.with_files(lambda path: path if path == made else link(path, here, links))
    text = recipe and re.sub(r"(?m)^(\s*file\s*=\s*)([^#\n]*[^#\s])", lambda m: m[1] + link(m[2], here, links), recipe.text)
    check_written(deck, [*links, *OWN, os.path.basename(deck.path), *([made, os.path.basename(recipe.path)] if made else [])])
    return deck, text, made, links


def name_within(path):
    """The name within the folder of a run, wherever the file is."""
    return os.path.basename(path) if leads_out(path) else os.path.normpath(path)


def leads_out(path):
    return os.path.isabs(path) or os.path.normpath(path).split(os.sep)[0] == os.pardir


def link(path, here, links):
    """Its name in the folder; the name of no file stays as it is."""
    file = os.path.join(here, path)
    if not os.path.isfile(file):
        return path
    name = name_within(path)
    if name in links and not os.path.samefile(links[name], file):
        fail(f"{links[name]} and {file} would have one name in the folder of a run: expected two")
    links[name] = file
    return name


def writers_in(deck):
    """Section, key and name of each file that a run writes into its folder."""
    found = [(element.get("name") or "", key, value_in(element, key)) for element in deck.root.findall("ParameterList")
             for start, key in WRITTEN if (element.get("name") or "").startswith(start)]
    return [(section, key, name) for section, key, name in found if name]


def check_written(deck, taken):
    """Checks that runs write into their own folders, and not over files that they read."""
    for section, key, name in writers_in(deck):
        where = f"{deck.path}: {section} > {key}"
        if leads_out(name):
            fail(f"{where} '{name}' leads out of the folder of a run, where all runs would write it: expected a name within")
        suffix = ".e" if section.startswith("Output") and not os.path.splitext(name)[1] else ""
        if os.path.normpath(name + suffix) in taken:
            fail(f"{where} '{name}' is also the name of a file that a run needs: expected another one")
