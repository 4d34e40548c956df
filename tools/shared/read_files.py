"""The files that a deck names to be read, besides those of Output, History and Restart, which it writes."""
import os
import re

# The keys that name one, anywhere in a section, relative to the deck's folder.
FILES = (("Discretization", "Input Mesh File"), ("Discretization", "File Name"), ("Materials", "Library"))
RESULT = ("Start From", "Checkpoint")  # relative to the working folder, as what a run writes
NO_FILE = re.compile(r"[\d\s]*|nearest\s.*")  # in a set of Peridigm's: numbers of points
TABLE = re.compile(r"(,\s*')([^']+)('\s*\))")  # of an expression: table(t, 'pull.csv')


def rename(deck, renamed):
    """Gives each file that this deck (an element) names another name, renamed(name)."""
    for section, key in (*FILES, RESULT):
        for element in deck.iterfind(f"./ParameterList[@name='{section}']//Parameter[@name='{key}']"):
            name = element.get("value")
            is_here = (section, key) == RESULT and os.path.isfile(name)
            element.set("value", renamed(os.path.abspath(name) if is_here else name))
    for element in deck.iterfind("./ParameterList[@name='Boundary Conditions']/Parameter"):
        if "Node Set" in element.get("name") and not NO_FILE.fullmatch(element.get("value")):
            element.set("value", renamed(element.get("value")))
    rename_tables(deck, renamed)


def rename_tables(deck, renamed):
    for element in deck.iter("Parameter"):
        element.set("value", TABLE.sub(lambda found: found[1] + renamed(found[2]) + found[3], element.get("value", "")))
